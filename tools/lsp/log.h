// SPDX-License-Identifier: Apache-2.0
// The file of `--log`: each message in both directions, with the milliseconds since the start. Written line by line, so
// that it is whole when a server is ended.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace rung::lsp {

class Log {
 public:
  Log() = default;
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // Returns why the file cannot be written, or an empty string.
  [[nodiscard]] std::string open(const std::string& path);
  void received(std::string_view text) { write("<-", text); }
  void sent(std::string_view text) { write("->", text); }

 private:
  void write(const char* direction, std::string_view text);

  std::FILE* file_ = nullptr;  // none: nothing is logged
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace rung::lsp

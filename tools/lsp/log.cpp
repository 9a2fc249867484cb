// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/log.h"

#include <cerrno>
#include <cstring>

namespace rung::lsp {

Log::~Log() {
  if (file_ != nullptr) std::fclose(file_);
}

std::string Log::open(const std::string& path) {
  file_ = std::fopen(path.c_str(), "we");
  if (file_ == nullptr) return "cannot write `" + path + "`: " + std::strerror(errno);
  std::setvbuf(file_, nullptr, _IOLBF, 0);
  return {};
}

void Log::write(const char* direction, std::string_view text) {
  if (file_ == nullptr) return;
  const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin_);
  std::fprintf(file_, "%8lld %s %.*s\n", static_cast<long long>(elapsed.count()), direction,
               static_cast<int>(text.size()), text.data());
}

}  // namespace rung::lsp

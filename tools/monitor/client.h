// SPDX-License-Identifier: Apache-2.0
// A client of the monitor of a running program (docs/monitor.md). In: the URL that the program has printed. Out:
// answers as JSON, and the events of a stream. What it receives may be anything: sizes and times are bounded. Called by
// monitor.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "stdlib/runtime/host/json.h"

namespace rung::monitor {

using host::Json;

// `http://127.0.0.1:8080/?token=…`
bool isUrl(std::string_view text);

class Client {
 public:
  ~Client();
  Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // Empty, or what is wrong with the URL.
  [[nodiscard]] std::string readUrl(const std::string& url);

  struct Answer {
    Json value;
    std::string error;        // empty: it was done
    bool is_refused = false;  // by the program's monitor; else it was not reached
  };
  Answer get(const std::string& path) { return ask("GET", path, ""); }
  Answer post(const std::string& path, const Json& body) { return ask("POST", path, body.toText()); }
  // For what takes as long as a compilation.
  void setPatience(int64_t ms) { patience_ms_ = ms; }

  // Opens the stream of events at this path.
  Answer open(const std::string& path);
  // Waits for the next event, until `stop` can be read or the time is over.
  enum class Event : uint8_t { Values, None, End };
  Event next(Json& values, int stop, int64_t wait_ms);

 private:
  Answer ask(const char* method, const std::string& path, const std::string& body);
  std::string connect(int& fd) const;
  std::string send(int fd, const char* method, const std::string& path, const std::string& body) const;

  std::string host_;
  int64_t patience_ms_ = 10'000;
  uint32_t address_ = 0;
  uint16_t port_ = 0;
  std::string token_;
  int stream_ = -1;
  std::string received_;  // of the stream
};

// As a part of a query.
std::string percentEncoded(std::string_view text);

}  // namespace rung::monitor

// SPDX-License-Identifier: Apache-2.0
// Who may use the monitor: those who have its token, from a page of the monitor itself or from no page at all. In:
// where it listens, and requests. Out: null, or the reply that refuses. Called by monitor.cpp before anything else.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "http.h"

namespace rung::host {

// `[ADDRESS:]PORT` of --monitor.
struct MonitorAddress {
  uint32_t address = 0x7f000001;  // 127.0.0.1
  uint16_t port = 0;              // 0: any
  bool isLoopback() const { return address >> 24 == 127; }
};
// Empty, or what is wrong.
std::string readMonitorAddress(const std::string& text, MonitorAddress& address);

class MonitorAccess {
 public:
  // Makes token and nonce. False: the system has no random numbers.
  bool prepare(const MonitorAddress& address);
  const std::string& token() const { return token_; }
  // Marks the scripts of the page.
  const std::string& scriptNonce() const { return script_nonce_; }
  std::string url() const;
  std::optional<HttpReply> refusal(const HttpRequest& request) const;

 private:
  bool isOwnHost(std::string_view host) const;
  bool hasToken(const HttpRequest& request) const;

  MonitorAddress address_;
  std::string token_, script_nonce_;
};

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// Who may use the monitor: see monitor_access.h.
#include "monitor_access.h"

#include <arpa/inet.h>
#include <sys/random.h>
#include <unistd.h>
#include <charconv>

#include "sockets.h"
#include "symbols.h"

namespace rung::host {
namespace {

std::string addressText(uint32_t address) {
  const in_addr number{htonl(address)};
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &number, text, sizeof text);
  return text;
}

// In a time that does not tell how much of it is right.
bool isSameSecret(std::string_view given, std::string_view secret) {
  unsigned difference = given.size() == secret.size() ? 0 : 1;
  for (size_t i = 0; i < secret.size(); ++i)
    difference |= static_cast<unsigned char>(secret[i]) ^ static_cast<unsigned char>(i < given.size() ? given[i] : 0);
  return difference == 0;
}

// 32 hexadecimal digits; empty: the system has no random numbers.
std::string randomText() {
  unsigned char bytes[16];
  std::string text;
  if (getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes)) return text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace

std::string readMonitorAddress(const std::string& text, MonitorAddress& address) {
  const size_t colon = text.rfind(':');
  const std::string_view port = std::string_view(text).substr(colon == std::string::npos ? 0 : colon + 1);
  const std::from_chars_result read = std::from_chars(port.data(), port.data() + port.size(), address.port);
  const bool is_port = !port.empty() && read.ec == std::errc{} && read.ptr == port.data() + port.size();
  std::string name = colon == std::string::npos ? "127.0.0.1" : text.substr(0, colon);
  if (name == "localhost") name = "127.0.0.1";
  if (is_port && !name.empty() && readAddress(name.c_str(), address.address)) return "";
  return "--monitor needs a port, or an address and a port such as 127.0.0.1:8080, not `" + text + "`";
}

bool MonitorAccess::prepare(const MonitorAddress& address) {
  address_ = address;
  token_ = randomText();
  script_nonce_ = randomText();
  return !token_.empty() && !script_nonce_.empty();
}

std::string MonitorAccess::url() const {
  const std::string host = address_.address == 0 ? "127.0.0.1" : addressText(address_.address);
  return "http://" + host + ':' + std::to_string(address_.port) + "/?token=" + token_;
}

// A name that somebody else's server gives to this address is not one: its page could ask as if it were ours.
bool MonitorAccess::isOwnHost(std::string_view host) const {
  const std::string port = ':' + std::to_string(address_.port);
  if (host.size() > port.size() && host.substr(host.size() - port.size()) == port)
    host.remove_suffix(port.size());
  else if (address_.port != 80)
    return false;
  const std::string name = lowerCase(host);
  if (address_.isLoopback() || address_.address == 0)
    if (name == "localhost" || name == "127.0.0.1") return true;
  if (address_.address != 0) return name == addressText(address_.address);
  uint32_t any = 0;
  char own[256] = "";
  return (!name.empty() && readAddress(name.c_str(), any)) ||
         (gethostname(own, sizeof own - 1) == 0 && name == lowerCase(own));
}

bool MonitorAccess::hasToken(const HttpRequest& request) const {
  constexpr std::string_view kScheme = "bearer ";
  const std::string_view header = request.authorization;
  if (lowerCase(header.substr(0, kScheme.size())) == kScheme)
    return isSameSecret(trimmed(header.substr(kScheme.size())), token_);
  const std::string* const parameter = request.parameter("token");
  return parameter != nullptr && isSameSecret(*parameter, token_);
}

std::optional<HttpReply> MonitorAccess::refusal(const HttpRequest& request) const {
  constexpr std::string_view kScheme = "http://";
  const std::string_view origin = request.origin;
  const bool is_own =
      origin.empty() || (origin.substr(0, kScheme.size()) == kScheme && isOwnHost(origin.substr(kScheme.size())));
  std::optional<HttpReply> reply;
  if (!isOwnHost(request.host))
    reply = httpError(403, "the Host of the request is not this monitor");
  else if (!is_own)
    reply = httpError(403, "the Origin of the request is not a page of this monitor");
  else if (!hasToken(request))
    reply = httpError(401, "the token is missing or wrong; take the URL that the program printed at its start");
  if (reply) reply->closes = true;
  return reply;
}

}  // namespace rung::host

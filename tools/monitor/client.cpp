// SPDX-License-Identifier: Apache-2.0
#include "tools/monitor/client.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

#include "stdlib/runtime/host/clock.h"
#include "stdlib/runtime/host/sockets.h"

namespace rung::monitor {
namespace {

constexpr size_t kLongestAnswer = size_t{64} << 20;
constexpr std::string_view kScheme = "http://";
const char kNotReached[] = "the program is not reached: ";

// False: it does not become ready in time, or is gone.
bool waitFor(int fd, short events, int64_t wait_ms) {
  pollfd ready{fd, events, 0};
  int count = 0;
  do count = poll(&ready, 1, static_cast<int>(wait_ms));
  while (count < 0 && errno == EINTR);
  return count > 0;
}

// Reads until `end` is found, or until the other end closes. False: it takes too long or is too long.
bool receiveUntil(int fd, std::string& to, std::string_view end, int64_t patience_ms) {
  char bytes[16384];
  while (end.empty() || to.find(end) == std::string::npos) {
    if (!waitFor(fd, POLLIN, patience_ms) || to.size() > kLongestAnswer) return false;
    const ssize_t count = recv(fd, bytes, sizeof bytes, 0);
    if (count == 0) return end.empty();
    if (count < 0 && errno != EINTR && errno != EAGAIN) return false;
    if (count > 0) to.append(bytes, static_cast<size_t>(count));
  }
  return true;
}

// `HTTP/1.1 200 OK`; 0: something else.
int statusOf(std::string_view answer) {
  int status = 0;
  if (answer.size() < 12 || !answer.starts_with("HTTP/1.")) return 0;
  std::from_chars(answer.data() + 9, answer.data() + 12, status);
  return status;
}

Client::Answer answerOf(std::string_view text) {
  Client::Answer answer;
  const size_t head = text.find("\r\n\r\n");
  host::JsonResult body = host::parseJson(head == std::string_view::npos ? "" : text.substr(head + 4));
  if (statusOf(text) == 0 || !body.error.empty()) {
    answer.error = "what answers there is not the monitor of a program";
    return answer;
  }
  if (statusOf(text) != 200) {
    answer.error = body.value["error"].text();
    answer.is_refused = true;
  }
  answer.value = std::move(body.value);
  return answer;
}

}  // namespace

bool isUrl(std::string_view text) { return text.starts_with(kScheme) || text.starts_with("https://"); }

std::string percentEncoded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '_') {
      out += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      ((out += '%') += "0123456789ABCDEF"[byte >> 4]) += "0123456789ABCDEF"[byte & 15];
    }
  }
  return out;
}

Client::~Client() {
  if (stream_ >= 0) close(stream_);
}

std::string Client::readUrl(const std::string& url) {
  const std::string wrong =
      "expected the URL that the program printed, http://ADDRESS:PORT/?token=TOKEN, not `" + url + "`";
  std::string_view rest = url;
  if (!rest.starts_with(kScheme)) return wrong;
  rest.remove_prefix(kScheme.size());
  host_ = rest.substr(0, rest.find('/'));
  const size_t colon = host_.find(':'), token = rest.find("token=");
  if (colon == std::string::npos || token == std::string_view::npos) return wrong;
  token_ = rest.substr(token + 6);
  token_.resize(std::min(token_.find_first_of("&# \r\n"), token_.size()));
  const std::string name = host_.substr(0, colon);
  const std::string_view port = std::string_view(host_).substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), port_);
  if (error != std::errc() || end != port.data() + port.size()) return wrong;
  if (host::readAddress(name == "localhost" ? "127.0.0.1" : name.c_str(), address_) && !name.empty()) return "";
  return "write the address of `" + name + "` as numbers, such as 192.168.1.10";
}

std::string Client::connect(int& fd) const {
  bool is_connected = false;
  int32_t ignored = 0;
  fd = host::openTcpClient(address_, port_, is_connected, ignored);
  if (fd < 0) return kNotReached + std::string(strerror(errno));
  if (!is_connected && !waitFor(fd, POLLOUT, patience_ms_)) return kNotReached + std::string("it does not answer");
  int number = 0;
  socklen_t size = sizeof number;
  getsockopt(fd, SOL_SOCKET, SO_ERROR, &number, &size);
  return number == 0 ? "" : kNotReached + std::string(strerror(number));
}

std::string Client::send(int fd, const char* method, const std::string& path, const std::string& body) const {
  std::string text = std::string(method) + ' ' + path + " HTTP/1.1\r\nHost: " + host_ + "\r\nAuthorization: Bearer " +
                     token_ + "\r\nConnection: close\r\n";
  if (!body.empty())
    text += "Content-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n";
  text += "\r\n" + body;
  for (size_t at = 0; at < text.size();) {
    if (!waitFor(fd, POLLOUT, patience_ms_)) return kNotReached + std::string("it does not read");
    const ssize_t count = ::send(fd, text.data() + at, text.size() - at, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR && errno != EAGAIN) break;  // its answer says why
    at += static_cast<size_t>(std::max<ssize_t>(count, 0));
  }
  return "";
}

Client::Answer Client::ask(const char* method, const std::string& path, const std::string& body) {
  int fd = -1;
  std::string error = connect(fd), text;
  if (error.empty()) error = send(fd, method, path, body);
  if (error.empty() && !receiveUntil(fd, text, "", patience_ms_)) error = "the answer is not complete";
  if (fd >= 0) close(fd);
  if (error.empty()) return answerOf(text);
  Answer answer;
  answer.error = std::move(error);
  return answer;
}

// ---- streams

Client::Answer Client::open(const std::string& path) {
  Answer answer;
  answer.error = connect(stream_);
  if (answer.error.empty()) answer.error = send(stream_, "GET", path, "");
  if (!answer.error.empty()) return answer;
  if (!receiveUntil(stream_, received_, "\r\n\r\n", patience_ms_)) return answerOf("");
  if (statusOf(received_) != 200) {
    receiveUntil(stream_, received_, "", patience_ms_);
    return answerOf(received_);
  }
  received_.erase(0, received_.find("\r\n\r\n") + 4);
  return answer;
}

Client::Event Client::next(Json& values, int stop, int64_t wait_ms) {
  constexpr std::string_view kData = "data: ";
  for (const int64_t end = host::monotonicNs() / 1'000'000 + wait_ms;;) {
    const size_t line_end = received_.find("\n\n");
    if (line_end != std::string::npos) {
      const std::string line = received_.substr(0, line_end);
      received_.erase(0, line_end + 2);
      if (!line.starts_with(kData)) continue;
      host::JsonResult data = host::parseJson(std::string_view(line).substr(kData.size()));
      if (!data.error.empty()) return Event::End;
      values = std::move(data.value);
      return Event::Values;
    }
    const int64_t left = end - host::monotonicNs() / 1'000'000;
    if (left <= 0) return Event::None;
    pollfd ready[] = {{stream_, POLLIN, 0}, {stop, POLLIN, 0}};
    const int count = poll(ready, 2, static_cast<int>(left));
    if (count < 0 || ready[1].revents != 0) return Event::None;
    if (ready[0].revents == 0) continue;
    char bytes[16384];
    const ssize_t size = recv(stream_, bytes, sizeof bytes, MSG_DONTWAIT);
    if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR) || received_.size() > kLongestAnswer)
      return Event::End;
    if (size > 0) received_.append(bytes, static_cast<size_t>(size));
  }
}

}  // namespace rung::monitor

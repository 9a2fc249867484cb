// SPDX-License-Identifier: Apache-2.0
#include "tools/protocol/framing.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>

#include "frontend/source/names.h"

namespace rung::protocol {
namespace {

constexpr size_t kUnknownLength = ~size_t{0};
// A larger number is a header that is wrong, not a message that is too long: the wait for its end would not end.
constexpr size_t kMostSkipped = size_t{4} << 30;

std::string_view withoutBlanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// Of `Content-Length: 12`; unknown: the line says something else. After a broken message its rest may be before it.
size_t lengthIn(std::string_view line) {
  constexpr std::string_view kName = "Content-Length";
  const size_t colon = line.rfind(':');
  if (colon == std::string_view::npos || colon < kName.size() ||
      !sameIdentifier(line.substr(colon - kName.size(), kName.size()), kName))
    return kUnknownLength;
  const std::string_view digits = withoutBlanks(line.substr(colon + 1));
  size_t length = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  return is_number && length <= kMostSkipped ? length : kUnknownLength;
}

}  // namespace

// More bytes; false: there are none.
bool MessageReader::fill() {
  constexpr size_t kChunk = size_t{64} << 10;
  if (at_ > 0) {
    buffer_.erase(0, at_);
    at_ = 0;
  }
  pollfd waits[] = {{input_, POLLIN, 0}, {stop_, POLLIN, 0}};
  for (;;) {
    if (poll(waits, 2, -1) < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    if (waits[1].revents != 0) return false;
    const size_t before = buffer_.size();
    buffer_.resize(before + kChunk);
    const ssize_t count = read(input_, buffer_.data() + before, kChunk);
    buffer_.resize(before + static_cast<size_t>(std::max<ssize_t>(count, 0)));
    if (count > 0) return true;
    if (count == 0 || (errno != EINTR && errno != EAGAIN)) return false;
  }
}

// A line without its end; of a line that is too long its beginning. False: the stream has ended.
bool MessageReader::readLine(std::string& line, bool& is_cut) {
  line.clear();
  for (;;) {
    const size_t end = buffer_.find('\n', at_);
    const size_t stop = std::min(end, buffer_.size());
    const size_t room = kMaxHeaderBytes - line.size();
    is_cut = is_cut || stop - at_ > room;
    line.append(buffer_, at_, std::min(stop - at_, room));
    at_ = stop;
    if (end != std::string::npos) break;
    if (!fill()) return false;
  }
  ++at_;
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

MessageReader::Result MessageReader::readBody(size_t length) {
  std::string text;
  for (size_t missing = length; missing > 0;) {
    if (at_ == buffer_.size() && !fill()) return {Kind::End, {}};
    const size_t part = std::min(missing, buffer_.size() - at_);
    if (length <= kMaxMessageBytes) text.append(buffer_, at_, part);
    at_ += part;
    missing -= part;
  }
  if (length > kMaxMessageBytes) return {Kind::Broken, "the message is larger than 128 MiB"};
  return {Kind::Message, std::move(text)};
}

MessageReader::Result MessageReader::next() {
  size_t length = kUnknownLength, header_bytes = 0;
  bool is_cut = false;
  for (std::string line;;) {
    if (!readLine(line, is_cut)) return {Kind::End, {}};
    if (line.empty() && header_bytes == 0) continue;  // blank lines between messages
    if (line.empty()) break;
    header_bytes += line.size();
    if (const size_t given = lengthIn(line); given != kUnknownLength) length = given;
  }
  if (is_cut || header_bytes > kMaxHeaderBytes) return {Kind::Broken, "the header is longer than 16 KiB"};
  if (length == kUnknownLength) return {Kind::Broken, "the header has no Content-Length"};
  return readBody(length);
}

bool writeMessage(int output, std::string_view text) {
  std::string message = "Content-Length: " + std::to_string(text.size()) + "\r\n\r\n";
  message += text;
  for (size_t at = 0; at < message.size();) {
    const ssize_t count = write(output, message.data() + at, message.size() - at);
    if (count > 0) {
      at += static_cast<size_t>(count);
    } else if (count < 0 && errno == EAGAIN) {
      pollfd ready{output, POLLOUT, 0};
      poll(&ready, 1, 1000);
    } else if (count == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace rung::protocol

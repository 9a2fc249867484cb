// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/positions.h"

#include <algorithm>

namespace rung::lsp {
namespace {

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// Of the character that begins with this byte: two for those beyond 0xffff. A byte that is not UTF-8 counts as one.
uint32_t utf16UnitsOf(char lead) { return static_cast<unsigned char>(lead) >= 0xf0 ? 2 : 1; }

}  // namespace

uint32_t unitsOf(std::string_view text, Encoding encoding) {
  if (encoding == Encoding::Utf8) return static_cast<uint32_t>(text.size());
  uint32_t units = 0;
  for (const char c : text)
    if (!isContinuation(c)) units += utf16UnitsOf(c);
  return units;
}

Positions::Positions(std::string_view text, Encoding encoding) : text_(text), encoding_(encoding), starts_{0} {
  size_t carriage = text.find('\r'), feed = text.find('\n');
  while (carriage != std::string_view::npos || feed != std::string_view::npos) {
    size_t end = std::min(carriage, feed) + 1;
    if (end == feed) ++end;  // CR LF
    starts_.push_back(static_cast<uint32_t>(end));
    if (carriage < end) carriage = text.find('\r', end);
    if (feed < end) feed = text.find('\n', end);
  }
}

std::string_view Positions::lineAt(uint32_t line) const {
  const uint32_t begin = starts_[line];
  const size_t end = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
  std::string_view text = text_.substr(begin, end - begin);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

uint32_t Positions::byteOf(Position position) const {
  if (position.line >= starts_.size()) return static_cast<uint32_t>(text_.size());
  const std::string_view line = lineAt(position.line);
  const uint32_t begin = starts_[position.line];
  if (encoding_ == Encoding::Utf8) {
    size_t at = std::min<size_t>(position.character, line.size());
    while (at > 0 && at < line.size() && isContinuation(line[at])) --at;
    return begin + static_cast<uint32_t>(at);
  }
  size_t at = 0;
  for (uint32_t units = 0; at < line.size() && units < position.character;) {
    units += utf16UnitsOf(line[at]);
    if (units > position.character) break;  // in the middle of a pair
    for (++at; at < line.size() && isContinuation(line[at]);) ++at;
  }
  return begin + static_cast<uint32_t>(at);
}

Position Positions::positionOf(uint32_t byte) const {
  byte = std::min(byte, static_cast<uint32_t>(text_.size()));
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), byte);
  const auto line = static_cast<uint32_t>(after - starts_.begin() - 1);
  const uint32_t end = starts_[line] + static_cast<uint32_t>(lineAt(line).size());  // never between CR and LF
  byte = std::min(byte, end);
  if (last_.line != line || last_.byte > byte) last_ = {line, starts_[line], 0};
  last_.units += unitsOf(text_.substr(last_.byte, byte - last_.byte), encoding_);
  last_.byte = byte;
  return {line, last_.units};
}

}  // namespace rung::lsp

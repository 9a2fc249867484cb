// SPDX-License-Identifier: Apache-2.0
// Message files of NCT ladders, docs/nct.md: a line is a number and its text, with a tab between them. Only blanks
// before the text change; the text itself stays byte for byte.
#include <algorithm>

#include "frontend/format/format.h"
#include "frontend/source/message_line.h"

namespace rung::format {
namespace {

std::string written(std::string_view line) {
  const MessageParts parts = messageParts(line);
  std::string out(parts.number);
  if (!parts.text.empty()) (out += '\t') += parts.text;
  return out;
}

}  // namespace

std::string formattedMessages(std::string_view source, const Style& style, LineRange range) {
  const std::string_view newline = source.find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
  std::string out;
  uint32_t number = 0, blank = 0;
  for (size_t at = 0; at < source.size();) {
    const size_t end = std::min(source.find('\n', at), source.size());
    std::string_view line = source.substr(at, end - at);
    at = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const bool may_change = ++number >= range.first && number <= range.last;
    const std::string text = may_change ? written(line) : std::string(line);
    blank = text.empty() ? blank + 1 : 0;
    if (may_change && blank > (out.empty() ? 0 : style.blank_lines)) continue;
    out += text;
    out += newline;
  }
  while (out.ends_with(std::string(newline) + std::string(newline))) out.resize(out.size() - newline.size());
  return out;
}

}  // namespace rung::format

// SPDX-License-Identifier: Apache-2.0
// Characters of strings in the notation of the standard: `$$`, `$'`, `$0A`, and of texts and attributes in XML. Used by
// everything that prints literals, or writes files of vendors.
#pragma once

#include <string>

namespace rung {

// One byte between quotes; `escape`: as `$` and its two digits. A wide string (quote ") has four digits.
inline void appendInQuotes(std::string& out, char c, char quote, bool escape, bool four_digits = false) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  if (c == quote || c == '$') {
    out += '$';
    out += c;
  } else if (escape) {
    out += four_digits ? "$00" : "$";
    out += kHex[byte >> 4];
    out += kHex[byte & 15];
  } else {
    out += c;
  }
}
// One byte of a text or attribute in XML. Line ends are a matter of the file.
inline void appendToXml(std::string& out, char c, bool in_attribute) {
  switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += in_attribute ? "&quot;" : "\""; break;
    case '\n': out += in_attribute ? "&#10;" : "\n"; break;
    case '\t': out += in_attribute ? "&#9;" : "\t"; break;
    case '\r': break;
    default: out += c;
  }
}
inline bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace rung

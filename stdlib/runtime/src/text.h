// SPDX-License-Identifier: Apache-2.0
// Characters of the runtime as bytes: the case of ASCII letters, digits and UTF-8. Called by the runtime's sources and
// the bundled host; not installed as an interface. Without memory of its own.
#pragma once

#include <stddef.h>
#include <stdint.h>

// An ASCII letter in lower case, any other character as it is.
constexpr char rung_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

// Tells whether two spellings are one identifier.
inline bool rung_equal_names(const char* a, size_t length, const char* b) {
  for (size_t i = 0; i < length; ++i)
    if (b[i] == 0 || (a[i] != b[i] && rung_lower(a[i]) != rung_lower(b[i]))) return false;
  return b[length] == 0;
}

// The value of a hexadecimal digit; 99: not one.
constexpr uint32_t rung_digit(char c) {
  return c >= '0' && c <= '9'   ? static_cast<uint32_t>(c - '0')
         : c >= 'a' && c <= 'f' ? static_cast<uint32_t>(c - 'a' + 10)
         : c >= 'A' && c <= 'F' ? static_cast<uint32_t>(c - 'A' + 10)
                                : 99u;
}

// The UTF-8 of a code point; returns the number of bytes.
inline uint32_t rung_utf8(uint32_t code, char (&bytes)[4]) {
  uint32_t count = 0;
  if (code < 0x80) {
    bytes[count++] = static_cast<char>(code);
    return count;
  }
  if (code >= 0x10000) {
    bytes[count++] = static_cast<char>(0xf0 | code >> 18);
    bytes[count++] = static_cast<char>(0x80 | (code >> 12 & 0x3f));
  } else if (code >= 0x800) {
    bytes[count++] = static_cast<char>(0xe0 | code >> 12);
  }
  bytes[count++] = static_cast<char>(code >= 0x800 ? 0x80 | (code >> 6 & 0x3f) : 0xc0 | code >> 6);
  bytes[count++] = static_cast<char>(0x80 | (code & 0x3f));
  return count;
}

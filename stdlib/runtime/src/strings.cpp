// SPDX-License-Identifier: Apache-2.0
// STRING, WSTRING and USTRING in place (rung/code.h): assignment, comparison, conversion between them; integers as
// text. In: NUL-terminated strings. Out: strings of at most `capacity` characters. `to` may overlap `from`.
#include <stdint.h>
#include <string.h>

#include "rung/code.h"
#include "text.h"

namespace {

// The digits of a number below 10000 in the bytes of a 32-bit word, the first in the lowest byte: divided by 100, then
// both halves by 10.
uint32_t fourDigits(uint32_t number) {
  const uint32_t hundreds = number * 5243 >> 19;
  const uint32_t halves = hundreds | (number - hundreds * 100) << 16;
  const uint32_t tens = halves * 103 >> 10 & 0x000f000f;
  return tens | (halves - tens * 10) << 8;
}

bool isSurrogate(uint32_t code) { return code >= 0xd800 && code < 0xe000; }

// UTF-8 of a code point, returns the number of bytes; '?' for an invalid one.
uint32_t encode(uint32_t code, char (&bytes)[4]) {
  return rung_utf8(code >= 0x110000 || isSurrogate(code) ? '?' : code, bytes);
}

// The bytes of the character that begins with `lead`; 1 when it begins none.
uint32_t bytesOf(unsigned char lead) {
  return lead >= 0xf0 && lead < 0xf5 ? 4 : lead >= 0xe0 && lead < 0xf0 ? 3 : lead >= 0xc2 && lead < 0xe0 ? 2 : 1;
}

// The code point at `at`, which advances past it; '?' for invalid bytes.
uint32_t decode(const unsigned char*& at) {
  const uint32_t lead = *at++;
  if (lead < 0x80) return lead;
  const uint32_t more = bytesOf(static_cast<unsigned char>(lead)) - 1;
  if (more == 0) return '?';
  uint32_t code = lead & (0x3fu >> more), i = 0;
  for (; i < more && (at[i] & 0xc0) == 0x80; ++i) code = code << 6 | (at[i] & 0x3fu);
  at += i;
  const uint32_t least = more == 1 ? 0x80u : more == 2 ? 0x800u : 0x10000u;
  return i == more && code >= least && code < 0x110000 && !isSurrogate(code) ? code : '?';
}

// False when there is no room: never half a character.
bool appendCode(char* to, uint32_t capacity, uint32_t& length, uint32_t code) {
  char bytes[4];
  const uint32_t count = encode(code, bytes);
  if (length + count > capacity) return false;
  memcpy(to + length, bytes, count);
  length += count;
  return true;
}

}  // namespace

uint32_t rung_string_assign(char* to, uint32_t capacity, const char* from) {
  const void* const end = memchr(from, 0, capacity);
  const size_t length = end == nullptr ? capacity : static_cast<size_t>(static_cast<const char*>(end) - from);
  memmove(to, from, length);
  to[length] = 0;
  return static_cast<uint32_t>(length);
}

uint32_t rung_wstring_assign(char16_t* to, uint32_t capacity, const char16_t* from) {
  uint32_t length = 0;
  while (length < capacity && rung_unit(from, length) != 0) ++length;
  memmove(static_cast<void*>(to), from, length * sizeof *from);
  rung_set_unit(to, length, 0);
  return length;
}

int rung_string_compare(const char* a, const char* b) { return strcmp(a, b); }

int rung_wstring_compare(const char16_t* a, const char16_t* b) {
  for (uint32_t i = 0;; ++i) {
    const char16_t one = rung_unit(a, i), other = rung_unit(b, i);
    if (one != other) return one < other ? -1 : 1;
    if (one == 0) return 0;
  }
}

uint32_t rung_wstring_length(const char16_t* string) {
  uint32_t length = 0;
  while (rung_unit(string, length) != 0) ++length;
  return length;
}

uint32_t rung_string_of_wstring(char* to, uint32_t capacity, const char16_t* from) {
  uint32_t length = 0;
  for (uint32_t i = 0; rung_unit(from, i) != 0; ++i) {
    uint32_t code = rung_unit(from, i);
    if (code >= 0xd800 && code < 0xdc00) {
      const char16_t second = rung_unit(from, i + 1);
      if (second >= 0xdc00 && second < 0xe000) {
        code = 0x10000 + ((code - 0xd800) << 10) + (second - 0xdc00u);
        ++i;
      }
    }
    if (!appendCode(to, capacity, length, code)) break;
  }
  to[length] = 0;
  return length;
}

uint32_t rung_wstring_of_string(char16_t* to, uint32_t capacity, const char* from) {
  uint32_t length = 0;
  const unsigned char* at = reinterpret_cast<const unsigned char*>(from);
  while (*at != 0) {
    const uint32_t code = decode(at);
    const uint32_t units = code >= 0x10000 ? 2 : 1;
    if (length + units > capacity) break;
    if (units == 2) {
      rung_set_unit(to, length++, static_cast<char16_t>(0xd800 + ((code - 0x10000) >> 10)));
      rung_set_unit(to, length++, static_cast<char16_t>(0xdc00 + ((code - 0x10000) & 0x3ff)));
    } else {
      rung_set_unit(to, length++, static_cast<char16_t>(code));
    }
  }
  rung_set_unit(to, length, 0);
  return length;
}

uint32_t rung_ustring_whole(char* string, uint32_t length) {
  uint32_t begin = length;  // of the last character
  while (begin > 0 && length - begin < 3 && (static_cast<unsigned char>(string[begin - 1]) & 0xc0) == 0x80) --begin;
  if (begin > 0 && length - begin + 1 < bytesOf(static_cast<unsigned char>(string[begin - 1]))) {
    length = begin - 1;
    string[length] = 0;
  }
  return length;
}

uint32_t rung_ustring_assign(char* to, uint32_t capacity, const char* from) {
  return rung_ustring_whole(to, rung_string_assign(to, capacity, from));
}

uint32_t rung_ustring_length(const char* string) {
  uint32_t length = 0;
  for (; *string != 0; ++string) length += (static_cast<unsigned char>(*string) & 0xc0) != 0x80;
  return length;
}

int64_t rung_ustring_offset(const char* string, int64_t count) {
  int64_t offset = 0;
  for (; count > 0; --count) {
    if (string[offset] == 0) return offset + count;
    ++offset;
    while ((static_cast<unsigned char>(string[offset]) & 0xc0) == 0x80) ++offset;
  }
  return offset + count;  // a negative count stays negative
}

uint32_t rung_ustring_code(const char* string) {
  const unsigned char* at = reinterpret_cast<const unsigned char*>(string);
  return decode(at);
}

uint32_t rung_ustring_of_code(char* to, uint32_t capacity, uint32_t code) {
  char bytes[4];
  uint32_t length = code == 0 ? 0 : encode(code, bytes);
  if (length > capacity) length = 0;
  memcpy(to, bytes, length);
  to[length] = 0;
  return length;
}

uint32_t rung_ustring_of_string(char* to, uint32_t capacity, const char* from) {
  // A '?' is no longer than the bytes that it replaces, so `to` may be `from`.
  uint32_t length = 0;
  const unsigned char* at = reinterpret_cast<const unsigned char*>(from);
  while (*at != 0) {
    if (!appendCode(to, capacity, length, decode(at))) break;
  }
  to[length] = 0;
  return length;
}

uint32_t rung_string_of_integer(char* to, uint32_t capacity, bool negative, uint64_t magnitude) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  if (magnitude < 1000000 && capacity >= 7) {
    // All digits at once; then leading zeros are shifted out, zeros come in at the end, and one store writes digits and
    // NUL. The bytes after it stay as they were.
    const auto number = static_cast<uint32_t>(magnitude);
    const bool is_short = number < 10000;
    const uint64_t digits =
        is_short ? fourDigits(number) : fourDigits(number / 10000) | uint64_t{fourDigits(number % 10000)} << 32;
    const uint32_t last = is_short ? 24 : 56;  // the bit where the last digit begins; that digit may be a zero
    const uint32_t zeros = static_cast<uint32_t>(__builtin_ctzll(digits | uint64_t{1} << last)) & ~7u;
    uint64_t word = (digits | uint64_t{0x3030303030303030} >> (56 - last)) >> zeros;
    if (negative) word = word << 8 | '-';
    const uint32_t length = (last - zeros) / 8 + 1 + negative;
    uint64_t old;
    memcpy(&old, to, sizeof old);
    const uint64_t after = length == 7 ? 0 : ~uint64_t{0} << (length + 1) * 8;
    word |= old & after;
    memcpy(to, &word, sizeof word);
    return length;
  }
#endif
  uint32_t length = negative ? 2 : 1;
  for (uint64_t rest = magnitude; rest >= 10; rest /= 10) ++length;
  const uint32_t kept = length < capacity ? length : capacity;
  for (uint32_t i = length; i > negative; --i, magnitude /= 10) {
    if (i <= kept) to[i - 1] = static_cast<char>('0' + magnitude % 10);
  }
  if (negative && kept > 0) to[0] = '-';
  to[kept] = 0;
  return kept;
}

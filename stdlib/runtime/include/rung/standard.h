/* SPDX-License-Identifier: Apache-2.0 */
/* String functions of the library Standard for strings whose lengths the generated code keeps in C++ locals: the sized
 * forms of the functions marked {sized} in standard/string.st, and the slice forms of those marked {slice}. In: each
 * string followed by its length. Out: the result in `out`, and its length. Semantics are those of
 * standard/native/string.cpp: a result has at most 255 characters and at most `capacity`. `out` is one of the inputs,
 * which then may be longer than `capacity`, or overlaps none. Included by generated code that calls one of them. */
#ifndef RUNG_STANDARD_H
#define RUNG_STANDARD_H

#include "rung/code.h"

static inline uint32_t rung_string_limit(uint32_t capacity) { return capacity < 255 ? capacity : 255; }

/* Single characters are the most frequent parts of all: one store for the character and the NUL. */
static inline uint32_t rung_string_part(char* out, const char* from, uint32_t length) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  if (length == 1) {
    const uint16_t ended = (uint8_t)*from;
    memcpy(out, &ended, 2);
    return 1;
  }
#endif
  memmove(out, from, length);
  out[length] = 0;
  return length;
}

static inline int16_t rung_standard_LEN__STRING_255_sized(const char*, uint32_t length) {
  return length > INT16_MAX ? INT16_MAX : (int16_t)length;
}

/* How many of `length` characters LEFT and RIGHT take; `result`: as many of them as have room. */
static inline uint32_t rung_string_taken(uint32_t length, int32_t l, uint32_t capacity, uint32_t* result) {
  const uint32_t limit = rung_string_limit(capacity);
  uint32_t count = (uint32_t)l;
  if (!RUNG_UNLIKELY(count > length || count > limit)) { /* a foretold jump is quicker than a choice */
    *result = count;
    return count;
  }
  if (l < 0) count = 0;
  if (count > length) count = length;
  *result = count > limit ? limit : count;
  return count;
}

/* The slice forms return the beginning of the result, which is a part of the input, and set its length. */
static inline const char* rung_standard_LEFT__STRING_255_slice(const char* in, uint32_t length, int32_t l,
                                                               uint32_t capacity, uint32_t* result) {
  rung_string_taken(length, l, capacity, result);
  return in;
}

static inline const char* rung_standard_RIGHT__STRING_255_slice(const char* in, uint32_t length, int32_t l,
                                                                uint32_t capacity, uint32_t* result) {
  return in + (length - rung_string_taken(length, l, capacity, result));
}

static inline const char* rung_standard_MID__STRING_255_slice(const char* in, uint32_t length, int32_t l, int32_t p,
                                                              uint32_t capacity, uint32_t* result) {
  const uint32_t limit = rung_string_limit(capacity);
  *result = 0;
  if (l <= 0 || p < 1 || (uint32_t)p > length) return in;
  uint32_t count = (uint32_t)l;
  if (count > 1 && count > length - ((uint32_t)p - 1)) count = length - ((uint32_t)p - 1);
  *result = count > limit ? limit : count;
  return in + (p - 1);
}

static inline uint32_t rung_standard_LEFT__STRING_255_sized(const char* in, uint32_t length, int32_t l, char* out,
                                                            uint32_t capacity) {
  uint32_t count;
  const char* from = rung_standard_LEFT__STRING_255_slice(in, length, l, capacity, &count);
  return rung_string_part(out, from, count);
}

static inline uint32_t rung_standard_RIGHT__STRING_255_sized(const char* in, uint32_t length, int32_t l, char* out,
                                                             uint32_t capacity) {
  uint32_t count;
  const char* from = rung_standard_RIGHT__STRING_255_slice(in, length, l, capacity, &count);
  return rung_string_part(out, from, count);
}

static inline uint32_t rung_standard_MID__STRING_255_sized(const char* in, uint32_t length, int32_t l, int32_t p,
                                                           char* out, uint32_t capacity) {
  uint32_t count;
  const char* from = rung_standard_MID__STRING_255_slice(in, length, l, p, capacity, &count);
  return rung_string_part(out, from, count);
}

extern "C" {
uint32_t rung_string_join(const char* in1, uint32_t length1, const char* in2, uint32_t length2, char* out,
                          uint32_t capacity);
uint32_t rung_standard_INSERT__STRING_255_sized(const char* in1, uint32_t length1, const char* in2, uint32_t length2,
                                                int32_t p, char* out, uint32_t capacity);
uint32_t rung_string_delete(const char* in, uint32_t length, int32_t l, int32_t p, char* out, uint32_t capacity);
uint32_t rung_standard_REPLACE__STRING_255_sized(const char* in1, uint32_t length1, const char* in2, uint32_t length2,
                                                 int32_t l, int32_t p, char* out, uint32_t capacity);
uint32_t rung_string_search(const char* in, uint32_t length, char unit) RUNG_PURE; /* as rung_string_find_unit */
int16_t rung_string_find(const char* in1, uint32_t length1, const char* in2, uint32_t length2) RUNG_PURE;
}

/* Appends in place when `out` is in1. */
static inline uint32_t rung_standard_CONCAT__STRING_255_sized(const char* in1, uint32_t length1, const char* in2,
                                                              uint32_t length2, char* out, uint32_t capacity) {
  const uint32_t limit = rung_string_limit(capacity);
  if (out != in1) return rung_string_join(in1, length1, in2, length2, out, capacity);
  if (length1 + length2 <= limit) /* keeps a constant length */
    return length1 + rung_string_part(out + length1, in2, length2);
  if (length1 > limit) length1 = limit;
  return length1 + rung_string_part(out + length1, in2, limit - length1);
}

/* `from` comes after `to`. */
static inline void rung_string_move_down(char* to, const char* from, uint32_t count) {
  if (count >= 8 && count <= 64) {
    uint64_t last, word;
    memcpy(&last, from + count - 8, 8);
    char* const end = to + count - 8;
    while (to < end) {
      memcpy(&word, from, 8);
      memcpy(to, &word, 8);
      to += 8;
      from += 8;
    }
    memcpy(end, &last, 8);
    return;
  }
  memmove(to, from, count);
}

/* From inside a string, in place: the rest moves. */
static inline uint32_t rung_standard_DELETE__STRING_255_sized(const char* in, uint32_t length, int32_t l, int32_t p,
                                                              char* out, uint32_t capacity) {
  if (out != in || l <= 0 || p <= 0 || (uint32_t)p > length || length > rung_string_limit(capacity))
    return rung_string_delete(in, length, l, p, out, capacity);
  const uint32_t begin = (uint32_t)p - 1, count = rung_min_u32((uint32_t)l, length - begin);
  rung_string_move_down(out + begin, out + begin + count, length - begin - count);
  out[length - count] = 0;
  return length - count;
}

/* Sets the top bit of each byte that equals `unit`; the lowest bit set is that of the first one. */
static inline uint64_t rung_string_units(uint64_t word, char unit) {
  const uint64_t ones = 0x0101010101010101ULL;
  word ^= ones * (uint8_t)unit;
  return (word - ones) & ~word & ones << 7;
}

/* Index of the first `unit`, or `length`. A set of a few characters, such as the digits, is searched without a call:
 * as two words whose bytes are compared at once; so is the beginning of a longer string. */
static inline uint32_t rung_string_find_unit(const char* in, uint32_t length, char unit) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  if (length >= 8 && length <= 16) {
    uint64_t first, last;
    memcpy(&first, in, 8);
    memcpy(&last, in + length - 8, 8);
    first = rung_string_units(first, unit);
    last = rung_string_units(last, unit);
    if (first != 0) return (uint32_t)__builtin_ctzll(first) / 8;
    return last != 0 ? length - 8 + (uint32_t)__builtin_ctzll(last) / 8 : length;
  }
  if (length > 16) {
    uint64_t first;
    memcpy(&first, in, 8);
    first = rung_string_units(first, unit);
    if (first != 0) return (uint32_t)__builtin_ctzll(first) / 8;
  }
#endif
  return rung_string_search(in, length, unit);
}

static inline int16_t rung_standard_FIND__STRING_255_sized(const char* in1, uint32_t length1, const char* in2,
                                                           uint32_t length2) {
  if (length2 != 1) return rung_string_find(in1, length1, in2, length2);
  const uint32_t at = rung_string_find_unit(in1, length1, *in2);
  return at == length1 ? 0 : at >= INT16_MAX ? INT16_MAX : (int16_t)(at + 1);
}

/* Numbers in decimal digits are read without a call; all others as text that ends with a NUL. */
static inline bool rung_string_digits(const char* in, uint32_t length, uint64_t* number) {
  const bool is_negative = length > 1 && *in == '-';
  uint64_t value = 0;
  if (length == 0) return false;
  for (uint32_t i = is_negative; i < length; ++i) {
    const uint8_t digit = (uint8_t)(in[i] - '0');
    if (digit > 9) return false;
    value = value * 10 + digit;
  }
  *number = is_negative ? 0 - value : value;
  return true;
}
#define RUNG_SIZED_NUMBER(TYPE, T)                                                                  \
  extern "C" T rung_standard_STRING_TO_##TYPE(rung_context* ctx, const char* in);                   \
  static inline RUNG_COLD T rung_string_to_##TYPE(const char* in, uint32_t length) {                \
    char text[256];                                                                                 \
    rung_string_part(text, in, length < 255 ? length : 255);                                        \
    return rung_standard_STRING_TO_##TYPE(nullptr, text);                                           \
  }                                                                                                 \
  static inline T rung_standard_STRING_TO_##TYPE##_sized(const char* in, uint32_t length) {         \
    uint64_t number;                                                                                \
    return rung_string_digits(in, length, &number) ? (T)number : rung_string_to_##TYPE(in, length); \
  }
/* Numbers of up to five digits are written without a call, two digits at a time. */
static inline uint32_t rung_string_number(char* to, uint32_t capacity, bool negative, uint64_t magnitude) {
  static const char pairs[] =
      "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
      "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";
  if (magnitude >= 100000 || capacity < 6) return rung_string_of_integer(to, capacity, negative, magnitude);
  uint32_t rest = (uint32_t)magnitude, length = 1;
  *to = '-';
  char* at = to + negative;
  if (rest >= 1000) {
    length = 4;
    if (rest >= 10000) {
      length = 5;
      *at++ = (char)('0' + rest / 10000);
      rest %= 10000;
    }
    memcpy(at, pairs + rest / 100 * 2, 2);
    memcpy(at + 2, pairs + rest % 100 * 2, 2);
    at[4] = 0;
  } else if (rest >= 10) {
    length = 2;
    if (rest >= 100) {
      length = 3;
      *at++ = (char)('0' + rest / 100);
      rest %= 100;
    }
    memcpy(at, pairs + rest * 2, 2);
    at[2] = 0;
  } else {
    at[0] = (char)('0' + rest);
    at[1] = 0;
  }
  return length + negative;
}
#define RUNG_SIZED_TEXT(TYPE, T)                                                                       \
  static inline uint32_t rung_standard_TO_STRING__##TYPE##_sized(T in, char* out, uint32_t capacity) { \
    const bool negative = (T)-1 < (T)0 && (int64_t)in < 0;                                             \
    return rung_string_number(out, capacity, negative, negative ? 0 - (uint64_t)in : (uint64_t)in);    \
  }
static inline uint32_t rung_standard_TO_STRING__STRING_255_sized(const char* in, uint32_t length, char* out,
                                                                 uint32_t capacity) {
  return rung_string_put(out, rung_string_limit(capacity), in, length);
}

#define RUNG_SIZED_BOTH(TYPE, T) RUNG_SIZED_NUMBER(TYPE, T) RUNG_SIZED_TEXT(TYPE, T)
RUNG_SIZED_BOTH(BYTE, uint8_t)
RUNG_SIZED_BOTH(WORD, uint16_t)
RUNG_SIZED_BOTH(DWORD, uint32_t)
RUNG_SIZED_BOTH(LWORD, uint64_t)
RUNG_SIZED_BOTH(SINT, int8_t)
RUNG_SIZED_BOTH(INT, int16_t)
RUNG_SIZED_BOTH(DINT, int32_t)
RUNG_SIZED_BOTH(LINT, int64_t)
RUNG_SIZED_BOTH(USINT, uint8_t)
RUNG_SIZED_BOTH(UINT, uint16_t)
RUNG_SIZED_BOTH(UDINT, uint32_t)
RUNG_SIZED_BOTH(ULINT, uint64_t)
#undef RUNG_SIZED_BOTH
#undef RUNG_SIZED_TEXT
#undef RUNG_SIZED_NUMBER

#endif

/* Text functions of the library Standard for texts whose lengths the generated code keeps in C++ locals: the sized
 * forms of the functions marked {sized} in standard/string.st, and the slice forms of those marked {slice}. In: each
 * text followed by its length. Out: the result in `out`, and its length. Semantics are those of
 * standard/native/string.cpp: a result has at most 255 characters and at most `capacity`. `out` is one of the inputs or
 * apart from all; included by generated code that calls one of them. */
#ifndef RUNG_STANDARD_H
#define RUNG_STANDARD_H

#include "rung/code.h"

static inline uint32_t rung_text_limit(uint32_t capacity) { return capacity < 255 ? capacity : 255; }

static inline uint32_t rung_text_part(char* out, const char* from, uint32_t length) {
  rung_text_move(out, from, length);
  out[length] = 0;
  return length;
}

static inline int16_t rung_standard_LEN__STRING_255_sized(const char*, uint32_t length) {
  return length > INT16_MAX ? INT16_MAX : (int16_t)length;
}

/* The slice forms tell which part of the input the result is: they give its beginning, and set its length. */
static inline const char* rung_standard_LEFT__STRING_255_slice(const char* in, uint32_t length, int32_t l,
                                                               uint32_t capacity, uint32_t* result) {
  const uint32_t limit = rung_text_limit(capacity);
  uint32_t count = l < 0 ? 0 : (uint32_t)l;
  if (count > length) count = length;
  *result = count > limit ? limit : count;
  return in;
}

static inline const char* rung_standard_RIGHT__STRING_255_slice(const char* in, uint32_t length, int32_t l,
                                                                uint32_t capacity, uint32_t* result) {
  const uint32_t limit = rung_text_limit(capacity);
  uint32_t count = l < 0 ? 0 : (uint32_t)l;
  if (count > length) count = length;
  *result = count > limit ? limit : count;
  return in + (length - count);
}

static inline const char* rung_standard_MID__STRING_255_slice(const char* in, uint32_t length, int32_t l, int32_t p,
                                                              uint32_t capacity, uint32_t* result) {
  const uint32_t limit = rung_text_limit(capacity);
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
  return rung_text_part(out, from, count);
}

static inline uint32_t rung_standard_RIGHT__STRING_255_sized(const char* in, uint32_t length, int32_t l, char* out,
                                                             uint32_t capacity) {
  uint32_t count;
  const char* from = rung_standard_RIGHT__STRING_255_slice(in, length, l, capacity, &count);
  return rung_text_part(out, from, count);
}

static inline uint32_t rung_standard_MID__STRING_255_sized(const char* in, uint32_t length, int32_t l, int32_t p,
                                                           char* out, uint32_t capacity) {
  uint32_t count;
  const char* from = rung_standard_MID__STRING_255_slice(in, length, l, p, capacity, &count);
  return rung_text_part(out, from, count);
}

extern "C" {
uint32_t rung_text_join(const char* in1, uint32_t length1, const char* in2, uint32_t length2, char* out,
                        uint32_t capacity);
uint32_t rung_standard_INSERT__STRING_255_sized(const char* in1, uint32_t length1, const char* in2, uint32_t length2,
                                                int32_t p, char* out, uint32_t capacity);
uint32_t rung_standard_DELETE__STRING_255_sized(const char* in, uint32_t length, int32_t l, int32_t p, char* out,
                                                uint32_t capacity);
uint32_t rung_standard_REPLACE__STRING_255_sized(const char* in1, uint32_t length1, const char* in2, uint32_t length2,
                                                 int32_t l, int32_t p, char* out, uint32_t capacity);
int16_t rung_text_find(const char* in1, uint32_t length1, const char* in2, uint32_t length2) RUNG_PURE;
}

/* What fits is appended in place, without a call where its length is a constant. */
static inline uint32_t rung_standard_CONCAT__STRING_255_sized(const char* in1, uint32_t length1, const char* in2,
                                                              uint32_t length2, char* out, uint32_t capacity) {
  const uint32_t limit = rung_text_limit(capacity);
  if (out != in1 || length2 > limit || length1 > limit - length2)
    return rung_text_join(in1, length1, in2, length2, out, capacity);
  return length1 + rung_text_part(out + length1, in2, length2);
}

/* A bit at the top of each byte that is `unit`; the lowest bit set is that of the first one. */
static inline uint64_t rung_text_units(uint64_t word, char unit) {
  const uint64_t ones = 0x0101010101010101ULL;
  word ^= ones * (uint8_t)unit;
  return (word - ones) & ~word & ones << 7;
}

/* Index of the first `unit`, or `length`. Most texts are short, and what is looked for stands near: the first
 * characters are compared as one word, without a call. */
static inline uint32_t rung_text_find_unit(const char* in, uint32_t length, char unit) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  uint64_t word, found;
  if (length >= 8) {
    memcpy(&word, in, 8);
    found = rung_text_units(word, unit);
    if (found != 0) return (uint32_t)__builtin_ctzll(found) / 8;
    if (length <= 16) {
      memcpy(&word, in + length - 8, 8);
      found = rung_text_units(word, unit);
      return found != 0 ? length - 8 + (uint32_t)__builtin_ctzll(found) / 8 : length;
    }
  } else if (length >= 4) {
    uint32_t first, last;
    memcpy(&first, in, 4);
    memcpy(&last, in + length - 4, 4);
    found = rung_text_units(first | (uint64_t)last << 8 * (length - 4), unit); /* behind the text are zeros */
    const uint32_t at = found != 0 ? (uint32_t)__builtin_ctzll(found) / 8 : length;
    return at < length ? at : length;
  }
#endif
  if (length < 4) {
    for (uint32_t i = 0; i < length; ++i)
      if (in[i] == unit) return i;
    return length;
  }
  const char* at = (const char*)memchr(in, unit, length);
  return at != nullptr ? (uint32_t)(at - in) : length;
}

static inline int16_t rung_standard_FIND__STRING_255_sized(const char* in1, uint32_t length1, const char* in2,
                                                           uint32_t length2) {
  if (length2 != 1) return rung_text_find(in1, length1, in2, length2);
  const uint32_t at = rung_text_find_unit(in1, length1, *in2);
  return at == length1 ? 0 : at >= INT16_MAX ? INT16_MAX : (int16_t)(at + 1);
}

#endif

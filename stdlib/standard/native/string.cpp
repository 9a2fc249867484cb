// SPDX-License-Identifier: Apache-2.0
// Native bodies of string.st. Positions count from 1, in bytes of a STRING and 16-bit units of a WSTRING. A result has
// at most 255 characters and at most `capacity`; `out` may be one of the inputs. Lengths and positions outside of a
// string are clipped, so nothing outside of it is ever accessed. CODESYS documents what its functions do there (library
// Standard, "INSERT", "DELETE", "REPLACE"): position 0 is the first character with a length that is one less.
#include <string.h>

#include "rung/code.h"
#include "rung/standard.h"

namespace {

constexpr uint32_t kLongest = 255;

template <class Unit>
int64_t lengthOf(const Unit* string) {
  int64_t length = 0;
  while (string[length] != 0) ++length;
  return length;
}
inline int64_t lengthOf(const char* string) { return static_cast<int64_t>(strlen(string)); }

// Like lengthOf, but looks no further than `most`.
template <class Unit>
int64_t lengthUpTo(const Unit* string, int64_t most) {
  int64_t length = 0;
  while (length < most && string[length] != 0) ++length;
  return length;
}
inline int64_t lengthUpTo(const char* string, int64_t most) {
  const void* end = most > 0 ? memchr(string, 0, static_cast<size_t>(most)) : nullptr;
  return end != nullptr ? static_cast<const char*>(end) - string : most > 0 ? most : 0;
}

int64_t clip(int64_t value, int64_t low, int64_t high) { return value < low ? low : value > high ? high : value; }

uint32_t limitOf(uint32_t capacity) { return capacity < kLongest ? capacity : kLongest; }

// `count` characters from `from`, which may be inside `out`. Like all functions that make a string, returns its length.
template <class Unit>
uint32_t give(const Unit* from, int64_t count, Unit* out, uint32_t capacity) {
  const int64_t taken = clip(count, 0, limitOf(capacity));
  memmove(out, from, static_cast<size_t>(taken) * sizeof(Unit));
  out[taken] = 0;
  return static_cast<uint32_t>(taken);
}

// True when the `length` characters of `string` are inside the memory that `out` writes.
template <class Unit>
bool overlaps(const Unit* string, int64_t length, const Unit* out, uint32_t capacity) {
  const uintptr_t at = reinterpret_cast<uintptr_t>(string), begin = reinterpret_cast<uintptr_t>(out);
  return at < begin + (uint64_t{capacity} + 1) * sizeof(Unit) &&
         begin <= at + static_cast<size_t>(length) * sizeof(Unit);
}

// Collects a result part by part: directly in `out` when no input is there, else in a buffer.
template <class Unit>
class Result {
 public:
  Result(Unit* out, uint32_t capacity, bool apart) : out_(out), to_(apart ? units_ : out), limit_(limitOf(capacity)) {}
  void append(const Unit* from, int64_t count) {
    const int64_t taken = clip(count, 0, limit_ - length_);
    memcpy(to_ + length_, from, static_cast<size_t>(taken) * sizeof(Unit));
    length_ += static_cast<uint32_t>(taken);
  }
  uint32_t finish() {
    if (to_ != out_) memcpy(out_, to_, length_ * sizeof(Unit));
    out_[length_] = 0;
    return length_;
  }

 private:
  Unit* out_;
  Unit* to_;
  uint32_t limit_, length_ = 0;
  Unit units_[kLongest];
};

template <class Unit>
uint32_t mid(const Unit* in, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  const int64_t begin = position - 1, end = begin + clip(count, 0, kLongest);
  const int64_t length = lengthUpTo(in, end);
  if (begin < 0 || begin >= length) return give(in, 0, out, capacity);
  return give(in + begin, length - begin, out, capacity);
}

template <class Unit>
uint32_t left(const Unit* in, int64_t count, Unit* out, uint32_t capacity) {
  return give(in, lengthUpTo(in, clip(count, 0, kLongest)), out, capacity);
}

template <class Unit>
uint32_t right(const Unit* in, int64_t count, Unit* out, uint32_t capacity) {
  const int64_t length = lengthOf(in), taken = clip(count, 0, length);
  return give(in + length - taken, taken, out, capacity);
}

// Appends in place when `out` is in1.
template <class Unit>
uint32_t concat(const Unit* in1, const Unit* in2, Unit* out, uint32_t capacity) {
  const int64_t limit = limitOf(capacity);
  const int64_t first = lengthUpTo(in1, limit), second = lengthUpTo(in2, limit - first);
  if (out != in1 && (overlaps(in1, first, out, capacity) || overlaps(in2, second, out, capacity))) {
    Result<Unit> result(out, capacity, true);
    result.append(in1, first);
    result.append(in2, second);
    return result.finish();
  }
  if (out != in1) memcpy(out, in1, static_cast<size_t>(first) * sizeof(Unit));
  memmove(out + first, in2, static_cast<size_t>(second) * sizeof(Unit));
  out[first + second] = 0;
  return static_cast<uint32_t>(first + second);
}

template <class Unit>
struct MeasuredString {
  const Unit* units;
  int64_t length;
};
template <class Unit>
MeasuredString<Unit> measured(const Unit* string) {
  return {string, lengthOf(string)};
}

// in1 with `count` characters from `position` (from 1, inside) replaced by in2.
template <class Unit>
uint32_t splice(MeasuredString<Unit> in1, MeasuredString<Unit> in2, int64_t count, int64_t position, Unit* out,
                uint32_t capacity) {
  const int64_t begin = position - 1, end = begin + clip(count, 0, in1.length - begin), limit = limitOf(capacity);
  if (out == in1.units && begin <= limit && !overlaps(in2.units, in2.length, out, capacity)) {
    const int64_t middle = clip(in2.length, 0, limit - begin);
    const int64_t rest = clip(in1.length - end, 0, limit - begin - middle);
    memmove(out + begin + middle, out + end, static_cast<size_t>(rest) * sizeof(Unit));
    memcpy(out + begin, in2.units, static_cast<size_t>(middle) * sizeof(Unit));
    out[begin + middle + rest] = 0;
    return static_cast<uint32_t>(begin + middle + rest);
  }
  Result<Unit> result(out, capacity,
                      overlaps(in1.units, in1.length, out, capacity) || overlaps(in2.units, in2.length, out, capacity));
  result.append(in1.units, begin);
  result.append(in2.units, in2.length);
  result.append(in1.units + end, in1.length - end);
  return result.finish();
}

template <class Unit>
uint32_t unchanged(MeasuredString<Unit> in, Unit* out, uint32_t capacity) {
  static const Unit nothing[1] = {0};
  return splice<Unit>(in, {nothing, 0}, 0, 1, out, capacity);
}

template <class Unit>
uint32_t insert(MeasuredString<Unit> in1, MeasuredString<Unit> in2, int64_t position, Unit* out, uint32_t capacity) {
  if (position < 0 || position > kLongest) return unchanged(in1, out, capacity);
  return splice(in1, in2, 0, clip(position, 0, in1.length) + 1, out, capacity);
}

template <class Unit>
uint32_t remove(MeasuredString<Unit> in, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  static const Unit nothing[1] = {0};
  if (position == 0) return remove(in, count - 1, 1, out, capacity);
  if (position < 0 || position > in.length) return unchanged(in, out, capacity);
  return splice<Unit>(in, {nothing, 0}, count, position, out, capacity);
}

template <class Unit>
uint32_t replace(MeasuredString<Unit> in1, MeasuredString<Unit> in2, int64_t count, int64_t position, Unit* out,
                 uint32_t capacity) {
  if (position == 0) return replace(in1, in2, count - 1, 1, out, capacity);
  if (position < 0 || position > in1.length + 1) return unchanged(in1, out, capacity);
  return splice(in1, in2, count, position, out, capacity);
}

int16_t asInt(int64_t value) { return static_cast<int16_t>(clip(value, 0, INT16_MAX)); }

template <class Unit>
int16_t find(const Unit* in1, const Unit* in2) {
  if (*in2 == 0) return 0;
  for (const Unit* at = in1; *at != 0; ++at) {
    int64_t i = 0;
    while (in2[i] != 0 && at[i] == in2[i]) ++i;
    if (in2[i] == 0) return asInt(at - in1 + 1);
  }
  return 0;
}
inline int16_t find(const char* in1, const char* in2) {
  return rung_string_find(in1, rung_string_length(in1), in2, rung_string_length(in2));
}

}  // namespace

extern "C" {

// NOLINTBEGIN(bugprone-macro-parentheses): Unit is a type
#define RUNG_STRING_FUNCTIONS(TYPE, Unit)                                                                        \
  int16_t rung_standard_LEN__##TYPE(rung_context*, const Unit* in) { return asInt(lengthOf(in)); }               \
  uint32_t rung_standard_LEFT__##TYPE(rung_context*, const Unit* in, int32_t l, Unit* out, uint32_t capacity) {  \
    return left(in, l, out, capacity);                                                                           \
  }                                                                                                              \
  uint32_t rung_standard_RIGHT__##TYPE(rung_context*, const Unit* in, int32_t l, Unit* out, uint32_t capacity) { \
    return right(in, l, out, capacity);                                                                          \
  }                                                                                                              \
  uint32_t rung_standard_MID__##TYPE(rung_context*, const Unit* in, int32_t l, int32_t p, Unit* out,             \
                                     uint32_t capacity) {                                                        \
    return mid(in, l, p, out, capacity);                                                                         \
  }                                                                                                              \
  uint32_t rung_standard_CONCAT__##TYPE(rung_context*, const Unit* in1, const Unit* in2, Unit* out,              \
                                        uint32_t capacity) {                                                     \
    return concat(in1, in2, out, capacity);                                                                      \
  }                                                                                                              \
  uint32_t rung_standard_INSERT__##TYPE(rung_context*, const Unit* in1, const Unit* in2, int32_t p, Unit* out,   \
                                        uint32_t capacity) {                                                     \
    return insert(measured(in1), measured(in2), p, out, capacity);                                               \
  }                                                                                                              \
  uint32_t rung_standard_DELETE__##TYPE(rung_context*, const Unit* in, int32_t l, int32_t p, Unit* out,          \
                                        uint32_t capacity) {                                                     \
    return remove(measured(in), l, p, out, capacity);                                                            \
  }                                                                                                              \
  uint32_t rung_standard_REPLACE__##TYPE(rung_context*, const Unit* in1, const Unit* in2, int32_t l, int32_t p,  \
                                         Unit* out, uint32_t capacity) {                                         \
    return replace(measured(in1), measured(in2), l, p, out, capacity);                                           \
  }                                                                                                              \
  int16_t rung_standard_FIND__##TYPE(rung_context*, const Unit* in1, const Unit* in2) { return find(in1, in2); }
// NOLINTEND(bugprone-macro-parentheses)
RUNG_STRING_FUNCTIONS(STRING_255, char)
RUNG_STRING_FUNCTIONS(WSTRING_255, char16_t)
#undef RUNG_STRING_FUNCTIONS

// ---- sized forms (rung/standard.h)

uint32_t rung_string_join(const char* in1, uint32_t length1, const char* in2, uint32_t length2, char* out,
                          uint32_t capacity) {
  const uint32_t limit = limitOf(capacity);
  if (length1 > limit) length1 = limit;
  if (length2 > limit - length1) length2 = limit - length1;
  memmove(out + length1, in2, length2);  // first: `out` may be in2
  if (out != in1) memcpy(out, in1, length1);
  out[length1 + length2] = 0;
  return length1 + length2;
}
uint32_t rung_standard_INSERT__STRING_255_sized(const char* in1, uint32_t length1, const char* in2, uint32_t length2,
                                                int32_t p, char* out, uint32_t capacity) {
  return insert<char>({in1, length1}, {in2, length2}, p, out, capacity);
}
uint32_t rung_string_delete(const char* in, uint32_t length, int32_t l, int32_t p, char* out, uint32_t capacity) {
  return remove<char>({in, length}, l, p, out, capacity);
}
uint32_t rung_standard_REPLACE__STRING_255_sized(const char* in1, uint32_t length1, const char* in2, uint32_t length2,
                                                 int32_t l, int32_t p, char* out, uint32_t capacity) {
  return replace<char>({in1, length1}, {in2, length2}, l, p, out, capacity);
}
uint32_t rung_string_search(const char* in, uint32_t length, char unit) {
  if (length > 8) {
    const void* at = memchr(in, unit, length);
    return at != nullptr ? static_cast<uint32_t>(static_cast<const char*>(at) - in) : length;
  }
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  if (length >= 4) {
    uint32_t first, last;
    memcpy(&first, in, 4);
    memcpy(&last, in + length - 4, 4);
    const uint64_t found = rung_string_units(first | static_cast<uint64_t>(last) << 8 * (length - 4), unit);
    const uint32_t at = found != 0 ? static_cast<uint32_t>(__builtin_ctzll(found)) / 8 : length;
    return at < length ? at : length;  // zeros follow the string
  }
#endif
  for (uint32_t i = 0; i < length; ++i) {
    if (in[i] == unit) return i;
  }
  return length;
}
int16_t rung_string_find(const char* in1, uint32_t length1, const char* in2, uint32_t length2) {
  if (length2 == 0 || length2 > length1) return 0;
  const char* const end = in1 + (length1 - length2) + 1;
  for (const char* at = in1; at < end; ++at) {
    at = static_cast<const char*>(memchr(at, *in2, static_cast<size_t>(end - at)));
    if (at == nullptr) return 0;
    if (memcmp(at, in2, length2) == 0) return asInt(at - in1 + 1);
  }
  return 0;
}

}  // extern "C"

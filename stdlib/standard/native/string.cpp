// Native bodies of string.st. Positions count from 1, by bytes of a STRING and 16-bit units of a WSTRING. A result has
// at most 255 characters and at most `capacity`; `out` may be one of the inputs. Lengths and positions outside a text
// are clipped, so nothing outside it is ever touched.
#include <cstring>

#include "rung/code.h"

namespace {

constexpr uint32_t kLongest = 255;

template <class Unit>
int64_t lengthOf(const Unit* text) {
  int64_t length = 0;
  while (text[length] != 0) ++length;
  return length;
}
inline int64_t lengthOf(const char* text) { return static_cast<int64_t>(strlen(text)); }

// As lengthOf, but looks no further than `most`.
template <class Unit>
int64_t lengthUpTo(const Unit* text, int64_t most) {
  int64_t length = 0;
  while (length < most && text[length] != 0) ++length;
  return length;
}
inline int64_t lengthUpTo(const char* text, int64_t most) {
  const void* end = most > 0 ? memchr(text, 0, static_cast<size_t>(most)) : nullptr;
  return end != nullptr ? static_cast<const char*>(end) - text : most > 0 ? most : 0;
}

int64_t clip(int64_t value, int64_t low, int64_t high) { return value < low ? low : value > high ? high : value; }

uint32_t limitOf(uint32_t capacity) { return capacity < kLongest ? capacity : kLongest; }

// `count` characters from `from`, which may lie in `out`.
template <class Unit>
void give(const Unit* from, int64_t count, Unit* out, uint32_t capacity) {
  const int64_t taken = clip(count, 0, limitOf(capacity));
  memmove(out, from, static_cast<size_t>(taken) * sizeof(Unit));
  out[taken] = 0;
}

// Whether the `length` characters of `text` lie in the memory that `out` writes.
template <class Unit>
bool overlaps(const Unit* text, int64_t length, const Unit* out, uint32_t capacity) {
  const uintptr_t at = reinterpret_cast<uintptr_t>(text), begin = reinterpret_cast<uintptr_t>(out);
  return at < begin + (uint64_t{capacity} + 1) * sizeof(Unit) &&
         begin <= at + static_cast<size_t>(length) * sizeof(Unit);
}

// Collects a result part by part: in `out` itself where no input lies there, else apart.
template <class Unit>
class Result {
 public:
  Result(Unit* out, uint32_t capacity, bool apart) : out_(out), to_(apart ? units_ : out), limit_(limitOf(capacity)) {}
  void append(const Unit* from, int64_t count) {
    const int64_t taken = clip(count, 0, limit_ - length_);
    memcpy(to_ + length_, from, static_cast<size_t>(taken) * sizeof(Unit));
    length_ += static_cast<uint32_t>(taken);
  }
  void finish() {
    if (to_ != out_) memcpy(out_, to_, length_ * sizeof(Unit));
    out_[length_] = 0;
  }

 private:
  Unit* out_;
  Unit* to_;
  uint32_t limit_, length_ = 0;
  Unit units_[kLongest];
};

template <class Unit>
void mid(const Unit* in, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  const int64_t begin = position - 1, end = begin + clip(count, 0, kLongest);
  const int64_t length = lengthUpTo(in, end);
  if (begin < 0 || begin >= length)
    out[0] = 0;
  else
    give(in + begin, length - begin, out, capacity);
}

template <class Unit>
void left(const Unit* in, int64_t count, Unit* out, uint32_t capacity) {
  give(in, lengthUpTo(in, clip(count, 0, kLongest)), out, capacity);
}

template <class Unit>
void right(const Unit* in, int64_t count, Unit* out, uint32_t capacity) {
  const int64_t length = lengthOf(in), taken = clip(count, 0, length);
  give(in + length - taken, taken, out, capacity);
}

// Appends in place where `out` is in1.
template <class Unit>
void concat(const Unit* in1, const Unit* in2, Unit* out, uint32_t capacity) {
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
}

// in1 with `count` characters from `position` (from 1, inside) replaced by in2.
template <class Unit>
void splice(const Unit* in1, const Unit* in2, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  const int64_t length = lengthOf(in1), begin = position - 1, end = begin + clip(count, 0, length - begin);
  const int64_t middle = lengthOf(in2);
  Result<Unit> result(out, capacity, overlaps(in1, length, out, capacity) || overlaps(in2, middle, out, capacity));
  result.append(in1, begin);
  result.append(in2, middle);
  result.append(in1 + end, length - end);
  result.finish();
}

template <class Unit>
void insert(const Unit* in1, const Unit* in2, int64_t position, Unit* out, uint32_t capacity) {
  splice(in1, in2, 0, clip(position, 0, lengthOf(in1)) + 1, out, capacity);
}

template <class Unit>
void remove(const Unit* in, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  static const Unit nothing[1] = {0};
  if (position < 1 || position > lengthOf(in)) return splice(in, nothing, 0, 1, out, capacity);
  splice(in, nothing, count, position, out, capacity);
}

template <class Unit>
void replace(const Unit* in1, const Unit* in2, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  static const Unit nothing[1] = {0};
  if (position < 1 || position > lengthOf(in1) + 1) return splice(in1, nothing, 0, 1, out, capacity);
  splice(in1, in2, count, position, out, capacity);
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

}  // namespace

extern "C" {

#define RUNG_STRING_FUNCTIONS(TYPE, Unit)                                                                              \
  int16_t rung_standard_LEN__##TYPE(rung_context*, const Unit* in) { return asInt(lengthOf(in)); }                     \
  void rung_standard_LEFT__##TYPE(rung_context*, const Unit* in, int32_t l, Unit* out, uint32_t capacity) {            \
    left(in, l, out, capacity);                                                                                        \
  }                                                                                                                    \
  void rung_standard_RIGHT__##TYPE(rung_context*, const Unit* in, int32_t l, Unit* out, uint32_t capacity) {           \
    right(in, l, out, capacity);                                                                                       \
  }                                                                                                                    \
  void rung_standard_MID__##TYPE(rung_context*, const Unit* in, int32_t l, int32_t p, Unit* out, uint32_t capacity) {  \
    mid(in, l, p, out, capacity);                                                                                      \
  }                                                                                                                    \
  void rung_standard_CONCAT__##TYPE(rung_context*, const Unit* in1, const Unit* in2, Unit* out, uint32_t capacity) {   \
    concat(in1, in2, out, capacity);                                                                                   \
  }                                                                                                                    \
  void rung_standard_INSERT__##TYPE(rung_context*, const Unit* in1, const Unit* in2, int32_t p, Unit* out,             \
                                    uint32_t capacity) {                                                               \
    insert(in1, in2, p, out, capacity);                                                                                \
  }                                                                                                                    \
  void rung_standard_DELETE__##TYPE(rung_context*, const Unit* in, int32_t l, int32_t p, Unit* out,                    \
                                    uint32_t capacity) {                                                               \
    remove(in, l, p, out, capacity);                                                                                   \
  }                                                                                                                    \
  void rung_standard_REPLACE__##TYPE(rung_context*, const Unit* in1, const Unit* in2, int32_t l, int32_t p, Unit* out, \
                                     uint32_t capacity) {                                                              \
    replace(in1, in2, l, p, out, capacity);                                                                            \
  }                                                                                                                    \
  int16_t rung_standard_FIND__##TYPE(rung_context*, const Unit* in1, const Unit* in2) { return find(in1, in2); }
RUNG_STRING_FUNCTIONS(STRING_255, char)
RUNG_STRING_FUNCTIONS(WSTRING_255, char16_t)
#undef RUNG_STRING_FUNCTIONS

}  // extern "C"

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

// Collects a result apart, since `out` may be an input.
template <class Unit>
class Result {
 public:
  void append(const Unit* from, int64_t count) {
    if (count <= 0) return;
    const uint32_t room = kLongest - length_;
    const uint32_t taken = count > room ? room : static_cast<uint32_t>(count);
    memcpy(units_ + length_, from, taken * sizeof(Unit));
    length_ += taken;
  }
  void finish(Unit* out, uint32_t capacity) {
    if (length_ > capacity) length_ = capacity;
    memcpy(out, units_, length_ * sizeof(Unit));
    out[length_] = 0;
  }

 private:
  uint32_t length_ = 0;
  Unit units_[kLongest];
};

int64_t clip(int64_t value, int64_t low, int64_t high) { return value < low ? low : value > high ? high : value; }

template <class Unit>
void mid(const Unit* in, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  const int64_t length = lengthOf(in);
  Result<Unit> result;
  if (position >= 1 && position <= length) result.append(in + position - 1, clip(count, 0, length - position + 1));
  result.finish(out, capacity);
}

template <class Unit>
void left(const Unit* in, int64_t count, Unit* out, uint32_t capacity) {
  Result<Unit> result;
  result.append(in, clip(count, 0, lengthOf(in)));
  result.finish(out, capacity);
}

template <class Unit>
void right(const Unit* in, int64_t count, Unit* out, uint32_t capacity) {
  const int64_t length = lengthOf(in), taken = clip(count, 0, length);
  Result<Unit> result;
  result.append(in + length - taken, taken);
  result.finish(out, capacity);
}

template <class Unit>
void concat(const Unit* in1, const Unit* in2, Unit* out, uint32_t capacity) {
  Result<Unit> result;
  result.append(in1, lengthOf(in1));
  result.append(in2, lengthOf(in2));
  result.finish(out, capacity);
}

// in1 with `count` characters from `position` (from 1, inside) replaced by in2.
template <class Unit>
void splice(const Unit* in1, const Unit* in2, int64_t count, int64_t position, Unit* out, uint32_t capacity) {
  const int64_t length = lengthOf(in1), begin = position - 1, end = begin + clip(count, 0, length - begin);
  Result<Unit> result;
  result.append(in1, begin);
  result.append(in2, lengthOf(in2));
  result.append(in1 + end, length - end);
  result.finish(out, capacity);
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

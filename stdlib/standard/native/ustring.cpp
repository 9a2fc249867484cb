// SPDX-License-Identifier: Apache-2.0
// The functions of string.st for USTRING, whose positions and lengths count characters: converted to bytes, passed to
// the function of STRING, and a character cut in its middle is dropped. Also LEN_CODE_UNIT, and strings as bytes.
#include <string.h>

#include "rung/code.h"

extern "C" {

uint32_t rung_standard_LEFT__STRING_255(rung_context*, const char*, int32_t, char*, uint32_t);
uint32_t rung_standard_MID__STRING_255(rung_context*, const char*, int32_t, int32_t, char*, uint32_t);
uint32_t rung_standard_CONCAT__STRING_255(rung_context*, const char*, const char*, char*, uint32_t);
uint32_t rung_standard_INSERT__STRING_255(rung_context*, const char*, const char*, int32_t, char*, uint32_t);
uint32_t rung_standard_DELETE__STRING_255(rung_context*, const char*, int32_t, int32_t, char*, uint32_t);
uint32_t rung_standard_REPLACE__STRING_255(rung_context*, const char*, const char*, int32_t, int32_t, char*, uint32_t);
int16_t rung_standard_FIND__STRING_255(rung_context*, const char*, const char*);

}  // extern "C"

namespace {

// `count` characters from `position`, in bytes.
struct Bytes {
  int32_t position, count;
};
Bytes bytesOf(const char* string, int32_t position, int32_t count) {
  const int64_t begin = rung_ustring_offset(string, static_cast<int64_t>(position) - 1);
  const int64_t length = rung_string_length(string);
  const int64_t bytes = begin < 0 || begin >= length || count < 0 ? count : rung_ustring_offset(string + begin, count);
  const int64_t most = INT32_MAX;
  return {static_cast<int32_t>(begin < most ? begin + 1 : most), static_cast<int32_t>(bytes < most ? bytes : most)};
}

template <class Unit>
uint32_t unitsOf(const Unit* string) {
  uint32_t count = 0;
  while (string[count] != 0) ++count;
  return count;
}

// The rest of the array is 0.
void fill(const void* from, uint64_t length, void* to, uint64_t size) {
  const uint64_t taken = length < size ? length : size;
  memcpy(to, from, taken);
  memset(static_cast<char*>(to) + taken, 0, size - taken);
}

}  // namespace

extern "C" {

int16_t rung_standard_LEN__USTRING_255(rung_context*, const char* in) {
  const uint32_t length = rung_ustring_length(in);
  return static_cast<int16_t>(length < INT16_MAX ? length : INT16_MAX);
}
uint32_t rung_standard_LEFT__USTRING_255(rung_context* ctx, const char* in, int32_t l, char* out, uint32_t capacity) {
  return rung_ustring_whole(out, rung_standard_LEFT__STRING_255(ctx, in, bytesOf(in, 1, l).count, out, capacity));
}
uint32_t rung_standard_RIGHT__USTRING_255(rung_context* ctx, const char* in, int32_t l, char* out, uint32_t capacity) {
  const int64_t length = rung_ustring_length(in), taken = l < 0 ? 0 : l < length ? l : length;
  const Bytes part = bytesOf(in, static_cast<int32_t>(length - taken + 1), static_cast<int32_t>(taken));
  return rung_ustring_whole(out, rung_standard_MID__STRING_255(ctx, in, part.count, part.position, out, capacity));
}
uint32_t rung_standard_MID__USTRING_255(rung_context* ctx, const char* in, int32_t l, int32_t p, char* out,
                                        uint32_t capacity) {
  const Bytes part = bytesOf(in, p, l);
  return rung_ustring_whole(out, rung_standard_MID__STRING_255(ctx, in, part.count, part.position, out, capacity));
}
uint32_t rung_standard_CONCAT__USTRING_255(rung_context* ctx, const char* in1, const char* in2, char* out,
                                           uint32_t capacity) {
  return rung_ustring_whole(out, rung_standard_CONCAT__STRING_255(ctx, in1, in2, out, capacity));
}
uint32_t rung_standard_INSERT__USTRING_255(rung_context* ctx, const char* in1, const char* in2, int32_t p, char* out,
                                           uint32_t capacity) {
  const auto length = static_cast<int32_t>(strlen(in1));
  int32_t at = bytesOf(in1, 1, p).count;
  if (at > length && p <= 255) at = length;
  return rung_ustring_whole(out, rung_standard_INSERT__STRING_255(ctx, in1, in2, at, out, capacity));
}
uint32_t rung_standard_DELETE__USTRING_255(rung_context* ctx, const char* in, int32_t l, int32_t p, char* out,
                                           uint32_t capacity) {
  if (p == 0) return rung_standard_DELETE__USTRING_255(ctx, in, l < 1 ? 0 : l - 1, 1, out, capacity);
  const Bytes part = bytesOf(in, p, l);
  return rung_ustring_whole(out, rung_standard_DELETE__STRING_255(ctx, in, part.count, part.position, out, capacity));
}
uint32_t rung_standard_REPLACE__USTRING_255(rung_context* ctx, const char* in1, const char* in2, int32_t l, int32_t p,
                                            char* out, uint32_t capacity) {
  if (p == 0) return rung_standard_REPLACE__USTRING_255(ctx, in1, in2, l < 1 ? 0 : l - 1, 1, out, capacity);
  const Bytes part = bytesOf(in1, p, l);
  return rung_ustring_whole(out,
                            rung_standard_REPLACE__STRING_255(ctx, in1, in2, part.count, part.position, out, capacity));
}
int16_t rung_standard_FIND__USTRING_255(rung_context* ctx, const char* in1, const char* in2) {
  const int16_t at = rung_standard_FIND__STRING_255(ctx, in1, in2);
  int16_t before = 0;  // characters that begin before it
  for (int16_t i = 1; i < at; ++i) before = static_cast<int16_t>(before + ((in1[i - 1] & 0xc0) != 0x80));
  return at == 0 ? int16_t{0} : static_cast<int16_t>(before + 1);
}

int32_t rung_standard_LEN_CODE_UNIT__STRING_255(rung_context*, const char* in) {
  return static_cast<int32_t>(unitsOf(in));
}
int32_t rung_standard_LEN_CODE_UNIT__WSTRING_255(rung_context*, const char16_t* in) {
  return static_cast<int32_t>(unitsOf(in));
}
int32_t rung_standard_LEN_CODE_UNIT__USTRING_255(rung_context*, const char* in) {
  return static_cast<int32_t>(unitsOf(in));
}

// ---- strings as bytes: the memory of the string, for a WSTRING the low byte first
uint8_t rung_standard_BYTES_OF_STRING(rung_context*, const char* in, void* out, uint64_t size) {
  fill(in, unitsOf(in), out, size);
  return 1;
}
uint8_t rung_standard_BYTES_OF_USTRING(rung_context*, const char* in, void* out, uint64_t size) {
  fill(in, unitsOf(in), out, size);
  return 1;
}
uint8_t rung_standard_BYTES_OF_WSTRING(rung_context*, const char16_t* in, void* out, uint64_t size) {
  fill(in, uint64_t{unitsOf(in)} * 2, out, size);
  return 1;
}
uint32_t rung_standard_STRING_OF_BYTES(rung_context*, void* in, uint64_t size, char* out, uint32_t capacity) {
  const size_t most = size < capacity ? static_cast<size_t>(size) : capacity;
  const void* const end = memchr(in, 0, most);
  const size_t length =
      end == nullptr ? most : static_cast<size_t>(static_cast<const char*>(end) - static_cast<const char*>(in));
  memcpy(out, in, length);
  out[length] = 0;
  return static_cast<uint32_t>(length);
}
uint32_t rung_standard_WSTRING_OF_BYTES(rung_context*, void* in, uint64_t size, char16_t* out, uint32_t capacity) {
  uint32_t length = 0;
  for (; length < capacity && uint64_t{length} * 2 + 1 < size; ++length) {
    memcpy(&out[length], static_cast<const char*>(in) + uint64_t{length} * 2, 2);
    if (out[length] == 0) break;
  }
  out[length] = 0;
  return length;
}
uint32_t rung_standard_USTRING_OF_BYTES(rung_context* ctx, void* in, uint64_t size, char* out, uint32_t capacity) {
  uint32_t length = rung_standard_STRING_OF_BYTES(ctx, in, size, out, capacity);
  if (length == capacity && length < size) length = rung_ustring_whole(out, length);
  return rung_ustring_of_string(out, length, out);
}

}  // extern "C"

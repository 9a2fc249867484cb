// SPDX-License-Identifier: Apache-2.0
// Native bodies of conversion.st: values to and from strings, BCD, byte order.
#include <string.h>

#include "integers.h"
#include "rung/code.h"
#include "rung/values.h"

namespace {

template <class T>
uint64_t bitsOf(T value) {
  return static_cast<uint64_t>(static_cast<int64_t>(value));  // sign-extended when T is signed
}
uint64_t bitsOf(uint64_t value) { return value; }
uint64_t bitsOf(float value) { return rung_bits_of_f64(static_cast<double>(value)); }
uint64_t bitsOf(double value) { return rung_bits_of_f64(value); }

template <class T>
struct Read {
  static T from(uint64_t bits) { return static_cast<T>(bits); }
};
template <>
struct Read<float> {
  static float from(uint64_t bits) { return static_cast<float>(rung_f64_of(bits)); }
};
template <>
struct Read<double> {
  static double from(uint64_t bits) { return rung_f64_of(bits); }
};

template <class T>
uint32_t stringOfInteger(T value, char* out, uint32_t capacity) {
  const uint64_t bits = bitsOf(value);
  const bool negative = static_cast<T>(-1) < static_cast<T>(0) && static_cast<int64_t>(bits) < 0;
  return rung_string_of_integer(out, capacity, negative, negative ? 0 - bits : bits);
}

// True when the dialect of the module gives TIME or LTIME a sign: the C type is unsigned in any dialect. `unknown`: the
// answer when the module does not have the type.
bool isSigned(const rung_context* ctx, rung_type_kind kind, bool unknown) {
  if (ctx->module == nullptr) return unknown;
  for (uint32_t i = 0; i < ctx->module->types.count; ++i) {
    const rung_type& type = *rung_type_at(ctx->module, i);
    if (type.kind == kind) return type.is_signed != 0;
  }
  return unknown;
}

const char* longTimeString(const rung_context* ctx, int64_t value, char (&text)[64]) {
  rung_format(RUNG_LTIME, isSigned(ctx, RUNG_LTIME, true), &value, text, sizeof text - 1);
  return text;
}
uint64_t timeBits(const rung_context* ctx, uint32_t value) {
  return isSigned(ctx, RUNG_TIME, false) ? bitsOf(static_cast<int32_t>(value)) : value;
}

uint64_t fromBcd(uint64_t bcd) {
  uint64_t value = 0;
  for (int shift = 60; shift >= 0; shift -= 4) value = value * 10 + (bcd >> shift & 15);
  return value;
}
// The low `digits` decimal digits of the value as BCD.
uint64_t toBcd(uint64_t value, int digits) {
  uint64_t bcd = 0;
  for (int i = 0; i < digits; ++i, value /= 10) bcd |= value % 10 << (4 * i);
  return bcd;
}
// Formats a scalar; CHAR, WCHAR and UCHAR values are code points.
uint32_t stringOfUnicode(rung_type_kind kind, uint64_t bits, char* out, uint32_t capacity) {
  if (kind >= RUNG_CHAR && kind <= RUNG_UCHAR) return rung_ustring_of_code(out, capacity, static_cast<uint32_t>(bits));
  return rung_string_of_scalar(out, capacity, kind, bits);
}

// '?' for an invalid code point, or one that does not fit a CHAR or WCHAR.
uint32_t codeOf(uint64_t number) {
  return number < 0x110000 && (number < 0xd800 || number >= 0xe000) ? static_cast<uint32_t>(number) : uint32_t{'?'};
}
uint8_t charOf(uint32_t code) { return static_cast<uint8_t>(code < 0x100 ? code : '?'); }
uint16_t wcharOf(uint32_t code) { return static_cast<uint16_t>(code < 0x10000 ? code : '?'); }
uint32_t firstOf(const char16_t* text) {
  char utf8[5];
  const char16_t first[3] = {text[0], text[0] != 0 ? text[1] : char16_t{0}, 0};
  rung_string_of_wstring(utf8, 4, first);
  return rung_ustring_code(utf8);
}

// The bytes of a number in reverse order.
float swapped(float value) { return rung_f32_of(__builtin_bswap32(rung_bits_of_f32(value))); }
double swapped(double value) { return rung_f64_of(__builtin_bswap64(rung_bits_of_f64(value))); }
template <class T>
T swapped(T value) {
  if constexpr (sizeof(T) == 2) return static_cast<T>(__builtin_bswap16(static_cast<uint16_t>(value)));
  if constexpr (sizeof(T) == 4) return static_cast<T>(__builtin_bswap32(static_cast<uint32_t>(value)));
  if constexpr (sizeof(T) == 8) return static_cast<T>(__builtin_bswap64(static_cast<uint64_t>(value)));
  return value;
}

// rung_scalar_of_string for integers, without a call for a string of digits only.
uint64_t integerOf(rung_type_kind kind, const char* in) {
  const bool is_negative = *in == '-';
  const char* const first = in + is_negative;
  const char* at = first;
  uint64_t value = 0;
  while (*at >= '0' && *at <= '9') value = value * 10 + static_cast<uint64_t>(*at++ - '0');
  if (*at != 0 || at == first) return rung_scalar_of_string(kind, in);
  return is_negative ? 0 - value : value;
}

uint8_t isBcd(uint64_t bcd) {
  for (; bcd != 0; bcd >>= 4)
    if ((bcd & 15) > 9) return 0;
  return 1;
}

}  // namespace

// ROW(NAME, type) for the durations, dates and times.
#define RUNG_EACH_TIME(ROW)    \
  ROW(TIME, uint32_t)          \
  ROW(LTIME, int64_t)          \
  ROW(DATE, uint32_t)          \
  ROW(LDATE, uint64_t)         \
  ROW(TIME_OF_DAY, uint32_t)   \
  ROW(LTIME_OF_DAY, uint64_t)  \
  ROW(DATE_AND_TIME, uint32_t) \
  ROW(LDATE_AND_TIME, uint64_t)

extern "C" {

// ---- strings. TYPE: the name of the type in the language; KIND: that of rung_type_kind.
#define RUNG_STRING_OF(TYPE, KIND, T, bits)                                                         \
  uint32_t rung_standard_TO_STRING__##TYPE(rung_context* ctx, T in, char* out, uint32_t capacity) { \
    (void)ctx;                                                                                      \
    return rung_string_of_scalar(out, capacity, RUNG_##KIND, bits);                                 \
  }                                                                                                 \
  RUNG_WTEXT_OF(TYPE, KIND, T, bits)
#define RUNG_WTEXT_OF(TYPE, KIND, T, bits)                                                               \
  uint32_t rung_standard_TO_WSTRING__##TYPE(rung_context* ctx, T in, char16_t* out, uint32_t capacity) { \
    (void)ctx;                                                                                           \
    return rung_wstring_of_scalar(out, capacity, RUNG_##KIND, bits);                                     \
  }                                                                                                      \
  uint32_t rung_standard_TO_USTRING__##TYPE(rung_context* ctx, T in, char* out, uint32_t capacity) {     \
    (void)ctx;                                                                                           \
    return stringOfUnicode(RUNG_##KIND, bits, out, capacity);                                            \
  }
#define RUNG_OF_STRING(TYPE, KIND, T) RUNG_OF_STRING_BY(TYPE, KIND, T, rung_scalar_of_string)
#define RUNG_OF_STRING_BY(TYPE, KIND, T, function)                                                                     \
  T rung_standard_STRING_TO_##TYPE(rung_context*, const char* in) { return Read<T>::from(function(RUNG_##KIND, in)); } \
  T rung_standard_USTRING_TO_##TYPE(rung_context*, const char* in) {                                                   \
    return Read<T>::from(function(RUNG_##KIND, in));                                                                   \
  }                                                                                                                    \
  T rung_standard_WSTRING_TO_##TYPE(rung_context*, const char16_t* in) {                                               \
    return Read<T>::from(rung_scalar_of_wstring(RUNG_##KIND, in));                                                     \
  }
#define RUNG_STRING_BOTH(TYPE, KIND, T)     \
  RUNG_STRING_OF(TYPE, KIND, T, bitsOf(in)) \
  RUNG_OF_STRING(TYPE, KIND, T)
#define RUNG_INTEGER_BOTH(TYPE, T)                                                              \
  uint32_t rung_standard_TO_STRING__##TYPE(rung_context*, T in, char* out, uint32_t capacity) { \
    return stringOfInteger(in, out, capacity);                                                  \
  }                                                                                             \
  RUNG_WTEXT_OF(TYPE, TYPE, T, bitsOf(in))                                                      \
  RUNG_OF_STRING_BY(TYPE, TYPE, T, integerOf)
RUNG_STRING_BOTH(BOOL, BOOL, uint8_t)
RUNG_EACH_INTEGER(RUNG_INTEGER_BOTH)
RUNG_STRING_BOTH(REAL, REAL, float)
RUNG_STRING_BOTH(LREAL, LREAL, double)
RUNG_STRING_OF(TIME, TIME, uint32_t, timeBits(ctx, in))
RUNG_OF_STRING(TIME, TIME, uint32_t)
RUNG_OF_STRING(LTIME, LTIME, int64_t)
uint32_t rung_standard_TO_STRING__LTIME(rung_context* ctx, int64_t in, char* out, uint32_t capacity) {
  char text[64];
  return rung_string_assign(out, capacity, longTimeString(ctx, in, text));
}
uint32_t rung_standard_TO_USTRING__LTIME(rung_context* ctx, int64_t in, char* out, uint32_t capacity) {
  char text[64];
  return rung_string_assign(out, capacity, longTimeString(ctx, in, text));
}
uint32_t rung_standard_TO_WSTRING__LTIME(rung_context* ctx, int64_t in, char16_t* out, uint32_t capacity) {
  char text[64];
  return rung_wstring_of_string(out, capacity, longTimeString(ctx, in, text));
}
RUNG_STRING_BOTH(DATE, DATE, uint32_t)
RUNG_STRING_BOTH(LDATE, LDATE, uint64_t)
RUNG_STRING_BOTH(TIME_OF_DAY, TOD, uint32_t)
RUNG_STRING_BOTH(LTIME_OF_DAY, LTOD, uint64_t)
RUNG_STRING_BOTH(DATE_AND_TIME, DT, uint32_t)
RUNG_STRING_BOTH(LDATE_AND_TIME, LDT, uint64_t)
RUNG_STRING_OF(CHAR, CHAR, uint8_t, bitsOf(in))
RUNG_STRING_OF(WCHAR, WCHAR, uint16_t, bitsOf(in))
RUNG_STRING_OF(UCHAR, UCHAR, uint32_t, bitsOf(in))
#undef RUNG_INTEGER_BOTH
#undef RUNG_STRING_BOTH
#undef RUNG_WTEXT_OF
#undef RUNG_STRING_OF
#undef RUNG_OF_STRING_BY
#undef RUNG_OF_STRING

#define RUNG_TEXT_OF(TO, TO_CHAR, TYPE, FROM_CHAR, function)                                       \
  uint32_t rung_standard_TO_##TO##__##TYPE##_255(rung_context*, const FROM_CHAR* in, TO_CHAR* out, \
                                                 uint32_t capacity) {                              \
    return function(out, capacity, in);                                                            \
  }
RUNG_TEXT_OF(STRING, char, STRING, char, rung_string_assign)
RUNG_TEXT_OF(STRING, char, WSTRING, char16_t, rung_string_of_wstring)
RUNG_TEXT_OF(STRING, char, USTRING, char, rung_ustring_assign)
RUNG_TEXT_OF(USTRING, char, STRING, char, rung_ustring_of_string)
RUNG_TEXT_OF(USTRING, char, WSTRING, char16_t, rung_string_of_wstring)
RUNG_TEXT_OF(USTRING, char, USTRING, char, rung_ustring_assign)
RUNG_TEXT_OF(WSTRING, char16_t, USTRING, char, rung_wstring_of_string)
RUNG_TEXT_OF(WSTRING, char16_t, STRING, char, rung_wstring_of_string)
RUNG_TEXT_OF(WSTRING, char16_t, WSTRING, char16_t, rung_wstring_assign)
#undef RUNG_TEXT_OF

// ---- binary transfer
float rung_standard_DWORD_TO_REAL(rung_context*, uint32_t in) { return rung_f32_of(in); }
uint32_t rung_standard_REAL_TO_DWORD(rung_context*, float in) { return rung_bits_of_f32(in); }
double rung_standard_LWORD_TO_LREAL(rung_context*, uint64_t in) { return rung_f64_of(in); }
uint64_t rung_standard_LREAL_TO_LWORD(rung_context*, double in) { return rung_bits_of_f64(in); }

// ---- single characters
#define RUNG_CHAR_OF(TYPE, T)                                                                        \
  uint8_t rung_standard_TO_CHAR__##TYPE(rung_context*, T in) { return static_cast<uint8_t>(in); }    \
  uint16_t rung_standard_TO_WCHAR__##TYPE(rung_context*, T in) { return static_cast<uint16_t>(in); } \
  uint32_t rung_standard_TO_UCHAR__##TYPE(rung_context*, T in) { return codeOf(static_cast<uint64_t>(in)); }
#define RUNG_CODE_OF(TYPE, T)                                                                \
  T rung_standard_CHAR_TO_##TYPE(rung_context*, uint8_t in) { return static_cast<T>(in); }   \
  T rung_standard_WCHAR_TO_##TYPE(rung_context*, uint16_t in) { return static_cast<T>(in); } \
  T rung_standard_UCHAR_TO_##TYPE(rung_context*, uint32_t in) { return static_cast<T>(in); }
#define RUNG_CHAR_BOTH(TYPE, T) \
  RUNG_CHAR_OF(TYPE, T)         \
  RUNG_CODE_OF(TYPE, T)
RUNG_EACH_INTEGER(RUNG_CHAR_BOTH)
RUNG_CHAR_OF(BOOL, uint8_t)
RUNG_EACH_TIME(RUNG_CHAR_OF)
RUNG_CHAR_OF(CHAR, uint8_t)
RUNG_CHAR_OF(WCHAR, uint16_t)
#undef RUNG_CHAR_BOTH
#undef RUNG_CHAR_OF
#undef RUNG_CODE_OF
uint8_t rung_standard_TO_CHAR__REAL(rung_context*, float in) { return static_cast<uint8_t>(rung_round_i32(in)); }
uint8_t rung_standard_TO_CHAR__LREAL(rung_context*, double in) { return static_cast<uint8_t>(rung_round_i32(in)); }
uint16_t rung_standard_TO_WCHAR__REAL(rung_context*, float in) { return static_cast<uint16_t>(rung_round_i32(in)); }
uint16_t rung_standard_TO_WCHAR__LREAL(rung_context*, double in) { return static_cast<uint16_t>(rung_round_i32(in)); }
uint32_t rung_standard_TO_UCHAR__REAL(rung_context*, float in) {
  return codeOf(static_cast<uint32_t>(rung_round_i32(in)));
}
uint32_t rung_standard_TO_UCHAR__LREAL(rung_context*, double in) {
  return codeOf(static_cast<uint32_t>(rung_round_i32(in)));
}
uint32_t rung_standard_TO_UCHAR__UCHAR(rung_context*, uint32_t in) { return in; }
uint8_t rung_standard_TO_CHAR__UCHAR(rung_context*, uint32_t in) { return charOf(in); }
uint16_t rung_standard_TO_WCHAR__UCHAR(rung_context*, uint32_t in) { return wcharOf(in); }
uint32_t rung_standard_TO_UCHAR__STRING_255(rung_context*, const char* in) { return rung_ustring_code(in); }
uint32_t rung_standard_TO_UCHAR__WSTRING_255(rung_context*, const char16_t* in) { return firstOf(in); }
uint32_t rung_standard_TO_UCHAR__USTRING_255(rung_context*, const char* in) { return rung_ustring_code(in); }
uint8_t rung_standard_TO_CHAR__USTRING_255(rung_context*, const char* in) { return charOf(rung_ustring_code(in)); }
uint16_t rung_standard_TO_WCHAR__USTRING_255(rung_context*, const char* in) { return wcharOf(rung_ustring_code(in)); }
uint8_t rung_standard_TO_CHAR__STRING_255(rung_context*, const char* in) { return static_cast<uint8_t>(*in); }
uint8_t rung_standard_TO_CHAR__WSTRING_255(rung_context*, const char16_t* in) { return static_cast<uint8_t>(*in); }
uint16_t rung_standard_TO_WCHAR__STRING_255(rung_context*, const char* in) {
  char16_t one[2];
  rung_wstring_of_string(one, 1, in);
  return one[0];
}
uint16_t rung_standard_TO_WCHAR__WSTRING_255(rung_context*, const char16_t* in) { return *in; }

// ---- BCD
#define RUNG_BCD(BITS, B, digits, UNSIGNED, U)                                                                  \
  B rung_standard_##UNSIGNED##_TO_BCD_##BITS(rung_context*, U in) { return static_cast<B>(toBcd(in, digits)); } \
  U rung_standard_##BITS##_BCD_TO_##UNSIGNED(rung_context*, B in) { return static_cast<U>(fromBcd(in)); }
#define RUNG_BCD_OF(UNSIGNED, U)             \
  RUNG_BCD(BYTE, uint8_t, 2, UNSIGNED, U)    \
  RUNG_BCD(WORD, uint16_t, 4, UNSIGNED, U)   \
  RUNG_BCD(DWORD, uint32_t, 8, UNSIGNED, U)  \
  RUNG_BCD(LWORD, uint64_t, 16, UNSIGNED, U) \
  U rung_standard_BCD_TO_##UNSIGNED(rung_context*, uint64_t in) { return static_cast<U>(fromBcd(in)); }
RUNG_BCD_OF(USINT, uint8_t)
RUNG_BCD_OF(UINT, uint16_t)
RUNG_BCD_OF(UDINT, uint32_t)
RUNG_BCD_OF(ULINT, uint64_t)
#undef RUNG_BCD_OF
#undef RUNG_BCD
uint8_t rung_standard_TO_BCD_BYTE(rung_context*, uint64_t in) { return static_cast<uint8_t>(toBcd(in, 2)); }
uint16_t rung_standard_TO_BCD_WORD(rung_context*, uint64_t in) { return static_cast<uint16_t>(toBcd(in, 4)); }
uint32_t rung_standard_TO_BCD_DWORD(rung_context*, uint64_t in) { return static_cast<uint32_t>(toBcd(in, 8)); }
uint64_t rung_standard_TO_BCD_LWORD(rung_context*, uint64_t in) { return toBcd(in, 16); }

uint8_t rung_standard_IS_VALID_BCD(rung_context*, uint64_t in) { return isBcd(in); }

// ---- byte order: memory of the running program is little-endian, so only the big forms swap.
#define RUNG_BYTE_ORDER(TYPE, T)                                                       \
  T rung_standard_TO_BIG_ENDIAN__##TYPE(rung_context*, T in) { return swapped(in); }   \
  T rung_standard_FROM_BIG_ENDIAN__##TYPE(rung_context*, T in) { return swapped(in); } \
  T rung_standard_TO_LITTLE_ENDIAN__##TYPE(rung_context*, T in) { return in; }         \
  T rung_standard_FROM_LITTLE_ENDIAN__##TYPE(rung_context*, T in) { return in; }
RUNG_BYTE_ORDER(BOOL, uint8_t)
RUNG_EACH_INTEGER(RUNG_BYTE_ORDER)
RUNG_EACH_TIME(RUNG_BYTE_ORDER)
RUNG_BYTE_ORDER(CHAR, uint8_t)
RUNG_BYTE_ORDER(WCHAR, uint16_t)
RUNG_BYTE_ORDER(UCHAR, uint32_t)
RUNG_BYTE_ORDER(REAL, float)
RUNG_BYTE_ORDER(LREAL, double)
#undef RUNG_BYTE_ORDER

#define RUNG_STRING_ORDER(NAME)                                                                                       \
  uint32_t rung_standard_##NAME##__STRING_255(rung_context*, const char* in, char* out, uint32_t capacity) {          \
    return rung_string_assign(out, capacity, in);                                                                     \
  }                                                                                                                   \
  uint32_t rung_standard_##NAME##__USTRING_255(rung_context*, const char* in, char* out, uint32_t capacity) {         \
    return rung_ustring_assign(out, capacity, in);                                                                    \
  }                                                                                                                   \
  uint32_t rung_standard_##NAME##__WSTRING_255(rung_context*, const char16_t* in, char16_t* out, uint32_t capacity) { \
    return rung_wstring_assign(out, capacity, in);                                                                    \
  }
RUNG_STRING_ORDER(TO_BIG_ENDIAN)
RUNG_STRING_ORDER(TO_LITTLE_ENDIAN)
RUNG_STRING_ORDER(FROM_BIG_ENDIAN)
RUNG_STRING_ORDER(FROM_LITTLE_ENDIAN)
#undef RUNG_STRING_ORDER

}  // extern "C"

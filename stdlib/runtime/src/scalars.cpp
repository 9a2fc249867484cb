// SPDX-License-Identifier: Apache-2.0
// TO_STRING and its inverse (rung/code.h): a scalar in a string, and the scalar that a string begins with. In: the kind
// of the scalar and its bits. strings.cpp and values.cpp do the work and know nothing of this file.
#include <string.h>

#include "rung/code.h"
#include "rung/reals.h"
#include "rung/values.h"
#include "text.h"

namespace {

// Room for a scalar formatted by TO_STRING; enough for every elementary type.
constexpr uint32_t kScalarRoom = RUNG_FORMATTED_SCALAR;

bool isSignedInteger(uint8_t kind) {
  return kind == RUNG_SINT || kind == RUNG_INT || kind == RUNG_DINT || kind == RUNG_LINT;
}
bool isUnsignedInteger(uint8_t kind) {
  return kind == RUNG_BYTE || kind == RUNG_WORD || kind == RUNG_DWORD || kind == RUNG_LWORD || kind == RUNG_USINT ||
         kind == RUNG_UINT || kind == RUNG_UDINT || kind == RUNG_ULINT;
}

uint32_t formatScalar(uint8_t kind, uint64_t bits, char* out) {
  if (kind == RUNG_CHAR) {
    out[0] = static_cast<char>(bits);
    out[1] = 0;
    return 1;
  }
  if (kind == RUNG_REAL) {
    const float value = static_cast<float>(rung_f64_of(bits));
    return rung_format(kind, false, &value, out, kScalarRoom);
  }
  // `bits` is sign-extended when the type is signed, so the sign of 64 bits is the sign of the value.
  return rung_format(kind, static_cast<int64_t>(bits) < 0, &bits, out, kScalarRoom);
}

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Sign, `16#`, `8#`, `2#`, digits; stops at the first other character.
uint64_t readLeadingInteger(const char* string) {
  bool negative = false;
  if (*string == '-' || *string == '+') negative = *string++ == '-';
  uint32_t base = 10;
  if (strncmp(string, "16#", 3) == 0)
    base = 16, string += 3;
  else if (strncmp(string, "8#", 2) == 0)
    base = 8, string += 2;
  else if (strncmp(string, "2#", 2) == 0)
    base = 2, string += 2;
  uint64_t value = 0;
  for (;; ++string) {
    const uint32_t digit = rung_digit(*string);
    if (digit >= base) break;
    value = value * base + digit;
  }
  return negative ? 0 - value : value;
}

// `word` is in lower case.
bool beginsWith(const char* string, const char* word) {
  for (; *word != 0; ++string, ++word)
    if (rung_lower(*string) != *word) return false;
  return true;
}

// 0 when there is no number, infinity when it is too large.
double readLeadingReal(const char* string, bool is_single) {
  const bool negative = *string == '-';
  if (*string == '-' || *string == '+') ++string;
  double value = 0;
  size_t size = strlen(string);
  if (rung_real_parse(string, &size, is_single, &value) == RUNG_REAL_NONE) {
    if (beginsWith(string, "inf")) value = __builtin_inf();
    if (beginsWith(string, "nan")) value = __builtin_nan("");
  }
  return negative ? -value : value;
}

}  // namespace

uint32_t rung_string_of_scalar(char* to, uint32_t capacity, uint8_t kind, uint64_t bits) {
  if (kind == RUNG_UCHAR) return rung_ustring_of_code(to, capacity, static_cast<uint32_t>(bits));
  if (kind == RUNG_WCHAR) {
    const char16_t one[2] = {static_cast<char16_t>(bits), 0};
    return rung_string_of_wstring(to, capacity, one);
  }
  if (isUnsignedInteger(kind)) return rung_string_of_integer(to, capacity, false, bits);
  if (isSignedInteger(kind)) {
    const bool negative = static_cast<int64_t>(bits) < 0;
    return rung_string_of_integer(to, capacity, negative, negative ? 0 - bits : bits);
  }
  char string[kScalarRoom + 1];
  formatScalar(kind, bits, string);
  return rung_string_assign(to, capacity, string);
}

uint32_t rung_wstring_of_scalar(char16_t* to, uint32_t capacity, uint8_t kind, uint64_t bits) {
  if (kind == RUNG_WCHAR) {
    const char16_t one[2] = {static_cast<char16_t>(bits), 0};
    return rung_wstring_assign(to, capacity, one);
  }
  char string[kScalarRoom + 1];
  if (kind == RUNG_UCHAR)
    rung_ustring_of_code(string, kScalarRoom, static_cast<uint32_t>(bits));
  else
    formatScalar(kind, bits, string);
  return rung_wstring_of_string(to, capacity, string);
}

uint64_t rung_scalar_of_string(uint8_t kind, const char* string) {
  if (kind == RUNG_UCHAR) return rung_ustring_code(string);
  if (kind == RUNG_CHAR || kind == RUNG_WCHAR) {
    char16_t one[2];
    if (kind == RUNG_CHAR) return static_cast<unsigned char>(*string);
    rung_wstring_of_string(one, 1, string);
    return one[0];
  }
  while (isBlank(*string)) ++string;
  size_t size = strlen(string);
  while (size > 0 && isBlank(string[size - 1])) --size;
  switch (static_cast<rung_type_kind>(kind)) {
    case RUNG_BOOL: return size == 4 && (memcmp(string, "TRUE", 4) == 0 || memcmp(string, "true", 4) == 0) ? 1 : 0;
    case RUNG_REAL: return rung_bits_of_f64(readLeadingReal(string, true));
    case RUNG_LREAL: return rung_bits_of_f64(readLeadingReal(string, false));
    case RUNG_TIME:
    case RUNG_LTIME: {
      int64_t wide = 0;
      int32_t narrow = 0;
      if (kind == RUNG_LTIME) {
        if (!rung_parse(kind, true, 0, string, size, &wide)) rung_parse(kind, false, 0, string, size, &wide);
        return static_cast<uint64_t>(wide);
      }
      if (rung_parse(kind, true, 0, string, size, &narrow)) return static_cast<uint64_t>(static_cast<int64_t>(narrow));
      rung_parse(kind, false, 0, string, size, &narrow);
      return static_cast<uint32_t>(narrow);
    }
    case RUNG_DATE:
    case RUNG_TOD:
    case RUNG_DT: {
      uint32_t value = 0;
      return rung_parse(kind, false, 0, string, size, &value) ? value : 0;
    }
    case RUNG_LDATE:
    case RUNG_LTOD:
    case RUNG_LDT: {
      uint64_t value = 0;
      return rung_parse(kind, false, 0, string, size, &value) ? value : 0;
    }
    default: return readLeadingInteger(string);
  }
}

uint64_t rung_scalar_of_wstring(uint8_t kind, const char16_t* string) {
  if (kind == RUNG_WCHAR) return rung_unit(string, 0);
  while (rung_unit(string, 0) == ' ') ++string;
  char narrow[4 * kScalarRoom + 1];
  rung_string_of_wstring(narrow, sizeof narrow - 1, string);
  return rung_scalar_of_string(kind, narrow);
}

// SPDX-License-Identifier: Apache-2.0
// The integer and bit-string types of the language with their C types, for native bodies that exist once for each.
// RUNG_EACH_INTEGER(ROW) is ROW(NAME, type) for all twelve. Used by conversion.cpp and numeric.cpp.
#pragma once

#include <stdint.h>

#define RUNG_EACH_INTEGER(ROW) \
  ROW(BYTE, uint8_t)           \
  ROW(WORD, uint16_t)          \
  ROW(DWORD, uint32_t)         \
  ROW(LWORD, uint64_t)         \
  ROW(SINT, int8_t)            \
  ROW(INT, int16_t)            \
  ROW(DINT, int32_t)           \
  ROW(LINT, int64_t)           \
  ROW(USINT, uint8_t)          \
  ROW(UINT, uint16_t)          \
  ROW(UDINT, uint32_t)         \
  ROW(ULINT, uint64_t)

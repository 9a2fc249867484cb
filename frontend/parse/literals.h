// SPDX-License-Identifier: Apache-2.0
// The values of literals. In: the spelling of one token of the lexer. Out: a value, and diagnostics for malformed
// literals (digits, units, calendar, escapes). Called by expressions.cpp; sema checks that values fit their types.
#pragma once

#include <string>
#include <string_view>

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/tree.h"

namespace rung::text {

struct NumberValue {
  bool is_real = false;
  bool is_based = false;
  bool has_underscore_pair = false;  // 1__000, an error in the standard
  uint64_t integer = 0;              // magnitude
  double real = 0;
};
// 12  1_000  16#FF  1.5e3. False: an error was reported.
bool readNumber(std::string_view text, Loc loc, Diagnostics& diagnostics, NumberValue& value);
// `1__000_` as `1_000`.
std::string withSingleUnderscores(std::string_view number);

struct TimeValue {
  LiteralKind kind = LiteralKind::Duration;
  bool is_long = false;      // LT#, LD#, LTOD#, LDT#
  bool is_negative = false;  // T#-5s; a date before 1970
  bool is_unsigned = false;  // set by the caller: LDATE and LDT count in an unsigned number, up to 2554
  uint64_t value = 0;        // nanoseconds, two's complement
  bool overflows = false;    // a part of a duration after the first exceeds its unit: T#1h90m
};
// T#… D#… TOD#… DT#… and their long forms, with the prefix.
bool readDuration(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value);
bool readDate(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value);
bool readTimeOfDay(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value);
bool readDateTime(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value);

// The characters between the quotes with escapes decoded: bytes for '…', UTF-8 for "…".
bool readString(std::string_view text, bool wide, Loc loc, Diagnostics& diagnostics, std::string& value);

// %IX0.0  %QW4  %M*; path receives its numbers.
bool readAddress(std::string_view text, Loc loc, Diagnostics& diagnostics, DirectAddress& address,
                 std::vector<uint32_t>& path);

}  // namespace rung::text

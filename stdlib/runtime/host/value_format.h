// SPDX-License-Identifier: Apache-2.0
// Formats and parses values of variables, enumerations by name. In: a variable of the symbol map. Out: its value as in
// the trace; or the variable set from a literal.
#pragma once

#include "symbols.h"

namespace rung::host {

// Appends the value; nothing when a pointer on the path is null.
void formatValue(const LoadedModule& module, const Variable& variable, std::string& to);
// The same of a copy of the value, as rung_read_value makes it.
void formatCopied(const LoadedModule& module, const Variable& variable, const uint8_t* value, std::string& to);
struct Integer {
  int64_t bits = 0;
  bool is_unsigned = false;
  bool isBeyondSigned() const { return is_unsigned && bits < 0; }
};
// The value of types held as an integer: BOOL, numbers, times, dates, characters, enumerations.
bool integerOf(const LoadedModule& module, const Variable& variable, Integer& value);
// The value as a number: BOOL 0 or 1, TIME in its own unit. False: strings, dates, pointers, a null pointer.
bool numberOf(const LoadedModule& module, const Variable& variable, double& value);
// Sets the variable from a literal; returns an error message, or an empty string. The second only checks.
std::string assignValue(const LoadedModule& module, const Variable& variable, std::string_view text);
std::string checkValue(const LoadedModule& module, const Variable& variable, std::string_view text);
// The message for an answer of rung/monitor.h to a value; empty: it was accepted.
std::string whyRefused(const LoadedModule& module, const Variable& variable, rung_access why, std::string_view text);
// The type as messages name it.
std::string typeName(const LoadedModule& module, const rung_type& type);

}  // namespace rung::host

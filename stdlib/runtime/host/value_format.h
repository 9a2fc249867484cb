// Values of variables as text and back, enumerations by name (design §11). In: a variable of the symbol map. Out: its
// text in the trace; or the variable set from a literal.
#pragma once

#include "symbols.h"

namespace rung::host {

// Appends the value; nothing when a pointer on the way is null.
void formatValue(const rung_module& module, const Variable& variable, std::string& to);
struct Integer {
  int64_t bits = 0;
  bool is_unsigned = false;
  bool isBeyondSigned() const { return is_unsigned && bits < 0; }
};
// The value where it is held as an integer: BOOL, numbers, times, dates, characters, enumerations.
bool integerOf(const rung_module& module, const Variable& variable, Integer& value);
// The value as a number: BOOL 0 or 1, TIME in its own unit. False: texts, dates, pointers, a null pointer on the way.
bool numberOf(const rung_module& module, const Variable& variable, double& value);
// Sets the variable from a literal, or says what is wrong. `dry`: only checks.
std::string assignValue(const rung_module& module, const Variable& variable, std::string_view text, bool dry = false);
// The type as messages name it.
std::string typeName(const rung_module& module, const rung_type& type);

}  // namespace rung::host

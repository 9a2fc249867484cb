// SPDX-License-Identifier: Apache-2.0
// Functions that work on a type, an lvalue or the source, and so cannot be declared in a library: SIZEOF, ADR,
// LOWER_BOUND, __NEW, ASSERT … One row of the table in pseudo_functions.cpp and one function each, here by file. A
// declaration of the same name hides them. Called by calls.cpp for a name that is not declared.
#pragma once

#include <optional>

#include "sema/context.h"

namespace rung::sema {

struct PseudoCall {
  NameId name;                          // as written
  std::span<const Argument> arguments;  // as many as the row says, each with a value
  bool as_statement;
};

// None: there is no such function. Otherwise the type, also written into the expression.
std::optional<TypeId> checkPseudoCall(Context& context, ExprId& expr, NameId name, bool as_statement);

// "Did you mean" for a call of a name that is not declared.
std::string_view nearestPseudoFunction(Context& context, NameId written);

// Each checks the call `expr`, may replace it, and returns its type; kError after a report.
using PseudoHandler = TypeId(Context& context, ExprId& expr, const PseudoCall& call);

PseudoHandler checkAssert, checkAssertEq, checkAssertNear;  // assertions.cpp
PseudoHandler checkSizeOf, checkLengthLimit;                // sizes.cpp
PseudoHandler checkAdr, checkVal, checkIsValid;             // pointers.cpp
PseudoHandler checkBitAdr;                                  // bit_addresses.cpp
PseudoHandler checkLowerBound, checkUpperBound;             // open_arrays.cpp
PseudoHandler checkQueryInterface, checkQueryPointer;       // attempts.cpp
PseudoHandler checkDelete;                                  // dynamic_memory.cpp
PseudoHandler checkVarInfo, checkPouName, checkPosition;    // var_info.cpp

}  // namespace rung::sema

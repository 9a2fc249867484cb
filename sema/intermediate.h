// SPDX-License-Identifier: Apache-2.0
// The width of intermediate results. In codesys + - * / MOD, negation and ABS of integers and bit strings below the
// native width (--native-width, 32 bits by default) compute in the native width: signed operands in DINT, all others
// modulo 2^32. Assigning, passing and converting cut the value; another operation and a comparison see it uncut. The
// tree keeps the operands' type as the type of the expression; these functions tell what is computed instead. In iec
// and in library code nothing is wider than its type. "Operators: overflow/underflow in the data type" of the CODESYS
// help. In codesys, too, a REAL becomes an integer in another way. Used by constant expressions and by lowering.
#pragma once

#include "sema/entities.h"

namespace rung::sema {

// The type in which codesys computes with an integer or bit string of this type; none where that is its own.
TypeId nativeType(const Symbols& symbols, TypeId type);

// The type of an intermediate result that is wider than the expression's type says; none: it has just that type.
TypeId uncutType(const Symbols& symbols, ExprId expr);

// The type in which two values are compared when one of them is wider than its type says; none: their own.
TypeId comparedType(const Symbols& symbols, ExprId left, ExprId right);

// The operation is one of those above, on values of the type: marks the expression, or takes the mark away.
void markIntermediate(const Symbols& symbols, ExprId expr, TypeId type, bool is_wide);

// How a conversion of a REAL rounds: in codesys away from zero (ABB's CODESYS help, "REAL_TO_"), else to even.
void markRounding(const Symbols& symbols, ExprId expr, TypeId from, bool is_wide);
types::Rounding roundingOf(const Meaning& known);

// A sum, difference or product: its last bits do not depend on the first ones of its operands.
bool isRingOperation(const Symbols& symbols, ExprId expr);

}  // namespace rung::sema

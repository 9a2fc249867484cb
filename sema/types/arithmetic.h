// SPDX-License-Identifier: Apache-2.0
// The arithmetic kernel: the single implementation of IEC semantics on typed values. In: values and an operator. Out: a
// value or the fault that it raises. Used for constants in sema, folding in the IR and the interpreter; differential
// tests check that generated code agrees with it.
#pragma once

#include <cstdint>
#include <string>

#include "sema/types/types.h"

namespace rung::types {

enum class Op : uint8_t {
#define RUNG_OPERATOR(name, word, operands) name,
#include "sema/types/operators.def"
};
const char* word(Op op);
int operandCount(Op op);
// The operator with this keyword; false when there is none.
bool findOp(std::string_view word, Op& op);
bool isComparison(Op op);
bool isShift(Op op);      // rotations too
bool mayOverflow(Op op);  // of operands that are not zero divisors

// A scalar or a string. Integers, BOOL, bit strings, times, dates, enumerations: sign- or zero-extended to 64 bits.
// REAL and LREAL: the bits of a double (a REAL's value is exact in it). Strings: the NameId of the exact characters
// (WSTRING as UTF-8).
struct Value {
  TypeId type;
  uint64_t bits = 0;
  int64_t asSigned() const { return static_cast<int64_t>(bits); }
  double asReal() const;
  static Value ofReal(TypeId type, double value);
  friend bool operator==(const Value&, const Value&) = default;
};

enum class Fault : uint8_t { None, Div, Index, Null, Cast, Subrange, Convert, Overflow, Lock, Stack, Stop };
const char* word(Fault fault);

// How a REAL becomes an integer. ToEven: exact halves to the even number; a value out of range to the nearest one.
// AwayFromZero: exact halves away from zero; of a value out of range the last bits are kept. NaN gives 0.
enum class Rounding : uint8_t { ToEven, AwayFromZero };

struct Outcome {
  Value value;
  Fault fault = Fault::None;  // value is then the result of unchecked code (x/0 = 0)
  bool overflow = false;      // the exact result did not fit and wrapped, saturated or became infinite
};

// Both operands already have the operator's type (comparisons return BOOL; shifts take any integer as N; Power takes
// any numeric exponent).
Outcome apply(const TypeTable& table, const Names& names, Op op, const Value& left, const Value& right = {});

// Conversion between elementary types, enumerations and subranges included: integers wrap at the target's width, REAL
// to integer rounds, subranges saturate, TIME <-> LTIME scales. `outcome.overflow` when the value changed beyond
// rounding. Strings are not converted here (the runtime does it).
Outcome convert(const TypeTable& table, const Value& value, TypeId to, Rounding rounding = Rounding::ToEven);

// Nanoseconds of one unit of a duration or date kind.
int64_t nanoseconds(TypeKind kind);

// Conversions that change the unit: TIME and LTIME, times of day, and the parts of a date and time.
bool changesUnit(TypeKind from, TypeKind to);

// The default of a type's memory when nothing is declared: 0, '' or the lower bound of a subrange, the first enum item.
Value defaultValue(const TypeTable& table, Names& names, TypeId type);

// True when every value of `from` is a value of `to`: INT to DINT, REAL to LREAL, BYTE to WORD, USINT to INT.
bool isLossless(const TypeTable& table, TypeId from, TypeId to);

// The format of traces and messages: `TRUE`, `-5`, `0.5`, `T#1s500ms`, `'a$L'`, `Red`.
std::string toString(const TypeTable& table, const Names& names, const Value& value);
std::string durationText(int64_t ns);  // T#2s500ms, T#500us

}  // namespace rung::types

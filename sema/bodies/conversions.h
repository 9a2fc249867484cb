// SPDX-License-Identifier: Apache-2.0
// Conversions: which are implicit, which lose values, which need a function; see conversions.cpp.
#pragma once

#include <string>
#include <string_view>

#include "sema/context.h"
#include "sema/shorthands.h"

namespace rung::sema {

// Checks, then converts implicitly to `to` if the dialect allows it (wraps in ConvertExpr), else reports. `what`
// describes the use, for the message: "assigned to `x`".
bool checkExprAs(Context& context, ExprId& expr, TypeId to, std::string_view what);

// What a value is used for. The words are made for a message only: "assigned to `x`".
enum class Use : uint8_t {
  Other,  // Purpose::words
  Assigned,
  Condition,
  IfCondition,
  ElsifCondition,
  WhileCondition,
  UntilCondition,
  AssertCondition,
  ComparedByAssert,
  Set,
  CaseLabel,
  LoopControl,
  LoopLimit,
  LoopStep,
  PassedToInput,
  Passed,
  PassedToEn,
  CopiedFromOutput,
  CopiedFromEno,
  BoundToOutput,
  BoundToEno,
  BoundToInOut,
  Deleted,
  OtherOperand,
};

struct Purpose {
  Use use = Use::Other;
  NameId name = {};  // `x`
  NameId of = {};    // of `TON`
  std::string_view words = {};
  std::string toString(const Context& context) const;
};

enum class Fit : uint8_t {
  Same,       // nothing to do
  Lossless,   // converted silently
  Lossy,      // a warning in codesys, an error in iec
  Pointer,    // a pointer to something else: the same
  Extension,  // codesys alone: bit strings and enumerations as integers
  No,
};

Fit fit(const Context& context, TypeId from, TypeId to);
bool extendsStructure(const Context& context, TypeId derived, TypeId base);
// One is a type with named values, the other its base type. IEC 61131-3 ed. 3, 6.4.4.3.
bool isNamedValueOf(const Context& context, TypeId a, TypeId b);
bool sameType(const Context& context, TypeId a, TypeId b);
// For a checked expression: adapts literals, converts to `to`, or reports.
bool convert(Context& context, ExprId& expr, TypeId to, const Purpose& purpose);
bool checkAs(Context& context, ExprId& expr, TypeId to, const Purpose& purpose);
void wrapConvert(Context& context, ExprId& expr, TypeId to);
// The BOOL of IF, WHILE, UNTIL.
void checkCondition(Context& context, ExprId& expr, Use use);
// The common type of both sides; none when they do not combine.
TypeId commonNumber(const Context& context, TypeId a, TypeId b);
// An error or warning, depending on the fit; false for an error.
bool reportFit(Context& context, Fit fit, ExprId expr, TypeId from, TypeId to, const Purpose& purpose);

}  // namespace rung::sema

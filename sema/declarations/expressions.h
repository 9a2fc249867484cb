// SPDX-License-Identifier: Apache-2.0
// What declarations need of expressions: bounds, initial values and arguments are expressions, and names in expressions
// resolve declarations, so each needs the other. sema/bodies implements this interface (bodies/for_declarations.cpp);
// declarations use it through Context::expressions and include nothing of bodies.
#pragma once

#include <string_view>

#include "sema/context.h"

namespace rung::sema {

class Expressions {
 public:
  virtual ~Expressions() = default;

  // Checks an expression and returns its type (kError after a report). `expected` (or none) is the type that the
  // context wants: it types literals and picks enumeration items; nothing is converted. May replace the expression.
  virtual TypeId check(Context& context, ExprId& expr, TypeId expected) const = 0;
  // Checks, then converts implicitly to `to` if the dialect allows it (wraps in ConvertExpr), else reports. `what`
  // describes the use, for the message: "assigned to `x`".
  virtual bool checkAs(Context& context, ExprId& expr, TypeId to, std::string_view what) const = 0;
  // Makes an lvalue the target of a reference of this type; reports when the reference cannot be bound to it.
  virtual bool bindReference(Context& context, ExprId& lvalue, TypeId reference) const = 0;
  // Checks the arguments for FB_Init in the declaration of a variable; `type` is as written. For an array whose
  // elements have separate arguments, `elements` calls follow each other.
  virtual CallId checkConstructor(Context& context, TypeExprId type, uint32_t& elements) const = 0;
  // Checks the arguments of PROGRAM p WITH t : Main(...), like those of a call of that program.
  virtual void checkConnections(Context& context, ExprId call, PouId program) const = 0;
  // Checks the body of a POU unless that is done. False: it has errors, or is being checked.
  virtual bool ensureBody(Context& context, PouId pou) const = 0;
};

}  // namespace rung::sema

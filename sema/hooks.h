// SPDX-License-Identifier: Apache-2.0
// The moments at which the rules of sema/checks look at the project. In: what declarations and bodies have just found.
// Out: diagnostics; a rule reads and reports, and changes neither the tree nor the project. Declarations and bodies
// announce each moment through Context::rules; checks/rules.cpp calls the rules that checks/rules.def has for it.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// A written type or a call that names a declaration.
struct UsedName {
  PouId pou;  // the POU; none: a type of another kind
  const DeclHeader& declared;
  NameId name;
  Loc loc;
  bool is_call;
};

class Rules {
 public:
  virtual ~Rules() = default;

  virtual void use(Context& context, const UsedName& used) const = 0;
  // A value is stored by :=, REF= or ?=; both sides are checked and converted.
  virtual void assignment(Context& context, ExprId target, ExprId value) const = 0;
  // An implicit conversion of a checked value that loses nothing, before its node is created.
  virtual void conversion(Context& context, ExprId value, TypeId to) const = 0;
  // An operation or an indexed array: the operands have their types, and so has the expression.
  virtual void expression(Context& context, ExprId expr) const = 0;
  // A call of an instance or program whose arguments are bound.
  virtual void call(Context& context, const CallExpr& node, const Call& call) const = 0;
  // A statement of any body, the statements in it first.
  virtual void statement(Context& context, StmtId statement) const = 0;
  // The end of a body; Context::pou and Context::body are its own.
  virtual void pou(Context& context) const = 0;
  // All declarations are resolved, and no body is checked.
  virtual void declarations(Context& context) const = 0;
  // All bodies are checked; the calls are sorted by their caller.
  virtual void project(Context& context) const = 0;
};

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// The rules of rules.def: a constant for each message, the declaration of each function, and the object that calls
// them. In: a moment of hooks.h. Out: diagnostics. The file of a rule includes this header; only rules.cpp calls the
// functions.
#pragma once

#include "frontend/source/diagnostics.h"
#include "sema/checks/operation.h"
#include "sema/hooks.h"

namespace rung::sema {

// What a rule of each hook is given; an expression and a statement by their kind.
using UseRule = void(Context& context, const UsedName& used);
using AssignmentRule = void(Context& context, ExprId target, ExprId value);
using ConversionRule = void(Context& context, ExprId value, TypeId to);
using IndexRule = void(Context& context, const IndexExpr& node);
using ComparisonRule = void(Context& context, const Operation& operation);
using OperationRule = void(Context& context, const Operation& operation);  // any other
using CallRule = void(Context& context, const CallExpr& node, const Call& call);
using AssignRule = void(Context& context, const AssignStmt& node);
using IfRule = void(Context& context, const IfStmt& node);
using CaseRule = void(Context& context, const CaseStmt& node);
using ForRule = void(Context& context, const ForStmt& node);
using PouRule = void(Context& context);
using DeclarationsRule = void(Context& context);
using ProjectRule = void(Context& context);

// All of them, called at their hooks.
const Rules& allRules();

}  // namespace rung::sema

#define RUNG_RULE(hook, file, function) \
  }                                     \
  namespace rung::sema {                \
  hook##Rule function;                  \
  }                                     \
  namespace rung::diag {

namespace rung::diag {
#include "sema/checks/rules.def"
}  // namespace rung::diag

#undef RUNG_RULE

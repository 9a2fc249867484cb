// SPDX-License-Identifier: Apache-2.0
// Calls: the callee, the pin of each argument, and the result; see calls.cpp.
#pragma once

#include <vector>

#include "sema/context.h"

namespace rung::sema {

// Checks the arguments of PROGRAM p WITH t : Main(...), like those of a call of that program.
void checkConnections(Context& context, ExprId call, PouId program);
TypeId checkCall(Context& context, ExprId& expr, TypeId expected, bool as_statement);

// Which pin each argument belongs to, EN and ENO apart. Arguments without a pin are reported and checked alone.
// `slots` has the argument's index + 1 by position among the pins; those of an {extensible} pin follow the last pin.
struct Arguments {
  std::vector<uint32_t> slots;
  uint32_t en = 0, eno = 0;  // index + 1
  uint32_t positional = 0;   // how many have no name
  bool ok = true;
  bool checked = false;  // except literals: chooseOverload
};

Arguments matchArguments(Context& context, const CallExpr& node, PouId pou);
// Checks the values of arguments that do not fit the pins, to report their errors too. Out: no type.
TypeId checkRefused(Context& context, CallExpr& node, const Arguments& arguments);
// The POU that a call means: of several of one name the one that fits, with its header resolved. None: reported.
PouId calledOf(Context& context, const CallExpr& node, PouId named, bool& checked);
// The type of a call; reports one that has none where a value is wanted.
TypeId resultOf(Context& context, CallExpr& node, const Pou& callee, bool as_statement);
void bindControlPins(Context& context, const CallExpr& node, const Arguments& arguments, Call& call);
// Checks the arguments of a call that cannot be resolved, to report their errors too.
void checkLooseArguments(Context& context, const CallExpr& node);
CallId addCall(Context& context, Call&& call);
// The bindings of a call whose pins are not generic.
void bindArguments(Context& context, const CallExpr& node, PouId callee, const Arguments& arguments, Call& call);

}  // namespace rung::sema

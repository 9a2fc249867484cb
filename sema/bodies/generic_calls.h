// SPDX-License-Identifier: Apache-2.0
// Calls of generic and extensible library functions: inputs of one generic type name share one type, and a result of
// that name follows it. In: a call whose pins have generic types. Out: the same call to an instance for these types,
// parsed again (declarations/generics.cpp), so that bodies are checked with concrete types only. Called by calls.cpp;
// operator_calls.cpp shares the grouping.
#pragma once

#include <span>
#include <vector>

#include "sema/bodies/calls.h"
#include "sema/context.h"
#include "sema/shorthands.h"

namespace rung::sema {

// The checked operands of a call by slot (see Arguments), grouped by generic pin type, each group of one type.
struct GenericOperands {
  std::vector<ExprId> values;     // by slot; none: left open
  std::vector<TypeId> pin_types;  // by slot, as declared
  struct Group {
    TypeId generic, type;
  };
  std::vector<Group> groups;
  bool ok = true;

  // The type of a declared pin or result type in this call.
  TypeId typeFor(const Context& context, TypeId declared) const;
};

// In codesys bit strings are numbers, and integers are bit strings.
bool belongs(const Context& context, TypeId type, TypeKind generic);

// `forced` (or none): the type in a typed name such as MUX_INT. `checked`: the operands have their types.
GenericOperands groupOperands(Context& context, const CallExpr& node, PouId pou, const Arguments& arguments,
                              TypeId expected, TypeId forced, bool checked);

TypeId checkGenericCall(Context& context, ExprId& expr, PouId pou, TypeId expected, TypeId forced);

}  // namespace rung::sema

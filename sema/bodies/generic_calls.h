// Calls of generic and extensible library functions: inputs of one generic type name share one type, and a result of
// that name follows it (design §5). In: a call whose pins have generic types. Out: the same call to an instance for
// these types. Called by calls.cpp; operator_calls.cpp shares the grouping.
#pragma once

#include <span>
#include <vector>

#include "sema/bodies/bodies.h"

namespace rung::sema {

// The operands of a call by slot (see Arguments), checked, grouped by generic pin type and brought to one type a group.
struct GenericOperands {
  std::vector<ExprId> values;     // by slot; none: left open
  std::vector<TypeId> pin_types;  // by slot, as declared
  struct Group {
    TypeId generic, type;
  };
  std::vector<Group> groups;
  bool ok = true;

  // The type that a declared pin or result type stands for in this call.
  TypeId typeFor(const Context& context, TypeId declared) const;
};

// In codesys bit strings are numbers, and integers are bit strings.
bool belongs(const Context& context, TypeId type, TypeKind generic);

// `forced` (or none): the type that a typed name such as MUX_INT asks for. `checked`: the operands have their types.
GenericOperands groupOperands(Context& context, const CallExpr& node, PouId pou, const Arguments& arguments,
                              TypeId expected, TypeId forced, bool checked);

TypeId checkGenericCall(Context& context, ExprId& expr, PouId pou, TypeId expected, TypeId forced);

// Makes a call with EN or ENO that stands for a plain value, a conversion or a sum of times, into
// MOVE(EN := …, value, ENO => …): the value has no pins of its own.
TypeId guardValue(Context& context, ExprId& expr, ExprId value);

}  // namespace rung::sema

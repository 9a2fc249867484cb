// SPDX-License-Identifier: Apache-2.0
// Lowering of calls of functions and methods: a plan says what is passed how and where the result goes, then the call
// is emitted in the order of evaluation. In: a call that sema has resolved. Out: a Call statement with temporaries for
// its results; of a pure function an expression. Called by calls.cpp, initial_values.cpp and exits.cpp. By-reference
// inputs (arrays, structures, strings of functions) are copied by the caller unless the callee is pure or nothing can
// change them during the call. Only a callee that writes such an input copies it, at its entry (statements.cpp), so
// callers never pay for callees that only read.
#include <algorithm>
#include <numeric>

#include "ir/lower/lowering.h"
#include "ir/string_end.h"
#include "sema/declarations/constants.h"

namespace rung::ir {

// How an argument reaches the callee.
enum class Passing : uint8_t {
  Default,    // an open input: its default
  Value,      // a scalar input
  Aggregate,  // an array, structure or string: the variable, or a copy where the call could change it
  Variable,   // a VAR_IN_OUT: the variable; a part of a byte is a copy that is written back
  Output,     // a temporary, stored to the caller's variable after the call
  Discarded,  // an open output: nothing
  OpenArray,  // ARRAY[*]: a pointer here, the bounds after all other arguments
};

struct CallLowering::FunctionCall {
  struct Pin {
    sema::VarId id;
    const sema::Binding* binding;  // null: open
    Passing passing;
  };
  struct Argument {
    ExprId value;
    bool is_variable = false;         // an in-out: reached through temporaries only
    std::vector<ExprId> bounds = {};  // of an ARRAY[*]
  };
  struct Output {
    rung::ExprId target;
    ExprId value;
    bool negated;
  };

  const sema::Call& call;
  const sema::Pou& pou;
  BodyId callee;
  Loc loc;

  // the plan
  std::vector<Pin> pins = {};
  std::vector<uint32_t> order = {};  // of `pins` as their arguments were written
  bool is_pure = false;              // the callee
  bool may_alias = false;            // the call could change the memory of an input
  TypeId result_type = {};           // none: no result
  bool makes_string = false;     // a native string function writes directly into the target, which may be an input too
  Target* wanted = nullptr;      // the caller's target of such a string
  Target own = {};               // else a temporary
  bool builds_in_place = false;  // the first input is built in the target: mayChain

  // what the arguments became
  std::vector<Argument> arguments = {};
  std::vector<Output> outputs = {};
  ExprId copies = {};  // the value of bInCopyCode

  Target& target() { return wanted != nullptr ? *wanted : own; }
};

// ---- the plan

CallLowering::FunctionCall CallLowering::planFunctionCall(const sema::Call& call, const rung::CallExpr& node,
                                                          Target* target) {
  const sema::Pou& pou = project_.pou(call.pou);
  FunctionCall plan{.call = call, .pou = pou, .callee = in_.bodyOf(call.pou), .loc = node.h.loc};
  plan.is_pure = in_.module.body(plan.callee).pure;
  bool has_reference_outputs = false;
  for (const sema::Binding& binding : call.bindings) {
    const SectionKind section = project_.var(binding.pin).section;
    if (section == SectionKind::InOut || section == SectionKind::Output) has_reference_outputs = true;
  }
  plan.may_alias = !plan.is_pure && (!pou.pragmas.native || has_reference_outputs);
  if (pou.result) plan.result_type = strip(pou.result);
  plan.makes_string = plan.result_type && pou.pragmas.native && TypeTable::isString(types_.kind(plan.result_type));
  if (target != nullptr && plan.makes_string) {
    const TypeId type = target->place ? typeOf(target->place) : strip(sema::typeOf(tree_, target->expr));
    if (types_.kind(type) == types_.kind(plan.result_type)) plan.wanted = target;
  }
  planPins(plan);
  return plan;
}

void CallLowering::planPins(FunctionCall& plan) {
  const std::vector<sema::Binding>& bindings = plan.call.bindings;
  size_t next = 0;
  for (const sema::VarId id : plan.pou.vars) {
    const sema::Var& pin = project_.var(id);
    if (pin.section != SectionKind::Input && pin.section != SectionKind::Output && pin.section != SectionKind::InOut)
      continue;
    // Bindings are in the order of the pins; an open pin may be absent.
    const sema::Binding* binding = nullptr;
    for (size_t i = 0; i < bindings.size() && binding == nullptr; ++i) {
      if (bindings[(next + i) % bindings.size()].pin != id) continue;
      binding = &bindings[(next + i) % bindings.size()];
      next += i + 1;
    }
    if (binding != nullptr && !binding->value) binding = nullptr;
    const bool is_input = pin.section == SectionKind::Input;
    RUNG_INVARIANT(binding != nullptr || pin.section != SectionKind::InOut || types_.isOpenArray(strip(pin.type)),
                   "sema reports an open VAR_IN_OUT");
    const Passing passing = types_.isOpenArray(strip(pin.type)) ? Passing::OpenArray
                            : pin.section == SectionKind::InOut ? Passing::Variable
                            : binding == nullptr && is_input    ? Passing::Default
                            : binding == nullptr                ? Passing::Discarded
                            : !is_input                         ? Passing::Output
                            : isAggregate(strip(pin.type))      ? Passing::Aggregate
                                                                : Passing::Value;
    plan.pins.push_back({id, binding, passing});
  }
  plan.order.resize(plan.pins.size());
  std::iota(plan.order.begin(), plan.order.end(), 0);
  writtenOrder(plan.order, [&](uint32_t pin) {
    const sema::Binding* binding = plan.pins[pin].binding;
    return binding != nullptr ? binding->value : rung::ExprId{};
  });
}

// Tells whether the first input of a native string function may be built in the target of its result, as in
// `s := CONCAT(CONCAT(a, b), c)`: a and b go to s, then c is appended in place. The other arguments must not see that,
// and cutting to the target's capacity must not change the result.
bool CallLowering::mayChain(const sema::Call& call, const Target& target) const {
  const sema::Pou& pou = project_.pou(call.pou);
  if (!target.early) return false;
  if (!pou.pragmas.prefix && types_.info(typeOf(target.place)).length < types_.info(strip(pou.result)).length)
    return false;
  if (isTemp(target.place)) return true;
  for (size_t i = 1; i < call.bindings.size(); ++i)
    if (call.bindings[i].value && !places().isApart(call.bindings[i].value, places().rootVar(target.expr)))
      return false;
  return true;
}

// ---- arguments

ExprId CallLowering::defaultArgument(sema::VarId pin_id, rung::ExprId init, Loc loc) {
  const sema::Var& pin = project_.var(pin_id);
  TypeId type = strip(pin.type);
  if (!isAggregate(type)) {
    if (init)
      if (auto value = sema::constantOf(project_, init)) return convertValue(ofValue(*value, loc), type, loc);
    if (!init && in_.records.isZero(type)) return zero(type, loc);
  }
  ExprId place = temp(type, loc);
  objects().storeInitial(copy(place), type, init, false);
  return place;
}

ExprId CallLowering::argumentPlace(ExprId value, TypeId pin_type, bool may_alias, Loc loc) {
  const Expr expr = body_.expr(value);
  bool constant_memory = expr.kind == ExprKind::String || expr.kind == ExprKind::Data || expr.kind == ExprKind::Zero;
  bool is_value = expr.kind == ExprKind::Convert || expr.kind == ExprKind::Select || expr.kind == ExprKind::Call;
  bool same = typeOf(value) == strip(pin_type) || TypeTable::isString(types_.kind(pin_type));
  if (constant_memory || (same && !is_value && !may_alias && isReferable(value))) return value;
  if (const uint32_t* index = localOf(expr); index != nullptr && body_.locals[*index].kind == LocalKind::Temp)
    return value;
  const ExprId own = temp(same ? typeOf(value) : strip(pin_type), expr.loc);
  assign(copy(own), value, loc);
  return own;
}

// The place of a VAR_IN_OUT: the variable, or a copy of the value that a VAR_IN_OUT CONSTANT is given.
ExprId CallLowering::inOutPlace(rung::ExprId argument, TypeId pin_type) {
  Loc loc = tree_.loc(argument);
  ExprId place = places().lowerPlace(argument);
  if (sema::PouId wanted = in_.records.pouOf(strip(pin_type))) place = asBase(place, wanted, loc);
  if (isPlace(body_.expr(place).kind)) {
    place = stable(place);
    const bool is_string = TypeTable::isString(types_.kind(typeOf(place)));
    if (is_string && mayLackEnd(types_, body_, place)) assign(copy(place), toTemp(copy(place), loc), loc);
    return places().seenAs(place, strip(pin_type), loc);
  }
  const ExprId own = temp(strip(pin_type), loc);
  assign(copy(own), convertValue(place, strip(pin_type), loc), loc);
  return own;
}

ExprId CallLowering::passAggregate(FunctionCall& plan, TypeId type, rung::ExprId given) {
  const Loc loc = tree_.loc(given);
  ExprId value;
  if (plan.builds_in_place && given == plan.pins.front().binding->value && isPlainCall(given)) {
    Target inner = plan.target();
    value = lowerCall(given, &inner);
    if (inner.stored) value = copy(inner.place);
  } else {
    value = values().lowerValue(given);
  }
  // A body in ST sees no more of a string than its pin takes; the library's C functions take any length.
  const bool is_cut = !plan.pou.pragmas.native && TypeTable::isString(types_.kind(type)) &&
                      types_.info(typeOf(value)).length > types_.info(type).length;
  if (!is_cut) return argumentPlace(value, type, plan.may_alias, loc);
  const ExprId own = temp(type, loc);
  assign(copy(own), value, loc);
  return own;
}

ExprId CallLowering::passVariable(FunctionCall& plan, TypeId type, rung::ExprId given) {
  const ExprId variable = inOutPlace(given, type);
  if (isReferable(variable)) return variable;
  const ExprId own = toTemp(variable, plan.loc);
  plan.outputs.push_back({given, copy(own), false});
  return own;
}

ExprId CallLowering::passArgument(FunctionCall& plan, uint32_t number) {
  const FunctionCall::Pin& planned = plan.pins[number];
  const sema::Var& pin = project_.var(planned.id);
  const TypeId type = strip(pin.type);
  const sema::Binding* binding = planned.binding;
  switch (planned.passing) {
    case Passing::Default:
      if (plan.copies && sameIdentifier(project_.names.string(pin.name), "bInCopyCode")) return copy(plan.copies);
      return defaultArgument(planned.id, pin.init, plan.loc);
    case Passing::Value: {
      const ExprId value = values().lowerValue(binding->value);
      return state_.guard && mayFault(value) ? toTemp(value, plan.loc) : value;
    }
    case Passing::Aggregate: return passAggregate(plan, type, binding->value);
    case Passing::Variable: return passVariable(plan, type, binding->value);
    case Passing::Output: {
      const ExprId own = temp(type, plan.loc);
      plan.outputs.push_back({binding->value, copy(own), binding->negated});
      return own;
    }
    case Passing::Discarded: return {};
    case Passing::OpenArray: {
      const bool copies = pin.section == SectionKind::Input && !plan.is_pure;
      const OpenArray array = binding == nullptr ? places().noOpenArray(type, plan.loc)
                                                 : places().passOpenArray(binding->value, type, copies);
      plan.arguments[number].bounds = array.bounds;
      return array.pointer;
    }
  }
  return {};
}

void CallLowering::spillArguments(FunctionCall& plan, InsertionPoint point) {
  for (FunctionCall::Argument& argument : plan.arguments)
    if (!argument.is_variable) spill(point, {&argument.value});
}

// ---- emission

ExprId CallLowering::lowerFunctionCall(const sema::Call& call, const rung::CallExpr& node, Target* target,
                                       ExprId object, ExprId copies) {
  FunctionCall plan = planFunctionCall(call, node, target);
  plan.copies = copies;
  if (plan.makes_string && plan.wanted == nullptr)
    plan.own = {.place = temp(plan.result_type, plan.loc), .early = true};
  if (plan.makes_string && plan.is_pure && plan.target().early) {
    lowerTarget(plan.target());
    plan.builds_in_place = plan.order.front() == 0 && mayChain(call, plan.target());
  }
  plan.arguments.resize(plan.pins.size());
  for (const uint32_t i : plan.order) {
    const InsertionPoint point = here();
    const ExprId value = passArgument(plan, i);
    spillArguments(plan, point);
    plan.arguments[i].value = value;
    plan.arguments[i].is_variable = plan.pins[i].passing == Passing::Variable;
  }
  for (size_t i = 0; i < plan.pins.size(); ++i)
    for (const ExprId bound : std::vector(plan.arguments[i].bounds)) plan.arguments.push_back({.value = bound});
  ExprId result;
  if (plan.makes_string) {
    const InsertionPoint point = here();
    result = placeOf(plan.target());
    spillArguments(plan, point);
    plan.target().stored = true;
  }
  return emitFunctionCall(plan, object, result);
}

// A VAR_IN_OUT of a test gets a variable of its own.
void CallLowering::lowerTestCall(sema::PouId test, std::span<const sema::TestCase::Input> inputs, Loc loc) {
  sema::Call call;
  call.pou = test;
  FunctionCall plan{.call = call, .pou = project_.pou(test), .callee = in_.bodyOf(test), .loc = loc};
  if (plan.pou.result) plan.result_type = strip(plan.pou.result);
  std::vector<ExprId> bounds;
  for (const sema::VarId id : plan.pou.vars) {
    const sema::Var& pin = project_.var(id);
    const bool is_output = pin.section == SectionKind::Output, is_in_out = pin.section == SectionKind::InOut;
    if (!is_output && !is_in_out && pin.section != SectionKind::Input) continue;
    const TypeId type = strip(pin.type);
    rung::ExprId init = pin.init;
    for (const sema::TestCase::Input& input : inputs)
      if (input.var == id) init = input.value;
    FunctionCall::Argument& argument = plan.arguments.emplace_back();
    if (types_.isOpenArray(type)) {
      const OpenArray array = places().noOpenArray(type, loc);
      argument.value = array.pointer;
      bounds.insert(bounds.end(), array.bounds.begin(), array.bounds.end());
    } else if (is_in_out) {
      argument.value = temp(type, loc);
      objects().storeInitial(copy(argument.value), type, {}, false);
    } else if (!is_output) {
      argument.value = defaultArgument(id, init, loc);
    }
  }
  for (const ExprId bound : bounds) plan.arguments.push_back({.value = bound});
  emitFunctionCall(plan, {}, {});
}

ExprId CallLowering::emitFunctionCall(FunctionCall& plan, ExprId object, ExprId result) {
  std::vector<ExprId> arguments;
  arguments.reserve(plan.arguments.size());
  for (const FunctionCall::Argument& argument : plan.arguments) arguments.push_back(argument.value);
  const Slice<ExprId> operands = list(arguments);
  if (plan.is_pure && plan.result_type && !isAggregate(plan.result_type) && plan.outputs.empty())
    return add(plan.loc, plan.result_type, CallExpr{.callee = plan.callee, .operands = operands});

  if (plan.result_type && !result) result = temp(plan.result_type, plan.loc);
  append(plan.loc, CallStmt{.callee = plan.callee,
                            .self = object,
                            .operands = operands,
                            .result = result,
                            .is_virtual = plan.call.is_virtual,
                            .is_checked = plan.call.is_virtual && in_.checksCasts()});
  for (const FunctionCall::Output& output : plan.outputs)
    storeOutput(output.target, output.value, output.negated, plan.loc);
  if (plan.pou.pragmas.faults && !isLibraryCode()) faultUnlessZero(result, plan.loc);
  return result && plan.wanted == nullptr ? copy(result) : ExprId{};
}

// After a function marked {fault}: its result is 0, or a fault that the caller raises.
void CallLowering::faultUnlessZero(ExprId result, Loc loc) {
  const StmtId fault = block(
      [&] { append(loc, FaultStmt{.value = convert(copy(result), types::kLInt, loc), .fault = types::Fault::Lock}); });
  const ExprId bad = binary(Op::Ne, types::kBool, copy(result), constant(typeOf(result), 0, loc), loc);
  append(loc, IfStmt{.condition = bad, .then_block = fault});
}

}  // namespace rung::ir

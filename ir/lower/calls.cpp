// SPDX-License-Identifier: Apache-2.0
// Lowering of calls: EN and ENO, function blocks and programs. In: calls that sema has resolved. Out: Call statements.
// Functions are in function_calls.cpp, operators in operator_calls.cpp, assertions in assertions.cpp.
#include <algorithm>
#include <numeric>

#include "ir/lower/lowering.h"

namespace rung::ir {

void CallLowering::lowerTarget(Target& target) {
  if (!target.place) target.place = stable(places().lowerPlace(target.expr));
}

ExprId CallLowering::placeOf(Target& target) {
  lowerTarget(target);
  return copy(target.place);
}

ExprId CallLowering::lowerCall(rung::ExprId id, Target* target) {
  const rung::CallExpr& node = tree_.as<rung::CallExpr>(id);
  const sema::Call& call = project_.call(sema::meaning(node.h).call);
  const bool is_conditional = call.en || call.eno || call.eno_memory;
  return is_conditional ? lowerConditionalCall(call, node, target) : lowerPlainCall(call, node, target, {});
}

// A call that does not ask whether it may run. `instance`: of a block, where it is known; none: not yet evaluated.
ExprId CallLowering::lowerPlainCall(const sema::Call& call, const rung::CallExpr& node, Target* target,
                                    ExprId instance) {
  switch (call.kind) {
    case sema::CallKind::Function: return lowerFunctionCall(call, node, target);
    case sema::CallKind::Method: return lowerMethodCall(call, node, target);
    case sema::CallKind::Operator: return lowerOperator(call, node);
    case sema::CallKind::Instance:
      lowerBlockCall(call, node, instance ? instance : stable(places().lowerPlace(call.instance)));
      return {};
    case sema::CallKind::Program: lowerBlockCall(call, node, places().lowerPlace(node.callee)); return {};
    case sema::CallKind::Assertion: lowerAssertion(call, node); return {};
    case sema::CallKind::Attempt: return values().lowerAttempt(call, node.h.loc);
    case sema::CallKind::Delete: values().lowerDelete(call, node.h.loc); return {};
  }
  return {};
}

// EN and ENO: nothing runs when EN is FALSE; a check that fails inside sets ENO FALSE and keeps the outputs.
ExprId CallLowering::lowerConditionalCall(const sema::Call& call, const rung::CallExpr& node, Target* target) {
  const Loc loc = node.h.loc;
  PlaceLowering::Instance instance;
  if (call.eno_memory) instance = places().lowerInstance(call.instance, call.eno_memory);
  const ExprId en = call.en ? values().lowerValue(call.en) : constantBool(true, loc);
  const ExprId eno = temp(types::kBool, loc);
  assign(copy(eno), en, loc);
  ExprId result;
  const TypeId written = sema::meaning(node.h).type, result_type = written ? strip(written) : TypeId{};
  const bool has_result = result_type && types_.kind(result_type) != TypeKind::None &&
                          call.kind != sema::CallKind::Instance && call.kind != sema::CallKind::Program &&
                          call.kind != sema::CallKind::Assertion;
  if (has_result && !target) {
    result = temp(result_type, loc);
    assign(copy(result), zero(result_type, loc), loc);
  }
  StmtId body = block([&] {
    ExprId value = lowerPlainCall(call, node, nullptr, instance.place);
    if (!has_result || !value) return;
    if (target) {
      ExprId place = lowerAfter({&value}, [&] { return placeOf(*target); });
      assign(place, convertValue(value, typeOf(place), loc), loc);
    } else {
      assign(copy(result), value, loc);
    }
  });
  if (call.eno || call.eno_memory) body = clearingOnFault(eno, body, loc);
  append(loc, IfStmt{.condition = copy(eno), .then_block = body});
  if (call.eno_memory) assign(instance.eno, copy(eno), loc);
  storeEno(call, eno, loc);
  if (has_result && target) target->stored = true;
  return result;
}

// The statements, after a fault in which `eno` is FALSE.
StmtId CallLowering::clearingOnFault(ExprId eno, StmtId statements, Loc loc) {
  return block([&] {
    const StmtId failed = block([&] { assign(copy(eno), constantBool(false, loc), loc); });
    append(loc, TryStmt{.body_block = statements, .catch_block = failed, .catches = true});
  });
}

void CallLowering::storeEno(const sema::Call& call, ExprId eno, Loc loc) {
  if (call.eno && call.eno_is_pin) {  // the callee has set it, if it ran
    const StmtId none = block([&] { storeOutput(call.eno, constantBool(false, loc), false, loc); });
    append(loc, IfStmt{.condition = unary(Op::Not, types::kBool, copy(eno), loc), .then_block = none});
  } else if (call.eno) {
    storeOutput(call.eno, eno, false, loc);
  }
}

void CallLowering::storeOutput(rung::ExprId target, ExprId value, bool negated, Loc loc) {
  if (negated) value = unary(Op::Not, typeOf(value), value, loc);
  ExprId place = lowerAfter({&value}, [&] { return places().lowerPlace(target); });
  assign(place, convertValue(value, typeOf(place), loc), loc);
}

// An unconditional call: without EN and with an ENO that nothing reads.
bool CallLowering::isPlainCall(rung::ExprId expr) const {
  if (tree_.kind(expr) != rung::ExprKind::Call) return false;
  const sema::Call& call = project_.call(sema::meaning(tree_, expr).call);
  return !call.en && !call.eno && !call.eno_memory;
}

ExprId CallLowering::lowerMethodCall(const sema::Call& call, const rung::CallExpr& node, Target* target) {
  const sema::PouId owner = project_.pou(call.pou).owner;
  ExprId object;
  if (call.instance)
    object = stable(places().lowerPlace(call.instance));
  else
    object = self(node.h.loc);
  if (!call.bindings.empty() && project_.pou(call.pou).kind == PouKind::Action) {
    lowerBlockCall(call, node, object);
    return {};
  }
  return lowerFunctionCall(call, node, target, asBase(object, owner, node.h.loc));
}

void CallLowering::writtenOrder(std::vector<uint32_t>& pins, FunctionRef<rung::ExprId(uint32_t)> value) const {
  std::vector<std::pair<uint32_t, uint32_t>> written;  // place in the source, pin
  std::vector<uint32_t*> slots;
  for (uint32_t& pin : pins) {
    const rung::ExprId given = value(pin);
    if (!given) continue;
    written.push_back({tree_.begin(given).offset, pin});
    slots.push_back(&pin);
  }
  std::sort(written.begin(), written.end());
  for (size_t i = 0; i < slots.size(); ++i) *slots[i] = written[i].second;
}

// ---- function blocks and programs ------------------------------------------------------------------------------

// The attributes of its variables: inputs that the call leaves open and that are marked `initialize_on_call` get their
// initial values, variables marked `is_connected` tell whether it gives the input a value. The call of the body of the
// base is a part of another call.
void CallLowering::setMarkedVariables(const sema::Call& call, const rung::CallExpr& node, ExprId instance) {
  const bool calls_base = tree_.kind(node.callee) == rung::ExprKind::Deref &&
                          tree_.kind(tree_.as<rung::DerefExpr>(node.callee).base) == rung::ExprKind::Super;
  if (calls_base) return;
  const auto isGiven = [&](sema::VarId pin) {
    return std::any_of(call.bindings.begin(), call.bindings.end(), [&](const sema::Binding& binding) {
      return binding.pin == pin && binding.value && !binding.is_output;
    });
  };
  for (sema::PouId at = call.pou; at; at = project_.pou(at).base) {
    const sema::Pou& block = project_.pou(at);
    for (const sema::VarId id : block.vars) {
      const sema::Var& var = project_.var(id);
      const Loc loc = node.h.loc;
      if (var.tells_input)
        assign(places().pinPlace(copy(instance), var, loc), constantBool(isGiven(var.tells_input), loc), loc);
      if (block.pragmas.initialize_on_call && var.pragmas.initialize_on_call && !isGiven(id))
        objects().storeInitial(places().pinPlace(copy(instance), var, loc), var.type, var.init, false);
    }
  }
}

void CallLowering::storeOpenArray(const sema::Var& pin, rung::ExprId value, ExprId instance) {
  const Loc at = tree_.loc(value);
  const OpenArray array = places().passOpenArray(value, strip(pin.type), false);
  assign(field(asBase(copy(instance), pin.pou, at), pin.field, typeOf(array.pointer), at), array.pointer, at);
  for (uint32_t i = 0; i < array.bounds.size(); ++i) {
    const sema::Var& bound = project_.var({pin.open_array.bounds.index + i});
    assign(field(asBase(copy(instance), pin.pou, at), bound.field, bound.type, at), array.bounds[i], at);
  }
}

// Lets an in-out of an instance refer to a variable.
void CallLowering::bindInOut(const sema::Var& pin, rung::ExprId value, ExprId instance, InOuts& in_outs) {
  const auto isLocal = [&](ExprId place) { return body_.expr(rootOf(body_, place)).kind == ExprKind::Local; };
  const Loc at = tree_.loc(value);
  const ExprId place = places().pinPlace(copy(instance), pin, at);
  ExprId variable = inOutPlace(value, strip(pin.type));
  if (!isReferable(variable)) {
    variable = toTemp(variable, at);
    in_outs.copies.push_back({value, copy(variable)});
  }
  if (isLocal(variable) && !isLocal(instance)) in_outs.short_lived.push_back(copy(place));
  append(at, BindStmt{.field = place, .place = variable});
}

void CallLowering::callBody(const sema::Call& call, const rung::CallExpr& node, ExprId instance) {
  const Loc loc = node.h.loc;
  if (project_.pou(call.pou).kind == PouKind::Action) {
    sema::Call action = call;
    action.bindings.clear();
    lowerFunctionCall(action, node, nullptr, asBase(instance, project_.pou(call.pou).owner, loc));
    return;
  }
  const BodyId callee = call.is_virtual ? in_.blockCallOf(call.pou) : in_.bodyOf(call.pou);
  append(loc, CallStmt{.callee = callee,
                       .self = instance,
                       .is_virtual = call.is_virtual,
                       .is_checked = call.is_virtual && in_.checksCasts()});
}

void CallLowering::lowerBlockCall(const sema::Call& call, const rung::CallExpr& node, ExprId instance) {
  const Loc loc = node.h.loc;
  InOuts in_outs;
  std::vector<uint32_t> order(call.bindings.size());
  std::iota(order.begin(), order.end(), 0);
  writtenOrder(order, [&](uint32_t i) { return call.bindings[i].value; });
  for (const uint32_t number : order) {
    const sema::Binding& binding = call.bindings[number];
    if (binding.is_output || !binding.value) continue;
    const sema::Var& pin = project_.var(binding.pin);
    if (types_.isOpenArray(strip(pin.type))) {
      storeOpenArray(pin, binding.value, instance);
    } else if (pin.section == SectionKind::InOut) {
      bindInOut(pin, binding.value, instance, in_outs);
    } else {
      const Loc at = tree_.loc(binding.value);
      const ExprId place = places().pinPlace(copy(instance), pin, at);
      assign(place, values().lowerValue(binding.value), at);
    }
  }
  if (project_.pou(call.pou).kind == PouKind::FunctionBlock) setMarkedVariables(call, node, instance);
  callBody(call, node, instance);
  // The variables that they refer to end with this body or sooner, and a trace must not follow them there.
  for (const ExprId field : in_outs.short_lived) append(loc, BindStmt{.field = field});
  for (const CopyBack& back : in_outs.copies) storeOutput(back.target, back.value, false, loc);
  for (const uint32_t number : order) {
    const sema::Binding& binding = call.bindings[number];
    if (!binding.is_output || !binding.value) continue;
    const sema::Var& pin = project_.var(binding.pin);
    storeOutput(binding.value, places().pinPlace(copy(instance), pin, loc), binding.negated, loc);
  }
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Boxes: operators become expressions, everything else calls. A function with one reader becomes part of the reader's
// expression; a function block is called at its place in the execution order and its outputs are read from the
// instance.
// EN guards the assignments of a box: `IF en THEN c := c + 1; END_IF`. If several variables read a result, and for the
// outputs of an instance, each of them is assigned only if EN, or the ENO that the network reads, is TRUE; other
// readers read a variable that keeps the result, or the instance. An operator that can fault is called as in ST if its
// ENO is read: ENO is then FALSE.
#include <algorithm>
#include <optional>
#include <utility>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/network_pins.h"
#include "frontend/schedule/network_scheduler.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/standard_names.h"

namespace rung::diagram {

enum class Form : uint8_t { Chain, Pair, Invert, Move };  // a op b op c …, a op b, NOT a, a
struct Operator {
  Form form;
  BinaryOp op;
};

namespace {

// The function of an operator that a box without instance calls.
std::optional<Operator> operatorNamed(std::string_view name) {
  if (const OperatorFunction* function = operatorFunction(name))
    return Operator{function->extensible ? Form::Chain : Form::Pair, function->op};
  if (sameIdentifier(name, kNot)) return Operator{Form::Invert, BinaryOp::Or};
  if (sameIdentifier(name, kMove)) return Operator{Form::Move, BinaryOp::Or};
  return std::nullopt;
}

}  // namespace

struct Scheduler::Call {
  Signature signature;
  ExprId callee;
  std::optional<Operator> op;
  std::vector<Argument> arguments;
  const DiagramPin* en = nullptr;  // unless it is always TRUE
};

bool Scheduler::isOperator(const DiagramElement& e) const {
  return e.kind == ElementKind::Box && !e.operand && e.path && tree_.kind(e.path) == ExprKind::Name &&
         operatorNamed(names_.string(e.name.name)).has_value();
}

// The output of a wire without a pin name: the result of a function.
uint32_t Scheduler::resultOf(uint32_t element, const Signature& signature) const {
  for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
    const NameId pin = graph_.sources[s].pin.name;
    if (pin && isControl(names_, pin)) continue;
    if (pin && pinNamed(graph_.elements[element], names_.string(pin), PinDirection::InOut) != nullptr) continue;
    const PinSignature* known = pin ? signature.find(names_, pin) : nullptr;
    if (known == nullptr || known->direction == PinDirection::Input) return s;
  }
  return kNone;
}

//   fails   a pin that the block does not have        E1004
bool Scheduler::fillArguments(uint32_t element, Call& call) {
  const Element& e = graph_.elements[element];
  const SignatureKind kind = call.signature.kind;
  const bool known = kind == SignatureKind::Instance || kind == SignatureKind::Function ||
                     kind == SignatureKind::Method || kind == SignatureKind::Program;
  const bool named = (known || e.operand || e.hidden) && bindsByName(tree_, names_, e, call.signature);
  bool ok = true;
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    if (pin.direction == PinDirection::Output || pin.wires.empty()) continue;
    if (isControl(names_, pin.name.name) && call.signature.find(names_, pin.name.name) == nullptr) {
      call.en = graph_.isAlwaysTrue(pin) ? nullptr : &pin;
      continue;
    }
    if (known && named && !hasPin(names_, call.signature, pin.name)) {
      std::string_view near;
      std::vector<std::string_view> candidates;
      for (const PinSignature& candidate : call.signature.pins)
        if (candidate.direction != PinDirection::Output) candidates.push_back(names_.string(candidate.name));
      near = nearest(names_.string(pin.name.name), candidates);
      diagnostics_
          .report(diag::NoSuchPin, pin.name.loc, {describe(tree_, names_, e), "input", names_.string(pin.name.name)})
          .didYouMean(near);
      ok = false;
      continue;
    }
    const ExprId value = valueOf(e, pin);
    const Loc loc = pin.name.loc;
    call.arguments.push_back({named ? pin.name : Ident{{}, loc}, value, false, false, loc});
  }
  return ok;
}

// The value of an output of a box that was called, or that keeps the value of the last cycle.
//   fails   an output that the block does not have                                     E1004
//   fails   an operator or function that is read before it runs                        E1013
ExprId Scheduler::readBox(uint32_t source) {
  const Source s = graph_.sources[source];
  const Element& e = graph_.elements[s.element];
  const Loc loc = s.pin.loc ? s.pin.loc : e.loc;
  if (const DiagramPin* wired = s.pin.name ? pinNamed(e, names_.string(s.pin.name), PinDirection::InOut) : nullptr;
      wired != nullptr && !wired->wires.empty())  // the wire of an in-out continues after the box
    return read(graph_.sourceOf(*wired, 0));
  if (failed_[s.element]) return build_.error(loc);
  if (keepsState(e)) {
    const ExprId instance = e.operand ? clone(tree_, e.operand) : build_.name(e.hidden, e.loc);
    const Signature signature = e.operand ? signatures_.of(e.operand) : signatures_.of(e.hidden);
    NameId pin = s.pin.name;
    if (signature.kind == SignatureKind::Instance) {
      const PinSignature* known = pin ? signature.find(names_, pin) : nullptr;
      if (!pin) {  // the first output
        for (const PinSignature& candidate : signature.pins)
          if (known == nullptr && candidate.direction == PinDirection::Output) known = &candidate;
        if (known != nullptr) pin = known->name;
      }
      if (known == nullptr) {
        std::vector<std::string_view> candidates;
        for (const PinSignature& candidate : signature.pins) candidates.push_back(names_.string(candidate.name));
        diagnostics_.report(diag::NoSuchPin, loc, {describe(tree_, names_, e), "output", names_.string(pin)})
            .didYouMean(nearest(names_.string(pin), candidates));
        return build_.error(loc);
      }
    }
    return build_.member(instance, pin, loc);
  }
  diagnostics_.report(diag::ReadBeforeExecution, loc, {describe(tree_, names_, e)});
  return build_.error(loc);
}

// If the value of a box has one reader, and that is a variable which may be assigned now: its element; else kNone.
uint32_t Scheduler::soleTarget(uint32_t source) const {
  if (source == kNone || graph_.sources[source].uses != 1 || graph_.sources[source].temporary) return kNone;
  const uint32_t user = graph_.sources[source].user, element = graph_.sources[source].element;
  const Element& e = graph_.elements[user];
  if (e.kind != ElementKind::Output || isModified(e) || walk_->isResolved(user)) return kNone;
  const DiagramPin* out = graph_.outputPin(source);
  if (out != nullptr && isModified(*out)) return kNone;
  if (e.order != 0 && (graph_.elements[element].order == 0 || order_of_[user] != order_of_[element] + 1)) return kNone;
  return graph_.isTarget(user) && !isModified(*graph_.inputPin(user)) ? user : kNone;
}

// Passes the `value` of the box to its readers: now, as a temporary, or as a part of the only reader's expression.
void Scheduler::giveResult(uint32_t element, uint32_t result, ExprId value) {
  Source& s = graph_.sources[result];
  const Element& e = graph_.elements[element];
  s.pending = value;
  s.height = heightOf(e);
  const bool in_order = e.order == 0 || (order_of_[s.user] != kNone && order_of_[s.user] == order_of_[element] + 1);
  if (!s.temporary && s.uses == 1 && in_order && s.height < kMaxHeight) {
    if (hasCall(tree_, value)) calls_open_.push_back(result);
    notePending(result);
    return;
  }
  keep(result, wireName(element));
}

// Where a box that may not run writes `result`: a variable, or what its readers read.
ExprId Scheduler::targetOf(uint32_t element, uint32_t result) {
  const Loc loc = graph_.elements[element].loc;
  if (const uint32_t user = soleTarget(result); user != kNone) {
    assigned_[user] = true;
    return operandOf(user);
  }
  if (result == kNone) return build_.name(newTemporary(wireName(element), loc), loc);
  Source& s = graph_.sources[result];
  if (!s.temporary) s.temporary = newTemporary(wireName(element), loc);
  return build_.name(s.temporary, loc);
}

bool Scheduler::hasTargets(uint32_t element) const {
  for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next)
    if (target_of_[s] && !(graph_.sources[s].pin.name && isControl(names_, graph_.sources[s].pin.name))) return true;
  return false;
}

// Variables that read the outputs of the box keep their values while `condition` is FALSE.
void Scheduler::guard(uint32_t element, NameId condition) {
  for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
    const NameId pin = graph_.sources[s].pin.name;
    if (pin && (isControl(names_, pin) || pinNamed(graph_.elements[element], names_.string(pin), PinDirection::InOut)))
      continue;
    graph_.sources[s].guard = condition;
  }
}

//   fails   an unconnected input                  E1007
bool Scheduler::checkOperands(uint32_t element, const Call& call) {
  const Element& e = graph_.elements[element];
  const bool pair = call.op->form == Form::Chain || call.op->form == Form::Pair;
  const size_t least = pair ? 2 : 1;
  std::string open;
  Loc loc = e.loc;
  size_t inputs = 0;
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    if (pin.direction == PinDirection::Output || isControl(names_, pin.name.name)) continue;
    ++inputs;
    if (!pin.wires.empty() || !open.empty()) continue;
    open = names_.string(pin.name.name);
    loc = pin.name.loc;
  }
  if (open.empty() && inputs < least) open = pair ? "IN" + std::to_string(inputs + 1) : "IN";
  if (open.empty() && (call.op->form == Form::Chain || inputs == least)) return true;
  const std::string what = open.empty() ? "all inputs" : "`" + open + "`";
  diagnostics_.report(diag::NotWired, loc, {what + " of " + describe(tree_, names_, e)});
  return false;
}

void Scheduler::resolveOperator(uint32_t element, Call& call) {
  const Element& e = graph_.elements[element];
  failed_[element] = !checkOperands(element, call);
  if (failed_[element]) return;
  const uint32_t eno = graph_.find(element, names_.intern(kEnableOutput));
  const uint32_t result = resultOf(element, {});
  const bool reads_eno = eno != kNone && graph_.sources[eno].uses > 0;
  if (reads_eno && call.op->form == Form::Pair &&
      (call.op->op == BinaryOp::Divide || call.op->op == BinaryOp::Modulo)) {
    for (size_t k = 0; k < call.arguments.size(); ++k)
      call.arguments[k].pin.name = names_.intern("IN" + std::to_string(k + 1));
    const std::string_view name = call.op->op == BinaryOp::Divide ? "DIV" : "MOD";
    call.callee = build_.name(names_.intern(name), tree_.loc(e.path));
    return callWithEno(element, call, eno, result);
  }
  ExprId value = call.arguments[0].value;
  if (call.op->form == Form::Invert) value = inverted(value, e.loc);
  for (size_t k = 1; k < call.arguments.size(); ++k)
    value = build_.binary(call.op->op, value, call.arguments[k].value, e.loc);

  if (call.en == nullptr) {
    if (eno != kNone) keep(eno, build_.boolean(true, e.loc), wireName(element) + "_ENO");
    if (result != kNone) return giveResult(element, result, value);
    const NameId unread = newTemporary(wireName(element), e.loc);
    return assign(build_.name(unread, e.loc), value, e.loc);
  }
  ExprId condition = valueOf(e, *call.en);
  const bool guards = soleTarget(result) == kNone && hasTargets(element);
  if (eno != kNone) {
    keep(eno, condition, wireName(element) + "_ENO");
    condition = plainValue(eno);
    if (guards) guard(element, graph_.sources[eno].temporary);
  } else if (guards) {
    const NameId name = keptEnable(element, condition);
    guard(element, name);
    condition = build_.name(name, e.loc);
  }
  const ExprId target = targetOf(element, result);
  conditional(condition, e.loc, build_.assign(AssignOp::Assign, target, value, e.loc));
}

NameId Scheduler::keptEnable(uint32_t element, ExprId condition) {
  const Loc loc = graph_.elements[element].loc;
  const NameId name = newTemporary(wireName(element) + "_EN", loc);
  assign(build_.name(name, loc), condition, loc);
  return name;
}

// `target := callee(EN := en, arguments, ENO => eno)`
void Scheduler::callWithEno(uint32_t element, Call& call, uint32_t eno, uint32_t result) {
  const Element& e = graph_.elements[element];
  addControl(element, call, eno);
  const ExprId value = build_.call(call.callee, call.arguments, e.loc);
  if (soleTarget(result) == kNone) guard(element, graph_.sources[eno].temporary);
  assign(targetOf(element, result), value, e.loc);
}

// The arguments for EN and ENO.
void Scheduler::addControl(uint32_t element, Call& call, uint32_t eno) {
  const Element& e = graph_.elements[element];
  if (call.en != nullptr) {
    const Ident& name = call.en->name;
    call.arguments.insert(call.arguments.begin(), {name, valueOf(e, *call.en), false, false, name.loc});
  }
  if (eno == kNone || graph_.sources[eno].uses == 0) return;
  Source& s = graph_.sources[eno];
  if (!s.temporary) s.temporary = newTemporary(wireName(element) + "_ENO", e.loc);
  call.arguments.push_back({s.pin, build_.name(s.temporary, s.pin.loc), true, false, s.pin.loc});
}

// The call of an instance, or of a POU without result.
void Scheduler::resolveCall(uint32_t element, Call& call) {
  const Element& e = graph_.elements[element];
  const uint32_t eno = graph_.find(element, names_.intern(kEnableOutput));
  const bool reads_eno = eno != kNone && graph_.sources[eno].uses > 0;
  const bool function = call.signature.kind == SignatureKind::Function ||
                        call.signature.kind == SignatureKind::Method || call.signature.kind == SignatureKind::Unknown;
  const bool has_result = function && (call.signature.kind == SignatureKind::Unknown || call.signature.has_result);
  const uint32_t result = has_result ? resultOf(element, call.signature) : kNone;
  addControl(element, call, eno);
  bool outputs = false;
  for (uint32_t s = function ? graph_.first_source[element] : kNone; s != kNone; s = graph_.sources[s].next) {
    if (s == result || s == eno || graph_.sources[s].uses == 0) continue;
    if (pinNamed(e, names_.string(graph_.sources[s].pin.name), PinDirection::InOut) != nullptr) continue;
    Source& source = graph_.sources[s];
    if (!source.temporary)
      source.temporary = newTemporary(wireName(element) + "_" + std::string(names_.string(source.pin.name)), e.loc);
    call.arguments.push_back({source.pin, build_.name(source.temporary, source.pin.loc), true, false, source.pin.loc});
    outputs = true;
  }
  // The body of a function may set ENO to FALSE, after which its variables keep their values, so none takes the result.
  if (function && reads_eno && result != kNone && !graph_.sources[result].temporary)
    graph_.sources[result].temporary = newTemporary(wireName(element), e.loc);
  const bool sole = soleTarget(result) != kNone;
  if (reads_eno) {
    guard(element, graph_.sources[eno].temporary);
  } else if (call.en != nullptr && (!function || outputs || !sole) && hasTargets(element)) {
    const NameId name = keptEnable(element, call.arguments[0].value);
    call.arguments[0].value = build_.name(name, e.loc);
    guard(element, name);
  }
  const ExprId value = build_.call(call.callee, call.arguments, tree_.loc(call.callee));
  if (result == kNone) return emit(build_.callStatement(value));
  if (call.en != nullptr || reads_eno) return assign(targetOf(element, result), value, e.loc);
  if (outputs) return keep(result, value, wireName(element));
  giveResult(element, result, value);
}

// Forbids a box of a block that is not that of its variable.
//   fails   box 1 TOF (t) […];  with t : TON          E1019
bool Scheduler::checkBlock(const DiagramElement& e) {
  if (!e.path || signatures_.fits(e.operand, e.path)) return true;
  const std::string_view block = names_.string(e.name.name);
  diagnostics_.report(diag::OtherBlock, e.name.loc, {block});
  return false;
}

void Scheduler::resolveBox(uint32_t element) {
  const Element& e = graph_.elements[element];
  Call call;
  if (!e.path && !e.operand) return;
  if (isOperator(e)) {
    call.op = operatorNamed(names_.string(e.name.name));
    if (fillArguments(element, call)) resolveOperator(element, call);
    return;
  }
  if (e.operand && !checkBlock(e)) {
    failed_[element] = true;
    return;
  }
  call.signature = signatureOf(signatures_, e, e.hidden);
  if (!fillArguments(element, call)) {
    failed_[element] = true;
    return;
  }
  call.callee = e.operand ? operandOf(element) : e.hidden ? build_.name(e.hidden, e.loc) : e.path;
  resolveCall(element, call);
}

}  // namespace rung::diagram

// Boxes: operators become expressions, everything else calls. A function with one reader becomes part of the reader's
// expression; a function block is called at its place in the execution order and its outputs are read from the
// instance.
// EN of a function with one target guards the assignment: `IF en THEN c := c + 1; END_IF`. Other readers of its result
// see a temporary that is 0 (the initial value) in cycles in which EN is FALSE.
#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "frontend/schedule/diagnostics.h"
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

bool isControl(const Names& names, NameId pin) { return rung::isControl(names.string(pin)); }

}  // namespace

struct Scheduler::Call {
  Signature signature;
  ExprId callee;
  std::optional<Operator> op;
  std::vector<Argument> arguments;
  DiagramPin en{};
  bool has_en = false;
};

bool Scheduler::isOperator(const DiagramElement& e) const {
  return e.kind == ElementKind::Box && !e.operand && e.path && tree_.kind(e.path) == ExprKind::Name &&
         operatorNamed(names_.string(e.name.name)).has_value();
}

// The pin that a wire comes from; for a wire without a pin name the only one besides ENO.
const DiagramPin* Scheduler::outputNamed(const DiagramElement& e, const Ident& pin) const {
  if (pin.name) return pinNamed(e, names_.string(pin.name), PinDirection::Output);
  const DiagramPin* only = nullptr;
  for (const DiagramPin& candidate : tree_.list(e.pins)) {
    if (candidate.direction != PinDirection::Output || isControl(names_, candidate.name.name)) continue;
    if (only != nullptr) return nullptr;
    only = &candidate;
  }
  return only;
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

// Extensible pins are named IN3, IN4, …
bool Scheduler::hasPin(const Signature& signature, const Ident& pin) const {
  if (signature.find(names_, pin.name) != nullptr) return true;
  const std::string_view name = names_.string(pin.name);
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.back())) == 0) return false;
  return std::any_of(signature.pins.begin(), signature.pins.end(),
                     [](const PinSignature& known) { return known.extensible; });
}

//   fails   a pin that the block does not have        E1004
bool Scheduler::fillArguments(uint32_t element, Call& call) {
  const DiagramElement& e = graph_.elements[element];
  const SignatureKind kind = call.signature.kind;
  const bool known = kind == SignatureKind::Instance || kind == SignatureKind::Function ||
                     kind == SignatureKind::Method || kind == SignatureKind::Program;
  bool named = known || e.operand || e.hidden;
  // Some editors use different names for all pins.
  if (named && call.signature.kind == SignatureKind::Function) {
    bool any = false, all_unknown = true;
    for (const DiagramPin& pin : tree_.list(e.pins)) {
      if (pin.direction == PinDirection::Output || isControl(names_, pin.name.name)) continue;
      any = true;
      all_unknown = all_unknown && !hasPin(call.signature, pin.name);
    }
    named = !(any && all_unknown && !call.signature.pins.empty());
  }
  bool ok = true;
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    if (pin.direction == PinDirection::Output || pin.wires.empty()) continue;
    if (isControl(names_, pin.name.name) && call.signature.find(names_, pin.name.name) == nullptr) {
      call.en = pin;
      call.has_en = true;
      continue;
    }
    if (known && named && !hasPin(call.signature, pin.name)) {
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
  const DiagramElement& e = graph_.elements[s.element];
  const Loc loc = s.pin.loc ? s.pin.loc : e.loc;
  if (const DiagramPin* wired = s.pin.name ? pinNamed(e, names_.string(s.pin.name), PinDirection::InOut) : nullptr;
      wired != nullptr && !wired->wires.empty())  // the wire of an in-out continues after the box
    return read(graph_.sourceOf(*wired, 0));
  ExprId value;
  if (e.stored) return build_.name(e.stored, loc);
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
    value = build_.member(instance, pin, loc);
  } else {
    diagnostics_.report(diag::ReadBeforeExecution, loc, {describe(tree_, names_, e)});
    return build_.error(loc);
  }
  const DiagramPin* out = outputNamed(e, s.pin);
  return out != nullptr && out->negated ? inverted(value, loc) : value;
}

// If the value of a box has one reader, and that is a variable: its element; else kNone.
uint32_t Scheduler::soleTarget(uint32_t source) const {
  if (source == kNone || graph_.sources[source].uses != 1) return kNone;
  const uint32_t user = graph_.sources[source].user;
  const DiagramElement& e = graph_.elements[user];
  const bool plain = e.kind == ElementKind::Output && !e.negated && e.edge == EdgeKind::None &&
                     e.storage == PinStorage::None && phase_[user] != Phase::Resolved;
  if (!plain || (e.order != 0 && graph_.elements[graph_.sources[source].element].order == 0)) return kNone;
  const DiagramPin* pin = firstInput(e);
  return pin->wires.count == 1 && !pin->negated && pin->edge == EdgeKind::None ? user : kNone;
}

// Passes the `value` of the box to its readers: now, as a temporary, or as a part of the only reader's expression.
void Scheduler::giveResult(uint32_t element, uint32_t result, ExprId value) {
  Source& s = graph_.sources[result];
  const DiagramElement& e = graph_.elements[element];
  if (const DiagramPin* out = outputNamed(e, s.pin); out != nullptr && out->negated) value = inverted(value, e.loc);
  if (e.stored) {
    s.temporary = e.stored;
    return assign(build_.name(e.stored, e.loc), value, e.loc);
  }
  s.pending = value;
  s.height = heightOf(e);
  const bool in_order = e.order == 0 || (order_of_[s.user] != kNone && order_of_[s.user] == order_of_[element] + 1);
  if (s.uses == 1 && in_order && s.height < kMaxHeight) {
    if (hasCall(tree_, value)) calls_open_.push_back(result);
    return;
  }
  keep(result, wireName(element));
}

//   fails   an unconnected input                  E1007
void Scheduler::resolveOperator(uint32_t element, Call& call) {
  const DiagramElement& e = graph_.elements[element];
  const size_t least = call.op->form == Form::Chain || call.op->form == Form::Pair ? 2 : 1;
  const bool fits = call.op->form == Form::Chain ? call.arguments.size() >= 2 : call.arguments.size() == least;
  bool open = false;
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    if (pin.direction == PinDirection::Output || !pin.wires.empty() || isControl(names_, pin.name.name)) continue;
    if (!open)
      diagnostics_.report(diag::NotWired, pin.name.loc,
                          {"`" + std::string(names_.string(pin.name.name)) + "` of " + describe(tree_, names_, e)});
    open = true;
  }
  failed_[element] = open || !fits;
  if (open) return;
  if (!fits) {
    diagnostics_.report(diag::NotWired, e.loc, {"all inputs of " + describe(tree_, names_, e)});
    return;
  }
  ExprId value = call.arguments[0].value;
  if (call.op->form == Form::Invert) value = inverted(value, e.loc);
  for (size_t k = 1; k < call.arguments.size(); ++k)
    value = build_.binary(call.op->op, value, call.arguments[k].value, e.loc);

  const uint32_t eno = graph_.find(element, names_.intern(kEnableOutput));
  const uint32_t result = resultOf(element, {});
  if (!call.has_en) {
    if (eno != kNone) {
      graph_.sources[eno].pending = build_.boolean(true, e.loc);
      keep(eno, wireName(element) + "_ENO");
    }
    if (result != kNone) return giveResult(element, result, value);
    const NameId unread = newTemporary(wireName(element), e.loc);
    return assign(build_.name(unread, e.loc), value, e.loc);
  }
  ExprId condition = valueOf(e, call.en);
  if (eno != kNone) {
    graph_.sources[eno].pending = condition;
    keep(eno, wireName(element) + "_ENO");
    condition = read(eno);
  }
  ExprId target;
  if (const uint32_t user = soleTarget(result); user != kNone) {
    target = operandOf(user);
    assigned_[user] = true;
  } else {
    const NameId name = newTemporary(wireName(element), e.loc);
    if (result != kNone) graph_.sources[result].temporary = name;
    target = build_.name(name, e.loc);
  }
  conditional(condition, e.loc, build_.assign(AssignOp::Assign, target, value, e.loc));
}

// The call of an instance, or of a POU without result.
void Scheduler::resolveCall(uint32_t element, Call& call) {
  const DiagramElement& e = graph_.elements[element];
  const uint32_t eno = graph_.find(element, names_.intern(kEnableOutput));
  if (call.has_en) {
    const Loc loc = call.en.name.loc;
    call.arguments.insert(call.arguments.begin(), {call.en.name, valueOf(e, call.en), false, false, loc});
  }
  if (eno != kNone && graph_.sources[eno].uses > 0) {
    const NameId name = newTemporary(wireName(element) + "_ENO", e.loc);
    graph_.sources[eno].temporary = name;
    const Ident pin = graph_.sources[eno].pin;
    call.arguments.push_back({pin, build_.name(name, pin.loc), true, false, pin.loc});
  }
  const bool function = call.signature.kind == SignatureKind::Function ||
                        call.signature.kind == SignatureKind::Method || call.signature.kind == SignatureKind::Unknown;
  uint32_t result = kNone;
  bool outputs = eno != kNone;
  if (function) {
    result = call.signature.kind == SignatureKind::Unknown || call.signature.has_result
                 ? resultOf(element, call.signature)
                 : kNone;
    for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
      if (s == result || s == eno) continue;
      if (pinNamed(e, names_.string(graph_.sources[s].pin.name), PinDirection::InOut) != nullptr) continue;
      Source& source = graph_.sources[s];
      source.temporary = newTemporary(wireName(element) + "_" + std::string(names_.string(source.pin.name)), e.loc);
      const DiagramPin* out = pinNamed(e, names_.string(source.pin.name), PinDirection::Output);
      source.inverted = out != nullptr && out->negated;
      call.arguments.push_back(
          {source.pin, build_.name(source.temporary, source.pin.loc), true, false, source.pin.loc});
      outputs = true;
    }
  }
  const ExprId value = build_.call(call.callee, call.arguments, tree_.loc(call.callee));
  if (result == kNone) {
    emit(build_.callStatement(value));
    return;
  }
  if (call.has_en || outputs) {
    // If EN is FALSE, the target keeps its value.
    if (const uint32_t user = soleTarget(result); call.has_en && user != kNone) {
      assigned_[user] = true;
      return assign(operandOf(user), value, e.loc);
    }
    graph_.sources[result].pending = value;
    return keep(result, wireName(element));
  }
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
  const DiagramElement& e = graph_.elements[element];
  Call call;
  if (!e.path && !e.operand) return;
  if (isOperator(e)) {
    call.op = operatorNamed(names_.string(e.name.name));
    if (fillArguments(element, call)) resolveOperator(element, call);
    return;
  }
  if (e.operand) {
    if (!checkBlock(e)) {
      failed_[element] = true;
      return;
    }
    call.signature = signatures_.of(e.operand);
  } else if (e.hidden) {
    call.signature = signatures_.of(e.hidden);
  } else {
    call.signature = signatures_.of(e.path);
  }
  if (!fillArguments(element, call)) {
    failed_[element] = true;
    return;
  }
  call.callee = e.operand ? operandOf(element) : e.hidden ? build_.name(e.hidden, e.loc) : e.path;
  resolveCall(element, call);
}

}  // namespace rung::diagram

#include "frontend/schedule/network_schedule.h"

#include <algorithm>
#include <utility>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/network_scheduler.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/standard_names.h"

namespace rung::diagram {
namespace {

// The OR of this many wires or more is built as a balanced tree.
constexpr uint32_t kManyWires = 32;

}  // namespace

// ---- nodes

//   fails   an edge in a function        E1012
ExprId Scheduler::sensed(NameId sensor, ExprId value, Loc loc) {
  if (function_ != nullptr) {
    diagnostics_.report(diag::EdgeInFunction, loc, {function_});
    return value;
  }
  const Argument clk{{names_.intern("CLK"), loc}, value, false, false, loc};
  emit(build_.callStatement(build_.call(build_.name(sensor, loc), {&clk, 1}, loc)));
  return build_.member(build_.name(sensor, loc), names_.intern("Q"), loc);
}

// Pending values that contain calls are evaluated before another statement.
void Scheduler::emit(StmtId statement) {
  for (const uint32_t source : std::exchange(calls_open_, {}))
    if (graph_.sources[source].pending) keep(source, wireName(graph_.sources[source].element));
  out_.push_back(statement);
}

NameId Scheduler::newTemporary(const std::string& base, Loc loc) {
  Ident ident{names_.intern(base), loc};
  for (int k = 2; signatures_.of(ident.name).kind != SignatureKind::Unknown; ++k)
    ident.name = names_.intern(base + "_" + std::to_string(k));
  temporaries_.push_back(build_.variable(ident, {}));
  return ident.name;
}

std::string Scheduler::wireName(uint32_t element) const {
  const DiagramElement& e = graph_.elements[element];
  const std::string number = std::to_string(e.number);
  if (e.kind == ElementKind::Box && e.name.name) return std::string(names_.string(e.name.name)) + "_" + number;
  return "wire_" + number;
}

// Evaluates a source now, into a temporary.
void Scheduler::keep(uint32_t source, const std::string& base) {
  const Loc loc = graph_.elements[graph_.sources[source].element].loc;
  const NameId name = newTemporary(base, loc);
  const ExprId value = std::exchange(graph_.sources[source].pending, {});
  graph_.sources[source].temporary = name;
  graph_.sources[source].height = 1;
  assign(build_.name(name, loc), value, loc);
}

// ---- wires

const DiagramPin* Scheduler::firstInput(const DiagramElement& e) const {
  return e.pins.empty() ? nullptr : &tree_.list(e.pins)[0];
}

const DiagramPin* Scheduler::pinNamed(const DiagramElement& e, std::string_view name, PinDirection direction) const {
  for (const DiagramPin& pin : tree_.list(e.pins))
    if (pin.direction == direction && sameIdentifier(names_.string(pin.name.name), name)) return &pin;
  return nullptr;
}

bool Scheduler::isTrue(const DiagramPin& pin) const {
  for (uint32_t w = 0; w < pin.wires.count; ++w) {
    const uint32_t source = graph_.sourceOf(pin, w);
    if (graph_.elements[graph_.sources[source].element].kind == ElementKind::Rail) return true;
  }
  return false;
}

uint16_t Scheduler::heightOf(const DiagramElement& e) const {
  uint32_t height = 1;
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    const uint32_t joints = std::min(pin.wires.count, kManyWires);
    for (uint32_t w = 0; w < pin.wires.count; ++w)
      height = std::max<uint32_t>(height, graph_.sources[graph_.sourceOf(pin, w)].height + joints + 1);
  }
  return static_cast<uint16_t>(std::min<uint32_t>(height, UINT16_MAX));
}

ExprId Scheduler::joined(const DiagramPin& pin, uint32_t first, uint32_t count) {
  if (count > kManyWires) {
    const ExprId left = joined(pin, first, count / 2);
    return build_.binary(BinaryOp::Or, left, joined(pin, first + count / 2, count - count / 2), pin.name.loc);
  }
  ExprId value = read(graph_.sourceOf(pin, first));
  for (uint32_t w = 1; w < count; ++w) {
    const Loc loc = tree_.list(pin.wires)[first + w].loc;
    value = build_.binary(BinaryOp::Or, value, read(graph_.sourceOf(pin, first + w)), loc);
  }
  return value;
}

//   fails   two wires into one pin, neither from a contact, a coil or a rail                                   E1005
ExprId Scheduler::valueOf(const DiagramElement& e, const DiagramPin& pin) {
  if (pin.wires.empty()) return {};
  ExprId value;
  if (isTrue(pin)) {
    value = build_.boolean(true, e.loc);
  } else {
    if (pin.wires.count > 1 && language_ != NetworkLanguage::Ladder) {
      bool ladder = false;
      for (uint32_t w = 0; w < pin.wires.count; ++w) {
        const ElementKind from = graph_.elements[graph_.sources[graph_.sourceOf(pin, w)].element].kind;
        ladder = ladder || from == ElementKind::Contact || from == ElementKind::Coil;
      }
      if (!ladder) {
        const Loc loc = tree_.list(pin.wires)[1].loc;
        std::string where = describe(tree_, names_, e);
        if (pin.name.name) where = "pin `" + std::string(names_.string(pin.name.name)) + "` of " + where;
        diagnostics_.report(diag::WiresMeet, loc, {std::to_string(pin.wires.count), where});
      }
    }
    value = joined(pin, 0, pin.wires.count);
  }
  if (pin.edge != EdgeKind::None) value = sensed(pin.hidden, value, e.loc);
  return pin.negated ? inverted(value, e.loc) : value;
}

// The operand of an element as parsed; a copy from the second use on.
ExprId Scheduler::operandOf(uint32_t element) {
  const ExprId operand = graph_.elements[element].operand;
  if (failed_[element]) return build_.error(tree_.loc(operand));
  if (operand_taken_[element]) return clone(tree_, operand);
  operand_taken_[element] = true;
  return operand;
}

ExprId Scheduler::read(uint32_t source) {
  Source& s = graph_.sources[source];
  const DiagramElement& e = graph_.elements[s.element];
  if (s.temporary) {
    const ExprId value = build_.name(s.temporary, e.loc);
    return s.inverted ? inverted(value, e.loc) : value;
  }
  if (s.pending) return std::exchange(s.pending, {});
  switch (e.kind) {
    case ElementKind::Rail: return build_.boolean(true, e.loc);
    case ElementKind::Input:
    case ElementKind::InOut: {
      const ExprId value = operandOf(s.element);
      return e.negated && e.kind == ElementKind::Input ? inverted(value, e.loc) : value;
    }
    case ElementKind::Contact: {
      ExprId value = operandOf(s.element);
      if (e.negated) value = inverted(value, e.loc);
      const DiagramPin* pin = firstInput(e);
      if (pin == nullptr || pin->wires.empty() || isTrue(*pin)) return value;
      const ExprId left = valueOf(e, *pin);
      return build_.binary(BinaryOp::And, left, value, e.loc);
    }
    case ElementKind::Box:
    case ElementKind::Execute: return readBox(source);
    case ElementKind::Compose: return build_.name(e.hidden, e.loc);
    case ElementKind::Connector: {
      const DiagramPin& pin = *firstInput(e);
      return valueOf(e, pin);
    }
    case ElementKind::Coil:
    case ElementKind::Output:
    case ElementKind::Select:
    case ElementKind::RightRail:
    case ElementKind::Continuation:
    case ElementKind::Jump:
    case ElementKind::Label:
    case ElementKind::Return:
    case ElementKind::Comment: break;
  }
  // Not computed yet: possible only if it is later in the execution order.
  diagnostics_.report(diag::ReadBeforeExecution, e.loc, {describe(tree_, names_, e)});
  return build_.error(e.loc);
}

// ---- the walk

// Resolves `root` after everything that it reads.
void Scheduler::visit(uint32_t root) {
  while (phase_[root] == Phase::New) {  // again when a box in a loop with it had to run first
    push(root, false);
    while (!stack_.empty()) {
      const uint32_t next = graph_.nextInput(stack_.back());
      if (next == kNone) {
        const uint32_t done = stack_.back().element;
        stack_.pop_back();
        phase_[done] = Phase::Resolved;
        resolve(done);
      } else if (phase_[next] == Phase::New && graph_.elements[next].order == 0) {
        push(next, false);
      } else if (phase_[next] == Phase::Busy && graph_.elements[next].order == 0 &&
                 !keepsState(graph_.elements[next])) {  // otherwise its value of the last cycle is read
        breakCycle(next);
      }
    }
  }
}

void Scheduler::push(uint32_t element, bool begins) {
  phase_[element] = Phase::Busy;
  stack_.push_back({element, 0, 0, begins});
}

// Breaks a feedback loop: `first` is connected to itself through the elements above it on the stack. A box that keeps
// its value runs first: one that already had to, or the last one before `first`. The elements above `first` are visited
// again later.
//   fails   a loop without such a box        E1006
void Scheduler::breakCycle(uint32_t first) {
  uint32_t keeper = kNone, begun = kNone;
  for (;;) {
    const Frame frame = stack_.back();
    stack_.pop_back();
    phase_[frame.element] = Phase::New;
    if (frame.element == first) break;
    if (keepsState(graph_.elements[frame.element])) keeper = frame.element;
    if (frame.begins) begun = frame.element;
  }
  const uint32_t begin = begun != kNone ? begun : keeper;
  if (begin != kNone) {
    if (!stack_.empty()) --stack_.back().wire;  // of `first`, which comes next
    return push(begin, true);
  }
  const DiagramElement& e = graph_.elements[first];
  diagnostics_.report(diag::WireLoop, e.loc);
  phase_[first] = Phase::Resolved;
  for (uint32_t s = graph_.first_source[first]; s != kNone; s = graph_.sources[s].next)
    graph_.sources[s].temporary = newTemporary("wire_" + std::to_string(e.number), e.loc);
}

void Scheduler::resolve(uint32_t element) {
  switch (graph_.elements[element].kind) {
    case ElementKind::Contact: return resolveContact(element);
    case ElementKind::Connector: return resolveConnector(element);
    case ElementKind::Coil:
    case ElementKind::Output:
    case ElementKind::InOut: return resolveAssignment(element);
    case ElementKind::Box: return resolveBox(element);
    case ElementKind::Execute: return resolveExecute(element);
    case ElementKind::Jump:
    case ElementKind::Label:
    case ElementKind::Return: return resolveJump(element);
    case ElementKind::Compose:
    case ElementKind::Select: return resolveComposer(element);
    case ElementKind::Input: {
      const uint32_t source = graph_.first_source[element];
      const DiagramElement& e = graph_.elements[element];
      if (source == kNone || graph_.sources[source].uses < 2 || !hasCall(tree_, e.operand)) return;
      graph_.sources[source].pending = read(source);
      keep(source, wireName(element));
      return;
    }
    case ElementKind::Rail:
    case ElementKind::RightRail:
    case ElementKind::Continuation:
    case ElementKind::Comment: return;
  }
}

// Whether the variable of a contact may be read wherever its wire is read: nothing in its network changes it.
bool Scheduler::readable(uint32_t element) {
  const DiagramElement& e = graph_.elements[element];
  const DiagramPin* pin = firstInput(e);
  if (e.edge != EdgeKind::None || (pin != nullptr && !isTrue(*pin))) return false;
  if (tree_.kind(e.operand) != ExprKind::Name || network_calls_[graph_.network[element]]) return false;
  const std::pair key{graph_.network[element], names_.key(tree_.as<NameExpr>(e.operand).name).index};
  return !std::binary_search(written_.begin(), written_.end(), key);
}

//   fails   an unconnected contact        E1007
void Scheduler::resolveContact(uint32_t element) {
  const DiagramElement& e = graph_.elements[element];
  const DiagramPin* pin = firstInput(e);
  if (pin == nullptr || pin->wires.empty()) diagnostics_.report(diag::NotWired, e.loc, {describe(tree_, names_, e)});
  const uint32_t source = graph_.first_source[element];
  if (e.edge != EdgeKind::None) {
    ExprId value = operandOf(element);
    if (e.negated) value = inverted(value, e.loc);
    value = sensed(e.hidden, value, e.loc);
    if (source == kNone) return;
    if (pin != nullptr && !pin->wires.empty() && !isTrue(*pin)) {
      const ExprId left = valueOf(e, *pin);
      value = build_.binary(BinaryOp::And, left, value, e.loc);
    }
    graph_.sources[source].pending = value;
  }
  if (source == kNone) return;
  Source& s = graph_.sources[source];
  s.height = heightOf(e);
  if ((s.uses < 2 || readable(element)) && s.height < kMaxHeight) return;
  if (!s.pending) s.pending = read(source);
  if (s.uses > 0) keep(source, wireName(element));
}

// Joined wires.
void Scheduler::resolveConnector(uint32_t element) {
  const uint32_t source = graph_.first_source[element];
  if (source == kNone) return;
  Source& s = graph_.sources[source];
  s.height = heightOf(graph_.elements[element]);
  if (s.uses < 2 && s.height < kMaxHeight) return;
  s.pending = read(source);
  keep(source, wireName(element));
}

void Scheduler::assignTo(const DiagramElement& e, ExprId value) {
  const auto element = static_cast<uint32_t>(&e - graph_.elements.data());
  if (e.edge != EdgeKind::None) value = sensed(e.hidden, value, e.loc);
  if (e.negated) value = inverted(value, e.loc);
  const ExprId target = operandOf(element);
  const AssignOp op = e.storage == PinStorage::Set     ? AssignOp::Set
                      : e.storage == PinStorage::Reset ? AssignOp::Reset
                                                       : AssignOp::Assign;
  assign(target, value, e.loc, op);
}

//   warns   an unconnected coil or variable        W1018
void Scheduler::resolveAssignment(uint32_t element) {
  if (assigned_[element]) return;
  const DiagramElement& e = graph_.elements[element];
  const DiagramPin* pin = firstInput(e);
  if (pin == nullptr || pin->wires.empty()) {
    if (e.kind == ElementKind::InOut) return;
    diagnostics_.report(diag::NotWiredIdle, e.loc, {describe(tree_, names_, e)});
    return;
  }
  const uint32_t own = graph_.first_source[element];
  ExprId value = valueOf(e, *pin);
  if (own != kNone && graph_.sources[own].uses > 0 && e.kind != ElementKind::InOut) {  // the wire continues after it
    graph_.sources[own].pending = value;
    keep(own, wireName(element));
    value = read(own);
  }
  // A set or negated output of a box applies to the variable connected to it.
  if (pin->wires.count == 1) {
    const Source& s = graph_.sources[graph_.sourceOf(*pin, 0)];
    const DiagramElement& from = graph_.elements[s.element];
    if (from.kind == ElementKind::Box) {
      const DiagramPin* out = outputNamed(from, s.pin);
      if (out != nullptr && out->storage != PinStorage::None && e.storage == PinStorage::None) {
        const AssignOp op = out->storage == PinStorage::Set ? AssignOp::Set : AssignOp::Reset;
        return assign(operandOf(element), value, e.loc, op);
      }
    }
  }
  assignTo(graph_.elements[element], value);
}

// A composer fills its structure; a selector reads the members of its input.
void Scheduler::resolveComposer(uint32_t element) {
  const DiagramElement& e = graph_.elements[element];
  for (const DiagramPin& pin : tree_.list(e.pins)) {
    if (pin.direction == PinDirection::Output || pin.wires.empty()) continue;
    const ExprId value = valueOf(e, pin);
    if (e.kind == ElementKind::Compose) {
      if (e.hidden)
        assign(build_.member(build_.name(e.hidden, e.loc), pin.name.name, pin.name.loc), value, pin.name.loc);
      continue;
    }
    for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
      const Ident member = graph_.sources[s].pin;
      graph_.sources[s].pending = build_.member(clone(tree_, value), member.name, member.loc);
      keep(s, wireName(element) + "_" + std::string(names_.string(member.name)));
    }
    return;
  }
  if (e.kind == ElementKind::Select) diagnostics_.report(diag::NotWired, e.loc, {describe(tree_, names_, e)});
}

void Scheduler::resolveExecute(uint32_t element) {
  const DiagramElement& e = graph_.elements[element];
  const DiagramPin* en = pinNamed(e, kEnable, PinDirection::Input);
  ExprId condition;
  if (en != nullptr && !en->wires.empty()) {
    condition = valueOf(e, *en);
  } else if (en == nullptr && !e.pins.empty() && tree_.list(e.pins)[0].direction == PinDirection::Input) {
    condition = valueOf(e, tree_.list(e.pins)[0]);
  }
  const uint32_t eno = graph_.first_source[element];
  if (eno != kNone) {
    graph_.sources[eno].pending = condition ? condition : build_.boolean(true, e.loc);
    keep(eno, wireName(element));
    if (condition) condition = read(eno);
  }
  if (!condition) {
    for (uint32_t k = 0; k < e.body.count; ++k) emit(tree_.list(e.body)[k]);
    return;
  }
  emit(build_.ifStatement(condition, tree_.list(e.body), e.loc, kConditionalOp));
}

void Scheduler::resolveJump(uint32_t element) {
  const DiagramElement& e = graph_.elements[element];
  if (e.kind == ElementKind::Label) {
    emit(build_.label(e.name));
    return;
  }
  const StmtId leave = e.kind == ElementKind::Jump ? build_.jump(e.name, e.name.loc) : build_.returnStatement(e.loc);
  const DiagramPin* pin = firstInput(e);
  if (pin == nullptr || pin->wires.empty() || (isTrue(*pin) && !e.negated)) return emit(leave);
  const ExprId condition = valueOf(e, *pin);
  conditional(e.negated ? inverted(condition, e.loc) : condition, e.loc, leave);
}

// Warns of two coils of one variable: the first has no effect. TM/TP manual 5.3.4.5.
//   passes  a set and a reset coil; coils with a jump between them
//   warns   two coils (q)        W1016
void Scheduler::checkCoils() {
  std::vector<std::pair<uint32_t, uint32_t>> coils;  // key of the name, element
  for (const uint32_t k : graph_.roots) {
    const DiagramElement& e = graph_.elements[k];
    if (e.kind == ElementKind::Jump || e.kind == ElementKind::Return) return;
    if (e.kind == ElementKind::Coil && e.storage == PinStorage::None && tree_.kind(e.operand) == ExprKind::Name)
      coils.emplace_back(names_.key(tree_.as<NameExpr>(e.operand).name).index, k);
  }
  std::stable_sort(coils.begin(), coils.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (size_t k = 1; k < coils.size(); ++k) {
    if (coils[k].first != coils[k - 1].first) continue;
    const DiagramElement& e = graph_.elements[coils[k].second];
    diagnostics_.report(diag::DuplicateCoil, tree_.loc(e.operand), {names_.string(tree_.as<NameExpr>(e.operand).name)})
        .note(tree_.loc(graph_.elements[coils[k - 1].second].operand), diag::OtherCoil);
  }
}

// Warns of a holding coil of a variable that is not retained. TM/TP manual 5.3.4.
//   warns   coil HOLDING (q) with q declared in VAR        W1015
void Scheduler::checkHolding(const PouDecl& pou) {
  for (const DiagramElement& e : graph_.elements) {
    if (!e.holding || tree_.kind(e.operand) != ExprKind::Name) continue;
    const NameId name = tree_.as<NameExpr>(e.operand).name;
    for (const DeclId s : tree_.list(pou.sections)) {
      const SectionDecl& section = tree_.as<SectionDecl>(s);
      if ((section.h.bits & (kRetain | kPersistent)) != 0 || section.section == SectionKind::External) continue;
      for (const DeclId v : tree_.list(section.vars))
        for (const Ident& declared : tree_.list(tree_.as<VarDecl>(v).names))
          if (names_.same(declared.name, name))
            diagnostics_.report(diag::CoilNotRetained, tree_.loc(e.operand), {names_.string(name)})
                .declaredHere(declared.loc);
    }
  }
}

// Forbids contacts and coils of variables of another type than BOOL. IEC 61131-3 ed. 3, 8.2.
//   fails   coil 3 (n) := 2;  with n : INT          E1020
void Scheduler::checkBooleans() {
  for (uint32_t k = 0; k < graph_.elements.size(); ++k) {
    const DiagramElement& e = graph_.elements[k];
    if ((e.kind != ElementKind::Contact && e.kind != ElementKind::Coil) || !e.operand) continue;
    const std::string type = signatures_.typeUnlessBool(e.operand);
    if (type.empty()) continue;
    failed_[k] = true;
    diagnostics_.report(diag::NoBoolean, tree_.loc(e.operand), {describe(tree_, names_, e), type});
  }
}

ScheduledBody Scheduler::run(const PouDecl& pou) {
  const Diagram& diagram = pou.diagram;
  language_ = diagram.language;
  if (pou.pou_kind == PouKind::Function) function_ = "a function";
  if (!graph_.build(tree_, names_, diagnostics_, diagram)) return {};
  checkCoils();
  checkHolding(pou);
  const size_t count = graph_.elements.size();
  phase_.assign(count, Phase::New);
  operand_taken_.assign(count, false);
  assigned_.assign(count, false);
  failed_.assign(count, false);
  checkBooleans();
  network_calls_.assign(count, false);
  order_of_.assign(count, kNone);
  for (uint32_t k = 0; k < graph_.roots.size(); ++k) order_of_[graph_.roots[k]] = k;
  for (uint32_t k = 0; k < count; ++k) {
    const DiagramElement& e = graph_.elements[k];
    if ((e.kind == ElementKind::Box && !isOperator(e)) || e.kind == ElementKind::Execute)
      network_calls_[graph_.network[k]] = true;
    const bool writes = e.kind == ElementKind::Coil || e.kind == ElementKind::Output || e.kind == ElementKind::InOut;
    if (!writes) continue;
    if (tree_.kind(e.operand) == ExprKind::Name)
      written_.emplace_back(graph_.network[k], names_.key(tree_.as<NameExpr>(e.operand).name).index);
    else
      network_calls_[graph_.network[k]] = true;  // possibly another view of the same memory
  }
  std::sort(written_.begin(), written_.end());
  for (const uint32_t root : graph_.roots) visit(root);
  return scheduledBody(tree_, out_, temporaries_);
}

ScheduledBody scheduleNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                               const PouDecl& pou) {
  return Scheduler(tree, names, diagnostics, signatures).run(pou);
}

}  // namespace rung::diagram

// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/network_schedule.h"

#include <algorithm>
#include <utility>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/network_scheduler.h"
#include "frontend/syntax/children.h"
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
  return outputOf(sensor, loc);
}

ExprId Scheduler::outputOf(NameId sensor, Loc loc) {
  return build_.member(build_.name(sensor, loc), names_.intern("Q"), loc);
}

// Pending values that contain calls are evaluated before another statement.
void Scheduler::emit(StmtId statement) {
  for (const uint32_t source : std::exchange(calls_open_, {}))
    if (graph_.sources[source].pending) keep(source, wireName(graph_.sources[source].element));
  keepReadersOf(statement);
  out_.push_back(statement);
}

// A box with one reader becomes part of the reader's expression, which comes later: no variable that it reads may be
// written in between. Blocks that write global variables are not seen.
void Scheduler::notePending(uint32_t source) {
  const auto visit = [&](const auto& self, ExprId expr) -> void {
    if (tree_.kind(expr) == ExprKind::Name) readers_[names_.key(tree_.as<NameExpr>(expr).name).index].push_back(source);
    forEachOperand(tree_, expr, [&](ExprId operand) { self(self, operand); });
  };
  visit(visit, graph_.sources[source].pending);
}

void Scheduler::keepReadersOf(ExprId written) {
  for (;;) {
    const ExprKind kind = tree_.kind(written);
    if (kind == ExprKind::Name) break;
    if (kind == ExprKind::Member)
      written = tree_.as<MemberExpr>(written).base;
    else if (kind == ExprKind::Index)
      written = tree_.as<IndexExpr>(written).base;
    else if (kind == ExprKind::Deref)
      written = tree_.as<DerefExpr>(written).base;
    else if (kind == ExprKind::BitAccess)
      written = tree_.as<BitAccessExpr>(written).base;
    else
      return;
  }
  const auto found = readers_.find(names_.key(tree_.as<NameExpr>(written).name).index);
  if (found == readers_.end()) return;
  for (const uint32_t source : std::exchange(found->second, {}))
    if (graph_.sources[source].pending) keep(source, wireName(graph_.sources[source].element));
}

void Scheduler::keepAllPending() {
  std::vector<uint32_t> all;
  for (const auto& [name, sources] : std::exchange(readers_, {})) all.insert(all.end(), sources.begin(), sources.end());
  std::sort(all.begin(), all.end());
  for (const uint32_t source : all)
    if (graph_.sources[source].pending) keep(source, wireName(graph_.sources[source].element));
}

void Scheduler::keepReadersOf(StmtId statement) {
  if (readers_.empty()) return;
  const auto call = [&](ExprId expr) {
    if (!expr || tree_.kind(expr) != ExprKind::Call) return;
    keepReadersOf(tree_.as<CallExpr>(expr).callee);
    for (const Argument& argument : tree_.list(tree_.as<CallExpr>(expr).arguments))
      if (argument.value) keepReadersOf(argument.value);  // an in-out, perhaps
  };
  switch (tree_.kind(statement)) {
    case StmtKind::Assign:
      keepReadersOf(tree_.as<AssignStmt>(statement).target);
      return call(tree_.as<AssignStmt>(statement).value);
    case StmtKind::Call: return call(tree_.as<CallStmt>(statement).call);
    case StmtKind::If:
      if (tree_.stmt(statement).op != kConditionalOp) return keepAllPending();
      for (const IfBranch& branch : tree_.list(tree_.as<IfStmt>(statement).branches))
        for (const StmtId inner : tree_.list(branch.body)) keepReadersOf(inner);
      return;
    case StmtKind::Error:
    case StmtKind::Empty:
    case StmtKind::Exit:
    case StmtKind::Continue:
    case StmtKind::Jump:
    case StmtKind::Return: return;
    case StmtKind::Case:
    case StmtKind::For:
    case StmtKind::While:
    case StmtKind::Repeat:
    case StmtKind::Try:
    case StmtKind::Label: return keepAllPending();
  }
}

NameId Scheduler::newTemporary(const std::string& base, Loc loc) {
  Ident ident{names_.intern(base), loc};
  for (int k = 2; signatures_.of(ident.name).kind != SignatureKind::Unknown; ++k)
    ident.name = names_.intern(base + "_" + std::to_string(k));
  temporaries_.push_back(build_.variable(ident, {}));
  return ident.name;
}

std::string Scheduler::wireName(uint32_t element) const {
  const Element& e = graph_.elements[element];
  const std::string number = std::to_string(e.number);
  if (e.kind == ElementKind::Box && e.name.name) return std::string(names_.string(e.name.name)) + "_" + number;
  return "wire_" + number;
}

void Scheduler::keep(uint32_t source, const std::string& base) {
  Source& s = graph_.sources[source];
  const Loc loc = graph_.elements[s.element].loc;
  if (!s.temporary) s.temporary = newTemporary(base, loc);
  s.height = 1;
  assign(build_.name(s.temporary, loc), std::exchange(s.pending, {}), loc);
}

void Scheduler::keep(uint32_t source, ExprId value, const std::string& base) {
  graph_.sources[source].pending = value;
  keep(source, base);
}

// ---- wires

const DiagramPin* Scheduler::pinNamed(const DiagramElement& e, std::string_view name, PinDirection direction) const {
  for (const DiagramPin& pin : tree_.list(e.pins))
    if (pin.direction == direction && sameIdentifier(names_.string(pin.name.name), name)) return &pin;
  return nullptr;
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
  if (graph_.isPowered(pin)) {
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
  if (pin.direction == PinDirection::InOut) return value;  // modifiers are an error
  if (pin.edge != EdgeKind::None) value = sensed(variables_.hidden(pin), value, e.loc);
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
  const DiagramPin* pin = graph_.outputPin(source);
  if (pin == nullptr || (!pin->negated && pin->edge == EdgeKind::None)) return plainValue(source);
  const Loc loc = graph_.elements[graph_.sources[source].element].loc;
  const ExprId value = pin->edge == EdgeKind::None ? plainValue(source) : outputOf(variables_.hidden(*pin), loc);
  return pin->negated ? inverted(value, loc) : value;
}

ExprId Scheduler::plainValue(uint32_t source) {
  Source& s = graph_.sources[source];
  const uint32_t element = s.element;
  const Element& e = graph_.elements[element];
  if (s.failed) return build_.error(e.loc);
  if (s.temporary) return build_.name(s.temporary, e.loc);
  if (s.pending) return std::exchange(s.pending, {});
  switch (e.kind) {
    case ElementKind::Rail: return build_.boolean(true, e.loc);
    case ElementKind::Input:
    case ElementKind::InOut: {
      const ExprId value = operandOf(element);
      return e.negated && e.kind == ElementKind::Input ? inverted(value, e.loc) : value;
    }
    case ElementKind::Contact: {
      ExprId value = operandOf(element);
      if (e.negated) value = inverted(value, e.loc);
      const DiagramPin* pin = graph_.inputPin(element);
      if (pin == nullptr || pin->wires.empty() || graph_.isAlwaysTrue(*pin)) return value;
      const ExprId left = valueOf(e, *pin);
      return build_.binary(BinaryOp::And, left, value, e.loc);
    }
    case ElementKind::Box:
    case ElementKind::Execute: return readBox(source);
    case ElementKind::Compose: return build_.name(e.hidden, e.loc);
    case ElementKind::Connector: {
      const ExprId value = valueOf(e, *graph_.inputPin(element));
      return e.negated ? inverted(value, e.loc) : value;
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

// The wire back of a feedback loop.
//   passes  boxes that wait for each other's values
//   fails   boxes that wait for each other's ENO; a loop in a function, which keeps nothing from call to call E1006
void Scheduler::readLastCycle(uint32_t source, uint32_t reader) {
  Source& s = graph_.sources[source];
  const bool is_eno = s.pin.name && isEnableOutput(names_.string(s.pin.name));
  if (s.failed || (function_ == nullptr && !is_eno)) return;
  s.failed = true;
  diagnostics_.report(diag::WireLoop, graph_.elements[reader].loc);
}

// Of a loop of elements none of which has a value from the last cycle.
//   fails   contacts that are connected to each other        E1006
void Scheduler::breakCycle(uint32_t first) {
  for (uint32_t s = graph_.first_source[first]; s != kNone; s = graph_.sources[s].next) {
    if (graph_.sources[s].failed) return;
    graph_.sources[s].failed = true;
  }
  diagnostics_.report(diag::WireLoop, graph_.elements[first].loc);
}

// Of outputs that are read: their edge detectors run when the element has run.
void Scheduler::detectEdges(uint32_t element) {
  for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
    const DiagramPin* pin = graph_.outputPin(s);
    if (pin == nullptr || pin->edge == EdgeKind::None || graph_.sources[s].uses == 0) continue;
    sensed(variables_.hidden(*pin), plainValue(s), graph_.elements[element].loc);
  }
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
      const Element& e = graph_.elements[element];
      if (source == kNone) return;
      if (e.edge != EdgeKind::None)
        graph_.sources[source].pending = sensed(e.hidden, plainValue(source), e.loc);
      else if (graph_.sources[source].uses < 2 || !hasCall(tree_, e.operand))
        return;
      return keep(source, plainValue(source), wireName(element));
    }
    case ElementKind::Rail:
    case ElementKind::RightRail:
    case ElementKind::Continuation:
    case ElementKind::Comment: return;
  }
}

// Tells whether the variable of a contact may be read wherever its wire is read: nothing in its network changes it.
bool Scheduler::readable(uint32_t element) {
  const Element& e = graph_.elements[element];
  const DiagramPin* pin = graph_.inputPin(element);
  if (e.edge != EdgeKind::None || (pin != nullptr && !graph_.isAlwaysTrue(*pin))) return false;
  if (tree_.kind(e.operand) != ExprKind::Name || network_calls_[graph_.network[element]]) return false;
  const std::pair key{graph_.network[element], names_.key(tree_.as<NameExpr>(e.operand).name).index};
  return !std::binary_search(written_.begin(), written_.end(), key);
}

//   fails   an unconnected contact        E1007
void Scheduler::resolveContact(uint32_t element) {
  const Element& e = graph_.elements[element];
  const DiagramPin* pin = graph_.inputPin(element);
  if (pin == nullptr || pin->wires.empty()) diagnostics_.report(diag::NotWired, e.loc, {describe(tree_, names_, e)});
  const uint32_t source = graph_.first_source[element];
  if (e.edge != EdgeKind::None) {
    ExprId value = operandOf(element);
    if (e.negated) value = inverted(value, e.loc);
    value = sensed(e.hidden, value, e.loc);
    if (source == kNone) return;
    if (pin != nullptr && !pin->wires.empty() && !graph_.isAlwaysTrue(*pin)) {
      const ExprId left = valueOf(e, *pin);
      value = build_.binary(BinaryOp::And, left, value, e.loc);
    }
    graph_.sources[source].pending = value;
  }
  if (source == kNone) return;
  Source& s = graph_.sources[source];
  s.height = heightOf(e);
  if ((s.uses < 2 || readable(element)) && s.height < kMaxHeight) return;
  if (s.uses > 0) keep(source, plainValue(source), wireName(element));
}

// Joined wires.
void Scheduler::resolveConnector(uint32_t element) {
  const uint32_t source = graph_.first_source[element];
  if (source == kNone) return;
  Source& s = graph_.sources[source];
  s.height = heightOf(graph_.elements[element]);
  const Element& e = graph_.elements[element];
  if (e.edge != EdgeKind::None) {
    const ExprId edge = sensed(e.hidden, valueOf(e, *graph_.inputPin(element)), e.loc);
    s.pending = e.negated ? inverted(edge, e.loc) : edge;
  } else if (s.uses < 2 && s.height < kMaxHeight) {
    return;
  }
  keep(source, plainValue(source), wireName(element));
}

void Scheduler::assignTo(uint32_t element, ExprId value, PinStorage storage, NameId guard) {
  const Element& e = graph_.elements[element];
  if (e.edge != EdgeKind::None) value = sensed(e.hidden, value, e.loc);
  if (e.negated) value = inverted(value, e.loc);
  const AssignOp op = storage == PinStorage::Set     ? AssignOp::Set
                      : storage == PinStorage::Reset ? AssignOp::Reset
                                                     : AssignOp::Assign;
  const StmtId statement = build_.assign(op, operandOf(element), value, e.loc);
  if (guard) return conditional(build_.name(guard, e.loc), e.loc, statement);
  emit(statement);
}

//   warns   an unconnected coil or variable        W1018
void Scheduler::resolveAssignment(uint32_t element) {
  if (assigned_[element]) return;
  const Element& e = graph_.elements[element];
  const DiagramPin* pin = graph_.inputPin(element);
  if (pin == nullptr || pin->wires.empty()) {
    if (e.kind == ElementKind::InOut) return;
    diagnostics_.report(diag::NotWiredIdle, e.loc, {describe(tree_, names_, e)});
    return;
  }
  const uint32_t own = graph_.first_source[element];
  ExprId value = valueOf(e, *pin);
  if (own != kNone && graph_.sources[own].uses > 0 && e.kind != ElementKind::InOut) {  // the wire continues after it
    keep(own, value, wireName(element));
    value = plainValue(own);
  }
  if (!graph_.isTarget(element)) return assignTo(element, value, storageOf(e), {});
  // A set or reset output applies to the variables connected to it.
  const uint32_t source = graph_.sourceOf(*pin, 0);
  const DiagramPin* out = graph_.outputPin(source);
  const bool takes = out != nullptr && e.storage == PinStorage::None && out->storage != PinStorage::None;
  assignTo(element, value, takes ? out->storage : storageOf(e), graph_.sources[source].guard);
}

// A coil that detects an edge and keeps its variable without one sets it. The manual has no such coil that negates.
PinStorage Scheduler::storageOf(const DiagramElement& e) const {
  const bool latches = edge_coils_ == EdgeCoils::Latch && e.kind == ElementKind::Coil && e.edge != EdgeKind::None &&
                       e.storage == PinStorage::None && !e.negated;
  return latches ? PinStorage::Set : e.storage;
}

// A composer fills its structure; a selector reads the members of its input.
void Scheduler::resolveComposer(uint32_t element) {
  const Element& e = graph_.elements[element];
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
      keep(s, build_.member(clone(tree_, value), member.name, member.loc),
           wireName(element) + "_" + std::string(names_.string(member.name)));
    }
    return;
  }
  if (e.kind == ElementKind::Select) diagnostics_.report(diag::NotWired, e.loc, {describe(tree_, names_, e)});
}

void Scheduler::resolveExecute(uint32_t element) {
  const Element& e = graph_.elements[element];
  const DiagramPin* en = pinNamed(e, kEnable, PinDirection::Input);
  if (en == nullptr) en = graph_.inputPin(element);
  ExprId condition;
  if (en != nullptr && !graph_.isAlwaysTrue(*en)) condition = valueOf(e, *en);
  const uint32_t eno = graph_.first_source[element];
  if (eno != kNone) {
    keep(eno, condition ? condition : build_.boolean(true, e.loc), wireName(element));
    if (condition) condition = plainValue(eno);
  }
  if (!condition) {
    for (uint32_t k = 0; k < e.body.count; ++k) emit(tree_.list(e.body)[k]);
    return;
  }
  emit(build_.ifStatement(condition, tree_.list(e.body), e.loc, kConditionalOp));
}

void Scheduler::resolveJump(uint32_t element) {
  const Element& e = graph_.elements[element];
  if (e.kind == ElementKind::Label) {
    emit(build_.label(e.name));
    return;
  }
  const StmtId leave = e.kind == ElementKind::Jump ? build_.jump(e.name, e.name.loc) : build_.returnStatement(e.loc);
  const DiagramPin* pin = graph_.inputPin(element);
  const bool always = pin == nullptr || pin->wires.empty() || graph_.isAlwaysTrue(*pin);
  if (always && !isModified(e)) return emit(leave);
  ExprId condition = valueOf(e, *pin);
  if (e.edge != EdgeKind::None) condition = sensed(e.hidden, condition, e.loc);
  conditional(e.negated ? inverted(condition, e.loc) : condition, e.loc, leave);
}

// Warns of two coils of one variable: the first has no effect. TM/TP manual 5.3.4.5.
//   passes  a set and a reset coil; coils with a jump between them
//   warns   two coils (q)        W1016
void Scheduler::checkCoils() {
  std::vector<std::pair<uint32_t, uint32_t>> coils;  // key of the name, element
  for (const uint32_t k : graph_.roots) {
    const Element& e = graph_.elements[k];
    if (e.kind == ElementKind::Jump || e.kind == ElementKind::Return) return;
    if (e.kind == ElementKind::Coil && storageOf(e) == PinStorage::None && tree_.kind(e.operand) == ExprKind::Name)
      coils.emplace_back(names_.key(tree_.as<NameExpr>(e.operand).name).index, k);
  }
  std::stable_sort(coils.begin(), coils.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (size_t k = 1; k < coils.size(); ++k) {
    if (coils[k].first != coils[k - 1].first) continue;
    const Element& e = graph_.elements[coils[k].second];
    diagnostics_.report(diag::DuplicateCoil, tree_.loc(e.operand), {names_.string(tree_.as<NameExpr>(e.operand).name)})
        .note(tree_.loc(graph_.elements[coils[k - 1].second].operand), diag::OtherCoil);
  }
}

// Warns of a holding coil of a variable that is not retained. TM/TP manual 5.3.4.
//   warns   coil HOLDING (q) with q declared in VAR        W1015
void Scheduler::checkHolding(const PouDecl& pou) {
  for (const Element& e : graph_.elements) {
    if (!e.holding || tree_.kind(e.operand) != ExprKind::Name) continue;
    const NameId name = tree_.as<NameExpr>(e.operand).name;
    for (const DeclId s : tree_.list(pou.sections)) {
      const SectionDecl& section = tree_.as<SectionDecl>(s);
      if (section.qualifiers.isKept() || section.section == SectionKind::External) continue;
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
    const Element& e = graph_.elements[k];
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
  if (!graph_.build(tree_, names_, diagnostics_, diagram, variables_)) return {};
  checkCoils();
  checkHolding(pou);
  const size_t count = graph_.elements.size();
  operand_taken_.assign(count, false);
  assigned_.assign(count, false);
  failed_.assign(count, false);
  target_of_.assign(graph_.sources.size(), false);
  for (uint32_t k = 0; k < count; ++k)
    if (graph_.isTarget(k)) target_of_[graph_.sourceOf(*graph_.inputPin(k), 0)] = true;
  checkModifiers();
  checkBooleans();
  for (uint32_t s = 0; s < graph_.sources.size(); ++s) {
    const DiagramPin* pin = graph_.sources[s].pin.name ? graph_.outputPin(s) : nullptr;
    graph_.sources[s].temporary =
        pin != nullptr ? variables_.stored(*pin) : graph_.elements[graph_.sources[s].element].stored;
  }
  network_calls_.assign(count, false);
  order_of_.assign(count, kNone);
  for (uint32_t k = 0; k < graph_.roots.size(); ++k) order_of_[graph_.roots[k]] = k;
  for (uint32_t k = 0; k < count; ++k) {
    const Element& e = graph_.elements[k];
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
  walk_.emplace(graph_);
  for (const uint32_t root : graph_.roots) walk_->run(root, Visitor{*this});
  return scheduledBody(tree_, out_, temporaries_);
}

std::vector<uint32_t> executionOrder(Tree& tree, Names& names, Diagnostics& diagnostics, const Diagram& diagram) {
  struct Visitor {
    const Graph& graph;
    std::vector<uint32_t>& order;
    void resolve(uint32_t element) {
      if (graph.runs(element)) order.push_back(element);
    }
    void readOrdered(uint32_t) {}
    void readLastCycle(uint32_t, uint32_t) {}
    void breakCycle(uint32_t) {}
  };
  Graph graph;
  std::vector<uint32_t> order;
  if (!graph.build(tree, names, diagnostics, diagram, {})) return order;
  ExecutionWalk walk(graph);
  for (const uint32_t root : graph.roots) walk.run(root, Visitor{graph, order});
  return order;
}

ScheduledBody scheduleNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                               const NetworkVariables& variables, EdgeCoils edge_coils, const PouDecl& pou) {
  return Scheduler(tree, names, diagnostics, signatures, variables, edge_coils).run(pou);
}

}  // namespace rung::diagram

// SPDX-License-Identifier: Apache-2.0
// Which modifiers the elements and pins of networks may have. docs/networks.md, "Modifiers", has the same table.
// Inputs apply theirs in Scheduler::valueOf(), outputs in Scheduler::read(), whatever the element is.
#include <algorithm>
#include <string>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/network_scheduler.h"
#include "frontend/syntax/diagram.h"

namespace rung::diagram {
namespace {

struct Allowed {
  bool logic;    // NOT, RISING, FALLING
  bool storage;  // SET, RESET
};

Allowed ofElement(const DiagramElement& e, bool wired) {
  switch (e.kind) {
    case ElementKind::Coil:
    case ElementKind::Output: return {true, true};
    case ElementKind::InOut: return {wired, wired};
    case ElementKind::Jump:
    case ElementKind::Return: return {wired, false};
    case ElementKind::Contact:
    case ElementKind::Input:
    case ElementKind::Connector: return {true, false};
    case ElementKind::Rail:
    case ElementKind::RightRail:
    case ElementKind::Box:
    case ElementKind::Continuation:
    case ElementKind::Label:
    case ElementKind::Execute:
    case ElementKind::Compose:
    case ElementKind::Select:
    case ElementKind::Comment: break;
  }
  return {false, false};
}

Allowed ofPin(ElementKind kind, PinDirection direction) {
  if (direction == PinDirection::InOut) return {false, false};
  const bool output = direction == PinDirection::Output;
  switch (kind) {
    case ElementKind::Contact:
    case ElementKind::Coil:
    case ElementKind::Box:
    case ElementKind::Output:
    case ElementKind::InOut:
    case ElementKind::Execute:
    case ElementKind::Select: return {true, output};
    case ElementKind::Input: return {output, output};
    case ElementKind::Compose:
    case ElementKind::Connector:
    case ElementKind::Jump:
    case ElementKind::Return: return {!output, false};
    case ElementKind::Rail:
    case ElementKind::RightRail:
    case ElementKind::Continuation:
    case ElementKind::Label:
    case ElementKind::Comment: break;
  }
  return {false, false};
}

// The words of the modifiers that are not allowed; empty: none.
template <class Modifiable>
std::string forbidden(const Modifiable& m, const Allowed& allowed) {
  std::string words;
  const auto add = [&](const char* word) { words += (words.empty() ? "" : " ") + std::string(word); };
  if (!allowed.logic) {
    if (m.negated) add("NOT");
    if (m.edge != EdgeKind::None) add(m.edge == EdgeKind::Rising ? "RISING" : "FALLING");
  }
  if (!allowed.storage) {
    if (m.storage != PinStorage::None) add(m.storage == PinStorage::Set ? "SET" : "RESET");
  }
  return words;
}

}  // namespace

// Forbids modifiers that do nothing. IEC 61131-3 ed. 3, tables 72, 74 and 75.
//   fails   box 4 ADD [IN1 SET := 1, IN2 := 2, OUT =>];  coil 5 (q) := 4(OUT);  jump 6 end NOT;          E1021
//   fails   box 4 ADD [IN1 := 1, IN2 := 2, OUT SET =>];  box 5 NOT [IN := 4(OUT), OUT =>];               E1021
void Scheduler::checkModifiers() {
  for (uint32_t k = 0; k < graph_.elements.size(); ++k) {
    Element& e = graph_.elements[k];
    const DiagramPin* input = graph_.inputPin(k);
    const std::string words = forbidden(e, ofElement(e, input != nullptr && !input->wires.empty()));
    if (!words.empty()) {
      diagnostics_.report(diag::ModifierIdle, e.loc, {words, describe(tree_, names_, e)});
      e.negated = false;
      e.edge = EdgeKind::None;
      e.storage = PinStorage::None;
    }
    for (const DiagramPin& pin : tree_.list(e.pins)) {
      Allowed allowed = ofPin(e.kind, pin.direction);
      if (pin.storage != PinStorage::None && allowed.storage) allowed.storage = isStored(k, pin);
      const std::string idle = forbidden(pin, allowed);
      if (idle.empty()) continue;
      const char* const side = pin.direction == PinDirection::Output  ? "output"
                               : pin.direction == PinDirection::InOut ? "in-out"
                                                                      : "input";
      std::string where = side;
      if (pin.name.name) where += " `" + std::string(names_.string(pin.name.name)) + "`";
      where += " of " + describe(tree_, names_, e);
      diagnostics_.report(diag::ModifierIdle, pin.name.loc ? pin.name.loc : e.loc, {idle, where});
    }
  }
}

// SET and RESET of an output apply to the variables that its wire leads to; without readers they wait for one.
bool Scheduler::isStored(uint32_t element, const DiagramPin& pin) const {
  bool read = false;
  for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
    if (graph_.outputPin(s) != &pin || graph_.sources[s].uses == 0) continue;
    if (target_of_[s]) return true;
    read = true;
  }
  return !read;
}

}  // namespace rung::diagram

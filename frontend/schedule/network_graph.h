// SPDX-License-Identifier: Apache-2.0
// The elements of one body and their connections. Private to frontend/schedule.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/schedule/network_elements.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/syntax/diagram.h"

namespace rung::diagram {

constexpr uint32_t kNone = UINT32_MAX;

// An element of a body, with the hidden variables that it works on and that keeps its value (network_variables.h).
struct Element : DiagramElement {
  NameId hidden, stored;
};

// The source of wires: an element, or one output of a box. Connectors are not sources: wires are followed through them.
struct Source {
  uint32_t element;
  Ident pin;      // of a box
  uint32_t next;  // source of the same element, or kNone
  uint32_t uses = 0;
  uint32_t user = kNone;  // the last element that reads it
  // Used by the scheduler:
  NameId temporary;     // holds the value: a temporary, or a variable that keeps it from cycle to cycle
  ExprId pending;       // … or this expression, which is read once
  NameId guard;         // FALSE: nothing was computed in this cycle, so variables keep their values
  bool failed = false;  // an error was reported, so readers report none
  uint16_t height = 1;
};

// A box whose outputs can be read before it is called: they have the values of the last cycle.
bool keepsState(const Element& e);
// Runs at its place in the execution order even if an expression could replace it.
bool runsInLoops(const DiagramElement& e);
// The modifiers of a pin or element.
template <class Modifiable>
bool isModified(const Modifiable& m) {
  return m.negated || m.edge != EdgeKind::None || m.storage != PinStorage::None;
}

// A visit of all elements connected to the inputs of one.
struct InputWalk {
  uint32_t element, pin, wire;
};

class Graph {
 public:
  // False: an error was reported.
  bool build(const Tree& tree, const Names& names, Diagnostics& diagnostics, const Diagram& diagram,
             const NetworkVariables& variables);

  std::vector<Element> elements;
  std::vector<Source> sources;
  std::vector<uint32_t> first_source;  // of each element, or kNone
  std::vector<uint32_t> network;       // by element: equal where wires connect them
  std::vector<uint32_t> roots;         // elements with an effect, in execution order
  bool ordered = false;                // the file gives an execution order

  uint32_t sourceOf(const DiagramPin& pin, uint32_t wire) const {
    return source_of_wire_[pin.wires.first + wire - first_wire_];
  }
  // The next source connected to an input, or kNone.
  uint32_t nextInput(InputWalk& walk) const;
  // The pin of a source; null: the element has no such pin, or it has no pins.
  const DiagramPin* outputPin(uint32_t source) const;
  // The pin that an element with one input reads; null: none.
  const DiagramPin* inputPin(uint32_t element) const;
  // One of its wires comes from a power rail.
  bool isPowered(const DiagramPin& pin) const;
  bool isAlwaysTrue(const DiagramPin& pin) const { return isPowered(pin) && !isModified(pin); }
  // Wires are followed through it.
  bool isLink(uint32_t element) const;
  // Has a place in the execution order: not a contact, an input or a connector.
  bool runs(uint32_t element) const;
  // Runs where the file's execution order says.
  bool isOrdered(uint32_t element) const;
  // A variable that takes the value of one wire as it is: with a guard it keeps its value.
  bool isTarget(uint32_t element) const;
  // The input EN of a function or operator, unless it is always TRUE; null: it always runs.
  const DiagramPin* enableOf(uint32_t element) const;
  // Of a feedback loop: in this loop `to` runs before `from`, so it reads the value of the last cycle.
  bool leadsBack(uint32_t from, uint32_t to) const;
  // The element to run before this one, because it is the first of a loop: itself, or one that is still new.
  template <class IsNew>
  uint32_t firstOfLoop(uint32_t element, const IsNew& isNew) const {
    uint32_t first = element;
    for (uint32_t k = loop_first_[element]; k != kNone; k = loop_around_[k])
      if (k != element && isNew(k)) first = k;
    return first;
  }
  uint32_t find(uint32_t element, NameId pin) const;  // a source, or kNone: without readers

 private:
  friend class LoopOrder;
  struct End {
    uint32_t element;  // kNone: an error was reported
    Ident pin;
  };
  End endOf(uint32_t link);
  uint64_t keyOf(uint32_t element, NameId pin) const {
    return (static_cast<uint64_t>(element) << 32) | (pin ? names_->key(pin).index : 0);
  }
  uint32_t sourceAt(uint32_t element, const Ident& pin);
  bool connect();
  void separate();
  void orderLoops();
  void sortRoots();
  void checkExecutionOrder();
  void exclude(const Diagram& diagram);
  std::string nameOf(const DiagramElement& e) const { return describe(*tree_, *names_, e); }

  const Tree* tree_ = nullptr;
  const Names* names_ = nullptr;
  Diagnostics* diagnostics_ = nullptr;
  std::vector<End> ends_;  // of connectors and continuations
  std::unordered_map<uint64_t, uint32_t> by_pin_;
  std::vector<uint32_t> source_of_wire_;
  // The elements of a loop are numbered in a row; the first to run has the lowest number, and the end of the row.
  std::vector<uint32_t> loop_place_, loop_end_;
  std::vector<uint32_t> loop_first_, loop_around_;  // the first of the innermost loop; that of the loop around it
  uint32_t first_wire_ = 0;
};

}  // namespace rung::diagram

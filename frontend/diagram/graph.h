// The elements of one body and what their wires connect. Private to frontend/diagram.
#pragma once

#include <string>
#include <vector>

#include "frontend/diagram/elements.h"
#include "frontend/diagram/schedule.h"

namespace rung::diagram {

constexpr uint32_t kNone = UINT32_MAX;

// What wires come from: an element, of a box one of its outputs. Connectors are no sources: wires lead through them.
struct Source {
  uint32_t element;
  Ident pin;      // of a box
  uint32_t next;  // source of the same element, or kNone
  uint32_t uses = 0;
  uint32_t user = kNone;  // the last element that reads it
  // The scheduler's:
  NameId temporary;       // holds the value
  bool inverted = false;  // … negated
  ExprId pending;         // … or this expression is it, read once
  uint16_t height = 1;
};

// A box whose outputs can be read before it was called: they have the values of the last cycle.
bool keepsState(const DiagramElement& e);

class Graph {
 public:
  // False: an error was reported.
  bool build(Tree& tree, Names& names, Diagnostics& diagnostics, const Diagram& diagram);

  std::vector<DiagramElement> elements;
  std::vector<Source> sources;
  std::vector<uint32_t> first_source;  // of each element, or kNone
  std::vector<uint32_t> network;       // of each element: equal where wires connect them
  std::vector<uint32_t> roots;         // elements that do something, in the order in which they are asked to
  bool ordered = false;                // elements have turns of their own

  uint32_t sourceOf(const DiagramPin& pin, uint32_t wire) const {
    return source_of_wire_[pin.wires.first + wire - first_wire_];
  }
  uint32_t find(uint32_t element, NameId pin) const;  // a source, or kNone: nobody reads it

 private:
  bool isLink(uint32_t element) const;
  uint32_t followed(uint32_t element) const;
  void reportLink(uint32_t element);
  uint32_t sourceAt(uint32_t element, const Ident& pin);
  bool connect();
  void separate();
  void sortRoots();
  void checkTurns();
  void leaveOut(const Diagram& diagram);
  std::string nameOf(const DiagramElement& e) const { return describe(*tree_, *names_, e); }

  Tree* tree_ = nullptr;
  Names* names_ = nullptr;
  Diagnostics* diagnostics_ = nullptr;
  std::vector<uint32_t> source_of_wire_;
  uint32_t first_wire_ = 0;
};

}  // namespace rung::diagram

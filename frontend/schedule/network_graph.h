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

// The source of wires: an element, or one output of a box. Connectors are not sources: wires are followed through them.
struct Source {
  uint32_t element;
  Ident pin;      // of a box
  uint32_t next;  // source of the same element, or kNone
  uint32_t uses = 0;
  uint32_t user = kNone;  // the last element that reads it
  // Used by the scheduler:
  NameId temporary;       // holds the value
  bool inverted = false;  // … negated
  ExprId pending;         // … or this expression, which is read once
  uint16_t height = 1;
};

// A box whose outputs can be read before it is called: they have the values of the last cycle.
bool keepsState(const DiagramElement& e);

// A visit of all elements connected to the inputs of one.
struct InputWalk {
  uint32_t element, pin, wire;
};

class Graph {
 public:
  // False: an error was reported.
  bool build(Tree& tree, Names& names, Diagnostics& diagnostics, const Diagram& diagram);

  std::vector<DiagramElement> elements;
  std::vector<Source> sources;
  std::vector<uint32_t> first_source;  // of each element, or kNone
  std::vector<uint32_t> network;       // by element: equal where wires connect them
  std::vector<uint32_t> roots;         // elements with an effect, in execution order
  bool ordered = false;                // the file gives an execution order

  uint32_t sourceOf(const DiagramPin& pin, uint32_t wire) const {
    return source_of_wire_[pin.wires.first + wire - first_wire_];
  }
  // The next element connected to an input, or kNone.
  uint32_t nextInput(InputWalk& walk) const;
  uint32_t find(uint32_t element, NameId pin) const;  // a source, or kNone: without readers

 private:
  bool isLink(uint32_t element) const;
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
  void sortRoots();
  void checkExecutionOrder();
  void exclude(const Diagram& diagram);
  std::string nameOf(const DiagramElement& e) const { return describe(*tree_, *names_, e); }

  Tree* tree_ = nullptr;
  Names* names_ = nullptr;
  Diagnostics* diagnostics_ = nullptr;
  std::vector<End> ends_;  // of connectors and continuations
  std::unordered_map<uint64_t, uint32_t> by_pin_;
  std::vector<uint32_t> source_of_wire_;
  uint32_t first_wire_ = 0;
};

}  // namespace rung::diagram

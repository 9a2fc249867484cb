// SPDX-License-Identifier: Apache-2.0
// The walk through a body in the order in which it runs: everything that a root reads before it, the first element of a
// feedback loop before the others (docs/networks.md, "Execution order"). The scheduler, the search for values of the
// last cycle and pictures walk here, so they agree about the order. With an explicit stack: a chain of 100 000 contacts
// needs no recursion. Private to frontend/schedule.
#pragma once

#include <vector>

#include "frontend/schedule/network_graph.h"

namespace rung::diagram {

class ExecutionWalk {
 public:
  explicit ExecutionWalk(const Graph& graph) : graph_(graph), phase_(graph.elements.size(), Phase::New) {}

  // Calls of the visitor, with elements and sources of the graph:
  //   resolve(element)               all that it reads has been resolved
  //   readOrdered(source)            an element reads one that runs where the file says
  //   readLastCycle(source, reader)  … one that runs later in a feedback loop
  //   breakCycle(element)            … itself, and nothing on the way keeps a value
  template <class Visitor>
  void run(uint32_t root, Visitor&& visitor);

  bool isResolved(uint32_t element) const { return phase_[element] == Phase::Resolved; }

 private:
  enum class Phase : uint8_t { New, Busy, Resolved };
  struct Frame : InputWalk {
    uint32_t consumer;  // the element that the value is computed for, if that can be in a feedback loop
  };
  void push(uint32_t element, uint32_t consumer) {
    phase_[element] = Phase::Busy;
    stack_.push_back({{element, 0, 0}, consumer});
  }

  const Graph& graph_;
  std::vector<Phase> phase_;
  std::vector<Frame> stack_;
};

template <class Visitor>
void ExecutionWalk::run(uint32_t root, Visitor&& visitor) {
  const auto isNew = [&](uint32_t k) { return phase_[k] == Phase::New; };
  for (;;) {
    if (stack_.empty()) {
      if (!isNew(root)) return;
      const uint32_t first = graph_.firstOfLoop(root, isNew);
      push(first, first);
    }
    const uint32_t source = graph_.nextInput(stack_.back());
    if (source == kNone) {
      const uint32_t done = stack_.back().element;
      stack_.pop_back();
      phase_[done] = Phase::Resolved;
      visitor.resolve(done);
      continue;
    }
    const uint32_t next = graph_.sources[source].element, consumer = stack_.back().consumer;
    const bool begins = runsInLoops(graph_.elements[next]);
    if (graph_.isOrdered(next)) {
      visitor.readOrdered(source);
    } else if (phase_[next] == Phase::Resolved) {
      continue;
    } else if (begins && graph_.leadsBack(next, consumer)) {
      visitor.readLastCycle(source, consumer);
    } else if (phase_[next] == Phase::Busy) {
      visitor.breakCycle(next);
    } else if (const uint32_t first = graph_.firstOfLoop(next, isNew); first != next) {
      --stack_.back().wire;  // of `next`, which comes afterwards
      push(first, first);
    } else {
      push(next, begins ? next : consumer);
    }
  }
}

}  // namespace rung::diagram

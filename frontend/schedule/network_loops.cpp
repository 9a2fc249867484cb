// SPDX-License-Identifier: Apache-2.0
// Feedback loops of one body. The element of a loop that is farthest left runs first, without positions the first one
// in the file; the wires that lead back to it carry values of the last cycle. Where loops remain without it, each of
// them has a first element of its own. IEC 61131-3 ed. 3, 8.1.4 (feedback path); docs/networks.md, "Execution order" 4.
//   passes  boxes a to b to c to a: a, b, c
// Linear in the wires for each level of loops within loops; from kMaxLevels on all of a loop run from left to right.
#include <algorithm>
#include <tuple>
#include <utility>

#include "frontend/schedule/network_graph.h"
#include "frontend/syntax/diagram.h"

namespace rung::diagram {
namespace {

constexpr uint32_t kMaxLevels = 64;

}  // namespace

class LoopOrder {
 public:
  explicit LoopOrder(Graph& graph)
      : graph_(graph),
        scope_(graph.elements.size(), 0),
        index_(graph.elements.size(), 0),
        low_(graph.elements.size(), 0),
        on_stack_(graph.elements.size(), false) {
    graph_.loop_place_.assign(graph.elements.size(), kNone);
    graph_.loop_end_.assign(graph.elements.size(), 0);
    graph_.loop_first_.assign(graph.elements.size(), kNone);
    graph_.loop_around_.assign(graph.elements.size(), kNone);
  }

  void run() {
    Part all{{}, 0, 0};
    for (uint32_t k = 0; k < graph_.elements.size(); ++k)
      if (!graph_.isLink(k)) all.elements.push_back(k);
    open_.push_back(std::move(all));
    while (!open_.empty()) {
      const Part part = std::move(open_.back());
      open_.pop_back();
      divide(part);
    }
  }

 private:
  // Elements of one loop without its first one, to be searched for other loops.
  struct Part {
    std::vector<uint32_t> elements;
    uint32_t place, level;
  };

  // Tarjan's algorithm among the elements of the part, with an explicit stack.
  void divide(const Part& part) {
    ++scopes_;
    for (const uint32_t k : part.elements) {
      scope_[k] = scopes_;
      index_[k] = 0;
    }
    uint32_t place = part.place;
    for (const uint32_t root : part.elements) {
      if (index_[root] != 0) continue;
      enter(root);
      while (!walk_.empty()) {
        const uint32_t at = walk_.back().element;
        const uint32_t source = graph_.nextInput(walk_.back());
        if (source == kNone) {
          walk_.pop_back();
          if (!walk_.empty()) low_[walk_.back().element] = std::min(low_[walk_.back().element], low_[at]);
          if (low_[at] == index_[at]) close(at, place, part.level);
          continue;
        }
        const uint32_t from = graph_.sources[source].element;
        if (scope_[from] != scopes_ || graph_.isOrdered(from)) continue;
        if (index_[from] == 0)
          enter(from);
        else if (on_stack_[from])
          low_[at] = std::min(low_[at], index_[from]);
      }
    }
  }

  void enter(uint32_t element) {
    index_[element] = low_[element] = ++count_;
    on_stack_[element] = true;
    members_.push_back(element);
    walk_.push_back({element, 0, 0});
  }

  // `at` and the elements above it on the stack are one component.
  void close(uint32_t at, uint32_t& place, uint32_t level) {
    const auto first = std::find(members_.rbegin(), members_.rend(), at).base() - 1;
    std::vector<uint32_t> loop(first, members_.end());
    members_.erase(first, members_.end());
    for (const uint32_t k : loop) on_stack_[k] = false;
    const auto size = static_cast<uint32_t>(loop.size());
    if (level == 0 && size == 1 && !readsItself(at)) return;
    for (uint32_t k = 0; k < size; ++k) graph_.loop_place_[loop[k]] = place + k;
    if (size > 1 || readsItself(at)) order(std::move(loop), place, level);
    place += size;
  }

  void order(std::vector<uint32_t> loop, uint32_t place, uint32_t level) {
    const auto earlier = [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); };
    const auto end = place + static_cast<uint32_t>(loop.size());
    if (level == kMaxLevels) {
      std::sort(loop.begin(), loop.end(), earlier);
      for (uint32_t k = 0; k < loop.size(); ++k) {
        graph_.loop_place_[loop[k]] = place + k;
        graph_.loop_end_[loop[k]] = end;
      }
      return;
    }
    const auto first = std::min_element(loop.begin(), loop.end(), earlier);
    if (!runsInLoops(graph_.elements[*first])) return;  // a loop of contacts and connectors
    std::iter_swap(loop.begin(), first);
    graph_.loop_around_[loop[0]] = graph_.loop_first_[loop[0]];
    for (const uint32_t k : loop) graph_.loop_first_[k] = loop[0];
    graph_.loop_place_[loop[0]] = place;
    graph_.loop_end_[loop[0]] = end;
    loop.erase(loop.begin());
    for (uint32_t k = 0; k < loop.size(); ++k) graph_.loop_place_[loop[k]] = place + 1 + k;
    if (!loop.empty()) open_.push_back({std::move(loop), place + 1, level + 1});
  }

  std::tuple<bool, uint32_t, int32_t, int32_t, uint32_t> rank(uint32_t k) const {
    const Element& e = graph_.elements[k];
    return {!runsInLoops(e), e.network, e.placed ? e.x : 0, e.placed ? e.y : 0, k};
  }

  bool readsItself(uint32_t element) const {
    InputWalk walk{element, 0, 0};
    for (uint32_t source = graph_.nextInput(walk); source != kNone; source = graph_.nextInput(walk))
      if (graph_.sources[source].element == element) return true;
    return false;
  }

  Graph& graph_;
  std::vector<Part> open_;
  std::vector<uint32_t> scope_, index_, low_;  // by element
  std::vector<bool> on_stack_;
  std::vector<uint32_t> members_;
  std::vector<InputWalk> walk_;
  uint32_t scopes_ = 0, count_ = 0;
};

void Graph::orderLoops() { LoopOrder(*this).run(); }

bool Graph::leadsBack(uint32_t from, uint32_t to) const {
  const uint32_t place = loop_place_[from];
  return place != kNone && place >= loop_place_[to] && place < loop_end_[to];
}

}  // namespace rung::diagram

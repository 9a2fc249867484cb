// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/network_feedback.h"

#include <algorithm>

#include "frontend/schedule/network_walk.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/standard_names.h"

namespace rung::diagram {
namespace {

class Search {
 public:
  Search(const Tree& tree, const Names& names, const Graph& graph)
      : tree_(tree),
        names_(names),
        graph_(graph),
        order_of_(graph.elements.size(), 0),
        is_found_(graph.sources.size(), false) {
    for (uint32_t k = 0; k < graph.roots.size(); ++k) order_of_[graph.roots[k]] = k + 1;
  }

  std::vector<uint32_t> run() {
    ExecutionWalk walk(graph_);
    for (const uint32_t root : graph_.roots) walk.run(root, Visitor{*this, root});
    findHeld();
    std::sort(found_.begin(), found_.end());
    return found_;
  }

 private:
  void find(uint32_t source) {
    if (!is_found_[source]) found_.push_back(source);
    is_found_[source] = true;
  }

  // Variables, in-outs and the outputs of instances can be read at any time.
  bool isComputed(uint32_t source) const {
    const Source& s = graph_.sources[source];
    const Element& e = graph_.elements[s.element];
    if (e.kind == ElementKind::Compose || e.kind == ElementKind::InOut) return false;
    if (e.kind != ElementKind::Box) return true;
    if (s.pin.name && isEnableOutput(names_.string(s.pin.name))) return true;
    if (keepsState(e)) return false;
    for (const DiagramPin& pin : tree_.list(e.pins))
      if (pin.direction == PinDirection::InOut && names_.same(pin.name.name, s.pin.name)) return false;
    return true;
  }

  // The walk reports this about a root.
  struct Visitor {
    Search& search;
    uint32_t root;
    void resolve(uint32_t) {}
    void readOrdered(uint32_t source) {  // its reader runs when the root runs
      const uint32_t from = search.graph_.sources[source].element;
      if (search.order_of_[from] >= search.order_of_[root] && search.isComputed(source)) search.find(source);
    }
    void readLastCycle(uint32_t source, uint32_t) {
      if (search.isComputed(source)) search.find(source);
    }
    void breakCycle(uint32_t) {}
  };

  // The results of functions with EN, where others than variables read them: edge detectors, too.
  void findHeld() {
    for (uint32_t k = 0; k < graph_.elements.size(); ++k) {
      const bool is_target = graph_.isTarget(k);
      InputWalk inputs{k, 0, 0};
      for (uint32_t source = next(inputs); source != kNone; source = next(inputs)) {
        const Source& s = graph_.sources[source];
        const DiagramPin* pin = graph_.outputPin(source);
        if (is_target && (pin == nullptr || pin->edge == EdgeKind::None)) continue;
        if (isComputed(source) && graph_.enableOf(s.element) != nullptr &&
            !(s.pin.name && isEnableOutput(names_.string(s.pin.name))))
          find(source);
      }
    }
  }
  uint32_t next(InputWalk& inputs) const {
    const ElementKind kind = graph_.elements[inputs.element].kind;
    return kind == ElementKind::RightRail || graph_.isLink(inputs.element) ? kNone : graph_.nextInput(inputs);
  }

  const Tree& tree_;
  const Names& names_;
  const Graph& graph_;
  std::vector<uint32_t> order_of_;
  std::vector<uint32_t> found_;
  std::vector<bool> is_found_;
};

}  // namespace

std::vector<uint32_t> readBeforeExecution(const Tree& tree, const Names& names, const Graph& graph) {
  return Search(tree, names, graph).run();
}

}  // namespace rung::diagram

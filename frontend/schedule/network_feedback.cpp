#include "frontend/schedule/network_feedback.h"

#include <algorithm>

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
        phase_(graph.elements.size(), Phase::New),
        order_of_(graph.elements.size(), 0),
        is_found_(graph.sources.size(), false) {
    for (uint32_t k = 0; k < graph.roots.size(); ++k) order_of_[graph.roots[k]] = k + 1;
  }

  std::vector<uint32_t> run() {
    for (const uint32_t root : graph_.roots) walk(root);
    findHeld();
    std::sort(found_.begin(), found_.end());
    return found_;
  }

 private:
  enum class Phase : uint8_t { New, Busy, Done };
  struct Frame : InputWalk {
    uint32_t consumer;
  };

  void find(uint32_t source) {
    if (!is_found_[source]) found_.push_back(source);
    is_found_[source] = true;
  }

  // Variables, in-outs and the outputs of instances can be read at any time.
  bool isComputed(uint32_t source) const {
    const Source& s = graph_.sources[source];
    const DiagramElement& e = graph_.elements[s.element];
    if (e.kind == ElementKind::Compose || e.kind == ElementKind::InOut) return false;
    if (e.kind != ElementKind::Box) return true;
    if (s.pin.name && isEnableOutput(names_.string(s.pin.name))) return true;
    if (keepsState(e)) return false;
    for (const DiagramPin& pin : tree_.list(e.pins))
      if (pin.direction == PinDirection::InOut && names_.same(pin.name.name, s.pin.name)) return false;
    return true;
  }

  void walk(uint32_t root) {
    const auto isNew = [&](uint32_t k) { return phase_[k] == Phase::New; };
    std::vector<Frame> stack;
    const auto push = [&](uint32_t element, uint32_t consumer) {
      phase_[element] = Phase::Busy;
      stack.push_back({{element, 0, 0}, consumer});
    };
    for (;;) {
      if (stack.empty()) {
        if (!isNew(root)) return;
        const uint32_t first = graph_.firstOfLoop(root, isNew);
        push(first, first);
      }
      const uint32_t source = graph_.nextInput(stack.back());
      if (source == kNone) {
        phase_[stack.back().element] = Phase::Done;
        stack.pop_back();
        continue;
      }
      const uint32_t from = graph_.sources[source].element, consumer = stack.back().consumer;
      if (graph_.isOrdered(from)) {  // its reader runs when the root runs
        if (order_of_[from] >= order_of_[root] && isComputed(source)) find(source);
      } else if (phase_[from] != Phase::Done && graph_.leadsBack(from, consumer) &&
                 runsInLoops(graph_.elements[from])) {
        if (isComputed(source)) find(source);
      } else if (isNew(from)) {
        const uint32_t first = graph_.firstOfLoop(from, isNew);
        if (first != from) --stack.back().wire;  // of `from`, which comes afterwards
        push(first, first != from || runsInLoops(graph_.elements[from]) ? first : consumer);
      }
    }
  }

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
  std::vector<Phase> phase_;
  std::vector<uint32_t> order_of_;
  std::vector<uint32_t> found_;
  std::vector<bool> is_found_;
};

}  // namespace

std::vector<uint32_t> readBeforeExecution(const Tree& tree, const Names& names, const Graph& graph) {
  return Search(tree, names, graph).run();
}

}  // namespace rung::diagram

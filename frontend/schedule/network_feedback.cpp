#include "frontend/schedule/network_feedback.h"

#include <algorithm>

#include "frontend/syntax/diagram.h"

namespace rung::diagram {
namespace {

bool isFunction(const DiagramElement& e) { return e.kind == ElementKind::Box && !keepsState(e); }

class Search {
 public:
  explicit Search(const Graph& graph)
      : graph_(graph),
        phase_(graph.elements.size(), Phase::New),
        order_of_(graph.elements.size(), 0),
        is_found_(graph.elements.size(), false) {
    for (uint32_t k = 0; k < graph.roots.size(); ++k) order_of_[graph.roots[k]] = k + 1;
  }

  std::vector<uint32_t> run() {
    for (const uint32_t root : graph_.roots) walk(root);
    std::sort(found_.begin(), found_.end());
    return found_;
  }

 private:
  enum class Phase : uint8_t { New, Busy, Done };
  void find(uint32_t element) {
    if (!is_found_[element]) found_.push_back(element);
    is_found_[element] = true;
  }
  bool isKept(uint32_t element) const { return keepsState(graph_.elements[element]) || is_found_[element]; }

  void walk(uint32_t root) {
    if (phase_[root] != Phase::New) return;
    std::vector<InputWalk> stack{{root, 0, 0}};
    phase_[root] = Phase::Busy;
    while (!stack.empty()) {
      const uint32_t from = graph_.nextInput(stack.back());
      if (from == kNone) {
        phase_[stack.back().element] = Phase::Done;
        stack.pop_back();
        continue;
      }
      const DiagramElement& e = graph_.elements[from];
      if (e.order != 0) {  // its reader runs when the root runs
        if (isFunction(e) && order_of_[from] >= order_of_[root]) find(from);
        continue;
      }
      if (phase_[from] == Phase::New) {
        phase_[from] = Phase::Busy;
        stack.push_back({from, 0, 0});
      } else if (phase_[from] == Phase::Busy && !isKept(from)) {
        breakCycle(stack, from);
      }
    }
  }

  // The loop is the end of the stack from `first` on. Nothing to do if an element of it keeps its value.
  void breakCycle(const std::vector<InputWalk>& stack, uint32_t first) {
    uint32_t box = kNone;
    for (size_t k = stack.size(); k > 0; --k) {
      const uint32_t element = stack[k - 1].element;
      if (isKept(element)) return;
      if (isFunction(graph_.elements[element])) box = element;
      if (element == first) break;
    }
    if (box != kNone) find(box);
  }

  const Graph& graph_;
  std::vector<Phase> phase_;
  std::vector<uint32_t> order_of_;
  std::vector<uint32_t> found_;
  std::vector<bool> is_found_;
};

}  // namespace

std::vector<uint32_t> readBeforeExecution(const Graph& graph) { return Search(graph).run(); }

}  // namespace rung::diagram

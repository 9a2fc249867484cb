// SPDX-License-Identifier: Apache-2.0
// Forbids a POU that calls itself, directly or through others (codesys: warning). IEC 61131-3 ed. 3, 6.6.1.
//   passes  Outer calls Inner
//   fails   Fact := n * Fact(n - 1);
// Called once, when all bodies are checked. One depth-first walk over the calls, with an explicit stack.
#include "sema/checks/rules.h"

#include <algorithm>

#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

void checkRecursion(Context& context) {
  const std::vector<Project::CallEdge>& edges = context.project.call_edges;
  const size_t count = context.symbols.pous.size();
  std::vector<uint32_t> first(count + 1, 0);
  for (const auto& edge : edges) ++first[edge.caller.index + 1];
  for (size_t i = 0; i < count; ++i) first[i + 1] += first[i];
  enum : uint8_t { kNew, kOpen, kDone };
  std::vector<uint8_t> state(count, kNew);
  std::vector<std::pair<uint32_t, uint32_t>> path;  // POU, next edge
  for (uint32_t root = 1; root < count; ++root) {
    if (state[root] != kNew) continue;
    path.push_back({root, first[root]});
    state[root] = kOpen;
    while (!path.empty()) {
      auto& [pou, next] = path.back();
      if (next == first[pou + 1]) {
        state[pou] = kDone;
        path.pop_back();
        continue;
      }
      const Project::CallEdge& edge = edges[next++];
      const uint32_t callee = edge.callee.index;
      if (state[callee] == kNew) {
        state[callee] = kOpen;
        path.push_back({callee, first[callee]});
      } else if (state[callee] == kOpen) {
        std::string cycle;
        for (size_t i = 0; i < path.size(); ++i) {
          if (cycle.empty() && path[i].first != callee) continue;
          if (!cycle.empty()) cycle += " calls ";
          cycle.append("`").append(string(context, context.symbols.pous[path[i].first].name)).append("`");
        }
        cycle.append(" calls `").append(string(context, context.symbols.pous[callee].name)).append("`");
        context.report(context.profile().recursion ? diag::RecursionAllowed : diag::Recursion, edge.loc, {cycle});
      }
    }
  }
}

}  // namespace rung::sema

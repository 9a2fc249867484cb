// SPDX-License-Identifier: Apache-2.0
// Shrinks generated programs: see shrink.h.
#include "tests/fuzz/differential/shrink.h"

namespace rung::differential {
namespace {

// Outer nodes first: one run of the program may then save many. True when something was removed.
bool shrinkNode(Node& node, const std::function<bool()>& shows) {
  if (node.simplified) return false;
  bool changed = false;
  if (!node.fixed) {
    node.simplified = true;
    if (shows()) return true;
    node.simplified = false;
    for (size_t i = 0; node.hoisted < 0 && i < node.children.size(); ++i) {
      if (node.children[i].type != node.type) continue;
      node.hoisted = static_cast<int>(i);
      if (shows()) {
        changed = true;
      } else {
        node.hoisted = -1;
      }
    }
  }
  if (node.hoisted >= 0) return shrinkNode(node.children[static_cast<size_t>(node.hoisted)], shows) || changed;
  // From the end: declarations precede their uses.
  for (size_t i = node.children.size(); i > 0; --i) changed |= shrinkNode(node.children[i - 1], shows);
  return changed;
}

}  // namespace

void shrink(Node& program, const std::function<bool()>& shows) {
  while (shrinkNode(program, shows)) {
  }
}

}  // namespace rung::differential

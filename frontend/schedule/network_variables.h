// SPDX-License-Identifier: Apache-2.0
// The hidden variables of bodies of networks, beside the elements and pins that were written. In: what
// declareNetworks() declares when a POU is collected. Out: the same for the scheduler of its body. Sema keeps it with
// the project.
#pragma once

#include <unordered_map>

#include "frontend/syntax/diagram.h"

namespace rung::diagram {

class NetworkVariables {
 public:
  // The instance that detects the edge of an element or a pin; of a box or a composer the instance or variable that it
  // works on; or none.
  NameId hidden(const DiagramElement& e) const { return find(hidden_, &e); }
  NameId hidden(const DiagramPin& pin) const { return find(hidden_, &pin); }
  void hide(const DiagramElement& e, NameId name) { hidden_[&e] = name; }
  void hide(const DiagramPin& pin, NameId name) { hidden_[&pin] = name; }

  // The variable that keeps the value of an output pin, or of wires from an element that name no pin; or none.
  NameId stored(const DiagramElement& e) const { return find(stored_, &e); }
  NameId stored(const DiagramPin& pin) const { return find(stored_, &pin); }
  void store(const DiagramElement& e, NameId name) { stored_[&e] = name; }
  void store(const DiagramPin& pin, NameId name) { stored_[&pin] = name; }

 private:
  using Names = std::unordered_map<const void*, NameId>;  // by elements and pins of the tree, which do not move

  static NameId find(const Names& names, const void* at) {
    const auto found = names.find(at);
    return found == names.end() ? NameId{} : found->second;
  }

  Names hidden_, stored_;
};

}  // namespace rung::diagram

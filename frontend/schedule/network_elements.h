// SPDX-License-Identifier: Apache-2.0
// How messages describe the elements of diagrams: "network 3 of `Main`, contact `start`, number 12".
#pragma once

#include <string>
#include <vector>

#include "frontend/syntax/diagram.h"
#include "frontend/syntax/tree.h"

namespace rung::diagram {

// "contact `start`"
std::string describe(const Tree& tree, const Names& names, const DiagramElement& element);

// Finds the element at a location, in any body of the tree.
class ElementLocator {
 public:
  ElementLocator(const Tree& tree, const Names& names);
  bool empty() const { return bodies_.empty(); }
  // Empty: the location is not in an element.
  std::string at(Loc loc) const;

 private:
  struct Body {
    Loc begin, end;
    DeclId pou;
    NameId owner;  // of an action or method
  };
  void collect(DeclId decl, NameId owner);

  const Tree& tree_;
  const Names& names_;
  std::vector<Body> bodies_;  // sorted
};

}  // namespace rung::diagram

// SPDX-License-Identifier: Apache-2.0
// The cyclic part of a module and its subroutines. In: the elements of the module. Out: where each part is, and the
// jumps and calls whose targets are wrong, which are reported. NCT manual 6.14. Used by write.cpp.
#pragma once

#include <set>
#include <vector>

#include "frontend/import/nct/program.h"

namespace rung::importer::nct {

inline constexpr int32_t kMostLabel = 99;

struct Body {
  uint32_t begin, end;  // elements
  int32_t label;        // of the subroutine; -1: the cyclic part
  Loc loc;
};

struct Bodies {
  std::vector<Body> list;
  std::set<const Element*> broken_jumps;
};

Bodies findBodies(const Module& module, Diagnostics& diagnostics);

// The number that JME, SBN, JMP or SBS names; -1: not a label.
int32_t labelOf(const Element& element);
bool isMarker(const Element& element, std::string_view word);

}  // namespace rung::importer::nct

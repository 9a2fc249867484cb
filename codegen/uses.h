// SPDX-License-Identifier: Apache-2.0
// How a body uses its variables: how often, in loops or not, who writes them, whether an address leaves. In: a verified
// body and the facts of the module. Out: Uses, a row for each variable. Called by analysis.cpp; the choices of locals,
// counted loops, lengths and slices read it.
#pragma once

#include <string>
#include <vector>

#include "codegen/facts.h"
#include "codegen/variables.h"

namespace rung::codegen {

struct VariableUse {
  uint32_t weight = 0, loop_weight = 0;  // all uses, weighted by loops; the uses in loops alone
  uint32_t sized_weight = 0;             // of a string: the uses by sized functions
  bool written = false;
  bool exposed = false;  // its address leaves the body
  bool sliced = false;   // a string made by functions marked {slice}, where that pays
};

struct Uses {
  Variables variables;  // without fields when other code may reach the instance
  std::vector<VariableUse> of;
  std::vector<ir::StmtId> quiet_loops;  // FOR whose control is a variable that nothing in the loop writes
  bool has_try = false, has_calls = false;
  bool has_leaving_calls = false;  // of what may fault, or what the host may answer
  bool has_slice_calls = false;    // of functions marked {slice}, where that pays

  std::string toString() const;
};

// Temporaries that one call makes and one other expression reads: they may live where the reader wants them.
class ReadOnce {
 public:
  ReadOnce(const ir::Module& module, const ir::Body& body);
  // The one that the call makes, or null.
  const uint32_t* madeBy(const ir::CallStmt& call) const;

 private:
  const ir::Body& body_;
  std::vector<uint32_t> names_;  // by local: how many expressions name it
};

Uses analyzeUses(const ir::Module& module, const ir::Body& body, const Facts& facts);

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// The list of the analyses of a body: see analysis.h.
#include "codegen/analysis.h"

namespace rung::codegen {

BodyAnalysis analyzeBody(const ir::Module& module, const ir::Body& body, const Facts& facts) {
  BodyAnalysis of{analyzeUses(module, body, facts), {}, {}, {}, {}, {}, {}, {}, {}, {}};
  of.fields = analyzeLocals(module, facts, of.uses);
  of.write_backs = analyzeWriteBacks(module, body, of.uses, of.fields);
  of.loops = analyzeLoops(module, body, of.uses, of.fields);
  of.measured = analyzeLengths(module, body, facts, of.uses);
  const StringsOfBody strings{module, body, of.uses.variables, of.measured};
  of.slices = analyzeSlices(strings, facts, of.uses);
  of.lengths = analyzeKnownLengths(strings, of.slices, facts);
  of.effort = effortFor(body, of.measured.any);
  of.appends = analyzeAppends(strings, of.lengths);
  of.held = analyzeHeldBytes(module, body);
  return of;
}

}  // namespace rung::codegen

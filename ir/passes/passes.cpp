// SPDX-License-Identifier: Apache-2.0
// The list of passes: see passes.h.
#include "ir/passes/passes.h"

#include "ir/passes/fold_constants.h"
#include "ir/passes/hoist_checks.h"
#include "ir/passes/privatize.h"
#include "ir/passes/propagate.h"
#include "ir/passes/remove_checks.h"
#include "ir/passes/remove_dead_code.h"
#include "ir/passes/simplify_branches.h"
#include "ir/passes/thread_conditions.h"

namespace rung::ir {

namespace {

// A pass that needs no exposure.
template <bool (*kRun)(Module&, Body&)>
bool alone(Module& module, const Exposure&, Body& body) {
  return kRun(module, body);
}

constexpr Pass kBodyPasses[] = {
    {"propagation", alone<propagate>},
    {"constants", alone<foldConstants>},
    {"branches", alone<simplifyBranches>},
    {"conditions", alone<threadConditions>},
    {"checks", removeChecks},
    {"hoisting", hoistChecks},
    {"privatization", alone<privatize>},
    {"dead-code", alone<removeDeadCode>},
};

}  // namespace

std::span<const Pass> bodyPasses(int level) {
  if (level <= 0) return {};
  return kBodyPasses;
}

void optimize(Module& module, int level, FunctionRef<void(const Pass&, Body&)> after) {
  if (level <= 0) return;
  const Exposure exposure(module);
  for (size_t i = 1; i < module.bodies.size(); ++i) {
    Body& body = module.bodies[i];
    if (body.native || !body.first) continue;
    for (const Pass& pass : bodyPasses(level)) {
      pass.run(module, exposure, body);
      after(pass, body);
    }
  }
}

}  // namespace rung::ir

// The list of passes: see passes.h.
#include "ir/passes/passes.h"

#include "ir/passes/fold_constants.h"
#include "ir/passes/privatize.h"
#include "ir/passes/propagate.h"
#include "ir/passes/remove_checks.h"
#include "ir/passes/remove_dead_code.h"
#include "ir/passes/simplify_branches.h"
#include "ir/passes/thread_conditions.h"

namespace rung::ir {

namespace {
constexpr Pass kBodyPasses[] = {
    {"propagation", propagate},       {"constants", foldConstants}, {"branches", simplifyBranches},
    {"conditions", threadConditions}, {"checks", removeChecks},     {"privatization", privatize},
    {"dead-code", removeDeadCode},
};
}  // namespace

std::span<const Pass> bodyPasses(int level) {
  if (level <= 0) return {};
  return kBodyPasses;
}

void optimize(Module& module, Body& body, int level, FunctionRef<void(const Pass&, Body&)> after) {
  if (body.native || !body.first) return;
  for (const Pass& pass : bodyPasses(level)) {
    pass.run(module, body);
    after(pass, body);
  }
}

void optimize(Module& module, int level, FunctionRef<void(const Pass&, Body&)> after) {
  if (level <= 0) return;
  for (size_t i = 1; i < module.bodies.size(); ++i) optimize(module, module.bodies[i], level, after);
}

}  // namespace rung::ir

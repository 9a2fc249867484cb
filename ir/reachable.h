// SPDX-License-Identifier: Apache-2.0
// Which bodies a task can reach. Of a virtual call, all that it may call.
#pragma once

#include <vector>

#include "ir/ir.h"

namespace rung::ir {

// The bodies that task `task` (its index) calls: its programs and blocks, and what is called around them.
std::vector<BodyId> rootsOfTask(const Module& module, uint32_t task);

// These bodies and those that they reach, each once; missing ids are skipped. Needs Module::dispatches.
std::vector<BodyId> reachableBodies(const Module& module, const std::vector<BodyId>& roots);

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Limits of what a body may nest: above those of the parser, which reports first.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// Above the limits of the parser, which reports first; they bound the trees of schedulers.
constexpr uint32_t kMaxExprDepth = 2100;
constexpr uint32_t kMaxStmtDepth = 2100;
constexpr uint32_t kMaxOperands = 2000;      // of an extensible call, whose value is nested as `a + b + c` is
constexpr uint32_t kMaxElsifDepth = 20'000;  // each ELSIF is in the ELSE of the branch before it

}  // namespace rung::sema

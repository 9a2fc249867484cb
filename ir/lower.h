// SPDX-License-Identifier: Apache-2.0
// Lowering: checked syntax trees to IR. In: a sema::Project without errors. Out: an ir::Module with the code of every
// POU in use; each call, conversion, check and initial value explicit. Called by the driver after check().
#pragma once

#include "ir/ir.h"
#include "sema/ids.h"

namespace rung::sema {
struct Project;
}

namespace rung::ir {

struct LowerOptions {
  uint8_t checks = kCheckDiv | kCheckIndex | kCheckNull | kCheckCast;
  bool online_change = false;      // Module::lives, and FB_Init and FB_Exit see whether a change copies them
  bool used_of_libraries = false;  // lower library POUs marked `used` even where the project does not call them
};
// Must not be called for a project with errors.
void lower(const sema::Project& project, const LowerOptions& options, Module& module);

// Lowers one checked function and those that it calls, while the project is still being checked. Returns a function
// whose body is not checked yet, if there is one: check it and call this again.
sema::PouId lowerFunction(const sema::Project& project, sema::PouId function, const LowerOptions& options,
                          Module& module, BodyId& body);

}  // namespace rung::ir

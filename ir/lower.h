// Lowering: checked syntax trees to IR. In: a sema::Project without errors. Out: an ir::Module whose bodies hold the
// code of every POU in use; each call, conversion, check and initial value explicit. Called by the driver after
// check().
#pragma once

#include "ir/ir.h"
#include "sema/ids.h"

namespace rung::sema {
struct Project;
}

namespace rung::ir {

struct LowerOptions {
  uint8_t checks = kCheckDiv | kCheckIndex | kCheckNull | kCheckCast;
  bool used_of_libraries = false;  // library POUs marked `used` even where no code of the project leads to them
};
// With errors in the project: must not be called.
void lower(const sema::Project& project, const LowerOptions& options, Module& module);

// One checked function and those that it calls, while the project is still being checked. Gives a function whose body
// is not checked yet, if there is one: check it and lower anew.
sema::PouId lowerFunction(const sema::Project& project, sema::PouId function, const LowerOptions& options,
                          Module& module, BodyId& body);

}  // namespace rung::ir

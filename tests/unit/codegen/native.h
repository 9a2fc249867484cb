// SPDX-License-Identifier: Apache-2.0
// Compiles the generated C++ of a module together with a driver, and runs the program. In: a module, the source of a
// main() that may call its functions. Out: the program's output, or the compiler's messages. Warnings are errors.
#pragma once

#include <string>

#include "ir/ir.h"

namespace rung::codegen {

struct NativeResult {
  bool ok = false;
  std::string output;
};
// `flags`: for the compiler, besides the strict ones.
NativeResult runNatively(const ir::Module& module, const std::string& driver, const std::string& flags);

}  // namespace rung::codegen

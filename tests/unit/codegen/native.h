// Compiles what codegen makes of a module with a driver beside it, and runs the program. In: a module, the text of a
// main() that may call its functions. Out: what the program printed, or the compiler's messages. Warnings are errors.
#pragma once

#include <string>

#include "ir/ir.h"

namespace rung::codegen {

struct NativeResult {
  bool ok = false;
  std::string output;
};
// `flags`: of the compiler, besides the strict ones.
NativeResult runNatively(const ir::Module& module, const std::string& driver, const std::string& flags);

}  // namespace rung::codegen

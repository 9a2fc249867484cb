// SPDX-License-Identifier: Apache-2.0
// The text form of the IR (docs/ir.md is its manual): printed by `rung emit --emit=ir` and --dump-after, read back by
// the tests of passes. print(parse(print(m))) == print(m).
#pragma once

#include <string>

#include "frontend/source/diagnostics.h"
#include "ir/ir.h"

namespace rung::ir {

std::string print(const Module& module);
std::string print(const Module& module, const Body& body);

// Reads a module; mistakes go to diagnostics (E09xx) with their locations. False when there were any.
bool parse(const Sources& sources, FileId file, Module& module, Diagnostics& diagnostics);

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Shrinks a program that shows a difference.
#pragma once

#include <functional>

#include "tests/fuzz/differential/program.h"

namespace rung::differential {

// Removes statements and declarations, and replaces expressions by literals or operands, until nothing more can go.
// `shows` runs the program; it is true for `program` as given and for the result.
void shrink(Node& program, const std::function<bool()>& shows);

}  // namespace rung::differential

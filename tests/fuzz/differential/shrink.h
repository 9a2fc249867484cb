// Makes a program small while it still shows what it shows.
#pragma once

#include <functional>

#include "tests/fuzz/differential/program.h"

namespace rung::differential {

// Leaves out statements and declarations, and puts literals or operands where expressions stand, until nothing more
// can go. `shows` runs the program; it is true for `program` as given and for what stands there afterwards.
void shrink(Node& program, const std::function<bool()>& shows);

}  // namespace rung::differential

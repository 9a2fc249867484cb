// The native bodies of the libraries, by the names of their C functions: what the interpreter calls. Made when rung is
// built, from the declarations (main.cpp). Sorted by name.
#pragma once

#include <cstddef>

#include "ir/interpreter/code.h"

namespace rung::natives {

extern const ir::interpreter::Native table[];
extern const size_t count;

}  // namespace rung::natives

// SPDX-License-Identifier: Apache-2.0
// Bodies in C++: the checks that rung can make before g++ reads them; see cpp_bodies.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// A body in C++, whose source g++ reads: its variables can be accessed there, and the functions that it names are used.
void checkCppBody(Context& context, const PouDecl& decl);

}  // namespace rung::sema

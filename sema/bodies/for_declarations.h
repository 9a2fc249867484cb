// SPDX-License-Identifier: Apache-2.0
// The expressions of declarations, checked as those of bodies are. In: the calls of declarations/expressions.h. Out:
// the same calls of the functions of this folder. Given to the Context by check().
#pragma once

#include "sema/context.h"
#include "sema/declarations/expressions.h"

namespace rung::sema {

const Expressions& expressionsForDeclarations();

}  // namespace rung::sema

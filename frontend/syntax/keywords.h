// SPDX-License-Identifier: Apache-2.0
// The words that declarations begin with, as messages, lists and editors write them.
#pragma once

#include "frontend/syntax/nodes.h"

namespace rung {

const char* keywordOf(PouKind kind);         // FUNCTION_BLOCK
const char* keywordOf(SectionKind section);  // VAR_INPUT

}  // namespace rung

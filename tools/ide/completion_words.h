// SPDX-License-Identifier: Apache-2.0
// Completions that need no types. In: the text before the cursor. Out: pragmas, attributes with their values, the
// sections and keys of rung.project. Used by completion.cpp.
#pragma once

#include <string_view>

#include "tools/ide/completion.h"
#include "tools/ide/cursor.h"

namespace rung::ide {

// A pragma after its brace, the name of an attribute in quotes, or the value of one.
void addPragmas(const Cursor& cursor, Completion& result);
// The sections after `[`, and the keys of the section around the cursor.
void addProjectKeys(std::string_view source, size_t offset, Completion& result);

}  // namespace rung::ide

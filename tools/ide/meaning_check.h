// SPDX-License-Identifier: Apache-2.0
// Whether edits keep the meaning of a project. In: views before and after them, and the names that they exchange. Out:
// the first name that means something else, or the first new error, as a sentence. What the check recorded of both is
// compared, so that it holds for all that may happen to names: duplicates, hiding, inheritance, overloads.
#pragma once

#include <string>

#include "tools/ide/text_edits.h"

namespace rung::ide {

// Empty: all keep their meaning.
std::string changedMeaning(const View& before, const View& after, const Edits& edits, std::string_view old_name,
                           std::string_view new_name);

}  // namespace rung::ide

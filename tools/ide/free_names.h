// SPDX-License-Identifier: Apache-2.0
// Names that meet no other one. In: a variable of a POU, and another name for it. Out: whether the code that can see
// the variable does not know the name, so that a rename needs no trial. Asked by rename.
#pragma once

#include <string_view>
#include <vector>

#include "tools/ide/scope.h"
#include "tools/ide/view.h"

namespace rung::ide {

// False: perhaps it is not.
bool isFreeFor(const View& view, Entity entity, std::string_view name);
// The code that can name a local variable of a function or block: that of its POU, and of those that extend it. Empty:
// also other code may.
std::vector<Range> codeThatSees(const View& view, Entity entity);
// Not a part of a longer name; in any case of letters.
bool hasName(std::string_view text, std::string_view name);

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// Work on a copy of all that this process knows, which is gone afterwards. In: what to do. Out: the text that it gave.
// The copy is a forked process: it shares memory with this one until it writes, so that it costs a millisecond or two,
// and what is left of a project that was changed for a trial needs no undoing. What ends the copy does not end this.
#pragma once

#include <optional>
#include <string>

#include "frontend/source/function_ref.h"

namespace rung::workspace {

// None: there could be no copy, or it ended early. It may use memory, but no other thread and no open file.
std::optional<std::string> inProcessCopy(FunctionRef<std::string()> work);

}  // namespace rung::workspace

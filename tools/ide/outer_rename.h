// SPDX-License-Identifier: Apache-2.0
// Another name for a namespace, a configuration, a resource, a task or a list of globals. In: a view, the name, the new
// one, and how the project would be with other texts. Out: as of rename.h, which calls this: edits and new names of
// files, made on trial first, or the sentence that says why not.
#pragma once

#include <string>

#include "tools/ide/outer_names.h"
#include "tools/ide/rename.h"

namespace rung::ide {

// Why it cannot have another name; empty: it can.
std::string refusalOfOuter(const View& view, const OuterName& name);
Renaming renameOuter(const View& view, const OuterName& name, const std::string& new_name, bool renames_files,
                     RenameTrial trial);

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// Another name for what a project declares, in all files and formats. In: a view, a byte with the name, the new one,
// and how the project would be with other texts. Out: edits and new names of files, or the sentence that says why not:
// the edits are made on trial, and every name of the project must mean what it meant before.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frontend/source/function_ref.h"
#include "tools/ide/family.h"
#include "tools/ide/vendor_names.h"

namespace rung::ide {

// What can be renamed at a place.
struct Renamable {
  std::string refusal;  // why nothing can; else empty
  FileRange at;
  std::string name;
};
Renamable renamableAt(const View& view, FileId file, uint32_t byte);

struct Renaming {
  std::string refusal;  // empty: it can be done
  std::vector<TextEdit> edits;
  std::vector<FileMove> moves;  // of TwinCAT's files, which have the names of what they declare
};
// What is said of the project with other texts, by path; none: nothing could be. The view before is of no use there.
using RenameTrial = FunctionRef<std::optional<std::string>(const std::map<std::string, std::string>&,
                                                           FunctionRef<std::string(const View& after)>)>;
// Files keep their names where the editor cannot rename them.
Renaming renameAt(const View& view, FileId file, uint32_t byte, const std::string& new_name, bool renames_files,
                  RenameTrial trial);

}  // namespace rung::ide

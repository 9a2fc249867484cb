// SPDX-License-Identifier: Apache-2.0
// Names that files of other tools repeat beside the source: the `Name` of a TwinCAT object, which is the name of its
// file too, and the structure that CODESYS exports beside a declaration as text. In: the places of a name. Out: more
// edits, and the files to rename.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/references.h"
#include "tools/ide/text_edits.h"

namespace rung::ide {

struct NameChange {
  std::string from, to;
};
void addVendorNames(const View& view, const std::vector<Reference>& references, const NameChange& change,
                    std::vector<TextEdit>& edits);

struct FileMove {
  std::string from, to;  // absolute paths
};
// Of the files that are named after what they declare.
std::vector<FileMove> movesFor(const View& view, const std::vector<Reference>& references, const NameChange& change);
// Where the list of a project names the file.
void addNamesOfFile(const View& view, const FileMove& move, std::vector<TextEdit>& edits);

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// A file of several declarations as one file for each: the program of another tool becomes a folder as a programmer
// would keep it. In: the tree as parsed. Out: the parts of a file in source order, which together are all of its text:
// a part has the comments and pragmas in front of its declaration. Called by convert.cpp.
#pragma once

#include <string>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/syntax/tree.h"

namespace rung::driver {

// A POU, a TYPE block, a namespace or a configuration by its name. The sections of global variables are named after
// their list, as listOfSection() of sema decides it, because the name of a file is the name of its list. Several parts
// may have one name, and belong into one file.
struct FilePart {
  std::string name;
  Loc begin, end;
};

// Empty: the file has to stay whole, because something in it is about all that follows: USING, or a pragma such as
// {IF …}, {define …} or {warning …} outside of the declarations.
std::vector<FilePart> declarationFiles(const Tree& tree, const Names& names, const Sources& sources,
                                       const FileUnit& unit, const std::string& list_of_file);

}  // namespace rung::driver

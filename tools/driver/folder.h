// SPDX-License-Identifier: Apache-2.0
// Finds the files of a folder that may belong to a program. In: a folder. Out: the files whose extensions Rung reads,
// the folders inside, and what kind of project of another tool it is. Called by inputs.cpp.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rung::driver {

// Paths, sorted.
struct Folder {
  std::vector<std::string> files, folders, plc_projects;
  bool is_beremiz = false;                                   // a project of Beremiz or OpenPLC
  std::vector<std::pair<std::string, std::string>> outside;  // links to files elsewhere, with their targets
};

// The text before the names of a folder's files: nothing in the current folder, so that messages say `main.st`.
std::string prefixOf(const std::string& folder);

// Hidden entries and links to folders are left out: loops and `.git` do not belong to a project. So are links to files
// that are not below `root`, which would make the project depend on what its folder does not hold. The result is an
// error, or empty.
[[nodiscard]] std::string readFolder(const std::string& path, const std::string& root, Folder& folder);

// Leaves of an extension's folder in a Beremiz project the files that say what variables it has.
void keepVariables(Folder& extension);

}  // namespace rung::driver

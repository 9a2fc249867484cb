// A program as PLCopen TC6 XML, version 2.01. In: the tree as the parser leaves it, before sema changes it. Out: one
// file that is valid by the schema and from which readProject() makes the same program. What TC6 says in its own
// elements stands in them; the declaration stands as text beside them where they do not say all of it, as editors of
// the 3S family keep it. docs/files.md lists what goes where. Called by `rung convert --to xml`.
#pragma once

#include <span>
#include <string>

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/tree.h"

namespace rung::plcopen {

// What is written.
struct Program {
  const Tree& tree;
  const Names& names;
  const Sources& sources;
  std::span<const FileUnit> files;
};

// The files of the program, under the name of the project. What TC6 cannot say is reported, and left out of the text.
std::string writeProject(const Program& program, const std::string& project, Diagnostics& diagnostics);

}  // namespace rung::plcopen

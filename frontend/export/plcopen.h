// SPDX-License-Identifier: Apache-2.0
// A program as PLCopen TC6 XML, version 2.01. In: the tree as parsed, before sema changes it: bodies are quoted from
// the source, structures printed from the tree. Out: one file that is valid by the schema and from which readProject()
// makes the same program. Declarations are written as TC6 elements. Where these would lose something (`is_lossless` is
// false), the declaration is added as text, as editors of the 3S family do, and the import prefers that text.
// docs/files.md lists the mapping. Called by `rung convert --to xml`, between parsing and checking.
#pragma once

#include <span>
#include <string>

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/tree.h"

namespace rung::exporter {

// The program to write.
struct Program {
  const Tree& tree;
  const Names& names;
  const Sources& sources;
  std::span<const FileUnit> files;
};

// Exports the files of the program under the project's name. Declarations that TC6 cannot express are reported and
// omitted.
std::string writeProject(const Program& program, const std::string& project, Diagnostics& diagnostics);

}  // namespace rung::exporter

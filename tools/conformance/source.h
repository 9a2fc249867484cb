// SPDX-License-Identifier: Apache-2.0
// Plain source of the suite, parsed: the tree and, beside it, the units of the text, which the exporter rewrites. In: a
// text and its dialect. Out: Source. Read by everything here that looks at source.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/tree.h"

namespace rung::conformance {

class Source {
 public:
  Source(const std::string& text, Dialect dialect);
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  size_t at(Loc loc) const { return loc.offset - sources.begin(file).offset; }
  std::string_view text() const { return sources.sourceText(file); }
  std::string_view textOf(const Unit& unit) const { return text().substr(unit.begin, unit.end - unit.begin); }
  std::string spelling(NameId name) const { return std::string(names.string(name)); }
  size_t begin(DeclId id) const { return at(tree.decl(id).begin); }
  size_t end(DeclId id) const { return at(tree.decl(id).end); }
  // The first unit at or after an offset.
  std::vector<Unit>::const_iterator unitAt(size_t offset) const;
  // The number of the unit after `index` that is code; units.size(): there is none.
  size_t nextCode(size_t index) const;

  Sources sources;
  Names names;
  Diagnostics diagnostics;
  Tree tree;
  FileId file;
  std::vector<DeclId> decls;  // of the file
  std::vector<Unit> units;    // with comments and pragmas
};

}  // namespace rung::conformance

// SPDX-License-Identifier: Apache-2.0
// Edits of declarations in a source: a variable that comes or goes, and where in a POU others may follow. In: the tree
// as it was written, and its sources. Out: edits of fixes; one without a place where the source has none. Called by
// sema, which reports what is not declared or unused, and by refactorings of editors.
#pragma once

#include <string>
#include <string_view>

#include "frontend/source/diagnostics.h"
#include "frontend/syntax/tree.h"

namespace rung {

// What was written.
struct Written {
  const Sources& sources;
  const Tree& tree;
  const Names& names;
};

// A variable as the last one of the plain section of a kind, or in a new one. `variable`: `name : TYPE`.
Fix::Edit declarationIn(const Written& written, const PouDecl& pou, SectionKind kind, const std::string& variable);
// … of a section, as the one that findSection() gives; none: it has no END_VAR of its own.
Fix::Edit declarationIn(const Written& written, const SectionDecl& section, const std::string& variable);
// The last section of a kind without RETAIN, CONSTANT …; null: there is none.
const SectionDecl* findSection(const Written& written, Slice<DeclId> declarations, SectionKind kind);

// A declared name is gone, its declaration and its section too when they declare nothing else.
struct Removal {
  Fix::Edit edit;
  bool has_comment = false;  // a comment or pragma would go with it, or would be left alone on the line
};
Removal declarationGone(const Written& written, const PouDecl& pou, DeclId decl, Loc name);

// Where methods and sections may follow the header and the sections of a POU.
Loc endOfSections(const Written& written, const PouDecl& pou);
// The blanks before the first token of the line.
std::string indentAt(const Sources& sources, Loc loc);
// The range, with its line where nothing else is on it, else with the blanks beside it.
Range withBlanks(const Sources& sources, Range range);
// The source of a range; empty: it is not one of a file.
std::string sourceText(const Sources& sources, Range range);
// The file is ST as somebody wrote it, not made of parts.
bool isWholeSource(const Sources& sources, Loc loc);

}  // namespace rung

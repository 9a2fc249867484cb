// SPDX-License-Identifier: Apache-2.0
// Builds fixes of diagnostics from the tree: declarations that come and go, calls around expressions, exchanged
// operands. In: what was written, with its source ranges. Out: a Fix (frontend/source/diagnostics.h); one without edits
// where the source has no place for it. Called by who reports.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sema/context.h"

namespace rung::sema {

// The source of an expression, also of its copy in code, without parentheses around it. Empty: it was not written.
Range sourceRange(const Context& context, ExprId expr);
std::string sourceText(const Context& context, Range range);

// "Write `F(...)`".
Fix callAround(const Context& context, ExprId expr, const std::string& function);
// The first in place of the second, and the second in place of the first.
Fix exchanged(const Context& context, ExprId first, ExprId second);
// The first `sign` between two places becomes another one.
Fix otherSign(const Context& context, Loc from, Loc to, std::string_view sign, std::string_view by, Sureness sureness);
// A statement from its first to past its last byte, with the `;` after it.
Fix withoutStatement(const Context& context, Loc begin, Loc end);
// A word between two places is gone, or another one is written in its place; a sign before it goes with it.
Fix withoutWord(const Context& context, Loc from, Loc to, std::string_view word, Sureness sureness);
Fix otherWord(const Context& context, Loc from, Loc to, std::string_view word, std::string_view by, Sureness sureness);
// What a declaration has after a sign, `:= value`, is gone.
Fix withoutPart(const Context& context, Loc from, std::string_view sign, Loc end);
// {test} before a declaration.
Fix withPragma(const Context& context, DeclId decl, std::string_view pragma);
// The argument of a call, with a comma beside it; that and all after it.
Fix withoutArguments(const Context& context, const CallExpr& call, const Argument& from);
Fix withoutArgument(const Context& context, const CallExpr& call, const Argument& argument);

// The variable's declaration is gone, its section too when it declares nothing else. Sure, unless a comment, a pragma
// or a call would go with it.
Fix withoutVariable(const Context& context, const Var& var);

// A variable for a name that is not declared, in this section of the POU: "Declare `x` as INT". None: there is no type.
struct NewVariable {
  std::string name, type;
};
Fix declaredInPou(const Context& context, PouId pou, SectionKind section, const NewVariable& variable);
// … in a VAR_GLOBAL of the project.
Fix declaredGlobally(const Context& context, PouId pou, const NewVariable& variable);
// Adds to the report of a name all that can declare it. Of what was reported, the name of an expression: nothing when
// its type is known already.
void addDeclarations(const Context& context, Report report, NameId name, TypeId type);
void declareUnknown(const Context& context, ExprId name, TypeId type);

// Where declarations and methods may follow the header and the sections of a POU, and the blanks before its keyword.
Loc endOfSections(const Context& context, const PouDecl& pou);
std::string indentAt(const Context& context, Loc loc);
// The file is ST as somebody wrote it, not made of parts.
bool isWholeSource(const Context& context, Loc loc);

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// What is selected in a body in ST: the nodes around it, their source, and edits as code actions. In: a view and bytes
// of a file. Shared by the refactorings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frontend/source/scanner.h"
#include "frontend/syntax/declaration_edits.h"
#include "frontend/syntax/node_at.h"
#include "tools/ide/code_actions.h"
#include "tools/ide/meanings.h"

namespace rung::ide {

struct Selection {
  const View& view;
  FileRange range;            // without blanks at its ends
  Range parsed;               // the same, as it was parsed
  std::vector<NodeRef> path;  // from the declaration of the file to the innermost node at its begin
  PouId pou;                  // whose body it is in, or whose declaration

  const Tree& tree() const { return view.tree(); }
  const Scope& scope() const { return view.meanings().scope(); }
  const sema::Project& project() const { return scope().project(); }
  Written written() const { return {view.sources(), view.tree(), view.names()}; }
  std::string text(Range of) const { return sourceText(view.sources(), of); }
  std::string indent(Loc loc) const { return indentAt(view.sources(), loc); }
  const PouDecl& pouDecl() const;
  const PouDecl& declaringPou() const;  // of an action the block, which declares its variables
  // A name that is not used yet: `base`, `base2` …
  std::string freshName(const std::string& base) const;
  // The type that the check gave an expression; none: it is not known.
  TypeId typeOf(ExprId expr) const;
};

// None: nothing there was parsed, or it is not in a POU of the project.
std::optional<Selection> selectionAt(const View& view, const FileRange& range);

// The list of statements with this one, which is a child of `parent`.
std::span<const StmtId> listWith(const Tree& tree, NodeRef parent, StmtId stmt);
// The first word or sign of a source, outside of comments, from one place to another; none: it is not there.
Loc findSign(const View& view, Loc from, Loc to, std::string_view word);

// Without edits: a place is not in a file.
CodeAction codeAction(const View& view, std::string title, ActionKind kind, std::vector<Fix::Edit> edits);

// Each adds what can be done with the selection.
void addExtractions(const Selection& selection, std::vector<CodeAction>& actions);          // extractions.cpp
void addInlining(const Selection& selection, std::vector<CodeAction>& actions);             // inlining.cpp
void addConversionsOfChains(const Selection& selection, std::vector<CodeAction>& actions);  // chains.cpp
void addNewPin(const Selection& selection, std::vector<CodeAction>& actions);               // new_pin.cpp

}  // namespace rung::ide

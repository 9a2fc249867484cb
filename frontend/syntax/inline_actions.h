// Actions that an XML file has inside a step (<action><inline>): the import declares them, with a name that it makes
// and the pragma {inline}. Pictures show their statements instead of the name, and the export writes them inside the
// step again. In: the POU of a chart. Out: the action of a step, if it is one of these. Called by frontend/render and
// frontend/export.
#pragma once

#include "frontend/syntax/tree.h"

namespace rung {

constexpr std::string_view kInlineAction = "inline";

bool isInlineAction(const Tree& tree, const Names& names, DeclId member);
// The inline action of that name; null: none.
const PouDecl* inlineAction(const Tree& tree, const Names& names, const PouDecl& chart, NameId name);

}  // namespace rung

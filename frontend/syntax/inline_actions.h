// SPDX-License-Identifier: Apache-2.0
// Actions that an XML file has inside a step (<action><inline>): the import declares them, with a name that it makes
// and the pragma {inline}. Pictures show their statements instead of the name, and the export writes them inside the
// step again. In: the POU of a chart. Out: these of its actions. Called by frontend/render and frontend/export.
#pragma once

#include <unordered_map>

#include "frontend/syntax/tree.h"

namespace rung {

constexpr std::string_view kInlineAction = "inline";

bool isInlineAction(const Tree& tree, const Names& names, DeclId member);

class InlineActions {
 public:
  InlineActions(const Tree& tree, const Names& names, const PouDecl& chart);

  // The inline action of that name; null: none.
  const PouDecl* find(NameId name) const;

 private:
  const Names& names_;
  std::unordered_map<uint32_t, const PouDecl*> by_name_;  // by key
};

}  // namespace rung

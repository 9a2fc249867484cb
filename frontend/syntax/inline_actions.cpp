// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/inline_actions.h"

namespace rung {

bool isInlineAction(const Tree& tree, const Names& names, DeclId member) {
  if (tree.kind(member) != DeclKind::Pou || tree.as<PouDecl>(member).pou_kind != PouKind::Action) return false;
  for (const Pragma& pragma : tree.list(tree.decl(member).pragmas))
    if (names.string(pragma.name) == kInlineAction) return true;
  return false;
}

InlineActions::InlineActions(const Tree& tree, const Names& names, const PouDecl& chart) : names_(names) {
  for (const DeclId member : tree.list(chart.members)) {
    if (!isInlineAction(tree, names, member)) continue;
    const PouDecl& action = tree.as<PouDecl>(member);
    by_name_[names.key(action.name).index] = &action;
  }
}

const PouDecl* InlineActions::find(NameId name) const {
  const auto found = by_name_.find(names_.key(name).index);
  return found == by_name_.end() ? nullptr : found->second;
}

}  // namespace rung

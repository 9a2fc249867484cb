#include "frontend/syntax/inline_actions.h"

namespace rung {

bool isInlineAction(const Tree& tree, const Names& names, DeclId member) {
  if (tree.kind(member) != DeclKind::Pou || tree.as<PouDecl>(member).pou_kind != PouKind::Action) return false;
  for (const Pragma& pragma : tree.list(tree.decl(member).pragmas))
    if (names.string(pragma.name) == kInlineAction) return true;
  return false;
}

const PouDecl* inlineAction(const Tree& tree, const Names& names, const PouDecl& chart, NameId name) {
  for (const DeclId member : tree.list(chart.members))
    if (isInlineAction(tree, names, member) && names.same(tree.as<PouDecl>(member).name, name))
      return &tree.as<PouDecl>(member);
  return nullptr;
}

}  // namespace rung

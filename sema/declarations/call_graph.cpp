// SPDX-License-Identifier: Apache-2.0
#include "sema/declarations/call_graph.h"

#include <algorithm>

#include "sema/declarations/mentions.h"
#include "sema/hooks.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

void noteCall(Context& context, PouId callee, Loc loc, Loc name) {
  Pou& pou = context.symbols.pou(callee);
  pou.progress.used = true;
  const bool is_block = pou.kind == PouKind::FunctionBlock || pou.kind == PouKind::Class;
  // The name of a block is not written there.
  if (!is_block) noteMention(context, entity(callee), name ? name : loc, Access::Call);
  if (pou.kind == PouKind::Program) noteEffect(context);
  if (pou.decl) context.rules->use(context, {callee, context.tree().decl(pou.decl), pou.name, loc, true});
  // Of library blocks only those that may ask for a task (checks/task_needs.cpp).
  const bool matters = !pou.library || (pou.kind == PouKind::FunctionBlock && pou.decl &&
                                        !context.tree().decl(pou.decl).pragmas.empty());
  if (matters && context.pou) context.project.call_edges.push_back({context.pou, callee, loc});
}

void sortEffects(Project& project) {
  std::stable_sort(project.call_edges.begin(), project.call_edges.end(),
                   [](const auto& a, const auto& b) { return a.caller.index < b.caller.index; });
  std::stable_sort(project.global_writes.begin(), project.global_writes.end(),
                   [](const auto& a, const auto& b) { return a.pou.index < b.pou.index; });
}

}  // namespace rung::sema

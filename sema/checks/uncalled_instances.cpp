// SPDX-License-Identifier: Apache-2.0
// Warns of a local instance whose outputs are read but that nothing calls: the outputs never change. Only instances are
// reported of which nothing but the outputs is used, and that neither other code nor a task can reach.
//   passes  delay(IN := run, PT := T#1s); lamp := delay.Q;
//   fails   lamp := delay.Q;                                         with VAR delay : TON; END_VAR
// Called once, when all bodies are checked. Linear in the expressions.
#include "sema/checks/rules.h"

#include "frontend/syntax/children.h"
#include "sema/bodies/names.h"
#include "sema/declarations/mentions.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// How the bodies of the project use each variable.
class Uses {
 public:
  explicit Uses(const Context& context)
      : tree_(context.tree()), context_(context), reads_(context.symbols.vars.size()), other_(reads_.size()) {}

  void note(VarId id) { other_[id.index] = true; }
  bool onlyRead(VarId id) const { return reads_[id.index] && !other_[id.index]; }

  void walk(StmtId id) {
    forEachChild(tree_, id, [&](auto child) { walk(child); });
  }
  void walk(ExprId id) {
    if (tree_.kind(id) == ExprKind::Member && noteRead(tree_.as<MemberExpr>(id))) return;
    if (const Entity entity = entityOf(context_, id); entity.entityKind() == EntityKind::Var)
      other_[entity.index] = true;
    forEachChild(tree_, id, [&](auto child) { walk(child); });
  }
  void walk(TypeExprId) {}
  void walk(DeclId) {}

 private:
  // instance.OUTPUT
  bool noteRead(const MemberExpr& member) {
    const Entity base = entityOf(context_, member.base);
    if (base.entityKind() != EntityKind::Var || meaning(member.h).entity.entityKind() != EntityKind::Var) return false;
    if (tree_.kind(member.base) != ExprKind::Name) return false;
    if (context_.symbols.var({meaning(member.h).entity.index}).section != SectionKind::Output) return false;
    reads_[base.index] = true;
    return true;
  }

  const Tree& tree_;
  const Context& context_;
  std::vector<bool> reads_, other_;
};

bool hasBody(const Context& context, PouId id) {
  const Pou& pou = context.symbols.pou(id);
  if (pou.kind != PouKind::FunctionBlock || pou.object.extended || !pou.decl) return false;
  const PouDecl& decl = context.tree().as<PouDecl>(pou.decl);
  return pou.pragmas.native || pou.cpp.is_body || decl.body_kind == BodyKind::Native || !pou.body.code.empty();
}

// Locals that may be such instances: who calls one, or passes it on, may write it.
std::vector<VarId> candidates(const Context& context) {
  const Symbols& symbols = context.symbols;
  std::vector<VarId> found;
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    const Pou& pou = symbols.pous[i];
    if (pou.library || pou.cpp.is_body || pou.object.extended || pou.base || !pou.decl || !pou.progress.checked())
      continue;
    for (const VarId id : pou.vars) {
      const Var& var = symbols.var(id);
      if (var.section != SectionKind::Local || !var.name || var.used.reads == 0 || var.used.writes != 0) continue;
      const NamedType* named = context.scopes.named(context.types().resolve(var.type));
      if (named != nullptr && named->pou && hasBody(context, named->pou)) found.push_back(id);
    }
  }
  return found;
}

}  // namespace

void checkUncalledInstances(Context& context) {
  const Symbols& symbols = context.symbols;
  if (symbols.diagnostics.hasErrors()) return;
  const std::vector<VarId> instances = candidates(context);
  if (instances.empty()) return;
  Uses uses(context);
  std::vector<bool> wanted(symbols.vars.size());
  for (const VarId id : instances) wanted[id.index] = true;
  const BodiesWith bodies(context.project, std::move(wanted));
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    const Pou& pou = symbols.pous[i];
    if (!pou.decl || pou.generic || !pou.progress.checked() || pou.cpp.is_body || !bodies.mayMention(pou)) continue;
    for (const StmtId id : context.tree().list(pou.body.code)) uses.walk(id);
  }
  for (const BlockTask& task : context.project.block_tasks) uses.note(task.block);
  for (const VarId id : instances)
    if (uses.onlyRead(id))
      context.report(diag::NeverCalled, symbols.var(id).loc, {string(context, symbols.var(id).name)});
}

}  // namespace rung::sema

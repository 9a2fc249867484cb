// SPDX-License-Identifier: Apache-2.0
// Warns of a VAR_TEMP without an initial value that is read in a statement before any statement sets it: it begins each
// call with the default of its type, which looks like a value kept from the call before. In a loop, a value set later
// in the loop counts.
//   passes  sum := a + b; mean := sum / 2;                          with VAR_TEMP sum : INT; END_VAR
//   fails   count := count + 1;                                     with VAR_TEMP count : INT; END_VAR
// Called once, when all bodies are checked. Linear in the statements.
#include "sema/checks/rules.h"

#include "frontend/syntax/children.h"
#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

class TempWalk {
 public:
  TempWalk(Context& context, std::vector<bool> is_unset)
      : context_(context), tree_(context.tree()), is_unset_(std::move(is_unset)) {}

  void walk(Slice<StmtId> list) {
    for (const StmtId id : tree_.list(list)) statement(id);
  }

 private:
  void statement(StmtId id) {
    const StmtKind kind = tree_.kind(id);
    if (kind == StmtKind::Assign) {
      const AssignStmt& node = tree_.as<AssignStmt>(id);
      read(node.value);
      if (node.op() != AssignOp::Assign && node.op() != AssignOp::Reference) read(node.target);
      setAll(node.target);
    } else if (kind == StmtKind::For || kind == StmtKind::While || kind == StmtKind::Repeat) {
      setIn(id);
    } else if (kind == StmtKind::If) {
      for (const IfBranch& branch : tree_.list(tree_.as<IfStmt>(id).branches)) {
        read(branch.condition);
        walk(branch.body);
      }
      walk(tree_.as<IfStmt>(id).otherwise);
    } else if (kind == StmtKind::Case) {
      read(tree_.as<CaseStmt>(id).selector);
      for (const CaseBranch& branch : tree_.list(tree_.as<CaseStmt>(id).branches)) walk(branch.body);
      walk(tree_.as<CaseStmt>(id).otherwise);
    } else {
      setIn(id);  // calls, which may set any argument, and the blocks of __TRY
    }
  }

  // A read of a plain variable; what is passed to a call may be set by it.
  void read(ExprId id) {
    if (tree_.kind(id) == ExprKind::Call || tree_.kind(id) == ExprKind::AddressOf || tree_.kind(id) == ExprKind::Assign)
      return setAll(id);
    if (tree_.kind(id) == ExprKind::Name) {
      const Entity entity = meaning(tree_, id).entity;
      if (entity.entityKind() != EntityKind::Var || !is_unset_[entity.index]) return;
      is_unset_[entity.index] = false;
      const Var& var = context_.symbols.var({entity.index});
      context_.report(diag::TempUnset, tree_.loc(id), {string(context_, var.name)}).declaredHere(var.loc);
      return;
    }
    forEachOperand(tree_, id, [&](ExprId operand) { read(operand); });
  }

  void setAll(ExprId id) {
    if (tree_.kind(id) == ExprKind::Name) {
      const Entity entity = meaning(tree_, id).entity;
      if (entity.entityKind() == EntityKind::Var) is_unset_[entity.index] = false;
    }
    forEachOperand(tree_, id, [&](ExprId operand) { setAll(operand); });
  }
  void setIn(StmtId id) {
    forEachChild(tree_, id, [&](auto child) {
      if constexpr (std::is_same_v<decltype(child), ExprId>) setAll(child);
      if constexpr (std::is_same_v<decltype(child), StmtId>) setIn(child);
    });
  }

  Context& context_;
  const Tree& tree_;
  std::vector<bool> is_unset_;  // by VarId
};

}  // namespace

void checkUnsetTemporaries(Context& context) {
  const Symbols& symbols = context.symbols;
  if (symbols.diagnostics.hasErrors()) return;
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    const Pou& pou = symbols.pous[i];
    if (pou.library || !pou.decl || !pou.progress.checked()) continue;
    const PouDecl& decl = context.tree().as<PouDecl>(pou.decl);
    if (decl.body_kind != BodyKind::St) continue;
    std::vector<bool> is_unset;
    for (const VarId id : pou.vars) {
      const Var& var = symbols.var(id);
      const types::TypeKind kind = context.types().plainKind(var.type);
      if (var.section != SectionKind::Temp || var.temporary != 0 || var.init || var.sharing.field ||
          !types::TypeTable::isScalar(kind))
        continue;
      is_unset.resize(symbols.vars.size());
      is_unset[id.index] = true;
    }
    if (!is_unset.empty()) TempWalk(context, std::move(is_unset)).walk(pou.body.code);
  }
}

}  // namespace rung::sema

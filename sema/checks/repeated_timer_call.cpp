// SPDX-License-Identifier: Apache-2.0
// Warns of two calls of one timer that both run in each cycle: the second one sees no edge that the first one has seen,
// or starts what the first one stopped. A timer is a library block with a TIME input and a TIME output. Calls in
// branches and a call with a constant FALSE, which resets the timer, are not reported, and neither is Instruction List,
// whose input operators PT and IN are calls.
//   passes  IF slow THEN delay(IN := run, PT := T#2s); ELSE delay(IN := run, PT := T#1s); END_IF
//   passes  delay(IN := FALSE); delay(IN := TRUE, PT := T#1s);
//   fails   delay(IN := a, PT := T#1s); delay(IN := b, PT := T#2s);
// Called once, when all bodies are checked. Linear in the statements.
#include "sema/checks/rules.h"

#include <map>

#include "frontend/syntax/children.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

using types::TypeKind;

class TimerCalls {
 public:
  explicit TimerCalls(Context& context) : context_(context), tree_(context.tree()) {}

  void walk(Slice<StmtId> list) {
    std::map<uint32_t, Loc> called;  // by VarId: the first call
    for (const StmtId id : tree_.list(list)) {
      if (tree_.kind(id) == StmtKind::Label) called.clear();
      if (tree_.kind(id) == StmtKind::Call) note(tree_.as<CallStmt>(id).call, called);
      walkBlocks(id);
    }
  }

 private:
  void walkBlocks(StmtId id) {
    switch (tree_.kind(id)) {
      case StmtKind::If:
        for (const IfBranch& branch : tree_.list(tree_.as<IfStmt>(id).branches)) walk(branch.body);
        return walk(tree_.as<IfStmt>(id).otherwise);
      case StmtKind::Case:
        for (const CaseBranch& branch : tree_.list(tree_.as<CaseStmt>(id).branches)) walk(branch.body);
        return walk(tree_.as<CaseStmt>(id).otherwise);
      case StmtKind::For: return walk(tree_.as<ForStmt>(id).body);
      case StmtKind::While: return walk(tree_.as<WhileStmt>(id).body);
      case StmtKind::Repeat: return walk(tree_.as<RepeatStmt>(id).body);
      case StmtKind::Try: return walk(tree_.as<TryStmt>(id).body);
      case StmtKind::Error:
      case StmtKind::Empty:
      case StmtKind::Assign:
      case StmtKind::Call:
      case StmtKind::Exit:
      case StmtKind::Continue:
      case StmtKind::Return:
      case StmtKind::Jump:
      case StmtKind::Label: return;
    }
  }

  // Only plain variables: the elements of an array are told apart by their index.
  void note(ExprId expr, std::map<uint32_t, Loc>& called) {
    if (tree_.kind(expr) != ExprKind::Call) return;
    const CallExpr& call = tree_.as<CallExpr>(expr);
    if (tree_.kind(call.callee) != ExprKind::Name) return;
    const Entity entity = meaning(tree_, call.callee).entity;
    if (entity.entityKind() != EntityKind::Var) return;
    const Var& var = context_.symbols.var({entity.index});
    if (!isTimer(var.type) || resets(call)) return;
    const auto [first, is_new] = called.insert({entity.index, tree_.loc(call.callee)});
    if (is_new) return;
    context_.report(diag::TimerCalledTwice, tree_.loc(call.callee), {string(context_, var.name)})
        .note(first->second, Note{"the first call is here"});
  }

  bool isTimer(TypeId type) const {
    type = context_.types().resolve(type);
    if (context_.types().kind(type) != TypeKind::Record) return false;
    const NamedType* named = context_.scopes.named(type);
    if (named == nullptr || !named->pou || !context_.symbols.pou(named->pou).library) return false;
    bool has_input = false, has_output = false;
    for (const VarId id : context_.symbols.pou(named->pou).vars) {
      const Var& var = context_.symbols.var(id);
      const TypeKind kind = context_.types().plainKind(var.type);
      if (kind != TypeKind::Time && kind != TypeKind::LTime) continue;
      has_input = has_input || var.section == SectionKind::Input;
      has_output = has_output || var.section == SectionKind::Output;
    }
    return has_input && has_output;
  }

  bool resets(const CallExpr& call) const {
    for (const Argument& argument : tree_.list(call.arguments)) {
      if (!argument.value || tree_.kind(argument.value) != ExprKind::Literal || argument.is_output) continue;
      if (context_.types().plainKind(typeOf(tree_, argument.value)) == TypeKind::Bool &&
          tree_.as<LiteralExpr>(argument.value).value() == 0)
        return true;
    }
    return false;
  }

  Context& context_;
  const Tree& tree_;
};

}  // namespace

void checkRepeatedTimerCalls(Context& context) {
  if (context.symbols.diagnostics.hasErrors()) return;
  for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
    const Pou& pou = context.symbols.pous[i];
    if (pou.library || pou.pragmas.test || pou.pragmas.test_only || !pou.decl || !pou.progress.checked()) continue;
    const PouDecl& decl = context.tree().as<PouDecl>(pou.decl);
    if (decl.body_kind != BodyKind::Il) TimerCalls(context).walk(pou.body.code);
  }
}

}  // namespace rung::sema

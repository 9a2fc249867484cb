// SPDX-License-Identifier: Apache-2.0
// A block or function gets an input, and each call of it in ST a value for it.
//   FUNCTION_BLOCK Ramp … ramp(step := 1.0);     VAR_INPUT newInput : BOOL; END_VAR … ramp(step := 1.0, newInput :=
//   FALSE);
#include <algorithm>

#include "frontend/syntax/children.h"
#include "tools/ide/cursor.h"
#include "tools/ide/navigation.h"
#include "tools/ide/references.h"
#include "tools/ide/selection.h"

namespace rung::ide {
namespace {

// The calls of a POU in what was written.
class CallsOf {
 public:
  CallsOf(const View& view, PouId callee) : view_(view), tree_(view.tree()), callee_(callee) {
    for (const FileUnit& unit : tree_.files)
      for (const DeclId decl : tree_.list(unit.decls)) visit(decl, {});
  }
  const std::vector<ExprId>& all() const { return found_; }

 private:
  template <class Id>
  void visit(Id id, PouId pou) {
    if constexpr (std::is_same_v<Id, DeclId>)
      if (tree_.kind(id) == DeclKind::Pou) pou = view_.meanings().scope().pouOf(id);
    if constexpr (std::is_same_v<Id, ExprId>)
      if (tree_.kind(id) == ExprKind::Call && pou && isOfCallee(tree_.as<CallExpr>(id), pou)) found_.push_back(id);
    forEachChild(tree_, id, [&](const auto& child) { visit(child, pou); });
  }
  bool isOfCallee(const CallExpr& call, PouId pou) const {
    if (!call.callee) return false;
    return calledBy(view_.meanings().scope(), view_.meanings().valueOf(pou, call.callee)) == callee_;
  }

  const View& view_;
  const Tree& tree_;
  PouId callee_;
  std::vector<ExprId> found_;
};

// Each use of a function outside of its body is one of these calls: a call that lacks an argument is an error.
bool areAllCalls(const View& view, const NamePlace& name, const std::vector<ExprId>& calls, DeclId decl) {
  const FileRange own = view.inFile(view.tree().range(decl));
  for (const Reference& reference : referencesTo(view, Family(view.meanings().scope(), name.entity), {})) {
    const FileRange& at = reference.at;
    if (at.file == own.file && own.begin <= at.begin && at.end <= own.end) continue;
    const auto isCallee = [&](ExprId call) {
      return view.nameInFile(view.tree().loc(view.tree().as<CallExpr>(call).callee)) == at;
    };
    if (std::none_of(calls.begin(), calls.end(), isCallee)) return false;
  }
  return true;
}

Fix::Edit withArgument(const Selection& selection, const CallExpr& call, const std::string& pin) {
  const bool is_named = call.arguments.empty() || selection.tree().list(call.arguments)[0].pin.name;
  const std::string argument = (is_named ? pin + " := " : "") + "FALSE";
  if (call.is_bare) return {call.h.end, call.h.end, "(" + argument + ")"};
  return {call.end, call.end, (call.arguments.empty() ? "" : ", ") + argument};
}

}  // namespace

void addNewPin(const Selection& selection, std::vector<CodeAction>& actions) {
  const View& view = selection.view;
  const std::optional<NamePlace> name = nameAt(view, selection.range.file, selection.range.begin);
  if (!name || !name->is_declaration || name->entity.entityKind() != EntityKind::Pou) return;
  const PouId callee{name->entity.index};
  const sema::Pou& pou = selection.project().pou(callee);
  if (pou.owner || (pou.kind != PouKind::Function && pou.kind != PouKind::FunctionBlock)) return;
  const std::string pin = selection.freshName("newInput");
  const PouDecl& decl = view.tree().as<PouDecl>(pou.decl);
  std::vector<Fix::Edit> edits = {declarationIn(selection.written(), decl, SectionKind::Input, pin + " : BOOL")};
  const CallsOf calls(view, callee);
  const std::vector<VarId> pins = selection.scope().pinsOf(callee);
  const bool has_in_out = std::any_of(
      pins.begin(), pins.end(), [&](VarId id) { return selection.project().var(id).section == SectionKind::InOut; });
  if (has_in_out && pou.kind == PouKind::Function) return;  // which a call without names gives after the inputs
  for (const ExprId call : calls.all()) edits.push_back(withArgument(selection, view.tree().as<CallExpr>(call), pin));
  if (pou.kind == PouKind::Function && !areAllCalls(view, *name, calls.all(), pou.decl)) return;
  const std::string title = "Add an input to `" + std::string(view.names().string(pou.name)) + "` and its calls";
  actions.push_back(codeAction(view, title, ActionKind::Rewrite, std::move(edits)));
}

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// A variable that is set once and read in the next statement only becomes its value.
//   sum := a + b; IF sum > 3 THEN …     IF (a + b) > 3 THEN …
#include <algorithm>

#include "frontend/syntax/children.h"
#include "tools/ide/navigation.h"
#include "tools/ide/references.h"
#include "tools/ide/selection.h"

namespace rung::ide {
namespace {

// The assignments to a variable in a body, each with the statement after it in its list; none: it is the last.
class Assignments {
 public:
  struct Found {
    StmtId stmt, next;
  };
  Assignments(const Selection& selection, VarId var) : selection_(selection), tree_(selection.tree()), var_(var) {}

  std::vector<Found> of(const PouDecl& pou) {
    visitList(tree_.list(pou.body));
    return std::move(found_);
  }

 private:
  void visitList(std::span<const StmtId> list) {
    for (size_t i = 0; i < list.size(); ++i) {
      if (assigns(list[i])) found_.push_back({list[i], i + 1 < list.size() ? list[i + 1] : StmtId{}});
      visitInner(list[i]);
    }
  }
  // Each list of statements in it.
  void visitInner(StmtId stmt) {
    std::vector<StmtId> children;
    forEachChild(tree_, stmt, [&](const auto& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, StmtId>) children.push_back(child);
    });
    size_t at = 0;
    while (at < children.size()) {
      const std::span<const StmtId> list = listWith(tree_, stmt, children[at]);
      if (list.empty()) return;
      visitList(list);
      at += list.size();
    }
  }
  bool assigns(StmtId stmt) const {
    if (tree_.kind(stmt) != StmtKind::Assign) return false;
    const AssignStmt& node = tree_.as<AssignStmt>(stmt);
    if (node.op() != AssignOp::Assign || tree_.kind(node.target) != ExprKind::Name) return false;
    const Entity entity = selection_.view.meanings().valueOf(selection_.pou, node.target).entity;
    return entity.entityKind() == EntityKind::Var && entity.index == var_.index;
  }

  const Selection& selection_;
  const Tree& tree_;
  VarId var_;
  std::vector<Found> found_;
};

bool hasCall(const Tree& tree, ExprId expr) {
  bool found = tree.kind(expr) == ExprKind::Call;
  forEachChild(tree, expr, [&](const auto& child) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, ExprId>) found = found || hasCall(tree, child);
  });
  return found;
}

// The name is an argument of its own, which may need an lvalue.
bool isArgument(const Selection& selection, const FileRange& name) {
  const Loc at = selection.view.parsedAt(name.file, name.begin);
  const FileUnit* const unit = selection.view.unitWith(at);
  if (unit == nullptr) return true;
  const std::vector<NodeRef> path = nodeAt(selection.tree(), *unit, at);
  if (path.size() < 2 || path[path.size() - 2].category != NodeRef::Category::Expr) return false;
  return selection.tree().kind(ExprId{path[path.size() - 2].word}) == ExprKind::Call;
}

// What the statement evaluates once, before it does anything: the reads of the variable must be in it.
Range evaluatedFirst(const Tree& tree, StmtId stmt) {
  const StmtKind kind = tree.kind(stmt);
  if (kind == StmtKind::Assign) return tree.range(tree.as<AssignStmt>(stmt).value);
  if (kind == StmtKind::Call) return tree.range(tree.as<CallStmt>(stmt).call);
  if (kind == StmtKind::Case) return tree.range(tree.as<CaseStmt>(stmt).selector);
  if (kind == StmtKind::If) return tree.range(tree.list(tree.as<IfStmt>(stmt).branches)[0].condition);
  return {};
}

bool isLocal(const sema::Var& var) {
  return var.section == SectionKind::Local || var.section == SectionKind::Temp || var.section == SectionKind::Stat;
}

}  // namespace

void addInlining(const Selection& selection, std::vector<CodeAction>& actions) {
  const View& view = selection.view;
  const std::optional<NamePlace> name = nameAt(view, selection.range.file, selection.range.begin);
  if (!name || name->entity.entityKind() != EntityKind::Var) return;
  const VarId id{name->entity.index};
  const sema::Var& var = selection.project().var(id);
  if (!isLocal(var) || var.pou != selection.pou || !var.decl) return;
  const std::vector<Assignments::Found> assignments = Assignments(selection, id).of(selection.pouDecl());
  if (assignments.size() != 1 || !assignments[0].next) return;
  const Tree& tree = selection.tree();
  const AssignStmt& set = tree.as<AssignStmt>(assignments[0].stmt);
  const FileRange reads_in = view.inFile(evaluatedFirst(tree, assignments[0].next));
  const FileRange target = view.inFile(tree.range(set.target));
  std::vector<FileRange> reads;
  for (const Reference& reference : referencesTo(view, Family(selection.scope(), name->entity), {})) {
    if (reference.is_declaration || reference.at == target) continue;
    const bool is_in = reads_in && reference.at.file == reads_in.file && reads_in.begin <= reference.at.begin &&
                       reference.at.end <= reads_in.end;
    if (!is_in || reference.kind != ReferenceKind::Read || isArgument(selection, reference.at)) return;
    reads.push_back(reference.at);
  }
  if (reads.empty() || (reads.size() > 1 && hasCall(tree, set.value))) return;
  std::string value = selection.text(tree.range(set.value));
  const bool is_operation = tree.kind(set.value) == ExprKind::Binary || tree.kind(set.value) == ExprKind::Unary;
  if (is_operation && tree.expr(set.value).in_parens == 0) value = "(" + value + ")";
  const Range line = withBlanks(view.sources(), tree.range(assignments[0].stmt));
  const Removal gone = declarationGone(selection.written(), selection.pouDecl(), var.decl, var.loc);
  if (!gone.edit.begin) return;
  const std::string title = "Inline variable `" + std::string(view.names().string(var.name)) + "`";
  CodeAction action = codeAction(view, title, ActionKind::Inline, {{line.begin, line.end, {}}, gone.edit});
  if (action.edits.empty()) return;
  for (const FileRange& read : reads) action.edits.push_back({read, value});
  actions.push_back(std::move(action));
}

}  // namespace rung::ide

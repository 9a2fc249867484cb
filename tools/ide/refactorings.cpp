// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/refactorings.h"

#include <algorithm>

#include "frontend/source/fixes.h"
#include "frontend/syntax/children.h"
#include "tools/ide/selection.h"

namespace rung::ide {
namespace {

// Finds the code that was made of an expression.
class CodeSearch {
 public:
  CodeSearch(const Tree& tree, ExprId written)
      : tree_(tree), written_(tree.expr(written)), begin_(tree.begin(written)) {}

  template <class Id>
  void search(Id id) {
    if (found_) return;
    if constexpr (std::is_same_v<Id, ExprId>) {
      const ExprHeader& header = tree_.expr(id);
      if (!header.has_room) return;
      if (header.kind == written_.kind && header.end == written_.end && tree_.begin(id) == begin_) found_ = id;
    }
    if constexpr (!std::is_same_v<Id, DeclId>)
      if (!found_) forEachChild(tree_, id, [&](const auto& child) { search(child); });
  }
  ExprId found() const { return found_; }

 private:
  const Tree& tree_;
  const ExprHeader& written_;
  Loc begin_;
  ExprId found_;
};

FileRange withoutBlanks(const View& view, FileRange range) {
  const std::string_view text = view.textOf(range.file);
  while (range.begin < range.end && isBlankCharacter(text[range.begin])) ++range.begin;
  while (range.begin < range.end && isBlankCharacter(text[range.end - 1])) --range.end;
  return range;
}

}  // namespace

const PouDecl& Selection::pouDecl() const { return tree().as<PouDecl>(project().pou(pou).decl); }

const PouDecl& Selection::declaringPou() const {
  const sema::Pou& of = project().pou(pou);
  return of.kind == PouKind::Action && of.owner ? tree().as<PouDecl>(project().pou(of.owner).decl) : pouDecl();
}

std::string Selection::freshName(const std::string& base) const {
  for (uint32_t number = 1;; ++number) {
    std::string name = number == 1 ? base : base + std::to_string(number);
    if (!view.names().find(name)) return name;
  }
}

TypeId Selection::typeOf(ExprId expr) const {
  CodeSearch search(tree(), expr);
  for (const StmtId stmt : tree().list(project().pou(pou).body.code)) search.search(stmt);
  const TypeId type = search.found() ? sema::meaning(tree(), search.found()).type : TypeId{};
  return type == types::kError ? TypeId{} : type;
}

std::optional<Selection> selectionAt(const View& view, const FileRange& range) {
  if (view.snapshot().project() == nullptr || range.end > view.textOf(range.file).size()) return std::nullopt;
  Selection selection{view, withoutBlanks(view, range), {}, {}, {}};
  const Loc begin = view.parsedAt(range.file, selection.range.begin);
  const FileUnit* const unit = view.unitWith(begin);
  if (!begin || unit == nullptr) return std::nullopt;
  const Loc end{begin.offset + (selection.range.end - selection.range.begin)};
  // One piece of the file, byte by byte.
  if (view.bytesInFile(begin, 0).begin != selection.range.begin ||
      view.bytesInFile(end, 0).begin != selection.range.end)
    return std::nullopt;
  selection.parsed = {begin, end};
  selection.path = nodeAt(view.tree(), *unit, begin);
  selection.pou = view.meanings().pouAt(begin);
  if (!selection.pou) return std::nullopt;
  const sema::Pou& pou = selection.project().pou(selection.pou);
  if (pou.library || !pou.decl || view.tree().kind(pou.decl) != DeclKind::Pou) return std::nullopt;
  return selection;
}

std::span<const StmtId> listWith(const Tree& tree, NodeRef parent, StmtId stmt) {
  std::span<const StmtId> found;
  const auto look = [&](Slice<StmtId> list) {
    const std::span<const StmtId> items = tree.list(list);
    if (std::find(items.begin(), items.end(), stmt) != items.end()) found = items;
  };
  if (parent.category == NodeRef::Category::Decl && tree.kind(DeclId{parent.word}) == DeclKind::Pou)
    look(tree.as<PouDecl>(DeclId{parent.word}).body);
  if (parent.category != NodeRef::Category::Stmt) return found;
  const StmtId of{parent.word};
  const StmtKind kind = tree.kind(of);
  if (kind == StmtKind::If) {
    for (const IfBranch& branch : tree.list(tree.as<IfStmt>(of).branches)) look(branch.body);
    look(tree.as<IfStmt>(of).otherwise);
  } else if (kind == StmtKind::Case) {
    for (const CaseBranch& branch : tree.list(tree.as<CaseStmt>(of).branches)) look(branch.body);
    look(tree.as<CaseStmt>(of).otherwise);
  } else if (kind == StmtKind::For) {
    look(tree.as<ForStmt>(of).body);
  } else if (kind == StmtKind::While) {
    look(tree.as<WhileStmt>(of).body);
  } else if (kind == StmtKind::Repeat) {
    look(tree.as<RepeatStmt>(of).body);
  }
  return found;
}

Loc findSign(const View& view, Loc from, Loc to, std::string_view word) {
  const FileId file = view.sources().fileOf(from);
  if (!file || to <= from) return {};
  const uint32_t base = view.sources().begin(file).offset;
  Scanner scanner(view.sources().original(file).substr(0, to.offset - base));
  scanner.moveTo(from.offset - base);
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
    if (sameIdentifier(scanner.textOf(unit), word)) return {base + static_cast<uint32_t>(unit.begin)};
  return {};
}

CodeAction codeAction(const View& view, std::string title, ActionKind kind, std::vector<Fix::Edit> edits) {
  CodeAction action{std::move(title), kind, false, {}, nullptr};
  const Diagnostic none{diagOf("E0401"), Severity::Note, {}, {}, {}, 0, {}, {}, {}, 0, {}};
  for (FileEdit& edit : fileEdits(view.sources(), none, {{}, std::move(edits), false}))
    action.edits.push_back({{edit.file, edit.begin, edit.end}, std::move(edit.text)});
  return action;
}

std::vector<CodeAction> refactoringsAt(const View& view, const FileRange& range) {
  std::vector<CodeAction> actions;
  const std::optional<Selection> selection = selectionAt(view, range);
  if (!selection) return actions;
  addExtractions(*selection, actions);
  addInlining(*selection, actions);
  addConversionsOfChains(*selection, actions);
  addNewPin(*selection, actions);
  std::erase_if(actions, [](const CodeAction& action) { return action.edits.empty(); });
  return actions;
}

}  // namespace rung::ide

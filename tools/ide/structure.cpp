// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/structure.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "frontend/syntax/children.h"
#include "frontend/syntax/node_at.h"

namespace rung::ide {
namespace {

class Folder {
 public:
  Folder(const View& view, FileId file) : view_(view), tree_(view.tree()), file_(file) {}

  std::vector<Fold> folds() {
    for (const FileUnit* unit : view_.unitsOf(file_)) {
      for (const DeclId decl : tree_.list(unit->decls)) visit(decl);
      comments(*unit);
    }
    std::sort(folds_.begin(), folds_.end(), [](const Fold& a, const Fold& b) { return a.range.begin < b.range.begin; });
    return std::move(folds_);
  }

 private:
  void add(Range range, FoldKind kind, bool keeps_last_line) {
    const FileRange at = view_.inFile(range);
    if (at.file != file_) return;
    const std::string_view text = view_.textOf(file_).substr(at.begin, at.end - at.begin);
    if (text.find('\n') != std::string_view::npos || text.find('\r') != std::string_view::npos)
      folds_.push_back({at, kind, keeps_last_line});
  }

  template <class Id>
  void visit(Id id) {
    if (isFolded(id)) add(extentOf(tree_, id), FoldKind::Code, true);
    if constexpr (std::is_same_v<Id, StmtId>) branches(id);
    forEachChild(tree_, id, [&](const auto& child) { visit(child); });
  }

  bool isFolded(DeclId id) const { return tree_.kind(id) != DeclKind::Var && tree_.kind(id) != DeclKind::Using; }
  bool isFolded(StmtId id) const {
    const StmtKind kind = tree_.kind(id);
    return kind == StmtKind::If || kind == StmtKind::Case || kind == StmtKind::For || kind == StmtKind::While ||
           kind == StmtKind::Repeat || kind == StmtKind::Try || kind == StmtKind::Call || kind == StmtKind::Assign;
  }
  bool isFolded(ExprId) const { return false; }
  bool isFolded(TypeExprId id) const { return tree_.kind(id) == TypeExprKind::Struct; }

  void branches(StmtId id) {
    if (tree_.kind(id) == StmtKind::If)
      for (const IfBranch& branch : tree_.list(tree_.as<IfStmt>(id).branches)) body(branch.condition, branch.body);
    if (tree_.kind(id) == StmtKind::Case)
      for (const CaseBranch& branch : tree_.list(tree_.as<CaseStmt>(id).branches))
        if (const auto labels = tree_.list(branch.labels); !labels.empty()) body(labels.front(), branch.body);
  }
  // From the condition to the last statement.
  void body(ExprId head, Slice<StmtId> statements) {
    const auto list = tree_.list(statements);
    if (head && !list.empty()) add({tree_.range(head).begin, tree_.range(list.back()).end}, FoldKind::Code, false);
  }

  // Comments of several lines, `//` lines that follow each other, and regions.
  void comments(const FileUnit& unit) {
    const std::string_view source = view_.sources().sourceText(unit.file);
    const uint32_t base = view_.sources().begin(unit.file).offset;
    const auto at = [&](size_t offset) { return Loc{base + static_cast<uint32_t>(offset)}; };
    std::vector<Loc> regions;
    Range lines;
    const auto flush = [&] {
      if (lines.begin) add(lines, FoldKind::Comment, false);
      lines = {};
    };
    Scanner scanner(source);
    for (Unit piece = scanner.next(); piece.kind != UnitKind::End; piece = scanner.next()) {
      const std::string_view text = scanner.textOf(piece);
      if (piece.kind == UnitKind::Comment && text.starts_with("//")) {
        if (!lines.begin) lines.begin = at(piece.begin);
        lines.end = at(piece.end);
        continue;
      }
      flush();
      if (piece.kind == UnitKind::Comment) add({at(piece.begin), at(piece.end)}, FoldKind::Comment, false);
      if (piece.kind == UnitKind::Pragma) region(text, at(piece.begin), at(piece.end), regions);
    }
    flush();
  }

  void region(std::string_view pragma, Loc begin, Loc end, std::vector<Loc>& open) {
    const std::string word = upper(pragma.substr(1, pragma.find_first_of(" \t'}", 1) - 1));
    if (word == "REGION") {
      open.push_back(begin);
    } else if (word == "ENDREGION" && !open.empty()) {
      add({open.back(), end}, FoldKind::Region, false);
      open.pop_back();
    }
  }

  const View& view_;
  const Tree& tree_;
  FileId file_;
  std::vector<Fold> folds_;
};

}  // namespace

std::vector<Fold> foldsOf(const View& view, FileId file) { return Folder(view, file).folds(); }

std::vector<FileRange> selectionAt(const View& view, FileId file, uint32_t byte) {
  std::vector<FileRange> ranges;
  const auto add = [&](const FileRange& range) {
    if (range.file != file || range.begin > byte || range.end < byte) return;
    const bool is_larger = ranges.empty() || (range.begin <= ranges.back().begin && range.end >= ranges.back().end &&
                                              range != ranges.back());
    if (is_larger) ranges.push_back(range);
  };
  const Loc parsed = view.parsedAt(file, byte);
  if (const FileUnit* unit = parsed ? view.unitWith(parsed) : nullptr) {
    Scanner scanner(view.sources().sourceText(unit->file));
    const uint32_t offset = parsed.offset - view.sources().begin(unit->file).offset;
    for (Unit piece = scanner.next(); piece.kind != UnitKind::End && piece.begin <= offset; piece = scanner.next())
      if (offset < piece.end || (offset == piece.end && piece.kind == UnitKind::Name))
        add(view.inFile({{parsed.offset - offset + static_cast<uint32_t>(piece.begin)},
                         {parsed.offset - offset + static_cast<uint32_t>(piece.end)}}));
    std::vector<NodeRef> nodes = nodeAt(view.tree(), *unit, parsed);
    if (nodes.empty() && offset > 0) nodes = nodeAt(view.tree(), *unit, {parsed.offset - 1});
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) add(view.inFile(extentOf(view.tree(), *node)));
  }
  constexpr size_t kMost = 100;  // clients read them by recursion
  if (ranges.size() > kMost) ranges.resize(kMost);
  add({file, 0, static_cast<uint32_t>(view.textOf(file).size())});
  return ranges;
}

}  // namespace rung::ide

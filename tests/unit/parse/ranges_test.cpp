// SPDX-License-Identifier: Apache-2.0
// Tree::range over all programs of the suite: the range of a node lies within that of its parent, ends with the token
// that ends such a node, and the text of an expression or type, parsed alone, gives the same node.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "frontend/parse/parse.h"
#include "frontend/syntax/children.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

class RangeCheck {
 public:
  explicit RangeCheck(const std::string& path) : path_(path) {
    file_ = sources_.add(path, readFile(path).content);
    unit_ = text::parseFile(tree_, names_, sources_, file_, Dialect::Codesys, diagnostics_);
  }
  bool valid() const { return !diagnostics_.hasErrors(); }
  void run() {
    const Loc begin = sources_.begin(file_);
    const Range whole{begin, {begin.offset + static_cast<uint32_t>(sources_.sourceText(file_).size())}};
    for (const DeclId decl : tree_.list(unit_.decls)) node(decl, whole);
  }
  uint32_t nodes = 0;

 private:
  std::string_view textOf(Range range) const {
    return sources_.sourceText(file_).substr(range.begin.offset - sources_.begin(file_).offset,
                                             range.end.offset - range.begin.offset);
  }
  std::string where(Range range) const {
    return path_ + ":" + std::to_string(sources_.lineNumber(range.begin)) + ": `" + std::string(textOf(range)) + "`";
  }

  template <class Id>
  void node(Id id, Range parent) {
    const Range range = tree_.range(id);
    ++nodes;
    ASSERT_TRUE(range.begin && range.begin <= range.end) << path_ << ":" << sources_.lineNumber(tree_.loc(id));
    if (!(range.begin < range.end)) return;  // the input of a setter, made from the header
    EXPECT_TRUE(parent.begin <= range.begin && range.end <= parent.end) << where(range) << " within " << where(parent);
    EXPECT_NE(std::string_view(" \t\r\n").find(textOf(range).front()), 0u) << where(range);
    EXPECT_EQ(std::string_view(" \t\r\n").find(textOf(range).back()), std::string_view::npos) << where(range);
    check(id, range);
    // An accessor's result and input have the type of the property.
    forEachChild(tree_, id, [&](auto& child) {
      if (!isShared(id, child)) node(child, range);
    });
  }
  template <class Parent, class Child>
  bool isShared(Parent, Child) const {
    return false;
  }
  bool isShared(DeclId parent, TypeExprId child) const {
    return tree_.kind(parent) != DeclKind::Property && !(tree_.decl(parent).begin <= tree_.typeExpr(child).loc);
  }
  // Members that follow the END_… of their block, and the second half of a property of edition 4.
  bool isShared(DeclId parent, DeclId child) const {
    const bool in_halves = tree_.kind(parent) == DeclKind::Property && tree_.as<PropertyDecl>(parent).in_halves;
    return in_halves || (tree_.kind(parent) == DeclKind::Pou && tree_.decl(parent).end <= tree_.decl(child).begin);
  }

  void check(ExprId id, Range range) {
    const ExprKind kind = tree_.kind(id);
    if (path_.ends_with("keywords_as_names.st") || path_.ends_with("statement_forms.st"))
      return;  // whether TO is a name depends on the rest of the file
    if (shape(kind) == ExprShape::Initializer || kind == ExprKind::Range || kind == ExprKind::Error) return;
    if (kind == ExprKind::Call && (!tree_.as<CallExpr>(id).callee || hasNestedIl(range))) return;
    const bool operator_name = kind == ExprKind::Name && isOperatorName(textOf(range));  // AND(a, b), a box ADD
    if (operator_name) return;
    if (kind == ExprKind::Deref && textOf(range).back() != '^') return;  // of SUPER in `SUPER()`
    const bool bare_assignment = kind == ExprKind::Assign && textOf(range).front() != '(';
    if (bare_assignment) return;  // an expression only as a condition or in parentheses
    reparse(std::string(textOf(range)), [&](FileId file) {
      const ExprId again = text::parseExpression(tree_, names_, sources_, file, Dialect::Codesys, diagnostics_);
      EXPECT_TRUE(again) << where(range);
      if (!again || (tree_.kind(id) == ExprKind::Call && tree_.as<CallExpr>(id).is_bare)) return;
      EXPECT_EQ(printExpression(tree_, names_, again), printExpression(tree_, names_, id)) << where(range);
    });
  }
  bool isWritten(ExprId id) const { return tree_.range(id).begin < tree_.range(id).end; }
  void check(StmtId id, Range range) {
    const std::string_view text = textOf(range);
    const StmtKind kind = tree_.kind(id);
    if (kind == StmtKind::Label) {
      EXPECT_EQ(text.back(), ':') << where(range);
    } else if (kind == StmtKind::Assign && !isWritten(tree_.as<AssignStmt>(id).target)) {
      // the condition of a named transition, which is assigned to its name
    } else if (kind == StmtKind::Assign && text.back() != ';' &&
               (text.find("R=") != text.npos || text.find("S=") != text.npos)) {
      // a part of a row, `a S= b R= c;`
    } else if (kind == StmtKind::Assign || kind == StmtKind::Call || kind == StmtKind::Exit) {
      EXPECT_TRUE(text.back() == ';') << where(range);
    } else {
      EXPECT_TRUE(text.back() == ';' || text.back() == ')' || std::isalpha(text.back())) << where(range);
    }
  }
  void check(TypeExprId id, Range range) {
    if (tree_.kind(id) == TypeExprKind::Error) return;
    if (tree_.kind(id) == TypeExprKind::Struct && tree_.as<StructTypeExpr>(id).base) return;  // only in TYPE
    reparse("PROGRAM p VAR x : " + std::string(textOf(range)) + "; END_VAR END_PROGRAM", [&](FileId file) {
      const FileUnit unit = text::parseFile(tree_, names_, sources_, file, Dialect::Codesys, diagnostics_);
      const Slice<DeclId> sections = tree_.as<PouDecl>(tree_.list(unit.decls)[0]).sections;
      ASSERT_EQ(sections.count, 1u) << where(range);
      const SectionDecl& section = tree_.as<SectionDecl>(tree_.list(sections)[0]);
      ASSERT_EQ(section.vars.count, 1u) << where(range);
      EXPECT_EQ(tree_.kind(tree_.as<VarDecl>(tree_.list(section.vars)[0]).type), tree_.kind(id)) << where(range);
    });
  }
  void check(DeclId id, Range range) {
    const std::string_view text = textOf(range);
    const DeclKind kind = tree_.kind(id);
    EXPECT_TRUE(kind != DeclKind::Var || text.back() == ';') << where(range);
    EXPECT_TRUE(kind != DeclKind::Section || sameIdentifier(text.substr(0, 3), "VAR")) << where(range);
  }

  template <class Parse>
  void reparse(std::string text, Parse parse) {
    const uint32_t errors = diagnostics_.errorCount();
    const std::string shown = text;
    parse(sources_.add("part.st", std::move(text)));
    EXPECT_EQ(diagnostics_.errorCount(), errors) << path_ << ": `" << shown << "`";
  }
  bool hasNestedIl(Range range) const { return textOf(range).find("(LD ") != std::string_view::npos; }
  static bool isOperatorName(std::string_view name) {
    for (const char* word : {"AND", "OR", "XOR", "MOD", "NOT"})
      if (sameIdentifier(name, word)) return true;
    return false;
  }

  std::string path_;
  Sources sources_;
  Names names_;
  Diagnostics diagnostics_{sources_};
  Tree tree_;
  FileId file_;
  FileUnit unit_;
};

TEST(Ranges, OfAllPrograms) {
  uint32_t programs = 0, nodes = 0;
  for (const char* folder : {"/tests/conformance", "/tests/programs", "/samples", "/stdlib"}) {
    for (const auto& entry : fs::recursive_directory_iterator(std::string(RUNG_SOURCE_ROOT) + folder)) {
      if (entry.path().extension() != ".st") continue;
      RangeCheck check(entry.path().string());
      if (!check.valid()) continue;
      check.run();
      ++programs;
      nodes += check.nodes;
    }
  }
  EXPECT_GT(programs, 300u);
  EXPECT_GT(nodes, 50'000u);
}

}  // namespace
}  // namespace rung

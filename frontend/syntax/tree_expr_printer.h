// SPDX-License-Identifier: Apache-2.0
// Expressions as the tree's text form prints them, in parentheses on one line: a part of tree_printer.cpp, which adds
// the lines of statements, types and declarations.
#pragma once

#include <string>

#include "frontend/syntax/tree.h"

namespace rung {

class TreeExprPrinter {
 public:
  // With `sources` the source of what could not be parsed is printed.
  TreeExprPrinter(const Tree& tree, const Names& names, const Sources* sources)
      : tree_(tree), names_(names), sources_(sources) {}
  std::string out;

 protected:
  void line(int depth) {
    if (!out.empty()) out += '\n';
    out.append(static_cast<size_t>(depth) * 2, ' ');
  }
  void line(int depth, std::string_view text) {
    line(depth);
    out += text;
  }
  void name(NameId id) { out += names_.string(id); }
  void spaced(NameId id) {
    out += ' ';
    name(id);
  }
  void number(uint64_t n) { out += std::to_string(n); }
  void quoted(std::string_view s);
  void source(Range range);
  void path(Slice<Ident> idents, const char* between) {
    bool first = true;
    for (const Ident& ident : tree_.list(idents)) {
      if (!first) out += between;
      first = false;
      name(ident.name);
    }
  }
  void expr(ExprId id, int depth = 0);
  void spaced(ExprId id, int depth = 0) {
    out += ' ';
    expr(id, depth);
  }
  // Nothing where no expression is written.
  void optional(const char* before, ExprId id) {
    if (!id) return;
    out += before;
    expr(id);
  }
  void exprs(Slice<ExprId> list, int depth) {
    for (ExprId e : tree_.list(list)) spaced(e, depth + 1);
  }
  void arguments(Slice<Argument> list, int depth);
  void address(const DirectAddress& a);
  virtual void typeExpr(TypeExprId id, int depth) = 0;  // of __NEW
  ~TreeExprPrinter() = default;

  const Tree& tree_;
  const Names& names_;
  const Sources* sources_;

 private:
  void literal(const LiteralExpr& e);
  // The rest of a node, after its word.
  void print(const ErrorExpr& e, int);
  void print(const LiteralExpr& e, int);
  void print(const NameExpr& e, int);
  void print(const TypedNameExpr& e, int);
  void print(const MemberExpr& e, int depth);
  void print(const IndexExpr& e, int depth);
  void print(const ThisExpr&, int) {}
  void print(const SuperExpr&, int) {}
  void print(const DerefExpr& e, int depth);
  void print(const BitAccessExpr& e, int depth);
  void print(const AddressExpr& e, int);
  void print(const UnaryExpr& e, int depth);
  void print(const BinaryExpr& e, int depth);
  void print(const CallExpr& e, int depth);
  void print(const RangeExpr& e, int depth);
  void print(const ArrayInitExpr& e, int depth);
  void print(const RepeatExpr& e, int depth);
  void print(const StructInitExpr& e, int depth);
  void print(const ConvertExpr& e, int depth);
  void print(const BoundExpr& e, int depth);
  void print(const AnyValueExpr& e, int depth);
  void print(const AssignExpr& e, int depth);
  void print(const NewExpr& e, int depth);
  void print(const AddressOfExpr& e, int depth);
};

}  // namespace rung

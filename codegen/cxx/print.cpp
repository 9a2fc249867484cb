// SPDX-License-Identifier: Apache-2.0
// Prints expressions and statements of C++: see print.h.
#include "codegen/cxx/print.h"

#include <algorithm>

#include "codegen/names.h"

namespace rung::codegen::cxx {

namespace {

// Low to high: an operand that binds less than its place needs gets parentheses.
enum class Prec : uint8_t {
  Comma,
  Assign,
  Choice,
  Or,
  And,
  Bit,
  Equality,
  Relation,
  Shift,
  Sum,
  Product,
  Unary,
  Postfix
};

struct OperatorRow {
  std::string_view text;
  Prec own, left, right;
  bool joins;
};
constexpr OperatorRow kOperators[] = {
#define RUNG_CXX_OPERATOR(name, text, own, left, right, joins) {text, Prec::own, Prec::left, Prec::right, joins},
#include "codegen/cxx/operators.def"
#undef RUNG_CXX_OPERATOR
};

const OperatorRow& rowOf(const Node& infix) { return kOperators[static_cast<size_t>(infix.op)]; }

Prec precOf(const Node& node) {
  switch (node.kind) {
    case NodeKind::Negative:
    case NodeKind::Prefix:
    case NodeKind::Cast: return Prec::Unary;
    case NodeKind::Infix: return rowOf(node).own;
    case NodeKind::Choice: return Prec::Choice;
    case NodeKind::Name:
    case NodeKind::Number:
    case NodeKind::Call:
    case NodeKind::List:
    case NodeKind::Element:
    case NodeKind::Member:
    case NodeKind::Arrow:
    case NodeKind::Group: return Prec::Postfix;
  }
  return Prec::Postfix;
}

// !a or ~a, also cut to its type.
bool isComplement(const Node& node) {
  if (node.kind == NodeKind::Cast) return isComplement(*node.operands[0]);
  return node.kind == NodeKind::Prefix && (node.text == "!" || node.text == "~");
}
bool isNot(const Node& node) { return node.kind == NodeKind::Prefix && node.text == "!"; }

// Collects what is printed, since most of it is a few characters.
class Sink {
 public:
  explicit Sink(std::string& out) : out_(out) {}
  ~Sink() { flush(); }
  Sink& operator+=(char c) {
    if (used_ == sizeof buffer_) flush();
    buffer_[used_++] = c;
    return *this;
  }
  Sink& operator+=(std::string_view text) {
    if (text.size() > sizeof buffer_ - used_) flush();
    if (text.size() > sizeof buffer_) {
      out_ += text;
    } else {
      std::copy(text.begin(), text.end(), buffer_ + used_);
      used_ += text.size();
    }
    return *this;
  }
  void append(size_t count, char c) {
    for (; count > 0; --count) *this += c;
  }

 private:
  void flush() {
    out_.append(buffer_, used_);
    used_ = 0;
  }

  std::string& out_;
  size_t used_ = 0;
  char buffer_[1024];
};

class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(Sink& out) : out_(out) {}

  void print(const Node& node) {
    switch (node.kind) {
      case NodeKind::Name:
      case NodeKind::Number:
      case NodeKind::Negative: out_ += node.text; return;
      case NodeKind::Prefix:
        out_ += node.text;
        operand(*node.operands[0], node.text == "-" ? Prec::Postfix : Prec::Unary);
        return;
      case NodeKind::Cast:
        out_ += '(';
        out_ += node.text;
        out_ += ')';
        operand(*node.operands[0], Prec::Unary);
        return;
      case NodeKind::Infix: return infix(node);
      case NodeKind::Choice:
        operand(*node.operands[0], Prec::Or);
        out_ += " ? ";
        operand(*node.operands[1], Prec::Or);
        out_ += " : ";
        operand(*node.operands[2], Prec::Or);
        return;
      case NodeKind::Call:
        out_ += node.text;
        out_ += '(';
        list(node.operands);
        out_ += ')';
        return;
      case NodeKind::List:
        out_ += '{';
        list(node.operands);
        out_ += '}';
        return;
      case NodeKind::Element:
        operand(*node.operands[0], Prec::Postfix);
        out_ += '[';
        print(*node.operands[1]);
        out_ += ']';
        return;
      case NodeKind::Member:
      case NodeKind::Arrow:
        operand(*node.operands[0], Prec::Postfix);
        out_ += node.kind == NodeKind::Member ? "." : "->";
        out_ += node.text;
        return;
      case NodeKind::Group: return parenthesized(*node.operands[0]);
    }
  }

 private:
  void infix(const Node& node) {
    const OperatorRow& row = rowOf(node);
    const Node &left = *node.operands[0], &right = *node.operands[1];
    const bool compares = row.own == Prec::Equality || row.own == Prec::Relation;
    const bool wraps_left = compares ? isComplement(left) : row.own == Prec::Bit && isNot(left);
    side(node, left, wraps_left ? Prec::Postfix : row.left);
    out_ += row.text;
    side(node, right, row.own == Prec::Bit && isNot(right) ? Prec::Postfix : row.right);
  }
  void side(const Node& node, const Node& of, Prec needed) {
    const bool is_same = of.kind == NodeKind::Infix && of.op == node.op && rowOf(node).joins;
    is_same ? print(of) : operand(of, needed);
  }
  void operand(const Node& node, Prec needed) { precOf(node) < needed ? parenthesized(node) : print(node); }
  void parenthesized(const Node& node) {
    out_ += '(';
    print(node);
    out_ += ')';
  }
  void list(std::span<const Node* const> items) {
    for (size_t i = 0; i < items.size(); ++i) {
      if (i > 0) out_ += ", ";
      operand(*items[i], Prec::Assign);
    }
  }

  Sink& out_;
};

constexpr uint32_t kMaxBlankLines = 6, kAnyLines = ~0u;
constexpr uint32_t kDeepestIndent = 40;

size_t indentOf(uint32_t depth) { return 2 * static_cast<size_t>(std::min(depth, kDeepestIndent)); }

class StatementPrinter {
 public:
  StatementPrinter(std::string& out, const Tree& tree) : out_(out), tree_(tree) {}

  void run(const Stmt* first) {
    list(first);
    flushCloses(0);
  }

 private:
  void list(const Stmt* first) {
    for (const Stmt* stmt = first; stmt != nullptr; stmt = stmt->next) {
      begin(*stmt);
      print(*stmt);
    }
  }

  // ---- lines

  // Writes the pending braces, at most `lines` of them on separate lines.
  void flushCloses(uint32_t lines) {
    for (; closes_ > 0; --closes_) {
      if (lines > 0) {
        out_ += '\n';
        out_.append(indentOf(depth_ + closes_ - 1), ' ');
        if (line_ != 0) ++line_;
        --lines;
      } else {
        out_ += ' ';
      }
      out_ += '}';
    }
  }

  void begin(const Stmt& stmt) {
    const Position at = stmt.at;
    const size_t indent = indentOf(depth_);
    const bool same_file = line_ != 0 && at.file == line_file_;
    if (!stmt.begins || (at.line != 0 && same_file && at.line == line_)) {
      flushCloses(0);
      out_ += ' ';
      return;
    }
    if (at.line == 0) {
      flushCloses(kAnyLines);
      out_ += '\n';
      if (line_ != 0) ++line_;
      out_.append(indent, ' ');
      return;
    }
    if (same_file && at.line > line_ && at.line - line_ <= kMaxBlankLines + closes_) {
      flushCloses(at.line - line_ - 1);
      out_.append(at.line - line_, '\n');
    } else {
      flushCloses(kAnyLines);
      out_ += "\n#line ";
      std::string line;
      appendUnsigned(line, at.line);
      if (!same_file) {
        line += ' ';
        appendQuoted(line, tree_.path(at.file));
      }
      out_ += line;
      out_ += '\n';
    }
    out_.append(indent, ' ');
    line_ = at.line;
    line_file_ = at.file;
  }

  // ` {`, a block, and a `}` that is written where the next statement begins.
  void braced(const Stmt* first) {
    out_ += " {";
    block(first);
  }
  void block(const Stmt* first) {
    ++depth_;
    list(first);
    --depth_;
    ++closes_;
  }
  // On one line.
  void scope(const Stmt* first) {
    out_ += '{';
    list(first);
    out_ += " }";
  }

  // ---- statements

  void print(const Stmt& stmt) {
    switch (stmt.kind) {
      case StmtKind::Nothing: return;
      case StmtKind::Empty: out_ += ';'; return;
      case StmtKind::Expression:
        out_ += stmt.text;
        expression(stmt.a);
        out_ += ';';
        return;
      case StmtKind::Macro: return expression(stmt.a);
      case StmtKind::Goto: return word("goto ", stmt.text);
      case StmtKind::Label:
        out_ += stmt.text;
        out_ += ':';
        optional(stmt.a);
        out_ += ';';
        return;
      case StmtKind::Break: out_ += "break;"; return;
      case StmtKind::Continue: out_ += "continue;"; return;
      case StmtKind::Return:
        out_ += "return";
        optional(stmt.a);
        out_ += ';';
        return;
      case StmtKind::Block: out_ += '{'; return block(stmt.first);
      case StmtKind::If: return ifStatement(stmt);
      case StmtKind::ShortIf: head("if (", stmt.a); return list(stmt.first);
      case StmtKind::BracedIf:
        head("if (", stmt.a);
        out_ += ' ';
        return scope(stmt.first);
      case StmtKind::While: head("while (", stmt.a); return braced(stmt.first);
      case StmtKind::DoWhile:
        out_ += "do";
        braced(stmt.first);
        flushCloses(0);
        head(" while (", stmt.a);
        out_ += ';';
        return;
      case StmtKind::For: return forStatement(stmt);
      case StmtKind::Switch: head("switch (", stmt.a); return braced(stmt.first);
      case StmtKind::Case: out_ += stmt.text; return braced(stmt.first);
      case StmtKind::Scope: return scope(stmt.first);
      case StmtKind::Declaration: return word("", stmt.text);
      case StmtKind::Frame:
        out_ += "{ auto ";
        out_ += stmt.text;
        out_ += " = [&]()";
        braced(stmt.first);
        flushCloses(0);
        out_ += "; ";
        expression(stmt.a);
        out_ += "; }";
        return;
    }
  }

  void expression(Ex e) { ExpressionPrinter(out_).print(*e); }
  void optional(Ex e) {
    if (e == nullptr) return;
    out_ += ' ';
    expression(e);
  }
  void word(std::string_view before, std::string_view text) {
    out_ += before;
    out_ += text;
    out_ += ';';
  }
  void head(std::string_view before, Ex condition) {
    out_ += before;
    expression(condition);
    out_ += ')';
  }

  void ifStatement(const Stmt& first) {
    for (const Stmt* stmt = &first;;) {
      head("if (", stmt->a);
      braced(stmt->first);
      if (stmt->second == nullptr) return;
      // A brace gets its own line where the source leaves room for it.
      const Position next = stmt->second_at;
      const bool same_file = next.line != 0 && line_ != 0 && next.file == line_file_;
      uint32_t room = kAnyLines;
      if (same_file) {
        room = next.line > line_ ? next.line - line_ - 1 : 0;
        if (room > kMaxBlankLines) room = kAnyLines;
      }
      flushCloses(room);
      out_ += " else";
      if (!stmt->is_chained) return braced(stmt->second);
      if (same_file && line_ != 0 && next.line == line_ + 1) {
        out_ += '\n';
        out_.append(indentOf(depth_), ' ');
        ++line_;
      } else {
        out_ += ' ';
      }
      stmt = stmt->second;
    }
  }

  void forStatement(const Stmt& stmt) {
    out_ += "for (";
    if (stmt.a != nullptr) expression(stmt.a);
    out_ += ';';
    optional(stmt.b);
    out_ += ';';
    optional(stmt.c);
    out_ += ')';
    braced(stmt.first);
  }

  Sink out_;
  const Tree& tree_;
  uint32_t depth_ = 1;
  uint32_t closes_ = 0;  // braces still to be closed
  uint32_t line_file_ = 0;
  uint32_t line_ = 0;  // 0: unknown to the reader
};

}  // namespace

void print(std::string& out, Ex expression) {
  Sink sink(out);
  ExpressionPrinter(sink).print(*expression);
}

std::string toString(Ex expression) {
  std::string out;
  print(out, expression);
  return out;
}

void print(std::string& out, const Tree& tree, const Statements& body) {
  StatementPrinter(out, tree).run(body.first());
}

}  // namespace rung::codegen::cxx

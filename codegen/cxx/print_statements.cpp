// SPDX-License-Identifier: Apache-2.0
// Prints the statements of a function, and `#line` where the lines of the code cannot follow those of the source: see
// printer.h.
#include "codegen/cxx/print.h"
#include "codegen/cxx/printer.h"
#include "codegen/names.h"

namespace rung::codegen::cxx {
namespace {

constexpr uint32_t kMaxBlankLines = 6, kAnyLines = ~0u;

}  // namespace

void StatementPrinter::list(const Stmt* first) {
  for (const Stmt* stmt = first; stmt != nullptr; stmt = stmt->next) {
    begin(*stmt);
    print(*stmt);
  }
}

// Writes the pending braces, at most `lines` of them on separate lines.
void StatementPrinter::flushCloses(uint32_t lines) {
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

void StatementPrinter::begin(const Stmt& stmt) {
  const Position at = stmt.at;
  if (stmt.kind == StmtKind::Exit) {
    flushCloses(0);
    out_ += '\n';
    return;
  }
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
    out_.append(indentOf(depth_), ' ');
    return;
  }
  beginSourceLine(at);
}

// By empty lines where the source is not far, else by #line.
void StatementPrinter::beginSourceLine(Position at) {
  const bool same_file = line_ != 0 && at.file == line_file_;
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
  out_.append(indentOf(depth_), ' ');
  line_ = at.line;
  line_file_ = at.file;
}

// ` {`, a block, and a `}` that is written where the next statement begins.
void StatementPrinter::braced(const Stmt* first) {
  out_ += " {";
  block(first);
}

void StatementPrinter::block(const Stmt* first) {
  ++depth_;
  list(first);
  --depth_;
  ++closes_;
}

// With a line for each brace.
void StatementPrinter::lines(const Stmt* first) {
  out_ += '{';
  ++depth_;
  list(first);
  flushCloses(kAnyLines);
  --depth_;
  out_ += '\n';
  out_.append(indentOf(depth_), ' ');
  out_ += '}';
}

// On one line.
void StatementPrinter::scope(const Stmt* first) {
  out_ += '{';
  list(first);
  out_ += " }";
}

void StatementPrinter::print(const Stmt& stmt) {
  switch (stmt.kind) {
    case StmtKind::Nothing: return;
    case StmtKind::Empty: out_ += ';'; return;
    case StmtKind::Expression:
      out_ += stmt.text;
      expression(stmt.a);
      out_ += ';';
      return;
    case StmtKind::Macro: return expression(stmt.a);
    case StmtKind::Goto:
      out_ += "goto ";
      out_ += stmt.text;
      out_ += ';';
      return;
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
    case StmtKind::Lines: return lines(stmt.first);
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
    case StmtKind::Case: labels(stmt); return braced(stmt.first);
    case StmtKind::Scope: return scope(stmt.first);
    case StmtKind::Exit:
      out_ += stmt.text;
      out_ += ':';
      return;
    case StmtKind::Declaration: return DeclarationPrinter(out_, tree_).print(*stmt.declares);
    case StmtKind::Source: return source(stmt.text);
    case StmtKind::Frame: return frame(stmt);
  }
}

void StatementPrinter::optional(Ex e) {
  if (e == nullptr) return;
  out_ += ' ';
  expression(e);
}

void StatementPrinter::head(std::string_view before, Ex condition) {
  out_ += before;
  expression(condition);
  out_ += ')';
}

void StatementPrinter::ifStatement(const Stmt& first) {
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

void StatementPrinter::forStatement(const Stmt& stmt) {
  out_ += "for (";
  if (stmt.a != nullptr) expression(stmt.a);
  out_ += ';';
  optional(stmt.b);
  out_ += ';';
  optional(stmt.c);
  out_ += ')';
  braced(stmt.first);
}

void StatementPrinter::labels(const Stmt& stmt) {
  if (stmt.labels.empty()) out_ += "default:";
  for (const CaseLabel& label : stmt.labels) {
    out_ += &label == stmt.labels.data() ? "case " : " case ";
    expression(label.low);
    if (label.high != nullptr) {
      out_ += " ... ";
      expression(label.high);
    }
    out_ += ':';
  }
}

void StatementPrinter::source(std::string_view text) {
  out_ += "[&]() -> void {\n";
  out_ += text;
  out_ += '\n';
  out_.append(indentOf(depth_), ' ');
  out_ += "}();";
}

void StatementPrinter::frame(const Stmt& stmt) {
  out_ += "{ auto ";
  out_ += stmt.text;
  out_ += " = [&]()";
  braced(stmt.first);
  flushCloses(0);
  out_ += "; ";
  expression(stmt.a);
  out_ += "; }";
}

void print(std::string& out, const Tree& tree, const Statements& body) {
  Sink sink(out);
  StatementPrinter(sink, tree, 1).run(body.first());
}

}  // namespace rung::codegen::cxx

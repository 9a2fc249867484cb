// SPDX-License-Identifier: Apache-2.0
// The printers of expressions, statements and declarations, which call each other. Internal to codegen/cxx: others
// call print.h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "codegen/cxx/nodes.h"

namespace rung::codegen::cxx {

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
    if (text.size() > sizeof buffer_ - used_) return appendLarge(text);
    if (!text.empty()) std::memcpy(buffer_ + used_, text.data(), text.size());
    used_ += text.size();
    return *this;
  }
  void append(size_t count, char c) {
    for (; count > 0; --count) *this += c;
  }

 private:
  Sink& appendLarge(std::string_view text);
  void flush() {
    out_.append(buffer_, used_);
    used_ = 0;
  }

  std::string& out_;
  size_t used_ = 0;
  char buffer_[1024];
};

// The blanks at the beginning of a line.
inline size_t indentOf(uint32_t depth) {
  constexpr uint32_t kDeepest = 40;
  return 2 * static_cast<size_t>(std::min(depth, kDeepest));
}

enum class Prec : uint8_t;

class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(Sink& out) : out_(out) {}
  void print(const Node& node);

 private:
  void infix(const Node& node);
  void call(std::span<const Node* const> arguments);
  void side(const Node& node, const Node& of, Prec needed);
  void operand(const Node& node, Prec needed);
  void parenthesized(const Node& node);
  void list(std::span<const Node* const> items);

  Sink& out_;
};

// The statements of a function, `depth` of the first one. The lines follow those of the source.
class StatementPrinter {
 public:
  StatementPrinter(Sink& out, const Tree& tree, uint32_t depth) : out_(out), tree_(tree), depth_(depth) {}

  void run(const Stmt* first) {
    list(first);
    flushCloses(0);
  }
  void scope(const Stmt* first);  // in braces, on one line

 private:
  void list(const Stmt* first);
  void flushCloses(uint32_t lines);
  void begin(const Stmt& stmt);
  void beginSourceLine(Position at);
  void braced(const Stmt* first);
  void block(const Stmt* first);
  void lines(const Stmt* first);
  void print(const Stmt& stmt);
  void expression(Ex e) { ExpressionPrinter(out_).print(*e); }
  void optional(Ex e);
  void head(std::string_view before, Ex condition);
  void ifStatement(const Stmt& first);
  void forStatement(const Stmt& stmt);
  void labels(const Stmt& stmt);
  void frame(const Stmt& stmt);
  void source(std::string_view text);

  Sink& out_;
  const Tree& tree_;
  uint32_t depth_;
  uint32_t closes_ = 0;  // braces still to be closed
  uint32_t line_file_ = 0;
  uint32_t line_ = 0;  // 0: unknown to the reader
};

// `float (*x)[3]`
void printDeclarator(Sink& out, const Type& type, std::string_view name);

class DeclarationPrinter {
 public:
  DeclarationPrinter(Sink& out, const Tree& tree, uint32_t depth = 0) : out_(out), tree_(tree), depth_(depth) {}

  void list(const Decl* first);  // each on its own lines
  void print(const Decl& decl);  // without the indentation before it and the line end after it
  void signature(const Function& of);

 private:
  void variable(const Variable& of);
  void initialiser(const Valued& of);
  void function(const Function& of);
  void body(const Function& of);
  void record(const Record& of);
  void enumeration(const Enumeration& of);
  void space(const Namespace& of);
  void prefix(std::string_view text);
  void expression(Ex e) { ExpressionPrinter(out_).print(*e); }

  Sink& out_;
  const Tree& tree_;
  uint32_t depth_;
};

}  // namespace rung::codegen::cxx

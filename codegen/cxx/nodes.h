// SPDX-License-Identifier: Apache-2.0
// C++ as a value: expressions and statements of a function, made before any of it is printed. A Tree owns the nodes of
// one function and makes them; they never change, so that one may be a part of several others. print.h prints them and
// alone knows parentheses, lines and indentation. Nothing here knows the IR.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <new>
#include <span>
#include <string_view>
#include <vector>

namespace rung::codegen::cxx {

enum class Op : uint8_t {
#define RUNG_CXX_OPERATOR(name, text, own, left, right, joins) name,
#include "codegen/cxx/operators.def"
#undef RUNG_CXX_OPERATOR
};

enum class NodeKind : uint8_t {
  Name,      // a variable, or any text that binds as tightly as one
  Number,    // a constant that is not negative
  Negative,  // a constant that is
  Prefix,    // `text` and an operand: ! ~ - * & ++ --
  Cast,      // (text)operand
  Infix,     // left op right
  Choice,    // condition ? yes : no
  Call,      // text(operands)
  List,      // {operands}
  Element,   // base[index]
  Member,    // base.text
  Arrow,     // base->text
  Group      // (operand), where a reader or g++ wants it
};

struct Node {
  NodeKind kind;
  Op op = Op::Comma;  // of Infix
  std::string_view text;
  std::span<const Node* const> operands;
};
using Ex = const Node*;
bool same(Ex a, Ex b);  // they print the same

// The location of a statement in the source; line 0: none.
struct Position {
  uint32_t file = 0;  // of Tree::files
  uint32_t line = 0;
};

enum class StmtKind : uint8_t {
  Nothing,     // only the line that it begins
  Empty,       // ;
  Expression,  // a; after a macro, text, or nothing
  Macro,       // a macro that is a statement of its own: RUNG_CHECK(...)
  Goto,        // goto text;
  Label,       // text:; or text: a;
  Break,
  Continue,
  Return,       // return a; or return;
  Block,        // { first }
  If,           // if (a) { first } else { second }
  ShortIf,      // if (a) first; on one line
  BracedIf,     // if (a) { first } on one line
  While,        // while (a) { first }
  DoWhile,      // do { first } while (a);
  For,          // for (a; b; c) { first }, where each may be missing
  Switch,       // switch (a) { first: cases }
  Case,         // text { first }: the text is `case 1: case 3 ... 5:` or `default:`
  Scope,        // { first } on one line
  Declaration,  // text;
  Frame         // { auto text = [&]() { first return; }; a }: what runs between setjmp and longjmp
};

struct Stmt {
  StmtKind kind = StmtKind::Nothing;
  bool begins = false;      // on the line of its source; else after the one before it, on the same line
  bool is_chained = false;  // an If whose `second` is one If: else if
  Position at;
  Position second_at;  // of an If: of its `second`
  Ex a = nullptr, b = nullptr, c = nullptr;
  std::string_view text;
  Stmt* first = nullptr;
  Stmt* second = nullptr;
  Stmt* next = nullptr;
};

// A list of statements that grows at its end.
class Statements {
 public:
  void add(Stmt* stmt) {
    (last_ == nullptr ? first_ : last_->next) = stmt;
    last_ = stmt;
  }
  Stmt* first() const { return first_; }
  bool empty() const { return first_ == nullptr; }
  void append(const Statements& other) {
    if (other.empty()) return;
    add(other.first_);
    last_ = other.last_;
  }

 private:
  Stmt* first_ = nullptr;
  Stmt* last_ = nullptr;
};

// Memory for what needs no destructor; all of it is given up at once, and used again.
class Arena {
 public:
  void* allocate(size_t bytes, size_t align) {
    used_ = (used_ + align - 1) & ~(align - 1);
    if (current_ == chunks_.size() || used_ + bytes > chunks_[current_].size()) beginChunk(bytes);
    void* const at = chunks_[current_].data() + used_;
    used_ += bytes;
    return at;
  }
  template <class T>
  T* make(T value) {
    return new (allocate(sizeof(T), alignof(T))) T(value);
  }
  template <class T>
  std::span<const T> copy(std::span<const T> items) {
    T* const to = static_cast<T*>(allocate(items.size_bytes(), alignof(T)));
    std::copy(items.begin(), items.end(), to);
    return {to, items.size()};
  }
  void clear() { current_ = used_ = 0; }

 private:
  void beginChunk(size_t bytes);

  std::vector<std::vector<unsigned char>> chunks_;
  size_t current_ = 0, used_ = 0;  // the chunk in use, and its bytes that are taken
};

class Tree {
 public:
  void clear();  // for the next function

  // ---- expressions. Text is copied, except where a parameter is called `fixed`: that lives as long as the tree.
  Ex fixed(std::string_view fixed) { return add({NodeKind::Name, {}, fixed, {}}); }
  Ex name(std::string_view text) { return add({NodeKind::Name, {}, kept(text), {}}); }
  Ex number(uint64_t value, std::string_view suffix = {});
  Ex signedNumber(int64_t value, std::string_view suffix = {});
  Ex constant(std::string_view text, bool is_negative) {
    return add({is_negative ? NodeKind::Negative : NodeKind::Number, {}, kept(text), {}});
  }
  Ex prefix(std::string_view fixed, Ex operand) { return add({NodeKind::Prefix, {}, fixed, list({operand})}); }
  Ex cast(std::string_view type, Ex operand) { return add({NodeKind::Cast, {}, kept(type), list({operand})}); }
  Ex infix(Op op, Ex left, Ex right) { return add({NodeKind::Infix, op, {}, list({left, right})}); }
  Ex choice(Ex condition, Ex yes, Ex no) { return add({NodeKind::Choice, {}, {}, list({condition, yes, no})}); }
  Ex call(std::string_view function, std::initializer_list<Ex> arguments) {
    return add({NodeKind::Call, {}, kept(function), list(arguments)});
  }
  Ex call(std::string_view function, const std::vector<Ex>& arguments) {
    return add({NodeKind::Call, {}, kept(function), list(arguments)});
  }
  Ex braces(const std::vector<Ex>& items) { return add({NodeKind::List, {}, {}, list(items)}); }
  Ex element(Ex base, Ex index) { return add({NodeKind::Element, {}, {}, list({base, index})}); }
  Ex member(Ex base, std::string_view fixed) { return add({NodeKind::Member, {}, fixed, list({base})}); }
  Ex arrow(Ex base, std::string_view fixed) { return add({NodeKind::Arrow, {}, fixed, list({base})}); }
  Ex group(Ex inner) { return add({NodeKind::Group, {}, {}, list({inner})}); }

  // ---- statements
  Stmt* stmt(StmtKind kind, Ex a = nullptr) {
    Stmt* const made = arena_.make(Stmt{});
    made->kind = kind;
    made->a = a;
    return made;
  }
  Stmt* textual(StmtKind kind, std::string_view text) {
    Stmt* const made = stmt(kind);
    made->text = kept(text);
    return made;
  }

  std::string_view kept(std::string_view text) {
    if (text.empty()) return {};
    const std::span<const char> copy = arena_.copy(std::span<const char>(text.data(), text.size()));
    return {copy.data(), copy.size()};
  }
  uint32_t file(std::string_view path);  // its number
  std::string_view path(uint32_t file) const { return files_[file]; }

 private:
  Ex add(const Node& node) { return arena_.make(node); }
  std::span<const Node* const> list(std::span<const Ex> items) { return arena_.copy(items); }
  std::span<const Node* const> list(std::initializer_list<Ex> items) {
    return list(std::span<const Ex>(items.begin(), items.size()));
  }
  std::span<const Node* const> list(const std::vector<Ex>& items) { return list(std::span<const Ex>(items)); }

  Arena arena_;
  std::vector<std::string_view> files_;
};

}  // namespace rung::codegen::cxx

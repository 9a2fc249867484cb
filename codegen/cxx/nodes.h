// SPDX-License-Identifier: Apache-2.0
// C++ as a value: expressions, statements and declarations, made before any of it is printed. A Tree owns the nodes of
// one function or file and makes them. An expression never changes, so that it may be a part of several others; a
// statement or declaration is in one list. print.h prints them and alone knows parentheses, braces, lines and
// indentation. Nothing here knows the IR.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
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
  Invoke,    // operand(further operands)
  List,      // {operands}
  Element,   // base[index]
  Member,    // base.text
  Arrow,     // base->text
  Lambda,    // [](text) { operand; }
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

struct Decl;

struct CaseLabel {
  Ex low, high;  // high null: only the one
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
  Lines,        // { first } with a line for each brace
  If,           // if (a) { first } else { second }
  ShortIf,      // if (a) first; on one line
  BracedIf,     // if (a) { first } on one line
  While,        // while (a) { first }
  DoWhile,      // do { first } while (a);
  For,          // for (a; b; c) { first }, where each may be missing
  Switch,       // switch (a) { first: cases }
  Case,         // case 1: case 3 ... 5: { first }, with `labels`; without any default: { first }
  Scope,        // { first } on one line
  Exit,         // text: at the beginning of a line, before the exits of a function
  Declaration,  // declares
  Source,       // [&]() -> void { text }(); where the text is lines of the user
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
  std::span<const CaseLabel> labels;
  const Decl* declares = nullptr;
  Stmt* first = nullptr;
  Stmt* second = nullptr;
  Stmt* next = nullptr;
};

// A list of statements or declarations that grows at its end.
template <class T>
class Chain {
 public:
  void add(T* item) {
    (last_ == nullptr ? first_ : last_->next) = item;
    last_ = item;
  }
  T* first() const { return first_; }
  bool empty() const { return first_ == nullptr; }
  void append(const Chain& other) {
    if (other.empty()) return;
    add(other.first_);
    last_ = other.last_;
  }

 private:
  T* first_ = nullptr;
  T* last_ = nullptr;
};
using Statements = Chain<Stmt>;
using Declarations = Chain<Decl>;

enum class DeclKind : uint8_t {
  Variable,
  Function,
  Record,
  Enumeration,
  Using,
  Namespace,
  Assertion,
  Include,
  Directive,
  Comment,
  Blank,
  Printed
};

struct Decl {
  DeclKind kind;
  Decl* next = nullptr;
};

// The type of a variable as C++ writes it around the name: `float x[3]`, `char* x`, `float (*x)[3]`.
struct Type {
  std::string_view base;              // `float`, `struct Ramp_type`, `void* const`
  std::string_view reference;         // `*`, `&` or `&&`
  std::span<const uint64_t> extents;  // 0: as many as its value has
};

struct Valued : Decl {  // the declaration of something that may have a value
  explicit Valued(DeclKind of) : Decl{of} {}
  Ex value = nullptr;      // ` = value`
  Ex arguments = nullptr;  // `(a, b)` or `{a, b}` after the name
};

struct Variable : Valued {  // prefix type name suffix = value;
  Variable() : Valued{DeclKind::Variable} {}
  std::string_view prefix;  // `extern const`, `alignas(8)`
  Type type;
  std::string_view name, suffix;
  Variable* also = nullptr;  // another name of the same type: `int a, b;`
};

struct Function : Decl {  // prefix result name(parameters) suffix
  Function() : Decl{DeclKind::Function} {}
  enum class Form : uint8_t { Prototype, Lines, OneLine };
  std::string_view prefix;
  Type result;  // without a base: a constructor or conversion
  std::string_view name, suffix;
  Chain<Decl> parameters;  // variables
  struct Initialised {
    std::string_view member;
    Ex arguments;
  };
  std::span<const Initialised> initialises;  // those that a constructor does: `a(b)`
  Form form = Form::Prototype;
  const Stmt* body = nullptr;
  const Stmt* exits = nullptr;  // after the last brace of the body
};

struct Record : Valued {  // keyword attributes name { members } variable = value;
  Record() : Valued{DeclKind::Record} {}
  std::string_view keyword, attributes, name;
  bool is_line = false;     // all on one line
  bool has_access = false;  // of a class: its members are public
  Declarations members;
  std::string_view variable;
};

struct Enumeration : Decl {  // enum name : base { items };
  Enumeration() : Decl{DeclKind::Enumeration} {}
  std::string_view name, base;
  bool is_line = false;
  struct Item {
    std::string_view name;
    Ex value;
  };
  std::span<const Item> items;
};

struct Using : Decl {  // using name = of;
  Using() : Decl{DeclKind::Using} {}
  std::string_view name, of;  // without `of`: using name;
};

struct Namespace : Decl {
  Namespace() : Decl{DeclKind::Namespace} {}
  std::string_view name, attributes;
  Declarations members;
};

struct Assertion : Decl {  // static_assert(condition, "text");
  Assertion() : Decl{DeclKind::Assertion} {}
  Ex condition = nullptr;
  std::string_view text;
};

struct Textual : Decl {
  explicit Textual(DeclKind of) : Decl{of} {}
  // Include: the path; Directive: `define NAME`; Comment; Printed: lines that were printed before, or are the user's.
  std::string_view text;
};

template <class T>
const T& as(const Decl& decl) {
  return static_cast<const T&>(decl);
}

// Memory for what needs no destructor; all of it is given up at once, and used again.
class Arena {
 public:
  void* allocate(size_t bytes, size_t align) {
    used_ = (used_ + align - 1) & ~(align - 1);
    if (current_ == chunks_.size() || used_ + bytes > chunks_[current_].size) beginChunk(bytes);
    void* const at = chunks_[current_].bytes.get() + used_;
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

  struct Chunk {
    std::unique_ptr<unsigned char[]> bytes;  // not cleared
    size_t size;
  };
  std::vector<Chunk> chunks_;
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
  // The call of a function that is an expression.
  Ex invoke(Ex function, std::initializer_list<Ex> arguments) {
    std::vector<Ex> all{function};
    all.insert(all.end(), arguments);
    return add({NodeKind::Invoke, {}, {}, list(all)});
  }
  // A function without captures that does what the expression says.
  Ex lambda(std::string_view parameters, Ex does) {
    return add({NodeKind::Lambda, {}, kept(parameters), list({does})});
  }
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

  // ---- declarations
  template <class T>
  T* declaration() {
    return arena_.make(T{});
  }
  Decl* textual(DeclKind kind, std::string_view text) {
    Textual* const made = arena_.make(Textual(kind));
    made->text = kept(text);
    return made;
  }
  // `fixed` is not copied.
  Decl* printed(std::string_view fixed) {
    Textual* const made = arena_.make(Textual(DeclKind::Printed));
    made->text = fixed;
    return made;
  }
  Decl* blank() { return arena_.make(Textual(DeclKind::Blank)); }
  Variable* variable(const Type& type, std::string_view name, Ex value = nullptr) {
    Variable* const made = declaration<Variable>();
    made->type = type;
    made->name = kept(name);
    made->value = value;
    return made;
  }
  Variable* variable(std::string_view type, std::string_view name, Ex value = nullptr) {
    return variable(Type{kept(type), {}, {}}, name, value);
  }
  Stmt* declare(const Decl* declaration) {
    Stmt* const made = stmt(StmtKind::Declaration);
    made->declares = declaration;
    return made;
  }

  template <class T>
  std::span<const T> copy(const std::vector<T>& items) {
    return arena_.copy(std::span<const T>(items));
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

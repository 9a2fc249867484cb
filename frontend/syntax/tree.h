// SPDX-License-Identifier: Apache-2.0
// The syntax tree of all languages. In: nodes from the parsers (and from the schedulers of diagrams, IL and NCT), made
// by tree_builder.h. Out: what was written, with its source ranges. A tree knows nothing of meaning: who checks a
// program makes a copy of each body (sema/code.h). Nodes and lists are trivial structs in one arena of fixed chunks,
// addressed by typed 32-bit ids; references to nodes, lists and strings never become invalid. nodes.def lists the
// kinds.
#pragma once

#include <cstdint>
#include <cstring>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "frontend/source/invariant.h"
#include "frontend/syntax/nodes.h"

namespace rung {

// The declarations of one file, in source order: TypeDecl, PouDecl, SectionDecl (VAR_GLOBAL), ConfigurationDecl.
struct FileUnit {
  FileId file;
  Slice<DeclId> decls;
  Slice<Range> skipped = {};  // what recovery from syntax errors skipped and no error node holds, in source order
};

// The kind of a node struct, which Tree::as() checks in debug builds.
template <class Node>
inline constexpr int kind_of_node = -1;
#define RUNG_EXPR(kind, word, ...) \
  template <>                      \
  inline constexpr ExprKind kind_of_node<kind##Expr> = ExprKind::kind;
#define RUNG_STMT(kind, word, ...) \
  template <>                      \
  inline constexpr StmtKind kind_of_node<kind##Stmt> = StmtKind::kind;
#define RUNG_TYPE_EXPR(kind, word, ...) \
  template <>                           \
  inline constexpr TypeExprKind kind_of_node<kind##TypeExpr> = TypeExprKind::kind;
#define RUNG_DECL(kind, word, ...) \
  template <>                      \
  inline constexpr DeclKind kind_of_node<kind##Decl> = DeclKind::kind;
#include "frontend/syntax/nodes.def"

class Tree {
 public:
  Tree();
  ~Tree();
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  // ---- reading. The node must be of the kind asked for (checked in debug builds).
  ExprKind kind(ExprId id) const { return at<ExprHeader>(id.word).kind; }
  StmtKind kind(StmtId id) const { return at<StmtHeader>(id.word).kind; }
  DeclKind kind(DeclId id) const { return at<DeclHeader>(id.word).kind; }
  TypeExprKind kind(TypeExprId id) const { return at<TypeExprHeader>(id.word).kind; }
  ExprHeader& expr(ExprId id) { return at<ExprHeader>(id.word); }
  const ExprHeader& expr(ExprId id) const { return at<ExprHeader>(id.word); }
  StmtHeader& stmt(StmtId id) { return at<StmtHeader>(id.word); }
  const StmtHeader& stmt(StmtId id) const { return at<StmtHeader>(id.word); }
  DeclHeader& decl(DeclId id) { return at<DeclHeader>(id.word); }
  const DeclHeader& decl(DeclId id) const { return at<DeclHeader>(id.word); }
  TypeExprHeader& typeExpr(TypeExprId id) { return at<TypeExprHeader>(id.word); }
  const TypeExprHeader& typeExpr(TypeExprId id) const { return at<TypeExprHeader>(id.word); }
  Loc loc(ExprId id) const { return expr(id).loc; }
  Loc loc(StmtId id) const { return stmt(id).loc; }
  Loc loc(DeclId id) const { return decl(id).loc; }
  Loc loc(TypeExprId id) const { return typeExpr(id).loc; }
  // The location where an expression begins: the leftmost token of its operands, without parentheses around it.
  Loc begin(ExprId id) const;
  // What a step of a path goes on from.
  ExprId base(ExprId step) const;
  // The source range of a node as written, with parentheses around it. Empty: nothing was written here.
  Range range(ExprId id) const;
  Range bareRange(ExprId id) const;  // … without parentheses around it
  Range range(StmtId id) const;
  Range range(TypeExprId id) const;
  Range range(DeclId id) const;

  template <class Node, class Id>
  Node& as(Id id) {
    return node<Node>(kind(id), id.word);
  }
  template <class Node, class Id>
  const Node& as(Id id) const {
    return node<Node>(kind(id), id.word);
  }

  // ---- writing: see tree_builder.h
  template <class Id, class Node>
  Id add(const Node& node) {
    static_assert(std::is_trivially_copyable_v<Node> && sizeof(Node) % 4 == 0);
    const uint32_t word = allocate(sizeof(Node) / 4);
    std::memcpy(address(word), &node, sizeof(Node));
    return Id{word};
  }
  // An expression with zeroed words in front of it, for what its owner keeps beside it: see roomOf().
  template <class Node>
  ExprId add(Node node, uint32_t room) {
    static_assert(std::is_trivially_copyable_v<Node> && sizeof(Node) % 4 == 0);
    node.h.has_room = room != 0;
    const uint32_t word = allocate(room + sizeof(Node) / 4);
    std::memset(address(word), 0, size_t{room} * 4);
    std::memcpy(address(word + room), &node, sizeof(Node));
    return {word + room};
  }
  // Notes the parentheses around an expression.
  void parenthesize(ExprId expr, Loc open, Loc close_end);

  // Lists of ids and of small structs.
  template <class T>
  Slice<T> addList(std::span<const T> items) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
    if (items.empty()) return {};
    const uint32_t first = allocate(static_cast<uint32_t>(items.size() * (sizeof(T) / 4)), alignof(T) / 4);
    std::memcpy(address(first), items.data(), items.size_bytes());
    return {first, static_cast<uint32_t>(items.size())};
  }
  template <class T>
  std::span<T> list(Slice<T> slice) {
    return slice.empty() ? std::span<T>() : std::span<T>(&at<T>(slice.first), slice.count);
  }
  template <class T>
  std::span<const T> list(Slice<T> slice) const {
    return slice.empty() ? std::span<const T>() : std::span<const T>(&at<T>(slice.first), slice.count);
  }

  // Everything added since the tree had this size is gone, and its memory is used again.
  uint32_t size() const { return next_word_; }
  void truncate(uint32_t size);

  StringId addString(std::string_view text);
  std::string_view string(StringId id) const {
    return id.length == 0 ? std::string_view()
                          : std::string_view(reinterpret_cast<char*>(address(id.first)), id.length);
  }

  std::vector<FileUnit> files;
  // Instances whose ENO is read, `t` in `t.ENO`; by name key.
  bool readsEnoOf(NameId key) const { return key.index < eno_read_of.size() && eno_read_of[key.index]; }
  std::vector<bool> eno_read_of;
  bool lost_names = false;  // likewise of types and globals: names visible in the whole project

 private:
  // A node, list or string lies within one chunk, or in chunks made for it. Tiny ones in debug builds, so that every
  // test crosses them.
#ifdef NDEBUG
  static constexpr uint32_t kChunkWords = 1u << 16;
#else
  static constexpr uint32_t kChunkWords = 1u << 6;
#endif
  uint32_t* address(uint32_t word) const { return chunks_[word / kChunkWords] + word % kChunkWords; }
  template <class T>
  T& at(uint32_t word) const {
    return *std::launder(reinterpret_cast<T*>(address(word)));
  }
  template <class Node, class Kind>
  Node& node([[maybe_unused]] Kind kind, uint32_t word) const {
#ifndef NDEBUG
    RUNG_INVARIANT(kind == kind_of_node<Node>, "a node is read as what it is");
#endif
    return at<Node>(word);
  }
  uint32_t allocate(uint32_t words, uint32_t alignment = 1) {
    if (alignment > 1) next_word_ += next_word_ % alignment;
    const uint32_t used = next_word_ % kChunkWords;
    if (used == 0 || words > kChunkWords - used) openChunks(words);
    const uint32_t word = next_word_;
    next_word_ += words;
    return word;
  }
  void openChunks(uint32_t words);
  void openBlock(uint32_t chunks);

  struct Parens {
    ExprId of;
    Loc open, end;
  };
  const Parens* parensOf(ExprId id) const;

  std::vector<uint32_t*> chunks_;   // some point into a larger block
  std::vector<uint32_t*> blocks_;   // owned
  std::vector<uint32_t*> free_;     // chunks that were truncated
  uint32_t* next_chunk_ = nullptr;  // in the last block, with `spare_` chunks from it on
  uint32_t spare_ = 0;
  uint32_t next_word_ = 0;
  std::vector<Parens> parens_;  // sorted by `of`
};

// The tree as indented text (rung emit --emit=tree), with the words of nodes.def; golden tests read it.
// As written, with the source of what could not be parsed.
std::string printTree(const Tree& tree, const Names& names, const Sources& sources, const FileUnit& unit);
std::string printExpression(const Tree& tree, const Names& names, ExprId expr);

}  // namespace rung

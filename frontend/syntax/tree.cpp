// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/tree.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "frontend/syntax/children.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/sfc.h"

namespace rung {

const char* spelling(BinaryOp op) {
  switch (op) {
    case BinaryOp::Or: return "OR";
    case BinaryOp::OrElse: return "OR_ELSE";
    case BinaryOp::Xor: return "XOR";
    case BinaryOp::And: return "AND";
    case BinaryOp::AndThen: return "AND_THEN";
    case BinaryOp::Equal: return "=";
    case BinaryOp::NotEqual: return "<>";
    case BinaryOp::Less: return "<";
    case BinaryOp::LessEqual: return "<=";
    case BinaryOp::Greater: return ">";
    case BinaryOp::GreaterEqual: return ">=";
    case BinaryOp::Add: return "+";
    case BinaryOp::Subtract: return "-";
    case BinaryOp::Multiply: return "*";
    case BinaryOp::Divide: return "/";
    case BinaryOp::Modulo: return "MOD";
    case BinaryOp::Power: return "**";
  }
  return "";
}

const char* spelling(UnaryOp op) {
  switch (op) {
    case UnaryOp::Not: return "NOT";
    case UnaryOp::Negate: return "-";
    case UnaryOp::Plus: return "+";
  }
  return "";
}

const char* spelling(AssignOp op) {
  switch (op) {
    case AssignOp::Assign: return ":=";
    case AssignOp::Set: return "S=";
    case AssignOp::Reset: return "R=";
    case AssignOp::Reference: return "REF=";
    case AssignOp::Add: return "+=";
    case AssignOp::Subtract: return "-=";
    case AssignOp::Multiply: return "*=";
    case AssignOp::Divide: return "/=";
    case AssignOp::Attempt: return "?=";
  }
  return "";
}

ExprShape shape(ExprKind kind) {
  static constexpr ExprShape kShapes[] = {
#define RUNG_EXPR(kind, word, shape, ...) ExprShape::shape,
#include "frontend/syntax/nodes.def"
  };
  return kShapes[static_cast<size_t>(kind)];
}

// ---- storage

Tree::Tree() = default;

Tree::~Tree() {
  for (uint32_t* block : blocks_) std::free(block);
}

// Memory for this many chunks; of a large tree, in huge pages, which the system clears at once. The tiny chunks of
// debug builds stay apart, so that a test notices who reads past the end of one.
void Tree::openBlock(uint32_t chunks) {
  constexpr size_t kHugePage = size_t{2} << 20, kSmall = 4;
  size_t bytes = size_t{chunks} * kChunkWords * sizeof(uint32_t);
  const bool is_large = blocks_.size() >= kSmall && kChunkWords * sizeof(uint32_t) >= kHugePage / 8;
  if (is_large) bytes = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* const block = is_large ? std::aligned_alloc(kHugePage, bytes) : std::malloc(bytes);
  if (block == nullptr) throw std::bad_alloc();
  if (is_large) madvise(block, bytes, MADV_HUGEPAGE);
  blocks_.push_back(static_cast<uint32_t*>(block));
  next_chunk_ = blocks_.back();
  spare_ = static_cast<uint32_t>(bytes / (kChunkWords * sizeof(uint32_t)));
}

void Tree::openChunks(uint32_t words) {
  next_word_ = static_cast<uint32_t>(chunks_.size()) * kChunkWords;
  if (next_word_ == 0) next_word_ = 2;  // 0 means no node
  const uint32_t count = (next_word_ % kChunkWords + words + kChunkWords - 1) / kChunkWords;
  if (count == 1 && !free_.empty()) {
    chunks_.push_back(free_.back());
    free_.pop_back();
    return;
  }
  if (count > spare_) openBlock(count);
  for (uint32_t k = 0; k < count; ++k) chunks_.push_back(next_chunk_ + size_t{k} * kChunkWords);
  next_chunk_ += size_t{count} * kChunkWords;
  spare_ -= count;
}

void Tree::truncate(uint32_t size) {
  const uint32_t kept = (size + kChunkWords - 1) / kChunkWords;
  free_.insert(free_.end(), chunks_.begin() + kept, chunks_.end());
  chunks_.resize(kept);
  next_word_ = size;
  while (!parens_.empty() && parens_.back().of.word >= size) parens_.pop_back();
}

StringId Tree::addString(std::string_view text) {
  if (text.empty()) return {};
  const uint32_t word = allocate(static_cast<uint32_t>((text.size() + 3) / 4));
  std::memcpy(address(word), text.data(), text.size());
  return {word, static_cast<uint32_t>(text.size())};
}

void Tree::parenthesize(ExprId id, Loc open, Loc close_end) {
  expr(id).in_parens = 1;
  // The node was made last, so that it is at the end, or there already from a pair of parentheses inside these.
  auto it = parens_.end();
  while (it != parens_.begin() && it[-1].of.word >= id.word) --it;
  if (it != parens_.end() && it->of == id)
    *it = {id, open, close_end};
  else
    parens_.insert(it, {id, open, close_end});
}

// ---- where nodes begin and end

namespace {

bool beginsWithOperand(ExprKind kind) {
  switch (shape(kind)) {
    case ExprShape::Leaf: return false;
    case ExprShape::Step: return true;
    case ExprShape::Operation: return kind != ExprKind::Unary && kind != ExprKind::New;
    case ExprShape::Initializer: return kind == ExprKind::Repeat;
    case ExprShape::Inserted: return kind == ExprKind::Convert || kind == ExprKind::AnyValue;
  }
  return false;
}

// The operand with which an expression begins, the first in its row of nodes.def; none: it begins with a token of its
// own.
ExprId firstOperand(const Tree& tree, ExprId id) {
  ExprId first;
  if (!beginsWithOperand(tree.kind(id))) return first;
  forEachField(tree, id, [&](const auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, ExprId>)
      if (!first) first = field;
  });
  return first;
}

}  // namespace

// Where an expression without operands begins: at its location, or at the point before it.
static Loc beginOfLeaf(const Tree& tree, ExprId id) {
  Loc loc = tree.loc(id);
  if (tree.kind(id) == ExprKind::Name && tree.expr(id).op == kGlobalName) --loc.offset;
  return loc;
}

Loc Tree::begin(ExprId id) const {
  while (const ExprId first = firstOperand(*this, id)) id = first;
  return beginOfLeaf(*this, id);
}

ExprId Tree::base(ExprId step) const {
  RUNG_INVARIANT(shape(kind(step)) == ExprShape::Step, "only a step of a path has a base");
  return firstOperand(*this, step);
}

// A node without an end is not written: it has a location, and an empty range there.
static Range rangeFrom(Loc begin, Loc end) { return {begin, end < begin ? begin : end}; }

const Tree::Parens* Tree::parensOf(ExprId id) const {
  if (expr(id).in_parens == 0) return nullptr;
  const auto found = std::lower_bound(parens_.begin(), parens_.end(), id.word,
                                      [](const Parens& p, uint32_t word) { return p.of.word < word; });
  return found != parens_.end() && found->of == id ? &*found : nullptr;
}

Range Tree::range(ExprId id) const {
  if (const Parens* parens = parensOf(id)) return {parens->open, parens->end};
  return bareRange(id);
}

Range Tree::bareRange(ExprId id) const {
  ExprId at = id;
  while (const ExprId first = firstOperand(*this, at)) {
    if (const Parens* parens = parensOf(first)) return rangeFrom(parens->open, expr(id).end);
    at = first;
  }
  return rangeFrom(beginOfLeaf(*this, at), expr(id).end);
}

Range Tree::range(StmtId id) const {
  const StmtHeader& h = stmt(id);
  Loc begin = h.loc;
  if (h.kind == StmtKind::Assign)
    if (const Range target = range(as<AssignStmt>(id).target); target.begin < target.end) begin = target.begin;
  if (h.kind == StmtKind::Call) begin = range(as<CallStmt>(id).call).begin;
  return rangeFrom(begin, h.end);
}

Range Tree::range(TypeExprId id) const {
  const TypeExprHeader& h = typeExpr(id);
  Loc begin = h.loc;
  if (h.kind == TypeExprKind::Enum)  // INT (a, b), but not (a, b) INT
    if (const TypeExprId base = as<EnumTypeExpr>(id).base) begin = std::min(begin, typeExpr(base).loc);
  if (h.kind == TypeExprKind::Struct)  // a EXTENDS b : STRUCT
    if (const TypeExprId base = as<StructTypeExpr>(id).base) begin = std::min(begin, typeExpr(base).loc);
  return rangeFrom(begin, h.end);
}

Range Tree::range(DeclId id) const { return rangeFrom(decl(id).begin, decl(id).end); }

}  // namespace rung

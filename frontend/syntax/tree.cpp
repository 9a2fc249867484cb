#include "frontend/syntax/tree.h"

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

Tree::Tree() = default;

Tree::~Tree() {
  for (const uint32_t* chunk : chunks_) delete[] chunk;
}

uint32_t Tree::store(const void* node, size_t bytes) {
  const auto words = static_cast<uint32_t>((bytes + 3) / 4);
  if (next_word_ % kChunkWords + words > kChunkWords) next_word_ = (next_word_ / kChunkWords + 1) * kChunkWords;
  const uint32_t chunk = next_word_ / kChunkWords;
  if (chunk == chunks_.size()) chunks_.push_back(new uint32_t[kChunkWords]);
  const uint32_t word = next_word_;
  std::memcpy(chunks_[chunk] + word % kChunkWords, node, bytes);
  next_word_ += words;
  return word;
}

Loc Tree::begin(ExprId id) const {
  for (;;) {
    switch (kind(id)) {
      case ExprKind::Member: id = as<MemberExpr>(id).base; break;
      case ExprKind::Index: id = as<IndexExpr>(id).base; break;
      case ExprKind::This:
      case ExprKind::Super: return loc(id);
      case ExprKind::Deref: id = as<DerefExpr>(id).base; break;
      case ExprKind::BitAccess: id = as<BitAccessExpr>(id).base; break;
      case ExprKind::Binary: id = as<BinaryExpr>(id).left; break;
      case ExprKind::Call: id = as<CallExpr>(id).callee; break;
      case ExprKind::Range: id = as<RangeExpr>(id).low; break;
      case ExprKind::Repeat: id = as<RepeatExpr>(id).count; break;
      case ExprKind::Convert: id = as<ConvertExpr>(id).operand; break;
      case ExprKind::AnyValue: id = as<AnyValueExpr>(id).value; break;
      case ExprKind::New:
      case ExprKind::AddressOf:
      case ExprKind::Bound:
      case ExprKind::Error:
      case ExprKind::Literal:
      case ExprKind::Name:
      case ExprKind::TypedName:
      case ExprKind::Address:
      case ExprKind::Unary:
      case ExprKind::ArrayInit:
      case ExprKind::StructInit: return loc(id);
    }
    if (!id) return {};
  }
}

StringId Tree::addString(std::string_view text) {
  const StringId id{static_cast<uint32_t>(strings_.size()), static_cast<uint32_t>(text.size())};
  strings_.insert(strings_.end(), text.begin(), text.end());
  return id;
}

}  // namespace rung

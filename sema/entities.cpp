// SPDX-License-Identifier: Apache-2.0
#include "sema/entities.h"

namespace rung::sema {

using types::Op;
using types::TypeKind;
using types::TypeTable;
using types::Value;

bool sameParameters(const Symbols& symbols, PouId a, PouId b) {
  const auto isParameter = [&](VarId id) {
    const SectionKind section = symbols.var(id).section;
    return section == SectionKind::Input || section == SectionKind::Output || section == SectionKind::InOut;
  };
  std::vector<VarId> left, right;
  for (const VarId id : symbols.pou(a).vars)
    if (isParameter(id)) left.push_back(id);
  for (const VarId id : symbols.pou(b).vars)
    if (isParameter(id)) right.push_back(id);
  if (left.size() != right.size()) return false;
  for (size_t i = 0; i < left.size(); ++i) {
    const Var &one = symbols.var(left[i]), &other = symbols.var(right[i]);
    const TypeId type = symbols.types.resolve(one.type);
    const bool texts = types::TypeTable::isString(symbols.types.info(type).kind) &&
                       symbols.types.info(type).kind == symbols.types.kind(other.type);
    if (one.section != other.section || (!texts && type != symbols.types.resolve(other.type))) return false;
  }
  return true;
}

PouId methodLike(const Symbols& symbols, PouId object, PouId like_id) {
  const Pou& like = symbols.pou(like_id);
  for (const PouId member : symbols.pou(object).members) {
    const Pou& pou = symbols.pou(member);
    const bool is_action = like.kind == PouKind::Action && pou.kind == PouKind::Action && !pou.chart;
    if ((pou.kind != PouKind::Method && !is_action) || pou.object.accessor != like.object.accessor ||
        !symbols.names.same(pou.name, like.name))
      continue;
    if ((!pou.overloads.first && !like.overloads.first) || sameParameters(symbols, member, like_id)) return member;
  }
  return {};
}

namespace {

// The code of a string of one character: a byte for a CHAR, else a code point (a WCHAR: one 16-bit unit).
uint64_t characterOf(std::string_view text, TypeKind kind) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const uint64_t lead = byte(0);
  if (kind == TypeKind::Char || text.size() < 2 || lead < 0xc0) return lead;
  if (lead < 0xe0) return (lead & 0x1f) << 6 | (byte(1) & 0x3f);
  if (lead < 0xf0) return (lead & 0x0f) << 12 | (byte(1) & 0x3f) << 6 | (byte(2) & 0x3f);
  return (lead & 0x07) << 18 | (byte(1) & 0x3f) << 12 | (byte(2) & 0x3f) << 6 | (byte(3) & 0x3f);
}

}  // namespace

Value valueOf(const Symbols& symbols, const LiteralExpr& literal) {
  const TypeTable& table = symbols.types;
  const TypeId type = table.resolve(meaning(literal.h).type);
  const TypeKind kind = table.plainKind(type);
  const bool negative = literal.form.is_negative;
  switch (literal.literal()) {
    case LiteralKind::Bool:
    case LiteralKind::Null: return {type, literal.value()};
    case LiteralKind::Integer: {
      const uint64_t bits = negative ? 0 - literal.value() : literal.value();
      if (!TypeTable::isReal(kind) && kind != TypeKind::RealLiteral) return {type, bits};
      return types::convert(table, {types::idOf(negative ? TypeKind::LInt : TypeKind::ULInt), bits}, type).value;
    }
    case LiteralKind::Real: {
      const Value number{types::kLReal, literal.value()};
      if (kind == TypeKind::RealLiteral) return {type, number.bits};
      return types::convert(table, number, type).value;
    }
    case LiteralKind::String:
    case LiteralKind::WString: {
      const std::string_view text = symbols.tree.string(literal.string());
      if (TypeTable::isCharacter(kind)) return {type, characterOf(text, kind)};
      return {type, symbols.names.intern(text).index};
    }
    case LiteralKind::Duration: {
      if (kind != TypeKind::Time) return {type, literal.value()};
      const uint64_t ms = (negative ? 0 - literal.value() : literal.value()) / 1'000'000;
      return types::convert(table, {types::kLInt, negative ? 0 - ms : ms}, type).value;
    }
    case LiteralKind::Date: return types::convert(table, {types::idOf(TypeKind::LDate), literal.value()}, type).value;
    case LiteralKind::TimeOfDay:
      return types::convert(table, {types::idOf(TypeKind::LTimeOfDay), literal.value()}, type).value;
    case LiteralKind::DateTime:
      return types::convert(table, {types::idOf(TypeKind::LDateTime), literal.value()}, type).value;
  }
  return {type, 0};
}

Op operatorOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Or:
    case BinaryOp::OrElse: return Op::Or;
    case BinaryOp::Xor: return Op::Xor;
    case BinaryOp::And:
    case BinaryOp::AndThen: return Op::And;
    case BinaryOp::Equal: return Op::Eq;
    case BinaryOp::NotEqual: return Op::Ne;
    case BinaryOp::Less: return Op::Lt;
    case BinaryOp::LessEqual: return Op::Le;
    case BinaryOp::Greater: return Op::Gt;
    case BinaryOp::GreaterEqual: return Op::Ge;
    case BinaryOp::Add: return Op::Add;
    case BinaryOp::Subtract: return Op::Sub;
    case BinaryOp::Multiply: return Op::Mul;
    case BinaryOp::Divide: return Op::Div;
    case BinaryOp::Modulo: return Op::Mod;
    case BinaryOp::Power: return Op::Power;
  }
  return Op::Add;
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Literals. In: literals as parsed. Out: typed literals; untyped numbers keep the type IntegerLiteral or RealLiteral
// until their context gives them one (adapt) or they take their default (finalizeUntyped).
// An untyped expression is a tree of untyped literals and arithmetic on them: it is computed exactly, and only its
// result must fit. Each such tree is typed once, so the cost is linear.
#include "sema/bodies/literals.h"

#include <bit>
#include <cmath>

#include "frontend/source/dialect.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/types.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"
#include "sema/types/arithmetic.h"

namespace rung::sema {

namespace {

using Int128 = __int128;

struct Bounds {
  Int128 low, high;
};

Bounds boundsOf(const types::TypeTable& table, TypeKind kind) {
  const uint32_t width = types::TypeTable::bitWidth(kind);
  if (table.isSigned(kind)) return {-(Int128{1} << (width - 1)), (Int128{1} << (width - 1)) - 1};
  return {0, (Int128{1} << width) - 1};
}

std::string decimal(Int128 value) {
  if (value == 0) return "0";
  const bool negative = value < 0;
  std::string digits;
  for (unsigned __int128 rest = negative ? -static_cast<unsigned __int128>(value)
                                         : static_cast<unsigned __int128>(value);
       rest != 0; rest /= 10) {
    digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(rest % 10)));
  }
  return negative ? "-" + digits : digits;
}

Int128 literalValue(const LiteralExpr& node) {
  const Int128 value = node.value();
  return node.form.is_negative ? -value : value;
}

bool isIntegerLike(TypeKind kind) { return types::TypeTable::isInteger(kind) || types::TypeTable::isBits(kind); }

bool reportRange(Context& context, ExprId expr, Int128 value, TypeId to, Bounds bounds) {
  context.report(diag::ConstantOutOfRange, context.tree().begin(expr),
                 {decimal(value), context.types().toString(to), decimal(bounds.low), decimal(bounds.high)});
  context.type(expr) = types::kError;
  return false;
}

double realValue(const LiteralExpr& node) {
  if (node.literal() == LiteralKind::Integer) return static_cast<double>(literalValue(node));
  return std::bit_cast<double>(node.value());
}

// True when an untyped integer expression has another value on REAL: `1 / 2`, `NOT 5`.
bool needsIntegers(const Context& context, ExprId expr, bool& divides) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Unary) {
    const UnaryExpr& node = tree.as<UnaryExpr>(expr);
    return node.op() == UnaryOp::Not || needsIntegers(context, node.operand, divides);
  }
  if (tree.kind(expr) != ExprKind::Binary) return false;
  const BinaryExpr& node = tree.as<BinaryExpr>(expr);
  divides |= node.op() == BinaryOp::Divide;
  if (node.op() != BinaryOp::Add && node.op() != BinaryOp::Subtract && node.op() != BinaryOp::Multiply) return true;
  return needsIntegers(context, node.left, divides) || needsIntegers(context, node.right, divides);
}

// Folds `left op right`; false when the value is not known or too large for any type.
bool fold(BinaryOp op, Int128 left, Int128 right, Int128& value) {
  constexpr Int128 kLimit = Int128{1} << 100;
  const auto inLimit = [&] { return value < kLimit && value > -kLimit; };
  switch (op) {
    case BinaryOp::Add: value = left + right; return inLimit();
    case BinaryOp::Subtract: value = left - right; return inLimit();
    case BinaryOp::Multiply: return !__builtin_mul_overflow(left, right, &value) && inLimit();
    case BinaryOp::Divide:
      if (right == 0) return false;
      value = left / right;
      return true;
    case BinaryOp::Modulo:
      if (right == 0) return false;
      value = left % right;
      return true;
    case BinaryOp::And: value = left & right; return true;
    case BinaryOp::Or: value = left | right; return true;
    case BinaryOp::Xor: value = left ^ right; return true;
    case BinaryOp::OrElse:
    case BinaryOp::AndThen:
    case BinaryOp::Equal:
    case BinaryOp::NotEqual:
    case BinaryOp::Less:
    case BinaryOp::LessEqual:
    case BinaryOp::Greater:
    case BinaryOp::GreaterEqual:
    case BinaryOp::Power: return false;
  }
  return false;
}

// True when every part of an untyped expression of known value is inside the bounds.
bool partsFit(const Context& context, ExprId expr, Bounds bounds, Int128& value) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Unary) {
    const UnaryExpr& node = tree.as<UnaryExpr>(expr);
    if (node.op() == UnaryOp::Negate && tree.kind(node.operand) == ExprKind::Literal) {
      value = -literalValue(tree.as<LiteralExpr>(node.operand));
    } else if (!partsFit(context, node.operand, bounds, value)) {
      return false;
    } else if (node.op() == UnaryOp::Negate) {
      value = -value;
    }
  } else if (tree.kind(expr) == ExprKind::Binary) {
    const BinaryExpr& node = tree.as<BinaryExpr>(expr);
    Int128 left, right;
    if (!partsFit(context, node.left, bounds, left) || !partsFit(context, node.right, bounds, right)) return false;
    if (!fold(node.op(), left, right, value)) return false;
  } else {
    value = literalValue(tree.as<LiteralExpr>(expr));
  }
  return value >= bounds.low && value <= bounds.high;
}

void setIntegerType(Context& context, ExprId& expr, TypeId to) {
  const Tree& tree = context.tree();
  typeOf(tree, expr) = to;
  meaning(tree, expr).is_constant = 1;
  if (tree.kind(expr) == ExprKind::Unary) {
    UnaryExpr& node = context.code().as<UnaryExpr>(expr);
    setIntegerType(context, node.operand, to);
    if (node.op() == UnaryOp::Negate && tree.kind(node.operand) == ExprKind::Literal) {
      // -32768 is one value: its magnitude alone does not fit.
      const ExprId literal = context.code().duplicate(node.operand);
      LiteralForm& form = context.code().as<LiteralExpr>(literal).form;
      form.is_negative = !form.is_negative;
      context.replace(expr, literal);
    }
  } else if (tree.kind(expr) == ExprKind::Binary) {
    BinaryExpr& node = context.code().as<BinaryExpr>(expr);
    setIntegerType(context, node.left, to);
    setIntegerType(context, node.right, to);
  }
}

bool adaptInteger(Context& context, ExprId& expr, TypeId to, Bounds bounds) {
  const Tree& tree = context.tree();
  Int128 value;
  if (tree.kind(expr) == ExprKind::Literal) {
    LiteralExpr& node = context.code().as<LiteralExpr>(expr);
    value = literalValue(node);
    if (value < bounds.low || value > bounds.high) return reportRange(context, expr, value, to, bounds);
    meaning(node.h).type = to;
    return true;
  }
  if (!untypedValue(context, expr, value)) {  // NOT, or too large for any type
    setIntegerType(context, expr, to);
    return true;
  }
  if (value < bounds.low || value > bounds.high) return reportRange(context, expr, value, to, bounds);
  Int128 whole;
  if (partsFit(context, expr, bounds, whole)) {
    setIntegerType(context, expr, to);
    return true;
  }
  context.replace(expr, makeInteger(context, to, value, tree.begin(expr)));
  return true;
}

// A negative number for an unsigned type is the bit pattern of that width (codesys): `mask : WORD := -1`.
//   warns   count : UINT := -1;      W0562
bool adaptNegative(Context& context, ExprId& expr, TypeId to, TypeKind kind) {
  Int128 value;
  if (!context.profile().negative_bit_patterns || context.types().isSigned(kind) || kind == TypeKind::Bool)
    return false;
  const uint32_t width = types::TypeTable::bitWidth(kind);
  if (!untypedValue(context, expr, value) || value >= 0 || value < -(Int128{1} << (width - 1))) return false;
  const Int128 bits = (Int128{1} << width) + value;
  const Loc loc = context.tree().begin(expr);
  context.report(diag::NegativeWithoutSign, loc, {decimal(value), context.types().toString(to), decimal(bits)});
  context.replace(expr, makeLiteral(context, LiteralKind::Integer, to, static_cast<int64_t>(bits), loc));
  return true;
}

// A number of the unsigned type of the same width is the bit pattern (codesys): a literal without type has the smallest
// that holds it, here an unsigned one, and CODESYS warns of its conversion (C0196).
//   warns   id : INT := 37000;       W0583
bool adaptPattern(Context& context, ExprId& expr, TypeId to, TypeKind kind) {
  Int128 value;
  if (!context.profile().unsigned_bit_patterns || !context.types().isSigned(kind)) return false;
  const uint32_t width = types::TypeTable::bitWidth(kind);
  if (!untypedValue(context, expr, value) || value < Int128{1} << (width - 1) || value >= Int128{1} << width)
    return false;
  const Int128 stored = value - (Int128{1} << width);
  const Loc loc = context.tree().begin(expr);
  context.report(diag::SignBitSet, loc, {decimal(value), context.types().toString(to), decimal(stored)});
  context.replace(expr, makeInteger(context, to, stored, loc));
  return true;
}

bool adaptReal(Context& context, ExprId& expr, TypeId to);

// `whole`: an integer expression without a quotient, or a part of one.
bool setRealType(Context& context, ExprId& expr, TypeId to, bool whole) {
  const Tree& tree = context.tree();
  ExprHeader& header = context.code().expr(expr);
  if (!whole && meaning(header).type == types::idOf(TypeKind::IntegerLiteral)) return adaptReal(context, expr, to);
  meaning(header).type = to;
  if (header.kind == ExprKind::Unary)
    return setRealType(context, context.code().as<UnaryExpr>(expr).operand, to, whole);
  if (header.kind == ExprKind::Binary) {
    BinaryExpr& node = context.code().as<BinaryExpr>(expr);
    if (!setRealType(context, node.left, to, whole)) return false;
    if (node.op() == BinaryOp::Power && typeOf(tree, node.right) == types::idOf(TypeKind::IntegerLiteral)) {
      return finalizeUntyped(context, node.right) != types::kError;
    }
    return setRealType(context, node.right, to, whole);
  }
  meaning(header).is_constant = 1;
  constexpr double kRoundsToInfinity = 3.4028235677973366e38;  // halfway between the largest REAL and the next
  const double value = std::fabs(realValue(tree.as<LiteralExpr>(expr)));
  if (context.types().plainKind(to) != TypeKind::Real || value < kRoundsToInfinity) return true;
  context.report(diag::RealOutOfRange, header.loc, {"REAL"});
  meaning(header).type = types::kError;
  return false;
}

bool adaptReal(Context& context, ExprId& expr, TypeId to) {
  ExprHeader& header = context.code().expr(expr);
  const bool integer = meaning(header).type == types::idOf(TypeKind::IntegerLiteral);
  bool divides = false;
  if (integer && needsIntegers(context, expr, divides)) {
    if (divides) context.report(diag::IntegerDivision, header.loc);
    if (finalizeUntyped(context, expr) == types::kError) return false;
    wrapConvert(context, expr, to);
    return true;
  }
  if (!setRealType(context, expr, to, integer)) return false;
  if (context.tree().kind(expr) != ExprKind::Binary) return true;
  evaluate(context, expr);  // reports a value beyond the type (W0368)
  return true;
}

// The length of a string of this kind in its units: bytes, or UTF-16 units; of a UCHAR in characters.
uint32_t lengthOf(std::string_view value, TypeKind kind) {
  if (kind != TypeKind::WString && kind != TypeKind::WChar && kind != TypeKind::UChar)
    return static_cast<uint32_t>(value.size());
  const uint32_t outside = kind == TypeKind::UChar ? 1 : 2;  // of U+10000 and above
  uint32_t units = 0;
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) != 0x80) units += byte >= 0xf0 ? outside : 1;
  }
  return units;
}

// '$E9' is a byte of a STRING. In Unicode strings, bytes that are not UTF-8 are the characters of these codes.
void makeUnicode(Context& context, ExprId& expr) {
  const LiteralExpr& node = context.tree().as<LiteralExpr>(expr);
  std::string_view rest = context.tree().string(node.string());
  if (node.literal() == LiteralKind::WString || isUtf8(rest)) return;  // those of "..." are codes of 16 bits already
  std::string out;
  for (size_t bad = findInvalidUtf8(rest); bad != std::string_view::npos; bad = findInvalidUtf8(rest)) {
    out.append(rest.substr(0, bad));
    appendUtf8(out, static_cast<unsigned char>(rest[bad]));
    rest.remove_prefix(bad + 1);
  }
  out.append(rest);
  const StringId characters = context.code().addString(out);
  const ExprId created = context.code().duplicate(expr);
  context.code().as<LiteralExpr>(created).low = characters.first;
  context.code().as<LiteralExpr>(created).high = characters.length;
  context.replace(expr, created);
}

TypeId prefixType(Context& context, LiteralExpr& node) {
  if (const TypeId elementary = context.types().elementary(node.prefix)) {
    const TypeId own = ownTypeOfLateName(context, node.prefix, node.h.loc, context.types().info(elementary).kind);
    return own ? own : elementary;
  }
  const Entity entity = lookUp(context, node.prefix);
  if (entity.entityKind() == EntityKind::Type) {
    noteName(context, entity, node.h.loc);
    return TypeId{entity.index};
  }
  if (!entity) {
    if (isFirstReport(context, node.prefix))
      context.report(diag::UnknownName, node.h.loc, {string(context, node.prefix)})
          .didYouMean(nearestName(context, node.prefix));
  } else {
    context.report(diag::NotALiteralType, node.h.loc, {string(context, node.prefix)});
  }
  return types::kError;
}

TypeId checkTypedNumber(Context& context, ExprId& expr) {
  LiteralExpr& node = context.code().as<LiteralExpr>(expr);
  Meaning& known = meaning(node.h);
  const TypeId type = prefixType(context, node);
  if (type == types::kError) return known.type = type;
  const TypeKind kind = context.types().plainKind(type);
  if (types::TypeTable::isReal(kind) &&
      (node.literal() == LiteralKind::Real || node.literal() == LiteralKind::Integer)) {
    return adaptReal(context, expr, type) ? type : types::kError;
  }
  if (isIntegerLike(kind) && node.literal() == LiteralKind::Integer) {
    return adaptInteger(context, expr, type, boundsOf(context.types(), kind)) ? type : types::kError;
  }
  if (kind == TypeKind::Bool && node.literal() == LiteralKind::Integer) {
    if (node.value() > 1) {
      reportRange(context, expr, literalValue(node), type, {0, 1});
      return types::kError;
    }
    return known.type = type;
  }
  if (kind == TypeKind::Bool && node.literal() == LiteralKind::Bool) return known.type = type;
  if ((types::TypeTable::isString(kind) || types::TypeTable::isCharacter(kind)) &&
      (node.literal() == LiteralKind::String || node.literal() == LiteralKind::WString)) {
    if (kind != TypeKind::String && kind != TypeKind::Char) makeUnicode(context, expr);
    LiteralExpr& text = context.code().as<LiteralExpr>(expr);
    const uint32_t length = lengthOf(context.tree().string(text.string()), kind);
    if (types::TypeTable::isString(kind)) return meaning(text.h).type = context.types().string(kind, length);
    if (length == 1) return meaning(text.h).type = type;
    const uint64_t value = context.names().intern(context.tree().string(text.string())).index;
    context.report(diag::NotOneCharacter, node.h.loc,
                   {types::toString(context.types(), context.names(),
                                    {context.types().string(types::TypeTable::stringOf(kind), 1), value}),
                    context.types().toString(type)});
    return meaning(text.h).type = types::kError;
  }
  context.report(diag::NotALiteralType, node.h.loc, {string(context, node.prefix)});
  return known.type = types::kError;
}

// T# and similar: the long form where it is written or wanted, else the short one when the value fits.
TypeId checkSpan(Context& context, LiteralExpr& node, TypeId expected, TypeKind shorter, TypeKind longer,
                 int64_t unit) {
  Meaning& known = meaning(node.h);
  const TypeKind wanted = expected ? context.types().plainKind(expected) : TypeKind::None;
  // IEC 61131-3 ed. 2, 2.2.3.1: only the most significant unit may overflow. CODESYS, "TIME Constants".
  //   passes  T#90m        fails  T#1h90m        E0246, in codesys W0258
  if (node.form.overflows)
    context.report(context.profile().overflowing_durations ? diag::DurationOverflowWarning : diag::DurationOverflow,
                   node.h.loc, {context.symbols.sources.tokenAt(node.h.loc)});
  // A duration is 64 bits of nanoseconds; LTIME with a sign has one bit less, without one no negative values.
  const bool is_long = node.form.is_long || wanted == longer;
  const bool is_signed = context.types().isSigned(longer);
  const bool is_negative = node.form.is_negative && node.value() != 0;
  const bool beyond = is_signed ? !is_negative && node.value() >> 63 != 0 : is_negative;
  if (is_long && longer == TypeKind::LTime && beyond) {
    const uint64_t low = is_signed ? uint64_t{1} << 63 : 0, high = ~uint64_t{0} >> (is_signed ? 1 : 0);
    context.report(diag::ConstantOutOfRange, node.h.loc,
                   {context.symbols.sources.tokenAt(node.h.loc), context.types().toString(types::idOf(longer)),
                    types::toString(context.types(), context.names(), {types::kLTime, low}),
                    types::toString(context.types(), context.names(), {types::kLTime, high})});
    return known.type = types::kError;
  }
  if (is_long) return known.type = types::idOf(longer);
  const int64_t count = static_cast<int64_t>(node.value()) / unit;
  const Bounds bounds = boundsOf(context.types(), shorter);
  const bool negative = static_cast<int64_t>(node.value()) < 0;
  if (count < bounds.low || count > bounds.high || (negative && bounds.low == 0)) {
    const types::Value low{types::idOf(shorter), static_cast<uint64_t>(bounds.low)};
    const types::Value high{types::idOf(shorter), static_cast<uint64_t>(bounds.high)};
    context.report(diag::ConstantOutOfRange, node.h.loc,
                   {context.symbols.sources.tokenAt(node.h.loc), context.types().toString(types::idOf(shorter)),
                    types::toString(context.types(), context.names(), low),
                    types::toString(context.types(), context.names(), high)});
    return known.type = types::kError;
  }
  if (static_cast<int64_t>(node.value()) % unit != 0) {
    const types::Value stored{types::idOf(shorter), static_cast<uint64_t>(count)};
    context.report(diag::LiteralFiner, node.h.loc,
                   {context.symbols.sources.tokenAt(node.h.loc), context.types().toString(types::idOf(shorter)),
                    types::toString(context.types(), context.names(), stored),
                    unit == 1'000'000 ? "milliseconds" : "seconds", context.types().toString(types::idOf(longer))});
  }
  return known.type = types::idOf(shorter);
}

TypeId checkString(Context& context, ExprId& expr, TypeId expected) {
  LiteralExpr& node = context.code().as<LiteralExpr>(expr);
  const TypeKind own = node.literal() == LiteralKind::WString ? TypeKind::WString : TypeKind::String;
  meaning(node.h).type = context.types().string(own, lengthOf(context.tree().string(node.string()), own));
  if (expected) retypeString(context, expr, expected);
  return context.type(expr);
}

}  // namespace

void retypeString(Context& context, ExprId& expr, TypeId wanted) {
  const LiteralExpr& node = context.tree().as<LiteralExpr>(expr);
  const TypeKind kind = context.types().plainKind(wanted);
  const bool is_string = types::TypeTable::isString(kind), wide = node.literal() == LiteralKind::WString;
  if (node.prefix || (node.literal() != LiteralKind::String && !wide)) return;
  if (!is_string && !types::TypeTable::isCharacter(kind)) return;
  const bool is_wide_kind = kind == TypeKind::WString || kind == TypeKind::WChar;
  const bool widens = context.symbols.profile.wide_plain_strings;
  if (wide ? !is_wide_kind : is_wide_kind && !widens) return;
  const std::string_view value = context.tree().string(node.string());
  if (kind != TypeKind::String && kind != TypeKind::Char && !wide && !isUtf8(value)) {
    if (!is_string && value.size() != 1) return;
    makeUnicode(context, expr);
  }
  LiteralExpr& text = context.code().as<LiteralExpr>(expr);
  const uint32_t length = lengthOf(context.tree().string(text.string()), kind);
  if (is_string)
    meaning(text.h).type = context.types().string(kind, length);
  else if (length == 1)
    meaning(text.h).type = wanted;
}

TypeId checkLiteral(Context& context, ExprId& expr, TypeId expected) {
  LiteralExpr& node = context.code().as<LiteralExpr>(expr);
  Meaning& known = meaning(node.h);
  known.is_constant = 1;
  switch (node.literal()) {
    case LiteralKind::Bool: return node.prefix ? checkTypedNumber(context, expr) : known.type = types::kBool;
    case LiteralKind::Integer:
      return node.prefix ? checkTypedNumber(context, expr) : known.type = types::idOf(TypeKind::IntegerLiteral);
    case LiteralKind::Real:
      return node.prefix ? checkTypedNumber(context, expr) : known.type = types::idOf(TypeKind::RealLiteral);
    case LiteralKind::String:
    case LiteralKind::WString:
      return node.prefix ? checkTypedNumber(context, expr) : checkString(context, expr, expected);
    case LiteralKind::Duration: return checkSpan(context, node, expected, TypeKind::Time, TypeKind::LTime, 1'000'000);
    case LiteralKind::Date: return checkSpan(context, node, expected, TypeKind::Date, TypeKind::LDate, 1'000'000'000);
    case LiteralKind::TimeOfDay:
      return checkSpan(context, node, expected, TypeKind::TimeOfDay, TypeKind::LTimeOfDay, 1'000'000);
    case LiteralKind::DateTime:
      return checkSpan(context, node, expected, TypeKind::DateTime, TypeKind::LDateTime, 1'000'000'000);
    case LiteralKind::Null: return known.type = types::idOf(TypeKind::NullLiteral);
  }
  return known.type = types::kError;
}

// Forbids, in iec, a constant outside the subrange that it is assigned to; codesys warns, and takes the nearer bound.
// IEC 61131-3 ed. 3, 6.4.4.4.
//   passes  percent := INT#50;      fails  percent := INT#150;      E0565
bool isInSubrange(Context& context, ExprId expr, Int128 value, TypeId subrange) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(subrange));
  const bool is_signed = context.types().isSigned(context.types().plainKind(subrange));
  const Int128 low = is_signed ? Int128{info.low} : Int128{static_cast<uint64_t>(info.low)};
  const Int128 high = is_signed ? Int128{info.high} : Int128{static_cast<uint64_t>(info.high)};
  if (value >= low && value <= high) return true;
  context.report(context.profile().free_subranges ? diag::OutsideSubrange : diag::NotInSubrange,
                 context.tree().begin(expr),
                 {decimal(value), context.types().toString(subrange), decimal(low), decimal(high)});
  return false;
}

bool untypedValue(const Context& context, ExprId expr, Int128& value) {
  const Tree& tree = context.tree();
  if (tree.kind(expr) == ExprKind::Literal) {
    const LiteralExpr& node = tree.as<LiteralExpr>(expr);
    value = literalValue(node);
    return node.literal() == LiteralKind::Integer;
  }
  if (tree.kind(expr) == ExprKind::Unary) {
    const UnaryExpr& node = tree.as<UnaryExpr>(expr);
    if (node.op() == UnaryOp::Not || !untypedValue(context, node.operand, value)) return false;
    if (node.op() == UnaryOp::Negate) value = -value;
    return true;
  }
  if (tree.kind(expr) != ExprKind::Binary) return false;
  const BinaryExpr& node = tree.as<BinaryExpr>(expr);
  Int128 left, right;
  if (!untypedValue(context, node.left, left) || !untypedValue(context, node.right, right)) return false;
  return fold(node.op(), left, right, value);
}

TypeId defaultType(Context& context, ExprId expr) {
  if (context.type(expr) == types::idOf(TypeKind::RealLiteral)) return types::kReal;
  Int128 value;
  if (!untypedValue(context, expr, value)) return types::kLInt;
  for (const TypeId type : {types::kInt, types::kDInt, types::kLInt}) {
    const Bounds bounds = boundsOf(context.types(), context.types().kind(type));
    if (value >= bounds.low && value <= bounds.high) return type;
  }
  return types::kULInt;
}

bool untypedFits(Context& context, ExprId expr, TypeId to) {
  const TypeKind kind = context.types().plainKind(to);
  const bool integer = context.type(expr) == types::idOf(TypeKind::IntegerLiteral);
  if (types::TypeTable::isReal(kind)) return true;
  if (!integer) return false;
  Int128 value;
  if (kind == TypeKind::Bool) {
    return context.tree().kind(expr) == ExprKind::Literal && untypedValue(context, expr, value) && value >= 0 &&
           value <= 1;
  }
  if (!isIntegerLike(kind)) return false;
  if (!untypedValue(context, expr, value)) return true;
  const Bounds bounds = boundsOf(context.types(), kind);
  return value >= bounds.low && value <= bounds.high;
}

bool adapt(Context& context, ExprId& expr, TypeId to, const Purpose& purpose) {
  ExprHeader& header = context.code().expr(expr);
  const TypeId target = context.types().resolve(to);
  const types::TypeInfo& info = context.types().info(target);
  const TypeKind kind = context.types().plainKind(target);
  if (types::TypeTable::isReal(kind)) return adaptReal(context, expr, to);
  if (meaning(header).type == types::idOf(TypeKind::IntegerLiteral)) {
    if (info.kind == TypeKind::Subrange) {
      const Bounds bounds = boundsOf(context.types(), kind);
      Int128 value;
      if (untypedValue(context, expr, value) && value >= bounds.low && value <= bounds.high) {
        if (!isInSubrange(context, expr, value, to)) {
          if (!context.profile().free_subranges) return false;
          if (!adaptInteger(context, expr, info.base, bounds)) return false;
          wrapConvert(context, expr, to);
          return true;
        }
      }
      return adaptInteger(context, expr, to, bounds);
    }
    if (isIntegerLike(kind) && info.kind != TypeKind::Enum) {
      if (adaptNegative(context, expr, to, kind) || adaptPattern(context, expr, to, kind)) return true;
      return adaptInteger(context, expr, to, boundsOf(context.types(), kind));
    }
    if (kind == TypeKind::Bool) {
      Int128 value;
      if (context.tree().kind(expr) == ExprKind::Literal && untypedValue(context, expr, value) && value >= 0 &&
          value <= 1) {
        meaning(header).type = to;
        return true;
      }
    }
  }
  const TypeId own = finalizeUntyped(context, expr);
  if (own == types::kError) return false;
  return convert(context, expr, to, purpose);
}

TypeId finalizeUntyped(Context& context, ExprId& expr, TypeId expected) {
  const TypeId now = context.type(expr);
  if (!isUntyped(context, now)) return now;
  TypeId to = defaultType(context, expr);
  if (expected && untypedFits(context, expr, expected)) to = expected;
  return adapt(context, expr, to, {}) ? to : types::kError;
}

}  // namespace rung::sema

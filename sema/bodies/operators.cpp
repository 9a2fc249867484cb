// SPDX-License-Identifier: Apache-2.0
// Operators: the common type of both sides, and the type of the result. In: UnaryExpr, BinaryExpr, and the operands of
// operator functions (ADD, MAX, EQ …), which follow the same rules. Out: types, and conversions of the operands.
// The type of an integer operation is that of its operands; the target of an assignment does not widen it. In codesys
// the value may be wider until it is stored: sema/intermediate.h.
#include "sema/bodies/operators.h"

#include "sema/access.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/division_by_zero.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/implicit_checks.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/bodies/pointers.h"
#include "sema/bodies/temporaries.h"
#include "sema/bodies/time_arithmetic.h"
#include "sema/fixes.h"
#include "sema/hooks.h"
#include "sema/intermediate.h"
#include "sema/shorthands.h"
#include "sema/types/arithmetic.h"

namespace rung::sema {

namespace {

using types::TypeTable;

constexpr Purpose kOperand{Use::OtherOperand, {}, {}};

bool isTimeKind(TypeKind k) { return TypeTable::isDuration(k) || TypeTable::isDate(k); }

TypeId reportOperand(Context& context, std::string_view what, TypeId type, Loc loc) {
  const TypeKind kind = context.types().plainKind(type);
  const bool extension = (TypeTable::isBits(kind) && !context.profile().bit_arithmetic) ||
                         (TypeTable::isInteger(kind) && !context.profile().integers_as_bits);
  context.report(extension ? diag::OperandExtension : diag::OperandType, loc, {what, context.types().toString(type)});
  return types::kError;
}

TypeId reportOperands(Context& context, std::string_view what, TypeId a, TypeId b, Loc loc) {
  const auto word = [&](TypeId type) {
    const TypeKind kind = context.types().info(type).kind;
    if (kind == TypeKind::IntegerLiteral) return std::string("INT");
    if (kind == TypeKind::RealLiteral) return std::string("REAL");
    return context.types().toString(type);
  };
  context.report(diag::OperandTypes, loc, {what, word(a), word(b)});
  return types::kError;
}

// The common type of two typed operands, whether or not the operator accepts it. None: they do not combine.
TypeId join(Context& context, TypeId a, TypeId b) {
  types::TypeTable& table = context.types();
  if (sameType(context, a, b)) return a;
  if (isNamedValueOf(context, a, b)) return table.plain(a);
  const TypeKind x = table.plainKind(a), y = table.plainKind(b);
  if (TypeTable::isNumber(x) && TypeTable::isNumber(y)) {
    const bool enums = table.kind(a) == TypeKind::Enum || table.kind(b) == TypeKind::Enum;
    if (enums && (!context.profile().enums_as_numbers || table.kind(a) == table.kind(b))) return {};
    if (!context.profile().bits_as_integers && TypeTable::isBits(x) != TypeTable::isBits(y)) return {};
    return commonNumber(context, a, b);
  }
  const TypeId left = table.resolve(a), right = table.resolve(b);
  if (TypeTable::isString(x) && x == y) return table.info(left).length >= table.info(right).length ? a : b;
  if (fit(context, a, b) == Fit::Lossless) return b;
  if (fit(context, b, a) == Fit::Lossless) return a;
  if (table.info(left).kind == TypeKind::NullLiteral && table.info(right).kind == TypeKind::Pointer) return b;
  if (table.info(right).kind == TypeKind::NullLiteral && table.info(left).kind == TypeKind::Pointer) return a;
  if (table.info(left).kind == TypeKind::Pointer && table.info(right).kind == TypeKind::Pointer &&
      context.profile().pointers_beside_others) {
    return a;
  }
  return {};
}

// The common type of a typed and an untyped operand: the typed one's where the literal fits it.
TypeId joinUntyped(Context& context, TypeId typed, ExprId literal, TypeId expected) {
  types::TypeTable& table = context.types();
  const TypeId plain = table.plain(typed);
  const TypeKind kind = table.info(plain).kind;
  if (table.kind(typed) == TypeKind::Enum && !context.profile().enums_as_numbers) return {};
  if (untypedFits(context, literal, plain)) return plain;
  if (context.type(literal) == types::idOf(TypeKind::RealLiteral)) {
    if (!TypeTable::isNumber(kind) || (!context.profile().bit_arithmetic && TypeTable::isBits(kind))) return {};
    const TypeKind wanted = expected ? table.plainKind(expected) : TypeKind::None;
    if (TypeTable::isReal(wanted)) return types::idOf(wanted);
    return types::isLossless(table, plain, types::kReal) ? types::kReal : types::kLReal;
  }
  if (TypeTable::isBits(kind)) {
    for (const TypeId wider : {types::kWord, types::kDWord, types::kLWord}) {
      if (untypedFits(context, literal, wider)) return wider;
    }
    if (!context.profile().bits_as_integers) return {};
  }
  if (!TypeTable::isNumber(kind)) return {};
  return commonNumber(context, plain, defaultType(context, literal));
}

bool accepts(Context& context, Operands accepted, TypeId type) {
  const TypeKind kind = context.types().kind(type);
  const TypeKind plain = context.types().plainKind(type);
  const bool enumeration = kind == TypeKind::Enum;
  if (enumeration && accepted != Operands::Anything && accepted != Operands::Equatable) {
    const bool named_values = context.types().info(context.types().resolve(type)).named_values;
    if ((!context.profile().enums_as_numbers && !named_values) ||
        (context.types().info(context.types().resolve(type)).strict && accepted != Operands::Comparable)) {
      return false;
    }
  }
  const bool bits = TypeTable::isBits(plain);
  switch (accepted) {
    case Operands::Number: return TypeTable::isNumber(plain) && (!bits || context.profile().bit_arithmetic);
    case Operands::NumberOrTime:
      return (TypeTable::isNumber(plain) && (!bits || context.profile().bit_arithmetic)) ||
             TypeTable::isDuration(plain);
    case Operands::Bits:
      return plain == TypeKind::Bool || bits || (TypeTable::isInteger(plain) && context.profile().integers_as_bits);
    case Operands::Comparable:  // the standard compares references for equality only: ed. 3, 6.4.4.10.5
      if (kind == TypeKind::Pointer && !context.profile().ordered_pointers) return false;
      [[fallthrough]];
    case Operands::Equatable:
      return TypeTable::isElementary(plain) || kind == TypeKind::Pointer || kind == TypeKind::NullLiteral;
    case Operands::Anything: return true;
  }
  return false;
}

// 'x' = c: next to a character a string literal of one character is that character, and next to a WSTRING or USTRING
// one in single quotes is a string of that kind.
void typeCharacters(Context& context, std::span<ExprId> operands) {
  for (const ExprId operand : operands) {
    const TypeKind kind = context.types().plainKind(context.type(operand));
    if (!TypeTable::isCharacter(kind) && kind != TypeKind::WString && kind != TypeKind::UString) continue;
    const bool is_literal = context.tree().kind(operand) == ExprKind::Literal;
    if (is_literal && !context.tree().as<LiteralExpr>(operand).prefix) continue;
    for (ExprId& other : operands) {
      if (context.tree().kind(other) == ExprKind::Literal) retypeString(context, other, types::idOf(kind));
    }
    return;
  }
}

bool keepsOwnType(Operands accepted) {
  return accepted == Operands::Anything || accepted == Operands::Comparable || accepted == Operands::Equatable;
}

Operands operandsOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Or:
    case BinaryOp::OrElse:
    case BinaryOp::Xor:
    case BinaryOp::And:
    case BinaryOp::AndThen: return Operands::Bits;
    case BinaryOp::Equal:
    case BinaryOp::NotEqual: return Operands::Equatable;
    case BinaryOp::Less:
    case BinaryOp::LessEqual:
    case BinaryOp::Greater:
    case BinaryOp::GreaterEqual: return Operands::Comparable;
    case BinaryOp::Add:
    case BinaryOp::Subtract: return Operands::NumberOrTime;
    case BinaryOp::Multiply:
    case BinaryOp::Divide:
    case BinaryOp::Modulo:
    case BinaryOp::Power: return Operands::Number;
  }
  return Operands::Number;
}

bool isComparison(BinaryOp op) { return op >= BinaryOp::Equal && op <= BinaryOp::GreaterEqual; }

// Both sides are untyped: the result is, too, except of comparisons. None when the sides must be typed first.
TypeId combineUntyped(Context& context, BinaryExpr& node) {
  const BinaryOp op = node.op();
  if (isComparison(op) || op == BinaryOp::OrElse || op == BinaryOp::AndThen) return {};
  if (op == BinaryOp::Power) return types::idOf(TypeKind::RealLiteral);
  const bool real = context.type(node.left) == types::idOf(TypeKind::RealLiteral) ||
                    context.type(node.right) == types::idOf(TypeKind::RealLiteral);
  if (real && (operandsOf(op) == Operands::Bits || op == BinaryOp::Modulo))
    return reportOperand(context, spelling(op), types::kReal, node.h.loc);
  const bool divides = op == BinaryOp::Divide || op == BinaryOp::Modulo;
  if (divides && !checkDivisor(context, node.right, op)) return types::kError;
  return types::idOf(real ? TypeKind::RealLiteral : TypeKind::IntegerLiteral);
}

// Items of two enumerations are compared by their numbers (codesys).
bool areOtherEnums(const Context& context, Operands accepted, TypeId a, TypeId b) {
  const types::TypeTable& table = context.types();
  const bool compares = accepted == Operands::Comparable || accepted == Operands::Equatable;
  return compares && context.profile().enums_compared && table.kind(a) == TypeKind::Enum &&
         table.kind(b) == TypeKind::Enum && table.resolve(a) != table.resolve(b);
}

}  // namespace

// A number in the process image, as in `x * %IW62`: a direct address has no declaration that could give it a numeric
// type, so in arithmetic its bits are those of an integer, signed as the other operands. IEC 61131-3 ed. 2, 2.4.1.2;
// syntax manual 001, 5.3.2.
static void typeAddresses(Context& context, std::span<ExprId> operands) {
  bool is_unsigned = false;
  for (const ExprId operand : operands) {
    const TypeKind kind = context.types().plainKind(context.type(operand));
    is_unsigned |= TypeTable::isInteger(kind) && !context.types().isSigned(kind);
  }
  for (ExprId& operand : operands) {
    if (context.tree().kind(operand) != ExprKind::Address) continue;
    struct Row {
      TypeKind bits, if_signed, if_unsigned;
    };
    static constexpr Row kRows[] = {{TypeKind::Byte, TypeKind::SInt, TypeKind::USInt},
                                    {TypeKind::Word, TypeKind::Int, TypeKind::UInt},
                                    {TypeKind::DWord, TypeKind::DInt, TypeKind::UDInt},
                                    {TypeKind::LWord, TypeKind::LInt, TypeKind::ULInt}};
    const TypeKind kind = context.types().plainKind(context.type(operand));
    for (const Row& row : kRows)
      if (row.bits == kind) wrapConvert(context, operand, types::idOf(is_unsigned ? row.if_unsigned : row.if_signed));
  }
}

namespace {

// The operands of one operator on the way to their common type.
struct Unification {
  Context& context;
  std::span<ExprId> operands;
  Operands accepted;
  TypeId expected;
  std::string_view what;
  Loc loc;
  TypeId common;
  bool untyped = false, real = false;  // literals among them
  bool mixed_enums = false;

  TypeId type(ExprId operand) const { return context.type(operand); }
  bool accepts(TypeId type) const { return sema::accepts(context, accepted, type); }
  bool fail(TypeId first, TypeId second) const {
    reportOperands(context, what, first, second, loc);
    return false;
  }

  TypeId run() {
    if (!joinTyped()) return types::kError;
    if (common && !keepsOwnType(accepted)) common = context.types().plain(common);
    if (untyped && (common ? !joinLiterals() : !chooseForLiterals())) return types::kError;
    const bool ok = TypeTable::isString(context.types().plainKind(common)) ? convertStrings() : convertAll();
    return ok ? common : types::kError;
  }

  bool joinTyped() {
    for (const ExprId operand : operands) {
      const TypeId own = type(operand);
      if (!own || own == types::kError) return false;
      if (isUntyped(context, own)) {
        untyped = true;
        real |= own == types::idOf(TypeKind::RealLiteral);
        continue;
      }
      if (!accepts(own)) {
        reportRefused(operand, own);
        return false;
      }
      if (common && areOtherEnums(context, accepted, common, own)) {
        context.report(diag::EnumsCompared, loc,
                       {what, context.types().toString(common), context.types().toString(own)});
        common = commonNumber(context, common, own);
        mixed_enums = true;
        continue;
      }
      const TypeId joined = common ? join(context, common, own) : own;
      if (!joined) return fail(common, own);
      common = joined;
    }
    return true;
  }

  void reportRefused(ExprId operand, TypeId own) const {
    const Loc at = operands.size() == 2 ? loc : context.tree().loc(operand);
    if (common && accepted == Operands::Bits)
      reportOperands(context, what, common, own, at);
    else
      reportOperand(context, what, own, at);
  }

  // CODESYS takes a whole number as a pointer: SEL(is_valid, 0, pointer).
  bool isAddress(ExprId literal) const {
    return context.profile().pointers_as_numbers && context.types().kind(common) == TypeKind::Pointer &&
           type(literal) == types::idOf(TypeKind::IntegerLiteral);
  }

  // Literals beside typed operands.
  bool joinLiterals() {
    const TypeId typed = common;
    for (const ExprId operand : operands) {
      const TypeId own = type(operand);
      if (!isUntyped(context, own)) continue;
      if (accepted == Operands::Anything && (isAddress(operand) || untypedFits(context, operand, common))) continue;
      const TypeId joined = joinUntyped(context, common, operand, expected);
      if (!joined) return fail(typed, own);
      common = joined;
    }
    return accepts(common) || fail(typed, common);
  }

  // Nothing but literals: the expected type if all fit, else that of the widest.
  bool chooseForLiterals() {
    bool fits = static_cast<bool>(expected) && !isUntyped(context, expected) && accepts(expected);
    for (const ExprId operand : operands) fits = fits && untypedFits(context, operand, expected);
    if (fits) {
      common = context.types().plain(expected);
    } else if (real) {
      common = types::kReal;
    } else {
      for (const ExprId operand : operands) {
        const TypeId own = defaultType(context, operand);
        common = common ? commonNumber(context, common, own) : own;
      }
    }
    if (accepts(common)) return true;
    reportOperand(context, what, common, loc);
    return false;
  }

  // Strings keep their lengths.
  bool convertStrings() const {
    const TypeKind kind = context.types().plainKind(common);
    for (ExprId& operand : operands) {
      const types::TypeInfo& own = context.types().info(context.types().resolve(type(operand)));
      if (own.kind != kind) wrapConvert(context, operand, context.types().string(kind, own.length));
    }
    return true;
  }

  bool convertAll() const {
    for (ExprId& operand : operands) {
      if (mixed_enums && context.types().kind(type(operand)) == TypeKind::Enum) {
        wrapConvert(context, operand, common);
        continue;
      }
      const ExprId given = operand;
      if (!convert(context, operand, common, kOperand)) return false;
      if (operand != given && context.tree().kind(operand) == ExprKind::Convert)
        context.meaning(operand).is_intermediate = true;
    }
    return true;
  }
};

}  // namespace

TypeId unify(Context& context, std::span<ExprId> operands, Operands accepted, TypeId expected, std::string_view what,
             Loc loc) {
  if (keepsOwnType(accepted)) typeCharacters(context, operands);
  if (context.profile().addresses_as_numbers && (accepted == Operands::Number || accepted == Operands::NumberOrTime))
    typeAddresses(context, operands);
  Unification unification{.context = context,
                          .operands = operands,
                          .accepted = accepted,
                          .expected = expected,
                          .what = what,
                          .loc = loc,
                          .common = {}};
  return unification.run();
}

// x ** n: the base becomes REAL or LREAL; the exponent keeps its type.
TypeId power(Context& context, ExprId& base_expr, ExprId& exponent_expr, TypeId expected, Loc loc) {
  for (ExprId* side : {&base_expr, &exponent_expr}) {
    const TypeId type = context.type(*side);
    if (isUntyped(context, type)) continue;
    const TypeKind kind = context.types().plainKind(type);
    if (!TypeTable::isNumber(kind) || !accepts(context, Operands::Number, type)) {
      return reportOperand(context, "**", type, loc);
    }
  }
  TypeId base = context.type(base_expr);
  if (!TypeTable::isReal(context.types().plainKind(base))) {
    const TypeId exponent = context.type(exponent_expr);
    const TypeKind wanted = expected ? context.types().plainKind(expected) : TypeKind::None;
    TypeId real = types::kReal;
    if (TypeTable::isReal(wanted)) {
      real = types::idOf(wanted);
    } else if (!isUntyped(context, exponent) && context.types().plainKind(exponent) == TypeKind::LReal) {
      real = types::kLReal;
    } else if (!isUntyped(context, base) && !types::isLossless(context.types(), context.types().plain(base), real)) {
      real = types::kLReal;
    }
    if (!convert(context, base_expr, real, kOperand)) return types::kError;
    base = real;
  } else {
    base = context.types().plain(base);
  }
  if (context.type(exponent_expr) == types::idOf(TypeKind::RealLiteral)) {
    if (!adapt(context, exponent_expr, base, kOperand)) return types::kError;
  } else if (finalizeUntyped(context, exponent_expr) == types::kError) {
    return types::kError;
  }
  const TypeId exponent = context.types().plain(context.type(exponent_expr));
  if (TypeTable::isReal(context.types().info(exponent).kind) && exponent != base) {
    if (base == types::kReal) {
      wrapConvert(context, base_expr, types::kLReal);
      base = types::kLReal;
    } else {
      wrapConvert(context, exponent_expr, types::kLReal);
    }
  } else if (exponent != context.type(exponent_expr)) {
    wrapConvert(context, exponent_expr, exponent);
  }
  return base;
}

namespace {

// Pointers and times have rules of their own. None: the operands are neither.
TypeId combineSpecial(Context& context, ExprId& self, TypeId expected) {
  const BinaryExpr& node = context.tree().as<BinaryExpr>(self);
  const BinaryOp op = node.op();
  const TypeId left = context.type(node.left), right = context.type(node.right);
  if (context.types().kind(left) == TypeKind::Pointer || context.types().kind(right) == TypeKind::Pointer) {
    if (const TypeId type = combinePointers(context, self, expected)) return type;
  }
  if (isComparison(op) || operandsOf(op) == Operands::Bits) return {};
  const auto isTime = [&](TypeId type) {
    return !isUntyped(context, type) && isTimeKind(context.types().plainKind(type));
  };
  if (!isTime(left) && !isTime(right)) return {};
  const Loc loc = node.h.loc;
  if (const TypeId type = combineTimes(context, self, op, node.left, node.right)) return type;
  return reportOperands(context, spelling(op), left, right, loc);
}

// What an operator forbids of the common type of its operands.
TypeId checkCommon(Context& context, BinaryExpr& node, TypeId common) {
  const BinaryOp op = node.op();
  const TypeKind kind = context.types().plainKind(common);
  if ((op == BinaryOp::AndThen || op == BinaryOp::OrElse) && kind != TypeKind::Bool)
    return reportOperand(context, spelling(op), common, node.h.loc);
  if (op == BinaryOp::Modulo && TypeTable::isReal(kind)) return reportOperand(context, "MOD", common, node.h.loc);
  if (op == BinaryOp::Divide || op == BinaryOp::Modulo) {
    if (!checkDivisor(context, node.right, op)) return types::kError;
    callDivisorCheck(context, node.right);
  }
  return common;
}

// CONCAT(a, b) for `a + b`.
Fix concatenation(const Context& context, const BinaryExpr& node) {
  const Range left = sourceRange(context, node.left), right = sourceRange(context, node.right);
  if (!(left.begin < left.end) || !(right.begin < right.end)) return {};
  const std::string first = sourceText(context, left), second = sourceText(context, right);
  return {"Write `CONCAT(...)`", {{left.begin, right.end, "CONCAT(" + first + ", " + second + ")"}}, true};
}

}  // namespace

TypeId combine(Context& context, ExprId& self, TypeId expected) {
  BinaryExpr& node = context.code().as<BinaryExpr>(self);
  Meaning& known = meaning(node.h);
  const TypeId left = context.type(node.left), right = context.type(node.right);
  if (!left || !right || left == types::kError || right == types::kError) {
    if (right == types::kError && left && !isUntyped(context, left)) declareUnknown(context, node.right, left);
    if (left == types::kError && right && !isUntyped(context, right)) declareUnknown(context, node.left, right);
    return known.type = types::kError;
  }
  const BinaryOp op = node.op();
  const bool comparison = isComparison(op);
  known.is_constant = context.meaning(node.left).is_constant & context.meaning(node.right).is_constant;
  if (isUntyped(context, left) && isUntyped(context, right)) {
    if (const TypeId type = combineUntyped(context, node)) return known.type = type;
  }
  if (op == BinaryOp::Power) return known.type = power(context, node.left, node.right, expected, node.h.loc);
  if (const TypeId type = combineSpecial(context, self, expected)) return context.type(self) = type;
  if (op == BinaryOp::Add && TypeTable::isString(context.types().plainKind(left)) &&
      TypeTable::isString(context.types().plainKind(right))) {
    context.report(diag::StringsAdded, node.h.loc).fix(concatenation(context, node));
    return known.type = types::kError;
  }
  ExprId operands[2] = {node.left, node.right};
  TypeId common = unify(context, operands, operandsOf(op), comparison ? TypeId{} : expected, spelling(op), node.h.loc);
  node.left = operands[0];
  node.right = operands[1];
  if (common == types::kError) return known.type = types::kError;
  if (comparison) {
    common = types::kBool;
  } else {
    if (checkCommon(context, node, common) == types::kError) return known.type = types::kError;
    markIntermediate(context.symbols, self, common, context.isWide() && operandsOf(op) != Operands::Bits);
  }
  known.type = common;
  context.rules->expression(context, self);
  return common;
}

TypeId checkBinary(Context& context, ExprId& expr, TypeId expected) {
  BinaryExpr& node = context.code().as<BinaryExpr>(expr);
  const bool comparison = isComparison(node.op());
  const TypeId hint = comparison ? TypeId{} : expected;
  if (isOpenTemporary(context, node.left)) {  // the literals in it adapt to the other side
    const TypeId other = check(context, node.right, hint, Access::Read);
    check(context, node.left, isUntyped(context, other) ? hint : other, Access::Read);
    return combine(context, expr, expected);
  }
  const TypeId left = check(context, node.left, hint, Access::Read);
  // The other side of a comparison decides which enumeration a bare item belongs to, and the size of T# literals.
  const TypeId right = check(context, node.right, comparison && !isUntyped(context, left) ? left : hint, Access::Read);
  if (comparison && left != right && left != types::kError && right != types::kError) {
    const Entity entity = entityOf(context, node.left);
    const bool item = entity.entityKind() == EntityKind::EnumValue && context.types().kind(right) == TypeKind::Enum;
    if (item && context.tree().kind(node.left) == ExprKind::Name) check(context, node.left, right, Access::Read);
  }
  return combine(context, expr, expected);
}

TypeId checkUnary(Context& context, ExprId& expr, TypeId expected) {
  UnaryExpr& node = context.code().as<UnaryExpr>(expr);
  Meaning& known = meaning(node.h);
  const TypeId type = check(context, node.operand, expected, Access::Read);
  known.is_constant = context.meaning(node.operand).is_constant;
  if (!type || type == types::kError) return known.type = types::kError;
  if (isUntyped(context, type)) {
    if (node.op() == UnaryOp::Not) {
      if (type == types::idOf(TypeKind::RealLiteral)) {
        return known.type = reportOperand(context, "NOT", types::kReal, node.h.loc);
      }
      if (expected && context.types().plainKind(expected) == TypeKind::Bool &&
          untypedFits(context, node.operand, expected)) {
        adapt(context, node.operand, types::kBool, kOperand);
        return known.type = types::kBool;
      }
    }
    return known.type = type;
  }
  const TypeId plain = context.types().plain(type);
  const bool ok = node.op() == UnaryOp::Not ? accepts(context, Operands::Bits, type)
                                            : accepts(context, Operands::NumberOrTime, type);
  if (!ok) return known.type = reportOperand(context, spelling(node.op()), type, node.h.loc);
  if (plain != type) convert(context, node.operand, plain, kOperand);
  markIntermediate(context.symbols, expr, plain, context.isWide() && node.op() != UnaryOp::Not);
  return known.type = plain;
}

}  // namespace rung::sema

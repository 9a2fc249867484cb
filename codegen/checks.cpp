// SPDX-License-Identifier: Apache-2.0
// Checks in front of a statement, in the order in which its expressions are evaluated (ir.h): each is a compare and a
// branch to the body's fault block. A check is numbered by its row among the group's sites, so a change of one POU
// renumbers nothing in other groups.
#include "codegen/body_parts.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::Fault;
using types::TypeInfo;
using types::TypeTable;

uint32_t CheckWriter::addSite(Loc loc, int64_t low, int64_t high) {
  Site created;
  created.pou = body_->spelling ? body_->spelling : body_->name;
  created.low = low;
  created.high = high;
  if (body_->origin.path) {
    created.origin_path = body_->origin.path;
    created.line = body_->origin.line;
  } else {
    const SourceLocation location = module_.sources.location(loc ? loc : body_->loc);
    created.file = location.file;
    created.line = location.line;
    created.column = location.column;
  }
  group_.sites.push_back(created);
  return static_cast<uint32_t>(group_.sites.size() - 1);
}

uint32_t CheckWriter::site(Loc loc, Fault fault, int64_t low, int64_t high) {
  state_.uses_fault = true;
  return addSite(loc, low, high) << 4 | static_cast<uint32_t>(fault);
}

void CheckWriter::check(Ex is_wrong, Loc loc, Fault fault, Ex value, int64_t low, int64_t high) {
  const Ex number = tree_.number(site(loc, fault, low, high), "u");
  add(tree_.stmt(cxx::StmtKind::Macro, tree_.call("RUNG_CHECK", {is_wrong, number, value})));
}

bool CheckWriter::needsPreparation(ExprId id) const {
  const Expr& e = expr(id);
  if (e.checks != 0) return true;
  if (isString(e.type) && (e.kind == ExprKind::Convert || e.kind == ExprKind::Call)) return true;
  bool needs = e.kind == ExprKind::Zero && isAggregate(e.type);
  ir::forEachOperand(*body_, e, [&](ExprId operand) { needs = needs || needsPreparation(operand); });
  return needs;
}

void CheckWriter::prepareChildren(const Expr& e) {
  ir::forEachOperand(*body_, e, [&](ExprId operand) { prepare(operand); });
}

void CheckWriter::prepare(ExprId id) {
  const Expr& e = expr(id);
  if (e.kind == ExprKind::Index) {
    prepareElement(e);
  } else {
    prepareChildren(e);
    if (e.checks != 0) checkNode(id, e);
  }
  if (isString(e.type) && (e.kind == ExprKind::Convert || e.kind == ExprKind::Call)) {
    strings().materializeString(id);
  } else if (e.kind == ExprKind::Zero && isAggregate(e.type)) {
    const Ex name = newVariable(e.type, "z");
    clear(name);
    state_.materialized.push_back({id.index, name});
  }
}

void CheckWriter::checkNode(ExprId id, const Expr& e) {
  if ((e.checks & (ir::kCheckNull | ir::kCheckCast)) != 0) nullCheck(e);
  if ((e.checks & ir::kCheckDiv) != 0) divisionCheck(e);
  const auto* convert = e.tryAs<ir::ConvertExpr>();
  if (convert == nullptr) {
    if ((e.checks & ir::kCheckOverflow) != 0) overflowCheck(id);
    return;
  }
  const TypeKind target = types_.plainKind(e.type);
  if (isString(expr(convert->operand).type) || TypeTable::isString(target)) return;
  const bool is_integer = !TypeTable::isReal(target) && widthOf(target) > 0;
  if ((e.checks & ir::kCheckConvert) != 0 && is_integer && target != TypeKind::Bool) convertCheck(e);
  const bool is_subrange = types_.info(types_.resolve(e.type)).kind == TypeKind::Subrange;
  if ((e.checks & ir::kCheckSubrange) != 0 && is_subrange) subrangeCheck(e);
}

void CheckWriter::nullCheck(const Expr& e) {
  Ex pointer;
  if (const auto* deref = e.tryAs<ir::DerefExpr>()) {
    pointer = values().value(deref->pointer);
  } else {
    const ir::FieldExpr& field = e.as<ir::FieldExpr>();
    pointer = places().member(field.base, fieldOf(field).name);
  }
  check(tree_.infix(Operator::Equal, pointer, tree_.fixed("nullptr")), e.loc,
        (e.checks & ir::kCheckNull) != 0 ? Fault::Null : Fault::Cast, tree_.number(0));
}

// Of a power: 0 to a negative exponent.
void CheckWriter::divisionCheck(const Expr& e) {
  const auto [left, right, op] = e.as<ir::BinaryExpr>();
  const bool is_power = op == Op::Power;
  if (is_power && !types_.isSigned(kindOf(right))) return;
  const Ex zero = tree_.number(0);
  Ex is_wrong = tree_.infix(Operator::Equal, values().value(is_power ? left : right), zero);
  if (is_power) {
    const Ex is_negative = tree_.infix(Operator::Less, values().value(right), zero);
    is_wrong = tree_.infix(Operator::And, is_wrong, is_negative);
  }
  check(is_wrong, e.loc, Fault::Div, zero);
}

void CheckWriter::convertCheck(const Expr& e) {
  const ir::ConvertExpr& node = e.as<ir::ConvertExpr>();
  const TypeKind source = kindOf(node.operand), target = types_.plainKind(e.type);
  const uint32_t width = widthOf(target);
  const bool is_signed = types_.isSigned(target);
  const bool is_away = node.rounding == types::Rounding::AwayFromZero;
  const Ex number = values().value(node.operand);
  if (TypeTable::isReal(source)) {
    std::string low = is_signed ? "-" : "0", high;
    if (is_signed) appendUnsigned(low, uint64_t{1} << (width - 1));
    appendUnsigned(high, (is_signed ? uint64_t{1} << (width - 1) : width == 64 ? 0 : uint64_t{1} << width) - 1);
    const Ex is_wrong = tree_.call(is_away ? "rung_whole_wraps" : "rung_round_saturates",
                                   {number, tree_.name(low + ".0"), tree_.name(high + ".0")});
    // The nearest whole number: casting NaN or a value that does not fit is undefined.
    const Ex whole = tree_.call(is_away ? "rung_whole_i64" : "rung_round_i64", {number});
    return check(is_wrong, e.loc, Fault::Convert, whole);
  }
  // Cut and extended again it must be the same number, with the same sign.
  const bool from_signed = types_.isSigned(source);
  const char* const widest = from_signed ? "int64_t" : "uint64_t";
  const Ex cut = tree_.cast(scalarType(types_, e.type), number);
  Ex is_wrong = tree_.infix(Operator::Differs, tree_.cast(widest, number), tree_.cast(widest, cut));
  if (from_signed != is_signed) {
    const Ex sign = tree_.cast("int64_t", from_signed ? number : cut);
    is_wrong = tree_.infix(Operator::Or, is_wrong, tree_.infix(Operator::Less, sign, tree_.number(0)));
  }
  check(is_wrong, e.loc, Fault::Convert, tree_.group(number));
}

void CheckWriter::subrangeCheck(const Expr& e) {
  const ir::ConvertExpr& node = e.as<ir::ConvertExpr>();
  const TypeInfo& info = types_.info(types_.resolve(e.type));
  const TypeKind source = kindOf(node.operand);
  const bool from_real = TypeTable::isReal(source), from_signed = from_real || types_.isSigned(source);
  Ex number = values().value(node.operand);
  if (from_real) {
    const bool is_away = node.rounding == types::Rounding::AwayFromZero;
    number = tree_.call(is_away ? "rung_whole_i64" : "rung_round_i64", {number});
  }
  // A limit outside of the source's type needs no test.
  const Ex high = constantOf(from_signed ? types::kLInt : types::kULInt, static_cast<uint64_t>(info.high));
  Ex is_wrong = tree_.infix(Operator::Greater, number, high);
  if (from_signed || info.low > 0) {
    const TypeId limits = from_signed ? types::kLInt : expr(node.operand).type;
    const Ex low = constantOf(limits, static_cast<uint64_t>(info.low));
    is_wrong = tree_.infix(Operator::Or, tree_.infix(Operator::Less, number, low), is_wrong);
  }
  check(is_wrong, e.loc, Fault::Subrange, tree_.group(number), info.low, info.high);
}

// Each index is checked before the next one is evaluated, as in the interpreter.
void CheckWriter::prepareElement(const Expr& e) {
  const ir::IndexExpr& node = e.as<ir::IndexExpr>();
  const TypeInfo& array = types_.info(types_.resolve(expr(node.base).type));
  prepare(node.base);
  for (uint32_t i = 0; i < node.indices.count; ++i) {
    const ExprId index = body_->list(node.indices)[i];
    prepare(index);
    if ((e.checks & ir::kCheckIndex) != 0 && i < array.dimensions.size() && !e.isProven(i))
      indexCheck(e.loc, index, array.dimensions[i]);
  }
}

void CheckWriter::indexCheck(Loc loc, ExprId id, const types::Dimension& dimension) {
  if (expr(id).kind == ExprKind::Const) {
    const auto index = static_cast<int64_t>(ir::bitsOf(expr(id)));
    if (index >= dimension.low && index <= dimension.high) return;
  }
  const bool narrow = widthOf(kindOf(id)) <= 16 && dimension.count() <= UINT32_MAX;
  const Ex offset = tree_.cast(narrow ? "uint32_t" : "uint64_t", tree_.group(places().indexValue(id, dimension)));
  const Ex is_wrong =
      tree_.infix(Operator::GreaterEqual, offset, tree_.number(dimension.count(), narrow ? "u" : "ULL"));
  const Ex value = tree_.group(values().value(id));
  check(is_wrong, loc, Fault::Index, value, dimension.low, dimension.high);
}

void CheckWriter::overflowCheck(ExprId id) {
  const Expr& e = expr(id);
  const bool is_unary = e.kind == ExprKind::Unary;
  const ExprId a = is_unary ? e.as<ir::UnaryExpr>().operand : e.as<ir::BinaryExpr>().left;
  const ExprId b = is_unary ? ExprId{} : e.as<ir::BinaryExpr>().right;
  const Op op = e.op();
  const TypeKind kind = kindOf(a);
  if (TypeTable::isReal(kind)) return realOverflowCheck(id, a, b);
  const uint32_t width = widthOf(kind);
  if (width <= 1) return;
  if (op == Op::Add || op == Op::Sub || op == Op::Mul || op == Op::Neg) {
    const std::string type = scalarType(types_, e.type);
    const Ex result = tree_.name(newName("o"));
    declare(type, result->text);
    const Ex left = tree_.cast(type, op == Op::Neg ? tree_.number(0) : values().value(a));
    const Ex right = tree_.cast(type, values().value(op == Op::Neg ? a : b));
    const char* const function = op == Op::Add   ? "__builtin_add_overflow"
                                 : op == Op::Mul ? "__builtin_mul_overflow"
                                                 : "__builtin_sub_overflow";
    return check(tree_.call(function, {left, right, addressOf(result)}), e.loc, Fault::Overflow, result);
  }
  if ((op != Op::Div && op != Op::Abs) || !types_.isSigned(kind)) return;
  const Ex number = values().value(a);
  Ex is_wrong = tree_.infix(Operator::Equal, number, constantOf(e.type, ~uint64_t{0} << (width - 1)));
  if (op == Op::Div) {
    const Ex is_minus_one = tree_.infix(Operator::Equal, values().value(b), tree_.signedNumber(-1));
    is_wrong = tree_.infix(Operator::And, is_wrong, is_minus_one);
  }
  check(is_wrong, e.loc, Fault::Overflow, tree_.group(number));
}

// Infinity that no operand has.
void CheckWriter::realOverflowCheck(ExprId id, ExprId a, ExprId b) {
  const Expr& e = expr(id);
  if (types::isComparison(e.op())) return;
  const Ex result = tree_.call("__builtin_isinf", {values().value(id)});
  const auto isFinite = [&](ExprId operand) { return tree_.call("__builtin_isfinite", {values().value(operand)}); };
  Ex is_wrong = tree_.infix(Operator::And, result, isFinite(a));
  if (b && TypeTable::isReal(kindOf(b))) is_wrong = tree_.infix(Operator::And, is_wrong, isFinite(b));
  check(is_wrong, e.loc, Fault::Overflow, tree_.number(0));
}

}  // namespace rung::codegen

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

void CheckWriter::endCheck(Loc loc, Fault fault, std::string_view value, int64_t low, int64_t high) {
  out_ += ", ";
  appendUnsigned(out_, site(loc, fault, low, high));
  out_ += "u, ";
  out_ += value;
  out_ += ") ";
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
    const std::string name = newVariable(e.type, "z");
    out_ += "memset(&" + name + ", 0, sizeof " + name + "); ";
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
  beginCheck();
  if (const auto* deref = e.tryAs<ir::DerefExpr>()) {
    values().value(deref->pointer, Prec::Sum);
  } else {
    const ir::FieldExpr& field = e.as<ir::FieldExpr>();
    places().member(field.base);
    appendMangled(out_, string(fieldOf(field).name));
  }
  out_ += " == nullptr";
  endCheck(e.loc, (e.checks & ir::kCheckNull) != 0 ? Fault::Null : Fault::Cast, "0");
}

// Of a power: 0 to a negative exponent.
void CheckWriter::divisionCheck(const Expr& e) {
  const auto [left, right, op] = e.as<ir::BinaryExpr>();
  const bool is_power = op == Op::Power;
  if (is_power && !types_.isSigned(kindOf(right))) return;
  beginCheck();
  values().value(is_power ? left : right, Prec::Sum);
  out_ += " == 0";
  if (is_power) {
    out_ += " && ";
    values().value(right, Prec::Sum);
    out_ += " < 0";
  }
  endCheck(e.loc, Fault::Div, "0");
}

void CheckWriter::convertCheck(const Expr& e) {
  const ExprId from = e.as<ir::ConvertExpr>().operand;
  const TypeKind source = kindOf(from), target = types_.plainKind(e.type);
  const uint32_t width = widthOf(target);
  const bool from_real = TypeTable::isReal(source), is_signed = types_.isSigned(target);
  const bool is_away = e.as<ir::ConvertExpr>().rounding == types::Rounding::AwayFromZero;
  beginCheck();
  if (from_real) {
    out_ += is_away ? "rung_whole_wraps(" : "rung_round_saturates(";
    values().value(from, Prec::Ternary);
    std::string low = is_signed ? "-" : "0", high;
    if (is_signed) appendUnsigned(low, uint64_t{1} << (width - 1));
    appendUnsigned(high, (is_signed ? uint64_t{1} << (width - 1) : width == 64 ? 0 : uint64_t{1} << width) - 1);
    out_ += ", " + low + ".0, " + high + ".0)";
  } else {
    // Cut and extended again it must be the same number, with the same sign.
    const std::string number = captured([&] { values().value(from, Prec::Unary); });
    const char* type = scalarType(types_, e.type);
    const bool from_signed = types_.isSigned(source);
    out_ += from_signed ? "(int64_t)" : "(uint64_t)";
    out_ += number + " != " + (from_signed ? "(int64_t)(" : "(uint64_t)(") + type + ')' + number;
    if (from_signed && !is_signed) {
      out_ += " || (int64_t)" + number + " < 0";
    } else if (!from_signed && is_signed) {
      out_ += " || (int64_t)(";
      out_ += type;
      out_ += ')' + number + " < 0";
    }
  }
  // For REAL the nearest whole number: casting NaN or a value that does not fit is undefined.
  const std::string number = captured([&] { values().value(from, Prec::Ternary); });
  endCheck(e.loc, Fault::Convert, (is_away ? "rung_whole_i64(" : from_real ? "rung_round_i64(" : "(") + number + ")");
}

void CheckWriter::subrangeCheck(const Expr& e) {
  const ExprId from = e.as<ir::ConvertExpr>().operand;
  const TypeInfo& info = types_.info(types_.resolve(e.type));
  const TypeKind source = kindOf(from);
  const bool from_real = TypeTable::isReal(source);
  beginCheck();
  const std::string number = captured([&] {
    if (from_real) {
      const bool is_away = e.as<ir::ConvertExpr>().rounding == types::Rounding::AwayFromZero;
      out_ += is_away ? "rung_whole_i64(" : "rung_round_i64(";
      values().value(from, Prec::Ternary);
      out_ += ')';
    } else {
      values().value(from, Prec::Sum);
    }
  });
  const TypeId limits = from_real ? types::kLInt : expr(from).type;
  const bool from_signed = from_real || types_.isSigned(source);
  // A limit outside of the source's type needs no test.
  if (from_signed || info.low > 0) {
    out_ += number + " < ";
    appendConstant(out_, types_, from_signed ? types::kLInt : limits, static_cast<uint64_t>(info.low));
    out_ += " || ";
  }
  out_ += number + " > ";
  appendConstant(out_, types_, from_signed ? types::kLInt : types::kULInt, static_cast<uint64_t>(info.high));
  endCheck(e.loc, Fault::Subrange, "(" + number + ")", info.low, info.high);
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
  beginCheck();
  out_ += narrow ? "(uint32_t)(" : "(uint64_t)(";
  places().indexValue(id, dimension);
  out_ += ") >= ";
  appendUnsigned(out_, dimension.count());
  out_ += narrow ? "u" : "ULL";
  endCheck(loc, Fault::Index, "(" + captured([&] { values().value(id, Prec::Comma); }) + ")", dimension.low,
           dimension.high);
}

void CheckWriter::overflowCheck(ExprId id) {
  const Expr& e = expr(id);
  const bool is_unary = e.kind == ExprKind::Unary;
  const Op op = e.op();
  const ExprId a = is_unary ? e.as<ir::UnaryExpr>().operand : e.as<ir::BinaryExpr>().left;
  const ExprId b = is_unary ? ExprId{} : e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  if (TypeTable::isReal(kind)) {
    if (types::isComparison(op)) return;
    beginCheck();
    out_ += "__builtin_isinf(";
    values().value(id, Prec::Ternary);
    out_ += ") && __builtin_isfinite(";
    values().value(a, Prec::Ternary);
    out_ += ')';
    if (b && TypeTable::isReal(kindOf(b))) {
      out_ += " && __builtin_isfinite(";
      values().value(b, Prec::Ternary);
      out_ += ')';
    }
    endCheck(e.loc, Fault::Overflow, "0");
    return;
  }
  if (width <= 1) return;
  const std::string type = scalarType(types_, e.type);
  if (op == Op::Add || op == Op::Sub || op == Op::Mul || op == Op::Neg) {
    const std::string result = newName("o");
    declarations_ += " " + type + " " + result + ";";
    beginCheck();
    out_ += op == Op::Add   ? "__builtin_add_overflow("
            : op == Op::Mul ? "__builtin_mul_overflow("
                            : "__builtin_sub_overflow(";
    out_ += '(' + type + ')';
    if (op == Op::Neg) {
      out_ += '0';
    } else {
      values().value(a, Prec::Unary);
    }
    out_ += ", (" + type + ')';
    values().value(op == Op::Neg ? a : b, Prec::Unary);
    out_ += ", &" + result + ')';
    endCheck(e.loc, Fault::Overflow, result);
  } else if ((op == Op::Div || op == Op::Abs) && is_signed) {
    beginCheck();
    values().value(a, Prec::Sum);
    out_ += " == ";
    appendConstant(out_, types_, e.type, ~uint64_t{0} << (width - 1));
    if (op == Op::Div) {
      out_ += " && ";
      values().value(b, Prec::Sum);
      out_ += " == -1";
    }
    endCheck(e.loc, Fault::Overflow, "(" + captured([&] { values().value(a, Prec::Comma); }) + ")");
  }
}

}  // namespace rung::codegen

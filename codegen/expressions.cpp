// SPDX-License-Identifier: Apache-2.0
// Expressions in C++: values, conditions, operators and calls of functions. In: an expression that needs no more
// checks. Out: its C++ (cxx/nodes.h). Called by the writers of statements, places and checks. Integers are computed in
// arithmetic.cpp, conversions made in conversions.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::ValueKind;
using types::TypeTable;

// ---- values

cxx::Ex ExpressionWriter::value(ExprId id) {
  const Expr& e = expr(id);
  if (ir::isPlace(e.kind)) return load(id);
  switch (ir::valueKind(e.kind)) {
    case ValueKind::None: return tree_.number(0);
    case ValueKind::Const: return constant(e);
    case ValueKind::Zero: return isString(e.type) ? strings().stringValue(id) : constantOf(e.type, 0);
    case ValueKind::String: return strings().stringValue(id);
    case ValueKind::Data: return places().place(id);
    case ValueKind::Unary: return unary(id);
    case ValueKind::Binary: return binary(id);
    case ValueKind::Convert: return convert(id);
    case ValueKind::Select: {
      if (isString(e.type)) return strings().stringValue(id);
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      const Ex test = condition(decides), first = value(yes), second = value(no);
      return tree_.choice(test, first, second);
    }
    case ValueKind::Call: return calls().callExpr(e);
    case ValueKind::Address: {
      const ExprId target = e.as<ir::AddressExpr>().place;
      const Ex place = places().place(target);
      return tree_.cast("void*", isString(expr(target).type) ? place : addressOf(place));
    }
  }
  return nullptr;
}

// The value of a place.
cxx::Ex ExpressionWriter::load(ExprId id) {
  const Expr& e = expr(id);
  if (isString(e.type)) return strings().stringValue(id);
  if (const auto* bits = e.tryAs<ir::BitsExpr>()) return loadBits(*bits, types_.plainKind(e.type));
  if (!places().isLvalue(id)) return places().imageLoad(id, e);
  const TypeKind kind = types_.plainKind(e.type);
  const Ex place = places().place(id);
  if (kind == TypeKind::Bool && !places().isVariableTruth(id))
    return tree_.infix(Operator::Differs, place, tree_.number(0));
  return wideOf(id) == 64 ? tree_.cast(types_.isSigned(kind) ? "int32_t" : "uint32_t", place) : place;
}

cxx::Ex ExpressionWriter::loadBits(const ir::BitsExpr& node, TypeKind kind) {
  const TypeKind whole = kindOf(node.base);
  const uint32_t width = widthOf(kind), shift = node.position * width;
  Ex bits = value(node.base);
  if (types_.isSigned(whole)) bits = tree_.cast(unsignedType(widthOf(whole)), bits);
  if (shift != 0) bits = tree_.infix(Operator::ShiftRight, bits, tree_.number(shift));
  if (kind == TypeKind::Bool) return tree_.group(tree_.infix(Operator::Mask, bits, tree_.number(1)));
  return tree_.cast(unsignedType(std::min(width, 32u)), tree_.group(bits));
}

const char* ExpressionWriter::unsignedType(uint32_t width) {
  return width == 8 ? "uint8_t" : width == 16 ? "uint16_t" : width == 32 ? "uint32_t" : "uint64_t";
}

// A BOOL where C++ expects a condition: memory is compared with != 0 anyway.
cxx::Ex ExpressionWriter::condition(ExprId id) {
  const Expr& e = expr(id);
  if (ir::isPlace(e.kind) && places().isLvalue(id)) return places().place(id);
  if (e.kind == ExprKind::Binary && isContacts(id)) return bitAt(id, positionOf(id));
  return value(id);
}

cxx::Ex ExpressionWriter::constant(const Expr& e) {
  const TypeId record = e.as<ir::ConstExpr>().number_of;
  if (!record) return constantOf(e.type, ir::bitsOf(e));
  if (std::find(group_.classes.begin(), group_.classes.end(), record) == group_.classes.end())
    group_.classes.push_back(record);
  return tree_.name(className(types_, record));
}

cxx::Ex ExpressionWriter::scalarBits(ExprId id) {
  const TypeKind kind = kindOf(id);
  const Ex number = value(id);
  if (TypeTable::isReal(kind)) return tree_.call("rung_bits_of_f64", {number});
  if (isPointer(kind)) return tree_.cast("uint64_t", tree_.cast("uintptr_t", number));
  return tree_.cast("uint64_t", types_.isSigned(kind) ? tree_.cast("int64_t", number) : number);
}

// ---- operators

cxx::Ex ExpressionWriter::unary(ExprId id) {
  const auto [a, op] = expr(id).as<ir::UnaryExpr>();
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  if (op == Op::Not) {
    if (kind == TypeKind::Bool) return tree_.prefix("!", condition(a));
    const Ex complement = tree_.prefix("~", value(a));
    return !is_signed && width < 32 ? tree_.cast(unsignedType(width), complement) : complement;
  }
  if (TypeTable::isReal(kind)) {
    if (op != Op::Abs) return tree_.prefix("-", value(a));
    return tree_.call(kind == TypeKind::Real ? "__builtin_fabsf" : "__builtin_fabs", {value(a)});
  }
  if (op == Op::Neg) return arithmetic(id);
  if (!is_signed) return value(a);
  const Ex absolute = tree_.call(width == 64 ? "rung_abs_i64" : "rung_abs_i32", {value(a)});
  return width < 32 ? tree_.cast(width == 8 ? "int8_t" : "int16_t", absolute) : absolute;
}

cxx::Ex ExpressionWriter::binary(ExprId id) {
  const ir::BinaryExpr& node = expr(id).as<ir::BinaryExpr>();
  const TypeKind kind = kindOf(node.left);
  const bool is_real = TypeTable::isReal(kind);
  switch (node.op) {
    case Op::Eq: return comparison(Operator::Equal, node);
    case Op::Ne: return comparison(Operator::Differs, node);
    case Op::Lt: return comparison(Operator::Less, node);
    case Op::Le: return comparison(Operator::LessEqual, node);
    case Op::Gt: return comparison(Operator::Greater, node);
    case Op::Ge: return comparison(Operator::GreaterEqual, node);
    case Op::Add: return is_real ? both(Operator::Add, node) : arithmetic(id);
    case Op::Sub: return is_real ? both(Operator::Subtract, node) : arithmetic(id);
    case Op::Mul: return is_real ? both(Operator::Multiply, node) : arithmetic(id);
    case Op::Div: return is_real ? both(Operator::Divide, node) : divide(node);
    case Op::Mod:
      return is_real ? function(kind == TypeKind::Real ? "__builtin_fmodf" : "__builtin_fmod", node) : divide(node);
    case Op::Power: return power(expr(id));
    case Op::And: return kind == TypeKind::Bool ? logical(id) : both(Operator::BitAnd, node);
    case Op::Or: return kind == TypeKind::Bool ? logical(id) : both(Operator::BitOr, node);
    case Op::Xor: return both(kind == TypeKind::Bool ? Operator::Differs : Operator::BitXor, node);
    case Op::Shl:
    case Op::Shr:
    case Op::Sar:
    case Op::Rol:
    case Op::Ror: return shift(expr(id));
    case Op::Min:
    case Op::Max: return TypeTable::isString(kind) ? strings().stringValue(id) : extreme(node);
    case Op::Neg:
    case Op::Not:
    case Op::Abs: break;
  }
  return nullptr;
}

cxx::Ex ExpressionWriter::both(Operator op, const ir::BinaryExpr& node) {
  const Ex left = value(node.left), right = value(node.right);
  return tree_.infix(op, left, right);
}

cxx::Ex ExpressionWriter::function(std::string_view name, const ir::BinaryExpr& node) {
  const Ex left = value(node.left), right = value(node.right);
  return tree_.call(name, {left, right});
}

// MIN, MAX
cxx::Ex ExpressionWriter::extreme(const ir::BinaryExpr& node) {
  const TypeKind kind = kindOf(node.left);
  const bool is_signed = types_.isSigned(kind);
  const uint32_t width = widthOf(kind);
  std::string name = node.op == Op::Min ? "rung_min_" : "rung_max_";
  if (TypeTable::isReal(kind)) {
    name += kind == TypeKind::Real ? "f32" : "f64";
  } else if (width == 64) {
    name += is_signed ? "i64" : "u64";
  } else {
    name += width == 32 && !is_signed ? "u32" : "i32";
  }
  return function(name, node);
}

cxx::Ex ExpressionWriter::logical(ExprId id) {
  if (isContacts(id)) return bitAt(id, 0);
  const ir::BinaryExpr& node = expr(id).as<ir::BinaryExpr>();
  const Ex left = condition(node.left), right = condition(node.right);
  return tree_.infix(node.op == Op::And ? Operator::And : Operator::Or, left, right);
}

cxx::Ex ExpressionWriter::comparison(Operator op, const ir::BinaryExpr& node) {
  return isString(expr(node.left).type) ? strings().compareStrings(op, node) : both(op, node);
}

}  // namespace rung::codegen

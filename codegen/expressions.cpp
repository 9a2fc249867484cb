// SPDX-License-Identifier: Apache-2.0
// Expressions in C++: values, conditions, operators and calls of functions. In: an expression that needs no more
// checks. Out: its C++ with the parentheses that its context needs. Called by the writers of statements, places and
// checks. Integers are computed in arithmetic.cpp, conversions written in conversions.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::TypeTable;

// ---- values

void ExpressionWriter::value(ExprId id, Prec context) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::None: out_ += '0'; return;
    case ExprKind::Const: constant(e, context); return;
    case ExprKind::Zero:
      if (isString(e.type)) {
        strings().stringValue(id);
      } else {
        appendConstant(out_, types_, e.type, 0);
      }
      return;
    case ExprKind::String: strings().stringValue(id); return;
    case ExprKind::Data: places().place(id); return;
    case ExprKind::Local:
    case ExprKind::Self:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Image:
    case ExprKind::Field:
    case ExprKind::Index:
    case ExprKind::Deref:
    case ExprKind::Bits: {
      if (isString(e.type)) {
        strings().stringValue(id);
        return;
      }
      if (const auto* bits = e.tryAs<ir::BitsExpr>()) {
        loadBits(*bits, types_.plainKind(e.type));
        return;
      }
      if (!places().isLvalue(id)) {
        places().imageLoad(id, e);
        return;
      }
      const TypeKind kind = types_.plainKind(e.type);
      if (kind == TypeKind::Bool && !places().isVariableTruth(id)) {
        parenthesis(Prec::Equality, context);
        places().place(id);
        out_ += " != 0";
        closeParenthesis(Prec::Equality, context);
        return;
      }
      if (wideOf(id) == 64) out_ += types_.isSigned(kind) ? "(int32_t)" : "(uint32_t)";
      places().place(id);
      return;
    }
    case ExprKind::Unary: unary(id, context); return;
    case ExprKind::Binary: binary(id, context); return;
    case ExprKind::Convert: convert(id, context); return;
    case ExprKind::Select: {
      if (isString(e.type)) {
        strings().stringValue(id);
        return;
      }
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      parenthesis(Prec::Ternary, context);
      condition(decides, Prec::Or);
      out_ += " ? ";
      value(yes, Prec::Or);
      out_ += " : ";
      value(no, Prec::Or);
      closeParenthesis(Prec::Ternary, context);
      return;
    }
    case ExprKind::Call: calls().callExpr(e); return;
    case ExprKind::Address: {
      const ExprId target = e.as<ir::AddressExpr>().place;
      out_ += isString(expr(target).type) ? "(void*)" : "(void*)&";
      places().place(target);
      return;
    }
  }
}

void ExpressionWriter::loadBits(const ir::BitsExpr& node, TypeKind kind) {
  const TypeKind whole = kindOf(node.base);
  const uint32_t width = widthOf(kind), shift = node.position * width;
  const bool is_signed = types_.isSigned(whole);
  out_ += kind == TypeKind::Bool ? "(" : width == 8 ? "(uint8_t)(" : width == 16 ? "(uint16_t)(" : "(uint32_t)(";
  if (is_signed) {
    const uint32_t from = widthOf(whole);
    out_ += from == 8 ? "(uint8_t)" : from == 16 ? "(uint16_t)" : from == 32 ? "(uint32_t)" : "(uint64_t)";
  }
  value(node.base, Prec::Unary);
  if (shift != 0) {
    out_ += " >> ";
    appendUnsigned(out_, shift);
  }
  out_ += kind == TypeKind::Bool ? " & 1)" : ")";
}

// A BOOL where C++ expects a condition: memory is compared with != 0 anyway.
void ExpressionWriter::condition(ExprId id, Prec context) {
  const Expr& e = expr(id);
  if (ir::isPlace(e.kind) && places().isLvalue(id)) {
    places().place(id);
    return;
  }
  if (e.kind == ExprKind::Binary && isContacts(id)) return bitAt(id, positionOf(id), context);
  value(id, context);
}

void ExpressionWriter::constant(const Expr& e, Prec context) {
  const uint64_t bits = ir::bitsOf(e);
  if (const TypeId record = e.as<ir::ConstExpr>().number_of) {
    if (std::find(group_.classes.begin(), group_.classes.end(), record) == group_.classes.end())
      group_.classes.push_back(record);
    out_ += className(types_, record);
    return;
  }
  const TypeKind kind = types_.plainKind(e.type);
  const bool negative = TypeTable::isReal(kind) ? (bits >> 63) != 0
                        : types_.isSigned(kind) ? static_cast<int64_t>(bits) < 0
                                                : false;
  if (negative) parenthesis(Prec::Unary, context);
  appendConstant(out_, types_, e.type, bits);
  if (negative) closeParenthesis(Prec::Unary, context);
}

void ExpressionWriter::scalarBits(ExprId id) {
  const TypeKind kind = kindOf(id);
  if (TypeTable::isReal(kind)) {
    out_ += "rung_bits_of_f64(";
    value(id, Prec::Ternary);
    out_ += ')';
    return;
  }
  out_ += isPointer(kind) ? "(uint64_t)(uintptr_t)" : types_.isSigned(kind) ? "(uint64_t)(int64_t)" : "(uint64_t)";
  value(id, Prec::Unary);
}

// ---- operators

void ExpressionWriter::unary(ExprId id, Prec context) {
  const auto [a, op] = expr(id).as<ir::UnaryExpr>();
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  if (op == Op::Not) {
    parenthesis(Prec::Unary, context);
    if (kind == TypeKind::Bool) {
      out_ += '!';
      condition(a, Prec::Unary);
    } else {
      if (!is_signed && width < 32) out_ += width == 8 ? "(uint8_t)" : "(uint16_t)";
      out_ += '~';
      value(a, Prec::Unary);
    }
    closeParenthesis(Prec::Unary, context);
    return;
  }
  if (TypeTable::isReal(kind)) {
    if (op == Op::Abs) {
      out_ += kind == TypeKind::Real ? "__builtin_fabsf(" : "__builtin_fabs(";
      value(a, Prec::Ternary);
      out_ += ')';
    } else {
      parenthesis(Prec::Unary, context);
      out_ += '-';
      value(a, Prec::Postfix);
      closeParenthesis(Prec::Unary, context);
    }
    return;
  }
  if (op == Op::Abs) {
    if (!is_signed) {
      value(a, context);
      return;
    }
    if (width < 32) {
      parenthesis(Prec::Unary, context);
      out_ += width == 8 ? "(int8_t)" : "(int16_t)";
    }
    out_ += width == 64 ? "rung_abs_i64(" : "rung_abs_i32(";
    value(a, Prec::Ternary);
    out_ += ')';
    if (width < 32) closeParenthesis(Prec::Unary, context);
    return;
  }
  arithmetic(id, context);  // Neg
}

void ExpressionWriter::binary(ExprId id, Prec context) {
  const ir::BinaryExpr& node = expr(id).as<ir::BinaryExpr>();
  const TypeKind kind = kindOf(node.left);
  const bool is_real = TypeTable::isReal(kind);
  switch (node.op) {
    case Op::Eq:
    case Op::Ne:
    case Op::Lt:
    case Op::Le:
    case Op::Gt:
    case Op::Ge: return TypeTable::isString(kind) ? strings().compareStrings(node, context) : comparison(node, context);
    case Op::Add:
    case Op::Sub:
    case Op::Mul: return is_real ? realOperation(node, context) : arithmetic(id, context);
    case Op::Div: return is_real ? realOperation(node, context) : divide(node, context);
    case Op::Mod:
      return is_real ? function(kind == TypeKind::Real ? "__builtin_fmodf" : "__builtin_fmod", node)
                     : divide(node, context);
    case Op::Power: return power(expr(id));
    case Op::And:
    case Op::Or: return kind == TypeKind::Bool ? logical(id, context) : bitwise(node, context);
    case Op::Xor: return kind == TypeKind::Bool ? differs(node, context) : bitwise(node, context);
    case Op::Shl:
    case Op::Shr:
    case Op::Sar:
    case Op::Rol:
    case Op::Ror: return shift(expr(id), context);
    case Op::Min:
    case Op::Max: return TypeTable::isString(kind) ? strings().stringValue(id) : extreme(node);
    case Op::Neg:
    case Op::Not:
    case Op::Abs: return;
  }
}

void ExpressionWriter::function(std::string_view name, const ir::BinaryExpr& node) {
  out_ += name;
  out_ += '(';
  value(node.left, Prec::Ternary);
  out_ += ", ";
  value(node.right, Prec::Ternary);
  out_ += ')';
}

void ExpressionWriter::realOperation(const ir::BinaryExpr& node, Prec context) {
  const bool is_sum = node.op == Op::Add || node.op == Op::Sub;
  const Prec own = is_sum ? Prec::Sum : Prec::Product;
  parenthesis(own, context);
  value(node.left, own);
  out_ += node.op == Op::Add ? " + " : node.op == Op::Sub ? " - " : node.op == Op::Mul ? " * " : " / ";
  value(node.right, is_sum ? Prec::Product : Prec::Unary);
  closeParenthesis(own, context);
}

// g++ warns about nested operators of these precedences, so they get parentheses.
void ExpressionWriter::bitwise(const ir::BinaryExpr& node, Prec context) {
  const char* op = node.op == Op::And ? " & " : node.op == Op::Or ? " | " : " ^ ";
  parenthesis(Prec::Bit, context);
  auto operand = [&](ExprId id) {
    const auto* child = expr(id).tryAs<ir::BinaryExpr>();
    value(id, child != nullptr && child->op == node.op ? Prec::Bit : Prec::Unary);
  };
  operand(node.left);
  out_ += op;
  operand(node.right);
  closeParenthesis(Prec::Bit, context);
}

void ExpressionWriter::extreme(const ir::BinaryExpr& node) {
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
  function(name, node);
}

// XOR of BOOL.
void ExpressionWriter::differs(const ir::BinaryExpr& node, Prec context) {
  parenthesis(Prec::Equality, context);
  leftOfEquality(node.left);
  out_ += " != ";
  value(node.right, Prec::Sum);
  closeParenthesis(Prec::Equality, context);
}

void ExpressionWriter::logical(ExprId id, Prec context) {
  if (isContacts(id)) return bitAt(id, 0, context);
  const ir::BinaryExpr& node = expr(id).as<ir::BinaryExpr>();
  const Prec own = node.op == Op::And ? Prec::And : Prec::Or;
  parenthesis(own, context);
  auto operand = [&](ExprId side) {
    const auto* child = expr(side).tryAs<ir::BinaryExpr>();
    condition(side, child != nullptr && child->op == node.op ? own : Prec::Equality);
  };
  operand(node.left);
  out_ += node.op == Op::And ? " && " : " || ";
  operand(node.right);
  closeParenthesis(own, context);
}

// (!a) != b: without the parentheses g++ warns.
void ExpressionWriter::leftOfEquality(ExprId id) { value(id, ir::isNot(expr(id)) ? Prec::Postfix : Prec::Sum); }

void ExpressionWriter::comparison(const ir::BinaryExpr& node, Prec context) {
  const bool is_equality = node.op == Op::Eq || node.op == Op::Ne;
  const Prec own = is_equality ? Prec::Equality : Prec::Relation;
  parenthesis(own, context);
  leftOfEquality(node.left);
  out_ += node.op == Op::Eq   ? " == "
          : node.op == Op::Ne ? " != "
          : node.op == Op::Lt ? " < "
          : node.op == Op::Le ? " <= "
          : node.op == Op::Gt ? " > "
                              : " >= ";
  value(node.right, Prec::Sum);
  closeParenthesis(own, context);
}

}  // namespace rung::codegen

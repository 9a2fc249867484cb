// Expressions in C++: see body.h. Integers are computed in unsigned types of their width, or in int where no
// intermediate value can leave it, and cut back; everything agrees with the arithmetic kernel.
#include <algorithm>

#include "codegen/body.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::TypeInfo;
using types::TypeTable;

namespace {

bool isBitwise(types::Op op) { return op == types::Op::And || op == types::Op::Or || op == types::Op::Xor; }
bool isSumOrProduct(types::Op op) { return op == types::Op::Add || op == types::Op::Sub || op == types::Op::Mul; }

// Pointer arithmetic has the bounds of ULINT.
bool isPointer(types::TypeKind kind) { return kind == types::TypeKind::Pointer || kind == types::TypeKind::Reference; }

}  // namespace

// ---- values

void BodyWriter::value(ExprId id, Prec context) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::None: out_ += '0'; return;
    case ExprKind::Const: constant(e, context); return;
    case ExprKind::Zero:
      if (isString(e.type)) {
        stringValue(id);
      } else {
        appendConstant(out_, types_, e.type, 0);
      }
      return;
    case ExprKind::String: stringValue(id); return;
    case ExprKind::Data: place(id); return;
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
        stringValue(id);
        return;
      }
      if (!isLvalue(id)) {
        imageLoad(id, e);
        return;
      }
      const TypeKind kind = types_.plainKind(e.type);
      if (kind == TypeKind::Bool && !isVariableTruth(id)) {
        parenthesis(Prec::Equality, context);
        place(id);
        out_ += " != 0";
        closeParenthesis(Prec::Equality, context);
        return;
      }
      Slot slot = slotOf(id);
      if (Variable* of = variableOf(slot); of != nullptr && of->wide == 64) {
        out_ += types_.isSigned(kind) ? "(int32_t)" : "(uint32_t)";
      }
      place(id);
      return;
    }
    case ExprKind::Unary: unary(id, context); return;
    case ExprKind::Binary: binary(id, context); return;
    case ExprKind::Convert: convert(id, context); return;
    case ExprKind::Select: {
      if (isString(e.type)) {
        stringValue(id);
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
    case ExprKind::Call: callExpr(e); return;
    case ExprKind::Address: {
      const ExprId target = e.as<ir::AddressExpr>().place;
      out_ += isString(expr(target).type) ? "(void*)" : "(void*)&";
      place(target);
      return;
    }
  }
}

// A BOOL where C++ expects a condition: memory is compared with != 0 anyway.
void BodyWriter::condition(ExprId id, Prec context) {
  const Expr& e = expr(id);
  if (ir::isPlace(e.kind) && isLvalue(id)) {
    place(id);
    return;
  }
  value(id, context);
}

void BodyWriter::constant(const Expr& e, Prec context) {
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

void BodyWriter::callExpr(const Expr& e) {
  const auto [id, operands] = e.as<ir::CallExpr>();
  const Body& callee = module_.body(id);
  if (!isString(e.type) && isSizedCall(callee, operands, {})) {
    sizedCall(callee, operands);
    out_ += ')';
    return;
  }
  call(id);
  if (callee.native) {
    out_ += ir::nativeName(module_, callee);
  } else {
    appendFunctionName(out_, module_, callee);
  }
  out_ += "(ctx";
  uint32_t i = 0;
  for (const ir::Local& parameter : ir::parameters(callee)) {
    if (i >= operands.count) break;
    const ExprId operand = body_->list(operands)[i++];
    out_ += ", ";
    if (parameter.by_reference) {
      reference(parameter, callee.native, operand);
    } else {
      value(operand, Prec::Ternary);
    }
  }
  out_ += ')';
}

void BodyWriter::scalarBits(ExprId id) {
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

void BodyWriter::unary(ExprId id, Prec context) {
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

void BodyWriter::binary(ExprId id, Prec context) {
  const ir::BinaryExpr& node = expr(id).as<ir::BinaryExpr>();
  const ExprId a = node.left, b = node.right;
  const TypeKind kind = kindOf(a);
  if (types::isComparison(node.op)) {
    if (TypeTable::isString(kind)) {
      compareStrings(node, context);
    } else {
      comparison(node, context);
    }
    return;
  }
  if (kind == TypeKind::Bool && isBitwise(node.op)) {
    if (node.op == Op::Xor) {
      parenthesis(Prec::Equality, context);
      leftOfEquality(a);
      out_ += " != ";
      value(b, Prec::Sum);
      closeParenthesis(Prec::Equality, context);
    } else {
      logical(node, context);
    }
    return;
  }
  const bool is_real = TypeTable::isReal(kind), is_single = kind == TypeKind::Real;
  switch (node.op) {
    case Op::Add:
    case Op::Sub:
    case Op::Mul:
      if (!is_real) {
        arithmetic(id, context);
        return;
      }
      [[fallthrough]];
    case Op::Div:
      if (!is_real) {
        divide(node, context);
      } else {
        const bool is_sum = node.op == Op::Add || node.op == Op::Sub;
        const Prec own = is_sum ? Prec::Sum : Prec::Product;
        parenthesis(own, context);
        value(a, own);
        out_ += node.op == Op::Add ? " + " : node.op == Op::Sub ? " - " : node.op == Op::Mul ? " * " : " / ";
        value(b, is_sum ? Prec::Product : Prec::Unary);
        closeParenthesis(own, context);
      }
      return;
    case Op::Mod:
      if (!is_real) {
        divide(node, context);
        return;
      }
      out_ += is_single ? "__builtin_fmodf(" : "__builtin_fmod(";
      value(a, Prec::Ternary);
      out_ += ", ";
      value(b, Prec::Ternary);
      out_ += ')';
      return;
    case Op::Power: power(expr(id)); return;
    case Op::And:
    case Op::Or:
    case Op::Xor: {
      const char* op = node.op == Op::And ? " & " : node.op == Op::Or ? " | " : " ^ ";
      parenthesis(Prec::Bit, context);
      auto operand = [&](ExprId operand_id) {
        const auto* child = expr(operand_id).tryAs<ir::BinaryExpr>();
        value(operand_id, child != nullptr && child->op == node.op ? Prec::Bit : Prec::Unary);
      };
      operand(a);
      out_ += op;
      operand(b);
      closeParenthesis(Prec::Bit, context);
      // g++ warns about nested operators of these precedences, so they get parentheses.
      return;
    }
    case Op::Shl:
    case Op::Shr:
    case Op::Rol:
    case Op::Ror: shift(expr(id), context); return;
    case Op::Min:
    case Op::Max: {
      if (TypeTable::isString(kind)) {
        stringValue(id);
        return;
      }
      const uint32_t width = widthOf(kind);
      out_ += node.op == Op::Min ? "rung_min_" : "rung_max_";
      if (is_real) {
        out_ += is_single ? "f32(" : "f64(";
      } else if (width == 64) {
        out_ += types_.isSigned(kind) ? "i64(" : "u64(";
      } else {
        out_ += width == 32 && !types_.isSigned(kind) ? "u32(" : "i32(";
      }
      value(a, Prec::Ternary);
      out_ += ", ";
      value(b, Prec::Ternary);
      out_ += ')';
      return;
    }
    case Op::Neg:
    case Op::Not:
    case Op::Abs:
    case Op::Eq:
    case Op::Ne:
    case Op::Lt:
    case Op::Le:
    case Op::Gt:
    case Op::Ge: return;
  }
}

void BodyWriter::logical(const ir::BinaryExpr& node, Prec context) {
  const Prec own = node.op == Op::And ? Prec::And : Prec::Or;
  parenthesis(own, context);
  auto operand = [&](ExprId id) {
    const auto* child = expr(id).tryAs<ir::BinaryExpr>();
    condition(id, child != nullptr && child->op == node.op ? own : Prec::Equality);
  };
  operand(node.left);
  out_ += node.op == Op::And ? " && " : " || ";
  operand(node.right);
  closeParenthesis(own, context);
}

// (!a) != b: without the parentheses g++ warns.
void BodyWriter::leftOfEquality(ExprId id) { value(id, ir::isNot(expr(id)) ? Prec::Postfix : Prec::Sum); }

void BodyWriter::comparison(const ir::BinaryExpr& node, Prec context) {
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

// ---- integer + - * and negation

bool BodyWriter::isChain(const Expr& e) const {
  const auto* negation = e.tryAs<ir::UnaryExpr>();
  const auto* binary = e.tryAs<ir::BinaryExpr>();
  const bool is_arithmetic =
      (binary != nullptr && isSumOrProduct(binary->op)) || (negation != nullptr && negation->op == Op::Neg);
  const TypeKind kind = types_.plainKind(e.type);
  return is_arithmetic && widthOf(kind) > 1 && !TypeTable::isReal(kind);
}

// Bits of a signed number that holds every value of the expression computed in int.
uint32_t BodyWriter::plainBits(ExprId id) const {
  const Expr& e = expr(id);
  if (isChain(e)) {
    if (const auto* negation = e.tryAs<ir::UnaryExpr>()) return plainBits(negation->operand) + 1;
    const auto [left, right, op] = e.as<ir::BinaryExpr>();
    const uint32_t a = plainBits(left), b = plainBits(right);
    return op == Op::Mul ? a + b : std::max(a, b) + 1;
  }
  const TypeKind kind = types_.plainKind(e.type);
  if (e.kind == ExprKind::Const) {
    const auto number = static_cast<int64_t>(ir::bitsOf(e));
    uint32_t bits = 1;
    while (bits < 32 && (number < -(int64_t{1} << (bits - 1)) || number >= int64_t{1} << (bits - 1))) ++bits;
    return bits;
  }
  return widthOf(kind) + (types_.isSigned(kind) ? 0 : 1);
}

void BodyWriter::plain(ExprId id, Prec context) {
  const Expr& e = expr(id);
  if (!isChain(e)) {
    value(id, context);
    return;
  }
  if (const auto* negation = e.tryAs<ir::UnaryExpr>()) {
    parenthesis(Prec::Unary, context);
    out_ += '-';
    plain(negation->operand, Prec::Postfix);
    closeParenthesis(Prec::Unary, context);
    return;
  }
  const auto [left, right, op] = e.as<ir::BinaryExpr>();
  const Prec own = op == Op::Mul ? Prec::Product : Prec::Sum;
  parenthesis(own, context);
  plain(left, own);
  out_ += op == Op::Add ? " + " : op == Op::Sub ? " - " : " * ";
  plain(right, own == Prec::Sum ? Prec::Product : Prec::Unary);
  closeParenthesis(own, context);
}

// An unsigned expression of 32 or 64 bits that is equal to the value modulo 2^32 or 2^64.
void BodyWriter::modular(ExprId id, bool wide, Prec context) {
  const Expr& e = expr(id);
  const TypeKind kind = types_.plainKind(e.type);
  if (isChain(e)) {
    if (const auto* negation = e.tryAs<ir::UnaryExpr>()) {
      parenthesis(Prec::Sum, context);
      out_ += wide ? "0ULL - " : "0u - ";
      modular(negation->operand, wide, Prec::Product);
      closeParenthesis(Prec::Sum, context);
      return;
    }
    const auto [left, right, op] = e.as<ir::BinaryExpr>();
    const Prec own = op == Op::Mul ? Prec::Product : Prec::Sum;
    parenthesis(own, context);
    modular(left, wide, own);
    const auto* constant = expr(right).tryAs<ir::ConstExpr>();
    const bool flips = own == Prec::Sum && constant != nullptr && types_.isSigned(kind) &&
                       static_cast<int64_t>(uint64_t{constant->bits}) < 0;
    out_ += op == Op::Mul ? " * " : (op == Op::Add) != flips ? " + " : " - ";
    if (flips) {
      appendUnsigned(out_, 0 - uint64_t{constant->bits});
      out_ += wide ? "ULL" : "u";
    } else {
      modular(right, wide, own == Prec::Sum ? Prec::Product : Prec::Unary);
    }
    closeParenthesis(own, context);
    return;
  }
  if (ir::isConst(e)) {
    appendUnsigned(out_, wide ? ir::bitsOf(e) : static_cast<uint32_t>(ir::bitsOf(e)));
    out_ += wide ? "ULL" : "u";
    return;
  }
  if (!types_.isSigned(kind) && widthOf(kind) == (wide ? 64u : 32u)) {
    value(id, context);
    return;
  }
  parenthesis(Prec::Unary, context);
  out_ += wide ? "(uint64_t)" : "(uint32_t)";
  value(id, Prec::Unary);
  closeParenthesis(Prec::Unary, context);
}

void BodyWriter::arithmetic(ExprId id, Prec context) {
  const Expr& e = expr(id);
  const auto* binary = e.tryAs<ir::BinaryExpr>();
  const TypeKind kind = kindOf(binary != nullptr ? binary->left : e.as<ir::UnaryExpr>().operand);
  const uint32_t width = widthOf(kind);
  if (binary != nullptr && (isPointer(kind) || width == 0)) {
    parenthesis(Prec::Unary, context);
    out_ += "(void*)((uintptr_t)";
    value(binary->left, Prec::Unary);
    out_ += binary->op == Op::Sub ? " - " : " + ";
    out_ += "(uintptr_t)";
    value(binary->right, Prec::Unary);
    out_ += ')';
    closeParenthesis(Prec::Unary, context);
    return;
  }
  if (!types_.isSigned(kind) && width >= 32) {
    modular(id, width == 64, context);
    return;
  }
  parenthesis(Prec::Unary, context);
  out_ += '(';
  out_ += scalarType(types_, e.type);
  out_ += ")(";
  if (width <= 16 && plainBits(id) <= 32) {
    plain(id, Prec::Comma);
  } else {
    modular(id, width == 64, Prec::Comma);
  }
  out_ += ')';
  closeParenthesis(Prec::Unary, context);
}

void BodyWriter::divide(const ir::BinaryExpr& node, Prec context) {
  const auto [a, b, op] = node;
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  const uint64_t divisor = ir::isConst(expr(b)) ? ir::bitsOf(expr(b)) : 0;
  if (divisor != 0 && !(is_signed && static_cast<int64_t>(divisor) == -1)) {
    parenthesis(Prec::Product, context);
    value(a, Prec::Product);
    out_ += op == Op::Div ? " / " : " % ";
    value(b, Prec::Unary);
    closeParenthesis(Prec::Product, context);
    return;
  }
  const bool cuts = is_signed && width < 32 && op == Op::Div;
  if (cuts) {
    parenthesis(Prec::Unary, context);
    out_ += width == 8 ? "(int8_t)" : "(int16_t)";
  }
  out_ += op == Op::Div ? "rung_div_" : "rung_mod_";
  out_ += width == 64 ? (is_signed ? "i64(" : "u64(") : (is_signed || width < 32 ? "i32(" : "u32(");
  value(a, Prec::Ternary);
  out_ += ", ";
  value(b, Prec::Ternary);
  out_ += ')';
  if (cuts) closeParenthesis(Prec::Unary, context);
}

// A count of the width or more gives 0; a rotation is modulo the width.
void BodyWriter::shift(const Expr& e, Prec context) {
  const Op op = e.op();
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  auto writeBits = [&](Prec at) {  // zero-extended
    if (!is_signed) {
      value(a, at);
      return;
    }
    parenthesis(Prec::Unary, at);
    out_ += width == 8 ? "(uint8_t)" : width == 16 ? "(uint16_t)" : width == 32 ? "(uint32_t)" : "(uint64_t)";
    value(a, Prec::Unary);
    closeParenthesis(Prec::Unary, at);
  };
  const bool rotates = op == Op::Rol || op == Op::Ror;
  const bool cuts = is_signed || (width < 32 && op == Op::Shl);
  if (!rotates && expr(b).kind == ExprKind::Const) {
    const uint64_t count = ir::bitsOf(expr(b));
    if (count >= width) {
      appendConstant(out_, types_, e.type, 0);
      return;
    }
    parenthesis(cuts ? Prec::Unary : Prec::Shift, context);
    if (cuts) {
      out_ += '(';
      out_ += scalarType(types_, e.type);
      out_ += ")(";
    }
    writeBits(Prec::Unary);
    out_ += op == Op::Shl ? " << " : " >> ";
    appendUnsigned(out_, count);
    if (cuts) out_ += ')';
    closeParenthesis(cuts ? Prec::Unary : Prec::Shift, context);
    return;
  }
  if (cuts) {
    parenthesis(Prec::Unary, context);
    out_ += '(';
    out_ += scalarType(types_, e.type);
    out_ += ')';
  }
  if (rotates) {
    out_ += "rung_rol";
    appendUnsigned(out_, width);
  } else {
    out_ += op == Op::Shl ? "rung_shl" : "rung_shr";
    if (width == 64) out_ += "64";
  }
  out_ += '(';
  writeBits(Prec::Ternary);
  out_ += op == Op::Ror ? ", 0 - (uint64_t)" : ", (uint64_t)";
  value(b, Prec::Unary);
  out_ += ')';
  if (cuts) closeParenthesis(Prec::Unary, context);
}

void BodyWriter::power(const Expr& e) {
  const ExprId a = e.as<ir::BinaryExpr>().left, b = e.as<ir::BinaryExpr>().right;
  const TypeKind kind = kindOf(a);
  if (TypeTable::isReal(kind)) {
    if (kind == TypeKind::Real) out_ += "(float)";
    out_ += "rung_power(";
    value(a, Prec::Ternary);
    out_ += ", ";
    if (!TypeTable::isReal(kindOf(b))) out_ += "(double)";
    value(b, TypeTable::isReal(kindOf(b)) ? Prec::Ternary : Prec::Unary);
    out_ += ')';
    return;
  }
  out_ += '(';
  out_ += scalarType(types_, e.type);
  out_ += ")rung_integer_power(";
  out_ += types_.isSigned(kind) ? "(uint64_t)(int64_t)" : "(uint64_t)";
  value(a, Prec::Unary);
  out_ += ", (uint64_t)";
  value(b, Prec::Unary);
  out_ += ", ";
  if (types_.isSigned(kindOf(b))) {
    value(b, Prec::Sum);
    out_ += " < 0)";
  } else {
    out_ += "false)";
  }
}

// ---- conversions

void BodyWriter::convertTime(ExprId from, TypeKind source, TypeKind target) {
  const bool is_signed = types_.isSigned(source);
  const char* integer = is_signed ? "(int64_t)" : "(uint64_t)";
  const char* suffix = is_signed ? "LL" : "ULL";
  const int64_t unit = types::nanoseconds(source), to = types::nanoseconds(target);
  constexpr int64_t kDay = 86'400'000'000'000;
  // Computed in the finer of both units: 32-bit values scaled up fit 64 bits.
  auto number = [&] {
    out_ += integer;
    value(from, Prec::Unary);
  };
  const int64_t day = kDay / unit;
  out_ += '(';
  if (TypeTable::isDateTime(source) && TypeTable::isTimeOfDay(target)) {
    number();
    out_ += " % ";
    appendSigned(out_, day);
    out_ += suffix;
  } else if (TypeTable::isDateTime(source) && TypeTable::isDay(target)) {
    number();
    out_ += " / ";
    appendSigned(out_, day);
    out_ += suffix;
    out_ += " * ";
    appendSigned(out_, day);
    out_ += suffix;
  } else {
    number();
  }
  out_ += ')';
  if (unit > to) {
    out_ += " * ";
    appendSigned(out_, unit / to);
    out_ += suffix;
  } else if (to > unit) {
    out_ += " / ";
    appendSigned(out_, to / unit);
    out_ += suffix;
  }
}

void BodyWriter::convert(ExprId id, Prec context) {
  const Expr& e = expr(id);
  const ExprId a = e.as<ir::ConvertExpr>().operand;
  const TypeKind source = kindOf(a), target = types_.plainKind(e.type);
  if (TypeTable::isString(target)) {
    stringValue(id);
    return;
  }
  const TypeInfo& info = types_.info(types_.resolve(e.type));
  const bool is_signed = types_.isSigned(target);
  const uint32_t width = widthOf(target);
  const bool clamps = info.kind == TypeKind::Subrange && types_.resolve(expr(a).type) != types_.resolve(e.type);
  const Prec clamp_context = context;
  if (clamps) {
    parenthesis(Prec::Unary, context);
    out_ += '(';
    out_ += scalarType(types_, e.type);
    out_ += is_signed || width < 64 ? ")rung_clamp(" : ")rung_clamp_u(";
    context = Prec::Ternary;
  }
  const Prec outer = context;
  auto cast = [&](std::string_view type) {
    parenthesis(Prec::Unary, outer);
    out_ += '(';
    out_ += type;
    out_ += ')';
  };
  auto endCast = [&] { closeParenthesis(Prec::Unary, outer); };
  const std::string type = scalarType(types_, e.type);
  const bool from_real = TypeTable::isReal(source);

  if (TypeTable::isString(source)) {
    if (TypeTable::isReal(target)) {
      if (target == TypeKind::Real) out_ += "(float)";
      out_ += "rung_f64_of(";
    } else {
      cast(type);
    }
    out_ += source == TypeKind::WString ? "rung_scalar_of_wstring(" : "rung_scalar_of_string(";
    out_ += typeKindName(types_, e.type);
    out_ += ", ";
    stringValue(a);
    out_ += ')';
    if (TypeTable::isReal(target)) {
      out_ += ')';
    } else {
      endCast();
    }
  } else if (isPointer(target) || isPointer(source)) {
    if (isPointer(target) == isPointer(source)) {
      value(a, context);
    } else {
      cast(isPointer(target) ? "void*" : type);
      out_ += "(uintptr_t)";
      value(a, Prec::Unary);
      endCast();
    }
  } else if (TypeTable::isReal(target)) {
    if (source == target) {
      value(a, context);
    } else {
      cast(type);
      value(a, Prec::Unary);
      endCast();
    }
  } else if (target == TypeKind::Bool) {
    if (source == TypeKind::Bool) {
      value(a, context);
    } else if (from_real) {  // FALSE for NaN
      out_ += '(';
      value(a, Prec::Sum);
      out_ += " < 0 || ";
      value(a, Prec::Sum);
      out_ += " > 0)";
    } else {
      parenthesis(Prec::Equality, context);
      value(a, Prec::Sum);
      out_ += " != 0";
      closeParenthesis(Prec::Equality, context);
    }
  } else if (from_real) {
    if (width == 64) {
      out_ += is_signed ? "rung_round_i64(" : "rung_round_u64(";
      value(a, Prec::Ternary);
      out_ += ')';
    } else if (width == 32 && is_signed) {
      out_ += "rung_round_i32(";
      value(a, Prec::Ternary);
      out_ += ')';
    } else {
      cast(type);
      out_ += "rung_round(";
      value(a, Prec::Ternary);
      out_ += ", ";
      appendSigned(out_, is_signed ? -(int64_t{1} << (width - 1)) : 0);
      out_ += ", ";
      appendSigned(out_, (int64_t{1} << (is_signed ? width - 1 : width)) - 1);
      out_ += ')';
      endCast();
    }
  } else if (types::changesUnit(source, target)) {
    cast(type);
    out_ += '(';
    convertTime(a, source, target);
    out_ += ')';
    endCast();
  } else {
    const bool from_signed = types_.isSigned(source);
    const uint32_t from_width = widthOf(source);
    // The value promotes to int, which is the target's type or can hold it.
    const bool keeps =
        (from_width == width && from_signed == is_signed && from_width > 1) ||
        (from_width < 32 && width <= 32 && from_width < width && (is_signed || (!from_signed && width < 32)));
    if (keeps) {
      value(a, context);
    } else {
      cast(type);
      if (isChain(expr(a)) && from_width >= width && width < 64) {  // the operand need not be cut first
        out_ += '(';
        if (from_width <= 16 && plainBits(a) <= 32) {
          plain(a, Prec::Comma);
        } else {
          modular(a, from_width == 64, Prec::Comma);
        }
        out_ += ')';
      } else {
        value(a, Prec::Unary);
      }
      endCast();
    }
  }
  if (clamps) {
    out_ += ", ";
    if (is_signed || width < 64) {
      appendConstant(out_, types_, types::kLInt, static_cast<uint64_t>(info.low));
      out_ += ", ";
      appendConstant(out_, types_, types::kLInt, static_cast<uint64_t>(info.high));
    } else {
      appendConstant(out_, types_, types::kULInt, static_cast<uint64_t>(info.low));
      out_ += ", ";
      appendConstant(out_, types_, types::kULInt, static_cast<uint64_t>(info.high));
    }
    out_ += ')';
    closeParenthesis(Prec::Unary, clamp_context);
  }
}

}  // namespace rung::codegen

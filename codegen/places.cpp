// Lvalues in C++: variables, fields, elements, targets of pointers, and views of the process image, which are
// little-endian bytes at any address and therefore read and written by the helpers of rung/code.h.
#include "codegen/body.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::Field;
using types::TypeInfo;
using types::TypeTable;

bool BodyWriter::isImagePlace(ExprId id) const { return expr(ir::rootOf(*body_, id)).kind == ExprKind::Image; }
bool BodyWriter::isLvalue(ExprId id) const { return expr(id).kind != ExprKind::Bits && !isImagePlace(id); }

// Only generated code writes locals, and it writes 0 or 1.
bool BodyWriter::isVariableTruth(ExprId id) const {
  const Expr& e = expr(id);
  if (const uint32_t* local = ir::localOf(e)) return !body_->locals[*local].by_reference && !locals_[*local].exposed;
  const Slot slot = slotOf(id);
  return slot.kind == Slot::Field && fields_[slot.index].cached;
}

void BodyWriter::place(ExprId id) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::Local: {
      const ir::Local& local = body_->locals[e.as<ir::LocalExpr>().local];
      const bool after = local.by_reference && !isString(local.type);
      if (after) out_ += "(*";
      variable(out_, local);
      if (after) out_ += ')';
      return;
    }
    case ExprKind::Self: out_ += "self"; return;
    case ExprKind::Global:
    case ExprKind::Program: {
      const bool is_list = e.kind == ExprKind::Global;
      const uint32_t number = is_list ? facts_.list_block[e.as<ir::GlobalExpr>().list]
                                      : facts_.program_block[e.as<ir::ProgramExpr>().program];
      const std::string type = recordName(types_, e.type);
      includeRecord(e.type);
      bool declared = false;
      for (uint32_t known : blocks_declared_) declared |= known == number;
      std::string name;
      appendMangled(name, string(facts_.blocks[number].name));
      name += is_list ? "list_block" : "block";
      if (!declared) {
        blocks_declared_.push_back(number);
        declarations_ += " " + type + "& " + name + " = *static_cast<" + type + "*>(ctx->blocks[";
        appendUnsigned(declarations_, number);
        declarations_ += "]);";
      }
      out_ += name;
      return;
    }
    case ExprKind::Field: {
      const auto [base, number] = e.as<ir::FieldExpr>();
      const Field& field = fieldOf(e.as<ir::FieldExpr>());
      if (expr(base).kind == ExprKind::Self && number < fields_.size() && fields_[number].cached) {
        appendMangled(out_, string(field.name));
        return;
      }
      const bool after = field.by_reference && !isString(field.type);
      if (after) includeRecord(field.type);
      if (after) out_ += "(*";
      member(base);
      appendMangled(out_, string(field.name));
      if (after) out_ += ')';
      return;
    }
    case ExprKind::Index: {
      const ir::IndexExpr& node = e.as<ir::IndexExpr>();
      const TypeInfo& array = types_.info(types_.resolve(expr(node.base).type));
      place(node.base);
      for (uint32_t i = 0; i < node.indices.count; ++i) {
        const types::Dimension dimension = i < array.dimensions.size() ? array.dimensions[i] : types::Dimension{};
        out_ += '[';
        indexValue(body_->list(node.indices)[i], dimension);
        out_ += ']';
      }
      return;
    }
    case ExprKind::Deref: {
      const ExprId pointer = e.as<ir::DerefExpr>().pointer;
      const TypeKind kind = types_.kind(e.type);
      if (isString(e.type)) {
        out_ += isWide(e.type) ? "((char16_t*)" : "((char*)";
        value(pointer, Prec::Unary);
        out_ += ')';
        return;
      }
      out_ += "(*(";
      if (kind == TypeKind::Record || kind == TypeKind::Array) {
        includeRecord(e.type);
        const TypeId element = elementOf(types_, e.type);
        std::string type;
        appendPointer(type, types_, e.type, "");
        // Elements may be read with another type than the one they were written with.
        if (types_.kind(element) != TypeKind::Record && !isString(element)) {
          const std::string scalar = scalarType(types_, element);
          type.replace(0, scalar.size(), scalarAliasType(types_, element));
        }
        out_ += type;
      } else {
        out_ += scalarAliasType(types_, e.type);
        out_ += '*';
      }
      out_ += ')';
      value(pointer, Prec::Unary);
      out_ += ')';
      return;
    }
    case ExprKind::Data:
      out_ += "(*(";
      appendPointer(out_, types_, e.type, "", true);
      out_ += ')';
      dataReference(e.as<ir::DataExpr>().index);
      out_ += ')';
      return;
    case ExprKind::Zero:
    case ExprKind::Call:
    case ExprKind::Convert:
      for (const auto& [created, name] : materialized_) {
        if (created == id.index) out_ += name;
      }
      return;
    case ExprKind::Select: {
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      out_ += "(*(";
      condition(decides, Prec::Or);
      out_ += " ? &";
      place(yes);
      out_ += " : &";
      place(no);
      out_ += "))";
      return;
    }
    case ExprKind::Image:  // as an aggregate: in place
      out_ += "(*(";
      appendPointer(out_, types_, e.type, "");
      out_ += ")(";
      imageAddress(id);
      out_ += "))";
      return;
    case ExprKind::Bits:
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::String:
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Address: value(id, Prec::Postfix); return;
  }
}

// Writes the prefix of a field's name.
void BodyWriter::member(ExprId base) {
  const Expr& e = expr(base);
  if (const uint32_t* local = ir::localOf(e); local != nullptr && body_->locals[*local].by_reference) {
    variable(out_, body_->locals[*local]);
    out_ += "->";
    return;
  }
  if (const auto* part = e.tryAs<ir::FieldExpr>()) {
    const Field& field = fieldOf(*part);
    if (field.by_reference) {
      includeRecord(field.type);
      member(part->base);
      appendMangled(out_, string(field.name));
      out_ += "->";
      return;
    }
  }
  place(base);
  out_ += '.';
}

// ---- indices

// `i + 1` need not be cut to its type when the values that would differ are invalid indices either way.
ir::ExprId BodyWriter::peelIndex(ExprId id, const types::Dimension& dimension, int64_t& addend) const {
  addend = 0;
  const Expr& e = expr(id);
  if (e.kind != ExprKind::Binary || e.checks != 0) return id;
  auto [variable, constant, op] = e.as<ir::BinaryExpr>();
  if (op != Op::Add && op != Op::Sub) return id;
  const TypeKind kind = types_.plainKind(e.type);
  const uint32_t width = widthOf(kind);
  if (width < 8 || width > 32 || TypeTable::isReal(kind)) return id;
  if (op == Op::Add && expr(variable).kind == ExprKind::Const) std::swap(variable, constant);
  if (expr(constant).kind != ExprKind::Const) return id;
  int64_t c = static_cast<int64_t>(ir::bitsOf(expr(constant)));
  if (op == Op::Sub) c = -c;
  constexpr int64_t kMax = int64_t{1} << 31;
  if (c <= -kMax || c >= kMax) return id;
  const bool is_signed = types_.isSigned(kind);
  const int64_t low = is_signed ? -(int64_t{1} << (width - 1)) : 0;
  const int64_t high = (int64_t{1} << (is_signed ? width - 1 : width)) - 1;
  auto meets = [&](int64_t from, int64_t to) { return from <= dimension.high && to >= dimension.low; };
  if (c > 0 && (meets(high + 1, high + c) || meets(low, low + c - 1))) return id;
  if (c < 0 && (meets(low + c, low - 1) || meets(high + c + 1, high))) return id;
  addend = c;
  return variable;
}

// The index, counted from 0.
void BodyWriter::indexValue(ExprId id, const types::Dimension& dimension) {
  const Expr& whole = expr(id);
  if (whole.kind == ExprKind::Const) {
    appendSigned(out_, static_cast<int64_t>(ir::bitsOf(whole)) - dimension.low);
    return;
  }
  int64_t addend;
  const ExprId inner = peelIndex(id, dimension, addend);
  const TypeKind kind = kindOf(inner);
  const uint32_t width = widthOf(kind);
  const int64_t offset = addend - dimension.low;
  const Slot slot = slotOf(inner);
  const Variable* of = expr(inner).kind == ExprKind::Bits ? nullptr : variableOf(slot);
  const bool is_wide = of != nullptr && of->wide == 64;
  auto writeInner = [&](Prec context) {
    if (is_wide) {
      place(inner);
    } else {
      value(inner, context);
    }
  };
  if (offset == 0) {
    writeInner(Prec::Comma);
    return;
  }
  if (width == 64) {
    out_ += "(int64_t)((uint64_t)";
    value(inner, Prec::Unary);
    out_ += offset < 0 ? " - " : " + ";
    appendUnsigned(out_, offset < 0 ? 0 - static_cast<uint64_t>(offset) : static_cast<uint64_t>(offset));
    out_ += "ULL)";
    return;
  }
  const bool fits_int = width <= 16 && offset > -(1 << 30) && offset < (1 << 30);
  if (!fits_int && !is_wide) out_ += "(int64_t)";
  writeInner(fits_int ? Prec::Sum : Prec::Unary);
  out_ += offset < 0 ? " - " : " + ";
  appendUnsigned(out_, offset < 0 ? 0 - static_cast<uint64_t>(offset) : static_cast<uint64_t>(offset));
}

// ---- the process image

// An area is where it is for the whole call, which g++ cannot know of memory that bytes are stored to.
void BodyWriter::area(uint32_t index) {
  std::string name = "area";
  name += module_.areas[index].letter;
  if ((areas_declared_ >> index & 1) == 0) {
    areas_declared_ |= 1u << index;
    declarations_ += " uint8_t* const " + name + " = ctx->areas[";
    appendUnsigned(declarations_, index);
    declarations_ += "];";
  }
  out_ += name;
}

void BodyWriter::imageAddress(ExprId id) {
  const Expr& e = expr(id);
  if (const auto* image = e.tryAs<ir::ImageExpr>()) {
    area(image->area);
    if (image->byte != 0) {
      out_ += " + ";
      appendUnsigned(out_, image->byte);
    }
    return;
  }
  imageAddress(ir::baseOf(e));
  if (const auto* field = e.tryAs<ir::FieldExpr>()) {
    out_ += " + ";
    appendUnsigned(out_, fieldOf(*field).offset);
    return;
  }
  const ir::IndexExpr& node = e.as<ir::IndexExpr>();
  const TypeInfo& info = types_.info(types_.resolve(expr(node.base).type));
  uint64_t size = types_.info(types_.resolve(e.type)).size;
  for (uint32_t i = node.indices.count; i-- > 0;) {  // row-major: the last index is the fastest
    out_ += " + (";
    indexValue(body_->list(node.indices)[i], info.dimensions[i]);
    out_ += ") * ";
    appendUnsigned(out_, size);
    size *= info.dimensions[i].count();
  }
}

void BodyWriter::imageLoad(ExprId id, const Expr& e) {
  const TypeKind kind = types_.plainKind(e.type);
  if (const auto* bits = e.tryAs<ir::BitsExpr>()) {
    const TypeKind whole = kindOf(bits->base);
    const uint32_t width = widthOf(kind), shift = bits->position * width;
    const bool is_signed = types_.isSigned(whole);
    out_ += kind == TypeKind::Bool ? "(" : width == 8 ? "(uint8_t)(" : width == 16 ? "(uint16_t)(" : "(uint32_t)(";
    if (is_signed) {
      const uint32_t from = widthOf(whole);
      out_ += from == 8 ? "(uint8_t)" : from == 16 ? "(uint16_t)" : from == 32 ? "(uint32_t)" : "(uint64_t)";
    }
    value(bits->base, Prec::Unary);
    if (shift != 0) {
      out_ += " >> ";
      appendUnsigned(out_, shift);
    }
    out_ += kind == TypeKind::Bool ? " & 1)" : ")";
    return;
  }
  if (isAggregate(e.type)) {
    place(id);
    return;
  }
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    out_ += '(';
    area(image.area);
    out_ += '[';
    appendUnsigned(out_, image.byte);
    out_ += "] >> ";
    appendUnsigned(out_, image.bit);
    out_ += " & 1)";
    return;
  }
  const uint32_t width = kind == TypeKind::Bool ? 8 : widthOf(kind);
  if (kind == TypeKind::Real || kind == TypeKind::LReal) {
    out_ += kind == TypeKind::Real ? "rung_f32_of(rung_get32(" : "rung_f64_of(rung_get64(";
    imageAddress(id);
    out_ += "))";
    return;
  }
  if (types_.isSigned(kind)) {
    out_ += '(';
    out_ += scalarType(types_, e.type);
    out_ += ')';
  }
  if (width == 8) {
    out_ += kind == TypeKind::Bool ? "(*(" : "*(";
    imageAddress(id);
    out_ += kind == TypeKind::Bool ? ") != 0)" : ")";
    return;
  }
  out_ += "rung_get";
  appendUnsigned(out_, width);
  out_ += '(';
  imageAddress(id);
  out_ += ')';
}

void BodyWriter::store(ExprId to, std::string_view value_code) {
  const Expr& e = expr(to);
  if (isLvalue(to)) {
    place(to);
    out_ += " = ";
    out_ += value_code;
    return;
  }
  const TypeKind kind = types_.plainKind(e.type);
  if (e.kind == ExprKind::Bits) {
    const ExprId base = e.as<ir::BitsExpr>().base;
    const uint32_t from = widthOf(kindOf(base)), width = widthOf(kind), shift = e.as<ir::BitsExpr>().position * width;
    const std::string type = from == 64 ? "uint64_t" : "uint32_t";
    const uint64_t mask = (width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1) << shift;
    const uint64_t keep = ~mask & (from >= 64 ? ~uint64_t{0} : (uint64_t{1} << from) - 1);
    std::string changed = "(";
    changed += scalarType(types_, expr(base).type);
    changed += ")(((" + type + ")" + captured([&] { value(base, Prec::Unary); }) + " & ";
    appendUnsigned(changed, keep);
    changed += from == 64 ? "ULL) | (" : "u) | (";
    changed += type + ")(";
    changed += value_code;
    changed += ")";
    if (shift != 0) {
      changed += " << ";
      appendUnsigned(changed, shift);
    }
    changed += ")";
    store(base, changed);
    return;
  }
  if (ir::isImageBit(e)) {
    out_ += "rung_put_bit(";
    imageAddress(to);
    out_ += ", ";
    appendUnsigned(out_, e.as<ir::ImageExpr>().bit);
    out_ += ", ";
    out_ += value_code;
    out_ += ')';
    return;
  }
  const uint32_t width = kind == TypeKind::Bool ? 8 : widthOf(kind);
  if (width == 8) {
    out_ += "*(";
    imageAddress(to);
    out_ += ") = (uint8_t)(";
    out_ += value_code;
    out_ += ')';
    return;
  }
  out_ += "rung_put";
  appendUnsigned(out_, width);
  out_ += '(';
  imageAddress(to);
  out_ += kind == TypeKind::Real    ? ", rung_bits_of_f32("
          : kind == TypeKind::LReal ? ", rung_bits_of_f64("
          : width == 16             ? ", (uint16_t)("
          : width == 32             ? ", (uint32_t)("
                                    : ", (uint64_t)(";
  out_ += value_code;
  out_ += "))";
}

// ---- by-reference parameters

void BodyWriter::reference(const ir::Local& parameter, bool native, ExprId operand) {
  static_cast<void>(native);
  if (!operand) {  // a discarded output
    const std::string name = newVariable(parameter.type, "d");
    if (!isString(parameter.type)) out_ += '&';
    out_ += name;
    return;
  }
  if (isString(parameter.type)) {
    if (parameter.kind == ir::LocalKind::Input) {
      stringValue(operand);
    } else {
      place(operand);
    }
    return;
  }
  if (const uint32_t* local = ir::localOf(expr(operand)); local != nullptr && body_->locals[*local].by_reference) {
    variable(out_, body_->locals[*local]);
    return;
  }
  out_ += '&';
  place(operand);
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Lvalues in C++: variables, fields, elements, targets of pointers. In: a place of the IR. Out: its C++ as an lvalue,
// as an argument, or as the target of a store. Called by all writers of a body; views of the image are in image.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::Field;
using types::TypeInfo;
using types::TypeTable;

bool PlaceWriter::isImagePlace(ExprId id) const { return expr(ir::rootOf(*body_, id)).kind == ExprKind::Image; }
bool PlaceWriter::isLvalue(ExprId id) const { return expr(id).kind != ExprKind::Bits && !isImagePlace(id); }

// Only generated code writes locals, and it writes 0 or 1.
bool PlaceWriter::isVariableTruth(ExprId id) const {
  const Expr& e = expr(id);
  if (const uint32_t* local = ir::localOf(e))
    return !body_->locals[*local].by_reference && !analysis_->uses.of[*local].exposed;
  return isCached(id);
}

void PlaceWriter::place(ExprId id) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::Local: localPlace(body_->locals[e.as<ir::LocalExpr>().local]); return;
    case ExprKind::Self: out_ += "self"; return;
    case ExprKind::Global: blockPlace(e.type, facts_.list_block[e.as<ir::GlobalExpr>().list], "list_block"); return;
    case ExprKind::Program: blockPlace(e.type, facts_.program_block[e.as<ir::ProgramExpr>().program], "block"); return;
    case ExprKind::Field: fieldPlace(id); return;
    case ExprKind::Index: elementPlace(e.as<ir::IndexExpr>()); return;
    case ExprKind::Deref: targetPlace(e.as<ir::DerefExpr>().pointer, e.type); return;
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
      for (const auto& [created, name] : state_.materialized) {
        if (created == id.index) out_ += name;
      }
      return;
    case ExprKind::Select: {
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      out_ += "(*(";
      values().condition(decides, Prec::Or);
      out_ += " ? &";
      place(yes);
      out_ += " : &";
      place(no);
      out_ += "))";
      return;
    }
    case ExprKind::Image:  // as an aggregate: in place; a string is its characters
      if (isString(e.type)) return strings().stringValue(id);
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
    case ExprKind::Address: values().value(id, Prec::Postfix); return;
  }
}

void PlaceWriter::localPlace(const ir::Local& local) {
  const bool after = local.by_reference && !isString(local.type);
  if (after) out_ += "(*";
  variable(out_, local);
  if (after) out_ += ')';
}

// A block of memory: a list of globals or a program's instance.
void PlaceWriter::blockPlace(TypeId record, uint32_t number, std::string_view suffix) {
  const std::string type = recordName(types_, record);
  includeRecord(record);
  std::string name;
  appendMangled(name, string(facts_.blocks[number].name));
  name += suffix;
  if (std::find(blocks_declared_.begin(), blocks_declared_.end(), number) == blocks_declared_.end()) {
    blocks_declared_.push_back(number);
    declarations_ += " " + type + "& " + name + " = *static_cast<" + type + "*>(ctx->blocks[";
    appendUnsigned(declarations_, number);
    declarations_ += "]);";
  }
  out_ += name;
}

void PlaceWriter::fieldPlace(ExprId id) {
  const ir::FieldExpr& node = expr(id).as<ir::FieldExpr>();
  const Field& field = fieldOf(node);
  if (isCached(id)) {
    appendMangled(out_, string(field.name));
    return;
  }
  const bool after = field.by_reference && !isString(field.type);
  if (after) includeRecord(field.type);
  if (after) out_ += "(*";
  member(node.base);
  appendMangled(out_, string(field.name));
  if (after) out_ += ')';
}

void PlaceWriter::elementPlace(const ir::IndexExpr& node) {
  const TypeInfo& array = types_.info(types_.resolve(expr(node.base).type));
  place(node.base);
  for (uint32_t i = 0; i < node.indices.count; ++i) {
    const types::Dimension dimension = i < array.dimensions.size() ? array.dimensions[i] : types::Dimension{};
    out_ += '[';
    indexValue(body_->list(node.indices)[i], dimension);
    out_ += ']';
  }
}

void PlaceWriter::targetPlace(ExprId pointer, TypeId type) {
  if (isString(type)) {
    out_ += isWide(type) ? "((char16_t*)" : "((char*)";
    values().value(pointer, Prec::Unary);
    out_ += ')';
    return;
  }
  out_ += "(*(";
  if (isAggregate(type)) {
    includeRecord(type);
    const TypeId element = elementOf(types_, type);
    std::string pointer_type;
    appendPointer(pointer_type, types_, type, "");
    // Elements may be read with another type than the one they were written with.
    if (types_.kind(element) != TypeKind::Record && !isString(element)) {
      const std::string scalar = scalarType(types_, element);
      pointer_type.replace(0, scalar.size(), scalarAliasType(types_, element));
    }
    out_ += pointer_type;
  } else {
    out_ += scalarAliasType(types_, type);
    out_ += '*';
  }
  out_ += ')';
  values().value(pointer, Prec::Unary);
  out_ += ')';
}

// Writes the prefix of a field's name.
void PlaceWriter::member(ExprId base) {
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
ir::ExprId PlaceWriter::peelIndex(ExprId id, const types::Dimension& dimension, int64_t& addend) const {
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
void PlaceWriter::indexValue(ExprId id, const types::Dimension& dimension) {
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
  const bool is_wide = expr(inner).kind != ExprKind::Bits && wideOf(inner) == 64;
  auto writeInner = [&](Prec context) {
    if (is_wide) {
      place(inner);
    } else {
      values().value(inner, context);
    }
  };
  if (offset == 0) {
    writeInner(Prec::Comma);
    return;
  }
  if (width == 64) {
    out_ += "(int64_t)((uint64_t)";
    values().value(inner, Prec::Unary);
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

// ---- constant bytes

void PlaceWriter::dataReference(uint32_t index) {
  if (state_.in.marks.data[index] != state_.in.group_number) {
    state_.in.marks.data[index] = state_.in.group_number;
    state_.in.marks.data_number[index] = ++group_.data_count;
    const ir::Data& data = module_.data[index];
    std::string_view bytes(reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size());
    size_t used = bytes.size();
    while (used > 0 && bytes[used - 1] == '\0') --used;
    group_.data += "alignas(8) static const unsigned char data_" + group_.stem + '_';
    appendUnsigned(group_.data, group_.data_count);
    group_.data += '[';
    appendUnsigned(group_.data, bytes.size() + 1);
    group_.data += "] = ";
    appendQuoted(group_.data, bytes.substr(0, used));
    group_.data += ";\n";
  }
  out_ += "data_" + group_.stem + '_';
  appendUnsigned(out_, state_.in.marks.data_number[index]);
}

// ---- writing

void PlaceWriter::store(ExprId to, std::string_view value_code) {
  const Expr& e = expr(to);
  if (isLvalue(to)) {
    place(to);
    out_ += " = ";
    out_ += value_code;
    return;
  }
  if (const auto* bits = e.tryAs<ir::BitsExpr>()) {
    storeBits(*bits, types_.plainKind(e.type), value_code);
    return;
  }
  imageStore(to, value_code);
}

// Some bits of a variable: the others keep their values.
void PlaceWriter::storeBits(const ir::BitsExpr& node, TypeKind kind, std::string_view value_code) {
  const ExprId base = node.base;
  const uint32_t from = widthOf(kindOf(base)), width = widthOf(kind), shift = node.position * width;
  const std::string type = from == 64 ? "uint64_t" : "uint32_t";
  const uint64_t mask = (width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1) << shift;
  const uint64_t keep = ~mask & (from >= 64 ? ~uint64_t{0} : (uint64_t{1} << from) - 1);
  std::string changed = "(";
  changed += scalarType(types_, expr(base).type);
  changed += ")(((" + type + ")" + captured([&] { values().value(base, Prec::Unary); }) + " & ";
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
}

// ---- by-reference parameters

void PlaceWriter::reference(const ir::Local& parameter, ExprId operand) {
  if (!operand) {  // a discarded output
    const std::string name = newVariable(parameter.type, "d");
    if (!isString(parameter.type)) out_ += '&';
    out_ += name;
    return;
  }
  // Only VAR_IN_OUT CONSTANT takes an input, which is const here. A bound in-out and its body do not say that they are.
  const uint32_t* root = ir::isPlace(expr(operand).kind) ? ir::localOf(expr(ir::rootOf(*body_, operand))) : nullptr;
  const bool is_input =
      root != nullptr && body_->locals[*root].by_reference && body_->locals[*root].kind == ir::LocalKind::Input;
  if (is_input && parameter.kind == ir::LocalKind::InOut) {
    out_ += "const_cast<";
    appendPointer(out_, types_, expr(operand).type, "");
    out_ += ">(";
    plainReference(parameter, operand);
    out_ += ')';
    return;
  }
  plainReference(parameter, operand);
}

void PlaceWriter::plainReference(const ir::Local& parameter, ExprId operand) {
  if (isString(parameter.type)) {
    if (parameter.kind == ir::LocalKind::Input) {
      strings().stringValue(operand);
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

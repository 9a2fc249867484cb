// SPDX-License-Identifier: Apache-2.0
// Lvalues in C++: variables, fields, elements, targets of pointers. In: a place of the IR. Out: its C++ as an lvalue,
// as an argument, or as the target of a store. Called by all writers of a body; views of the image are in image.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "codegen/cxx/print.h"
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

cxx::Ex PlaceWriter::place(ExprId id) {
  const Expr& e = expr(id);
  switch (e.kind) {
    case ExprKind::Local: return localPlace(body_->locals[e.as<ir::LocalExpr>().local]);
    case ExprKind::Self: return tree_.fixed("self");
    case ExprKind::Global: return blockPlace(e.type, facts_.list_block[e.as<ir::GlobalExpr>().list], "list_block");
    case ExprKind::Program: return blockPlace(e.type, facts_.program_block[e.as<ir::ProgramExpr>().program], "block");
    case ExprKind::Field: return fieldPlace(id);
    case ExprKind::Index: return elementPlace(e.as<ir::IndexExpr>());
    case ExprKind::Deref: return targetPlace(e.as<ir::DerefExpr>().pointer, e.type);
    case ExprKind::Data: return target(tree_.cast(pointerTo(e.type, true), dataReference(e.as<ir::DataExpr>().index)));
    case ExprKind::Zero:
    case ExprKind::Call:
    case ExprKind::Convert: return materialized(id);
    case ExprKind::Select: {
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      const Ex test = values().condition(decides), first = addressOf(place(yes)), second = addressOf(place(no));
      return target(tree_.choice(test, first, second));
    }
    case ExprKind::Image:  // as an aggregate: in place; a string is its characters
      if (isString(e.type)) return strings().stringValue(id);
      return target(tree_.cast(pointerTo(e.type), tree_.group(imageAddress(id))));
    case ExprKind::Bits:
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::String:
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Address: return values().value(id);
  }
  return nullptr;
}

cxx::Ex PlaceWriter::localPlace(const ir::Local& local) {
  const Ex name = variable(local);
  return local.by_reference && !isString(local.type) ? target(name) : name;
}

// A block of memory: a list of globals or a program's instance.
cxx::Ex PlaceWriter::blockPlace(TypeId record, uint32_t number, std::string_view suffix) {
  const std::string type = recordName(types_, record);
  includeRecord(record);
  std::string name = mangled(facts_.blocks[number].name);
  name += suffix;
  if (std::find(blocks_declared_.begin(), blocks_declared_.end(), number) == blocks_declared_.end()) {
    blocks_declared_.push_back(number);
    const Ex memory = tree_.element(tree_.arrow(tree_.fixed("ctx"), "blocks"), tree_.number(number));
    declare(cxx::Type{tree_.kept(type), "&", {}}, name,
            tree_.prefix("*", tree_.call("static_cast<" + type + "*>", {memory})));
  }
  return tree_.name(name);
}

cxx::Ex PlaceWriter::fieldPlace(ExprId id) {
  const ir::FieldExpr& node = expr(id).as<ir::FieldExpr>();
  const Field& field = fieldOf(node);
  if (isCached(id)) return mangledName(field.name);
  const bool after = field.by_reference && !isString(field.type);
  if (after) includeRecord(field.type);
  const Ex place = member(node.base, field.name);
  return after ? target(place) : place;
}

cxx::Ex PlaceWriter::elementPlace(const ir::IndexExpr& node) {
  const TypeInfo& array = types_.info(types_.resolve(expr(node.base).type));
  Ex result = place(node.base);
  for (uint32_t i = 0; i < node.indices.count; ++i) {
    const types::Dimension dimension = i < array.dimensions.size() ? array.dimensions[i] : types::Dimension{};
    result = tree_.element(result, indexValue(body_->list(node.indices)[i], dimension));
  }
  return result;
}

cxx::Ex PlaceWriter::targetPlace(ExprId pointer, TypeId type) {
  if (isString(type)) return tree_.group(tree_.cast(isWide(type) ? "char16_t*" : "char*", values().value(pointer)));
  std::string pointer_type;
  if (isAggregate(type)) {
    includeRecord(type);
    const TypeId element = elementOf(types_, type);
    pointer_type = pointerTo(type);
    // Elements may be read with another type than the one they were written with.
    if (types_.kind(element) != TypeKind::Record && !isString(element)) {
      const std::string scalar = scalarType(types_, element);
      pointer_type.replace(0, scalar.size(), scalarAliasType(types_, element));
    }
  } else {
    pointer_type = scalarAliasType(types_, type);
    pointer_type += '*';
  }
  return target(tree_.cast(pointer_type, values().value(pointer)));
}

// A field of a record.
cxx::Ex PlaceWriter::member(ExprId base, NameId name) {
  const Expr& e = expr(base);
  if (const uint32_t* local = ir::localOf(e); local != nullptr && body_->locals[*local].by_reference)
    return tree_.arrow(variable(body_->locals[*local]), keptMangled(name));
  if (const auto* part = e.tryAs<ir::FieldExpr>()) {
    const Field& field = fieldOf(*part);
    if (field.by_reference) {
      includeRecord(field.type);
      return tree_.arrow(member(part->base, field.name), keptMangled(name));
    }
  }
  return tree_.member(place(base), keptMangled(name));
}

cxx::Ex PlaceWriter::find(ExprId id) const {
  for (const auto& [created, name] : state_.materialized)
    if (created == id.index) return name;
  return nullptr;
}

cxx::Ex PlaceWriter::materialized(ExprId id) const {
  const Ex name = find(id);
  return name != nullptr ? name : tree_.fixed("");
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
cxx::Ex PlaceWriter::indexValue(ExprId id, const types::Dimension& dimension) {
  const Expr& whole = expr(id);
  if (whole.kind == ExprKind::Const) return tree_.signedNumber(static_cast<int64_t>(ir::bitsOf(whole)) - dimension.low);
  int64_t addend;
  const ExprId inner = peelIndex(id, dimension, addend);
  const uint32_t width = widthOf(kindOf(inner));
  const int64_t offset = addend - dimension.low;
  const bool is_wide = expr(inner).kind != ExprKind::Bits && wideOf(inner) == 64;
  Ex index = is_wide ? place(inner) : values().value(inner);
  if (offset == 0) return index;
  const Operator op = offset < 0 ? Operator::Subtract : Operator::Add;
  const uint64_t distance = offset < 0 ? 0 - static_cast<uint64_t>(offset) : static_cast<uint64_t>(offset);
  if (width == 64) {
    index = tree_.infix(op, tree_.cast("uint64_t", values().value(inner)), tree_.number(distance, "ULL"));
    return tree_.cast("int64_t", index);
  }
  const bool fits_int = width <= 16 && offset > -(1 << 30) && offset < (1 << 30);
  if (!fits_int && !is_wide) index = tree_.cast("int64_t", index);
  return tree_.infix(op, index, tree_.number(distance));
}

// ---- constant bytes

cxx::Ex PlaceWriter::dataReference(uint32_t index) {
  if (state_.in.marks.data[index] != state_.in.group_number) {
    state_.in.marks.data[index] = state_.in.group_number;
    state_.in.marks.data_number[index] = ++group_.data_count;
    const ir::Data& data = module_.data[index];
    std::string_view bytes(reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size());
    size_t used = bytes.size();
    while (used > 0 && bytes[used - 1] == '\0') --used;
    const std::string name = "data_" + group_.stem + '_' + std::to_string(group_.data_count);
    cxx::Variable* const constant = tree_.variable("unsigned char", name, quoted(bytes.substr(0, used)));
    constant->prefix = "alignas(8) static const";
    constant->type.extents = tree_.copy(std::vector<uint64_t>{bytes.size() + 1});
    cxx::print(group_.data, tree_, *constant);
    group_.data += '\n';
  }
  return tree_.name("data_" + group_.stem + '_' + std::to_string(state_.in.marks.data_number[index]));
}

// ---- writing

cxx::Ex PlaceWriter::store(ExprId to, Ex value) {
  const Expr& e = expr(to);
  if (isLvalue(to)) return tree_.infix(Operator::Assign, place(to), value);
  if (const auto* bits = e.tryAs<ir::BitsExpr>()) return storeBits(*bits, types_.plainKind(e.type), value);
  return imageStore(to, value);
}

// Some bits of a variable: the others keep their values.
cxx::Ex PlaceWriter::storeBits(const ir::BitsExpr& node, TypeKind kind, Ex value) {
  const ExprId base = node.base;
  const uint32_t from = widthOf(kindOf(base)), width = widthOf(kind), shift = node.position * width;
  const char* const type = from == 64 ? "uint64_t" : "uint32_t";
  const uint64_t mask = (width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1) << shift;
  const uint64_t keep = ~mask & (from >= 64 ? ~uint64_t{0} : (uint64_t{1} << from) - 1);
  const Ex others = tree_.infix(Operator::BitAnd, tree_.cast(type, values().value(base)),
                                tree_.number(keep, from == 64 ? "ULL" : "u"));
  Ex bits = tree_.cast(type, tree_.group(value));
  if (shift != 0) bits = tree_.infix(Operator::ShiftLeft, bits, tree_.number(shift));
  return store(base, tree_.cast(scalarType(types_, expr(base).type), tree_.infix(Operator::Merge, others, bits)));
}

// ---- by-reference parameters

cxx::Ex PlaceWriter::reference(const ir::Local& parameter, ExprId operand) {
  if (!operand) {  // a discarded output
    const Ex name = newVariable(parameter.type, "d");
    return isString(parameter.type) ? name : addressOf(name);
  }
  // Only VAR_IN_OUT CONSTANT takes an input, which is const here. A bound in-out and its body do not say that they are.
  const uint32_t* root = ir::isPlace(expr(operand).kind) ? ir::localOf(expr(ir::rootOf(*body_, operand))) : nullptr;
  const bool is_input =
      root != nullptr && body_->locals[*root].by_reference && body_->locals[*root].kind == ir::LocalKind::Input;
  const Ex plain = plainReference(parameter, operand);
  const bool drops_const = is_input && parameter.kind == ir::LocalKind::InOut;
  return drops_const ? tree_.call("const_cast<" + pointerTo(expr(operand).type) + ">", {plain}) : plain;
}

cxx::Ex PlaceWriter::plainReference(const ir::Local& parameter, ExprId operand) {
  if (isString(parameter.type))
    return parameter.kind == ir::LocalKind::Input ? strings().stringValue(operand) : place(operand);
  if (const uint32_t* local = ir::localOf(expr(operand)); local != nullptr && body_->locals[*local].by_reference)
    return variable(body_->locals[*local]);
  return addressOf(place(operand));
}

}  // namespace rung::codegen

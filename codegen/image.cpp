// SPDX-License-Identifier: Apache-2.0
// Views of the process image in C++: little-endian bytes at any address, therefore read and written by the helpers of
// rung/code.h. In: a place whose root is an area. Out: its address, its value, or a store, as C++ (cxx/nodes.h). Called
// by places.cpp and expressions.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::TypeInfo;

// An area is where it is for the whole call, which g++ cannot know of memory that bytes are stored to.
cxx::Ex PlaceWriter::area(uint32_t index) {
  std::string name = "area";
  name += module_.areas[index].letter;
  if ((areas_declared_ >> index & 1) == 0) {
    areas_declared_ |= 1u << index;
    declare("uint8_t* const", name, tree_.element(tree_.arrow(tree_.fixed("ctx"), "areas"), tree_.number(index)));
  }
  return tree_.name(name);
}

cxx::Ex PlaceWriter::imageAddress(ExprId id) {
  const Expr& e = expr(id);
  if (const auto* image = e.tryAs<ir::ImageExpr>()) {
    const Ex begin = area(image->area);
    return image->byte != 0 ? tree_.infix(Operator::Add, begin, tree_.number(image->byte)) : begin;
  }
  Ex address = imageAddress(ir::baseOf(e));
  if (const auto* field = e.tryAs<ir::FieldExpr>())
    return tree_.infix(Operator::Add, address, tree_.number(fieldOf(*field).offset));
  const ir::IndexExpr& node = e.as<ir::IndexExpr>();
  const TypeInfo& info = types_.info(types_.resolve(expr(node.base).type));
  uint64_t size = types_.info(types_.resolve(e.type)).size;
  for (uint32_t i = node.indices.count; i-- > 0;) {  // row-major: the last index is the fastest
    const Ex index = tree_.group(indexValue(body_->list(node.indices)[i], info.dimensions[i]));
    address = tree_.infix(Operator::Add, address, tree_.infix(Operator::Multiply, index, tree_.number(size)));
    size *= info.dimensions[i].count();
  }
  return address;
}

cxx::Ex PlaceWriter::imageLoad(ExprId id, const Expr& e) {
  const TypeKind kind = types_.plainKind(e.type);
  if (isAggregate(e.type)) return place(id);
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    const Ex shifted = tree_.infix(Operator::ShiftRight, imageByte(image), tree_.number(image.bit));
    return tree_.group(tree_.infix(Operator::Mask, shifted, tree_.number(1)));
  }
  const uint32_t width = kind == TypeKind::Bool ? 8 : widthOf(kind);
  const Ex address = imageAddress(id);
  if (kind == TypeKind::Real) return tree_.call("rung_f32_of", {tree_.call("rung_get32", {address})});
  if (kind == TypeKind::LReal) return tree_.call("rung_f64_of", {tree_.call("rung_get64", {address})});
  const Ex bits =
      width == 8 ? tree_.prefix("*", tree_.group(address)) : tree_.call("rung_get" + std::to_string(width), {address});
  if (kind == TypeKind::Bool) return tree_.group(tree_.infix(Operator::Differs, bits, tree_.number(0)));
  return types_.isSigned(kind) ? tree_.cast(scalarType(types_, e.type), bits) : bits;
}

// The byte of a bit, where it is now.
cxx::Ex PlaceWriter::imageByte(const ir::ImageExpr& image) {
  const Held* held = heldFor(image);
  return held != nullptr ? held->name : memoryByte(image.area, image.byte);
}

cxx::Ex PlaceWriter::memoryByte(uint32_t area_index, uint32_t byte) {
  return tree_.element(area(area_index), tree_.number(byte));
}

PlaceWriter::Held* PlaceWriter::heldFor(const ir::ImageExpr& image) {
  for (Held& held : held_)
    if (held.byte->area == image.area && held.byte->byte == image.byte) return &held;
  return nullptr;
}

// The bytes are in the order of the text, so only the next one may begin here.
bool PlaceWriter::holdsBytesFrom(StmtId id) const {
  return held_begun_ < analysis_->held.size() && analysis_->held[held_begun_].first == id;
}

void PlaceWriter::holdBytes(StmtId id) {
  const HeldBytes& all = analysis_->held;
  for (; holdsBytesFrom(id); ++held_begun_) {
    const HeldByte& byte = all[held_begun_];
    const std::string name = newName("held");
    declare("uint32_t", name);
    Ex bits = byte.cleared == 0xFF ? tree_.number(0) : memoryByte(byte.area, byte.byte);
    if (byte.cleared != 0xFF && byte.cleared != 0)
      bits = tree_.infix(Operator::BitAnd, bits, tree_.number(0xFF & ~byte.cleared));
    held_.push_back({&byte, tree_.name(name), byte.cleared});
    assign(held_.back().name, bits);
  }
}

bool PlaceWriter::releasesBytes(StmtId id) const {
  return std::any_of(held_.begin(), held_.end(), [&](const Held& held) { return held.byte->last == id; });
}

void PlaceWriter::releaseBytes(StmtId id) {
  std::erase_if(held_, [&](const Held& held) {
    if (held.byte->last != id) return false;
    assign(memoryByte(held.byte->area, held.byte->byte), tree_.cast("uint8_t", held.name));
    return true;
  });
}

cxx::Ex PlaceWriter::storeBit(ExprId to, ExprId from) {
  const ir::ImageExpr& image = expr(to).as<ir::ImageExpr>();
  return putBit(image, values().bitAt(from, image.bit));
}

// `value_bits`: the bit at its place, and no other.
cxx::Ex PlaceWriter::putBit(const ir::ImageExpr& image, Ex value_bits) {
  Held* const held = heldFor(image);
  const uint32_t bit = 1u << image.bit;
  if (held != nullptr && (held->cleared & bit) != 0) {
    held->cleared &= static_cast<uint8_t>(~bit);
    return tree_.infix(Operator::AssignOr, held->name, value_bits);
  }
  const Ex byte = imageByte(image), others = tree_.infix(Operator::BitAnd, byte, tree_.number(0xFF & ~bit));
  const Ex joined = tree_.infix(Operator::BitOr, others, tree_.group(value_bits));
  return tree_.infix(Operator::Assign, byte, held == nullptr ? tree_.cast("uint8_t", joined) : joined);
}

cxx::Ex PlaceWriter::imageStore(ExprId to, Ex value) {
  const Expr& e = expr(to);
  const TypeKind kind = types_.plainKind(e.type);
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    return putBit(image, tree_.call("rung_bit", {value, tree_.number(image.bit)}));
  }
  const uint32_t width = kind == TypeKind::Bool ? 8 : widthOf(kind);
  const Ex address = imageAddress(to);
  if (width == 8) {
    return tree_.infix(Operator::Assign, tree_.prefix("*", tree_.group(address)),
                       tree_.cast("uint8_t", tree_.group(value)));
  }
  const std::string bits = std::to_string(width);
  const Ex stored = kind == TypeKind::Real    ? tree_.call("rung_bits_of_f32", {value})
                    : kind == TypeKind::LReal ? tree_.call("rung_bits_of_f64", {value})
                                              : tree_.cast("uint" + bits + "_t", tree_.group(value));
  return tree_.call("rung_put" + bits, {address, stored});
}

}  // namespace rung::codegen

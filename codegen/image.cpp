// SPDX-License-Identifier: Apache-2.0
// Views of the process image in C++: little-endian bytes at any address, therefore read and written by the helpers of
// rung/code.h. In: a place whose root is an area. Out: its address, its value, or a store. Called by places.cpp and
// expressions.cpp.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::TypeInfo;

// An area is where it is for the whole call, which g++ cannot know of memory that bytes are stored to.
void PlaceWriter::area(uint32_t index) {
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

void PlaceWriter::imageAddress(ExprId id) {
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

void PlaceWriter::imageLoad(ExprId id, const Expr& e) {
  const TypeKind kind = types_.plainKind(e.type);
  if (isAggregate(e.type)) {
    place(id);
    return;
  }
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    out_ += '(';
    imageByte(image);
    out_ += " >> ";
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

// The byte of a bit, where it is now.
void PlaceWriter::imageByte(const ir::ImageExpr& image) {
  const Held* held = heldFor(image);
  if (held != nullptr) {
    out_ += held->name;
  } else {
    memoryByte(image.area, image.byte);
  }
}

void PlaceWriter::memoryByte(uint32_t area_index, uint32_t byte) {
  area(area_index);
  out_ += '[';
  appendUnsigned(out_, byte);
  out_ += ']';
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
    declarations_ += " uint32_t " + name + ";";
    out_ += name + " = ";
    if (byte.cleared == 0xFF) {
      out_ += '0';
    } else {
      memoryByte(byte.area, byte.byte);
      if (byte.cleared != 0) out_ += " & " + std::to_string(0xFF & ~byte.cleared);
    }
    out_ += "; ";
    held_.push_back({&byte, name, byte.cleared});
  }
}

bool PlaceWriter::releasesBytes(StmtId id) const {
  return std::any_of(held_.begin(), held_.end(), [&](const Held& held) { return held.byte->last == id; });
}

void PlaceWriter::releaseBytes(StmtId id) {
  std::erase_if(held_, [&](const Held& held) {
    if (held.byte->last != id) return false;
    out_ += ' ';
    memoryByte(held.byte->area, held.byte->byte);
    out_ += " = (uint8_t)" + held.name + ";";
    return true;
  });
}

void PlaceWriter::storeBit(ExprId to, ExprId from) {
  const ir::ImageExpr& image = expr(to).as<ir::ImageExpr>();
  putBit(image, captured([&] { values().bitAt(from, image.bit, Prec::Bit); }));
}

// `value_bits`: the bit at its place, and no other.
void PlaceWriter::putBit(const ir::ImageExpr& image, std::string_view value_bits) {
  Held* const held = heldFor(image);
  const uint32_t bit = 1u << image.bit;
  if (held != nullptr && (held->cleared & bit) != 0) {
    held->cleared &= static_cast<uint8_t>(~bit);
    out_ += held->name + " |= ";
    out_ += value_bits;
    return;
  }
  const std::string byte = captured([&] { imageByte(image); });
  out_ +=
      byte + " = " + (held == nullptr ? "(uint8_t)(" : "") + "(" + byte + " & " + std::to_string(0xFF & ~bit) + ") | (";
  out_ += value_bits;
  out_ += held == nullptr ? "))" : ")";
}

void PlaceWriter::imageStore(ExprId to, std::string_view value_code) {
  const Expr& e = expr(to);
  const TypeKind kind = types_.plainKind(e.type);
  if (ir::isImageBit(e)) {
    const ir::ImageExpr& image = e.as<ir::ImageExpr>();
    putBit(image, "rung_bit(" + std::string(value_code) + ", " + std::to_string(image.bit) + ")");
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

}  // namespace rung::codegen

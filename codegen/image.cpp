// Views of the process image in C++: little-endian bytes at any address, therefore read and written by the helpers of
// rung/code.h. In: a place whose root is an area. Out: its address, its value, or a store. Called by places.cpp and
// expressions.cpp.
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

void PlaceWriter::imageStore(ExprId to, std::string_view value_code) {
  const Expr& e = expr(to);
  const TypeKind kind = types_.plainKind(e.type);
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

}  // namespace rung::codegen

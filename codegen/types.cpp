// SPDX-License-Identifier: Apache-2.0
// C++ names of types, constants and record definitions: see types.h.
#include "codegen/types.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "codegen/cxx/print.h"
#include "codegen/names.h"

namespace rung::codegen {

using types::Field;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

enum Representation {
  kI8,
  kI16,
  kI32,
  kI64,
  kU8,
  kU16,
  kU32,
  kU64,
  kF32,
  kF64,
  kPointer,
  kString,
  kWideString,
  kOther
};
constexpr const char* kPlainNames[] = {"int8_t",   "int16_t", "int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t",
                                       "uint64_t", "float",   "double",  "void*",   "char",    "char16_t", "void"};
constexpr const char* kAliasNames[] = {"rung_i8_at",      "rung_i16_at", "rung_i32_at", "rung_i64_at", "rung_u8_at",
                                       "rung_u16_at",     "rung_u32_at", "rung_u64_at", "rung_f32_at", "rung_f64_at",
                                       "rung_pointer_at", "char",        "char16_t",    "void"};

Representation representationOf(const TypeTable& types, TypeId type) {
  const TypeKind kind = types.plainKind(type);
  if (kind == TypeKind::Real) return kF32;
  if (kind == TypeKind::LReal) return kF64;
  if (kind == TypeKind::Pointer || kind == TypeKind::Reference) return kPointer;
  if (kind == TypeKind::String || kind == TypeKind::UString) return kString;
  if (kind == TypeKind::WString) return kWideString;
  const bool is_signed = types.isSigned(kind);
  switch (TypeTable::bitWidth(kind)) {
    case 1:
    case 8: return is_signed ? kI8 : kU8;
    case 16: return is_signed ? kI16 : kU16;
    case 32: return is_signed ? kI32 : kU32;
    case 64: return is_signed ? kI64 : kU64;
    default: return kOther;
  }
}

std::vector<uint64_t> extentsOf(const TypeTable& types, TypeId type) {
  std::vector<uint64_t> extents;
  for (;;) {
    const TypeInfo& info = types.info(types.resolve(type));
    if (info.kind == TypeKind::Array) {
      for (const types::Dimension& dimension : info.dimensions)
        extents.push_back(std::max<uint64_t>(dimension.count(), 1));  // C++ has no array without elements
      if (info.dimensions.empty()) extents.push_back(1);              // ARRAY[*]: the caller knows its bounds
      type = info.base;
      continue;
    }
    if (TypeTable::isString(info.kind)) extents.push_back(uint64_t{info.length} + 1);
    return extents;
  }
}

std::string_view baseOf(cxx::Tree& tree, const TypeTable& types, TypeId type) {
  const TypeId element = elementOf(types, type);
  if (types.kind(element) == TypeKind::Record) return tree.kept(recordType(types, element));
  return scalarType(types, element);
}

bool isEightBytes(const TypeTable& types, TypeId type) {
  const TypeKind kind = types.plainKind(elementOf(types, type));
  return TypeTable::isScalar(kind) && TypeTable::bitWidth(kind) == 64;
}

template <class Float>
void appendReal(std::string& out, Float value, const char* suffix) {
  if (std::isnan(value)) {
    out += sizeof value == 4 ? "__builtin_nanf(\"\")" : "__builtin_nan(\"\")";
    return;
  }
  if (std::isinf(value)) {
    if (value < 0) out += '-';
    out += sizeof value == 4 ? "__builtin_inff()" : "__builtin_inf()";
    return;
  }
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  out.append(buffer, end);
  if (std::memchr(buffer, '.', static_cast<size_t>(end - buffer)) == nullptr &&
      std::memchr(buffer, 'e', static_cast<size_t>(end - buffer)) == nullptr) {
    out += ".0";
  }
  out += suffix;
}

}  // namespace

const char* scalarType(const TypeTable& types, TypeId type) { return kPlainNames[representationOf(types, type)]; }
const char* scalarAliasType(const TypeTable& types, TypeId type) { return kAliasNames[representationOf(types, type)]; }

const char* typeKindName(const TypeTable& types, TypeId type) {
  static constexpr const char* kHostKinds[] = {
#define RUNG_KIND(kind, category, bits, class_number, host) host,
#include "sema/types/kinds.def"
  };
  return kHostKinds[static_cast<uint8_t>(types.plainKind(type))];
}

TypeId elementOf(const TypeTable& types, TypeId type) {
  for (;;) {
    type = types.resolve(type);
    if (types.info(type).kind != TypeKind::Array) return type;
    type = types.info(type).base;
  }
}

std::string recordName(const TypeTable& types, TypeId type) {
  const TypeInfo& info = types.info(types.resolve(type));
  std::string name;
  appendMangled(name, types.names().string(info.name));
  return name += info.record_kind == RecordKind::GlobalList ? "list" : "type";
}

std::string recordFile(const TypeTable& types, TypeId type) {
  const TypeInfo& info = types.info(types.resolve(type));
  std::string name = fileStem(types.names().string(info.name));
  return name += info.record_kind == RecordKind::GlobalList ? "list.h" : ".h";
}

std::string recordType(const TypeTable& types, TypeId type) {
  const TypeInfo& info = types.info(types.resolve(type));
  return (info.record_kind == RecordKind::Union ? "union " : "struct ") + recordName(types, type);
}

cxx::Namespace* hiddenNamespace(cxx::Tree& tree, std::string_view name) {
  cxx::Namespace* const made = tree.declaration<cxx::Namespace>();
  made->name = tree.kept(name);
  made->attributes = "RUNG_HIDDEN";
  return made;
}

std::string className(const TypeTable& types, TypeId record) {
  std::string name;
  appendMangled(name, types.names().string(types.info(types.resolve(record)).name));
  return name += "class";
}

std::string methodName(const ir::Module& module, ir::BodyId method, const char* what) {
  std::string name;
  appendMangled(name, module.names.string(module.body(method).name));
  return name += what;
}

void appendFunctionName(std::string& out, const ir::Module& module, const ir::Body& body) {
  const TypeTable& types = module.types;
  switch (body.kind) {
    case ir::BodyKind::Function:
      appendMangled(out, module.names.string(body.name));
      out += "fn";
      return;
    case ir::BodyKind::Block:
      appendMangled(out, module.names.string(body.name));
      out += "body";
      return;
    case ir::BodyKind::Init:
      appendMangled(out, module.names.string(body.name));
      // A list may have the name of a POU.
      if (types.info(types.resolve(body.self)).record_kind == RecordKind::GlobalList) out += "list_";
      out += "init";
      return;
  }
}

cxx::Type valueType(cxx::Tree& tree, const TypeTable& types, TypeId type) {
  return {baseOf(tree, types, type), {}, tree.copy(extentsOf(types, type))};
}

cxx::Type pointerType(cxx::Tree& tree, const TypeTable& types, TypeId type, bool constant) {
  const std::string_view base = baseOf(tree, types, type);
  cxx::Type made{constant ? tree.kept(constantOf(std::string(base))) : base, "*", {}};
  if (types.kind(type) == TypeKind::Array) made.extents = tree.copy(extentsOf(types, type));
  return made;
}

void appendDeclaration(std::string& out, const TypeTable& types, TypeId type, std::string_view name) {
  cxx::Tree tree;
  cxx::print(out, valueType(tree, types, type), name);
}

std::string constantOf(const std::string& type) { return type.back() == '*' ? type + " const" : "const " + type; }

void appendConstant(std::string& out, const TypeTable& types, TypeId type, uint64_t bits) {
  const Representation representation = representationOf(types, type);
  if (types.plainKind(type) == TypeKind::Bool) {
    out += bits != 0 ? "true" : "false";
    return;
  }
  double real;
  std::memcpy(&real, &bits, sizeof real);
  switch (representation) {
    case kF32: appendReal(out, static_cast<float>(real), "f"); return;
    case kF64: appendReal(out, real, ""); return;
    case kPointer:
      if (bits == 0) {
        out += "nullptr";
      } else {
        out += "(void*)";
        appendUnsigned(out, bits);
        out += "u";
      }
      return;
    case kI8:
    case kI16:
    case kU8:
    case kU16: appendSigned(out, static_cast<int64_t>(bits)); return;
    case kI32:
      if (static_cast<int64_t>(bits) == INT32_MIN) {
        out += "INT32_MIN";
      } else {
        appendSigned(out, static_cast<int64_t>(bits));
      }
      return;
    case kI64:
      if (static_cast<int64_t>(bits) == INT64_MIN) {
        out += "INT64_MIN";
      } else {
        appendSigned(out, static_cast<int64_t>(bits));
        out += "LL";
      }
      return;
    case kU32:
      appendUnsigned(out, bits);
      out += 'u';
      return;
    case kU64:
      appendUnsigned(out, bits);
      out += "ULL";
      return;
    case kString:
    case kWideString:
    case kOther: out += '0'; return;
  }
}

namespace {

// The alignment that C++ gives a variable of the type.
uint32_t cppAlign(const TypeTable& types, const Field& field) {
  if (field.by_reference) return types.pointerSize();
  const TypeInfo& info = types.info(types.resolve(elementOf(types, field.type)));
  return info.kind == TypeKind::Record ? info.placed_align : info.align;
}

}  // namespace

RecordPlacement placementOf(const TypeTable& types, TypeId type) {
  const TypeInfo& info = types.info(types.resolve(type));
  const bool is_union = info.record_kind == RecordKind::Union;
  RecordPlacement placement;
  uint64_t end = 0;
  for (const Field& field : info.fields) {
    MemberPlacement& member = placement.members.emplace_back();
    const uint32_t align = std::min(types.fieldAlign(field), info.placed_align), own = cppAlign(types, field);
    if (own > align) {
      member.after =
          align == 1 ? " __attribute__((packed))" : " __attribute__((packed, aligned(" + std::to_string(align) + ")))";
    } else if (own < align || (align == 8 && isEightBytes(types, field.type) && !field.by_reference)) {
      member.before = "alignas(" + std::to_string(align) + ")";
    }
    const uint64_t size = field.by_reference ? types.pointerSize() : types.info(types.resolve(field.type)).size;
    const uint64_t at = (end + align - 1) / align * align;
    if (!is_union && at != field.offset) member.gap = static_cast<uint32_t>(field.offset - end);
    end = is_union ? std::max(end, field.offset + size) : field.offset + size;
  }
  const uint64_t size = (end + info.placed_align - 1) / info.placed_align * info.placed_align;
  if (end != 0 && size != info.size) placement.gap = static_cast<uint32_t>(info.size - (is_union ? 0 : end));
  return placement;
}

cxx::Record* recordDefinition(cxx::Tree& tree, const TypeTable& types, TypeId type, bool pointed) {
  const TypeInfo& info = types.info(types.resolve(type));
  const RecordPlacement placement = placementOf(types, type);
  cxx::Record* const record = tree.declaration<cxx::Record>();
  record->keyword = info.record_kind == RecordKind::Union ? "union" : "struct";
  record->attributes = pointed ? "RUNG_MAY_ALIAS" : "";
  record->name = tree.kept(recordName(types, type));
  const auto gap = [&](uint64_t bytes, size_t number) {
    cxx::Variable* const made = tree.variable("uint8_t", "gap" + std::to_string(number));
    made->type.extents = tree.copy(std::vector<uint64_t>{bytes});
    return made;
  };
  std::string name;
  for (size_t i = 0; i < info.fields.size(); ++i) {
    const Field& field = info.fields[i];
    const MemberPlacement& placed = placement.members[i];
    name.clear();
    appendMangled(name, types.names().string(field.name));
    if (placed.gap != 0) record->members.add(gap(placed.gap, i));
    cxx::Variable* const member = tree.variable(
        field.by_reference ? pointerType(tree, types, field.type) : valueType(tree, types, field.type), name);
    member->prefix = tree.kept(placed.before);
    member->suffix = tree.kept(placed.after);
    if (info.record_kind != RecordKind::Union || field.given_offset == 0) {
      record->members.add(member);
      continue;
    }
    cxx::Record* const overlay = tree.declaration<cxx::Record>();  // STRUCT OVERLAP: after a gap
    overlay->keyword = "struct";
    overlay->is_line = true;
    overlay->members.add(gap(field.given_offset, i));
    overlay->members.add(member);
    record->members.add(overlay);
  }
  if (placement.gap != 0) record->members.add(gap(placement.gap, info.fields.size()));
  return record;
}

cxx::Assertion* layoutAssertion(cxx::Tree& tree, const TypeTable& types, TypeId type) {
  constexpr size_t kAsserted = 16;
  const TypeInfo& info = types.info(types.resolve(type));
  const cxx::Ex name = tree.name(recordName(types, type));
  const auto is = [&](cxx::Ex what, uint64_t bytes) { return tree.infix(cxx::Op::Equal, what, tree.number(bytes)); };
  cxx::Assertion* const assertion = tree.declaration<cxx::Assertion>();
  assertion->text = "layout";
  assertion->condition = is(tree.call("sizeof", {name}), info.size);
  const size_t step = info.fields.size() / kAsserted + 1;
  for (size_t i = 0; i < info.fields.size(); ++i) {
    if (info.fields[i].offset == 0 || (i % step != 0 && i + 1 != info.fields.size())) continue;
    std::string field;
    appendMangled(field, types.names().string(info.fields[i].name));
    const cxx::Ex offset = tree.call("offsetof", {name, tree.name(field)});
    assertion->condition = tree.infix(cxx::Op::And, assertion->condition, is(offset, info.fields[i].offset));
  }
  return assertion;
}

}  // namespace rung::codegen

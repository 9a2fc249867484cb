// SPDX-License-Identifier: Apache-2.0
// The type table: elementary types by name, interned structural types, named types (layout.cpp lays them out).
#include "sema/types/types.h"

#include "frontend/source/invariant.h"

namespace rung::types {

namespace {

struct ElementaryName {
  const char* name;
  TypeKind kind;
};
// Messages use the first name of a kind.
constexpr ElementaryName kElementaryNames[] = {
    {"BOOL", TypeKind::Bool},
    {"BYTE", TypeKind::Byte},
    {"WORD", TypeKind::Word},
    {"DWORD", TypeKind::DWord},
    {"LWORD", TypeKind::LWord},
    {"SINT", TypeKind::SInt},
    {"INT", TypeKind::Int},
    {"DINT", TypeKind::DInt},
    {"LINT", TypeKind::LInt},
    {"USINT", TypeKind::USInt},
    {"UINT", TypeKind::UInt},
    {"UDINT", TypeKind::UDInt},
    {"ULINT", TypeKind::ULInt},
    {"REAL", TypeKind::Real},
    {"LREAL", TypeKind::LReal},
    {"TIME", TypeKind::Time},
    {"LTIME", TypeKind::LTime},
    {"DATE", TypeKind::Date},
    {"LDATE", TypeKind::LDate},
    {"TIME_OF_DAY", TypeKind::TimeOfDay},
    {"TOD", TypeKind::TimeOfDay},
    {"LTIME_OF_DAY", TypeKind::LTimeOfDay},
    {"LTOD", TypeKind::LTimeOfDay},
    {"DATE_AND_TIME", TypeKind::DateTime},
    {"DT", TypeKind::DateTime},
    {"LDATE_AND_TIME", TypeKind::LDateTime},
    {"LDT", TypeKind::LDateTime},
    {"CHAR", TypeKind::Char},
    {"WCHAR", TypeKind::WChar},
    {"UCHAR", TypeKind::UChar},
    {"STRING", TypeKind::String},
    {"WSTRING", TypeKind::WString},
    {"USTRING", TypeKind::UString},
    {"ANY", TypeKind::Any},
    {"ANY_ELEMENTARY", TypeKind::AnyElementary},
    {"ANY_MAGNITUDE", TypeKind::AnyMagnitude},
    {"ANY_NUM", TypeKind::AnyNum},
    {"ANY_REAL", TypeKind::AnyReal},
    {"ANY_INT", TypeKind::AnyInt},
    {"ANY_UNSIGNED", TypeKind::AnyUnsigned},
    {"ANY_SIGNED", TypeKind::AnySigned},
    {"ANY_DURATION", TypeKind::AnyDuration},
    {"ANY_BIT", TypeKind::AnyBit},
    {"ANY_CHARS", TypeKind::AnyChars},
    {"ANY_STRING", TypeKind::AnyString},
    {"ANY_CHAR", TypeKind::AnyChar},
    {"ANY_DATE", TypeKind::AnyDate},
    {"ANY_DERIVED", TypeKind::AnyDerived},
};
constexpr uint32_t kDefaultLength = 80;

// A string is laid out from the start, like a scalar: lowering adds more of them when all layouts are known.
void setLength(TypeInfo& info, uint32_t length) {
  const uint32_t unit = info.kind == TypeKind::WString ? 2 : 1;
  info.length = length;
  info.size = (uint64_t{length} + 1) * unit;
  info.align = info.least_align = unit;
  info.laid_out = true;
}

uint64_t internKey(TypeKind kind, uint64_t value) { return static_cast<uint64_t>(kind) << 56 ^ value; }

}  // namespace

TypeTable::TypeTable(Names& names, uint32_t pointer_size) : names_(names), pointer_size_(pointer_size) {
  for (uint32_t i = 0; i < static_cast<uint32_t>(TypeKind::Count_); ++i) {
    TypeInfo info;
    info.kind = static_cast<TypeKind>(i);
    if (isScalar(info.kind)) {
      info.size = (bitWidth(info.kind) + 7) / 8;
      info.align = static_cast<uint32_t>(info.size);
      info.laid_out = true;
    } else if (isString(info.kind)) {
      setLength(info, kDefaultLength);
    }
    types_.add(std::move(info));
  }
  for (const ElementaryName& row : kElementaryNames) {
    const NameId name = names.intern(row.name);
    elementary_.emplace(names.key(name).index, idOf(row.kind));
    TypeInfo& info = types_[static_cast<uint32_t>(row.kind)];
    if (!info.name) info.name = name;
  }
  // CODESYS's names for numbers as wide as an address.
  const auto native = [&](const char* name, TypeKind wide, TypeKind narrow) {
    elementary_.emplace(names.key(names.intern(name)).index, idOf(pointer_size == 8 ? wide : narrow));
  };
  native("__XWORD", TypeKind::LWord, TypeKind::DWord);
  native("__XINT", TypeKind::LInt, TypeKind::DInt);
  native("__UXINT", TypeKind::ULInt, TypeKind::UDInt);
  // A string without a length has the same type as one with the default length.
  for (const TypeKind kind : {TypeKind::String, TypeKind::WString, TypeKind::UString})
    interned_.emplace(internKey(kind, kDefaultLength), idOf(kind));
}

TypeKind TypeTable::kindOfNamed(TypeId id) const {
  for (;;) {
    const TypeInfo& info = types_[id.index];
    if (info.kind != TypeKind::Alias) return info.kind;
    id = info.base;
  }
}

TypeId TypeTable::plainOfNamed(TypeId id) const {
  for (;;) {
    const TypeInfo& info = types_[id.index];
    if (info.kind != TypeKind::Alias && info.kind != TypeKind::Subrange && info.kind != TypeKind::Enum) return id;
    id = info.base;
  }
}

TypeId TypeTable::elementary(NameId name) const {
  const auto found = elementary_.find(names_.key(name).index);
  return found == elementary_.end() ? TypeId{} : found->second;
}

namespace {

// A type over another one: its elements, target or base.
TypeInfo infoOver(TypeKind kind, TypeId base, NameId name = {}) {
  TypeInfo info;
  info.kind = kind;
  info.name = name;
  info.base = base;
  return info;
}

}  // namespace

TypeId TypeTable::string(TypeKind kind, uint32_t length) {
  TypeId& id = interned_[internKey(kind, length)];
  if (!id) {
    TypeInfo info;
    info.kind = kind;
    setLength(info, length);
    id = types_.add(std::move(info));
  }
  return id;
}

TypeId TypeTable::array(TypeId element, std::span<const Dimension> dimensions) {
  uint64_t hash = element.index + 0x9e3779b97f4a7c15u;
  for (const Dimension& dimension : dimensions) {
    for (const int64_t bound : {dimension.low, dimension.high}) {
      hash = (hash ^ static_cast<uint64_t>(bound)) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 29;
    }
  }
  for (;; ++hash) {  // skips the key of another array with the same hash
    TypeId& id = interned_[internKey(TypeKind::Array, hash & 0x00ffffffffffffffu)];
    if (id) {
      const TypeInfo& known = types_[id.index];
      bool equal = known.base == element && known.dimensions.size() == dimensions.size();
      for (size_t i = 0; equal && i < dimensions.size(); ++i) {
        equal = known.dimensions[i].low == dimensions[i].low && known.dimensions[i].high == dimensions[i].high;
      }
      if (equal) return id;
      continue;
    }
    TypeInfo info = infoOver(TypeKind::Array, element);
    info.dimensions.assign(dimensions.begin(), dimensions.end());
    return id = types_.add(std::move(info));
  }
}

TypeId TypeTable::openArray(TypeId element, uint32_t dimensions) {
  for (uint64_t key = element.index;; key += uint64_t{1} << 32) {
    TypeId& id = interned_[internKey(TypeKind::Any, key)];
    if (!id) {
      TypeInfo info = infoOver(TypeKind::Array, element);
      info.length = dimensions;
      return id = types_.add(std::move(info));
    }
    if (types_[id.index].length == dimensions) return id;
  }
}

TypeId TypeTable::pointer(TypeId target) {
  TypeId& id = interned_[internKey(TypeKind::Pointer, target.index)];
  if (!id) id = types_.add(infoOver(TypeKind::Pointer, target));
  return id;
}

TypeId TypeTable::reference(TypeId target) {
  TypeId& id = interned_[internKey(TypeKind::Reference, target.index)];
  if (!id) id = types_.add(infoOver(TypeKind::Reference, target));
  return id;
}

TypeId TypeTable::addEnum(NameId name, TypeId base) { return types_.add(infoOver(TypeKind::Enum, base, name)); }

TypeId TypeTable::addSubrange(NameId name, TypeId base, int64_t low, int64_t high) {
  TypeInfo info = infoOver(TypeKind::Subrange, base, name);
  info.low = info.initial = low;
  info.high = high;
  return types_.add(std::move(info));
}

TypeId TypeTable::addAlias(NameId name, TypeId target) { return types_.add(infoOver(TypeKind::Alias, target, name)); }

TypeId TypeTable::addRecord(RecordKind kind, NameId name) {
  TypeInfo info;
  info.kind = TypeKind::Record;
  info.record_kind = kind;
  info.name = name;
  return types_.add(std::move(info));
}

bool TypeTable::isSigned(TypeKind k) const {
  return isSignedInteger(k) || isReal(k) || (k == TypeKind::Time && time_is_signed) ||
         (k == TypeKind::LTime && long_time_is_signed);
}

// The tree of generic types, IEC 61131-3 ed. 3 figure 5.
bool TypeTable::belongsTo(TypeKind kind, TypeKind generic) {
  const bool integer = isInteger(kind);
  const bool magnitude = integer || isReal(kind) || isDuration(kind);
  const bool bits = kind == TypeKind::Bool || isBits(kind);
  const bool chars = isString(kind) || isCharacter(kind);
  if (generic == TypeKind::Any) return kind != TypeKind::None;
  if (generic == TypeKind::AnyElementary) return magnitude || bits || chars || isDate(kind);
  if (generic == TypeKind::AnyMagnitude) return magnitude;
  if (generic == TypeKind::AnyNum) return integer || isReal(kind);
  if (generic == TypeKind::AnyReal) return isReal(kind);
  if (generic == TypeKind::AnyInt) return integer;
  if (generic == TypeKind::AnyUnsigned) return isUnsignedInteger(kind);
  if (generic == TypeKind::AnySigned) return isSignedInteger(kind);
  if (generic == TypeKind::AnyDuration) return isDuration(kind);
  if (generic == TypeKind::AnyBit) return bits;
  if (generic == TypeKind::AnyChars) return chars;
  if (generic == TypeKind::AnyString) return isString(kind);
  if (generic == TypeKind::AnyChar) return isCharacter(kind);
  if (generic == TypeKind::AnyDate) return isDate(kind);
  if (generic == TypeKind::AnyDerived) {
    return kind == TypeKind::Enum || kind == TypeKind::Subrange || kind == TypeKind::Array || kind == TypeKind::Record;
  }
  return false;
}

bool TypeTable::belongsToOrMixes(TypeKind kind, TypeKind generic) {
  if (belongsTo(kind, generic)) return true;
  if (isBits(kind)) {
    return generic == TypeKind::AnyInt || generic == TypeKind::AnyUnsigned || generic == TypeKind::AnyNum ||
           generic == TypeKind::AnyMagnitude;
  }
  return generic == TypeKind::AnyBit && isInteger(kind);
}

}  // namespace rung::types

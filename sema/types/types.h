// SPDX-License-Identifier: Apache-2.0
// Types of the language and their layout in memory. In: types that sema resolves from declarations, or the IR reader.
// Out: TypeIds that sema, IR, code generation and the interpreter share.
// Structural types (arrays, strings, pointers, references) are interned: equal types have equal ids. Named types
// (enumerations, subranges, records, aliases) are one id per declaration.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/source/names.h"
#include "sema/types/type_id.h"

namespace rung::types {

enum class TypeKind : uint8_t {
#define RUNG_KIND(kind, category, bits, class_number, host) kind,
#include "sema/types/kinds.def"
  Count_,
};

enum class TypeCategory : uint8_t {
  None,
  Bool,
  Bits,
  Signed,
  Unsigned,
  Real,
  Duration,
  Date,
  Character,
  String,
  Literal,
  Generic,
  Derived,
  Pointer
};

// The columns of kinds.def.
struct KindRow {
  TypeCategory category;
  uint8_t bits, class_number;
};
inline constexpr KindRow kKindRows[] = {
#define RUNG_KIND(kind, category, bits, class_number, host) {TypeCategory::category, bits, class_number},
#include "sema/types/kinds.def"
    {TypeCategory::None, 0, 29}};
constexpr const KindRow& rowOf(TypeKind kind) { return kKindRows[static_cast<uint8_t>(kind)]; }
constexpr TypeCategory categoryOf(TypeKind kind) { return rowOf(kind).category; }

// Ids of elementary types are their kinds: TypeId{(uint32_t)TypeKind::Int} is INT.
constexpr TypeId idOf(TypeKind kind) { return TypeId{static_cast<uint32_t>(kind)}; }
inline constexpr TypeId kError = idOf(TypeKind::Error), kBool = idOf(TypeKind::Bool), kByte = idOf(TypeKind::Byte),
                        kWord = idOf(TypeKind::Word), kDWord = idOf(TypeKind::DWord), kLWord = idOf(TypeKind::LWord),
                        kSInt = idOf(TypeKind::SInt), kInt = idOf(TypeKind::Int), kDInt = idOf(TypeKind::DInt),
                        kLInt = idOf(TypeKind::LInt), kUSInt = idOf(TypeKind::USInt), kUInt = idOf(TypeKind::UInt),
                        kUDInt = idOf(TypeKind::UDInt), kULInt = idOf(TypeKind::ULInt), kReal = idOf(TypeKind::Real),
                        kLReal = idOf(TypeKind::LReal), kTime = idOf(TypeKind::Time), kLTime = idOf(TypeKind::LTime);

// Interface: the target of a variable of an INTERFACE type: the type id with which every object of a class begins, so
// that layout, copying, null checks and comparison are those of pointers.
// Union: all members at Field::given_offset, which is 0 except in STRUCT OVERLAP.
enum class RecordKind : uint8_t { Struct, Union, FunctionBlock, Program, GlobalList, Interface };

enum class FieldRole : uint8_t { Member, Local, Input, Output, InOut, Base };  // Base: the block that it extends
// {attribute 'symbol'}: what tools outside of the program may do with a variable.
enum class SymbolAccess : uint8_t { ReadWrite, Read, Write, None };

struct Field {
  NameId name;
  TypeId type;
  FieldRole role = FieldRole::Member;
  bool by_reference = false;  // VAR_IN_OUT: the memory holds a pointer to the variable
  bool retain = false, persistent = false, constant = false;
  bool non_retain = false;  // not kept, even where the instance is retained
  bool no_copy = false;     // an online change does not copy it
  SymbolAccess symbol_access = SymbolAccess::ReadWrite;
  uint8_t pack = 0;           // {attribute 'pack_mode'}: aligned to at most this; 0: as its type
  uint32_t given_offset = 0;  // of a union whose members have AT positions
  uint32_t offset = 0;        // after layout
};

struct BitMember {  // of type BIT, in a field of its record that is a byte
  NameId name;
  uint32_t field;
  uint8_t bit;
};

struct Dimension {
  int64_t low = 0, high = -1;
  uint64_t count() const { return static_cast<uint64_t>(high - low) + 1; }
};

struct TypeInfo {
  TypeKind kind = TypeKind::None;
  RecordKind record_kind = RecordKind::Struct;
  bool laid_out = false;
  bool overlaps = false;      // STRUCT OVERLAP: a union whose members all have their initial values, in order
  bool named_values = false;  // enumerations with a base type: its values have names, others have none
  bool strict = false;        // enumerations: no numbers for items ({attribute 'strict'})
  bool qualified = false;     // enumerations: TYPE#item only ({attribute 'strict'} or 'qualified_only')
  NameId name;                // named types, unique in generated code
  NameId shown_name;          // in messages, where it is another one: `CAA.PVOID` for `CAA__PVOID`
  TypeId base;  // Enum, Subrange: the integer type; Alias, Array (element), Pointer, Reference: the target
  uint32_t length =
      0;  // strings: capacity in bytes, of a WString in 16-bit units; Array without `dimensions`: how many are open
  int64_t low = 0, high = 0;  // Subrange: bounds in the base type's bits
  int64_t initial = 0;        // Subrange: the value that a variable begins with
  uint64_t size = 0;          // bytes, after layout
  uint8_t pack = 0;           // Record: Field::pack of its members
  uint32_t align = 1;
  uint32_t least_align = 1;  // no pack mode goes below: that of blocks, whose code may be native, and of wide strings
  uint32_t placed_align =
      1;  // Record: what every address of one suits: less than `align` where a packed record holds it
  std::vector<Dimension> dimensions;              // Array; empty: ARRAY[*]
  std::vector<Field> fields;                      // Record
  std::vector<BitMember> bits;                    // Record
  std::vector<std::pair<NameId, int64_t>> items;  // Enum: in order of declaration
};

// Types by id. They never move, and a look-up is a shift and a mask.
class TypeInfos {
 public:
  TypeInfo& operator[](uint32_t index) { return chunks_[index / kChunk][index % kChunk]; }
  const TypeInfo& operator[](uint32_t index) const { return chunks_[index / kChunk][index % kChunk]; }
  uint32_t size() const { return count_; }
  TypeId add(TypeInfo info) {
    if (count_ % kChunk == 0) chunks_.push_back(std::make_unique<TypeInfo[]>(kChunk));
    (*this)[count_] = std::move(info);
    return {count_++};
  }

 private:
  static constexpr uint32_t kChunk = 64;
  std::vector<std::unique_ptr<TypeInfo[]>> chunks_;
  uint32_t count_ = 0;
};

class TypeTable {
 public:
  // pointer_size: 4 or 8, the target's (--target-pointer).
  TypeTable(Names& names, uint32_t pointer_size);
  TypeTable(const TypeTable&) = delete;
  TypeTable& operator=(const TypeTable&) = delete;

  const TypeInfo& info(TypeId id) const { return types_[id.index]; }
  uint32_t count() const { return types_.size(); }
  uint32_t pointerSize() const { return pointer_size_; }
  const Names& names() const { return names_; }

  // The kind, through aliases. `plain` also goes through subranges and enumerations to the integer type in memory.
  TypeId resolve(TypeId id) const {
    if (isKind(id)) return id;
    while (types_[id.index].kind == TypeKind::Alias) id = types_[id.index].base;
    return id;
  }
  TypeId plain(TypeId id) const { return isKind(id) ? id : plainOfNamed(id); }
  TypeKind kind(TypeId id) const { return isKind(id) ? static_cast<TypeKind>(id.index) : kindOfNamed(id); }
  TypeKind plainKind(TypeId id) const { return kind(plain(id)); }

  // The elementary type with this name (any case; TOD and TIME_OF_DAY alike), generic types included; or none.
  TypeId elementary(NameId name) const;

  TypeId string(TypeKind kind, uint32_t length);
  TypeId string(uint32_t length) { return string(TypeKind::String, length); }
  TypeId wstring(uint32_t length) { return string(TypeKind::WString, length); }
  TypeId array(TypeId element, std::span<const Dimension> dimensions);
  TypeId openArray(TypeId element, uint32_t dimensions);  // ARRAY[*], ARRAY[*, *]: of a VAR_IN_OUT
  TypeId pointer(TypeId target);
  TypeId reference(TypeId target);
  TypeId addEnum(NameId name, TypeId base);
  TypeId addSubrange(NameId name, TypeId base, int64_t low, int64_t high);
  TypeId addAlias(NameId name, TypeId target);
  TypeId addRecord(RecordKind kind, NameId name);
  // Filled while the declaration is resolved; not after layout().
  TypeInfo& edit(TypeId id) { return types_[id.index]; }

  // Sets size, align and field offsets of a type and of what it holds: natural alignment where no pack mode says less,
  // 64-bit scalars alignas(8), arrays row-major, strings length+1 units, in-outs a pointer. A record that holds itself
  // must have been reported and cut before. False when the size does not fit 2 GiB.
  bool layout(TypeId id);
  // What the offset of a field is a multiple of; its type is laid out.
  uint32_t fieldAlign(const Field& field) const;
  // Some variable of a record may be less aligned than its type ({attribute 'pack_mode'}).
  bool has_misaligned = false;

  // The format of messages: `INT`, `STRING[20]`, `ARRAY[1..10] OF REAL`, `POINTER TO Motor`, `Color`.
  std::string toString(TypeId id) const;

  // ---- classes of elementary kinds
  static bool isSignedInteger(TypeKind k) { return categoryOf(k) == TypeCategory::Signed; }
  static bool isUnsignedInteger(TypeKind k) { return categoryOf(k) == TypeCategory::Unsigned; }
  static bool isInteger(TypeKind k) { return isSignedInteger(k) || isUnsignedInteger(k); }
  static bool isBits(TypeKind k) { return categoryOf(k) == TypeCategory::Bits; }  // without BOOL
  // UINT and WORD: a number without sign and a bit string of one width. All pointers.
  static bool haveSameBits(TypeKind a, TypeKind b) {
    if (a == TypeKind::Pointer && b == TypeKind::Pointer) return true;
    return ((isUnsignedInteger(a) && isBits(b)) || (isBits(a) && isUnsignedInteger(b))) && bitWidth(a) == bitWidth(b);
  }
  static bool isNumber(TypeKind k) { return isInteger(k) || isBits(k) || isReal(k); }
  static bool isReal(TypeKind k) { return categoryOf(k) == TypeCategory::Real; }
  static bool isDuration(TypeKind k) { return categoryOf(k) == TypeCategory::Duration; }
  static bool isTimeOfDay(TypeKind k) { return k == TypeKind::TimeOfDay || k == TypeKind::LTimeOfDay; }
  static bool isDateTime(TypeKind k) { return k == TypeKind::DateTime || k == TypeKind::LDateTime; }
  static bool isDay(TypeKind k) { return k == TypeKind::Date || k == TypeKind::LDate; }
  static bool isDate(TypeKind k) { return categoryOf(k) == TypeCategory::Date; }
  static bool isString(TypeKind k) { return categoryOf(k) == TypeCategory::String; }
  static bool isCharacter(TypeKind k) { return categoryOf(k) == TypeCategory::Character; }
  // The character type of a string type, the string type of a character type.
  static TypeKind characterOf(TypeKind string) {
    return string == TypeKind::WString   ? TypeKind::WChar
           : string == TypeKind::UString ? TypeKind::UChar
                                         : TypeKind::Char;
  }
  static TypeKind stringOf(TypeKind character) {
    return character == TypeKind::WChar   ? TypeKind::WString
           : character == TypeKind::UChar ? TypeKind::UString
                                          : TypeKind::String;
  }
  bool isOpenArray(TypeId id) const {
    if (isKind(id)) return false;
    const TypeInfo& info = types_[resolve(id).index];
    return info.kind == TypeKind::Array && info.dimensions.empty();
  }
  static bool isElementary(TypeKind k) { return k >= TypeKind::Bool && k <= TypeKind::UString; }
  static bool isGeneric(TypeKind k) { return categoryOf(k) == TypeCategory::Generic; }
  static bool isScalar(TypeKind k) { return k >= TypeKind::Bool && k <= TypeKind::UChar; }  // elementary, not a string
  // BOOL 1, INT 16, TIME 32, LTIME 64, …; 0 for types that are not scalar.
  static uint32_t bitWidth(TypeKind k) { return rowOf(k).bits; }
  // The representation of an elementary kind: signed or unsigned integer of bitWidth, or floating point.
  bool isSigned(TypeKind k) const;
  // Of the dialect (docs/dialects.md).
  bool time_is_signed = false, long_time_is_signed = false;
  // True when `kind` belongs to the generic type (ANY_NUM holds INT).
  static bool belongsTo(TypeKind kind, TypeKind generic);
  // The same where bit strings are taken for integers, and vice versa.
  static bool belongsToOrMixes(TypeKind kind, TypeKind generic);

 private:
  void place(TypeId id, uint32_t align);
  bool layoutArray(TypeInfo& info);
  bool layoutRecord(TypeInfo& info);
  // The id is that of an elementary or generic type, which is its kind. Most types are: they need no look-up.
  static bool isKind(TypeId id) { return id.index < static_cast<uint32_t>(TypeKind::Enum); }
  TypeId plainOfNamed(TypeId id) const;
  TypeKind kindOfNamed(TypeId id) const;

  Names& names_;
  uint32_t pointer_size_;
  TypeInfos types_;
  std::unordered_map<uint64_t, TypeId> interned_;
  std::unordered_map<uint32_t, TypeId> elementary_;  // by name key
};

}  // namespace rung::types

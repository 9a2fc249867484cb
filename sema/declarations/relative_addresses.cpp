// SPDX-License-Identifier: Apache-2.0
// Structures whose members have AT offsets, AT %B2: the members in the order of their offsets, with hidden fields for
// the gaps, so that the natural layout equals the one written. In: the members, resolved. Out: the fields of the
// record. IEC 61131-3 ed. 3 table 11, 8 and 9. A BOOL at %X3.0 is a bit. With OVERLAP the record is a union whose
// members have offsets, in source order.
#include "sema/declarations/relative_addresses.h"

#include <algorithm>

#include "sema/declarations/bit_members.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"

namespace rung::sema {

namespace {

struct RelativeMember {
  VarId var;
  uint64_t byte = 0;
  int bit = -1;
  bool given = false;
};

RelativeMember relativeAddressOf(const Context& context, VarId id) {
  RelativeMember out{.var = id};
  const VarDecl& decl = context.tree().as<VarDecl>(context.symbols.var(id).decl);
  if (!decl.located || decl.address.incomplete || decl.address.path.empty()) return out;
  const auto path = context.tree().list(decl.address.path);
  const char size = decl.address.size;
  out.given = true;
  out.byte = uint64_t{path[0]} * (size == 'W' ? 2 : size == 'D' ? 4 : size == 'L' ? 8 : 1);
  if (size == 'X') {
    out.bit = static_cast<int>(path.size() > 1 ? path[1] : path[0] % 8);
    if (path.size() == 1) out.byte = path[0] / 8;
  }
  return out;
}

void addGap(Context& context, TypeId record, uint64_t bytes, Loc loc) {
  const types::Dimension all{0, static_cast<int64_t>(bytes) - 1};
  Var gap;
  gap.name = context.names().intern("__gap_" + std::to_string(context.types().info(record).fields.size()));
  gap.loc = loc;
  gap.type = context.types().array(types::kByte, {&all, 1});
  gap.storage = Storage::Field;
  gap.record = record;
  gap.used = {1, 1};
  const VarId created{static_cast<uint32_t>(context.symbols.vars.size())};
  context.symbols.vars.push_back(gap);
  addField(context, record, created);
}

void setLastOffset(Context& context, TypeId record, uint64_t byte) {
  if (context.types().info(record).overlaps)
    context.types().edit(record).fields.back().given_offset = static_cast<uint32_t>(byte);
}

// Gives members their offsets, one after the other.
class MemberLayout {
 public:
  MemberLayout(Context& context, TypeId record)
      : context_(context), record_(record), overlaps_(context.types().info(record).overlaps) {}

  // Begins after the inherited fields; false when these have no size.
  bool begin() {
    for (const types::Field& field : context_.types().info(record_).fields) {
      if (!ensureLayout(context_, field.type)) return false;
      end_ = aligned(context_.types().fieldAlign(field)) + sizeOf(field.type);
    }
    return true;
  }

  void add(const RelativeMember& item) {
    const Var& var = context_.symbols.var(item.var);
    if (var.type == types::kError || !ensureLayout(context_, var.type) || !place(item, var))
      addField(context_, record_, item.var);
  }

 private:
  uint64_t aligned(uint32_t align) const { return (end_ + align - 1) / align * align; }
  uint64_t sizeOf(TypeId type) const { return context_.types().info(context_.types().resolve(type)).size; }
  bool isUsed(int bit) const { return (bits_used_ >> bit & 1) != 0; }

  // Forbids offsets that overlap (without OVERLAP) or do not suit the type, and a bit of anything but a BOOL.
  //   passes  a AT %B0 : INT; b AT %B2 : USINT; c AT %X3.0 : BOOL;
  //   fails   a AT %B0 : INT; b AT %B1 : USINT;              E0381
  //   fails   a AT %B1 : INT;                                E0382
  bool place(const RelativeMember& item, const Var& var) {
    const std::string_view name = context_.names().string(var.name);
    const VarDecl& decl = context_.tree().as<VarDecl>(var.decl);
    if (item.bit >= 0 && context_.types().kind(var.type) != types::TypeKind::Bool) {
      context_.report(diag::BitOffset, decl.address_loc, {name, context_.types().toString(var.type)});
      return false;
    }
    types::Field member;
    member.type = var.type;
    member.pack = context_.types().info(record_).pack;
    const uint32_t align = context_.types().fieldAlign(member);
    const bool same_byte = item.bit >= 0 && bits_ && bits_at_ == item.byte && (!overlaps_ || !isUsed(item.bit));
    const uint64_t at = item.given ? item.byte : aligned(align);
    if (!overlaps_ && (same_byte ? isUsed(item.bit) : at < end_)) {
      Report report = context_.report(diag::MemberOverlaps, decl.located ? decl.address_loc : var.loc, {name});
      if (last_) report.alsoDeclaredHere(context_.symbols.var(last_).loc);
      return false;
    }
    if (item.bit < 0 && at % align != 0) {
      context_.report(diag::MemberAlignment, decl.address_loc,
                      {name, context_.types().toString(var.type), std::to_string(align)});
      return false;
    }
    if (!overlaps_ && !same_byte && at > end_) addGap(context_, record_, at - end_, var.loc);
    last_ = item.var;
    if (item.bit >= 0)
      putBit(item, same_byte);
    else
      put(item, at, sizeOf(var.type));
    return true;
  }

  void put(const RelativeMember& item, uint64_t at, uint64_t size) {
    addField(context_, record_, item.var);
    setLastOffset(context_, record_, at);
    end_ = at + size;
  }

  void putBit(const RelativeMember& item, bool same_byte) {
    if (!same_byte) {
      bits_ = addByteOfBits(context_, record_, item.var);
      setLastOffset(context_, record_, item.byte);
      bits_at_ = item.byte;
      bits_used_ = 0;
      end_ = item.byte + 1;
    }
    bits_used_ = static_cast<uint8_t>(bits_used_ | 1u << item.bit);
    addBitAt(context_, record_, item.var, bits_, static_cast<uint8_t>(item.bit));
  }

  Context& context_;
  TypeId record_;
  bool overlaps_;
  uint64_t end_ = 0;
  VarId bits_, last_;  // the byte of the last bits, and the last member
  uint64_t bits_at_ = 0;
  uint8_t bits_used_ = 0;
};

}  // namespace

void layOutMembers(Context& context, TypeId record, std::span<const VarId> members) {
  std::vector<RelativeMember> list;
  for (const VarId id : members) list.push_back(relativeAddressOf(context, id));
  for (size_t i = 1; i < list.size(); ++i)  // without an offset: after the previous one
    if (!list[i].given) list[i].byte = list[i - 1].byte;
  if (!context.types().info(record).overlaps)
    std::stable_sort(list.begin(), list.end(), [](const RelativeMember& a, const RelativeMember& b) {
      return a.byte != b.byte ? a.byte < b.byte : a.bit < b.bit;
    });
  MemberLayout layout(context, record);
  if (!layout.begin()) return;
  for (const RelativeMember& item : list) layout.add(item);
}

}  // namespace rung::sema

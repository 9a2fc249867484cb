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
  gap.use.read = gap.use.written = true;
  const VarId created{static_cast<uint32_t>(context.symbols.vars.size())};
  context.symbols.vars.push_back(gap);
  addField(context, record, created);
}

void setLastOffset(Context& context, TypeId record, uint64_t byte) {
  if (context.types().info(record).overlaps)
    context.types().edit(record).fields.back().given_offset = static_cast<uint32_t>(byte);
}

}  // namespace

// Forbids offsets that overlap (without OVERLAP) or do not suit the type, and a bit of anything but a BOOL.
//   passes  a AT %B0 : INT; b AT %B2 : USINT; c AT %X3.0 : BOOL;
//   fails   a AT %B0 : INT; b AT %B1 : USINT;              E0381
//   fails   a AT %B1 : INT;                                E0382
void layOutMembers(Context& context, TypeId record, std::span<const VarId> members) {
  std::vector<RelativeMember> list;
  for (const VarId id : members) list.push_back(relativeAddressOf(context, id));
  for (size_t i = 1; i < list.size(); ++i)  // without an offset: after the previous one
    if (!list[i].given) list[i].byte = list[i - 1].byte;
  const bool overlaps = context.types().info(record).overlaps;
  if (!overlaps)
    std::stable_sort(list.begin(), list.end(), [](const RelativeMember& a, const RelativeMember& b) {
      return a.byte != b.byte ? a.byte < b.byte : a.bit < b.bit;
    });
  uint64_t end = 0;
  for (const types::Field& field : context.types().info(record).fields) {  // inherited ones
    if (!ensureLayout(context, field.type)) return;
    const uint32_t align = context.types().fieldAlign(field);
    end = (end + align - 1) / align * align + context.types().info(context.types().resolve(field.type)).size;
  }
  VarId bits, last;
  uint64_t bits_at = 0;
  uint8_t bits_used = 0;
  for (const RelativeMember& item : list) {
    const Var& var = context.symbols.var(item.var);
    if (var.type == types::kError || !ensureLayout(context, var.type)) {
      addField(context, record, item.var);
      continue;
    }
    const Loc loc = var.loc;
    const std::string_view name = context.names().string(var.name);
    const types::TypeInfo& info = context.types().info(context.types().resolve(var.type));
    types::Field member;
    member.type = var.type;
    member.pack = context.types().info(record).pack;
    const uint32_t align = context.types().fieldAlign(member);
    const VarDecl& decl = context.tree().as<VarDecl>(var.decl);
    if (item.bit >= 0 && info.kind != types::TypeKind::Bool) {
      context.report(diag::BitOffset, decl.address_loc, {name, context.types().toString(var.type)});
      addField(context, record, item.var);
      continue;
    }
    const bool same_byte =
        item.bit >= 0 && bits && bits_at == item.byte && (!overlaps || (bits_used >> item.bit & 1) == 0);
    const uint64_t at = item.given ? item.byte : (end + align - 1) / align * align;
    if (!overlaps && (same_byte ? (bits_used >> item.bit & 1) != 0 : at < end)) {
      Report report = context.report(diag::MemberOverlaps, decl.located ? decl.address_loc : loc, {name});
      if (last) report.alsoDeclaredHere(context.symbols.var(last).loc);
      addField(context, record, item.var);
      continue;
    }
    if (item.bit < 0 && at % align != 0) {
      context.report(diag::MemberAlignment, decl.address_loc,
                     {name, context.types().toString(var.type), std::to_string(align)});
      addField(context, record, item.var);
      continue;
    }
    if (!overlaps && !same_byte && at > end) addGap(context, record, at - end, loc);
    last = item.var;
    if (item.bit < 0) {
      addField(context, record, item.var);
      setLastOffset(context, record, at);
      end = at + info.size;
      continue;
    }
    if (!same_byte) {
      bits = addByteOfBits(context, record, item.var);
      setLastOffset(context, record, item.byte);
      bits_at = item.byte;
      bits_used = 0;
      end = item.byte + 1;
    }
    bits_used = static_cast<uint8_t>(bits_used | 1u << item.bit);
    addBitAt(context, record, item.var, bits, static_cast<uint8_t>(item.bit));
  }
}

}  // namespace rung::sema

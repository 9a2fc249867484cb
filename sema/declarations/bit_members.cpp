// SPDX-License-Identifier: Apache-2.0
// Members of type BIT (codesys): eight in a row share a byte, the first is its lowest bit. In: variables declared BIT.
// Out: hidden BYTE fields, the position of each bit, and the byte made of the bits' initial values. In bodies such a
// member is a BitAccess to that byte (bodies/names.cpp). In a union each is bit 0.
#include "sema/declarations/bit_members.h"

#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

bool isNamedBit(const Context& context, NameId name) { return sameIdentifier(context.names().string(name), "BIT"); }

bool isBit(Context& context, TypeExprId written) {
  if (!context.profile().bit_type || context.tree().kind(written) != TypeExprKind::Named) return false;
  const NamedTypeExpr& expr = context.tree().as<NamedTypeExpr>(written);
  if (expr.path.count != 1) return false;
  const NameId name = context.tree().list(expr.path)[0].name;
  return isNamedBit(context, name) && !lookUpType(context, name);
}

// A BIT outside of structures and blocks, where there is nothing to share a byte with, is a BOOL, as in the
// tables of the NCT manual.
//   passes  TYPE t : STRUCT ready : BIT; END_STRUCT END_TYPE       warns  FUNCTION f VAR b : BIT; END_VAR      W0393
bool mayBeBit(Context& context, const Var& var, TypeExprId written) {
  const bool block = var.pou && (context.symbols.pou(var.pou).kind == PouKind::FunctionBlock ||
                                 context.symbols.pou(var.pou).kind == PouKind::Class);
  const bool plain =
      var.section == SectionKind::Local || var.section == SectionKind::Input || var.section == SectionKind::Output;
  if (var.storage == Storage::Field && plain && (block || var.record)) return true;
  context.report(diag::BitAsBool, context.tree().loc(written));
  return false;
}

void addBitAt(Context& context, TypeId record, VarId id, VarId byte, uint8_t bit) {
  Var& var = context.symbols.var(id);
  var.bits.holder = byte;
  var.bits.bit = bit;
  var.field = context.symbols.var(byte).field;
  var.bits.is_bit = true;
  context.scopes.named(record)->bits.push_back(id);
  context.types().edit(record).bits.push_back({var.name, var.field, var.bits.bit});
}

VarId addByteOfBits(Context& context, TypeId record, VarId first) {
  Symbols& symbols = context.symbols;
  const Var var = symbols.var(first);
  Var byte;
  byte.name = context.names().intern("__bits_" + toString(context, var.name));
  byte.loc = var.loc;
  byte.type = types::kByte;
  byte.storage = Storage::Field;
  byte.keeping.retain = var.keeping.retain;
  byte.keeping.persistent = var.keeping.persistent;
  byte.pou = var.pou;
  byte.record = var.record;
  byte.used = {1, 1};
  byte.bits.holds_bits = true;
  const VarId created{static_cast<uint32_t>(symbols.vars.size())};
  symbols.vars.push_back(byte);
  if (var.pou) symbols.pou(var.pou).vars.push_back(created);
  addField(context, record, created);
  return created;
}

void addBit(Context& context, TypeId record, VarId id) {
  Symbols& symbols = context.symbols;
  NamedType& named = *context.scopes.named(record);
  Var& var = symbols.var(id);
  const bool is_union = context.types().info(record).record_kind == types::RecordKind::Union;
  const VarId last = named.bits.empty() || is_union ? VarId{} : named.bits.back();
  if (last && symbols.var(last).bits.bit < 7 && symbols.var(last).bits.holder == named.fields.back() &&
      symbols.var(last).keeping.retain == var.keeping.retain &&
      symbols.var(last).keeping.persistent == var.keeping.persistent) {
    return addBitAt(context, record, id, symbols.var(last).bits.holder,
                    static_cast<uint8_t>(symbols.var(last).bits.bit + 1));
  }
  addBitAt(context, record, id, addByteOfBits(context, record, id), 0);
}

// The initial byte that holds a member of type BIT, from the declarations of all its bits; each value must be constant.
uint8_t initialBits(Context& context, TypeId record, VarId byte) {
  uint8_t value = 0;
  const NamedType& named = *context.scopes.named(context.types().resolve(record));
  for (size_t i = 0; i < named.bits.size(); ++i) {
    const VarId id = named.bits[i];
    if (context.symbols.var(id).bits.holder != byte) continue;
    ensureInitialValue(context, id);
    const ExprId init = context.symbols.var(id).init;
    if (!init) continue;
    const auto bit = requireConstant(context, init, types::kBool);
    if (bit && bit->bits != 0) value = static_cast<uint8_t>(value | 1u << context.symbols.var(id).bits.bit);
  }
  return value;
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Forbids the address of an expression without memory: one bit, a value, and in iec a constant number. Arrays,
// structures and strings have memory even when they are constant. TM/TP manual 5.2 (ADR).
//   passes  p := ADR(level);  p := ADR(motors[2].speed);  p := ADR(table) where table is VAR CONSTANT
//   fails   p := ADR(word.3);  p := ADR(a + b);  p := REF(limit) where limit : INT is VAR CONSTANT      E0537
// Called for the operand of ADR and REF, and for the target of a reference.
#include "sema/bodies/addressable.h"

#include "sema/bodies/diagnostics.h"
#include "sema/bodies/names.h"

namespace rung::sema {

namespace {

// The reason why a variable at the root of an lvalue has no address, or null.
const char* whyNotAddressable(const Context& context, VarId id) {
  const Var* var = &context.symbols.var(id);
  if (var->external) var = &context.symbols.var(var->external);
  if (var->storage == Storage::Image && var->image.is_bit) return "one bit of the process image";
  if (var->storage == Storage::Constant) return "a constant";
  const bool number = types::TypeTable::isScalar(context.types().plainKind(var->type));
  return !context.profile().addresses_of_constants && var->constant && number && var->section != SectionKind::InOut
             ? "a constant"
             : nullptr;
}

const char* whyNotAddressable(const Context& context, ExprId lvalue) {
  const Tree& tree = context.tree();
  for (;;) {
    const ExprKind kind = tree.kind(lvalue);
    if (kind == ExprKind::Deref || kind == ExprKind::Error) return nullptr;
    if (kind == ExprKind::Literal || kind == ExprKind::TypedName) return "a constant";
    if (kind == ExprKind::BitAccess)
      return tree.as<BitAccessExpr>(lvalue).width == 1 ? "one bit" : "a part of a number";
    if (kind == ExprKind::Address)
      return typeOf(tree, lvalue) == types::kBool ? "one bit of the process image" : nullptr;
    if (kind == ExprKind::Name || kind == ExprKind::Member) {
      const Entity entity = entityOf(context, lvalue);
      if (entity.entityKind() == EntityKind::EnumValue) return "a constant";
      if (entity.entityKind() == EntityKind::Program) return nullptr;
      if (entity.entityKind() == EntityKind::Pou)
        return context.symbols.pou(PouId{entity.index}).kind == PouKind::Program ? nullptr : "the name of a POU";
      if (entity.entityKind() != EntityKind::Var) return "the name of a type";
      if (const char* reason = whyNotAddressable(context, VarId{entity.index})) return reason;
      if (kind == ExprKind::Name || isWhole(context, tree.as<MemberExpr>(lvalue))) return nullptr;
    }
    if (shape(kind) != ExprShape::Step) return "a value";
    lvalue = tree.base(lvalue);
  }
}

}  // namespace

bool hasMemory(const Context& context, ExprId lvalue) { return whyNotAddressable(context, lvalue) == nullptr; }

bool checkAddressable(Context& context, ExprId lvalue) {
  const char* reason = whyNotAddressable(context, lvalue);
  if (reason != nullptr) context.report(diag::NoAddress, context.tree().begin(lvalue), {reason});
  return reason == nullptr;
}

}  // namespace rung::sema

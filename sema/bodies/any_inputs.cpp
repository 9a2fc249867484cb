// SPDX-License-Identifier: Apache-2.0
// Inputs of type ANY, ANY_NUM … of a POU in codesys: the caller passes the address, the length and the type class of
// its variable (__SYSTEM.AnyType). In: the argument. Out: an AnyValueExpr. Called for each call that binds one.
#include "sema/bodies/any_inputs.h"

#include "sema/bodies/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/generic_calls.h"
#include "sema/bodies/literals.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

uint32_t typeClassOf(const Context& context, TypeId type) {
  switch (context.types().kind(type)) {
    case TypeKind::Bool: return 0;
    case TypeKind::Byte:
    case TypeKind::Char: return 2;
    case TypeKind::Word:
    case TypeKind::WChar: return 3;
    case TypeKind::DWord:
    case TypeKind::UChar: return 4;
    case TypeKind::LWord: return 5;
    case TypeKind::SInt: return 6;
    case TypeKind::Int: return 7;
    case TypeKind::DInt: return 8;
    case TypeKind::LInt: return 9;
    case TypeKind::USInt: return 10;
    case TypeKind::UInt: return 11;
    case TypeKind::UDInt: return 12;
    case TypeKind::ULInt: return 13;
    case TypeKind::Real: return 14;
    case TypeKind::LReal: return 15;
    case TypeKind::String:
    case TypeKind::UString: return 16;
    case TypeKind::WString: return 17;
    case TypeKind::Time: return 18;
    case TypeKind::Date: return 19;
    case TypeKind::DateTime: return 20;
    case TypeKind::TimeOfDay: return 21;
    case TypeKind::Pointer: return 22;
    case TypeKind::Reference: return 23;
    case TypeKind::Subrange: return 24;
    case TypeKind::Enum: return 25;
    case TypeKind::Array: return 26;
    case TypeKind::Record: return 28;
    case TypeKind::LTime: return 37;
    case TypeKind::LDate: return 46;
    case TypeKind::LDateTime: return 47;
    case TypeKind::LTimeOfDay: return 48;
    case TypeKind::None:
    case TypeKind::Error:
    case TypeKind::IntegerLiteral:
    case TypeKind::RealLiteral:
    case TypeKind::NullLiteral:
    case TypeKind::Any:
    case TypeKind::AnyElementary:
    case TypeKind::AnyMagnitude:
    case TypeKind::AnyNum:
    case TypeKind::AnyReal:
    case TypeKind::AnyInt:
    case TypeKind::AnyUnsigned:
    case TypeKind::AnySigned:
    case TypeKind::AnyDuration:
    case TypeKind::AnyBit:
    case TypeKind::AnyChars:
    case TypeKind::AnyString:
    case TypeKind::AnyChar:
    case TypeKind::AnyDate:
    case TypeKind::AnyDerived:
    case TypeKind::Alias:
    case TypeKind::Count_: return 29;
  }
  return 29;
}

void bindAny(Context& context, const Pou& pou, const Var& pin, ExprId& value) {
  TypeId type = check(context, value, {}, Access::Address);
  if (isUntyped(context, type)) type = finalizeUntyped(context, value);
  if (!type || type == types::kError || pin.type == types::kError) return;
  if (context.types().resolve(type) == context.types().resolve(pin.type)) return;  // an ANY input passed on
  const Loc loc = context.tree().begin(value);
  if (context.types().isOpenArray(type) || !belongs(context, type, context.types().kind(pin.any))) {
    context.report(diag::NotOfGeneric, loc,
                   {context.types().toString(type), string(context, pou.name), context.types().toString(pin.any)});
    return;
  }
  if (const PouId record = pouOf(context, type)) resolvePou(context, record);
  if (!ensureLayout(context, type)) return;
  const ExprId passed = context.build().anyValue(value, {}, typeClassOf(context, type), loc);
  context.replace(value, typed(context, passed, pin.type));
}

}  // namespace rung::sema

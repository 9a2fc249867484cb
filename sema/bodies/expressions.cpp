// SPDX-License-Identifier: Apache-2.0
// Expressions: dispatch over the kinds, and those that are not names, literals, operators or calls.
// In: an expression of a body or an initial value, and the type that its context wants. Out: types, entities and
// conversions written into the tree. Called by statements.cpp and by the declarations.
#include "sema/bodies/expressions.h"

#include <algorithm>

#include "frontend/source/dialect.h"
#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/dynamic_memory.h"
#include "sema/bodies/implicit_checks.h"
#include "sema/bodies/limits.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/pointers.h"
#include "sema/bodies/statements.h"
#include "sema/bodies/writable.h"
#include "sema/declarations/addresses.h"
#include "sema/declarations/constants.h"
#include "sema/hooks.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

using types::TypeTable;

// An integer; reports another type.
TypeId checkIndexValue(Context& context, ExprId& index) {
  TypeId type = check(context, index, {}, Access::Read);
  if (isUntyped(context, type)) type = finalizeUntyped(context, index);
  const TypeKind kind = context.types().plainKind(type);
  const bool enumeration = context.types().kind(type) == TypeKind::Enum;
  if (type == types::kError) return type;
  if ((TypeTable::isInteger(kind) || TypeTable::isBits(kind)) && (!enumeration || context.profile().enums_as_numbers))
    return type;
  context.report(diag::IndexNotInteger, context.tree().loc(index), {context.types().toString(type)});
  return types::kError;
}

// s[i]: in codesys the bytes of a STRING and the words of a WSTRING, from 0. The zero after the last one that fits can
// be read, so that a loop finds the end of a full string; it cannot be written. In edition 3 characters, CHAR and
// WCHAR, from 1 (6.4.2.2).
TypeId checkCharacter(Context& context, IndexExpr& node, TypeId string_type, Access access) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(string_type));
  if (info.kind == TypeKind::UString) {
    checkIndexValue(context, context.code().list(node.indices)[0]);
    context.report(diag::CharacterOfUtf8, context.tree().begin(context.tree().list(node.indices)[0]));
    return types::kError;
  }
  const bool reads = access == Access::Read || access == Access::Qualifier;
  ExprId& index = context.code().list(node.indices)[0];
  const TypeId type = checkIndexValue(context, index);
  if (type == types::kError) return type;
  if (!reads) meaning(node.h).writes_character = true;
  meaning(node.h).is_writable = context.meaning(node.base).is_writable;
  if (context.profile().characters_from_one)
    return types::idOf(info.kind == TypeKind::WString ? TypeKind::WChar : TypeKind::Char);
  return types::idOf(info.kind == TypeKind::WString ? TypeKind::Word : TypeKind::Byte);
}

TypeId checkIndex(Context& context, ExprId& expr, Access access) {
  IndexExpr& node = context.code().as<IndexExpr>(expr);
  Meaning& known = meaning(node.h);
  const TypeId base = check(context, node.base, {}, access == Access::Qualifier ? Access::Read : access);
  const uint32_t count = node.indices.count;
  const types::TypeInfo* info = &context.types().info(context.types().resolve(base));
  if (info->kind == TypeKind::Pointer && count == 1) return checkPointerIndex(context, expr, access);
  if (TypeTable::isString(info->kind) && count == 1 && context.profile().indexed_strings) {
    known.type = checkCharacter(context, node, base, access);
    if (known.type != types::kError) context.rules->expression(context, expr);
    return known.type;
  }
  const bool array = info->kind == TypeKind::Array;
  const uint32_t dimensions = info->dimensions.empty() ? info->length : static_cast<uint32_t>(info->dimensions.size());
  if (!array && base != types::kError) {
    context.report(diag::NotAnArray, node.h.loc, {context.types().toString(base)});
  } else if (array && dimensions != count) {
    // The first surplus index, or the last index before the missing ones.
    const uint32_t marked = std::min(dimensions, count - 1);
    context.report(diag::WrongIndexCount, context.tree().loc(context.tree().list(node.indices)[marked]),
                   {context.types().toString(base), std::to_string(dimensions), std::to_string(count)});
  }
  bool ok = array && dimensions == count;
  for (uint32_t i = 0; i < count; ++i) {
    ExprId& index = context.code().list(node.indices)[i];
    if (checkIndexValue(context, index) == types::kError) {
      ok = false;
    }
  }
  if (!ok) return known.type = types::kError;
  known.is_writable = context.meaning(node.base).is_writable;
  known.type = info->base;
  context.rules->expression(context, expr);
  for (uint32_t i = 0; i < info->dimensions.size(); ++i)
    callBoundsCheck(context, context.code().list(node.indices)[i], info->dimensions[i]);
  return known.type;
}

TypeId checkDeref(Context& context, ExprId& expr, Access access) {
  DerefExpr& node = context.code().as<DerefExpr>(expr);
  Meaning& known = meaning(node.h);
  if (known.type) return known.type;  // of a reference that was checked before
  const TypeId base = check(context, node.base, {}, Access::Read);
  if (base == types::kError) return known.type = types::kError;
  const types::TypeInfo& info = context.types().info(context.types().resolve(base));
  if (info.kind != TypeKind::Pointer) {
    context.report(diag::NotAPointer, node.h.loc, {context.types().toString(base)});
    return known.type = types::kError;
  }
  known.is_writable = 1;
  callPointerCheck(context, node.base, info.base, access);
  return known.type = info.base;
}

TypeId checkBitAccess(Context& context, ExprId& expr, Access access) {
  BitAccessExpr& node = context.code().as<BitAccessExpr>(expr);
  if (meaning(node.h).is_bit_member) return meaning(node.h).type;  // checked before
  check(context, node.base, {}, access == Access::Write ? Access::ReadWrite : access);
  return checkBitOf(context, expr);
}

// %IX0.3, %QW5: a view of the image without a declaration.
TypeId checkAddress(Context& context, ExprId& expr) {
  AddressExpr& node = context.code().as<AddressExpr>(expr);
  Meaning& known = meaning(node.h);
  known.is_writable = 1;
  if (isHierarchical(context, node.address)) {
    const VarId named = hierarchicalVar(context, node.address, node.h.loc, {});
    if (!named) return known.type = types::kError;
    const Var& var = context.symbols.var(named);
    const ExprId name = makeName(context, var.name, entity(named), node.h.loc);
    context.code().expr(name).in_parens = node.h.in_parens;
    context.meaning(name).is_writable = 1;
    context.replace(expr, typed(context, name, var.type));
    return var.type;
  }
  if (!resolveAddress(context, node.address, node.h.loc, {})) return known.type = types::kError;
  const TypeId declared = declaredAddressType(context, node.address);
  return known.type = declared ? declared : addressType(node.address);
}

// A REFERENCE is used like its target.
TypeId throughReference(Context& context, ExprId& expr, TypeId type, Access access) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(type));
  if (info.kind != TypeKind::Reference) return type;
  callPointerCheck(context, expr, info.base, access);
  context.replace(expr, makeDeref(context, expr, info.base, context.tree().loc(expr)));
  return info.base;
}

TypeId dispatch(Context& context, ExprId& expr, TypeId expected, Access access) {
  const Tree& tree = context.tree();
  switch (tree.kind(expr)) {
    case ExprKind::Error: return typeOf(tree, expr) = types::kError;
    case ExprKind::Literal: return checkLiteral(context, expr, expected);
    case ExprKind::Name: return checkName(context, expr, expected, access);
    case ExprKind::TypedName: return checkTypedName(context, expr);
    case ExprKind::Member: return checkMember(context, expr, expected, access);
    case ExprKind::Index: return checkIndex(context, expr, access);
    case ExprKind::This:
    case ExprKind::Super: return checkThisOrSuper(context, expr, expected, access);
    case ExprKind::Deref: return checkDeref(context, expr, access);
    case ExprKind::BitAccess: return checkBitAccess(context, expr, access);
    case ExprKind::Address: return checkAddress(context, expr);
    case ExprKind::Unary: return checkUnary(context, expr, expected);
    case ExprKind::Binary: return checkBinary(context, expr, expected);
    case ExprKind::Call: return checkCall(context, expr, expected, false);
    case ExprKind::New: return checkNew(context, expr);
    case ExprKind::Assign: return checkAssignExpr(context, expr);
    case ExprKind::Convert:
    case ExprKind::Bound:
    case ExprKind::AnyValue:
    case ExprKind::AddressOf: return typeOf(tree, expr);  // checked before
    case ExprKind::ArrayInit:
    case ExprKind::StructInit:
    case ExprKind::Range:
    case ExprKind::Repeat: RUNG_INVARIANT(false, "lists and ranges appear only in initial values and CASE labels");
  }
  return types::kError;
}

}  // namespace

TypeId checkBitOf(Context& context, ExprId expr) {
  BitAccessExpr& node = context.code().as<BitAccessExpr>(expr);
  Meaning& known = meaning(node.h);
  const TypeId base = context.type(node.base);
  if (!base || base == types::kError) return known.type = types::kError;
  const TypeKind kind = context.types().plainKind(base);
  const bool integer = TypeTable::isInteger(kind);
  if ((!TypeTable::isBits(kind) && !integer) || (integer && !context.profile().bits_of_integers)) {
    context.report(diag::NoBits, node.h.loc, {context.types().toString(base)});
    return known.type = types::kError;
  }
  const uint32_t count = TypeTable::bitWidth(kind) / node.width;
  if (node.position >= count) {
    if (count == 0) {
      context.report(diag::NoBits, node.h.loc, {context.types().toString(base)});
    } else {
      context.report(diag::BitOutOfRange, node.h.loc,
                     {std::to_string(node.position), context.types().toString(base), std::to_string(count - 1)});
    }
    return known.type = types::kError;
  }
  known.is_writable = context.meaning(node.base).is_writable;
  switch (node.width) {
    case 8: return known.type = types::kByte;
    case 16: return known.type = types::kWord;
    case 32: return known.type = types::kDWord;
    default: return known.type = types::kBool;
  }
}

TypeId check(Context& context, ExprId& expr, TypeId expected, Access access) {
  if (!expr) return types::kError;
  if (context.depth >= kMaxExprDepth) {
    context.report(diag::ExpressionTooDeep, context.tree().loc(expr), {std::to_string(kMaxExprDepth)});
    return context.type(expr) = types::kError;
  }
  ++context.depth;
  TypeId type = dispatch(context, expr, expected, access);
  if (context.tree().kind(expr) != ExprKind::AddressOf) type = throughReference(context, expr, type, access);
  --context.depth;
  return type;
}

TypeId checkExpr(Context& context, ExprId& expr, TypeId expected) {
  const TypeId type = check(context, expr, expected, Access::Read);
  return isUntyped(context, type) ? finalizeUntyped(context, expr, expected) : type;
}

std::optional<int64_t> constantInteger(Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  if (!meaning(tree, expr).is_constant) return std::nullopt;
  if (tree.kind(expr) == ExprKind::Literal) {
    const LiteralExpr& node = tree.as<LiteralExpr>(expr);
    if (node.literal() != LiteralKind::Integer && node.literal() != LiteralKind::Bool) return std::nullopt;
    const auto value = static_cast<int64_t>(node.value());
    return node.form.is_negative ? -value : value;
  }
  const Entity entity = entityOf(context, expr);
  if (entity.entityKind() == EntityKind::EnumValue) return context.symbols.enum_values[entity.index].value;
  const std::optional<types::Value> value = evaluate(context, expr);
  if (!value || !TypeTable::isScalar(context.types().plainKind(value->type)) ||
      TypeTable::isReal(context.types().plainKind(value->type))) {
    return std::nullopt;
  }
  return value->asSigned();
}

}  // namespace rung::sema

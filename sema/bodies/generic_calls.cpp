// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/generic_calls.h"

#include <algorithm>

#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/required_pins.h"
#include "sema/bodies/writable.h"
#include "sema/declarations/generics.h"
#include "sema/declarations/objects.h"
#include "sema/shorthands.h"
#include "sema/types/arithmetic.h"

namespace rung::sema {

using types::TypeTable;

bool belongs(const Context& context, TypeId type, TypeKind generic) {
  const TypeKind kind = context.types().kind(type), plain = context.types().plainKind(type);
  if (TypeTable::belongsTo(kind, generic) || TypeTable::belongsTo(plain, generic)) return true;
  if (generic == TypeKind::Any) return true;
  return context.profile().generics_mix_bits_and_integers && TypeTable::belongsToOrMixes(plain, generic);
}

namespace {

Operands classOf(TypeKind generic) {
  if (generic >= TypeKind::AnyNum && generic <= TypeKind::AnySigned) return Operands::Number;
  if (generic == TypeKind::AnyMagnitude || generic == TypeKind::AnyDuration) return Operands::NumberOrTime;
  if (generic == TypeKind::AnyBit) return Operands::Bits;
  if (generic == TypeKind::AnyElementary || generic == TypeKind::AnyDate) return Operands::Comparable;
  if (generic >= TypeKind::AnyChars && generic <= TypeKind::AnyChar) return Operands::Comparable;
  return Operands::Anything;
}

TypeId groupType(Context& context, std::span<ExprId> operands, TypeKind generic, TypeId expected, const Pou& pou,
                 Loc loc) {
  // SQRT(2) and SIN(intVar): other numbers become REAL where only REAL is accepted.
  if (generic == TypeKind::AnyReal) {
    TypeId real = expected && TypeTable::isReal(context.types().plainKind(expected)) ? context.types().plain(expected)
                                                                                     : types::kReal;
    bool typed_real = false;
    for (const ExprId operand : operands) {
      const TypeId type = context.type(operand);
      if (isUntyped(context, type) || type == types::kError) continue;
      const TypeId plain = context.types().plain(type);
      const TypeKind kind = context.types().info(plain).kind;
      if (TypeTable::isReal(kind)) {
        real = typed_real ? commonNumber(context, real, plain) : plain;
        typed_real = true;
      } else if (!typed_real && (TypeTable::isInteger(kind) || TypeTable::isBits(kind)) &&
                 !types::isLossless(context.types(), plain, real)) {
        real = types::kLReal;
      }
    }
    for (ExprId& operand : operands) {
      if (!convert(context, operand, real, Purpose{Use::Passed, pou.name, {}})) return types::kError;
    }
    return real;
  }
  const bool equality = pou.pragmas.operator_kind == OperatorKind::Op &&
                        (pou.pragmas.op == types::Op::Eq || pou.pragmas.op == types::Op::Ne);
  const TypeId common = unify(context, operands, equality ? Operands::Equatable : classOf(generic), expected,
                              string(context, pou.name), loc);
  if (common == types::kError) return common;
  if (!belongs(context, common, generic)) {
    context.report(
        diag::NotOfGeneric, operands.size() == 1 ? context.tree().loc(operands[0]) : loc,
        {context.types().toString(common), string(context, pou.name), context.types().toString(types::idOf(generic))});
    return types::kError;
  }
  return common;
}

// f(a, b, c) of a function with two inputs, the second extensible: f(f(a, b), c).
TypeId foldCall(Context& context, ExprId& expr, PouId pou, const Arguments& arguments, TypeId expected) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  const size_t declared = pinsOf(context, pou).size();
  std::vector<Argument> values;
  for (const uint32_t index : arguments.slots) {
    Argument argument{};
    if (index != 0) argument = context.tree().list(node.arguments)[index - 1];
    argument.pin = {};
    values.push_back(argument);
  }
  ExprId inner;
  for (size_t from = 0; from < values.size();) {
    std::vector<Argument> some;
    if (inner) some.push_back(Argument{{}, inner, false, false, node.h.loc});
    while (some.size() < declared && from < values.size()) some.push_back(values[from++]);
    const ExprId link = context.code().duplicate(expr);
    if (from == values.size()) {  // EN and ENO belong to the whole
      for (const uint32_t control : {arguments.en, arguments.eno}) {
        if (control != 0) some.push_back(context.tree().list(node.arguments)[control - 1]);
      }
    }
    context.code().as<CallExpr>(link).arguments = context.code().addList<Argument>(some);
    inner = link;
  }
  context.replace(expr, inner);
  return checkGenericCall(context, expr, pou, expected, {});
}

// Forbids anything but an ARRAY OF BYTE of one dimension for the generic type of a {bytes} function. Edition 4.
//   passes  bytes := STRING_TO_ARRAY_OF_BYTE(s);       fails   words := STRING_TO_ARRAY_OF_BYTE(s);        E0150
bool checkBytes(Context& context, const CallExpr& node, const Pou& pou, std::span<const TypeId> pins, TypeId expected) {
  const bool gives = pou.result && TypeTable::isGeneric(context.types().kind(pou.result));
  const TypeId type = gives ? expected : pins[0];
  const types::TypeInfo* const info = type ? &context.types().info(context.types().resolve(type)) : nullptr;
  if (type == types::kError) return false;
  if (info != nullptr && info->kind == TypeKind::Array && info->dimensions.size() == 1 &&
      context.types().kind(info->base) == TypeKind::Byte)
    return true;
  context.report(diag::BytesOnly, node.h.loc,
                 {string(context, pou.name), gives ? "gives" : "takes",
                  type ? "`" + context.types().toString(type) + "`" : std::string("a value")});
  return false;
}

}  // namespace

TypeId GenericOperands::typeFor(const Context& context, TypeId declared) const {
  const TypeKind kind = context.types().info(declared).kind;
  if (!TypeTable::isGeneric(kind)) return declared;
  for (const Group& group : groups) {
    if (group.generic == declared) return group.type;
  }
  return {};
}

namespace {

// codesys: a pointer as the number of its first byte, where anything elementary is converted.
void takePointerAsNumber(Context& context, ExprId& value, TypeId type, TypeId declared) {
  if (context.profile().pointers_as_numbers && context.types().kind(type) == TypeKind::Pointer &&
      context.types().info(declared).kind == TypeKind::AnyElementary)
    wrapConvert(context, value, types::idOf(context.types().pointerSize() == 8 ? TypeKind::ULInt : TypeKind::UDInt));
}

// How the operands of a call of a generic function are checked.
struct OperandCheck {
  Context& context;
  const Pou& pou;
  TypeId expected, forced;
  bool checked;  // before, by the choice of an overload or as an operator

  bool resultIsGeneric() const { return pou.result && TypeTable::isGeneric(context.types().info(pou.result).kind); }
  bool checkAgainst(ExprId& value, TypeId type, const Purpose& purpose) const {
    return checked ? convert(context, value, type, purpose) : checkAs(context, value, type, purpose);
  }

  bool check(ExprId& value, SectionKind section, TypeId declared, const Purpose& purpose) const {
    if (section == SectionKind::Output)
      return sema::check(context, value, {}, Access::Write) != types::kError && checkWritable(context, value, purpose);
    if (!TypeTable::isGeneric(context.types().info(declared).kind)) return checkAgainst(value, declared, purpose);
    if (forced && (!resultIsGeneric() || declared == pou.result)) return checkAgainst(value, forced, purpose);
    if (checked) return true;
    const TypeId type = sema::check(context, value, declared == pou.result ? expected : TypeId{}, Access::Read);
    if (!resultIsGeneric()) takePointerAsNumber(context, value, type, declared);
    return type != types::kError;
  }
};

// Gives the operands of each generic type their common type.
bool groupTypes(Context& context, const CallExpr& node, const Pou& pou, const Arguments& arguments, TypeId expected,
                GenericOperands& out) {
  std::vector<ExprId> operands;
  for (size_t i = 0; i < out.values.size(); ++i) {
    const TypeId generic = out.pin_types[i];
    const TypeKind kind = context.types().info(generic).kind;
    if (!out.values[i] || !TypeTable::isGeneric(kind)) continue;
    if (std::any_of(out.groups.begin(), out.groups.end(), [&](const auto& group) { return group.generic == generic; }))
      continue;
    operands.clear();
    for (size_t k = i; k < out.values.size(); ++k) {
      if (out.pin_types[k] == generic && out.values[k]) operands.push_back(out.values[k]);
    }
    const TypeId type =
        groupType(context, operands, kind, generic == pou.result ? expected : TypeId{}, pou, node.h.loc);
    out.groups.push_back({generic, type});
    if (type == types::kError) return false;
    size_t at = 0;
    for (size_t k = i; k < out.values.size(); ++k) {
      if (out.pin_types[k] != generic || !out.values[k]) continue;
      out.values[k] = operands[at++];
      context.code().list(node.arguments)[arguments.slots[k] - 1].value = out.values[k];
    }
  }
  return true;
}

}  // namespace

GenericOperands groupOperands(Context& context, const CallExpr& node, PouId id, const Arguments& arguments,
                              TypeId expected, TypeId forced, bool checked) {
  GenericOperands out;
  const std::span<const VarId> pins = pinsOf(context, id);
  const Pou& pou = context.symbols.pou(id);
  const OperandCheck operand{
      .context = context, .pou = pou, .expected = expected, .forced = forced, .checked = checked};
  out.values.resize(arguments.slots.size());
  out.pin_types.resize(arguments.slots.size());
  TypeId extensible_type;
  for (const VarId pin : pins) {
    if (context.symbols.var(pin).pragmas.extensible) extensible_type = context.symbols.var(pin).type;
  }
  for (size_t i = 0; i < arguments.slots.size(); ++i) {
    const Var* const pin = i < pins.size() ? &context.symbols.var(pins[i]) : nullptr;  // none: a further operand
    out.pin_types[i] = pin != nullptr ? pin->type : extensible_type;
    if (arguments.slots[i] == 0) continue;
    const uint32_t index = arguments.slots[i] - 1;
    const Argument& argument = context.tree().list(node.arguments)[index];
    if (!argument.value) continue;
    ExprId value = argument.value;
    const Purpose purpose{Use::Passed, pin != nullptr ? pin->name : argument.pin.name, pou.name};
    out.ok &= operand.check(value, pin != nullptr ? pin->section : SectionKind::Input, out.pin_types[i], purpose);
    context.code().list(node.arguments)[index].value = value;
    out.values[i] = value;
  }
  if (out.ok) out.ok = groupTypes(context, node, pou, arguments, expected, out);
  return out;
}

TypeId checkGenericCall(Context& context, ExprId& expr, PouId pou, TypeId expected, TypeId forced) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  Meaning& known = meaning(node.h);
  Arguments arguments = matchArguments(context, node, pou);
  const size_t declared = pinsOf(context, pou).size();
  if (arguments.slots.size() > declared) return foldCall(context, expr, pou, arguments, expected);
  if (!arguments.ok) {
    return checkRefused(context, node, arguments);
  }
  Call call;
  call.kind = CallKind::Function;
  bindControlPins(context, node, arguments, call);
  if (!checkRequiredPins(context, node, pou, arguments)) return known.type = types::kError;
  GenericOperands operands = groupOperands(context, node, pou, arguments, expected, forced, false);
  if (!operands.ok) return known.type = types::kError;
  // A string has the largest capacity inside: one instance serves every length. C functions know no named types.
  const bool native = context.symbols.pou(pou).pragmas.native;
  const auto normal = [&](TypeId type) {
    const TypeKind kind = context.types().plainKind(type);
    if (TypeTable::isString(kind)) return context.types().string(kind, 255);
    return native ? context.types().plain(type) : type;
  };
  std::vector<TypeId> types_by_pin;
  const Pou& generic = context.symbols.pou(pou);
  for (size_t i = 0; i < declared; ++i) {
    const TypeId pin = context.symbols.var(pinsOf(context, pou)[i]).type;
    const TypeId type = operands.typeFor(context, pin);
    types_by_pin.push_back(type ? normal(type) : types::kInt);
  }
  if (generic.pragmas.bytes && !checkBytes(context, node, generic, types_by_pin, expected))
    return known.type = types::kError;
  TypeId result = generic.result ? operands.typeFor(context, generic.result) : TypeId{};
  if (generic.result && !result) {  // TRUNC: the result is any integer that is wanted
    result = forced ? forced : types::kDInt;
    if (!forced && expected && belongs(context, expected, context.types().info(generic.result).kind)) {
      result = context.types().plain(expected);
    }
  }
  if (result) result = normal(result);
  call.pou = generic.generic ? instantiate(context, pou, types_by_pin, result) : pou;
  if (!call.pou) return known.type = types::kError;
  context.symbols.pou(call.pou).progress.used = true;
  const std::span<const VarId> pins = pinsOf(context, call.pou);
  known.is_constant = generic.library && generic.pragmas.pure && !native && !call.en && !call.eno;
  for (size_t i = 0; i < operands.values.size() && i < pins.size(); ++i) {
    if (!operands.values[i]) continue;
    known.is_constant = known.is_constant && context.meaning(operands.values[i]).is_constant;
    Binding binding;
    binding.pin = pins[i];
    binding.value = operands.values[i];
    binding.is_output = context.symbols.var(pins[i]).section == SectionKind::Output;
    call.bindings.push_back(binding);
  }
  const TypeId type = context.symbols.pou(call.pou).result;
  known.call = addCall(context, std::move(call));
  return known.type = type;
}

}  // namespace rung::sema

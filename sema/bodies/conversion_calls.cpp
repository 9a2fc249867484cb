// SPDX-License-Identifier: Apache-2.0
// Calls whose names follow a rule instead of a declaration: conversions `<A>_TO_<B>`, `TO_<B>`, `ANY_TO_<B>`,
// `<A>_TRUNC_<B>`, `TRUNC_<B>`, and typed names `<FUNC>_<TYPE>` (MUX_INT, ADD_TIME). In: a call of a name that is not
// declared. Out: a ConvertExpr, or a call of the library function that the rule names.
// Strings are converted by library functions: TO_STRING, TO_WSTRING, STRING_TO_<B>.
#include "sema/bodies/conversion_calls.h"

#include <string>

#include "frontend/source/scanner.h"
#include "frontend/syntax/standard_names.h"
#include "sema/access.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/generic_calls.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/operator_calls.h"
#include "sema/declarations/call_graph.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/types.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

using types::TypeTable;

struct Rule {
  enum class Kind : uint8_t { None, Convert, Truncate } kind = Kind::None;
  TypeId from, to;
};

TypeId typeNamed(Context& context, std::string_view word) {
  const NameId name = context.names().find(word);
  if (!name) return {};
  if (const TypeId type = context.types().elementary(name)) {
    return TypeTable::isGeneric(context.types().info(type).kind) ? TypeId{} : type;
  }
  const Entity entity = lookUp(context, name);
  // In the name of a conversion no variable hides the type: `mode : Mode; … MODE_TO_INT(mode)`.
  const TypeId type = entity.entityKind() == EntityKind::Type ? TypeId{entity.index} : lookUpType(context, name);
  if (!type) return {};
  return TypeTable::isElementary(context.types().plainKind(type)) ? type : TypeId{};
}

Rule ruleOf(Context& context, std::string_view name) {
  struct Word {
    std::string_view infix;
    Rule::Kind kind;
  };
  for (const Word& word : {Word{"_TO_", Rule::Kind::Convert}, Word{"_TRUNC_", Rule::Kind::Truncate}}) {
    const std::string_view prefix = word.infix.substr(1);
    if (name.starts_with(prefix)) {
      if (const TypeId to = typeNamed(context, name.substr(prefix.size()))) return {word.kind, {}, to};
    }
    for (size_t at = name.find(word.infix); at != std::string_view::npos; at = name.find(word.infix, at + 1)) {
      const TypeId to = typeNamed(context, name.substr(at + word.infix.size()));
      if (!to) continue;
      if (name.substr(0, at) == "ANY") return {word.kind, {}, to};
      if (const TypeId from = typeNamed(context, name.substr(0, at))) return {word.kind, from, to};
    }
  }
  return {};
}

// The value of a call with exactly one input, and its EN and ENO.
struct OneInput {
  ExprId value;
  uint32_t index = 0;
  ExprId en, eno;
  bool ok = false;
};

OneInput oneInput(Context& context, const CallExpr& node, NameId name) {
  OneInput out;
  uint32_t inputs = 0;
  for (uint32_t i = 0; i < node.arguments.count; ++i) {
    const Argument& argument = context.tree().list(node.arguments)[i];
    const std::string_view pin = argument.pin.name ? string(context, argument.pin.name) : std::string_view();
    if (isEnable(pin) && !argument.is_output) {
      out.en = argument.value;
    } else if (isEnableOutput(pin) && argument.is_output) {
      out.eno = argument.value;
    } else if (!pin.empty() && !sameIdentifier(pin, "IN")) {
      context.report(diag::UnknownPin, argument.pin.loc, {string(context, name), pin}).didYouMean("IN");
      return out;
    } else {
      ++inputs;
      out.value = argument.value;
      out.index = i;
    }
  }
  out.ok = inputs == 1 && out.value;
  if (!out.ok) {
    context.report(diag::WrongArgumentCount, node.h.loc, {string(context, name), "1", std::to_string(inputs)});
  }
  return out;
}

// Calls a library function instead: the callee becomes its name.
TypeId callLibrary(Context& context, ExprId& expr, std::string_view function, TypeId expected, NameId written) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  const NameId name = context.names().intern(function);
  if (lookUp(context, name).entityKind() != EntityKind::Pou) {
    context.report(diag::UnknownName, node.h.loc, {string(context, written)});
    return meaning(node.h).type = types::kError;
  }
  context.replace(node.callee, context.build().name(name, context.tree().loc(node.callee)));
  return checkCall(context, expr, expected, false);
}

// The operand as a value of `type`; a typed operand is not typed again.
bool operandAs(Context& context, ExprId& value, TypeId type, NameId function) {
  if (!checkAs(context, value, type, Purpose{Use::PassedToInput, function, {}})) return false;
  if (context.tree().kind(value) != ExprKind::Convert) wrapConvert(context, value, context.type(value));
  return true;
}

// The name of the library function for two types where the dialect has one: `DWORD_TO_REAL` transfers the bits in
// edition 3, `WORD_TO_BOOL` takes the rightmost one. Else empty.
std::string libraryConversion(Context& context, TypeKind from, TypeKind to) {
  if (!context.profile().conversions_by_library) return {};
  if (TypeTable::isReal(from) == TypeTable::isReal(to) && (to != TypeKind::Bool || from == TypeKind::Bool)) return {};
  std::string function(string(context, context.types().info(types::idOf(from)).name));
  function.append("_TO_").append(string(context, context.types().info(types::idOf(to)).name));
  const Entity entity = lookUp(context, context.names().intern(function));
  return entity.entityKind() == EntityKind::Pou && context.symbols.pou(PouId{entity.index}).library ? function
                                                                                                    : std::string();
}

// A call of a conversion, whose function depends on the types on both sides.
class ConversionCall {
 public:
  ConversionCall(Context& context, ExprId& expr, NameId name, const Rule& rule, TypeId expected)
      : context_(context),
        expr_(expr),
        node_(context.code().as<CallExpr>(expr)),
        name_(name),
        rule_(rule),
        expected_(expected) {}

  TypeId check() {
    input_ = oneInput(context_, node_, name_);
    if (!input_.ok) {
      checkLooseArguments(context_, node_);
      return fail();
    }
    value_ = input_.value;
    from_ = checkValue();
    if (from_ == types::kError) return fail();
    takePointerAsNumber();
    source_ = context_.types().plainKind(from_);
    target_ = context_.types().plainKind(rule_.to);
    if (!TypeTable::isElementary(source_)) return reportValue("ANY_ELEMENTARY");
    if (rule_.kind == Rule::Kind::Truncate) return truncate();
    if (TypeTable::isString(target_) || TypeTable::isCharacter(target_)) return toString();
    if (TypeTable::isString(source_) || TypeTable::isCharacter(source_)) return fromString();
    if (const std::string function = libraryConversion(context_, source_, target_); !function.empty())
      return call(function);
    return convertValue();
  }

 private:
  TypeId fail() { return meaning(node_.h).type = types::kError; }
  TypeId reportValue(std::string_view wanted) {
    context_.report(diag::NotOfGeneric, context_.tree().loc(value_),
                    {context_.types().toString(from_), string(context_, name_), wanted});
    return fail();
  }
  std::string nameOf(TypeKind kind) const {
    return std::string(string(context_, context_.types().info(types::idOf(kind)).name));
  }

  // The type of the value: the one that the name of the function says, or its own.
  TypeId checkValue() {
    if (rule_.from) {
      const bool ok = checkAs(context_, value_, rule_.from, Purpose{Use::PassedToInput, name_, {}});
      return ok ? rule_.from : types::kError;
    }
    const TypeId own = sema::check(context_, value_, {}, Access::Read);
    if (!isUntyped(context_, own)) return own;
    const bool direct = untypedFits(context_, value_, rule_.to) && rule_.kind == Rule::Kind::Convert;
    return finalizeUntyped(context_, value_, direct ? rule_.to : TypeId{});
  }

  // The number of its first byte.
  void takePointerAsNumber() {
    if (!context_.profile().pointers_as_numbers || context_.types().kind(from_) != TypeKind::Pointer) return;
    from_ = types::idOf(context_.types().pointerSize() == 8 ? TypeKind::ULInt : TypeKind::UDInt);
    wrapConvert(context_, value_, from_);
  }

  void replaceArgument() {
    if (context_.tree().kind(value_) != ExprKind::Convert) wrapConvert(context_, value_, context_.type(value_));
    context_.code().list(node_.arguments)[input_.index].value = value_;
  }
  TypeId call(std::string_view function) {
    replaceArgument();
    return callLibrary(context_, expr_, function, expected_, name_);
  }

  TypeId toString() {
    if (source_ != target_) return call("TO_" + nameOf(target_));
    context_.replace(expr_, value_);
    return context_.type(expr_);
  }

  TypeId fromString() {
    const std::string function = nameOf(source_) + "_TO_" + nameOf(target_);
    if (sameIdentifier(function, string(context_, name_))) return {};  // the library has no such function
    return call(function);
  }

  TypeId truncate() {
    const Entity trunc = lookUp(context_, context_.names().intern("TRUNC"));
    if (!TypeTable::isReal(source_) || !(TypeTable::isInteger(target_) || TypeTable::isBits(target_)))
      return reportValue("ANY_REAL");
    if (trunc.entityKind() != EntityKind::Pou) return {};
    replaceArgument();
    return checkGenericCall(context_, expr_, PouId{trunc.index}, expected_, rule_.to);
  }

  // A number or time of day is converted to a date through the date and time that it counts, so that a DATE is always a
  // whole day.
  TypeId convertValue() {
    const bool to_day = target_ == TypeKind::Date || target_ == TypeKind::LDate;
    const bool is_time_of_day = source_ == TypeKind::TimeOfDay || source_ == TypeKind::LTimeOfDay;
    if (to_day && (is_time_of_day || !TypeTable::isDate(source_)))
      wrapConvert(context_, value_, types::idOf(target_ == TypeKind::Date ? TypeKind::DateTime : TypeKind::LDateTime));
    wrapConvert(context_, value_, rule_.to);
    context_.code().expr(value_).loc = node_.h.loc;
    if (input_.en || input_.eno) return guardValue(context_, expr_, value_);
    context_.replace(expr_, value_);
    return rule_.to;
  }

  Context& context_;
  ExprId& expr_;
  CallExpr& node_;
  NameId name_;
  const Rule& rule_;
  TypeId expected_;
  OneInput input_;
  ExprId value_;
  TypeId from_;
  TypeKind source_ = TypeKind::None, target_ = TypeKind::None;
};

// MUX_INT, ADD_TIME, SUB_DATE_DATE: a generic function and the types of its inputs.
TypeId checkTypedCall(Context& context, ExprId& expr, std::string_view name, TypeId expected) {
  CallExpr& node = context.code().as<CallExpr>(expr);
  const size_t cut = name.find('_');
  if (cut == std::string_view::npos || cut == 0) return {};
  const NameId function = context.names().find(name.substr(0, cut));
  if (!function) return {};
  std::vector<TypeId> operand_types;
  for (size_t at = cut + 1; at <= name.size();) {
    size_t end = name.find('_', at);
    TypeId type = typeNamed(context, name.substr(at));  // TIME_OF_DAY contains underscores
    if (type) {
      end = name.size();
    } else {
      if (end == std::string_view::npos) return {};
      type = typeNamed(context, name.substr(at, end - at));
    }
    if (!type) return {};
    operand_types.push_back(type);
    at = end + 1;
  }
  const Entity entity = lookUp(context, function);
  if (entity.entityKind() != EntityKind::Pou || operand_types.empty()) return {};
  const PouId id{entity.index};
  const Pou& pou = context.symbols.pou(id);
  if (pou.kind != PouKind::Function || (pou.pragmas.operator_kind == OperatorKind::None && !pou.generic)) return {};
  pinsOf(context, id);
  noteCall(context, id, node.h.loc);
  context.meaning(node.callee).entity = entity;
  TypeId forced = operand_types[0];
  if (operand_types.size() > 1) {
    forced = {};
    for (uint32_t i = 0; i < node.arguments.count && i < operand_types.size(); ++i) {
      ExprId value = context.tree().list(node.arguments)[i].value;
      if (!value) continue;
      const bool ok = operandAs(context, value, operand_types[i], function);
      context.code().list(node.arguments)[i].value = value;
      if (!ok) return meaning(node.h).type = types::kError;
    }
  }
  if (pou.pragmas.operator_kind != OperatorKind::None) return checkOperatorCall(context, expr, id, expected, forced);
  return checkGenericCall(context, expr, id, expected, forced);
}

}  // namespace

TypeId guardValue(Context& context, ExprId& expr, ExprId value) {
  const CallExpr& node = context.tree().as<CallExpr>(expr);
  if (context.tree().kind(value) != ExprKind::Convert) wrapConvert(context, value, context.type(value));
  std::vector<Argument> arguments;
  for (const Argument& argument : context.tree().list(node.arguments)) {
    const std::string_view pin = argument.pin.name ? string(context, argument.pin.name) : std::string_view();
    if (sameIdentifier(pin, argument.is_output ? kEnableOutput : kEnable)) arguments.push_back(argument);
  }
  arguments.push_back(Argument{{}, value, false, false, node.h.loc});
  const ExprId guarded = context.code().duplicate(expr);
  context.code().as<CallExpr>(guarded).arguments = context.code().addList<Argument>(arguments);
  context.replace(expr, guarded);
  const NameId name = context.tree().as<NameExpr>(node.callee).name;
  return callLibrary(context, expr, kMove, context.type(value), name);
}

TypeId checkRuleCall(Context& context, ExprId& expr, NameId name, TypeId expected) {
  std::string spelling = upper(string(context, name));
  if (spelling == "MULTIME" || spelling == "DIVTIME") spelling.insert(3, 1, '_');  // as edition 2 writes it, table 30
  if (spelling.find('_') == std::string::npos) return {};
  const Rule rule = ruleOf(context, spelling);
  if (rule.kind != Rule::Kind::None) {
    const TypeId type = ConversionCall(context, expr, name, rule, expected).check();
    if (type) context.type(expr) = type;
    return type;
  }
  return checkTypedCall(context, expr, spelling, expected);
}

}  // namespace rung::sema

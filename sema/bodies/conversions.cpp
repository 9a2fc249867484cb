// SPDX-License-Identifier: Apache-2.0
// Conversions: which are implicit, which lose values, which need a function. In: checked expressions and the type
// that is wanted. Out: ConvertExpr nodes in the parent's child field, or one message. docs/language.md "Dialects".
#include "sema/bodies/conversions.h"

#include "frontend/source/dialect.h"
#include "sema/access.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/implicit_checks.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/names.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/types.h"
#include "sema/declarations/uncopied.h"
#include "sema/fixes.h"
#include "sema/hooks.h"
#include "sema/intermediate.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"
#include "sema/types/arithmetic.h"

namespace rung::sema {

namespace {

using types::TypeTable;

bool isWholeKind(TypeKind k) { return TypeTable::isInteger(k) || TypeTable::isBits(k); }

Fit fitNumbers(const Context& context, TypeId from, TypeId to) {
  const TypeKind a = context.types().plainKind(from), b = context.types().plainKind(to);
  if (TypeTable::isReal(a) && isWholeKind(b)) return Fit::No;
  const bool lossless = types::isLossless(context.types(), from, to);
  if (!context.profile().bits_as_integers && TypeTable::isBits(a) != TypeTable::isBits(b)) return Fit::Extension;
  return lossless ? Fit::Lossless : Fit::Lossy;
}

// DATE and LDATE, TIME and LTIME …: the same quantity in another size.
bool sameQuantity(TypeKind a, TypeKind b) {
  const auto group = [](TypeKind k) {
    if (TypeTable::isDuration(k)) return 1;
    if (k == TypeKind::Date || k == TypeKind::LDate) return 2;
    if (k == TypeKind::TimeOfDay || k == TypeKind::LTimeOfDay) return 3;
    return k == TypeKind::DateTime || k == TypeKind::LDateTime ? 4 : 0;
  };
  return group(a) != 0 && group(a) == group(b);
}

// The name of the function that converts, if there is one: from characters and strings those that the library declares,
// otherwise a rule for each pair.
std::string conversionName(const Context& constant, TypeId from, TypeId to) {
  Context context = constant;
  const auto word = [&](TypeId type) -> std::string {
    const types::TypeInfo& own = context.types().info(context.types().resolve(type));
    if (own.kind == TypeKind::Enum)
      return own.name && !own.shown_name ? std::string(string(context, own.name)) : std::string("ANY");
    if (own.kind == TypeKind::Pointer && type == from &&
        context.profile().pointers_as_numbers) {  // a number in codesys
      const types::TypeInfo& target = context.types().info(context.types().resolve(own.base));
      const bool is_interface = target.kind == TypeKind::Record && target.record_kind == types::RecordKind::Interface;
      if (is_interface || !TypeTable::isInteger(context.types().plainKind(to))) return {};
      return context.types().pointerSize() == 8 ? "LWORD" : "DWORD";
    }
    const TypeId plain = context.types().plain(type);
    const TypeKind kind = context.types().info(plain).kind;
    if (!TypeTable::isElementary(kind)) return {};
    return std::string(string(context, context.types().info(types::idOf(kind)).name));
  };
  const std::string source = word(from), target = word(to);
  if (source.empty() || target.empty() || source == target) return {};
  const std::string name = source + "_TO_" + target;
  const TypeKind a = context.types().plainKind(from), b = context.types().plainKind(to);
  const auto isText = [](TypeKind kind) { return TypeTable::isString(kind) || TypeTable::isCharacter(kind); };
  const bool is_declared = isText(a) && !isText(b);
  if (is_declared && lookUp(context, context.names().intern(name)).entityKind() != EntityKind::Pou) return {};
  return name;
}

}  // namespace

static std::string_view wordsOf(Use use) {
  switch (use) {
    case Use::Other: break;
    case Use::Assigned: return "assigned to";
    case Use::Condition: return "used as a condition";
    case Use::IfCondition: return "used as the condition of IF";
    case Use::ElsifCondition: return "used as the condition of ELSIF";
    case Use::WhileCondition: return "used as the condition of WHILE";
    case Use::UntilCondition: return "used as the condition of UNTIL";
    case Use::AssertCondition: return "used as the condition of ASSERT";
    case Use::ComparedByAssert: return "compared by ASSERT_NEAR";
    case Use::Set: return "used to set or reset a variable";
    case Use::CaseLabel: return "used as a CASE label";
    case Use::LoopControl: return "used as the control variable of FOR";
    case Use::LoopLimit: return "used as the limit of";
    case Use::LoopStep: return "added to";
    case Use::PassedToInput: return "passed to the input of";
    case Use::Passed: return "passed to";
    case Use::PassedToEn: return "passed to `EN`";
    case Use::CopiedFromOutput: return "copied from output";
    case Use::CopiedFromEno: return "copied from output `ENO`";
    case Use::BoundToOutput: return "bound to output";
    case Use::BoundToEno: return "bound to output `ENO`";
    case Use::BoundToInOut: return "bound to in-out";
    case Use::Deleted: return "deleted";
    case Use::OtherOperand: return "converted to the type of the other operand";
  }
  return {};
}

std::string Purpose::toString(const Context& context) const {
  std::string out(use == Use::Other ? words : wordsOf(use));
  if (name) out.append(" `").append(string(context, name)).append("`");
  if (of) out.append(" of `").append(string(context, of)).append("`");
  return out;
}

bool sameType(const Context& context, TypeId a, TypeId b) {
  const types::TypeTable& table = context.types();
  a = table.resolve(a);
  b = table.resolve(b);
  if (a == b) return true;
  const types::TypeInfo& left = table.info(a);
  const types::TypeInfo& right = table.info(b);
  if (left.kind != right.kind) return false;
  if (left.kind == TypeKind::Pointer || left.kind == TypeKind::Reference) {
    return sameType(context, left.base, right.base);
  }
  if (left.kind != TypeKind::Array || left.dimensions.size() != right.dimensions.size()) return false;
  for (size_t i = 0; i < left.dimensions.size(); ++i) {
    if (left.dimensions[i].low != right.dimensions[i].low || left.dimensions[i].high != right.dimensions[i].high) {
      return false;
    }
  }
  return sameType(context, left.base, right.base);
}

// A pointer to a string may point to a longer one.
static bool pointsAlike(const Context& context, TypeId from, TypeId to) {
  const types::TypeInfo& source = context.types().info(context.types().resolve(from));
  const types::TypeInfo& target = context.types().info(context.types().resolve(to));
  if (TypeTable::isString(source.kind) && source.kind == target.kind) return source.length >= target.length;
  return sameType(context, from, to);
}

// Arrays of one element type whose dimensions have as many elements, with other bounds: codesys copies element by
// element.
static bool haveEqualLengths(const Context& context, const types::TypeInfo& a, const types::TypeInfo& b) {
  if (a.kind != TypeKind::Array || b.kind != TypeKind::Array || a.dimensions.size() != b.dimensions.size())
    return false;
  for (size_t i = 0; i < a.dimensions.size(); ++i)
    if (a.dimensions[i].count() != b.dimensions[i].count()) return false;
  return sameType(context, a.base, b.base);
}

// A structure that extends another one begins with its members.
bool extendsStructure(const Context& context, TypeId derived, TypeId base) {
  base = context.types().resolve(base);
  for (;;) {
    const NamedType* named = context.scopes.named(context.types().resolve(derived));
    if (named == nullptr || !named->type || context.tree().kind(named->type) != TypeExprKind::Struct) return false;
    const TypeExprId extended = context.tree().as<StructTypeExpr>(named->type).base;
    if (!extended) return false;
    derived = typeAsWritten(context, extended);
    if (!derived || derived == types::kError) return false;
    if (context.types().resolve(derived) == base) return true;
  }
}

namespace {

bool isInterface(const Context& context, const types::TypeInfo& type) {
  if (type.kind != TypeKind::Pointer) return false;
  const types::TypeInfo& target = context.types().info(context.types().resolve(type.base));
  return target.kind == TypeKind::Record && target.record_kind == types::RecordKind::Interface;
}

// An object where an interface that it implements is wanted, and a pointer to an object where one to its base is.
bool isObjectFit(const Context& constant, const types::TypeInfo& source, TypeId from, const types::TypeInfo& target) {
  Context context = constant;
  const PouId wanted = pouOf(context, target.base);
  const PouId given = source.kind == TypeKind::Record    ? pouOf(context, from)
                      : source.kind == TypeKind::Pointer ? pouOf(context, source.base)
                                                         : PouId{};
  if (!wanted || !given || wanted == given) return false;
  if (source.kind == TypeKind::Record && context.symbols.pou(wanted).kind != PouKind::Interface) return false;
  return isKindOf(context, given, wanted);
}

// codesys: the value of an object or structure that extends another one contains a value of that.
bool isPartOf(const Context& constant, TypeId from, TypeId to) {
  Context context = constant;
  if (!context.profile().copied_base_parts || context.types().kind(from) != TypeKind::Record ||
      context.types().kind(to) != TypeKind::Record)
    return false;
  const PouId base = pouOf(context, to), object = pouOf(context, from);
  const bool is_block = base && context.symbols.pou(base).kind == PouKind::FunctionBlock;
  return is_block ? object && isKindOf(context, object, base) : extendsStructure(context, from, to);
}

}  // namespace

bool isNamedValueOf(const Context& context, TypeId a, TypeId b) {
  const types::TypeTable& table = context.types();
  const types::TypeInfo &left = table.info(table.resolve(a)), &right = table.info(table.resolve(b));
  if (left.named_values == right.named_values) return false;
  return left.named_values ? table.resolve(left.base) == table.resolve(b)
                           : table.resolve(right.base) == table.resolve(a);
}

Fit fit(const Context& context, TypeId from, TypeId to) {
  const types::TypeTable& table = context.types();
  from = table.resolve(from);
  to = table.resolve(to);
  if (from == to || from == types::kError || to == types::kError) return Fit::Same;
  const types::TypeInfo& source = table.info(from);
  const types::TypeInfo& target = table.info(to);
  const TypeKind a = table.plainKind(from), b = table.plainKind(to);
  if (source.kind == TypeKind::Enum || target.kind == TypeKind::Enum) {
    if (!context.profile().enums_as_numbers && isNamedValueOf(context, from, to)) return Fit::Lossless;
    if (source.kind == target.kind) return context.profile().enums_become_others ? Fit::Lossy : Fit::No;
    if (target.strict) return Fit::No;
    if (!TypeTable::isNumber(a) || !TypeTable::isNumber(b)) return Fit::No;
    if (TypeTable::isReal(a)) return Fit::No;
    if (!context.profile().enums_as_numbers) return Fit::Extension;
    if (target.kind == TypeKind::Enum) return Fit::Lossy;
    const Fit plain = fit(context, table.plain(from), to);
    return plain == Fit::Same ? Fit::Lossless : plain;
  }
  if (source.kind == TypeKind::Subrange || target.kind == TypeKind::Subrange) {
    const Fit plain = fit(context, table.plain(from), table.plain(to));
    if (plain == Fit::Same) return Fit::Lossless;
    return plain == Fit::Lossy && types::isLossless(table, from, to) ? Fit::Lossless : plain;
  }
  if (TypeTable::isNumber(a) && TypeTable::isNumber(b)) return fitNumbers(context, from, to);
  // Figure 12 of edition 3.
  if (a == TypeKind::Bool && TypeTable::isBits(b) && context.profile().bool_widens) return Fit::Lossless;
  if (sameQuantity(a, b)) return types::isLossless(table, from, to) ? Fit::Lossless : Fit::Lossy;
  if (TypeTable::isString(a) && a == b) return Fit::Same;  // cut to the capacity where it is stored
  // An addition of edition 4.
  const bool widens =
      (a == TypeKind::String && b == TypeKind::WString) || (a == TypeKind::Char && b == TypeKind::WChar);
  if (widens && context.symbols.profile.strings_widen) return Fit::Lossless;
  if (context.profile().arrays_of_equal_lengths && haveEqualLengths(context, source, target)) return Fit::Lossless;
  if (target.kind == TypeKind::Pointer) {
    if (source.kind == TypeKind::NullLiteral) return Fit::Same;
    if (isObjectFit(context, source, from, target)) return Fit::Lossless;
    if (isInterface(context, target) || isInterface(context, source))
      return sameType(context, from, to) ? Fit::Same : Fit::No;
    if (source.kind == TypeKind::Pointer && extendsStructure(context, source.base, target.base)) return Fit::Lossless;
    if (source.kind == TypeKind::Pointer)
      return pointsAlike(context, source.base, target.base) ? Fit::Same : Fit::Pointer;
  }
  // CODESYS accepts a pointer as the number of its first byte, and a number as a pointer.
  if (isInterface(context, source)) return Fit::No;
  if ((target.kind == TypeKind::Pointer && isWholeKind(a)) || (source.kind == TypeKind::Pointer && isWholeKind(b))) {
    const uint32_t bits = table.pointerSize() * 8;
    if (!context.profile().pointers_as_numbers) return Fit::No;
    const bool narrow = source.kind == TypeKind::Pointer && TypeTable::bitWidth(b) < bits;
    return narrow ? Fit::Lossy : Fit::Lossless;
  }
  if (sameType(context, from, to)) return Fit::Same;
  return isPartOf(context, from, to) ? Fit::Lossless : Fit::No;
}

TypeId commonNumber(const Context& context, TypeId a, TypeId b) {
  const types::TypeTable& table = context.types();
  a = table.plain(a);
  b = table.plain(b);
  if (a == b) return a;
  const TypeKind x = table.info(a).kind, y = table.info(b).kind;
  if (!TypeTable::isNumber(x) || !TypeTable::isNumber(y)) return {};
  if (TypeTable::isBits(x) && TypeTable::isInteger(y) && TypeTable::bitWidth(x) == TypeTable::bitWidth(y)) {
    return TypeTable::isUnsignedInteger(y)
               ? b
               : commonNumber(context, table.plain(b),
                              types::idOf(static_cast<TypeKind>(static_cast<uint32_t>(TypeKind::USInt) +
                                                                static_cast<uint32_t>(x) -
                                                                static_cast<uint32_t>(TypeKind::Byte))));
  }
  if (TypeTable::isBits(y) && TypeTable::isInteger(x)) {
    if (TypeTable::bitWidth(x) == TypeTable::bitWidth(y)) return commonNumber(context, b, a);
  }
  if (types::isLossless(table, a, b)) return b;
  if (types::isLossless(table, b, a)) return a;
  if (TypeTable::isReal(x)) return a;
  if (TypeTable::isReal(y)) return b;
  for (const TypeId wider : {types::kInt, types::kDInt, types::kLInt}) {
    if (types::isLossless(table, a, wider) && types::isLossless(table, b, wider)) return wider;
  }
  return types::kLInt;
}

void wrapConvert(Context& context, ExprId& expr, TypeId to) {
  const ExprId created = context.build().convert(expr, context.tree().loc(expr));
  context.meaning(created).is_constant = context.meaning(expr).is_constant;
  const TypeId from = context.type(expr);
  context.replace(expr, typed(context, created, to));
  markRounding(context.symbols, created, from, context.isWide());
}

namespace {

// Literals without a type, and operators on them: `2`, `NOT 2`, `1 + 1`.
bool isOfPlainLiterals(const Tree& tree, ExprId expr) {
  if (tree.kind(expr) == ExprKind::Unary) return isOfPlainLiterals(tree, tree.as<UnaryExpr>(expr).operand);
  if (tree.kind(expr) == ExprKind::Binary)
    return isOfPlainLiterals(tree, tree.as<BinaryExpr>(expr).left) &&
           isOfPlainLiterals(tree, tree.as<BinaryExpr>(expr).right);
  return tree.kind(expr) == ExprKind::Literal && !tree.as<LiteralExpr>(expr).prefix;
}

// Names a number as it is written: the type that it was given is none of the user's. False: it is not such a number.
bool reportNumberForBool(Context& context, ExprId expr, TypeId to, const Purpose& purpose) {
  if (!isOfPlainLiterals(context.tree(), expr)) return false;
  const ExprId written = context.meaning(expr).written;
  if (!written) return false;
  const Range range = context.tree().range(written);
  const Sources& sources = context.symbols.sources;
  const FileId file = sources.fileOf(range.begin);
  const std::string_view spelling = sources.sourceText(file).substr(range.begin.offset - sources.begin(file).offset,
                                                                    range.end.offset - range.begin.offset);
  if (spelling.find('\n') != std::string_view::npos) return false;
  context.report(diag::WrongType, range.begin, {spelling, purpose.toString(context), context.types().toString(to)})
      .length(static_cast<uint32_t>(spelling.size()))
      .note({}, Note{"a BOOL is TRUE or FALSE"});
  return true;
}

}  // namespace

// The same characters as a string of the other width; none where they are written otherwise there.
static Fix otherQuotes(const Context& context, ExprId literal, char quote) {
  const Range range = sourceRange(context, literal);
  const std::string text = sourceText(context, range);
  if (text.size() < 2 || text.find_first_of("$'\"", 1) != text.size() - 1) return {};
  const std::string other = quote + text.substr(1, text.size() - 2) + quote;
  return {"Write `" + other + "`", {{range.begin, range.end, other}}, true};
}

bool reportFit(Context& context, Fit fitness, ExprId expr, TypeId from, TypeId to, const Purpose& purpose) {
  const Loc loc = context.tree().loc(expr);
  switch (fitness) {
    case Fit::Same:
    case Fit::Lossless: return true;
    case Fit::Lossy: {
      if (context.library) return true;
      const std::string function = conversionName(context, from, to);
      if (context.types().info(context.types().resolve(to)).kind == TypeKind::Enum) {
        context.report(diag::NumberToEnum, loc,
                       {context.types().toString(from), purpose.toString(context), context.types().toString(to)});
        return true;
      }
      context
          .report(context.profile().lossy_conversions ? diag::MayLoseValues : diag::LossyConversion, loc,
                  {context.types().toString(from), purpose.toString(context), context.types().toString(to), function})
          .fix(callAround(context, expr, function));
      return context.profile().lossy_conversions;
    }
    case Fit::Pointer:
      if (context.library) return true;
      context.report(context.profile().pointers_to_other_types ? diag::PointerToOther : diag::OtherPointer, loc,
                     {context.types().toString(from), purpose.toString(context), context.types().toString(to)});
      return context.profile().pointers_to_other_types;
    case Fit::Extension:
    case Fit::No: break;
  }
  const TypeKind own = context.types().plainKind(from), wanted = context.types().plainKind(to);
  if (context.tree().kind(expr) == ExprKind::Literal && !context.tree().as<LiteralExpr>(expr).prefix && own != wanted &&
      TypeTable::isString(own) && TypeTable::isString(wanted)) {
    const bool wide = own == TypeKind::WString;
    context
        .report(diag::StringQuotes, loc,
                {wide ? "double" : "single", wide ? "WSTRING" : "STRING",
                 string(context, context.types().info(types::idOf(wanted)).name), wide ? "single" : "double",
                 wide ? "'" : "\""})
        .fix(otherQuotes(context, expr, wide ? '\'' : '"'));
    return false;
  }
  if (wanted == TypeKind::Bool && TypeTable::isNumber(own) && reportNumberForBool(context, expr, to, purpose))
    return false;
  // Does not suggest BOOL_TO_TIME(FALSE): another constant is meant.
  const bool truth = own == TypeKind::Bool && context.tree().kind(expr) == ExprKind::Literal;
  const std::string function = truth ? std::string() : conversionName(context, from, to);
  if (function.empty()) {
    context.report(diag::WrongType, loc,
                   {context.types().toString(from), purpose.toString(context), context.types().toString(to)});
  } else {
    Report report = context.report(
        diag::NeedsConversion, loc,
        {context.types().toString(from), purpose.toString(context), context.types().toString(to), function});
    report.fix(callAround(context, expr, function));
    const bool is_duration = wanted == TypeKind::Time || wanted == TypeKind::LTime;
    if (is_duration && TypeTable::isInteger(own) && context.tree().kind(expr) == ExprKind::Literal)
      report.note({}, Note{"a time has a unit: write `T#{0}ms`"},
                  {std::to_string(context.tree().as<LiteralExpr>(expr).value())});
  }
  return false;
}

namespace {

// A constant is checked by its value: `VAR CONSTANT k : INT := 3` fits a SINT.
bool constantFits(Context& context, ExprId expr, TypeId to) {
  if (!context.profile().fitting_constants || !context.meaning(expr).is_constant) return false;
  const types::TypeInfo& target = context.types().info(context.types().resolve(to));
  const std::optional<types::Value> value = evaluate(context, expr);
  return value && target.kind != TypeKind::Enum && TypeTable::isScalar(context.types().plainKind(value->type)) &&
         !types::convert(context.types(), *value, to).overflow;
}

// A constant number for an enumeration becomes the item with that value. CODESYS and TwinCAT accept any number if the
// enumeration is not {attribute 'strict'}, and the number of an item if it is.
//   passes  actual := 1;     where Running is 1
//   warns   actual := 7;     where no item is 7                     W0549
//   fails   actual := 7;     the same of a strict enumeration       E0547
// False when this does not apply; `ok`: no error was reported.
bool takeItem(Context& context, ExprId& expr, TypeId to, bool& ok) {
  if (!context.profile().enums_as_numbers) return false;
  const TypeId target = context.types().resolve(to);
  const TypeId from = context.type(expr);
  const types::TypeInfo& info = context.types().info(target);
  if (info.kind != TypeKind::Enum || context.types().kind(from) == TypeKind::Enum) return false;
  __int128 number = 0;
  if (!isUntyped(context, from)) {
    if (!isWholeKind(context.types().plainKind(from)) || !context.meaning(expr).is_constant) return false;
    const std::optional<types::Value> value = evaluate(context, expr);
    if (!value) return false;
    number =
        context.types().isSigned(context.types().plainKind(from)) ? __int128{value->asSigned()} : __int128{value->bits};
  } else if (from != types::idOf(TypeKind::IntegerLiteral) || !untypedValue(context, expr, number)) {
    return false;
  }
  const NamedType* named = context.scopes.named(target);
  bool is_item = false;
  if (named == nullptr || named->resolved != State::Done) return false;
  named->members.forEach(
      [&](NameId, Entity item) { is_item |= __int128{context.symbols.enum_values[item.index].value} == number; });
  const Loc loc = context.tree().begin(expr);
  if (!is_item && !context.library) {
    const std::string spelling = number < 0 ? "-" + std::to_string(static_cast<uint64_t>(-number))
                                            : std::to_string(static_cast<uint64_t>(number));
    context.report(info.strict ? diag::NoItemOfStrict : diag::NoItem, loc, {spelling, context.types().toString(to)});
    if (info.strict) {
      context.type(expr) = types::kError;
      ok = false;
      return true;
    }
    if (!types::convert(context.types(), {types::kLInt, static_cast<uint64_t>(number)}, info.base).overflow)
      is_item = true;
  }
  if (!is_item) return false;
  context.replace(expr, makeInteger(context, to, number, loc));
  return true;
}

// False: a constant that the subrange must not take, which was reported.
bool checkSubrange(Context& context, ExprId expr, TypeId to) {
  if (context.types().kind(to) != TypeKind::Subrange || !context.meaning(expr).is_constant) return true;
  const TypeKind from = context.types().plainKind(context.type(expr));
  const std::optional<types::Value> value = isWholeKind(from) ? evaluate(context, expr) : std::nullopt;
  if (!value) return true;
  const __int128 number = context.types().isSigned(from) ? __int128{value->asSigned()} : __int128{value->bits};
  return isInSubrange(context, expr, number, to) || context.profile().free_subranges;
}

// A library's own name for POINTER TO BYTE stands for memory of any type, such as the rows of a cam.
bool isMemory(const Context& context, TypeId type) {
  const types::TypeInfo& named = context.types().info(type);
  if (named.kind != TypeKind::Alias) return false;
  const types::TypeInfo& pointer = context.types().info(context.types().resolve(type));
  if (pointer.kind != TypeKind::Pointer || context.types().kind(pointer.base) != TypeKind::Byte) return false;
  const NamedType* declared = context.scopes.named(type);
  return declared != nullptr && declared->library;
}

// codesys: the address of an array as that of its first element.
bool isFirstElement(const Context& context, TypeId from, TypeId to) {
  if (!context.profile().array_address_is_element_address) return false;
  const types::TypeInfo* source = &context.types().info(context.types().resolve(from));
  const types::TypeInfo& target = context.types().info(context.types().resolve(to));
  if (source->kind != TypeKind::Pointer || target.kind != TypeKind::Pointer) return false;
  TypeId element = source->base;
  while (context.types().kind(element) == TypeKind::Array) {
    element = context.types().info(context.types().resolve(element)).base;
    if (pointsAlike(context, element, target.base)) return true;
  }
  return false;
}

}  // namespace

bool convert(Context& context, ExprId& expr, TypeId to, const Purpose& purpose) {
  const TypeId from = context.type(expr);
  if (from == to) return from != types::kError && checkCopied(context, expr, to);
  if (!from || from == types::kError || to == types::kError) return false;
  __int128 number = 1;
  if (context.profile().zero_is_no_object && isUntyped(context, from) && untypedValue(context, expr, number) &&
      number == 0 && isInterface(context, context.types().info(context.types().resolve(to)))) {  // 0: no object
    context.replace(expr, makeLiteral(context, LiteralKind::Null, to, 0, context.tree().loc(expr)));
    return true;
  }
  if (bool ok = true; takeItem(context, expr, to, ok)) return ok;
  if (isUntyped(context, from)) return adapt(context, expr, to, purpose);
  Fit fitness = fit(context, from, to);
  if (fitness == Fit::Lossy && constantFits(context, expr, to)) fitness = Fit::Lossless;
  // A strict enumeration accepts an item of another one, but not a variable.
  const types::TypeInfo& wanted = context.types().info(context.types().resolve(to));
  if (fitness == Fit::Lossy && wanted.kind == TypeKind::Enum && wanted.strict && !context.meaning(expr).is_constant)
    fitness = Fit::No;
  const bool is_memory = fitness == Fit::Pointer &&
                         (isMemory(context, to) || isMemory(context, from) || isFirstElement(context, from, to));
  if (!is_memory && !reportFit(context, fitness, expr, from, to, purpose)) {
    context.type(expr) = types::kError;
    return false;
  }
  if (fitness == Fit::Same) {
    if (!checkCopied(context, expr, to)) return false;
    if (context.types().info(from).kind == TypeKind::NullLiteral) context.type(expr) = to;
    const types::TypeInfo& info = context.types().info(context.types().resolve(to));
    if (TypeTable::isString(info.kind) && context.tree().kind(expr) == ExprKind::Literal &&
        context.types().info(context.types().resolve(from)).length > info.length) {
      context.report(diag::StringTooLong, context.tree().loc(expr),
                     {std::to_string(context.types().info(context.types().resolve(from)).length),
                      context.types().toString(to), std::to_string(info.length)});
    }
    return true;
  }
  if (fitness == Fit::Lossless) context.rules->conversion(context, expr, to);
  if (!checkSubrange(context, expr, to)) {
    context.type(expr) = types::kError;
    return false;
  }
  if (context.types().kind(from) == TypeKind::Record)  // an object as an interface, which may change it
    if (const Entity object = entityOf(context, expr); object.entityKind() == EntityKind::Var)
      markAccess(context, VarId{object.index}, Access::Address, context.tree().loc(expr));
  callRangeCheck(context, expr, to);
  wrapConvert(context, expr, to);
  return true;
}

bool checkAs(Context& context, ExprId& expr, TypeId to, const Purpose& purpose) {
  if (!expr) return false;
  if (check(context, expr, to, Access::Read) == types::kError) return false;
  return convert(context, expr, to, purpose);
}

bool checkExprAs(Context& context, ExprId& expr, TypeId to, std::string_view what) {
  return checkAs(context, expr, to, Purpose{Use::Other, {}, {}, what});
}

void checkCondition(Context& context, ExprId& expr, Use use) {
  checkAs(context, expr, types::kBool, Purpose{use, {}, {}});
}

}  // namespace rung::sema

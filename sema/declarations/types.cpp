// SPDX-License-Identifier: Apache-2.0
// Types as written become TypeIds: elementary types, names, arrays, strings, subranges, enumerations, structures,
// pointers. Named types are resolved on first use; records only get their fields on demand, so that long chains of
// blocks within blocks need no deep recursion.
#include "sema/declarations/types.h"

#include "frontend/syntax/diagnostics.h"
#include "sema/declarations/bit_members.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/generics.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/limits.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/names.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/relative_addresses.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/hooks.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

#include <limits>

namespace rung::sema {

using types::Dimension;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

constexpr int64_t kMaxStringLength = 1 << 20;

// Flags in TypeExprHeader::bits.

// TwinCAT reaches the types of its type system, which libraries and the system declare, by the namespace Global too.
bool isGlobalNamespace(Context& context, NameId name) {
  return context.profile().global_namespace && sameIdentifier(context.names().string(name), "Global") &&
         !findNamespace(context, name);
}

// Forbids an undeclared type name, and a name that is not a type.
//   passes  m : Motor;       fails  m : Moter;         E0402, did you mean `Motor`?
void reportUnknownType(Context& context, NameId name, Loc loc, Entity found) {
  const std::string_view text = context.names().string(name);
  if (found.entityKind() == EntityKind::Pou) {
    context.report(diag::FunctionAsType, loc, {text}).declaredHere(context.symbols.pous[found.index].loc);
    return;
  }
  if (!isFirstReport(context, name)) return;
  if (const Entity hidden = context.scopes.libraries.hidden.find(keyOf(context, name))) {
    context.report(diag::NotInLibrary, loc, {text, context.project.options.libraries[hidden.index].hidden_by});
    return;
  }
  if (context.symbols.diagnostics.full()) {
    context.report(diag::UnknownType, loc, {text});
    return;
  }
  if (const std::string_view elsewhere = nameElsewhere(context, keyOf(context, name)); !elsewhere.empty()) {
    context.report(diag::UnknownType, loc, {text}).didYouMean(elsewhere);
    return;
  }
  std::vector<std::string_view> candidates;
  const auto add = [&](NameId key, Entity declared) {
    if (declared.entityKind() == EntityKind::Type) {
      const NameId spelling = context.types().info(TypeId{declared.index}).name;
      candidates.push_back(context.names().string(spelling ? spelling : key));
    } else if (declared.entityKind() == EntityKind::Pou &&
               context.symbols.pous[declared.index].kind != PouKind::Function) {
      candidates.push_back(context.names().string(context.symbols.pous[declared.index].name));
    }
  };
  if (const Namespace* space = namespaceAround(context); space != nullptr) space->names.forEach(add);
  context.scopes.pous_and_types.forEach(add);
  const Libraries& libraries = context.scopes.libraries;
  libraries.index.forEach(
      [&](NameId, Entity entry) { candidates.push_back(context.names().string(libraries.names[entry.index].name)); });
  for (uint32_t kind = 0; kind < static_cast<uint32_t>(TypeKind::Any); ++kind) {
    const NameId elementary = context.types().info(TypeId{kind}).name;
    if (elementary) candidates.push_back(context.names().string(elementary));
  }
  context.report(diag::UnknownType, loc, {text}).didYouMean(nearest(text, candidates));
}

// A type or block by name: of the namespaces around, of the symbols, then of libraries (inside a library, its own names
// first).
Entity findDeclaredType(Context& context, NameId key, Loc loc) {
  if (context.library) {
    if (const Entity found = lookUpLibrary(context, key)) return found;
  }
  if (context.region)
    if (const Entity found = lookUpAround(context, key, loc, true)) return found;
  if (const Entity found = context.scopes.pous_and_types.find(key)) return found;
  if (context.region)
    if (const Entity found = lookUpOpened(context, key, loc, true)) return found;
  return context.library ? Entity{} : lookUpLibrary(context, key);
}

Entity findType(Context& context, NameId name, Loc loc) {
  const NameId key = keyOf(context, name);
  return orMock(context, key, findDeclaredType(context, key, loc));
}

TypeId typeNamed(Context& context, Entity found) {
  if (found.entityKind() == EntityKind::Type) {
    const TypeId type{found.index};
    if (context.types().info(type).kind != TypeKind::Record) resolveNamed(context, type);
    return type;
  }
  if (found.entityKind() == EntityKind::Pou) {
    const Pou& pou = context.symbols.pous[found.index];
    return pou.kind == PouKind::Interface ? context.types().pointer(pou.record) : pou.record;
  }
  return {};
}

}  // namespace

TypeId ownTypeOfLateName(Context& context, NameId name, Loc loc, TypeKind kind) {
  if (kind != TypeKind::UString && kind != TypeKind::UChar) return {};
  const Entity found = lookUp(context, name);
  noteName(context, found, loc);
  return found.entityKind() == EntityKind::Type || found.entityKind() == EntityKind::Pou ? typeNamed(context, found)
                                                                                         : TypeId{};
}

namespace {

TypeId resolveNamedExpr(Context& context, const NamedTypeExpr& expr) {
  const uint32_t length = expr.path.count;
  if (length == 0) return types::kError;  // reported by the parser
  const Ident first = context.tree().list(expr.path)[0];
  const Ident last = context.tree().list(expr.path)[length - 1];
  const auto refuseGenerics = [&] {
    if (!expr.generics.empty())
      context.report(diag::SurplusGeneric, context.tree().list(expr.generics)[0].loc,
                     {context.names().string(last.name), "0"});
  };
  Entity found;
  if (length == 1) {
    if (const TypeId elementary = context.types().elementary(first.name)) {
      refuseGenerics();
      const TypeKind kind = context.types().info(elementary).kind;
      if (const TypeId own = ownTypeOfLateName(context, first.name, first.loc, kind)) return own;
      if (!TypeTable::isGeneric(kind) || !context.pou) return elementary;
      for (const Substitution& put : context.scopes.pous[context.pou.index].substitutions) {
        if (put.generic == kind) return put.type;
      }
      return elementary;
    }
    found = findType(context, first.name, first.loc);
  } else if (length == 2 && isGlobalNamespace(context, first.name)) {
    found = findType(context, last.name, last.loc);
  } else {
    found = lookUpQualified(context, expr.path);  // Lib.Motor, A.B.Motor
  }
  if (found.entityKind() == EntityKind::Error) return types::kError;
  if (!found && length == 1 && context.profile().bit_type && isNamedBit(context, last.name)) {
    context.report(diag::BitAsBool, last.loc);
    return types::kBool;
  }
  const bool is_block =
      found.entityKind() == EntityKind::Pou && context.symbols.pous[found.index].kind == PouKind::FunctionBlock;
  if (is_block) {
    const PouId instance = instantiateBlock(context, PouId{found.index}, expr);
    if (!instance) return types::kError;
    found = entity(instance);
  } else {
    refuseGenerics();
  }
  const TypeId type = typeNamed(context, found);
  noteMention(context, found, last.loc, Access::Qualifier);
  if (const NamedType* named = type ? context.scopes.named(type) : nullptr) {
    const DeclId decl = named->pou ? context.symbols.pou(named->pou).decl : named->decl;
    if (decl) context.rules->use(context, {named->pou, context.tree().decl(decl), last.name, last.loc, false});
  }
  if (type) return context.types().resolve(type) == types::kError ? types::kError : type;
  reportUnknownType(context, last.name, last.loc, found);
  return types::kError;
}

TypeId resolveString(Context& context, TypeExprId id) {
  const StringTypeExpr& expr = context.tree().as<StringTypeExpr>(id);
  const TypeKind kind = expr.code == StringEncoding::Wide   ? TypeKind::WString
                        : expr.code == StringEncoding::Utf8 ? TypeKind::UString
                                                            : TypeKind::String;
  if (!expr.length) return types::idOf(kind);
  const auto length = boundAsWritten(context, expr.length);
  if (!length) return types::kError;
  const int64_t least = context.profile().empty_strings ? 0 : 1;  // CODESYS knows STRING(0), which holds '' alone
  if (*length < least || *length > kMaxStringLength) {
    context.report(diag::StringLength, context.tree().begin(expr.length),
                   {std::to_string(*length), std::to_string(least), std::to_string(kMaxStringLength)});
    return types::kError;
  }
  const auto capacity = static_cast<uint32_t>(*length);
  return context.types().string(kind, capacity);
}

// Forbids ARRAY[*] as the type of anything but a VAR_IN_OUT. IEC 61131-3 ed. 3 table 15, 2.
//   passes  VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR      fails  p : POINTER TO ARRAY[*] OF INT      E0313
TypeId closedType(Context& context, TypeExprId written) {
  const TypeId type = resolveType(context, written);
  if (type == types::kError || !context.types().isOpenArray(type)) return type;
  context.report(diag::OpenArray, context.tree().loc(written));
  return types::kError;
}

// Forbids array bounds that are not constant or that are reversed. IEC 61131-3 ed. 3, 6.4.4.5.
//   passes  ARRAY[1..10] OF INT        fails  ARRAY[10..1] OF INT      E0306
TypeId resolveArray(Context& context, TypeExprId id) {
  const ArrayTypeExpr& expr = context.tree().as<ArrayTypeExpr>(id);
  std::vector<Dimension> dimensions;
  bool ok = true;
  uint32_t open = 0;
  for (uint32_t i = 0; i < expr.bounds.count; ++i) {
    const ArrayBound& bound = context.tree().list(expr.bounds)[i];
    if (!bound.low) {
      ++open;
      continue;
    }
    const auto low = boundAsWritten(context, bound.low);
    const auto high = boundAsWritten(context, bound.high);
    if (!low || !high) {
      ok = false;
    } else if (*low > *high && (!context.profile().empty_arrays || *low - 1 != *high)) {
      context
          .report(diag::ArrayBoundsReversed, context.tree().begin(bound.low),
                  {std::to_string(*low), std::to_string(*high)})
          .fix(exchanged(context, bound.low, bound.high));
      ok = false;
    } else if (*low < std::numeric_limits<int32_t>::min() || *high > std::numeric_limits<int32_t>::max()) {
      context.report(diag::ArrayBoundOutside, context.tree().begin(bound.low));
      ok = false;
    } else {
      if (*low > *high)
        context.report(diag::EmptyArray, context.tree().begin(bound.low),
                       {std::to_string(*low), std::to_string(*high)});
      dimensions.push_back({*low, *high});
    }
  }
  const TypeId element = closedType(context, expr.element);
  if (!ok || element == types::kError) return types::kError;
  if (open == 0) return context.types().array(element, dimensions);
  if (open == expr.bounds.count) return context.types().openArray(element, open);
  context.report(diag::OpenArray, expr.h.loc);
  return types::kError;
}

// The integer type under a subrange or an enumeration.
//   fails   TYPE t : REAL (0..1); END_TYPE              E0308
TypeId integerBase(Context& context, TypeExprId base, Diag diag) {
  const TypeId type = resolveType(context, base);
  if (type == types::kError) return type;
  const TypeKind kind = context.types().kind(type);
  if (TypeTable::isInteger(kind) || TypeTable::isBits(kind)) return context.types().resolve(type);
  context.report(diag, context.tree().loc(base), {context.types().toString(type)});
  return types::kError;
}

// True when the number is a value of the integer type; reports when not.
bool fits(Context& context, TypeId base, int64_t number, Loc loc) {
  const types::Value value{types::idOf(TypeKind::LInt), static_cast<uint64_t>(number)};
  if (!types::convert(context.types(), value, base).overflow) return true;
  context.report(diag::ValueOutOfType, loc, {std::to_string(number), context.types().toString(base)});
  return false;
}

void fillSubrange(Context& context, TypeId type, TypeExprId id) {
  const SubrangeTypeExpr& expr = context.tree().as<SubrangeTypeExpr>(id);
  const TypeId base = integerBase(context, expr.base, diag::SubrangeBase);
  const auto low = boundAsWritten(context, expr.low);
  const auto high = boundAsWritten(context, expr.high);
  TypeInfo& info = context.types().edit(type);
  info.base = base;
  bool ok = base != types::kError && low && high;
  if (ok) {
    ok = fits(context, base, *low, context.tree().begin(expr.low)) &&
         fits(context, base, *high, context.tree().begin(expr.high));
  }
  if (ok && *low > *high) {
    context
        .report(diag::SubrangeReversed, context.tree().begin(expr.low), {std::to_string(*low), std::to_string(*high)})
        .fix(exchanged(context, expr.low, expr.high));
    ok = false;
  }
  if (!ok) {  // its users stay silent
    info.kind = TypeKind::Alias;
    info.base = types::kError;
    return;
  }
  info.initial = info.low = *low;
  info.high = *high;
  if (!context.project.options.free_subranges) return;
  const TypeKind kind = context.types().plainKind(base);
  const uint32_t rest = 64 - TypeTable::bitWidth(kind);
  const bool is_signed = context.types().isSigned(kind);
  info.low = is_signed ? std::numeric_limits<int64_t>::min() >> rest : 0;
  info.high = is_signed ? std::numeric_limits<int64_t>::max() >> rest : static_cast<int64_t>(~uint64_t{0} >> rest);
}

// Items without a value follow the previous one, from 0. IEC 61131-3 ed. 3, 6.4.4.2 and table 11, 3.
void fillEnum(Context& context, TypeId type, TypeExprId id) {
  const EnumTypeExpr& expr = context.tree().as<EnumTypeExpr>(id);
  Symbols& symbols = context.symbols;
  TypeId base = types::kInt;
  if (expr.base) {
    base = integerBase(context, expr.base, diag::EnumBase);
    if (base == types::kError) base = types::kInt;
  }
  context.types().edit(type).base = base;
  context.types().edit(type).named_values = static_cast<bool>(expr.base);
  NamedType& named = *context.scopes.named(type);
  context.items_of = type;
  int64_t next = 0;
  for (uint32_t i = 0; i < expr.items.count; ++i) {
    const EnumItem& item = context.tree().list(expr.items)[i];
    bool ok = true;
    if (item.value) {
      const auto value = boundAsWritten(context, item.value);
      if (value) {
        next = *value;
      } else {
        ok = false;
      }
    }
    if (ok && !fits(context, base, next, item.value ? context.tree().begin(item.value) : item.item.loc)) next = 0;
    context.types().edit(type).items.emplace_back(item.item.name, next);
    const Entity declared = named.members.find(keyOf(context, item.item.name));
    if (declared.entityKind() == EntityKind::EnumValue && symbols.enum_values[declared.index].loc == item.item.loc) {
      symbols.enum_values[declared.index].value = next;
    }
    next = static_cast<int64_t>(static_cast<uint64_t>(next) + 1);  // after the largest value: wraps
  }
  context.items_of = {};
}

// A field for each field of the structure that this one extends, at the same offsets.
void inheritFields(Context& context, TypeId record, TypeExprId base_expr) {
  const TypeId base = context.types().resolve(resolveType(context, base_expr));
  if (base == types::kError) return;
  NamedType* named_base = context.scopes.named(base);
  const TypeInfo& info = context.types().info(base);
  if (named_base == nullptr || info.kind != TypeKind::Record || info.record_kind != RecordKind::Struct) {
    context.report(diag::ExtendsNoStruct, context.tree().loc(base_expr), {context.types().toString(base)});
    return;
  }
  resolveNamed(context, base);
  NamedType& named = *context.scopes.named(record);
  const auto inherit = [&](VarId inherited) {
    ensureInitialValue(context, inherited);
    Var var = context.symbols.var(inherited);
    const VarId id{static_cast<uint32_t>(context.symbols.vars.size())};
    var.record = record;
    var.decl = {};  // checked at its declaration
    context.symbols.vars.push_back(var);
    named.members.insert(keyOf(context, var.name), entity(id));
    return id;
  };
  const bool is_laid_out = ensureLayout(context, base);
  for (size_t i = 0; i < named_base->fields.size(); ++i) {
    addField(context, record, inherit(named_base->fields[i]));
    context.types().edit(record).fields.back().pack = info.fields[i].pack;
    if (is_laid_out) context.types().edit(record).fields.back().given_offset = info.fields[i].offset;
  }
  for (size_t i = 0; i < named_base->bits.size(); ++i) {
    const VarId id = inherit(named_base->bits[i]);
    Var& var = context.symbols.var(id);
    var.bits.holder = named.fields[var.field];
    named.bits.push_back(id);
    context.types().edit(record).bits.push_back({var.name, var.field, var.bits.bit});
  }
}

}  // namespace

TypeId addStructure(Context& context, TypeExprId written, NameId name) {
  const StructTypeExpr& expr = context.tree().as<StructTypeExpr>(written);
  const bool shares = expr.is_union || expr.overlaps;
  const TypeId type = context.types().addRecord(shares ? RecordKind::Union : RecordKind::Struct, name);
  context.types().edit(type).overlaps = expr.overlaps;
  return type;
}

namespace {

void fillRecord(Context& context, TypeId type, TypeExprId id) {
  const StructTypeExpr& expr = context.tree().as<StructTypeExpr>(id);
  Symbols& symbols = context.symbols;
  NamedType& named = *context.scopes.named(type);
  if (expr.base) inheritFields(context, type, expr.base);
  SectionDecl section{};
  section.section = SectionKind::Local;
  std::vector<VarId> vars;
  for (const DeclId decl : context.tree().list(expr.fields)) {
    if (context.tree().kind(decl) != DeclKind::Var) continue;
    declareVars(context, decl, section, {}, {}, &named.members, vars);
  }
  for (const VarId var : vars) {
    symbols.var(var).record = type;
    symbols.var(var).storage = Storage::Field;
  }
  bool placed = false;
  for (const VarId var : vars) {
    ensureVarType(context, var);
    const VarDecl& decl = context.tree().as<VarDecl>(symbols.var(var).decl);
    placed = placed || (decl.located && !decl.address.incomplete);
  }
  if (placed || expr.overlaps) return layOutMembers(context, type, vars);
  for (const VarId var : vars) addField(context, type, var);
}

// A name for a type written in place, in VAR, for generated code.
NameId anonymousTypeName(Context& context, Loc loc) {
  const SourceLocation location = context.symbols.sources.location(loc);
  std::string name = context.pou ? toString(context, context.symbols.pou(context.pou).unique_name) : "Type";
  name += "__" + std::to_string(location.line) + "_" + std::to_string(location.column);
  return context.names().intern(name);
}

NamedType& addAnonymousType(Context& context, TypeId type, TypeExprId written) {
  NamedType& named = addNamed(context, type);
  named.type = written;
  named.owner = context.pou;
  named.file = context.file;
  named.library = context.library;
  named.region = context.region;
  return named;
}

TypeId resolveWritten(Context& context, TypeExprId id) {
  const Tree& tree = context.tree();
  types::TypeTable& table = context.types();
  switch (tree.kind(id)) {
    case TypeExprKind::Error: return types::kError;
    case TypeExprKind::Named: return resolveNamedExpr(context, tree.as<NamedTypeExpr>(id));
    case TypeExprKind::String: return resolveString(context, id);
    case TypeExprKind::Array: return resolveArray(context, id);
    case TypeExprKind::Subrange: {
      const TypeId type = table.addSubrange({}, types::kInt, 0, 0);
      addAnonymousType(context, type, id).resolved = State::Done;
      fillSubrange(context, type, id);
      return type;
    }
    case TypeExprKind::Enum: {
      const TypeId type = table.addEnum({}, types::kInt);
      addAnonymousType(context, type, id).resolved = State::Busy;
      NameMap* bare = context.pou ? &context.scopes.pous[context.pou.index].names : &context.scopes.items;
      declareItems(context, type, id, bare, false);
      fillEnum(context, type, id);
      context.scopes.named(type)->resolved = State::Done;
      return type;
    }
    case TypeExprKind::Struct: {
      const TypeId type = addStructure(context, id, anonymousTypeName(context, tree.loc(id)));
      table.edit(type).shown_name = context.names().intern("STRUCT");
      addAnonymousType(context, type, id);
      return type;
    }
    case TypeExprKind::Pointer: {
      const PointerTypeExpr& expr = tree.as<PointerTypeExpr>(id);
      const TypeId target = closedType(context, expr.target);
      if (target == types::kError) return target;
      return expr.form == PointerForm::Reference ? table.reference(target) : table.pointer(target);
    }
  }
  return types::kError;
}

}  // namespace

// Forbids types that are nested so deep that a walk over them would exhaust the stack.
//   fails   2501 structures inside each other          E0220
void reportTooDeep(Context& context, Loc loc, const char* what, uint32_t limit) {
  context.report(diag::TooDeep, loc, {what, std::to_string(limit)});
}

TypeId lookUpType(Context& context, NameId name, Loc loc) {
  if (const TypeId elementary = context.types().elementary(name)) return elementary;
  return typeNamed(context, findType(context, name, loc));
}

TypeId resolveType(Context& context, TypeExprId id) {
  if (!id) return types::kError;  // reported by the parser
  auto& known = context.scopes.written_types;
  const WrittenType before = known[id];
  if (before.type) return before.type;
  const Loc loc = context.tree().loc(id);
  if (before.busy) {  // an array bound or length that depends on the type itself
    context.report(diag::TypeOfItself, loc);
    return known[id].type = types::kError;
  }
  if (context.scopes.depth > kMaxDeclarationDepth) {
    context.report(diag::DeclarationsTooDeep, loc, {context.symbols.sources.tokenAt(loc)});
    return known[id].type = types::kError;
  }
  known[id].busy = true;
  ++context.scopes.depth;
  const TypeId type = resolveWritten(context, id);
  --context.scopes.depth;
  WrittenType& now = known[id];
  now.busy = false;
  if (!now.type) now.type = type;
  return now.type;
}

TypeId typeAsWritten(const Context& context, TypeExprId id) { return context.scopes.written_types.find(id).type; }

void resolveNamed(Context& context, TypeId type) {
  NamedType* named = context.scopes.named(type);
  if (named == nullptr || named->resolved == State::Done) return;
  if (named->pou) return resolvePou(context, named->pou);
  if (!named->type) return;  // a global list
  if (named->resolved == State::Busy) {
    TypeInfo& info = context.types().edit(type);
    if (info.kind == TypeKind::Alias && info.base == types::kError && named->decl) {
      // Forbids an alias of itself.   fails  TYPE a : b; b : a; END_TYPE       E0304
      const TypeDecl& decl = context.tree().as<TypeDecl>(named->decl);
      context.report(diag::AliasOfItself, decl.h.loc, {context.names().string(decl.name)});
    }
    return;
  }
  if (context.scopes.depth > kMaxDeclarationDepth) {
    context.report(diag::DeclarationsTooDeep, context.tree().loc(named->type),
                   {context.names().string(context.types().info(type).name)});
    named->resolved = State::Done;
    return;
  }
  named->resolved = State::Busy;
  ++context.scopes.depth;
  Context there = at(context, named->owner, named->file, named->library, named->region);
  switch (context.tree().kind(named->type)) {
    case TypeExprKind::Enum: fillEnum(there, type, named->type); break;
    case TypeExprKind::Subrange: fillSubrange(there, type, named->type); break;
    case TypeExprKind::Struct: fillRecord(there, type, named->type); break;
    case TypeExprKind::Error: break;
    case TypeExprKind::Named:
    case TypeExprKind::String:
    case TypeExprKind::Array:
    case TypeExprKind::Pointer: {
      TypeId target = closedType(there, named->type);
      TypeId step = target;  // an alias that refers back to this type was reported
      while (step != type && context.types().info(step).kind == TypeKind::Alias) step = context.types().info(step).base;
      uint32_t depth = 0;
      for (TypeId inner = target; depth <= kMaxTypeDepth; inner = context.types().info(inner).base, ++depth) {
        const TypeKind kind = context.types().info(inner).kind;
        if (inner == type || (kind != TypeKind::Alias && kind != TypeKind::Array)) break;
      }
      if (depth > kMaxTypeDepth)
        reportTooDeep(there, context.tree().loc(named->type), "arrays and type names", kMaxTypeDepth);
      context.types().edit(type).base = step == type || depth > kMaxTypeDepth ? types::kError : target;
      break;
    }
  }
  --context.scopes.depth;
  context.scopes.named(type)->resolved = State::Done;
}

}  // namespace rung::sema

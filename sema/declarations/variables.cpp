// SPDX-License-Identifier: Apache-2.0
// Variables of POUs and global lists: their names first, then types and storage, then initial values; each on demand.
#include "sema/declarations/variables.h"

#include <algorithm>

#include "frontend/schedule/network_schedule.h"
#include "frontend/syntax/children.h"
#include "frontend/syntax/keywords.h"
#include "frontend/syntax/standard_names.h"
#include "sema/declarations/addresses.h"
#include "sema/declarations/attributes.h"
#include "sema/declarations/bit_members.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/configuration.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/expressions.h"
#include "sema/declarations/initial_values.h"
#include "sema/declarations/libraries.h"
#include "sema/declarations/limits.h"
#include "sema/declarations/names.h"
#include "sema/declarations/namespaces.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/shared_temporaries.h"
#include "sema/declarations/signatures.h"
#include "sema/declarations/types.h"
#include "sema/declarations/uncopied.h"
#include "sema/diagnostics.h"
#include "sema/fixes.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

using types::Field;
using types::FieldRole;
using types::TypeKind;

namespace {

// Whether a variable AT %I* has a separate address in each instance: in a block, or a program with several instances.
bool addressesPerInstance(const Context& context, PouId pou) {
  if (!pou || isFunction(context.symbols.pou(pou).kind)) return false;
  if (context.symbols.pou(pou).kind == PouKind::FunctionBlock) return true;
  return static_cast<bool>(context.scopes.instantiated.again.find(keyOf(context, context.symbols.pou(pou).name)));
}

Storage storageOf(const Context& context, SectionKind section, PouId pou, const VarDecl& decl) {
  if (decl.located && decl.address.incomplete && addressesPerInstance(context, pou)) return Storage::Field;
  if (decl.located) return Storage::Image;
  if (!pou || section == SectionKind::External || section == SectionKind::Stat) return Storage::Global;
  if (section == SectionKind::Temp || isFunction(context.symbols.pou(pou).kind)) return Storage::Local;
  return Storage::Field;
}

Context contextAt(Context& context, VarId id) {
  const Var& var = context.symbols.var(id);
  if (var.pou) return atPou(context, var.pou);
  if (const NamedType* named = var.record ? context.scopes.named(var.record) : nullptr) {
    Context there = at(context, named->owner, named->file, named->library, named->region);
    if (!named->owner) there.record = var.record;
    return there;
  }
  const NamedType* list = nullptr;
  if (var.list) list = context.scopes.named(context.symbols.global_lists[var.list.index].record);
  const auto& regions = context.scopes.regions.of_global;
  const auto region = regions.find(id.index);
  Context there = at(context, {}, context.symbols.sources.fileOf(var.loc), list != nullptr && list->library,
                     region == regions.end() ? RegionId{} : region->second);
  there.list = var.list;
  if (const NameId resource = var.list ? context.symbols.global_lists[var.list.index].resource : NameId{})
    there.resource = keyOf(context, resource);
  return there;
}

}  // namespace

namespace {

void takePragmas(Context& context, const DeclHeader& header, Var& var) {
  const Scopes::KnownNames& known = context.scopes.known_names;
  if (header.pragmas.empty()) return;
  var.pragmas.required = findPragma(context, header, known.required) != nullptr;
  var.pragmas.optional = findPragma(context, header, known.optional) != nullptr;
  var.pragmas.long_time = findPragma(context, header, known.long_time) != nullptr;
  var.pragmas.lazy = findPragma(context, header, known.lazy) != nullptr;
  var.pragmas.instance_path = findPragma(context, header, known.attributes.instance_path) != nullptr;
  takeVariableAttributes(context, header, var);
  if (const auto access = symbolAccessOf(context, header)) var.symbol_access = *access;
  var.pragmas.extensible = findPragma(context, header, known.extensible) != nullptr;
  for (const Pragma& pragma : context.tree().list(header.pragmas)) {
    if (keyOf(context, pragma.name) == known.alias)
      var.pragmas.aliases.push_back(context.names().intern(context.tree().string(pragma.value)));
  }
}

// What the variables of one declaration have in common.
Var describeVar(Context& context, DeclId decl_id, const SectionDecl& section, PouId pou, ListId list) {
  const VarDecl& decl = context.tree().as<VarDecl>(decl_id);
  Var var;
  var.decl = decl_id;
  var.section = section.section;
  var.access = section.access;
  var.storage = storageOf(context, section.section, pou, decl);
  var.edge = decl.edge;
  // TwinCAT accepts VAR_INPUT CONSTANT, but the input can be set, and written in its block.
  const bool settable = section.section == SectionKind::Input && context.profile().settable_constant_inputs;
  var.constant = section.qualifiers.constant && !settable;
  var.keeping.persistent = section.qualifiers.persistent;
  var.keeping.retain = section.qualifiers.isKept();
  var.keeping.non_retain = section.qualifiers.non_retain;
  var.generic = section.qualifiers.generic;
  var.pou = pou;
  var.list = list;
  if (pou)
    var.symbol_access = context.symbols.pou(pou).pragmas.symbol_access;
  else if (list)
    var.symbol_access = context.symbols.global_lists[list.index].symbol_access;
  takePragmas(context, decl.h, var);
  return var;
}

// Gives a variable its name and aliases in a scope.
void enter(Context& context, NameMap& names, VarId id, const VarDecl& decl) {
  const Var& var = context.symbols.var(id);
  const NameId key = keyOf(context, var.name);
  if (!names.insert(key, entity(id))) {
    const Entity first = names.find(key);
    const Loc loc = first.entityKind() == EntityKind::Var ? context.symbols.vars[first.index].loc : Loc{};
    // A declaration that could not be read declares nothing.
    if (!decl.type || context.tree().kind(decl.type) != TypeExprKind::Error)
      reportTwice(context, var.name, var.loc, loc);
    return;
  }
  for (const NameId alias : var.pragmas.aliases) names.insert(keyOf(context, alias), entity(id));
}

}  // namespace

void declareVars(Context& context, DeclId decl_id, const SectionDecl& section, PouId pou, ListId list, NameMap* names,
                 std::vector<VarId>& into) {
  Symbols& symbols = context.symbols;
  const VarDecl& decl = context.tree().as<VarDecl>(decl_id);
  Var var = describeVar(context, decl_id, section, pou, list);
  const uint32_t count = decl.names.empty() ? 1 : decl.names.count;  // an unnamed located variable
  for (uint32_t i = 0; i < count; ++i) {
    const VarId id{static_cast<uint32_t>(symbols.vars.size())};
    var.loc = decl.h.loc;
    if (!decl.names.empty()) {
      const Ident& ident = context.tree().list(decl.names)[i];
      var.name = ident.name;
      var.loc = ident.loc;
    }
    symbols.vars.push_back(var);
    into.push_back(id);
    if (var.name)
      enter(context, *names, id, decl);
    else if (decl.located && !decl.address.incomplete)
      context.scopes.addresses.unnamed[addressKey(context, decl.address)].push_back(id);
  }
}

static bool isBase(const Context& context, VarId id) {
  const PouId pou = context.symbols.var(id).pou;
  return pou && context.symbols.pou(pou).object.base_var == id;
}

void addField(Context& context, TypeId record, VarId id) {
  if (context.symbols.var(id).bits.is_bit) return addBit(context, record, id);
  Var& var = context.symbols.var(id);
  Field field;
  field.name = var.name;
  field.type = var.type;
  field.role = var.section == SectionKind::Input    ? FieldRole::Input
               : var.section == SectionKind::Output ? FieldRole::Output
               : var.section == SectionKind::InOut  ? FieldRole::InOut
               : isBase(context, id)                ? FieldRole::Base
               : var.pou                            ? FieldRole::Local
                                                    : FieldRole::Member;
  field.by_reference = var.section == SectionKind::InOut;
  if (context.types().isOpenArray(var.type)) {  // a pointer to the first element; the bounds are separate fields
    field.type = context.types().pointer(context.types().info(context.types().resolve(var.type)).base);
    field.by_reference = false;
  }
  field.retain = var.keeping.retain;
  field.non_retain = var.keeping.non_retain;
  field.no_copy = var.pragmas.no_copy || var.pragmas.set_by_change;
  field.persistent = var.keeping.persistent;
  field.constant = var.constant;
  field.symbol_access = var.symbol_access;
  types::TypeInfo& info = context.types().edit(record);
  field.pack = info.pack;
  var.field = static_cast<uint32_t>(info.fields.size());
  info.fields.push_back(field);
  context.scopes.named(record)->fields.push_back(id);
}

namespace {

// Forbids R_EDGE and F_EDGE on anything but a BOOL input of a block. IEC 61131-3 ed. 3 table 40, 4.
//   fails   VAR_INPUT clk : INT R_EDGE; END_VAR        E0333
void checkEdge(Context& context, const Var& var) {
  if (var.edge == EdgeKind::None || var.type == types::kError) return;
  const bool block = var.pou && !isFunction(context.symbols.pou(var.pou).kind) && !var.bits.is_bit;
  if (block && var.section == SectionKind::Input && context.types().kind(var.type) == TypeKind::Bool) return;
  context.report(diag::EdgeNotBool, var.loc, {context.names().string(var.name)});
}

// VAR_EXTERNAL CONSTANT
Fix constantSection(const Context& context, const Var& var) {
  const Tree& tree = context.tree();
  if (!var.pou || !context.symbols.pou(var.pou).decl) return {};
  for (const DeclId id : tree.list(tree.as<PouDecl>(context.symbols.pou(var.pou).decl).sections)) {
    const SectionDecl& section = tree.as<SectionDecl>(id);
    const std::span<const DeclId> vars = tree.list(section.vars);
    if (std::find(vars.begin(), vars.end(), var.decl) == vars.end()) continue;
    const Loc end{section.h.loc.offset + static_cast<uint32_t>(std::string_view("VAR_EXTERNAL").size())};
    return {"Write `VAR_EXTERNAL CONSTANT`", {{end, end, " CONSTANT"}}, true};
  }
  return {};
}

// In the declaration of a variable.
Fix otherType(const Context& context, const Var& var, const std::string& type) {
  if (!var.decl || context.tree().kind(var.decl) != DeclKind::Var) return {};
  const TypeExprId written = context.tree().as<VarDecl>(var.decl).type;
  const Range range = written ? context.tree().range(written) : Range{};
  return range.begin < range.end ? Fix{"Write `" + type + "`", {{range.begin, range.end, type}}, false} : Fix{};
}

// Forbids a VAR_EXTERNAL without its VAR_GLOBAL, or with another type. IEC 61131-3 ed. 3, 6.5.2.2.
//   passes  VAR_GLOBAL level : REAL; END_VAR … VAR_EXTERNAL level : REAL; END_VAR
//   fails   VAR_EXTERNAL level : INT; END_VAR          E0335
void matchExternal(Context& context, VarId id) {
  Symbols& symbols = context.symbols;
  const NameId name = symbols.var(id).name;
  const Loc loc = symbols.var(id).loc;
  Entity found;
  for (const Namespace* space = namespaceAround(context); space != nullptr && !found;
       space = space->outer == kNoLibrary ? nullptr : &context.scopes.libraries.list[space->outer])
    found = space->globals.find(keyOf(context, name));
  if (!found)
    found = globalOfResource(context, keyOf(context, name), context.scopes.globals.find(keyOf(context, name)));
  if (!found) found = lookUpLibrary(context, keyOf(context, name), kNoLibrary);
  if (found.entityKind() != EntityKind::Var) {
    std::vector<std::string_view> candidates;
    context.scopes.globals.forEach(
        [&](NameId, Entity global) { candidates.push_back(context.names().string(symbols.vars[global.index].name)); });
    context.report(diag::ExternalUnknown, loc, {context.names().string(name)})
        .didYouMean(nearest(context.names().string(name), candidates));
    symbols.var(id).type = types::kError;
    return;
  }
  if (differsByResource(context, keyOf(context, name))) {
    context.report(diag::GlobalDiffers, loc, {context.names().string(name)});
    symbols.var(id).type = types::kError;
    return;
  }
  const VarId global_id{found.index};
  ensureVarType(context, global_id);
  Var& var = symbols.var(id);
  const Var& global = symbols.var(global_id);
  const types::TypeTable& table = context.types();
  if (var.type != types::kError && global.type != types::kError &&
      table.resolve(var.type) != table.resolve(global.type)) {
    context
        .report(diag::ExternalType, loc,
                {context.names().string(name), table.toString(var.type), table.toString(global.type)})
        .declaredHere(global.loc)
        .fix(otherType(context, var, table.toString(global.type)));
    var.type = types::kError;
    return;
  }
  if (global.constant && !var.constant && !context.profile().implied_constant_externals)
    context.report(diag::ExternalConstant, loc, {context.names().string(name)})
        .declaredHere(global.loc)
        .fix(constantSection(context, var));
  if (global.constant) var.constant = true;
  var.external = global_id;
  var.storage = global.storage;
  var.list = global.list;
  var.field = global.field;
  var.image = global.image;
  if (global.constant) {
    ensureInitialValue(context, global_id);
    var.has_value = symbols.var(global_id).has_value;
    var.value = symbols.var(global_id).value;
  }
}

// Forbids initial values where they would have no effect. IEC 61131-3 ed. 3, 6.5.1.3; manual 5.3.3.
//   fails   VAR_EXTERNAL level : REAL := 1.0; END_VAR  E0324
bool mayHaveInitialValue(Context& context, const Var& var, ExprId init) {
  if (context.types().isOpenArray(var.type) && var.section != SectionKind::InOut) {
    context.report(diag::InitialValueNotAllowed, context.tree().begin(init), {"ARRAY[*]"})
        .fix(withoutPart(context, var.loc, ":=", context.tree().expr(init).end));
    return false;
  }
  if (var.section != SectionKind::External && var.section != SectionKind::InOut) return true;
  context.report(diag::InitialValueNotAllowed, context.tree().begin(init), {keywordOf(var.section)})
      .fix(withoutPart(context, var.loc, ":=", context.tree().expr(init).end));
  return false;
}

// ARRAY[*]: a pin of any direction of a call; in an instance only a pin that each call binds again.
bool mayBeOpen(const Context& context, const Var& var) {
  if (var.section == SectionKind::InOut) return true;
  const bool of_call = var.pou && isFunction(context.symbols.pou(var.pou).kind);
  return of_call && (var.section == SectionKind::Input || var.section == SectionKind::Output);
}

bool isBlock(const Context& context, TypeId type) {
  while (context.types().kind(type) == TypeKind::Array) type = context.types().info(context.types().resolve(type)).base;
  if (context.types().kind(type) != TypeKind::Record) return false;
  return context.types().info(context.types().resolve(type)).record_kind == types::RecordKind::FunctionBlock;
}

bool isForTests(const Context& context, PouId pou) {  // a test runs once
  const auto& pragmas = context.symbols.pou(pou).pragmas;
  return pragmas.test || pragmas.test_only;
}

// Forbids, in iec: an address of a VAR_EXTERNAL, and a complete one in a block or function; an instance of a block as a
// constant, and in iec2 one in a function, which has no memory for it (elsewhere a warning). IEC 61131-3 ed. 3 table
// 13, grammar of External_Decl and FB_Decl; ed. 2, 2.5.1 and table 16b; CODESYS, SA0167.
//   passes  FUNCTION_BLOCK f VAR o AT %Q* : BOOL; END_VAR
//   fails   FUNCTION_BLOCK f VAR o AT %QX0.1 : BOOL; END_VAR                          E0632
Loc endOfAddress(const Context& context, const VarDecl& decl) {
  const std::string_view address = context.symbols.sources.tokenAt(decl.address_loc);
  return {decl.address_loc.offset + static_cast<uint32_t>(address.size())};
}

void checkPlacement(Context& there, const Var& var, const VarDecl& decl) {
  if (there.library || var.record) return;
  const std::string_view name = there.names().string(var.name);
  const PouKind kind = var.pou ? there.symbols.pou(var.pou).kind : PouKind::Program;
  if (!there.profile().located_externals && decl.located && var.section == SectionKind::External)
    there.report(diag::ExternalAddress, decl.address_loc, {name})
        .fix(withoutPart(there, var.loc, "AT", endOfAddress(there, decl)));
  else if (!there.profile().addresses_in_blocks && decl.located && !decl.address.incomplete && kind != PouKind::Program)
    there.report(diag::AddressInBlock, decl.address_loc, {keywordOf(kind)});
  const bool has_memory = var.section == SectionKind::Local || var.section == SectionKind::Temp || !var.pou;
  if (var.type == types::kError || !has_memory || !isBlock(there, var.type)) return;
  const std::string block = there.types().toString(var.type);
  if (!there.profile().constant_instances && var.constant)
    there.report(diag::ConstantBlock, var.loc, {name, block});
  else if (kind == PouKind::Function && !there.profile().instances_in_functions)
    there.report(diag::BlockInFunction, var.loc, {name, block});
  else if (kind == PouKind::Function && !isForTests(there, var.pou))
    there.report(diag::BlockOfCall, var.loc, {name, block});
}

uint32_t firstOfDecl(const Symbols& symbols, uint32_t index) {
  while (index > 1 && symbols.vars[index - 1].decl == symbols.vars[index].decl) --index;
  return index;
}

// AT %IX*, which resolveInstancePaths completes.
void leaveAddressOpen(Context& there, Var& var, const VarDecl& decl, TypeId type) {
  const bool is_bool = type != types::kError && there.types().kind(type) == TypeKind::Bool;
  if (decl.address.size_given && addressType(decl.address) == types::kBool && type != types::kError && !is_bool) {
    const std::string address = {'%', decl.address.area, 'X', '*'};
    there.report(diag::AddressType, decl.address_loc, {address, there.types().toString(type)});
    var.type = types::kError;
  }
  if (const std::optional<types::AreaId> area = areaOf(there, decl.address, decl.address_loc))
    var.image.area = *area;
  else
    var.type = types::kError;
  var.open_address = true;
  var.image.is_bit = is_bool;
}

// Gives a variable the type of its declaration, unless a rule forbids it there. first: of the declaration's variables.
void giveType(Context& there, Var& var, const VarDecl& decl, TypeId type, bool first) {
  var.type = type;
  if (there.types().isOpenArray(type) && !mayBeOpen(there, var)) {
    if (first) there.report(diag::OpenArray, there.tree().loc(decl.type));
    var.type = types::kError;
  }
  // An ANY input of CODESYS describes the caller's variable; generic types of the standard are for the library only.
  const bool generic = types::TypeTable::isGeneric(there.types().kind(var.type));
  const bool may_report = var.section == SectionKind::Input || var.section == SectionKind::Local;
  if (generic && may_report && there.profile().any_inputs) {
    var.any = var.type;
    var.type = anyType(there);
  }
  checkEdge(there, var);
  if (var.section != SectionKind::InOut && var.section != SectionKind::External && type != types::kError &&
      !checkNotAbstract(there, type, there.tree().loc(decl.type)))
    var.type = types::kError;
  if (var.type != types::kError && !checkKept(there, var, there.tree().loc(decl.type))) var.type = types::kError;
  if (first) checkPlacement(there, var, decl);
}

// Resolves the address of a variable. False: it is one of the hierarchical addresses, of which nothing else is checked.
bool locate(Context& there, VarId id, const VarDecl& decl, TypeId type) {
  Var& var = there.symbols.var(id);
  if (!decl.located) return true;
  if (decl.address.incomplete) {
    leaveAddressOpen(there, var, decl, type);
    return true;
  }
  if (var.record) return true;
  if (isHierarchical(there, decl.address)) {
    const VarId named = hierarchicalVar(there, decl.address, decl.address_loc, id);
    if (!named) there.symbols.var(id).type = types::kError;
    return false;
  }
  if (const auto view = resolveAddress(there, decl.address, decl.address_loc, type))
    var.image = *view;
  else
    var.type = types::kError;
  return true;
}

// Limits how deep declarations name each other. Reports the variable, and returns false, beyond the limit.
bool checkDepth(Context& context, VarId id) {
  if (context.scopes.depth <= kMaxDeclarationDepth) return true;
  const Var& var = context.symbols.var(id);
  context.report(diag::DeclarationsTooDeep, var.loc, {context.names().string(var.name)});
  return false;
}

}  // namespace

void ensureVarType(Context& context, VarId id) {
  Symbols& symbols = context.symbols;
  if (symbols.var(id).type || !symbols.var(id).decl) return;
  Context there = contextAt(context, id);
  const VarDecl& decl = context.tree().as<VarDecl>(symbols.var(id).decl);
  if (!checkDepth(context, id)) {
    symbols.var(id).type = types::kError;
    return;
  }
  ++context.scopes.depth;
  const bool is_bit_type = decl.type && isBit(there, decl.type);
  const bool bit = is_bit_type && mayBeBit(there, symbols.var(id), decl.type);
  const TypeId type = is_bit_type ? types::kBool : decl.type ? resolveType(there, decl.type) : types::kError;
  --context.scopes.depth;
  const uint32_t first = firstOfDecl(symbols, id.index);
  for (uint32_t i = first; i < symbols.vars.size() && symbols.vars[i].decl == symbols.vars[id.index].decl; ++i) {
    Var& var = symbols.vars[i];
    if (var.type) continue;
    var.bits.is_bit = bit && type != types::kError;
    giveType(there, var, decl, type, i == first);
    if (locate(there, VarId{i}, decl, type) && var.section == SectionKind::External) matchExternal(there, VarId{i});
  }
}

// A constant without a value has that of its type, which of a number is most likely not meant. IEC 61131-3 ed.
// 3, 6.5.1.
static Fix withDefault(const Context& context, const Var& var, const std::string& value) {
  if (!var.decl || context.tree().kind(var.decl) != DeclKind::Var) return {};
  const VarDecl& decl = context.tree().as<VarDecl>(var.decl);
  const Range type = decl.type ? context.tree().range(decl.type) : Range{};
  if (decl.names.count != 1 || !(type.begin < type.end)) return {};
  return {"Write `:= " + value + "`", {{type.end, type.end, " := " + value}}, false};
}

static void warnOfDefault(Context& context, const Var& var) {
  const types::Value value = types::defaultValue(context.types(), context.names(), var.type);
  context
      .report(diag::ConstantDefault, var.loc,
              {context.names().string(var.name), types::toString(context.types(), context.names(), value)})
      .fix(withDefault(context, var, types::toString(context.types(), context.names(), value)));
}

namespace {

// A value that silences follow-up errors.
void setUnknown(Context& context, VarId id) {
  Var& var = context.symbols.var(id);
  const TypeKind kind = context.types().plainKind(var.type);
  if (!types::TypeTable::isElementary(kind)) return;
  var.has_value = true;
  var.value = types::defaultValue(context.types(), context.names(), var.type);
  if (types::TypeTable::isReal(kind)) var.value = types::Value::ofReal(var.type, 1.0);
  if (types::TypeTable::isInteger(kind) && var.value.bits == 0) var.value.bits = 1;
}

// Forbids a constant whose value depends on itself. IEC 61131-3 ed. 3, 6.5.1.
//   passes  VAR CONSTANT a : INT := b + 1; b : INT := 2; END_VAR
//   fails   VAR CONSTANT a : INT := b; b : INT := a; END_VAR       E0321
void reportCycle(Context& context, VarId id) {
  const Var& var = context.symbols.var(id);
  if (!var.constant || var.has_value) return;
  context.report(diag::ConstantCycle, var.loc, {context.names().string(var.name)});
  setUnknown(context, id);
}

// The variables that an initial value may read.
InitialReads readsOf(const Context& there, const Var& var) {
  const bool of_call = there.pou && isFunction(there.symbols.pou(there.pou).kind);
  if (!there.profile().variables_in_initial_values || var.record) return InitialReads::Constants;
  if (of_call && var.section == SectionKind::Input)
    return InitialReads::Globals;  // the caller evaluates the default of an input that it leaves open
  if (var.storage == Storage::Local) return InitialReads::Call;
  return var.list || var.pou ? InitialReads::Variables : InitialReads::Constants;
}

// The initial value of the variables of one declaration.
struct InitialValue {
  ExprId init;
  bool ok = true;
  bool reads = false;     // variables
  bool defaults = false;  // a constant that has none
  CallId constructor;
  uint32_t elements = 0;  // that the constructor makes
};

void checkInitialValue(Context& there, const Var& var, InitialValue& out) {
  if (!out.init) return;
  ++there.scopes.depth;
  const uint32_t errors = there.symbols.diagnostics.errorCount();
  const std::string what = "the initial value of `" + toString(there, var.name) + "`";
  out.reads = checkInitializerAs(there, out.init, var.type, what, readsOf(there, var));
  out.ok = there.symbols.diagnostics.errorCount() == errors;
  --there.scopes.depth;
}

InitialValue initialValueOf(Context& there, const Var& var, const VarDecl& decl) {
  InitialValue out;
  if (decl.init) out.init = there.code().copy(decl.init);
  if (!out.init && var.generic) out.init = there.build().literal(LiteralKind::Integer, 1, decl.h.loc);
  const bool is_elementary = types::TypeTable::isElementary(there.types().plainKind(var.type));
  const bool makes_object = var.section != SectionKind::InOut && var.section != SectionKind::External;
  out.defaults = !out.init && var.constant && is_elementary && makes_object && var.section != SectionKind::Input;
  if (out.defaults) warnOfDefault(there, var);
  if (out.init && !mayHaveInitialValue(there, var, out.init)) out.init = {};
  checkInitialValue(there, var, out);
  if (decl.type && makes_object) out.constructor = there.expressions->checkConstructor(there, decl.type, out.elements);
  return out;
}

// The value of a constant.
std::optional<types::Value> constantValue(Context& there, const Var& var, const InitialValue& initial) {
  if (initial.defaults) return types::defaultValue(there.types(), there.names(), var.type);
  if (!var.constant || !initial.init || !initial.ok) return std::nullopt;
  if (!types::TypeTable::isElementary(there.types().plainKind(var.type))) return std::nullopt;
  std::optional<types::Value> value = evaluate(there, initial.init);
  if (value) value->type = var.type;
  return value;
}

}  // namespace

void ensureInitialValue(Context& context, VarId id) {
  Symbols& symbols = context.symbols;
  const Var& var = symbols.var(id);
  if (!var.decl) return;
  const VarDecl& decl = context.tree().as<VarDecl>(var.decl);
  const DeclId decl_id = var.decl;
  const State state = context.scopes.initial_values[decl_id];
  if (state == State::Done) return;
  if (var.section == SectionKind::External && var.external && !decl.init) return;
  if (state == State::Busy) return reportCycle(context, id);
  Context there = contextAt(context, id);
  ensureVarType(context, id);
  if (!checkDepth(context, id)) return setUnknown(context, id);
  context.scopes.initial_values[decl_id] = State::Busy;
  const InitialValue initial = initialValueOf(there, var, decl);
  context.scopes.initial_values[decl_id] = State::Done;
  const auto value = constantValue(there, var, initial);
  for (uint32_t i = firstOfDecl(symbols, id.index); i < symbols.vars.size() && symbols.vars[i].decl == decl_id; ++i) {
    Var& each = symbols.vars[i];
    each.init = initial.init;
    each.start.constructor = initial.constructor;
    each.start.element_constructors = initial.elements;
    if (initial.reads || initial.constructor.index != 0) context.scopes.reading_inits.push_back(VarId{i});
    if (value) {
      each.has_value = true;
      each.value = *value;
    } else if (var.constant && initial.init && !initial.ok) {
      setUnknown(context, VarId{i});
    }
  }
}

// VAR_INST of a method: a variable of the object, visible only in this method; of an action: the variables of its
// chart, see shareChartVars.
static void declareInstanceVars(Context& context, DeclId decl, const SectionDecl& section, PouId method) {
  Symbols& symbols = context.symbols;
  const PouId owner = symbols.pou(method).owner;
  std::vector<VarId>& vars = symbols.pou(owner).vars;
  const size_t first = vars.size();
  SectionDecl local = section;
  local.section = SectionKind::Local;
  declareVars(context, decl, local, owner, {}, &context.scopes.pous[method.index].names, vars);
  for (size_t i = first; i < vars.size(); ++i) {
    Var& var = symbols.var(vars[i]);
    var.name = context.names().intern(toString(context, symbols.pou(method).name) + "__" + toString(context, var.name));
  }
}

// The variables that schedulers add for networks of the POU and of its actions.
static void declareHidden(Context& context, PouId id) {
  Tree& tree = context.symbols.arena;
  const PouDecl& decl = context.tree().as<PouDecl>(context.symbols.pou(id).decl);
  if (decl.pou_kind == PouKind::Action || decl.pou_kind == PouKind::Interface) return;
  std::vector<DeclId> added;
  Context there = atPou(context, id);
  ProjectSignatures signatures(there);
  const auto declare = [&](const PouDecl& of, std::string_view prefix) {
    if (of.body_kind != BodyKind::Network) return;
    const SectionKind kind = decl.pou_kind == PouKind::Method ? SectionKind::Inst : SectionKind::Local;
    const DeclId section = diagram::declareNetworks(tree, context.names(), context.symbols.diagnostics, signatures,
                                                    context.project.network_variables, of, kind, prefix);
    if (section) added.push_back(section);
  };
  declare(decl, {});
  for (const DeclId member : tree.list(decl.members)) {
    if (tree.kind(member) != DeclKind::Pou) continue;
    const PouDecl& action = tree.as<PouDecl>(member);
    if (action.pou_kind == PouKind::Action) declare(action, toString(context, action.name) + "_");
  }
  if (added.empty()) return;
  std::vector<DeclId>& made = context.project.made_sections[&decl];  // some of a chart
  made.insert(made.end(), added.begin(), added.end());
}

// ENO in the body of a function is an output that need not be declared; TRUE until the body assigns it.
// IEC 61131-3 ed. 2, 2.5.1.2 and the function WEIGH of its annex F.
static void declareEno(Context& context, PouId id) {
  Symbols& symbols = context.symbols;
  const NameId name = context.names().intern(kEnableOutput);
  const VarId created{static_cast<uint32_t>(symbols.vars.size())};
  if (!context.scopes.pous[id.index].names.insert(keyOf(context, name), entity(created))) return;
  Var var;
  var.name = name;
  var.loc = symbols.pou(id).loc;
  var.type = types::kBool;
  var.section = SectionKind::Output;
  var.pou = id;
  var.init = makeLiteral(context, LiteralKind::Bool, types::kBool, 1, var.loc);
  symbols.vars.push_back(var);
  symbols.pou(id).vars.push_back(created);
}

static Var hiddenBeside(Context& context, VarId of, const std::string& suffix, TypeId type) {
  const Var& var = context.symbols.var(of);
  Var hidden;
  hidden.name = context.names().intern("__" + toString(context, var.name) + suffix);
  hidden.loc = var.loc;
  hidden.type = type;
  hidden.storage = var.storage;
  hidden.used = {1, 1};
  return hidden;
}

// `t.ENO` reads what the last call of the instance t set, so a hidden variable beside it holds that; TRUE at first.
// Not of a block that declares an output ENO.
static bool keepsEno(Context& context, VarId id) {
  const Var& var = context.symbols.var(id);
  if (!var.name || !context.tree().readsEnoOf(keyOf(context, var.name))) return false;
  const NamedType* type = context.scopes.named(context.types().resolve(var.type));
  const PouId block = type == nullptr ? PouId{} : type->pou;
  if (!block || context.symbols.pou(block).kind != PouKind::FunctionBlock) return false;
  return !findMember(context, context.types().resolve(var.type), context.names().intern(kEnableOutput));
}

// A modifier after the keyword of a section.
static Fix withoutModifier(const Context& context, const SectionDecl& section, std::string_view word) {
  const std::span<const DeclId> vars = context.tree().list(section.vars);
  const Loc end = vars.empty() ? section.h.end : context.tree().decl(vars[0]).begin;
  return withoutWord(context, section.h.loc, end, word, Sureness::Proposal);
}

// Forbids RETAIN with NON_RETAIN, and in iec modifiers that contradict their section: a constant is not retained; an
// in-out, and a variable of one call, has no memory to keep; an output is written by its block; VAR_IN_OUT CONSTANT is
// of CODESYS. There RETAIN in a function has no effect, with a warning. IEC 61131-3 ed. 3 table 14 and figure 9, ed. 2
// B.1.4.3, B.1.5.1; CODESYS, "Retain Variable - RETAIN".
//   passes  VAR RETAIN n : INT; END_VAR      fails  VAR_TEMP RETAIN n : INT; END_VAR      E0372
void checkModifiers(Context& context, const SectionDecl& section) {
  if (context.library) return;
  const Qualifiers& written = section.qualifiers;
  if (written.retain && written.non_retain) {
    context.report(diag::RetainTwice, section.h.loc).fix(withoutModifier(context, section, "NON_RETAIN"));
    return;
  }
  const bool lives = section.section == SectionKind::Stat || section.section == SectionKind::Inst ||
                     section.section == SectionKind::External;
  const bool of_call = context.pou && isFunction(context.symbols.pou(context.pou).kind) && !lives;
  if (of_call && written.isKept()) {
    const std::string_view word = written.retain ? "RETAIN" : "PERSISTENT";
    if (!context.profile().retain_in_functions)
      context.report(diag::SectionModifier, section.h.loc, {"a variable of a function or method", word})
          .fix(withoutModifier(context, section, word));
    else
      context.report(diag::RetainOfCall, section.h.loc, {word, keywordOf(context.symbols.pou(context.pou).kind)})
          .fix(withoutModifier(context, section, word));
    return;
  }
  const LanguageProfile& profile = context.profile();
  const bool retain = written.isKept() && !profile.retain_without_memory;
  const bool constant = written.constant;
  const std::string_view retained = written.retain ? "RETAIN" : "PERSISTENT";
  const bool is_pin_or_temp = section.section == SectionKind::InOut || section.section == SectionKind::Temp;
  if (retain && constant)
    context.report(diag::SectionModifier, section.h.loc, {"a constant", "RETAIN"})
        .fix(withoutModifier(context, section, retained));
  else if (retain && is_pin_or_temp)
    context.report(diag::SectionModifier, section.h.loc, {keywordOf(section.section), "RETAIN"})
        .fix(withoutModifier(context, section, retained));
  else if (constant && !profile.constant_outputs &&
           (section.section == SectionKind::Output || section.section == SectionKind::InOut))
    context.report(diag::SectionModifier, section.h.loc, {keywordOf(section.section), "CONSTANT"})
        .fix(withoutModifier(context, section, "CONSTANT"));
}

// The variables of one section of a POU.
static void declareSection(Context& there, PouId id, const PouDecl& decl, const SectionDecl& section) {
  Symbols& symbols = there.symbols;
  PouScope& scope = there.scopes.pous[id.index];
  const PouKind kind = decl.pou_kind;
  const bool is_member = kind == PouKind::Method || kind == PouKind::Action;
  // Forbids sections that a POU cannot have. IEC 61131-3 ed. 3 table 14.
  if (section.section == SectionKind::Global && mayHoldGlobals(there, kind)) return;  // collect.cpp
  if (section.section == SectionKind::Access && kind == PouKind::Program) return;     // access_paths.cpp
  const bool misplaced = section.section == SectionKind::Global || section.section == SectionKind::Access ||
                         section.section == SectionKind::Config || kind == PouKind::Interface ||
                         (section.section == SectionKind::Stat && !there.profile().static_variables) ||
                         (section.section == SectionKind::Inst && !is_member);
  if (misplaced) {
    there.report(diag::SectionNotAllowed, section.h.loc, {keywordOf(section.section), keywordOf(kind)});
    if (section.section != SectionKind::Global && section.section != SectionKind::Stat) return;
  }
  checkModifiers(there, section);
  const bool of_chart = section.maker == SectionMaker::Chart;
  const size_t first_var = symbols.vars.size();
  for (const DeclId var : there.tree().list(section.vars)) {
    if (section.section == SectionKind::Stat) {
      // One for all instances and calls: a separate list, visible only in this POU. codesys.
      const std::string name = toString(there, symbols.pou(id).unique_name) + "__static";
      const ListId list = listNamed(there, name, symbols.pou(id).file, section.h.loc, there.scopes.qualifiers);
      declareVars(there, var, section, id, list, &scope.names, symbols.global_lists[list.index].vars);
      continue;
    }
    if (section.section == SectionKind::Inst && is_member) {
      declareInstanceVars(there, var, section, id);
      continue;
    }
    declareVars(there, var, section, id, {}, &scope.names, symbols.pou(id).vars);
  }
  for (size_t i = first_var; of_chart && i < symbols.vars.size(); ++i) symbols.vars[i].of_chart = true;
}

// Forbids, in iec, a variable of a function that has the function's name: there is no way to set the result then, and a
// name is declared once in a POU. IEC 61131-3 ed. 3, 6.1.2. A warning in codesys, where the variable hides the result.
//   fails   FUNCTION F : INT VAR f : INT; END_VAR …                                   E0301, codesys: W0635
static void reportHiddenResult(Context& there, PouId id, Entity by) {
  const Pou& pou = there.symbols.pou(id);
  if (there.library || by.entityKind() != EntityKind::Var || pou.object.accessor != AccessorKind::None) return;
  const Var& var = there.symbols.vars[by.index];
  if (!there.names().same(var.name, pou.name)) return;  // an alias
  if (!there.profile().hidden_results)
    reportTwice(there, var.name, var.loc, pou.loc);
  else
    there.report(diag::ResultHidden, var.loc, {there.names().string(var.name), there.names().string(pou.name)})
        .declaredHere(pou.loc);
}

void declarePou(Context& context, PouId id) {
  PouScope& scope = context.scopes.pous[id.index];
  if (scope.declared) return;
  scope.declared = true;
  Symbols& symbols = context.symbols;
  const Tree& tree = context.tree();
  declareHidden(context, id);
  const PouDecl& decl = tree.as<PouDecl>(symbols.pou(id).decl);
  Context there = atPou(context, id);
  const PouKind kind = decl.pou_kind;
  if (decl.result) {
    Var var;
    var.name = decl.name;
    var.loc = decl.h.loc;
    var.section = SectionKind::Output;
    var.pou = id;
    symbols.vars.push_back(var);
    symbols.pou(id).result_var = VarId{static_cast<uint32_t>(symbols.vars.size() - 1)};
  }
  forEachSection(tree, decl, context.project.madeSections(decl),
                 [&](const SectionDecl& section) { declareSection(there, id, decl, section); });
  declareMembers(context, id);
  if (kind == PouKind::Function && decl.uses_eno) declareEno(context, id);
  if (const VarId result = symbols.pou(id).result_var) {
    // The name is the result inside the body, unless a variable has it.
    const NameId key = keyOf(context, decl.name);
    if (!scope.names.insert(key, entity(result))) reportHiddenResult(there, id, scope.names.find(key));
  }
}

namespace {

void resolveResult(Context& there, Pou& pou, const PouDecl& decl) {
  if (!decl.result) return;
  pou.result = resolveType(there, decl.result);
  there.symbols.var(pou.result_var).type = pou.result;
  if (types::TypeTable::isGeneric(there.types().kind(pou.result))) pou.generic = true;
}

// Variables of a POU that have another one beside them, which the source does not declare.
struct Accompanied {
  std::vector<VarId> edges, open_arrays, enabled;
};

Accompanied resolveVars(Context& there, Pou& pou) {
  Accompanied out;
  for (size_t i = 0; i < pou.vars.size(); ++i) {
    const VarId id = pou.vars[i];
    ensureVarType(there, id);
    Var& var = there.symbols.var(id);
    if (var.storage == Storage::Local) var.field = static_cast<uint32_t>(i);
    if (var.storage == Storage::Field && !var.bits.holds_bits) addField(there, pou.record, id);
    if (types::TypeTable::isGeneric(there.types().kind(var.type))) pou.generic = true;
    if (var.pragmas.extensible) pou.extensible = true;
    if (var.edge != EdgeKind::None && var.storage == Storage::Field) out.edges.push_back(id);
    if (there.types().isOpenArray(var.type)) out.open_arrays.push_back(id);
    if (keepsEno(there, id)) out.enabled.push_back(id);
  }
  // A call with more arguments is folded from the left, f(f(a, b), c), which takes two inputs.
  const auto isInput = [&](VarId var) { return there.symbols.var(var).section == SectionKind::Input; };
  if (std::count_if(pou.vars.begin(), pou.vars.end(), isInput) < 2) pou.extensible = false;
  return out;
}

VarId addHidden(Context& there, PouId id, VarId of, const std::string& suffix, TypeId type) {
  Symbols& symbols = there.symbols;
  Pou& pou = symbols.pou(id);
  Var hidden = hiddenBeside(there, of, suffix, type);
  hidden.pou = id;
  hidden.field = static_cast<uint32_t>(pou.vars.size());
  hidden.open_array.hidden_input = hidden.storage == Storage::Local;
  const VarId hidden_id{static_cast<uint32_t>(symbols.vars.size())};
  symbols.vars.push_back(hidden);
  pou.vars.push_back(hidden_id);
  if (hidden.storage == Storage::Field) addField(there, pou.record, hidden_id);
  return hidden_id;
}

// The memory of edges, the last ENO of instances, and the bounds of open arrays.
void addHiddenVars(Context& there, PouId id, const Accompanied& vars) {
  Symbols& symbols = there.symbols;
  for (const VarId edge : vars.edges) {
    const VarId memory = addHidden(there, id, edge, "_edge", types::kBool);
    symbols.var(edge).memory.edge = memory;
    // iec: the body of F_TRIG, which F_EDGE stands for, sees an edge in a first call with FALSE.
    if (there.profile().falling_edge_at_start && symbols.var(edge).edge == EdgeKind::Falling)
      symbols.var(memory).init = makeLiteral(there, LiteralKind::Integer, types::kBool, 1, symbols.var(edge).loc);
  }
  for (const VarId instance : vars.enabled) {
    const VarId memory = addHidden(there, id, instance, "_eno", types::kBool);
    symbols.var(instance).memory.eno = memory;
    symbols.var(memory).init = makeLiteral(there, LiteralKind::Bool, types::kBool, 1, symbols.var(instance).loc);
  }
  for (const VarId array : vars.open_arrays) {
    const uint32_t dimensions = there.types().info(there.types().resolve(symbols.var(array).type)).length;
    for (uint32_t i = 0; i < 2 * dimensions; ++i) {
      const std::string suffix = (i % 2 == 0 ? "_low" : "_high") + std::to_string(i / 2 + 1);
      const VarId bound = addHidden(there, id, array, suffix, types::kDInt);
      if (i == 0) symbols.var(array).open_array.bounds = bound;
    }
  }
}

}  // namespace

void resolvePou(Context& context, PouId id) {
  PouScope& scope = context.scopes.pous[id.index];
  if (scope.resolved != State::New) return;
  scope.resolved = State::Busy;
  declarePou(context, id);
  Context there = atPou(context, id);
  addObjectFields(context, id);
  Pou& pou = context.symbols.pou(id);
  resolveResult(there, pou, context.tree().as<PouDecl>(pou.decl));
  shareTemporaries(there, id);
  const Accompanied vars = resolveVars(there, pou);
  // Forbids generic types outside of functions: an instance of a block has one layout.
  if (pou.generic && (pou.kind != PouKind::Function || pou.owner)) {
    context.report(diag::GenericBlock, pou.loc, {context.names().string(pou.name)});
    pou.generic = false;
  }
  addHiddenVars(there, id, vars);
  scope.resolved = State::Done;
  if (!context.library) checkAttributesOf(there, id);
}

void resolveList(Context& context, ListId id) {
  ListScope& scope = context.scopes.lists[id.index];
  if (scope.resolved != State::New) return;
  scope.resolved = State::Busy;
  Symbols& symbols = context.symbols;
  const TypeId record = symbols.global_lists[id.index].record;
  for (size_t i = 0; i < symbols.global_lists[id.index].vars.size(); ++i) {
    const VarId var = symbols.global_lists[id.index].vars[i];
    ensureVarType(context, var);
    if (symbols.var(var).storage == Storage::Global) addField(context, record, var);
    if (symbols.var(var).storage != Storage::Global || !keepsEno(context, var)) continue;
    Var hidden = hiddenBeside(context, var, "_eno", types::kBool);
    hidden.list = id;
    hidden.init = makeLiteral(context, LiteralKind::Bool, types::kBool, 1, hidden.loc);
    const VarId created{static_cast<uint32_t>(symbols.vars.size())};
    symbols.vars.push_back(hidden);
    symbols.var(var).memory.eno = created;
    symbols.global_lists[id.index].vars.push_back(created);
  }
  scope.resolved = State::Done;
}

}  // namespace rung::sema

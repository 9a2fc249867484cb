// SPDX-License-Identifier: Apache-2.0
#include "sema/declarations/attributes.h"

#include <algorithm>
#include <charconv>

#include "sema/declarations/collect.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/objects.h"
#include "sema/project.h"
#include "sema/scopes.h"

namespace rung::sema {

namespace {

constexpr uint32_t before(Attributed what) { return 1u << static_cast<uint32_t>(what); }

struct Position {
  NameId Scopes::KnownNames::Attributes::*attribute;
  uint32_t allowed;
  const char* where;
};
using Known = Scopes::KnownNames::Attributes;
constexpr Position kPositions[] = {
    {&Known::pack_mode, before(Attributed::Structure) | before(Attributed::Block),
     "before a STRUCT, a UNION or a FUNCTION_BLOCK"},
    {&Known::global_init_slot, before(Attributed::Globals) | before(Attributed::Program),
     "before VAR_GLOBAL or a PROGRAM"},
    {&Known::after_globals, before(Attributed::Function) | before(Attributed::Program) | before(Attributed::Method),
     "before a FUNCTION, a PROGRAM or a METHOD"},
    {&Known::initialize_on_call, before(Attributed::Block) | before(Attributed::Input),
     "before a FUNCTION_BLOCK and its inputs"},
    {&Known::is_connected, before(Attributed::Variable), "before a BOOL variable of a FUNCTION_BLOCK"},
};

Attributed attributedBy(PouKind kind) {
  switch (kind) {
    case PouKind::Function: return Attributed::Function;
    case PouKind::Program: return Attributed::Program;
    case PouKind::FunctionBlock:
    case PouKind::Class:
    case PouKind::Interface: return Attributed::Block;
    case PouKind::Method:
    case PouKind::Action: return Attributed::Method;
  }
  return Attributed::Block;
}

// Forbids slots that are not integers.   fails   {attribute 'global_init_slot' := 'first'} VAR_GLOBAL …     E0388
std::optional<int32_t> slotOf(Context& context, const DeclHeader& header, NameId attribute) {
  const Pragma* const pragma = findPragma(context, header, attribute);
  if (pragma == nullptr) return std::nullopt;
  const std::string_view value = context.tree().string(pragma->value);
  int32_t slot = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), slot);
  if (error == std::errc() && end == value.data() + value.size()) return slot;
  context.report(diag::AttributeValue, pragma->loc, {value, context.names().string(pragma->name), "an integer"});
  return std::nullopt;
}

}  // namespace

//   passes  {attribute 'pack_mode' := '1'} TYPE Telegram : STRUCT …
//   fails   {attribute 'pack_mode' := '1'} FUNCTION Send …             W0386
void checkAttributes(Context& context, const DeclHeader& header, Attributed what) {
  if (header.pragmas.empty() || context.library) return;
  for (const Position& row : kPositions) {
    const Pragma* const pragma = findPragma(context, header, context.scopes.known_names.attributes.*row.attribute);
    if (pragma != nullptr && (row.allowed & before(what)) == 0)
      context.report(diag::AttributeWithoutEffect, pragma->loc, {context.names().string(pragma->name), row.where});
  }
}

void takeAttributes(Context& context, const DeclHeader& header, Pou& pou) {
  if (header.pragmas.empty()) return;
  const Known& known = context.scopes.known_names.attributes;
  checkAttributes(context, header, attributedBy(pou.kind));
  pou.pragmas.initialize_on_call = findPragma(context, header, known.initialize_on_call) != nullptr;
  pou.pragmas.reflection = findPragma(context, header, known.reflection) != nullptr;
  pou.pragmas.symbol_access = symbolAccessOf(context, header).value_or(types::SymbolAccess::ReadWrite);
  if (pou.kind == PouKind::Program)
    if (const auto slot = initSlotOf(context, header)) pou.pragmas.init_slot = *slot;
  const bool callable = pou.kind == PouKind::Function || pou.kind == PouKind::Program || pou.kind == PouKind::Method;
  const auto slot = callable ? slotOf(context, header, known.after_globals) : std::nullopt;
  pou.pragmas.after_globals = slot.has_value();
  pou.pragmas.after_globals_slot = slot.value_or(0);
}

void takeVariableAttributes(Context& context, const DeclHeader& header, Var& var) {
  const bool of_block = var.pou && (context.symbols.pou(var.pou).kind == PouKind::FunctionBlock ||
                                    context.symbols.pou(var.pou).kind == PouKind::Class);
  const bool is_input = var.section == SectionKind::Input;
  checkAttributes(context, header,
                  is_input && of_block ? Attributed::Input
                  : of_block           ? Attributed::Variable
                                       : Attributed::OtherType);
  const Known& known = context.scopes.known_names.attributes;
  var.pragmas.no_exit = findPragma(context, header, known.no_exit) != nullptr;
  var.pragmas.no_copy = findPragma(context, header, known.no_copy) != nullptr;
  var.pragmas.set_by_change = findPragma(context, header, known.init_on_change) != nullptr;
  if (is_input && of_block)
    var.pragmas.initialize_on_call = findPragma(context, header, known.initialize_on_call) != nullptr;
}

// Forbids other values than those of the page "Attribute: symbol" of the CODESYS help; without one: readwrite.
//   passes  {attribute 'symbol' := 'read'} level : INT;
//   warns   {attribute 'symbol' := 'readonly'} level : INT;    W0790
std::optional<types::SymbolAccess> symbolAccessOf(Context& context, const DeclHeader& header) {
  constexpr std::string_view kValues[] = {"readwrite", "read", "write", "none"};  // in the order of SymbolAccess
  const Pragma* const pragma = findPragma(context, header, context.scopes.known_names.attributes.symbol);
  if (pragma == nullptr) return {};
  const std::string_view value = context.tree().string(pragma->value);
  if (value.empty()) return types::SymbolAccess::ReadWrite;
  for (size_t i = 0; i < std::size(kValues); ++i)
    if (sameIdentifier(value, kValues[i])) return static_cast<types::SymbolAccess>(i);
  context.report(diag::SymbolAccessValue, pragma->loc, {value});
  return {};
}

std::optional<int32_t> initSlotOf(Context& context, const DeclHeader& header) {
  return slotOf(context, header, context.scopes.known_names.attributes.global_init_slot);
}

namespace {

// Forbids {attribute 'is_connected'} of anything but an input of the block.
//   passes  {attribute 'reflection'} FUNCTION_BLOCK F VAR_INPUT x : INT; END_VAR
//           VAR {attribute 'is_connected' := 'x'} has_x : BOOL; END_VAR …
//   fails   VAR {attribute 'is_connected' := 'y'} has_y : BOOL; END_VAR …         E0388
void resolveConnection(Context& context, PouId block, VarId id, const Pragma& pragma) {
  Var& var = context.symbols.var(id);
  const std::string_view name = context.tree().string(pragma.value);
  const Entity found = findInObject(context, block, context.names().intern(name));
  const bool is_var = found.entityKind() == EntityKind::Var;
  const SectionKind section = is_var ? context.symbols.vars[found.index].section : SectionKind::Local;
  if (section != SectionKind::Input && section != SectionKind::InOut) {
    context.report(diag::AttributeValue, pragma.loc, {name, "is_connected", "the name of an input of this block"});
    return;
  }
  if (var.type == types::kError) return;
  if (context.types().kind(var.type) != types::TypeKind::Bool) {
    context.report(diag::AttributeWithoutEffect, pragma.loc, {"is_connected", "before a BOOL variable"});
  } else if (!context.symbols.pou(block).pragmas.reflection) {
    context.report(diag::AttributeWithoutEffect, pragma.loc,
                   {"is_connected", "in a block with {attribute 'reflection'}"});
  } else {
    var.tells_input = VarId{found.index};
    ++var.used.writes;
  }
}

// Forbids inputs of what is called after the initialization, of its object or of all, and around a task: nothing gives
// them values.
//   fails   {attribute 'call_after_init'} METHOD Prepare VAR_INPUT x : INT; END_VAR …        E0649
void checkCalledAfterInit(Context& context, const Pou& pou) {
  const bool is_called = pou.pragmas.call_after_init || pou.pragmas.before_task || pou.pragmas.after_task;
  if (!(is_called && pou.kind == PouKind::Method) && (!pou.pragmas.after_globals || pou.kind == PouKind::Program))
    return;
  for (const VarId id : pou.vars) {
    const Var& var = context.symbols.var(id);
    if (var.section != SectionKind::Input && var.section != SectionKind::InOut) continue;
    context.report(diag::InputAfterInit, var.loc, {context.names().string(var.name), context.names().string(pou.name)});
    return;
  }
}

}  // namespace

void checkAttributesOf(Context& context, PouId id) {
  checkCalledAfterInit(context, context.symbols.pou(id));
  if (context.symbols.pou(id).kind != PouKind::FunctionBlock) return;
  const Known& known = context.scopes.known_names.attributes;
  for (const VarId var_id : std::vector(context.symbols.pou(id).vars)) {
    const Var& var = context.symbols.var(var_id);
    if (!var.decl || context.tree().kind(var.decl) != DeclKind::Var) continue;
    const DeclHeader& header = context.tree().decl(var.decl);
    if (const Pragma* const pragma = findPragma(context, header, known.is_connected);
        pragma != nullptr && var.section != SectionKind::Input)
      resolveConnection(context, id, var_id, *pragma);
    if (!var.pragmas.initialize_on_call || context.symbols.pou(id).pragmas.initialize_on_call) continue;
    const Pragma* const pragma = findPragma(context, header, known.initialize_on_call);
    context.report(diag::AttributeWithoutEffect, pragma->loc, {"initialize_on_call", "before the FUNCTION_BLOCK, too"});
  }
}

// Forbids other pack modes than those that the pages list.
//   fails   {attribute 'pack_mode' := '3'} TYPE Telegram : STRUCT …    E0388
uint8_t packModeOf(Context& context, const DeclHeader& header) {
  const Pragma* const pragma = findPragma(context, header, context.scopes.known_names.attributes.pack_mode);
  if (pragma == nullptr) return 0;
  const std::string_view value = context.tree().string(pragma->value);
  constexpr std::string_view kModes[] = {"0", "1", "2", "4", "8"};
  if (std::find(std::begin(kModes), std::end(kModes), value) == std::end(kModes)) {
    context.report(diag::AttributeValue, pragma->loc, {value, "pack_mode", "0, 1, 2, 4 or 8"});
    return 0;
  }
  return value == "0" ? 1 : static_cast<uint8_t>(value[0] - '0');
}

//   warns   {attribute 'pack_mode' := '1'} TYPE T : STRUCT b : BYTE; w : WSTRING; END_STRUCT …    W0387
void checkPacking(Context& context, TypeId record) {
  const types::TypeInfo& info = context.types().info(record);
  if (info.pack == 0 || context.library) return;
  const NamedType& named = *context.scopes.named(record);
  for (size_t i = 0; i < info.fields.size(); ++i) {
    const types::Field& field = info.fields[i];
    const uint32_t least = field.by_reference ? 1 : context.types().info(field.type).least_align;
    if (field.role == types::FieldRole::Base || field.pack != info.pack || least <= info.pack) continue;
    context.report(diag::MemberAligned, context.symbols.var(named.fields[i]).loc,
                   {context.names().string(field.name), context.types().toString(field.type), std::to_string(least)});
  }
}

}  // namespace rung::sema

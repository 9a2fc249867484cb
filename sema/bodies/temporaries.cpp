// SPDX-License-Identifier: Apache-2.0
#include "sema/bodies/temporaries.h"

#include <algorithm>
#include <utility>

#include "sema/access.h"
#include "sema/bodies/body.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/literals.h"
#include "sema/declarations/names.h"
#include "sema/declarations/resolve.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

using Temporary = BodyState::Temporary;

constexpr uint32_t kMaxLookAhead = 50;  // temporaries that wait for each other's types

Temporary& stateOf(Context& context, VarId id) {
  return context.body->temporaries[context.symbols.var(id).temporary - 1];
}

VarId temporaryOf(Context& context, ExprId expr) {
  if (context.body == nullptr || context.body->temporaries.empty()) return {};
  if (context.tree().kind(expr) != ExprKind::Name) return {};
  const Entity entity = lookUp(context, context.tree().as<NameExpr>(expr));
  const bool is_one = entity.entityKind() == EntityKind::Var && context.symbols.vars[entity.index].temporary != 0;
  return is_one ? VarId{entity.index} : VarId{};
}

bool isNull(const Context& context, TypeId type) { return context.types().info(type).kind == TypeKind::NullLiteral; }

// A type that holds every value of this one: a string may get longer than the first one.
TypeId roomFor(Context& context, TypeId type) {
  types::TypeTable& table = context.types();
  const types::TypeInfo& info = table.info(table.resolve(type));
  if (types::TypeTable::isString(info.kind)) {
    const uint32_t length = std::max(info.length, 255u);
    type = table.string(info.kind, length);
  } else if (info.kind == TypeKind::Subrange) {
    type = table.plain(type);
  }
  ensureLayout(context, type);
  return type;
}

bool shares(Context& context, TypeId own, ExprId value) {
  const types::TypeTable& table = context.types();
  TypeId type = context.type(value);
  if (isUntyped(context, type)) return untypedFits(context, value, own);
  if (isNull(context, type)) return table.kind(own) == TypeKind::Pointer;
  if (types::TypeTable::isString(table.kind(own))) return table.kind(type) == table.kind(own);
  if (table.kind(type) == TypeKind::Subrange) type = table.plain(type);
  return sameType(context, own, type);
}

// Forbids values of several types in one temporary: two paths to a label of IL that bring different ones.
//   passes  LD a (INT)  JMP m … LD 7  m: ST c
//   fails   LD a (INT)  JMP m … LD b (BOOL)  m: ST c        E0729
void adaptValue(Context& context, const Temporary& state, AssignStmt& node) {
  NameExpr& target = context.code().as<NameExpr>(node.target);
  meaning(target.h).entity = Entity::of(EntityKind::Var, state.var.index);
  meaning(target.h).type = state.type;
  const TypeId type = context.type(node.value);
  if (!type || type == types::kError || state.type == types::kError) return;
  if (shares(context, state.type, node.value)) {
    convert(context, node.value, state.type, Purpose{Use::Assigned, target.name, {}});
    return;
  }
  const TypeId own = isUntyped(context, type) ? defaultType(context, node.value) : type;
  const std::string line = std::to_string(context.symbols.sources.lineNumber(state.first));
  context
      .report(diag::TypesMeet, node.h.loc, {context.types().toString(own), context.types().toString(state.type), line})
      .note(state.first, diag::OtherValue);
}

void finalizeType(Context& context, Temporary& state, TypeId type, Loc first) {
  state.type = type == types::kError ? type : roomFor(context, type);
  state.first = first;
  context.symbols.var(state.var).type = state.type;
  for (AssignStmt* open : std::exchange(state.open, {})) adaptValue(context, state, *open);
}

void checkValue(Context& context, Temporary& state, AssignStmt& node) {
  if (!context.body->with_value.insert(&node).second) return;
  TypeId type = check(context, node.value, state.type, Access::Read);
  if (!type) type = types::kError;
  if (state.type) return adaptValue(context, state, node);
  state.open.push_back(&node);
  if (!isUntyped(context, type) && !isNull(context, type)) finalizeType(context, state, type, node.h.loc);
}

// The body's assignments to its temporaries: needed when a reader comes before a value with a type.
void collectAssigns(Context& context, Slice<StmtId> list) {
  for (const StmtId id : context.tree().list(list)) {
    if (context.tree().kind(id) == StmtKind::Assign) {
      AssignStmt& node = context.code().as<AssignStmt>(id);
      if (const VarId var = temporaryOf(context, node.target)) stateOf(context, var).assigns.push_back(&node);
    } else if (context.tree().kind(id) == StmtKind::If) {
      const IfStmt& node = context.tree().as<IfStmt>(id);
      for (uint32_t b = 0; b < node.branches.count; ++b)
        collectAssigns(context, context.tree().list(node.branches)[b].body);
      collectAssigns(context, node.otherwise);
    }
  }
}

void lookAhead(Context& context, Temporary& state) {
  BodyState& body = *context.body;
  if (state.busy || body.looking_ahead >= kMaxLookAhead) return;
  if (!body.assigns_known) collectAssigns(context, body.statements);
  body.assigns_known = true;
  state.busy = true;
  ++body.looking_ahead;
  for (size_t k = 0; k < state.assigns.size() && !state.type; ++k) checkValue(context, state, *state.assigns[k]);
  --body.looking_ahead;
  state.busy = false;
}

// Literals alone take the reader's type if they fit it, else the widest of their own.
TypeId typeOfOpen(Context& context, const Temporary& state, TypeId expected) {
  bool fits = expected && !isUntyped(context, expected);
  TypeId widest = types::kInt;
  for (const AssignStmt* open : state.open) {
    if (isNull(context, context.type(open->value))) return context.types().pointer(types::kByte);
    fits = fits && untypedFits(context, open->value, expected);
    widest = commonNumber(context, widest, defaultType(context, open->value));
  }
  return fits ? context.types().plain(expected) : widest;
}

}  // namespace

void declareTemporaries(Context& context, DeclId section) {
  if (!section) return;
  Symbols& symbols = context.symbols;
  const Slice<DeclId> decls = context.tree().as<SectionDecl>(section).vars;
  for (uint32_t k = 0; k < decls.count; ++k) {
    const VarDecl& decl = context.tree().as<VarDecl>(context.tree().list(decls)[k]);
    const Ident ident = context.tree().list(decl.names)[0];
    const VarId id{static_cast<uint32_t>(symbols.vars.size())};
    Pou& pou = symbols.pou(context.pou);
    Var var;
    var.name = ident.name;
    var.loc = ident.loc;
    var.section = SectionKind::Temp;
    var.storage = Storage::Local;
    var.used = {1, 1};
    var.pou = context.pou;
    var.field = static_cast<uint32_t>(pou.vars.size());
    context.body->temporaries.push_back({.var = id});
    var.temporary = static_cast<uint32_t>(context.body->temporaries.size());
    symbols.vars.push_back(var);
    pou.vars.push_back(id);
    context.scopes.pous[context.pou.index].names.insert(keyOf(context, ident.name), entity(id));
  }
}

bool checkTemporaryAssign(Context& context, AssignStmt& node) {
  const VarId var = temporaryOf(context, node.target);
  if (!var) return false;
  checkValue(context, stateOf(context, var), node);
  return true;
}

bool isOpenTemporary(Context& context, ExprId expr) {
  const VarId var = temporaryOf(context, expr);
  return var && !stateOf(context, var).type;
}

TypeId temporaryType(Context& context, VarId id, TypeId expected) {
  Temporary& state = stateOf(context, id);
  if (!state.type) lookAhead(context, state);
  if (!state.type) {
    const Loc first = state.open.empty() ? context.symbols.var(id).loc : state.open.front()->h.loc;
    finalizeType(context, state, typeOfOpen(context, state, expected), first);
  }
  return state.type;
}

void finalizeTemporaries(Context& context) {
  for (const Temporary& state : context.body->temporaries) temporaryType(context, state.var, {});
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Resolves declarations: types, POUs and lists; cuts types that contain themselves, lays everything out and checks
// initial values. Runs after collecting the files, and again whenever a library declaration was read.
#include "sema/declarations/resolve.h"

#include <algorithm>
#include <unordered_set>

#include "sema/declarations/attributes.h"
#include "sema/declarations/bit_members.h"
#include "sema/declarations/diagnostics.h"
#include "sema/declarations/initial_values.h"
#include "sema/declarations/limits.h"
#include "sema/declarations/types.h"
#include "sema/declarations/variables.h"
#include "sema/diagnostics.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

using types::TypeInfo;
using types::TypeKind;

namespace {

// The record that is stored in place in a value of this type; none for pointers. `depth` grows by the arrays and
// aliases around it.
TypeId heldRecord(const Context& context, TypeId type, uint32_t& depth) {
  for (;; ++depth) {
    const TypeInfo& info = context.types().info(type);
    if (info.kind == TypeKind::Record) return type;
    if (info.kind != TypeKind::Alias && info.kind != TypeKind::Array) return {};
    type = info.base;
  }
}

struct CycleSearch {
  Context& context;
  // An explicit stack: the depth of nested blocks is known only at the end.
  struct Step {
    TypeId record;
    uint32_t field;
  };
  std::vector<Step> stack;

  // Forbids a type that contains itself. IEC 61131-3 ed. 3, 6.4.4; manual 5.4.
  //   fails   FUNCTION_BLOCK a VAR x : b; END_VAR … FUNCTION_BLOCK b VAR y : a; END_VAR …       E0303
  void report(TypeId from, uint32_t field_index) {
    std::string names;
    bool inside = false;
    TypeId start{};
    for (const Step& step : stack) {
      if (step.record == from) {
        inside = true;
        start = step.record;
      }
      if (!inside) continue;
      names += "`" + context.types().toString(step.record) + "` contains ";
    }
    names += "`" + context.types().toString(start) + "`";
    NamedType& holder = *context.scopes.named(stack.back().record);
    const VarId var = holder.fields[field_index];
    context.report(diag::ContainsItself, context.symbols.var(var).loc, {context.types().toString(start), names});
  }

  void run(TypeId root) {
    enter(root);
    while (!stack.empty()) {
      Step& top = stack.back();
      NamedType& named = *context.scopes.named(top.record);
      TypeInfo& info = context.types().edit(top.record);
      if (top.field == info.fields.size()) {
        named.cut = State::Done;
        stack.pop_back();
        continue;
      }
      const uint32_t index = top.field++;
      types::Field& field = info.fields[index];
      if (field.by_reference) continue;
      uint32_t depth = 1;
      const TypeId held = heldRecord(context, field.type, depth);
      NamedType* inner = held ? context.scopes.named(held) : nullptr;
      if (inner == nullptr) continue;
      if (inner->cut == State::New) {
        --top.field;  // again, when its own depth is known
        enter(held);
        continue;
      }
      depth += inner->depth;
      if (inner->cut == State::Busy) {
        report(held, index);
      } else if (depth > kMaxTypeDepth) {
        reportTooDeep(context, context.symbols.var(named.fields[index]).loc, "structures and blocks", kMaxTypeDepth);
      } else {
        named.depth = std::max(named.depth, depth);
        continue;
      }
      field.type = types::kError;
      context.symbols.var(named.fields[index]).type = types::kError;
    }
  }

  void enter(TypeId record) {
    resolveNamed(context, record);
    context.scopes.named(record)->cut = State::Busy;
    stack.push_back({record, 0});
  }
};

// Resolves a type and all that it holds, with an explicit stack.
void resolveHeld(Context& context, TypeId type) {
  uint32_t depth = 0;
  const TypeId record = heldRecord(context, type, depth);
  NamedType* named = record ? context.scopes.named(record) : nullptr;
  if (named == nullptr || named->cut != State::New) return;
  CycleSearch search{context, {}};
  search.run(record);
}

void layoutVar(Context& context, VarId id) {
  Var& var = context.symbols.var(id);
  if (var.type == types::kError || !var.type) return;
  if (ensureLayout(context, var.type)) return;
  context.report(diag::TypeTooLarge, var.loc, {context.names().string(var.name)});
  var.type = types::kError;
}

void checkTypeInit(Context& context, TypeId type) {
  const NamedType& named = *context.scopes.named(type);
  if (!named.decl) return;
  const TypeDecl& decl = context.tree().as<TypeDecl>(named.decl);
  if (!decl.init) return;
  Context there = at(context, {}, named.file, named.library, named.region);
  if (context.types().kind(type) == TypeKind::Enum) there.items_of = context.types().resolve(type);
  ExprId init = codeOf(context, decl.init);
  checkInitializerAs(there, init, type, "the initial value of `" + toString(context, decl.name) + "`");
  auto& inits = context.project.type_inits;
  if (inits.size() <= type.index) inits.resize(type.index + 1);
  inits[type.index] = init;
}

void checkFieldInits(Context& context, TypeId type) {
  auto& inits = context.project.field_inits;
  NamedType& named = *context.scopes.named(type);
  std::vector<ExprId> list(named.fields.size());
  for (size_t i = 0; i < list.size(); ++i) {
    ensureInitialValue(context, named.fields[i]);
    if (Var& var = context.symbols.var(named.fields[i]); var.bits.holds_bits) {
      const uint8_t value = initialBits(context, type, named.fields[i]);
      if (value != 0) var.init = makeLiteral(context, LiteralKind::Integer, types::kByte, value, var.loc);
    }
    list[i] = context.symbols.var(named.fields[i]).init;
  }
  if (inits.size() <= type.index) inits.resize(type.index + 1);
  inits[type.index] = std::move(list);
}

}  // namespace

bool ensureLayout(Context& context, TypeId type) {
  resolveHeld(context, type);
  return context.types().layout(type);
}

namespace {

// What holds the fields of a record is resolved: the POU, the list of globals or the type.
bool isResolved(Context& context, TypeId record) {
  resolveNamed(context, record);
  const NamedType* named = context.scopes.named(record);
  if (named == nullptr) return true;
  if (named->pou) return context.scopes.pous[named->pou.index].resolved == State::Done;
  if (named->type) return named->resolved == State::Done;
  for (size_t i = 0; i < context.symbols.global_lists.size(); ++i) {
    if (context.symbols.global_lists[i].record != record) continue;
    resolveList(context, ListId{static_cast<uint32_t>(i)});
    return context.scopes.lists[i].resolved == State::Done;
  }
  return true;
}

// A part of a type that is being resolved; none: all of it is known.
TypeId unresolvedPart(Context& context, TypeId type) {
  std::vector<TypeId> open{type};
  std::unordered_set<uint32_t> seen;
  while (!open.empty()) {
    const TypeId part = open.back();
    open.pop_back();
    const TypeKind kind = context.types().info(part).kind;
    if (kind != TypeKind::Alias && kind != TypeKind::Array && kind != TypeKind::Record) continue;
    if (context.types().info(part).laid_out || !seen.insert(part.index).second) continue;
    if (!isResolved(context, part)) return part;
    const TypeInfo& info = context.types().info(part);
    if (kind != TypeKind::Record) {
      open.push_back(info.base);
      continue;
    }
    for (const types::Field& field : info.fields)
      if (!field.by_reference) open.push_back(field.type);
  }
  return {};
}

}  // namespace

// Forbids a size or bit number in the declaration that determines it. CODESYS, "SIZEOF": known at compile time.
//   fails   FUNCTION_BLOCK A VAR list : ARRAY[0..SIZEOF(A)] OF INT; END_VAR …       E1023
bool checkLayout(Context& context, std::string_view function, TypeId type, Loc loc) {
  const TypeId part = unresolvedPart(context, type);
  if (part) context.report(diag::LayoutOfItself, loc, {function, context.types().toString(part)});
  return !part;
}

namespace {

// True when there are declarations after these positions.
bool areDeclaredAfter(const Context& context, const Scopes::Positions& positions) {
  return positions.types < context.scopes.declared_types.size() || positions.pous < context.project.pous.size() ||
         positions.lists < context.project.global_lists.size();
}

// Resolves all declarations, and those that this adds.
void resolvePending(Context& context) {
  const Project& project = context.project;
  Scopes::Positions& next = context.scopes.resolved;
  while (areDeclaredAfter(context, next)) {
    while (next.types < context.scopes.declared_types.size())
      resolveNamed(context, context.scopes.declared_types[next.types++]);
    while (next.pous < project.pous.size()) resolvePou(context, PouId{static_cast<uint32_t>(next.pous++)});
    while (next.lists < project.global_lists.size()) resolveList(context, ListId{static_cast<uint32_t>(next.lists++)});
  }
}

void layOutType(Context& context, TypeId type) {
  resolveHeld(context, type);
  const NamedType& named = *context.scopes.named(type);
  const bool is_record = context.types().info(type).kind == TypeKind::Record;
  if (!context.types().layout(type) && !named.pou && is_record) {
    const Loc loc = named.decl ? context.tree().loc(named.decl) : named.type ? context.tree().loc(named.type) : Loc{};
    context.report(diag::TypeTooLarge, loc, {context.types().toString(type)});
  }
  if (is_record) checkPacking(context, type);
}

// Lays out all types before any initial value is checked, which may ask for their sizes.
void layOutPending(Context& context, const Scopes::Positions& end) {
  const Project& project = context.project;
  const Scopes::Positions& next = context.scopes.checked;
  for (size_t i = next.types; i < end.types; ++i) layOutType(context, context.scopes.declared_types[i]);
  for (size_t i = next.pous; i < end.pous; ++i) {
    for (const VarId var : project.pous[i].vars) layoutVar(context, var);
    if (project.pous[i].result_var) layoutVar(context, project.pous[i].result_var);
  }
  for (size_t i = next.lists; i < end.lists; ++i) {
    for (const VarId var : project.global_lists[i].vars) layoutVar(context, var);
  }
}

void checkPendingInits(Context& context, const Scopes::Positions& end) {
  Scopes::Positions& next = context.scopes.checked;
  while (next.types < end.types) {
    const TypeId type = context.scopes.declared_types[next.types++];
    checkTypeInit(context, type);
    const NamedType& named = *context.scopes.named(type);
    if (!named.pou && named.type && context.types().info(type).kind == TypeKind::Record) checkFieldInits(context, type);
  }
  while (next.pous < end.pous) {
    const Pou& pou = context.project.pous[next.pous++];
    if (pou.generic) continue;  // its instances are checked
    for (size_t v = 0; v < pou.vars.size(); ++v) ensureInitialValue(context, pou.vars[v]);
    if (pou.record) checkFieldInits(context, pou.record);
  }
  while (next.lists < end.lists) {
    const GlobalList& list = context.project.global_lists[next.lists++];
    for (size_t v = 0; v < list.vars.size(); ++v) ensureInitialValue(context, list.vars[v]);
    checkFieldInits(context, list.record);
  }
}

}  // namespace

void resolveDeclarations(Context& context) {
  Scopes& scopes = context.scopes;
  if (scopes.resolving || scopes.depth > 0) return;  // the outermost call resolves everything
  scopes.resolving = true;
  while (areDeclaredAfter(context, scopes.resolved) || areDeclaredAfter(context, scopes.checked)) {
    resolvePending(context);
    const Scopes::Positions end{.types = scopes.declared_types.size(),
                                .pous = context.project.pous.size(),
                                .lists = context.project.global_lists.size()};
    layOutPending(context, end);
    checkPendingInits(context, end);
  }
  scopes.resolving = false;
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// VAR_TEMP outside of the body that declares it. In: a POU whose bases are resolved. Out: a hidden field for each
// VAR_TEMP that an action names, and a variable of its own for each VAR_TEMP of a base that the POU's body names.
//
// A VAR_TEMP has its value for one call of the body. An action shares the variables of the body that calls it, so a
// temporary that it names lies in the instance: a call of the body saves the field, gives it the initial value, and
// restores it at the end, so a call inside of a call has values of its own. While no body runs (`in_body`), an action
// begins with the initial values. A method cannot use it (bodies/names.cpp).
#include "sema/declarations/shared_temporaries.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "frontend/syntax/children.h"
#include "sema/declarations/variables.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

// The names in a body, whatever its language. Charts and networks may name more than they use.
class NamesIn {
 public:
  NamesIn(Context& context, const NameMap& wanted) : context_(context), wanted_(wanted) {}

  void add(const PouDecl& decl) {
    all_ = all_ || decl.body_kind == BodyKind::Cpp;
    const Tree& tree = context_.tree();
    const auto push = [&](auto id) { open_.push_back(id); };
    ChildWalk<const Tree, decltype(push)> walk(tree, push);
    walk(decl.body);
    walk(decl.il);
    walk(decl.diagram);
    walk(decl.steps);
    walk(decl.transitions);
    finish();
  }
  void add(ExprId expr) {
    if (expr) open_.push_back(expr);
    finish();
  }
  bool has(NameId key) const { return all_ || found_.find(key); }

 private:
  using Node = std::variant<ExprId, StmtId, TypeExprId, DeclId>;

  void finish() {
    const Tree& tree = context_.tree();
    while (!open_.empty()) {
      const Node node = open_.back();
      open_.pop_back();
      if (const ExprId* expr = std::get_if<ExprId>(&node); expr != nullptr && tree.kind(*expr) == ExprKind::Name) {
        const NameId key = keyOf(context_, tree.as<NameExpr>(*expr).name);
        if (const Entity of = wanted_.find(key)) found_.insert(key, of);
      }
      std::visit([&](auto id) { forEachChild(tree, id, [&](auto child) { open_.push_back(child); }); }, node);
    }
  }

  Context& context_;
  const NameMap& wanted_;
  NameMap found_;
  std::vector<Node> open_;
  bool all_ = false;
};

VarId addHiddenField(Context& context, PouId pou, const std::string& name, TypeId type, VarId holds = {}) {
  Symbols& symbols = context.symbols;
  Var hidden;
  hidden.name = context.names().intern(name);
  hidden.loc = symbols.pou(pou).loc;
  hidden.type = type;
  hidden.storage = Storage::Field;
  hidden.keeping.non_retain = true;
  hidden.symbol_access = types::SymbolAccess::None;
  hidden.pragmas.no_exit = true;
  hidden.sharing.holds = holds;
  hidden.pou = pou;
  hidden.used = {1, 1};
  const VarId created{static_cast<uint32_t>(symbols.vars.size())};
  symbols.vars.push_back(hidden);
  symbols.pou(pou).vars.push_back(created);
  return created;
}

bool isTemporary(const Var& var) {
  return var.section == SectionKind::Temp && var.storage == Storage::Local && var.name && var.type;
}

// What the initial value of a temporary reads is used where it is declared.
VarId declaredOf(const Symbols& symbols, VarId var) {
  const VarId copied = symbols.var(var).sharing.copy_of;
  return copied ? copied : var;
}

// The temporaries that a POU or its bases declare and nothing nearer hides, in order of declaration.
std::vector<VarId> temporariesOf(Context& context, PouId id, NameMap& known) {
  Symbols& symbols = context.symbols;
  std::vector<VarId> temporaries;
  for (PouId at = id; at; at = symbols.pou(at).base) {
    if (at != id) resolvePou(context, at);
    const std::vector<VarId> vars = symbols.pou(at).vars;
    for (const VarId var : vars) {
      ensureVarType(context, var);
      if (!isTemporary(symbols.var(var))) continue;
      const NameId key = keyOf(context, symbols.var(var).name);
      const Entity own = context.scopes.pous[id.index].names.find(key);
      if (at != id && own) continue;
      if (known.insert(key, entity(var))) temporaries.push_back(var);
    }
  }
  std::sort(temporaries.begin(), temporaries.end(),
            [&](VarId a, VarId b) { return declaredOf(symbols, a).index < declaredOf(symbols, b).index; });
  return temporaries;
}

// The temporary of a base as this POU has it.
VarId copyTemporary(Context& context, PouId id, VarId var) {
  Symbols& symbols = context.symbols;
  Var copy = symbols.var(var);
  copy.pou = id;
  copy.sharing.copy_of = declaredOf(symbols, var);
  copy.decl = {};
  copy.used = {1, 1};
  Var& original = symbols.var(copy.sharing.copy_of);
  original.used = {1, 1};
  const VarId own{static_cast<uint32_t>(symbols.vars.size())};
  symbols.vars.push_back(copy);
  symbols.pou(id).vars.push_back(own);
  context.scopes.pous[id.index].names.insert(keyOf(context, copy.name), entity(own));
  return own;
}

}  // namespace

void shareTemporaries(Context& context, PouId id) {
  Symbols& symbols = context.symbols;
  const bool is_block = symbols.pou(id).kind == PouKind::FunctionBlock || symbols.pou(id).kind == PouKind::Program;
  if (!is_block || symbols.pou(id).owner) return;
  NameMap known;
  const std::vector<VarId> temporaries = temporariesOf(context, id, known);
  if (temporaries.empty()) return;
  NamesIn actions(context, known), body(context, known);
  for (const PouId member : symbols.pou(id).members)
    if (symbols.pou(member).kind == PouKind::Action) actions.add(context.tree().as<PouDecl>(symbols.pou(member).decl));
  body.add(context.tree().as<PouDecl>(symbols.pou(id).decl));
  for (size_t i = temporaries.size(); i-- > 0;) {
    const NameId key = keyOf(context, symbols.var(temporaries[i]).name);
    const Var& var = symbols.var(declaredOf(symbols, temporaries[i]));
    const ExprId init = var.decl ? context.tree().as<VarDecl>(var.decl).init : ExprId{};
    if (actions.has(key)) actions.add(init);
    if (body.has(key)) body.add(init);
  }
  for (const VarId var : temporaries) {
    if (symbols.var(var).sharing.field) continue;  // by a base
    const NameId key = keyOf(context, symbols.var(var).name);
    const bool is_own = symbols.var(var).pou == id;
    if (!is_own && !actions.has(key) && !body.has(key)) continue;
    const VarId own = is_own ? var : copyTemporary(context, id, var);
    if (!actions.has(key)) continue;
    const std::string name = "__" + toString(context, symbols.var(own).name) + "_temp";
    const VarId field = addHiddenField(context, id, name, symbols.var(own).type, own);
    symbols.var(own).sharing.field = field;
  }
  const auto isShared = [&](VarId var) { return static_cast<bool>(symbols.var(var).sharing.field); };
  const std::vector<VarId>& vars = symbols.pou(id).vars;
  if (std::any_of(vars.begin(), vars.end(), isShared))
    symbols.pou(id).object.in_body = addHiddenField(context, id, "__in_body", types::kBool);
}

}  // namespace rung::sema

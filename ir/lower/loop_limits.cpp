// SPDX-License-Identifier: Apache-2.0
// FOR in codesys evaluates its end value before every turn (SA0081). Lowering makes such a loop: it counts to the limit
// of the type, and leaves when the control variable is past the end value. Where nothing in the loop can change the end
// value, which is known when all bodies are lowered, it becomes a loop that counts to it.
// In: the loops that lowering noted. Out: the same loops or simpler ones. Called by module.cpp.
//
// What a statement writes is a set of names: a variable of an instance, list or structure may have changed when a field
// of its name was written, be it of another instance. A write through a pointer, a virtual call and a body in C++
// change everything but locals whose address is not taken. Other tasks do not count: nothing orders them with the loop.
#include <unordered_map>
#include <unordered_set>

#include "ir/lower/lowering.h"

namespace rung::ir {

namespace {

constexpr size_t kMostCallees = 200;  // looked at for one loop; with more, it may have changed

// A place as a chain of fields.
struct Chain {
  ExprKind root = ExprKind::None;
  uint32_t number = 0;            // of a local or an area
  bool is_reached = false;        // through a pointer or an in-out: it may be a part of any variable
  bool is_through_field = false;  // through an in-out of an instance, which keeps it from call to call
  bool overlaps = false;          // in a UNION
  std::vector<uint32_t> names;    // keys, the innermost first
  TypeId type;                    // of bits: of the variable that they are in
};

struct Effects {
  bool everything = false;                            // that has an address
  std::unordered_set<uint32_t> names, areas, locals;  // innermost names of written places
  std::unordered_set<uint32_t> types,
      reached_types;            // of written places, of those reached through an instance's in-out
  bool has_aggregates = false;  // one of them is a structure or an array
  std::vector<BodyId> calls;
};

class LoopLimits {
 public:
  explicit LoopLimits(Module& module) : module_(module) {}

  void simplify(const VariableLimit& loop);

 private:
  Chain chainOf(const Body& body, ExprId place) const;
  void write(const Body& body, ExprId place, Effects& effects) const;
  void add(const Body& body, StmtId id, Effects& effects) const;
  const Effects& effectsOf(BodyId body);
  const std::unordered_set<uint32_t>& addressedIn(BodyId body);
  bool changes(const Effects& effects, const Chain& read, bool is_own) const;
  bool mayChange(const VariableLimit& loop, ExprId end);

  Module& module_;
  std::unordered_map<uint32_t, Effects> effects_;                         // by body
  std::unordered_map<uint32_t, std::unordered_set<uint32_t>> addressed_;  // locals by body
};

Chain LoopLimits::chainOf(const Body& body, ExprId place) const {
  Chain chain;
  for (ExprId id = place; id; id = baseOf(body.expr(id))) {
    const Expr& expr = body.expr(id);
    chain.root = expr.kind;
    if (!chain.type && expr.kind != ExprKind::Bits) chain.type = module_.types.resolve(expr.type);
    if (const auto* field = expr.tryAs<FieldExpr>()) {
      const types::TypeInfo& record = module_.types.info(module_.types.resolve(body.expr(field->base).type));
      chain.names.push_back(module_.names.key(record.fields[field->field].name).index);
      chain.overlaps = chain.overlaps || record.record_kind == types::RecordKind::Union || record.overlaps;
      chain.is_through_field = chain.is_through_field || record.fields[field->field].by_reference;
    }
    if (const uint32_t* local = localOf(expr)) {
      chain.number = *local;
      chain.is_reached = chain.is_reached || body.locals[*local].by_reference;
    }
    if (const auto* image = expr.tryAs<ImageExpr>()) chain.number = image->area;
    chain.is_reached = chain.is_reached || chain.is_through_field || expr.kind == ExprKind::Deref;
  }
  return chain;
}

void LoopLimits::write(const Body& body, ExprId place, Effects& effects) const {
  const Chain chain = chainOf(body, place);
  const TypeKind kind = module_.types.kind(chain.type);
  const bool is_aggregate = kind == TypeKind::Record || kind == TypeKind::Array;
  effects.types.insert(chain.type.index);
  effects.has_aggregates = effects.has_aggregates || is_aggregate;
  if (chain.root == ExprKind::Deref || chain.overlaps || (chain.is_through_field && is_aggregate))
    effects.everything = true;
  if (chain.is_through_field) effects.reached_types.insert(chain.type.index);
  if (chain.root == ExprKind::Image) effects.areas.insert(chain.number);
  if (!chain.names.empty()) effects.names.insert(chain.names.front());
  if (chain.root == ExprKind::Local) {
    // What an in-out of a function refers to is written where the function is called.
    if (!chain.is_reached) effects.locals.insert(chain.number);
  } else if (chain.names.empty() && chain.root != ExprKind::Image) {
    effects.everything = true;  // a whole instance
  }
}

// Adds the names that the statement itself writes, without those in its blocks.
void LoopLimits::add(const Body& body, StmtId id, Effects& effects) const {
  const Stmt& stmt = body.stmt(id);
  forEachRoot(module_, body, stmt, [&](ExprId root, Use use) {
    const auto* call = stmt.tryAs<CallStmt>();
    const bool is_object = call != nullptr && root == call->self && !module_.body(call->callee).native;
    if (use != Use::Read && !is_object) write(body, root, effects);
  });
  const auto* call = stmt.tryAs<CallStmt>();
  if (call == nullptr) return;
  const Body& callee = module_.body(call->callee);
  if (call->is_virtual || callee.cpp != 0) effects.everything = true;
  if (!callee.native && !callee.pure) effects.calls.push_back(call->callee);
}

const Effects& LoopLimits::effectsOf(BodyId id) {
  const auto [found, is_new] = effects_.try_emplace(id.index);
  Effects& effects = found->second;
  if (is_new) {
    const Body& body = module_.body(id);
    forEachStmt(body, body.first, [&](StmtId stmt) { add(body, stmt, effects); });
    effects.locals.clear();
  }
  return effects;
}

// The locals whose address is taken anywhere, or to which an in-out of an instance refers.
const std::unordered_set<uint32_t>& LoopLimits::addressedIn(BodyId id) {
  const auto [found, is_new] = addressed_.try_emplace(id.index);
  std::unordered_set<uint32_t>& addressed = found->second;
  if (!is_new) return addressed;
  const Body& body = module_.body(id);
  const auto take = [&](ExprId place) {
    if (const uint32_t* local = place ? localOf(body.expr(rootOf(body, place))) : nullptr) addressed.insert(*local);
  };
  for (const Expr& expr : body.exprs)
    if (const auto* address = expr.tryAs<AddressExpr>()) take(address->place);
  for (const Stmt& stmt : body.stmts)
    if (const auto* bind = stmt.tryAs<BindStmt>()) take(bind->place);
  return addressed;
}

bool LoopLimits::changes(const Effects& effects, const Chain& read, bool is_own) const {
  if (read.root == ExprKind::Local && !read.is_reached && effects.locals.count(read.number) != 0) return true;
  if (is_own) return false;
  if (effects.everything) return true;
  if (read.overlaps) return !effects.types.empty();
  if (read.root == ExprKind::Image) return effects.areas.count(read.number) != 0;
  if (read.is_reached && (effects.has_aggregates || effects.types.count(read.type.index) != 0)) return true;
  if (effects.reached_types.count(read.type.index) != 0) return true;
  for (const uint32_t name : read.names)
    if (effects.names.count(name) != 0) return true;
  return false;
}

bool LoopLimits::mayChange(const VariableLimit& loop, ExprId end) {
  const Body& body = module_.body(loop.body);
  std::vector<std::pair<Chain, bool>> read;
  forEachExpr(body, end, [&](ExprId id) {
    const ExprKind kind = body.expr(id).kind;
    if (!isPlace(kind) || kind == ExprKind::Self || kind == ExprKind::Global || kind == ExprKind::Program) return;
    const Chain& chain = read.emplace_back(chainOf(body, id), false).first;
    read.back().second =
        chain.root == ExprKind::Local && !chain.is_reached && addressedIn(loop.body).count(chain.number) == 0;
  });
  const auto isChanged = [&](const Effects& effects) {
    for (const auto& [chain, is_own] : read)
      if (changes(effects, chain, is_own)) return true;
    return false;
  };
  Effects own;
  write(body, body.stmt(loop.loop).as<ForStmt>().control, own);
  forEachStmt(body, body.stmt(loop.loop).as<ForStmt>().body_block, [&](StmtId id) { add(body, id, own); });
  if (isChanged(own)) return true;
  std::unordered_set<uint32_t> seen;
  std::vector<BodyId> calls = own.calls;
  while (!calls.empty()) {
    const BodyId callee = calls.back();
    calls.pop_back();
    if (!seen.insert(callee.index).second) continue;
    if (seen.size() > kMostCallees) return true;
    const Effects& effects = effectsOf(callee);
    if (isChanged(effects)) return true;
    calls.insert(calls.end(), effects.calls.begin(), effects.calls.end());
  }
  return false;
}

void LoopLimits::simplify(const VariableLimit& noted) {
  Body& body = module_.body(noted.body);
  ForStmt& loop = body.stmt(noted.loop).as<ForStmt>();
  const StmtId test = loop.body_block;
  const ExprId end = body.expr(body.stmt(test).as<IfStmt>().condition).as<BinaryExpr>().right;
  if (mayChange(noted, end)) return;
  loop.to = end;
  loop.body_block = body.stmt(test).next;
}

}  // namespace

void ModuleLowering::simplifyLimits() {
  LoopLimits limits(module);
  for (const VariableLimit& loop : variable_limits) limits.simplify(loop);
}

}  // namespace rung::ir

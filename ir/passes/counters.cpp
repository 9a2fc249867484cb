// SPDX-License-Identifier: Apache-2.0
// See counters.h.
#include "ir/passes/counters.h"

#include <algorithm>

#include "ir/passes/effects.h"
#include "ir/passes/support.h"
#include "sema/types/arithmetic.h"

namespace rung::ir {

using types::Op;
using types::TypeTable;

namespace {

constexpr uint32_t kNoVariable = KnownVariables::kNone;
constexpr Int128 kMost = Int128{1} << 64;  // larger products prove nothing

}  // namespace

// ---- variables and constants

uint32_t Counters::counted(uint32_t variable) const {
  const bool is_counted = variable != kNoVariable && variables_.isIntegral(variables_.typeOf(variable));
  return is_counted ? variable : kNoVariable;
}

std::optional<Int128> Counters::constant(ExprId id) const {
  const Expr& e = body_.expr(id);
  if (!isConst(e) || !hasInterval(module_.types, e.type)) return std::nullopt;
  const bool is_signed = module_.types.isSigned(module_.types.plainKind(e.type));
  return is_signed ? Int128{static_cast<int64_t>(bitsOf(e))} : Int128{bitsOf(e)};
}

// ---- iterations

// `x`, `x + 1` or `x - 1`. Its type is the narrowest that the value went through: beyond it nothing is cut any more.
std::optional<Counters::Sum> Counters::sumOf(ExprId id) const {
  TypeId narrowest = body_.expr(id).type;
  while (const auto* convert = body_.expr(id).tryAs<ConvertExpr>()) {
    if (variableAfter(id) != kNoVariable) break;
    const TypeId from = body_.expr(convert->operand).type, to = body_.expr(id).type;
    if (!hasInterval(module_.types, from)) return std::nullopt;
    if (types::isLossless(module_.types, from, narrowest))
      narrowest = from;
    else if (TypeTable::bitWidth(module_.types.plainKind(from)) < TypeTable::bitWidth(module_.types.plainKind(to)))
      return std::nullopt;  // narrower, but of another sign
    id = convert->operand;
  }
  if (const uint32_t v = variableAfter(id); v != kNoVariable) {
    while (const auto* convert = body_.expr(id).tryAs<ConvertExpr>()) id = convert->operand;
    return Sum{v, 0, body_.expr(id).type};
  }
  const auto* sum = body_.expr(id).tryAs<BinaryExpr>();
  if (sum == nullptr || (sum->op != Op::Add && sum->op != Op::Sub)) return std::nullopt;
  const uint32_t v = variableAfter(sum->left);
  const std::optional<Int128> addend = constant(sum->right);
  if (v == kNoVariable || !addend) return std::nullopt;
  return Sum{v, sum->op == Op::Add ? *addend : -*addend, narrowest};
}

std::optional<Int128> Counters::mostIterations(const ForStmt& loop) const {
  const std::optional<Int128> step = constant(loop.step);
  if (!step || *step == 0) return std::nullopt;
  std::optional<Int128> distance;
  const std::optional<Int128> from = constant(loop.from), to = constant(loop.to);
  if (from && to) {
    distance = *to - *from;
  } else {
    const std::optional<Sum> first = sumOf(loop.from), last = sumOf(loop.to);
    if (!first || !last || first->variable != last->variable || first->variable == variable(loop.control))
      return std::nullopt;
    // Both are cut to one type, in which they differ by the distance, or by it less all values of the type: then the
    // loop does not run. Where nothing is added nothing is cut.
    const TypeId type = first->addend != 0 ? first->type : last->type;
    const TypeId other = first->addend != 0 ? last->type : first->type;
    const bool is_cut_alike =
        module_.types.plainKind(type) == module_.types.plainKind(other) ||
        ((first->addend == 0 || last->addend == 0) && types::isLossless(module_.types, other, type));
    if (!is_cut_alike) return std::nullopt;
    distance = last->addend - first->addend;
    const Interval all = intervalOf(module_.types, type, false);
    if (*distance * (*step > 0 ? 1 : -1) < 0 || *distance > all.high - all.low || -*distance > all.high - all.low)
      return std::nullopt;
  }
  if (*step < 0) return *distance > 0 ? 0 : -*distance / -*step + 1;
  return *distance < 0 ? 0 : *distance / *step + 1;
}

// ---- growth

// `v := v + c`, with conversions on the way.
bool Counters::count(const AssignStmt& assign, Growth& growth) const {
  Interval limit = intervalOf(module_.types, body_.expr(assign.place).type, true);
  ExprId id = assign.value;
  const auto through = [&](TypeId type) { limit = meet(limit, intervalOf(module_.types, type, true)); };
  while (const auto* convert = body_.expr(id).tryAs<ConvertExpr>()) {
    if (!hasInterval(module_.types, body_.expr(id).type)) return false;
    through(body_.expr(id).type);
    id = convert->operand;
  }
  const auto* sum = body_.expr(id).tryAs<BinaryExpr>();
  if (sum == nullptr || (sum->op != Op::Add && sum->op != Op::Sub)) return false;
  const std::optional<Int128> addend = constant(sum->right);
  if (!addend || variableAfter(sum->left) != variable(assign.place)) return false;
  through(body_.expr(id).type);
  through(body_.expr(sum->left).type);
  const Int128 by = sum->op == Op::Add ? *addend : -*addend;
  growth.limit = meet(growth.limit, limit);
  (by > 0 ? growth.up : growth.down) += by > 0 ? by : -by;
  return growth.up <= kMost && growth.down <= kMost;
}

bool Counters::mayWrite(const Stmt& stmt, uint32_t variable) const {
  const bool is_own = !variables_.isLocal(variable);
  bool may = is_own && bindsOwn(body_, stmt);
  forEachWritten(module_, body_, stmt, [&](ExprId place) {
    const Effect effect = effectOfWrite(module_, body_, variables_.privateLocals(), place);
    switch (effect.kind) {
      case Effect::None: return;
      case Effect::Local: may = may || effect.index == variable; return;
      case Effect::Field:
        may = may || (variables_.isField(variable) && effect.index == variables_.fieldOf(variable));
        return;
      case Effect::Exposed: may = may || variables_.isExposed(variable); return;
      case Effect::Fields: may = may || is_own; return;
    }
  });
  if (const auto* call = stmt.tryAs<CallStmt>(); call != nullptr && is_own && !may)
    may = !module_.body(call->callee).pure &&
          (callReachesSelf(module_, exposure_, body_, *call) || variables_.isExposed(variable));
  return may;
}

void Counters::addLoop(StmtId block, const ForStmt* loop, const std::vector<uint32_t>& variables, Growths& to) const {
  const Growths once = growthIn(block, variables);
  const std::optional<Int128> most = loop == nullptr ? std::nullopt : mostIterations(*loop);
  const Int128 times = most.value_or(kMost + 1);
  for (size_t i = 0; i < to.size(); ++i) {
    Growth& growth = to[i];
    const bool is_still = once[i].up == 0 && once[i].down == 0;
    if (!once[i].is_counted || (!is_still && times > kMost)) {
      growth.is_counted = false;
    } else if (!is_still) {
      growth.up += once[i].up * times;
      growth.down += once[i].down * times;
      growth.limit = meet(growth.limit, once[i].limit);
      growth.is_counted = growth.is_counted && growth.up <= kMost && growth.down <= kMost;
    }
  }
}

// One of the blocks runs, or none.
void Counters::addBranches(const std::vector<StmtId>& blocks, const std::vector<uint32_t>& variables,
                           Growths& to) const {
  Growths most(variables.size());
  for (size_t i = 0; i < to.size(); ++i) most[i].limit = to[i].limit;
  for (const StmtId block : blocks) {
    const Growths one = growthIn(block, variables);
    for (size_t i = 0; i < to.size(); ++i) {
      most[i].up = std::max(most[i].up, one[i].up);
      most[i].down = std::max(most[i].down, one[i].down);
      most[i].limit = meet(most[i].limit, one[i].limit);
      most[i].is_counted = most[i].is_counted && one[i].is_counted;
    }
  }
  for (size_t i = 0; i < to.size(); ++i) {
    to[i].up += most[i].up;
    to[i].down += most[i].down;
    to[i].limit = meet(to[i].limit, most[i].limit);
    to[i].is_counted = to[i].is_counted && most[i].is_counted && to[i].up <= kMost && to[i].down <= kMost;
  }
}

void Counters::addStmt(const Stmt& stmt, const std::vector<uint32_t>& variables, Growths& to) const {
  const auto* assign = stmt.tryAs<AssignStmt>();
  const uint32_t target = assign == nullptr ? kNoVariable : variable(assign->place);
  for (size_t i = 0; i < to.size(); ++i) {
    if (!to[i].is_counted) continue;
    const bool is_counted = target == variables[i] ? count(*assign, to[i]) : !mayWrite(stmt, variables[i]);
    to[i].is_counted = is_counted;
  }
  if (const auto* branch = stmt.tryAs<IfStmt>())
    return addBranches({branch->then_block, branch->else_block}, variables, to);
  if (const auto* branch = stmt.tryAs<SwitchStmt>()) {
    std::vector<StmtId> blocks{branch->else_block};
    for (const Case& one : body_.list(branch->cases)) blocks.push_back(one.block);
    return addBranches(blocks, variables, to);
  }
  if (const auto* loop = stmt.tryAs<ForStmt>()) return addLoop(loop->body_block, loop, variables, to);
  if (const auto* loop = stmt.tryAs<LoopStmt>()) {
    addLoop(loop->body_block, nullptr, variables, to);
    return addLoop(loop->next_block, nullptr, variables, to);
  }
  const bool is_entered_elsewhere =
      stmt.kind == StmtKind::Label || stmt.kind == StmtKind::Jump || stmt.kind == StmtKind::Try;
  if (!is_entered_elsewhere) return;
  for (Growth& growth : to) growth.is_counted = false;
}

void Counters::add(StmtId block, const std::vector<uint32_t>& variables, Growths& to) const {
  for (StmtId id = block; id; id = body_.stmt(id).next) addStmt(body_.stmt(id), variables, to);
}

std::vector<Growth> Counters::growthIn(StmtId block, const std::vector<uint32_t>& variables) const {
  Growths growths(variables.size());
  for (Growth& growth : growths) growth.limit = {-kMost, kMost};
  add(block, variables, growths);
  return growths;
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Range analysis: see remove_checks.h. Walks the statements with the facts that hold at each (range_facts.h).
#include "ir/passes/remove_checks.h"

#include <algorithm>
#include <optional>

#include "ir/passes/counters.h"
#include "ir/passes/range_facts.h"
#include "ir/passes/support.h"

namespace rung::ir {

using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

constexpr uint32_t kNone = RangeFacts::kNone;

TypeId unsignedOf(TypeId type) {
  return type == types::kSInt   ? types::kUSInt
         : type == types::kInt  ? types::kUInt
         : type == types::kDInt ? types::kUDInt
         : type == types::kLInt ? types::kULInt
                                : TypeId{};
}

// By a positive constant: cheaper without sign.
bool isSignedDivision(const Body& body, const Expr& e) {
  const auto* division = e.tryAs<BinaryExpr>();
  if (division == nullptr || (division->op != Op::Div && division->op != Op::Mod) || !unsignedOf(e.type)) return false;
  const Expr& divisor = body.expr(division->right);
  return isConst(divisor) && static_cast<int64_t>(bitsOf(divisor)) > 0;
}

bool isWorthIt(const Body& body) {
  return std::any_of(body.exprs.begin(), body.exprs.end(),
                     [&](const Expr& e) { return (e.checks & ~kCheckCast) != 0 || isSignedDivision(body, e); });
}

class Analysis {
 public:
  Analysis(Module& module, const Exposure& exposure, Body& body)
      : module_(module), types_(module.types), exposure_(exposure), body_(body), facts_(module, exposure, body) {}

  bool run() {
    findChecks();
    block(body_.first);
    return changed_;
  }

 private:
  void dropSign(ExprId id) {
    const Expr signed_one = body_.expr(id);
    BinaryExpr division = signed_one.as<BinaryExpr>();
    Builder builder(module_, body_);
    const auto add = [&](const auto& fields) {
      has_checks_.push_back(has_checks_[id.index]);
      return builder.add(signed_one.loc, unsignedOf(signed_one.type), fields);
    };
    division.left = add(ConvertExpr{division.left});
    division.right = add(ConstExpr{.bits = bitsOf(body_.expr(division.right))});
    const ExprId created = add(division);
    body_.expr(id).set(ConvertExpr{created});
    changed_ = true;
  }

  // Finds the expressions with a check or a division that may lose its sign in or below them; the others are evaluated
  // only where their value matters.
  void findChecks() {
    has_checks_.assign(body_.exprs.size(), false);
    bool all_known = true;
    size_t divisions = 0;
    for (uint32_t i = 1; i < body_.exprs.size(); ++i) {
      const Expr& e = body_.exprs[i];
      divisions += isSignedDivision(body_, e);
      uint8_t found = e.checks != 0 || isSignedDivision(body_, e);
      forEachOperand(body_, e, [&](ExprId operand) {
        found |= has_checks_[operand.index];
        all_known = all_known && operand.index < i;
      });
      has_checks_[i] = found;
    }
    if (divisions != 0) body_.exprs.reserve(body_.exprs.size() + 3 * divisions);  // nodes stay where they are
    if (!all_known) has_checks_.assign(body_.exprs.size(), true);  // a pass left users before their operands
  }

  const KnownVariables& variables() const { return facts_.variables(); }
  uint32_t variable(ExprId id) const { return variables().at(id); }
  bool isIntegral(TypeId type) const { return variables().isIntegral(type); }
  bool isPointer(TypeId type) const { return variables().isPointer(type); }
  bool isTracked(TypeId type) const { return variables().isTracked(type); }
  Interval allOf(TypeId type, bool with_bounds) { return facts_.allOf(type, with_bounds); }

  // ---- statements

  // Tells whether control leaves the end of the list. Statements after one that control does not leave are dead.
  bool block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next)
      if (!stmt(body_.stmt(id))) return false;
    return true;
  }

  bool stmt(Stmt& s) {
    switch (s.kind) {
      case StmtKind::None:
      case StmtKind::Label: return true;
      case StmtKind::Break: note(&Watch::at_exit); return false;
      case StmtKind::Continue: note(&Watch::at_end); return false;
      case StmtKind::Return:
      case StmtKind::Jump: return false;
      case StmtKind::Fault:
        if (const ExprId shown = s.as<FaultStmt>().value) value(shown);
        return false;
      case StmtKind::Assign: assign(s.as<AssignStmt>()); return true;
      case StmtKind::Bind:
      case StmtKind::Call:
      case StmtKind::Assert:
      case StmtKind::Evaluate:
        forEachRoot(module_, body_, s, [&](ExprId root, Use) { valueForChecks(root); });
        facts_.effectsOf(s);
        return true;
      case StmtKind::If: return ifStmt(s.as<IfStmt>());
      case StmtKind::Switch: return switchStmt(s.as<SwitchStmt>());
      case StmtKind::Loop: {
        LoopState loop{s.as<LoopStmt>().body_block, s.as<LoopStmt>().next_block, {}};
        const size_t mark = facts_.mark();
        facts_.effectsIn(loop.body);
        facts_.effectsIn(loop.next);
        watch(loop, mark, kNone);
        iterate(loop, [] {});
        for (const Watch& one : loop.watches)
          if (one.at_exit) facts_.set(one.variable, *one.at_exit);
        return true;
      }
      case StmtKind::For: return forLoop(s.as<ForStmt>());
      case StmtKind::Try: tryStmt(s.as<TryStmt>()); return true;
    }
    return true;
  }
  void assign(const AssignStmt& s) {
    const uint32_t v = variable(s.place);
    if (v == kNone) {
      valueForChecks(s.place);
      valueForChecks(s.value);
      facts_.written(s.place);
    } else {
      const Interval given = value(s.value);
      const Interval both = meet(given, allOf(body_.expr(s.place).type, true));
      facts_.set(v, both.isEmpty() ? given : both);
    }
  }
  bool ifStmt(const IfStmt& s) {
    valueForChecks(s.condition);
    RangeFacts::Junction branches = facts_.junction();
    for (const bool outcome : {true, false}) {
      facts_.branch(branches, [&] {
        refine(s.condition, outcome);
        return block(outcome ? s.then_block : s.else_block);
      });
    }
    facts_.join(branches);
    return branches.falling > 0;
  }
  void tryStmt(const TryStmt& s) {
    for (const StmtId part : {s.body_block, s.catch_block, s.finally_block}) {  // begins anywhere in the one before
      RangeFacts::Junction alone = facts_.junction();
      facts_.branch(alone, [&] { return block(part); });
      facts_.discard(alone);
      facts_.effectsIn(part);
      if (part == s.body_block && s.number) {
        value(s.number);
        facts_.written(s.number);
      }
    }
  }

  // ---- loops. At the head of a loop, a variable that it writes may have any value, unless each iteration leaves it
  // within some interval around the values from before the loop. Such an interval is a guess that a walk through the
  // loop confirms or rejects: first the values before the loop, then those without the bounds that the iteration
  // exceeds (except 0), then what that iteration left.

  struct Watch {
    uint32_t variable;
    Interval before, head;
    Interval most = {-kWide, kWide}, most_after = {-kWide, kWide};  // of a counter: at the head, after the loop
    Interval agreed = {};                                           // the last guess that held
    std::optional<Interval> at_end = {}, at_exit = {};  // joined over all ends of an iteration, over all breaks
    bool is_narrowed = false;
  };
  struct LoopState {
    StmtId body, next;
    std::vector<Watch> watches;
  };
  static constexpr int kMaxRounds = 6, kMaxTrials = 2;  // walks of a loop; nested loops that are tried

  void note(std::optional<Interval> Watch::*where) {
    if (loops_.empty()) return;
    for (Watch& one : loops_.back()->watches) {
      std::optional<Interval>& noted = one.*where;
      const Interval now = facts_.current(one.variable);
      noted = noted ? join(*noted, now) : now;
    }
  }

  // A break or continue in a Try runs its last block first.
  bool isWorthWatching(StmtId first) {
    bool has_checks = false, has_try = false;
    forEachStmt(body_, first, [&](StmtId id) {
      has_try = has_try || body_.stmt(id).kind == StmtKind::Try;
      forEachRoot(module_, body_, body_.stmt(id),
                  [&](ExprId root, Use) { has_checks = has_checks || has_checks_[root.index] != 0; });
    });
    return has_checks && !has_try;
  }
  // The variables whose facts went into the trail from `mark` on, because the loop writes them.
  void watch(LoopState& loop, size_t mark, uint32_t control) {
    if (trials_ == kMaxTrials || mark == facts_.mark()) return;
    if (!isWorthWatching(loop.body) && !isWorthWatching(loop.next)) return;
    facts_.forEachForgotten(mark, [&](uint32_t variable, const Interval& before) {
      if (variable != control) loop.watches.push_back({variable, before, before});
    });
  }

  template <class Before>
  void iterateOnce(LoopState& loop, Before&& before) {
    for (Watch& one : loop.watches) {
      one.at_end.reset();
      one.at_exit.reset();
    }
    const size_t mark = facts_.mark();
    loops_.push_back(&loop);
    for (const Watch& one : loop.watches) facts_.set(one.variable, one.head);
    before();
    if (block(loop.body)) note(&Watch::at_end);
    facts_.undo(mark);
    if (loop.next) {
      for (Watch& one : loop.watches) {
        if (one.at_end) facts_.set(one.variable, *one.at_end);
        one.at_end.reset();
      }
      if (block(loop.next)) note(&Watch::at_end);
      facts_.undo(mark);
    }
    loops_.pop_back();
  }
  // The next guess for a variable whose iterations leave `left`; false: this one stays. The first guess for a counter
  // that a test stops at 7 fails, since the largest value plus one wraps; then the test's bound is tried.
  bool guess(Watch& one) {
    if (!one.at_end) return false;
    const Interval end = meet(*one.at_end, one.most);
    if (end.isEmpty()) return false;  // there is no next iteration
    const Interval left = join(one.before, end), last = one.head;
    if (left == last || (one.is_narrowed && left.within(last))) return false;
    const bool below = left.low<last.low, above = left.high> last.high;
    if (!one.is_narrowed && !(below && above) && (left.low > last.low || left.high < last.high)) {
      one.head = meet(left, last);
      one.is_narrowed = true;
      return true;
    }
    const Interval any = facts_.all(one.variable);
    const Int128 least = left.low >= 0 ? std::max<Int128>(any.low, 0) : any.low;
    one.head = meet({below ? least : last.low, above ? any.high : last.high}, one.most);
    return true;
  }
  template <class Before>
  void iterate(LoopState& loop, Before&& before) {
    const bool outer = asking_;
    asking_ = true;
    ++trials_;
    bool has_agreed = false;
    for (int round = 0; !loop.watches.empty(); ++round) {
      if (round < kMaxRounds) iterateOnce(loop, before);
      bool holds = round < kMaxRounds, changed = false;
      for (const Watch& one : loop.watches) {
        if (!one.at_end) continue;
        const Interval end = meet(*one.at_end, one.most);
        holds = holds && (end.isEmpty() || end.within(one.head));
      }
      if (!holds && has_agreed) {
        for (Watch& one : loop.watches) one.head = one.agreed;
        break;
      }
      if (round == kMaxRounds) {
        loop.watches.clear();
        break;
      }
      if (holds) {
        for (Watch& one : loop.watches) one.agreed = one.head;
        has_agreed = true;
      }
      for (Watch& one : loop.watches) changed = guess(one) || changed;
      if (!changed) break;
    }
    --trials_;
    asking_ = outer;
    iterateOnce(loop, before);
  }

  bool switchStmt(const SwitchStmt& s) {
    value(s.selector);
    const bool is_signed = types_.isSigned(types_.plainKind(body_.expr(s.selector).type));
    const auto bound = [&](int64_t bits) { return is_signed ? Int128{bits} : Int128{static_cast<uint64_t>(bits)}; };
    const uint32_t v = variables().after(s.selector);
    RangeFacts::Junction branches = facts_.junction();
    for (const Case& one : body_.list(s.cases)) {
      facts_.branch(branches, [&] {
        const std::span<const CaseRange> ranges = body_.list(one.ranges);
        Interval hull{bound(ranges[0].low), bound(ranges[0].high)};
        for (const CaseRange& range : ranges) hull = join(hull, {bound(range.low), bound(range.high)});
        if (v != kNone) facts_.narrow(v, hull);
        return block(one.block);
      });
    }
    facts_.branch(branches, [&] { return block(s.else_block); });
    facts_.join(branches);
    return branches.falling > 0;
  }

  bool forLoop(const ForStmt& s) {
    value(s.control);
    const Interval from = value(s.from);
    const Interval to = value(s.to);
    const uint32_t control = variable(s.control);
    // Tells whether the body itself writes the control variable: its fact is set before the scan.
    if (control != kNone) facts_.set(control, from);
    const size_t mark = facts_.mark();
    facts_.effectsIn(s.body_block);
    const bool is_kept = control != kNone && facts_.isKnown(control);
    LoopState loop{s.body_block, {}, {}};
    watch(loop, mark, control);
    boundCounters(loop, s, from, to);
    facts_.written(s.control);
    const Expr& step = body_.expr(s.step);
    const bool up = static_cast<int64_t>(bitsOf(step)) > 0 || !types_.isSigned(types_.plainKind(step.type));
    const Interval bounds = up ? Interval{from.low, to.high} : Interval{to.low, from.high};
    iterate(loop, [&] {
      if (is_kept && !bounds.isEmpty()) facts_.narrow(control, bounds);
    });
    for (const Watch& one : loop.watches) {
      Interval after = one.head;
      const Interval end = one.at_end ? meet(*one.at_end, one.most_after) : after;
      if (!end.isEmpty()) after = join(after, end);
      facts_.set(one.variable, one.at_exit ? join(after, *one.at_exit) : after);
    }
    return true;
  }

  // How far the loop can move what its body only counts: `most` of the watches.
  void boundCounters(LoopState& loop, const ForStmt& s, const Interval& from, const Interval& to) {
    if (loop.watches.empty()) return;
    const Counters counters(module_, exposure_, body_, variables());
    std::optional<Int128> times = counters.mostIterations(s);
    if (!times) {
      const std::optional<Int128> step = constant(s.step);
      if (!step || *step == 0 || from.isEmpty() || to.isEmpty()) return;
      const Int128 distance = *step > 0 ? to.high - from.low : from.high - to.low;
      times = distance < 0 ? 0 : distance / (*step > 0 ? *step : -*step) + 1;
    }
    if (*times <= 0 || *times >= kWide >> 70) return;
    std::vector<uint32_t> variables;
    for (const Watch& one : loop.watches) variables.push_back(one.variable);
    const std::vector<Growth> growths = counters.growthIn(loop.body, variables);
    for (size_t i = 0; i < growths.size(); ++i) {
      Watch& one = loop.watches[i];
      const auto after = [&](Int128 n) {
        return Interval{one.before.low - growths[i].down * n, one.before.high + growths[i].up * n};
      };
      if (!growths[i].is_counted || !after(*times).within(meet(growths[i].limit, facts_.all(one.variable)))) continue;
      one.most = after(*times - 1);
      one.most_after = after(*times);
    }
  }
  std::optional<Int128> constant(ExprId id) {
    const Expr& e = body_.expr(id);
    return isConst(e) ? std::optional<Int128>(value(id).low) : std::nullopt;
  }

  // ---- comparisons

  // An expression lies in these bounds from here on: narrows the variable in `i`, `i + 1` or `i - 1`.
  void holdsFrom(ExprId id, Interval bounds) {
    while (const auto* sum = body_.expr(id).tryAs<BinaryExpr>()) {
      if ((sum->op != Op::Add && sum->op != Op::Sub) || !isConst(body_.expr(sum->right))) return;
      const bool outer = asking_;
      asking_ = true;
      const Interval left = value(sum->left), right = value(sum->right);
      asking_ = outer;
      if (!apply(sum->op, left, right, allOf(body_.expr(id).type, false)).fits) return;
      const Int128 addend = sum->op == Op::Add ? right.low : -right.low;
      bounds = {bounds.low - addend, bounds.high - addend};
      id = sum->left;
    }
    const uint32_t v = variables().after(id);
    if (v != kNone) facts_.narrow(v, bounds);
  }

  // Narrows variables by the outcome of a condition.
  void refine(ExprId condition, bool outcome) {
    const Expr& e = body_.expr(condition);
    if (isNot(e)) return refine(e.as<UnaryExpr>().operand, !outcome);
    if (e.kind != ExprKind::Binary) return;
    const auto [left, right, op] = e.as<BinaryExpr>();
    if ((op == Op::And && outcome) || (op == Op::Or && !outcome)) {
      if (types_.kind(e.type) != TypeKind::Bool) return;
      refine(left, outcome);
      refine(right, outcome);
      return;
    }
    if (!types::isComparison(op) || !isTracked(body_.expr(left).type)) return;
    compare(op, outcome, left, right, false);
    compare(op, outcome, right, left, true);
  }

  // `one op other` (or `other op one` when swapped) gave `outcome`: narrows `one`.
  void compare(Op op, bool outcome, ExprId one, ExprId other, bool swapped) {
    const uint32_t v = variables().after(one);
    if (v == kNone) return;
    // Evaluated without clearing checks: they ran before the condition had an outcome.
    const bool outer = asking_;
    asking_ = true;
    const Interval o = value(other);
    asking_ = outer;
    if (!outcome) {
      op = op == Op::Eq   ? Op::Ne
           : op == Op::Ne ? Op::Eq
           : op == Op::Lt ? Op::Ge
           : op == Op::Ge ? Op::Lt
           : op == Op::Gt ? Op::Le
                          : Op::Gt;
    }
    if (swapped) {
      op = op == Op::Lt ? Op::Gt : op == Op::Gt ? Op::Lt : op == Op::Le ? Op::Ge : op == Op::Ge ? Op::Le : op;
    }
    const Interval now = facts_.current(v);
    if (op == Op::Lt) facts_.narrow(v, {now.low, o.high - 1});
    if (op == Op::Le) facts_.narrow(v, {now.low, o.high});
    if (op == Op::Gt) facts_.narrow(v, {o.low + 1, now.high});
    if (op == Op::Ge) facts_.narrow(v, {o.low, now.high});
    if (op == Op::Eq) facts_.narrow(v, o);
    if (op == Op::Ne && o.low == o.high) {
      if (o.low == now.low) facts_.narrow(v, {now.low + 1, now.high});
      if (o.low == now.high) facts_.narrow(v, {now.low, now.high - 1});
    }
  }

  // ---- expressions

  void clear(Expr& e, unsigned check) {
    if (asking_ || (e.checks & check) == 0) return;
    e.checks = static_cast<uint8_t>(e.checks & ~check);
    changed_ = true;
  }

  // Nothing of this value is cut. Only where it would cost: the C++ compiler computes in 32 bits.
  void fits(Expr& e) const {
    if (!asking_ && TypeTable::bitWidth(types_.plainKind(e.type)) < 32) e.proven = 1;
  }

  // Memory that only ST writes holds a subrange's bounds; an image, a union or a pointer's target may not.
  bool keepsBounds(ExprId id) const {
    const Expr* e = &body_.expr(id);
    while (e->kind == ExprKind::Field || e->kind == ExprKind::Index) {
      const Expr& base = body_.expr(baseOf(*e));
      if (e->kind == ExprKind::Field && types_.info(types_.resolve(base.type)).record_kind == RecordKind::Union)
        return false;
      e = &base;
    }
    return e->kind == ExprKind::Local || e->kind == ExprKind::Self || e->kind == ExprKind::Global ||
           e->kind == ExprKind::Program;
  }

  void valueForChecks(ExprId id) {
    if (has_checks_[id.index] != 0) value(id);
  }

  Interval constant(const Expr& e) {
    if (isPointer(e.type)) return bitsOf(e) == 0 ? Interval{0, 0} : kNotNull;
    if (!isIntegral(e.type)) return allOf(e.type, false);
    const uint64_t value = bitsOf(e);
    const Int128 bits = types_.isSigned(types_.plainKind(e.type)) ? Int128{static_cast<int64_t>(value)} : Int128{value};
    return {bits, bits};
  }

  Interval variableOf(ExprId id) {
    const uint32_t v = variable(id);
    return v != kNone ? facts_.current(v) : allOf(body_.expr(id).type, keepsBounds(id));
  }

  Interval unary(Expr& e) {
    const auto [operand, op] = e.as<UnaryExpr>();
    const Interval a = value(operand);
    if (!isIntegral(e.type)) return allOf(e.type, false);
    const IntervalResult result = apply(op, a, {0, 0}, allOf(e.type, false));
    if (result.fits) clear(e, kCheckOverflow);
    if (result.fits && op == Op::Neg) fits(e);
    return result.interval;
  }

  Interval conversion(Expr& e) {
    const ExprId operand = e.as<ConvertExpr>().operand;
    const TypeId from = body_.expr(operand).type;
    const Interval a = value(operand);
    if (isPointer(e.type) && isPointer(from)) return a;
    if (!isIntegral(e.type)) return allOf(e.type, false);
    const Interval target = allOf(e.type, true);
    if (!isIntegral(from)) return target;
    if (types_.plainKind(e.type) == TypeKind::Bool) return allOf(e.type, false);  // <> 0
    if (!a.within(target)) return target;
    clear(e, kCheckSubrange | kCheckConvert | kCheckOverflow);
    if (types_.plainKind(from) != TypeKind::Bool && !types::isLossless(types_, from, e.type)) fits(e);
    return a;
  }

  // The values that an expression can have; clears the checks below that it proves.
  Interval value(ExprId id) {
    Expr& e = body_.expr(id);
    if (has_checks_[id.index] == 0 && !isTracked(e.type)) return {-kWide, kWide};
    switch (e.kind) {
      case ExprKind::Const: return constant(e);
      case ExprKind::Local: return variableOf(id);
      case ExprKind::Field:
        value(e.as<FieldExpr>().base);
        nullCheck(e, variables().referenceAt(e));
        return variableOf(id);
      case ExprKind::Index: return indexed(id);
      case ExprKind::Unary: return unary(e);
      case ExprKind::Binary: return binary(id);
      case ExprKind::Convert: return conversion(e);
      case ExprKind::Select: {
        const SelectExpr node = e.as<SelectExpr>();
        value(node.condition);
        const Interval yes = value(node.when_true);
        const Interval no = value(node.when_false);
        return join(yes, no);
      }
      case ExprKind::None:
      case ExprKind::String:
      case ExprKind::Data:
      case ExprKind::Zero:
      case ExprKind::Self:
      case ExprKind::Global:
      case ExprKind::Program:
      case ExprKind::Image:
      case ExprKind::Bits:
      case ExprKind::Call: forEachOperand(body_, e, [&](ExprId operand) { value(operand); }); break;
      case ExprKind::Deref:
        value(e.as<DerefExpr>().pointer);
        nullCheck(e, variables().after(e.as<DerefExpr>().pointer));
        break;
      case ExprKind::Address:
        value(e.as<AddressExpr>().place);
        if (isOwnMemory(e.as<AddressExpr>().place)) return kNotNull;
        break;
    }
    return allOf(e.type, false);
  }
  // A place through a pointer: it is not null from here on, which `v` keeps.
  void nullCheck(Expr& e, uint32_t v) {
    if ((e.checks & kCheckNull) == 0 || v == kNone) return;
    if (facts_.current(v).low > 0) return clear(e, kCheckNull);
    facts_.narrow(v, kNotNull);
  }
  // Without a pointer on the way.
  bool isOwnMemory(ExprId place) const {
    const Expr* e = &body_.expr(place);
    for (; baseOf(*e); e = &body_.expr(baseOf(*e)))
      if (isReference(module_, body_, *e)) return false;
    return e->kind != ExprKind::Deref;
  }
  Interval indexed(ExprId id) {
    Expr& e = body_.expr(id);
    const IndexExpr& node = e.as<IndexExpr>();
    value(node.base);
    const TypeInfo& array = types_.info(types_.resolve(body_.expr(node.base).type));
    bool inside = array.dimensions.size() == node.indices.count;
    uint16_t proven = 0;
    for (uint32_t i = 0; i < node.indices.count; ++i) {
      const Interval one = value(body_.list(node.indices)[i]);
      const bool is_proven = i < array.dimensions.size() && one.within(boundsOf(array, i));
      if (is_proven && i < kMostProven) proven = static_cast<uint16_t>(proven | 1u << i);
      inside = inside && is_proven;
    }
    if ((e.checks & kCheckIndex) == 0) return allOf(e.type, keepsBounds(id));
    if (!asking_ && proven != e.proven) {
      e.proven = inside ? uint16_t{0} : proven;
      changed_ = true;
    }
    if (inside) clear(e, kCheckIndex);
    for (uint32_t i = 0; i < node.indices.count && i < array.dimensions.size(); ++i)
      holdsFrom(body_.list(node.indices)[i], boundsOf(array, i));
    return allOf(e.type, keepsBounds(id));
  }
  static Interval boundsOf(const TypeInfo& array, uint32_t dimension) {
    return {array.dimensions[dimension].low, array.dimensions[dimension].high};
  }
  Interval binary(ExprId id) {
    Expr& e = body_.expr(id);
    const auto [left, right, op] = e.as<BinaryExpr>();
    const Interval a = value(left);
    const Interval b = value(right);
    const bool integers = isIntegral(body_.expr(left).type) && isIntegral(body_.expr(right).type);
    if (types::isComparison(op)) return {0, 1};
    if (!integers || !isIntegral(e.type)) return allOf(e.type, false);
    if ((op == Op::Div || op == Op::Mod) && !b.contains(0)) clear(e, kCheckDiv);
    const IntervalResult result = apply(op, a, b, allOf(e.type, false));
    if (result.fits) clear(e, kCheckOverflow);
    if (result.fits && (op == Op::Add || op == Op::Sub || op == Op::Mul)) fits(e);
    if (!asking_ && a.low >= 0 && e.checks == 0 && isSignedDivision(body_, e)) dropSign(id);
    return result.interval;
  }

  Module& module_;
  const TypeTable& types_;
  const Exposure& exposure_;
  Body& body_;
  std::vector<uint8_t> has_checks_;  // by expression
  RangeFacts facts_;
  std::vector<LoopState*> loops_;  // the loops around the current statement
  int trials_ = 0;
  bool asking_ = false;
  bool changed_ = false;
};

}  // namespace

bool removeChecks(Module& module, const Exposure& exposure, Body& body) {
  if (body.has_labels || !body.first || !isWorthIt(body)) return false;
  return Analysis(module, exposure, body).run();
}

}  // namespace rung::ir

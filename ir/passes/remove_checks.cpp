// Range analysis: see remove_checks.h. A fact is the interval of one variable. Changes of facts go to a trail, so that
// the end of a branch takes them back; where branches meet, the facts that they left are joined.
#include "ir/passes/remove_checks.h"

#include <algorithm>
#include <optional>

#include "ir/passes/counters.h"
#include "ir/passes/effects.h"
#include "ir/passes/interval.h"
#include "ir/passes/support.h"

namespace rung::ir {

using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

constexpr uint32_t kNone = ~0u;
constexpr Int128 kWide = Int128{1} << 100;  // beyond every integer: proves nothing

constexpr Interval kPointers{0, kWide}, kNotNull{1, kWide};

struct Fact {
  bool known = false;
  uint32_t epoch = 0;  // of a field of self: valid until something unknown may write it
  Interval interval;
};

class Analysis {
 public:
  Analysis(Module& module, const Exposure& exposure, Body& body)
      : module_(module), types_(module.types), exposure_(exposure), body_(body) {}

  bool run() {
    if (body_.has_labels || !body_.first || !isWorthIt()) return false;
    private_ = privateLocals(module_, body_);
    self_first_ = static_cast<uint32_t>(body_.locals.size());
    findFields();
    facts_.assign(references_first_ + (references_first_ - self_first_), {});
    stamp_.assign(facts_.size(), 0);
    stamp_entry_.assign(facts_.size(), 0);
    findChecks();
    block(body_.first);
    return changed_;
  }

 private:
  bool isWorthIt() const {
    for (const Expr& e : body_.exprs)
      if ((e.checks & ~kCheckCast) != 0 || isSignedDivision(e)) return true;
    return false;
  }

  void findFields() {
    const TypeId self = body_.self ? types_.resolve(body_.self) : TypeId{};
    const size_t count = self ? types_.info(self).fields.size() : 0;
    references_first_ = self_first_ + static_cast<uint32_t>(count);
    is_exposed_.resize(count);
    for (uint32_t i = 0; i < count; ++i) is_exposed_[i] = exposure_.isExposed(self, i);
  }

  // By a positive constant: cheaper without sign.
  bool isSignedDivision(const Expr& e) const {
    const auto* division = e.tryAs<BinaryExpr>();
    if (division == nullptr || (division->op != Op::Div && division->op != Op::Mod) || !unsignedOf(e.type))
      return false;
    const Expr& divisor = body_.expr(division->right);
    return isConst(divisor) && static_cast<int64_t>(bitsOf(divisor)) > 0;
  }
  static TypeId unsignedOf(TypeId type) {
    return type == types::kSInt   ? types::kUSInt
           : type == types::kInt  ? types::kUInt
           : type == types::kDInt ? types::kUDInt
           : type == types::kLInt ? types::kULInt
                                  : TypeId{};
  }
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
      divisions += isSignedDivision(e);
      uint8_t found = e.checks != 0 || isSignedDivision(e);
      forEachOperand(body_, e, [&](ExprId operand) {
        found |= has_checks_[operand.index];
        all_known = all_known && operand.index < i;
      });
      has_checks_[i] = found;
    }
    if (divisions != 0) body_.exprs.reserve(body_.exprs.size() + 3 * divisions);  // nodes stay where they are
    if (!all_known) has_checks_.assign(body_.exprs.size(), true);  // a pass left users before their operands
  }

  Interval allOf(TypeId type, bool with_bounds) {
    if (isPointer(type)) return kPointers;
    if (type.index >= kKinds) return intervalOf(types_, type, with_bounds);
    if (!kind_known_[type.index]) {
      kind_known_[type.index] = true;
      kind_interval_[type.index] = intervalOf(types_, type, false);
    }
    return kind_interval_[type.index];
  }
  bool isIntegral(TypeId type) const {
    if (type.index >= kKinds) return hasInterval(types_, type);
    const auto kind = static_cast<TypeKind>(type.index);
    return kind == TypeKind::Bool || TypeTable::isInteger(kind) || TypeTable::isBits(kind);
  }

  bool isPointer(TypeId type) const {
    const TypeKind kind = types_.kind(type);
    return kind == TypeKind::Pointer || kind == TypeKind::Reference;
  }
  bool isTracked(TypeId type) const { return isIntegral(type) || isPointer(type); }

  // ---- facts. The variables are the locals, the fields of self and, again by field, the pointers in fields that are
  // references. Of a pointer a fact says whether it may be null.

  // The number of a variable whose interval is tracked, or kNone.
  uint32_t variable(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (!isTracked(e.type)) return kNone;
    if (const uint32_t* local = localOf(e)) return private_[*local] ? *local : kNone;
    const auto* field = e.tryAs<FieldExpr>();
    if (field == nullptr || body_.expr(field->base).kind != ExprKind::Self) return kNone;
    const TypeInfo& self = types_.info(types_.resolve(body_.self));
    if (self.record_kind == RecordKind::Union || self.fields[field->field].by_reference) return kNone;
    return self_first_ + field->field;
  }
  // The number of the pointer in a field of self that is a reference, or kNone.
  uint32_t referenceOf(const Expr& e) const {
    const auto* field = e.tryAs<FieldExpr>();
    if (field == nullptr || body_.expr(field->base).kind != ExprKind::Self || !isReference(module_, body_, e))
      return kNone;
    return references_first_ + field->field;
  }
  // Epochs of fields of self: one counts the statements that may write any of them, the other also those that reach a
  // field only by its address.
  uint32_t epochOf(uint32_t variable) const {
    const bool by_address =
        variable >= self_first_ && variable < references_first_ && is_exposed_[variable - self_first_];
    return by_address ? exposed_epoch_ : epoch_;
  }
  bool holds(uint32_t variable, const Fact& fact) const {
    return fact.known && (variable < self_first_ || fact.epoch == epochOf(variable));
  }
  void set(uint32_t variable, const Fact& fact) {
    trail_.push_back({variable, facts_[variable]});
    facts_[variable] = fact;
    facts_[variable].epoch = epochOf(variable);
  }
  void forgetFields() {
    ++epoch_;
    ++exposed_epoch_;
  }
  void setInterval(uint32_t variable, const Interval& interval) {
    Fact fact;
    fact.known = true;
    fact.interval = interval;
    set(variable, fact);
  }

  // A place was written, or may have been.
  void written(ExprId place) {
    const Effect effect = effectOfWrite(module_, body_, private_, place);
    switch (effect.kind) {
      case Effect::None: return;
      case Effect::Local: return set(effect.index, {});
      case Effect::Field: return set(self_first_ + effect.index, {});
      case Effect::Exposed: ++exposed_epoch_; return;
      case Effect::Fields: return forgetFields();
    }
  }
  void effectsOf(const Stmt& s) {
    forEachWritten(module_, body_, s, [&](ExprId place) { written(place); });
    if (bindsOwn(body_, s)) forgetFields();
    const auto* call = s.tryAs<CallStmt>();
    if (call == nullptr || module_.body(call->callee).pure) return;
    ++exposed_epoch_;
    if (callReachesSelf(module_, exposure_, body_, *call)) ++epoch_;
  }
  void effectsIn(StmtId first) {
    forEachStmt(body_, first, [&](StmtId id) { effectsOf(body_.stmt(id)); });
  }

  // ---- branches

  struct Change {
    uint32_t variable;
    Fact before;
  };
  struct Touched {  // the fact that a branch left for a variable that it touched
    uint32_t variable;
    uint32_t branches;
    Fact fact;
  };

  // Walks a block, takes its changes back and appends what it left to touched_. Whether control leaves its end.
  template <class Before>
  bool branch(StmtId first, Before&& before) {
    const size_t mark = trail_.size();
    before();
    const bool falls = block(first);
    const uint32_t now = ++stamps_;
    for (size_t i = trail_.size(); i-- > mark;) {
      const uint32_t v = trail_[i].variable;
      if (stamp_[v] != now) {
        stamp_[v] = now;
        Fact left = facts_[v];
        left.known = holds(v, left);
        if (falls) touched_.push_back({v, 1, left});
      }
    }
    undo(mark);
    return falls;
  }
  void undo(size_t mark) {
    while (trail_.size() > mark) {
      facts_[trail_.back().variable] = trail_.back().before;
      trail_.pop_back();
    }
  }
  bool branch(StmtId first) {
    return branch(first, [] {});
  }

  // Joins what `falling` branches left in touched_[mark..]; a branch that did not touch a variable keeps the old fact.
  void joinBranches(size_t mark, uint32_t falling) {
    const uint32_t now = ++stamps_;
    size_t count = mark;
    for (size_t i = mark; i < touched_.size(); ++i) {
      const Touched one = touched_[i];
      if (stamp_[one.variable] != now) {
        stamp_[one.variable] = now;
        stamp_entry_[one.variable] = static_cast<uint32_t>(count);
        touched_[count++] = one;
        continue;
      }
      Touched& entry = touched_[stamp_entry_[one.variable]];
      ++entry.branches;
      entry.fact.known = entry.fact.known && one.fact.known;
      entry.fact.interval = join(entry.fact.interval, one.fact.interval);
    }
    for (size_t i = mark; i < count; ++i) {
      Touched entry = touched_[i];
      if (entry.branches < falling) {
        const Fact& before = facts_[entry.variable];
        entry.fact.known = entry.fact.known && holds(entry.variable, before);
        entry.fact.interval = join(entry.fact.interval, before.interval);
      }
      set(entry.variable, entry.fact);
    }
    touched_.resize(mark);
  }

  // ---- statements

  // Whether control leaves the end of the list. Statements after one that control does not leave are dead.
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
        effectsOf(s);
        return true;
      case StmtKind::If: {
        const IfStmt node = s.as<IfStmt>();
        valueForChecks(node.condition);
        const size_t mark = touched_.size();
        const bool yes = branch(node.then_block, [&] { refine(node.condition, true); });
        const bool no = branch(node.else_block, [&] { refine(node.condition, false); });
        joinBranches(mark, static_cast<uint32_t>(yes) + static_cast<uint32_t>(no));
        return yes || no;
      }
      case StmtKind::Switch: return switchStmt(s.as<SwitchStmt>());
      case StmtKind::Loop: {
        LoopState loop{s.as<LoopStmt>().body_block, s.as<LoopStmt>().next_block, {}};
        const size_t mark = trail_.size();
        effectsIn(loop.body);
        effectsIn(loop.next);
        watch(loop, mark, kNone);
        iterate(loop, [] {});
        for (const Watch& one : loop.watches)
          if (one.at_exit.known) setInterval(one.variable, one.at_exit.interval);
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
      written(s.place);
    } else {
      const Interval given = value(s.value);
      const Interval both = meet(given, allOf(body_.expr(s.place).type, true));
      setInterval(v, both.isEmpty() ? given : both);
    }
  }
  void tryStmt(const TryStmt& s) {
    for (const StmtId part : {s.body_block, s.catch_block, s.finally_block}) {  // begins anywhere in the one before
      const size_t mark = touched_.size();
      branch(part);
      touched_.resize(mark);
      effectsIn(part);
      if (part == s.body_block && s.number) {
        value(s.number);
        written(s.number);
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
    Fact at_end = {}, at_exit = {};  // joined over all ends of an iteration, over all breaks
    bool is_narrowed = false;
  };
  struct LoopState {
    StmtId body, next;
    std::vector<Watch> watches;
  };
  static constexpr int kMaxRounds = 6, kMaxTrials = 2;  // walks of a loop; nested loops that are tried

  void note(Fact Watch::*where) {
    if (loops_.empty()) return;
    for (Watch& one : loops_.back()->watches) {
      Fact& fact = one.*where;
      const Interval now = current(one.variable);
      fact.interval = fact.known ? join(fact.interval, now) : now;
      fact.known = true;
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
    if (trials_ == kMaxTrials || mark == trail_.size()) return;
    if (!isWorthWatching(loop.body) && !isWorthWatching(loop.next)) return;
    const uint32_t now = ++stamps_;
    for (size_t i = mark; i < trail_.size(); ++i) {
      const uint32_t v = trail_[i].variable;
      if (v == control || stamp_[v] == now) continue;
      stamp_[v] = now;
      if (holds(v, trail_[i].before)) {
        const Interval before = trail_[i].before.interval;
        loop.watches.push_back({v, before, before});
      }
    }
  }

  template <class Before>
  void iterateOnce(LoopState& loop, Before&& before) {
    for (Watch& one : loop.watches) one.at_end.known = one.at_exit.known = false;
    const size_t mark = trail_.size(), touched = touched_.size();
    loops_.push_back(&loop);
    for (const Watch& one : loop.watches) setInterval(one.variable, one.head);
    before();
    if (block(loop.body)) note(&Watch::at_end);
    undo(mark);
    if (loop.next) {
      for (Watch& one : loop.watches) {
        if (one.at_end.known) setInterval(one.variable, one.at_end.interval);
        one.at_end.known = false;
      }
      if (block(loop.next)) note(&Watch::at_end);
      undo(mark);
    }
    loops_.pop_back();
    touched_.resize(touched);
  }
  // The next guess for a variable whose iterations leave `left`; false: this one stays. The first guess for a counter
  // that a test stops at 7 fails, since the largest value plus one wraps; then the test's bound is tried.
  bool guess(Watch& one) {
    if (!one.at_end.known) return false;
    const Interval end = meet(one.at_end.interval, one.most);
    if (end.isEmpty()) return false;  // there is no next iteration
    const Interval left = join(one.before, end), last = one.head;
    if (left == last || (one.is_narrowed && left.within(last))) return false;
    const bool below = left.low<last.low, above = left.high> last.high;
    if (!one.is_narrowed && !(below && above) && (left.low > last.low || left.high < last.high)) {
      one.head = meet(left, last);
      one.is_narrowed = true;
      return true;
    }
    const Interval any = all(one.variable);
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
        const Interval end = meet(one.at_end.interval, one.most);
        holds = holds && (!one.at_end.known || end.isEmpty() || end.within(one.head));
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
    const size_t mark = touched_.size();
    uint32_t falling = 0;
    for (const Case& one : body_.list(s.cases)) {
      falling += branch(one.block, [&] {
        const uint32_t v = variableAfter(s.selector);
        if (v == kNone) return;
        const std::span<const CaseRange> ranges = body_.list(one.ranges);
        Interval hull{bound(ranges[0].low), bound(ranges[0].high)};
        for (const CaseRange& range : ranges) hull = join(hull, {bound(range.low), bound(range.high)});
        narrow(v, hull);
      });
    }
    falling += branch(s.else_block);
    joinBranches(mark, falling);
    return falling > 0;
  }

  bool forLoop(const ForStmt& s) {
    value(s.control);
    const Interval from = value(s.from);
    const Interval to = value(s.to);
    const uint32_t control = variable(s.control);
    // Whether the body itself writes the control variable: its fact is set before the scan.
    if (control != kNone) setInterval(control, from);
    const size_t mark = trail_.size();
    effectsIn(s.body_block);
    const bool is_kept = control != kNone && holds(control, facts_[control]);
    LoopState loop{s.body_block, {}, {}};
    watch(loop, mark, control);
    boundCounters(loop, s, from, to);
    written(s.control);
    const Expr& step = body_.expr(s.step);
    const bool up = static_cast<int64_t>(bitsOf(step)) > 0 || !types_.isSigned(types_.plainKind(step.type));
    const Interval bounds = up ? Interval{from.low, to.high} : Interval{to.low, from.high};
    iterate(loop, [&] {
      if (is_kept && !bounds.isEmpty()) narrow(control, bounds);
    });
    for (const Watch& one : loop.watches) {
      Interval after = one.head;
      const Interval end = meet(one.at_end.interval, one.most_after);
      if (one.at_end.known && !end.isEmpty()) after = join(after, end);
      setInterval(one.variable, one.at_exit.known ? join(after, one.at_exit.interval) : after);
    }
    return true;
  }

  // How far the loop can move what its body only counts: `most` of the watches.
  void boundCounters(LoopState& loop, const ForStmt& s, const Interval& from, const Interval& to) {
    if (loop.watches.empty()) return;
    const Counters counters(module_, exposure_, body_, private_);
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
      if (!growths[i].is_counted || !after(*times).within(meet(growths[i].limit, all(one.variable)))) continue;
      one.most = after(*times - 1);
      one.most_after = after(*times);
    }
  }
  std::optional<Int128> constant(ExprId id) {
    const Expr& e = body_.expr(id);
    return isConst(e) ? std::optional<Int128>(value(id).low) : std::nullopt;
  }

  // ---- comparisons

  // The variable whose value an expression is, also through conversions that keep every value.
  uint32_t variableAfter(ExprId id) const {
    while (const auto* convert = body_.expr(id).tryAs<ConvertExpr>()) {
      const TypeId from = body_.expr(convert->operand).type, to = body_.expr(id).type;
      if (isPointer(from) && (isPointer(to) || TypeTable::bitWidth(types_.plainKind(to)) == 64)) {
        id = convert->operand;
        continue;
      }
      if (!isIntegral(to) || !isIntegral(from) || !types::isLossless(types_, from, to)) return kNone;
      id = convert->operand;
    }
    return variable(id);
  }

  void narrow(uint32_t v, const Interval& bounds) {
    const Interval now = current(v);
    const Interval both = meet(now, bounds);
    if (both.isEmpty() || both == now) return;  // empty: never reached
    setInterval(v, both);
  }
  Interval current(uint32_t v) { return holds(v, facts_[v]) ? facts_[v].interval : all(v); }
  Interval all(uint32_t v) {
    if (v >= references_first_) return kPointers;
    const TypeId type =
        v < self_first_ ? body_.locals[v].type : types_.info(types_.resolve(body_.self)).fields[v - self_first_].type;
    return allOf(type, true);
  }

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
    const uint32_t v = variableAfter(id);
    if (v != kNone) narrow(v, bounds);
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
    const uint32_t v = variableAfter(one);
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
    const Interval now = current(v);
    if (op == Op::Lt) narrow(v, {now.low, o.high - 1});
    if (op == Op::Le) narrow(v, {now.low, o.high});
    if (op == Op::Gt) narrow(v, {o.low + 1, now.high});
    if (op == Op::Ge) narrow(v, {o.low, now.high});
    if (op == Op::Eq) narrow(v, o);
    if (op == Op::Ne && o.low == o.high) {
      if (o.low == now.low) narrow(v, {now.low + 1, now.high});
      if (o.low == now.high) narrow(v, {now.low, now.high - 1});
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

  // The values that an expression can have; clears the checks below that it proves.
  Interval value(ExprId id) {
    Expr& e = body_.expr(id);
    if (has_checks_[id.index] == 0 && !isTracked(e.type)) return {-kWide, kWide};
    switch (e.kind) {
      case ExprKind::Const: {
        if (isPointer(e.type)) return bitsOf(e) == 0 ? Interval{0, 0} : kNotNull;
        if (!isIntegral(e.type)) break;
        const uint64_t value = bitsOf(e);
        const Int128 bits =
            types_.isSigned(types_.plainKind(e.type)) ? Int128{static_cast<int64_t>(value)} : Int128{value};
        return {bits, bits};
      }
      case ExprKind::Local:
      case ExprKind::Field: {
        if (e.kind == ExprKind::Field) {
          value(e.as<FieldExpr>().base);
          nullCheck(e, referenceOf(e));
        }
        const uint32_t v = variable(id);
        if (v != kNone) return current(v);
        return allOf(e.type, keepsBounds(id));
      }
      case ExprKind::Index: return indexed(id);
      case ExprKind::Unary: {
        const auto [operand, op] = e.as<UnaryExpr>();
        const Interval a = value(operand);
        if (!isIntegral(e.type)) break;
        const IntervalResult result = apply(op, a, {0, 0}, allOf(e.type, false));
        if (result.fits) clear(e, kCheckOverflow);
        if (result.fits && op == Op::Neg) fits(e);
        return result.interval;
      }
      case ExprKind::Binary: return binary(id);
      case ExprKind::Convert: {
        const ExprId operand = e.as<ConvertExpr>().operand;
        const Interval a = value(operand);
        if (isPointer(e.type) && isPointer(body_.expr(operand).type)) return a;
        if (!isIntegral(e.type)) break;
        const Interval target = allOf(e.type, true);
        if (!isIntegral(body_.expr(operand).type)) return target;
        if (types_.plainKind(e.type) == TypeKind::Bool) break;  // <> 0
        if (a.within(target)) {
          clear(e, kCheckSubrange | kCheckConvert | kCheckOverflow);
          const TypeId from = body_.expr(operand).type;
          if (types_.plainKind(from) != TypeKind::Bool && !types::isLossless(types_, from, e.type)) fits(e);
          return a;
        }
        return target;
      }
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
        nullCheck(e, variableAfter(e.as<DerefExpr>().pointer));
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
    if (current(v).low > 0) return clear(e, kCheckNull);
    narrow(v, kNotNull);
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
    if (!asking_ && a.low >= 0 && e.checks == 0 && isSignedDivision(e)) dropSign(id);
    return result.interval;
  }

  Module& module_;
  const TypeTable& types_;
  const Exposure& exposure_;
  Body& body_;
  static constexpr size_t kKinds = static_cast<size_t>(TypeKind::Count_);
  Interval kind_interval_[kKinds];
  bool kind_known_[kKinds] = {};
  std::vector<uint8_t> has_checks_;  // by expression
  std::vector<bool> private_;
  std::vector<Fact> facts_;  // by variable: the locals, then the fields of self
  std::vector<uint32_t> stamp_, stamp_entry_;
  std::vector<Change> trail_;
  std::vector<Touched> touched_;
  std::vector<LoopState*> loops_;    // the loops around the current statement
  std::vector<uint8_t> is_exposed_;  // by field of self
  uint32_t self_first_ = 0, references_first_ = 0;
  uint32_t epoch_ = 0, exposed_epoch_ = 0, stamps_ = 0;
  int trials_ = 0;
  bool asking_ = false;
  bool changed_ = false;
};

}  // namespace

bool removeChecks(Module& module, const Exposure& exposure, Body& body) {
  return Analysis(module, exposure, body).run();
}

}  // namespace rung::ir

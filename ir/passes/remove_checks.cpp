// Range analysis: see remove_checks.h. A fact is the interval of one variable. Changes of facts go to a trail, so that
// the end of a branch takes them back; where branches meet, the facts that they left are joined.
#include "ir/passes/remove_checks.h"

#include <algorithm>

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

struct Fact {
  bool known = false;
  uint32_t epoch = 0;  // of a field of self: valid until something unknown writes self
  Interval interval;
};

class Analysis {
 public:
  Analysis(Module& module, Body& body) : module_(module), types_(module.types), body_(body) {}

  bool run() {
    if (body_.has_labels || !body_.first || !isWorthIt()) return false;
    private_ = privateLocals(module_, body_);
    self_first_ = static_cast<uint32_t>(body_.locals.size());
    const size_t fields = body_.self ? types_.info(types_.resolve(body_.self)).fields.size() : 0;
    facts_.assign(self_first_ + fields, {});
    stamp_.assign(facts_.size(), 0);
    stamp_entry_.assign(facts_.size(), 0);
    findChecks();
    block(body_.first);
    return changed_;
  }

 private:
  bool isWorthIt() const {
    for (const Expr& e : body_.exprs)
      if ((e.checks & ~(kCheckNull | kCheckCast)) != 0 || isSignedDivision(e)) return true;
    return false;
  }

  // By a positive constant: cheaper without sign.
  bool isSignedDivision(const Expr& e) const {
    if (e.kind != ExprKind::Binary || (e.op != Op::Div && e.op != Op::Mod) || !unsignedOf(e.type)) return false;
    const Expr& divisor = body_.exprs[e.b];
    return isConst(divisor) && static_cast<int64_t>(divisor.bits()) > 0;
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
    const TypeId type = unsignedOf(signed_one.type);
    const auto add = [&](Expr e) {
      e.type = type;
      e.loc = signed_one.loc;
      has_checks_.push_back(has_checks_[id.index]);
      body_.exprs.push_back(e);
      return static_cast<uint32_t>(body_.exprs.size() - 1);
    };
    Expr dividend, division = signed_one;
    dividend.kind = ExprKind::Convert;
    dividend.a = signed_one.a;
    division.a = add(dividend);
    division.b = add(body_.exprs[signed_one.b]);
    const uint32_t created = add(division);
    Expr& e = body_.expr(id);
    e.kind = ExprKind::Convert;
    e.a = created;
    e.b = 0;
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
      forEachSlot(body_, e, [&](const uint32_t& slot) {
        found |= has_checks_[slot];
        all_known = all_known && slot < i;
      });
      has_checks_[i] = found;
    }
    if (divisions != 0) body_.exprs.reserve(body_.exprs.size() + 3 * divisions);  // nodes stay where they are
    if (!all_known) has_checks_.assign(body_.exprs.size(), true);  // a pass left users before their operands
  }

  Interval allOf(TypeId type, bool with_bounds) {
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

  // ---- facts

  // The number of a variable whose interval is tracked, or kNone.
  uint32_t variable(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (!isIntegral(e.type)) return kNone;
    if (e.kind == ExprKind::Local) return private_[e.a] ? e.a : kNone;
    if (e.kind != ExprKind::Field || body_.expr(ExprId{e.a}).kind != ExprKind::Self) return kNone;
    const TypeInfo& self = types_.info(types_.resolve(body_.self));
    if (self.record_kind == RecordKind::Union || self.fields[e.b].by_reference) return kNone;
    return self_first_ + e.b;
  }
  bool holds(uint32_t variable, const Fact& fact) const {
    return fact.known && (variable < self_first_ || fact.epoch == epoch_);
  }
  void set(uint32_t variable, const Fact& fact) {
    trail_.push_back({variable, facts_[variable]});
    facts_[variable] = fact;
    facts_[variable].epoch = epoch_;
  }
  void setInterval(uint32_t variable, const Interval& interval) {
    Fact fact;
    fact.known = true;
    fact.interval = interval;
    set(variable, fact);
  }

  // A place was written, or may have been.
  void written(ExprId place) {
    const Expr* e = &body_.expr(place);
    uint32_t below_self = kNone;  // the field of self that the place lies in
    bool leads_out = false;
    while (e->kind == ExprKind::Field || e->kind == ExprKind::Index || e->kind == ExprKind::Bits) {
      const Expr& base = body_.expr(ExprId{e->a});
      if (e->kind == ExprKind::Field) {
        leads_out = leads_out || types_.info(types_.resolve(base.type)).fields[e->b].by_reference;
        below_self = e->b;
      }
      e = &base;
    }
    if (leads_out) {
      ++epoch_;
    } else if (e->kind == ExprKind::Local) {
      if (private_[e->a])
        set(e->a, {});
      else if (body_.locals[e->a].by_reference)
        ++epoch_;
    } else if (e->kind == ExprKind::Self && below_self != kNone &&
               types_.info(types_.resolve(body_.self)).record_kind != RecordKind::Union) {
      set(self_first_ + below_self, {});
    } else if (e->kind != ExprKind::Image) {
      ++epoch_;
    }
  }
  void effectsOf(const Stmt& s) {
    forEachWritten(module_, body_, s, [&](ExprId place) { written(place); });
    if (s.kind == StmtKind::Call && !module_.body(BodyId{s.a}).pure) ++epoch_;
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
        if (s.a != 0) value(ExprId{s.a});
        return false;
      case StmtKind::Assign: {
        const uint32_t v = variable(ExprId{s.a});
        if (v == kNone) {
          if (has_checks_[s.a] != 0) value(ExprId{s.a});
          if (has_checks_[s.b] != 0) value(ExprId{s.b});
          written(ExprId{s.a});
        } else {
          const Interval given = value(ExprId{s.b});
          const Interval both = meet(given, allOf(body_.exprs[s.a].type, true));
          setInterval(v, both.isEmpty() ? given : both);
        }
        return true;
      }
      case StmtKind::Bind:
      case StmtKind::Call:
      case StmtKind::Assert:
      case StmtKind::Evaluate:
        forEachRoot(module_, body_, s, [&](uint32_t& slot, Use) {
          if (has_checks_[slot] != 0) value(ExprId{slot});
        });
        effectsOf(s);
        return true;
      case StmtKind::If: {
        if (has_checks_[s.a] != 0) value(ExprId{s.a});
        const size_t mark = touched_.size();
        const bool yes = branch(StmtId{s.b}, [&] { refine(ExprId{s.a}, true); });
        const bool no = branch(StmtId{s.c}, [&] { refine(ExprId{s.a}, false); });
        joinBranches(mark, static_cast<uint32_t>(yes) + static_cast<uint32_t>(no));
        return yes || no;
      }
      case StmtKind::Switch: return switchStmt(s);
      case StmtKind::Loop: {
        LoopState loop{StmtId{s.a}, StmtId{s.b}, {}};
        const size_t mark = trail_.size();
        effectsIn(loop.body);
        effectsIn(loop.next);
        watch(loop, mark, kNone);
        iterate(loop, [] {});
        for (const Watch& one : loop.watches)
          if (one.at_exit.known) setInterval(one.variable, one.at_exit.interval);
        return true;
      }
      case StmtKind::For: return forLoop(s);
      case StmtKind::Try: {
        for (uint32_t part : {s.a, s.b, s.c}) {  // each may begin anywhere in the one before
          const size_t mark = touched_.size();
          branch(StmtId{part});
          touched_.resize(mark);
          effectsIn(StmtId{part});
          if (part == s.a && s.d != 0) {
            place(ExprId{s.d});
            written(ExprId{s.d});
          }
        }
        return true;
      }
    }
    return true;
  }

  // ---- loops. At the head of a loop, a variable that it writes may have any value, unless each iteration leaves it
  // within some interval around the values from before the loop. Such an interval is a guess that a walk through the
  // loop confirms or rejects: first the values before the loop, then those without the bounds that the iteration
  // exceeds (except 0), then what that iteration left.

  struct Watch {
    uint32_t variable;
    Interval before, head;
    Interval agreed = {};            // the last guess that held
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
                  [&](const uint32_t& slot, Use) { has_checks = has_checks || has_checks_[slot] != 0; });
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
    const Interval left = join(one.before, one.at_end.interval), last = one.head;
    if (left == last || (one.is_narrowed && left.within(last))) return false;
    const bool below = left.low<last.low, above = left.high> last.high;
    if (!one.is_narrowed && !(below && above) && (left.low > last.low || left.high < last.high)) {
      one.head = meet(left, last);
      one.is_narrowed = true;
      return true;
    }
    const Interval any = all(one.variable);
    const Int128 least = left.low >= 0 ? std::max<Int128>(any.low, 0) : any.low;
    one.head = {below ? least : last.low, above ? any.high : last.high};
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
      for (const Watch& one : loop.watches)
        holds = holds && (!one.at_end.known || one.at_end.interval.within(one.head));
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

  bool switchStmt(Stmt& s) {
    value(ExprId{s.a});
    const bool is_signed = types_.isSigned(types_.plainKind(body_.exprs[s.a].type));
    const auto bound = [&](int64_t bits) { return is_signed ? Int128{bits} : Int128{static_cast<uint64_t>(bits)}; };
    const size_t mark = touched_.size();
    uint32_t falling = 0;
    for (uint32_t i = 0; i < s.c; ++i) {
      const Case& one = body_.cases[s.b + i];
      falling += branch(one.block, [&] {
        const uint32_t v = variableAfter(ExprId{s.a});
        if (v == kNone) return;
        Interval hull{bound(body_.ranges[one.first_range].low), bound(body_.ranges[one.first_range].high)};
        for (uint32_t k = 1; k < one.range_count; ++k) {
          const CaseRange& range = body_.ranges[one.first_range + k];
          hull = join(hull, {bound(range.low), bound(range.high)});
        }
        narrow(v, hull);
      });
    }
    falling += branch(StmtId{s.d});
    joinBranches(mark, falling);
    return falling > 0;
  }

  bool forLoop(Stmt& s) {
    place(ExprId{s.a});
    const Interval from = value(ExprId{s.b});
    const Interval to = value(ExprId{s.c});
    const uint32_t control = variable(ExprId{s.a});
    const uint32_t epoch_before = epoch_;
    // Whether the body itself writes the control variable: its fact is set before the scan.
    if (control != kNone) setInterval(control, from);
    const size_t mark = trail_.size();
    effectsIn(StmtId{s.e});
    const bool is_kept = control != kNone && facts_[control].known && (control < self_first_ || epoch_ == epoch_before);
    LoopState loop{StmtId{s.e}, {}, {}};
    watch(loop, mark, control);
    written(ExprId{s.a});
    const bool up =
        static_cast<int64_t>(body_.exprs[s.d].bits()) > 0 || !types_.isSigned(types_.plainKind(body_.exprs[s.d].type));
    const Interval bounds = up ? Interval{from.low, to.high} : Interval{to.low, from.high};
    iterate(loop, [&] {
      if (is_kept && !bounds.isEmpty()) narrow(control, bounds);
    });
    for (const Watch& one : loop.watches)
      setInterval(one.variable, one.at_exit.known ? join(one.head, one.at_exit.interval) : one.head);
    return true;
  }

  // ---- comparisons

  // The variable whose value an expression is, also through conversions that keep every value.
  uint32_t variableAfter(ExprId id) const {
    while (body_.expr(id).kind == ExprKind::Convert) {
      const Expr& e = body_.expr(id);
      const ExprId inner{e.a};
      if (!isIntegral(e.type) || !isIntegral(body_.expr(inner).type) ||
          !types::isLossless(types_, body_.expr(inner).type, e.type))
        return kNone;
      id = inner;
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
    const TypeId type =
        v < self_first_ ? body_.locals[v].type : types_.info(types_.resolve(body_.self)).fields[v - self_first_].type;
    return allOf(type, true);
  }

  // Narrows variables by the outcome of a condition.
  void refine(ExprId condition, bool outcome) {
    const Expr& e = body_.expr(condition);
    if (e.kind == ExprKind::Unary && e.op == Op::Not) return refine(ExprId{e.a}, !outcome);
    if (e.kind != ExprKind::Binary) return;
    if ((e.op == Op::And && outcome) || (e.op == Op::Or && !outcome)) {
      if (types_.kind(e.type) != TypeKind::Bool) return;
      refine(ExprId{e.a}, outcome);
      refine(ExprId{e.b}, outcome);
      return;
    }
    if (!types::isComparison(e.op) || !isIntegral(body_.exprs[e.a].type)) return;
    compare(e.op, outcome, ExprId{e.a}, ExprId{e.b}, false);
    compare(e.op, outcome, ExprId{e.b}, ExprId{e.a}, true);
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

  // Memory that only ST writes holds a subrange's bounds; an image, a union or a pointer's target may not.
  bool keepsBounds(ExprId id) const {
    const Expr* e = &body_.expr(id);
    while (e->kind == ExprKind::Field || e->kind == ExprKind::Index) {
      const Expr& base = body_.expr(ExprId{e->a});
      if (e->kind == ExprKind::Field && types_.info(types_.resolve(base.type)).record_kind == RecordKind::Union)
        return false;
      e = &base;
    }
    return e->kind == ExprKind::Local || e->kind == ExprKind::Self || e->kind == ExprKind::Global ||
           e->kind == ExprKind::Program;
  }

  void place(ExprId id) { value(id); }

  // The values that an expression can have; clears the checks below that it proves.
  Interval value(ExprId id) {
    Expr& e = body_.exprs[id.index];
    if (has_checks_[id.index] == 0 && !isIntegral(e.type)) return {-kWide, kWide};
    switch (e.kind) {
      case ExprKind::Const: {
        if (!isIntegral(e.type)) break;
        const Int128 bits =
            types_.isSigned(types_.plainKind(e.type)) ? Int128{static_cast<int64_t>(e.bits())} : Int128{e.bits()};
        return {bits, bits};
      }
      case ExprKind::Local:
      case ExprKind::Field: {
        if (e.kind == ExprKind::Field) value(ExprId{e.a});
        const uint32_t v = variable(id);
        if (v != kNone) return current(v);
        return allOf(e.type, keepsBounds(id));
      }
      case ExprKind::Index: {
        value(ExprId{e.a});
        const TypeInfo& array = types_.info(types_.resolve(body_.exprs[e.a].type));
        bool inside = array.dimensions.size() == e.c;
        for (uint32_t i = 0; i < e.c; ++i) {
          const Interval one = value(body_.operands[e.b + i]);
          inside = inside && one.within({array.dimensions[i].low, array.dimensions[i].high});
        }
        if (inside) clear(e, kCheckIndex);
        return allOf(e.type, keepsBounds(id));
      }
      case ExprKind::Unary: {
        const Interval a = value(ExprId{e.a});
        if (!isIntegral(e.type)) break;
        const IntervalResult result = apply(e.op, a, {0, 0}, allOf(e.type, false));
        if (result.fits) clear(e, kCheckOverflow);
        return result.interval;
      }
      case ExprKind::Binary: {
        const Interval a = value(ExprId{e.a});
        const Interval b = value(ExprId{e.b});
        const bool integers = isIntegral(body_.exprs[e.a].type) && isIntegral(body_.exprs[e.b].type);
        if (types::isComparison(e.op)) return {0, 1};
        if (!integers || !isIntegral(e.type)) break;
        if ((e.op == Op::Div || e.op == Op::Mod) && !b.contains(0)) clear(e, kCheckDiv);
        const IntervalResult result = apply(e.op, a, b, allOf(e.type, false));
        if (result.fits) clear(e, kCheckOverflow);
        if (!asking_ && a.low >= 0 && e.checks == 0 && isSignedDivision(e)) dropSign(id);
        return result.interval;
      }
      case ExprKind::Convert: {
        const Interval a = value(ExprId{e.a});
        if (!isIntegral(e.type)) break;
        const Interval target = allOf(e.type, true);
        if (!isIntegral(body_.exprs[e.a].type)) return target;
        if (types_.plainKind(e.type) == TypeKind::Bool) break;  // <> 0
        if (a.within(target)) {
          clear(e, kCheckSubrange | kCheckConvert | kCheckOverflow);
          return a;
        }
        return target;
      }
      case ExprKind::Select: {
        value(ExprId{e.a});
        const Interval yes = value(ExprId{e.b});
        const Interval no = value(ExprId{e.c});
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
      case ExprKind::Deref:
      case ExprKind::Bits:
      case ExprKind::Call:
      case ExprKind::Address: forEachSlot(body_, e, [&](const uint32_t& slot) { value(ExprId{slot}); }); break;
    }
    return allOf(e.type, false);
  }

  Module& module_;
  const TypeTable& types_;
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
  std::vector<LoopState*> loops_;  // the loops around the current statement
  uint32_t self_first_ = 0;
  uint32_t epoch_ = 0, stamps_ = 0;
  int trials_ = 0;
  bool asking_ = false;
  bool changed_ = false;
};

}  // namespace

bool removeChecks(Module& module, Body& body) { return Analysis(module, body).run(); }

}  // namespace rung::ir

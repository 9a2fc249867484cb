// See evaluator.h.
#include "evaluator.h"

#include "ir/walk.h"

namespace rung::ir {

using types::Fault;
using types::TypeInfo;
using types::TypeKind;
using types::Value;

namespace {

constexpr int kMaxSteps = 3000;

enum class Flow { Next, Break, Continue, Return, Jump, Stop };

class Machine {
 public:
  Machine(const Module& module, const Body& body, int depth) : m_(module), t_(module.types), b_(body), depth_(depth) {
    for (const Local& local : b_.locals) {
      size_t count = 1;
      const TypeInfo& info = t_.info(local.type);
      if (info.kind == TypeKind::Array) {
        for (const auto& d : info.dimensions) count *= d.count();
        memory_.push_back(std::vector<Value>(count, Value{t_.resolve(info.base), 0}));
      } else {
        memory_.push_back(std::vector<Value>(1, Value{local.type, 0}));
      }
    }
  }

  RunResult result;
  std::vector<std::vector<Value>> memory_;  // by local

  Flow block(StmtId first) {
    StmtId id = first;
    while (id) {
      const Flow flow = stmt(b_.stmt(id));
      if (flow == Flow::Jump) {
        StmtId target;
        for (StmtId at = first; at; at = b_.stmt(at).next)
          if (b_.stmt(at).kind == StmtKind::Label && b_.stmt(at).a == jump_) target = at;
        if (!target) return flow;
        id = target;
        continue;
      }
      if (flow != Flow::Next) return flow;
      id = b_.stmt(id).next;
    }
    return Flow::Next;
  }

 private:
  Flow stop(const std::string& why) {
    if (result.trouble.empty() && result.fault == Fault::None) result.trouble = why;
    return Flow::Stop;
  }
  bool stopped() const { return result.fault != Fault::None || !result.trouble.empty(); }
  void raise(Fault fault) {
    if (!stopped()) result.fault = fault;
  }

  Value* place(ExprId id) {
    const Expr& e = b_.expr(id);
    if (e.kind == ExprKind::Local) return &memory_[e.a][0];
    if (e.kind == ExprKind::Index && b_.expr(ExprId{e.a}).kind == ExprKind::Local) {
      const TypeInfo& array = t_.info(b_.expr(ExprId{e.a}).type);
      size_t at = 0;
      for (uint32_t i = 0; i < e.c; ++i) {
        const int64_t index = value(b_.operands[e.b + i]).asSigned();
        const auto& d = array.dimensions[i];
        if (index < d.low || index > d.high) {
          if ((e.checks & kCheckIndex) != 0)
            raise(Fault::Index);
          else
            stop("an index outside of its array is not checked");
          return nullptr;
        }
        at = at * d.count() + static_cast<size_t>(index - d.low);
      }
      return stopped() ? nullptr : &memory_[b_.expr(ExprId{e.a}).a][at];
    }
    stop("a place that is not a local");
    return nullptr;
  }

  Value value(ExprId id) {
    const Expr& e = b_.expr(id);
    auto checked = [&](const types::Outcome& outcome) {
      if (outcome.fault == Fault::Div && (e.checks & kCheckDiv) != 0) raise(Fault::Div);
      if (outcome.overflow && (e.checks & kCheckSubrange) != 0) raise(Fault::Subrange);
      if (outcome.overflow && (e.checks & kCheckConvert) != 0) raise(Fault::Convert);
      if (outcome.overflow && (e.checks & kCheckOverflow) != 0) raise(Fault::Overflow);
      return Value{e.type, outcome.value.bits};
    };
    switch (e.kind) {
      case ExprKind::Const: return {e.type, e.bits()};
      case ExprKind::Local:
      case ExprKind::Index: {
        const Value* at = place(id);
        return at == nullptr ? Value{} : *at;
      }
      case ExprKind::Unary: {
        const Value a = value(ExprId{e.a});
        return stopped() ? Value{} : checked(types::apply(t_, m_.names, e.op, a));
      }
      case ExprKind::Binary: {
        const Value a = value(ExprId{e.a});
        const Value b = value(ExprId{e.b});
        return stopped() ? Value{} : checked(types::apply(t_, m_.names, e.op, a, b));
      }
      case ExprKind::Convert: {
        const Value a = value(ExprId{e.a});
        return stopped() ? Value{} : checked(types::convert(t_, a, e.type));
      }
      case ExprKind::Select: {
        const Value condition = value(ExprId{e.a});
        const Value yes = value(ExprId{e.b});
        const Value no = value(ExprId{e.c});
        return condition.bits != 0 ? yes : no;
      }
      case ExprKind::Bits: {
        const Value base = value(ExprId{e.a});
        const uint32_t width = types::TypeTable::bitWidth(t_.plainKind(e.type));
        return {e.type, base.bits >> (e.b * width) & ((uint64_t{1} << width) - 1)};
      }
      case ExprKind::Call: return call(m_.body(BodyId{e.a}), e.b, e.c);
      case ExprKind::None:
      case ExprKind::String:
      case ExprKind::Data:
      case ExprKind::Zero:
      case ExprKind::Self:
      case ExprKind::Global:
      case ExprKind::Program:
      case ExprKind::Image:
      case ExprKind::Field:
      case ExprKind::Deref:
      case ExprKind::Address: break;
    }
    stop("an expression that the test evaluator does not know");
    return {};
  }

  Value call(const Body& callee, uint32_t first, uint32_t count) {
    if (depth_ > 50) {
      stop("calls too deep");
      return {};
    }
    Machine inner(m_, callee, depth_ + 1);
    std::vector<std::pair<size_t, Value*>> back;
    uint32_t i = 0;
    Value given{};
    for (size_t k = 0; k < callee.locals.size(); ++k) {
      const LocalKind kind = callee.locals[k].kind;
      if (kind != LocalKind::Input && kind != LocalKind::Output && kind != LocalKind::InOut) continue;
      if (i == count) break;
      const ExprId operand = b_.operands[first + i++];
      if (!operand) continue;
      if (kind == LocalKind::Input) {
        inner.memory_[k][0].bits = value(operand).bits;
      } else if (Value* at = place(operand)) {
        inner.memory_[k][0].bits = at->bits;
        back.push_back({k, at});
      }
      if (stopped()) return {};
    }
    if (inner.block(callee.first) == Flow::Stop) {
      result = inner.result;
      return {};
    }
    for (auto& [k, at] : back) at->bits = inner.memory_[k][0].bits;
    for (size_t k = 0; k < callee.locals.size(); ++k)
      if (callee.locals[k].kind == LocalKind::Result) given = inner.memory_[k][0];
    return given;
  }

  Flow iterate(StmtId body, bool& leave) {
    leave = false;
    const Flow flow = block(body);
    if (flow == Flow::Break) leave = true;
    if (flow == Flow::Return || flow == Flow::Jump || flow == Flow::Stop) return flow;
    return Flow::Next;
  }

  Flow stmt(const Stmt& s) {
    if (++steps_ > kMaxSteps) return stop("the run does not end");
    const Flow flow = step(s);
    return stopped() ? Flow::Stop : flow;
  }

  Flow step(const Stmt& s) {
    switch (s.kind) {
      case StmtKind::Assign: {
        const Expr& target = b_.expr(ExprId{s.a});
        if (target.kind == ExprKind::Bits) {
          Value* at = place(ExprId{target.a});
          const Value v = value(ExprId{s.b});
          if (at == nullptr || stopped()) return Flow::Stop;
          const uint32_t width = types::TypeTable::bitWidth(t_.plainKind(target.type));
          const uint64_t mask = ((uint64_t{1} << width) - 1) << (target.b * width);
          at->bits = (at->bits & ~mask) | (v.bits << (target.b * width) & mask);
          return Flow::Next;
        }
        Value* at = place(ExprId{s.a});
        const Value v = value(ExprId{s.b});
        if (at == nullptr || stopped()) return Flow::Stop;
        at->bits = v.bits;
        return Flow::Next;
      }
      case StmtKind::Call: {
        const Value v = call(m_.body(BodyId{s.a}), s.c, s.d);
        if (stopped() || s.e == 0) return Flow::Next;
        if (Value* at = place(ExprId{s.e})) at->bits = v.bits;
        return Flow::Next;
      }
      case StmtKind::If: {
        const Value condition = value(ExprId{s.a});
        return stopped() ? Flow::Stop : block(StmtId{condition.bits != 0 ? s.b : s.c});
      }
      case StmtKind::Switch: {
        const Value selector = value(ExprId{s.a});
        if (stopped()) return Flow::Stop;
        const bool is_signed = t_.isSigned(t_.plainKind(selector.type));
        auto notAbove = [&](uint64_t a, uint64_t b) {
          return is_signed ? static_cast<int64_t>(a) <= static_cast<int64_t>(b) : a <= b;
        };
        for (uint32_t i = 0; i < s.c; ++i) {
          const Case& one = b_.cases[s.b + i];
          for (uint32_t k = 0; k < one.range_count; ++k) {
            const CaseRange& r = b_.ranges[one.first_range + k];
            if (notAbove(static_cast<uint64_t>(r.low), selector.bits) &&
                notAbove(selector.bits, static_cast<uint64_t>(r.high)))
              return block(one.block);
          }
        }
        return block(StmtId{s.d});
      }
      case StmtKind::Loop:
        for (bool leave = false;;) {
          if (++steps_ > kMaxSteps) return stop("the run does not end");
          Flow flow = iterate(StmtId{s.a}, leave);
          if (flow != Flow::Next || leave) return flow;
          flow = block(StmtId{s.b});
          if (flow != Flow::Next) return flow == Flow::Break ? Flow::Next : flow;
        }
      case StmtKind::For: {
        Value* control = place(ExprId{s.a});
        const Value from = value(ExprId{s.b});
        const Value to = value(ExprId{s.c});
        const int64_t by = value(ExprId{s.d}).asSigned();
        if (control == nullptr || stopped()) return Flow::Stop;
        control->bits = from.bits;
        while (by > 0 ? control->asSigned() <= to.asSigned() : control->asSigned() >= to.asSigned()) {
          bool leave = false;
          const Flow flow = iterate(StmtId{s.e}, leave);
          if (flow != Flow::Next || leave) return flow;
          const types::Outcome next =
              types::apply(t_, m_.names, types::Op::Add, *control, Value{control->type, static_cast<uint64_t>(by)});
          if (next.overflow) {
            control->bits = to.bits;
            break;
          }
          control->bits = next.value.bits;
          if (++steps_ > kMaxSteps) return stop("the run does not end");
        }
        return Flow::Next;
      }
      case StmtKind::Break: return Flow::Break;
      case StmtKind::Continue: return Flow::Continue;
      case StmtKind::Return: return Flow::Return;
      case StmtKind::Jump: jump_ = s.a; return Flow::Jump;
      case StmtKind::Label: return Flow::Next;
      case StmtKind::Try: {
        Flow flow = block(StmtId{s.a});
        if (result.fault != Fault::None) {
          const auto number = static_cast<uint64_t>(result.fault);
          result.fault = Fault::None;
          if (s.d != 0) {
            if (Value* at = place(ExprId{s.d})) at->bits = number;
          }
          flow = block(StmtId{s.b});
        }
        const RunResult outer = result;
        result = {};
        const Flow last = block(StmtId{s.c});
        if (last != Flow::Next) return last;
        result = outer;
        return flow;
      }
      case StmtKind::Fault: raise(static_cast<Fault>(s.op)); return Flow::Stop;
      case StmtKind::Evaluate: value(ExprId{s.a}); return Flow::Next;
      case StmtKind::None:
      case StmtKind::Bind:
      case StmtKind::Assert: break;
    }
    return stop("a statement that the test evaluator does not know");
  }

  const Module& m_;
  const types::TypeTable& t_;
  const Body& b_;
  int depth_;
  int steps_ = 0;
  uint32_t jump_ = 0;
};

}  // namespace

RunResult run(const Module& module, const Body& body, const std::vector<Value>& arguments) {
  Machine machine(module, body, 0);
  size_t next = 0;
  for (size_t i = 0; i < body.locals.size(); ++i) {
    const LocalKind kind = body.locals[i].kind;
    if (kind != LocalKind::Input && kind != LocalKind::InOut) continue;
    if (next < arguments.size()) machine.memory_[i][0].bits = arguments[next++].bits;
  }
  machine.block(body.first);
  for (size_t i = 0; i < body.locals.size(); ++i)
    if (body.locals[i].kind == LocalKind::Result) machine.result.value = machine.memory_[i][0];
  return machine.result;
}

}  // namespace rung::ir

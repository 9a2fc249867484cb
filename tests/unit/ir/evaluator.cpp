// SPDX-License-Identifier: Apache-2.0
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
          if (const auto* label = b_.stmt(at).tryAs<LabelStmt>(); label != nullptr && label->label == jump_)
            target = at;
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
    if (const uint32_t* local = localOf(e)) return &memory_[*local][0];
    const auto* element = e.tryAs<IndexExpr>();
    const uint32_t* of = element == nullptr ? nullptr : localOf(b_.expr(element->base));
    if (of != nullptr) {
      const TypeInfo& array = t_.info(b_.expr(element->base).type);
      size_t at = 0;
      for (uint32_t i = 0; i < element->indices.count; ++i) {
        const int64_t index = value(b_.list(element->indices)[i]).asSigned();
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
      return stopped() ? nullptr : &memory_[*of][at];
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
      case ExprKind::Const: return {e.type, bitsOf(e)};
      case ExprKind::Local:
      case ExprKind::Index: {
        const Value* at = place(id);
        return at == nullptr ? Value{} : *at;
      }
      case ExprKind::Unary: {
        const auto [operand, op] = e.as<UnaryExpr>();
        const Value a = value(operand);
        return stopped() ? Value{} : checked(types::apply(t_, m_.names, op, a));
      }
      case ExprKind::Binary: {
        const auto [left, right, op] = e.as<BinaryExpr>();
        const Value a = value(left);
        const Value b = value(right);
        return stopped() ? Value{} : checked(types::apply(t_, m_.names, op, a, b));
      }
      case ExprKind::Convert: {
        const auto [operand, rounding] = e.as<ConvertExpr>();
        const Value a = value(operand);
        return stopped() ? Value{} : checked(types::convert(t_, a, e.type, rounding));
      }
      case ExprKind::Select: {
        const SelectExpr& node = e.as<SelectExpr>();
        const Value condition = value(node.condition);
        const Value yes = value(node.when_true);
        const Value no = value(node.when_false);
        return condition.bits != 0 ? yes : no;
      }
      case ExprKind::Bits: {
        const auto [place, position] = e.as<BitsExpr>();
        const Value base = value(place);
        const uint32_t width = types::TypeTable::bitWidth(t_.plainKind(e.type));
        return {e.type, base.bits >> (position * width) & ((uint64_t{1} << width) - 1)};
      }
      case ExprKind::Call: return call(m_.body(e.as<CallExpr>().callee), e.as<CallExpr>().operands);
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

  Value call(const Body& callee, Slice<ExprId> operands) {
    if (depth_ > 50) {
      stop("calls too deep");
      return {};
    }
    Machine inner(m_, callee, depth_ + 1);
    std::vector<std::pair<size_t, Value*>> back;
    uint32_t i = 0;
    Value given{};
    for (size_t k = 0; k < callee.locals.size(); ++k) {
      if (!isParameter(callee.locals[k])) continue;
      if (i == operands.count) break;
      const ExprId operand = b_.list(operands)[i++];
      if (!operand) continue;
      if (callee.locals[k].kind == LocalKind::Input) {
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

  Flow forLoop(const ForStmt& node) {
    Value* control = place(node.control);
    const Value from = value(node.from);
    const Value to = value(node.to);
    const int64_t by = value(node.step).asSigned();
    if (control == nullptr || stopped()) return Flow::Stop;
    control->bits = from.bits;
    while (by > 0 ? control->asSigned() <= to.asSigned() : control->asSigned() >= to.asSigned()) {
      bool leave = false;
      const Flow flow = iterate(node.body_block, leave);
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

  Flow step(const Stmt& s) {
    switch (s.kind) {
      case StmtKind::Assign: {
        const auto [to, from] = s.as<AssignStmt>();
        const Expr& target = b_.expr(to);
        if (const auto* bits = target.tryAs<BitsExpr>()) {
          Value* at = place(bits->base);
          const Value v = value(from);
          if (at == nullptr || stopped()) return Flow::Stop;
          const uint32_t width = types::TypeTable::bitWidth(t_.plainKind(target.type));
          const uint64_t mask = ((uint64_t{1} << width) - 1) << (bits->position * width);
          at->bits = (at->bits & ~mask) | (v.bits << (bits->position * width) & mask);
          return Flow::Next;
        }
        Value* at = place(to);
        const Value v = value(from);
        if (at == nullptr || stopped()) return Flow::Stop;
        at->bits = v.bits;
        return Flow::Next;
      }
      case StmtKind::Call: {
        const CallStmt& node = s.as<CallStmt>();
        const Value v = call(m_.body(node.callee), node.operands);
        if (stopped() || !node.result) return Flow::Next;
        if (Value* at = place(node.result)) at->bits = v.bits;
        return Flow::Next;
      }
      case StmtKind::If: {
        const IfStmt& node = s.as<IfStmt>();
        const Value condition = value(node.condition);
        return stopped() ? Flow::Stop : block(condition.bits != 0 ? node.then_block : node.else_block);
      }
      case StmtKind::Switch: {
        const SwitchStmt& node = s.as<SwitchStmt>();
        const Value selector = value(node.selector);
        if (stopped()) return Flow::Stop;
        const bool is_signed = t_.isSigned(t_.plainKind(selector.type));
        auto notAbove = [&](uint64_t a, uint64_t b) {
          return is_signed ? static_cast<int64_t>(a) <= static_cast<int64_t>(b) : a <= b;
        };
        for (const Case& one : b_.list(node.cases)) {
          for (const CaseRange& r : b_.list(one.ranges)) {
            if (notAbove(static_cast<uint64_t>(r.low), selector.bits) &&
                notAbove(selector.bits, static_cast<uint64_t>(r.high)))
              return block(one.block);
          }
        }
        return block(node.else_block);
      }
      case StmtKind::Loop:
        for (bool leave = false;;) {
          if (++steps_ > kMaxSteps) return stop("the run does not end");
          Flow flow = iterate(s.as<LoopStmt>().body_block, leave);
          if (flow != Flow::Next || leave) return flow;
          flow = block(s.as<LoopStmt>().next_block);
          if (flow != Flow::Next) return flow == Flow::Break ? Flow::Next : flow;
        }
      case StmtKind::For: return forLoop(s.as<ForStmt>());
      case StmtKind::Break: return Flow::Break;
      case StmtKind::Continue: return Flow::Continue;
      case StmtKind::Return: return Flow::Return;
      case StmtKind::Jump: jump_ = s.as<JumpStmt>().label; return Flow::Jump;
      case StmtKind::Label: return Flow::Next;
      case StmtKind::Try: {
        const TryStmt& node = s.as<TryStmt>();
        Flow flow = block(node.body_block);
        if (result.fault != Fault::None) {
          const auto number = static_cast<uint64_t>(result.fault);
          result.fault = Fault::None;
          if (node.number) {
            if (Value* at = place(node.number)) at->bits = number;
          }
          flow = block(node.catch_block);
        }
        const RunResult outer = result;
        result = {};
        const Flow last = block(node.finally_block);
        if (last != Flow::Next) return last;
        result = outer;
        return flow;
      }
      case StmtKind::Fault: raise(s.as<FaultStmt>().fault); return Flow::Stop;
      case StmtKind::Evaluate: value(s.as<EvaluateStmt>().value); return Flow::Next;
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

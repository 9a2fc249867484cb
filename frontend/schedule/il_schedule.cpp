// SPDX-License-Identifier: Apache-2.0
// How it works. The accumulator is an expression that is not part of a statement yet; LD begins a new one, operators
// wrap it, ST, JMPC and the like put it into a statement. Values that must be evaluated before another statement become
// temporaries: the accumulator where an instruction reads it afterwards, and the values in front of open parentheses.
// Tells whether an instruction reads it is known in advance (il_flow.h, one walk), so most bodies need no temporary at
// all; literals are repeated instead. Unreachable instructions are dropped. Inputs of an instance that are stored
// before CAL (`LD a  ST timer.IN`) are ordinary assignments, in edition 2 as well: inputs may be set from outside in
// every dialect (ed. 3 table 42, 6a).
#include "frontend/schedule/il_schedule.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/il_flow.h"
#include "frontend/schedule/il_structure.h"
#include "frontend/syntax/clone.h"
#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/tree_builder.h"

namespace rung::text {
namespace {

// Of one expression. A larger tree is cut by a temporary, so the number of instructions is not limited.
constexpr uint16_t kMaxHeight = 200;

class IlScheduler {
 public:
  IlScheduler(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures, bool short_circuit)
      : tree_(tree), names_(names), diagnostics_(diagnostics), signatures_(signatures), short_circuit_(short_circuit) {}

  ScheduledBody run(Slice<IlInstruction> list);

 private:
  enum class State : uint8_t {
    Empty,   // nothing was loaded
    Known,   //
    Broken,  // an error was reported
  };
  struct Value {
    State state = State::Empty;
    bool constant = false;  // a literal: repeated where it is read again, so that each copy gets its own type
    bool literals = false;  // consists of literals only, which are computed exactly
    bool calls = false;
    bool read = false;
    uint16_t height = 1;
    ExprId expr;
    NameId temporary;  // instead of `expr`
    Loc loc;           // of the instruction that computed it
  };
  struct Open {  // a deferred operator
    IlInstruction instruction;
    Value left;
  };

  bool isLive(uint32_t instruction) const { return flow_->reader[instruction] != kNoInstruction; }
  Argument operand(const IlInstruction& i, uint32_t index) const { return tree_.list(i.operands)[index]; }
  bool isConstant(ExprId expr) const;

  // ---- instructions
  Value runList(Slice<IlInstruction> list, bool nested);
  void step(const IlInstruction& i);
  void skip(const IlInstruction& i, bool& reported);
  void label(const IlInstruction& i);
  void store(const IlInstruction& i);
  void binary(const IlInstruction& i);
  void close(const IlInstruction& i);
  void function(const IlInstruction& i);
  void call(const IlInstruction& i);
  void jump(const IlInstruction& i);
  void leave(const IlInstruction& i);
  bool allowed(const IlInstruction& i);

  // ---- values
  void require(Value& value, const IlInstruction& reader);
  ExprId take(Value& value, Loc reader);
  ExprId use(const IlInstruction& reader);
  Value valueOf(ExprId operand, Loc loc) const;
  Value negated(Value value, Loc loc);
  Value combined(Value left, BinaryOp op, Value right, Loc loc);
  Value called(ExprId callee, std::vector<Argument>& arguments, Loc loc, uint16_t height);
  void fillNested(const IlInstruction& i, std::vector<Argument>& arguments);
  void spill(Value& value);
  void finalizeOpen();
  void limit(Value& value);
  void drop();
  void keepOrDrop();

  // ---- nodes
  void emit(StmtId statement) {
    finalizeOpen();
    out_.push_back(statement);
  }
  void assign(ExprId target, ExprId value, Loc loc, AssignOp op = AssignOp::Assign) {
    emit(build_.assign(op, target, value, loc));
  }
  void callStatement(ExprId call) { emit(build_.callStatement(call)); }
  // IF condition THEN statements emitted by `body` END_IF
  template <class Body>
  void conditional(ExprId condition, Loc loc, Body body);
  NameId newTemporary(Loc loc);

  Tree& tree_;
  TreeBuilder build_{tree_};
  Names& names_;
  Diagnostics& diagnostics_;
  Signatures& signatures_;
  bool short_circuit_;

  std::vector<StmtId> out_;
  std::vector<Open> open_;
  size_t finalized_ = 0;  // of open_: the first ones, whose values are already temporaries or constants
  std::vector<DeclId> temporaries_;
  uint32_t next_temporary_ = 1;
  Value acc_;
  bool falls_ = true;       // the instruction before continues here
  uint32_t at_ = 0;         // the current instruction
  IlFlow* flow_ = nullptr;  // of the current list
  size_t first_open_ = 0;
  bool nested_ = false;
  struct EmptyWay {
    uint32_t label;
    Loc from;
  };
  std::vector<EmptyWay> empty_ways_;  // to labels whose accumulator is read
};

// ---- values

bool IlScheduler::isConstant(ExprId expr) const {
  while (tree_.kind(expr) == ExprKind::Unary) expr = tree_.as<UnaryExpr>(expr).operand;
  return tree_.kind(expr) == ExprKind::Literal || tree_.kind(expr) == ExprKind::TypedName;
}

NameId IlScheduler::newTemporary(Loc loc) {
  Ident ident{{}, loc};
  do {
    std::string name = "acc";
    if (next_temporary_ > 1) name += std::to_string(next_temporary_);
    ++next_temporary_;
    ident.name = names_.intern(name);
  } while (signatures_.of(ident.name).kind != SignatureKind::Unknown);
  temporaries_.push_back(build_.variable(ident, {}));
  return ident.name;
}

IlScheduler::Value IlScheduler::valueOf(ExprId operand, Loc loc) const {
  Value value;
  value.state = State::Known;
  value.expr = operand;
  value.constant = value.literals = isConstant(operand);
  value.calls = tree_.kind(operand) == ExprKind::Call;
  value.loc = loc;
  return value;
}

// Evaluates the value now, into a temporary.
void IlScheduler::spill(Value& value) {
  if (value.state != State::Known || value.constant || value.temporary) return;
  const NameId name = newTemporary(value.loc);
  out_.push_back(build_.assign(AssignOp::Assign, build_.name(name, value.loc), value.expr, value.loc));
  value.expr = {};
  value.temporary = name;
  value.literals = value.calls = false;
  value.height = 1;
}

// Values in front of open parentheses are evaluated before the statement that follows.
void IlScheduler::finalizeOpen() {
  for (; finalized_ < open_.size(); ++finalized_) spill(open_[finalized_].left);
}

// A temporary for an expression of literals would fix their type too early.
void IlScheduler::limit(Value& value) {
  if (value.height < kMaxHeight || value.literals) return;
  finalizeOpen();
  spill(value);
}

// Forbids reading the accumulator before a value is loaded.
//   fails   ST a        at the beginning of a body                E0727
void IlScheduler::require(Value& value, const IlInstruction& reader) {
  if (value.state != State::Empty) return;
  value.state = State::Broken;
  diagnostics_.report(diag::AccumulatorEmpty, reader.loc,
                      {reader.word ? names_.string(reader.word) : std::string_view(")")});
}

// The value as an expression of the tree.
ExprId IlScheduler::take(Value& value, Loc reader) {
  value.read = true;
  if (value.state != State::Known) return build_.error(reader);
  if (value.temporary) return build_.name(value.temporary, reader);
  return value.constant ? clone(tree_, value.expr) : value.expr;
}

// The accumulator for an instruction that does not change it.
ExprId IlScheduler::use(const IlInstruction& reader) {
  if (isLive(at_ + 1)) {
    finalizeOpen();
    spill(acc_);
  }
  return take(acc_, reader.loc);
}

IlScheduler::Value IlScheduler::negated(Value value, Loc loc) {
  Value result = value;
  result.expr = build_.unary(UnaryOp::Not, take(value, loc), loc);
  result.state = value.state == State::Broken ? State::Broken : State::Known;
  result.temporary = {};
  result.constant = result.read = false;
  result.loc = loc;
  ++result.height;
  limit(result);
  return result;
}

IlScheduler::Value IlScheduler::combined(Value left, BinaryOp op, Value right, Loc loc) {
  const bool logical = op == BinaryOp::And || op == BinaryOp::Or;
  if (short_circuit_ && logical && right.calls) {
    finalizeOpen();
    spill(left);
    spill(right);
  }
  Value result;
  result.state = left.state == State::Known && right.state == State::Known ? State::Known : State::Broken;
  result.literals = left.literals && right.literals;
  result.calls = left.calls || right.calls;
  result.height = static_cast<uint16_t>(std::max(left.height, right.height) + 1);
  result.loc = loc;
  const ExprId first = take(left, loc), second = take(right, loc);
  result.expr = build_.binary(op, first, second, loc);
  limit(result);
  return result;
}

// The accumulator gets another value. An unused value is still evaluated: it may call or fault, and its names are
// checked.
void IlScheduler::drop() {
  const Value value = std::exchange(acc_, {});
  if (value.state != State::Known || value.read) return;
  if (value.expr && tree_.kind(value.expr) == ExprKind::Call) return callStatement(value.expr);
  diagnostics_.report(diag::AccumulatorUnused, value.loc);
  if (value.constant) return;
  acc_ = value;
  finalizeOpen();
  spill(acc_);
  acc_ = {};
}

// Before a call that does not read the accumulator.
void IlScheduler::keepOrDrop() {
  if (!isLive(at_ + 1)) return drop();
  finalizeOpen();
  spill(acc_);
}

// ---- instructions

template <class Body>
void IlScheduler::conditional(ExprId condition, Loc loc, Body body) {
  finalizeOpen();
  const size_t first = out_.size();
  body();
  const StmtId statement =
      build_.ifStatement(condition, std::span<const StmtId>(out_).subspan(first), loc, kConditionalOp);
  out_.resize(first);
  out_.push_back(statement);
}

// Forbids instructions that leave open parentheses, and statements in the list of an argument.
bool IlScheduler::allowed(const IlInstruction& i) {
  const bool leaves = i.kind == IlKind::Jump || i.kind == IlKind::Return;
  const bool states =
      i.kind == IlKind::Store || i.kind == IlKind::Set || i.kind == IlKind::Reset || i.kind == IlKind::Call;
  if (!(leaves && open_.size() > first_open_) && !(nested_ && (leaves || states))) return true;
  const std::string shown = "`" + std::string(names_.string(i.word)) + "`";
  diagnostics_.report(diag::IlInsideParens, i.loc, {shown});
  return false;
}

// The accumulator at the end of a list.
IlScheduler::Value IlScheduler::runList(Slice<IlInstruction> list, bool nested) {
  IlFlow flow = flowOf(tree_, names_, diagnostics_, signatures_, list, nested);
  IlFlow* const outer_flow = std::exchange(flow_, &flow);
  const uint32_t outer_at = at_;
  const size_t outer_open = std::exchange(first_open_, open_.size());
  const bool outer_nested = std::exchange(nested_, nested);
  const Value outer_acc = std::exchange(acc_, {});
  bool reported = false;
  for (at_ = 0; at_ < list.count; ++at_) {
    const IlInstruction& i = tree_.list(list)[at_];
    if (!flow.reached[at_]) {
      skip(i, reported);
      continue;
    }
    reported = false;
    if (i.label.name) label(i);
    step(i);
  }
  for (size_t k = 0; !nested && k < empty_ways_.size(); ++k) {
    const EmptyWay& way = empty_ways_[k];
    const IlInstruction& reader = tree_.list(list)[flow.reader[way.label]];
    diagnostics_
        .report(diag::AccumulatorEmpty, reader.loc, {reader.word ? names_.string(reader.word) : std::string_view(")")})
        .note(way.from, diag::WayWithoutValue);
  }
  if (!nested) drop();
  flow_ = outer_flow;
  at_ = outer_at;
  first_open_ = outer_open;
  nested_ = outer_nested;
  return std::exchange(acc_, outer_acc);
}

// Where paths meet, the accumulator is a temporary that each of them sets. A label without jumps is dropped.
void IlScheduler::label(const IlInstruction& i) {
  if (open_.size() > first_open_ || nested_) {
    const std::string shown = "the label `" + std::string(names_.string(i.label.name)) + "`";
    diagnostics_.report(diag::IlInsideParens, i.label.loc, {shown});
    return;
  }
  if (flow_->jumps[at_] == 0) return;
  NameId& temporary = flow_->temporary[at_];
  if (isLive(at_)) {
    if (!temporary) temporary = newTemporary(i.label.loc);
    if (falls_ && acc_.state == State::Empty) empty_ways_.push_back({at_, i.label.loc});
    if (acc_.state == State::Known) assign(build_.name(temporary, acc_.loc), take(acc_, acc_.loc), acc_.loc);
    acc_ = {};
    acc_.state = State::Known;
    acc_.temporary = temporary;
    acc_.loc = i.label.loc;
  } else {
    drop();
  }
  emit(build_.label(i.label));
  falls_ = true;
}

// An unreachable instruction. Its parentheses are tracked, so that a label inside of them is reported.
void IlScheduler::skip(const IlInstruction& i, bool& reported) {
  if (!reported && i.kind != IlKind::Label) {
    diagnostics_.report(diag::Unreachable, i.loc);
    reported = true;
  }
  if ((i.flags & kIlDeferred) != 0) {
    open_.push_back({i, {}});
    open_.back().left.state = State::Broken;
  }
  if (i.kind != IlKind::Close) return;
  open_.pop_back();
  finalized_ = std::min(finalized_, open_.size());
}

void IlScheduler::step(const IlInstruction& i) {
  if (!allowed(i)) return;
  // The call of the instance with this one input.
  if (const NameId* pin = inputOperator(tree_, names_, signatures_, i)) {
    require(acc_, i);
    Argument argument{{*pin, i.loc}, use(i), false, false, i.loc};
    std::vector<Argument> arguments{argument};
    return callStatement(called(operand(i, 0).value, arguments, i.loc, 1).expr);
  }
  switch (i.kind) {
    case IlKind::Label: return;
    case IlKind::Load:
      drop();
      acc_ = valueOf(operand(i, 0).value, i.loc);
      if ((i.flags & kIlNegated) != 0) acc_ = negated(acc_, i.loc);
      return;
    case IlKind::Store:
    case IlKind::Set:
    case IlKind::Reset: return store(i);
    case IlKind::Not:
      require(acc_, i);
      acc_ = negated(acc_, i.loc);
      return;
    case IlKind::Binary: return binary(i);
    case IlKind::Close: return close(i);
    case IlKind::Function: return function(i);
    case IlKind::Call: return call(i);
    case IlKind::Jump: return jump(i);
    case IlKind::Return: return leave(i);
  }
}

void IlScheduler::store(const IlInstruction& i) {
  require(acc_, i);
  const ExprId value = use(i);
  const ExprId target = operand(i, 0).value;
  if (i.kind != IlKind::Store)
    assign(target, value, i.loc, i.kind == IlKind::Set ? AssignOp::Set : AssignOp::Reset);
  else if ((i.flags & kIlAttempt) != 0)
    assign(target, value, i.loc, AssignOp::Attempt);
  else
    assign(target, (i.flags & kIlNegated) != 0 ? build_.unary(UnaryOp::Not, value, i.loc) : value, i.loc);
}

void IlScheduler::binary(const IlInstruction& i) {
  require(acc_, i);
  if ((i.flags & kIlDeferred) != 0) {
    open_.push_back({i, std::exchange(acc_, {})});
    if (!i.operands.empty()) acc_ = valueOf(operand(i, 0).value, i.loc);
    return;
  }
  for (uint32_t k = 0; k < i.operands.count; ++k) {
    Value right = valueOf(operand(i, k).value, i.loc);
    if ((i.flags & kIlNegated) != 0) right = negated(right, i.loc);
    acc_ = combined(acc_, i.op, right, i.loc);
  }
}

void IlScheduler::close(const IlInstruction& i) {
  require(acc_, i);
  const Open open = open_.back();
  open_.pop_back();
  finalized_ = std::min(finalized_, open_.size());
  const IlInstruction& op = open.instruction;
  if (op.kind == IlKind::Function) {
    Value left = open.left;
    std::vector<Argument> arguments;
    const uint16_t height = std::max(left.height, acc_.height);
    if (left.state != State::Empty) arguments.push_back({{}, take(left, op.loc), false, false, op.loc});
    arguments.push_back({{}, take(acc_, op.loc), false, false, op.loc});
    acc_ = called(op.callee, arguments, op.loc, height);
    return limit(acc_);
  }
  if ((op.flags & kIlNegated) != 0) acc_ = negated(acc_, op.loc);
  acc_ = combined(open.left, op.op, acc_, op.loc);
}

IlScheduler::Value IlScheduler::called(ExprId callee, std::vector<Argument>& arguments, Loc loc, uint16_t height) {
  Value value;
  value.state = State::Known;
  value.calls = true;
  value.height = static_cast<uint16_t>(height + 1);
  value.loc = loc;
  value.expr = build_.call(callee, tree_.addList<Argument>(arguments), tree_.loc(callee), loc);
  return value;
}

// The operands as arguments, with the values of nested lists.
void IlScheduler::fillNested(const IlInstruction& i, std::vector<Argument>& arguments) {
  const size_t first = arguments.size();
  for (uint32_t k = 0; k < i.operands.count; ++k) arguments.push_back(operand(i, k));
  for (const IlNested& nested : tree_.list(i.nested)) {
    Value value = runList(nested.list, true);
    IlInstruction reader = i;
    reader.loc = arguments[first + nested.operand].loc;
    require(value, reader);
    arguments[first + nested.operand].value = take(value, reader.loc);
  }
}

void IlScheduler::function(const IlInstruction& i) {
  const Signature signature = signatures_.of(i.callee);
  if ((i.flags & kIlDeferred) != 0) {
    open_.push_back({i, std::exchange(acc_, {})});
    if (!i.operands.empty()) acc_ = valueOf(operand(i, 0).value, i.loc);
    return;
  }
  std::vector<Argument> arguments;
  uint16_t height = 1;
  const bool block = signature.kind == SignatureKind::Instance && (i.flags & kIlFormal) != 0;
  if (block) {  // timer(IN := a): CAL without the keyword
    keepOrDrop();
  } else if (takesAccumulator(signatures_, i)) {
    // Undeclared names get no second report.
    const bool listed =
        acc_.state == State::Empty && ((i.flags & kIlInParens) != 0 || signature.kind == SignatureKind::Unknown);
    if (!listed) {
      require(acc_, i);
      height = acc_.height;
      arguments.push_back({{}, take(acc_, i.loc), false, false, i.loc});
    }
  } else {
    drop();
  }
  fillNested(i, arguments);
  const Value result = called(i.callee, arguments, i.loc, height);
  if (block) return callStatement(result.expr);
  const bool known = signature.kind == SignatureKind::Function || signature.kind == SignatureKind::Method;
  if (known && !signature.has_result) {
    acc_ = {};
    return callStatement(result.expr);
  }
  acc_ = result;
  limit(acc_);
}

void IlScheduler::call(const IlInstruction& i) {
  const auto make = [&] {
    std::vector<Argument> arguments;
    fillNested(i, arguments);
    return called(i.callee, arguments, i.loc, 1);
  };
  if ((i.flags & kIlConditional) != 0) {
    require(acc_, i);
    ExprId condition = use(i);
    if ((i.flags & kIlNegated) != 0) condition = build_.unary(UnaryOp::Not, condition, i.loc);
    conditional(condition, i.loc, [&] { callStatement(make().expr); });
    return;
  }
  if (signatures_.of(i.callee).has_result) {
    drop();
    acc_ = make();
    return;
  }
  keepOrDrop();
  callStatement(make().expr);
}

void IlScheduler::jump(const IlInstruction& i) {
  const bool conditioned = (i.flags & kIlConditional) != 0;
  if (conditioned) require(acc_, i);
  const StmtId statement = build_.jump(i.target, i.loc);
  const uint32_t target = flow_->labelOf(names_, i.target);
  NameId temporary;
  if (target != kNoInstruction && isLive(target)) {
    if (!flow_->temporary[target]) flow_->temporary[target] = newTemporary(i.loc);
    temporary = flow_->temporary[target];
  }
  // Sets the temporary that the reader after the label reads.
  const auto bring = [&] {
    if (acc_.state == State::Empty) empty_ways_.push_back({target, i.loc});
    if (acc_.state == State::Known && acc_.temporary != temporary)
      assign(build_.name(temporary, i.loc), take(acc_, i.loc), i.loc);
  };
  if (!conditioned) {
    if (temporary)
      bring();
    else
      drop();
    emit(statement);
    acc_ = {};
    falls_ = false;
    return;
  }
  if (temporary) {
    if (isLive(at_ + 1)) spill(acc_);
    bring();
    if (!acc_.constant && !acc_.temporary) {
      acc_.expr = {};
      acc_.temporary = temporary;
    }
  }
  ExprId condition = use(i);
  if ((i.flags & kIlNegated) != 0) condition = build_.unary(UnaryOp::Not, condition, i.loc);
  conditional(condition, i.loc, [&] { out_.push_back(statement); });
}

void IlScheduler::leave(const IlInstruction& i) {
  const bool conditioned = (i.flags & kIlConditional) != 0;
  const auto make = [&] { return build_.returnStatement(i.loc); };
  if (!conditioned) {
    drop();
    emit(make());
    falls_ = false;
    return;
  }
  require(acc_, i);
  ExprId condition = use(i);
  if ((i.flags & kIlNegated) != 0) condition = build_.unary(UnaryOp::Not, condition, i.loc);
  conditional(condition, i.loc, [&] { out_.push_back(make()); });
}

ScheduledBody IlScheduler::run(Slice<IlInstruction> list) {
  runList(list, false);
  structureJumps(tree_, names_, out_);
  return scheduledBody(tree_, out_, temporaries_);
}

}  // namespace

ScheduledBody scheduleIl(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                         Slice<IlInstruction> instructions, bool short_circuit) {
  return IlScheduler(tree, names, diagnostics, signatures, short_circuit).run(instructions);
}

}  // namespace rung::text

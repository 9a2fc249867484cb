// SPDX-License-Identifier: Apache-2.0
// Lowering of statements and of a whole POU. In: a checked body. Out: the statements of an ir::Body. An assignment
// evaluates the calls of its right side first, then the place, then stores: `a[i] := f()` uses the `i` that `f` left.
#include <utility>

#include "frontend/source/dialect.h"
#include "ir/lower/lowering.h"
#include "sema/declarations/constants.h"
#include "sema/intermediate.h"

namespace rung::ir {

void StatementLowering::lowerPou() {
  const sema::Pou& pou = project_.pou(pou_);
  enterBody();
  // Locals of a call, output parameters included, start from their initial values.
  for (sema::VarId id : pou.vars) {
    const sema::Var& var = project_.var(id);
    if (var.storage != sema::Storage::Local || var.sharing.field) continue;
    if (var.section == SectionKind::InOut || var.open_array.hidden_input || var.temporary != 0 ||
        types_.isOpenArray(var.type))
      continue;
    if (var.section == SectionKind::Input) {
      // The caller's variable stays unchanged: a body that writes a by-reference input writes a copy, made here.
      uint32_t& index = state_.local_of[var.field];
      if (var.used.writes == 0 || !body_.locals[index - 1].by_reference) continue;
      const TypeId type = strip(var.type);
      const ExprId own = temp(type, var.loc);
      // The unit after the last character, as in ObjectLowering::storeInitial.
      if (types::TypeTable::isString(types_.kind(type))) assign(copy(own), zero(type, var.loc), var.loc);
      assign(own, local(index - 1, var.loc), var.loc);
      index = *localOf(body_.expr(own)) + 1;
      continue;
    }
    const sema::Var& declared = var.sharing.copy_of ? project_.var(var.sharing.copy_of) : var;
    objects().storeInitial(local(state_.local_of[var.field] - 1, var.loc), strip(var.type), declared.init, false);
  }
  if (state_.result_local != kNoBit) {
    const Local& result = body_.locals[state_.result_local];
    objects().storeInitial(local(state_.result_local, result.loc), result.type, {}, false);
  }
  detectEdges();
  lowerStatements(pou.body.code);
  leaveBody(pou.loc);
  body_.first = build_.block().first;
}

// An R_EDGE or F_EDGE pin is TRUE inside the block for the one call in which the input has changed (ed. 3 table 12).
void StatementLowering::detectEdges() {
  for (sema::VarId id : project_.pou(pou_).vars) {
    const sema::Var& var = project_.var(id);
    if (!var.memory.edge) continue;
    auto input = [&] { return field(self(var.loc), var.field, types::kBool, var.loc); };
    auto memory = [&] { return field(self(var.loc), project_.var(var.memory.edge).field, types::kBool, var.loc); };
    auto inverse = [&](ExprId value) { return unary(Op::Not, types::kBool, value, var.loc); };
    bool rising = var.edge == EdgeKind::Rising;
    ExprId edge = temp(types::kBool, var.loc);
    const uint32_t edge_local = *localOf(body_.expr(edge));
    assign(edge,
           binary(Op::And, types::kBool, rising ? input() : inverse(input()), rising ? inverse(memory()) : memory(),
                  var.loc),
           var.loc);
    assign(memory(), input(), var.loc);
    state_.edge_locals.push_back({id.index, edge_local});
  }
}

void StatementLowering::lowerStatements(Slice<rung::StmtId> statements) {
  for (uint32_t i = 0; i < statements.count; ++i) lowerStatement(tree_.list(statements)[i]);
}

void StatementLowering::lowerStatement(rung::StmtId id) {
  Loc loc = tree_.loc(id);
  switch (tree_.kind(id)) {
    case rung::StmtKind::Empty: return;
    case rung::StmtKind::Assign: return lowerAssign(tree_.as<rung::AssignStmt>(id));
    case rung::StmtKind::Call: {
      const rung::ExprId call = tree_.as<rung::CallStmt>(id).call;
      if (tree_.kind(call) != rung::ExprKind::Call) return;  // a known value: nothing happens
      ExprId value = calls().lowerCall(call);
      // A pure call as a statement has no effect; only its faults count.
      if (value && mayFault(value)) append(loc, EvaluateStmt{.value = value});
      return;
    }
    case rung::StmtKind::If: return lowerIf(tree_.as<rung::IfStmt>(id));
    case rung::StmtKind::Case: return lowerCase(tree_.as<CaseStmt>(id));
    case rung::StmtKind::For: return lowerFor(tree_.as<rung::ForStmt>(id));
    case rung::StmtKind::While: return lowerWhile(tree_.as<WhileStmt>(id));
    case rung::StmtKind::Repeat: return lowerRepeat(tree_.as<RepeatStmt>(id));
    case rung::StmtKind::Try: return lowerTry(tree_.as<rung::TryStmt>(id));
    case rung::StmtKind::Exit: append(loc, BreakStmt{}); return;
    case rung::StmtKind::Continue: append(loc, ContinueStmt{}); return;
    case rung::StmtKind::Return:
      leaveBody(loc);
      append(loc, ReturnStmt{});
      return;
    case rung::StmtKind::Jump:
      append(loc, JumpStmt{.label = labelNumber(tree_.as<rung::JumpStmt>(id).label.name)});
      return;
    case rung::StmtKind::Label:
      append(loc, LabelStmt{.label = labelNumber(tree_.as<rung::LabelStmt>(id).label.name)});
      return;
    case rung::StmtKind::Error: break;
  }
  RUNG_INVARIANT(false, "a statement with an error is not lowered");
}

uint32_t StatementLowering::labelNumber(NameId label) {
  body_.has_labels = true;
  const auto next = static_cast<uint32_t>(body_.labels.size());
  const auto [known, is_new] = state_.label_numbers.emplace(project_.names.key(label).index, next);
  if (is_new) body_.labels.push_back(label);
  return known->second;
}

// The call that an assignment stores: it may write its result directly into the target, and EN guards the whole
// assignment. None: the value is something else.
rung::ExprId StatementLowering::assignedCall(const rung::AssignStmt& stmt) const {
  rung::ExprId source = stmt.value;
  if (tree_.kind(source) == rung::ExprKind::Convert) {
    const rung::ExprId operand = tree_.as<rung::ConvertExpr>(source).operand;
    const bool same = strip(sema::typeOf(tree_, source)) == strip(sema::typeOf(tree_, stmt.target));
    const bool string = TypeTable::isString(types_.kind(sema::typeOf(tree_, operand)));  // the assignment cuts it
    if (same || string) source = operand;
  }
  return tree_.kind(source) == rung::ExprKind::Call ? source : rung::ExprId{};
}

void StatementLowering::lowerStore(const rung::AssignStmt& stmt) {
  const Loc loc = stmt.h.loc;
  if (tree_.kind(stmt.target) == rung::ExprKind::Call) {  // SET of a property
    calls().lowerCall(stmt.target);
    return;
  }
  const rung::ExprId call = assignedCall(stmt);
  if (call && (TypeTable::isString(types_.kind(sema::typeOf(tree_, call))) || !calls().isPlainCall(call))) {
    Target target{.expr = stmt.target, .early = places().isPlainPlace(stmt.target)};
    ExprId value = calls().lowerCall(call, &target);
    if (target.stored) return;
    const ExprId place = lowerAfter({&value}, [&] { return calls().placeOf(target); });
    assign(place, convertValue(value, typeOf(place), loc), loc);
    return;
  }
  ExprId value = values().lowerValue(stmt.value);
  const ExprId target = lowerAfter({&value}, [&] { return places().lowerPlace(stmt.target); });
  assign(target, convertValue(value, typeOf(target), loc), loc);
}

// x += y
void StatementLowering::lowerUpdate(const rung::AssignStmt& stmt, Op op) {
  const Loc loc = stmt.h.loc;
  const TypeId wide = op == Op::Div ? sema::uncutType(project_, stmt.value) : TypeId{};
  ExprId value = values().lowerOperand(stmt.value, wide);
  const ExprId target = stable(lowerAfter({&value}, [&] { return places().lowerPlace(stmt.target); }));
  const TypeId type = wide ? wide : typeOf(target);
  const ExprId operand = convertValue(copy(target), type, loc);
  assign(target,
         convertValue(arithmetic(binary(op, type, operand, convertValue(value, type, loc), loc)), typeOf(target), loc),
         loc);
}

void StatementLowering::lowerAssign(const rung::AssignStmt& stmt) {
  const Loc loc = stmt.h.loc;
  switch (stmt.op()) {
    case AssignOp::Assign: return lowerStore(stmt);
    case AssignOp::Set:
    case AssignOp::Reset: {
      const ExprId condition = values().lowerValue(stmt.value);
      const StmtId then =
          block([&] { assign(places().lowerPlace(stmt.target), constantBool(stmt.op() == AssignOp::Set, loc), loc); });
      append(loc, IfStmt{.condition = condition, .then_block = then});
      return;
    }
    case AssignOp::Add: return lowerUpdate(stmt, Op::Add);
    case AssignOp::Subtract: return lowerUpdate(stmt, Op::Sub);
    case AssignOp::Multiply: return lowerUpdate(stmt, Op::Mul);
    case AssignOp::Divide: return lowerUpdate(stmt, Op::Div);
    case AssignOp::Attempt: break;  // sema made a call of it
    case AssignOp::Reference: {     // sema made the value an address
      ExprId value = values().lowerValue(stmt.value);
      const ExprId target = lowerAfter({&value}, [&] { return places().lowerPlace(stmt.target); });
      assign(target, value, loc);
      return;
    }
  }
}

void StatementLowering::lowerIf(const rung::IfStmt& stmt) {
  lowerIfFrom(tree_.list(stmt.branches), stmt.otherwise, stmt.h.loc);
}

// ELSIF nests in the else block; a loop, not a recursion, so that a thousand of them need no deep stack.
void StatementLowering::lowerIfFrom(std::span<const IfBranch> branches, Slice<rung::StmtId> otherwise, Loc loc) {
  struct Level {
    Block outer;
    StmtId branch;
  };
  std::vector<Level> levels;
  for (size_t i = 0; i < branches.size(); ++i) {
    if (i > 0) {
      const StmtId branch = build_.block().last;
      levels.push_back({build_.open(), branch});
      loc = tree_.loc(branches[i].condition);
    }
    ExprId condition = values().lowerValue(branches[i].condition);
    StmtId then = block([&] { lowerStatements(branches[i].body); });
    append(loc, IfStmt{.condition = condition, .then_block = then});
  }
  StmtId last = build_.block().last;
  StmtId otherwise_block = block([&] { lowerStatements(otherwise); });
  body_.stmt(last).as<IfStmt>().else_block = otherwise_block;
  while (!levels.empty()) {
    const StmtId first = build_.close(levels.back().outer);
    body_.stmt(levels.back().branch).as<IfStmt>().else_block = first;
    levels.pop_back();
  }
}

void StatementLowering::lowerCase(const CaseStmt& stmt) {
  ExprId selector = values().lowerUncut(stmt.selector);
  std::vector<Case> cases;
  for (const CaseBranch& branch : tree_.list(stmt.branches)) {
    StmtId body = block([&] { lowerStatements(branch.body); });
    Case created{{static_cast<uint32_t>(body_.ranges.size()), 0}, body};
    for (rung::ExprId label : tree_.list(branch.labels)) {
      rung::ExprId low = label, high = label;
      if (tree_.kind(label) == rung::ExprKind::Range) {
        low = tree_.as<RangeExpr>(label).low;
        high = tree_.as<RangeExpr>(label).high;
      }
      auto from = sema::constantOf(project_, low), to = sema::constantOf(project_, high);
      RUNG_INVARIANT(from && to, "a CASE label is constant");
      body_.ranges.push_back({from->asSigned(), to->asSigned()});
      ++created.ranges.count;
    }
    cases.push_back(created);
  }
  StmtId otherwise = block([&] { lowerStatements(stmt.otherwise); });
  uint32_t first = static_cast<uint32_t>(body_.cases.size());
  body_.cases.insert(body_.cases.end(), cases.begin(), cases.end());
  append(
      stmt.h.loc,
      SwitchStmt{.selector = selector, .cases = {first, static_cast<uint32_t>(cases.size())}, .else_block = otherwise});
}

void StatementLowering::lowerFor(const rung::ForStmt& stmt) {
  Loc loc = stmt.h.loc;
  ExprId control = stable(places().lowerPlace(stmt.control));
  TypeId type = typeOf(control), plain = types_.plain(type);
  std::optional<Value> step = Value{plain, 1};
  if (stmt.step) step = sema::constantOf(project_, stmt.step);
  ExprId from = convertValue(values().lowerValue(stmt.from), type, loc);
  Limit limit;
  const Block outer = build_.open();
  limit.value = convertValue(values().lowerValue(stmt.to), type, loc);
  limit.statements = build_.block();
  build_.close(outer);
  const Block body = lowerBlock(stmt.body);
  const bool once = !profile().for_end_in_each_turn || types_.kind(type) == TypeKind::Subrange;
  limit.is_variable = !once && !isConst(body_.expr(limit.value));
  if (!limit.is_variable && limit.statements.first) {
    if (!isStable(from)) from = toTemp(from, loc);
    link(std::exchange(limit.statements, {}));
  }
  // An unsigned variable that counts down by a constant (codesys) needs the test of the direction, like an unknown
  // step: the step keeps its sign, and the loop stops before the variable wraps.
  if (stmt.step &&
      types_.isSigned(types_.plainKind(sema::typeOf(tree_, stmt.step))) != types_.isSigned(types_.kind(plain)))
    step.reset();
  if (types_.kind(type) == TypeKind::Subrange) return lowerForOfSubrange(stmt, control, from, limit.value, step, body);
  if (!step) return lowerForWithVariableStep(stmt, control, from, limit, [&] { link(body); });
  if (limit.is_variable) return lowerForWithVariableLimit(control, from, limit, *step, body, loc);
  append(loc, ForStmt{.control = control,
                      .from = from,
                      .to = limit.value,
                      .step = constant(type, step->bits, loc),
                      .body_block = body.first});
}

Block StatementLowering::lowerBlock(Slice<rung::StmtId> statements) {
  const Block outer = build_.open();
  lowerStatements(statements);
  const Block lowered = build_.block();
  build_.close(outer);
  return lowered;
}

// Appends statements that were lowered before.
void StatementLowering::link(Block statements) {
  if (!statements.first) return;
  Block& open = build_.block();
  if (open.last)
    body_.stmt(open.last).next = statements.first;
  else
    open.first = statements.first;
  open.last = statements.last;
}

// codesys: the end value is evaluated before every turn. The loop counts to the limit of the type, and leaves as soon
// as the control variable is past the end value.
void StatementLowering::lowerForWithVariableLimit(ExprId control, ExprId from, const Limit& limit, const Value& step,
                                                  Block body, Loc loc) {
  const TypeId type = typeOf(control);
  const TypeKind kind = types_.plainKind(type);
  const bool is_signed = types_.isSigned(kind), upward = !is_signed || step.asSigned() > 0;
  const uint64_t highest = ~uint64_t{0} >> (64 - TypeTable::bitWidth(kind) + (is_signed ? 1 : 0));
  const uint64_t last = upward ? highest : ~highest;
  const StmtId block_of = block([&] {
    link(limit.statements);
    const StmtId leave = block([&] { append(loc, BreakStmt{}); });
    append(loc, IfStmt{.condition = binary(upward ? Op::Gt : Op::Lt, types::kBool, copy(control), limit.value, loc),
                       .then_block = leave});
    link(body);
  });
  const StmtId loop = append(loc, ForStmt{.control = control,
                                          .from = from,
                                          .to = constant(type, last, loc),
                                          .step = constant(type, step.bits, loc),
                                          .body_block = block_of});
  if (!limit.statements.first) in_.variable_limits.push_back({in_.bodyOf(pou_), loop});
}

// FOR with a control variable of a subrange type counts in the plain type, since the first value that fails the test
// may be outside the subrange. Then the variable is left at the limit.
void StatementLowering::lowerForOfSubrange(const rung::ForStmt& stmt, ExprId control, ExprId from, ExprId to,
                                           const std::optional<Value>& step, Block statements) {
  Loc loc = stmt.h.loc;
  TypeId type = typeOf(control), plain = types_.plain(type);
  ExprId count = temp(plain, loc);
  ExprId first = toTemp(convertValue(from, plain, loc), loc), last = toTemp(convertValue(to, plain, loc), loc);
  auto store = [&](ExprId value) {  // in range: no check, no saturation
    append(loc, AssignStmt{.place = copy(control), .value = add(loc, type, ConvertExpr{.operand = value})});
  };
  auto iteration = [&] {
    store(copy(count));
    link(statements);
  };
  if (step) {
    StmtId body = block(iteration);
    append(loc, ForStmt{.control = copy(count),
                        .from = first,
                        .to = copy(last),
                        .step = constant(plain, step->bits, loc),
                        .body_block = body});
  } else {
    lowerForWithVariableStep(stmt, copy(count), first, {.statements = {}, .value = copy(last)}, iteration);
  }
  const TypeInfo& range = types_.info(type);
  auto bound = [&](int64_t value) { return constant(plain, static_cast<uint64_t>(value), loc); };
  ExprId outside = binary(Op::Or, types::kBool, binary(Op::Lt, types::kBool, copy(count), bound(range.low), loc),
                          binary(Op::Gt, types::kBool, copy(count), bound(range.high), loc), loc);
  StmtId at_limit = block([&] { store(last); });
  StmtId past = block([&] { store(count); });
  append(loc, IfStmt{.condition = outside, .then_block = at_limit, .else_block = past});
}

// FOR with a step that is only known at run time: the direction is tested in each iteration, and the loop ends when the
// next value does not fit the type.
void StatementLowering::lowerForWithVariableStep(const rung::ForStmt& stmt, ExprId control, ExprId from,
                                                 const Limit& limit, FunctionRef<void()> iteration) {
  Loc loc = stmt.h.loc;
  TypeId type = typeOf(control);
  from = toTemp(from, loc);
  const ExprId to = limit.is_variable ? temp(type, loc) : toTemp(limit.value, loc);
  ExprId step = toTemp(values().lowerValue(stmt.step), loc);
  TypeId step_type = typeOf(step);  // of an unsigned variable perhaps the signed type of its width
  assign(copy(control), from, loc);
  bool is_signed = types_.isSigned(types_.plainKind(step_type));
  ExprId upward = toTemp(
      is_signed ? binary(Op::Ge, types::kBool, copy(step), constant(step_type, 0, loc), loc) : constantBool(true, loc),
      loc);
  step = toTemp(convertValue(step, type, loc), loc);
  ExprId next = temp(type, loc);
  StmtId leave = block([&] { append(loc, BreakStmt{}); });
  auto comparison = [&](Op op, ExprId left, ExprId right) {
    return binary(op, types::kBool, copy(left), copy(right), loc);
  };
  auto chosen = [&](ExprId when_up, ExprId when_down) {
    return add(loc, types::kBool, SelectExpr{.condition = copy(upward), .when_true = when_up, .when_false = when_down});
  };
  StmtId body = block([&] {
    if (limit.is_variable) {
      link(limit.statements);
      assign(copy(to), limit.value, loc);
    }
    ExprId past = chosen(comparison(Op::Gt, control, to), comparison(Op::Lt, control, to));
    append(loc, IfStmt{.condition = past, .then_block = leave});
    iteration();
  });
  StmtId advance = block([&] {
    assign(copy(next), binary(Op::Add, type, copy(control), step, loc), loc);
    ExprId wrapped = chosen(comparison(Op::Lt, next, control), comparison(Op::Gt, next, control));
    StmtId stop = block([&] {
      assign(copy(control), to, loc);
      append(loc, BreakStmt{});
    });
    append(loc, IfStmt{.condition = wrapped, .then_block = stop});
    assign(control, next, loc);
  });
  append(loc, LoopStmt{.body_block = body, .next_block = advance});
}

void StatementLowering::lowerWhile(const WhileStmt& stmt) {
  Loc loc = stmt.h.loc;
  StmtId body = block([&] {
    ExprId condition = values().lowerValue(stmt.condition);
    StmtId leave = block([&] { append(loc, BreakStmt{}); });
    append(loc, IfStmt{.condition = unary(Op::Not, types::kBool, condition, loc), .then_block = leave});
    lowerStatements(stmt.body);
  });
  append(loc, LoopStmt{.body_block = body});
}

void StatementLowering::lowerRepeat(const RepeatStmt& stmt) {
  Loc loc = tree_.loc(stmt.until);
  StmtId body = block([&] { lowerStatements(stmt.body); });
  StmtId test = block([&] {
    ExprId condition = values().lowerValue(stmt.until);
    StmtId leave = block([&] { append(loc, BreakStmt{}); });
    append(loc, IfStmt{.condition = condition, .then_block = leave});
  });
  append(stmt.h.loc, LoopStmt{.body_block = body, .next_block = test});
}

// The number of a fault in CODESYS's runtime: the items of __SYSTEM.ExceptionCode.
static uint32_t exceptionCode(types::Fault fault) {
  switch (fault) {
    case types::Fault::None: return 0;
    case types::Fault::Div: return 0x102;       // RTSEXCPT_DIVIDEBYZERO
    case types::Fault::Index: return 0x101;     // RTSEXCPT_ARRAYBOUNDS
    case types::Fault::Null: return 0x51;       // RTSEXCPT_ACCESS_VIOLATION
    case types::Fault::Overflow: return 0x103;  // RTSEXCPT_OVERFLOW
    case types::Fault::Cast:
    case types::Fault::Subrange:
    case types::Fault::Convert:
    case types::Fault::Lock:
    case types::Fault::Stack:
    case types::Fault::Stop: break;
  }
  return 0xffffffff;  // RTSEXCPT_UNKNOWN
}

void StatementLowering::lowerTry(const rung::TryStmt& stmt) {
  const Loc loc = stmt.h.loc;
  StmtId body = block([&] { lowerStatements(stmt.body); });
  ExprId number = stmt.code ? temp(types::kDInt, loc) : ExprId{};
  StmtId handler = block([&] {
    if (number) {
      ExprId code = constant(types::kUDInt, exceptionCode(types::Fault::Cast), loc);
      for (types::Fault fault : {types::Fault::Div, types::Fault::Index, types::Fault::Null, types::Fault::Overflow}) {
        ExprId is_it =
            binary(Op::Eq, types::kBool, copy(number), constant(types::kDInt, static_cast<uint64_t>(fault), loc), loc);
        ExprId own = constant(types::kUDInt, exceptionCode(fault), loc);
        code = add(loc, types::kUDInt, SelectExpr{.condition = is_it, .when_true = own, .when_false = code});
      }
      ExprId place = places().lowerPlace(stmt.code);
      assign(place, convertValue(code, typeOf(place), loc), loc);
    }
    lowerStatements(stmt.handler);
  });
  StmtId finally = block([&] { lowerStatements(stmt.finally); });
  append(loc, TryStmt{.body_block = body,
                      .catch_block = handler,
                      .finally_block = finally,
                      .number = number,
                      .catches = stmt.catches});
}

}  // namespace rung::ir

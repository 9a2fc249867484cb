// Lowering of statements and of a whole POU. In: a checked body. Out: the statements of an ir::Body. An assignment
// evaluates the calls of its right side first, then the place, then stores: `a[i] := f()` uses the `i` that `f` left.
#include "ir/lower/lowering.h"

namespace rung::ir {

void BodyLowering::lowerPou() {
  const sema::Pou& pou = project_.pou(pou_);
  // Locals of a call, output parameters included, start from their initial values.
  for (sema::VarId id : pou.vars) {
    const sema::Var& var = project_.var(id);
    if (var.storage != sema::Storage::Local) continue;
    if (var.section == SectionKind::InOut || var.open_array.hidden_input || var.temporary != 0 ||
        types_.isOpenArray(var.type))
      continue;
    if (var.section == SectionKind::Input) {
      // The caller's variable stays unchanged: a body that writes a by-reference input writes a copy, made here.
      uint32_t& index = local_of_[var.field];
      if (!var.use.written || !body_.locals[index - 1].by_reference) continue;
      ExprId copy = temp(strip(var.type), var.loc);
      assign(copy, local(index - 1, var.loc), var.loc);
      index = *localOf(body_.expr(copy)) + 1;
      continue;
    }
    storeInitial(local(local_of_[var.field] - 1, var.loc), strip(var.type), var.init, false);
  }
  if (result_local_ != kNoBit) {
    const Local& result = body_.locals[result_local_];
    storeInitial(local(result_local_, result.loc), result.type, {}, false);
  }
  detectEdges();
  lowerStatements(tree_.as<PouDecl>(pou.decl).body);
  body_.first = build_.block().first;
}

// An R_EDGE or F_EDGE pin is TRUE inside the block for the one call in which the input has changed (ed. 3 table 12).
void BodyLowering::detectEdges() {
  for (sema::VarId id : project_.pou(pou_).vars) {
    const sema::Var& var = project_.var(id);
    if (!var.edge_memory) continue;
    auto input = [&] { return field(self(var.loc), var.field, types::kBool, var.loc); };
    auto memory = [&] { return field(self(var.loc), project_.var(var.edge_memory).field, types::kBool, var.loc); };
    auto inverse = [&](ExprId value) { return unary(Op::Not, types::kBool, value, var.loc); };
    bool rising = var.edge == EdgeKind::Rising;
    ExprId edge = temp(types::kBool, var.loc);
    const uint32_t edge_local = *localOf(body_.expr(edge));
    assign(edge,
           binary(Op::And, types::kBool, rising ? input() : inverse(input()), rising ? inverse(memory()) : memory(),
                  var.loc),
           var.loc);
    assign(memory(), input(), var.loc);
    edge_locals_.push_back({id.index, edge_local});
  }
}

void BodyLowering::lowerStatements(Slice<rung::StmtId> statements) {
  for (uint32_t i = 0; i < statements.count; ++i) lowerStatement(tree_.list(statements)[i]);
}

void BodyLowering::lowerStatement(rung::StmtId id) {
  Loc loc = tree_.loc(id);
  switch (tree_.kind(id)) {
    case rung::StmtKind::Empty: return;
    case rung::StmtKind::Assign: return lowerAssign(tree_.as<rung::AssignStmt>(id));
    case rung::StmtKind::Call: {
      const rung::ExprId call = tree_.as<rung::CallStmt>(id).call;
      if (tree_.kind(call) != rung::ExprKind::Call) return;  // a known value: nothing happens
      ExprId value = lowerCall(call);
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
    case rung::StmtKind::Return: append(loc, ReturnStmt{}); return;
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

uint32_t BodyLowering::labelNumber(NameId label) {
  body_.has_labels = true;
  const auto next = static_cast<uint32_t>(body_.labels.size());
  const auto [known, is_new] = label_numbers_.emplace(project_.names.key(label).index, next);
  if (is_new) body_.labels.push_back(label);
  return known->second;
}

void BodyLowering::lowerAssign(const rung::AssignStmt& stmt) {
  Loc loc = stmt.h.loc;
  switch (stmt.effect()) {
    case AssignOp::Assign: {
      if (tree_.kind(stmt.target) == rung::ExprKind::Call) {  // SET of a property
        lowerCall(stmt.target);
        return;
      }
      rung::ExprId source = stmt.value;
      // A call may write its result directly into the target, and EN guards the whole assignment.
      if (tree_.kind(source) == rung::ExprKind::Convert) {
        rung::ExprId operand = tree_.as<rung::ConvertExpr>(source).operand;
        bool same = strip(tree_.expr(source).type) == strip(tree_.expr(stmt.target).type);
        bool string = TypeTable::isString(types_.kind(tree_.expr(operand).type));  // the assignment itself cuts it
        if (tree_.kind(operand) == rung::ExprKind::Call && (same || string)) source = operand;
      }
      if (tree_.kind(source) == rung::ExprKind::Call) {
        bool string = TypeTable::isString(types_.kind(tree_.expr(source).type));
        if (string || !isPlainCall(source)) {
          Target target{.expr = stmt.target, .early = isPlainPlace(stmt.target)};
          ExprId value = lowerCall(source, &target);
          if (target.stored) return;
          ExprId place = lowerAfter({&value}, [&] { return placeOf(target); });
          assign(place, convertValue(value, typeOf(place), loc), loc);
          return;
        }
      }
      ExprId value = lowerValue(stmt.value);
      ExprId target = lowerAfter({&value}, [&] { return lowerPlace(stmt.target); });
      assign(target, convertValue(value, typeOf(target), loc), loc);
      return;
    }
    case AssignOp::Set:
    case AssignOp::Reset: {
      ExprId condition = lowerValue(stmt.value);
      StmtId then =
          block([&] { assign(lowerPlace(stmt.target), constantBool(stmt.effect() == AssignOp::Set, loc), loc); });
      append(loc, IfStmt{.condition = condition, .then_block = then});
      return;
    }
    case AssignOp::Add:
    case AssignOp::Subtract:
    case AssignOp::Multiply:
    case AssignOp::Divide: {
      Op op = stmt.effect() == AssignOp::Add        ? Op::Add
              : stmt.effect() == AssignOp::Subtract ? Op::Sub
              : stmt.effect() == AssignOp::Multiply ? Op::Mul
                                                    : Op::Div;
      ExprId value = lowerValue(stmt.value);
      ExprId target = stable(lowerAfter({&value}, [&] { return lowerPlace(stmt.target); }));
      TypeId type = typeOf(target);
      assign(target, binary(op, type, target, convertValue(value, type, loc), loc), loc);
      return;
    }
    case AssignOp::Attempt: break;  // sema made a call of it
    case AssignOp::Reference: {     // sema made the value an address
      ExprId value = lowerValue(stmt.value);
      ExprId target = lowerAfter({&value}, [&] { return lowerPlace(stmt.target); });
      assign(target, value, loc);
      return;
    }
  }
}

void BodyLowering::lowerIf(const rung::IfStmt& stmt) {
  lowerIfFrom(tree_.list(stmt.branches), stmt.otherwise, stmt.h.loc);
}

// ELSIF nests in the else block; a loop, not a recursion, so that a thousand of them need no deep stack.
void BodyLowering::lowerIfFrom(std::span<const IfBranch> branches, Slice<rung::StmtId> otherwise, Loc loc) {
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
    ExprId condition = lowerValue(branches[i].condition);
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

void BodyLowering::lowerCase(const CaseStmt& stmt) {
  ExprId selector = lowerValue(stmt.selector);
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
      auto from = constantOf(project_, low), to = constantOf(project_, high);
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

void BodyLowering::lowerFor(const rung::ForStmt& stmt) {
  Loc loc = stmt.h.loc;
  ExprId control = stable(lowerPlace(stmt.control));
  TypeId type = typeOf(control), plain = types_.plain(type);
  std::optional<Value> step = Value{plain, 1};
  if (stmt.step) step = constantOf(project_, stmt.step);
  ExprId from = lowerValue(stmt.from);
  ExprId to = lowerAfter({&from}, [&] { return lowerValue(stmt.to); });
  from = convertValue(from, type, loc);
  to = convertValue(to, type, loc);
  // An unsigned variable that counts down by a constant (codesys) needs the test of the direction, like an unknown
  // step: the step keeps its sign, and the loop stops before the variable wraps.
  if (stmt.step && types_.isSigned(types_.plainKind(tree_.expr(stmt.step).type)) != types_.isSigned(types_.kind(plain)))
    step.reset();
  if (types_.kind(type) == TypeKind::Subrange) return lowerForOfSubrange(stmt, control, from, to, step);
  if (!step) return lowerForWithVariableStep(stmt, control, from, to, [&] { lowerStatements(stmt.body); });
  StmtId body = block([&] { lowerStatements(stmt.body); });
  append(
      loc,
      ForStmt{.control = control, .from = from, .to = to, .step = constant(type, step->bits, loc), .body_block = body});
}

// FOR with a control variable of a subrange type counts in the plain type, since the first value that fails the test
// may be outside the subrange. Then the variable is left at the limit.
void BodyLowering::lowerForOfSubrange(const rung::ForStmt& stmt, ExprId control, ExprId from, ExprId to,
                                      const std::optional<Value>& step) {
  Loc loc = stmt.h.loc;
  TypeId type = typeOf(control), plain = types_.plain(type);
  ExprId count = temp(plain, loc);
  ExprId first = toTemp(convertValue(from, plain, loc), loc), last = toTemp(convertValue(to, plain, loc), loc);
  auto store = [&](ExprId value) {  // in range: no check, no saturation
    append(loc, AssignStmt{.place = control, .value = add(loc, type, ConvertExpr{.operand = value})});
  };
  auto iteration = [&] {
    store(count);
    lowerStatements(stmt.body);
  };
  if (step) {
    StmtId body = block(iteration);
    append(
        loc,
        ForStmt{
            .control = count, .from = first, .to = last, .step = constant(plain, step->bits, loc), .body_block = body});
  } else {
    lowerForWithVariableStep(stmt, count, first, last, iteration);
  }
  const TypeInfo& range = types_.info(type);
  auto bound = [&](int64_t value) { return constant(plain, static_cast<uint64_t>(value), loc); };
  ExprId outside = binary(Op::Or, types::kBool, binary(Op::Lt, types::kBool, count, bound(range.low), loc),
                          binary(Op::Gt, types::kBool, count, bound(range.high), loc), loc);
  StmtId at_limit = block([&] { store(last); });
  StmtId past = block([&] { store(count); });
  append(loc, IfStmt{.condition = outside, .then_block = at_limit, .else_block = past});
}

// FOR with a step that is only known at run time: the direction is tested in each iteration, and the loop ends when the
// next value does not fit the type.
void BodyLowering::lowerForWithVariableStep(const rung::ForStmt& stmt, ExprId control, ExprId from, ExprId to,
                                            FunctionRef<void()> iteration) {
  Loc loc = stmt.h.loc;
  TypeId type = typeOf(control);
  from = toTemp(from, loc);
  to = toTemp(to, loc);
  ExprId step = toTemp(lowerValue(stmt.step), loc);
  TypeId step_type = typeOf(step);  // of an unsigned variable perhaps the signed type of its width
  assign(control, from, loc);
  bool is_signed = types_.isSigned(types_.plainKind(step_type));
  ExprId upward = toTemp(
      is_signed ? binary(Op::Ge, types::kBool, step, constant(step_type, 0, loc), loc) : constantBool(true, loc), loc);
  step = toTemp(convertValue(step, type, loc), loc);
  ExprId next = temp(type, loc);
  StmtId leave = block([&] { append(loc, BreakStmt{}); });
  auto chosen = [&](ExprId when_up, ExprId when_down) {
    return add(loc, types::kBool, SelectExpr{.condition = upward, .when_true = when_up, .when_false = when_down});
  };
  StmtId body = block([&] {
    ExprId past =
        chosen(binary(Op::Gt, types::kBool, control, to, loc), binary(Op::Lt, types::kBool, control, to, loc));
    append(loc, IfStmt{.condition = past, .then_block = leave});
    iteration();
  });
  StmtId advance = block([&] {
    assign(next, binary(Op::Add, type, control, step, loc), loc);
    ExprId wrapped =
        chosen(binary(Op::Lt, types::kBool, next, control, loc), binary(Op::Gt, types::kBool, next, control, loc));
    StmtId stop = block([&] {
      assign(control, to, loc);
      append(loc, BreakStmt{});
    });
    append(loc, IfStmt{.condition = wrapped, .then_block = stop});
    assign(control, next, loc);
  });
  append(loc, LoopStmt{.body_block = body, .next_block = advance});
}

void BodyLowering::lowerWhile(const WhileStmt& stmt) {
  Loc loc = stmt.h.loc;
  StmtId body = block([&] {
    ExprId condition = lowerValue(stmt.condition);
    StmtId leave = block([&] { append(loc, BreakStmt{}); });
    append(loc, IfStmt{.condition = unary(Op::Not, types::kBool, condition, loc), .then_block = leave});
    lowerStatements(stmt.body);
  });
  append(loc, LoopStmt{.body_block = body});
}

void BodyLowering::lowerRepeat(const RepeatStmt& stmt) {
  Loc loc = tree_.loc(stmt.until);
  StmtId body = block([&] { lowerStatements(stmt.body); });
  StmtId test = block([&] {
    ExprId condition = lowerValue(stmt.until);
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
    case types::Fault::Lock: break;
  }
  return 0xffffffff;  // RTSEXCPT_UNKNOWN
}

void BodyLowering::lowerTry(const rung::TryStmt& stmt) {
  const Loc loc = stmt.h.loc;
  StmtId body = block([&] { lowerStatements(stmt.body); });
  ExprId number = stmt.code ? temp(types::kDInt, loc) : ExprId{};
  StmtId handler = block([&] {
    if (number) {
      ExprId code = constant(types::kUDInt, exceptionCode(types::Fault::Cast), loc);
      for (types::Fault fault : {types::Fault::Div, types::Fault::Index, types::Fault::Null, types::Fault::Overflow}) {
        ExprId is_it =
            binary(Op::Eq, types::kBool, number, constant(types::kDInt, static_cast<uint64_t>(fault), loc), loc);
        ExprId own = constant(types::kUDInt, exceptionCode(fault), loc);
        code = add(loc, types::kUDInt, SelectExpr{.condition = is_it, .when_true = own, .when_false = code});
      }
      ExprId place = lowerPlace(stmt.code);
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

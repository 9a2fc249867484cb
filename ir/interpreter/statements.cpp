// SPDX-License-Identifier: Apache-2.0
// Statements of the translated code: see translate.h.
#include <algorithm>

#include "ir/assertion.h"
#include "ir/interpreter/translate.h"
#include "ir/walk.h"
#include "rung/code.h"

namespace rung::ir::interpreter {

namespace {

constexpr uint64_t kLargestTable = 1024;  // entries of a switch that is a table

}  // namespace

void BodyTranslator::block(StmtId first) {
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    const uint32_t before = top_;
    statement(body_->stmt(id));
    top_ = before;
  }
}

// Where the source of a statement begins: an assignment is at its `:=`, and its variable is in front of that.
Loc BodyTranslator::beginOf(const Stmt& stmt) const {
  Loc first = stmt.loc;
  if (const auto* assign = stmt.tryAs<AssignStmt>(); assign != nullptr && first) {
    forEachExpr(*body_, assign->place, [&](ExprId at) {
      const Loc loc = expr(at).loc;
      if (loc && loc.offset < first.offset) first = loc;
    });
  }
  return first;
}

void BodyTranslator::statement(const Stmt& stmt) {
  recordLocation(stmt.loc);
  if (stmt.kind != StmtKind::Label) recordPoint(beginOf(stmt));
  if (stmt.kind != StmtKind::Label) count(stmt.loc, nullptr);
  switch (stmt.kind) {
    case StmtKind::None: return;
    case StmtKind::Assign: return assign(stmt.as<AssignStmt>().place, stmt.as<AssignStmt>().value);
    case StmtKind::Bind: return bindStatement(stmt.as<BindStmt>());
    case StmtKind::Call: return callStatement(stmt.as<CallStmt>(), stmt.loc);
    case StmtKind::If: return ifStatement(stmt.as<IfStmt>(), stmt.loc);
    case StmtKind::Switch: return switchStatement(stmt.as<SwitchStmt>(), stmt.loc);
    case StmtKind::Loop: return loopStatement(stmt.as<LoopStmt>());
    case StmtKind::For: return forStatement(stmt.as<ForStmt>());
    case StmtKind::Break:
      if (!loops_.empty()) leaveTo(loops_.back().on_break, loops_.back().try_depth);
      return;
    case StmtKind::Continue:
      if (!loops_.empty()) leaveTo(loops_.back().on_continue, loops_.back().try_depth);
      return;
    case StmtKind::Return: return leaveTo(return_label_, 0);
    case StmtKind::Jump: {
      const UserLabel& to = user_labels_[stmt.as<JumpStmt>().label];
      return leaveTo(to.label, to.try_depth);
    }
    case StmtKind::Label:
      place(user_labels_[stmt.as<LabelStmt>().label].label);
      countStep();
      return;
    case StmtKind::Try: return tryStatement(stmt.as<TryStmt>());
    case StmtKind::Fault: return faultStatement(stmt.as<FaultStmt>(), stmt.loc);
    case StmtKind::Assert: return assertStatement(stmt);
    case StmtKind::Evaluate: return evaluate(stmt.as<EvaluateStmt>().value);
  }
}

void BodyTranslator::bindStatement(const BindStmt& stmt) {
  const Address to = fieldMemory(expr(stmt.field));
  if (!stmt.place) return write(to, Scalar::U64, {Mode::Constant, {}, 0});
  const Address variable = isString(expr(stmt.field).type) ? string(stmt.place) : place(stmt.place);
  write(to, Scalar::U64, {Mode::Frame, pointerTo(variable), 0});
}

void BodyTranslator::ifStatement(const IfStmt& stmt, Loc loc) {
  const Label otherwise = newLabel();
  branch(stmt.condition, false, otherwise);
  countBranch(loc, 1);
  block(stmt.then_block);
  if (!stmt.else_block && !countsBranches(loc)) return place(otherwise);
  const Label end = newLabel();
  jump(end);
  place(otherwise);
  countBranch(loc, 2);
  block(stmt.else_block);
  place(end);
}

void BodyTranslator::faultStatement(const FaultStmt& stmt, Loc loc) {
  Operand shown = temp();
  if (stmt.value)
    shown = wideBits(stmt.value);
  else
    move(Scalar::U64, {}, shown);
  const bool open_array = stmt.fault == types::Fault::Index;  // low above high: unknown
  emit(raiseHandler(), {static_cast<uint32_t>(stmt.fault), false}, shown.ref, {},
       open_array ? site(loc, 1, 0) : site(loc));
}

void BodyTranslator::evaluate(ExprId id) {
  const TypeId type = expr(id).type;
  if (isString(type))
    string(id);
  else if (isAggregate(type))
    place(id);
  else
    value(id);
}

// ---- assignments

void BodyTranslator::assign(ExprId to, ExprId from) {
  const TypeId type = expr(to).type;
  if (isString(type)) {
    const Address at = place(to);
    return assignString(at, capacityOf(type), isWide(type), from);
  }
  if (isAggregate(type)) {
    const Address at = place(to);
    const auto size = static_cast<uint32_t>(info(type).size);
    if (expr(from).kind == ExprKind::Zero) {
      const Address base = at.base == Base::Pointer ? Address{Base::Pointer, pointerTo(at), 0, 0, kNoBit} : at;
      emit(clearHandler(base.base), base.ref, {}, {size, false});
      return;
    }
    return copyAggregate(at, place(from), size);
  }
  const Scalar scalar = scalarOf(to);
  // The checks of the place come first.
  Element element_at;
  if (expr(to).kind == ExprKind::Index && !ir::mayFault(*body_, from) && !contains(*body_, from, ExprKind::Call) &&
      element(expr(to), element_at)) {
    const Operand created = inMemory(value(from), scalar);
    emit(storeElementHandler(scalar, element_at.index_type, element_at.base.base, element_at.index.mode, created.mode),
         created.ref, element_at.base.ref, element_at.index.ref, element_at.site, element_at.range);
    return;
  }
  const Address at = place(to);
  if (isDirect(at)) return valueInto(from, direct(at));
  write(at, scalar, value(from));
}

// ---- branches

void BodyTranslator::switchStatement(const SwitchStmt& stmt, Loc loc) {
  const Scalar type = scalarOf(stmt.selector);
  const Operand value_of = inMemory(value(stmt.selector), type);
  const Label otherwise = newLabel(), end = newLabel();
  const uint64_t flip = isSigned(type) ? uint64_t{1} << 63 : 0;
  std::vector<SwitchRow> rows;
  std::vector<Label> labels;
  for (const Case& one : body_->list(stmt.cases)) {
    labels.push_back(newLabel());
    for (const CaseRange& range : body_->list(one.ranges))
      rows.push_back(
          {static_cast<uint64_t>(range.low) ^ flip, static_cast<uint64_t>(range.high) ^ flip, labels.back()});
  }
  std::sort(rows.begin(), rows.end(), [](const SwitchRow& a, const SwitchRow& b) { return a.low < b.low; });
  if (!rows.empty() && rows.back().high - rows.front().low < kLargestTable)
    switchByTable(value_of, type, rows, otherwise);
  else
    switchByRanges(value_of, type, rows, otherwise);
  for (uint32_t i = 0; i < stmt.cases.count; ++i) {
    place(labels[i]);
    countBranch(loc, i + 1);
    block(body_->list(stmt.cases)[i].block);
    jump(end);
  }
  place(otherwise);
  countBranch(loc, stmt.cases.count + 1);
  block(stmt.else_block);
  place(end);
}

// A jump for each value from the lowest to the highest.
void BodyTranslator::switchByTable(const Operand& value, Scalar type, const std::vector<SwitchRow>& rows,
                                   Label otherwise) {
  const uint64_t flip = isSigned(type) ? uint64_t{1} << 63 : 0, first = rows.front().low;
  code_.tables.emplace_back(rows.back().high - first + 1);
  std::vector<int32_t>& table = code_.tables.back();
  const uint32_t insn = emit(switchHandler(type, value.mode), value.ref, {},
                             {static_cast<uint32_t>(table.size()), false}, 0, reinterpret_cast<int64_t>(table.data()));
  emit(haltHandler(), {}, {}, {}, 0, static_cast<int64_t>(first ^ flip));
  jumpTo(insn, otherwise);
  for (int32_t& to : table) to = -1;
  for (const SwitchRow& row : rows) {
    for (uint64_t at = row.low - first; at <= row.high - first; ++at) {
      if (table[at] != -1) continue;
      table[at] = 0;
      table_jumps_.push_back({&table[at], insn, row.label});
    }
  }
  for (int32_t& to : table)
    if (to == -1) table_jumps_.push_back({&to, insn, otherwise});
}

// A search in the ranges.
void BodyTranslator::switchByRanges(const Operand& value, Scalar type, const std::vector<SwitchRow>& rows,
                                    Label otherwise) {
  code_.ranges.emplace_back(rows.size());
  std::vector<SwitchRange>& ranges = code_.ranges.back();
  const uint32_t insn = emit(switchRangesHandler(type, value.mode), value.ref, {},
                             {static_cast<uint32_t>(rows.size()), false}, 0, reinterpret_cast<int64_t>(ranges.data()));
  jumpTo(insn, otherwise);
  for (size_t i = 0; i < rows.size(); ++i) {
    ranges[i] = {rows[i].low, rows[i].high, 0};
    table_jumps_.push_back({&ranges[i].to, insn, rows[i].label});
  }
}

// ---- loops

// Those of pure library functions do not count, so that generated code may keep them in headers.
// The test of a WHILE follows its body, so that an iteration takes one branch.
void BodyTranslator::loopStatement(const LoopStmt& stmt) {
  const auto depth = static_cast<uint32_t>(tries_.size());
  const Label iteration = newLabel(), on_continue = newLabel(), end = newLabel();
  loops_.push_back({end, on_continue, depth});
  if (options_.debug) emit(passHandler());  // the point of the statement is not one of each iteration
  auto [first, next] = stmt;
  const ExprId test = next ? ExprId{} : exitTest(*body_, first);
  if (test) {
    first = body_->stmt(first).next;
    jump(on_continue);
  }
  place(iteration);
  countStep();
  block(first);
  place(on_continue);
  if (test) {
    branch(test, false, iteration);
  } else if (exitTest(*body_, next) && !body_->stmt(next).next) {  // REPEAT
    branch(exitTest(*body_, next), false, iteration);
  } else {
    block(next);
    jump(iteration);
  }
  place(end);
  loops_.pop_back();
}

void BodyTranslator::forStatement(const ForStmt& stmt) {
  const auto depth = static_cast<uint32_t>(tries_.size());
  const auto [control, from, to, step_of, body_block] = stmt;
  const Scalar type = scalarOf(control);
  const auto step = static_cast<int64_t>(bitsOf(expr(step_of)));
  const bool up = step > 0;
  const Label iteration = newLabel(), on_continue = newLabel(), end = newLabel();

  const Address at = place(control);
  const Operand begin = temp(), limit = temp();
  const bool is_direct = isDirect(at);
  const bool is_constant = expr(from).kind == ExprKind::Const;
  if (!is_constant) valueInto(from, begin);
  valueInto(to, limit);
  const Operand first = is_constant ? constant(expr(from)) : begin;
  write(at, type, first);
  const Operand tested = is_constant ? inFrame(first, type) : begin;
  const bool enters =
      is_constant && isConst(expr(to)) &&
      (isSigned(type) ? (up ? static_cast<int64_t>(bitsOf(expr(from))) <= static_cast<int64_t>(bitsOf(expr(to)))
                            : static_cast<int64_t>(bitsOf(expr(from))) >= static_cast<int64_t>(bitsOf(expr(to))))
                      : (up ? bitsOf(expr(from)) <= bitsOf(expr(to)) : bitsOf(expr(from)) >= bitsOf(expr(to))));
  if (!enters) {
    jumpTo(emit(branchHandler(up ? Op::Le : Op::Ge, type, Mode::Frame, Mode::Frame, false), tested.ref, limit.ref),
           end);
  }
  loops_.push_back({end, on_continue, depth});
  place(iteration);
  countStep();
  block(body_block);
  place(on_continue);
  if (is_direct) {
    const Operand counter = direct(at);
    jumpTo(emit(forHandler(type, up, counter.mode), counter.ref, limit.ref, {}, 0, step), iteration);
  } else {
    const Operand counter = temp(), more = temp();
    const Address again = place(control);
    move(type, read(again, type, &counter), counter);
    emit(forFlagHandler(type, up), counter.ref, limit.ref, more.ref, 0, step);
    write(again, type, counter);
    jumpTo(emit(branchTruthHandler(Mode::Frame, true), more.ref), iteration);
  }
  place(end);
  loops_.pop_back();
}

// ---- try

void BodyTranslator::noteLabels(StmtId first, uint32_t depth) {
  for (StmtId id = first; id; id = body_->stmt(id).next) {
    const Stmt& stmt = body_->stmt(id);
    if (const auto* label = stmt.tryAs<LabelStmt>()) user_labels_[label->label].try_depth = depth;
    const auto* guard = stmt.tryAs<TryStmt>();
    uint32_t part = 0;
    forEachBlock(*body_, stmt, [&](StmtId inner) {
      const bool guarded = guard != nullptr && (part == 0 || (part == 1 && guard->finally_block));
      noteLabels(inner, depth + (guarded ? 1 : 0));
      ++part;
    });
  }
}

// Control leaves the blocks of a try in steps: each notes the target, and its Halt ends the guarded run.
void BodyTranslator::leaveTo(Label label, uint32_t try_depth) {
  if (tries_.size() <= try_depth) return jump(label);
  Try& inside = tries_.back();
  inside.exits.push_back({label, try_depth});
  move(Scalar::U32, {Mode::Constant, {}, static_cast<int64_t>(inside.exits.size())}, inside.exit);
  emit(haltHandler());
}

void BodyTranslator::tryStatement(const TryStmt& stmt) {
  const Operand fault = temp(), exit = temp();
  const bool has_catch = stmt.catches, has_finally = static_cast<bool>(stmt.finally_block);
  move(Scalar::U64, {}, exit);
  const auto guarded = [&](StmtId first) {
    const Label after = newLabel();
    tries_.push_back({exit, {}});
    jumpTo(emit(tryHandler(), fault.ref), after);
    block(first);
    emit(haltHandler());
    place(after);
    std::vector<Exit> exits = std::move(tries_.back().exits);
    tries_.pop_back();
    return exits;
  };
  std::vector<Exit> exits = guarded(stmt.body_block);
  if (has_catch) {
    const Label ok = newLabel();
    jumpTo(emit(branchHandler(Op::Eq, Scalar::U8, Mode::Frame, Mode::Constant, true), fault.ref), ok);
    if (stmt.number) {
      const Scalar type = scalarOf(stmt.number);
      const Operand number = converted(fault, Scalar::U8, type, nullptr);
      write(place(stmt.number), type, number);
    }
    if (has_finally) {
      // The numbers of its exits follow those of the body.
      tries_.push_back({exit, exits});
      const Label after = newLabel();
      jumpTo(emit(tryHandler(), fault.ref), after);
      block(stmt.catch_block);
      emit(haltHandler());
      place(after);
      exits = std::move(tries_.back().exits);
      tries_.pop_back();
    } else {
      block(stmt.catch_block);
    }
    place(ok);
  }
  if (has_finally) block(stmt.finally_block);
  if (!has_catch || has_finally) emit(rethrowHandler(), fault.ref);
  for (size_t i = 0; i < exits.size(); ++i) {
    const Label other = newLabel();
    jumpTo(emit(branchHandler(Op::Eq, Scalar::U32, Mode::Frame, Mode::Constant, false), exit.ref, {}, {}, 0,
                static_cast<int64_t>(i + 1)),
           other);
    leaveTo(exits[i].to, exits[i].try_depth);
    place(other);
  }
}

// ---- tests

void BodyTranslator::assertStatement(const Stmt& stmt) {
  AssertionReport report = assertionReport(module_, *body_, stmt);
  const auto keep = [&](std::string_view text) -> const char* {
    if (text.empty()) return nullptr;
    code_.strings.emplace_back(text);
    return code_.strings.back().c_str();
  };
  AssertionSite created{};
  created.is = {keep(report.position.path), report.position.line, report.position.column, keep(report.source),
                keep(report.message),       keep(report.shown),   keep(report.items)};
  const Ref slots = slot(32);
  const auto put = [&](ExprId id, uint32_t number) {
    const Ref to{slots.offset + 8 * number, false};
    if (isString(expr(id).type)) return pointerInto(string(id), to);
    move(Scalar::U64, wideBits(id), {Mode::Frame, to, 0});
  };
  AssertionKind kind = AssertionKind::Truth;
  const auto [first, second, third, message, text, shown, assertion] = stmt.as<AssertStmt>();
  if (second) created.kind = assertedKind(types_, expr(second).type);
  switch (assertion) {
    case Assertion::Assert:
      move(Scalar::Bool, value(first), {Mode::Frame, slots, 0});
      if (!second) break;
      kind = AssertionKind::Compared;
      put(second, 1);
      put(third, 2);
      break;
    case Assertion::AssertNear: {
      kind = AssertionKind::Near;
      uint32_t number = 0;
      for (ExprId id : {first, second, third}) {
        const Operand real = converted(value(id), scalarOf(id), Scalar::F64, nullptr);
        move(Scalar::F64, real, {Mode::Frame, {slots.offset + 8 * number++, false}, 0});
      }
      break;
    }
    case Assertion::AssertEq: {
      const TypeId type = expr(second).type;
      if (isAggregate(type) && !isString(type)) {
        const Ref a = pointerTo(place(first)), b = pointerTo(place(second));
        emit(compareMemoryHandler(), slots, a, {static_cast<uint32_t>(info(type).size), false}, b.offset);
      } else {
        kind = AssertionKind::Equal;
        put(first, 0);
        put(second, 1);
      }
      break;
    }
  }
  created.has_message = static_cast<bool>(message);
  if (message) put(message, 3);
  code_.assertions.push_back(created);
  emit(assertHandler(kind), {}, slots, {}, 0, reinterpret_cast<int64_t>(&code_.assertions.back()));
}

}  // namespace rung::ir::interpreter

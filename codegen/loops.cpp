// SPDX-License-Identifier: Apache-2.0
// Loops of a body in C++: a FOR as a plain C++ loop where counted_loops.h says so, else with a flag that guards the
// step. In: a loop statement. Out: its C++. Called by statements.cpp.
#include "codegen/body_parts.h"
#include "ir/walk.h"

namespace rung::codegen {

// ---- steps: what rung_context::steps counts

void StatementWriter::step(Loc loc) {
  if (countsSteps())
    checks().check(tree_.call("rung_step", {tree_.fixed("ctx")}), loc, types::Fault::Stop, tree_.number(0));
}

void StatementWriter::stepOfCall() {
  if (!body_->library) step(body_->loc);
}

// The condition of a loop's exit test, with nothing to be done before it; none of other statements.
ir::ExprId StatementWriter::exitTest(StmtId id) const {
  const ExprId test = ir::exitTest(*body_, id);
  const bool is_ready = test && !checks().needsPreparation(test) && !analysis_->lengths.countsBefore(id);
  return is_ready ? test : ExprId{};
}

void StatementWriter::loopStatement(const ir::LoopStmt& stmt, Loc loc) {
  const StmtId first = stmt.body_block, next = stmt.next_block;
  Loop loop;
  loop.number = ++state_.names_created;
  loop.has_next = static_cast<bool>(next);
  const auto stays = [&](ExprId leaves) {
    if (ir::isNot(expr(leaves))) return values().condition(expr(leaves).as<ir::UnaryExpr>().operand);
    return tree_.prefix("!", values().condition(leaves));
  };
  if (!next && exitTest(first)) {  // WHILE
    addLoop(tree_.stmt(cxx::StmtKind::While, stays(exitTest(first))), loop, [&] {
      step(loc);
      block(body_->stmt(first).next);
    });
  } else if (exitTest(next) && !body_->stmt(next).next) {  // REPEAT
    loop.has_next = false;                                 // `continue` goes to the test
    cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::DoWhile);
    const auto body = [&] {
      step(loc);
      block(first);
    };
    addLoop(made, loop, body, [&] { made->a = stays(exitTest(next)); });
  } else {
    addLoop(tree_.stmt(cxx::StmtKind::For), loop, [&] {
      step(loc);
      if (!next) return block(first);
      addWithBlock(tree_.stmt(cxx::StmtKind::Block), first);
      if (loops_.back().continues_by_goto) addLabel("continue" + std::to_string(loop.number));
      loops_.back().has_next = false;
      block(next);
    });
  }
}

void StatementWriter::breakLoop() {
  if (loops_.empty()) return add(tree_.stmt(cxx::StmtKind::Empty));
  Loop& loop = loops_.back();
  if (loop.try_depth > 0 && !frames_.empty()) {
    frames_.back().breaks = true;
    return leaveFrame(2);
  }
  if (!loop.in_switch) return add(tree_.stmt(cxx::StmtKind::Break));
  loop.breaks_by_goto = true;
  addGoto("break" + std::to_string(loop.number));
}

void StatementWriter::continueLoop() {
  if (loops_.empty()) return add(tree_.stmt(cxx::StmtKind::Empty));
  Loop& loop = loops_.back();
  if (loop.try_depth > 0 && !frames_.empty()) {
    frames_.back().continues = true;
    return leaveFrame(3);
  }
  if (!loop.has_next) return add(tree_.stmt(cxx::StmtKind::Continue));
  loop.continues_by_goto = true;
  addGoto("continue" + std::to_string(loop.number));
}

namespace {

uint64_t magnitude(int64_t step) { return step < 0 ? 0 - static_cast<uint64_t>(step) : static_cast<uint64_t>(step); }

// Tells whether the body may leave the loop before its last iteration.
bool mayLeave(const ir::Body& body, ir::StmtId first) {
  bool found = false;
  ir::forEachStmt(body, first, [&](ir::StmtId id) {
    const ir::StmtKind kind = body.stmt(id).kind;
    found = found || kind == ir::StmtKind::Break || kind == ir::StmtKind::Return || kind == ir::StmtKind::Jump;
  });
  return found;
}

}  // namespace

// The variable of a counted loop.
cxx::Ex StatementWriter::controlName(ExprId control) {
  const Expr& place = expr(control);
  if (const uint32_t* local = ir::localOf(place)) return variable(body_->locals[*local]);
  return mangledName(fieldOf(place.as<ir::FieldExpr>()).name);
}

// The limit is read once, before the control changes.
cxx::Ex StatementWriter::limitOf(const ir::ForStmt& stmt, uint8_t wide) {
  if (expr(stmt.to).kind == ExprKind::Const) return values().value(stmt.to);
  const Ex limit = tree_.name(newName("e"));
  declare(wide == 64 ? "int64_t" : wide == 32 ? "int32_t" : scalarType(types_, expr(stmt.control).type), limit->text);
  assign(limit, values().value(stmt.to));
  return limit;
}

void StatementWriter::countedFor(const ir::ForStmt& stmt, bool fits, Loc loc) {
  const auto step = static_cast<int64_t>(ir::bitsOf(expr(stmt.step)));
  const uint8_t wide = wideOf(stmt.control);
  const Ex name = controlName(stmt.control), limit = limitOf(stmt, wide);
  const Ex begin = tree_.infix(Operator::Assign, name, values().value(stmt.from));
  const Ex goes_on = tree_.infix(step > 0 ? Operator::LessEqual : Operator::GreaterEqual, name, limit);
  cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::For);
  made->b = goes_on;
  made->c = step == 1 || step == -1 ? tree_.prefix(step == 1 ? "++" : "--", name)
                                    : tree_.infix(step < 0 ? Operator::AssignSub : Operator::AssignAdd, name,
                                                  tree_.number(magnitude(step)));
  // All steps in front of the loop, so that g++ still sees a plain one.
  const bool pays_first = countsSteps() && !mayLeave(*body_, stmt.body_block);
  if (pays_first) {
    perform(begin);
    cxx::Stmt* const payment = tree_.stmt(cxx::StmtKind::BracedIf, goes_on);
    add(payment);
    payment->first = nested([&] { paySteps(loc, step > 0 ? name : limit, step > 0 ? limit : name, step); }).first();
  } else {
    made->a = begin;
  }
  Loop loop;
  loop.number = ++state_.names_created;
  const auto body = [&] {
    if (!pays_first) this->step(loc);
    block(stmt.body_block);
  };
  addLoop(made, loop, body, [&] {
    if (wide != 0 && !fits) keepInType(stmt.control, name, step > 0);
  });
}

// One step for each iteration from `low` to `high`.
void StatementWriter::paySteps(Loc loc, Ex low, Ex high, int64_t step) {
  const Ex first = tree_.cast("uint64_t", tree_.group(low)), last = tree_.cast("uint64_t", tree_.group(high));
  Ex count = tree_.group(tree_.infix(Operator::Subtract, last, first));
  if (step != 1 && step != -1) count = tree_.infix(Operator::Divide, count, tree_.number(magnitude(step)));
  checks().check(tree_.call("rung_steps", {tree_.fixed("ctx"), count}), loc, types::Fault::Stop, tree_.number(0));
}

// After a loop whose control is wider than its type: where the next value does not fit it stays at the type's limit.
void StatementWriter::keepInType(ExprId control, Ex name, bool rises) {
  const TypeKind kind = kindOf(control);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  const Ex bound = rises ? tree_.number((uint64_t{1} << (is_signed ? width - 1 : width)) - 1)
                         : tree_.signedNumber(is_signed ? -(int64_t{1} << (width - 1)) : 0);
  cxx::Stmt* const test =
      tree_.stmt(cxx::StmtKind::ShortIf, tree_.infix(rises ? Operator::Greater : Operator::Less, name, bound));
  add(test);
  test->first = nested([&] { assign(name, bound); }).first();
}

void StatementWriter::forStatement(StmtId id, const ir::ForStmt& stmt) {
  checks().prepare(stmt.control);
  checks().prepare(stmt.from);
  checks().prepare(stmt.to);
  if (const CountedLoop* counted = analysis_->loops.find(id))
    return countedFor(stmt, counted->fits, body_->stmt(id).loc);
  const auto step = static_cast<int64_t>(ir::bitsOf(expr(stmt.step)));
  const std::string type = scalarType(types_, expr(stmt.control).type);
  const std::string next_name = newName("n"), limit_name = newName("e"), more_name = newName("m");
  const Ex zero = tree_.number(0);
  declare(type, next_name, zero)->also = tree_.variable(type, limit_name, zero);
  declare("bool", more_name, tree_.fixed("false"));
  const Ex next = tree_.name(next_name), limit = tree_.name(limit_name), more = tree_.name(more_name);
  assign(next, values().value(stmt.from));
  assign(limit, values().value(stmt.to));
  perform(places().store(stmt.control, next));
  const Ex goes_on = tree_.infix(step > 0 ? Operator::LessEqual : Operator::GreaterEqual, next, limit);
  const Ex overflows = tree_.call("__builtin_add_overflow",
                                  {values().value(stmt.control), tree_.signedNumber(step, "LL"), addressOf(next)});
  const Ex at_limit = places().store(stmt.control, typeLimit(stmt.control, step > 0));
  const Ex at_next = places().store(stmt.control, next);
  cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::For);
  made->a = tree_.infix(Operator::Assign, more, goes_on);
  made->b = more;
  made->c = tree_.infix(Operator::Assign, more,
                        tree_.choice(overflows, tree_.infix(Operator::Comma, at_limit, tree_.fixed("false")),
                                     tree_.infix(Operator::Comma, at_next, goes_on)));
  Loop loop;
  loop.number = ++state_.names_created;
  addLoop(made, loop, [&] {
    this->step(body_->stmt(id).loc);
    block(stmt.body_block);
  });
}

// The last value that the type of a control has.
cxx::Ex StatementWriter::typeLimit(ExprId control, bool rises) {
  const TypeKind kind = kindOf(control);
  const uint32_t width = widthOf(kind);
  const uint64_t half = (uint64_t{1} << (width - 1)) - 1;
  Ex limit = tree_.number(0);
  if (rises) {
    const uint64_t high = types_.isSigned(kind) ? half : width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1;
    limit = tree_.number(high, high > INT64_MAX ? "ULL" : "LL");
  } else if (types_.isSigned(kind)) {
    limit = tree_.infix(Operator::Subtract, tree_.name("-" + std::to_string(half) + "LL"), tree_.number(1));
  }
  return tree_.cast(scalarType(types_, expr(control).type), limit);
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Loops of a body in C++: a FOR as a plain C++ loop where counted_loops.h says so, else with a flag that guards the
// step. In: a loop statement. Out: its C++. Called by statements.cpp.
#include "codegen/body_parts.h"
#include "ir/walk.h"

namespace rung::codegen {

// ---- steps: what rung_context::steps counts

void StatementWriter::step(Loc loc) {
  if (!countsSteps()) return;
  out_ += " RUNG_CHECK(rung_step(ctx)";
  checks().endCheck(loc, types::Fault::Stop, "0");
}

void StatementWriter::stepOfCall() {
  if (!body_->library) step(body_->loc);
}

// All iterations of a loop in front of it, so that g++ still sees a plain loop.
void StatementWriter::stepsOf(Loc loc, const std::string& count) {
  out_ += "RUNG_CHECK(rung_steps(ctx, " + count + ")";
  checks().endCheck(loc, types::Fault::Stop, "0");
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
  auto writeNegated = [&](ExprId id) {
    if (ir::isNot(expr(id))) {
      values().condition(expr(id).as<ir::UnaryExpr>().operand, Prec::Comma);
    } else {
      out_ += '!';
      values().condition(id, Prec::Unary);
    }
  };
  if (!next && exitTest(first)) {  // WHILE
    out_ += "while (";
    writeNegated(exitTest(first));
    out_ += ')';
    open();
    step(loc);
    loops_.push_back(loop);
    block(body_->stmt(first).next);
    close();
  } else if (exitTest(next) && !body_->stmt(next).next) {  // REPEAT
    loop.has_next = false;                                 // `continue` goes to the test
    out_ += "do";
    open();
    step(loc);
    loops_.push_back(loop);
    block(first);
    close();
    flushCloses(0);
    out_ += " while (";
    writeNegated(exitTest(next));
    out_ += ");";
  } else {
    out_ += "for (;;)";
    open();
    step(loc);
    loops_.push_back(loop);
    if (next) {
      out_ += " {";
      ++depth_;
      block(first);
      close();
      flushCloses(0);
      if (loops_.back().continues_by_goto) {
        out_ += " continue";
        appendUnsigned(out_, loop.number);
        out_ += ":;";
      }
      loops_.back().has_next = false;
      block(next);
    } else {
      block(first);
    }
    close();
  }
  const Loop done = loops_.back();
  loops_.pop_back();
  if (done.breaks_by_goto) {
    flushCloses(0);
    out_ += " break";
    appendUnsigned(out_, done.number);
    out_ += ":;";
  }
}

void StatementWriter::breakLoop() {
  if (loops_.empty()) {
    out_ += ';';
    return;
  }
  Loop& loop = loops_.back();
  if (loop.try_depth > 0 && !frames_.empty()) {
    frames_.back().breaks = true;
    out_ += frames_.back().exit + " = 2; return;";
    return;
  }
  if (!loop.in_switch) {
    out_ += "break;";
    return;
  }
  loop.breaks_by_goto = true;
  out_ += "goto break";
  appendUnsigned(out_, loop.number);
  out_ += ';';
}

void StatementWriter::continueLoop() {
  if (loops_.empty()) {
    out_ += ';';
    return;
  }
  Loop& loop = loops_.back();
  if (loop.try_depth > 0 && !frames_.empty()) {
    frames_.back().continues = true;
    out_ += frames_.back().exit + " = 3; return;";
    return;
  }
  if (!loop.has_next) {
    out_ += "continue;";
    return;
  }
  loop.continues_by_goto = true;
  out_ += "goto continue";
  appendUnsigned(out_, loop.number);
  out_ += ';';
}

namespace {

void appendStep(std::string& out, std::string_view name, int64_t step) {
  if (step == 1 || step == -1) {
    out += step == 1 ? "++" : "--";
    out += name;
    return;
  }
  out += name;
  out += step < 0 ? " -= " : " += ";
  if (step < 0) {
    appendUnsigned(out, 0 - static_cast<uint64_t>(step));
  } else {
    appendSigned(out, step);
  }
}

}  // namespace

namespace {

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

void StatementWriter::countedFor(const ir::ForStmt& stmt, bool fits, Loc loc) {
  const ExprId control = stmt.control, from = stmt.from, to = stmt.to;
  const TypeKind kind = kindOf(control);
  const auto step = static_cast<int64_t>(ir::bitsOf(expr(stmt.step)));
  const uint8_t wide = wideOf(control);
  std::string name;
  const Expr& place = expr(control);
  if (const uint32_t* local = ir::localOf(place)) {
    variable(name, body_->locals[*local]);
  } else {
    appendMangled(name, string(fieldOf(place.as<ir::FieldExpr>()).name));
  }
  // The limit is read once, before the control changes.
  std::string limit;
  if (expr(to).kind == ExprKind::Const) {
    limit = captured([&] { values().value(to, Prec::Shift); });
  } else {
    limit = newName("e");
    declarations_ += wide == 64 ? " int64_t " : wide == 32 ? " int32_t " : " ";
    if (wide == 0) {
      declarations_ += scalarType(types_, place.type);
      declarations_ += ' ';
    }
    declarations_ += limit + ";";
    out_ += limit + " = ";
    values().value(to, Prec::Comma);
    out_ += "; ";
  }
  const char* const order = step > 0 ? " <= " : " >= ";
  const bool pays_first = countsSteps() && !mayLeave(*body_, stmt.body_block);
  if (pays_first) {
    out_ += name + " = ";
    values().value(from, Prec::Comma);
    out_ += "; if (" + name + order + limit + ") { ";
    const std::string low = step > 0 ? name : limit, high = step > 0 ? limit : name;
    std::string count = "((uint64_t)(" + high + ") - (uint64_t)(" + low + "))";
    if (step != 1 && step != -1) {
      count += " / ";
      appendUnsigned(count, step < 0 ? 0 - static_cast<uint64_t>(step) : static_cast<uint64_t>(step));
    }
    stepsOf(loc, count);
    out_ += "} for (; ";
  } else {
    out_ += "for (" + name + " = ";
    values().value(from, Prec::Comma);
    out_ += "; ";
  }
  out_ += name + order + limit + "; ";
  appendStep(out_, name, step);
  out_ += ')';
  open();
  if (!pays_first) this->step(loc);
  Loop loop;
  loop.number = ++state_.names_created;
  loops_.push_back(loop);
  block(stmt.body_block);
  close();
  const Loop done = loops_.back();
  loops_.pop_back();
  std::string tail;
  if (wide != 0 && !fits) {  // where the next value does not fit the control stays at the type's limit
    const uint32_t width = widthOf(kind);
    const bool is_signed = types_.isSigned(kind);
    std::string bound;
    if (step > 0) {
      appendUnsigned(bound, (uint64_t{1} << (is_signed ? width - 1 : width)) - 1);
      tail = " if (" + name + " > " + bound + ") " + name + " = " + bound + ";";
    } else {
      if (is_signed) {
        appendSigned(bound, -(int64_t{1} << (width - 1)));
      } else {
        bound = "0";
      }
      tail = " if (" + name + " < " + bound + ") " + name + " = " + bound + ";";
    }
  }
  if (!tail.empty() || done.breaks_by_goto) {
    flushCloses(0);
    out_ += tail;
  }
  if (done.breaks_by_goto) {
    out_ += " break";
    appendUnsigned(out_, done.number);
    out_ += ":;";
  }
}

void StatementWriter::forStatement(StmtId id, const ir::ForStmt& stmt) {
  const ExprId control = stmt.control, from = stmt.from, to = stmt.to;
  checks().prepare(control);
  checks().prepare(from);
  checks().prepare(to);
  if (const CountedLoop* counted = analysis_->loops.find(id)) {
    countedFor(stmt, counted->fits, body_->stmt(id).loc);
    return;
  }
  const TypeKind kind = kindOf(control);
  const uint32_t width = widthOf(kind);
  const bool is_signed = types_.isSigned(kind);
  const auto step = static_cast<int64_t>(ir::bitsOf(expr(stmt.step)));
  const std::string type = scalarType(types_, expr(control).type);
  const std::string next = newName("n"), limit = newName("e"), more = newName("m");
  declarations_ += " " + type + " " + next + " = 0, " + limit + " = 0; bool " + more + " = false;";
  out_ += next + " = ";
  values().value(from, Prec::Comma);
  out_ += "; " + limit + " = ";
  values().value(to, Prec::Comma);
  out_ += "; ";
  places().store(control, next);
  const std::string test = next + (step > 0 ? " <= " : " >= ") + limit;
  out_ += "; for (" + more + " = " + test + "; " + more + "; " + more + " = __builtin_add_overflow(";
  values().value(control, Prec::Ternary);
  out_ += ", ";
  appendSigned(out_, step);
  out_ += "LL, &" + next + ") ? (";
  std::string last = "(" + type + ")";
  if (step > 0) {
    const uint64_t high = is_signed     ? (uint64_t{1} << (width - 1)) - 1
                          : width >= 64 ? ~uint64_t{0}
                                        : (uint64_t{1} << width) - 1;
    appendUnsigned(last, high);
    last += high > INT64_MAX ? "ULL" : "LL";
  } else if (is_signed) {
    last += "(-";
    appendUnsigned(last, (uint64_t{1} << (width - 1)) - 1);
    last += "LL - 1)";
  } else {
    last += "0";
  }
  places().store(control, last);
  out_ += ", false) : (";
  places().store(control, next);
  out_ += ", " + test + "))";
  open();
  this->step(body_->stmt(id).loc);
  Loop loop;
  loop.number = ++state_.names_created;
  loops_.push_back(loop);
  block(stmt.body_block);
  close();
  const Loop done = loops_.back();
  loops_.pop_back();
  if (done.breaks_by_goto) {
    flushCloses(0);
    out_ += " break";
    appendUnsigned(out_, done.number);
    out_ += ":;";
  }
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Statements of a body and their lines: see body.h. The lines of the generated code follow those of the source; `#line`
// appears only where they diverge, which keeps the code small.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/assertion.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::Fault;

namespace {

constexpr uint32_t kMaxBlankLines = 6, kAnyLines = ~0u;
constexpr uint32_t kDeepestIndent = 40;
constexpr uint32_t kDeepestBraces = 200;  // clang++ takes 256

size_t indentOf(uint32_t depth) { return 2 * static_cast<size_t>(std::min(depth, kDeepestIndent)); }

struct Position {
  FileId file;
  uint32_t line = 0;
};

Position positionOf(const ir::Module& module, const ir::Body& body, Loc loc) {
  if (body.origin.path) return {{}, body.origin.line};
  if (!loc) return {};
  const SourceLocation location = module.sources.location(loc);
  return {location.file, location.line};
}

}  // namespace

// ---- lines

// Writes the pending braces, at most `lines` of them on separate lines.
void StatementWriter::flushCloses(uint32_t lines) {
  for (; closes_ > 0; --closes_) {
    if (lines > 0) {
      out_ += '\n';
      out_.append(indentOf(depth_ + closes_ - 1), ' ');
      if (line_ != 0) ++line_;
      --lines;
    } else {
      out_ += ' ';
    }
    out_ += '}';
  }
}

void StatementWriter::begin(Loc loc) {
  const Position at = options_.line_directives ? positionOf(module_, *body_, loc) : Position{};
  const size_t indent = indentOf(depth_);
  if (at.line == 0) {
    flushCloses(kAnyLines);
    out_ += '\n';
    if (line_ != 0) ++line_;
    out_.append(indent, ' ');
    return;
  }
  const bool same_file = line_ != 0 && at.file == line_file_;
  if (same_file && at.line == line_) {
    flushCloses(0);
    out_ += ' ';
    return;
  }
  if (same_file && at.line > line_ && at.line - line_ <= kMaxBlankLines + closes_) {
    flushCloses(at.line - line_ - 1);
    out_.append(at.line - line_, '\n');
  } else {
    flushCloses(kAnyLines);
    out_ += "\n#line ";
    appendUnsigned(out_, at.line);
    if (!same_file) {
      out_ += ' ';
      appendQuoted(out_, body_->origin.path ? string(body_->origin.path) : module_.sources.path(at.file));
    }
    out_ += '\n';
  }
  out_.append(indent, ' ');
  line_ = at.line;
  line_file_ = at.file;
}

void StatementWriter::open() {
  out_ += " {";
  ++depth_;
}

void StatementWriter::close() {
  --depth_;
  ++closes_;
}

// ---- statements

void StatementWriter::block(StmtId first) {
  for (StmtId id = first; id; id = body_->stmt(id).next) statement(id, body_->stmt(id));
}

void StatementWriter::statement(StmtId id, const Stmt& stmt) {
  if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && facts_.is_zeroing[call->callee.index] != 0) {
    // An initialiser begins by clearing the whole record.
    if (body_->kind == ir::BodyKind::Init && expr(ir::rootOf(*body_, call->self)).kind == ExprKind::Self) return;
    begin(stmt.loc);
    checks().prepare(call->self);
    const std::string name = captured([&] { places().place(call->self); });
    out_ += "memset(&" + name + ", 0, sizeof " + name + ");";
    return strings().forgetLengths(id);
  }
  begin(stmt.loc);
  places().holdBytes(id);
  strings().countLengths(id);
  write(id, stmt);
  if (places().releasesBytes(id)) {
    flushCloses(0);
    places().releaseBytes(id);
  }
}

void StatementWriter::write(StmtId id, const Stmt& stmt) {
  switch (stmt.kind) {
    case StmtKind::None: out_ += ';'; return;
    case StmtKind::Assign: assign(stmt.as<ir::AssignStmt>()); return strings().forgetLengths(id);
    case StmtKind::Bind: bindStatement(stmt.as<ir::BindStmt>()); return strings().forgetLengths(id);
    case StmtKind::Call: calls().callStatement(id); return strings().forgetLengths(id);
    case StmtKind::If: ifStatement(stmt.as<ir::IfStmt>()); return;
    case StmtKind::Switch: switchStatement(stmt.as<ir::SwitchStmt>()); return;
    case StmtKind::Loop: loopStatement(stmt.as<ir::LoopStmt>(), stmt.loc); return;
    case StmtKind::For: forStatement(id, stmt.as<ir::ForStmt>()); return;
    case StmtKind::Break: breakLoop(); return;
    case StmtKind::Continue: continueLoop(); return;
    case StmtKind::Return: leave(); return;
    case StmtKind::Jump:
      out_ += "goto ";
      appendMangled(out_, string(body_->labels[stmt.as<ir::JumpStmt>().label]));
      out_ += ';';
      return;
    case StmtKind::Label:
      appendMangled(out_, string(body_->labels[stmt.as<ir::LabelStmt>().label]));
      out_ += ":;";
      step(stmt.loc);
      return;
    case StmtKind::Try: tryStatement(stmt.as<ir::TryStmt>()); return;
    case StmtKind::Fault: faultStatement(stmt.as<ir::FaultStmt>(), stmt.loc); return;
    case StmtKind::Assert: assertStatement(stmt); return;
    case StmtKind::Evaluate: checks().prepare(stmt.as<ir::EvaluateStmt>().value); return;
  }
}

void StatementWriter::assign(const ir::AssignStmt& stmt) {
  const ExprId to = stmt.place, from = stmt.value;
  const TypeId type = expr(to).type;
  const Expr& source = expr(from);
  if (isString(type)) {
    if (isSlice(to)) return strings().assignSlice(to, from);
    checks().prepare(to);
    strings().prepareString(from);
    const std::string name = captured([&] { places().place(to); });
    const bool is_measured = isMeasured(to);
    const std::string length = is_measured ? captured([&] { strings().lengthName(to); }) : "";
    strings().copyString({name, capacityOf(type), isWide(type), length}, from);
    return;
  }
  if (!isAggregate(type)) {
    checks().prepare(to);
    checks().prepare(from);
    if (ir::isImageBit(expr(to)) && values().isContacts(from)) {
      places().storeBit(to, from);
    } else if (places().isLvalue(to)) {
      places().place(to);
      out_ += " = ";
      values().value(from, Prec::Ternary);
    } else {
      places().store(to, captured([&] { values().value(from, Prec::Ternary); }));
    }
    out_ += ';';
    return;
  }
  checks().prepare(to);
  const std::string name = captured([&] { places().place(to); });
  if (source.kind == ExprKind::Zero) {
    out_ += "memset(&" + name + ", 0, sizeof " + name + ");";
    return;
  }
  if (const auto* data = source.tryAs<ir::DataExpr>()) {
    out_ += "memcpy(&" + name + ", ";
    places().dataReference(data->index);
    out_ += ", sizeof " + name + ");";
    return;
  }
  checks().prepare(from);
  const std::string value_code = captured([&] { places().place(from); });
  if (value_code == name) return;
  if (types_.kind(type) == TypeKind::Record && !places().isImagePlace(to) && !places().isImagePlace(from)) {
    out_ += name + " = " + value_code + ";";
  } else {
    out_ += "memmove(&" + name + ", &" + value_code + ", sizeof " + name + ");";
  }
}

void StatementWriter::bindStatement(const ir::BindStmt& stmt) {
  checks().prepareChildren(expr(stmt.field));  // the field itself holds no variable yet
  if (stmt.place) checks().prepare(stmt.place);
  const ir::FieldExpr& field = expr(stmt.field).as<ir::FieldExpr>();
  places().member(field.base);
  const types::Field& info = fieldOf(field);
  appendMangled(out_, string(info.name));
  out_ += " = ";
  if (!stmt.place) {
    out_ += "nullptr";
  } else if (isString(info.type)) {
    places().place(stmt.place);
  } else {
    // The variable may have another type with the same memory.
    out_ += '(';
    appendPointer(out_, types_, info.type, "");
    out_ += ")&";
    places().place(stmt.place);
  }
  out_ += ';';
}

// `return`, after the locals are written back; in the frame of a try the frame's caller does that.
void StatementWriter::leave() {
  if (!frames_.empty()) {
    frames_.back().returns = true;
    out_ += frames_.back().exit;
    out_ += " = 1; return;";
    return;
  }
  if (hasExit()) {
    state_.uses_leave = true;
    out_ += "goto leave;";
    return;
  }
  for (const ir::Local& local : body_->locals) {
    if (local.kind != ir::LocalKind::Result || local.by_reference) continue;
    out_ += "return ";
    variable(out_, local);
    out_ += ';';
    return;
  }
  out_ += "return;";
}

bool StatementWriter::endsInJump(StmtId first) const {
  StmtKind last = StmtKind::None;
  for (StmtId id = first; id; id = body_->stmt(id).next) last = body_->stmt(id).kind;
  return ir::flowOf(last) == ir::StmtFlow::Leaves;
}

// Without braces: every variable is declared at the top, so jumps cross no initialisation.
void StatementWriter::deepIf(const ir::IfStmt& stmt) {
  const std::string otherwise = newName("else"), end = newName("end");
  checks().prepare(stmt.condition);
  out_ += "if (!";
  values().condition(stmt.condition, Prec::Unary);
  out_ += ") goto " + otherwise + ";";
  block(stmt.then_block);
  flushCloses(0);
  if (stmt.else_block) out_ += " goto " + end + ";";
  out_ += " " + otherwise + ":;";
  if (!stmt.else_block) return;
  block(stmt.else_block);
  flushCloses(0);
  out_ += " " + end + ":;";
}

void StatementWriter::ifStatement(const ir::IfStmt& stmt) {
  const ir::IfStmt* at = &stmt;
  for (;;) {
    if (depth_ > kDeepestBraces) {
      deepIf(*at);
      return;
    }
    checks().prepare(at->condition);
    out_ += "if (";
    values().condition(at->condition, Prec::Comma);
    out_ += ')';
    open();
    block(at->then_block);
    close();
    if (!at->else_block) return;
    const Stmt& other = body_->stmt(at->else_block);
    // A brace gets its own line where the source leaves room for it.
    const Position next = options_.line_directives ? positionOf(module_, *body_, other.loc) : Position{};
    uint32_t room = kAnyLines;
    if (next.line != 0 && line_ != 0 && next.file == line_file_) {
      room = next.line > line_ ? next.line - line_ - 1 : 0;
      if (room > kMaxBlankLines) room = kAnyLines;
    }
    flushCloses(room);
    out_ += " else";
    const auto* chained = other.next ? nullptr : other.tryAs<ir::IfStmt>();
    if (chained == nullptr || checks().needsPreparation(chained->condition) ||
        analysis_->lengths.countsBefore(at->else_block) || places().holdsBytesFrom(at->else_block)) {
      open();
      block(at->else_block);
      close();
      return;
    }
    if (next.line != 0 && line_ != 0 && next.line == line_ + 1 && next.file == line_file_) {
      out_ += '\n';
      out_.append(indentOf(depth_), ' ');
      ++line_;
    } else {
      out_ += ' ';
    }
    at = chained;
  }
}

void StatementWriter::switchStatement(const ir::SwitchStmt& stmt) {
  checks().prepare(stmt.selector);
  const TypeKind kind = kindOf(stmt.selector);
  const bool is_unsigned = !types_.isSigned(kind);
  // A conversion to an integer may be written as the bool itself, which compilers warn of as a selector, or in a
  // narrower type, which does not hold all labels.
  ir::ExprId origin = stmt.selector;
  while (const auto* conversion = expr(origin).tryAs<ir::ConvertExpr>()) origin = conversion->operand;
  const bool is_narrow =
      origin != stmt.selector && types::TypeTable::bitWidth(types_.plainKind(expr(origin).type)) <
                                     types::TypeTable::bitWidth(types_.plainKind(expr(stmt.selector).type));
  out_ += "switch (";
  if (is_narrow) out_.append("(").append(scalarType(types_, expr(stmt.selector).type)).append(")");
  values().value(stmt.selector, is_narrow ? Prec::Unary : Prec::Comma);
  out_ += ')';
  open();
  const bool had_loop = !loops_.empty();
  const bool was_in_switch = had_loop && loops_.back().in_switch;
  if (had_loop) loops_.back().in_switch = true;

  // The first case that holds a value takes it: later ranges keep the rest.
  struct Range {
    uint64_t low, high;  // order-preserving
  };
  const uint64_t flip = is_unsigned ? 0 : uint64_t{1} << 63;
  std::vector<Range> taken;
  std::vector<Range> rest;
  auto label = [&](uint64_t bits) { appendConstant(out_, types_, expr(stmt.selector).type, bits); };
  for (const ir::Case& one : body_->list(stmt.cases)) {
    rest.clear();
    for (const ir::CaseRange& range : body_->list(one.ranges)) {
      std::vector<Range> parts{{static_cast<uint64_t>(range.low) ^ flip, static_cast<uint64_t>(range.high) ^ flip}};
      // `taken` is sorted and disjoint.
      auto from = std::lower_bound(taken.begin(), taken.end(), parts[0].low,
                                   [](const Range& t, uint64_t low) { return t.high < low; });
      for (auto it = from; it != taken.end() && it->low <= parts.back().high; ++it) {
        const Range last = parts.back();
        parts.pop_back();
        if (last.low < it->low) parts.push_back({last.low, it->low - 1});
        if (last.high > it->high) {
          parts.push_back({it->high + 1, last.high});
        } else {
          break;
        }
        if (parts.empty()) break;
      }
      for (const Range& part : parts) {
        rest.push_back(part);
        taken.insert(std::lower_bound(taken.begin(), taken.end(), part.low,
                                      [](const Range& t, uint64_t low) { return t.low < low; }),
                     part);
      }
    }
    if (rest.empty()) continue;  // unreachable
    if (one.block) {
      begin(body_->stmt(one.block).loc);
    } else {
      out_ += ' ';
    }
    for (const Range& range : rest) {
      out_ += "case ";
      label(range.low ^ flip);
      if (range.low != range.high) {
        out_ += " ... ";
        label(range.high ^ flip);
      }
      out_ += ": ";
    }
    out_ += '{';
    ++depth_;
    block(one.block);
    if (!endsInJump(one.block)) {
      flushCloses(0);
      out_ += " break;";
    }
    close();
  }
  if (stmt.else_block) {
    begin(body_->stmt(stmt.else_block).loc);
    out_ += "default: {";
    ++depth_;
    block(stmt.else_block);
    if (!endsInJump(stmt.else_block)) {
      flushCloses(0);
      out_ += " break;";
    }
    close();
  }
  close();
  if (had_loop) loops_.back().in_switch = was_in_switch;
}

// ---- faults and tests

void StatementWriter::faultStatement(const ir::FaultStmt& stmt, Loc loc) {
  if (stmt.value) checks().prepare(stmt.value);
  out_ += "at = ";
  // The bounds of an ARRAY[*] are not known here: low above high marks that.
  appendUnsigned(out_,
                 stmt.fault == Fault::Index ? checks().site(loc, stmt.fault, 1, 0) : checks().site(loc, stmt.fault));
  out_ += "; value = ";
  if (stmt.value) {
    out_ += "(int64_t)";
    values().value(stmt.value, Prec::Unary);
  } else {
    out_ += '0';
  }
  out_ += "; goto fault;";
}

// A block of a try is a separate function that the runtime calls between setjmp and longjmp: what it shares with the
// body is then in memory, and the compiler knows it.
void StatementWriter::guarded(const std::string& frame, const std::string& fault, StmtId first) {
  std::vector<Loop> outer_loops = loops_;
  for (Loop& loop : loops_) loop.try_depth += 1;
  out_ += "{ auto " + frame + " = [&]()";  // in a separate scope: a jump to `fault` from before must not enter it
  open();
  const bool outer_uses_fault = state_.uses_fault;
  state_.uses_fault = false;
  block(first);
  flushCloses(0);
  out_ += " return;";
  if (state_.uses_fault) {
    out_ += " fault: rung_raise(ctx, at & 15, sites_" + group_.stem + " + (at >> 4), value);";
  }
  state_.uses_fault = outer_uses_fault;
  --depth_;
  out_ += " }; " + fault + " = rung_try(ctx, [](void* frame) { (*static_cast<decltype(" + frame +
          ")*>(frame))(); }, &" + frame + "); }";
  loops_ = std::move(outer_loops);
}

void StatementWriter::tryStatement(const ir::TryStmt& stmt) {
  const std::string exit = newName("x"), fault = newName("k");
  declarations_ += " uint32_t " + exit + " = 0; uint8_t " + fault + " = 0;";
  frames_.push_back({});
  frames_.back().exit = exit;
  out_ += exit + " = 0; ";
  guarded(newName("f"), fault, stmt.body_block);
  if (stmt.catches) {
    TryFrame frame = frames_.back();
    const bool has_finally = static_cast<bool>(stmt.finally_block);
    if (!has_finally) frames_.pop_back();
    out_ += " if (" + fault + " != 0)";
    open();
    if (stmt.number) {
      out_ += ' ';
      places().store(stmt.number, fault);
      out_ += ';';
    }
    if (has_finally) {
      out_ += ' ';
      guarded(newName("f"), fault, stmt.catch_block);
    } else {
      block(stmt.catch_block);
    }
    close();
    flushCloses(0);
    if (!has_finally) frames_.push_back(frame);
  }
  const TryFrame frame = frames_.back();
  frames_.pop_back();
  if (stmt.finally_block) {
    out_ += " {";
    ++depth_;
    block(stmt.finally_block);
    close();
    flushCloses(0);
  }
  if (!stmt.catches || stmt.finally_block) {
    out_ += " if (" + fault + " != 0) rung_raise(ctx, ctx->fault.kind, ctx->fault.site, ctx->fault.value);";
  }
  if (frame.returns) {
    out_ += " if (" + exit + " == 1) { ";
    leave();
    out_ += " }";
  }
  if (frame.breaks) {
    out_ += " if (" + exit + " == 2) { ";
    breakLoop();
    out_ += " }";
  }
  if (frame.continues) {
    out_ += " if (" + exit + " == 3) { ";
    continueLoop();
    out_ += " }";
  }
}

void StatementWriter::assertStatement(const Stmt& stmt) {
  const ir::AssertStmt& node = stmt.as<ir::AssertStmt>();
  const ExprId first = node.first, second = node.second, third = node.third;
  for (const ExprId operand : {first, second, third, node.message}) {
    if (operand) checks().prepare(operand);
  }
  const ir::AssertionReport report = ir::assertionReport(module_, *body_, stmt);
  const auto quotedOrNull = [&](std::string_view string) {
    if (string.empty()) {
      out_ += "nullptr";
    } else {
      appendQuoted(out_, string);
    }
  };
  out_ += node.message ? "{ const rung_assertion assertion = {" : "{ static const rung_assertion assertion = {";
  appendQuoted(out_, report.position.path);
  out_ += ", ";
  appendUnsigned(out_, report.position.line);
  out_ += ", ";
  appendUnsigned(out_, report.position.column);
  out_ += ", ";
  quotedOrNull(report.source);
  out_ += ", ";
  if (node.message)
    strings().stringValue(node.message);
  else
    quotedOrNull(report.message);
  for (const std::string_view string : {report.shown, std::string_view(report.items)}) {
    out_ += ", ";
    quotedOrNull(string);
  }
  out_ += "}; ";

  const auto kind = [&](TypeId type) {
    if (types_.info(types_.resolve(type)).kind == TypeKind::Enum) {
      out_ += "RUNG_ENUM";
    } else {
      out_ += typeKindName(types_, type);
    }
  };
  const auto bits = [&](ExprId id) {
    out_ += ", ";
    if (!isString(expr(id).type)) return values().scalarBits(id);
    out_ += "(uint64_t)(uintptr_t)";
    strings().stringValue(id);
  };
  switch (node.assertion) {
    case ir::Assertion::Assert:
      out_ += second ? "rung_assert_compared(ctx, &assertion, " : "rung_assert(ctx, &assertion, ";
      values().condition(first, Prec::Ternary);
      if (!second) break;
      out_ += ", ";
      kind(expr(second).type);
      bits(second);
      bits(third);
      break;
    case ir::Assertion::AssertNear:
      out_ += "rung_assert_near(ctx, &assertion, ";
      kind(expr(second).type);
      for (ExprId id : {first, second, third}) {
        out_ += ", ";
        values().value(id, Prec::Ternary);
      }
      break;
    case ir::Assertion::AssertEq: {
      const TypeId type = expr(second).type;
      if (isAggregate(type) && !isString(type)) {
        out_ += "rung_assert(ctx, &assertion, memcmp(&";
        places().place(first);
        out_ += ", &";
        places().place(second);
        out_ += ", ";
        appendUnsigned(out_, types_.info(types_.resolve(type)).size);
        out_ += ") == 0";
      } else {
        out_ += "rung_assert_equal(ctx, &assertion, ";
        kind(type);
        bits(first);
        bits(second);
      }
      break;
    }
  }
  out_ += "); }";
}

}  // namespace rung::codegen

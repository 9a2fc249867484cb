// SPDX-License-Identifier: Apache-2.0
// Statements of a body in C++, each at the location of its source: see body.h. In: statements of the IR. Out: those of
// C++ (cxx/nodes.h).
#include <algorithm>

#include "codegen/body_parts.h"
#include "codegen/cxx/print.h"
#include "ir/assertion.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::Fault;

namespace {

constexpr uint32_t kDeepestBraces = 200;  // clang++ takes 256

}  // namespace

cxx::Position StatementWriter::positionOf(Loc loc) {
  if (!options_.line_directives) return {};
  if (body_->origin.path) return {tree_.file(string(body_->origin.path)), body_->origin.line};
  if (!loc) return {};
  const SourceLocation location = module_.sources.location(loc);
  if (location.file != state_.last_file) {
    state_.last_file = location.file;
    state_.last_file_number = tree_.file(module_.sources.path(location.file));
  }
  return {state_.last_file_number, location.line};
}

void StatementWriter::begin(Loc loc) { state_.begin(positionOf(loc)); }

// Adds a statement with a block, whose braces are one level deeper than it.
void StatementWriter::addWithBlock(cxx::Stmt* stmt, StmtId first) {
  add(stmt);
  stmt->first = blockOf(first).first();
}

cxx::Statements StatementWriter::blockOf(StmtId first) {
  return deeper([&] { block(first); });
}

void StatementWriter::block(StmtId first) {
  for (StmtId id = first; id; id = body_->stmt(id).next) statement(id, body_->stmt(id));
}

void StatementWriter::statement(StmtId id, const Stmt& stmt) {
  if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && facts_.is_zeroing[call->callee.index] != 0) {
    // An initialiser begins by clearing the whole record.
    if (body_->kind == ir::BodyKind::Init && expr(ir::rootOf(*body_, call->self)).kind == ExprKind::Self) return;
    begin(stmt.loc);
    checks().prepare(call->self);
    clear(places().place(call->self));
    return strings().forgetLengths(id);
  }
  begin(stmt.loc);
  places().holdBytes(id);
  strings().countLengths(id);
  write(id, stmt);
  if (places().releasesBytes(id)) places().releaseBytes(id);
}

void StatementWriter::write(StmtId id, const Stmt& stmt) {
  switch (stmt.kind) {
    case StmtKind::None: return add(tree_.stmt(cxx::StmtKind::Empty));
    case StmtKind::Assign: assignStatement(stmt.as<ir::AssignStmt>()); return strings().forgetLengths(id);
    case StmtKind::Bind: bindStatement(stmt.as<ir::BindStmt>()); return strings().forgetLengths(id);
    case StmtKind::Call: calls().callStatement(id); return strings().forgetLengths(id);
    case StmtKind::If: return ifStatement(stmt.as<ir::IfStmt>());
    case StmtKind::Switch: return switchStatement(stmt.as<ir::SwitchStmt>());
    case StmtKind::Loop: return loopStatement(stmt.as<ir::LoopStmt>(), stmt.loc);
    case StmtKind::For: return forStatement(id, stmt.as<ir::ForStmt>());
    case StmtKind::Break: return breakLoop();
    case StmtKind::Continue: return continueLoop();
    case StmtKind::Return: return leave();
    case StmtKind::Jump: return addGoto(mangled(body_->labels[stmt.as<ir::JumpStmt>().label]));
    case StmtKind::Label: addLabel(mangled(body_->labels[stmt.as<ir::LabelStmt>().label])); return step(stmt.loc);
    case StmtKind::Try: return tryStatement(stmt.as<ir::TryStmt>());
    case StmtKind::Fault: return faultStatement(stmt.as<ir::FaultStmt>(), stmt.loc);
    case StmtKind::Assert: return assertStatement(stmt);
    case StmtKind::Evaluate: return checks().prepare(stmt.as<ir::EvaluateStmt>().value);
  }
}

void StatementWriter::assignStatement(const ir::AssignStmt& stmt) {
  const ExprId to = stmt.place, from = stmt.value;
  const TypeId type = expr(to).type;
  if (isString(type)) {
    if (isSlice(to)) return strings().assignSlice(to, from);
    checks().prepare(to);
    strings().prepareString(from);
    const Ex name = places().place(to), length = isMeasured(to) ? strings().lengthName(to) : nullptr;
    return strings().copyString({name, capacityOf(type), isWide(type), length}, from);
  }
  if (isAggregate(type)) return assignAggregate(to, from);
  checks().prepare(to);
  checks().prepare(from);
  if (ir::isImageBit(expr(to)) && values().isContacts(from)) return perform(places().storeBit(to, from));
  if (!places().isLvalue(to)) return perform(places().store(to, values().value(from)));
  const Ex place = places().place(to);
  assign(place, values().value(from));
}

void StatementWriter::assignAggregate(ExprId to, ExprId from) {
  checks().prepare(to);
  const Ex place = places().place(to);
  const Expr& source = expr(from);
  if (source.kind == ExprKind::Zero) return clear(place);
  if (const auto* data = source.tryAs<ir::DataExpr>()) {
    const Ex bytes = places().dataReference(data->index);
    return perform(tree_.call("memcpy", {addressOf(place), bytes, sizeOf(place)}));
  }
  checks().prepare(from);
  const Ex value = places().place(from);
  if (cxx::same(value, place)) return;
  if (types_.kind(expr(to).type) == TypeKind::Record && !places().isImagePlace(to) && !places().isImagePlace(from))
    return assign(place, value);
  perform(tree_.call("memmove", {addressOf(place), addressOf(value), sizeOf(place)}));
}

void StatementWriter::bindStatement(const ir::BindStmt& stmt) {
  checks().prepareChildren(expr(stmt.field));  // the field itself holds no variable yet
  if (stmt.place) checks().prepare(stmt.place);
  const ir::FieldExpr& field = expr(stmt.field).as<ir::FieldExpr>();
  const types::Field& info = fieldOf(field);
  const Ex member = places().member(field.base, info.name);
  if (!stmt.place) return assign(member, tree_.fixed("nullptr"));
  const Ex place = places().place(stmt.place);
  // The variable may have another type with the same memory.
  assign(member, isString(info.type) ? place : tree_.cast(pointerTo(info.type), addressOf(place)));
}

// `return`, after the locals are written back; in the frame of a try the frame's caller does that.
void StatementWriter::leave() {
  if (!frames_.empty()) {
    frames_.back().returns = true;
    return leaveFrame(1);
  }
  if (hasExit()) {
    state_.uses_leave = true;
    return addGoto("leave");
  }
  cxx::Stmt* const stmt = tree_.stmt(cxx::StmtKind::Return);
  for (const ir::Local& local : body_->locals)
    if (stmt->a == nullptr && local.kind == ir::LocalKind::Result && !local.by_reference) stmt->a = variable(local);
  add(stmt);
}

// Leaves the function of a try for its caller, which goes on as `how` says.
void StatementWriter::leaveFrame(uint32_t how) {
  assign(tree_.name(frames_.back().exit), tree_.number(how));
  add(tree_.stmt(cxx::StmtKind::Return));
}

void StatementWriter::addGoto(std::string_view label) { add(tree_.textual(cxx::StmtKind::Goto, label)); }
void StatementWriter::addLabel(std::string_view label) { add(tree_.textual(cxx::StmtKind::Label, label)); }

bool StatementWriter::endsInJump(StmtId first) const {
  StmtKind last = StmtKind::None;
  for (StmtId id = first; id; id = body_->stmt(id).next) last = body_->stmt(id).kind;
  return ir::flowOf(last) == ir::StmtFlow::Leaves;
}

// Without braces: every variable is declared at the top, so jumps cross no initialisation.
void StatementWriter::deepIf(const ir::IfStmt& stmt) {
  const std::string otherwise = newName("else"), end = newName("end");
  checks().prepare(stmt.condition);
  cxx::Stmt* const test = tree_.stmt(cxx::StmtKind::ShortIf, tree_.prefix("!", values().condition(stmt.condition)));
  add(test);
  test->first = tree_.textual(cxx::StmtKind::Goto, otherwise);
  block(stmt.then_block);
  if (stmt.else_block) addGoto(end);
  addLabel(otherwise);
  if (!stmt.else_block) return;
  block(stmt.else_block);
  addLabel(end);
}

void StatementWriter::ifStatement(const ir::IfStmt& stmt) {
  if (depth_ > kDeepestBraces) return deepIf(stmt);
  checks().prepare(stmt.condition);
  cxx::Stmt* made = tree_.stmt(cxx::StmtKind::If, values().condition(stmt.condition));
  addWithBlock(made, stmt.then_block);
  for (const ir::IfStmt* at = &stmt; at->else_block;) {
    const Stmt& other = body_->stmt(at->else_block);
    made->second_at = positionOf(other.loc);
    const auto* chained = other.next ? nullptr : other.tryAs<ir::IfStmt>();
    made->is_chained = chained != nullptr && !checks().needsPreparation(chained->condition) &&
                       !analysis_->lengths.countsBefore(at->else_block) && !places().holdsBytesFrom(at->else_block);
    if (!made->is_chained) {
      made->second = blockOf(at->else_block).first();
      return;
    }
    made->second = tree_.stmt(cxx::StmtKind::If, values().condition(chained->condition));
    made = made->second;
    made->first = blockOf(chained->then_block).first();
    at = chained;
  }
}

void StatementWriter::switchStatement(const ir::SwitchStmt& stmt) {
  checks().prepare(stmt.selector);
  const TypeId type = expr(stmt.selector).type;
  // A conversion to an integer may be written as the bool itself, which compilers warn of as a selector, or in a
  // narrower type, which does not hold all labels.
  ir::ExprId origin = stmt.selector;
  while (const auto* conversion = expr(origin).tryAs<ir::ConvertExpr>()) origin = conversion->operand;
  const bool is_narrow = origin != stmt.selector && widthOf(kindOf(origin)) < widthOf(kindOf(stmt.selector));
  const Ex selector = values().value(stmt.selector);
  cxx::Stmt* const made =
      tree_.stmt(cxx::StmtKind::Switch, is_narrow ? tree_.cast(scalarType(types_, type), selector) : selector);
  add(made);
  const bool had_loop = !loops_.empty();
  const bool was_in_switch = had_loop && loops_.back().in_switch;
  if (had_loop) loops_.back().in_switch = true;
  made->first = deeper([&] { switchCases(stmt, type); }).first();
  if (had_loop) loops_.back().in_switch = was_in_switch;
}

void StatementWriter::switchCases(const ir::SwitchStmt& stmt, TypeId type) {
  // The first case that holds a value takes it: later ranges keep the rest.
  struct Range {
    uint64_t low, high;  // order-preserving
  };
  const uint64_t flip = types_.isSigned(types_.plainKind(type)) ? uint64_t{1} << 63 : 0;
  std::vector<Range> taken;
  std::vector<Range> rest;
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
    std::vector<cxx::CaseLabel> labels;
    for (const Range& range : rest) {
      const Ex low = constantOf(type, range.low ^ flip);
      labels.push_back({low, range.low == range.high ? nullptr : constantOf(type, range.high ^ flip)});
    }
    switchCase(labels, one.block);
  }
  if (stmt.else_block) switchCase({}, stmt.else_block);
}

void StatementWriter::switchCase(const std::vector<cxx::CaseLabel>& labels, StmtId first) {
  if (first) begin(body_->stmt(first).loc);
  cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::Case);
  made->labels = tree_.copy(labels);
  add(made);
  made->first = deeper([&] {
                  block(first);
                  if (!endsInJump(first)) add(tree_.stmt(cxx::StmtKind::Break));
                }).first();
}

// ---- faults and tests

void StatementWriter::faultStatement(const ir::FaultStmt& stmt, Loc loc) {
  if (stmt.value) checks().prepare(stmt.value);
  // The bounds of an ARRAY[*] are not known here: low above high marks that.
  const uint32_t site =
      stmt.fault == Fault::Index ? checks().site(loc, stmt.fault, 1, 0) : checks().site(loc, stmt.fault);
  assign(tree_.fixed("at"), tree_.number(site));
  assign(tree_.fixed("value"), stmt.value ? tree_.cast("int64_t", values().value(stmt.value)) : tree_.number(0));
  addGoto("fault");
}

// A block of a try is a separate function that the runtime calls between setjmp and longjmp: what it shares with the
// body is then in memory, and the compiler knows it. It is in a scope of its own: a jump to `fault` from before must
// not enter it.
void StatementWriter::guarded(const std::string& frame, const std::string& fault, StmtId first) {
  std::vector<Loop> outer_loops = loops_;
  for (Loop& loop : loops_) loop.try_depth += 1;
  const bool outer_uses_fault = state_.uses_fault;
  state_.uses_fault = false;
  cxx::Stmt* const made = tree_.textual(cxx::StmtKind::Frame, frame);
  const Ex passed = tree_.call("static_cast<decltype(" + frame + ")*>", {tree_.fixed("frame")});
  const Ex run = tree_.lambda("void* frame", tree_.invoke(tree_.prefix("*", passed), {}));
  made->a = tree_.infix(Operator::Assign, tree_.name(fault),
                        tree_.call("rung_try", {tree_.fixed("ctx"), run, addressOf(tree_.name(frame))}));
  add(made);
  made->first = deeper([&] {
                  block(first);
                  add(tree_.stmt(cxx::StmtKind::Return));
                  if (!state_.uses_fault) return;
                  cxx::Stmt* const raise = tree_.textual(cxx::StmtKind::Label, "fault");
                  raise->a = raiseNoted();
                  add(raise);
                }).first();
  state_.uses_fault = outer_uses_fault;
  loops_ = std::move(outer_loops);
}

void StatementWriter::tryStatement(const ir::TryStmt& stmt) {
  const std::string exit = newName("x"), fault = newName("k");
  const Ex exit_name = tree_.name(exit), fault_name = tree_.name(fault), zero = tree_.number(0);
  declare("uint32_t", exit, zero);
  declare("uint8_t", fault, zero);
  frames_.push_back({});
  frames_.back().exit = exit;
  assign(exit_name, zero);
  guarded(newName("f"), fault, stmt.body_block);
  const Ex has_fault = tree_.infix(Operator::Differs, fault_name, zero);
  if (stmt.catches) {
    TryFrame frame = frames_.back();
    const bool has_finally = static_cast<bool>(stmt.finally_block);
    if (!has_finally) frames_.pop_back();
    cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::If, has_fault);
    add(made);
    made->first = deeper([&] {
                    if (stmt.number) perform(places().store(stmt.number, fault_name));
                    has_finally ? guarded(newName("f"), fault, stmt.catch_block) : block(stmt.catch_block);
                  }).first();
    if (!has_finally) frames_.push_back(frame);
  }
  const TryFrame frame = frames_.back();
  frames_.pop_back();
  if (stmt.finally_block) addWithBlock(tree_.stmt(cxx::StmtKind::Block), stmt.finally_block);
  if (!stmt.catches || stmt.finally_block) {
    cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::ShortIf, has_fault);
    add(made);
    made->first = nested([&] {
                    const Ex context = tree_.fixed("ctx"), raised = tree_.arrow(context, "fault");
                    perform(tree_.call("rung_raise", {context, tree_.member(raised, "kind"),
                                                      tree_.member(raised, "site"), tree_.member(raised, "value")}));
                  }).first();
  }
  const auto goesOn = [&](bool used, uint32_t how, auto&& write) {
    if (!used) return;
    cxx::Stmt* const made =
        tree_.stmt(cxx::StmtKind::BracedIf, tree_.infix(Operator::Equal, exit_name, tree_.number(how)));
    add(made);
    made->first = nested(write).first();
  };
  goesOn(frame.returns, 1, [&] { leave(); });
  goesOn(frame.breaks, 2, [&] { breakLoop(); });
  goesOn(frame.continues, 3, [&] { continueLoop(); });
}

// The constants of a report, which a test prints where the assertion fails.
cxx::Stmt* StatementWriter::assertionReport(const Stmt& stmt) {
  const ir::AssertStmt& node = stmt.as<ir::AssertStmt>();
  const ir::AssertionReport report = ir::assertionReport(module_, *body_, stmt);
  const auto quotedOrNull = [&](std::string_view text) { return text.empty() ? tree_.fixed("nullptr") : quoted(text); };
  const Ex values = tree_.braces({quoted(report.position.path), tree_.number(report.position.line),
                                  tree_.number(report.position.column), quotedOrNull(report.source),
                                  node.message ? strings().stringValue(node.message) : quotedOrNull(report.message),
                                  quotedOrNull(report.shown), quotedOrNull(report.items)});
  cxx::Variable* const assertion = tree_.variable("rung_assertion", "assertion", values);
  assertion->prefix = node.message ? "const" : "static const";
  return tree_.declare(assertion);
}

void StatementWriter::assertStatement(const Stmt& stmt) {
  const ir::AssertStmt& node = stmt.as<ir::AssertStmt>();
  for (const ExprId operand : {node.first, node.second, node.third, node.message}) {
    if (operand) checks().prepare(operand);
  }
  cxx::Stmt* const scope = tree_.stmt(cxx::StmtKind::Scope);
  add(scope);
  scope->first = nested([&] {
                   add(assertionReport(stmt));
                   perform(assertionCall(node));
                 }).first();
}

cxx::Ex StatementWriter::assertionCall(const ir::AssertStmt& node) {
  const ExprId first = node.first, second = node.second, third = node.third;
  std::vector<Ex> arguments{tree_.fixed("ctx"), tree_.fixed("&assertion")};
  const auto pass = [&](Ex argument) { arguments.push_back(argument); };
  const auto kind = [&](TypeId type) {
    const bool is_enum = types_.info(types_.resolve(type)).kind == TypeKind::Enum;
    pass(tree_.fixed(is_enum ? "RUNG_ENUM" : typeKindName(types_, type)));
  };
  const auto bits = [&](ExprId id) {
    if (!isString(expr(id).type)) return pass(values().scalarBits(id));
    pass(tree_.cast("uint64_t", tree_.cast("uintptr_t", strings().stringValue(id))));
  };
  switch (node.assertion) {
    case ir::Assertion::Assert:
      pass(values().condition(first));
      if (!second) return tree_.call("rung_assert", arguments);
      kind(expr(second).type);
      bits(second);
      bits(third);
      return tree_.call("rung_assert_compared", arguments);
    case ir::Assertion::AssertNear:
      kind(expr(second).type);
      for (const ExprId id : {first, second, third}) pass(values().value(id));
      return tree_.call("rung_assert_near", arguments);
    case ir::Assertion::AssertEq: {
      const TypeId type = expr(second).type;
      if (isAggregate(type) && !isString(type)) {
        const Ex a = addressOf(places().place(first)), b = addressOf(places().place(second));
        pass(strings().sameBytes(a, b, tree_.number(types_.info(types_.resolve(type)).size)));
        return tree_.call("rung_assert", arguments);
      }
      kind(type);
      bits(first);
      bits(second);
      return tree_.call("rung_assert_equal", arguments);
    }
  }
  return nullptr;
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// The choice of measured strings, and where their lengths are known: see lengths.h.
#include "codegen/lengths.h"

#include <algorithm>

#include "codegen/foreign_writes.h"
#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/slices.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::ExprId;
using ir::LocalKind;
using ir::Stmt;
using ir::StmtId;
using ir::StmtKind;
using types::TypeKind;
using types::TypeTable;

namespace {

constexpr uint32_t kWorthCounting = 3;  // uses that justify counting the length
constexpr uint32_t kWorthKeeping = 2;   // the same where it is known from the first write

bool isString(const ir::Module& module, TypeId type) { return TypeTable::isString(module.types.kind(type)); }

}  // namespace

bool isSized(const ir::Module& module, const ir::Body& callee) {
  const auto is_other = [&](TypeId type) {
    const TypeKind kind = module.types.plainKind(type);
    return kind != TypeKind::String && !TypeTable::isInteger(kind) && !TypeTable::isBits(kind);
  };
  if (!callee.sized || is_other(callee.result)) return false;
  for (const ir::Local& local : callee.locals) {
    if (is_other(local.type)) return false;
  }
  return true;
}

bool StringsOfBody::isSizedCall(const ir::Body& callee, Slice<ExprId> operands, ExprId result) const {
  if (!isSized(module, callee)) return false;
  const bool gives_string = result && isString(module, body.expr(result).type);
  if (gives_string) {
    if (module.types.kind(body.expr(result).type) == TypeKind::WString) return false;
    if (isOwn(result)) return true;
  }
  const uint32_t to = gives_string ? variables.stringAt(result) : kNoVariable;
  bool has_measured = measured.has(to), all_apart = true;
  for (const ExprId operand : body.list(operands)) {
    const ir::Expr& e = body.expr(operand);
    if (!isString(module, e.type)) continue;
    has_measured = has_measured || isMeasured(operand);
    all_apart = all_apart && (isOwn(operand) || e.kind == ir::ExprKind::String || e.kind == ir::ExprKind::Zero ||
                              (measured.isShared(to) && variables.stringAt(operand) == to));
  }
  return has_measured && (all_apart || !gives_string);
}

namespace {

// How the length of a variable is kept.
MeasuredStrings::As waysOf(const ir::Module& module, const ir::Body& body, const Facts& facts, const Uses& uses,
                           uint32_t variable) {
  const Variables& variables = uses.variables;
  const VariableUse& use = uses.of[variable];
  bool is_shared = use.exposed;
  uint32_t worth = kWorthCounting;
  if (variables.isField(variable)) {
    if (variables.field(variable).by_reference) return MeasuredStrings::As::No;
    is_shared = is_shared || facts.exposure.isExposed(variables.record(), variables.fieldIndex(variable));
  } else {
    const ir::Local& local = variables.local(variable);
    is_shared = is_shared || local.kind == LocalKind::InOut || local.kind == LocalKind::Output;
    if (passesLength(module, body, local)) worth = use.written ? 0 : 1;  // caller and callee share the work
    if (!is_shared && local.kind != LocalKind::Input) worth = kWorthKeeping;
  }
  if (use.sized_weight < worth) return MeasuredStrings::As::No;
  return is_shared ? MeasuredStrings::As::Shared : MeasuredStrings::As::Own;
}

// A loop that counts in a variable that others reach writes it without a statement of its own.
bool countsForeign(const ir::Module& module, const ir::Body& body, const Facts& facts) {
  const ForeignWrites foreign(module, body, facts.exposure);
  for (const Stmt& stmt : body.stmts)
    if (stmt.kind == StmtKind::For && foreign.by(stmt)) return true;
  return false;
}

}  // namespace

MeasuredStrings analyzeLengths(const ir::Module& module, const ir::Body& body, const Facts& facts, const Uses& uses) {
  using As = MeasuredStrings::As;
  MeasuredStrings strings;
  strings.as.resize(uses.variables.count());
  if (uses.has_try || body.has_labels) return strings;
  bool has_shared = false;
  for (uint32_t i = 0; i < strings.as.size(); ++i) {
    strings.as[i] = waysOf(module, body, facts, uses, i);
    strings.any = strings.any || strings.as[i] != As::No;
    has_shared = has_shared || strings.as[i] == As::Shared;
  }
  if (has_shared && countsForeign(module, body, facts))
    std::replace(strings.as.begin(), strings.as.end(), As::Shared, As::No);
  return strings;
}

std::string MeasuredStrings::toString(const Variables& variables) const {
  std::vector<std::string> rows(as.size());
  for (uint32_t i = 0; i < rows.size(); ++i) {
    if (has(i)) rows[i] = isShared(i) ? " measured shared" : " measured";
  }
  return variables.lines(rows);
}

// ---- where a length is known

namespace {

class LengthFlow {
 public:
  LengthFlow(const StringsOfBody& strings, const Slices& slices, const Facts& facts)
      : strings_(strings),
        body_(strings.body),
        variables_(strings.variables),
        foreign_(strings.module, strings.body, facts.exposure),
        known_(strings.variables.count()) {
    // All but inputs and fields are written before they are read.
    for (uint32_t i = 0; i < variables_.count(); ++i) {
      if (strings.measured.isShared(i)) shared_.push_back(i);
      if (!strings.measured.isOwn(i)) continue;
      if (variables_.isField(i) ? slices.has(i) : variables_.local(i).kind != LocalKind::Input) known_.set(i);
    }
  }

  KnownLengths run() {
    result_.is_known.resize(body_.exprs.size());
    result_.counted.resize(body_.stmts.size());
    if (!shared_.empty()) result_.forgets.resize(body_.stmts.size());
    block(body_.first);
    return std::move(result_);
  }

 private:
  void set(ExprId place) {
    if (const uint32_t variable = variables_.stringAt(place); strings_.measured.has(variable)) known_.set(variable);
  }
  bool isUnknown(ExprId place) const {
    const uint32_t variable = variables_.stringAt(place);
    return strings_.measured.has(variable) && !known_.has(variable);
  }

  void need(ExprId place) {
    if (!isUnknown(place) || (is_in_front_ && !strings_.isOwn(place))) return;
    needed_.push_back(place);
    set(place);
  }

  void needOf(ExprId id) {
    const ir::Expr& e = body_.expr(id);
    const auto* call = e.tryAs<ir::CallExpr>();
    if (call != nullptr && strings_.isSizedCall(strings_.module.body(call->callee), call->operands, {})) {
      for (const ExprId operand : body_.list(call->operands)) need(operand);
    }
    ir::forEachOperand(body_, e, [&](ExprId operand) { needOf(operand); });
  }

  // The lengths that the expressions of one statement need.
  void needOf(const Stmt& stmt) {
    ir::forEachRoot(strings_.module, body_, stmt, [&](ExprId root, ir::Use) { needOf(root); });
    const auto* assign = stmt.tryAs<ir::AssignStmt>();
    if (assign != nullptr && strings_.isMeasured(assign->place)) need(assign->value);
    const auto* call = stmt.tryAs<ir::CallStmt>();
    if (call == nullptr || !strings_.isSizedCall(strings_.module.body(call->callee), call->operands, call->result)) {
      return;
    }
    for (const ExprId operand : body_.list(call->operands)) need(operand);
  }

  // The lengths that a block needs before it starts, without those that it makes known itself.
  void needOfBlock(StmtId first) {
    const size_t mark = known_.mark();
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& stmt = body_.stmt(id);
      needOf(stmt);
      ir::forEachBlock(body_, stmt, [&](StmtId child) { needOfBlock(child); });
      setWritten(stmt);
    }
    known_.forget(mark);
  }

  void forgetShared() {
    for (const uint32_t variable : shared_) known_.unset(variable);
  }

  void setWritten(const Stmt& stmt) {
    if (const auto* assign = stmt.tryAs<ir::AssignStmt>()) set(assign->place);
    if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && call->result) set(call->result);
  }

  void record(ExprId id) {
    const uint32_t variable = variables_.stringAt(id);
    if (strings_.measured.has(variable)) result_.is_known[id.index] = known_.has(variable);
    ir::forEachOperand(body_, body_.expr(id), [&](ExprId operand) { record(operand); });
  }

  void block(StmtId first) {
    const size_t mark = known_.mark();
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& stmt = body_.stmt(id);
      needed_.clear();
      needOf(stmt);
      if (stmt.kind == StmtKind::Loop || stmt.kind == StmtKind::For) {  // all that its iterations need
        const size_t before = known_.mark();
        is_in_front_ = true;
        ir::forEachBlock(body_, stmt, [&](StmtId child) { needOfBlock(child); });
        is_in_front_ = false;
        known_.forget(before);
      }
      for (const ExprId place : needed_) set(place);
      result_.counted[id.index] = needed_;
      ir::forEachRoot(strings_.module, body_, stmt, [&](ExprId root, ir::Use) { record(root); });
      const bool loops = stmt.kind == StmtKind::Loop || stmt.kind == StmtKind::For;
      if (loops) forgetShared();  // an earlier iteration may have changed them
      ir::forEachBlock(body_, stmt, [&](StmtId child) { block(child); });
      if (!shared_.empty() && foreign_.by(stmt)) {
        forgetShared();
        result_.forgets[id.index] = 1;
      }
      setWritten(stmt);
    }
    known_.forget(mark);
  }

  const StringsOfBody& strings_;
  const ir::Body& body_;
  const Variables& variables_;
  ForeignWrites foreign_;
  KnownStrings known_;
  std::vector<uint32_t> shared_;
  bool is_in_front_ = false;  // of a loop
  std::vector<ExprId> needed_;
  KnownLengths result_;
};

}  // namespace

KnownLengths analyzeKnownLengths(const StringsOfBody& strings, const Slices& slices, const Facts& facts) {
  if (!strings.measured.any) return {};
  return LengthFlow(strings, slices, facts).run();
}

std::string KnownLengths::toString(const ir::Module& module, const ir::Body& body, const Variables& variables) const {
  std::string out;
  for (uint32_t i = 0; i < counted.size(); ++i) {
    for (const ExprId place : counted[i]) {
      const uint32_t variable = variables.stringAt(place);
      out += "count ";
      out += module.names.string(variables.isField(variable) ? variables.field(variable).name
                                                             : variables.local(variable).name);
      out += " before a ";
      out += body.stmts[i].kind == StmtKind::For || body.stmts[i].kind == StmtKind::Loop ? "loop\n" : "statement\n";
    }
    if (forgetsAfter(StmtId{i})) out += "forget shared strings\n";
  }
  return out;
}

}  // namespace rung::codegen

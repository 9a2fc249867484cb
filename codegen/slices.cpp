// SPDX-License-Identifier: Apache-2.0
// The choice of slices: see slices.h. Starts with all candidates and drops those that break a condition.
#include "codegen/slices.h"

#include "ir/walk.h"

namespace rung::codegen {

using ir::Expr;
using ir::ExprId;
using ir::LocalKind;
using ir::Stmt;
using ir::StmtId;
using types::TypeKind;
using types::TypeTable;

ExprId uncut(const ir::Module& module, const ir::Body& body, ExprId id) {
  const types::TypeTable& types = module.types;
  auto is_wide = [&](TypeId type) { return types.kind(type) == TypeKind::WString; };
  for (;;) {
    const Expr& e = body.expr(id);
    const auto* convert = e.tryAs<ir::ConvertExpr>();
    if (convert == nullptr || e.checks != 0 || !TypeTable::isString(types.kind(e.type))) return id;
    const TypeId inner = body.expr(convert->operand).type;
    if (!TypeTable::isString(types.kind(inner)) || is_wide(inner) != is_wide(e.type)) return id;
    id = convert->operand;
  }
}

namespace {

class Judge {
 public:
  Judge(const StringsOfBody& strings, const Facts& facts, const Uses& uses)
      : strings_(strings),
        module_(strings.module),
        body_(strings.body),
        variables_(uses.variables),
        facts_(facts),
        uses_(uses),
        known_(uses.variables.count()) {}

  Slices run() {
    const uint32_t count = variables_.count();
    is_slice_.resize(count);
    taken_apart_.resize(count);
    for (uint32_t i = 0; i < count; ++i) is_slice_[i] = isCandidate(i);
    do {
      changed_ = false;
      block(body_.first);
      if (changed_) continue;
      for (uint32_t i = 0; i < count; ++i) {
        if (is_slice_[i] == 0 || taken_apart_[i] != 0) continue;
        is_slice_[i] = 0;
        changed_ = true;
      }
    } while (changed_);
    return {std::move(is_slice_)};
  }

 private:
  bool isCandidate(uint32_t variable) const {
    if (!strings_.measured.isOwn(variable) || !uses_.of[variable].sliced) return false;
    if (variables_.isField(variable)) return true;
    const LocalKind kind = variables_.local(variable).kind;
    return kind == LocalKind::Temp || kind == LocalKind::Variable;
  }

  bool isSlice(uint32_t variable) const { return variable != kNoVariable && is_slice_[variable] != 0; }
  bool isNarrow(ExprId id) const {
    const TypeKind kind = module_.types.kind(body_.expr(id).type);
    return TypeTable::isString(kind) && kind != TypeKind::WString;
  }

  // Something that does not change while the body runs, or a part of it.
  bool isSource(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (e.kind == ir::ExprKind::String) return module_.types.kind(e.type) != TypeKind::WString;
    if (e.kind == ir::ExprKind::Zero) return true;
    const uint32_t variable = variables_.stringAt(id);
    if (variable == kNoVariable || isSlice(variable)) return variable != kNoVariable;
    const VariableUse& use = uses_.of[variable];
    if (use.written || use.exposed) return false;
    if (!variables_.isField(variable)) return variables_.local(variable).kind == LocalKind::Input;
    return !facts_.exposure.isExposed(variables_.record(), variables_.fieldIndex(variable)) &&
           !variables_.field(variable).by_reference;
  }

  void refuse(uint32_t variable) {
    is_slice_[variable] = 0;
    changed_ = true;
  }

  void write(ExprId place, bool makes_slice) {
    const uint32_t variable = variables_.stringAt(place);
    if (variable == kNoVariable) {
      ir::forEachOperand(body_, body_.expr(place), [&](ExprId operand) { read(operand, false); });
      return;
    }
    if (!makes_slice && isSlice(variable)) refuse(variable);
    if (strings_.measured.isOwn(variable)) known_.set(variable);
  }

  bool isKnown(ExprId place) const { return known_.has(variables_.stringAt(place)); }

  // is_sized: the reader receives the length.
  void read(ExprId id, bool is_sized) {
    const Expr& e = body_.expr(id);
    if (const uint32_t variable = variables_.stringAt(id); isSlice(variable)) {
      if (!is_sized || !known_.has(variable)) refuse(variable);
      return;
    }
    bool reads_sized = false;
    if (const auto* call = e.tryAs<ir::CallExpr>()) {
      reads_sized = !TypeTable::isString(module_.types.kind(e.type)) &&
                    strings_.isSizedCall(module_.body(call->callee), call->operands, {});
    } else if (const auto* comparison = e.tryAs<ir::BinaryExpr>()) {
      reads_sized = strings_.isSizedComparison(*comparison, [&](ExprId side) { return isKnown(side); });
    }
    ir::forEachOperand(body_, e, [&](ExprId operand) { read(operand, reads_sized); });
  }

  void call(const ir::CallStmt& stmt) {
    const ir::Body& callee = module_.body(stmt.callee);
    const std::span<const ExprId> operands = body_.list(stmt.operands);
    const bool is_sized = !stmt.self && strings_.isSizedCall(callee, stmt.operands, stmt.result);
    if (stmt.self) read(stmt.self, false);
    for (const ExprId operand : operands) {
      if (operand) read(operand, is_sized);
    }
    if (!stmt.result) return;
    const bool makes_slice = is_sized && callee.slice && isSource(operands[0]);
    write(stmt.result, makes_slice);
    const uint32_t to = variables_.stringAt(stmt.result);
    if (makes_slice && to != kNoVariable && isSlice(variables_.stringAt(operands[0]))) taken_apart_[to] = 1;
  }

  void block(StmtId first) {
    const size_t mark = known_.mark();
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& stmt = body_.stmt(id);
      if (const auto* assign = stmt.tryAs<ir::AssignStmt>()) {
        const ExprId from = uncut(module_, body_, assign->value);
        read(from, isNarrow(assign->place));
        write(assign->place, isSource(from));
      } else if (const auto* called = stmt.tryAs<ir::CallStmt>()) {
        call(*called);
      } else {
        ir::forEachRoot(module_, body_, stmt, [&](ExprId root, ir::Use) { read(root, false); });
      }
      ir::forEachBlock(body_, stmt, [&](StmtId child) { block(child); });
    }
    known_.forget(mark);
  }

  const StringsOfBody& strings_;
  const ir::Module& module_;
  const ir::Body& body_;
  const Variables& variables_;
  const Facts& facts_;
  const Uses& uses_;
  KnownStrings known_;
  std::vector<uint8_t> is_slice_, taken_apart_;
  bool changed_ = false;
};

// A temporary that one statement makes of a string and only the next one reads, before it writes anything: whatever
// becomes of the string later, nothing has to be copied. `number := STRING_TO_DINT(LEFT(line, 4));`
class PassingSlices {
 public:
  PassingSlices(const StringsOfBody& strings, Slices& slices)
      : strings_(strings), module_(strings.module), body_(strings.body), slices_(slices), read_once_(module_, body_) {}

  void run() {
    for (const Stmt& stmt : body_.stmts)
      if (const auto* call = stmt.tryAs<ir::CallStmt>(); call != nullptr && stmt.next) tryCall(*call, stmt.next);
  }

 private:
  void tryCall(const ir::CallStmt& call, StmtId next) {
    const ir::Body& callee = module_.body(call.callee);
    if (!callee.slice || read_once_.madeBy(call) == nullptr) return;
    if (!strings_.isSizedCall(callee, call.operands, call.result)) return;
    const uint32_t variable = strings_.variables.stringAt(call.result);
    if (!strings_.measured.isOwn(variable) || slices_.has(variable)) return;
    const Stmt& reader = body_.stmt(next);
    const auto* assign = reader.tryAs<ir::AssignStmt>();
    if (assign == nullptr || TypeTable::isString(module_.types.kind(body_.expr(assign->place).type))) return;
    if (!isReadSized(assign->value, variable)) return;
    slices_.is_slice.resize(strings_.variables.count());
    slices_.is_slice[variable] = 1;
  }
  // Tells whether a sized function that gives no string reads it, somewhere in the expression.
  bool isReadSized(ExprId id, uint32_t variable) const {
    const Expr& e = body_.expr(id);
    bool found = false;
    if (const auto* call = e.tryAs<ir::CallExpr>()) {
      const bool is_sized = !TypeTable::isString(module_.types.kind(e.type)) &&
                            strings_.isSizedCall(module_.body(call->callee), call->operands, {});
      if (is_sized)
        for (const ExprId operand : body_.list(call->operands))
          found = found || strings_.variables.stringAt(operand) == variable;
    }
    ir::forEachOperand(body_, e, [&](ExprId operand) { found = found || isReadSized(operand, variable); });
    return found;
  }

  const StringsOfBody& strings_;
  const ir::Module& module_;
  const ir::Body& body_;
  Slices& slices_;
  ReadOnce read_once_;
};

}  // namespace

Slices analyzeSlices(const StringsOfBody& strings, const Facts& facts, const Uses& uses) {
  Slices slices;
  if (!strings.measured.any) return slices;
  if (uses.has_slice_calls && !uses.has_leaving_calls) slices = Judge(strings, facts, uses).run();
  PassingSlices(strings, slices).run();
  return slices;
}

std::string Slices::toString(const Variables& variables) const {
  std::vector<std::string> rows(is_slice.size());
  for (uint32_t i = 0; i < rows.size(); ++i) {
    if (is_slice[i] != 0) rows[i] = " slice";
  }
  return variables.lines(rows);
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// One walk over the body: see uses.h.
#include "codegen/uses.h"

#include "codegen/lengths.h"
#include "codegen/names.h"
#include "codegen/signature.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::Expr;
using ir::ExprId;
using ir::ExprKind;
using ir::Stmt;
using ir::StmtId;
using ir::StmtKind;

namespace {

constexpr uint32_t kLoopWeight = 4, kMaxWeight = 64;

class Scan {
 public:
  Scan(const ir::Module& module, const ir::Body& body)
      : module_(module), body_(body), uses_{Variables(module, body), {}, {}} {
    uses_.of.resize(uses_.variables.count());
  }

  Uses run(const Facts& facts) {
    block(body_.first, 1);
    const TypeId record = uses_.variables.record();
    const bool is_block = uses_.variables.fieldCount() != 0;
    if (uses_.has_try || self_escapes_ || (is_block && facts.exposure.isSeen(record) && has_foreign_calls_) ||
        (is_block && module_.types.info(record).record_kind == types::RecordKind::Union)) {
      uses_.variables.dropFields();
      uses_.of.resize(uses_.variables.count());
    }
    return std::move(uses_);
  }

 private:
  struct Control {  // of an enclosing loop
    uint32_t variable;
    bool disturbed = false;
  };

  VariableUse* at(uint32_t number) { return number == kNoVariable ? nullptr : &uses_.of[number]; }
  VariableUse* stringAt(ExprId place) { return at(uses_.variables.stringAt(place)); }

  void expr(ExprId id, uint32_t weight) {
    const Expr& e = body_.expr(id);
    if (const uint32_t* local = ir::localOf(e)) {
      uses_.of[*local].weight += weight;
      return;
    }
    if (e.kind == ExprKind::Self) {
      self_escapes_ = true;
      return;
    }
    const auto* field = e.tryAs<ir::FieldExpr>();
    if (field != nullptr && body_.expr(field->base).kind == ExprKind::Self) {
      if (VariableUse* of = at(uses_.variables.at(id))) {
        of->weight += weight;
        if (weight > 1) of->loop_weight += weight;
      }
      return;
    }
    if (const auto* address = e.tryAs<ir::AddressExpr>()) {
      uint32_t number = uses_.variables.at(ir::rootOf(body_, address->place));
      if (number == kNoVariable) number = uses_.variables.at(address->place);
      if (VariableUse* of = at(number)) of->exposed = true;
      if (VariableUse* of = stringAt(address->place)) of->exposed = true;
    } else if (const auto* call = e.tryAs<ir::CallExpr>()) {
      sizedCall(module_.body(call->callee), call->operands, weight);
    }
    ir::forEachOperand(body_, e, [&](ExprId operand) { expr(operand, weight); });
  }

  void write(ExprId place, bool by_reference) {
    if (VariableUse* of = by_reference ? stringAt(place) : nullptr) of->exposed = true;
    const uint32_t number = uses_.variables.at(place);
    if (number == kNoVariable) {  // part of an aggregate: the local is in use
      if (const uint32_t* local = ir::localOf(body_.expr(ir::rootOf(body_, place)))) uses_.of[*local].written = true;
      return;
    }
    uses_.of[number].written = true;
    if (by_reference) uses_.of[number].exposed = true;
    for (Control& control : controls_) {
      if (control.variable == number) control.disturbed = true;
    }
  }

  void sizedCall(const ir::Body& callee, Slice<ExprId> operands, uint32_t weight) {
    if (!isSized(module_, callee)) return;
    for (const ExprId operand : body_.list(operands)) {
      if (VariableUse* of = operand ? stringAt(operand) : nullptr) of->sized_weight += weight;
    }
  }

  void lengthsPassed(const ir::Body& callee, Slice<ExprId> operands, uint32_t weight) {
    size_t i = 0;
    for (const ir::Local& parameter : ir::parameters(callee)) {
      const ExprId operand = i < operands.count ? body_.list(operands)[i++] : ExprId{};
      VariableUse* of = operand && passesLength(module_, callee, parameter) ? stringAt(operand) : nullptr;
      if (of != nullptr) of->sized_weight += weight;
    }
  }

  // An assignment passes the length on.
  void assign(const ir::AssignStmt& stmt, uint32_t weight) {
    VariableUse *to = stringAt(stmt.place), *from = stringAt(stmt.value);
    if (to == nullptr || from == nullptr) return;
    to->sized_weight += weight;
    from->sized_weight += weight;
  }

  void call(const ir::CallStmt& stmt, uint32_t weight) {
    const ir::Body& callee = module_.body(stmt.callee);
    uses_.has_calls = true;
    if (!callee.pure && !callee.library) has_foreign_calls_ = true;
    if (callee.may_fault || stmt.is_virtual || (callee.native && !callee.pure)) uses_.has_leaving_calls = true;
    sizedCall(callee, stmt.operands, weight);
    lengthsPassed(callee, stmt.operands, weight);
    VariableUse* result = stmt.result ? stringAt(stmt.result) : nullptr;
    if (result == nullptr) return;
    // A string of the instance is written back at the exits: that pays in loops only.
    if (callee.slice && (weight > 1 || body_.expr(stmt.result).kind == ExprKind::Local))
      result->sliced = uses_.has_slice_calls = true;
    if (isSized(module_, callee)) result->sized_weight += weight;
  }

  void forLoop(StmtId id, const ir::ForStmt& loop, uint32_t inner) {
    const uint32_t control = uses_.variables.at(loop.control);
    if (VariableUse* of = at(control)) {
      of->weight += inner;
      of->loop_weight += inner;
    }
    controls_.push_back({control});
    block(loop.body_block, inner);
    const bool is_variable = control != kNoVariable && body_.expr(loop.control).kind != ExprKind::Bits;
    if (is_variable && !controls_.back().disturbed) uses_.quiet_loops.push_back(id);
    controls_.pop_back();
  }

  void block(StmtId first, uint32_t weight) {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& stmt = body_.stmt(id);
      const auto* called = stmt.tryAs<ir::CallStmt>();
      ir::forEachRoot(module_, body_, stmt, [&](ExprId root, ir::Use use) {
        // A call on SELF exposes the whole instance; an element of it is a separate instance.
        expr(root, weight);
        if (use == ir::Use::Write) write(root, false);
        if (use == ir::Use::Reference && !(called != nullptr && root == called->self)) write(root, true);
      });
      if (stmt.kind == StmtKind::Try) uses_.has_try = true;
      if (const auto* assignment = stmt.tryAs<ir::AssignStmt>()) assign(*assignment, weight);
      if (called != nullptr) call(*called, weight);
      const auto* counted = stmt.tryAs<ir::ForStmt>();
      const bool loops = counted != nullptr || stmt.kind == StmtKind::Loop;
      const uint32_t inner = loops && weight < kMaxWeight ? weight * kLoopWeight : weight;
      if (counted != nullptr) {
        forLoop(id, *counted, inner);
      } else {
        ir::forEachBlock(body_, stmt, [&](StmtId child) { block(child, inner); });
      }
    }
  }

  const ir::Module& module_;
  const ir::Body& body_;
  Uses uses_;
  std::vector<Control> controls_;
  bool self_escapes_ = false, has_foreign_calls_ = false;
};

}  // namespace

Uses analyzeUses(const ir::Module& module, const ir::Body& body, const Facts& facts) {
  return Scan(module, body).run(facts);
}

std::string Uses::toString() const {
  std::vector<std::string> rows(of.size());
  for (uint32_t i = 0; i < of.size(); ++i) {
    const VariableUse& use = of[i];
    auto add = [&](const char* word, uint32_t number) {
      if (number == 0) return;
      rows[i] += word;
      appendUnsigned(rows[i], number);
    };
    add(" weight ", use.weight);
    add(" in loops ", use.loop_weight);
    add(" sized ", use.sized_weight);
    if (use.written) rows[i] += " written";
    if (use.exposed) rows[i] += " exposed";
    if (use.sliced) rows[i] += " sliced";
  }
  return variables.lines(rows);
}

ReadOnce::ReadOnce(const ir::Module& module, const ir::Body& body) : body_(body), names_(body.locals.size()) {
  ir::forEachStmt(body, body.first, [&](ir::StmtId id) {
    ir::forEachRoot(module, body, body.stmt(id), [&](ExprId root, ir::Use) {
      ir::forEachExpr(body, root, [&](ExprId at) {
        if (const uint32_t* local = ir::localOf(body.expr(at))) ++names_[*local];
      });
    });
  });
}

const uint32_t* ReadOnce::madeBy(const ir::CallStmt& call) const {
  const uint32_t* temp = call.result ? ir::localOf(body_.expr(call.result)) : nullptr;
  const bool is_one = temp != nullptr && body_.locals[*temp].kind == ir::LocalKind::Temp && names_[*temp] == 2;
  return is_one ? temp : nullptr;
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// Hoisting: see hoist_checks.h. Inner loops come first, so that what leaves them may leave the outer one as well.
#include "ir/passes/hoist_checks.h"

#include <algorithm>

#include "ir/passes/effects.h"
#include "ir/passes/support.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeTable;

namespace {

class Hoister {
 public:
  Hoister(Module& module, const Exposure& exposure, Body& body)
      : module_(module), types_(module.types), exposure_(exposure), body_(body), build_(module, body) {}

  bool run() {
    if (body_.has_labels || !body_.first || !isWorthIt()) return false;
    private_ = privateLocals(module_, body_);
    block(body_.first);
    return changed_;
  }

 private:
  bool isWorthIt() {
    bool has_loop = false, has_check = false;
    for (const Stmt& s : body_.stmts) {
      has_loop = has_loop || s.kind == StmtKind::For || s.kind == StmtKind::Loop;
      has_try_ = has_try_ || s.kind == StmtKind::Try;
    }
    for (const Expr& e : body_.exprs) has_check = has_check || (e.checks & kHoisted) != 0;
    return has_loop && has_check;
  }

  void block(StmtId first) {
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt stmt = body_.stmt(id);  // a copy: hoisting adds statements
      forEachBlock(body_, stmt, [&](StmtId inner) { block(inner); });
      if (stmt.kind == StmtKind::For) id = fromFor(id);
      if (stmt.kind == StmtKind::Loop) id = fromLoop(id);
    }
  }

  // ---- what a loop changes

  struct Written {
    std::vector<uint32_t> locals, fields;
    bool exposed = false, all_fields = false;
  };

  void note(const Effect& effect) {
    switch (effect.kind) {
      case Effect::None: return;
      case Effect::Local: written_.locals.push_back(effect.index); return;
      case Effect::Field: written_.fields.push_back(effect.index); return;
      case Effect::Exposed: written_.exposed = true; return;
      case Effect::Fields: written_.all_fields = true; return;
    }
  }
  void noteWrites(const Stmt& s) {
    forEachWritten(module_, body_, s, [&](ExprId place) { note(effectOfWrite(module_, body_, private_, place)); });
    const auto* call = s.tryAs<CallStmt>();
    if (bindsOwn(body_, s)) written_.all_fields = true;
    if (call == nullptr || module_.body(call->callee).pure) return;
    (callReachesSelf(module_, exposure_, body_, *call) ? written_.all_fields : written_.exposed) = true;
  }
  void findWrites(StmtId loop) {
    written_ = {};
    noteWrites(body_.stmt(loop));
    forEachBlock(body_, body_.stmt(loop),
                 [&](StmtId first) { forEachStmt(body_, first, [&](StmtId id) { noteWrites(body_.stmt(id)); }); });
  }
  static bool has(const std::vector<uint32_t>& list, uint32_t one) {
    return std::find(list.begin(), list.end(), one) != list.end();
  }

  // The memory that a place names is the same in each iteration.
  bool isFixedPlace(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (roleOf(e.kind) == ExprRole::Variable) return true;
    if (const auto* field = e.tryAs<FieldExpr>()) {
      const bool may_refer = written_.all_fields || body_.expr(field->base).kind != ExprKind::Self;
      return !(isReference(module_, body_, e) && may_refer) && isFixedPlace(field->base);
    }
    if (const auto* deref = e.tryAs<DerefExpr>()) return isFixedValue(deref->pointer);
    const auto* index = e.tryAs<IndexExpr>();
    if (index == nullptr) return false;
    for (const ExprId one : body_.list(index->indices))
      if (!isFixedValue(one)) return false;
    return isFixedPlace(index->base);
  }
  // The value is the same in each iteration: constants, variables that the loop does not write, and what they give.
  bool isFixedValue(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (const uint32_t* local = localOf(e)) return private_[*local] && !has(written_.locals, *local);
    if (const auto* field = e.tryAs<FieldExpr>()) {
      if (body_.expr(field->base).kind != ExprKind::Self || isReference(module_, body_, e) || written_.all_fields)
        return false;
      const TypeId self = types_.resolve(body_.self);
      if (types_.info(self).record_kind == types::RecordKind::Union) return false;
      return !has(written_.fields, field->field) && !(written_.exposed && exposure_.isExposed(self, field->field));
    }
    if (const auto* binary = e.tryAs<BinaryExpr>()) return isFixedValue(binary->left) && isFixedValue(binary->right);
    if (const auto* unary = e.tryAs<UnaryExpr>()) return isFixedValue(unary->operand);
    if (const auto* convert = e.tryAs<ConvertExpr>()) return isFixedValue(convert->operand);
    return isConst(e);
  }

  // ---- the checks that the first iteration reaches first

  // Tells whether the walk may go on after the expression. Its checks that can leave the loop are in found_.
  bool collect(ExprId id) {
    const size_t before = found_.size();
    bool goes_on = true;
    forEachOperand(body_, body_.expr(id), [&](ExprId operand) { goes_on = goes_on && collect(operand); });
    const Expr& e = body_.expr(id);
    if (!goes_on || e.checks == 0) return goes_on;
    if ((e.checks & ~kHoisted) != 0) return false;
    if (isFixedCheck(e)) {
      if (e.proven == 0) found_.resize(before);  // those below are in it
      found_.push_back({id});
      return true;
    }
    if (const uint16_t some = fixedDimensions(e); some != 0) found_.push_back({id, some});
    return false;
  }
  bool isFixedCheck(const Expr& e) const {
    if (const auto* deref = e.tryAs<DerefExpr>()) return isFixedValue(deref->pointer);
    if (const auto* field = e.tryAs<FieldExpr>())
      return body_.expr(field->base).kind == ExprKind::Self && !written_.all_fields;
    const auto* index = e.tryAs<IndexExpr>();
    if (index == nullptr || !isFixedPlace(index->base)) return false;
    for (uint32_t i = 0; i < index->indices.count; ++i)
      if (!e.isProven(i) && !isFixedValue(body_.list(index->indices)[i])) return false;
    return true;
  }

  // Of an index whose other dimensions change: those that come first and stay, by bit. Their part of the check comes
  // first.
  uint16_t fixedDimensions(const Expr& e) const {
    const auto* index = e.tryAs<IndexExpr>();
    if (index == nullptr || !isFixedPlace(index->base)) return 0;
    uint16_t some = 0;
    for (uint32_t i = 0; i < index->indices.count && i < kMostProven; ++i) {
      if (e.isProven(i)) continue;
      if (!isFixedValue(body_.list(index->indices)[i])) break;
      some |= static_cast<uint16_t>(1u << i);
    }
    return some;
  }

  void collectFrom(StmtId first) {
    found_.clear();
    for (StmtId id = first; id; id = body_.stmt(id).next) {
      const Stmt& s = body_.stmt(id);
      bool goes_on = true;
      forEachRoot(module_, body_, s, [&](ExprId root, Use) { goes_on = goes_on && collect(root); });
      if (!goes_on || (s.kind != StmtKind::Evaluate && !writesHidden(s))) return;
    }
  }
  // An assignment that no one sees when a fault follows.
  bool writesHidden(const Stmt& s) const {
    const auto* assign = s.tryAs<AssignStmt>();
    return assign != nullptr && !has_try_ &&
           effectOfWrite(module_, body_, private_, assign->place).kind == Effect::Local;
  }

  // ---- the new statements

  void clearChecks(ExprId id) {
    Expr& e = body_.expr(id);
    e.checks = 0;
    e.proven = 0;
    forEachOperand(body_, e, [&](ExprId operand) { clearChecks(operand); });
  }
  // Of an index with dimensions that need no check, or whose check stays in the loop, only the others matter.
  ExprId onlyHoisted(ExprId id, uint16_t some) {
    const Expr e = body_.expr(id);
    const IndexExpr& node = e.as<IndexExpr>();
    const TypeInfo& array = types_.info(types_.resolve(body_.expr(node.base).type));
    std::vector<ExprId> indices;
    for (uint32_t i = 0; i < node.indices.count; ++i) {
      const ExprId one = body_.list(node.indices)[i];
      const bool is_left_out = e.isProven(i) || (some != 0 && (some >> i & 1) == 0);
      indices.push_back(is_left_out ? build_.integer(body_.expr(one).type, array.dimensions[i].low) : build_.copy(one));
    }
    const ExprId base = build_.copy(node.base);
    clearChecks(base);
    const ExprId created = build_.index(base, indices, e.checks);
    body_.expr(created).loc = e.loc;
    return created;
  }
  void evaluateFound() {
    for (const auto& [id, some] : found_) {
      if (some != 0) {
        build_.evaluate(onlyHoisted(id, some));
        body_.expr(id).proven |= some;
      } else if (body_.expr(id).proven != 0) {
        build_.evaluate(onlyHoisted(id, 0));
        body_.expr(id).checks = 0;
        body_.expr(id).proven = 0;
      } else {
        build_.evaluate(build_.copy(id));
        clearChecks(id);
      }
    }
  }
  // Moves the loop after the statements of the open block. Returns its new id.
  StmtId insert(StmtId loop, Block outer) {
    StmtId last = build_.block().last;
    const StmtId first = build_.close(outer);
    const Stmt stmt = body_.stmt(loop);
    body_.stmts.push_back(stmt);
    const StmtId moved{static_cast<uint32_t>(body_.stmts.size()) - 1};
    if (last == first) last = loop;
    body_.stmt(loop) = body_.stmt(first);
    body_.stmt(first) = {};
    body_.stmt(last).next = moved;
    changed_ = true;
    return moved;
  }

  // Without faults and calls, and whatever the control variable holds.
  bool isPlain(ExprId id, ExprId control) const {
    const Expr& e = body_.expr(id);
    if (e.checks != 0) return false;
    if (const uint32_t* local = localOf(e)) {
      const uint32_t* other = localOf(body_.expr(control));
      return private_[*local] && (other == nullptr || *other != *local);
    }
    if (const auto* field = e.tryAs<FieldExpr>()) {
      const auto* other = body_.expr(control).tryAs<FieldExpr>();
      return body_.expr(field->base).kind == ExprKind::Self && !isReference(module_, body_, e) &&
             (other == nullptr || other->field != field->field);
    }
    if (const auto* binary = e.tryAs<BinaryExpr>())
      return isPlain(binary->left, control) && isPlain(binary->right, control);
    if (const auto* convert = e.tryAs<ConvertExpr>()) return isPlain(convert->operand, control);
    return isConst(e);
  }
  bool isScalarOfOwn(ExprId control) const {
    const Effect::Kind kind = effectOfWrite(module_, body_, private_, control).kind;
    return kind == Effect::Local || (kind == Effect::Field && body_.expr(control).kind == ExprKind::Field);
  }

  StmtId fromFor(StmtId loop) {
    const ForStmt node = body_.stmt(loop).as<ForStmt>();
    if (!isScalarOfOwn(node.control) || !isPlain(node.from, node.control) || !isPlain(node.to, node.control))
      return loop;
    findWrites(loop);
    collectFrom(node.body_block);
    if (found_.empty()) return loop;
    build_.loc = body_.stmt(loop).loc;
    const Block outer = build_.open();
    build_.assign(build_.copy(node.control), build_.copy(node.from));
    const Expr& step = body_.expr(node.step);
    const bool is_signed = types_.isSigned(types_.plainKind(step.type));
    const bool up = static_cast<int64_t>(bitsOf(step)) > 0 || !is_signed;
    const ExprId first = up ? node.from : node.to, last = up ? node.to : node.from;
    if (isConst(body_.expr(first)) && isConst(body_.expr(last))) {
      const uint64_t low = bitsOf(body_.expr(first)), high = bitsOf(body_.expr(last));
      const bool runs = is_signed ? static_cast<int64_t>(low) <= static_cast<int64_t>(high) : low <= high;
      if (!runs) {
        build_.close(outer);
        return loop;
      }
      evaluateFound();
    } else {
      const Block around = build_.open();
      evaluateFound();
      const StmtId checks = build_.close(around);
      build_.ifElse(build_.binary(Op::Le, build_.copy(first), build_.copy(last)), checks);
    }
    return insert(loop, outer);
  }

  // The first test of a loop comes before anything else.
  StmtId fromLoop(StmtId loop) {
    findWrites(loop);
    collectFrom(body_.stmt(loop).as<LoopStmt>().body_block);
    if (found_.empty()) return loop;
    build_.loc = body_.stmt(loop).loc;
    const Block outer = build_.open();
    evaluateFound();
    return insert(loop, outer);
  }

  static constexpr unsigned kHoisted = kCheckNull | kCheckIndex;

  Module& module_;
  const TypeTable& types_;
  const Exposure& exposure_;
  Body& body_;
  Builder build_;
  std::vector<bool> private_;
  Written written_;  // by the current loop
  struct Found {
    ExprId id;
    uint16_t some = 0;  // only the check of these dimensions leaves the loop; 0: all of it
  };
  std::vector<Found> found_;  // in the order of evaluation
  bool has_try_ = false, changed_ = false;
};

}  // namespace

bool hoistChecks(Module& module, const Exposure& exposure, Body& body) { return Hoister(module, exposure, body).run(); }

}  // namespace rung::ir

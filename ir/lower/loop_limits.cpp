// Whether a loop may change a value: the end value of a FOR loop in codesys, which is evaluated before every turn
// (SA0081). In: the value and the statements of the loop, lowered but not in a body yet. Out: yes, or certainly not.
// Variables are told apart by their names; what a pointer, an in-out or a called function may reach counts as changed.
// Called by statements.cpp.
#include "ir/lower/lowering.h"

namespace rung::ir {

namespace {

// The variable that a place is or is a part of: a local, or a member of an instance or list.
struct Variable {
  ExprKind root = ExprKind::None;  // Local, Self, Global, Program, Image; Deref: what a pointer or in-out refers to
  uint32_t number = 0;             // of the local, list, program or area
  uint32_t field = kNoBit;
  bool is_scalar = false;  // the field itself, and not a part of it
};

Variable variableOf(const Module& module, const Body& body, ExprId place) {
  Variable out;
  const Expr* member = nullptr;
  for (ExprId id = place; id; id = baseOf(body.expr(id))) {
    const Expr& expr = body.expr(id);
    if (isReference(module, body, expr)) return {.root = ExprKind::Deref};
    out.root = expr.kind;
    if (baseOf(expr)) member = &expr;
    out.is_scalar = member != nullptr && member == &body.expr(place);
    if (expr.kind == ExprKind::Local) out.number = expr.as<LocalExpr>().local;
    if (expr.kind == ExprKind::Global) out.number = expr.as<GlobalExpr>().list;
    if (expr.kind == ExprKind::Program) out.number = expr.as<ProgramExpr>().program;
    if (expr.kind == ExprKind::Image) out.number = expr.as<ImageExpr>().area;
  }
  if (out.root == ExprKind::Local && body.locals[out.number].by_reference) return {.root = ExprKind::Deref};
  if (out.root != ExprKind::Local && member != nullptr && member->kind == ExprKind::Field)
    out.field = member->as<FieldExpr>().field;
  return out;
}

bool mayOverlap(const Variable& read, const Variable& written) {
  if (read.root == ExprKind::Deref || written.root == ExprKind::Deref) return true;
  if (read.root == written.root && read.number == written.number)
    return read.field == written.field || read.field == kNoBit || written.field == kNoBit;
  if (read.root == written.root || read.root == ExprKind::Local || written.root == ExprKind::Local) return false;
  if (read.root == ExprKind::Image || written.root == ExprKind::Image) return false;
  // A variable of a list is not in an instance; an instance may be in a list or program.
  const auto inList = [](const Variable& of) { return of.root == ExprKind::Global && of.is_scalar; };
  return !inList(read) && !inList(written);
}

}  // namespace

// Whether the address of a local is taken in what is lowered so far. Each expression is looked at once.
bool StatementLowering::isAddressed(uint32_t local) {
  state_.addressed.resize(body_.locals.size());
  for (uint32_t& i = state_.addresses_searched; i < body_.exprs.size(); ++i) {
    const auto* address = body_.exprs[i].tryAs<AddressExpr>();
    const uint32_t* root = address != nullptr ? localOf(body_.expr(rootOf(body_, address->place))) : nullptr;
    if (root != nullptr) state_.addressed[*root] = true;
  }
  return state_.addressed[local];
}

bool StatementLowering::mayChange(ExprId value, StmtId loop, ExprId control) {
  std::vector<std::pair<Variable, TypeId>> read;
  forEachExpr(body_, value, [&](ExprId id) {
    const ExprKind kind = body_.expr(id).kind;
    if (isPlace(kind) && kind != ExprKind::Self && kind != ExprKind::Global && kind != ExprKind::Program)
      read.push_back({variableOf(in_.module, body_, id), body_.expr(id).type});
  });
  if (read.empty()) return false;
  const auto isOwn = [&](const Variable& variable) {  // no pointer and no call reaches it
    return variable.root == ExprKind::Local && !isAddressed(variable.number);
  };
  bool changed = false;
  const auto change = [&](ExprId place) {
    const Variable written = variableOf(in_.module, body_, place);
    // An in-out of another type refers to another variable; a pointer may refer to anything.
    const bool is_in_out = written.root == ExprKind::Deref && body_.expr(rootOf(body_, place)).kind != ExprKind::Deref;
    for (const auto& [variable, type] : read) {
      if (changed) return;
      const bool is_far = is_in_out && type != body_.expr(place).type;
      if (written.root == ExprKind::Deref && (is_far || isOwn(variable))) continue;
      changed = mayOverlap(variable, written);
    }
  };
  change(control);
  forEachStmt(body_, loop, [&](StmtId id) {
    const Stmt& stmt = body_.stmt(id);
    forEachRoot(in_.module, body_, stmt, [&](ExprId root, Use use) {
      if (use != Use::Read) change(root);
    });
    const auto* call = stmt.tryAs<CallStmt>();
    if (call == nullptr || in_.module.body(call->callee).pure || in_.module.body(call->callee).native) return;
    for (const auto& [variable, type] : read) changed = changed || !isOwn(variable);
  });
  return changed;
}

}  // namespace rung::ir

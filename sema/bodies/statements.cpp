// SPDX-License-Identifier: Apache-2.0
// Statements. In: the statement list of a body. Out: the same tree with every expression checked and converted.
// Called by checkBody() for each body.
#include "sema/bodies/statements.h"

#include "frontend/syntax/diagnostics.h"
#include "sema/access.h"
#include "sema/bodies/attempts.h"
#include "sema/bodies/body.h"
#include "sema/bodies/calls.h"
#include "sema/bodies/conversions.h"
#include "sema/bodies/diagnostics.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/limits.h"
#include "sema/bodies/literals.h"
#include "sema/bodies/names.h"
#include "sema/bodies/objects.h"
#include "sema/bodies/operators.h"
#include "sema/bodies/pointers.h"
#include "sema/bodies/temporaries.h"
#include "sema/bodies/writable.h"
#include "sema/fixes.h"
#include "sema/hooks.h"
#include "sema/project.h"
#include "sema/shorthands.h"
#include "sema/synthesized_nodes.h"

namespace rung::sema {

namespace {

// The name of an lvalue in messages: `a` of `a[i]`, `q` of `x.q`.
NameId lvalueName(const Context& context, ExprId expr) {
  const Tree& tree = context.tree();
  for (;;) {
    if (tree.kind(expr) == ExprKind::Index) {
      expr = tree.as<IndexExpr>(expr).base;
    } else if (tree.kind(expr) == ExprKind::Deref) {
      expr = tree.as<DerefExpr>(expr).base;
    } else if (tree.kind(expr) == ExprKind::BitAccess) {
      expr = tree.as<BitAccessExpr>(expr).base;
    } else {
      return nameOf(context, expr);
    }
  }
}

TypeId checkTarget(Context& context, ExprId& target, Access access) {
  const TypeId type = check(context, target, {}, access);
  if (entityOf(context, target).entityKind() == EntityKind::Property) return type;  // checkPropertyAssign
  if (!type || type == types::kError) return types::kError;
  if (isUntyped(context, type)) finalizeUntyped(context, target);
  return checkWritable(context, target, Purpose{Use::Assigned, {}, {}}) ? type : types::kError;
}

// x REF= y: the reference itself is the target.
void checkReferenceAssign(Context& context, AssignStmt& node) {
  const TypeId type = check(context, node.target, {}, Access::Bind);
  if (type == types::kError) {
    check(context, node.value, {}, Access::Address);
    return;
  }
  if (context.tree().kind(node.target) == ExprKind::Deref) {
    context.replace(node.target, context.tree().as<DerefExpr>(node.target).base);
  }
  if (checkPropertyAssign(context, node)) return;
  const TypeId own = context.type(node.target);
  if (context.types().kind(own) != TypeKind::Reference) {
    context.report(diag::NotAReference, context.tree().loc(node.target), {"REF=", context.types().toString(own)});
    return;
  }
  if (!checkWritable(context, node.target, Purpose{Use::Assigned, {}, {}})) return;
  if (bindReference(context, node.value, own)) context.rules->assignment(context, node.target, node.value);
}

}  // namespace

BinaryOp binaryOf(AssignOp op) {
  switch (op) {
    case AssignOp::Subtract: return BinaryOp::Subtract;
    case AssignOp::Multiply: return BinaryOp::Multiply;
    case AssignOp::Divide: return BinaryOp::Divide;
    case AssignOp::Add:
    case AssignOp::Assign:
    case AssignOp::Set:
    case AssignOp::Reset:
    case AssignOp::Reference:
    case AssignOp::Attempt: return BinaryOp::Add;
  }
  return BinaryOp::Add;
}

namespace {

// The type of the target; kError when nothing is left to check: it is wrong, or a property.
TypeId checkAssigned(Context& context, AssignStmt& node, Access access) {
  const TypeId type = checkTarget(context, node.target, access);
  if (type == types::kError) {
    const TypeId value = checkExpr(context, node.value);
    const bool is_untyped = value && value != types::kError && isUntyped(context, value);
    declareUnknown(context, node.target, is_untyped ? finalizeUntyped(context, node.value) : value);
    return type;
  }
  return checkPropertyAssign(context, node) ? types::kError : type;
}

// a += b is a := a + b; lowering keeps the short form where both sides have the target's type.
void checkCompoundAssign(Context& context, AssignStmt& node) {
  const TypeId type = checkAssigned(context, node, Access::ReadWrite);
  if (type == types::kError) return;
  ExprId value = context.build().binary(binaryOf(node.op()), node.target, node.value, node.h.loc);
  check(context, context.code().as<BinaryExpr>(value).right, type, Access::Read);
  if (combine(context, value, type) == types::kError) return;
  if (context.tree().kind(value) == ExprKind::Binary) {
    const BinaryExpr& created = context.tree().as<BinaryExpr>(value);
    if (meaning(created.h).type == context.types().resolve(type) && created.left == node.target) {
      node.value = created.right;
      return;
    }
  }
  context.replace(node.value, value);
  node.setOp(AssignOp::Assign);
  convert(context, node.value, type, Purpose{Use::Assigned, lvalueName(context, node.target), {}});
}

void checkAssign(Context& context, AssignStmt& node) {
  switch (node.op()) {
    case AssignOp::Assign: {
      if (checkTemporaryAssign(context, node)) return;
      const TypeId type = checkAssigned(context, node, Access::Write);
      if (type == types::kError) return;
      checkAs(context, node.value, type, Purpose{Use::Assigned, lvalueName(context, node.target), {}});
      context.rules->assignment(context, node.target, node.value);
      return;
    }
    case AssignOp::Set:
    case AssignOp::Reset: {
      const TypeId type = checkTarget(context, node.target, Access::ReadWrite);
      checkAs(context, node.value, types::kBool, Purpose{Use::Set, {}, {}});
      if (type != types::kError && context.types().plainKind(type) != TypeKind::Bool) {
        context.report(diag::SetNeedsBool, context.tree().loc(node.target), {context.types().toString(type)});
      }
      return;
    }
    case AssignOp::Reference: checkReferenceAssign(context, node); return;
    case AssignOp::Add:
    case AssignOp::Subtract:
    case AssignOp::Multiply:
    case AssignOp::Divide: checkCompoundAssign(context, node); return;
    case AssignOp::Attempt: checkAttempt(context, node); return;
  }
}

}  // namespace

// target := value in an expression. CODESYS, "Assignment operator: Assignment as expression".
//   passes  IF (n := n + 1) = m THEN        fails  IF (motor.speed := 3) > 2 with a property         E0655
TypeId checkAssignExpr(Context& context, ExprId expr) {
  AssignExpr& node = context.code().as<AssignExpr>(expr);
  const TypeId type = checkTarget(context, node.target, Access::Write);
  if (type == types::kError || entityOf(context, node.target).entityKind() == EntityKind::Property) {
    if (type != types::kError) context.report(diag::PropertyInExpression, context.tree().loc(node.target));
    checkExpr(context, context.code().as<AssignExpr>(expr).value);
    return context.type(expr) = types::kError;
  }
  ExprId value = context.tree().as<AssignExpr>(expr).value;
  checkAs(context, value, type, Purpose{Use::Assigned, lvalueName(context, node.target), {}});
  context.code().as<AssignExpr>(expr).value = value;
  context.rules->assignment(context, context.tree().as<AssignExpr>(expr).target, value);
  return context.type(expr) = type;
}

namespace {

void checkCallStatement(Context& context, StmtId id) {
  CallStmt& node = context.code().as<CallStmt>(id);
  if (context.tree().kind(node.call) != ExprKind::Call) {
    check(context, node.call, {}, Access::Read);
    return;
  }
  const bool bare = context.tree().as<CallExpr>(node.call).is_bare;  // reported
  checkCall(context, node.call, {}, true);
  if (context.tree().kind(node.call) == ExprKind::Call) return;
  const TypeId type = context.type(node.call);
  if (isUntyped(context, type)) finalizeUntyped(context, node.call);
  if (type != types::kError && !bare) context.report(diag::ResultUnused, node.h.loc);  // a conversion: nothing happens
}

bool checkIf(Context& context, const IfStmt& node) {
  bool falls = false;
  const uint32_t elsifs_around = context.body->elsif_depth;
  for (uint32_t i = 0; i < node.branches.count; ++i) {
    IfBranch& branch = context.code().list(node.branches)[i];
    if (i > 0 && ++context.body->elsif_depth > kMaxElsifDepth) {
      context.report(diag::StatementsTooDeep, context.tree().begin(branch.condition), {std::to_string(kMaxElsifDepth)});
      break;
    }
    checkCondition(context, branch.condition,
                   node.h.op == kConditionalOp ? Use::Condition
                   : i == 0                    ? Use::IfCondition
                                               : Use::ElsifCondition);
    falls |= checkStatements(context, branch.body);
  }
  const bool otherwise = checkStatements(context, node.otherwise);
  context.body->elsif_depth = elsifs_around;
  return falls || otherwise;
}

// Converts a label to the selector's type; its value, which the rule on labels reads, must be known.
void checkLabel(Context& context, ExprId& label, TypeId selector) {
  const bool enumeration = context.types().kind(selector) == TypeKind::Enum;
  TypeId type = check(context, label, selector, Access::Read);
  if (type == types::kError) return;
  TypeId wanted = selector;
  if (enumeration && isUntyped(context, type) && context.profile().enums_as_numbers &&
      !context.types().info(context.types().resolve(selector)).strict) {
    wanted = context.types().plain(selector);
  }
  if (!convert(context, label, wanted, Purpose{Use::CaseLabel, {}, {}})) {
    context.type(label) = types::kError;
    return;
  }
  const std::optional<int64_t> known = constantInteger(context, label);
  if (!known) {
    context.report(diag::LabelNotConstant, context.tree().begin(label));
    return;
  }
  if (entityOf(context, label) || context.tree().kind(label) == ExprKind::Literal) return;
  // Lowering need not compute it again.
  context.replace(label,
                  makeLiteral(context, LiteralKind::Integer, context.type(label), *known, context.tree().begin(label)));
}

void checkLabels(Context& context, const CaseBranch& branch, TypeId selector) {
  for (ExprId& label : context.code().list(branch.labels)) {
    const bool is_range = context.tree().kind(label) == ExprKind::Range;
    if (selector == types::kError) {
      if (!is_range) checkExpr(context, label);
    } else if (is_range) {
      RangeExpr& range = context.code().as<RangeExpr>(label);
      checkLabel(context, range.low, selector);
      checkLabel(context, range.high, selector);
      meaning(range.h).type = selector;
    } else {
      checkLabel(context, label, selector);
    }
  }
}

bool checkCase(Context& context, CaseStmt& node) {
  TypeId selector = check(context, node.selector, {}, Access::Read);
  if (isUntyped(context, selector)) selector = finalizeUntyped(context, node.selector);
  const TypeKind kind = context.types().plainKind(selector);
  if (selector != types::kError && !types::TypeTable::isInteger(kind) && !types::TypeTable::isBits(kind)) {
    context.report(diag::CaseSelector, context.tree().loc(node.selector), {context.types().toString(selector)});
    selector = types::kError;
  }
  bool falls = false;
  for (const CaseBranch& branch : context.tree().list(node.branches)) {
    checkLabels(context, branch, selector);
    falls |= checkStatements(context, branch.body);
  }
  const bool otherwise = checkStatements(context, node.otherwise);
  return falls || otherwise || !node.has_else;
}

// The required type of the step of a FOR over `control`. A step is signed even if the variable is not:
// FOR u := 9 TO 0 BY -1 counts an unsigned variable down (codesys; the standard wants one type for all).
TypeId stepType(Context& context, ExprId step, TypeId control) {
  const TypeId plain = context.types().plain(control);  // a step is not a value of the subrange
  const TypeKind kind = context.types().info(plain).kind;
  if (!context.profile().unsigned_loops_count_down || context.types().isSigned(kind)) return plain;
  const TypeId type = context.type(step);
  __int128 value = 0;
  const bool negative = isUntyped(context, type) ? untypedValue(context, step, value) && value < 0
                                                 : context.types().isSigned(context.types().plainKind(type));
  if (!negative) return plain;
  switch (types::TypeTable::bitWidth(kind)) {
    case 8: return types::kSInt;
    case 16: return types::kInt;
    case 32: return types::kDInt;
    default: return types::kLInt;
  }
}

// The type of the control variable, an integer; kError after a report. IEC 61131-3 ed. 3, 7.3.3.4.2.
//   passes  FOR i := 1 TO 9 DO          fails  FOR r := 0.0 TO 1.0 DO                     E0710
TypeId checkForControl(Context& context, ForStmt& node) {
  const TypeId type = check(context, node.control, {}, Access::ReadWrite);
  if (type == types::kError) {
    declareUnknown(context, node.control, types::kInt);
    return type;
  }
  if (isUntyped(context, type)) finalizeUntyped(context, node.control);
  if (!checkWritable(context, node.control, Purpose{Use::LoopControl, {}, {}})) {
    return types::kError;
  }
  const TypeKind kind = context.types().plainKind(type);
  const bool enumeration = context.types().kind(type) == TypeKind::Enum;
  if (!enumeration &&
      (types::TypeTable::isInteger(kind) || (types::TypeTable::isBits(kind) && context.profile().bit_arithmetic))) {
    return type;
  }
  context.report(diag::ControlNotInteger, context.tree().loc(node.control), {context.types().toString(type)});
  return types::kError;
}

void checkFor(Context& context, ForStmt& node) {
  const TypeId type = checkForControl(context, node);
  const NameId name = lvalueName(context, node.control);
  const auto bound = [&](ExprId& expr, TypeId wanted, Use use) {
    if (!expr) return;
    if (wanted == types::kError) {
      checkExpr(context, expr);
    } else {
      checkAs(context, expr, wanted, Purpose{use, name, {}});
    }
  };
  bound(node.from, type, Use::Assigned);
  bound(node.to, type, Use::LoopLimit);
  if (node.step && type != types::kError) {
    const TypeId step = check(context, node.step, type, Access::Read);
    if (step != types::kError) {
      convert(context, node.step, stepType(context, node.step, type), Purpose{Use::LoopStep, name, {}});
    }
  } else {
    bound(node.step, type, Use::LoopStep);
  }
  if (type == types::kError) context.type(node.control) = type;
  VarId control;
  if (context.tree().kind(node.control) == ExprKind::Name) {
    const Entity entity = context.meaning(node.control).entity;
    if (entity.entityKind() == EntityKind::Var) control = VarId{entity.index};
  }
  if (control) context.body->loop_controls.push_back({control, context.tree().loc(node.control)});
  ++context.loop_depth;
  checkStatements(context, node.body);
  --context.loop_depth;
  if (control) context.body->loop_controls.pop_back();
}

// Warns of a loop whose condition is a constant that never ends it, and that nothing leaves. Statements after it are
// not reported as unreachable.
bool checkEndless(Context& context, ExprId condition, bool goes_on, uint32_t ways_out_before, Loc loc) {
  const Tree& tree = context.tree();
  if (tree.kind(condition) != ExprKind::Literal || typeOf(tree, condition) != types::kBool) return false;
  if ((tree.as<LiteralExpr>(condition).value() != 0) != goes_on) return false;
  if (context.body->ways_out != ways_out_before) return false;
  context.report(diag::EndlessLoop, loc);
  return true;
}

// __TRY of CODESYS. The code is a number or an __SYSTEM.ExceptionCode.
bool checkTry(Context& context, TryStmt& node) {
  constexpr uint32_t kMostNested = 32;  // the time that g++ needs grows with the square
  if (!context.profile().try_statement) context.report(diag::TryExtension, node.h.loc);
  if (context.try_depth == kMostNested) {
    context.report(diag::TryTooDeep, node.h.loc, {std::to_string(kMostNested)});
    return true;
  }
  ++context.try_depth;
  const bool falls = checkStatements(context, node.body);
  if (node.code) {
    const TypeId type = checkTarget(context, node.code, Access::Write);
    const TypeKind kind = context.types().plainKind(type);
    if (type != types::kError && (types::TypeTable::bitWidth(kind) < 32 ||
                                  !(types::TypeTable::isInteger(kind) || types::TypeTable::isBits(kind))))
      context.report(diag::ExceptionCode, context.tree().begin(node.code), {context.types().toString(type)});
  }
  const bool handled = checkStatements(context, node.handler);
  const bool finished = checkStatements(context, node.finally);
  --context.try_depth;
  return (falls || (node.catches && handled)) && finished;
}

bool checkStatement(Context& context, StmtId id) {
  const Tree& tree = context.tree();
  BodyState& body = *context.body;
  switch (tree.kind(id)) {
    case StmtKind::Error:
    case StmtKind::Empty: return true;
    case StmtKind::Assign: checkAssign(context, context.code().as<AssignStmt>(id)); return true;
    case StmtKind::Call: checkCallStatement(context, id); return true;
    case StmtKind::If: return checkIf(context, tree.as<IfStmt>(id));
    case StmtKind::Case: return checkCase(context, context.code().as<CaseStmt>(id));
    case StmtKind::For: checkFor(context, context.code().as<ForStmt>(id)); return true;
    case StmtKind::While: {
      WhileStmt& node = context.code().as<WhileStmt>(id);
      const uint32_t before = body.ways_out;
      checkCondition(context, node.condition, Use::WhileCondition);
      ++context.loop_depth;
      checkStatements(context, node.body);
      --context.loop_depth;
      checkEndless(context, node.condition, true, before, node.h.loc);
      return true;
    }
    case StmtKind::Repeat: {
      RepeatStmt& node = context.code().as<RepeatStmt>(id);
      const uint32_t before = body.ways_out;
      ++context.loop_depth;
      const bool falls = checkStatements(context, node.body);
      --context.loop_depth;
      checkCondition(context, node.until, Use::UntilCondition);
      return checkEndless(context, node.until, false, before, node.h.loc) || falls || body.ways_out != before;
    }
    case StmtKind::Try: return checkTry(context, context.code().as<TryStmt>(id));
    case StmtKind::Exit:
    case StmtKind::Continue:
      if (context.loop_depth == 0) {
        const bool exit = tree.kind(id) == StmtKind::Exit;
        context.report(diag::OutsideLoop, tree.loc(id), {exit ? "EXIT" : "CONTINUE"});
        return true;
      }
      if (tree.kind(id) == StmtKind::Exit) ++body.ways_out;
      return false;
    case StmtKind::Return: ++body.ways_out; return false;
    case StmtKind::Jump:
      ++body.ways_out;
      body.jumps.push_back({tree.as<JumpStmt>(id).label, body.block});
      return false;
    case StmtKind::Label: body.labels.push_back({tree.as<LabelStmt>(id).label, body.block}); return true;
  }
  return true;
}

}  // namespace

bool checkStatements(Context& context, Slice<StmtId> list) {
  if (list.empty()) return true;
  BodyState& body = *context.body;
  if (body.stmt_depth >= kMaxStmtDepth) {
    context.report(diag::StatementsTooDeep, context.tree().loc(context.tree().list(list)[0]),
                   {std::to_string(kMaxStmtDepth)});
    return true;
  }
  ++body.stmt_depth;
  const uint32_t outer = body.block;
  body.block_parents.push_back(outer);
  body.block = static_cast<uint32_t>(body.block_parents.size());  // 0 is above all
  bool reachable = true, reported = false;
  for (const StmtId id : context.tree().list(list)) {
    const StmtKind kind = context.tree().kind(id);
    if (kind == StmtKind::Label) reachable = true;
    if (!reachable && !reported && kind != StmtKind::Empty && kind != StmtKind::Error) {
      context.report(diag::Unreachable, kind == StmtKind::Assign
                                            ? context.tree().begin(context.tree().as<AssignStmt>(id).target)
                                            : context.tree().loc(id));
      reported = true;
    }
    const bool falls = checkStatement(context, id);
    context.rules->statement(context, id);
    reachable = reachable && falls;
  }
  body.block = outer;
  --body.stmt_depth;
  return reachable;
}

}  // namespace rung::sema

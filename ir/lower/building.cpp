// Building blocks of lowering: nodes, temporaries, statements of the open block. An IR expression is a tree, so a node
// that is attached a second time is copied (`spare` marks attached nodes; it is cleared when the body is complete).
#include "ir/lower/lowering.h"
#include "ir/walk.h"

namespace rung::ir {

BodyLowering::BodyLowering(ModuleLowering& in, Body& body, sema::PouId pou)
    : in_(in), project_(in.project), tree_(in.tree), types_(in.types), body_(body), pou_(pou) {
  if (body_.exprs.empty()) body_.exprs.emplace_back();
  if (body_.stmts.empty()) body_.stmts.emplace_back();
  for (uint32_t i = 0; i < body_.locals.size(); ++i)
    if (body_.locals[i].kind == LocalKind::Result) result_local_ = i;
  if (!pou_ || body_.kind == BodyKind::Init) return;
  uint32_t next = 0;  // ModuleLowering::bodyOf made a local of each variable of this storage, in order
  for (sema::VarId id : project_.pou(pou_).vars) {
    const sema::Var& var = project_.var(id);
    if (var.storage != sema::Storage::Local) continue;
    if (local_of_.size() <= var.field) local_of_.resize(var.field + 1);
    local_of_[var.field] = ++next;
  }
}

uint32_t BodyLowering::attach(uint32_t expr) {
  if (expr == 0) return 0;
  Expr& node = body_.exprs[expr];
  if (node.spare == 0) {
    node.spare = 1;
    return expr;
  }
  return copyTree(expr);
}

uint32_t BodyLowering::copyTree(uint32_t id) {
  Expr copy = body_.exprs[id];
  copy.spare = 1;
  if (copy.kind == ExprKind::Index || copy.kind == ExprKind::Call) {
    uint32_t first = static_cast<uint32_t>(body_.operands.size());
    for (uint32_t i = 0; i < copy.c; ++i) body_.operands.push_back(body_.operands[copy.b + i]);
    copy.b = first;
    for (uint32_t i = 0; i < copy.c; ++i) {
      uint32_t operand = copyTree(body_.operands[first + i].index);  // may grow `operands`
      body_.operands[first + i].index = operand;
    }
    if (copy.kind == ExprKind::Index) copy.a = copyTree(copy.a);
  } else {
    forEachSlot(body_, copy, [&](uint32_t& slot) { slot = copyTree(slot); });
  }
  body_.exprs.push_back(copy);
  return static_cast<uint32_t>(body_.exprs.size() - 1);
}

ExprId BodyLowering::add(Expr expr) {
  if (expr.kind == ExprKind::Index || expr.kind == ExprKind::Call)
    for (uint32_t i = 0; i < expr.c; ++i) {
      uint32_t operand = attach(body_.operands[expr.b + i].index);  // may grow `operands`
      body_.operands[expr.b + i].index = operand;
    }
  bool list_only = expr.kind == ExprKind::Call;
  if (!list_only) {
    uint32_t operands = expr.kind == ExprKind::Index ? 1 : 0;
    switch (expr.kind) {
      case ExprKind::Field:
      case ExprKind::Deref:
      case ExprKind::Bits:
      case ExprKind::Unary:
      case ExprKind::Convert:
      case ExprKind::Address: operands = 1; break;
      case ExprKind::Binary: operands = 2; break;
      case ExprKind::Select: operands = 3; break;
      case ExprKind::None:
      case ExprKind::Const:
      case ExprKind::String:
      case ExprKind::Data:
      case ExprKind::Zero:
      case ExprKind::Local:
      case ExprKind::Self:
      case ExprKind::Global:
      case ExprKind::Program:
      case ExprKind::Image:
      case ExprKind::Index:
      case ExprKind::Call: break;
    }
    if (operands > 0) expr.a = attach(expr.a);
    if (operands > 1) expr.b = attach(expr.b);
    if (operands > 2) expr.c = attach(expr.c);
  }
  body_.exprs.push_back(expr);
  return {static_cast<uint32_t>(body_.exprs.size() - 1)};
}

ExprId BodyLowering::constant(TypeId type, uint64_t bits, Loc loc) {
  return add({.kind = ExprKind::Const,
              .type = strip(type),
              .loc = loc,
              .a = static_cast<uint32_t>(bits),
              .b = static_cast<uint32_t>(bits >> 32)});
}

ExprId BodyLowering::stringConstant(TypeId type, NameId string, Loc loc) {
  return add({.kind = ExprKind::String, .type = strip(type), .loc = loc, .a = string.index});
}

ExprId BodyLowering::ofValue(const Value& value, Loc loc) {
  if (TypeTable::isString(types_.plainKind(value.type)))
    return stringConstant(value.type, NameId{static_cast<uint32_t>(value.bits)}, loc);
  return constant(value.type, value.bits, loc);
}

ExprId BodyLowering::zero(TypeId type, Loc loc) {
  type = strip(type);
  if (!isAggregate(type)) return constant(type, 0, loc);
  return add({.kind = ExprKind::Zero, .type = type, .loc = loc});
}

bool BodyLowering::isAggregate(TypeId type) const {
  TypeKind kind = types_.kind(type);
  return kind == TypeKind::Array || kind == TypeKind::Record || TypeTable::isString(kind);
}

ExprId BodyLowering::local(uint32_t index, Loc loc) {
  return add({.kind = ExprKind::Local, .type = body_.locals[index].type, .loc = loc, .a = index});
}

ExprId BodyLowering::temp(TypeId type, Loc loc) {
  char name[16];
  int length = std::snprintf(name, sizeof name, "t%u", ++temp_count_);
  NameId id = in_.module.names.intern({name, static_cast<size_t>(length)});
  in_.module.types.layout(strip(type));  // of a string length that no declaration uses
  body_.locals.push_back({id, strip(type), LocalKind::Temp, false, loc});
  return local(static_cast<uint32_t>(body_.locals.size() - 1), loc);
}

ExprId BodyLowering::field(ExprId base, uint32_t index, TypeId type, Loc loc) {
  // While the project is being checked, records may not have their fields yet; only its being outside matters then.
  if (in_.partial && (body_.expr(base).kind == ExprKind::Global || body_.expr(base).kind == ExprKind::Program))
    return add({.kind = ExprKind::Global, .type = type, .loc = loc});
  const types::Field& info = types_.info(typeOf(base)).fields[index];
  uint8_t checks = info.by_reference ? in_.options.checks & kCheckNull : 0;
  return add({.kind = ExprKind::Field, .checks = checks, .type = strip(type), .loc = loc, .a = base.index, .b = index});
}

ExprId BodyLowering::asBase(ExprId place, sema::PouId base, Loc loc) {
  for (;;) {
    const sema::PouId object = in_.pouOfRecord(typeOf(place));
    if (object == base || !object || !project_.pou(object).base) return place;
    const sema::Pou& pou = project_.pou(object);
    place = field(place, project_.var(pou.object.base_var).field, project_.pou(pou.base).record, loc);
  }
}

ExprId BodyLowering::self(Loc loc) { return add({.kind = ExprKind::Self, .type = body_.self, .loc = loc}); }

ExprId BodyLowering::unary(Op op, TypeId type, ExprId operand, Loc loc) {
  return add({.kind = ExprKind::Unary, .op = op, .type = strip(type), .loc = loc, .a = operand.index});
}

ExprId BodyLowering::binary(Op op, TypeId type, ExprId left, ExprId right, Loc loc) {
  type = strip(type);
  bool divides = op == Op::Div || op == Op::Mod;
  bool checked = divides && !TypeTable::isReal(types_.plainKind(type));
  return add({.kind = ExprKind::Binary,
              .op = op,
              .checks = static_cast<uint8_t>(checked ? in_.options.checks & kCheckDiv : 0),
              .type = type,
              .loc = loc,
              .a = left.index,
              .b = right.index});
}

ExprId BodyLowering::convert(ExprId operand, TypeId to, Loc loc) {
  to = strip(to);
  uint8_t checks = 0;
  if (types_.kind(to) == TypeKind::Subrange) checks |= in_.options.checks & kCheckSubrange;
  TypeKind from_kind = types_.plainKind(typeOf(operand)), to_kind = types_.plainKind(to);
  bool integer_result = !TypeTable::isReal(to_kind) && TypeTable::isScalar(to_kind);
  // A long time or date converted to a short one is scaled: its number does not show whether it fits.
  const bool is_scaled = !TypeTable::isInteger(to_kind) && !TypeTable::isBits(to_kind) && to_kind != from_kind;
  if (TypeTable::isScalar(from_kind) && integer_result && !is_scaled && !types::isLossless(types_, typeOf(operand), to))
    checks |= in_.options.checks & kCheckConvert;
  return add({.kind = ExprKind::Convert, .checks = checks, .type = to, .loc = loc, .a = operand.index});
}

void BodyLowering::assign(ExprId place, ExprId value, Loc loc) {
  if (guard_ && mayFault(value) && isTemp(place) && !isAggregate(typeOf(place))) {
    append({.kind = StmtKind::Assign, .loc = loc, .a = place.index, .b = zero(typeOf(place), loc).index});
    StmtId then = block([&] { append({.kind = StmtKind::Assign, .loc = loc, .a = place.index, .b = value.index}); });
    append({.kind = StmtKind::If, .loc = loc, .a = guard_.index, .b = then.index});
    return;
  }
  append({.kind = StmtKind::Assign, .loc = loc, .a = place.index, .b = value.index});
}

StmtId BodyLowering::make(Stmt stmt) {
  if (stmt.kind == StmtKind::Call) {
    stmt.b = attach(stmt.b);
    for (uint32_t i = 0; i < stmt.d; ++i) {
      uint32_t operand = attach(body_.operands[stmt.c + i].index);  // may grow `operands`
      body_.operands[stmt.c + i].index = operand;
    }
    stmt.e = attach(stmt.e);
  } else {
    forEachRoot(in_.module, body_, stmt, [&](uint32_t& slot, Use) { slot = attach(slot); });
  }
  effects_ += hasEffect(stmt) ? 1 : 0;
  body_.stmts.push_back(stmt);
  return {static_cast<uint32_t>(body_.stmts.size() - 1)};
}

StmtId BodyLowering::append(Stmt stmt) {
  StmtId id = make(stmt);
  if (block_.last)
    body_.stmt(block_.last).next = id;
  else
    block_.first = id;
  block_.last = id;
  return id;
}

void BodyLowering::finish() {
  for (Expr& expr : body_.exprs) expr.spare = 0;
}

}  // namespace rung::ir

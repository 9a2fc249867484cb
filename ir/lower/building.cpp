// Building blocks of lowering: nodes with the checks that the options ask for, temporaries, the body's end.
#include "ir/lower/lowering.h"
#include "ir/walk.h"

namespace rung::ir {

BodyLowering::BodyLowering(ModuleLowering& in, Body& body, sema::PouId pou)
    : in_(in), project_(in.project), tree_(in.tree), types_(in.types), body_(body), pou_(pou), build_(in.module, body) {
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

void BodyLowering::attach(ExprId& id) {
  if (!id) return;
  if (attached_.size() <= id.index) attached_.resize(body_.exprs.size() + 64);
  if (attached_[id.index]) {
    id = build_.copy(id);
    attached_.resize(body_.exprs.size() + 64);
  }
  attached_[id.index] = true;
}

Slice<ExprId> BodyLowering::list(std::span<const ExprId> operands) {
  std::vector<ExprId> own(operands.begin(), operands.end());
  for (ExprId& operand : own) attach(operand);
  return build_.list(own);
}

ExprId BodyLowering::addExpr(Expr expr) {
  if (expr.kind == ExprKind::Index)
    attach(expr.as<IndexExpr>().base);
  else if (expr.kind != ExprKind::Call)
    forEachOperand(body_, expr, [&](ExprId& operand) { attach(operand); });
  return build_.push(expr);
}

StmtId BodyLowering::appendStmt(Stmt stmt) {
  if (stmt.kind == StmtKind::Call) {
    attach(stmt.as<CallStmt>().self);
    attach(stmt.as<CallStmt>().result);
  } else {
    forEachRoot(in_.module, body_, stmt, [&](ExprId& root, Use) { attach(root); });
  }
  return build_.push(stmt);
}

uint32_t BodyLowering::effects() {
  for (; effects_counted_ < body_.stmts.size(); ++effects_counted_)
    effects_ += hasEffect(body_.stmts[effects_counted_]) ? 1 : 0;
  return effects_;
}

ExprId BodyLowering::constant(TypeId type, uint64_t bits, Loc loc) {
  return add(loc, strip(type), ConstExpr{.bits = bits});
}

ExprId BodyLowering::stringConstant(TypeId type, NameId string, Loc loc) {
  return add(loc, strip(type), StringExpr{.characters = string});
}

ExprId BodyLowering::ofValue(const Value& value, Loc loc) {
  if (TypeTable::isString(types_.plainKind(value.type)))
    return stringConstant(value.type, NameId{static_cast<uint32_t>(value.bits)}, loc);
  return constant(value.type, value.bits, loc);
}

ExprId BodyLowering::zero(TypeId type, Loc loc) {
  type = strip(type);
  if (!isAggregate(type)) return constant(type, 0, loc);
  return add(loc, type, ZeroExpr{});
}

bool BodyLowering::isAggregate(TypeId type) const {
  TypeKind kind = types_.kind(type);
  return kind == TypeKind::Array || kind == TypeKind::Record || TypeTable::isString(kind);
}

ExprId BodyLowering::local(uint32_t index, Loc loc) {
  return add(loc, body_.locals[index].type, LocalExpr{.local = index});
}

ExprId BodyLowering::temp(TypeId type, Loc loc) {
  in_.module.types.layout(strip(type));  // of a string length that no declaration uses
  build_.loc = loc;
  return local(build_.temp(type), loc);
}

ExprId BodyLowering::field(ExprId base, uint32_t index, TypeId type, Loc loc) {
  // While the project is being checked, records may not have their fields yet; only its being outside matters then.
  if (in_.partial && (body_.expr(base).kind == ExprKind::Global || body_.expr(base).kind == ExprKind::Program))
    return add(loc, type, GlobalExpr{});
  const types::Field& info = types_.info(typeOf(base)).fields[index];
  uint8_t checks = info.by_reference ? in_.options.checks & kCheckNull : 0;
  return add(loc, strip(type), FieldExpr{.base = base, .field = index}, checks);
}

ExprId BodyLowering::asBase(ExprId place, sema::PouId base, Loc loc) {
  for (;;) {
    const sema::PouId object = in_.pouOfRecord(typeOf(place));
    if (object == base || !object || !project_.pou(object).base) return place;
    const sema::Pou& pou = project_.pou(object);
    place = field(place, project_.var(pou.object.base_var).field, project_.pou(pou.base).record, loc);
  }
}

ExprId BodyLowering::self(Loc loc) { return add(loc, body_.self, SelfExpr{}); }

ExprId BodyLowering::unary(Op op, TypeId type, ExprId operand, Loc loc) {
  return add(loc, strip(type), UnaryExpr{.operand = operand, .op = op});
}

ExprId BodyLowering::binary(Op op, TypeId type, ExprId left, ExprId right, Loc loc) {
  type = strip(type);
  bool divides = op == Op::Div || op == Op::Mod;
  bool checked = divides && !TypeTable::isReal(types_.plainKind(type));
  return add(loc, type, BinaryExpr{.left = left, .right = right, .op = op},
             static_cast<uint8_t>(checked ? in_.options.checks & kCheckDiv : 0));
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
  return add(loc, to, ConvertExpr{.operand = operand}, checks);
}

void BodyLowering::assign(ExprId place, ExprId value, Loc loc) {
  if (guard_ && mayFault(value) && isTemp(place) && !isAggregate(typeOf(place))) {
    append(loc, AssignStmt{.place = place, .value = zero(typeOf(place), loc)});
    StmtId then = block([&] { append(loc, AssignStmt{.place = place, .value = value}); });
    append(loc, IfStmt{.condition = guard_, .then_block = then});
    return;
  }
  append(loc, AssignStmt{.place = place, .value = value});
}

ExprId BodyLowering::element(ExprId array, std::span<const ExprId> indices, Loc loc) {
  return add(loc, strip(types_.info(typeOf(array)).base), IndexExpr{.base = array, .indices = list(indices)});
}

void BodyLowering::callOn(BodyId callee, ExprId self, Loc loc) {
  append(loc, CallStmt{.callee = callee, .self = self});
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Building blocks of lowering: see body_part.h.
#include "ir/lower/lowering.h"
#include "ir/walk.h"

namespace rung::ir {
namespace {

uint32_t lowestBit(uint64_t bytes) { return static_cast<uint32_t>(bytes & (~bytes + 1)); }

}  // namespace

BodyState::BodyState(ModuleLowering& in, Body& body, sema::PouId pou, BodyLowering& parts)
    : in(in), body(body), pou(pou), parts(parts), build(in.module, body) {
  for (uint32_t i = 0; i < body.locals.size(); ++i)
    if (body.locals[i].kind == LocalKind::Result) result_local = i;
  if (!pou || body.kind == BodyKind::Init) return;
  uint32_t next = 0;  // ModuleLowering::bodyOf made a local of each variable of this storage, in order
  for (sema::VarId id : in.project.pou(pou).vars) {
    const sema::Var& var = in.project.var(id);
    if (var.storage != sema::Storage::Local || var.sharing.field) continue;
    if (local_of.size() <= var.field) local_of.resize(var.field + 1);
    local_of[var.field] = ++next;
  }
}

BodyPart::BodyPart(BodyState& state)
    : state_(state),
      in_(state.in),
      project_(state.in.project),
      tree_(state.in.tree),
      types_(state.in.types),
      body_(state.body),
      pou_(state.pou),
      build_(state.build) {}

PlaceLowering& BodyPart::places() const { return state_.parts.places; }
ValueLowering& BodyPart::values() const { return state_.parts.values; }
CallLowering& BodyPart::calls() const { return state_.parts.calls; }
ObjectLowering& BodyPart::objects() const { return state_.parts.objects; }

ExprId BodyPart::constant(TypeId type, uint64_t bits, Loc loc) {
  return add(loc, strip(type), ConstExpr{.bits = bits});
}

ExprId BodyPart::stringConstant(TypeId type, NameId string, Loc loc) {
  return add(loc, strip(type), StringExpr{.characters = string});
}

ExprId BodyPart::ofValue(const Value& value, Loc loc) {
  if (TypeTable::isString(types_.plainKind(value.type)))
    return stringConstant(value.type, NameId{static_cast<uint32_t>(value.bits)}, loc);
  return constant(value.type, value.bits, loc);
}

ExprId BodyPart::zero(TypeId type, Loc loc) {
  type = strip(type);
  if (!isAggregate(type)) return constant(type, 0, loc);
  return add(loc, type, ZeroExpr{});
}

ExprId BodyPart::local(uint32_t index, Loc loc) {
  return add(loc, body_.locals[index].type, LocalExpr{.local = index});
}

ExprId BodyPart::temp(TypeId type, Loc loc) {
  in_.module.types.layout(strip(type));  // of a string length that no declaration uses
  build_.loc = loc;
  return local(build_.temp(type), loc);
}

ExprId BodyPart::field(ExprId base, uint32_t index, TypeId type, Loc loc) {
  // While the project is being checked, records may not have their fields yet; only its being outside matters then.
  if (in_.partial && (body_.expr(base).kind == ExprKind::Global || body_.expr(base).kind == ExprKind::Program))
    return add(loc, type, GlobalExpr{});
  const types::Field& info = types_.info(typeOf(base)).fields[index];
  uint8_t checks = info.by_reference ? in_.options.checks & kCheckNull : 0;
  return add(loc, strip(type), FieldExpr{.base = base, .field = index}, checks);
}

ExprId BodyPart::asBase(ExprId place, sema::PouId base, Loc loc) {
  for (;;) {
    const sema::PouId object = in_.records.pouOf(typeOf(place));
    if (object == base || !object || !project_.pou(object).base) return place;
    const sema::Pou& pou = project_.pou(object);
    place = field(place, project_.var(pou.object.base_var).field, project_.pou(pou.base).record, loc);
  }
}

ExprId BodyPart::self(Loc loc) { return add(loc, body_.self, SelfExpr{}); }

ExprId BodyPart::place(const Root& root, Loc loc) {
  return root.is_list ? add(loc, root.record, GlobalExpr{.list = root.index})
                      : add(loc, root.record, ProgramExpr{.program = root.index});
}

ExprId BodyPart::unary(Op op, TypeId type, ExprId operand, Loc loc) {
  return add(loc, strip(type), UnaryExpr{.operand = operand, .op = op});
}

ExprId BodyPart::binary(Op op, TypeId type, ExprId left, ExprId right, Loc loc) {
  type = strip(type);
  if (op == Op::Sar && !TypeTable::isSignedInteger(types_.plainKind(type))) op = Op::Shr;
  // iec: MOD by zero is 0, by the standard's definition of MOD.
  const bool defined_for_0 = profile().modulo_by_zero_is_zero;
  bool divides = op == Op::Div || (op == Op::Mod && !defined_for_0);
  bool checked = divides && !TypeTable::isReal(types_.plainKind(type));
  return add(loc, type, BinaryExpr{.left = left, .right = right, .op = op},
             static_cast<uint8_t>(checked ? in_.options.checks & kCheckDiv : 0));
}

// Libraries and POUs with {attribute 'no_check'} wrap and cut values on purpose.
bool BodyPart::wraps() const { return isLibraryCode() || (pou_ && project_.pou(pou_).pragmas.no_check); }
bool BodyPart::checksOverflow() const { return (in_.options.checks & kCheckOverflow) != 0 && !wraps(); }

ExprId BodyPart::arithmetic(ExprId operation) {
  Expr& e = body_.expr(operation);
  const TypeKind kind = types_.plainKind(e.type);
  const bool is_number = TypeTable::isScalar(kind) && kind != TypeKind::Bool;
  const bool is_operation = e.kind == ExprKind::Unary || e.kind == ExprKind::Binary;
  if (checksOverflow() && is_number && is_operation && types::mayOverflow(e.op())) e.checks |= kCheckOverflow;
  return operation;
}

ExprId BodyPart::convert(ExprId operand, TypeId to, Loc loc, types::Rounding rounding) {
  to = strip(to);
  uint8_t checks = 0;
  if (types_.kind(to) == TypeKind::Subrange) checks |= in_.options.checks & kCheckSubrange;
  TypeKind from_kind = types_.plainKind(typeOf(operand)), to_kind = types_.plainKind(to);
  bool integer_result = !TypeTable::isReal(to_kind) && TypeTable::isScalar(to_kind);
  // A long time or date converted to a short one is scaled: its number does not show whether it fits.
  const bool is_scaled = !TypeTable::isInteger(to_kind) && !TypeTable::isBits(to_kind) && to_kind != from_kind;
  if (!wraps() && TypeTable::isScalar(from_kind) && integer_result && !is_scaled &&
      !types::isLossless(types_, typeOf(operand), to))
    checks |= in_.options.checks & kCheckConvert;
  return add(loc, to, ConvertExpr{.operand = operand, .rounding = rounding}, checks);
}

// The alignment that the address of a view of the image has at least: an area begins at a multiple of 8.
uint32_t BodyPart::alignmentInImage(ExprId view) const {
  const Expr& e = body_.expr(view);
  uint64_t offset = 0;
  uint32_t base_align = 8;
  if (const auto* image = e.tryAs<ImageExpr>()) {
    offset = image->byte;
  } else if (const auto* part = e.tryAs<FieldExpr>()) {
    offset = types_.info(typeOf(part->base)).fields[part->field].offset;
    base_align = alignmentInImage(part->base);
  } else if (const auto* element = e.tryAs<IndexExpr>()) {
    offset = types_.info(strip(types_.info(typeOf(element->base)).base)).size;
    base_align = alignmentInImage(element->base);
  }
  return offset == 0 ? base_align : std::min(base_align, lowestBit(offset));
}

// The alignment that the address of a place has at least; a record has no demands, since its C++ struct knows.
uint32_t BodyPart::alignmentOf(ExprId place) const {
  const Expr& e = body_.expr(place);
  if (const auto* part = e.tryAs<FieldExpr>()) {
    const TypeInfo& record = types_.info(typeOf(part->base));
    const types::Field& field = record.fields[part->field];
    if (field.by_reference) return types_.info(e.type).align;
    return field.offset == 0 ? record.placed_align : std::min(record.placed_align, lowestBit(field.offset));
  }
  if (const auto* element = e.tryAs<IndexExpr>()) {
    const uint64_t stride = types_.info(strip(types_.info(typeOf(element->base)).base)).size;
    return std::min(alignmentOf(element->base), lowestBit(stride));
  }
  // A pointer may lead to such a member.
  return e.kind == ExprKind::Deref ? 1 : types_.info(e.type).align;
}

bool BodyPart::isReferable(ExprId place) const {
  const Expr& e = body_.expr(place);
  if (e.kind == ExprKind::Bits || isImageBit(e)) return false;
  if (!isPlace(e.kind)) return true;
  if (body_.expr(rootOf(body_, place)).kind == ExprKind::Image)
    return alignmentInImage(place) >= types_.info(e.type).align;
  if (!types_.has_misaligned) return true;
  TypeId type = e.type;
  while (types_.kind(type) == TypeKind::Array) type = strip(types_.info(type).base);
  return types_.kind(type) == TypeKind::Record || alignmentOf(place) >= types_.info(type).align;
}

void BodyPart::assign(ExprId place, ExprId value, Loc loc) {
  if (state_.guard && mayFault(value) && isTemp(place) && !isAggregate(typeOf(place))) {
    append(loc, AssignStmt{.place = copy(place), .value = zero(typeOf(place), loc)});
    StmtId then = block([&] { append(loc, AssignStmt{.place = place, .value = value}); });
    append(loc, IfStmt{.condition = copy(state_.guard), .then_block = then});
    return;
  }
  append(loc, AssignStmt{.place = place, .value = value});
}

ExprId BodyPart::element(ExprId array, std::span<const ExprId> indices, Loc loc) {
  return add(loc, strip(types_.info(typeOf(array)).base), IndexExpr{.base = array, .indices = list(indices)});
}

void BodyPart::callOn(BodyId callee, ExprId self, Loc loc) { append(loc, CallStmt{.callee = callee, .self = self}); }

}  // namespace rung::ir

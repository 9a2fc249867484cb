// SPDX-License-Identifier: Apache-2.0
// Lowering of values: literals, operators, conversions. In: checked expressions. Out: IR expressions; calls inside them
// become statements before, and values that were read before a call move to a temporary (evaluation_order.cpp).
#include "frontend/source/dialect.h"
#include "ir/lower/lowering.h"
#include "ir/string_end.h"
#include "sema/declarations/constants.h"
#include "sema/intermediate.h"

namespace rung::ir {

ExprId ValueLowering::lowerLiteral(rung::ExprId id) {
  return ofValue(sema::valueOf(project_, tree_.as<LiteralExpr>(id)), tree_.loc(id));
}

ExprId ValueLowering::lowerValue(rung::ExprId id) {
  switch (tree_.kind(id)) {
    case rung::ExprKind::Literal: return lowerLiteral(id);
    case rung::ExprKind::Name:
    case rung::ExprKind::Member:
    case rung::ExprKind::TypedName: {
      if (auto value = sema::constantOf(project_, id)) return ofValue(*value, tree_.loc(id));
      if (tree_.kind(id) == rung::ExprKind::Member) {
        // lowerPlace returns here only for an expression that is not an lvalue.
        const MemberExpr& node = tree_.as<MemberExpr>(id);
        RUNG_INVARIANT(sema::meaning(node.h).entity.entityKind() == sema::EntityKind::Var,
                       "a member is a variable or a constant");
      }
      return closed(places().lowerPlace(id));
    }
    case rung::ExprKind::This:
    case rung::ExprKind::Super: {
      ExprId object = self(tree_.loc(id));
      if (tree_.kind(id) == rung::ExprKind::Super)
        object = asBase(object, project_.pou(in_.objectOf(pou_)).base, tree_.loc(id));
      return add(tree_.loc(id), strip(sema::typeOf(tree_, id)), AddressExpr{.place = object});
    }
    case rung::ExprKind::Index:
    case rung::ExprKind::Deref:
    case rung::ExprKind::BitAccess:
    case rung::ExprKind::Address: return closed(places().lowerPlace(id));
    case rung::ExprKind::Unary: return lowerUnary(id);
    case rung::ExprKind::Binary: return lowerBinary(id);
    case rung::ExprKind::Convert: return lowerConvert(id);
    case rung::ExprKind::AddressOf: return lowerAddressOf(id);
    case rung::ExprKind::AnyValue: return lowerAnyValue(id);
    case rung::ExprKind::New: return lowerNew(id);
    case rung::ExprKind::Assign: return lowerAssignment(tree_.as<AssignExpr>(id));
    case rung::ExprKind::Bound: {
      const BoundExpr& node = tree_.as<BoundExpr>(id);
      return places().openArrayBound(node.array, node.index, node.h.loc);
    }
    case rung::ExprKind::Call:
      return sema::uncutType(project_, id) ? lowerIn(id, strip(sema::typeOf(tree_, id))) : calls().lowerCall(id);
    case rung::ExprKind::Error:
    case rung::ExprKind::Range:
    case rung::ExprKind::ArrayInit:
    case rung::ExprKind::Repeat:
    case rung::ExprKind::StructInit: break;
  }
  RUNG_INVARIANT(false, "an expression without a value is not lowered");
  return {};
}

// A string that other variables may overlap, cut at its capacity.
ExprId ValueLowering::closed(ExprId place) {
  if (!TypeTable::isString(types_.kind(typeOf(place))) || !mayLackEnd(types_, body_, place)) return place;
  return toTemp(place, body_.expr(place).loc);
}

ExprId ValueLowering::lowerUnary(rung::ExprId id) {
  const rung::UnaryExpr& node = tree_.as<rung::UnaryExpr>(id);
  if (auto value = sema::constantOf(project_, id)) return ofValue(*value, node.h.loc);
  if (sema::uncutType(project_, id)) return lowerIn(id, strip(sema::meaning(node.h).type));
  ExprId operand = lowerValue(node.operand);
  TypeId type = strip(sema::meaning(node.h).type);
  switch (node.op()) {
    case UnaryOp::Plus: return operand;
    case UnaryOp::Not: return unary(Op::Not, type, operand, node.h.loc);
    case UnaryOp::Negate: return arithmetic(unary(Op::Neg, type, operand, node.h.loc));
  }
  return {};
}

ExprId ValueLowering::lowerBinary(rung::ExprId id) {
  const rung::BinaryExpr& node = tree_.as<rung::BinaryExpr>(id);
  BinaryOp op = node.op();
  bool logical = op == BinaryOp::And || op == BinaryOp::Or || op == BinaryOp::AndThen || op == BinaryOp::OrElse;
  if (logical && types_.plainKind(strip(sema::meaning(node.h).type)) == TypeKind::Bool) {
    bool is_and = op == BinaryOp::And || op == BinaryOp::AndThen;
    bool short_circuit = op == BinaryOp::AndThen || op == BinaryOp::OrElse || project_.profile.short_circuit;
    return lowerLogical(id, is_and, short_circuit);
  }
  if (sema::uncutType(project_, id)) return lowerIn(id, strip(sema::meaning(node.h).type));
  const TypeId compared =
      types::isComparison(sema::operatorOf(op)) ? sema::comparedType(project_, node.left, node.right) : TypeId{};
  ExprId left = lowerOperand(node.left, compared);
  ExprId right = lowerAfter({&left}, [&] { return lowerOperand(node.right, compared); });
  return arithmetic(binary(sema::operatorOf(op), strip(sema::meaning(node.h).type), left, right, node.h.loc));
}

// The value that the target takes is kept in a temporary: an operand to the right may change the target again.
ExprId ValueLowering::lowerAssignment(const AssignExpr& node) {
  const Loc loc = node.h.loc;
  ExprId value = lowerValue(node.value);
  const ExprId kept = temp(strip(sema::meaning(node.h).type), loc);
  assign(kept, convertValue(value, typeOf(kept), loc), loc);
  assign(places().lowerPlace(node.target), copy(kept), loc);
  return copy(kept);
}

// Tells whether the expression contains a call of a function that may have an effect.
bool ValueLowering::callsFunction(rung::ExprId id) const {
  switch (tree_.kind(id)) {
    case rung::ExprKind::Unary: return callsFunction(tree_.as<rung::UnaryExpr>(id).operand);
    case rung::ExprKind::Convert: return callsFunction(tree_.as<rung::ConvertExpr>(id).operand);
    case rung::ExprKind::Member: return callsFunction(tree_.as<MemberExpr>(id).base);
    case rung::ExprKind::Deref: return callsFunction(tree_.as<rung::DerefExpr>(id).base);
    case rung::ExprKind::Bound: return false;
    case rung::ExprKind::New:
    case rung::ExprKind::Assign: return true;
    case rung::ExprKind::AnyValue: return callsFunction(tree_.as<AnyValueExpr>(id).value);
    case rung::ExprKind::AddressOf: return callsFunction(tree_.as<AddressOfExpr>(id).lvalue);
    case rung::ExprKind::BitAccess: return callsFunction(tree_.as<BitAccessExpr>(id).base);
    case rung::ExprKind::Binary:
      return callsFunction(tree_.as<rung::BinaryExpr>(id).left) || callsFunction(tree_.as<rung::BinaryExpr>(id).right);
    case rung::ExprKind::Index: {
      const rung::IndexExpr& node = tree_.as<rung::IndexExpr>(id);
      for (rung::ExprId index : tree_.list(node.indices))
        if (callsFunction(index)) return true;
      return isOpenArray(types_, sema::typeOf(tree_, node.base)) ||
             callsFunction(node.base);  // its check is a statement
    }
    case rung::ExprKind::Call: {
      const sema::Call& call = project_.call(sema::meaning(tree_, id).call);
      if (call.kind != sema::CallKind::Operator && !project_.pou(call.pou).pragmas.pure) return true;
      for (const sema::Binding& binding : call.bindings)
        if (binding.value && callsFunction(binding.value)) return true;
      return call.en && callsFunction(call.en);
    }
    case rung::ExprKind::Error:
    case rung::ExprKind::Literal:
    case rung::ExprKind::Name:
    case rung::ExprKind::TypedName:
    case rung::ExprKind::This:
    case rung::ExprKind::Super:
    case rung::ExprKind::Address:
    case rung::ExprKind::Range:
    case rung::ExprKind::ArrayInit:
    case rung::ExprKind::Repeat:
    case rung::ExprKind::StructInit: return false;
  }
  return false;
}

// BOOL AND and OR. codesys: calls in both operands run, but a check in the right one counts only when the left operand
// does not decide the result. iec and AND_THEN, OR_ELSE: the right operand is not evaluated at all then.
ExprId ValueLowering::lowerLogical(rung::ExprId id, bool is_and, bool short_circuit) {
  const rung::BinaryExpr& node = tree_.as<rung::BinaryExpr>(id);
  Loc loc = node.h.loc;
  Op op = is_and ? Op::And : Op::Or;
  ExprId left = lowerValue(node.left);
  const ExprId chained = left == state_.logical ? left : ExprId{};
  auto guarded = [&](ExprId result, StmtId right_block) {
    const ExprId read = copy(result);
    const ExprId matters = is_and ? read : unary(Op::Not, types::kBool, read, loc);
    append(loc, IfStmt{.condition = matters, .then_block = right_block});
    return state_.logical = result;
  };
  // A chain such as `a AND b AND c` shares one temporary.
  auto holding = [&](ExprId value) {
    if (chained && value == chained) return value;
    return toTemp(value, loc);
  };

  if (!short_circuit) {
    ExprId outer_guard = state_.guard;
    if (callsFunction(node.right)) {
      left = toTemp(left, loc);
      ExprId matters = is_and ? copy(left) : unary(Op::Not, types::kBool, copy(left), loc);
      if (state_.guard) matters = binary(Op::And, types::kBool, copy(state_.guard), matters, loc);
      state_.guard = is_and && !state_.guard ? matters : toTemp(matters, loc);
    }
    ExprId right = lowerAfter({&left}, [&] { return lowerValue(node.right); });
    state_.guard = outer_guard;
    if (!mayFault(right)) return binary(op, types::kBool, left, right, loc);
    ExprId result = holding(left);
    return guarded(result, block([&] { assign(copy(result), right, loc); }));
  }

  const Block outer = build_.open();
  ExprId right = lowerValue(node.right);
  const Block inner = build_.block();
  build_.close(outer);
  if (!inner.first && !mayFault(right)) return binary(op, types::kBool, left, right, loc);
  ExprId result = holding(left);
  return guarded(result, block([&] {
                   build_.block() = inner;
                   assign(copy(result), right, loc);
                 }));
}

ExprId ValueLowering::lowerConvert(rung::ExprId id) {
  if (auto value = sema::constantOf(project_, id)) return ofValue(*value, tree_.loc(id));
  const rung::ConvertExpr& node = tree_.as<rung::ConvertExpr>(id);
  const TypeKind kind = types_.kind(strip(sema::meaning(node.h).type));
  if (kind == TypeKind::Record || kind == TypeKind::Array) return lowerPart(node);
  if (ExprId object = lowerObjectConversion(node)) return object;
  if (sema::uncutType(project_, node.operand)) return convertUncut(node);
  return convertValue(lowerValue(node.operand), strip(sema::meaning(node.h).type), node.h.loc,
                      sema::roundingOf(sema::meaning(node.h)));
}

// The value of an object or structure as one of what it extends: a copy, which is an object of that kind. An array as
// one with other bounds.
ExprId ValueLowering::lowerPart(const rung::ConvertExpr& node) {
  const Loc loc = node.h.loc;
  const TypeId type = strip(sema::meaning(node.h).type);
  const sema::PouId base = in_.records.pouOf(type);
  ExprId place = places().lowerPlace(node.operand);
  place = base ? asBase(place, base, loc) : places().seenAs(place, type, loc);
  const ExprId part = temp(type, loc);
  assign(copy(part), place, loc);
  if (base && project_.pou(base).object.dispatched) {
    sema::PouId first = base;
    while (!project_.pou(first).object.id_var) first = project_.pou(first).base;
    const uint32_t id = project_.var(project_.pou(first).object.id_var).field;
    assign(field(asBase(copy(part), first, loc), id, types::kUDInt, loc),
           add(loc, types::kUDInt, ConstExpr{.number_of = type}), loc);
  }
  return part;
}

// The address of the target of a pointer or reference is its value: nothing is read.
ExprId ValueLowering::lowerAddressOf(rung::ExprId id) {
  const AddressOfExpr& node = tree_.as<AddressOfExpr>(id);
  const TypeId type = strip(sema::meaning(node.h).type);
  if (isOpenArray(types_, sema::typeOf(tree_, node.lvalue)))
    return convertValue(places().openArrayPointer(node.lvalue, node.h.loc), type, node.h.loc);
  // ADR(p^) is p, even if p points nowhere; for p[i] the base is a place that will be used.
  if (tree_.kind(node.lvalue) == rung::ExprKind::Deref && !sema::meaning(node.h).leads_somewhere)
    return convertValue(lowerValue(tree_.as<rung::DerefExpr>(node.lvalue).base), type, node.h.loc);
  const ExprId place = places().lowerPlace(node.lvalue);
  if (body_.expr(place).kind == ExprKind::Field) body_.expr(place).checks = 0;  // an in-out that is not bound: null
  return add(node.h.loc, type, AddressExpr{.place = place});
}

// A descriptor of the value in a temporary; a value that is not an lvalue is stored in a temporary.
ExprId ValueLowering::lowerAnyValue(rung::ExprId id) {
  const AnyValueExpr& node = tree_.as<AnyValueExpr>(id);
  const Loc loc = node.h.loc;
  ExprId value = places().lowerPlace(node.value);
  const Expr& expr = body_.expr(value);
  const bool is_bit = expr.kind == ExprKind::Bits || isImageBit(expr);
  if (!isPlace(expr.kind) || is_bit) value = toTemp(value, loc);
  ExprId descriptor = temp(sema::meaning(node.h).type, loc);
  const TypeInfo& record = types_.info(strip(sema::meaning(node.h).type));
  auto part = [&](uint32_t index) { return field(copy(descriptor), index, record.fields[index].type, loc); };
  if (node.facts) {  // __VARINFO: the address is the first member
    objects().storeInitial(copy(descriptor), sema::meaning(node.h).type, node.facts, false);
    const TypeId to = types_.pointer(typeOf(value));
    types_.layout(to);
    const ExprId address = add(loc, to, AddressExpr{.place = value});
    assign(part(0), convert(convert(address, types::kULInt, loc), types::kDWord, loc), loc);
    return descriptor;
  }
  const TypeId pointer = strip(record.fields[1].type);
  const uint64_t size = types_.info(typeOf(value)).size;
  assign(part(0), constant(strip(record.fields[0].type), node.type_class, loc), loc);
  assign(part(1), add(loc, pointer, AddressExpr{.place = value}), loc);
  assign(part(2), constant(types::kDInt, size, loc), loc);
  return descriptor;
}

// An object as a pointer to an interface, and a pointer to an object as one to its base; none for other conversions.
ExprId ValueLowering::lowerObjectConversion(const rung::ConvertExpr& node) {
  const TypeId to = strip(sema::meaning(node.h).type), from = strip(sema::typeOf(tree_, node.operand));
  if (types_.kind(to) != TypeKind::Pointer && types_.kind(to) != TypeKind::Reference) return {};
  const sema::PouId wanted = in_.records.pouOf(strip(types_.info(to).base));
  if (!wanted) return {};
  const Loc loc = node.h.loc;
  auto addressOf = [&](ExprId place) {
    const TypeId pointer = types_.pointer(typeOf(place));
    const ExprId address = add(loc, pointer, AddressExpr{.place = place});
    return pointer == to ? address : add(loc, to, ConvertExpr{.operand = address});
  };
  if (types_.kind(from) == TypeKind::Record) return addressOf(places().lowerPlace(node.operand));
  if (types_.kind(from) != TypeKind::Pointer && types_.kind(from) != TypeKind::Reference) return {};
  const TypeId target = strip(types_.info(from).base);
  const sema::PouId object = in_.records.pouOf(target);
  if (!object || object == wanted) return {};
  ExprId pointer = lowerValue(node.operand);
  if (in_.isKindOf(wanted, object)) pointer = checkedDowncast(pointer, object, wanted, loc);
  const sema::Pou& pou = project_.pou(object);
  // The pointer changes only where the base lies after the type id of the derived object.
  if (project_.pou(wanted).kind == PouKind::Interface || !pou.object.dispatched ||
      project_.pou(wanted).object.dispatched)
    return add(loc, to, ConvertExpr{.operand = pointer});
  if (!isStable(pointer)) pointer = toTemp(pointer, loc);
  const ExprId result = temp(to, loc);
  assign(copy(result), constant(to, 0, loc), loc);
  const ExprId is_null = binary(Op::Ne, types::kBool, copy(pointer), constant(from, 0, loc), loc);
  const StmtId then = block([&] {
    const ExprId whole = add(loc, target, DerefExpr{.pointer = pointer});
    assign(copy(result), addressOf(asBase(whole, wanted, loc)), loc);
  });
  append(loc, IfStmt{.condition = is_null, .then_block = then});
  return result;
}

}  // namespace rung::ir

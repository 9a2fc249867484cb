// SPDX-License-Identifier: Apache-2.0
// Lowering of ARRAY[*], allowed for a VAR_IN_OUT and for any pin of a function. In memory and in a call it is a pointer
// to the first element and two numbers for each dimension (sema::Var::bounds). An element is reached through a pointer
// to one row of elements, long enough for all; its check is a statement before the access, because the bounds vary.
#include "ir/lower/lowering.h"

namespace rung::ir {

namespace {

constexpr uint64_t kMaxBytes = uint64_t{1} << 30;

}  // namespace

// The pointer or a bound: a local of a function, a field of the instance.
ExprId PlaceLowering::openArrayPart(rung::ExprId array, sema::VarId part, Loc loc) {
  const sema::Var& var = project_.var(part);
  const TypeId type =
      types_.isOpenArray(var.type) ? types_.pointer(types_.info(strip(var.type)).base) : strip(var.type);
  if (var.storage == sema::Storage::Local) return local(state_.local_of[var.field] - 1, loc);
  if (tree_.kind(array) == rung::ExprKind::Member)
    return field(lowerPlace(tree_.as<MemberExpr>(array).base), var.field, type, loc);
  return field(self(loc), var.field, type, loc);
}

ExprId PlaceLowering::openArrayPointer(rung::ExprId array, Loc loc) {
  return openArrayPart(array, rootVar(array), loc);
}

ExprId PlaceLowering::openArrayBound(rung::ExprId array, uint32_t index, Loc loc) {
  return openArrayPart(array, {project_.var(rootVar(array)).open_array.bounds.index + index}, loc);
}

ExprId PlaceLowering::openArrayElement(const rung::IndexExpr& node) {
  const Loc loc = node.h.loc;
  const TypeId element = strip(sema::meaning(node.h).type);
  const TypeId number = types::kLInt;
  ExprId offset;  // of the element, counted in elements
  std::vector<ExprId> indices;
  for (rung::ExprId index : tree_.list(node.indices)) {
    InsertionPoint point = here();
    ExprId value = values().lowerValue(index);
    for (ExprId& earlier : indices) spill(point, {&earlier});
    indices.push_back(value);
  }
  for (uint32_t i = 0; i < indices.size(); ++i) {
    ExprId index = convertValue(indices[i], number, loc);
    if (!isStable(index)) index = toTemp(index, loc);
    auto bound = [&](uint32_t which) {
      return convertValue(openArrayBound(node.base, 2 * i + which, loc), number, loc);
    };
    if ((in_.options.checks & kCheckIndex) != 0) {
      ExprId outside = binary(Op::Or, types::kBool, binary(Op::Lt, types::kBool, copy(index), bound(0), loc),
                              binary(Op::Gt, types::kBool, copy(index), bound(1), loc), loc);
      if (state_.guard) outside = binary(Op::And, types::kBool, copy(state_.guard), outside, loc);
      StmtId fault = block([&] { append(loc, FaultStmt{.value = copy(index), .fault = types::Fault::Index}); });
      append(loc, IfStmt{.condition = outside, .then_block = fault});
    }
    ExprId step = binary(Op::Sub, number, index, bound(0), loc);
    if (!offset) {
      offset = step;
      continue;
    }
    ExprId count =
        binary(Op::Add, number, binary(Op::Sub, number, bound(1), bound(0), loc), constant(number, 1, loc), loc);
    offset = binary(Op::Add, number, binary(Op::Mul, number, offset, count, loc), step, loc);
  }
  const uint64_t size = std::max<uint64_t>(1, types_.info(element).size);
  const types::Dimension all{0, static_cast<int64_t>(kMaxBytes / size) - 1};
  const TypeId row = types_.array(element, {&all, 1});
  types_.layout(row);
  const ExprId pointer = convert(openArrayPointer(node.base, loc), types_.pointer(row), loc);
  const bool of_block = project_.var(rootVar(node.base)).storage == sema::Storage::Field;  // may be called without it
  const ExprId base = add(loc, row, DerefExpr{.pointer = pointer},
                          static_cast<uint8_t>(of_block ? in_.options.checks & kCheckNull : 0));
  return this->element(base, {&offset, 1}, loc);
}

OpenArray PlaceLowering::noOpenArray(TypeId pin_type, Loc loc) {
  const TypeInfo& pin = types_.info(strip(pin_type));
  OpenArray passed;
  passed.pointer = constant(types_.pointer(pin.base), 0, loc);
  for (uint32_t i = 0; i < 2 * pin.length; ++i)
    passed.bounds.push_back(constant(types::kDInt, i % 2 == 0 ? 0 : ~uint64_t{0}, loc));
  return passed;
}

OpenArray PlaceLowering::passOpenArray(rung::ExprId argument, TypeId pin_type, bool copies) {
  const Loc loc = tree_.loc(argument);
  const TypeInfo& given = types_.info(strip(sema::typeOf(tree_, argument)));
  const uint32_t count = 2 * types_.info(strip(pin_type)).length;
  OpenArray passed;
  if (given.dimensions.empty()) {  // passed on
    passed.pointer = openArrayPointer(argument, loc);
    for (uint32_t i = 0; i < count; ++i) passed.bounds.push_back(openArrayBound(argument, i, loc));
    return passed;
  }
  const TypeId pointer = types_.pointer(types_.info(strip(pin_type)).base);
  ExprId place = lowerPlace(argument);
  if (copies) place = calls().argumentPlace(place, typeOf(place), true, loc);
  place = isPlace(body_.expr(place).kind) ? stable(place) : toTemp(place, loc);
  passed.pointer = add(loc, pointer, AddressExpr{.place = place});
  for (uint32_t i = 0; i < count; ++i) {
    const types::Dimension& dimension = given.dimensions[i / 2];
    passed.bounds.push_back(
        constant(types::kDInt, static_cast<uint64_t>(i % 2 == 0 ? dimension.low : dimension.high), loc));
  }
  return passed;
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// Lowering of __NEW and __DELETE. The pool is a list of globals and its functions are ST (stdlib/__system); this file
// adds what depends on the type: initial values and FB_Init after the allocation, FB_Exit before the release.
#include "ir/lower/lowering.h"

namespace rung::ir {

ExprId ValueLowering::callPool(sema::PouId function, std::initializer_list<ExprId> arguments, Loc loc) {
  const BodyId body = in_.bodyOf(function);
  const ExprId result = temp(strip(project_.pou(function).result), loc);
  append(loc, CallStmt{.callee = body, .operands = list({arguments.begin(), arguments.size()}), .result = result});
  return copy(result);
}

ExprId ValueLowering::lowerNew(rung::ExprId id) {
  const NewExpr& node = tree_.as<NewExpr>(id);
  const sema::Call& allocate = project_.call(sema::meaning(node.h).call);
  const Loc loc = node.h.loc;
  const TypeId pointer_type = strip(sema::meaning(node.h).type), declared = types_.info(pointer_type).base,
               type = strip(declared);
  in_.records.declare(type);
  ExprId count = constant(types::kLInt, 1, loc);
  if (node.count) {
    count = temp(types::kLInt, loc);
    assign(copy(count), lowerValue(node.count), loc);
  }
  const ExprId size = constant(types::kLInt, types_.info(type).size, loc);
  const ExprId memory = callPool(allocate.pou, {count, size}, loc);
  const ExprId pointer = temp(pointer_type, loc);
  assign(copy(pointer), convertValue(memory, pointer_type, loc), loc);
  if (in_.records.isZero(declared)) return pointer;
  const ExprId is_there = binary(Op::Ne, types::kBool, copy(pointer), constant(pointer_type, 0, loc), loc);
  const sema::CallId outer = state_.given;
  state_.given = allocate.constructor;
  const StmtId then = block([&] {
    if (!node.count) {
      const ExprId place = add(loc, type, DerefExpr{.pointer = copy(pointer)});
      objects().storeInitial(place, declared, {}, true);
      return;
    }
    constexpr uint64_t kMaxBytes = uint64_t{1} << 30;
    const uint64_t bytes = std::max<uint64_t>(1, types_.info(type).size);
    const types::Dimension all{0, static_cast<int64_t>(kMaxBytes / bytes) - 1};
    const TypeId row = types_.array(type, {&all, 1}), to_row = types_.pointer(row);
    types_.layout(row);
    types_.layout(to_row);
    const ExprId elements = convert(copy(pointer), to_row, loc);
    const ExprId whole = add(loc, row, DerefExpr{.pointer = elements});
    const ExprId control = temp(types::kLInt, loc), number = copy(control);
    const StmtId body = block([&] { objects().storeInitial(element(whole, {&number, 1}, loc), declared, {}, true); });
    const ExprId last = binary(Op::Sub, types::kLInt, copy(count), constant(types::kLInt, 1, loc), loc);
    append(loc, ForStmt{.control = control,
                        .from = constant(types::kLInt, 0, loc),
                        .to = last,
                        .step = constant(types::kLInt, 1, loc),
                        .body_block = body});
  });
  state_.given = outer;
  append(loc, IfStmt{.condition = is_there, .then_block = then});
  return pointer;
}

// A null pointer stays null. Memory that is not of the pool, or was released before, is fault[null].
void ValueLowering::lowerDelete(const sema::Call& call, Loc loc) {
  const bool is_this = tree_.kind(call.instance) == rung::ExprKind::This;
  const ExprId place = is_this ? lowerValue(call.instance) : stable(places().lowerPlace(call.instance));
  const TypeId pointer_type = typeOf(place), type = strip(types_.info(pointer_type).base);
  const ExprId pointer = toTemp(copy(place), loc);
  const TypeId bytes = strip(project_.var(project_.pou(call.pou).vars.front()).type);
  const auto memory = [&] { return convertValue(copy(pointer), bytes, loc); };
  const auto require = [&](ExprId ok) {
    if ((in_.options.checks & kCheckNull) == 0) return;
    const ExprId failed = unary(Op::Not, types::kBool, ok, loc);
    const ExprId value = convert(copy(pointer), types::kLInt, loc);
    const StmtId fault = block([&] { append(loc, FaultStmt{.value = value, .fault = types::Fault::Null}); });
    append(loc, IfStmt{.condition = failed, .then_block = fault});
  };
  const StmtId then = block([&] {
    const sema::PouId object = in_.records.pouOf(type);
    if (in_.hasExit(type) || (object && project_.pou(object).object.dispatched)) {
      const ExprId owned = callPool(call.owns, {memory()}, loc);
      require(copy(owned));
      const StmtId ends = block([&] {
        const ExprId whole = add(loc, type, DerefExpr{.pointer = copy(pointer)});
        if (object)
          objects().callExit(whole, false, loc);
        else
          objects().exitElement(whole, type);
      });
      if (ends) append(loc, IfStmt{.condition = owned, .then_block = ends});
    }
    require(callPool(call.pou, {memory()}, loc));
    if (!is_this) assign(place, constant(pointer_type, 0, loc), loc);
  });
  const ExprId is_there = binary(Op::Ne, types::kBool, pointer, constant(pointer_type, 0, loc), loc);
  append(loc, IfStmt{.condition = is_there, .then_block = then});
}

}  // namespace rung::ir

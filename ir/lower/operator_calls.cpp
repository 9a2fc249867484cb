// SPDX-License-Identifier: Apache-2.0
// Lowering of operators in call form: ADD, GT, SEL, MUX, MOVE and conversions. In: calls that sema has resolved to an
// operator. Out: values; `if` and `switch` where an input is evaluated only when it is chosen. Called by calls.cpp.
#include <numeric>

#include "ir/lower/lowering.h"
#include "sema/intermediate.h"

namespace rung::ir {

ExprId CallLowering::operandOr0(const sema::Binding& binding, TypeId type, Loc loc) {
  return binding.value ? values().lowerValue(binding.value)
                       : ofValue(types::defaultValue(types_, in_.module.names, type), loc);
}

ExprId CallLowering::lowerOperator(const sema::Call& call, const rung::CallExpr& node) {
  const sema::Pou& pou = project_.pou(call.pou);
  switch (pou.pragmas.operator_kind) {
    case sema::OperatorKind::Op: return lowerArithmeticOperator(call, node, {});
    case sema::OperatorKind::Select: return lowerSelect(call, node);
    case sema::OperatorKind::Mux: return lowerMux(call, node);
    case sema::OperatorKind::Move:
    case sema::OperatorKind::Convert:
    case sema::OperatorKind::None:
      return convertValue(operandOr0(call.bindings.front(), strip(sema::meaning(node.h).type), node.h.loc),
                          sema::meaning(node.h).type, node.h.loc, sema::roundingOf(sema::meaning(node.h)));
  }
  return {};
}

// `native`: the type in which an intermediate result is computed; none: the operands' own.
ExprId CallLowering::lowerArithmeticOperator(const sema::Call& call, const rung::CallExpr& node, TypeId native) {
  Op op = project_.pou(call.pou).pragmas.op;
  Loc loc = node.h.loc;
  TypeId type = native ? native : strip(sema::meaning(node.h).type);
  TypeId operand_type = native;
  for (const sema::Binding& binding : call.bindings)
    if (types::isComparison(op) && binding.value && !native) native = sema::uncutType(project_, binding.value);
  for (const sema::Binding& binding : call.bindings)
    if (binding.value && !operand_type) operand_type = native ? native : strip(sema::typeOf(tree_, binding.value));
  if (!operand_type) operand_type = type;
  std::vector<uint32_t> order(call.bindings.size());
  std::iota(order.begin(), order.end(), 0);
  writtenOrder(order, [&](uint32_t i) { return call.bindings[i].value; });
  std::vector<ExprId> operands(call.bindings.size());
  for (const uint32_t number : order) {
    const sema::Binding& binding = call.bindings[number];
    InsertionPoint point = here();
    ExprId operand =
        native && binding.value ? values().lowerIn(binding.value, native) : operandOr0(binding, operand_type, loc);
    for (size_t i = operands.size(); i-- > 0;) spill(point, {&operands[i]});
    operands[number] = operand;
  }
  if (types::operandCount(op) == 1) return arithmetic(unary(op, type, operands[0], loc));
  if (!types::isComparison(op) || operands.size() == 2) {
    ExprId value = operands[0];
    for (size_t i = 1; i < operands.size(); ++i) value = arithmetic(binary(op, type, value, operands[i], loc));
    return value;
  }
  // A chain: GT(a, b, c) is (a > b) AND (b > c), each operand evaluated once.
  ExprId value;
  for (size_t i = 0; i + 1 < operands.size(); ++i) {
    ExprId& right = operands[i + 1];
    if (i + 2 < operands.size() && !isStable(right) && !isAggregate(typeOf(right))) right = toTemp(right, loc);
    ExprId link = binary(op, types::kBool, i == 0 ? operands[0] : copy(operands[i]), right, loc);
    value = value ? binary(Op::And, types::kBool, value, link, loc) : link;
  }
  return value;
}

// SEL(G, IN0, IN1): only the chosen input is evaluated, if evaluating the other could be observed.
ExprId CallLowering::lowerSelect(const sema::Call& call, const rung::CallExpr& node) {
  Loc loc = node.h.loc;
  TypeId type = strip(sema::meaning(node.h).type);
  RUNG_INVARIANT(call.bindings.size() == 3, "SEL has a selector and two inputs");
  ExprId selector = operandOr0(call.bindings[0], types::kBool, loc);
  if (state_.guard && mayFault(selector)) selector = toTemp(selector, loc);
  auto branch = [&](const sema::Binding& binding, Block& created) {
    const Block outer = build_.open();
    ExprId value = convertValue(operandOr0(binding, type, loc), type, loc);
    created = build_.block();
    build_.close(outer);
    return value;
  };
  Block created0, created1;
  ExprId value0 = branch(call.bindings[1], created0);
  ExprId value1 = branch(call.bindings[2], created1);
  bool plain = !created0.first && !created1.first && !mayFault(value0) && !mayFault(value1);
  if (plain && !isAggregate(type))
    return add(loc, type, SelectExpr{.condition = selector, .when_true = value1, .when_false = value0});
  ExprId result = temp(type, loc);
  auto finish = [&](Block created, ExprId value) {
    return block([&] {
      build_.block() = created;
      assign(copy(result), value, loc);
    });
  };
  StmtId when_true = finish(created1, value1);
  StmtId when_false = finish(created0, value0);
  append(loc, IfStmt{.condition = selector, .then_block = when_true, .else_block = when_false});
  return result;
}

// MUX(K, IN0, IN1, …): any K outside 0..n-1 chooses the last input (syntax manual 5.4.1.3.4, TM/TP 6.2.2).
ExprId CallLowering::lowerMux(const sema::Call& call, const rung::CallExpr& node) {
  Loc loc = node.h.loc;
  TypeId type = strip(sema::meaning(node.h).type);
  RUNG_INVARIANT(call.bindings.size() >= 2, "MUX has a selector and inputs");
  ExprId selector = values().lowerValue(call.bindings[0].value);
  if (state_.guard && mayFault(selector)) selector = toTemp(selector, loc);
  ExprId result = temp(type, loc);
  uint32_t inputs = static_cast<uint32_t>(call.bindings.size()) - 1;
  std::vector<StmtId> blocks;
  for (uint32_t i = 0; i < inputs; ++i)
    blocks.push_back(block(
        [&] { assign(copy(result), convertValue(operandOr0(call.bindings[i + 1], type, loc), type, loc), loc); }));
  uint32_t first_case = static_cast<uint32_t>(body_.cases.size());
  for (uint32_t i = 0; i + 1 < inputs; ++i) {
    body_.cases.push_back({{static_cast<uint32_t>(body_.ranges.size()), 1}, blocks[i]});
    body_.ranges.push_back({i, i});
  }
  append(loc, SwitchStmt{.selector = selector, .cases = {first_case, inputs - 1}, .else_block = blocks.back()});
  return result;
}

}  // namespace rung::ir

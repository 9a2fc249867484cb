// SPDX-License-Identifier: Apache-2.0
// Lowering of ASSERT, ASSERT_EQ and ASSERT_NEAR. In: calls that sema has resolved. Out: Assert statements; of a
// condition that compares also its sides and their source. Called by calls.cpp.
#include "ir/assertion.h"

#include <algorithm>

#include "ir/lower/lowering.h"
#include "sema/declarations/constants.h"
#include "sema/intermediate.h"

namespace rung::ir {

namespace {

// One line, without blanks at its ends and without parentheses that open or close outside of it.
std::string collapseBlanks(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!blank) out += c;
    if (blank && !out.empty() && out.back() != ' ') out += ' ';
  }
  const auto count = [&](char c) { return std::count(out.begin(), out.end(), c); };
  while (!out.empty() && (out.back() == ' ' || (out.back() == ')' && count(')') > count('(')))) out.pop_back();
  while (!out.empty() && (out[0] == ' ' || (out[0] == '(' && count('(') > count(')')))) out.erase(0, 1);
  return out;
}

}  // namespace

// The condition, its left and its right side as written, a line each; a literal's side is empty.
NameId CallLowering::comparedOperands(const rung::CallExpr& node, const rung::BinaryExpr& condition) {
  const Sources& sources = project_.sources;
  const FileId file = sources.fileOf(node.h.loc);
  const std::string_view source = sources.sourceText(file);
  const uint32_t base = sources.begin(file).offset;
  const size_t open = source.find('(', tree_.begin(node.callee).offset - base);
  const size_t at = condition.h.loc.offset - base, op_size = sources.tokenAt(condition.h.loc).size();
  size_t end = node.end.offset - base;
  if (node.arguments.count > 1) end = source.rfind(',', tree_.begin(tree_.list(node.arguments)[1].value).offset - base);
  if (end == std::string_view::npos || open >= at || at + op_size > end || end > source.size()) return {};
  const std::string left = collapseBlanks(source.substr(open + 1, at - open - 1)), op(source.substr(at, op_size)),
                    right = collapseBlanks(source.substr(at + op_size, end - at - op_size));
  const auto name = [&](rung::ExprId side, const std::string& text) {
    while (tree_.kind(side) == rung::ExprKind::Convert) side = tree_.as<rung::ConvertExpr>(side).operand;
    const TypeKind kind = types_.info(strip(sema::typeOf(tree_, side))).kind;
    const bool is_self_explanatory =
        tree_.kind(side) == rung::ExprKind::Literal || (kind == TypeKind::Enum && sema::constantOf(project_, side));
    return is_self_explanatory ? std::string() : text;
  };
  const std::string left_name = name(condition.left, left), right_name = name(condition.right, right);
  if (left_name.empty() && right_name.empty()) return {};
  return in_.module.names.intern(left + ' ' + op + ' ' + right + '\n' + left_name + '\n' + right_name);
}

void CallLowering::lowerAssertion(const sema::Call& call, const rung::CallExpr& node) {
  AssertStmt stmt{.assertion = static_cast<Assertion>(call.assertion)};
  size_t count = call.bindings.size();
  size_t operands = call.assertion == sema::Assertion::Assert ? 1 : call.assertion == sema::Assertion::AssertEq ? 2 : 3;
  RUNG_INVARIANT(count >= operands, "an assertion has its operands");
  const rung::ExprId condition = call.bindings[0].value;
  if (operands == 1 && tree_.kind(condition) == rung::ExprKind::Binary) {
    const rung::BinaryExpr& node_of = tree_.as<rung::BinaryExpr>(condition);
    const BinaryOp op = node_of.op();
    const TypeId type = strip(sema::typeOf(tree_, node_of.left));
    const bool compares = op >= BinaryOp::Equal && op <= BinaryOp::GreaterEqual;
    if (compares && assertedKind(types_, type) != RUNG_POINTER) stmt.shown = comparedOperands(node, node_of);
  }
  ExprId a, b, c;
  if (stmt.shown) {
    const rung::BinaryExpr& compared = tree_.as<rung::BinaryExpr>(condition);
    const auto once = [&](ExprId value) { return isStable(value) ? value : toTemp(value, compared.h.loc); };
    const TypeId wide = sema::comparedType(project_, compared.left, compared.right);
    b = values().lowerOperand(compared.left, wide);
    c = lowerAfter({&b}, [&] { return values().lowerOperand(compared.right, wide); });
    b = once(b);
    c = once(c);
    a = binary(sema::operatorOf(compared.op()), types::kBool, copy(b), copy(c), compared.h.loc);
  } else {
    a = values().lowerValue(condition);
    if (operands > 1) b = lowerAfter({&a}, [&] { return values().lowerValue(call.bindings[1].value); });
    if (operands > 2) c = lowerAfter({&a, &b}, [&] { return values().lowerValue(call.bindings[2].value); });
  }
  stmt.first = a;
  stmt.second = b;
  stmt.third = c;
  if (count > operands && call.bindings[operands].value) {
    const rung::ExprId message = call.bindings[operands].value;
    if (const auto text = sema::constantOf(project_, message))
      stmt.text = NameId{static_cast<uint32_t>(text->bits)};
    else
      stmt.message = lowerAfter({&stmt.first, &stmt.second, &stmt.third}, [&] { return values().lowerValue(message); });
  }
  append(node.h.loc, stmt);
}

}  // namespace rung::ir

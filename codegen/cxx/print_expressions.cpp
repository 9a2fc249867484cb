// SPDX-License-Identifier: Apache-2.0
// Prints expressions of C++, with the parentheses that the grammar needs or g++ wants: see printer.h.
#include "codegen/cxx/print.h"
#include "codegen/cxx/printer.h"

namespace rung::codegen::cxx {

// Low to high: an operand that binds less than its place needs gets parentheses.
enum class Prec : uint8_t {
  Comma,
  Assign,
  Choice,
  Or,
  And,
  Bit,
  Equality,
  Relation,
  Shift,
  Sum,
  Product,
  Unary,
  Postfix
};

namespace {

struct OperatorRow {
  std::string_view text;
  Prec own, left, right;
  bool joins;
};
constexpr OperatorRow kOperators[] = {
#define RUNG_CXX_OPERATOR(name, text, own, left, right, joins) {text, Prec::own, Prec::left, Prec::right, joins},
#include "codegen/cxx/operators.def"
#undef RUNG_CXX_OPERATOR
};

const OperatorRow& rowOf(const Node& infix) { return kOperators[static_cast<size_t>(infix.op)]; }

Prec precOf(const Node& node) {
  switch (node.kind) {
    case NodeKind::Negative:
    case NodeKind::Prefix:
    case NodeKind::Cast: return Prec::Unary;
    case NodeKind::Infix: return rowOf(node).own;
    case NodeKind::Choice: return Prec::Choice;
    case NodeKind::Name:
    case NodeKind::Number:
    case NodeKind::Call:
    case NodeKind::Invoke:
    case NodeKind::List:
    case NodeKind::Element:
    case NodeKind::Member:
    case NodeKind::Arrow:
    case NodeKind::Lambda:
    case NodeKind::Group: return Prec::Postfix;
  }
  return Prec::Postfix;
}

// !a or ~a, also cut to its type.
bool isComplement(const Node& node) {
  if (node.kind == NodeKind::Cast) return isComplement(*node.operands[0]);
  return node.kind == NodeKind::Prefix && (node.text == "!" || node.text == "~");
}
bool isNot(const Node& node) { return node.kind == NodeKind::Prefix && node.text == "!"; }

}  // namespace

void ExpressionPrinter::print(const Node& node) {
  switch (node.kind) {
    case NodeKind::Name:
    case NodeKind::Number:
    case NodeKind::Negative: out_ += node.text; return;
    case NodeKind::Prefix:
      out_ += node.text;
      operand(*node.operands[0], node.text == "-" ? Prec::Postfix : Prec::Unary);
      return;
    case NodeKind::Cast:
      out_ += '(';
      out_ += node.text;
      out_ += ')';
      operand(*node.operands[0], Prec::Unary);
      return;
    case NodeKind::Infix: return infix(node);
    case NodeKind::Choice:
      operand(*node.operands[0], Prec::Or);
      out_ += " ? ";
      operand(*node.operands[1], Prec::Or);
      out_ += " : ";
      operand(*node.operands[2], Prec::Or);
      return;
    case NodeKind::Call: out_ += node.text; return call(node.operands);
    case NodeKind::Invoke: operand(*node.operands[0], Prec::Postfix); return call(node.operands.subspan(1));
    case NodeKind::List:
      out_ += '{';
      list(node.operands);
      out_ += '}';
      return;
    case NodeKind::Element:
      operand(*node.operands[0], Prec::Postfix);
      out_ += '[';
      print(*node.operands[1]);
      out_ += ']';
      return;
    case NodeKind::Member:
    case NodeKind::Arrow:
      operand(*node.operands[0], Prec::Postfix);
      out_ += node.kind == NodeKind::Member ? "." : "->";
      out_ += node.text;
      return;
    case NodeKind::Lambda:
      out_ += "[](";
      out_ += node.text;
      out_ += ") { ";
      print(*node.operands[0]);
      out_ += "; }";
      return;
    case NodeKind::Group: return parenthesized(*node.operands[0]);
  }
}

void ExpressionPrinter::call(std::span<const Node* const> arguments) {
  out_ += '(';
  list(arguments);
  out_ += ')';
}

void ExpressionPrinter::infix(const Node& node) {
  const OperatorRow& row = rowOf(node);
  const Node &left = *node.operands[0], &right = *node.operands[1];
  const bool compares = row.own == Prec::Equality || row.own == Prec::Relation;
  const bool wraps_left = compares ? isComplement(left) : row.own == Prec::Bit && isNot(left);
  side(node, left, wraps_left ? Prec::Postfix : row.left);
  out_ += row.text;
  side(node, right, row.own == Prec::Bit && isNot(right) ? Prec::Postfix : row.right);
}

void ExpressionPrinter::side(const Node& node, const Node& of, Prec needed) {
  const bool is_same = of.kind == NodeKind::Infix && of.op == node.op && rowOf(node).joins;
  is_same ? print(of) : operand(of, needed);
}

void ExpressionPrinter::operand(const Node& node, Prec needed) {
  precOf(node) < needed ? parenthesized(node) : print(node);
}

void ExpressionPrinter::parenthesized(const Node& node) {
  out_ += '(';
  print(node);
  out_ += ')';
}

void ExpressionPrinter::list(std::span<const Node* const> items) {
  for (size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out_ += ", ";
    operand(*items[i], Prec::Assign);
  }
}

// More than there is room for.
Sink& Sink::appendLarge(std::string_view text) {
  flush();
  if (text.size() <= sizeof buffer_) return *this += text;
  out_ += text;
  return *this;
}

void print(std::string& out, Ex expression) {
  Sink sink(out);
  ExpressionPrinter(sink).print(*expression);
}

std::string toString(Ex expression) {
  std::string out;
  print(out, expression);
  return out;
}

}  // namespace rung::codegen::cxx

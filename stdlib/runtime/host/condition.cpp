// SPDX-License-Identifier: Apache-2.0
// Parser and evaluator of --stop-on conditions: see condition.h.
#include "condition.h"

#include <cstring>

#include "tasks.h"
#include "value_format.h"

namespace rung::host {
namespace {

constexpr uint32_t kDeepest = 100;
const rung_type kConditionType = {RUNG_BOOL, 0, 0, 0, 1, RUNG_NONE, 0, 0, 0};

bool isWordCharacter(char c) {
  return c == '_' || c == '%' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool isNumber(const rung_type& type) { return type.kind >= RUNG_BYTE && type.kind <= RUNG_LREAL; }

// Numbers compare with numbers of any type, other values only with their own kind, and an enumeration with itself.
bool comparable(const rung_type& a, const rung_type& b) {
  if (isNumber(a) && isNumber(b)) return true;
  return a.kind == b.kind && (a.kind != RUNG_ENUM || &a == &b);
}

// -1, 0 or 1: compares strings by code units.
template <typename Unit>
int compareStrings(const uint8_t* a, const uint8_t* b) {
  for (;; a += sizeof(Unit), b += sizeof(Unit)) {
    Unit x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    if (x != y) return x < y ? -1 : 1;
    if (x == 0) return 0;
  }
}

}  // namespace

bool Condition::fail(std::string what) {
  if (error_.empty()) error_ = std::move(what);
  return false;
}

void Condition::skipBlanks() {
  while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\n'))
    rest_.remove_prefix(1);
}

bool Condition::takeSymbol(std::string_view symbol) {
  skipBlanks();
  if (rest_.substr(0, symbol.size()) != symbol) return false;
  rest_.remove_prefix(symbol.size());
  return true;
}

bool Condition::takeWord(std::string_view word) {
  skipBlanks();
  size_t length = 0;
  while (length < rest_.size() && isWordCharacter(rest_[length])) ++length;
  if (lowerCase(rest_.substr(0, length)) != word) return false;
  if (length < rest_.size() && (rest_[length] == '.' || rest_[length] == '#')) return false;  // the name of an instance
  rest_.remove_prefix(length);
  return true;
}

uint32_t Condition::add(Kind kind, uint32_t left, uint32_t right) {
  nodes_.emplace_back();
  nodes_.back().kind = kind;
  nodes_.back().left = left;
  nodes_.back().right = right;
  return static_cast<uint32_t>(nodes_.size() - 1);
}

bool Condition::parse(std::string_view text, std::string& error) {
  rest_ = text;
  if (parseBinary(0, 0, root_)) {
    skipBlanks();
    if (rest_.empty())
      needBool(root_);
    else
      fail("expected a comparison, AND, XOR or OR, found " + backquoted(rest_));
  }
  error = error_;
  return error.empty();
}

// Levels: OR, XOR, AND, equality, order.
bool Condition::parseBinary(uint32_t level, uint32_t depth, uint32_t& node) {
  if (level == 5) return parseUnary(depth, node);
  if (!parseBinary(level + 1, depth, node)) return false;
  for (;;) {
    Kind kind = Kind::Compare;
    Relation relation = Relation::Equal;
    if (level == 0 && takeWord("or")) {
      kind = Kind::Or;
    } else if (level == 1 && takeWord("xor")) {
      kind = Kind::Xor;
    } else if (level == 2 && (takeWord("and") || takeSymbol("&"))) {
      kind = Kind::And;
    } else if (level == 3 && takeSymbol("<>")) {
      relation = Relation::Unequal;
    } else if (level == 3 && takeSymbol("=")) {
      relation = Relation::Equal;
    } else if (level == 4 && takeSymbol("<=")) {
      relation = Relation::LessEqual;
    } else if (level == 4 && takeSymbol(">=")) {
      relation = Relation::GreaterEqual;
    } else if (level == 4 && (skipBlanks(), rest_.substr(0, 2) != "<>") && takeSymbol("<")) {
      relation = Relation::Less;
    } else if (level == 4 && takeSymbol(">")) {
      relation = Relation::Greater;
    } else {
      return true;
    }
    const uint32_t left = node;
    uint32_t right = 0;
    if (!parseBinary(level + 1, depth, right)) return false;
    if (kind == Kind::Compare) {
      if (!compare(relation, left, right, node)) return false;
    } else {
      if (!needBool(left) || !needBool(right)) return false;
      node = add(kind, left, right);
    }
  }
}

bool Condition::parseUnary(uint32_t depth, uint32_t& node) {
  if (depth == kDeepest) return fail("more than 100 nested parentheses and NOT");
  if (takeWord("not")) {
    uint32_t operand = 0;
    if (!parseUnary(depth + 1, operand) || !needBool(operand)) return false;
    node = add(Kind::Not, operand, operand);
    return true;
  }
  if (takeSymbol("(")) {
    if (!parseBinary(0, depth + 1, node)) return false;
    return takeSymbol(")") ||
           fail(rest_.empty() ? "expected `)` at the end" : "expected `)` before " + backquoted(rest_));
  }
  return parseOperand(node);
}

bool Condition::parseOperand(uint32_t& node) {
  skipBlanks();
  if (rest_.empty()) return fail("expected a variable or a value at the end");
  size_t length = 0;
  bool is_literal = true;
  if (rest_.front() == '\'' || rest_.front() == '"') {
    const char quote = rest_.front();
    length = 1;
    while (length < rest_.size() && rest_[length] != quote) length += rest_[length] == '$' ? 2 : 1;
    if (length >= rest_.size()) return fail("the quote of " + backquoted(rest_) + " is not closed");
    ++length;
  } else {
    const char first = rest_.front();
    const bool is_number = (first >= '0' && first <= '9') || first == '-' || first == '+';
    while (length < rest_.size() && isWordCharacter(rest_[length])) ++length;
    is_literal = is_number || (length < rest_.size() && rest_[length] == '#');
    if (is_literal) {
      // Literals may contain `-`, `+`, `.` and `:`: DT#2026-01-31-12:30:00, 1.5e-3.
      while (length < rest_.size() && (isWordCharacter(rest_[length]) || strchr("#-+.:", rest_[length]) != nullptr))
        ++length;
    } else {
      bool in_brackets = false;
      while (length < rest_.size() &&
             (in_brackets || isWordCharacter(rest_[length]) || strchr(".[^", rest_[length]) != nullptr)) {
        if (rest_[length] == '[') in_brackets = true;
        if (rest_[length] == ']') in_brackets = false;
        ++length;
      }
    }
  }
  if (length == 0) return fail("expected a variable or a value before " + backquoted(rest_));

  node = add(Kind::Literal, 0, 0);
  Node& created = nodes_[node];
  created.text = rest_.substr(0, length);
  rest_.remove_prefix(length);
  const std::string lower = lowerCase(created.text);
  const bool is_bool = lower == "true" || lower == "false";
  Variable variable;
  if (!is_literal && !is_bool && symbols_.find(created.text, variable, created.unknown)) {
    created.kind = Kind::Variable;
    created.variable = variable;
  }
  return !is_bool || giveType(node, kConditionType);
}

bool Condition::giveType(uint32_t literal, const rung_type& type) {
  Node& node = nodes_[literal];
  if (!node.unknown.empty() && type.kind != RUNG_ENUM) return fail(node.unknown);
  storage_.emplace_back(size_t{type.size} + 8);
  literal_blocks_.push_back(storage_.back().data());
  literals_.blocks = literal_blocks_.data();
  literals_.module = &symbols_.module().description;
  node.variable = Variable();
  node.variable.type = &type;
  node.variable.bit = 255;
  node.variable.index = static_cast<uint32_t>(literal_blocks_.size() - 1);
  node.variable.context = &literals_;
  const std::string problem = assignValue(symbols_.module(), node.variable, node.text);
  return problem.empty() || fail(problem);
}

bool Condition::isUntyped(uint32_t node) const {
  return nodes_[node].kind == Kind::Literal && nodes_[node].variable.type == nullptr;
}

bool Condition::isBool(uint32_t index) const {
  const Node& node = nodes_[index];
  if (node.kind != Kind::Variable && node.kind != Kind::Literal) return true;
  return node.variable.type != nullptr && node.variable.type->kind == RUNG_BOOL;
}

bool Condition::needBool(uint32_t index) {
  if (isBool(index)) return true;
  const Node& node = nodes_[index];
  if (!node.unknown.empty()) return fail(node.unknown);
  if (node.kind == Kind::Literal) return fail(backquoted(node.text) + " is not BOOL; compare it with a variable");
  return fail(backquoted(node.text) + " is " + typeName(symbols_.module(), *node.variable.type) +
              ", not BOOL; compare it with a value");
}

bool Condition::compare(Relation relation, uint32_t left, uint32_t right, uint32_t& node) {
  for (const uint32_t side : {left, right}) {
    const Node& operand = nodes_[side];
    if (operand.kind == Kind::Variable && operand.variable.type->kind >= RUNG_ARRAY)
      return fail(backquoted(operand.text) + " is of type " + typeName(symbols_.module(), *operand.variable.type) +
                  "; only elementary variables and enumerations can be compared");
  }
  if (isUntyped(left) && isUntyped(right)) {
    for (const uint32_t side : {left, right})
      if (!nodes_[side].unknown.empty()) return fail(nodes_[side].unknown);
    return fail(backquoted(nodes_[left].text) + " and " + backquoted(nodes_[right].text) +
                " are both values; one side of a comparison must be a variable");
  }
  const auto typeOf = [&](uint32_t side) -> const rung_type& {
    const bool is_operand = nodes_[side].kind == Kind::Variable || nodes_[side].kind == Kind::Literal;
    return is_operand ? *nodes_[side].variable.type : kConditionType;
  };
  if (isUntyped(left) && !giveType(left, typeOf(right))) return false;
  if (isUntyped(right) && !giveType(right, typeOf(left))) return false;
  if (!comparable(typeOf(left), typeOf(right)))
    return fail("a value of type " + typeName(symbols_.module(), typeOf(left)) +
                " cannot be compared with one of type " + typeName(symbols_.module(), typeOf(right)));
  node = add(Kind::Compare, left, right);
  nodes_[node].relation = relation;
  return true;
}

bool Condition::compared(const Node& node) const {
  int order = 0;
  bool is_ordered = true;  // NaN is not
  if (isBool(node.left)) {
    order = static_cast<int>(value(node.left)) - static_cast<int>(value(node.right));
  } else {
    const Variable& a = nodes_[node.left].variable;
    const Variable& b = nodes_[node.right].variable;
    const uint8_t* const at_a = a.address();
    const uint8_t* const at_b = b.address();
    if (at_a == nullptr || at_b == nullptr) return false;
    Integer x, y;
    double p = 0, q = 0;
    if (a.type->kind == RUNG_STRING || a.type->kind == RUNG_USTRING) {
      order = compareStrings<uint8_t>(at_a, at_b);
    } else if (a.type->kind == RUNG_WSTRING) {
      order = compareStrings<uint16_t>(at_a, at_b);
    } else if (integerOf(symbols_.module(), a, x) && integerOf(symbols_.module(), b, y)) {
      if (x.isBeyondSigned() != y.isBeyondSigned())
        order = x.isBeyondSigned() ? 1 : -1;
      else
        order = x.bits < y.bits ? -1 : x.bits > y.bits ? 1 : 0;
    } else {
      is_ordered = numberOf(symbols_.module(), a, p) && numberOf(symbols_.module(), b, q) && p == p && q == q;
      order = p < q ? -1 : p > q ? 1 : 0;
    }
  }
  switch (node.relation) {
    case Relation::Equal: return is_ordered && order == 0;
    case Relation::Unequal: return !is_ordered || order != 0;
    case Relation::Less: return is_ordered && order < 0;
    case Relation::Greater: return is_ordered && order > 0;
    case Relation::LessEqual: return is_ordered && order <= 0;
    case Relation::GreaterEqual: return is_ordered && order >= 0;
  }
  return false;
}

bool Condition::value(uint32_t index) const {
  const Node& node = nodes_[index];
  switch (node.kind) {
    case Kind::Variable:
    case Kind::Literal: return readBool(node.variable);
    case Kind::Not: return !value(node.left);
    case Kind::And: return value(node.left) && value(node.right);
    case Kind::Xor: return value(node.left) != value(node.right);
    case Kind::Or: return value(node.left) || value(node.right);
    case Kind::Compare: return compared(node);
  }
  return false;
}

}  // namespace rung::host

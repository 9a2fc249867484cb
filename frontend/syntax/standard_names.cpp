// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/standard_names.h"

#include <algorithm>
#include <iterator>

#include "frontend/source/names.h"
#include "frontend/syntax/tree.h"

namespace rung {
namespace {

constexpr OperatorFunction kFunctions[] = {
    {"ADD", BinaryOp::Add, true},       {"AND", BinaryOp::And, true},          {"DIV", BinaryOp::Divide, false},
    {"EQ", BinaryOp::Equal, false},     {"GE", BinaryOp::GreaterEqual, false}, {"GT", BinaryOp::Greater, false},
    {"LE", BinaryOp::LessEqual, false}, {"LT", BinaryOp::Less, false},         {"MOD", BinaryOp::Modulo, false},
    {"MUL", BinaryOp::Multiply, true},  {"NE", BinaryOp::NotEqual, false},     {"OR", BinaryOp::Or, true},
    {"SUB", BinaryOp::Subtract, false}, {"XOR", BinaryOp::Xor, true}};

}  // namespace

bool isEnable(std::string_view pin) { return sameIdentifier(pin, kEnable); }
bool isEnableOutput(std::string_view pin) { return sameIdentifier(pin, kEnableOutput); }

const OperatorFunction* operatorFunction(std::string_view name) {
  if (name.size() < 2 || name.size() > 3) return nullptr;
  const char first = static_cast<char>(name[0] & ~0x20);  // the parser asks for many names that are none of them
  const auto* found = std::find_if(std::begin(kFunctions), std::end(kFunctions), [&](const OperatorFunction& row) {
    return row.name[0] == first && sameIdentifier(row.name, name);
  });
  return found == std::end(kFunctions) ? nullptr : found;
}

std::string_view edgeDetector(EdgeKind edge) { return edge == EdgeKind::Rising ? "R_TRIG" : "F_TRIG"; }

}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// Names that the standard gives a meaning wherever they occur: the functions of operators, the pins EN and ENO, and the
// blocks that detect edges. Used by IL, diagrams and sema.
#pragma once

#include <string_view>

#include "frontend/syntax/pin.h"

namespace rung {

enum class BinaryOp : uint8_t;

constexpr std::string_view kEnable = "EN", kEnableOutput = "ENO";

bool isEnable(std::string_view pin);
bool isEnableOutput(std::string_view pin);
inline bool isControl(std::string_view pin) { return isEnable(pin) || isEnableOutput(pin); }

// ADD is `+`. IEC 61131-3 ed. 3, tables 29, 30 and 33; IL has the same names, table 68.
struct OperatorFunction {
  std::string_view name;
  BinaryOp op;
  bool extensible;  // takes more than two operands
};
// Null: not the name of an operator with two operands.
const OperatorFunction* operatorFunction(std::string_view name);

constexpr std::string_view kNot = "NOT", kMove = "MOVE";

// R_TRIG or F_TRIG.
std::string_view edgeDetector(EdgeKind edge);

}  // namespace rung

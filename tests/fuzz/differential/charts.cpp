// SPDX-License-Identifier: Apache-2.0
// Charts of generated programs: a block whose body is a sequential function chart of steps in sequence, alternative and
// parallel branches, with actions of all qualifiers. Conditions and actions are generated expressions and statements.
#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

namespace {

constexpr int kLamps = 3, kActions = 4;  // BOOL variables and actions of the block

}  // namespace

// A step with its actions; returns its name.
std::string Generator::makeStep(Chart& chart) {
  const int number = chart.steps++;
  const std::string name = "Step" + std::to_string(number);
  std::string text = (number == 0 ? "INITIAL_STEP " : "STEP ") + name + ":\n";
  for (int n = below(4); n > 0; --n) {
    const std::string qualifier = pick({"N", "N", "S", "R", "P", "P1", "P0", "L", "D", "SD", "DS", "SL"});
    const bool timed =
        qualifier == "L" || qualifier == "D" || qualifier == "SD" || qualifier == "DS" || qualifier == "SL";
    text += (chance(40) ? "lamp" + std::to_string(below(kLamps)) : "Act" + std::to_string(below(kActions))) + "(" +
            qualifier + (timed ? ", T#" + std::to_string(10 * below(4)) + "ms" : "") + ");\n";
  }
  if (codesys()) {
    for (const char* when : {"{entry} ", "{active} ", "{exit} "}) {
      if (chance(12)) text += when + ("Act" + std::to_string(below(kActions))) + ";\n";
    }
  }
  chart.parts.push_back(Fixed{text + "END_STEP\n"});
  return name;
}

void Generator::connectSteps(Chart& chart, const std::string& from, const std::string& to) {
  const std::string priority = chance(15) ? "(PRIORITY := " + std::to_string(++chart.priority) + ") " : "";
  Node condition = expr(kBool, 2);
  condition.simple = "TRUE";
  const std::string time = from[0] != '(' && chance(15) ? " OR " + from + ".T >= T#20ms" : "";
  chart.parts.push_back(
      Fixed{"TRANSITION " + priority + "FROM " + from + " TO " + to + " := \1" + time + "; END_TRANSITION\n",
            {std::move(condition)}});
}

// Continues after the step `last`, returns the last step.
std::string Generator::makeSequence(Chart& chart, std::string last, int depth) {
  for (int n = 1 + below(2); n > 0; --n) {
    const int kind = depth > 0 ? below(3) : 0;
    if (kind == 0) {
      const std::string next = makeStep(chart);
      connectSteps(chart, last, next);
      last = next;
      continue;
    }
    const std::string first = makeStep(chart), second = makeStep(chart);
    if (kind == 1) {
      connectSteps(chart, last, first);
      connectSteps(chart, last, second);
    } else {
      connectSteps(chart, last, "(" + first + ", " + second + ")");
    }
    const std::string left = makeSequence(chart, first, depth - 1),
                      right = chance(50) ? second : makeSequence(chart, second, depth - 1);
    last = makeStep(chart);
    if (kind == 1) {
      connectSteps(chart, left, last);
      connectSteps(chart, right, last);
    } else {
      connectSteps(chart, "(" + left + ", " + right + ")", last);
    }
  }
  return last;
}

// In codesys the program reads its steps, too: chart.Step0.X.
Node Generator::makeChart() {
  own_inputs_.clear();
  for (int n = 1 + below(3); n > 0; --n) own_inputs_.push_back(anyType());
  chart_inputs_ = own_inputs_;
  body_ = Body::Block;
  std::string head = "FUNCTION_BLOCK " + prefix_ + "_Chart\nVAR_INPUT ";
  for (size_t i = 0; i < own_inputs_.size(); ++i)
    head += "in" + std::to_string(i) + " : " + kTypes[own_inputs_[i]].name + "; ";
  head += "END_VAR\nVAR_OUTPUT out0 : DINT;";
  for (int i = 0; i < kLamps; ++i) head += " lamp" + std::to_string(i) + " : BOOL;";
  head += " END_VAR\n";
  if (codesys() && chance(30)) head = "{attribute 'no_final_scan'}\n" + head;
  Chart chart;
  const std::string first = makeStep(chart), last = makeSequence(chart, first, 2);
  connectSteps(chart, last, first);
  for (int i = 0; i < kActions; ++i) {
    Node body = statements(1, 1 + below(3));
    chart.parts.push_back(Stmt{"ACTION Act" + std::to_string(i) + ":\n\1out0 := out0 * 3 + \1;\nEND_ACTION\n",
                               {std::move(body), expr(kDint, 1)}});
    chart.parts.back().fixed = true;
  }
  Node body = Fixed{std::string(chart.parts.size(), kChild), std::move(chart.parts)};
  Node vars = declarations({&body});
  return Stmt{head + "\1\1END_FUNCTION_BLOCK\n\n", {std::move(vars), std::move(body)}};
}

Node Generator::chartStatement() {
  if (chance(25))
    return Stmt{"IF " +
                    pick({codesys() ? "chart.Step0.X" : "chart.lamp1", "chart.lamp0", "chart.lamp2",
                          codesys() ? "chart.Step1.X" : "chart.lamp1"}) +
                    " THEN\n\1END_IF\n",
                {statements(1, 1)}};
  const std::string n = chance(30) ? "chart2" : "chart";
  std::string text = n + "(";
  std::vector<Node> arguments;
  for (size_t i = 0; i < chart_inputs_.size(); ++i) {
    if (chance(30)) continue;
    text += (arguments.empty() ? "in" : ", in") + std::to_string(i) + " := \1";
    arguments.push_back(expr(chart_inputs_[i], 2));
  }
  return Stmt{text + ");\nv_dint := " + n + ".out0;\n", std::move(arguments)};
}

}  // namespace rung::differential

// SPDX-License-Identifier: Apache-2.0
// Statements of generated programs.
#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

Node Generator::assignment() {
  const int type = anyType();
  if (body_ == Body::Program && chance(12)) {
    Node index = subscript(-1, 4, 1);
    return Stmt{"table[\1].count := \1;\n", {std::move(index), expr(kDint, 2)}};
  }
  if (body_ == Body::Program && chance(6)) {
    return Stmt{"grid[\1, \1] := \1;\n", {subscript(1, 2, 1), subscript(0, 2, 1), expr(kInt, 2)}};
  }
  if (body_ == Body::Program && chance(4)) return Stmt{pick({"pair := table[2];\n", "table[0] := pair;\n"})};
  if (body_ == Body::Program && chance(4)) {
    // The standard refuses a constant outside of the subrange.
    return Stmt{chance(50)  ? "colour := " + prefix_ + "_Colour#" + pick({"Red", "Green", "Blue"}) + ";\n"
                : codesys() ? "small := \1;\n"
                            : "small := MIN(v_usint, \1);\n",
                {expr(kUsint, 2)}};
  }
  if (codesys() && chance(3)) {
    const std::string first = writable(type), second = writable(type);
    if ((first + second).find('(') == std::string::npos) {  // a chain allows no call
      return Stmt{first + " := " + second + " := \1;\n", {expr(type, 2)}};
    }
  }
  if (codesys() && chance(4)) {
    const int number = 1 + below(14);
    if (number < kReal + 2 && chance(25)) {
      return Stmt{writable(number) + " /= \1;\n",
                  {kTypes[number].kind == Kind::Real ? variable(number) : divisor(number, 1)}};
    }
    return Stmt{writable(number) + " " + pick({"+=", "-=", "*="}) + " \1;\n", {expr(number, 2)}};
  }
  if (chance(4)) {
    const int size = chance(40) ? kBool : kByte + below(3);
    if (const std::string target = part(size); !target.empty()) return Stmt{target + " := \1;\n", {expr(size, 2)}};
  }
  if (chance(3)) return Stmt{"v_lint := \1;\n", {expr(kDint, 3)}};  // widened
  if (body_ == Body::Program && chance(4)) {
    return Stmt{"colour := SEL(\1, other_colour, " + prefix_ + "_Colour#Blue);\n", {expr(kBool, 2)}};
  }
  if ((body_ == Body::Function || inObject()) && chance(25)) return Stmt{own_ + " := \1;\n", {expr(own_result_, 3)}};
  return Stmt{writable(type) + " := \1;\n", {expr(type, 3)}};
}

Node Generator::loop(int depth) {
  const std::string n = std::to_string(loops_);
  ++loops_;
  Node result;
  switch (below(4)) {
    case 3: {
      const bool narrow = chance(50);
      result = Stmt{narrow ? "FOR v_usint2 := " + std::to_string(250 + below(6)) + " TO 255 DO\n\1END_FOR\n"
                           : "FOR v_sint2 := -" + std::to_string(120 + below(9)) + " TO -128 BY -" +
                                 std::to_string(1 + below(4)) + " DO\n\1END_FOR\n",
                    {Stmt{"v_lint := v_lint + \1;\n", {Expr{kDint, narrow ? "v_usint2" : "v_sint2"}}}}};
      break;
    }
    case 0: {
      const int type = below(3);
      const std::string control = "i" + n, first = std::to_string(below(5) - (type == 0 ? 2 : 0));
      const bool down = chance(25) && type == 0;
      std::string bounds = down ? "4 TO " + first + " BY -" + std::to_string(1 + below(2)) : first + " TO \1";
      if (!down && chance(30)) bounds += " BY " + std::to_string(1 + below(3));
      std::vector<Node> parts;
      if (!down) {
        Node limit = Expr{kInt, "MIN(\1, 5)", {expr(kInt, 1)}};
        limit.type = -1;
        parts.push_back(std::move(limit));
      }
      parts.push_back(statements(depth, 1 + below(3)));
      result = Stmt{"FOR " + control + " := " + bounds + " DO\n\1END_FOR\n", std::move(parts)};
      break;
    }
    case 1:
      result = Stmt{"n" + n + " := 0;\nWHILE n" + n + " < " + std::to_string(1 + below(5)) + " AND \1 DO\nn" + n +
                        " := n" + n + " + 1;\n\1END_WHILE\n",
                    {expr(kBool, 2), statements(depth, 1 + below(3))}};
      break;
    default:
      result = Stmt{"n" + n + " := 0;\nREPEAT\nn" + n + " := n" + n + " + 1;\n\1UNTIL n" + n +
                        " >= " + std::to_string(1 + below(4)) + " OR \1 END_REPEAT\n",
                    {statements(depth, 1 + below(3)), expr(kBool, 2)}};
  }
  --loops_;
  return result;
}

Node Generator::choice(int depth) {
  if (chance(60)) {
    std::string text = "IF \1 THEN\n\1";
    std::vector<Node> parts{expr(kBool, 3), statements(depth, 1 + below(3))};
    if (chance(40)) {
      text += "ELSIF \1 THEN\n\1";
      parts.push_back(expr(kBool, 2));
      parts.push_back(statements(depth, 1 + below(2)));
    }
    if (chance(50)) {
      text += "ELSE\n\1";
      parts.push_back(statements(depth, 1 + below(2)));
    }
    return Stmt{text + "END_IF\n", std::move(parts)};
  }
  const int type = anyInteger();
  ++cases_;
  std::string text = "CASE \1 OF\n";
  std::vector<Node> parts{expr(type, 2)};
  int label = 0;
  for (int n = 1 + below(4); n > 0; --n) {
    text += std::to_string(label);
    if (chance(30)) text += ", " + std::to_string(label + 1);
    if (chance(30)) text += ", " + std::to_string(label + 2) + ".." + std::to_string(label + 5);
    label += 6 + below(4);
    text += ":\n\1";
    parts.push_back(statements(depth, 1 + below(2)));
  }
  if (chance(60)) {
    text += "ELSE\n\1";
    parts.push_back(statements(depth, 1));
  }
  --cases_;
  return Stmt{text + "END_CASE\n", std::move(parts)};
}

Node Generator::blockCall() {
  switch (below(11)) {
    case 9:
    case 10: {
      const std::string en = chance(30) ? "EN := v_bool, ENO => v_bool2, " : "";
      const std::string io = pick({"pair", "table[0]", "table[3]"});
      return Stmt{pick({"short", "v_string", "pair.title"}) + " := " + prefix_ + "_Access(" + en + "io := " + io +
                      ", given := table[\1], row := row, title := \1, done => v_bool);\n",
                  {subscript(-1, 4, 1), expr(kString, 2)}};
    }
    case 0: return Stmt{pick({"ton", "tof", "tp"}) + "(IN := \1, PT := \1);\n", {expr(kBool, 2), expr(kTime, 1)}};
    case 1:
      return Stmt{codesys() ? "ctu(CU := \1, RESET := \1, PV := 3, CV => v_word);\n"
                            : "ctu(CU := \1, R := \1, PV := 3, CV => v_int);\n",
                  {expr(kBool, 2), expr(kBool, 1)}};
    case 2: return Stmt{pick({"rise", "fall"}) + "(CLK := \1, Q => v_bool2);\n", {expr(kBool, 2)}};
    case 3: return Stmt{"latch(SET1 := \1, RESET := \1);\n", {expr(kBool, 2), expr(kBool, 1)}};
    default: {
      const int n = below(static_cast<int>(blocks_.size()));
      std::string text = "block" + std::to_string(n) + (chance(25) ? "b(" : "(");
      std::vector<Node> arguments;
      for (size_t i = 0; i < blocks_[n].size(); ++i) {
        if (chance(20)) continue;
        text += "in" + std::to_string(i) + " := \1, ";
        arguments.push_back(expr(blocks_[n][i], 2));
      }
      if (chance(20)) {
        text += "EN := \1, ";
        arguments.push_back(expr(kBool, 1));
      }
      if (chance(20)) text += "ENO => v_bool, ";
      if (chance(50)) text += "out0 => v_dint2, ";
      return Stmt{text + "io := " + pick({"v_dint", "v_dint2", "pair.count", "table[1].count"}) + ");\n",
                  std::move(arguments)};
    }
  }
}

// Forward over statements, or back while a counter allows it.
Node Generator::jump(int depth) {
  const std::string n = std::to_string(labels_++), label = "l" + n;
  if (chance(60)) {
    return Stmt{"IF \1 THEN JMP " + label + "; END_IF\n\1" + label + ":;\n",
                {expr(kBool, 2), statements(depth, 1 + below(3))}};
  }
  const std::string count = "k" + n;
  return Stmt{count + " := 0;\n" + label + ":\n" + count + " := " + count + " + 1;\n\1IF " + count + " < " +
                  std::to_string(2 + below(3)) + " AND \1 THEN JMP " + label + "; END_IF\n",
              {statements(depth, 1 + below(3)), expr(kBool, 2)}};
}

// An operator or function by its call, with EN and ENO: a fault then clears ENO.
Node Generator::guardedCall() {
  const int type = anyInteger();
  const std::string target = "v_" + lowered(kTypes[type].name);
  const std::string en = chance(40) ? "EN := \1, " : "";
  std::vector<Node> arguments;
  if (!en.empty()) arguments.push_back(expr(kBool, 2));
  arguments.push_back(expr(type, 2));
  arguments.push_back(variable(type));
  return Stmt{target + " := " + pick({"DIV", "MOD", "DIV"}) + "(" + en + "IN1 := \1, IN2 := \1, ENO => v_bool);\n",
              std::move(arguments)};
}

// Variables written before the fault keep their values.
Node Generator::attempt(int depth) {
  ++cases_;
  const int type = anyInteger();
  std::vector<Node> parts{statements(depth, 1 + below(3)), expr(type, 1), variable(type), statements(depth, 1)};
  std::string text = "__TRY\n\1" + writable(type) + " := \1 / \1;\n__CATCH\n\1";
  if (chance(40)) {
    text += "__FINALLY\n\1";
    parts.push_back(statements(depth, 1));
  }
  --cases_;
  return Stmt{text + "__ENDTRY\n", std::move(parts)};
}

// A series of coils in two bytes, and now and then something else that may reach them.
Node Generator::rungs() {
  std::vector<Node> parts;
  const int count = 2 + below(6);
  for (int i = 0; i < count; ++i) {
    switch (below(8)) {
      case 0: parts.push_back(assignment()); break;
      case 1:
      case 2:
        parts.push_back(Stmt{"IF \1 THEN " + coil() + " := " + pick({"TRUE", "FALSE"}) + "; END_IF\n", {contacts(2)}});
        break;
      default: parts.push_back(Stmt{coil() + " := \1;\n", {contacts(3)}});
    }
  }
  return Stmt{std::string(parts.size(), kChild), std::move(parts)};
}

Node Generator::contacts(int depth) {
  if (depth > 0 && chance(70))
    return Expr{kBool, "(\1 " + pick({"AND", "OR"}) + " \1)", {contacts(depth - 1), contacts(depth - 1)}};
  if (depth > 0 && chance(30)) return Expr{kBool, "NOT \1", {contacts(depth - 1)}};
  if (chance(80)) return Expr{kBool, coil()};
  return chance(50) ? Expr{kBool, "(\1 > \1)", {leaf(kInt), leaf(kInt)}} : leaf(kBool);
}

Node Generator::statement(int depth) {
  if (loops_ > 0 && chance(7)) {
    return Stmt{"IF \1 THEN " + pick({"EXIT", dialect_ == Dialect::Iec2 ? "EXIT" : "CONTINUE"}) + "; END_IF\n",
                {expr(kBool, 2)}};
  }
  if (body_ != Body::Program && chance(4)) return Stmt{"IF \1 THEN RETURN; END_IF\n", {expr(kBool, 2)}};
  if (depth > 0 && loops_ < 2 && chance(12)) return loop(depth - 1);
  if (depth > 0 && chance(15)) return choice(depth - 1);
  if (codesys() && depth > 0 && chance(4)) return attempt(depth - 1);
  if (codesys() && loops_ == 0 && cases_ == 0 && depth > 0 && chance(8)) return jump(depth - 1);
  if (body_ == Body::Program && codesys() && loops_ < 2 && chance(35)) return objectStatement();
  if (body_ == Body::Program && codesys() && chance(30)) return pointerStatement();
  if (body_ == Body::Program && dialect_ == Dialect::Iec3 && loops_ < 2 && chance(30)) return classStatement();
  if (body_ == Body::Program && loops_ < 2 && chance(25)) return recordStatement();
  if (body_ == Body::Program && loops_ == 0 && chance(8)) return chartStatement();
  if (body_ == Body::Program && chance(18)) return blockCall();
  if (chance(7)) return guardedCall();
  if (chance(12)) return rungs();
  return assignment();
}

Node Generator::statements(int depth, int count) {
  std::vector<Node> parts;
  std::string text;
  for (int i = 0; i < count; ++i) {
    parts.push_back(statement(depth));
    text += kChild;
  }
  return Stmt{text, std::move(parts)};
}
}  // namespace rung::differential

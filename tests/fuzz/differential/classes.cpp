// SPDX-License-Identifier: Apache-2.0
// Objects of edition 3: a chain of classes with overridden and overloaded methods, an interface, REF_TO, assignment
// attempts (?=), overloaded functions, characters of strings, structures whose members overlap.
#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

namespace {

constexpr int kLine = 3;  // classes, each extending the previous one

}  // namespace

void Generator::makeClasses(std::vector<Node>& parts) {
  if (dialect_ != Dialect::Iec3) return;
  const auto number = [&] { return "DINT#" + std::to_string(below(199) - 99); };
  const std::string c = prefix_ + "_C";
  parts.push_back(Fixed{"INTERFACE " + prefix_ +
                        "_J\nMETHOD Twist : DINT\nVAR_INPUT x : DINT; END_VAR\nEND_METHOD\nMETHOD Twist : DINT\n"
                        "VAR_INPUT x : STRING; END_VAR\nEND_METHOD\nEND_INTERFACE\n"});
  for (int i = 0; i < kLine; ++i) {
    const bool base = i == 0;
    const std::string replaced = base ? "METHOD PUBLIC " : "METHOD PUBLIC OVERRIDE ";
    std::string text = "CLASS " + c + std::to_string(i) +
                       (base ? " IMPLEMENTS " + prefix_ + "_J" : " EXTENDS " + c + std::to_string(i - 1)) + "\n";
    text += "VAR PROTECTED own" + std::to_string(i) + " : DINT := " + number() + "; END_VAR\n";
    const std::string own = "own" + std::to_string(i);
    if (base || chance(70)) {
      text += replaced + "Twist : DINT\nVAR_INPUT x : DINT; END_VAR\n" + own + " := " + own + " * " + number() +
              " + x;\nTwist := " + own + " - " + number() + (base ? "" : " + SUPER.Twist(x)") + ";\nEND_METHOD\n";
    }
    if (base || chance(60)) {
      text += replaced + "Twist : DINT\nVAR_INPUT x : STRING; END_VAR\nTwist := THIS.Twist(INT_TO_DINT(LEN(x))) * " +
              number() + ";\nIF LEN(x) > 1 AND_THEN x[2] > '5' THEN Twist := Twist + 1; END_IF\nEND_METHOD\n";
    }
    if (base || chance(50)) {
      text += replaced + "Change : DINT\nVAR_IN_OUT io : DINT; END_VAR\nVAR_OUTPUT seen : DINT; END_VAR\nio := io + " +
              own + ";\nseen := io / 3;\nChange := THIS.Twist(io) - seen;\nEND_METHOD\n";
    }
    parts.push_back(Stmt{text + "END_CLASS\n\n"});
  }
  const std::string fold = "FUNCTION " + prefix_ + "_Fold : ";
  parts.push_back(
      Stmt{fold + "DINT\nVAR_INPUT x : DINT; END_VAR\n" + prefix_ + "_Fold := x * 7 - 1;\nEND_FUNCTION\n" + fold +
           "REAL\nVAR_INPUT x : REAL; END_VAR\n" + prefix_ + "_Fold := x * 0.5 + 1.0;\nEND_FUNCTION\n" + fold +
           "DINT\nVAR_INPUT s : STRING; END_VAR\nVAR i : INT; END_VAR\nFOR i := 1 TO LEN(s) DO\nIF s[i] > '4' "
           "THEN " +
           prefix_ + "_Fold := " + prefix_ + "_Fold * 3 + INT_TO_DINT(i); END_IF\nEND_FOR\nEND_FUNCTION\n" + fold +
           "DINT\nVAR_INPUT x, y : DINT; END_VAR\n" + prefix_ + "_Fold := " + prefix_ + "_Fold(x) - " + prefix_ +
           "_Fold(x := y);\nEND_FUNCTION\n\n"});
  parts.push_back(Stmt{"FUNCTION " + prefix_ + "_Meet : DINT\nVAR_INPUT i : " + prefix_ +
                       "_J; END_VAR\nVAR r : REF_TO " + c + "1; END_VAR\nr ?= i;\n" + prefix_ +
                       "_Meet := i.Twist(DINT#5);\nIF r <> NULL THEN " + prefix_ + "_Meet := " + prefix_ +
                       "_Meet + r^.Twist('ab9'); END_IF\nEND_FUNCTION\n\n"});
  parts.push_back(Stmt{"TYPE " + prefix_ +
                       "_Over : STRUCT OVERLAP whole AT %D0 : DWORD := 16#12345678; low AT %W0 : WORD; high AT %W1 : "
                       "WORD; parts AT %B0 : ARRAY[0..3] OF BYTE; sign AT %X3.7 : BOOL; number AT %D0 : DINT; "
                       "END_STRUCT; END_TYPE\n"});
}

Node Generator::classStatement() {
  const std::string object = pick({"k0", "k1", "k2", "ks[1]"});
  const auto result = [&] { return writable(kDint) + " := "; };
  switch (below(14)) {
    case 0: return Stmt{result() + object + ".Twist(\1);\n", {expr(kDint, 2)}};
    case 1: return Stmt{result() + object + ".Twist(x := \1);\n", {expr(kString, 1)}};
    case 2: return Stmt{result() + object + ".Change(io := tally, seen => seen0);\n"};
    case 3: return Stmt{"itf := " + object + ";\n"};
    case 4: return Stmt{"IF itf <> NULL THEN " + result() + "itf.Twist(\1); END_IF\n", {expr(kDint, 2)}};
    case 5: return Stmt{"way := REF(" + pick({"k0", "k1", "k2"}) + ");\n"};
    case 6: return Stmt{"IF way <> NULL THEN " + result() + "way^.Twist(\1); END_IF\n", {expr(kString, 1)}};
    case 7:
      return Stmt{"down ?= way;\nIF down <> NULL THEN " + result() + "down^.Twist(\1); END_IF\n", {expr(kDint, 1)}};
    case 8: return Stmt{result() + prefix_ + "_Fold(\1);\n", {expr(kDint, 2)}};
    case 9: return Stmt{writable(kReal) + " := " + prefix_ + "_Fold(\1);\n", {expr(kReal, 1)}};
    case 10: return Stmt{result() + prefix_ + "_Fold(\1);\n", {expr(kString, 1)}};
    case 11:
      return Stmt{result() + prefix_ + "_Fold(x := \1, y := \1) + " + prefix_ + "_Meet(" + object + ");\n",
                  {expr(kDint, 1), expr(kDint, 1)}};
    case 12:
      return Stmt{"over." + pick({"low", "high"}) + " := \1;\nover.sign := \1;\n", {expr(kWord, 1), expr(kBool, 1)}};
    default:
      return Stmt{"over.parts[" + std::to_string(below(4)) + "] := \1;\n" + result() + "over.number;\n" +
                      writable(kDword) + " := over.whole;\n",
                  {expr(kByte, 1)}};
  }
}

std::vector<Lvalue> Generator::classLvalues() const {
  const std::string c = prefix_ + "_C";
  return {{"k0", c + "0", ""},
          {"k1", c + "1", ""},
          {"k2", c + "2", ""},
          {"ks", "ARRAY[0..2] OF " + c + "1", ""},
          {"itf", prefix_ + "_J", "itf := k1;\n"},
          {"way", "REF_TO " + c + "0", "way := REF(k2);\n"},
          {"down", "REF_TO " + c + "1", ""},
          {"tally", "DINT := 5", ""},
          {"seen0", "DINT", ""},
          {"over", prefix_ + "_Over", ""}};
}

}  // namespace rung::differential

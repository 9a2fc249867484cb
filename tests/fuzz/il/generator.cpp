// SPDX-License-Identifier: Apache-2.0
// Function blocks as ST and IL from one tree of expressions and statements: see generator.h.
#include "tests/fuzz/il/generator.h"

#include <initializer_list>

#include "tests/fuzz/generated/options.h"

namespace rung::il_differential {
namespace {

enum Type : uint8_t { kBool, kDint, kInt, kReal, kTypes };

// An expression as ST, and as the instructions that leave its value in the accumulator.
struct Expr {
  std::string st, il;
  bool leaf = false;     // `il` is one LD of `st`
  bool literal = false;  // untyped
};

class Generator {
 public:
  Generator(uint64_t seed, unsigned index) : state_(seed * 2 + 1), name_("B" + std::to_string(index)) {}
  Twins block();

 private:
  uint64_t random() { return generated::nextRandom(state_); }
  unsigned below(unsigned n) { return static_cast<unsigned>(random() % n); }
  bool chance(unsigned percent) { return below(100) < percent; }
  std::string pick(std::initializer_list<const char*> words) {
    return words.begin()[below(static_cast<unsigned>(words.size()))];
  }

  std::string variable(Type type);
  std::string target(Type type);
  Expr leaf(Type type, bool literals);
  Expr expr(Type type, int depth);
  Expr binary(const Expr& left, const std::string& st_op, const std::string& il_op, const Expr& right, bool negated);
  Expr call(const std::string& name, const std::vector<Expr>& operands);
  std::string label() { return "L" + std::to_string(labels_++); }

  void add(const std::string& st, const std::string& il) {
    out_.st += st;
    out_.il += il;
  }
  void statements(int depth, unsigned count);
  void statement(int depth);
  void assignment();
  void branch(int depth);
  void loop(int depth);
  void blockCall();
  void joinedValue();

  uint64_t state_;
  std::string name_;
  unsigned labels_ = 0;
  unsigned loops_ = 0;
  Twins out_;
};

std::string Generator::variable(Type type) {
  switch (type) {
    case kBool:
      return pick(
          {"a", "b", "c", "d", "p", "q", "r", "mem.flag", "bits[1]", "bits[pos]", "w.3", "t1.Q", "e1.Q", "l1.Q1"});
    case kDint: return pick({"i", "j", "m", "n", "mem.count", "list[2]", "list[1]"});
    case kInt: return pick({"k", "s", "u", "mem.small"});
    case kReal: return pick({"x", "y", "z", "mem.level"});
    case kTypes: break;
  }
  return {};
}

std::string Generator::target(Type type) {
  switch (type) {
    case kBool: return pick({"p", "q", "r", "mem.flag", "bits[1]", "bits[2]", "w.3"});
    case kDint: return pick({"m", "n", "mem.count", "list[2]", "list[1]"});
    case kInt: return pick({"s", "u", "mem.small"});
    case kReal: return pick({"y", "z", "mem.level"});
    case kTypes: break;
  }
  return {};
}

Expr Generator::leaf(Type type, bool literals) {
  Expr e;
  if (literals && chance(25)) {
    e.literal = type != kBool;
    e.st = type == kBool   ? pick({"TRUE", "FALSE"})
           : type == kReal ? pick({"0.5", "2.0", "-1.25", "100.0"})
                           : pick({"1", "2", "7", "-3", "100", "16#1F"});
  } else {
    e.st = variable(type);
  }
  e.leaf = true;
  e.il = "LD " + e.st + "\n";
  return e;
}

// The right operand is in the instruction, in deferred parentheses, or in parentheses with a LD inside.
Expr Generator::binary(const Expr& left, const std::string& st_op, const std::string& il_op, const Expr& right,
                       bool negated) {
  Expr e;
  e.st = "(" + left.st + " " + st_op + " " + (negated ? "(NOT " + right.st + ")" : right.st) + ")";
  const std::string op = il_op + (negated ? "N" : "");
  e.il = left.il;
  if (right.leaf && chance(80)) {
    e.il += op + " " + right.st + "\n";
  } else if (chance(50)) {
    e.il += op + "(\n" + right.il + ")\n";
  } else {  // the first LD joins the parenthesis
    const size_t end = right.il.find('\n');
    const bool load = right.il.compare(0, 3, "LD ") == 0;
    e.il += load ? op + "( " + right.il.substr(3, end - 3) + "\n" + right.il.substr(end + 1) + ")\n"
                 : op + "(\n" + right.il + ")\n";
  }
  return e;
}

// Operands after the name must be leaves; else the function is called with names, which IL allows for lists too.
Expr Generator::call(const std::string& name, const std::vector<Expr>& operands) {
  Expr e;
  e.st = name + "(";
  e.il = operands[0].il + name;
  for (size_t k = 0; k < operands.size(); ++k) {
    e.st += (k > 0 ? ", " : "") + operands[k].st;
    if (k > 0) e.il += (k > 1 ? ", " : " ") + operands[k].st;
  }
  e.st += ")";
  e.il += "\n";
  return e;
}

Expr Generator::expr(Type type, int depth) {
  if (depth <= 0 || chance(20)) return leaf(type, true);
  if (type == kBool) {
    switch (below(6)) {
      case 0: {
        const Type of = static_cast<Type>(kDint + below(3));
        const Expr left = expr(of, depth - 1), right = expr(of, depth - 1);
        static const char* const kOps[][2] = {{">", "GT"},  {">=", "GE"}, {"<", "LT"},
                                              {"<=", "LE"}, {"=", "EQ"},  {"<>", "NE"}};
        const auto& op = kOps[below(of == kReal ? 4 : 6)];
        if (left.literal && right.literal) return leaf(type, true);
        return binary(left, op[0], op[1], right, false);
      }
      case 1: {
        Expr e = expr(kBool, depth - 1);
        return {"(NOT " + e.st + ")", e.il + "NOT\n"};
      }
      case 2: {
        const Expr l = leaf(kBool, false);
        return {"(NOT " + l.st + ")", "LDN " + l.st + "\n"};
      }
      default: {
        static const char* const kOps[] = {"AND", "OR", "XOR"};
        const char* op = kOps[below(3)];
        const bool negated = chance(30);
        const Expr left = expr(kBool, depth - 1);
        return binary(left, op, op, expr(kBool, depth - 1), negated);
      }
    }
  }
  const Expr left = expr(type, depth - 1);
  // Literals among themselves are computed exactly, and the result need not fit the type.
  Expr right = expr(type, depth - 1);
  if (left.literal && right.literal) right = leaf(type, false);
  switch (below(type == kReal ? 5 : 8)) {
    case 0: return binary(left, "+", "ADD", right, false);
    case 1: return binary(left, "-", "SUB", right, false);
    case 2: return binary(left, "*", "MUL", right, false);
    case 3: {  // three operands
      const Expr second = leaf(type, true), third = leaf(type, true);
      if (left.literal && second.literal && third.literal) return left;
      return call(pick({"MAX", "MIN"}), {left, second, third});
    }
    case 4: {
      if (type == kReal) return call("INT_TO_REAL", {expr(kInt, depth - 1)});
      if (type == kDint) return call("INT_TO_DINT", {expr(kInt, depth - 1)});
      return call("DINT_TO_INT", {expr(kDint, depth - 1)});
    }
    case 5: {
      if (left.literal) return left;
      Expr by{pick({"3", "7", "-5"}), {}, true, true};
      by.il = "LD " + by.st + "\n";
      return binary(left, "/", "DIV", by, false);
    }
    case 6: {
      if (left.literal) return left;
      Expr by{pick({"3", "7", "10"}), {}, true, true};
      by.il = "LD " + by.st + "\n";
      return binary(left, "MOD", "MOD", by, false);
    }
    default: {
      const Expr condition = expr(kBool, depth - 1), one = leaf(type, false), two = leaf(type, false);
      return call("SEL", {condition, one, two});
    }
  }
}

void Generator::assignment() {
  const Type type = static_cast<Type>(below(kTypes));
  const Expr value = expr(type, 3);
  const std::string to = target(type);
  if (type == kBool && chance(30)) {
    const bool set = chance(50);
    add("IF " + value.st + " THEN " + to + " := " + (set ? "TRUE" : "FALSE") + "; END_IF\n",
        value.il + (set ? "S " : "R ") + to + "\n");
  } else if (type == kBool && chance(20)) {
    add(to + " := NOT " + value.st + ";\n", value.il + "STN " + to + "\n");
  } else if (chance(25)) {  // stored, and used again
    const std::string keep = type == kBool ? "keep_b" : type == kDint ? "keep_d" : type == kInt ? "keep_i" : "keep_r";
    const std::string second = target(type);
    const Expr more = leaf(type, false);
    const std::string st_op = type == kBool ? "XOR" : "+", il_op = type == kBool ? "XOR" : "ADD";
    add(keep + " := " + value.st + ";\n" + to + " := " + keep + ";\n" + second + " := " + keep + " " + st_op + " " +
            more.st + ";\n",
        value.il + "ST " + keep + "\nST " + to + "\n" + il_op + " " + more.st + "\nST " + second + "\n");
  } else {
    add(to + " := " + value.st + ";\n", value.il + "ST " + to + "\n");
  }
}

void Generator::branch(int depth) {
  const Expr condition = expr(kBool, 2);
  const std::string otherwise = label(), end = label();
  const bool has_else = chance(60), not_first = chance(40);
  add("IF " + condition.st + " THEN\n",
      condition.il + (not_first ? "NOT\nJMPC " : pick({"JMPCN ", "JMPN "})) + otherwise + "\n");
  statements(depth - 1, 1 + below(3));
  if (has_else) {
    add("ELSE\n", "JMP " + end + "\n" + otherwise + ":\n");
    statements(depth - 1, 1 + below(2));
    add("END_IF\n", end + ":\n");
  } else {
    add("END_IF\n", otherwise + ":\n");
  }
}

void Generator::loop(int depth) {
  const std::string counter = "loop" + std::to_string(loops_++), begin = label(), end = label();
  const std::string limit = std::to_string(2 + below(4));
  add(counter + " := 0;\nWHILE " + counter + " < " + limit + " DO\n" + counter + " := " + counter + " + 1;\n",
      "LD 0\nST " + counter + "\n" + begin + ": LD " + counter + "\nGE " + limit + "\nJMPC " + end + "\nLD " + counter +
          "\nADD 1\nST " + counter + "\n");
  statements(depth - 1, 1 + below(2));
  add("END_WHILE\n", "JMP " + begin + "\n" + end + ":\n");
}

void Generator::blockCall() {
  const Expr in = expr(kBool, 2), other = leaf(kBool, false);
  switch (below(7)) {
    case 0: return add("e1(CLK := " + in.st + ");\n", in.il + "CLK e1\n");
    case 1: return add("t1(IN := " + in.st + ", PT := T#30ms);\n", in.il + "ST t1.IN\nLD T#30ms\nST t1.PT\nCAL t1\n");
    case 2:
      return add("l1(SET1 := " + other.st + ", RESET := a, Q1 => r);\n",
                 "CAL l1(\nSET1 := " + other.st + ",\nRESET := a, Q1 => r\n)\n");
    case 3: return add("c1(CU := " + in.st + ");\nn := c1.CV;\n", in.il + "CU c1\nLD c1.CV\nST n\n");
    case 4:
      return add("IF " + in.st + " THEN own(step := 2); END_IF\nm := own.sum;\n",
                 in.il + "CALC own(step := 2)\nLD own.sum\nST m\n");
    case 5: {
      const Expr step = leaf(kInt, true);
      return add("own(step := " + step.st + ");\nq := own.odd;\n",
                 "CAL own(step := " + step.st + ")\nLD own.odd\nST q\n");
    }
    default:
      return add("l1(SET1 := " + in.st + ", RESET := " + other.st + ");\n",
                 "CAL l1(SET1 := (" + in.il + "), RESET := " + other.st + ")\n");
  }
}

// Two paths bring the accumulator to one label.
void Generator::joinedValue() {
  const Type type = static_cast<Type>(below(kTypes));
  const Expr condition = expr(kBool, 2), one = expr(type, 2), two = expr(type, 2);
  const std::string to = target(type), other = label(), end = label();
  add("IF " + condition.st + " THEN " + to + " := " + one.st + "; ELSE " + to + " := " + two.st + "; END_IF\n",
      condition.il + "JMPCN " + other + "\n" + one.il + "JMP " + end + "\n" + other + ": " + two.il + end + ": ST " +
          to + "\n");
}

void Generator::statement(int depth) {
  const unsigned what = below(100);
  if (what < 55 || depth <= 0) return assignment();
  if (what < 70) return branch(depth);
  if (what < 78 && loops_ < 6) return loop(depth);
  if (what < 90) return blockCall();
  joinedValue();
}

void Generator::statements(int depth, unsigned count) {
  for (unsigned k = 0; k < count; ++k) statement(depth);
}

Twins Generator::block() {
  statements(3, 6 + below(8));
  if (chance(30)) {
    const Expr leave = expr(kBool, 2);
    add("IF " + leave.st + " THEN RETURN; END_IF\n", leave.il + "RETC\n");
    statements(2, 2);
  }
  std::string head = "FUNCTION_BLOCK " + name_ +
                     "\nVAR_INPUT a, b, c, d : BOOL; i, j : DINT; k : INT; x : REAL; END_VAR\n"
                     "VAR_OUTPUT p, q, r : BOOL; m, n : DINT; s, u : INT; y, z : REAL; mem : Memory; END_VAR\n"
                     "VAR bits : ARRAY[0..2] OF BOOL; list : ARRAY[1..2] OF DINT; w : WORD; pos : INT := 1;\n"
                     "keep_b : BOOL; keep_d : DINT; keep_i : INT; keep_r : REAL;\n"
                     "t1 : TON; e1 : R_TRIG; l1 : SR; c1 : CTU; own : Accumulate;\n";
  for (unsigned n = 0; n < loops_; ++n) head += "loop" + std::to_string(n) + " : INT;\n";
  head += "END_VAR\n";
  const std::string tail = "END_FUNCTION_BLOCK\n";
  return {head + out_.st + tail, head + out_.il + tail};
}

}  // namespace

Twins generate(uint64_t seed, unsigned index) { return Generator(seed, index).block(); }

}  // namespace rung::il_differential

// SPDX-License-Identifier: Apache-2.0
// Blocks with methods, properties, actions and bases in generated programs, the interfaces, pointers and references
// to them, and memory from the pool. Only in the codesys dialect.
// A method calls only methods with a smaller number, so every call ends, whatever the object is.
#include <cctype>

#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

namespace {

constexpr const char* kClasses[] = {"O0", "O1", "O2"};
constexpr int kClassCount = sizeof kClasses / sizeof kClasses[0];
constexpr int kMethodCount = 3;

// An object for method calls, and how many of M0, M1, M2 it has.
struct Receiver {
  const char* text;
  int methods;
  bool is_block;  // its inputs, body and action are accessible, too
};

constexpr Receiver kReceivers[] = {{"o0", 3, true},
                                   {"o1", 3, true},
                                   {"o2", 3, true},
                                   {"po^", 3, true},
                                   {"ro", 3, true},
                                   {"po1^", 3, true},
                                   {"any0", 1, false},
                                   {"any1", 2, false},
                                   {"itfs[\1]", 1, false},
                                   {"objs[\1]", 3, true},
                                   {"pos[\1]^", 3, true},
                                   {"o0.Me()", 3, true},
                                   {"po^.Me()", 3, true},
                                   {"any1.Self()", 1, false},
                                   {"ro.Self()", 1, false},
                                   {"cell.block", 3, true},
                                   {"cells[\1].block", 3, true}};
constexpr int kReceiverCount = sizeof kReceivers / sizeof kReceivers[0];

// Appends `end` to the names of the body's variables: a block may not declare those of its base again.
void rename(Node& node, const std::string& end) {
  const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string text;
  for (size_t i = 0; i < node.text.size();) {
    size_t last = i;
    while (last < node.text.size() && isPart(node.text[last])) ++last;
    if (last == i) {
      text += node.text[i++];
      continue;
    }
    const std::string word = node.text.substr(i, last - i);
    const bool numbered = word.size() > 1 && std::string("ink").find(word[0]) != std::string::npos &&
                          std::isdigit(static_cast<unsigned char>(word[1])) != 0;
    text += word + (word.compare(0, 2, "v_") == 0 || word.compare(0, 2, "c_") == 0 || numbered ? end : "");
    i = last;
  }
  node.text = std::move(text);
  for (Node& child : node.children) rename(child, end);
}

}  // namespace

// ---- blocks

// A call of method `number` with its arguments; `before`: the parts of the receiver. Inside an object only variables
// that exist there are passed by reference.
Node Generator::methodCall(const std::string& receiver, int number, std::vector<Node> before, int depth) {
  const Method& method = methods_[static_cast<size_t>(number)];
  std::string text = receiver + "M" + std::to_string(number) + "(";
  std::vector<Node> parts = std::move(before);
  for (size_t i = 0; i < method.inputs.size(); ++i) {
    text += (i == 0 ? "in" : ", in") + std::to_string(i) + " := \1";
    parts.push_back(expr(method.inputs[i], depth));
  }
  const bool inside = inObject();
  if (number == 1) {
    text += ", io := " + (inside ? pick({"v_dint", "v_dint2", "count"})
                                 : pick({"v_dint", "v_dint2", "target", "o0.count", "numbers[2]", "rd", "pn^"}));
    if (chance(50)) text += ", out1 => " + (inside ? pick({"v_dint", "count"}) : pick({"v_dint2", "target", "pm^"}));
  }
  if (number == 2)
    text += ", other := " + (body_ == Body::Method ? "other"
                             : inside              ? "THIS^"
                                                   : pick({"o0", "o1", "ro", "po^", "objs[1]"}));
  return Expr{method.result, text + ")", std::move(parts)};
}

// A receiver with method `number`, with its dot; the subscript that it needs goes to `parts`.
std::string Generator::receiver(int number, bool is_block, std::vector<Node>& parts) {
  if (inObject()) {
    if (body_ == Body::Method && method_ == 2 && chance(40)) return "other.";
    return chance(50) || is_block ? "THIS^." : "";
  }
  const Receiver* found = &kReceivers[below(kReceiverCount)];
  while (found->methods <= number || (is_block && !found->is_block)) found = &kReceivers[below(kReceiverCount)];
  const std::string text = found->text;
  if (text.find(kChild) != std::string::npos) parts.push_back(subscript(0, 2, 1));
  return text + ".";
}

// Calls a method with that result type; false when none has it or none may be called here.
bool Generator::methodOf(int type, int depth, Node& result) {
  if (methods_.empty() || loops_ > (body_ == Body::Program ? 1 : 0)) return false;
  const int reach = body_ == Body::Program ? kMethodCount : inObject() ? method_ : 0;
  for (int number = 0; number < reach; ++number) {
    if (methods_[static_cast<size_t>(number)].result != type) continue;
    std::vector<Node> parts;
    const std::string on = receiver(number, false, parts);
    result = methodCall(on, number, std::move(parts), depth);
    return true;
  }
  return false;
}

Node Generator::makeMethod(int number, const std::string& base) {
  const Method& method = methods_[static_cast<size_t>(number)];
  const std::string name = "M" + std::to_string(number);
  own_inputs_ = method.inputs;
  own_ = name;
  own_result_ = method.result;
  body_ = Body::Method;
  method_ = number;
  std::string head = "METHOD " + name + " : " + kTypes[method.result].name + "\nVAR_INPUT ";
  for (size_t i = 0; i < method.inputs.size(); ++i) {
    head += "in" + std::to_string(i) + " : " + kTypes[method.inputs[i]].name + "; ";
  }
  head += "END_VAR\n";
  if (number == 1) head += "VAR_IN_OUT io : DINT; END_VAR\nVAR_OUTPUT out1 : DINT; END_VAR\n";
  if (number == 2) head += "VAR_IN_OUT other : " + prefix_ + "_O0; END_VAR\n";
  Node body = statements(1, 2 + below(3));
  std::vector<Node> lines;
  std::string text;
  const auto line = [&](Node node) {
    lines.push_back(std::move(node));
    text += kChild;
  };
  if (number == 1) {
    line(Stmt{"io := io + \1;\n", {expr(kDint, 2)}});
    line(Stmt{"out1 := \1;\n", {expr(kDint, 2)}});
  }
  line(Stmt{name + " := \1;\n", {expr(method.result, 2)}});
  if (!base.empty() && chance(70)) {
    Node call = methodCall("SUPER^.", number, {}, 1);
    if (number == 1)
      call = Expr{method.result, "SUPER^.M1(in0 := \1, io := io, out1 => out1)", {expr(method.inputs[0], 1)}};
    line(Stmt{name + " := \1;\n", {std::move(call)}});
  }
  if (chance(50)) line(Stmt{"count := count + \1;\n", {expr(kDint, 1)}});
  Node rest = Stmt{text, std::move(lines)};
  Node vars = declarations({&body, &rest});
  return Stmt{head + "\1\1\1END_METHOD\n", {std::move(vars), std::move(body), std::move(rest)}};
}

Node Generator::makeClass(int number) {
  const std::string self = prefix_ + "_" + kClasses[number];
  const int parent = number == 0 ? -1 : number == 2 && !chained_ ? 0 : number - 1;
  const std::string base = parent < 0 ? "" : prefix_ + "_" + kClasses[parent];
  std::string head = "FUNCTION_BLOCK " + self;
  if (parent >= 0) head += " EXTENDS " + base;
  if (number == 0) head += " IMPLEMENTS " + prefix_ + "_I0";
  if (parent == 0) head += " IMPLEMENTS " + prefix_ + "_I1";
  head += "\n";
  if (number == 0) {
    head += "VAR_INPUT start : " + std::string(kTypes[start_].name) +
            "; count : DINT; image : WORD := 16#8421; list : ARRAY[0..2] OF INT := [1, -2, 3]; flag, low : BIT; "
            "END_VAR\nVAR_OUTPUT out0 : DINT; END_VAR\n";
  }
  if (number == 2) head += "VAR part : " + prefix_ + "_O0(-7); rest : LINT; END_VAR\n";
  std::vector<Node> parts;
  std::string text;
  const auto add = [&](Node node) {
    parts.push_back(std::move(node));
    text += kChild;
  };

  body_ = Body::Class;
  method_ = kMethodCount;
  own_inputs_.clear();
  own_ = "out0";
  own_result_ = kDint;
  std::vector<Node> lines;
  lines.push_back(statements(1, 1 + below(3)));
  if (parent >= 0 && chance(70)) lines.push_back(Stmt{"SUPER^();\n"});
  if (chance(40)) lines.push_back(Stmt{"THIS^.Act(start := \1);\n", {expr(start_, 1)}});
  if (number == 2) lines.push_back(Stmt{"part(start := \1);\nrest := rest + part.out0;\n", {expr(start_, 1)}});
  lines.push_back(Stmt{"out0 := out0 + \1;\n", {expr(kDint, 2)}});
  Node body = Stmt{std::string(lines.size(), kChild), std::move(lines)};
  Node vars = declarations({&body});
  rename(vars, std::string("_") + kClasses[number]);
  rename(body, std::string("_") + kClasses[number]);
  add(std::move(vars));
  add(std::move(body));

  for (int i = 0; i < kMethodCount; ++i) {
    if (number == 0 || chance(60)) add(makeMethod(i, base));
  }
  body_ = Body::Class;
  method_ = 0;
  own_inputs_.clear();
  own_ = "count";
  own_result_ = kDint;
  if (number == 0 || chance(50)) {
    Node get = expr(kDint, 2), set = expr(kDint, 2);
    Node get_vars = declarations({&get}), set_vars = declarations({&set});
    add(Stmt{parent < 0 ? "PROPERTY Level : DINT\nGET\n\1Level := count + \1;\nEND_GET\nSET\n\1count := Level - \1;\n"
                          "END_SET\nEND_PROPERTY\n"
                        : "PROPERTY Level : DINT\nGET\n\1Level := SUPER^.Level + \1;\nEND_GET\nSET\n\1SUPER^.Level := "
                          "Level * 2 + \1;\nEND_SET\nEND_PROPERTY\n",
             {std::move(get_vars), std::move(get), std::move(set_vars), std::move(set)}});
  }
  add(Stmt{"METHOD FB_Init : BOOL\nVAR_INPUT bInitRetains, bInCopyCode : BOOL; first : DINT" +
           std::string(parent >= 0 && chance(40) ? " := 5" : "") + "; END_VAR\ncount := count * 3 + first" +
           (chance(50) ? " + THIS^.Level" : "") + ";\nEND_METHOD\n"});
  if (number == 0) {
    const std::string calls = chance(50) ? "count := count + 1;\n" : "";
    add(Stmt{"METHOD Me : REFERENCE TO " + self + "\n" + calls + "Me REF= THIS^;\nEND_METHOD\n"});
    add(Stmt{"METHOD Self : " + prefix_ + "_I0\n" + calls + "Self := THIS^;\nEND_METHOD\n"});
    add(Stmt{"METHOD At : POINTER TO DINT\n" + calls + "At := ADR(count);\nEND_METHOD\n"});
    add(Stmt{"METHOD Add : DINT\nVAR_INPUT more : DINT; END_VAR\nVAR_IN_OUT sum : DINT; pair : " + prefix_ +
             "_Pair; END_VAR\n" +
             "sum := sum + more;\ncount := count - sum;\npair.count := pair.count + count;\nAdd := sum + "
             "pair.count;\nEND_METHOD\n"});
    add(Stmt{"METHOD FB_Exit : BOOL\nVAR_INPUT bInCopyCode : BOOL; END_VAR\n" + prefix_ + "_g_dint := " + prefix_ +
             "_g_dint + count;\nEND_METHOD\n"});
    add(Stmt{"ACTION Act\ncount := count * 5 + out0;\nimage.%B1 := DINT_TO_BYTE(count);\nEND_ACTION\n"});
  } else if (chance(40)) {
    add(Stmt{"ACTION Act\nSUPER^.Act();\nTHIS^.Level := out0;\nEND_ACTION\n"});
  }
  return Fixed{head + text + "END_FUNCTION_BLOCK\n\n", std::move(parts)};
}

// Interfaces, blocks, and functions that take objects and arrays by reference.
void Generator::makeObjects(std::vector<Node>& parts) {
  if (!codesys()) return;
  start_ = anyType();
  chained_ = chance(60);
  std::vector<Method> methods;
  for (int i = 0; i < kMethodCount; ++i) {
    Method method;
    method.result = chance(50) ? kDint : anyType();
    for (int n = 1 + (i == 1 ? 0 : below(2)); n > 0; --n) method.inputs.push_back(chance(40) ? kDint : anyType());
    methods.push_back(std::move(method));
  }
  methods_ = std::move(methods);
  const auto signature = [&](int number) {
    const Method& method = methods_[static_cast<size_t>(number)];
    std::string text = "METHOD M" + std::to_string(number) + " : " + kTypes[method.result].name + "\nVAR_INPUT ";
    for (size_t i = 0; i < method.inputs.size(); ++i) {
      text += "in" + std::to_string(i) + " : " + kTypes[method.inputs[i]].name + "; ";
    }
    text += "END_VAR\n";
    if (number == 1) text += "VAR_IN_OUT io : DINT; END_VAR\nVAR_OUTPUT out1 : DINT; END_VAR\n";
    return text + "END_METHOD\n";
  };
  parts.push_back(Fixed{"INTERFACE " + prefix_ + "_I0\n" + signature(0) +
                        "PROPERTY Level : DINT\nGET\nEND_GET\nSET\nEND_SET\nEND_PROPERTY\nMETHOD Self : " + prefix_ +
                        "_I0\nEND_METHOD\nEND_INTERFACE\nINTERFACE " + prefix_ + "_I1 EXTENDS " + prefix_ + "_I0\n" +
                        signature(1) + "END_INTERFACE\n"});
  for (int i = 0; i < kClassCount; ++i) parts.push_back(makeClass(i));
  parts.push_back(Stmt{"TYPE " + prefix_ +
                       "_Bits : STRUCT a : BIT; b : BIT := TRUE; n : INT := -1; c, d, e, f, g, h, i, k, l, m : BIT; "
                       "END_STRUCT END_TYPE\nTYPE " +
                       prefix_ + "_Cell : STRUCT block : " + prefix_ + "_O1(12); bits : " + prefix_ +
                       "_Bits; END_STRUCT END_TYPE\n"});
  own_inputs_.clear();
  method_ = -1;
  const std::string o0 = prefix_ + "_O0";
  parts.push_back(Stmt{"FUNCTION " + prefix_ + "_Run : DINT\nVAR_IN_OUT o : " + o0 +
                       "; END_VAR\nVAR_INPUT p : POINTER TO " + o0 + "; r : REFERENCE TO " + o0 + "; i : " + prefix_ +
                       "_I0; END_VAR\nVAR mine : " + prefix_ + "_O1(9); other : " + prefix_ +
                       "_I0; END_VAR\nmine(count := p^.count);\nother := mine;\n" + prefix_ + "_Run := other.Level;\n" +
                       (chance(50) ? "o();\n" : "r.Act();\n") +
                       (chance(50) ? "p^(out0 => " + prefix_ + "_Run);\n" : "") + "i.Level := r.count + o.Level;\n" +
                       prefix_ + "_Run := " + prefix_ + "_Run + p^.count * i.Level;\nEND_FUNCTION\n\n"});
  parts.push_back(
      Stmt{"FUNCTION " + prefix_ +
           "_Sum : DINT\nVAR_IN_OUT values : ARRAY[*] OF DINT; grid : ARRAY[*, *] OF INT; "
           "END_VAR\nVAR i, k : DINT; END_VAR\nFOR i := LOWER_BOUND(values, 1) TO UPPER_BOUND(values, 1) DO\n" +
           prefix_ + "_Sum := " + prefix_ + "_Sum * 3 + values[i];\nvalues[i] := values[i] + i;\nEND_FOR\n" +
           "FOR i := LOWER_BOUND(grid, 1) TO UPPER_BOUND(grid, 1) DO\n"
           "FOR k := LOWER_BOUND(grid, 2) TO UPPER_BOUND(grid, 2) DO\n" +
           prefix_ + "_Sum := " + prefix_ + "_Sum + grid[i, k] * i - k;\ngrid[i, k] := grid[i, k] - 1;\n" +
           "END_FOR\nEND_FOR\nEND_FUNCTION\n\n"});
}

// ---- in programs

// An instance, a pointer or its target, as the right side of a binding.
std::string Generator::instance(bool second) {
  if (second) return pick({"o1", "o2", "objs[0]", "objs[2]"});
  return pick({"o0", "o1", "o2", "objs[1]", "ro", "po^"});
}

Node Generator::bindObject() {
  switch (below(7)) {
    case 0: return Stmt{"any0 := " + instance(false) + ";\n"};
    case 1: return Stmt{"any1 := " + instance(true) + ";\n"};
    case 2: return Stmt{"po := ADR(" + pick({"o0", "o1", "o2", "objs[\1]"}) + ");\n", {subscript(0, 2, 1)}};
    case 3: return Stmt{"ro REF= " + pick({"o0", "o1", "o2", "objs[0]", "po^"}) + ";\n"};
    case 4:
      return Stmt{"itfs[\1] := " + pick({"any0", "any1", "o0", "o1", "o2", "objs[1]"}) + ";\n", {subscript(0, 2, 1)}};
    case 5: return Stmt{"pos[\1] := " + pick({"po", "po1", "ADR(o0)", "ADR(ro)"}) + ";\n", {subscript(0, 2, 1)}};
    default: return Stmt{"po1 := ADR(" + pick({"o1", chained_ ? "o2" : "o1", "objs[2]"}) + ");\n"};
  }
}

Node Generator::objectStatement() {
  std::vector<Node> parts;
  switch (below(17)) {
    case 12:
      return Stmt{pick({"v_dint", "target", "pm^"}) + " := " + pick({"o0", "ro", "po1^", "objs[0]", "cell.block"}) +
                      ".Add(more := \1, sum := " +
                      pick({"target", "v_dint", "pm^", "rd", "numbers[2]", "pair.count", "o0.count", "cell.block.count",
                            "objs[0].count"}) +
                      ", pair := " + pick({"pair", "table[1]", "pp^", "rp"}) + ");\n",
                  {expr(kDint, 2)}};
    case 13:
      return Stmt{pick({"objs[1] := objs[2];\n", "objs[0] := objs[1];\n", "cells[1] := cell;\n", "cell := cells[0];\n",
                        "cell.block := o1;\n", "cells[2].bits := cell.bits;\n"})};
    case 14: {
      const std::string text = receiver(0, true, parts);
      parts.push_back(expr(kDint, 2));
      return Stmt{text + "At()^ := \1;\n", std::move(parts)};
    }
    case 15: {
      const std::string text = pick({"cell.", "cells[\1]."}) + "bits." + pick({"a", "b", "c", "f", "h", "i", "m"});
      if (text.find(kChild) != std::string::npos) parts.push_back(subscript(0, 2, 1));
      parts.push_back(expr(kBool, 2));
      return Stmt{text + " := \1;\n", std::move(parts)};
    }
    case 0:
    case 1: {
      // Counted children must appear in the source: a subscript that nothing needs is left out.
      Node node = bindObject();
      if (node.text.find(kChild) == std::string::npos) node.children.clear();
      return node;
    }
    case 2: {
      std::string text = receiver(0, true, parts);
      text.pop_back();
      text += "(";
      if (chance(60)) {
        text += "start := \1";
        parts.push_back(expr(start_, 2));
        if (chance(50)) text += ", ";
      }
      if (text.back() != '\1') text += pick({"count := 3", "out0 => v_dint2", "out0 => target", "image := v_word"});
      return Stmt{text + ");\n", std::move(parts)};
    }
    case 3: {
      const std::string text = receiver(0, true, parts);
      if (chance(30)) return Stmt{text + "Act();\n", std::move(parts)};
      parts.push_back(expr(start_, 2));
      return Stmt{text + "Act(start := \1" + pick({"", ", out0 => v_dint", ", out0 => pn^"}) + ");\n",
                  std::move(parts)};
    }
    case 4: {
      const std::string text = receiver(0, false, parts);
      parts.push_back(expr(kDint, 2));
      return Stmt{text + "Level := \1;\n", std::move(parts)};
    }
    case 5: {
      const std::string text = receiver(0, true, parts);
      const int field = below(5);
      const int types[] = {kDint, kWord, kInt, kBool, kBool};
      const char* names[] = {"count", "image", "list[1]", "flag", "low"};
      parts.push_back(expr(types[field], 2));
      return Stmt{text + names[field] + " := \1;\n", std::move(parts)};
    }
    case 6:
      return Stmt{pick({"v_dint", "target", "v_dint2"}) + " := " + prefix_ + "_Run(o := " + instance(false) +
                  ", p := " + pick({"po", "po1", "ADR(o0)"}) + ", r := " + pick({"ro", "o1", "o0"}) +
                  ", i := " + pick({"any0", "any1", "o2", "itfs[1]"}) + ");\n"};
    case 7:
      return Stmt{"anyz ?= " + pick({"any0", "po", "ro", "itfs[2]"}) +
                  ";\nIF anyz <> 0 THEN\nv_dint := anyz.Level;\nany1 := anyz;\nEND_IF\n"};
    case 8:
      return Stmt{"IF __QUERY" +
                      (chance(50) ? "INTERFACE(" + pick({"any0", "itfs[0]", "any1"}) + ", any1"
                                  : "POINTER(" + pick({"any0", "itfs[0]", "any1"}) + ", po1") +
                      ") THEN\n\1ELSE\nany1 := o2;\npo1 := ADR(objs[1]);\nEND_IF\n",
                  {assignment()}};
    case 9: {
      const std::string created = pick({"O0(2)", "O1(3)", "O2(first := 4)"});
      return Stmt{"IF heap = 0 THEN heap := __NEW(" + prefix_ + "_" + created + "); END_IF\n"};
    }
    case 10:
      return Stmt{
          "IF heap <> 0 THEN\n\1v_dint := heap^.Level;\n" + pick({"__DELETE(heap);\n", "", "heap^();\n"}) + "END_IF\n",
          {Stmt{"heap^(start := \1, out0 => target);\n", {expr(start_, 2)}}}};
    case 11: {
      const std::string size = std::to_string(3 + below(4));
      return Stmt{"pool := __NEW(DINT, " + size +
                      ");\nIF pool <> 0 THEN\npool[1] := \1;\npool[2] := pool[1] * \1;\nv_dint := "
                      "pool[2] - pool[0];\n__DELETE(pool);\nEND_IF\n",
                  {expr(kDint, 2), expr(kDint, 2)}};
    }
    default: {
      const int number = below(kMethodCount);
      const std::string on = receiver(number, false, parts);
      const Node call = methodCall(on, number, std::move(parts), 2);
      if (chance(30)) return Stmt{"\1;\n", {call}};
      return Stmt{writable(call.type) + " := \1;\n", {call}};
    }
  }
}

Node Generator::pointerStatement() {
  switch (below(18)) {
    case 14: return Stmt{"pt[\1].count := \1;\n", {offset(-1, 4, 1), expr(kDint, 2)}};
    case 15: {
      const int wide = below(3);
      const char* text[] = {"words[\1].%X7 := \1;\n", "words[\1].%B1 := \1;\n", "words[\1].12 := \1;\n"};
      return Stmt{text[wide], {subscript(0, 2, 1), expr(wide == 1 ? kByte : kBool, 2)}};
    }
    case 16: return Stmt{"halves[\1].%W1.%B0 := \1;\n", {subscript(0, 1, 1), expr(kByte, 2)}};
    case 17:
      return Stmt{pick({"numbers[1]", "pm^", "others[0]", "pn[1]", "target", "rd"}) + "." + std::to_string(below(32)) +
                      " := \1;\n",
                  {expr(kBool, 2)}};
    case 0: return Stmt{"pm := ADR(numbers[\1]);\n", {subscript(0, 4, 1)}};
    case 1: return Stmt{"pm := pn + SIZEOF(DINT) * \1;\n", {offset(-1, 3, 1)}};
    case 2: return Stmt{"pn[\1] := \1;\n", {offset(-1, 3, 1), expr(kDint, 2)}};
    case 3: return Stmt{"pm^ := \1;\n", {expr(kDint, 2)}};
    case 4:
      return Stmt{"rd REF= " + pick({"target", "pair.count", "o1.count", "numbers[3]", "pm^", "rp.count"}) + ";\n"};
    case 5: return Stmt{"rd := \1;\n", {expr(kDint, 2)}};
    case 6: return Stmt{"pp := ADR(" + pick({"pair", "table[1]", "table[-1]", "rp"}) + ");\n"};
    case 7: return Stmt{"rp REF= " + pick({"pair", "table[0]", "table[4]", "pp^"}) + ";\n"};
    case 8: return Stmt{pick({"rp := pair;\n", "pair := pp^;\n", "pp^ := table[1];\n", "pp^ := rp;\n"})};
    case 9:
      return Stmt{"v_dint := " + prefix_ + "_Sum(" + pick({"numbers", "others"}) + ", " + pick({"grid", "squares"}) +
                  ");\n"};
    case 10: return Stmt{pick({"rz REF= target;\n", "rz REF= 0;\n", "rz REF= pm^;\n", "rz REF= rd;\n"})};
    case 11:
      if (faults_ == Faults::Index && chance(25)) {
        const char* empty[] = {"rz := 1;\n", "v_dint := anyz.Level;\n", "heap^();\n", "po1 := po;\n",
                               "po1 ?= po;\npo1^.Act();\n"};
        return Stmt{empty[below(5)]};
      }
      return Stmt{"IF __ISVALIDREF(rz) THEN rz := rz + \1; END_IF\n", {expr(kDint, 2)}};
    case 12: return Stmt{"pb[\1] := \1;\n", {offset(0, 3, 1), expr(kByte, 2)}};
    default: return Stmt{"pw[\1] := \1;\n", {offset(0, 1, 1), expr(kWord, 2)}};
  }
}

// An indirect lvalue of the type; empty when there is none.
std::string Generator::led(int type) {
  if (!codesys() || methods_.empty()) return "";
  if (inObject()) {
    const std::string self = chance(50) ? "THIS^." : "";
    if (type == kDint) return self + "count";
    if (type == kWord) return self + "image";
    if (type == kInt) return self + "list[" + std::to_string(below(3)) + "]";
    if (type == kBool) return self + pick({"flag", "low"});
    return "";
  }
  if (body_ != Body::Program) return "";
  const std::string self = pick({"o0.", "o1.", "o2.", "po^.", "ro.", "po1^.", "objs[1].", "pos[2]^."});
  if (type == kDint) {
    return chance(40) ? self + "count"
                      : pick({"pn^", "pm^", "pn[-1]", "pn[3]", "rd", "pt[-1].count", "pt[3].count", "o0.At()^",
                              "po1^.At()^", "pp^.count", "rp.count", "numbers[2]", "target"});
  }
  if (type == kWord) return chance(50) ? self + "image" : pick({"pw^", "pw[1]", "words[1]"});
  if (type == kByte) return pick({"pb^", "pb[3]", "pb[1]"});
  if (type == kDword) return pick({"seen", "halves[0]", "halves[1]"});
  if (type == kLword) return "pl^";
  if (type == kInt) return self + "list[" + std::to_string(below(3)) + "]";
  if (type == kBool && chance(40))
    return pick({"cell.bits.", "cells[1].bits.", "cells[0].bits."}) + pick({"a", "b", "c", "d", "g", "h", "m"});
  if (type == kBool) return self + pick({"flag", "low"});
  if (type == kReal) return pick({"pp^.share", "rp.share"});
  if (type == kString) return pick({"pp^.title", "rp.title"});
  return "";
}

Node Generator::pointerQuestion() {
  return Expr{kBool, pick({"(pm > pn)", "(pm = ADR(numbers[1]))", "__ISVALIDREF(rz)", "(po = ADR(o1))", "(heap <> 0)",
                           "(po = po1)", "(any0 = any1)", "(itfs[1] = o1)"})};
}

// The variables of a program for the above, and the bindings in its first cycle or in each.
const std::vector<Lvalue>& Generator::lvalues() {
  if (!lvalues_.empty()) return lvalues_;
  if (dialect_ == Dialect::Iec3) lvalues_ = classLvalues();
  if (codesys()) lvalues_ = objectLvalues();
  const std::vector<Lvalue> records = recordLvalues();
  lvalues_.insert(lvalues_.end(), records.begin(), records.end());
  return lvalues_;
}

std::vector<Lvalue> Generator::objectLvalues() const {
  const std::string o = prefix_ + "_O", pair = prefix_ + "_Pair";
  return {{"o0", o + "0(1)", ""},
          {"o1", o + "1(2)", ""},
          {"o2", o + "2(first := 3)", ""},
          {"objs", "ARRAY[0..2] OF " + o + "1[(4), (-5), (6)]", ""},
          {"po", "POINTER TO " + o + "0", "po := ADR(o1);\n"},
          {"po1", "POINTER TO " + o + "1", "po1 := ADR(objs[1]);\n"},
          {"pos", "ARRAY[0..2] OF POINTER TO " + o + "0", "pos[0] := ADR(o0);\npos[1] := ADR(o2);\npos[2] := po;\n"},
          {"ro", "REFERENCE TO " + o + "0", "ro REF= objs[2];\n"},
          {"any0", prefix_ + "_I0", "any0 := o0;\n"},
          {"any1", prefix_ + "_I1", "any1 := o1;\n"},
          {"cell", prefix_ + "_Cell", ""},
          {"cells", "ARRAY[0..2] OF " + prefix_ + "_Cell", ""},
          {"pt", "POINTER TO " + pair, "pt := ADR(table[0]);\n"},
          {"anyz", prefix_ + "_I1", ""},
          {"itfs", "ARRAY[0..2] OF " + prefix_ + "_I0", "itfs[0] := o0;\nitfs[1] := o1;\nitfs[2] := any0;\n"},
          {"heap", "POINTER TO " + o + "0", ""},
          {"pool", "POINTER TO DINT", ""},
          {"target", "DINT := -3", ""},
          {"numbers", "ARRAY[0..4] OF DINT := [5(7)]", ""},
          {"others", "ARRAY[-2..1] OF DINT := [1, 2, 3, 4]", ""},
          {"squares", "ARRAY[-1..0, 3..4] OF INT := [9, 8, 7, 6]", ""},
          {"pn", "POINTER TO DINT", "pn := ADR(numbers[1]);\n"},
          {"pm", "POINTER TO DINT", "pm := ADR(numbers[3]);\n"},
          {"pp", "POINTER TO " + pair, "pp := ADR(table[2]);\n"},
          {"rp", "REFERENCE TO " + pair, "rp REF= pair;\n"},
          {"rd", "REFERENCE TO DINT", "rd REF= numbers[2];\n"},
          {"rz", "REFERENCE TO DINT", ""},
          {"seen", "DWORD := 16#12345678", ""},
          {"pw", "POINTER TO WORD", "pw := ADR(seen);\n"},
          {"pb", "POINTER TO BYTE", "pb := ADR(seen);\n"},
          {"halves", "ARRAY[0..1] OF DWORD", ""},
          {"words", "ARRAY[0..2] OF WORD := [1, 2, 16#FFFF]", ""},
          {"pl", "POINTER TO LWORD", "pl := ADR(halves);\n"}};
}
}  // namespace rung::differential

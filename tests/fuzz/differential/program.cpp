// SPDX-License-Identifier: Apache-2.0
// POUs and declarations of generated programs, and the source of a program.
#include "tests/fuzz/differential/program.h"

#include <cctype>

#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

// ---- POUs

namespace {

// True when the text contains the name: `v_int` is not in `v_int2`.
bool uses(const std::string& text, const std::string& name) {
  const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const size_t end = at + name.size();
    if ((at == 0 || !isPart(text[at - 1])) && (end == text.size() || !isPart(text[end]))) return true;
  }
  return false;
}

}  // namespace

// The declarations used by the parts of a body, two variables and a constant of each type and those that loops need, in
// sections that are allowed there.
Node Generator::declarations(std::initializer_list<const Node*> users) {
  std::string used;
  for (const Node* user : users) used += user->print();
  std::string sections[5];
  std::vector<Node> parts[5];
  const auto add = [&](int section, Node line) {
    parts[section].push_back(std::move(line));
    sections[section] += kChild;
  };
  for (int type = 0; type < kTypeCount; ++type) {
    for (const char* suffix : {"", "2"}) {
      const std::string name = "v_" + lowered(kTypes[type].name) + suffix;
      Node init = Expr{type, literal(type)};
      const int where = below(100);
      // A temporary is initialised in each call; a static variable is shared by all calls and instances.
      const bool kept = where < 20 && codesys() && body_ != Body::Program;
      const int section = where < 12 ? 1 : kept ? 2 : where < 30 && body_ == Body::Method ? 4 : 0;
      if (uses(used, name)) add(section, Stmt{name + " : " + kTypes[type].name + " := \1;\n", {std::move(init)}});
    }
    const std::string name = "c_" + lowered(kTypes[type].name);
    Node value = Expr{type, literal(type)};
    if (uses(used, name)) add(3, Stmt{name + " : " + kTypes[type].name + " := \1;\n", {std::move(value)}});
  }
  for (const char* line : {"i0 : INT;\n", "i1 : DINT;\n", "n0 : INT;\n", "n1 : USINT;\n"}) {
    if (uses(used, std::string(line, 2))) add(0, Stmt{line});
  }
  for (int i = 0; i < labels_; ++i) {
    const std::string name = "k" + std::to_string(i);
    if (uses(used, name)) add(0, Stmt{name + " : INT;\n"});
  }
  labels_ = 0;
  const char* heads[] = {"VAR\n", "VAR_TEMP\n", "VAR_STAT\n", "VAR CONSTANT\n", "VAR_INST\n"};
  std::string text;
  std::vector<Node> all;
  for (int i = 0; i < 5; ++i) {
    if (parts[i].empty()) continue;
    text += kChild;
    all.push_back(Stmt{heads[i] + sections[i] + "END_VAR\n", std::move(parts[i])});
  }
  return Fixed{text, std::move(all)};
}

Node Generator::makeFunction(int number) {
  Function function;
  function.name = prefix_ + "_F" + std::to_string(number);
  function.result = anyType();
  for (int n = 1 + below(3); n > 0; --n) function.inputs.push_back(anyType());
  own_inputs_ = function.inputs;
  own_ = function.name;
  own_result_ = function.result;
  body_ = Body::Function;
  std::string head = "FUNCTION " + function.name + " : " + kTypes[function.result].name + "\nVAR_INPUT ";
  for (size_t i = 0; i < function.inputs.size(); ++i) {
    head += "in" + std::to_string(i) + " : " + kTypes[function.inputs[i]].name + "; ";
  }
  Node body = statements(1, 2 + below(3));
  Node last = Stmt{own_ + " := \1;\n", {expr(own_result_, 3)}};
  Node vars = declarations({&body, &last});
  functions_.push_back(std::move(function));
  return Stmt{head + "END_VAR\n\1\1\1END_FUNCTION\n\n", {std::move(vars), std::move(body), std::move(last)}};
}

// A function with by-reference parameters: an in-out, a structure, an array and a string.
Node Generator::makeAccess() {
  own_inputs_.clear();
  own_ = prefix_ + "_Access";
  own_result_ = kString;
  body_ = Body::Function;
  std::vector<Node> lines;
  std::string text;
  for (int n = 2 + below(4); n > 0; --n) {
    text += kChild;
    switch (below(7)) {
      case 0: lines.push_back(Stmt{"io.count := io.count + row[\1];\n", {subscript(0, 2, 1)}}); break;
      case 1: lines.push_back(Stmt{"io.title := CONCAT(title, \1);\n", {expr(kString, 1)}}); break;
      case 2: lines.push_back(Stmt{"io := given;\n"}); break;
      case 3: lines.push_back(Stmt{"done := given.share > io.share;\n"}); break;
      case 4: lines.push_back(Stmt{codesys() ? "given.count := io.count;\n" : "io.count := given.count;\n"}); break;
      case 5: lines.push_back(Stmt{own_ + " := CONCAT(title, io.title);\n"}); break;
      default: lines.push_back(statement(1));
    }
  }
  Node body = Stmt{text, std::move(lines)};
  Node vars = declarations({&body});
  const std::string pair = prefix_ + "_Pair";
  return Stmt{"FUNCTION " + own_ + " : STRING[20]\nVAR_IN_OUT io : " + pair + "; END_VAR\nVAR_INPUT given : " + pair +
                  "; row : ARRAY[0..2] OF INT; title : STRING[5]; END_VAR\nVAR_OUTPUT done : BOOL; "
                  "END_VAR\n\1\1END_FUNCTION\n\n",
              {std::move(vars), std::move(body)}};
}

Node Generator::makeBlock(int number) {
  std::vector<int> inputs;
  for (int n = 1 + below(3); n > 0; --n) inputs.push_back(anyType());
  own_inputs_ = inputs;
  body_ = Body::Block;
  std::string head = "FUNCTION_BLOCK " + prefix_ + "_B" + std::to_string(number) + "\nVAR_INPUT ";
  for (size_t i = 0; i < inputs.size(); ++i) {
    head += "in" + std::to_string(i) + " : " + kTypes[inputs[i]].name + "; ";
  }
  Node body = statements(2, 3 + below(4));
  const std::string inner = number > 0 && chance(60) ? "VAR inner : " + prefix_ + "_B0; END_VAR\n" : "";
  const std::string call = inner.empty() ? "" : "inner(io := io);\nv_dint := inner.out0;\n";
  Node last = Stmt{call + "io := io + \1;\nout0 := \1;\n", {expr(kDint, 2), expr(kDint, 2)}};
  Node vars = declarations({&body, &last});
  blocks_.push_back(std::move(inputs));
  return Stmt{head + "END_VAR\nVAR_OUTPUT out0 : DINT; END_VAR\nVAR_IN_OUT io : DINT; END_VAR\n" + inner +
                  "\1\1\1END_FUNCTION_BLOCK\n\n",
              {std::move(vars), std::move(body), std::move(last)}};
}

namespace {

// Types and global variables. The located ones share the same memory.
void declareGlobals(const std::string& prefix, unsigned index, bool codesys, std::vector<Node>& parts) {
  parts.push_back(Stmt{"TYPE " + prefix + "_Colour : (Red, Green := 4, Blue);\n" + prefix +
                       "_Percent : INT (0..100);\n" + prefix + "_Small : USINT (3..9);\n" + prefix +
                       "_Pair : STRUCT count : DINT; share : REAL := 0.5; title : STRING[7]; END_STRUCT; END_TYPE\n"});
  if (codesys) {
    parts.push_back(
        Stmt{"TYPE " + prefix + "_Mix : UNION whole : DWORD; bytes : ARRAY[0..3] OF BYTE; END_UNION END_TYPE\n"});
  }
  const unsigned base = index * 16;
  std::string globals = "VAR_GLOBAL\n";
  std::vector<Node> global_lines;
  const auto global = [&](const std::string& content) {
    global_lines.push_back(Stmt{prefix + content + ";\n"});
    globals += kChild;
  };
  global("_g_dint : DINT");
  global("_g_real : REAL");
  global("_g_string : STRING");
  global("_at_dword AT %MD" + std::to_string(base / 4) + " : DWORD := 16#89ABCDEF");
  global("_at_word AT %MW" + std::to_string(base / 2 + 1) + " : WORD");
  global("_at_byte AT %MB" + std::to_string(base + 1) + " : BYTE");
  global("_at_bool AT %MX" + std::to_string(base) + ".3 : BOOL");
  for (unsigned coil = 0; coil < kCoils; ++coil) {
    global("_coil" + std::to_string(coil) + " AT %MX" + std::to_string(base + coil / 8) + "." +
           std::to_string(coil % 8) + " : BOOL");
  }
  global("_at_int AT %QW" + std::to_string(index) + " : INT");
  parts.push_back(Fixed{globals + "END_VAR\n", std::move(global_lines)});
  if (codesys) parts.push_back(Stmt{"VAR_GLOBAL CONSTANT " + prefix + "_k5 : INT := 5; END_VAR\n"});
}

// The bindings of the references and pointers that the text uses; those in a binding may need a binding themselves.
Node bindUsed(const std::vector<Lvalue>& all, bool once, std::string& used) {
  std::vector<bool> is_bound(all.size());
  for (bool grows = true; grows;) {
    grows = false;
    for (size_t i = 0; i < all.size(); ++i) {
      if (is_bound[i] || all[i].binding.empty() || !uses(used, all[i].name)) continue;
      is_bound[i] = grows = true;
      used += all[i].binding;
    }
  }
  std::vector<Node> bindings;
  for (size_t i = 0; i < all.size(); ++i) {
    if (is_bound[i]) bindings.push_back(Stmt{all[i].binding});
  }
  std::string binding(bindings.size(), kChild);
  if (once) binding = "IF NOT bound THEN\nbound := TRUE;\n" + binding + "END_IF\n";
  return Fixed{bindings.empty() ? "" : binding, std::move(bindings)};
}

// The variables, apart from those of the elementary types, that the text uses.
Node declareUsed(const std::string& prefix, const std::string& used, int blocks, const std::vector<Lvalue>& all,
                 uint64_t seed) {
  std::string more = "VAR\n";
  std::vector<Node> lines;
  const auto line = [&](const std::string& name, const std::string& type) {
    if (!uses(used, name)) return;
    lines.push_back(Stmt{name + " : " + type + ";\n"});
    more += kChild;
  };
  line("pair", prefix + "_Pair");
  line("table", "ARRAY[-1..4] OF " + prefix + "_Pair");
  line("grid", "ARRAY[1..2, 0..2] OF INT := [3(1), 2, -5]");
  line("short", "STRING[3]");
  line("percent", prefix + "_Percent");
  line("row", "ARRAY[0..2] OF INT := [7, -8, 9]");
  line("small", prefix + "_Small");
  line("mix", prefix + "_Mix");
  line("colour", prefix + "_Colour");
  line("other_colour", prefix + "_Colour");
  line("ton", "TON");
  line("tof", "TOF");
  line("tp", "TP");
  line("ctu", "CTU");
  line("rise", "R_TRIG");
  line("fall", "F_TRIG");
  line("latch", "SR");
  for (int i = 0; i < blocks; ++i) {
    const std::string n = std::to_string(i);
    line("block" + n, prefix + "_B" + n);
    line("block" + n + "b", prefix + "_B" + n);
  }
  line("chart", prefix + "_Chart");
  line("chart2", prefix + "_Chart");
  line("g_dint", "DINT");
  line("g_real", "REAL");
  line("g_string", "STRING");
  line("at_dword", "DWORD");
  line("at_int", "INT");
  line("bound", "BOOL");
  for (const Lvalue& lvalue : all) line(lvalue.name, lvalue.type);
  lines.push_back(Stmt{"noise : ULINT := " + std::to_string(1 + seed % 2147483645) + ";\n"});
  return Fixed{more + "\1END_VAR\n", std::move(lines)};
}

}  // namespace

Node Generator::program() {
  std::vector<Node> parts;
  declareGlobals(prefix_, index_, codesys(), parts);
  for (int i = 0, n = 1 + below(2); i < n; ++i) parts.push_back(makeFunction(i));
  parts.push_back(makeAccess());
  const int blocks = 1 + below(2);
  for (int i = 0; i < blocks; ++i) parts.push_back(makeBlock(i));
  makeObjects(parts);
  makeClasses(parts);
  makeRecords(parts);
  parts.push_back(makeChart());
  body_ = Body::Program;
  own_inputs_.clear();

  // The same each time, from numbers that pass every check.
  std::vector<Node> inputs{Stmt{"noise := noise * 48271 MOD 2147483647;\n"}};
  for (int i = 0; i < 8; ++i) {
    const int type = chance(40) ? kReal + below(2) : anyType();
    const std::string name = kTypes[type].name;
    const std::string value = faults_ == Faults::Range
                                  ? "noise / " + std::to_string(1 + below(1000)) + " MOD 100"
                                  : "noise * 4294967297 / " + std::to_string(uint64_t{1} << below(60));
    inputs.push_back(kTypes[type].kind >= Kind::Letter
                         ? Stmt{"v_string := ULINT_TO_STRING(noise);\n"}
                         : Stmt{"v_" + lowered(kTypes[type].name) + " := ULINT_TO_" + name + "(" + value + ");\n"});
  }
  Node noise = Stmt{std::string(inputs.size(), kChild), std::move(inputs)};
  Node body = statements(3, (codesys() ? 14 : 6) + below(7));
  Node results = Fixed{"\1\1\1\1\1",
                       {Stmt{"g_dint := " + prefix_ + "_g_dint;\n"}, Stmt{"g_real := " + prefix_ + "_g_real;\n"},
                        Stmt{"g_string := " + prefix_ + "_g_string;\n"},
                        Stmt{"at_dword := " + prefix_ + "_at_dword;\n"}, Stmt{"at_int := " + prefix_ + "_at_int;\n"}}};
  std::string used = body.print() + results.print();
  const std::vector<Lvalue>& all = lvalues();
  Node bind = bindUsed(all, chance(60), used);
  used += bind.text;
  Node vars = declarations({&noise, &body, &bind});
  Node extra = declareUsed(prefix_, used, blocks, all, random());
  const std::string guard = "IF differential_only <> " + std::to_string(index_) +
                            (faults_ == Faults::None ? " AND differential_only >= 0" : "") + " THEN RETURN; END_IF\n";
  parts.push_back(Fixed{"PROGRAM " + prefix_ + "\n\1\1\1\1\1\1\1END_PROGRAM\n\n",
                        {std::move(vars), std::move(extra), Stmt{guard}, std::move(bind), std::move(noise),
                         std::move(body), std::move(results)}});
  std::string text(parts.size(), kChild);
  return Fixed{std::move(text), std::move(parts)};
}

namespace {

void append(const Node& node, std::string& out) {
  if (node.simplified) {
    out += node.simple;
    return;
  }
  if (node.hoisted >= 0) return append(node.children[static_cast<size_t>(node.hoisted)], out);
  size_t next = 0;
  for (const char c : node.text) {
    if (c == kChild) {
      append(node.children[next++], out);
    } else {
      out += c;
    }
  }
}

}  // namespace

std::string Node::print() const {
  std::string out;
  append(*this, out);
  return out;
}

Node generate(uint64_t seed, unsigned index, Faults faults, Dialect dialect) {
  return Generator(seed, index, faults, dialect).program();
}

}  // namespace rung::differential

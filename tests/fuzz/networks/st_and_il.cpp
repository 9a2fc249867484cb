// SPDX-License-Identifier: Apache-2.0
// A block as ST, the reference, and as IL: both follow the actions one by one and share nothing with the scheduler.
#include <algorithm>

#include "tests/fuzz/networks/logic.h"

namespace rung::network_differential {
namespace {

struct Word {
  const char *name, *sign;
};
constexpr Word kSigns[] = {{"AND", "AND"}, {"OR", "OR"}, {"XOR", "XOR"}, {"ADD", "+"}, {"SUB", "-"},
                           {"MUL", "*"},   {"DIV", "/"}, {"MOD", "MOD"}, {"GT", ">"},  {"GE", ">="},
                           {"LT", "<"},    {"LE", "<="}, {"EQ", "="},    {"NE", "<>"}};

std::string signOf(const std::string& name) {
  for (const Word& word : kSigns)
    if (name == word.name) return word.sign;
  return {};
}

class Printer {
 public:
  explicit Printer(const Logic& logic) : logic_(logic), done_(logic.nodes.size(), false) {}
  std::string text(const std::string& name, bool list);

 private:
  const Node& node(int n) const { return logic_.nodes[static_cast<size_t>(n)]; }
  static std::string kept(int n) { return "t" + std::to_string(n); }
  std::string temporary(Type type) {
    const std::string name = "i" + std::to_string(temporaries_++);
    variables_ += name + " : " + typeName(type) + "; ";
    return name;
  }
  std::string outputOf(int action, const std::string& pin) const;
  std::string enableOf(const Action& a) const;

  // ST
  void demand(int n);
  std::string expr(int n) const;
  std::string call(const Node& n, int self) const;
  void action(int number);
  void items(const std::vector<Item>& items);

  // IL
  std::string load(int n);     // leaves the value in the accumulator; writes its prerequisites at once
  std::string operand(int n);  // a variable or literal
  std::string compute(int n);
  void listed(int number);
  void listedItems(const std::vector<Item>& items);

  const Logic& logic_;
  std::vector<bool> done_;  // computed into its variable
  std::string out_, variables_, jump_;
  unsigned temporaries_ = 0, labels_ = 0;
};

std::string Printer::outputOf(int action, const std::string& pin) const {
  const Action& a = logic_.actions[static_cast<size_t>(action)];
  if (a.kind == ActionKind::Block && pin != "ENO") return a.instance + "." + pin;
  return "o" + std::to_string(action) + "_" + pin;
}

// A condition that is FALSE while a variable at an output of a block keeps its value, because the block does not run;
// else empty.
std::string Printer::enableOf(const Action& a) const {
  if (a.kind != ActionKind::Assign && a.kind != ActionKind::Set && a.kind != ActionKind::Reset &&
      a.kind != ActionKind::Pulse)
    return {};
  const Node& n = node(a.value);
  const bool is_output = n.kind == NodeKind::Pin && n.text != "ENO";
  return is_output && logic_.actions[static_cast<size_t>(n.action)].en >= 0 ? outputOf(n.action, "ENO") : std::string();
}

// ---- ST

std::string Printer::call(const Node& n, int self) const {
  std::string text = n.text + "(";
  for (size_t k = 0; k < n.operands.size(); ++k)
    text += (k > 0 ? ", " : "") + (n.operands[k] == kSelf ? kept(self) : expr(n.operands[k]));
  return text + ")";
}

std::string Printer::expr(int number) const {
  const Node& n = node(number);
  if (done_[static_cast<size_t>(number)]) return kept(number);
  const auto of = [&](size_t k) { return n.operands[k] == kSelf ? kept(number) : expr(n.operands[k]); };
  switch (n.kind) {
    case NodeKind::Leaf: return n.text;
    case NodeKind::Not: return "(NOT " + of(0) + ")";
    case NodeKind::Operator: return "(" + of(0) + " " + signOf(n.text) + " " + of(1) + ")";
    case NodeKind::Function: return call(n, number);
    case NodeKind::Pin:
    case NodeKind::Last: return outputOf(n.action, n.text);
    case NodeKind::Edge: return n.text + ".Q";
  }
  return {};
}

// Computes nodes that are read more than once, and calls the edge detectors.
void Printer::demand(int number) {
  const Node& n = node(number);
  if (done_[static_cast<size_t>(number)]) return;
  for (const int operand : n.operands)
    if (operand >= 0) demand(operand);
  if (n.kind == NodeKind::Edge) out_ += n.text + "(CLK := " + expr(n.operands[0]) + ");\n";
  if (!n.shared() || n.kind == NodeKind::Leaf || n.kind == NodeKind::Pin) return;
  out_ += kept(number) + " := " + expr(number) + ";\n";
  done_[static_cast<size_t>(number)] = true;
}

void Printer::action(int number) {
  const Action& a = logic_.actions[static_cast<size_t>(number)];
  for (const Argument& argument : a.arguments)
    if (argument.node >= 0) demand(argument.node);
  if (a.value >= 0) demand(a.value);
  if (a.en >= 0) demand(a.en);
  const std::string value = a.value >= 0 ? expr(a.value) : std::string();
  std::string arguments;
  for (const Argument& argument : a.arguments)
    arguments += (arguments.empty() ? "" : ", ") + argument.pin +
                 " := " + (argument.node >= 0 ? expr(argument.node) : argument.variable);
  if (a.en >= 0) out_ += outputOf(number, "ENO") + " := " + expr(a.en) + ";\nIF " + outputOf(number, "ENO") + " THEN ";
  const std::string enable = enableOf(a);
  if (a.kind == ActionKind::Pulse) out_ += a.instance + "(CLK := " + value + ");\n";
  if (!enable.empty()) out_ += "IF " + enable + " THEN ";
  switch (a.kind) {
    case ActionKind::Assign: out_ += a.target + " := " + (a.negated ? "NOT " : "") + value + ";\n"; break;
    case ActionKind::Set: out_ += "IF " + value + " THEN " + a.target + " := TRUE; END_IF\n"; break;
    case ActionKind::Reset: out_ += "IF " + value + " THEN " + a.target + " := FALSE; END_IF\n"; break;
    case ActionKind::Pulse: out_ += a.target + " := " + a.instance + ".Q;\n"; break;
    case ActionKind::Block: out_ += a.instance + "(" + arguments + ");\n"; break;
    case ActionKind::Guarded: out_ += a.target + " := " + value + ";\n"; break;
    case ActionKind::Split:
      out_ += outputOf(number, "") + " := Split(" + arguments + ", rest => " + outputOf(number, "rest") + ", odd => " +
              outputOf(number, "odd") + ");\n";
      break;
    case ActionKind::Execute: out_ += a.target + " := " + a.target + " + " + value + ";\n"; break;
    case ActionKind::Evaluate: break;
    case ActionKind::Return: out_ += "IF " + value + " THEN RETURN; END_IF\n"; break;
    case ActionKind::Jump: jump_ = value; break;
  }
  if (a.en >= 0 || !enable.empty()) out_ += "END_IF\n";
}

void Printer::items(const std::vector<Item>& items) {
  for (const Item& item : items) {
    if (item.kind == Item::Skip) out_ += "IF NOT " + jump_ + " THEN\n";
    if (item.kind == Item::Loop) out_ += "REPEAT\n";
    for (const int number : item.actions) action(number);
    this->items(item.body);
    if (item.kind == Item::Skip) out_ += "END_IF\n";
    if (item.kind == Item::Loop) out_ += "UNTIL NOT " + jump_ + " END_REPEAT\n";
  }
}

// ---- IL

std::string Printer::operand(int number) {
  const Node& n = node(number);
  if (done_[static_cast<size_t>(number)]) return kept(number);
  if (n.kind == NodeKind::Leaf) return n.text;
  if (n.kind == NodeKind::Pin || n.kind == NodeKind::Last) return outputOf(n.action, n.text);
  const std::string code = load(number);
  if (done_[static_cast<size_t>(number)]) return kept(number);
  const std::string name = temporary(n.type);
  out_ += code + "ST " + name + "\n";
  return name;
}

std::string Printer::compute(int number) {
  const Node& n = node(number);
  const auto of = [&](size_t k) { return n.operands[k] == kSelf ? kept(number) : operand(n.operands[k]); };
  switch (n.kind) {
    case NodeKind::Leaf:
    case NodeKind::Pin:
    case NodeKind::Last: return "LD " + operand(number) + "\n";
    case NodeKind::Not: {
      if (node(n.operands[0]).kind == NodeKind::Leaf) return "LDN " + of(0) + "\n";
      return load(n.operands[0]) + "NOT\n";
    }
    case NodeKind::Operator: {
      const int right = n.operands[1];
      const bool negated = right >= 0 && node(right).kind == NodeKind::Not && !node(right).shared() &&
                           (n.text == "AND" || n.text == "OR" || n.text == "XOR");
      // A variable would cut an intermediate result to its type.
      const bool is_wide = right >= 0 && node(right).kind == NodeKind::Operator && node(right).type == Type::Int;
      const std::string code = is_wide && !done_[static_cast<size_t>(right)] ? load(right) : std::string();
      const bool is_nested = !code.empty() && !done_[static_cast<size_t>(right)];
      const std::string name = negated ? operand(node(right).operands[0]) : is_nested ? "(\n" + code + ")" : of(1);
      const std::string left = n.operands[0] == kSelf ? "LD " + kept(number) + "\n" : load(n.operands[0]);
      return left + n.text + (negated ? "N " : is_nested ? "" : " ") + name + "\n";
    }
    case NodeKind::Function: {
      std::string rest;
      for (size_t k = 1; k < n.operands.size(); ++k) rest += (k > 1 ? ", " : " ") + of(k);
      const std::string first = n.operands[0] == kSelf ? "LD " + kept(number) + "\n" : load(n.operands[0]);
      return first + n.text + rest + "\n";
    }
    case NodeKind::Edge: {
      const std::string clk = load(n.operands[0]);
      out_ += clk + "ST " + n.text + ".CLK\nCAL " + n.text + "\n";
      return "LD " + n.text + ".Q\n";
    }
  }
  return {};
}

std::string Printer::load(int number) {
  const Node& n = node(number);
  if (done_[static_cast<size_t>(number)]) return "LD " + kept(number) + "\n";
  const std::string code = compute(number);
  if (!n.shared() || n.kind == NodeKind::Leaf || n.kind == NodeKind::Pin) return code;
  out_ += code + "ST " + kept(number) + "\n";
  done_[static_cast<size_t>(number)] = true;
  return "LD " + kept(number) + "\n";
}

void Printer::listed(int number) {
  const Action& a = logic_.actions[static_cast<size_t>(number)];
  std::string arguments;
  for (const Argument& argument : a.arguments)
    arguments += (arguments.empty() ? "" : ", ") + argument.pin +
                 " := " + (argument.node >= 0 ? operand(argument.node) : argument.variable);
  std::string value = a.value >= 0 ? load(a.value) : std::string();
  std::string after;
  if (a.en >= 0) {
    if (!value.empty()) {
      const std::string name = temporary(node(a.value).type);
      out_ += value + "ST " + name + "\n";
      value = "LD " + name + "\n";
    }
    after = "e" + std::to_string(labels_++);
    out_ += load(a.en);
    out_ += "ST " + outputOf(number, "ENO") + "\nJMPCN " + after + "\n";
  }
  if (a.kind == ActionKind::Pulse) {
    out_ += value + "ST " + a.instance + ".CLK\nCAL " + a.instance + "\n";
    value = "LD " + a.instance + ".Q\n";
  }
  if (const std::string enable = enableOf(a); !enable.empty()) {
    after = "e" + std::to_string(labels_++);
    out_ += "LD " + enable + "\nJMPCN " + after + "\n";
  }
  switch (a.kind) {
    case ActionKind::Assign: out_ += value + (a.negated ? "STN " : "ST ") + a.target + "\n"; break;
    case ActionKind::Set: out_ += value + "S " + a.target + "\n"; break;
    case ActionKind::Reset: out_ += value + "R " + a.target + "\n"; break;
    case ActionKind::Pulse: out_ += value + "ST " + a.target + "\n"; break;
    case ActionKind::Block: out_ += "CAL " + a.instance + "(" + arguments + ")\n"; break;
    case ActionKind::Guarded: out_ += value + "ST " + a.target + "\n"; break;
    case ActionKind::Split:
      out_ += "Split(" + arguments + ", rest => " + outputOf(number, "rest") + ", odd => " + outputOf(number, "odd") +
              ")\nST " + outputOf(number, "") + "\n";
      break;
    case ActionKind::Execute: out_ += "LD " + a.target + "\nADD " + operand(a.value) + "\nST " + a.target + "\n"; break;
    case ActionKind::Evaluate: break;
    case ActionKind::Return: out_ += value + "RETC\n"; break;
    case ActionKind::Jump: out_ += value + "JMPC " + a.target + "\n"; break;
  }
  if (!after.empty()) out_ += after + ":\n";
}

void Printer::listedItems(const std::vector<Item>& items) {
  for (const Item& item : items) {
    if (item.kind == Item::Loop) out_ += item.label + ":\n";
    for (const int number : item.actions) listed(number);
    listedItems(item.body);
    if (item.kind == Item::Skip) out_ += item.label + ":\n";
  }
}

std::string Printer::text(const std::string& name, bool list) {
  for (size_t k = 0; k < logic_.nodes.size(); ++k) {
    const Node& n = logic_.nodes[k];
    if (n.shared() && n.kind != NodeKind::Leaf && n.kind != NodeKind::Pin)
      variables_ += kept(static_cast<int>(k)) + " : " + typeName(n.type) + "; ";
  }
  for (size_t k = 0; k < logic_.actions.size(); ++k) {
    const Action& a = logic_.actions[k];
    if (a.en >= 0) variables_ += outputOf(static_cast<int>(k), "ENO") + " : BOOL; ";
    if (a.kind == ActionKind::Split)
      variables_ += outputOf(static_cast<int>(k), "") + " : DINT; " + outputOf(static_cast<int>(k), "rest") +
                    " : INT; " + outputOf(static_cast<int>(k), "odd") + " : BOOL; ";
  }
  if (list)
    listedItems(logic_.items);
  else
    items(logic_.items);
  std::string text = "FUNCTION_BLOCK " + name + "\n" + declarations(logic_);
  if (!variables_.empty()) text += "VAR " + variables_ + "END_VAR\n";
  return text + out_ + "END_FUNCTION_BLOCK\n";
}

}  // namespace

const char* typeName(Type type) {
  static const char* const kNames[] = {"BOOL", "INT", "DINT", "REAL", "TIME"};
  return kNames[static_cast<size_t>(type)];
}

std::string declarations(const Logic& logic) {
  return "VAR_INPUT a, b, c, d : BOOL; i, j : DINT; k, which : INT; x : REAL; END_VAR\n"
         "VAR_OUTPUT p, q, r, s : BOOL; u, v : INT; m, n : DINT; y, z : REAL; END_VAR\n"
         "VAR mem : Memory; bits : ARRAY[0..2] OF BOOL; list : ARRAY[1..2] OF DINT; w : WORD; t0 : TON; " +
         logic.variables + "END_VAR\n";
}

std::string structuredText(const Logic& logic, const std::string& name) { return Printer(logic).text(name, false); }
std::string instructionList(const Logic& logic, const std::string& name) { return Printer(logic).text(name, true); }

}  // namespace rung::network_differential

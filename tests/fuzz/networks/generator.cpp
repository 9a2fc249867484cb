// SPDX-License-Identifier: Apache-2.0
// Generates the logic of a block: see logic.h.
#include <algorithm>
#include <initializer_list>
#include <map>
#include <numeric>

#include "tests/fuzz/generated/options.h"
#include "tests/fuzz/networks/logic.h"

namespace rung::network_differential {
namespace {

class Generator {
 public:
  explicit Generator(uint64_t seed) : state_(seed * 2 + 1) {}
  Logic run();

 private:
  unsigned below(unsigned n) { return static_cast<unsigned>(generated::nextRandom(state_) % n); }
  bool chance(unsigned percent) { return below(100) < percent; }
  std::string pick(std::initializer_list<const char*> words) {
    return words.begin()[below(static_cast<unsigned>(words.size()))];
  }
  Type anyType() { return chance(50) ? Type::Bool : static_cast<Type>(1 + below(3)); }

  int add(Node node) {
    logic_.nodes.push_back(std::move(node));
    return static_cast<int>(logic_.nodes.size()) - 1;
  }
  int make(NodeKind kind, Type type, const std::string& text, std::vector<int> operands) {
    Node n;
    n.kind = kind;
    n.type = type;
    n.text = text;
    n.operands = std::move(operands);
    return add(n);
  }
  int leaf(Type type, bool literals);
  int expr(Type type, int depth);
  int fresh(Type type, int depth);
  int function(Type type, int depth);
  int edge(int operand);
  int feedback(Type type);
  std::string target(Type type);
  std::string instance(const std::string& type);
  int act(const Action& action) {
    logic_.actions.push_back(action);
    actions_.push_back(static_cast<int>(logic_.actions.size()) - 1);
    return actions_.back();
  }
  int pin(int action, Type type, const std::string& text) {
    const int node = make(NodeKind::Pin, type, text, {});
    logic_.nodes[static_cast<size_t>(node)].action = action;
    offered_.push_back(node);
    return node;
  }

  void action();
  void assignment();
  void block();
  void guarded();
  void split();
  void execute();
  void evaluate();
  void items(std::vector<Item>& out, int depth, unsigned count);
  void closeNetwork(std::vector<Item>& out);
  void count(int node);

  uint64_t state_;
  Logic logic_;
  std::vector<int> actions_;  // of the open network
  std::vector<int> offered_;  // nodes of the open network that others may read too
  unsigned instances_ = 0, labels_ = 0, returns_ = 0;
};

int Generator::leaf(Type type, bool literals) {
  Node n;
  n.type = type;
  if (literals && chance(25) && type != Type::Bool) {
    n.literal = true;
    n.text = type == Type::Real ? pick({"0.5", "2.0", "-1.25", "100.0"}) : pick({"1", "2", "7", "-3", "100", "16#1F"});
    return add(n);
  }
  switch (type) {
    case Type::Bool:
      n.text = chance(5) ? pick({"TRUE", "FALSE"})
                         : pick({"a", "b", "c", "d", "p", "q", "r", "s", "mem.flag", "bits[1]", "w.3", "t0.Q"});
      break;
    case Type::Int: n.text = pick({"k", "u", "v", "mem.small", "which"}); break;
    case Type::Dint: n.text = pick({"i", "j", "m", "n", "list[1]", "list[2]"}); break;
    case Type::Real: n.text = pick({"x", "y", "z"}); break;
    case Type::Time: n.text = pick({"T#20ms", "T#30ms", "T#55ms"}); break;
  }
  return add(n);
}

std::string Generator::target(Type type) {
  switch (type) {
    case Type::Bool: return pick({"p", "q", "r", "s", "mem.flag", "bits[1]", "w.3"});
    case Type::Int: return pick({"u", "v", "mem.small"});
    case Type::Dint: return pick({"m", "n", "list[1]", "list[2]"});
    case Type::Real: return pick({"y", "z"});
    case Type::Time: break;
  }
  return {};
}

std::string Generator::instance(const std::string& type) {
  const std::string name = "f" + std::to_string(instances_++);
  logic_.variables += name + " : " + type + "; ";
  return name;
}

int Generator::edge(int operand) {
  Node n;
  n.kind = NodeKind::Edge;
  n.rising = chance(60);
  n.operands = {operand};
  n.text = instance(n.rising ? "R_TRIG" : "F_TRIG");
  return add(n);
}

int Generator::function(Type type, int depth) {
  std::vector<int> in;
  std::vector<std::string> pins;
  std::string name;
  const auto put = [&](const char* pin, int node) {
    pins.emplace_back(pin);
    in.push_back(node);
  };
  switch (below(type == Type::Real ? 5 : 6)) {
    case 0:
      name = pick({"MAX", "MIN"});
      put("IN1", expr(type, depth - 1));
      put("IN2", leaf(type, true));
      if (chance(50)) put("IN3", leaf(type, true));
      break;
    case 1:
      name = "SEL";
      put("G", expr(Type::Bool, depth - 1));
      put("IN0", expr(type, depth - 1));
      put("IN1", expr(type, depth - 1));
      break;
    case 2: {
      name = "LIMIT";
      const bool real = type == Type::Real;
      Node low, high;
      low.type = high.type = type;
      low.literal = high.literal = true;
      low.text = real ? "-10.0" : "-5";
      high.text = real ? "10.0" : "90";
      const int mn = add(low), mx = add(high);
      put("MN", mn);
      put("IN", expr(type, depth - 1));
      put("MX", mx);
      break;
    }
    case 3: {
      name = "MUX";
      Node k;
      k.type = Type::Int;
      k.text = "which";
      put("K", add(k));
      put("IN0", expr(type, depth - 1));
      put("IN1", expr(type, depth - 1));
      put("IN2", leaf(type, false));
      break;
    }
    case 4:
      name = type == Type::Real ? "INT_TO_REAL" : type == Type::Dint ? "INT_TO_DINT" : "DINT_TO_INT";
      put("IN", expr(type == Type::Int ? Type::Dint : Type::Int, depth - 1));
      break;
    default:
      if (type == Type::Dint) return make(NodeKind::Operator, type, "ADD", {expr(type, depth - 1), leaf(type, true)});
      name = "Blend";
      put("first", expr(Type::Bool, depth - 1));
      put("one", expr(type, depth - 1));
      put("two", leaf(type, false));
      break;
  }
  const int node = make(NodeKind::Function, type, name, in);
  logic_.nodes[static_cast<size_t>(node)].pins = pins;
  return node;
}

// A node without readers yet.
int Generator::fresh(Type type, int depth) {
  if (depth <= 0 || chance(15)) return leaf(type, false);
  if (type == Type::Bool) {
    switch (below(10)) {
      case 0:
      case 1: {
        const Type of = static_cast<Type>(1 + below(3));
        static const char* const kOps[] = {"GT", "GE", "LT", "LE", "EQ", "NE"};
        const char* op = kOps[below(of == Type::Real ? 4 : 6)];
        const int left = expr(of, depth - 1);
        return make(NodeKind::Operator, type, op, {left, chance(50) ? leaf(of, true) : expr(of, depth - 1)});
      }
      case 2: return make(NodeKind::Not, type, "", {chance(50) ? leaf(type, false) : expr(type, depth - 1)});
      case 3: return edge(chance(70) ? leaf(type, false) : expr(type, depth - 1));
      case 4: return make(NodeKind::Operator, type, "XOR", {expr(type, depth - 1), expr(type, depth - 1)});
      default: {
        const char* op = chance(50) ? "AND" : "OR";
        return make(NodeKind::Operator, type, op, {expr(type, depth - 1), expr(type, depth - 1)});
      }
    }
  }
  if (chance(40)) return function(type, depth);
  const int left = expr(type, depth - 1);
  switch (below(type == Type::Real ? 3 : 5)) {
    case 0: return make(NodeKind::Operator, type, "ADD", {left, chance(50) ? leaf(type, true) : expr(type, depth - 1)});
    case 1: return make(NodeKind::Operator, type, "SUB", {left, chance(50) ? leaf(type, true) : expr(type, depth - 1)});
    case 2: return make(NodeKind::Operator, type, "MUL", {left, chance(50) ? leaf(type, true) : expr(type, depth - 1)});
    default: {
      Node by;
      by.type = type;
      by.literal = true;
      by.text = pick({"3", "7", "-5"});
      const int divisor = add(by);
      return make(NodeKind::Operator, type, chance(50) ? "DIV" : "MOD", {left, divisor});
    }
  }
}

// An existing node of the open network, or a new one.
int Generator::expr(Type type, int depth) {
  if (chance(25)) {
    std::vector<int> fitting;
    for (const int node : offered_)
      if (logic_.nodes[static_cast<size_t>(node)].type == type) fitting.push_back(node);
    if (!fitting.empty()) return fitting[below(static_cast<unsigned>(fitting.size()))];
  }
  const int node = fresh(type, depth);
  const Node& n = logic_.nodes[static_cast<size_t>(node)];
  // A variable that the network may write is read again each time; inputs of the block are never written.
  const bool constant =
      n.kind == NodeKind::Leaf && !n.literal && n.text.size() == 1 && n.text.find_first_of("abcdijkx") == 0;
  if ((n.kind != NodeKind::Leaf || constant) && chance(35)) offered_.push_back(node);
  return node;
}

// An operator or function that reads its own value of the last cycle.
int Generator::feedback(Type type) {
  const int other = expr(type, 1);
  Node n;
  n.type = type;
  n.keeps = true;
  n.kind = NodeKind::Operator;
  n.operands = {other, kSelf};
  if (chance(40)) std::swap(n.operands[0], n.operands[1]);
  if (type == Type::Bool) {
    n.text = pick({"AND", "OR", "XOR"});
  } else if (chance(60)) {
    n.text = pick({"ADD", "SUB"});
  } else {
    n.kind = NodeKind::Function;
    n.text = "SEL";
    n.pins = {"G", "IN0", "IN1"};
    n.operands.insert(n.operands.begin(), leaf(Type::Bool, false));
  }
  const int node = add(n);
  offered_.push_back(node);
  return node;
}

void Generator::assignment() {
  Action a{};
  const Type type = anyType();
  a.value = chance(12) ? feedback(type) : expr(type, 3);
  a.target = target(type);
  a.kind = ActionKind::Assign;
  if (type == Type::Bool) {
    const unsigned what = below(10);
    if (what < 2) a.kind = what == 0 ? ActionKind::Set : ActionKind::Reset;
    if (what == 2) {
      a.kind = ActionKind::Pulse;
      a.rising = chance(50);
      a.instance = instance(a.rising ? "R_TRIG" : "F_TRIG");
    }
    a.negated = a.kind == ActionKind::Assign && chance(20);
  }
  act(a);
}

void Generator::block() {
  Action a{};
  a.kind = ActionKind::Block;
  struct Pins {
    std::string name;
    Type type;
  };
  std::vector<Pins> in, out;
  switch (below(8)) {
    case 0:
      a.type = pick({"TON", "TOF", "TP"}), in = {{"IN", Type::Bool}, {"PT", Type::Time}}, out = {{"Q", Type::Bool}};
      break;
    case 1: a.type = "SR", in = {{"SET1", Type::Bool}, {"RESET", Type::Bool}}, out = {{"Q1", Type::Bool}}; break;
    case 2: a.type = "RS", in = {{"SET", Type::Bool}, {"RESET1", Type::Bool}}, out = {{"Q1", Type::Bool}}; break;
    case 3: a.type = "CTU", in = {{"CU", Type::Bool}, {"RESET", Type::Bool}}, out = {{"Q", Type::Bool}}; break;
    case 4: a.type = pick({"R_TRIG", "F_TRIG"}), in = {{"CLK", Type::Bool}}, out = {{"Q", Type::Bool}}; break;
    case 5: a.type = "Scale", in = {{"go", Type::Bool}}, out = {{"done", Type::Bool}}; break;
    default:
      a.type = "Accumulate", in = {{"step", Type::Int}, {"clear", Type::Bool}},
      out = {{"sum", Type::Dint}, {"odd", Type::Bool}};
      break;
  }
  a.instance = instance(a.type);
  a.nameless = chance(25);
  const int self = static_cast<int>(logic_.actions.size());
  for (const Pins& pin : in) {
    if (in.size() > 1 && pin.type != Type::Time && chance(15)) continue;  // keeps its value
    int node = pin.type == Type::Time ? leaf(pin.type, false) : expr(pin.type, 2);
    if (pin.type == Type::Bool && chance(20)) {
      const int last = make(NodeKind::Last, Type::Bool, out.back().name, {});
      logic_.nodes[static_cast<size_t>(last)].action = self;
      node = make(NodeKind::Operator, Type::Bool, "AND", {node, make(NodeKind::Not, Type::Bool, "", {last})});
    }
    a.arguments.push_back({pin.name, node, {}});
  }
  if (a.type == "CTU") {
    Node three;
    three.type = Type::Int;
    three.literal = true;
    three.text = "3";
    a.arguments.push_back({"PV", add(three), {}});
  }
  if (a.type == "Scale") a.arguments.push_back({"value", kNone, target(Type::Dint)});
  if (chance(30)) a.en = expr(Type::Bool, 2);
  const int number = act(a);
  for (const Pins& pin : out) {
    this->pin(number, pin.type, pin.name);
    logic_.actions[static_cast<size_t>(number)].outputs.push_back(pin.name);
  }
  if (a.en != kNone && chance(50)) pin(number, Type::Bool, "ENO");
}

void Generator::guarded() {
  Action a{};
  a.kind = ActionKind::Guarded;
  const Type type = static_cast<Type>(1 + below(3));
  const int left = expr(type, 2);
  a.value = chance(50) ? make(NodeKind::Operator, type, pick({"ADD", "SUB", "MUL"}), {left, leaf(type, true)})
                       : function(type, 2);
  if (logic_.nodes[static_cast<size_t>(a.value)].kind == NodeKind::Operator && chance(20))
    a.value = make(NodeKind::Operator, type, "ADD", {left, leaf(type, true)});
  a.target = target(type);
  a.en = expr(Type::Bool, 2);
  const int number = act(a);
  if (chance(50)) pin(number, Type::Bool, "ENO");
}

void Generator::split() {
  Action a{};
  a.kind = ActionKind::Split;
  a.type = "Split";
  a.arguments = {{"number", expr(Type::Dint, 2), {}}, {"unit", expr(Type::Int, 1), {}}};
  const int number = act(a);
  pin(number, Type::Dint, "");
  pin(number, Type::Int, "rest");
  pin(number, Type::Bool, "odd");
}

void Generator::execute() {
  Action a{};
  a.kind = ActionKind::Execute;
  const Type type = static_cast<Type>(1 + below(3));
  a.target = target(type);
  a.value = leaf(type, true);
  if (chance(70)) a.en = expr(Type::Bool, 2);
  const int number = act(a);
  if (a.en != kNone && chance(40)) pin(number, Type::Bool, "ENO");
}

// Executes a function on its own, before its readers.
void Generator::evaluate() {
  Action a{};
  a.kind = ActionKind::Evaluate;
  const Type type = static_cast<Type>(1 + below(3));
  a.value = function(type, 2);
  logic_.nodes[static_cast<size_t>(a.value)].forced = true;
  offered_.push_back(a.value);
  act(a);
  if (chance(70)) {  // its operands change before it is read
    for (unsigned k = 1 + below(2); k > 0; --k) assignment();
    Action late{};
    late.kind = ActionKind::Assign;
    late.value = a.value;
    late.target = target(type);
    act(late);
  }
}

void Generator::action() {
  const unsigned what = below(100);
  if (what < 50) return assignment();
  if (what < 70) return block();
  if (what < 78) return guarded();
  if (what < 84) return split();
  if (what < 90) return execute();
  if (what < 97 || returns_ > 0) return evaluate();
  ++returns_;
  Action a{};
  a.kind = ActionKind::Return;
  a.value = make(NodeKind::Operator, Type::Bool, "AND", {leaf(Type::Bool, false), expr(Type::Bool, 1)});
  act(a);
}

void Generator::count(int node) {
  Node& n = logic_.nodes[static_cast<size_t>(node)];
  if (++n.uses > 1) return;
  for (const int operand : std::vector<int>(n.operands))
    if (operand >= 0) count(operand);
}

// In a file without network numbers, wires connect the elements of one network: each such part becomes a network.
void Generator::closeNetwork(std::vector<Item>& out) {
  std::map<int, int> owner;  // node: the first action that reads it
  std::vector<int> part(logic_.actions.size());
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](int k) {
    while (part[static_cast<size_t>(k)] != k) k = part[static_cast<size_t>(k)];
    return k;
  };
  const auto join = [&](int a, int b) {
    a = root(a);
    b = root(b);
    part[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
  };
  for (const int action : actions_) {
    const Action& a = logic_.actions[static_cast<size_t>(action)];
    std::vector<int> open;
    const auto want = [&](int node) {
      if (node >= 0) open.push_back(node);
    };
    want(a.value);
    want(a.en);
    for (const Argument& argument : a.arguments) want(argument.node);
    for (const int node : std::vector<int>(open)) count(node);
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      const Node& n = logic_.nodes[static_cast<size_t>(node)];
      if (n.action != kNone) join(action, n.action);
      if (const auto [at, is_new] = owner.emplace(node, action); !is_new) {
        join(action, at->second);
        continue;
      }
      for (const int operand : n.operands) want(operand);
    }
  }
  std::vector<int> parts;
  for (const int action : actions_)
    if (std::find(parts.begin(), parts.end(), root(action)) == parts.end()) parts.push_back(root(action));
  const int jump = actions_.empty() ? kNone : actions_.back();
  if (jump != kNone && logic_.actions[static_cast<size_t>(jump)].kind == ActionKind::Jump) {
    parts.erase(std::find(parts.begin(), parts.end(), root(jump)));
    parts.push_back(root(jump));
  }
  for (const int p : parts) {
    Item item;
    for (const int action : actions_)
      if (root(action) == p) item.actions.push_back(action);
    out.push_back(item);
  }
  actions_.clear();
  offered_.clear();
}

void Generator::items(std::vector<Item>& out, int depth, unsigned number) {
  for (unsigned k = 0; k < number; ++k) {
    const unsigned what = depth > 0 ? below(100) : 0;
    for (unsigned n = 1 + below(5); n > 0; --n) action();
    if (what < 75) {
      closeNetwork(out);
      continue;
    }
    Item item;
    item.label = "l" + std::to_string(labels_++);
    Action jump{};
    jump.kind = ActionKind::Jump;
    jump.target = item.label;
    if (what < 90) {
      jump.value = expr(Type::Bool, 2);
      act(jump);
      closeNetwork(out);
      item.kind = Item::Skip;
      items(item.body, depth - 1, 1 + below(2));
    } else {
      const std::string counter = item.label + "n";
      logic_.variables += counter + " : INT; ";
      const auto step = [&](bool begins) {
        Node from, one;
        from.type = one.type = Type::Int;
        from.text = begins ? "k" : counter;
        one.literal = true;
        one.text = "1";
        Action a{};
        a.kind = ActionKind::Assign;
        a.target = counter;
        const int left = add(from), right = begins ? left : add(one);
        a.value = make(NodeKind::Operator, Type::Int, begins ? "SUB" : "ADD",
                       {left, begins ? leaf(Type::Int, false) : right});
        if (begins)
          logic_.nodes[static_cast<size_t>(logic_.nodes[static_cast<size_t>(a.value)].operands[1])].text = "k";
        act(a);
      };
      step(true);
      closeNetwork(out);
      item.kind = Item::Loop;
      items(item.body, 0, 1 + below(2));
      step(false);
      Node iterations, limit;
      iterations.type = limit.type = Type::Int;
      iterations.text = counter;
      limit.literal = true;
      limit.text = std::to_string(2 + below(3));
      const int left = add(iterations);
      jump.value = make(NodeKind::Operator, Type::Bool, "LT", {left, add(limit)});
      act(jump);
      closeNetwork(item.body);
    }
    out.push_back(item);
  }
}

Logic Generator::run() {
  items(logic_.items, 2, 2 + below(4));
  return logic_;
}

}  // namespace

Logic generate(uint64_t seed) { return Generator(seed).run(); }

}  // namespace rung::network_differential

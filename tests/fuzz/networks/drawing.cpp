// SPDX-License-Identifier: Apache-2.0
// Draws the logic of a block in LD, FBD or CFC: see drawing.h.
#include "tests/fuzz/networks/drawing.h"

#include <algorithm>
#include <map>

#include "tests/fuzz/generated/options.h"

namespace rung::network_differential {
namespace {

class Drawer {
 public:
  Drawer(const Logic& logic, Language language, uint64_t seed)
      : logic_(logic), state_(seed * 8 + static_cast<uint64_t>(language)) {
    out_.language = language;
  }
  Drawing run();

 private:
  bool chance(unsigned percent) { return generated::nextRandom(state_) % 100 < percent; }
  bool ladder() const { return out_.language == Language::Ladder; }
  const Node& node(int n) const { return logic_.nodes[static_cast<size_t>(n)]; }

  uint64_t put(Element e);
  Element element(const std::string& kind) {
    Element e;
    e.kind = kind;
    return e;
  }
  uint64_t boxOf(int action);
  uint64_t rail();
  uint64_t input(const std::string& text, bool negated);

  bool contactable(int n) const;
  Wires rung(int n, const Wires& in);
  Wires value(int n);
  Wires fresh(int n);
  Wires box(int n);
  void flatten(int n, const std::string& op, std::vector<int>& out) const;
  Pin pinFor(const std::string& name, int n);
  Pin output(const std::string& name) {
    Pin pin;
    pin.name = name;
    pin.output = true;
    return pin;
  }
  Pin plain(const Wires& wires) {
    Pin pin;
    pin.wires = wires;
    return pin;
  }

  void action(int number);
  void items(const std::vector<Item>& items);
  void label(const std::string& name);
  void connect();

  const Logic& logic_;
  uint64_t state_;
  Drawing out_;
  std::map<int, Wires> drawn_;              // shared nodes
  std::map<std::string, uint64_t> inputs_;  // of one action
  std::map<int, uint64_t> boxes_;           // of actions
  std::map<int, Wires> after_;              // LD: the last coil that takes a shared node
  uint64_t next_ = 1, rail_ = 0;
  unsigned network_ = 0, order_ = 0;
  int row_ = 0;
};

uint64_t Drawer::put(Element e) {
  if (e.number == 0) e.number = next_++;
  e.network = network_;
  const bool acts = e.kind == "box" || e.kind == "output" || e.kind == "coil" || e.kind == "jump" ||
                    e.kind == "label" || e.kind == "return" || e.kind == "execute";
  if (acts && out_.language == Language::Ordered) e.order = ++order_;
  e.x = 20 * static_cast<int>(out_.elements.size());
  e.y = 100 * row_ + static_cast<int>(generated::nextRandom(state_) % 50);
  out_.elements.push_back(e);
  return e.number;
}

uint64_t Drawer::boxOf(int action) {
  const auto [at, is_new] = boxes_.emplace(action, next_);
  if (is_new) ++next_;
  return at->second;
}

uint64_t Drawer::rail() {
  if (rail_ == 0) rail_ = put(element("rail"));
  return rail_;
}

uint64_t Drawer::input(const std::string& text, bool negated) {
  const std::string key = (negated ? "!" : "") + text;
  if (const auto found = inputs_.find(key); found != inputs_.end() && chance(60)) return found->second;
  Element e = element("input");
  e.operand = text;
  e.negated = negated;
  return inputs_[key] = put(e);
}

// True when the node can be drawn by contacts alone.
bool Drawer::contactable(int number) const {
  const Node& n = node(number);
  if (n.type != Type::Bool) return false;
  const auto isLeaf = [&](int leaf) {  // a shared one has a wire, which joins all its readers into one network
    return node(leaf).kind == NodeKind::Leaf && node(leaf).uses < 2;
  };
  if (n.kind == NodeKind::Leaf) return isLeaf(number);
  if (n.shared()) return false;
  switch (n.kind) {
    case NodeKind::Not:
    case NodeKind::Edge: return isLeaf(n.operands[0]);
    case NodeKind::Operator:
      if (n.text == "AND" || n.text == "OR") return contactable(n.operands[0]) && contactable(n.operands[1]);
      return n.text != "XOR" && isLeaf(n.operands[0]) && isLeaf(n.operands[1]);
    case NodeKind::Leaf:
    case NodeKind::Function:
    case NodeKind::Pin:
    case NodeKind::Last: break;
  }
  return false;
}

const char* signOf(const std::string& op) {
  return op == "GT"   ? " > "
         : op == "GE" ? " >= "
         : op == "LT" ? " < "
         : op == "LE" ? " <= "
         : op == "EQ" ? " = "
                      : " <> ";
}

Wires Drawer::rung(int number, const Wires& in) {
  const Node& n = node(number);
  if (n.kind == NodeKind::Operator && (n.text == "AND" || n.text == "OR")) {
    const Wires left = rung(n.operands[0], in);
    if (n.text == "AND") return rung(n.operands[1], left);
    Wires both = left;
    for (const Wire& wire : rung(n.operands[1], in)) both.push_back(wire);
    return both;
  }
  Element e = element("contact");
  const Node& leaf = n.kind == NodeKind::Leaf ? n : node(n.operands[0]);
  e.operand = n.kind == NodeKind::Operator ? leaf.text + signOf(n.text) + node(n.operands[1]).text : leaf.text;
  e.negated = n.kind == NodeKind::Not;
  if (n.kind == NodeKind::Edge) e.edge = n.rising ? Sense::Rising : Sense::Falling;
  e.pins = {plain(in)};
  return {{put(e), ""}};
}

void Drawer::flatten(int number, const std::string& op, std::vector<int>& out) const {
  const Node& n = node(number);
  const bool chain = op == "AND" || op == "OR" || op == "XOR" || op == "ADD" || op == "MUL";
  if (number == kSelf || !chain || n.kind != NodeKind::Operator || n.text != op || n.shared()) {
    out.push_back(number);
    return;
  }
  flatten(n.operands[0], op, out);
  out.push_back(n.operands[1]);
}

// An input pin that reads a node: an inversion or an edge may be a modifier of the pin.
Pin Drawer::pinFor(const std::string& name, int number) {
  Pin pin;
  pin.name = name;
  const Node& n = node(number);
  const bool marked = !n.shared() && (n.kind == NodeKind::Not || n.kind == NodeKind::Edge) && chance(60);
  if (marked && n.kind == NodeKind::Not) pin.negated = true;
  if (marked && n.kind == NodeKind::Edge) pin.edge = n.rising ? Sense::Rising : Sense::Falling;
  pin.wires = value(marked ? n.operands[0] : number);
  return pin;
}

Wires Drawer::box(int number) {
  const Node& n = node(number);
  Element e = element("box");
  e.name = n.kind == NodeKind::Not ? "NOT" : n.text;
  if (n.keeps) e.number = next_++;
  if (n.kind == NodeKind::Function) {
    for (size_t k = 0; k < n.operands.size(); ++k) {
      if (n.operands[k] == kSelf) {
        Pin pin;
        pin.name = n.pins[k];
        pin.wires = {{e.number, "OUT"}};
        e.pins.push_back(pin);
      } else {
        e.pins.push_back(pinFor(n.pins[k], n.operands[k]));
      }
    }
  } else {
    std::vector<int> operands;
    if (n.kind == NodeKind::Operator && !n.keeps) {
      flatten(n.operands[0], n.text, operands);
      operands.push_back(n.operands[1]);
    } else {
      operands = n.operands;
    }
    for (size_t k = 0; k < operands.size(); ++k) {
      const std::string name = operands.size() == 1 ? "IN" : "IN" + std::to_string(k + 1);
      if (operands[k] == kSelf) {
        Pin pin;
        pin.name = name;
        pin.wires = {{e.number, "OUT"}};
        e.pins.push_back(pin);
      } else {
        e.pins.push_back(pinFor(name, operands[k]));
      }
    }
  }
  e.pins.push_back(output("OUT"));
  return {{put(e), "OUT"}};
}

Wires Drawer::value(int number) {
  const Node& n = node(number);
  if (n.kind == NodeKind::Pin || n.kind == NodeKind::Last) {
    const Action& a = logic_.actions[static_cast<size_t>(n.action)];
    return {{boxOf(n.action), a.kind == ActionKind::Split && n.text.empty() ? "OUT" : n.text}};
  }
  if (!n.shared()) return fresh(number);
  if (const auto found = drawn_.find(number); found != drawn_.end()) return found->second;
  const Wires wires = fresh(number);
  return drawn_[number] = wires;
}

Wires Drawer::fresh(int number) {
  const Node& n = node(number);
  const bool is_contact = n.type == Type::Bool && (ladder() || chance(8));
  if (n.kind == NodeKind::Leaf) {
    if (is_contact) return rung(number, {{rail(), ""}});
    return {{input(n.text, false), ""}};
  }
  if (contactable(number) && is_contact) return rung(number, {{rail(), ""}});
  if (n.keeps) return box(number);
  if (ladder() && n.kind == NodeKind::Operator && (n.text == "AND" || n.text == "OR")) {
    const int left = n.operands[0], right = n.operands[1];
    if (n.text == "AND" && contactable(right)) return rung(right, value(left));
    if (n.text == "AND" && contactable(left)) return rung(left, value(right));
    if (n.text == "OR") {
      Wires both = value(left);
      for (const Wire& wire : value(right)) both.push_back(wire);
      return both;
    }
  }
  if (n.kind == NodeKind::Not && !n.shared() && node(n.operands[0]).kind == NodeKind::Leaf &&
      node(n.operands[0]).uses < 2 && chance(40))
    return {{input(node(n.operands[0]).text, true), ""}};
  if (n.kind == NodeKind::Not && chance(30)) {  // a negated output of the box
    const Node& inner = node(n.operands[0]);
    if (!inner.shared() && inner.kind == NodeKind::Operator && !(ladder() && contactable(n.operands[0]))) {
      const Wires wires = box(n.operands[0]);
      out_.elements.back().pins.back().negated = true;
      return wires;
    }
  }
  if (n.kind == NodeKind::Edge) {
    Element e = element("box");
    e.name = n.rising ? "R_TRIG" : "F_TRIG";
    if (chance(60)) e.operand = n.text;
    Pin clk;
    clk.name = "CLK";
    clk.wires = value(n.operands[0]);
    e.pins = {clk, output("Q")};
    return {{put(e), "Q"}};
  }
  return box(number);
}

void Drawer::action(int number) {
  const Action& a = logic_.actions[static_cast<size_t>(number)];
  inputs_.clear();
  ++row_;
  const bool is_bool = a.value >= 0 && node(a.value).type == Type::Bool;
  Element e;
  switch (a.kind) {
    case ActionKind::Evaluate: value(a.value); return;
    case ActionKind::Assign:
    case ActionKind::Set:
    case ActionKind::Reset:
    case ActionKind::Pulse: {
      const bool coil = a.kind != ActionKind::Assign || (is_bool && (ladder() ? chance(90) : chance(10)));
      e = element(coil ? "coil" : "output");
      const auto found = after_.find(a.value);
      Wires wires = coil && ladder() && found != after_.end() && chance(50) ? found->second : value(a.value);
      e.operand = a.target;
      e.negated = a.negated;
      if (a.kind == ActionKind::Set) e.storage = "set";
      if (a.kind == ActionKind::Reset) e.storage = "reset";
      if (a.kind == ActionKind::Pulse) e.edge = a.rising ? Sense::Rising : Sense::Falling;
      e.pins = {plain(wires)};
      const uint64_t own = put(e);
      if (coil && ladder() && node(a.value).shared()) after_[a.value] = {{own, ""}};
      return;
    }
    case ActionKind::Return:
    case ActionKind::Jump:
      e = element(a.kind == ActionKind::Jump ? "jump" : "return");
      if (a.kind == ActionKind::Jump) e.name = a.target;
      if (node(a.value).kind == NodeKind::Not && !node(a.value).shared() && chance(50)) {
        e.negated = true;
        e.pins = {plain(value(node(a.value).operands[0]))};
      } else {
        e.pins = {plain(value(a.value))};
      }
      put(e);
      return;
    case ActionKind::Execute:
      e = element("execute");
      e.number = boxOf(number);
      if (a.en >= 0) {
        e.pins.push_back(pinFor("EN", a.en));
        e.pins.push_back(output("ENO"));
      }
      e.statements = a.target + " := " + a.target + " + " + node(a.value).text + ";";
      put(e);
      return;
    case ActionKind::Block:
    case ActionKind::Split: {
      e = element("box");
      e.name = a.type;
      e.operand = a.kind == ActionKind::Block && !a.nameless ? a.instance : "";
      e.number = boxOf(number);
      if (a.en >= 0) e.pins.push_back(pinFor("EN", a.en));
      for (const Argument& argument : a.arguments) {
        if (argument.node >= 0) {
          e.pins.push_back(pinFor(argument.pin, argument.node));
          continue;
        }
        Element variable = element("inout");
        variable.operand = argument.variable;
        Pin pin;
        pin.name = argument.pin;
        pin.in_out = true;
        pin.wires = {{put(variable), ""}};
        e.pins.push_back(pin);
      }
      if (a.kind == ActionKind::Split) {
        e.pins.push_back(output("OUT"));
        e.pins.push_back(output("rest"));
        e.pins.push_back(output("odd"));
      }
      for (const std::string& pin : a.outputs) e.pins.push_back(output(pin));
      if (a.en >= 0) e.pins.push_back(output("ENO"));
      put(e);
      return;
    }
    case ActionKind::Guarded: {
      const Node& n = node(a.value);
      const Pin en = pinFor("EN", a.en);
      const uint64_t after = next_;
      box(a.value);  // and then EN
      (void)after;
      Element created = out_.elements.back();
      out_.elements.pop_back();
      if (created.order != 0) --order_;
      created.number = boxOf(number);
      created.pins.insert(created.pins.begin(), en);
      created.pins.push_back(output("ENO"));
      put(created);
      e = element("output");
      e.operand = a.target;
      e.pins = {plain({{created.number, "OUT"}})};
      (void)n;
      put(e);
      return;
    }
  }
}

void Drawer::label(const std::string& name) {
  ++network_;
  ++row_;
  rail_ = 0;
  Element e = element("label");
  e.name = name;
  put(e);
}

void Drawer::items(const std::vector<Item>& items) {
  for (const Item& item : items) {
    if (item.kind == Item::Loop) label(item.label);
    if (!item.actions.empty()) {
      ++network_;
      rail_ = 0;
      ++row_;
      drawn_.clear();
      after_.clear();
      if (chance(20)) {
        Element comment = element("comment");
        comment.statements = "network $'" + std::to_string(network_) + "$' <of> this & that";
        put(comment);
      }
      for (const int number : item.actions) action(number);
    }
    this->items(item.body);
    if (item.kind == Item::Skip) label(item.label);
  }
}

// Replaces some wires by connectors.
void Drawer::connect() {
  const size_t count = out_.elements.size();
  for (size_t k = 0; k < count; ++k) {
    for (size_t p = 0; p < out_.elements[k].pins.size(); ++p) {
      for (size_t w = 0; w < out_.elements[k].pins[p].wires.size(); ++w) {
        if (!chance(4)) continue;
        Element connector = element("connector"), continuation = element("continuation");
        network_ = out_.elements[k].network;
        row_ = out_.elements[k].y / 100;
        connector.name = continuation.name = "mark" + std::to_string(next_);
        connector.pins = {plain({out_.elements[k].pins[p].wires[w]})};
        const uint64_t number = put(connector);
        if (chance(30)) {
          out_.elements[k].pins[p].wires[w] = {number, ""};
          continue;
        }
        out_.elements[k].pins[p].wires[w] = {put(continuation), ""};
      }
    }
  }
}

Drawing Drawer::run() {
  items(logic_.items);
  connect();
  // Moves connectors into their networks, where they change nothing.
  std::stable_sort(out_.elements.begin(), out_.elements.end(),
                   [](const Element& a, const Element& b) { return a.network < b.network; });
  return out_;
}

}  // namespace

Drawing draw(const Logic& logic, Language language, uint64_t seed) { return Drawer(logic, language, seed).run(); }

namespace {

std::string modifiers(bool negated, Sense edge, const std::string& storage) {
  std::string text = negated ? " NOT" : "";
  if (edge != Sense::None) text += edge == Sense::Rising ? " RISING" : " FALLING";
  if (!storage.empty()) text += storage == "set" ? " SET" : " RESET";
  return text;
}

std::string notationOf(const Wires& wires) {
  std::string text;
  for (const Wire& wire : wires)
    text += (text.empty() ? "" : " OR ") + std::to_string(wire.from) + (wire.pin.empty() ? "" : "(" + wire.pin + ")");
  return text;
}

}  // namespace

std::string notation(const Logic& logic, const Drawing& drawing, const std::string& name, uint64_t seed) {
  uint64_t state = seed + 77;
  std::vector<Element> elements = drawing.elements;
  const bool ordered = drawing.language == Language::Ordered;
  const bool marked = !ordered && generated::nextRandom(state) % 2 == 0;  // NETWORK n;
  bool placed = false;
  if (ordered) {  // the file's order does not matter
    for (size_t k = elements.size(); k > 1; --k) std::swap(elements[k - 1], elements[generated::nextRandom(state) % k]);
  } else if (!marked && generated::nextRandom(state) % 3 == 0) {
    placed = true;
    for (size_t k = elements.size(); k > 1; --k) std::swap(elements[k - 1], elements[generated::nextRandom(state) % k]);
  }
  const char* word = drawing.language == Language::Ladder ? "LD" : drawing.language == Language::Blocks ? "FBD" : "CFC";
  std::string text = "FUNCTION_BLOCK " + name + "\n" + declarations(logic) + "{network " + word + "}\n";
  unsigned network = 0;
  for (const Element& e : elements) {
    if (marked && e.network != network) text += "NETWORK " + std::to_string(network = e.network) + ";\n";
    text += e.kind + " " + std::to_string(e.number);
    if (!e.name.empty()) text += " " + e.name;
    if (!e.operand.empty()) text += " (" + e.operand + ")";
    text += modifiers(e.negated, e.edge, e.storage);
    if (e.order != 0) text += " ORDER " + std::to_string(e.order);
    if (placed) text += " AT " + std::to_string(e.x) + ", " + std::to_string(e.y);
    if (e.kind == "comment") text += " '" + e.statements + "'";
    if (e.kind == "box" || e.kind == "execute") {
      text += " [";
      for (const Pin& pin : e.pins) {
        if (&pin != e.pins.data()) text += ", ";
        text += pin.name + modifiers(pin.negated, pin.edge, pin.storage);
        if (!pin.output) text += " := " + notationOf(pin.wires);
        if (pin.output || pin.in_out) text += " =>";
      }
      text += "]";
    } else if (!e.pins.empty()) {
      text += " := " + notationOf(e.pins[0].wires);
    }
    if (e.kind == "execute") text += " {network ST} " + e.statements + " {end_network}";
    text += ";\n";
  }
  return text + "{end_network}\nEND_FUNCTION_BLOCK\n";
}

}  // namespace rung::network_differential

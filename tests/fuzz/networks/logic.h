// SPDX-License-Identifier: Apache-2.0
// The common meaning of a generated block in all languages: networks of actions over expressions, with one execution
// order. An action evaluates what it needs and is not evaluated yet; a node with several readers is evaluated once.
// In: a seed. Called by main.cpp; printed by st_and_il.cpp (ST, the reference, and IL), drawn by drawing.cpp (LD, FBD,
// CFC).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rung::network_differential {

enum class Type : uint8_t { Bool, Int, Dint, Real, Time };
enum class NodeKind : uint8_t {
  Leaf,  // `text`: a variable or literal
  Not,
  Operator,  // `text`: AND, ADD, GT …
  Function,  // `text`: MAX, SEL, Blend …
  Pin,       // output `text` of `action`, which ran before
  Last,      // output `text` of `action`, which runs later: its value of the last cycle
  Edge,      // `text`: the R_TRIG or F_TRIG that senses the operand
};
constexpr int kNone = -1;
constexpr int kSelf = -2;  // operand: the node's own value of the last cycle

struct Node {
  NodeKind kind = NodeKind::Leaf;
  Type type = Type::Bool;
  std::string text;
  std::vector<int> operands;
  std::vector<std::string> pins;  // of a function
  int action = kNone;
  bool rising = true;
  bool literal = false;
  bool keeps = false;   // an operand is kSelf
  bool forced = false;  // an Evaluate action computes it
  int uses = 0;
  bool shared() const { return uses > 1 || keeps || forced; }
};

enum class ActionKind : uint8_t {
  Assign,  // target := value, or its negation
  Set,
  Reset,
  Pulse,     // target := edge of value, sensed by `instance`
  Block,     // call of `instance`, where `en` is TRUE
  Guarded,   // target := value, an operator or function, where `en` is TRUE
  Split,     // a function with several outputs
  Execute,   // target := target + value, where `en` is TRUE
  Evaluate,  // `value`, now
  Return,    // where value is TRUE
  Jump,      // to `target` where value is TRUE
};
struct Argument {
  std::string pin;
  int node = kNone;
  std::string variable;  // of an in-out
};
struct Action {
  ActionKind kind;
  int value = kNone;
  std::string target;
  bool negated = false, rising = true;
  bool nameless = false;  // the instance is used in no other network
  std::string type, instance;
  std::vector<Argument> arguments;
  std::vector<std::string> outputs;
  int en = kNone;
};

struct Item {
  enum Kind : uint8_t { Network, Skip, Loop } kind = Network;
  std::vector<int> actions;  // of a network
  std::vector<Item> body;    // Skip: the jump of the previous network goes past them. Loop: that of its last network
  std::string label;
};

struct Logic {
  std::vector<Node> nodes;
  std::vector<Action> actions;
  std::vector<Item> items;
  std::string variables;  // declarations besides those that all blocks have
};

Logic generate(uint64_t seed);

// FUNCTION_BLOCK name and its variables; temporaries() belong to ST and IL only.
std::string declarations(const Logic& logic);
std::string structuredText(const Logic& logic, const std::string& name);
std::string instructionList(const Logic& logic, const std::string& name);
const char* typeName(Type type);

}  // namespace rung::network_differential

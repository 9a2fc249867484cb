// SPDX-License-Identifier: Apache-2.0
// The condition of --stop-on: a BOOL expression over program variables, `Main.n >= 10 AND NOT Main.busy`. In: its
// source and the symbols. Out: its current value, or an error message. Called by run.cpp.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "symbols.h"

namespace rung::host {

// Takes paths as in --watch, literals, parentheses, and these operators of ST with their precedence:
// NOT, < > <= >=, = <>, AND &, XOR, OR. A literal has the type of the variable that it is compared with.
class Condition {
 public:
  explicit Condition(const Symbols& symbols) : symbols_(symbols) {}

  // False: `error` has the message.
  bool parse(std::string_view text, std::string& error);
  // A comparison through a null pointer is FALSE.
  bool holds() const { return value(root_); }

 private:
  enum class Kind : uint8_t { Variable, Literal, Not, And, Xor, Or, Compare };
  enum class Relation : uint8_t { Equal, Unequal, Less, Greater, LessEqual, GreaterEqual };
  struct Node {
    Kind kind = Kind::Literal;
    Relation relation = Relation::Equal;
    uint32_t left = 0, right = 0;  // nodes
    Variable variable;             // of a literal: once its type is known, in `storage_`
    std::string text;              // as written
    std::string unknown;           // of a name that is not a variable; it may be an item of an enumeration
  };

  bool parseBinary(uint32_t level, uint32_t depth, uint32_t& node);
  bool parseUnary(uint32_t depth, uint32_t& node);
  bool parseOperand(uint32_t& node);
  bool compare(Relation relation, uint32_t left, uint32_t right, uint32_t& node);
  bool giveType(uint32_t literal, const rung_type& type);
  bool needBool(uint32_t node);
  bool isBool(uint32_t node) const;
  bool isUntyped(uint32_t node) const;
  bool value(uint32_t node) const;
  bool compared(const Node& node) const;
  uint32_t add(Kind kind, uint32_t left, uint32_t right);
  void skipBlanks();
  bool takeSymbol(std::string_view symbol);
  bool takeWord(std::string_view word);
  bool fail(std::string what);

  const Symbols& symbols_;
  std::string_view rest_;
  std::string error_;
  std::vector<Node> nodes_;
  std::deque<std::vector<uint8_t>> storage_;  // values of literals
  std::vector<void*> literal_blocks_;         // a block for each
  rung_context literals_{};
  uint32_t root_ = 0;
};

}  // namespace rung::host

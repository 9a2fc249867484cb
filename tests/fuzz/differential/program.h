// SPDX-License-Identifier: Apache-2.0
// A generated program as a tree of text, so that the shrinker can take pieces out of it.
// In: a seed. Out: equal text for equal seeds, on every machine. Called by main.cpp; shrink.cpp changes the nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frontend/source/dialect.h"

namespace rung::differential {

// The character in Node::text at which the next child is printed.
constexpr char kChild = '\1';

struct Node {
  std::string text;
  std::vector<Node> children;
  std::string simple;  // may replace the node: a literal for an expression, nothing for a statement
  bool fixed = false;  // part of its parent: neither left out nor simplified
  int type = -1;       // of an expression; a child of the same type may replace its parent
  bool simplified = false;
  int hoisted = -1;  // the child that is printed instead of this node

  std::string print() const;
};

enum class Faults : uint8_t { None, Division, Index, Range };  // how the program may end
enum class Dialect : uint8_t { Codesys, Iec3, Iec2 };

// The POUs of one PROGRAM called `P<index>`, whose names all begin with that. It does nothing unless the global
// `differential_only` has its index, or -1 and no fault is wanted. Its behaviour is fully specified, and each of its
// cycles ends soon.
Node generate(uint64_t seed, unsigned index, Faults faults, Dialect dialect);

}  // namespace rung::differential

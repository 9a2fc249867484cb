// SPDX-License-Identifier: Apache-2.0
// The elements and wires of a block's logic as an editor of LD, FBD or CFC would draw them, and their files: the
// notation of networks, and PLCopen XML in the manner of several editors. Private to this folder.
#pragma once

#include "tests/fuzz/networks/logic.h"

namespace rung::network_differential {

enum class Language : uint8_t { Ladder, Blocks, Ordered, Flow };  // LD, FBD, CFC with and without execution order

struct Wire {
  uint64_t from;
  std::string pin;
};
using Wires = std::vector<Wire>;
enum class Sense : uint8_t { None, Rising, Falling };
struct Pin {
  std::string name;  // empty: the only input of its element
  bool output = false, in_out = false;
  bool negated = false;
  Sense edge = Sense::None;
  std::string storage;  // set, reset
  Wires wires;
};
struct Element {
  std::string kind;  // the keyword of the notation
  uint64_t number = 0;
  std::string name;     // of the called POU, a label, a connector
  std::string operand;  // a variable, the instance of a box
  bool negated = false;
  Sense edge = Sense::None;
  std::string storage;
  std::vector<Pin> pins;
  unsigned order = 0;
  unsigned network = 0;  // from 1
  int x = 0, y = 0;
  std::string statements;
};
struct Drawing {
  Language language;
  std::vector<Element> elements;  // in execution order
};

Drawing draw(const Logic& logic, Language language, uint64_t seed);

std::string notation(const Logic& logic, const Drawing& drawing, const std::string& name, uint64_t seed);

enum class Editor : uint8_t { Plain, Pixels, Vendor, Ordered };  // no positions; Beremiz; CODESYS; Bachmann
constexpr int kEditors = 4;
std::string xmlPou(const Logic& logic, const Drawing& drawing, const std::string& name, Editor editor, uint64_t seed);
std::string xmlProject(const std::string& pous, Editor editor);

}  // namespace rung::network_differential

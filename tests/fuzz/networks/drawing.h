// The elements and wires of a block's logic as an editor of LD, FBD or CFC would have drawn them, and their files: the
// notation of networks, and PLCopen XML in the manner of several editors. Private to this folder.
#pragma once

#include "tests/fuzz/networks/logic.h"

namespace rung::network_differential {

enum class Language : uint8_t { Ladder, Blocks, Ordered, Flow };  // LD, FBD, CFC with turns and without

struct Wire {
  uint64_t from;
  std::string pin;
};
using Wires = std::vector<Wire>;
enum class Sense : uint8_t { None, Rising, Falling };
struct Pin {
  std::string name;  // empty: of an element with one input
  bool output = false, in_out = false;
  bool negated = false;
  Sense edge = Sense::None;
  std::string storage;  // set, reset
  Wires wires;
};
struct Element {
  std::string kind;  // the word of the notation
  uint64_t number = 0;
  std::string name;     // of what a box calls, a label, a connector
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
  std::vector<Element> elements;  // in the order of evaluation
};

Drawing draw(const Logic& logic, Language language, uint64_t seed);

std::string notation(const Logic& logic, const Drawing& drawing, const std::string& name, uint64_t seed);

enum class Editor : uint8_t { Plain, Pixels, Vendor, Ordered };  // no places; Beremiz; CODESYS; Bachmann
constexpr int kEditors = 4;
std::string xmlPou(const Logic& logic, const Drawing& drawing, const std::string& name, Editor editor, uint64_t seed);
std::string xmlProject(const std::string& pous, Editor editor);

}  // namespace rung::network_differential

// SPDX-License-Identifier: Apache-2.0
// Writes the notation of networks (docs/networks.md, frontend/parse/network.cpp) as source-mapped text. In: the
// elements of a body, described as a reader finds them in its file. Out: {network} … {end_network}, in place of
// statements, with the locations of the file. Called by the readers of LD, FBD and CFC.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/source_mapped_text.h"
#include "frontend/syntax/diagram.h"

namespace rung::importer {

// The source of a wire. Several sources of one pin are joined by OR.
struct WireSource {
  xml::Excerpt element;  // its number
  xml::Excerpt pin;      // empty: the element has one output
};

struct Modifiers {
  bool negated = false;
  EdgeKind edge = EdgeKind::None;
  PinStorage storage = PinStorage::None;
};

struct NetworkPin {
  xml::Excerpt name;
  PinDirection direction;
  Modifiers modifiers;
  std::vector<WireSource> wires;  // of an input or in-out
};

// Where an element is drawn.
struct Area {
  bool placed = false;
  int32_t x = 0, y = 0, width = 0, height = 0;
};
// ` AT 100, 40, 60, 30`; empty without a position.
std::string clauseOf(const Area& area);

struct NetworkElement {
  NetworkElement(ElementKind of, Loc at, xml::Excerpt id) : kind(of), loc(at), number(std::move(id)) {}

  ElementKind kind;
  Loc loc;
  xml::Excerpt number;
  xml::Excerpt name;     // of a box: its type or function; of a jump, label or connector: labelOf(), connectorOf()
  xml::Excerpt operand;  // the variable, instance or expression
  Modifiers modifiers;
  bool holding = false;
  std::string comment;  // of a Comment
  uint64_t order = 0;   // 0: none
  Area area;
  bool has_pins = false;  // a box, even if `pins` is empty
  std::vector<NetworkPin> pins;
  std::vector<WireSource> input;  // of an element without named pins
  xml::Excerpt statements;        // of an Execute
};

class NetworkWriter {
 public:
  explicit NetworkWriter(xml::SourceMappedText& out) : out_(out) {}

  void beginBody(Loc loc, NetworkLanguage language);
  void endBody(Loc loc) { out_.put(loc, "{end_network}\n"); }
  void beginNetwork(Loc loc, uint64_t number, bool disabled = false, std::string_view title = {});
  void write(NetworkElement element);
  // An Execute whose statements the caller writes in between.
  void beginStatements(const NetworkElement& element);
  void endStatements(Loc loc) { out_.put(loc, "{end_network};\n"); }

 private:
  void nameSelectorPins(std::string_view selector, std::vector<NetworkPin>& pins) const;
  void writeParts(const NetworkElement& element);
  void writeModifiers(const Modifiers& modifiers);
  void writePins(const std::vector<NetworkPin>& pins);
  void writeWires(const std::vector<WireSource>& wires);

  xml::SourceMappedText& out_;
};

// The name of a label or of a jump to it, whose `spelling` in the file may have any characters: these are changed to an
// identifier. The name of a connector or continuation can be a string of the notation.
xml::Excerpt labelOf(xml::Excerpt name, std::string_view spelling);
xml::Excerpt connectorOf(xml::Excerpt name, std::string_view spelling);

// The name of the nth input or output of a box that has no name in the file: IN1, IN2, OUT, OUT2.
std::string unnamedPin(PinDirection direction, size_t nth);

// A coordinate as files write it, `12.5`, rounded; 0: not a number.
int32_t coordinateOf(std::string_view text);

// NOT, RISING, FALLING, SET and RESET by the words of the XML formats.
EdgeKind edgeOf(std::string_view word);
PinStorage storageOf(std::string_view word);

}  // namespace rung::importer

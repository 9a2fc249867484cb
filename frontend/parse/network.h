// SPDX-License-Identifier: Apache-2.0
// The notation of networks. Private to frontend/parse; see cursor.h. network.cpp.
#pragma once

#include "frontend/parse/il.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

class NetworkParser : public IlParser {
 public:
  using IlParser::IlParser;

 protected:
  void parseNetworks(PouDecl& d);
  void parsePosition(SfcPosition& position);

 private:
  void parseElement(std::vector<DiagramElement>& out, uint32_t network);
  void parsePart(DiagramElement& e, std::vector<DiagramPin>& pins, std::string_view word);
  void parseOrder(DiagramElement& e);
  void parsePosition(DiagramElement& e);
  void parseStatementsOf(DiagramElement& e);
  void parsePins(std::vector<DiagramPin>& out);
  void parseWires(DiagramPin& pin);
  ExprId parseElementPath(Ident& name);
  template <class Modifiable>
  bool takeModifier(Modifiable& out);
  bool takeWord(Ident& out);
  bool takeNumber(uint64_t& out);
  bool takeCoordinate(int32_t& out);
  void connectWires(std::span<const DiagramElement> elements);

  std::vector<DiagramWire> wires_;
  std::vector<uint64_t> wire_numbers_;  // of the body's wires: numbers of the source elements
};

}  // namespace rung::text

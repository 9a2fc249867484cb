// Bodies drawn in LD, FBD and CFC, and conditions of charts drawn in the same way. In: the element that holds the
// diagram. Out: {network} … {end_network}, where statements stand. Called by pous.cpp and sfc.cpp.
#pragma once

#include <string>
#include <vector>

#include "frontend/syntax/diagram.h"
#include "frontend/xml/source_mapped_text.h"

namespace rung::plcopen {

// localId of an element: the number of its network times this, plus a number of its own.
constexpr uint64_t kNumbersPerNetwork = 10'000'000'000u;

struct DrawnBody {
  const xml::Element& body;  // the <LD>, <FBD> or <CFC>; the <SFC> around a condition
  NetworkLanguage language;
  // Of the condition of a transition: the variable that it assigns. Where a <connectionPointIn> is given, what is wired
  // to it; otherwise the body does, by a coil or variable of the name or, in an <inline>, whatever name its result has.
  const xml::Element* condition = nullptr;
  std::string target = {};
  // Of a chart: these coils and variables with all that leads to them; steps give their flags.
  std::vector<const xml::Element*> ends = {};
};

// ` AT 100, 40, 60, 30`; empty where the element has no place.
std::string positionOf(const xml::Document& document, const xml::Element& element);

// Of an action block in a network: the variable that its wire is stored in; and, for the end of its body, the
// statements that call all of them. (action_blocks.cpp)
std::string wireOf(const xml::Document& document, const xml::Element& block);
void writeActionCalls(const xml::Document& document, const xml::Element& body, xml::SourceMappedText& out);

void writeNetworks(const Sources& sources, const xml::Document& document, const DrawnBody& diagram,
                   xml::SourceMappedText& out);

}  // namespace rung::plcopen

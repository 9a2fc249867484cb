// SPDX-License-Identifier: Apache-2.0
// Bodies drawn in LD, FBD and CFC, and conditions of charts drawn in the same way. In: the element that contains the
// diagram. Out: {network} … {end_network}, in place of statements. Called by pous.cpp and sfc.cpp.
#pragma once

#include <string>
#include <vector>

#include "frontend/import/content.h"
#include "frontend/import/network_writer.h"
#include "frontend/syntax/diagram.h"

namespace rung::importer::plcopen {

// The localId of an element is the number of its network times this, plus a number within the network.
constexpr uint64_t kNumbersPerNetwork = 10'000'000'000u;

struct DrawnBody {
  const xml::Element& body;  // the <LD>, <FBD> or <CFC>; the <SFC> that contains a condition
  NetworkLanguage language;
  // For the condition of a transition: `condition` is its <connectionPointIn>, and `target` the variable that gets the
  // value of its wires. Without it, the body assigns to a coil or variable of the target's name or, in an <inline>, of
  // any name.
  const xml::Element* condition = nullptr;
  std::string target = {};
  // For a chart: these coils and variables with all elements connected to them; steps provide their flags.
  std::vector<const xml::Element*> ends = {};
};

// Where the file draws the element.
Area areaOf(const xml::Document& document, const xml::Element& element);

// For an action block in a network: the variable that stores its wire; and for the end of its body, the statements that
// call all control blocks. (action_blocks.cpp)
std::string wireOf(const xml::Document& document, const xml::Element& block);
void writeActionCalls(const xml::Document& document, const xml::Element& body, xml::SourceMappedText& out);

void writeNetworks(Reading& reading, const DrawnBody& diagram);

}  // namespace rung::importer::plcopen

// SPDX-License-Identifier: Apache-2.0
// The writers of networks and charts write this text, and its parts lead to these locations.
#include "frontend/import/network_writer.h"

#include <gtest/gtest.h>

#include "frontend/import/chart_writer.h"

namespace rung::importer {
namespace {

struct Written {
  Sources sources;
  FileId file = sources.add("drawing.xml", "one two three");
  xml::SourceMappedText out{sources};

  Loc at(uint32_t offset) const { return {sources.begin(file).offset + offset}; }
  xml::Excerpt made(std::string text) const { return {at(4), std::move(text)}; }
};

TEST(NetworkWriter, AllParts) {
  Written w;
  NetworkWriter writer(w.out);
  writer.beginBody(w.at(0), NetworkLanguage::Blocks);
  writer.beginNetwork(w.at(0), 7, true, "it's");
  NetworkElement box(ElementKind::Box, w.at(0), w.made("12"));
  box.name = w.made("TON");
  box.operand = w.made("timer");
  box.order = 3;
  box.area = {true, -5, 6, 70, 80};
  box.has_pins = true;
  box.pins.push_back({w.made("IN"),
                      PinDirection::Input,
                      {true, EdgeKind::Rising, PinStorage::None},
                      {{w.made("1"), {}}, {w.made("2"), w.made("Q")}}});
  box.pins.push_back({w.made("x"), PinDirection::InOut, {}, {}});
  box.pins.push_back({w.made("Q"), PinDirection::Output, {}, {}});
  writer.write(box);
  NetworkElement coil(ElementKind::Coil, w.at(0), w.made("13"));
  coil.operand = w.made("y");
  coil.modifiers = {false, EdgeKind::None, PinStorage::Reset};
  coil.holding = true;
  coil.input = {{w.made("12"), w.made("Q")}};
  writer.write(coil);
  writer.endBody(w.at(0));
  EXPECT_EQ(w.out.text(),
            "{network FBD}\nNETWORK 7 DISABLED 'it$'s';\n"
            "box 12 TON (timer) ORDER 3 AT -5, 6, 70, 80 [IN NOT RISING := 1 OR 2(Q), x :=  =>, Q =>];\n"
            "coil 13 (y) RESET HOLDING := 12(Q);\n{end_network}\n");
}

TEST(NetworkWriter, NamesWithAnyCharacters) {
  Written w;
  EXPECT_EQ(labelOf(w.made("plain"), "plain").text, "plain");
  EXPECT_EQ(labelOf(w.made("a b"), "a b").text, "na32xb");
  EXPECT_EQ(connectorOf(w.made("it's"), "it's").text, "'it$'s'");
  EXPECT_EQ(connectorOf(w.made("it's"), "it's").loc, w.at(4));
}

TEST(ChartWriter, StepAndTransition) {
  Written w;
  ChartWriter writer(w.out);
  ChartStep step;
  step.loc = step.end = w.at(0);
  step.initial = true;
  step.name = w.made("Wait");
  step.maximum = w.made("T#5s");
  step.actions.push_back({"exit", w.made("Stop"), {}, {}, {}, {}});
  step.actions.push_back({{}, w.made("open"), w.made("L"), "T#", w.made("1s"), {w.made("done")}});
  step.actions.push_back({{}, w.made("hold"), {}, {}, {}, {}});
  writer.write(step);
  ChartTransition transition;
  transition.loc = w.at(0);
  transition.priority = w.made("2");
  transition.from = {w.made("A"), w.made("B")};
  transition.to = {w.made("C")};
  writer.beginTransition(transition);
  writer.endTransition(w.at(0));
  EXPECT_EQ(w.out.text(),
            "INITIAL_STEP Wait (TMAX := T#5s):\n{exit} Stop;\nopen(L, T#1s, done);\nhold(N);\nEND_STEP\n"
            "TRANSITION (PRIORITY := 2) FROM (A, B) TO C END_TRANSITION\n");
  EXPECT_EQ(declarationOfFlag("ErrorStep"), "VAR_OUTPUT SFCErrorStep : STRING; END_VAR\n");
  EXPECT_EQ(declarationOfFlag("Other"), "");
}

}  // namespace
}  // namespace rung::importer

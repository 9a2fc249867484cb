// SPDX-License-Identifier: Apache-2.0
// Corrupted and hostile networks and charts, drawn and written as PLCopen XML: everything that parses gives well-formed
// pictures and files, in bounded time. RUNG_MUTATION_SEED and RUNG_MUTATION_COUNT try other mutants; a build with
// sanitizers (preset asan) checks their memory accesses.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <random>

#include "frontend/export/plcopen.h"
#include "frontend/import/plcopen/plcopen.h"
#include "frontend/import/xml.h"
#include "frontend/parse/parse.h"
#include "frontend/render/picture.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/source/dialect.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

bool isWellFormed(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics(sources);
  xml::Document document;
  return xml::read(sources, sources.add("out.xml", text), diagnostics, document);
}

struct Outcome {
  uint32_t errors = 0, pictures = 0;
  bool written = false;
};

void drawMembers(Tree& tree, Names& names, Slice<DeclId> decls, const std::string& program, Outcome& out);

// With the numbers of the execution order in each language.
void draw(Tree& tree, Names& names, const PouDecl& pou, const std::string& program, Outcome& out) {
  std::vector<std::string> pictures;
  if (pou.body_kind == BodyKind::Sfc) pictures.push_back(picture::drawChart(tree, names, pou, "p"));
  if (pou.body_kind == BodyKind::Network) {
    const Sources none;
    Diagnostics unreported(none);
    const picture::NetworkNotes notes{diagram::executionOrder(tree, names, unreported, pou.diagram)};
    for (const int32_t page : {0, 400, 1200})
      pictures.push_back(picture::drawNetworks(tree, names, pou.diagram, "p", page, notes));
  }
  for (const std::string& svg : pictures) EXPECT_TRUE(isWellFormed(svg)) << program;
  out.pictures += static_cast<uint32_t>(pictures.size());
  drawMembers(tree, names, pou.members, program, out);
}

void drawMembers(Tree& tree, Names& names, Slice<DeclId> decls, const std::string& program, Outcome& out) {
  for (const DeclId id : tree.list(decls))
    if (tree.kind(id) == DeclKind::Pou) draw(tree, names, tree.as<PouDecl>(id), program, out);
}

// Parses and draws the program, and writes it if it parses completely, as `rung graph` and `rung convert` do.
Outcome outcomeOf(const std::string& program) {
  Sources sources;
  Names names;
  Diagnostics diagnostics(sources);
  Tree tree;
  FileId file = sources.add("mutant", program);
  std::vector<importer::Library> libraries;
  importer::ReadContext context{sources, diagnostics, libraries};
  if (importer::plcopen::isPlcopen(program)) file = importer::plcopen::readProgram(context, file);
  Outcome out;
  if (file) {
    const FileUnit unit = text::parseFile(tree, names, sources, file, Dialect::Codesys, diagnostics);
    if (diagnostics.errorCount() == 0) {
      drawMembers(tree, names, unit.decls, program, out);
      const std::string written = exporter::writeProject({tree, names, sources, {&unit, 1}}, "p", diagnostics);
      if (diagnostics.errorCount() == 0) {
        out.written = true;
        EXPECT_TRUE(isWellFormed(written)) << program;
      }
    }
  }
  out.errors = diagnostics.errorCount();
  return out;
}

uint32_t numberFrom(const char* variable, uint32_t otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr ? static_cast<uint32_t>(std::strtoul(value, nullptr, 10)) : otherwise;
}

// The drawn conformance programs, as ST and as XML.
std::vector<std::string> programs() {
  std::vector<std::string> all;
  for (const char* folder : {"standard/table54", "standard/table56", "standard/table58", "standard/table61",
                             "standard/table73", "standard/table74", "standard/table75", "standard/table76",
                             "manuals/tm_tp_5_3", "manuals/tm_tp_5_5", "manuals/tm_tp_5_6", "language/plcopen"}) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(std::string(RUNG_SOURCE_ROOT "/tests/conformance/") + folder))
      paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths) all.push_back(readFile(path).content);
  }
  return all;
}

TEST(DrawingMutation, corrupted_drawings_give_well_formed_files) {
  std::mt19937 random(numberFrom("RUNG_MUTATION_SEED", 1131));
  const uint32_t count = numberFrom("RUNG_MUTATION_COUNT", 400);
  const std::vector<std::string> all = programs();
  const auto below = [&](size_t n) { return static_cast<size_t>(random() % n); };
  static constexpr const char* kStrays[] = {"1",
                                            "2",
                                            "-5",
                                            "99",
                                            "NOT",
                                            "OR",
                                            ":=",
                                            "=>",
                                            "[",
                                            "]",
                                            "(",
                                            ")",
                                            ";",
                                            "box",
                                            "AT 3, 4",
                                            "ORDER 1",
                                            "STEP",
                                            "TO",
                                            "&",
                                            "<",
                                            "DISABLED",
                                            "'",
                                            "AT -9, 9999999",
                                            "\x01",
                                            "\"",
                                            ">",
                                            "0",
                                            "FROM"};
  uint32_t wrong = 0, pictures = 0, written = 0;
  for (uint32_t k = 0; k < count; ++k) {
    std::string text = all[below(all.size())];
    const bool xml = importer::plcopen::isPlcopen(text);
    for (size_t n = 1 + below(3); n > 0; --n) {
      size_t at = below(text.size());
      if (below(2) == 0) at = std::min(text.find_first_of("0123456789", at), text.size() - 1);  // a wire or a position
      const size_t length = below(3) == 0 ? 0 : 1 + below(below(4) == 0 ? 12 : 2);
      const std::string put = below(3) == 0          ? ""
                              : xml && below(4) != 0 ? std::to_string(below(40))
                                                     : kStrays[below(std::size(kStrays))];
      text.replace(at, std::min(length, text.size() - at), put);
    }
    const Outcome out = outcomeOf(text);
    wrong += out.errors > 0;
    pictures += out.pictures;
    written += out.written;
    if (HasFailure()) return;
  }
  std::printf("%u of %u mutants are wrong; %u pictures, %u files\n", wrong, count, pictures, written);
  EXPECT_GE(wrong, count / 4);
  EXPECT_GE(pictures, count / 4);
  EXPECT_GE(written, count / 8);
}

// Unknown names, several elements at one position, cycles, and positions outside of any page.
TEST(DrawingMutation, what_sema_would_refuse_is_drawn_and_written) {
  const std::string chart = "PROGRAM p\nVAR a : BOOL; END_VAR\nINITIAL_STEP s: END_STEP\n";
  for (const char* transitions :
       {"TRANSITION FROM s TO nowhere := a; END_TRANSITION", "TRANSITION FROM nowhere TO s := a; END_TRANSITION",
        "TRANSITION FROM (s, s) TO (s, s) := a; END_TRANSITION",
        "STEP s: END_STEP TRANSITION FROM s TO s := a; END_TRANSITION",
        "STEP t AT 2000000000, -5: END_STEP TRANSITION AT 5, 5 FROM s TO (t, s, t) := a; END_TRANSITION"}) {
    const Outcome out = outcomeOf(chart + transitions + "\nEND_PROGRAM\n");
    EXPECT_EQ(1u, out.pictures) << transitions;
  }
  for (const char* body : {"box 1 AND AT 1000000000, 5 [IN1 := 1, OUT =>]; box 2 OR AT -1000000000, 7 [IN1 := 1];",
                           "rail 1; right_rail 2 := 1; coil 3 (q) := 1; contact 4 (q);",
                           "label 1 a; label 2 a; jump 3 b; return 4; comment 5 '<&>';",
                           "connector 1 := 2; connector 2 := 1; coil 3 (q) := 2;",
                           "NETWORK 7 DISABLED; box 1 F [x := 1, x := 1, y =>, y =>];"}) {
    const Outcome out = outcomeOf("PROGRAM p\nVAR q : BOOL; END_VAR\n{network LD}\n" + std::string(body) +
                                  "\n{end_network}\nEND_PROGRAM\n");
    EXPECT_EQ(3u, out.pictures) << body;
  }
}

TEST(DrawingMutation, large_drawings_end) {
  std::string chain = "PROGRAM p\nVAR a, q : BOOL; END_VAR\n{network LD}\nrail 0;\n", wide = chain,
              steps = "PROGRAM p\nINITIAL_STEP s0: END_STEP\n";
  const uint32_t count = 1500;
  for (uint32_t k = 1; k <= count; ++k) {
    const std::string n = std::to_string(k), before = std::to_string(k - 1);
    chain += "contact " + n + " (a) := " + before + ";\n";
    wide += "contact " + n + " (a) := 0;\n";
    steps += "STEP s" + n + ": END_STEP TRANSITION FROM s" + before + " TO s" + n + " := TRUE; END_TRANSITION\n";
  }
  chain += "coil 99999 (q) := " + std::to_string(count) + ";\n{end_network}\nEND_PROGRAM\n";
  wide += "coil 99999 (q) := 1";
  for (uint32_t k = 2; k <= count; ++k) wide += " OR " + std::to_string(k);
  wide += ";\n{end_network}\nEND_PROGRAM\n";
  for (const std::string& program : {chain, wide, steps + "END_PROGRAM\n"}) {
    const std::clock_t begin = std::clock();
    const Outcome out = outcomeOf(program);
    EXPECT_EQ(0u, out.errors);
    EXPECT_GE(out.pictures, 1u);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 60.0);
  }
}

}  // namespace
}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// Corrupted and hostile networks, in the notation and in PLCopen XML: checking any file ends, in time that grows with
// its size, and a message reports what is cut off. RUNG_MUTATION_SEED and RUNG_MUTATION_COUNT try other mutants; a
// build with sanitizers (preset asan) checks their memory accesses.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <random>

#include "frontend/import/plcopen/plcopen.h"
#include "frontend/parse/parse.h"
#include "sema/check.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

const std::vector<sema::LibraryFile>& libraryFiles() {
  static std::vector<std::unique_ptr<std::string>> texts;
  static const std::vector<sema::LibraryFile> files = [] {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(RUNG_SOURCE_ROOT "/stdlib/standard"))
      if (entry.path().extension() == ".st") paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    std::vector<sema::LibraryFile> list;
    for (const std::string& path : paths) {
      texts.push_back(std::make_unique<std::string>(path));
      const char* name = texts.back()->c_str();
      texts.push_back(std::make_unique<std::string>(readFile(path).content));
      list.push_back({"Standard", name, *texts.back()});
    }
    return list;
  }();
  return files;
}

uint32_t errorsIn(const std::string& program, bool xml) {
  Sources sources;
  Names names;
  Diagnostics diagnostics(sources);
  Tree tree;
  sema::Options options;
  options.libraries = libraryFiles();
  FileId file = sources.add(xml ? "mutant.xml" : "mutant.st", program);
  std::vector<importer::Library> libraries;
  importer::ReadContext context{sources, diagnostics, libraries};
  if (xml) file = importer::plcopen::readProgram(context, file);
  if (file) text::parseFile(tree, names, sources, file, options.dialect, diagnostics);
  sema::Project project(sources, names, diagnostics, tree, options);
  sema::check(project);
  return diagnostics.errorCount();
}

uint32_t numberFrom(const char* variable, uint32_t otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr ? static_cast<uint32_t>(std::strtoul(value, nullptr, 10)) : otherwise;
}

// The networks of the conformance programs.
std::vector<std::string> programs() {
  std::vector<std::string> all;
  for (const char* folder : {"standard/table73", "standard/table74", "standard/table75", "standard/table76",
                             "manuals/tm_tp_5_3", "manuals/tm_tp_5_6"}) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(std::string(RUNG_SOURCE_ROOT "/tests/conformance/") + folder))
      if (entry.path().extension() == ".st") paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths)
      if (const std::string text = readFile(path).content; text.find("{network") != std::string::npos)
        all.push_back(text);
  }
  return all;
}

const char* const kXml = R"(<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><dataTypes/><pous>
<pou name="Starter" pouType="functionBlock"><interface>
<inputVars><variable name="start"><type><BOOL/></type></variable><variable name="x"><type><INT/></type></variable></inputVars>
<outputVars><variable name="motor"><type><BOOL/></type></variable><variable name="y"><type><INT/></type></variable></outputVars>
<localVars><variable name="t"><type><derived name="TON"/></type></variable></localVars></interface><body><FBD>
<inVariable localId="1"><position x="10" y="10"/><connectionPointOut/><expression>start</expression></inVariable>
<inVariable localId="2"><position x="10" y="20"/><connectionPointOut/><expression>T#1s</expression></inVariable>
<block localId="3" typeName="TON" instanceName="t"><position x="40" y="10"/><inputVariables>
<variable formalParameter="IN"><connectionPointIn><connection refLocalId="1"/></connectionPointIn></variable>
<variable formalParameter="PT"><connectionPointIn><connection refLocalId="2"/></connectionPointIn></variable></inputVariables>
<inOutVariables/><outputVariables><variable formalParameter="Q"><connectionPointOut/></variable></outputVariables></block>
<connector localId="4" name="later"><connectionPointIn><connection refLocalId="3" formalParameter="Q"/></connectionPointIn></connector>
<continuation localId="5" name="later"><connectionPointOut/></continuation>
<outVariable localId="6"><position x="80" y="10"/><connectionPointIn><connection refLocalId="5"/></connectionPointIn><expression>motor</expression></outVariable>
<inVariable localId="7"><position x="10" y="50"/><connectionPointOut/><expression>x</expression></inVariable>
<block localId="8" typeName="ADD"><position x="40" y="50"/><inputVariables>
<variable formalParameter="IN1"><connectionPointIn><connection refLocalId="7"/></connectionPointIn></variable>
<variable formalParameter="IN2"><connectionPointIn><connection refLocalId="8" formalParameter="OUT"/></connectionPointIn></variable></inputVariables>
<inOutVariables/><outputVariables><variable formalParameter="OUT"><connectionPointOut/></variable></outputVariables></block>
<outVariable localId="9"><position x="80" y="50"/><connectionPointIn><connection refLocalId="8" formalParameter="OUT"/></connectionPointIn><expression>y</expression></outVariable>
</FBD></body></pou></pous></types></project>
)";

// ---- truncated and corrupted

TEST(NetworkMutation, what_is_cut_off_inside_a_network_is_reported) {
  uint32_t cuts = 0;
  for (const std::string& program : programs()) {
    const size_t begin = program.find("{network"), end = program.find("{end_network", begin);
    for (size_t at = begin + 12 + cuts % 5; at + 1 < end; at += 37, ++cuts) {
      const uint32_t errors = errorsIn(program.substr(0, at), false);
      EXPECT_GE(errors, 1u) << program.substr(0, at);
      EXPECT_LE(errors, 2u) << program.substr(0, at);
    }
  }
  EXPECT_GE(cuts, 100u);
}

TEST(NetworkMutation, xml_that_is_cut_off_gives_one_error) {
  const std::string text = kXml;
  ASSERT_EQ(errorsIn(text, true), 0u);
  const size_t end = text.rfind('>');
  for (size_t at = 40; at < end; at += 11) EXPECT_EQ(errorsIn(text.substr(0, at), true), 1u) << text.substr(0, at);
}

TEST(NetworkMutation, corrupted_networks_are_checked_to_the_end) {
  std::mt19937 random(numberFrom("RUNG_MUTATION_SEED", 1131));
  const uint32_t count = numberFrom("RUNG_MUTATION_COUNT", 300);
  const std::vector<std::string> all = programs();
  const auto below = [&](size_t n) { return static_cast<size_t>(random() % n); };
  uint32_t wrong = 0, errors = 0;
  for (uint32_t k = 0; k < count; ++k) {
    const bool xml = k % 3 == 0;
    std::string text = xml ? kXml : all[k % all.size()];
    const size_t begin = text.find(xml ? "<FBD>" : "{network");
    const size_t end = text.find(xml ? "</FBD>" : "{end_network}", begin);
    static constexpr const char* kStrays[] = {
        "1", "2", "3", "5", "8",   "99",      "NOT",  "OR", "SET",          ":=",   "=>", "[",
        "]", "(", ")", ";", "box", "contact", "jump", "EN", "{network ST}", "TRUE", "Q"};
    for (size_t n = 1 + below(2); n > 0; --n) {
      // A number (an element or the start of a wire), or any position.
      size_t at = begin + below(end - begin);
      if (below(2) == 0) at = std::min(text.find_first_of("0123456789", at), end);
      const size_t length = below(3) == 0 ? 0 : 1 + below(below(4) == 0 ? 12 : 2);
      const std::string put = below(3) == 0 ? "" : xml ? std::to_string(below(12)) : kStrays[below(std::size(kStrays))];
      text.replace(at, std::min(length, text.size() - at), put);
    }
    const uint32_t found = errorsIn(text, xml);
    wrong += found > 0 ? 1 : 0;
    errors += found;
  }
  std::printf("%u of %u mutants are wrong, %.2f errors on average\n", wrong, count, 1.0 * errors / std::max(wrong, 1u));
  EXPECT_GE(wrong, count / 4);
  EXPECT_LE(errors, 3 * wrong);
}

// ---- huge

struct Hostile {
  const char* name;
  std::string (*line)(size_t k, size_t n);
  bool wrong;
};
std::string of(size_t n) { return std::to_string(n); }
const Hostile kHostile[] = {
    {"contacts in a row", [](size_t k, size_t) { return "contact " + of(k + 1) + " (a) := " + of(k) + ";"; }, false},
    {"contacts in a loop",
     [](size_t k, size_t n) {
       return "contact " + of(k + 1) + " (a) := " + of((k + 1) % n + 1) + ";" +
              (k == 0 ? "coil 9999999 (q) := 1;" : "");
     },
     true},
    {"connectors in a row, each read",
     [](size_t k, size_t n) {
       return (k == 0 ? "connector 1 := 0;" : "connector " + of(k + 1) + " := " + of(k) + ";") + " coil " +
              of(n + k + 1) + " (q) SET := " + of(k + 1) + ";";
     },
     false},
    {"connectors in a loop, each read",
     [](size_t k, size_t n) {
       return "connector " + of(k + 1) + " := " + of((k + 1) % n + 1) + "; coil " + of(n + k + 1) +
              " (q) SET := " + of(k + 1) + ";";
     },
     true},
    {"boxes in a loop",
     [](size_t k, size_t n) {
       return "box " + of(k + 1) + " AND [IN1 := " + of((k + 1) % n + 1) + ", IN2 := 0, OUT =>];";
     },
     false},
    {"boxes that read themselves",
     [](size_t k, size_t) { return "box " + of(k + 1) + " AND [IN1 := " + of(k + 1) + ", IN2 := 0, OUT =>];"; }, false},
    {"boxes that read the one before twice",
     [](size_t k, size_t) { return "box " + of(k + 1) + " AND [IN1 := " + of(k) + ", IN2 := " + of(k) + ", OUT =>];"; },
     false},
    {"function blocks in a loop",
     [](size_t k, size_t n) { return "box " + of(k + 1) + " R_TRIG [CLK := " + of((k + 1) % n + 1) + "(Q), Q =>];"; },
     false},
    {"outputs that a box does not have",
     [](size_t k, size_t) {
       return (k == 0 ? "box 1 R_TRIG [CLK := 0, Q =>];" : "") + std::string("coil ") + of(k + 2) + " (q) SET := 1(Q" +
              of(k) + ");";
     },
     true},
    {"labels and jumps",
     [](size_t k, size_t n) {
       return "label " + of(k + 1) + " l" + of(k) + "; jump " + of(n + k + 1) + " l" + of((k * 7919) % n) + " := 0;";
     },
     false},
    {"wires from nothing", [](size_t k, size_t n) { return "coil " + of(k + 1) + " (q) := " + of(n + k + 1) + ";"; },
     true},
    {"one number for all", [](size_t, size_t) { return std::string("coil 7 (q) := 0;"); }, true},
    {"one turn for all", [](size_t k, size_t) { return "coil " + of(k + 1) + " (q) SET ORDER 3 := 0;"; }, true},
    {"boxes of statements",
     [](size_t k, size_t) { return "execute " + of(k + 1) + " [EN := 0] {network ST} q := a; {end_network};"; }, false},
};

std::string program(const Hostile& hostile, size_t count) {
  std::string text =
      "FUNCTION_BLOCK F VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n{network LD}\nrail 0;\n";
  for (size_t k = 0; k < count; ++k) text += hostile.line(k, count) + "\n";
  return text + "{end_network}\nEND_FUNCTION_BLOCK\n";
}

TEST(NetworkMutation, cost_grows_with_the_size) {
  const size_t small = 500, factor = 8;
  for (const Hostile& hostile : kHostile) {
    const auto seconds = [&](size_t count) {
      const std::string text = program(hostile, count);
      const std::clock_t begin = std::clock();
      EXPECT_EQ(errorsIn(text, false) > 0, hostile.wrong) << hostile.name;
      return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    const double base = std::min(seconds(small), seconds(small)), much = seconds(small * factor);
    EXPECT_LE(much, factor * std::max(base, 0.005) * 3) << hostile.name << ": " << base << " s, then " << much << " s";
  }
}

TEST(NetworkMutation, depth_is_limited) {
  const size_t depth = 5000;
  std::string parens, nested, closed;
  for (size_t k = 0; k < depth; ++k) {
    parens += "(";
    nested += "IF a THEN ";
    closed += "END_IF ";
  }
  const std::string head = "FUNCTION_BLOCK F VAR a : BOOL; END_VAR\n{network LD}\nrail 0;\n",
                    tail = "\n{end_network}\nEND_FUNCTION_BLOCK\n";
  EXPECT_EQ(errorsIn(head + "contact 1 (" + parens + "a" + std::string(depth, ')') + ") := 0; coil 2 (a) := 1;" + tail,
                     false),
            1u);
  EXPECT_EQ(
      errorsIn(head + "execute 1 [] {network ST} " + nested + "a := TRUE; " + closed + "{end_network};" + tail, false),
      1u);
  std::string boxes;
  for (size_t k = 0; k < depth; ++k) boxes += "execute 1 [] {network ST} ";
  EXPECT_GE(errorsIn(head + boxes + tail, false), 1u);
}

}  // namespace
}  // namespace rung

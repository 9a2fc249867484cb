// SPDX-License-Identifier: Apache-2.0
// Networks: generated logic as ST, IL, LD, FBD and CFC (with an execution order, without, with the one that Rung
// computes) and as PLCopen XML gets the same random inputs for many cycles, and all forms must give the trace of the
// ST.
//   network_differential [--first=SEED] [--count=N] [--cycles=N] [--engine=interp|native] [-j N] [--rung=PATH]
//   [--folder=PATH] network_differential --print=SEED        all forms of one block and a program that runs them
// Blocks go in batches of 10, one project each: its trace has a checksum of all outputs per form and cycle. A batch
// that differs is run block by block. Called by tests/runner with few seeds and by hand with many.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "frontend/parse/parse.h"
#include "frontend/schedule/network_schedule.h"
#include "tests/fuzz/generated/options.h"
#include "tests/fuzz/networks/drawing.h"
#include "tests/runner/process.h"

namespace rung::network_differential {
namespace {

namespace fs = std::filesystem;
using generated::Options;

constexpr uint64_t kBatch = 10;
const char* const kForms[] = {"st", "il", "ld", "fbd", "cfc", "flow", "numbered", "xml_ld", "xml_fbd", "xml_cfc"};

const char* const kDeclarations =
    R"(TYPE Memory : STRUCT flag : BOOL; small : INT; END_STRUCT END_TYPE
TYPE Pattern : UNION r : REAL; w : DWORD; END_UNION END_TYPE
FUNCTION_BLOCK Accumulate
VAR_INPUT step : INT; clear : BOOL; END_VAR
VAR_OUTPUT sum : DINT; odd : BOOL; END_VAR
IF clear THEN sum := 0; END_IF
sum := sum + step;
odd := sum MOD 2 <> 0;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Scale
VAR_INPUT go : BOOL; END_VAR
VAR_IN_OUT value : DINT; END_VAR
VAR_OUTPUT done : BOOL; END_VAR
done := go AND value < 1000000;
IF done THEN value := value * 2 + 1; END_IF
END_FUNCTION_BLOCK
FUNCTION Blend : INT
VAR_INPUT first : BOOL; one, two : INT; END_VAR
IF first THEN Blend := one; ELSE Blend := two - one; END_IF
END_FUNCTION
FUNCTION Split : DINT
VAR_INPUT number : DINT; unit : INT; END_VAR
VAR_OUTPUT rest : INT; odd : BOOL; END_VAR
IF unit > 0 THEN Split := number / unit; rest := DINT_TO_INT(number MOD unit); END_IF
odd := number.0;
END_FUNCTION
FUNCTION Mix : DWORD
VAR_INPUT seed : DWORD; p, q, r, s : BOOL; u, v : INT; m, n : DINT; y, z : REAL; END_VAR
VAR pattern : Pattern; END_VAR
Mix := ROL(seed, 5) XOR DINT_TO_DWORD(m) XOR ROL(DINT_TO_DWORD(n), 7) XOR ROL(INT_TO_DWORD(u), 3) XOR ROL(INT_TO_DWORD(v), 9);
IF p THEN Mix := ROL(Mix, 1) + 1; END_IF
IF q THEN Mix := ROL(Mix, 1) + 3; END_IF
IF r THEN Mix := ROL(Mix, 1) + 7; END_IF
IF s THEN Mix := ROL(Mix, 1) + 9; END_IF
pattern.r := y; // of a NaN the sign may differ
IF y = y THEN Mix := ROL(Mix, 1) XOR pattern.w; END_IF
pattern.r := z;
IF z = z THEN Mix := ROL(Mix, 1) XOR pattern.w; END_IF
END_FUNCTION
)";

struct File {
  std::string name, text;
};

// A drawing without an execution order with the numbers that its picture shows, which say the same.
Drawing numbered(const Drawing& drawing, const std::string& text) {
  Sources sources;
  Diagnostics diagnostics(sources);
  Names names;
  Tree tree;
  const FileUnit unit =
      text::parseFile(tree, names, sources, sources.add("drawn.st", text), Dialect::Codesys, diagnostics);
  const Diagram diagram = tree.as<PouDecl>(tree.list(unit.decls)[0]).diagram;
  Drawing result{Language::Ordered, drawing.elements};
  unsigned place = 0;
  for (const uint32_t element : diagram::executionOrder(tree, names, diagnostics, diagram)) {
    const uint64_t number = tree.list(diagram.elements)[element].number;
    ++place;
    for (Element& e : result.elements)
      if (e.number == number) e.order = place;
  }
  return result;
}

// The project of some seeds, and the variables with the checksums.
std::vector<File> project(uint64_t first, uint64_t count, std::string& watch) {
  std::string text = kDeclarations, pous[kEditors];
  std::string vars = "PROGRAM Main\nVAR\nstate : UDINT := " + std::to_string(static_cast<uint32_t>(first + 1)) + ";\n",
              calls;
  for (uint64_t k = 0; k < count; ++k) {
    const uint64_t seed = first + k;
    const Logic logic = generate(seed);
    const std::string name = "B" + std::to_string(k) + "_";
    const auto editor = static_cast<Editor>(seed % kEditors);
    const Drawing ladder = draw(logic, Language::Ladder, seed), blocks = draw(logic, Language::Blocks, seed);
    const Drawing ordered = draw(logic, Language::Ordered, seed), flow = draw(logic, Language::Flow, seed);
    text += structuredText(logic, name + "st") + instructionList(logic, name + "il");
    text += notation(logic, ladder, name + "ld", seed) + notation(logic, blocks, name + "fbd", seed);
    const std::string drawn = notation(logic, flow, name + "flow", seed);
    text += notation(logic, ordered, name + "cfc", seed) + drawn;
    text += notation(logic, numbered(flow, drawn), name + "numbered", seed);
    std::string& xml = pous[static_cast<size_t>(editor)];
    xml += xmlPou(logic, draw(logic, Language::Ladder, seed + 1), name + "xml_ld", editor, seed);
    xml += xmlPou(logic, draw(logic, Language::Blocks, seed + 1), name + "xml_fbd", editor, seed);
    xml += xmlPou(logic, draw(logic, Language::Ordered, seed + 1), name + "xml_cfc", editor, seed);
    calls += "state := state * 1664525 + 1013904223;\n";
    for (const char* form : kForms) {
      const std::string b = "b" + std::to_string(k) + "_" + form, sum = "s" + std::to_string(k) + "_" + form;
      vars += b + " : " + name + form + "; " + sum + " : DWORD;\n";
      calls +=
          b + "(a := state.31, b := state.30, c := state.29 AND state.28, d := state.27 OR state.26, " +
          "i := UDINT_TO_DINT(state / 65536) - 32768, j := UDINT_TO_DINT(state), k := UDINT_TO_INT(state / 8388608), " +
          "which := UDINT_TO_INT(state / 65536 MOD 3), x := UDINT_TO_REAL(state / 1048576) / 16.0);\n";
      calls += sum + " := Mix(" + sum;
      for (const char* output : {"p", "q", "r", "s", "u", "v", "m", "n", "y", "z"}) calls += ", " + b + "." + output;
      calls += ");\n";
      watch += (watch.empty() ? "Main." : ",Main.") + sum;
    }
  }
  std::vector<File> files{{"blocks.st", text + vars + "END_VAR\n" + calls + "END_PROGRAM\n"}};
  for (size_t e = 0; e < kEditors; ++e)
    if (!pous[e].empty())
      files.push_back({"editor" + std::to_string(e) + ".xml", xmlProject(pous[e], static_cast<Editor>(e))});
  return files;
}

class Worker {
 public:
  Worker(const Options& options, std::string folder) : options_(options), folder_(std::move(folder)) {}

  // Returns the number of blocks that differ.
  unsigned compare(uint64_t first, uint64_t count) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::string watch;
    tests::Command command;
    command.folder = folder_;
    command.seconds = 600;
    const std::vector<File> files = project(first, count, watch);
    command.arguments = {options_.rung,
                         "run",
                         "--cycles=" + std::to_string(options_.cycles),
                         "--engine=" + options_.engine,
                         "--trace=-",
                         "--watch=" + watch};
    for (const File& file : files) {
      std::ofstream(folder_ + "/" + file.name, std::ios::binary) << file.text;
      command.arguments.push_back(file.name);
    }
    const tests::Output output = tests::run(command);
    std::string difference;
    if (output.exit_code != 0) {
      std::stringstream lines(output.err);
      std::string errors;
      for (std::string line; std::getline(lines, line);)
        if (line.find("warning[") == std::string::npos && line.find("error") != std::string::npos)
          errors += line + "\n";
      difference = "exit code " + std::to_string(output.exit_code) + "\n" +
                   (errors.empty() ? output.err.substr(0, 2000) : errors.substr(0, 2000));
    } else {
      difference = firstDifference(output.out);
    }
    if (difference.empty()) return 0;
    if (count == 1) {
      std::printf("seed %llu: %s\n", static_cast<unsigned long long>(first), difference.c_str());
      return 1;
    }
    unsigned differ = 0;
    for (uint64_t k = 0; k < count; ++k) differ += compare(first + k, 1);
    if (differ == 0)
      std::printf("seeds from %llu differ together only: %s\n", static_cast<unsigned long long>(first),
                  difference.c_str());
    return std::max(differ, 1u);
  }

 private:
  std::string firstDifference(const std::string& trace) const {
    std::stringstream lines(trace);
    std::string line;
    uint64_t rows = 0;
    std::getline(lines, line);
    std::string found;
    std::vector<bool> reported(std::size(kForms), false);
    for (; std::getline(lines, line); ++rows) {
      std::vector<std::string> cells;
      std::stringstream stream(line);
      for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
      for (size_t k = 2; k < cells.size(); ++k) {
        const size_t form = (k - 2) % std::size(kForms);
        if (cells[k] == cells[k - form] || reported[form]) continue;
        reported[form] = true;
        found += std::string(kForms[form]) + " differs in cycle " + std::to_string(rows) + "; ";
      }
    }
    return rows == options_.cycles ? found : "the trace has " + std::to_string(rows) + " rows";
  }

  const Options& options_;
  std::string folder_;
};

int runAll(const Options& options) {
  const unsigned differ =
      generated::runJobs(options, kBatch, [&](const std::string& folder) { return Worker(options, folder); });
  if (!options.keeps_folder) fs::remove_all(options.folder);
  std::printf("%llu blocks in %zu forms, %u differ\n", static_cast<unsigned long long>(options.count),
              std::size(kForms), differ);
  return differ == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rung::network_differential

int main(int argc, char** argv) {
  using namespace rung::network_differential;
  Options options;
  options.cycles = 1000;
  if (!rung::generated::readOptions(argc, argv, "network_differential", "--cycles -j --engine", options)) return 2;
  if (!options.has_print) return runAll(options);
  std::string watch;
  for (const File& file : project(options.print, 1, watch))
    std::printf("==== %s\n%s", file.name.c_str(), file.text.c_str());
  return 0;
}

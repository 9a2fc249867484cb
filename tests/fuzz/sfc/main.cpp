// SPDX-License-Identifier: Apache-2.0
// Generated charts against the evaluator: `rung run` must show the same active steps, variables and order of actions in
// each cycle.
//   sfc_differential [--first=SEED] [--count=N] [--cycles=N] [--engine=interp|native] [--rung=PATH] [--folder=PATH]
//   sfc_differential --print=SEED
// Charts go in batches of 10, one program each, which runs as it is, as the ST that `rung convert` makes of it, and
// drawn as PLCopen XML. Called by tests/runner with few seeds and by hand with many.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/fuzz/generated/options.h"
#include "tests/fuzz/sfc/chart.h"
#include "tests/runner/process.h"

namespace rung::sfc_differential {
namespace {

namespace fs = std::filesystem;
constexpr uint64_t kBatch = 10;

using generated::Options;

uint32_t next(uint32_t random) { return random * 1664525u + 1013904223u; }

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
  return out;
}

// Returns the first difference, or an empty string.
std::string compare(const std::string& trace, uint64_t first, const std::vector<Chart>& charts, uint64_t cycles) {
  std::stringstream lines(trace);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> header = cells(line);
  const auto column = [&](const std::string& name) {
    return static_cast<size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line)) rows.push_back(cells(line));
  if (rows.size() != cycles) return "the trace has " + std::to_string(rows.size()) + " rows";
  std::vector<uint32_t> randoms;
  uint32_t random = static_cast<uint32_t>(first);
  for (uint64_t i = 0; i < cycles; ++i) randoms.push_back(random = next(random));
  for (size_t k = 0; k < charts.size(); ++k) {
    const std::string block = "Main.c" + std::to_string(k) + ".";
    const std::vector<Seen> expected = evaluate(charts[k], randoms, 10);
    for (uint64_t i = 0; i < cycles; ++i) {
      const auto differs = [&](const std::string& name, const std::string& value) -> std::string {
        const size_t at = column(block + name);
        const std::string got = at < rows[i].size() ? rows[i][at] : "nothing";
        if (got == value) return {};
        return "seed " + std::to_string(first + k) + ", cycle " + std::to_string(i) + ": " + name + " is " + got +
               ", expected " + value;
      };
      for (size_t s = 0; s < charts[k].steps.size(); ++s)
        if (const std::string d = differs("s" + std::to_string(s) + ".x", expected[i].active[s] ? "TRUE" : "FALSE");
            !d.empty())
          return d;
      for (int v = 0; v < kVariables; ++v)
        if (const std::string d = differs("v" + std::to_string(v), expected[i].variables[v] ? "TRUE" : "FALSE");
            !d.empty())
          return d;
      for (size_t s = 0; s < expected[i].nested_active.size(); ++s)
        if (const std::string d =
                differs(nestedStep(charts[k], s) + ".x", expected[i].nested_active[s] ? "TRUE" : "FALSE");
            !d.empty())
          return d;
      for (size_t v = 0; v < expected[i].nested_variables.size(); ++v)
        if (const std::string d = differs("w" + std::to_string(v), expected[i].nested_variables[v] ? "TRUE" : "FALSE");
            !d.empty())
          return d;
      if (const std::string d = differs("order", std::to_string(expected[i].order)); !d.empty()) return d;
    }
  }
  return {};
}

// The variables that compare() reads, in its order.
std::string watchOf(const std::vector<Chart>& charts) {
  std::string watch;
  for (size_t k = 0; k < charts.size(); ++k) {
    const Chart& chart = charts[k];
    const std::string instance = "Main.c" + std::to_string(k) + ".";
    watch += watch.empty() ? "" : ",";
    for (size_t s = 0; s < chart.steps.size(); ++s) watch += instance + "s" + std::to_string(s) + ".x,";
    for (int v = 0; v < kVariables; ++v) watch += instance + "v" + std::to_string(v) + ",";
    if (!chart.nested.empty()) {
      for (size_t s = 0; s < chart.nested[0].steps.size(); ++s) watch += instance + nestedStep(chart, s) + ".x,";
      for (int v = 0; v < kVariables; ++v) watch += instance + "w" + std::to_string(v) + ",";
    }
    watch += instance + "order";
  }
  return watch;
}

std::string runBatch(const Options& options, uint64_t first, uint64_t count) {
  std::vector<Chart> charts, drawn;
  std::string text, xml, vars, calls;
  for (uint64_t k = 0; k < count; ++k) {
    charts.push_back(generate(first + k));
    const std::string n = std::to_string(k);
    text += textOf(charts.back(), "Chart" + n);
    drawn.push_back(withoutTextForms(charts.back()));
    xml += xmlOf(drawn.back(), "Chart" + n, first + k);
    vars += " c" + n + " : Chart" + n + ";";
    calls += "c" + n + "(random := random);\n";
  }
  const std::string main = "PROGRAM Main\nVAR random : UDINT := " + std::to_string(static_cast<uint32_t>(first)) + ";" +
                           vars + " END_VAR\nrandom := random * 1664525 + 1013904223;\n" + calls + "END_PROGRAM\n";
  text += main;
  const fs::path folder = fs::path(options.folder) / std::to_string(first);
  fs::create_directories(folder);
  const fs::path source = folder / "charts.st";
  std::ofstream(source) << text;
  const auto runOnce = [&](const fs::path& program, const std::vector<Chart>& expected) -> std::string {
    tests::Command c;
    c.folder = folder;
    c.seconds = 300;
    c.arguments = {options.rung,
                   "run",
                   "--engine=" + options.engine,
                   "--cycles=" + std::to_string(options.cycles),
                   "--trace=-",
                   "--watch=" + watchOf(expected),
                   program.string()};
    const tests::Output output = tests::run(c);
    if (output.exit_code != 0) return "seed " + std::to_string(first) + ": " + output.err.substr(0, 2000);
    return compare(output.out, first, expected, options.cycles);
  };
  if (const std::string difference = runOnce(source, charts); !difference.empty()) return difference;
  tests::Command c;
  c.folder = folder;
  c.seconds = 300;
  fs::remove_all(folder / "st");
  c.arguments = {options.rung, "convert", "--to", "st", "-o", (folder / "st").string(), source.string()};
  const tests::Output output = tests::run(c);
  if (output.exit_code != 0) return "seed " + std::to_string(first) + ": convert: " + output.err.substr(0, 2000);
  if (const std::string difference = runOnce(folder / "st" / "charts.st", charts); !difference.empty())
    return "converted, " + difference;
  const fs::path project = folder / "xml";
  fs::create_directories(project);
  std::ofstream(project / "main.st") << main;
  std::ofstream(project / "charts.xml") << "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\"><types><pous>\n"
                                        << xml << "</pous></types></project>\n";
  const std::string difference = runOnce(project, drawn);
  return difference.empty() ? difference : "drawn, " + difference;
}

int run(const Options& options) {
  uint64_t bad = 0;
  for (uint64_t k = 0; k < options.count; k += kBatch) {
    const std::string difference = runBatch(options, options.first + k, std::min(kBatch, options.count - k));
    if (difference.empty()) continue;
    ++bad;
    printf("%s\n", difference.c_str());
  }
  printf("%llu charts, %llu batches differ\n", static_cast<unsigned long long>(options.count),
         static_cast<unsigned long long>(bad));
  return bad == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rung::sfc_differential

int main(int argc, char** argv) {
  using namespace rung::sfc_differential;
  Options options;
  options.cycles = 300;
  if (!rung::generated::readOptions(argc, argv, "sfc_differential", "--cycles --engine", options)) return 2;
  if (options.has_print) {
    fputs(textOf(generate(options.print), "Chart").c_str(), stdout);
    fputs(xmlOf(withoutTextForms(generate(options.print)), "Chart", options.print).c_str(), stdout);
    return 0;
  }
  const int result = run(options);
  if (!options.keeps_folder) fs::remove_all(options.folder);
  return result;
}

// SPDX-License-Identifier: Apache-2.0
// rung_conformance export DIR: the conformance programs of the project for any compiler, docs/conformance.md.
//   rung_conformance export DIR [--profile=NAME]... [--root=DIR] [PROGRAM...]
// Exit codes: 0 written, 1 a row of edition 3 is neither exported nor has a reason, or has both, 2 usage or I/O.
#include <cstdio>
#include <filesystem>

#include "frontend/source/files.h"
#include "tools/conformance/export.h"
#include "tools/driver/output_files.h"

namespace rung::conformance {
namespace {

namespace fs = std::filesystem;

int usage(const std::string& problem) {
  std::fprintf(
      stderr,
      "rung_conformance: %s\nusage: rung_conformance export DIR [--profile=ed2-text|ed3-text|ed3-oop|plcopen-xml|"
      "motion]... [--root=DIR] [PROGRAM...]\n",
      problem.c_str());
  return 2;
}
int fail(const std::string& problem) {
  std::fprintf(stderr, "rung_conformance: %s\n", problem.c_str());
  return 2;
}

std::string copyRunner(const ExportOptions& options) {
  std::error_code error;
  fs::create_directories(options.folder + "/adapters", error);
  const fs::path from = fs::path(options.root) / "tools/conformance/runner";
  for (const auto& entry : fs::recursive_directory_iterator(from, error)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".pyc") continue;
    const fs::path to = fs::path(options.folder) / entry.path().lexically_relative(from);
    fs::copy_file(entry.path(), to, fs::copy_options::overwrite_existing, error);
    if (error) return "cannot write `" + to.string() + "`: " + error.message();
  }
  return error ? from.string() + ": " + error.message() : std::string();
}

// Every row of edition 3 is exported or has its reason; only where everything was exported can that be said.
int checkRows(const Suite& suite) {
  const std::set<std::string> exported = suite.exported();
  size_t rows = 0, covered = 0;
  int exit = 0;
  for (const Feature& feature : suite.features) {
    if (feature.editions.find('3') == std::string::npos) continue;
    ++rows;
    const bool is_exported = exported.count(feature.id) != 0, has_reason = suite.reasons.count(feature.id) != 0;
    covered += is_exported ? 1 : 0;
    if (is_exported != has_reason) continue;
    exit = 1;
    std::fprintf(stderr, "%s (%s) is %s\n", feature.id.c_str(), feature.name.c_str(),
                 is_exported ? "exported and has a reason in reasons.tsv not to be"
                             : "not exported and has no reason in reasons.tsv");
  }
  std::printf("%zu of %zu rows of edition 3 (%.1f %%)\n", covered, rows,
              100.0 * static_cast<double>(covered) / static_cast<double>(rows));
  return exit;
}

int runTool(int count, char** arguments) {
  ExportOptions options;
  std::vector<std::string> words;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word.starts_with("--profile=")) {
      const Profile* profile = findProfile(word.substr(10));
      if (profile == nullptr) return usage("unknown profile `" + word.substr(10) + "`");
      options.profiles.push_back(profile);
    } else if (word.starts_with("--root=")) {
      options.root = word.substr(7);
    } else if (word.starts_with("-")) {
      return usage("unknown option `" + word + "`");
    } else {
      words.push_back(word);
    }
  }
  if (words.size() < 2 || words[0] != "export") return usage("expected `export DIR`");
  options.folder = words[1];
  options.programs.assign(words.begin() + 2, words.end());
  const bool is_whole = options.profiles.empty() && options.programs.empty();
  if (options.profiles.empty())
    for (const Profile& profile : kProfiles) options.profiles.push_back(&profile);

  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) return fail("cannot create `" + options.folder + "`: " + error.message());
  Suite suite;
  std::string problem = readTables(options.root, suite);
  if (problem.empty()) problem = exportSuite(options, suite);
  if (problem.empty()) problem = copyRunner(options);
  const std::pair<const char*, std::string> tables[] = {{"manifest.json", manifest(suite, options.profiles)},
                                                        {"rows.tsv", rowTable(suite)},
                                                        {"refusals.tsv", refusalTable(suite)}};
  for (const auto& [name, text] : tables)
    if (problem.empty()) problem = driver::writeFile(options.folder + "/" + name, text);
  if (!problem.empty()) return fail(problem);
  for (const Profile* profile : options.profiles) {
    size_t runs = 0, errors = 0;
    for (const Case& one : suite.cases)
      if (one.profile == profile) ++(one.isRun() ? runs : errors);
    std::printf("%-12s %4zu runs, %4zu errors\n", profile->name, runs, errors);
  }
  return is_whole ? checkRows(suite) : 0;
}

}  // namespace
}  // namespace rung::conformance

int main(int count, char** arguments) { return rung::conformance::runTool(count, arguments); }

// SPDX-License-Identifier: Apache-2.0
// rung_conformance: writes the conformance programs of the project for any compiler, docs/conformance.md. kHelp says
// how.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>

#include "frontend/source/files.h"
#include "tools/conformance/export.h"
#include "tools/driver/installation.h"
#include "tools/driver/output_files.h"

namespace rung::conformance {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp = R"(rung_conformance: a conformance suite for compilers of IEC 61131-3

Usage:
  rung_conformance export DIR [PROGRAM...] [OPTION...]

Commands:
  export DIR       write the suite into DIR: a folder that needs nothing of Rung;
                   DIR/README.md says how to run it
  export DIR PROGRAM...
                   only the cases of these programs, such as
                   tests/conformance/standard/table43/sr.st

Options:
  --profile=NAME   only cases of this profile; may be repeated: ed2-text,
                   ed3-text, ed3-oop, plcopen-xml, motion (default: all)
  --root=DIR       Rung's sources (default: the current folder where it has
                   them, or else those that were installed)
  --help           print this
  --version        print the version

SOURCE_DATE_EPOCH sets the date in the suite (default: that of the version).

Exit codes: 0 written, 1 a row of edition 3 is neither exported nor has a
reason, or has both, 2 wrong usage, or a file cannot be read or written.
)";

int fail(const std::string& problem) {
  std::fprintf(stderr, "rung_conformance: error: %s\n", problem.c_str());
  return 2;
}
int usage(const std::string& problem) { return fail(problem + "; see `rung_conformance --help`"); }

// Of SOURCE_DATE_EPOCH, where it is set. The error says what is wrong with it.
std::string setDate(Suite& suite) {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr || epoch[0] == '\0') return {};
  char* end = nullptr;
  const std::time_t seconds = std::strtoll(epoch, &end, 10);
  std::tm date{};
  char text[16];
  if (*end != '\0' || gmtime_r(&seconds, &date) == nullptr || std::strftime(text, sizeof text, "%Y-%m-%d", &date) != 10)
    return std::string("SOURCE_DATE_EPOCH: expected seconds since 1970, found `") + epoch + "`";
  suite.date = text;
  return {};
}

std::string replaced(std::string text, std::string_view from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// Makes the folder, or empties one that an earlier export wrote.
std::string prepareFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return "cannot create `" + folder + "`: " + error.message();
  const bool is_empty = fs::is_empty(folder, error);
  if (!error && !is_empty && !fs::exists(folder + "/manifest.json", error))
    return "`" + folder + "` is neither empty nor an exported suite";
  for (const Profile& profile : kProfiles)
    if (!error) fs::remove_all(folder + "/" + profile.name, error);
  return error ? "cannot empty `" + folder + "`: " + error.message() : std::string();
}

// The runner with its adapters, the README for this version, and the licence.
std::string copyRunner(const ExportOptions& options, const Suite& suite) {
  std::error_code error;
  fs::create_directories(options.folder + "/adapters", error);
  const fs::path from = fs::path(options.root) / "tools/conformance/runner";
  for (const auto& entry : fs::recursive_directory_iterator(from, error)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".pyc") continue;
    const fs::path to = fs::path(options.folder) / entry.path().lexically_relative(from);
    fs::copy_file(entry.path(), to, fs::copy_options::overwrite_existing, error);
    // The installed ones are data; those of a suite are to be run.
    const bool is_script = to.extension() == ".py";
    if (!error && is_script) fs::permissions(to, fs::perms(0111), fs::perm_options::add, error);
    if (error) return "cannot write `" + to.string() + "`: " + error.message();
  }
  if (error) return from.string() + ": " + error.message();
  fs::copy_file(options.root + "/LICENSE", options.folder + "/LICENSE", fs::copy_options::overwrite_existing, error);
  if (error) return "cannot copy `" + options.root + "/LICENSE`: " + error.message();
  const ReadResult readme = readFile(from.string() + "/README.md");
  if (!readme.error.empty()) return from.string() + "/README.md: " + readme.error;
  return driver::writeFile(options.folder + "/README.md",
                           replaced(replaced(readme.content, "@VERSION@", suite.version), "@DATE@", suite.date));
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

// The words after the name of the tool. Returns an exit code where the tool is done.
std::optional<int> parseWords(int count, char** arguments, ExportOptions& options) {
  options.root.clear();
  std::vector<std::string> words;
  for (int i = 1; i < count; ++i) {
    std::string word = arguments[i];
    if (word == "--help" || word == "-h") {
      std::fputs(kHelp, stdout);
      return 0;
    }
    if (word == "--version") {
      std::printf("rung_conformance %s\n", driver::version());
      return 0;
    }
    if (word == "--profile" || word == "--root") {
      if (i + 1 == count) return usage("`" + word + "` needs a value");
      word += std::string("=") + arguments[++i];
    }
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
  if (words.empty()) return usage("expected a command");
  if (words[0] != "export") return usage("unknown command `" + words[0] + "`");
  if (words.size() < 2) return usage("`export` needs the folder to write");
  options.folder = words[1];
  for (size_t i = 2; i < words.size(); ++i) options.programs.push_back(fs::path(words[i]).lexically_normal().string());
  return {};
}

// The folder with the tables of the suite. Returns an error message, or an empty string.
std::string findRoot(std::string& root) {
  std::error_code error;
  const char* const kFeatures = "tests/conformance/features.tsv";
  if (!root.empty())
    return fs::exists(root + "/" + kFeatures, error)
               ? ""
               : "`" + root + "` is not the folder of Rung's sources: it has no " + kFeatures;
  root = fs::exists(kFeatures, error) ? "." : driver::sharedFolder("conformance");
  return root.empty() ? "the current folder is not that of Rung's sources; name it with --root=DIR" : "";
}

// Writes the programs, the runner and the tables. Returns an error message, or an empty string.
std::string writeSuite(ExportOptions& options, Suite& suite) {
  std::string problem = readTables(options.root, suite);
  if (problem.empty()) problem = setDate(suite);
  std::vector<std::string> paths;
  if (problem.empty()) problem = findPrograms(options, paths);
  if (problem.empty()) problem = prepareFolder(options.folder);
  if (problem.empty()) problem = exportSuite(options, suite);
  if (problem.empty()) problem = copyRunner(options, suite);
  const std::pair<const char*, std::string> tables[] = {{"manifest.json", manifest(suite, options.profiles)},
                                                        {"rows.tsv", rowTable(suite)},
                                                        {"refusals.tsv", refusalTable(suite)}};
  for (const auto& [name, text] : tables)
    if (problem.empty()) problem = driver::writeFile(options.folder + "/" + name, text);
  return problem;
}

int runTool(int count, char** arguments) {
  ExportOptions options;
  if (const std::optional<int> exit = parseWords(count, arguments, options)) return *exit;
  const bool is_whole = options.profiles.empty() && options.programs.empty();
  if (options.profiles.empty())
    for (const Profile& profile : kProfiles) options.profiles.push_back(&profile);
  Suite suite;
  std::string problem = findRoot(options.root);
  if (problem.empty()) problem = writeSuite(options, suite);
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

// SPDX-License-Identifier: Apache-2.0
// Corrupted NCT programs, read, written as ST and checked: no crash, no hang, and whatever is wrong is said about the
// ladder, never about the ST that it becomes. RUNG_MUTATION_SEED and RUNG_MUTATION_COUNT try other mutants,
// RUNG_MUTATION_SHOW=1 prints those that fail whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <random>

#include "frontend/import/nct/nct.h"
#include "frontend/parse/parse.h"
#include "frontend/render/picture.h"
#include "frontend/source/dialect.h"
#include "sema/check.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> pathsBelow(const std::string& folder, std::string_view extension) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(std::string(RUNG_SOURCE_ROOT "/") + folder))
    if (entry.path().extension() == extension) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

// The generated programs use these, kept for all runs.
const std::vector<sema::LibraryFile>& libraryFiles() {
  static std::vector<std::unique_ptr<std::string>> texts;
  static const std::vector<sema::LibraryFile> files = [] {
    std::vector<sema::LibraryFile> list;
    for (const auto& [library, folder] :
         {std::pair{"Standard", "stdlib/standard"}, {"System", "stdlib/system"}, {"Nct", "stdlib/nct"}})
      for (const std::string& path : pathsBelow(folder, ".st")) {
        texts.push_back(std::make_unique<std::string>(path));
        const char* name = texts.back()->c_str();
        texts.push_back(std::make_unique<std::string>(readFile(path).content));
        list.push_back({library, name, *texts.back()});
      }
    return list;
  }();
  return files;
}

// A ladder as the parser gets it; no file: its reader reported errors.
struct Reading {
  Sources sources;
  Names names;
  Diagnostics diagnostics{sources};
  Tree tree;
  FileId file;

  Reading(const std::string& program, bool for_pictures) {
    std::vector<importer::Library> libraries;
    importer::ReadContext context{sources, diagnostics, libraries, {}, for_pictures};
    file = importer::nct::readProgram(context, sources.add("mutant.nct", program));
  }
};

struct Outcome {
  uint32_t errors = 0;
  std::string foreign;  // messages that are not about the ladder
};

// `E14..`, `W14..`, and the warnings of the shared analyses that name symbols of the program.
bool isAboutLadder(std::string_view code) { return code.substr(1).starts_with("14"); }

Outcome check(const std::string& program) {
  Reading reading(program, false);
  auto& [sources, names, diagnostics, tree, file] = reading;
  EXPECT_EQ(diagnostics.errorCount() == 0, static_cast<bool>(file));
  if (file) {
    sema::Options options;
    options.libraries = libraryFiles();
    for (const types::MemoryArea& area : types::nctAreas()) options.areas.push_back(area);
    text::parseFile(tree, names, sources, file, options.dialect, diagnostics);
    sema::Project project(sources, names, diagnostics, tree, options);
    sema::check(project);
  }
  Outcome out;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    out.errors += diagnostic.severity == Severity::Error;
    const std::string code = diagInfo(diagnostic.diag).code;
    if (!isAboutLadder(code))
      out.foreign +=
          "    " + std::to_string(sources.lineNumber(diagnostic.loc)) + " " + code + " " + diagnostic.message + "\n";
  }
  return out;
}

// Of a program whose lines can be read, a picture can be made, whatever its operands mean.
void checkDrawing(const std::string& program) {
  Reading reading(program, true);
  auto& [sources, names, diagnostics, tree, file] = reading;
  if (!file) return;
  text::parseFile(tree, names, sources, file, Dialect{}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.all().front().message << "\n" << program;
  for (const DeclId id : tree.list(tree.files.front().decls)) {
    const auto& pou = tree.as<PouDecl>(id);
    EXPECT_NE(std::string::npos, picture::drawNetworks(tree, names, pou.diagram, "mutant").find("</svg>"));
  }
}

uint32_t numberFrom(const char* variable, uint32_t otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr ? static_cast<uint32_t>(std::strtoul(value, nullptr, 10)) : otherwise;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

class Mutator {
 public:
  Mutator(uint32_t seed, const std::vector<std::string>& programs) : random_(seed) {
    for (const std::string& program : programs)
      for (const std::string& line : linesOf(program)) {
        lines_.push_back(line);
        for (const std::string& word : wordsOf(line)) words_.push_back(word);
      }
  }

  std::string mutant(const std::string& program) {
    std::vector<std::string> lines = linesOf(program);
    if (below(2) == 0) rename(lines);
    for (size_t n = below(3); n > 0; --n) changeLine(lines);
    std::string text;
    for (const std::string& line : lines) text += line + (below(200) == 0 ? "\r\n" : "\n");
    if (below(20) == 0) text.resize(below(text.size()));
    return text;
  }
  size_t below(size_t n) { return static_cast<size_t>(random_() % n); }

 private:
  static std::vector<std::string> wordsOf(const std::string& line) {
    std::vector<std::string> words;
    for (size_t at = line.find_first_not_of(' '); at != std::string::npos; at = line.find_first_not_of(' ', at)) {
      const size_t end = std::min(line.find(' ', at), line.size());
      words.push_back(line.substr(at, end - at));
      at = end;
    }
    return words;
  }

  // Gives a symbol a name that means something else, everywhere.
  void rename(std::vector<std::string>& lines) {
    std::vector<std::string> names;
    for (const std::string& line : lines) {
      const std::vector<std::string> words = wordsOf(line);
      if (words.size() > 1 && words[1].starts_with("PLCRAM")) names.push_back(words[0]);
    }
    if (names.empty()) return;
    const std::string from = names[below(names.size())], to = kNames[below(std::size(kNames))];
    for (std::string& line : lines) {
      std::string changed;
      for (const std::string& word : wordsOf(line)) changed += "  " + (word == from ? to : word);
      line = changed;
    }
  }

  void changeLine(std::vector<std::string>& lines) {
    const size_t at = below(lines.size());
    const auto place = lines.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(6)) {
      case 0: lines.erase(place); break;
      case 1: lines.insert(place, lines_[below(lines_.size())]); break;
      case 2: std::swap(lines[at], lines[below(lines.size())]); break;
      case 3: lines.insert(place, lines[at]); break;
      case 4: changeWord(lines[at]); break;
      default: changeCharacters(lines[at]); break;
    }
    if (lines.empty()) lines.emplace_back();
  }
  void changeWord(std::string& line) {
    std::vector<std::string> words = wordsOf(line);
    if (words.empty()) return;
    words[below(words.size())] =
        below(3) == 0 ? std::string(kStrays[below(std::size(kStrays))]) : words_[below(words_.size())];
    line.clear();
    for (const std::string& word : words) line += "  " + word;
  }
  void changeCharacters(std::string& line) {
    const size_t at = below(line.size() + 1), length = std::min(below(3), line.size() - at);
    line.replace(at, length,
                 below(2) == 0 ? std::string(1, static_cast<char>(below(256)))
                               : std::string(kStrays[below(std::size(kStrays))]));
  }

  static constexpr const char* kNames[] = {
      "INT",      "if",           "END_PROGRAM",   "NCT_MEMORY", "Nct_Add",  "NCT_FLAGS",  "_cyclic", "_kept",
      "_5024",    "_5024_01",     "_sub1",         "_sub7",      "_p1",      "_box1",      "_edge1",  "_flags",
      "_started", "l1",           "DWORD_TO_DINT", "SEL",        "TRUE",     "Main",       "Int0",    "EXPT",
      "TON",      "R_TRIG",       "LEN",           "PLC",        "value",    "address",    "first",   "EN",
      "Q",        "control_Main", "timers_main",   "Nct",        "Standard", "TASK_LTIME", "ABS",     "_message"};
  static constexpr const char* kStrays[] = {"@",           "%",      "!",           ",",           ";",
                                            ":",           ".",      "#",           "#$",          "*",
                                            "\"",          "//",     "(",           "|",           ")",
                                            "[",           "]",      "TO",          "AT",          "9999",
                                            "0000",        "10000",  "32",          ".31",         ",#-1",
                                            ",#9999",      ",IDX",   ":IDX",        "#2147483648", "#-2147483648",
                                            "#$FFFFFFFFF", "*1e400", "*.",          "FLAGS",       "FL_ER",
                                            "INT",         "IF",     "END_PROGRAM", "NCT_MEMORY",  "NCT_ADD",
                                            "_cyclic",     "_5024",  "_sub7",       "l1",          "DWORD_TO_DINT",
                                            "SEL",         "TRUE",   "Main",        "N_ON",        "N_OFF",
                                            "RET",         "END",    "JMP 1",       "SBN 3",       "MODULE INT0",
                                            "EXPT"};

  std::mt19937 random_;
  std::vector<std::string> lines_, words_;
};

std::vector<std::string> programs() {
  std::vector<std::string> all;
  for (const char* folder : {"tests", "samples"})
    for (const std::string& path : pathsBelow(folder, ".nct"))
      if (!path.ends_with("/message_file.nct"))  // its texts are in a file beside it, which this test does not read
        all.push_back(readFile(path).content);
  return all;
}

TEST(LadderMutation, what_is_wrong_is_said_about_the_ladder) {
  const std::vector<std::string> all = programs();
  for (const std::string& program : all) {
    const Outcome out = check(program);
    ASSERT_EQ(0u, out.errors) << program.substr(0, 100) << "\n" << out.foreign;
    EXPECT_EQ("", out.foreign) << program.substr(0, 100);
    checkDrawing(program);
  }
  Mutator mutator(numberFrom("RUNG_MUTATION_SEED", 1440), all);
  const uint32_t count = numberFrom("RUNG_MUTATION_COUNT", 400);
  const bool shows = numberFrom("RUNG_MUTATION_SHOW", 0) != 0;
  uint32_t wrong = 0;
  for (uint32_t k = 0; k < count; ++k) {
    const std::string mutant = mutator.mutant(all[mutator.below(all.size())]);
    const std::clock_t begin = std::clock();
    const Outcome out = check(mutant);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 5.0);
    wrong += out.errors > 0;
    if (k % 4 == 0) checkDrawing(mutant);
    EXPECT_EQ("", out.foreign) << "mutant " << k << (shows ? "\n" + mutant : std::string());
    if (HasFailure()) return;
  }
  std::printf("%u of %u mutants are wrong\n", wrong, count);
  EXPECT_GE(wrong, count / 4);
}

TEST(LadderMutation, large_and_deep_programs_end) {
  const std::string head = "PROGRAM p\nMODULE MAIN\nRUNG\n  IN N_ON\n";
  std::string deep = head, wide = head + "(\n", garbage, words = head + "  MOV", symbols = "PROGRAM p\nSYMBOLS\n";
  for (uint32_t k = 0; k < 100000; ++k) deep += "(\n";
  for (uint32_t k = 0; k < 20000; ++k) wide += "  IN PLCRAM.00\n|\n";
  for (uint32_t k = 0; k < 300000; ++k) garbage += static_cast<char>(k * 7919 % 256);
  for (uint32_t k = 0; k < 100000; ++k) words += " PLCRAM";
  for (uint32_t k = 0; k < 20000; ++k) symbols += "S" + std::to_string(k) + " S" + std::to_string(k + 1) + ",#1\n";
  for (const std::string& program :
       {deep, wide + "  IN N_ON\n)\n  OUT PLCRAM.01\nEND_MODULE\n", garbage, words, symbols + "END_SYMBOLS\n"}) {
    const std::clock_t begin = std::clock();
    check(program);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 20.0) << program.substr(0, 60);
  }
}

}  // namespace
}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// One wrong token, one error, on its line: valid programs are corrupted token by token and checked, parser and sema
// together; the tree of each still prints its source. The seed is fixed; RUNG_MUTATION_SEED and RUNG_MUTATION_COUNT try
// others, RUNG_MUTATION_SHOW=1 prints each mutant that has its first error elsewhere, or more than one.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <span>

#include "frontend/parse/lexer.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/source_view.h"
#include "sema/check.h"

namespace rung {
namespace {

namespace fs = std::filesystem;
using text::Tok;

constexpr const char* kPrograms[] = {
    "samples/tank/tank.st",
    "samples/traffic_light/traffic_light.st",
    "samples/conveyor/conveyor.st",
    "tests/conformance/manuals/tm_tp_5_2/loops.st",
    "tests/conformance/manuals/tm_tp_5_2/selection.st",
    "tests/conformance/manuals/tm_tp_5_2/expressions.st",
    "tests/conformance/standard/iec_syntax_5_6/arrays.st",
    "tests/conformance/standard/iec_syntax_5_6/statements.st",
    "tests/conformance/standard/table46/ton.st",
    "tests/conformance/language/semantics/names_like_library_blocks.st",
};

constexpr const char* kInstructionLists[] = {
    "tests/conformance/standard/table67/deferred.st",
    "tests/conformance/standard/table68/arithmetic.st",
    "tests/conformance/standard/table68/comparisons.st",
    "tests/conformance/standard/table68/control.st",
    "tests/conformance/standard/table68/loads_and_stores.st",
    "tests/conformance/standard/table68/logic.st",
    "tests/conformance/standard/table69/calls.st",
    "tests/conformance/standard/table69/methods.st",
};
constexpr const char* kCharts[] = {
    "tests/conformance/standard/table54/steps.st",
    "tests/conformance/standard/table55/transitions.st",
    "tests/conformance/standard/table56/charts_in_actions.st",
    "tests/conformance/standard/table59/qualifiers.st",
    "tests/conformance/standard/table61/parallel.st",
    "tests/conformance/standard/table61/selection.st",
    "tests/conformance/manuals/tm_tp_5_5/macro_steps.st",
    "tests/conformance/manuals/tm_tp_5_5/step_times.st",
};

// The sources of the libraries that the programs use, kept for all runs.
const std::vector<sema::LibraryFile>& libraryFiles() {
  static std::vector<std::unique_ptr<std::string>> texts;
  static const std::vector<sema::LibraryFile> files = [] {
    std::vector<sema::LibraryFile> list;
    const auto add = [&](const char* library, const char* folder) {
      std::vector<std::string> paths;
      for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".st") paths.push_back(entry.path().string());
      std::sort(paths.begin(), paths.end());
      for (const std::string& path : paths) {
        texts.push_back(std::make_unique<std::string>(path));
        const char* name = texts.back()->c_str();
        texts.push_back(std::make_unique<std::string>(readFile(path).content));
        list.push_back({library, name, *texts.back()});
      }
    };
    add("Standard", RUNG_SOURCE_ROOT "/stdlib/standard");
    add("IecSfc", RUNG_SOURCE_ROOT "/stdlib/iecsfc");
    return list;
  }();
  return files;
}

struct Outcome {
  uint32_t errors = 0;
  uint32_t first_line = 0;
  std::string messages;
};

Outcome check(const std::string& program) {
  Sources sources;
  Names names;
  Diagnostics diagnostics(sources);
  Tree tree;
  sema::Options options;
  options.libraries = libraryFiles();
  const FileId file = sources.add("mutant.st", program);
  const FileUnit unit = text::parseFile(tree, names, sources, file, options.dialect, diagnostics);
  EXPECT_EQ(printSource(tree, unit, sources), program);
  sema::Project project(sources, names, diagnostics, tree, options);
  sema::check(project);
  diagnostics.sort();
  Outcome out;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (diagnostic.severity != Severity::Error) continue;
    const uint32_t line = sources.lineNumber(diagnostic.loc);
    if (out.errors++ == 0) out.first_line = line;
    out.messages +=
        "    " + std::to_string(line) + " " + diagInfo(diagnostic.diag).code + " " + diagnostic.message + "\n";
  }
  return out;
}

struct Piece {
  uint32_t begin, length, line;
  Tok kind;
};

std::vector<Piece> piecesOf(const std::string& program) {
  Sources sources;
  Names names;
  Diagnostics diagnostics(sources);
  const FileId file = sources.add("program.st", program);
  text::TokenStream stream;
  text::lex(stream, names, sources, file, 0, static_cast<uint32_t>(program.size()), Dialect::Codesys, diagnostics);
  std::vector<Piece> pieces;
  for (const text::Token& token : stream.tokens) {
    if (token.kind == Tok::End) break;
    const Loc loc{sources.begin(file).offset + token.offset};
    const bool named = text::isName(token.kind) || text::isTypeWord(token.kind);
    const auto length = named ? static_cast<uint32_t>(names.string({token.value}).size()) : token.value;
    pieces.push_back({token.offset, length, sources.lineNumber(loc), token.kind});
  }
  return pieces;
}

enum class Kind : uint8_t { Delete, Double, Misspell, Replace, Insert };
constexpr const char* kKindNames[] = {"delete", "double", "misspell", "replace", "insert"};

class Mutator {
 public:
  explicit Mutator(uint32_t seed) : random_(seed) {}

  uint32_t below(size_t n) { return static_cast<uint32_t>(random_() % n); }

  // Corrupts one piece; `what` describes the change.
  std::string mutate(const std::string& program, const std::vector<Piece>& pieces, uint32_t& line, std::string& what) {
    const Piece& piece = pieces[below(pieces.size())];
    const std::string own = program.substr(piece.begin, piece.length);
    const auto kind = static_cast<Kind>(below(5));
    std::string put;
    switch (kind) {
      case Kind::Delete: break;
      case Kind::Double: put = own + ' ' + own; break;
      case Kind::Misspell: put = misspelled(own); break;
      case Kind::Replace: put = ' ' + std::string(stray()) + ' '; break;
      case Kind::Insert: put = own + ' ' + stray(); break;
    }
    line = piece.line;
    what = std::string(kKindNames[static_cast<size_t>(kind)]) + " `" + own + "` -> `" + put + "`";
    return program.substr(0, piece.begin) + put + program.substr(piece.begin + piece.length);
  }

 private:
  const char* stray() {
    static constexpr const char* kStrays[] = {
        ";",  ":", ":=", ",",    ".",  "(",  ")",   "[",   "]",  "=",   "<>",   "+",    "-",      "*",     "..",
        "=>", "#", "IF", "THEN", "DO", "OF", "AND", "NOT", "42", "1.5", "TRUE", "'it'", "END_IF", "stray", "INT"};
    return kStrays[below(std::size(kStrays))];
  }
  std::string misspelled(std::string word) {
    if (word.size() < 2) return word + word;
    const uint32_t at = below(word.size() - 1);
    switch (below(3)) {
      case 0: std::swap(word[at], word[at + 1]); break;
      case 1: word.erase(at, 1); break;
      default: word.insert(at, 1, word[at]); break;
    }
    return word;
  }

  std::mt19937 random_;  // its sequence is the same everywhere
};

uint32_t numberFrom(const char* variable, uint32_t otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr ? static_cast<uint32_t>(std::strtoul(value, nullptr, 10)) : otherwise;
}

// Corrupts the programs one after the other; prints how many of the first errors are on the line of the wrong token,
// and how many errors there are.
void spoil(std::span<const char* const> paths, uint32_t seed, uint32_t count, double least_share, double most_errors) {
  std::vector<std::string> programs;
  std::vector<std::vector<Piece>> pieces;
  for (const char* path : paths) {
    programs.push_back(readFile(std::string(RUNG_SOURCE_ROOT "/") + path).content);
    pieces.push_back(piecesOf(programs.back()));
    ASSERT_FALSE(pieces.back().empty()) << path;
    ASSERT_EQ(check(programs.back()).messages, "") << path;
  }
  Mutator mutator(numberFrom("RUNG_MUTATION_SEED", seed));
  const uint32_t wanted = numberFrom("RUNG_MUTATION_COUNT", count);
  const bool show = std::getenv("RUNG_MUTATION_SHOW") != nullptr;
  uint32_t invalid = 0, on_line = 0, errors = 0;
  for (uint32_t tries = 0; invalid < wanted && tries < 10 * wanted; ++tries) {
    const size_t which = tries % programs.size();
    uint32_t line = 0;
    std::string what;
    const std::string mutant = mutator.mutate(programs[which], pieces[which], line, what);
    const Outcome outcome = check(mutant);
    if (outcome.errors == 0) continue;  // still a program
    ++invalid;
    on_line += outcome.first_line == line ? 1 : 0;
    errors += outcome.errors;
    if (show && (outcome.errors > 1 || outcome.first_line != line))
      std::printf("%s:%u: %s\n%s", paths[which], line, what.c_str(), outcome.messages.c_str());
  }
  ASSERT_GE(invalid, wanted);
  const double share = 100.0 * on_line / invalid, average = 1.0 * errors / invalid;
  std::printf("%u invalid mutants: first error on the line %.1f %%, %.3f errors on average\n", invalid, share, average);
  EXPECT_GE(share, least_share);
  EXPECT_LE(average, most_errors);
}

TEST(Mutation, one_error_on_the_line_of_the_unexpected_token) { spoil(kPrograms, 1131, 300, 90.0, 1.1); }
TEST(Mutation, one_error_in_instruction_lists) { spoil(kInstructionLists, 1132, 1000, 90.0, 1.1); }
TEST(Mutation, one_error_in_charts) { spoil(kCharts, 1133, 300, 90.0, 1.1); }

}  // namespace
}  // namespace rung

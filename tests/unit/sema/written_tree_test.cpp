// SPDX-License-Identifier: Apache-2.0
// Checking does not change what was written: over all programs of the suite, the tree prints as it did before.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "frontend/parse/parse.h"
#include "sema/check.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesBelow(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(std::string(RUNG_SOURCE_ROOT) + folder))
    if (entry.path().extension() == ".st") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Every library, each by the name of its folder. Sources are kept for all runs.
const std::vector<sema::LibraryFile>& libraryFiles() {
  static std::vector<std::unique_ptr<std::string>> texts;
  const auto keep = [](std::string text) {
    texts.push_back(std::make_unique<std::string>(std::move(text)));
    return std::string_view(*texts.back());
  };
  static const std::vector<sema::LibraryFile> files = [&] {
    std::vector<sema::LibraryFile> list;
    for (const std::string& path : filesBelow("/stdlib")) {
      std::string library = fs::path(path).parent_path().filename().string();
      if (library == "__system") library = "__SYSTEM";
      list.push_back({keep(library).data(), keep(path).data(), keep(readFile(path).content)});
    }
    return list;
  }();
  return files;
}

std::string printFiles(const Tree& tree, const Names& names, const Sources& sources, size_t count) {
  std::string out;
  for (size_t i = 0; i < count; ++i) out += printTree(tree, names, sources, tree.files[i]);
  return out;
}

// True when the program has no errors.
bool checkProgram(const std::string& path, Dialect dialect) {
  Sources sources;
  Names names;
  Diagnostics diagnostics(sources);
  Tree tree;
  sema::Options options;
  options.dialect = dialect;
  options.libraries = libraryFiles();
  text::parseFile(tree, names, sources, sources.add(path, readFile(path).content), dialect, diagnostics);
  const size_t files = tree.files.size();
  const std::string before = printFiles(tree, names, sources, files);
  sema::Project project(sources, names, diagnostics, tree, options);
  sema::check(project);
  EXPECT_EQ(printFiles(tree, names, sources, files), before) << path;
  return !diagnostics.hasErrors();
}

TEST(WrittenTree, PrintsAsBeforeChecking) {
  uint32_t correct = 0;
  for (const char* folder : {"/tests/conformance", "/tests/programs", "/tests/golden", "/samples"})
    for (const std::string& path : filesBelow(folder))
      for (const Dialect dialect : {Dialect::Codesys, Dialect::Iec3}) correct += checkProgram(path, dialect) ? 1 : 0;
  EXPECT_GT(correct, 300u);
}

}  // namespace
}  // namespace rung

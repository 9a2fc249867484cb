// SPDX-License-Identifier: Apache-2.0
// A parsed file and the nodes in it, for the tests of ranges; and all programs of the tests, samples and libraries.
#pragma once

#include <filesystem>
#include <string>

#include "frontend/parse/parse.h"
#include "frontend/syntax/node_at.h"

namespace rung {

struct ParsedFile {
  explicit ParsedFile(std::string source) : diagnostics(sources) {
    diagnostics.max_errors = 1000000;
    file = sources.add("test.st", std::move(source));
    unit = text::parseFile(tree, names, sources, file, Dialect::Codesys, diagnostics);
  }
  std::string_view textOf(Range range) const {
    return sources.sourceText(file).substr(range.begin.offset - begin(), range.end.offset - range.begin.offset);
  }
  uint32_t begin() const { return sources.begin(file).offset; }
  uint32_t size() const { return static_cast<uint32_t>(sources.sourceText(file).size()); }
  std::vector<NodeRef> at(uint32_t offset) const { return nodeAt(tree, unit, {begin() + offset}); }
  // The source of the innermost node around `marked`, and of those around it.
  std::string pathTo(std::string_view marked) const {
    std::string out;
    for (const NodeRef node : at(static_cast<uint32_t>(sources.sourceText(file).find(marked))))
      out.insert(0, "[" + std::string(textOf(extentOf(tree, node))) + "]");
    return out;
  }

  Sources sources;
  Names names;
  Diagnostics diagnostics;
  Tree tree;
  FileId file;
  FileUnit unit;
};

template <class Check>
uint32_t forEachProgram(std::initializer_list<const char*> folders, Check check) {
  uint32_t count = 0;
  for (const char* folder : folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(RUNG_SOURCE_ROOT) + folder)) {
      if (entry.path().extension() != ".st") continue;
      check(ParsedFile(readFile(entry.path().string()).content), entry.path().string());
      ++count;
    }
  return count;
}

// Parses the file cut off, without a piece and with wrong tokens, at several places.
template <class Check>
void forEachMutant(const ParsedFile& f, Check check) {
  const std::string source(f.sources.original(f.file));
  for (size_t cut = 7; cut < source.size(); cut += 97 + source.size() / 5)
    for (const std::string& broken : {source.substr(0, cut), source.substr(0, cut - 5) + source.substr(cut),
                                      source.substr(0, cut) + " ) END_IF @ ELSE ; " + source.substr(cut)})
      check(ParsedFile(broken));
}

}  // namespace rung

// SPDX-License-Identifier: Apache-2.0
// Parses a source. Out: the tree in its text form, and the diagnostics as "line:column code".
#pragma once

#include <string>

#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"

namespace rung::text {

struct Parsed {
  explicit Parsed(const std::string& source, Dialect dialect = Dialect::Codesys) : diagnostics(sources) {
    diagnostics.max_errors = 1000000;
    const FileId file = sources.add("test.st", source);
    const FileUnit unit = parseFile(tree, names, sources, file, dialect, diagnostics);
    printed = printTree(tree, names, sources, unit);
    diagnostics.sort();
  }
  // "3:7 E0201 5:1 W0250"
  std::string codes() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) {
      const SourceLocation location = sources.location(d.loc);
      if (!all.empty()) all += ' ';
      all += std::to_string(location.line) + ":" + std::to_string(location.column) + " " + diagInfo(d.diag).code;
    }
    return all;
  }

  Sources sources;
  Diagnostics diagnostics;
  Names names;
  Tree tree;
  std::string printed;
};

// The statements, indented two blanks less, of a program around them.
inline std::string body(const std::string& statements, Dialect dialect = Dialect::Codesys) {
  const Parsed parsed("PROGRAM p\n" + statements + "\nEND_PROGRAM\n", dialect);
  if (!parsed.codes().empty()) return parsed.codes();
  const size_t at = parsed.printed.find("  body\n");
  return at == std::string::npos ? parsed.printed : parsed.printed.substr(at + 7);
}
inline std::string statementErrors(const std::string& statements, Dialect dialect = Dialect::Codesys) {
  return Parsed("PROGRAM p\n" + statements + "\nEND_PROGRAM\n", dialect).codes();
}

}  // namespace rung::text

// SPDX-License-Identifier: Apache-2.0
// The symbols of a file, as an outline, and those of a project that match what somebody types. In: a view. Out: names,
// kinds and places. Both read the declarations as written, so that a file with errors has them too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

enum class SymbolKind : uint8_t {
  Program,
  FunctionBlock,
  Class,
  Interface,
  Function,
  Method,
  Action,
  Property,
  Variable,
  Constant,
  Field,
  Type,
  Structure,
  Enumeration,
  Item,
  Namespace,
  Configuration,
  Resource,
  Task,
  Step,
  Transition
};

SymbolKind symbolKindOf(PouKind kind);

struct Symbol {
  std::string name;
  std::string detail;  // the type as written, or the keyword of a section
  SymbolKind kind;
  FileRange range;       // the whole declaration
  FileRange name_range;  // inside of `range`
  std::vector<Symbol> children;
};

// Nested as the declarations are.
std::vector<Symbol> symbolsOf(const View& view, FileId file);

struct FoundSymbol {
  Symbol symbol;          // its name; without detail and children
  std::string container;  // the POU or type around it
  int score = 0;          // the larger the better
};
// Global declarations and members, but no local variables, whose names have the letters of `query` in this order; the
// best first, at most `most`. An empty query matches all.
std::vector<FoundSymbol> symbolsMatching(const View& view, std::string_view query, size_t most);

// How well a name matches; 0: it has not all letters of the query. Beginnings of words count more than letters inside.
int matchScore(std::string_view name, std::string_view query);

}  // namespace rung::ide

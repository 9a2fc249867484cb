// SPDX-License-Identifier: Apache-2.0
// What could be written at the cursor. In: a view and a byte of a file. Out: names, members, pins, enumeration values,
// types, keywords, pragmas, keys of rung.project; the best first. Only what the place takes: no statement inside of an
// expression, no type where a value belongs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/ide/library_index.h"
#include "tools/ide/meanings.h"
#include "tools/ide/view.h"

namespace rung::ide {

enum class CompletionKind : uint8_t {
  Variable,
  Constant,
  Field,
  Pin,
  Function,
  Method,
  Property,
  Block,
  Interface,
  Structure,
  Enumeration,
  Item,
  Type,
  List,
  Keyword,
  Snippet,
  Pragma,
  Key
};

// Whether what is there with the item is a program.
enum class Fit : uint8_t {
  Whole,  // it is
  Tried,  // a trial decides; without one it is taken for one
  Part    // it needs more: only offered to who has typed a letter
};

struct CompletionItem {
  std::string label;
  CompletionKind kind;
  std::string detail;       // its type
  std::string insert;       // empty: the label
  bool is_snippet = false;  // `insert` has places to fill in: ${1:IN}
  uint8_t rank = 9;         // the smaller the better
  Fit fit = Fit::Whole;
  std::string key;                // of what is tried: those of one key are good or bad together
  std::string tried;              // in its place; empty: itself
  bool is_tried_in_copy = false;  // the trial reads what the project has not read yet
  std::string documentation;      // of what is not an entity
  Entity entity;
  const LibraryName* library = nullptr;
};
struct Completion {
  std::vector<CompletionItem> items;
  bool is_incomplete = false;  // more letters find more
  FileRange replaced;          // what of the name is typed already
};
// Workspace::errorsOf, Workspace::errorsInCopy and Workspace::goodTypes.
class CompletionTrial {
 public:
  virtual ~CompletionTrial() = default;
  virtual std::optional<std::vector<std::string>> errorsOf(PouId pou, const std::vector<std::string>& statements,
                                                           bool in_copy) = 0;
  virtual std::optional<std::string> goodTypes(const workspace::Analysis::TypeTrial& trial) = 0;
};

// What makes a program, as far as a trial can tell. Names of libraries come with the first letter, and the rest that
// the place takes where nothing that begins so makes a program.
Completion completionsAt(const View& view, const LibraryIndex& libraries, FileId file, uint32_t byte,
                         CompletionTrial& trial);

// The declaration and documentation of an item, as Markdown.
std::string documentationOf(const View& view, const CompletionItem& item);

}  // namespace rung::ide

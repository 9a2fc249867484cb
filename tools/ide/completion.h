// SPDX-License-Identifier: Apache-2.0
// What could be written at the cursor. In: a view and a byte of a file. Out: names, members, pins, enumeration values,
// types, keywords, pragmas, keys of rung.project; the best first. Only what the place takes: no statement inside of an
// expression, no type where a value belongs.
#pragma once

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

struct CompletionItem {
  std::string label;
  CompletionKind kind;
  std::string detail;         // its type
  std::string insert;         // empty: the label
  bool is_snippet = false;    // `insert` has places to fill in: ${1:IN}
  uint8_t rank = 9;           // the smaller the better
  std::string documentation;  // of what is not an entity
  Entity entity;
  const LibraryName* library = nullptr;
};
struct Completion {
  std::vector<CompletionItem> items;
  bool is_incomplete = false;  // more letters find more
  FileRange replaced;          // what of the name is typed already
};
Completion completionsAt(const View& view, const LibraryIndex& libraries, FileId file, uint32_t byte);

// The declaration and documentation of an item, as Markdown.
std::string documentationOf(const View& view, const CompletionItem& item);

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// What the libraries declare, whether or not a program uses it. In: the libraries that are built in, and those of -I.
// Out: names with the source of their declarations, for completion and signatures. Made once for all projects.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/source/dialect.h"
#include "tools/driver/libraries.h"

namespace rung::ide {

struct LibraryName {
  std::string_view name, library;
  std::string_view source;  // of the file
  uint32_t begin, end;      // the declaration in it
  uint8_t standards;        // the dialects that have the name, as bits
};

struct LibraryUse;  // library_calls.h

class LibraryIndex {
 public:
  explicit LibraryIndex(const driver::ProjectOptions& options);
  ~LibraryIndex();

  const std::vector<LibraryName>& all() const { return names_; }
  // The first of this name that the dialect has; null: none.
  const LibraryName* find(std::string_view name, Dialect dialect) const;
  // How many files a library has.
  uint32_t filesOf(std::string_view library) const;
  // useOf() of one of the names, which is read once.
  const LibraryUse& useOf(const LibraryName& name) const;

 private:
  std::unique_ptr<driver::LibrarySet> libraries_;
  std::vector<LibraryName> names_;
  std::unordered_map<std::string_view, uint32_t> files_;  // by library
  mutable std::unordered_map<const LibraryName*, std::unique_ptr<LibraryUse>> uses_;
  std::unordered_map<std::string, std::vector<uint32_t>> by_name_;  // in lower case
};

}  // namespace rung::ide

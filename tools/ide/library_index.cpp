// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/library_index.h"

#include "frontend/source/names.h"
#include "sema/declarations/libraries.h"

namespace rung::ide {

// A library of -I that cannot be read is reported by each check of a project.
LibraryIndex::LibraryIndex(const driver::ProjectOptions& options) : libraries_(std::make_unique<driver::LibrarySet>()) {
  static_cast<void>(libraries_->load(options));
  for (const sema::LibraryFile& file : libraries_->files()) {
    if (std::string_view(file.library).starts_with("__")) continue;
    for (const sema::IndexedBlock& block : sema::indexLibrary(file.source))
      for (const std::string_view name : block.names) {
        if (name.starts_with("__")) continue;
        by_name_[foldedIdentifier(name)].push_back(static_cast<uint32_t>(names_.size()));
        names_.push_back({name, file.library, file.source, block.begin, block.end, block.standards});
      }
  }
}

const LibraryName* LibraryIndex::find(std::string_view name, Dialect dialect) const {
  const auto found = by_name_.find(foldedIdentifier(name));
  if (found == by_name_.end()) return nullptr;
  for (const uint32_t index : found->second)
    if (names_[index].standards & sema::bitOf(dialect)) return &names_[index];
  return nullptr;
}

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/library_index.h"

#include "frontend/source/names.h"
#include "sema/declarations/libraries.h"
#include "tools/ide/library_calls.h"

namespace rung::ide {

// A library of -I that cannot be read is reported by each check of a project.
LibraryIndex::LibraryIndex(const driver::ProjectOptions& options) : libraries_(std::make_unique<driver::LibrarySet>()) {
  static_cast<void>(libraries_->load(options));
  for (const sema::LibraryFile& file : libraries_->files()) {
    if (std::string_view(file.library).starts_with("__")) continue;
    ++files_[file.library];
    for (const sema::IndexedBlock& block : sema::indexLibrary(file.source))
      for (const std::string_view name : block.names) {
        if (name.starts_with("__")) continue;
        by_name_[foldedIdentifier(name)].push_back(static_cast<uint32_t>(names_.size()));
        names_.push_back({name, file.library, file.source, block.begin, block.end, block.standards});
      }
  }
}

LibraryIndex::~LibraryIndex() = default;

uint32_t LibraryIndex::filesOf(std::string_view library) const {
  const auto found = files_.find(library);
  return found == files_.end() ? 0 : found->second;
}

const LibraryUse& LibraryIndex::useOf(const LibraryName& name) const {
  std::unique_ptr<LibraryUse>& use = uses_[&name];
  if (!use) use = std::make_unique<LibraryUse>(ide::useOf(name));
  return *use;
}

const LibraryName* LibraryIndex::find(std::string_view name, Dialect dialect) const {
  const auto found = by_name_.find(foldedIdentifier(name));
  if (found == by_name_.end()) return nullptr;
  for (const uint32_t index : found->second)
    if (names_[index].standards & sema::bitOf(dialect)) return &names_[index];
  return nullptr;
}

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// Files that exist only in the tool, for an editor that wants to open them: the sources of libraries, and the pages of
// diagnostics. In: their names. Out: paths of copies in the cache of Rung, written when they are first asked for.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tools/driver/cache.h"

namespace rung::ide {

class EmbeddedFiles {
 public:
  EmbeddedFiles();

  // `standard/bistable.st` and its text; empty: it is not a file of a library, or cannot be written.
  std::string pathOfLibrary(std::string_view name, std::string_view text) const;
  // Of `E0401`.
  std::string pathOfPage(std::string_view code) const;
  bool isEmbedded(std::string_view path) const { return !folder_.empty() && path.starts_with(folder_); }

 private:
  std::string write(const std::string& below, std::string_view text) const;

  driver::Cache cache_;
  std::string folder_;                                // empty: there is no cache
  mutable std::map<std::string, std::string> known_;  // paths, by what is below the folder
};

}  // namespace rung::ide

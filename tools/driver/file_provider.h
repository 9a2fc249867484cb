// SPDX-License-Identifier: Apache-2.0
// Where source files are read from: memory, which holds the unsaved texts of an editor, else disk. In: paths, absolute
// or relative to the folder of the process. Called by inputs.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "frontend/source/files.h"
#include "tools/driver/options.h"

namespace rung::driver {

// The path from the root, without `.`, `..` and a slash at its end.
std::string absolutePath(const std::string& path);

// The names in a folder except hidden ones, sorted; none: it cannot be read.
std::vector<std::string> namesIn(const std::string& folder);

class FileProvider {
 public:
  explicit FileProvider(const std::vector<UnsavedFile>& unsaved);

  ReadResult read(const std::string& path) const;
  bool isUnsaved(const std::string& path) const { return find(path) != nullptr; }
  // The unsaved files in a folder, and in folders inside, that are not on disk; relative to the folder.
  std::vector<std::string> newFilesIn(const std::string& folder) const;

 private:
  const std::string* find(const std::string& path) const;

  std::map<std::string, const std::string*> texts_;  // by absolute path
};

}  // namespace rung::driver

// The libraries that a program may use: those built into the tool (stdlib/*/*.st) and those of -I folders.
// In: Options. Out: their texts, which live as long as this object. Called by compile.cpp and list.cpp.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "sema/project.h"
#include "tools/rung/options.h"

namespace rung::tool {

class LibrarySet {
 public:
  // The error names what could not be read.
  [[nodiscard]] std::string load(const Options& options);
  const std::vector<sema::LibraryFile>& files() const { return files_; }
  const std::vector<sema::LibraryAlias>& aliases() const { return aliases_; }
  const std::vector<std::string>& read() const { return read_; }  // files and folders of -I, for depfiles

 private:
  [[nodiscard]] std::string addFolder(const std::string& folder, bool with_folders);

  std::vector<sema::LibraryFile> files_;
  std::vector<sema::LibraryAlias> aliases_;
  std::deque<std::string> texts_;
  std::vector<std::string> read_;
};

}  // namespace rung::tool

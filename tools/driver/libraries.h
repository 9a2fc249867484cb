// SPDX-License-Identifier: Apache-2.0
// The libraries that a program may use: those built into the tool (stdlib/*/*.st and, by family, stdlib/*/*/*.st) and
// those of -I in ST. In: Options. Out: their sources, which live as long as this object. Called by compile.cpp and
// list.cpp.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "sema/options.h"
#include "tools/driver/options.h"

namespace rung::driver {

// `-I PATH` and `-I NAME=PATH`.
struct LibraryPath {
  std::string called;  // empty: after the folder or file
  std::string path;

  std::string name() const;
};
LibraryPath libraryPath(const std::string& written);

// Tells whether a LibrarySet reads this file; inputs.cpp reads those of other formats.
bool isLibraryInSt(const std::string& path);

class LibrarySet {
 public:
  // The error names the file that could not be read.
  [[nodiscard]] std::string load(const ProjectOptions& options);
  // A file of a library that was read from another format.
  void addFile(const std::string& library, const std::string& path, FileId file, std::string_view text);
  // Another name for a library: `Std.TON` when a project refers to Tc2_Standard as Std.
  void addAlias(const std::string& alias, const std::string& library);
  // A bare name that several libraries have means that of these.
  void prefer(const std::vector<std::string>& names);
  const std::vector<sema::LibraryFile>& files() const { return files_; }
  const std::vector<sema::LibraryAlias>& aliases() const { return aliases_; }
  // -I names this: a library and where it is.
  const std::vector<std::pair<std::string, std::string>>& folders() const { return folders_; }
  const std::vector<std::string>& read() const { return read_; }  // files and folders of -I, for depfiles

 private:
  [[nodiscard]] std::string addFolder(const LibraryPath& library, bool with_folders);
  [[nodiscard]] std::string addFile(const char* library, const std::string& path);

  std::vector<sema::LibraryFile> files_;
  std::vector<sema::LibraryAlias> aliases_;
  std::deque<std::string> contents_;
  std::vector<std::string> read_;
  std::vector<std::pair<std::string, std::string>> folders_;
};

}  // namespace rung::driver

// The libraries that a program may use: those built into the tool (stdlib/*/*.st and, by family, stdlib/*/*/*.st) and
// those of -I folders. In: Options. Out: their sources, which live as long as this object. Called by compile.cpp and
// list.cpp.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "sema/options.h"
#include "tools/driver/options.h"

namespace rung::driver {

struct LibraryPath {
  std::string called;  // empty: the name of the folder
  std::string folder;
};
// `-I DIR` and `-I NAME=DIR`.
LibraryPath libraryPath(const std::string& written);

class LibrarySet {
 public:
  // The error names the file that could not be read.
  [[nodiscard]] std::string load(const Options& options);
  // Another name for a library: `Std.TON` when a project refers to Tc2_Standard as Std.
  void addAlias(const std::string& alias, const std::string& library);
  // A bare name that several libraries have means that of these.
  void prefer(const std::vector<std::string>& names);
  const std::vector<sema::LibraryFile>& files() const { return files_; }
  const std::vector<sema::LibraryAlias>& aliases() const { return aliases_; }
  // The folders of -I: a library and where it is.
  const std::vector<std::pair<std::string, std::string>>& folders() const { return folders_; }
  const std::vector<std::string>& read() const { return read_; }  // files and folders of -I, for depfiles

 private:
  // `called`: the library's name, or empty for that of the folder.
  [[nodiscard]] std::string addFolder(const std::string& folder, std::string_view called, bool with_folders);

  std::vector<sema::LibraryFile> files_;
  std::vector<sema::LibraryAlias> aliases_;
  std::deque<std::string> contents_;
  std::vector<std::string> read_;
  std::vector<std::pair<std::string, std::string>> folders_;
};

}  // namespace rung::driver

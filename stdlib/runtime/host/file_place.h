// SPDX-License-Identifier: Apache-2.0
// Where a name of the program is: the folder that holds it, opened part by part below the root without following links,
// so that no name and no link leads outside. In: the root and a name. Out: a descriptor and the last part for the *at
// functions. Called by files.cpp, file_work.cpp and file_tree.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rung/module.h"

namespace rung::host {

// The parts of a name without `.` and `..`. False: it leaves the root.
bool partsOf(std::string_view name, std::vector<std::string>& parts);

class FilePlace {
 public:
  FilePlace(const std::string& root, const char* name);
  ~FilePlace();
  FilePlace(const FilePlace&) = delete;
  FilePlace& operator=(const FilePlace&) = delete;

  int64_t error() const { return error_; }  // 0, or a rung_file_error
  int folder() const { return folder_; }
  const char* leaf() const { return leaf_.c_str(); }  // `.` where the name means the root
  bool isRoot() const { return is_root_; }

 private:
  int folder_ = -1;
  bool is_root_ = false;
  std::string leaf_;
  int64_t error_ = 0;
};

int64_t fileErrorOf(int number);  // of errno
// All of the bytes, since write() may take less. Out: their count, or a rung_file_error.
int64_t writeAll(int descriptor, const char* bytes, uint64_t count);
inline int64_t fileResultOf(int64_t result, int number) { return result < 0 ? fileErrorOf(number) : result; }

}  // namespace rung::host

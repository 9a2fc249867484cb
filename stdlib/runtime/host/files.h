// SPDX-License-Identifier: Apache-2.0
// Files of the program, below one folder of this machine (--files-root). In: names as programs write them: `/` or `\`
// between folders, a leading `/` or `C:` means the folder itself. Out: rung_files for the host table. A name that
// leaves the folder by `..` is rejected, and links are not followed. Calls may come from several tasks.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "file_work.h"
#include "rung/module.h"

namespace rung::host {

class Files {
 public:
  // `in_background`: work is done by a thread of its own; else when its result is asked for, as virtual time needs it.
  Files(std::string root, bool in_background);
  ~Files();
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  // Adds the table to a host.
  void serve(rung_host& host);

  int64_t open(const char* name, uint32_t mode);
  int64_t close(int64_t file);
  // The descriptor of an open file, or -1.
  int descriptor(int64_t file);
  const std::string& root() const { return root_; }
  FileWork& work() { return work_; }

 private:
  std::string root_;
  std::mutex mutex_;              // guards the table below
  std::vector<int> descriptors_;  // by number - 1; -1: closed
  FileWork work_;                 // last: its thread uses the others
};

}  // namespace rung::host

// Files of the program, below one folder of this machine (--files-root). In: names as programs write them: `/` or `\`
// between folders, a leading `/` or `C:` means the folder itself. Out: rung_files for the host table. A name that
// leaves the folder by `..` is rejected. Calls may come from several tasks.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "rung/module.h"

namespace rung::host {

class Files {
 public:
  explicit Files(std::string root);
  ~Files();
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  // Adds the table to a host.
  void serve(rung_host& host);

  int64_t open(const char* name, uint32_t mode);
  int64_t close(int64_t file);
  // The descriptor of an open file, or -1.
  int descriptor(int64_t file);
  // Empty: the name leaves the folder.
  std::string pathOf(const char* name) const;

 private:
  std::string root_;
  std::mutex mutex_;              // guards the table below
  std::vector<int> descriptors_;  // by number - 1; -1: closed
};

}  // namespace rung::host

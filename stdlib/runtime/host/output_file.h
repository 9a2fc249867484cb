// SPDX-License-Identifier: Apache-2.0
// A file that appears whole or not at all: written beside its final path and renamed at the end. An unfinished file is
// removed by the destructor, and when a signal ends the process, also in an endless loop of the program. Used by
// traces, plots and test results.
#pragma once

#include <cstdio>
#include <string>

namespace rung::host {

// For a signal handler that ends the process.
void removeUnfinishedFiles();

class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // "-" is `out`; devices and pipes are written directly. False: `error` has the message.
  bool open(const std::string& path, std::FILE* out, std::string& error);
  bool isOpen() const { return file_ != nullptr; }
  // Errors of the system show at close().
  void write(const std::string& text);
  bool close(std::string& error);

 private:
  FILE* file_ = nullptr;
  bool standard_ = false;
  std::string path_, temporary_;
};

}  // namespace rung::host

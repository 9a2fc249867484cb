// SPDX-License-Identifier: Apache-2.0
// Retained and persistent variables of a run (--retain). The values are those of complete cycles: they are copied where
// no task is within an activation, and written to the file off the cycle. In: the ranges of the module. Out: memory
// restored, and a sentence for each variable whose value is lost.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "memory.h"
#include "retain_file.h"
#include "symbols.h"

namespace rung::host {

class Retain {
 public:
  Retain(const Symbols& symbols, Memory& memory, std::string path);

  // Opens the file and reads it. False: `error` is a complete sentence.
  bool open(std::string& error);
  bool hasData() const { return !found_.empty(); }
  // Restores after init: a warm start keeps retained and persistent variables, a cold start persistent ones, origin
  // none. From a file of another layout, variables with the same path and type are restored. Sets the time of the
  // context where timers go on.
  void restore(rung_start start);
  // After restore: a sentence for each variable that does not keep its value, and for a damaged file.
  const std::vector<std::string>& changes() const { return changes_; }

  // Another version of the program goes on; no task runs. False: the file cannot be made large enough.
  bool moveTo(const Symbols& symbols, Memory& memory, std::string& error);
  // Copies the current values; no task runs. Quick, and from any thread.
  void copy(int64_t now_ns);
  // Writes the last copy, if it is another one than that in the file. One thread at a time.
  bool save(std::string& error);

 private:
  std::string directory();
  rung_migration room();
  void note(const char* path, rung_loss why, const std::string& old_type, const std::string& new_type);

  const LoadedModule& module() const { return symbols_->module(); }

  const Symbols* symbols_;
  Memory* memory_;
  RetainFile file_;
  uint64_t sequence_ = 0;
  std::vector<std::string> changes_;
  std::vector<uint8_t> found_;    // the slot in the file at the start
  std::vector<uint8_t> written_;  // the values of the last save
  std::mutex mutex_;              // guards the next three
  std::string directory_;
  std::vector<uint8_t> latest_;
  bool is_new_ = false;
  std::mutex writing_;  // guards the file and the next one
  std::vector<uint8_t> saving_;
  std::string path_;  // room for one
};

}  // namespace rung::host

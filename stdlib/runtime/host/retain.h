// Retained and persistent variables in a file (--retain). The file has two slots, each with sequence number, layout
// hash, length and CRC-32. A save writes the older slot and syncs it before it returns, so a power failure at any
// instruction leaves the old or the new state, whole. In: the ranges of the module. Out: memory restored.
#pragma once

#include <string>
#include <vector>

#include "memory.h"
#include "symbols.h"

namespace rung::host {

class Retain {
 public:
  Retain(const rung_module& module, Memory& memory, std::string path);
  ~Retain();
  Retain(const Retain&) = delete;
  Retain& operator=(const Retain&) = delete;

  bool exists() const;
  // Restores after init: a warm start keeps retained and persistent variables, a cold start persistent ones, origin
  // none. From a file of another layout, variables with the same path and type are restored. False: `error` is set.
  bool restore(rung_start start, const Symbols& symbols, std::string& error);
  // After restore: a sentence for each variable that keeps its initial value because its type is another one now.
  const std::vector<std::string>& changes() const { return changes_; }
  // Writes the current values.
  bool save(const Symbols& symbols, std::string& error);

 private:
  struct Slot {
    uint64_t sequence = 0;
    uint64_t layout_hash = 0;
    uint32_t value_bytes = 0;  // the directory follows
    std::string payload;
  };
  bool readSlot(int index, Slot& slot) const;
  std::string directory(const Symbols& symbols) const;
  bool open(std::string& error);
  struct Entry;
  static bool readEntry(const std::string& line, std::string& path, Entry& entry);
  void restoreByName(const Slot& slot, rung_start start, const Symbols& symbols);

  const rung_module& module_;
  Memory& memory_;
  std::string path_;
  int file_ = -1;
  uint64_t sequence_ = 0;
  std::string directory_;
  std::vector<std::string> changes_;
};

uint32_t crc32(const void* data, size_t size, uint32_t crc = 0);

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// The private cache of compiled C++: files named by a hash of all their inputs. Entries appear by rename, so two
// concurrent rungs never read half a file; beyond the limit the least recently used entries are removed.
// In: keys. Out: paths of entries. Called by native.cpp. Folder: $RUNG_CACHE_DIR, $XDG_CACHE_HOME/rung, ~/.cache/rung,
// else a temporary folder, removed at the end. Limit: $RUNG_CACHE_SIZE in MiB, default 1024.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung::driver {

// A running hash of 128 bits; fast, not secure: an attacker could write into the folder anyway.
class Hash {
 public:
  void add(std::string_view bytes);  // with its length: ("a","bc") and ("ab","c") differ
  void add(uint64_t number);
  std::string hex() const;  // 32 digits

 private:
  uint64_t a_ = 0x243f6a8885a308d3ull, b_ = 0x13198a2e03707344ull;
};

class Cache {
 public:
  Cache();
  ~Cache();  // removes the temporary folder; trims when something was added
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;

  // Empty: no folder could be created.
  const std::string& folder() const { return folder_; }

  // The path of the entry, existing or not. `kind` is its folder and suffix: "o", "so", "gch".
  std::string path(const std::string& key, const char* kind) const;
  // True when the entry exists and has the hash that is noted beside it: a power failure can leave half a file under
  // its name. Updates its time of last use.
  bool has(const std::string& entry) const;
  // Renames a finished file to its entry (same file system: made in workFolder()).
  bool put(const std::string& from, const std::string& entry);

  // A fresh folder of this process, removed by drop() or, after a crash, by a later rung.
  std::string workFolder();
  void drop(const std::string& work_folder);

  static uint64_t limitBytes();
  void trim(uint64_t limit);

 private:
  std::string folder_;
  bool temporary_ = false, added_ = false;
  uint32_t next_work_ = 0;
};

}  // namespace rung::driver

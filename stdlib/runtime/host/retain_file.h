// SPDX-License-Identifier: Apache-2.0
// The file of retained data: slots (rung/retain.h) at multiples of 4096 bytes after a sector that says what the file
// is. A slot is written where the newest complete one is not, and synced; the file is never renamed or shortened. So
// whatever instruction a power failure comes at, the newest or the one before it is complete. In: a path. Out: bytes of
// slots.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rung::host {

class RetainFile {
 public:
  explicit RetainFile(std::string path) : path_(std::move(path)) {}
  ~RetainFile();
  RetainFile(const RetainFile&) = delete;
  RetainFile& operator=(const RetainFile&) = delete;

  // Creates the file where there is none. False: `error` is a sentence with the path; a file that is something else
  // stays as it is.
  bool open(std::string& error);
  // Room for two slots of this size, so that a full disk is known before the program runs.
  bool reserve(size_t slot_bytes, std::string& error);
  // The newest complete slot; empty: none. After open.
  std::vector<uint8_t> newest();
  // True when there are slots, but none is complete: a damaged file.
  bool isDamaged() const { return is_damaged_; }
  // Writes a sealed slot and waits until it is on the disk.
  bool write(const std::vector<uint8_t>& slot, std::string& error);
  const std::string& path() const { return path_; }

 private:
  bool begin(std::string& error);
  bool fail(std::string& error, const char* what = nullptr) const;

  std::string path_;
  int file_ = -1;
  uint64_t size_ = 0;
  uint64_t newest_at_ = 0, newest_end_ = 0;  // 0: none
  bool is_damaged_ = false;
};

}  // namespace rung::host

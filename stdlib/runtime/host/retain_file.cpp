// SPDX-License-Identifier: Apache-2.0
// The file of retained data: see retain_file.h.
#include "retain_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "rung/retain.h"

namespace rung::host {
namespace {

constexpr uint64_t kSector = 4096;
constexpr uint64_t kMostFileBytes = uint64_t{1} << 30;  // of a file: its slots are looked for in every sector
// A power failure leaves one slot that is newer than the newest complete one; a file with more of them is not ours.
constexpr size_t kMostCandidates = 4;
constexpr char kTitle[] = "Rung retained data 2\n";

// All bytes through pread or pwrite, which may take a part of them.
template <class Byte, class Move>
bool moveAll(Move move, int file, uint64_t offset, Byte* at, size_t size) {
  while (size > 0) {
    const ssize_t n = move(file, at, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = EIO;
    if (n <= 0) return false;
    at += n;
    offset += static_cast<uint64_t>(n);
    size -= static_cast<size_t>(n);
  }
  return true;
}
bool readAt(int file, uint64_t offset, void* to, size_t size) {
  return moveAll(pread, file, offset, static_cast<char*>(to), size);
}
bool writeAt(int file, uint64_t offset, const void* from, size_t size) {
  return moveAll(pwrite, file, offset, static_cast<const char*>(from), size);
}

uint64_t sectors(uint64_t bytes) { return (bytes + kSector - 1) / kSector * kSector; }

// The file itself, and its name in the folder.
bool syncWithFolder(int file, const std::string& path) {
  if (fsync(file) != 0) return false;
  const size_t slash = path.find_last_of('/');
  const int folder = ::open(slash == std::string::npos ? "." : path.substr(0, slash + 1).c_str(), O_RDONLY | O_CLOEXEC);
  if (folder < 0) return true;  // the folder cannot be read, and so not synced
  fsync(folder);
  close(folder);
  return true;
}

}  // namespace

RetainFile::~RetainFile() {
  if (file_ >= 0) close(file_);
}

bool RetainFile::fail(std::string& error, const char* what) const {
  error = path_ + ": " + (what != nullptr ? what : strerror(errno));
  return false;
}

bool RetainFile::open(std::string& error) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) return fail(error);
  struct stat status;
  if (fstat(file_, &status) != 0) return fail(error);
  if (!S_ISREG(status.st_mode)) return fail(error, "it is not a file");
  if (flock(file_, LOCK_EX | LOCK_NB) != 0)
    return fail(error, errno == EWOULDBLOCK ? "another program uses it as its retained data" : nullptr);
  size_ = static_cast<uint64_t>(status.st_size);
  if (size_ > kMostFileBytes) return fail(error, "it is larger than 1 GiB, the most that retained data may have");
  return begin(error);
}

// The first sector. All bytes zero: the power failed before the file had its title, or its content is lost.
bool RetainFile::begin(std::string& error) {
  std::vector<char> sector(kSector);
  const size_t there = static_cast<size_t>(std::min(size_, kSector));
  if (!readAt(file_, 0, sector.data(), there)) return fail(error);
  const size_t title = std::min(there, strlen(kTitle));
  if (title > 0 && memcmp(sector.data(), kTitle, title) == 0) {
    is_damaged_ = size_ < kSector;
    if (!is_damaged_) return true;
  } else if (std::any_of(sector.begin(), sector.begin() + static_cast<ptrdiff_t>(there),
                         [](char c) { return c != 0; })) {
    return fail(error, "it is not a file of retained data; choose another path, or remove it");
  } else {
    is_damaged_ = size_ > 0;
  }
  sector.assign(kSector, 0);
  memcpy(sector.data(), kTitle, strlen(kTitle));
  if (!writeAt(file_, 0, sector.data(), kSector) || !syncWithFolder(file_, path_)) return fail(error);
  size_ = std::max(size_, kSector);
  return true;
}

bool RetainFile::reserve(size_t slot_bytes, std::string& error) {
  const uint64_t wanted = kSector + 2 * sectors(slot_bytes);
  if (size_ >= wanted) return true;
  const int result = posix_fallocate(file_, 0, static_cast<off_t>(wanted));
  if (result != 0) {
    errno = result;
    return fail(error);
  }
  size_ = wanted;
  if (!syncWithFolder(file_, path_)) return fail(error);
  return true;
}

std::vector<uint8_t> RetainFile::newest() {
  struct Candidate {
    uint64_t sequence, at, length;
  };
  std::vector<Candidate> candidates;
  bool has_slots = false;
  newest_at_ = newest_end_ = 0;
  for (uint64_t at = kSector; at + sizeof(rung_slot) <= size_; at += kSector) {
    rung_slot header;
    if (!readAt(file_, at, &header, sizeof header)) continue;
    const char* const bytes = reinterpret_cast<const char*>(&header);
    has_slots = has_slots || std::any_of(bytes, bytes + sizeof header, [](char c) { return c != 0; });
    const uint64_t length = sizeof header + uint64_t{header.length};
    if (rung_retain_is_slot(&header) && length <= size_ - at) candidates.push_back({header.sequence, at, length});
  }
  const size_t tried = std::min(candidates.size(), kMostCandidates);
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<ptrdiff_t>(tried), candidates.end(),
                    [](const Candidate& a, const Candidate& b) { return a.sequence > b.sequence; });
  std::vector<uint8_t> best;
  for (size_t i = 0; i < tried; ++i) {
    const Candidate& candidate = candidates[i];
    best.resize(candidate.length);
    if (readAt(file_, candidate.at, best.data(), best.size()) && rung_retain_is_complete(best.data(), best.size())) {
      newest_at_ = candidate.at;
      newest_end_ = candidate.at + sectors(candidate.length);
      break;
    }
    best.clear();
  }
  is_damaged_ = (is_damaged_ || has_slots) && best.empty();
  return best;
}

bool RetainFile::write(const std::vector<uint8_t>& slot, std::string& error) {
  const uint64_t bytes = sectors(slot.size());
  const uint64_t at = newest_at_ == 0 || kSector + bytes <= newest_at_ ? kSector : newest_end_;
  if (at + bytes > size_) {
    const int result = posix_fallocate(file_, 0, static_cast<off_t>(at + bytes));
    if (result != 0) {
      errno = result;
      return fail(error);
    }
    size_ = at + bytes;
  }
  if (!writeAt(file_, at, slot.data(), slot.size()) || fdatasync(file_) != 0) return fail(error);
  newest_at_ = at;
  newest_end_ = at + bytes;
  return true;
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// Folders with their content: see file_tree.h.
#include "file_tree.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "file_place.h"

namespace rung::host {
namespace {

constexpr int kDeepestFolder = 64;  // nested folders

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

int openFolder(int folder, const char* name) {
  return openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

// The names in a folder, sorted. False: it cannot be read.
bool namesIn(int folder, std::vector<std::string>& names) {
  const int copy = dup(folder);  // closedir closes it
  DIR* const stream = copy < 0 ? nullptr : fdopendir(copy);
  if (stream == nullptr) return false;
  while (const dirent* const entry = readdir(stream))
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) names.emplace_back(entry->d_name);
  closedir(stream);
  std::sort(names.begin(), names.end());
  return true;
}

int64_t copyBytes(int from, int to) {
  char buffer[16384];
  for (;;) {
    const ssize_t count = read(from, buffer, sizeof buffer);
    if (count == 0) return 0;
    if (count < 0) return fileErrorOf(errno);
    const int64_t written = writeAll(to, buffer, static_cast<uint64_t>(count));
    if (written < 0) return written;
  }
}

struct Copy {
  bool overwrites;
  uint64_t most_bytes;

  int64_t file(int from_folder, int to_folder, const char* name, const struct stat& info) const {
    if (most_bytes > 0 && static_cast<uint64_t>(info.st_size) > most_bytes) return RUNG_FILE_TOO_LARGE;
    const Descriptor from(openat(from_folder, name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
    if (from.get() < 0) return fileErrorOf(errno);
    struct stat existing;
    const bool is_same = fstatat(to_folder, name, &existing, AT_SYMLINK_NOFOLLOW) == 0 &&
                         existing.st_ino == info.st_ino && existing.st_dev == info.st_dev;
    if (is_same) return overwrites ? 0 : int64_t{RUNG_FILE_EXISTS};
    const int mode = O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | (overwrites ? O_TRUNC : O_EXCL);
    const Descriptor to(openat(to_folder, name, mode, 0666));
    if (to.get() < 0) return fileErrorOf(errno);
    const int64_t result = copyBytes(from.get(), to.get());
    if (result < 0) unlinkat(to_folder, name, 0);
    return result;
  }

  int64_t any(int from_folder, int to_folder, const char* name, int depth) const {
    struct stat info;
    if (fstatat(from_folder, name, &info, AT_SYMLINK_NOFOLLOW) != 0) return fileErrorOf(errno);
    if (S_ISREG(info.st_mode)) return file(from_folder, to_folder, name, info);
    if (!S_ISDIR(info.st_mode)) return depth == 0 ? int64_t{RUNG_FILE_NAME} : 0;
    if (depth == kDeepestFolder) return RUNG_FILE_FAILED;
    if (mkdirat(to_folder, name, 0777) != 0 && (errno != EEXIST || !overwrites)) return fileErrorOf(errno);
    const Descriptor from(openFolder(from_folder, name)), to(openFolder(to_folder, name));
    std::vector<std::string> names;
    if (from.get() < 0 || to.get() < 0 || !namesIn(from.get(), names)) return fileErrorOf(errno);
    for (const std::string& entry : names)
      if (const int64_t result = any(from.get(), to.get(), entry.c_str(), depth + 1); result < 0) return result;
    return 0;
  }
};

int64_t removeAny(int folder, const char* name, int depth) {
  struct stat info;
  if (fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) != 0) return fileErrorOf(errno);
  if (!S_ISDIR(info.st_mode)) return fileResultOf(unlinkat(folder, name, 0), errno);
  if (depth == kDeepestFolder) return RUNG_FILE_FAILED;
  {
    const Descriptor inner(openFolder(folder, name));
    std::vector<std::string> names;
    if (inner.get() < 0 || !namesIn(inner.get(), names)) return fileErrorOf(errno);
    for (const std::string& entry : names)
      if (const int64_t result = removeAny(inner.get(), entry.c_str(), depth + 1); result < 0) return result;
  }
  return fileResultOf(unlinkat(folder, name, AT_REMOVEDIR), errno);
}

// True when the folder `inner` is `outer` or below it: it cannot be copied there.
bool isWithin(const char* inner, const char* outer) {
  std::vector<std::string> in, out;
  if (!partsOf(inner, in) || !partsOf(outer, out) || in.size() < out.size()) return false;
  return std::equal(out.begin(), out.end(), in.begin());
}

}  // namespace

int64_t listFolder(const std::string& root, const char* name, bool only_files, rung_file_entry* entries,
                   uint64_t capacity) {
  const FilePlace place(root, name);
  if (place.error() != 0) return place.error();
  const Descriptor folder(openFolder(place.folder(), place.leaf()));
  std::vector<std::string> names;
  if (folder.get() < 0 || !namesIn(folder.get(), names)) return fileErrorOf(errno);
  uint64_t count = 0;
  for (const std::string& found : names) {
    struct stat info;
    if (count == capacity) break;
    if (fstatat(folder.get(), found.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const bool is_folder = S_ISDIR(info.st_mode);
    if ((!is_folder && !S_ISREG(info.st_mode)) || (is_folder && only_files)) continue;
    rung_file_entry& entry = entries[count++];
    entry = {};
    memcpy(entry.name, found.c_str(), std::min(found.size(), sizeof entry.name - 1));
    entry.size = is_folder ? 0 : static_cast<uint64_t>(info.st_size);
    entry.modified_s = info.st_mtime;
    entry.is_folder = is_folder ? 1 : 0;
  }
  return static_cast<int64_t>(count);
}

int64_t copyTree(const std::string& root, const char* name, const char* target, bool overwrites, uint64_t most_bytes) {
  const FilePlace from(root, name), to(root, target);
  if (from.error() != 0) return from.error();
  if (to.error() != 0) return to.error();
  if (from.isRoot()) return RUNG_FILE_NAME;
  const Descriptor folder(openFolder(to.folder(), to.leaf()));
  if (folder.get() < 0) return fileErrorOf(errno);
  if (isWithin(target, name)) return RUNG_FILE_FAILED;
  return Copy{overwrites, most_bytes}.any(from.folder(), folder.get(), from.leaf(), 0);
}

int64_t removeTree(const std::string& root, const char* name) {
  const FilePlace place(root, name);
  if (place.error() != 0) return place.error();
  return place.isRoot() ? int64_t{RUNG_FILE_NAME} : removeAny(place.folder(), place.leaf(), 0);
}

}  // namespace rung::host

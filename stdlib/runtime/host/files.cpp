// SPDX-License-Identifier: Apache-2.0
// Files of the program: see files.h.
#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "file_place.h"

namespace rung::host {
namespace {

constexpr size_t kMaxFiles = 256;  // a program that never closes its files gets an error

Files& of(void* data) { return *static_cast<Files*>(data); }

// Calls `action` with a place that is not the root.
template <typename Action>
int64_t onPlace(void* data, const char* name, Action action) {
  const FilePlace place(of(data).root(), name);
  if (place.error() != 0) return place.error();
  if (place.isRoot()) return RUNG_FILE_NAME;
  const int64_t result = action(place);
  return fileResultOf(result, errno);
}
template <typename Action>
int64_t onFile(void* data, int64_t file, Action action) {
  const int descriptor = of(data).descriptor(file);
  if (descriptor < 0) return RUNG_FILE_HANDLE;
  const int64_t result = action(descriptor);
  return fileResultOf(result, errno);
}

int64_t sizeOf(const FilePlace& place) {
  struct stat info;
  if (fstatat(place.folder(), place.leaf(), &info, AT_SYMLINK_NOFOLLOW) != 0) return -1;
  if (S_ISREG(info.st_mode)) return info.st_size;
  errno = ENOENT;
  return -1;
}

const rung_files kFiles = {
    [](void* data, const char* name, uint32_t mode) { return of(data).open(name, mode); },
    [](void* data, int64_t file) { return of(data).close(file); },
    [](void* data, int64_t file, void* bytes, uint64_t count) {
      return onFile(data, file, [&](int fd) { return read(fd, bytes, count); });
    },
    [](void* data, int64_t file, const void* bytes, uint64_t count) {
      return onFile(data, file, [&](int fd) { return write(fd, bytes, count); });
    },
    [](void* data, int64_t file, int64_t offset, int from) {
      const int whence = from == 0 ? SEEK_SET : from == 1 ? SEEK_CUR : SEEK_END;
      return onFile(data, file, [&](int fd) { return lseek(fd, offset, whence); });
    },
    [](void* data, const char* name) { return onPlace(data, name, sizeOf); },
    [](void* data, const char* name) {
      return onPlace(data, name, [](const FilePlace& place) { return unlinkat(place.folder(), place.leaf(), 0); });
    },
    [](void* data, const char* from, const char* to) {
      return onPlace(data, from, [&](const FilePlace& old_place) -> int64_t {
        const FilePlace place(of(data).root(), to);
        if (place.error() != 0 || place.isRoot()) return errno = ELOOP, -1;
        return renameat(old_place.folder(), old_place.leaf(), place.folder(), place.leaf());
      });
    },
    [](void* data, const char* name) {
      return onPlace(data, name, [](const FilePlace& place) { return mkdirat(place.folder(), place.leaf(), 0777); });
    },
    [](void* data, const char* name) {
      return onPlace(data, name,
                     [](const FilePlace& place) { return unlinkat(place.folder(), place.leaf(), AT_REMOVEDIR); });
    },
    [](void* data, const rung_file_work* work) { return of(data).work().begin(*work); },
    [](void* data, int64_t work, void* bytes, uint64_t capacity) {
      return of(data).work().result(work, bytes, capacity);
    },
};

}  // namespace

Files::Files(std::string root, bool in_background) : root_(std::move(root)), work_(*this, in_background) {}

Files::~Files() {
  work_.end();
  for (const int descriptor : descriptors_)
    if (descriptor >= 0) ::close(descriptor);
}

void Files::serve(rung_host& host) {
  host.files = &kFiles;
  host.files_data = this;
}

int64_t Files::open(const char* name, uint32_t mode) {
  const FilePlace place(root_, name);
  if (place.error() != 0) return place.error();
  if (place.isRoot()) return RUNG_FILE_NAME;
  const bool reads = (mode & RUNG_FILE_READ) != 0, writes = (mode & RUNG_FILE_WRITE) != 0;
  int flags = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (writes ? reads ? O_RDWR : O_WRONLY : O_RDONLY);
  if ((mode & RUNG_FILE_APPEND) != 0) flags |= O_APPEND;
  if ((mode & RUNG_FILE_CREATE) != 0) flags |= O_CREAT;
  if ((mode & RUNG_FILE_TRUNCATE) != 0) flags |= O_TRUNC;
  if ((mode & RUNG_FILE_NEW) != 0) flags |= O_EXCL;
  const std::lock_guard<std::mutex> lock(mutex_);
  auto free = std::find(descriptors_.begin(), descriptors_.end(), -1);
  if (free == descriptors_.end() && descriptors_.size() == kMaxFiles) return RUNG_FILE_FAILED;
  const int descriptor = openat(place.folder(), place.leaf(), flags, 0666);
  if (descriptor < 0) return fileErrorOf(errno);
  struct stat info;  // a pipe or device would block whoever reads it
  if (fstat(descriptor, &info) != 0 || (!S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))) {
    ::close(descriptor);
    return RUNG_FILE_FAILED;
  }
  if (free == descriptors_.end()) free = descriptors_.insert(free, -1);
  *free = descriptor;
  return free - descriptors_.begin() + 1;
}

int64_t Files::close(int64_t file) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (file < 1 || file > static_cast<int64_t>(descriptors_.size())) return RUNG_FILE_HANDLE;
  int& descriptor = descriptors_[static_cast<size_t>(file - 1)];
  if (descriptor < 0) return RUNG_FILE_HANDLE;
  const int result = ::close(descriptor);
  descriptor = -1;
  return fileResultOf(result, errno);
}

int Files::descriptor(int64_t file) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (file < 1 || file > static_cast<int64_t>(descriptors_.size())) return -1;
  return descriptors_[static_cast<size_t>(file - 1)];
}

}  // namespace rung::host

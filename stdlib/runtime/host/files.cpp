// Files of the program: see files.h.
#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>

namespace rung::host {
namespace {

constexpr size_t kMaxFiles = 256;  // a program that never closes its files gets an error

int64_t errorOf(int number) {
  if (number == ENOENT || number == ENOTDIR) return RUNG_FILE_MISSING;
  if (number == EACCES || number == EPERM || number == EROFS) return RUNG_FILE_DENIED;
  if (number == EEXIST || number == ENOTEMPTY) return RUNG_FILE_EXISTS;
  if (number == EBADF) return RUNG_FILE_HANDLE;
  return RUNG_FILE_FAILED;
}
int64_t resultOf(int64_t result) { return result < 0 ? errorOf(errno) : result; }

Files& of(void* data) { return *static_cast<Files*>(data); }

// Calls `action` with the paths of the names, when all are inside the folder.
template <typename Action>
int64_t onPath(void* data, const char* name, Action action) {
  const std::string path = of(data).pathOf(name);
  return path.empty() ? int64_t{RUNG_FILE_NAME} : resultOf(action(path.c_str()));
}
template <typename Action>
int64_t onFile(void* data, int64_t file, Action action) {
  const int descriptor = of(data).descriptor(file);
  return descriptor < 0 ? int64_t{RUNG_FILE_HANDLE} : resultOf(action(descriptor));
}

int64_t sizeOf(const char* path) {
  struct stat info;
  if (stat(path, &info) != 0) return -1;
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
    [](void* data, const char* name) { return onPath(data, name, sizeOf); },
    [](void* data, const char* name) { return onPath(data, name, [](const char* path) { return unlink(path); }); },
    [](void* data, const char* from, const char* to) {
      const std::string old_path = of(data).pathOf(from);
      if (old_path.empty()) return int64_t{RUNG_FILE_NAME};
      return onPath(data, to, [&](const char* path) { return rename(old_path.c_str(), path); });
    },
    [](void* data, const char* name) { return onPath(data, name, [](const char* path) { return mkdir(path, 0777); }); },
    [](void* data, const char* name) { return onPath(data, name, [](const char* path) { return rmdir(path); }); },
};

}  // namespace

Files::Files(std::string root) : root_(std::move(root)) {}

Files::~Files() {
  for (const int descriptor : descriptors_)
    if (descriptor >= 0) ::close(descriptor);
}

void Files::serve(rung_host& host) {
  host.files = &kFiles;
  host.files_data = this;
}

std::string Files::pathOf(const char* name) const {
  std::string_view rest(name);
  if (rest.size() > 1 && rest[1] == ':') rest.remove_prefix(2);
  std::string path = root_;
  int depth = 0;
  bool has_part = false;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find_first_of("/\\"), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (part.empty() || part == ".") continue;
    depth += part == ".." ? -1 : 1;
    if (depth < 0) return "";
    has_part = true;
    path.append("/").append(part);
  }
  return has_part ? path : "";
}

int64_t Files::open(const char* name, uint32_t mode) {
  const std::string path = pathOf(name);
  if (path.empty()) return RUNG_FILE_NAME;
  const bool reads = (mode & RUNG_FILE_READ) != 0, writes = (mode & RUNG_FILE_WRITE) != 0;
  int flags = O_CLOEXEC | (writes ? reads ? O_RDWR : O_WRONLY : O_RDONLY);
  if ((mode & RUNG_FILE_APPEND) != 0) flags |= O_APPEND;
  if ((mode & RUNG_FILE_CREATE) != 0) flags |= O_CREAT;
  if ((mode & RUNG_FILE_TRUNCATE) != 0) flags |= O_TRUNC;
  const std::lock_guard<std::mutex> lock(mutex_);
  auto free = std::find(descriptors_.begin(), descriptors_.end(), -1);
  if (free == descriptors_.end() && descriptors_.size() == kMaxFiles) return RUNG_FILE_FAILED;
  const int descriptor = ::open(path.c_str(), flags, 0666);
  if (descriptor < 0) return errorOf(errno);
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
  return resultOf(result);
}

int Files::descriptor(int64_t file) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (file < 1 || file > static_cast<int64_t>(descriptors_.size())) return -1;
  return descriptors_[static_cast<size_t>(file - 1)];
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// Names of the program as places below the root: see file_place.h.
#include "file_place.h"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>

namespace rung::host {

int64_t fileErrorOf(int number) {
  if (number == ENOENT || number == ENOTDIR) return RUNG_FILE_MISSING;
  if (number == EACCES || number == EPERM || number == EROFS) return RUNG_FILE_DENIED;
  if (number == EEXIST || number == ENOTEMPTY) return RUNG_FILE_EXISTS;
  if (number == ELOOP) return RUNG_FILE_NAME;  // a link
  if (number == EBADF) return RUNG_FILE_HANDLE;
  return RUNG_FILE_FAILED;
}

int64_t writeAll(int descriptor, const char* bytes, uint64_t count) {
  for (uint64_t done = 0; done < count;) {
    const ssize_t written = write(descriptor, bytes + done, count - done);
    if (written <= 0) return fileErrorOf(errno);
    done += static_cast<uint64_t>(written);
  }
  return static_cast<int64_t>(count);
}

bool partsOf(std::string_view name, std::vector<std::string>& parts) {
  if (name.size() > 1 && name[1] == ':') name.remove_prefix(2);
  while (!name.empty()) {
    const size_t end = std::min(name.find_first_of("/\\"), name.size());
    const std::string_view part = name.substr(0, end);
    name.remove_prefix(std::min(end + 1, name.size()));
    if (part.empty() || part == ".") continue;
    if (part != "..") {
      parts.emplace_back(part);
      continue;
    }
    if (parts.empty()) return false;
    parts.pop_back();
  }
  return true;
}

FilePlace::FilePlace(const std::string& root, const char* name) {
  std::vector<std::string> parts;
  if (*name == '\0' || !partsOf(name, parts)) {
    error_ = RUNG_FILE_NAME;
    return;
  }
  is_root_ = parts.empty();
  leaf_ = is_root_ ? "." : parts.back();
  folder_ = ::open(root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  for (size_t i = 0; folder_ >= 0 && i + 1 < parts.size(); ++i) {
    const int next = openat(folder_, parts[i].c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    const int number = errno;
    ::close(folder_);
    folder_ = next;
    errno = number;
  }
  if (folder_ < 0) error_ = fileErrorOf(errno);
}

FilePlace::~FilePlace() {
  if (folder_ >= 0) ::close(folder_);
}

}  // namespace rung::host

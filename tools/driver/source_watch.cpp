// SPDX-License-Identifier: Apache-2.0
// Changes of a project's files: see source_watch.h.
#include "tools/driver/source_watch.h"

#include <sys/stat.h>
#include <filesystem>
#include <functional>

#include "frontend/import/formats.h"

namespace rung::driver {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMostFiles = 100'000;

bool isSource(const fs::path& path) {
  return importer::kindOfExtension(path.string()) != importer::FileKind::Unknown || path.filename() == "rung.project";
}

// The order of the files does not matter: their hashes are added.
uint64_t stampOf(const fs::path& path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0) return 0;
  const std::string text = path.string() + ':' + std::to_string(status.st_size) + ':' +
                           std::to_string(status.st_mtim.tv_sec) + ':' + std::to_string(status.st_mtim.tv_nsec);
  return std::hash<std::string>()(text);
}

}  // namespace

SourceWatch::SourceWatch(const ProjectOptions& project) : roots_(project.inputs) {
  if (roots_.empty()) roots_.emplace_back(".");
  for (const std::string& library : project.library_paths) roots_.push_back(library);
  known_ = seen_ = look();
}

uint64_t SourceWatch::look() const {
  uint64_t stamp = 0;
  size_t files = 0;
  for (const std::string& root : roots_) {
    std::error_code failed;
    if (!fs::is_directory(root, failed)) {
      stamp += stampOf(root);
      continue;
    }
    fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, failed), end;
    for (; !failed && at != end && files < kMostFiles; at.increment(failed), ++files) {
      const std::string name = at->path().filename().string();
      if (!name.empty() && name[0] == '.' && at->is_directory(failed)) at.disable_recursion_pending();
      if (isSource(at->path())) stamp += stampOf(at->path());
    }
  }
  return stamp;
}

bool SourceWatch::hasChanged() {
  const uint64_t now = look();
  const bool is_quiet = now == seen_;
  seen_ = now;
  if (!is_quiet || now == known_) return false;
  known_ = now;
  return true;
}

}  // namespace rung::driver

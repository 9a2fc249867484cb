// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/file_provider.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

namespace rung::driver {

namespace fs = std::filesystem;

std::string absolutePath(const std::string& path) {
  std::error_code error;
  fs::path full = fs::absolute(path, error);
  std::string normal = (error ? fs::path(path) : full).lexically_normal().generic_string();
  while (normal.size() > 1 && normal.back() == '/') normal.pop_back();
  return normal;
}

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  if (DIR* dir = opendir(folder.c_str())) {
    while (const dirent* entry = readdir(dir))
      if (entry->d_name[0] != '.') names.push_back(entry->d_name);
    closedir(dir);
  }
  std::sort(names.begin(), names.end());
  return names;
}

FileProvider::FileProvider(const std::vector<UnsavedFile>& unsaved) {
  for (const UnsavedFile& file : unsaved) texts_[absolutePath(file.path)] = &file.text;
}

const std::string* FileProvider::find(const std::string& path) const {
  if (texts_.empty()) return nullptr;
  const auto found = texts_.find(absolutePath(path));
  return found == texts_.end() ? nullptr : found->second;
}

ReadResult FileProvider::read(const std::string& path) const {
  if (const std::string* text = find(path)) return {*text, {}};
  return readFile(path);
}

std::vector<std::string> FileProvider::newFilesIn(const std::string& folder) const {
  std::vector<std::string> files;
  if (texts_.empty()) return files;
  const std::string prefix = absolutePath(folder) + "/";
  struct stat info;
  for (const auto& [path, text] : texts_)
    if (path.starts_with(prefix) && stat(path.c_str(), &info) != 0) files.push_back(path.substr(prefix.size()));
  return files;
}

}  // namespace rung::driver

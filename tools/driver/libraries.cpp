// SPDX-License-Identifier: Apache-2.0
// The libraries that a program may use; see libraries.h.
#include "tools/driver/libraries.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "frontend/import/formats.h"
#include "frontend/source/files.h"
#include "library_sources.h"
#include "tools/driver/namespaces.h"

namespace rung::driver {

namespace {

// The folder that holds the file: `comm/ICP_UDP_Comm_Send/send.st` is of the library ICP_UDP_Comm_Send.
std::string_view folderOf(std::string_view file) {
  const std::string_view path = file.substr(0, file.rfind('/'));
  return path.substr(path.rfind('/') + 1);  // all of it where there is no family
}

}  // namespace

std::string LibrarySet::load(const ProjectOptions& options) {
  for (size_t i = 0; i < embedded::library_sources_count; i++) {
    const embedded::File& file = embedded::library_sources[i];
    contents_.push_back(namespaceOf(folderOf(file.name)));
    const char* library = contents_.back().c_str();
    contents_.emplace_back(file.name);
    files_.push_back({library, contents_.back().c_str(), file.text});
  }
  for (const NamespaceAlias& row : namespaceAliases()) aliases_.push_back({row.alias, row.name});
  for (const std::string& written : options.library_paths) {
    const LibraryPath library = libraryPath(written);
    struct stat info;
    if (stat(library.path.c_str(), &info) != 0 || S_ISDIR(info.st_mode)) {
      if (std::string error = addFolder(library, true); !error.empty()) return error;
    } else if (isLibraryInSt(library.path)) {
      contents_.push_back(library.name());
      if (std::string error = addFile(contents_.back().c_str(), library.path); !error.empty()) return error;
    }
  }
  return {};
}

LibraryPath libraryPath(const std::string& written) {
  const size_t equal = written.find('=');
  const std::string_view name = std::string_view(written).substr(0, equal);
  if (equal == std::string::npos || !isModuleName(name)) return {{}, written};
  return {std::string(name), written.substr(equal + 1)};
}

std::string LibraryPath::name() const {
  if (!called.empty()) return called;
  std::string_view last = path;
  while (last.size() > 1 && last.back() == '/') last.remove_suffix(1);
  last = last.substr(last.rfind('/') + 1);
  const bool is_file = importer::kindOfExtension(last) != importer::FileKind::Unknown;
  return std::string(is_file ? last.substr(0, last.rfind('.')) : last);
}

bool isLibraryInSt(const std::string& path) { return path.ends_with(".st") || path.ends_with(".iecst"); }

void LibrarySet::addFile(const std::string& library, const std::string& path, FileId file, std::string_view text) {
  contents_.push_back(library);
  const char* name = contents_.back().c_str();
  contents_.push_back(path);
  files_.push_back({name, contents_.back().c_str(), text, file});
}

void LibrarySet::prefer(const std::vector<std::string>& names) {
  std::stable_partition(files_.begin(), files_.end(), [&](const sema::LibraryFile& file) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return sameIdentifier(name, file.library); });
  });
}

void LibrarySet::addAlias(const std::string& alias, const std::string& library) {
  contents_.push_back(alias);
  const char* shown = contents_.back().c_str();
  contents_.push_back(library);
  aliases_.push_back({shown, contents_.back().c_str()});
}

// Files of the folder are one library of its name; so is each folder inside.
std::string LibrarySet::addFolder(const LibraryPath& of, bool with_folders) {
  const std::string& folder = of.path;
  DIR* dir = opendir(folder.c_str());
  if (dir == nullptr) return "cannot read the library `" + folder + "`: " + strerror(errno);
  std::vector<std::string> names;
  while (const dirent* entry = readdir(dir))
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
  closedir(dir);
  std::sort(names.begin(), names.end());
  read_.push_back(folder);

  contents_.push_back(of.name());
  const char* library = contents_.back().c_str();
  folders_.emplace_back(library, folder);
  for (const std::string& entry : names) {
    const std::string path = folder + "/" + entry;
    struct stat info;
    if (stat(path.c_str(), &info) != 0) continue;
    std::string error;
    if (S_ISDIR(info.st_mode) && with_folders)
      error = addFolder({{}, path}, false);
    else if (S_ISREG(info.st_mode) && isLibraryInSt(entry))
      error = addFile(library, path);
    if (!error.empty()) return error;
  }
  return {};
}

std::string LibrarySet::addFile(const char* library, const std::string& path) {
  ReadResult read = readFile(path);
  if (!read.error.empty()) return "cannot read the library `" + path + "`: " + read.error;
  read_.push_back(path);
  contents_.push_back(path);
  const char* shown = contents_.back().c_str();
  contents_.push_back(std::move(read.content));
  files_.push_back({library, shown, contents_.back()});
  return {};
}

}  // namespace rung::driver

// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/folder.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "frontend/import/formats.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;
using importer::FileKind;

std::string_view nameOf(std::string_view path) { return path.substr(path.rfind('/') + 1); }

// The target of a link, if it is not below the root.
std::string targetOutside(const std::string& link, const std::string& root) {
  std::error_code error;
  const std::string target = fs::canonical(link, error).string();
  return error || target.starts_with(root == "/" ? root : root + '/') ? "" : target;
}

// Of a project of Beremiz or OpenPLC remain its program and its extensions in folders such as `python_0@py_ext`. The
// others hold what the tool generated, among it the whole program as ST.
void leaveGenerated(Folder& folder) {
  const auto program = std::find_if(folder.files.begin(), folder.files.end(),
                                    [](const std::string& path) { return nameOf(path) == "plc.xml"; });
  folder.is_beremiz = program != folder.files.end();
  if (!folder.is_beremiz) return;
  folder.files = {*program};
  std::erase_if(folder.folders,
                [](const std::string& path) { return nameOf(path).find('@') == std::string_view::npos; });
}

void add(std::string path, Folder& folder) {
  const FileKind kind = importer::kindOfExtension(path);
  const importer::FileRole role = importer::roleOf(kind);
  if (role == importer::FileRole::ListingProject)
    folder.plc_projects.push_back(std::move(path));
  else if (role == importer::FileRole::FolderProject)
    folder.is_beremiz = true;
  else if (kind != FileKind::Unknown && role != importer::FileRole::RungProject)
    folder.files.push_back(std::move(path));
}

}  // namespace

std::string prefixOf(const std::string& folder) {
  if (folder == ".") return "";
  return folder.back() == '/' ? folder : folder + "/";
}

std::string readFolder(const std::string& path, const std::string& root, Folder& folder) {
  DIR* dir = opendir(path.c_str());
  if (dir == nullptr) return strerror(errno);
  const std::string prefix = prefixOf(path);
  while (const dirent* entry = readdir(dir)) {
    if (entry->d_name[0] == '.') continue;
    std::string inner = prefix + entry->d_name;
    unsigned char type = entry->d_type;
    if (type == DT_UNKNOWN || type == DT_LNK) {
      struct stat info;
      if (stat(inner.c_str(), &info) != 0) continue;  // a dangling link
      if (S_ISREG(info.st_mode)) {
        if (std::string target = targetOutside(inner, root); !target.empty()) {
          if (importer::kindOfExtension(inner) != FileKind::Unknown)
            folder.outside.emplace_back(std::move(inner), std::move(target));
          continue;
        }
        type = DT_REG;
      } else if (S_ISDIR(info.st_mode) && type == DT_UNKNOWN) {
        type = DT_DIR;
      }
    }
    if (type == DT_DIR)
      folder.folders.push_back(std::move(inner));
    else if (type == DT_REG)
      add(std::move(inner), folder);
  }
  closedir(dir);
  for (std::vector<std::string>* paths : {&folder.files, &folder.folders, &folder.plc_projects})
    std::sort(paths->begin(), paths->end());
  std::sort(folder.outside.begin(), folder.outside.end());
  if (folder.is_beremiz) leaveGenerated(folder);
  return {};
}

void keepVariables(Folder& extension) {
  std::erase_if(extension.files, [](const std::string& path) {
    const std::string_view name = nameOf(path);
    return name != "pyfile.xml" && name != "cfile.xml" && name != "baseconfnode.xml";
  });
}

}  // namespace rung::driver

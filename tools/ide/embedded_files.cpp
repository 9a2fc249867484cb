// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/embedded_files.h"

#include <filesystem>

#include "frontend/source/files.h"
#include "tools/driver/commands.h"
#include "tools/driver/file_provider.h"
#include "tools/driver/installation.h"
#include "tools/driver/output_files.h"

namespace rung::ide {

EmbeddedFiles::EmbeddedFiles() {
  if (!cache_.folder().empty()) folder_ = driver::absolutePath(cache_.folder()) + "/editor-" + driver::version() + "/";
}

// Another process may have written the file: it is the same.
std::string EmbeddedFiles::write(const std::string& below, std::string_view text) const {
  if (folder_.empty()) return {};
  if (const auto known = known_.find(below); known != known_.end()) return known->second;
  std::string path = folder_ + below;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  const ReadResult old = readFile(path);
  if (!old.error.empty() || old.content != text)
    if (!driver::writeFile(path, std::string(text)).empty()) path.clear();
  known_.emplace(below, path);
  return path;
}

std::string EmbeddedFiles::pathOfLibrary(std::string_view name, std::string_view text) const {
  if (name.empty() || name.starts_with("__") || !name.ends_with(".st")) return {};
  return write("libraries/" + std::string(name), text);
}

std::string EmbeddedFiles::pathOfPage(std::string_view code) const {
  const std::string_view page = driver::errorPage(code);
  return page.empty() ? std::string() : write("errors/" + std::string(code) + ".md", page);
}

}  // namespace rung::ide

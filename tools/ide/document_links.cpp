// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/document_links.h"

#include <algorithm>
#include <filesystem>

#include "frontend/import/formats.h"
#include "tools/driver/file_provider.h"

namespace rung::ide {
namespace {

constexpr size_t kMostLinks = 2000;

bool listsFiles(const std::string& path) {
  return path.ends_with("/rung.project") ||
         importer::roleOf(importer::kindOfExtension(path)) == importer::FileRole::ListingProject;
}

// Between the quotes of an attribute, else between blanks and commas.
std::string_view endsOfPaths(const std::string& path) {
  return path.ends_with("/rung.project") ? std::string_view(" \t\r\n,=") : std::string_view("\"'<>=\r\n");
}

bool mayBePath(std::string_view word) {
  return word.size() > 1 && word.find_first_of("./\\") != std::string_view::npos &&
         word.find('\0') == std::string_view::npos;
}

}  // namespace

std::vector<DocumentLink> linksOf(const View& view, FileId file) {
  const std::string path = view.pathOf(file);
  std::vector<DocumentLink> links;
  if (!listsFiles(path)) return links;
  const std::string folder = path.substr(0, path.rfind('/') + 1);
  const std::string_view text = view.textOf(file), ends = endsOfPaths(path);
  for (size_t begin = 0; begin < text.size() && links.size() < kMostLinks;) {
    const size_t end = std::min(text.find_first_of(ends, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    if (mayBePath(word)) {
      std::string target(word);
      std::replace(target.begin(), target.end(), '\\', '/');
      if (!target.starts_with('/')) target.insert(0, folder);
      std::error_code error;
      if (std::filesystem::exists(target, error))
        links.push_back(
            {{file, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}, driver::absolutePath(target)});
    }
    begin = end + 1;
  }
  return links;
}

}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
// The C++ files of a project's native blocks; see native_sources.h.
#include "tools/driver/native_sources.h"

#include <algorithm>
#include <filesystem>

#include "codegen/names.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"
#include "native_table.h"
#include "tools/driver/file_provider.h"
#include "tools/driver/folder.h"

namespace rung::driver {

namespace fs = std::filesystem;

std::string NativeSources::readFolder(const std::string& folder, const std::string& library, Inputs& inputs,
                                      Sources& sources) {
  const fs::path natives = fs::path(prefixOf(folder)) / "native";
  std::error_code none;
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(natives, none))
    if (const std::string extension = entry.path().extension(); extension == ".cpp" || extension == ".h")
      paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  if (!paths.empty()) inputs.read.push_back(natives.string());
  for (const std::string& path : paths) {
    ReadResult text = rung::readFile(path);
    if (!text.error.empty()) return "cannot read `" + path + "`: " + text.error;
    inputs.read.push_back(path);
    // Relative to the root, so the generated code is the same wherever the project lies.
    const std::string shown = fs::path(absolutePath(path)).lexically_relative(inputs.root).generic_string();
    const FileId file = sources.add(shown, std::move(text.content));
    if (!file) return "the inputs together exceed 4 GiB with `" + path + "`";
    sources.setDisplayPath(file, path);
    sources_.push_back({library, fs::path(path).filename().string(), file});
  }
  return {};
}

std::string NativeSources::read(Inputs& inputs, const LibrarySet& libraries, Sources& sources) {
  const std::vector<std::string> folders = inputs.folders;
  for (const std::string& folder : folders)
    if (std::string error = readFolder(folder, {}, inputs, sources); !error.empty()) return error;
  for (const auto& [library, folder] : libraries.folders())
    if (std::string error = readFolder(folder, library, inputs, sources); !error.empty()) return error;
  return {};
}

void NativeSources::addTo(std::vector<codegen::OutputFile>& files, const ir::Module& module,
                          const Sources& sources) const {
  const auto isUsed = [&](const std::string& library) {
    return std::any_of(module.bodies.begin(), module.bodies.end(), [&](const ir::Body& body) {
      return body.native && sameIdentifier(module.names.string(body.library_name), library);
    });
  };
  for (const Source& source : sources_) {
    if (!isUsed(source.library)) continue;
    std::string text = "#line 1 ";
    codegen::appendQuoted(text, sources.path(source.file));
    text += '\n';
    files.push_back({codegen::nativeFolder(source.library) + source.name,
                     text + std::string(sources.sourceText(source.file)), source.name.ends_with(".cpp")});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
}

bool NativeSources::mention(std::string_view function, const Sources& sources) const {
  for (const Source& source : sources_) {
    const std::string_view text = sources.sourceText(source.file);
    for (size_t at = text.find(function); at != std::string_view::npos; at = text.find(function, at + 1)) {
      const size_t end = at + function.size();
      if ((at == 0 || !isNameCharacter(text[at - 1])) && (end == text.size() || !isNameCharacter(text[end])))
        return true;
    }
  }
  return false;
}

bool isNativeOfRung(std::string_view function) {
  return ir::interpreter::findNative({natives::table, natives::count}, function) != nullptr;
}

}  // namespace rung::driver

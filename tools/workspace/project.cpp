// SPDX-License-Identifier: Apache-2.0
// The project around a folder: see project.h.
#include "tools/workspace/project.h"

#include <algorithm>
#include <filesystem>

#include "frontend/import/formats.h"
#include "frontend/source/names.h"

namespace rung::workspace {
namespace {

namespace fs = std::filesystem;

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// The project files that a folder may have, by order of preference.
FoundProject projectIn(const fs::path& folder, const std::string& shown) {
  const auto named = [&](const std::string& name) { return shown == "." ? name : shown + "/" + name; };
  if (isFile(folder / "rung.project")) return {shown, {}};
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().generic_string();
    if (importer::roleOf(importer::kindOfExtension(name)) == importer::FileRole::ListingProject && isFile(it->path()))
      found.push_back(named(name));
  }
  std::sort(found.begin(), found.end());
  if (isFile(folder / "beremiz.xml")) {
    found.push_back(named("beremiz.xml"));
  } else if (isFile(folder / "plc.xml")) {
    found.push_back(named("plc.xml"));
  }
  if (found.empty()) return {};
  if (found.size() > 1)
    return {{}, "two projects in one folder, `" + found[0] + "` and `" + found[1] + "`; name one of them"};
  return {found[0], {}};
}

}  // namespace

FoundProject projectAround(const std::string& folder) {
  std::error_code error;
  fs::path at = fs::absolute(folder, error).lexically_normal();
  if (error) return {};
  if (at.filename().empty() && at.has_parent_path()) at = at.parent_path();
  std::string shown = folder;
  while (shown.size() > 1 && shown.back() == '/') shown.pop_back();
  for (;;) {
    FoundProject found = projectIn(at, shown);
    if (!found.input.empty() || !found.error.empty() || at == at.root_path()) return found;
    at = at.parent_path();
    shown = shown == "." ? ".." : shown + "/..";
  }
}

std::string addProject(std::vector<std::string>& inputs, const std::string& command, bool is_test) {
  if (inputs.empty()) {
    const FoundProject found = projectAround(".");
    if (!found.error.empty()) return found.error;
    if (found.input.empty())
      return "`rung " + command +
             "` needs files or folders to read, or a project here or in a folder above: rung.project, a .plcproj, "
             "beremiz.xml or plc.xml";
    inputs.push_back(found.input);
    return {};
  }
  if (!is_test) return {};
  for (const std::string& input : inputs) {
    std::error_code error;
    const fs::path path(input);
    const bool is_folder = fs::is_directory(path, error);
    const std::string folder = is_folder ? input : path.has_parent_path() ? path.parent_path().generic_string() : ".";
    const FoundProject found = projectAround(folder);
    const bool is_project = !found.input.empty() && fs::is_regular_file(fs::path(found.input) / "rung.project", error);
    if (!is_project || fs::equivalent(found.input, folder, error)) continue;
    inputs.push_back(found.input);
    break;
  }
  return {};
}

}  // namespace rung::workspace

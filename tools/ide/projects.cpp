// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/projects.h"

#include <algorithm>
#include <filesystem>

#include "frontend/import/formats.h"
#include "tools/driver/file_provider.h"
#include "tools/driver/folder.h"
#include "tools/workspace/project.h"

namespace rung::ide {
namespace {

namespace fs = std::filesystem;

// An opened folder may be a home folder or the root: beyond this the search for projects ends.
constexpr size_t kMaxSearchedFolders = 5000;
constexpr int kMaxSearchedDepth = 20;

std::string parentOf(const std::string& path) { return fs::path(path).parent_path().generic_string(); }

bool isBelow(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder == "/" ? folder : folder + "/");
}

bool isProgram(const std::string& path) { return importer::holdsProgram(importer::kindOfExtension(path)); }

// A file of this name says which files form a project.
bool namesProject(const std::string& path) {
  const std::string name = fs::path(path).filename().generic_string();
  return name == "rung.project" || name == "beremiz.xml" || name == "plc.xml" ||
         importer::roleOf(importer::kindOfExtension(name)) == importer::FileRole::ListingProject;
}

// The folders with a project file below one, itself among them, without links and hidden ones.
std::set<std::string> projectFoldersBelow(const std::string& folder) {
  std::set<std::string> found;
  size_t searched = 0;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && it != end && searched < kMaxSearchedFolders; it.increment(error)) {
    std::error_code ignored;
    const std::string name = it->path().filename().generic_string();
    if (!it->is_directory(ignored) || it->is_symlink(ignored)) {
      if (namesProject(name)) found.insert(parentOf(it->path().generic_string()));
      continue;
    }
    ++searched;
    if (name.starts_with('.') || name == "node_modules" || it.depth() >= kMaxSearchedDepth)
      it.disable_recursion_pending();
  }
  found.insert(folder);
  return found;
}

}  // namespace

// ---- which projects there are

void Projects::notice(const std::string& text) {
  if (noticed_.insert(text).second) notices_.push_back(text);
}

std::vector<std::string> Projects::takeNotices() { return std::exchange(notices_, {}); }

void Projects::addFolder(const std::string& path) {
  const std::string folder = driver::absolutePath(path);
  if (folders_.count(folder) != 0) return;
  folders_[folder] = search(folder);
  findProjects();
}

void Projects::removeFolder(const std::string& path) {
  if (folders_.erase(driver::absolutePath(path)) > 0) findProjects();
}

// A buffer without a file may name a project too: `rung.project` that is not saved yet.
Projects::Home Projects::homeOf(const std::string& path) {
  const workspace::FoundProject found = workspace::projectAround(parentOf(path));
  const std::string input = found.input.empty() ? std::string() : driver::absolutePath(found.input);
  const std::string nearest = namesProject(input) ? parentOf(input) : input;
  for (std::string folder = parentOf(path); folder.size() >= nearest.size(); folder = parentOf(folder)) {
    if (buffers_.count(folder + "/rung.project") != 0) return {folder};
    if (folder == "/" || folder.empty()) break;
  }
  if (!found.error.empty()) notice(parentOf(path) + ": " + found.error);
  if (!input.empty()) return {input};
  for (const auto& entry : folders_) {
    const std::string& folder = entry.first;
    const bool is_project = std::any_of(projects_.begin(), projects_.end(), [&](const auto& project) {
      return project->input() == folder && !project->is_single_folder_;
    });
    if (is_project && isBelow(path, folder)) return {folder};
  }
  return isProgram(path) ? Home{parentOf(path), true} : Home{};
}

void Projects::addProject(const Home& home) {
  if (home.input.empty()) return;
  for (const auto& project : projects_)
    if (project->input() == home.input) return;
  auto project = std::make_unique<Project>(home.input, options_);
  project->is_single_folder_ = home.is_single_folder;
  for (const auto& [path, text] : buffers_) project->changes_[path] = text;
  projects_.push_back(std::move(project));
}

// The inputs of the projects in an opened folder; the folder itself where there is none.
std::vector<std::string> Projects::search(const std::string& folder) {
  std::vector<std::string> inputs;
  for (const std::string& inner : projectFoldersBelow(folder)) {
    const workspace::FoundProject found = workspace::projectAround(inner);
    if (!found.error.empty()) notice(inner + ": " + found.error);
    if (!found.input.empty()) inputs.push_back(driver::absolutePath(found.input));
  }
  if (inputs.empty()) inputs.push_back(folder);
  return inputs;
}

// Those of the opened folders and of the buffers; a project that is still among them keeps its view.
void Projects::findProjects() {
  std::vector<std::unique_ptr<Project>> before = std::exchange(projects_, {});
  for (const auto& [folder, inputs] : folders_)
    for (const std::string& input : inputs) addProject({input});
  homes_.clear();
  for (const auto& [path, text] : buffers_) addProject(homes_[path] = homeOf(path));
  for (std::unique_ptr<Project>& project : projects_)
    for (std::unique_ptr<Project>& old : before)
      if (old != nullptr && old->input() == project->input() && old->is_single_folder_ == project->is_single_folder_) {
        project = std::move(old);
        break;
      }
}

Project* Projects::projectOf(const std::string& path) {
  const auto withInput = [&](const std::string& input) -> Project* {
    for (const auto& project : projects_)
      if (!input.empty() && project->input() == input) return project.get();
    return nullptr;
  };
  const auto home = homes_.find(path);
  Project* const own = withInput(home != homes_.end() ? home->second.input : homeOf(path).input);
  if (own != nullptr && (own->view() == nullptr || own->view()->fileAt(path))) return own;
  for (const auto& project : projects_)  // a library that a project reads
    if (project->view() != nullptr && project->view()->fileAt(path)) return project.get();
  return own;
}

// ---- changes

void Projects::edit(const std::string& path, std::string text) {
  const bool is_new = buffers_.count(path) == 0;
  buffers_[path] = text;
  const Home home = is_new ? homeOf(path) : homes_[path];
  homes_[path] = home;
  if (is_new && namesProject(path)) findProjects();
  addProject(home);
  for (const auto& project : projects_) {
    project->changes_[path] = text;
    if (project->input() == home.input || (project->view() != nullptr && project->view()->fileAt(path)))
      project->is_changed_ = true;
  }
}

void Projects::close(const std::string& path) {
  if (buffers_.erase(path) == 0) return;
  const Home home = homes_[path];
  homes_.erase(path);
  for (const auto& project : projects_) {
    project->changes_[path] = std::nullopt;
    if (project->input() == home.input || (project->view() != nullptr && project->view()->fileAt(path)))
      project->is_changed_ = true;
  }
  findProjects();  // a project of buffers alone ends with the last of them
}

void Projects::changedOnDisk(const std::string& path) {
  if (namesProject(path)) {
    for (auto& [folder, inputs] : folders_) inputs = search(folder);
    findProjects();
  }
  for (const auto& project : projects_) {
    const std::string folder = namesProject(project->input()) ? parentOf(project->input()) : project->input();
    const bool reads = project->view() != nullptr && project->view()->fileAt(path);
    if (!reads && !isBelow(path, folder) && !isBelow(folder, path)) continue;
    project->is_changed_ = true;
    if (buffers_.count(path) == 0) project->changes_[path] = std::nullopt;
  }
}

// ---- views

const LibraryIndex& Projects::libraries() {
  if (libraries_ == nullptr) libraries_ = std::make_unique<LibraryIndex>(options_);
  return *libraries_;
}

std::vector<std::string> Projects::inputsOf(const Project& project) const {
  if (!project.is_single_folder_) return {project.input()};
  std::vector<std::string> inputs;
  for (const std::string& name : driver::namesIn(project.input()))
    if (isProgram(name)) inputs.push_back(driver::prefixOf(project.input()) + name);
  for (const auto& [path, text] : buffers_)
    if (parentOf(path) == project.input() && isProgram(path)) inputs.push_back(path);
  std::sort(inputs.begin(), inputs.end());
  inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
  return inputs;
}

const View* Projects::update(Project& project, const std::atomic<bool>* cancelled) {
  if (!project.is_changed_) return project.view();
  std::vector<std::string> inputs = inputsOf(project);
  if (project.workspace_ == nullptr || project.options_.inputs != inputs) {
    project.options_.inputs = std::move(inputs);
    project.workspace_ = std::make_unique<workspace::Workspace>(project.options_);
    project.changes_.clear();
    for (const auto& [path, text] : buffers_) project.changes_[path] = text;
  }
  std::vector<workspace::Change> changes;
  for (auto& [path, text] : project.changes_) changes.push_back({path, std::move(text)});
  project.changes_.clear();
  project.view_.reset();  // what it shows may be brought up to date in its place
  auto snapshot = project.workspace_->apply(std::move(changes), cancelled);
  if (snapshot == nullptr) return nullptr;
  if (!snapshot->error().empty()) notice(project.input() + ": " + snapshot->error());
  project.view_ = std::make_shared<const View>(std::move(snapshot), embedded_);
  project.is_changed_ = false;
  ++project.version_;
  return project.view();
}

std::unique_ptr<const View> Projects::trial(const Project& project, const std::map<std::string, std::string>& texts,
                                            const std::atomic<bool>* cancelled) const {
  driver::ProjectOptions options = options_;
  options.inputs = inputsOf(project);
  std::vector<workspace::Change> changes;
  for (const auto& [path, text] : buffers_)
    if (texts.count(path) == 0) changes.push_back({path, text});
  for (const auto& [path, text] : texts) changes.push_back({path, text});
  auto snapshot = workspace::Workspace(std::move(options)).apply(std::move(changes), cancelled);
  return snapshot == nullptr ? nullptr : std::make_unique<const View>(std::move(snapshot), embedded_);
}

workspace::Fixed Projects::fixed(const Project& project, const std::string& path) const {
  driver::ProjectOptions options = options_;
  options.inputs = inputsOf(project);
  for (const auto& [buffer, text] : buffers_) options.unsaved.push_back({buffer, text});
  return workspace::applyFixes(options, driver::FixSet::Sure, path);
}

}  // namespace rung::ide

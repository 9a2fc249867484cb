// SPDX-License-Identifier: Apache-2.0
// The projects that an editor works on. In: the folders that it opened, the texts of its buffers, and which files
// changed on disk. Out: which project a file belongs to, and a view of each. A folder with a project file is that
// project, also where it is below an opened folder; an opened folder without any is a project of its own; a file
// outside of all is a project of the sources in its folder. Called by servers, in one thread.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/ide/library_index.h"
#include "tools/ide/view.h"
#include "tools/workspace/fix.h"

namespace rung::ide {

class Project {
 public:
  Project(std::string input, const driver::ProjectOptions& options) : input_(std::move(input)), options_(options) {}

  // The folder or file that names the project.
  const std::string& input() const { return input_; }
  // The last view; none before the first.
  const View* view() const { return view_.get(); }
  // Counts the views.
  uint64_t version() const { return version_; }
  bool isChanged() const { return is_changed_; }

 private:
  friend class Projects;

  std::string input_;
  bool is_single_folder_ = false;   // the sources that lie directly in the folder
  driver::ProjectOptions options_;  // of `workspace_`
  std::unique_ptr<workspace::Workspace> workspace_;
  std::map<std::string, std::optional<std::string>> changes_;  // since the last view: the texts of buffers
  std::shared_ptr<const View> view_;
  uint64_t version_ = 0;
  bool is_changed_ = true;
};

class Projects {
 public:
  explicit Projects(driver::ProjectOptions options) : options_(std::move(options)) {}

  void addFolder(const std::string& path);
  void removeFolder(const std::string& path);
  // The text of a buffer that lies over a file.
  void edit(const std::string& path, std::string text);
  void close(const std::string& path);
  // The file or folder was created, changed or deleted.
  void changedOnDisk(const std::string& path);

  const std::vector<std::unique_ptr<Project>>& all() const { return projects_; }
  // None: no project has the file.
  Project* projectOf(const std::string& path);
  // The view with all changes; null: `cancelled` became true.
  const View* update(Project& project, const std::atomic<bool>* cancelled);
  // What the sure fixes make of the project, if only this file may change.
  workspace::Fixed fixed(const Project& project, const std::string& path) const;
  // Workspace::errorsOf: of the last view.
  std::optional<std::vector<std::string>> errorsOf(const Project& project, sema::PouId pou,
                                                   const std::vector<std::string>& statements) const {
    return project.workspace_ == nullptr ? std::nullopt : project.workspace_->errorsOf(pou, statements);
  }
  std::optional<std::vector<std::string>> errorsInCopy(const Project& project, sema::PouId pou,
                                                       const std::vector<std::string>& statements) const {
    return project.workspace_ == nullptr ? std::nullopt : project.workspace_->errorsInCopy(pou, statements);
  }
  std::optional<std::string> goodTypes(const Project& project, const workspace::Analysis::TypeTrial& trial) const {
    return project.workspace_ == nullptr ? std::nullopt : project.workspace_->goodTypes(trial);
  }
  // Workspace::inTrial.
  std::optional<std::string> trial(const Project& project, const std::map<std::string, std::string>& texts,
                                   FunctionRef<std::string(const View& after)> use) const;
  // What the user should know about the folders, once each.
  std::vector<std::string> takeNotices();

  // Of all projects.
  const driver::ProjectOptions& options() const { return options_; }
  const EmbeddedFiles& embedded() const { return embedded_; }
  const LibraryIndex& libraries();

 private:
  struct Home {
    std::string input;
    bool is_single_folder = false;
  };
  Home homeOf(const std::string& path);
  std::vector<std::string> search(const std::string& folder);
  void findProjects();
  void addProject(const Home& home);
  std::vector<std::string> inputsOf(const Project& project) const;
  void notice(const std::string& text);

  driver::ProjectOptions options_;
  EmbeddedFiles embedded_;
  std::unique_ptr<LibraryIndex> libraries_;                  // none: not asked for yet
  std::map<std::string, std::vector<std::string>> folders_;  // those that are opened, with the inputs of their projects
  std::map<std::string, std::string> buffers_;               // by path
  std::map<std::string, Home> homes_;                        // of the files in buffers
  std::vector<std::unique_ptr<Project>> projects_;
  std::set<std::string> noticed_;
  std::vector<std::string> notices_;
};

}  // namespace rung::ide

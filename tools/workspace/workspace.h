// SPDX-License-Identifier: Apache-2.0
// A project that is being edited. In: options that name it, and the texts of open buffers, which lie over the files on
// disk. Out: a snapshot after each change: what the commands know of a project, immutable, so that other threads read
// an old one while the next is made. Used by servers; one thread makes changes.
//
// A change of one body in ST costs a check of its POU (edited_file.h) when no reader holds a snapshot any more: the
// next one then takes over what the last one knew. Any other change costs a whole check.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontend/source/function_ref.h"
#include "tools/workspace/analysis.h"

namespace rung::workspace {

class Snapshot {
 public:
  explicit Snapshot(std::shared_ptr<const Analysis> analysis) : analysis_(std::move(analysis)) {
    analysis_->readers.fetch_add(1, std::memory_order_relaxed);
  }
  ~Snapshot() { analysis_->readers.fetch_sub(1, std::memory_order_release); }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  // Of what is declared: another one after any change that is not one of bodies alone.
  uint64_t revision() const { return analysis_->revision; }
  const Sources& sources() const { return analysis_->compilation().sources; }
  const Names& names() const { return analysis_->compilation().names; }
  const Tree& tree() const { return analysis_->compilation().tree; }
  const driver::Inputs& inputs() const { return analysis_->compilation().inputs; }
  // None: the sources could not be read.
  const sema::Project* project() const { return analysis_->compilation().project.get(); }
  // Sorted as commands print them.
  const std::vector<Diagnostic>& diagnostics() const { return analysis_->compilation().diagnostics.all(); }
  // That of `rung check`.
  int exitCode() const { return analysis_->compilation().exitCode(); }
  // What is wrong with the options or the project as a whole, as a sentence; else empty.
  const std::string& error() const { return analysis_->error(); }

 private:
  std::shared_ptr<const Analysis> analysis_;
};

// An open buffer has this text, whether or not its file exists; without a text it is closed, and the file counts again.
struct Change {
  std::string path;
  std::optional<std::string> text;
};

class Workspace {
 public:
  explicit Workspace(driver::ProjectOptions options) : options_(std::move(options)) {}

  // The snapshot with these changes. A changed body alone is taken as it is; after any other change files that are not
  // open are read from disk. None when `cancelled` became true
  // meanwhile: the changes are noted, and the next snapshot has them.
  std::shared_ptr<const Snapshot> apply(std::vector<Change> changes, const std::atomic<bool>* cancelled = nullptr);
  // What would be wrong with statements in a POU of the last snapshot: for each its errors as `column:code`, with
  // blanks between them. None: it cannot be said. The snapshot says the same afterwards; no other thread reads it
  // meanwhile.
  std::optional<std::vector<std::string>> errorsOf(sema::PouId pou, const std::vector<std::string>& statements) const;
  // The same for statements that may name library blocks which the project does not use yet. Costs some milliseconds.
  std::optional<std::vector<std::string>> errorsInCopy(sema::PouId pou,
                                                       const std::vector<std::string>& statements) const;
  // Analysis::goodTypes, without a change of the last snapshot. None: it cannot be said.
  std::optional<std::string> goodTypes(const Analysis::TypeTrial& trial) const;
  // What `use` says of the project with other texts, by path. It gets a copy of what is known, and may read nothing
  // that refers to the last snapshot. None: it cannot be said.
  std::optional<std::string> inTrial(const std::map<std::string, std::string>& texts,
                                     FunctionRef<std::string(std::shared_ptr<const Snapshot>)> use);
  // The last one that was made; none before the first, and none when the one that was to take its place was cancelled.
  std::shared_ptr<const Snapshot> current();

 private:
  bool editInPlace(const std::vector<Change>& changes, const std::atomic<bool>* cancelled);

  driver::ProjectOptions options_;
  std::map<std::string, std::string> open_;  // by path
  std::shared_ptr<Analysis> analysis_;
  bool lacks_changes_ = false;             // … of an apply() that was cancelled
  std::weak_ptr<const Snapshot> current_;  // of the analysis
};

}  // namespace rung::workspace

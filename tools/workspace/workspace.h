// SPDX-License-Identifier: Apache-2.0
// A project that is being edited. In: options that name it, and the texts of open buffers, which lie over the files on
// disk. Out: a snapshot after each change: what the commands know of a project, immutable, so that other threads read
// an old one while the next is made. Used by servers; one thread makes changes.
//
// Each snapshot is made from its texts alone: a change of a project of 100 000 lines costs a whole check of it.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/driver/compile.h"

namespace rung::workspace {

class Snapshot {
 public:
  Snapshot(driver::ProjectOptions options, const std::atomic<bool>* cancelled);

  const Sources& sources() const { return compilation_.sources; }
  const Names& names() const { return compilation_.names; }
  const Tree& tree() const { return compilation_.tree; }
  const driver::Inputs& inputs() const { return compilation_.inputs; }
  // None: the sources could not be read.
  const sema::Project* project() const { return compilation_.project.get(); }
  // Sorted as commands print them.
  const std::vector<Diagnostic>& diagnostics() const { return compilation_.diagnostics.all(); }
  // That of `rung check`.
  int exitCode() const { return compilation_.exitCode(); }
  // What is wrong with the options or the project as a whole, as a sentence; else empty.
  const std::string& error() const { return sink_.error_text; }

 private:
  struct Silent final : driver::Sink {
    void message(std::string_view) override {}
    std::string output(std::string_view) override { return {}; }
    void diagnostics(const Diagnostics&, const Sources&, const RenderOptions&) override {}
    void error(std::string_view what) override { error_text = what; }
    std::string error_text;
  };

  Silent sink_;
  driver::PhaseTimes times_;
  driver::Compilation compilation_;
};

// An open buffer has this text, whether or not its file exists; without a text it is closed, and the file counts again.
struct Change {
  std::string path;
  std::optional<std::string> text;
};

class Workspace {
 public:
  explicit Workspace(driver::ProjectOptions options) : options_(std::move(options)) {}

  // The snapshot with these changes, or none when `cancelled` became true meanwhile: the changes are noted, and the
  // next snapshot has them.
  std::shared_ptr<const Snapshot> apply(std::vector<Change> changes, const std::atomic<bool>* cancelled = nullptr);
  // The last one that was made; none before the first.
  std::shared_ptr<const Snapshot> current() const { return current_; }

 private:
  driver::ProjectOptions options_;
  std::map<std::string, std::string> open_;  // by path
  std::shared_ptr<const Snapshot> current_;
};

}  // namespace rung::workspace

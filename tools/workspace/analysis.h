// SPDX-License-Identifier: Apache-2.0
// What is known of a project with the texts of open buffers: read, parsed, checked. Snapshots lend it to readers; while
// none does, the workspace may bring it up to date instead of making another.
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "tools/driver/compile.h"
#include "tools/workspace/edited_file.h"

namespace rung::workspace {

class Analysis {
 public:
  Analysis(driver::ProjectOptions options, const std::atomic<bool>* cancelled);

  // Gives files other texts, by path. False: that takes a new analysis, or was cancelled, and this one is of no use.
  bool edit(const std::map<std::string, std::string>& texts, const std::atomic<bool>* cancelled);

  // The errors of statements as the body of a POU, each on a line of its own: for each the columns and codes, `5:E0401
  // 9:E0231`. The analysis is of no use afterwards, unless staysUsable().
  std::vector<std::string> errorsOf(sema::PouId pou, const std::vector<std::string>& statements);
  bool staysUsable(sema::PouId pou, const std::vector<std::string>& statements) const;

  // Bodies to be checked once for each of several types of some variables.
  struct TypeTrial {
    std::vector<sema::VarId> vars;
    sema::PouId result_of;           // whose result has the type as well; none: nothing's
    sema::PouId pou;                 // around the declaration; none: file level
    std::vector<std::string> types;  // with initial values, as they are written: `INT := 5`
    struct Body {
      sema::PouId pou;
      std::string statements;  // that name the variables; empty: its own ones
    };
    std::vector<Body> bodies;
  };
  // The types that exist, take the initial value, and with which there is no error that there is not with a variable of
  // which nothing is known: for each `+` or `-`. The analysis is of no use afterwards.
  std::string goodTypes(const TypeTrial& trial);

  // Only one more edit will come.
  void makeLast() { compilation_.is_last = true; }

  const driver::Compilation& compilation() const { return compilation_; }
  const std::string& error() const { return sink_.error_text; }

  uint64_t revision;  // of the declarations
  mutable std::atomic<uint32_t> readers = 0;

 private:
  std::vector<std::string> errorsIn(FileId file, size_t lines) const;
  DeclId trialBody(sema::PouId id, const std::string& statements, FileId& file);
  std::vector<TypeId> typesOf(const TypeTrial& trial);
  size_t errorsOf(const std::vector<sema::CheckedProject::NewBody>& bodies) const;
  EditedFile* editedFile(const std::string& path);
  bool checkAgain(const std::map<std::string, std::string>& texts, const std::atomic<bool>* cancelled);

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
  std::map<std::string, EditedFile> edited_;    // by absolute path
  uint32_t first_size_ = 0, checked_size_ = 0;  // of the written tree at first, of all when it was last checked
};

}  // namespace rung::workspace

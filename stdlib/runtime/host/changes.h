// SPDX-License-Identifier: Apache-2.0
// The online changes of a run: the new version is compiled, where time goes on by a thread while the program runs, and
// takes over. In: commands, and files that change. Out: what became of them. Used by run.cpp.
#pragma once

#include <functional>
#include <future>
#include <string>

#include "rung/host.h"
#include "session.h"

namespace rung::host {

class Changes {
 public:
  struct Outcome {
    ChangeReport report;
    bool compiles = true;  // else the error says why not
  };
  using Done = std::function<void(const Outcome& outcome)>;
  // Runs what puts another version in the place of the session's: others may have to know before and after it.
  using Around = std::function<void(const std::function<void()>& act)>;

  Changes(Session& session, const RunOptions& options) : session_(session), options_(options) {}
  void setAround(Around around) { around_ = std::move(around); }

  // Of Command::Change. Where no time goes on, `done` is called at once, else from attend.
  void begin(const Command& command, Done done);
  // Makes the change that is ready, or begins one because files have changed. Called now and then; quick where there is
  // nothing to do.
  void attend(const Done& of_files);
  // The paths of the version that runs, as messages show them; empty: those of the options.
  const ShownPaths& paths() const { return paths_; }
  // The version before goes on: see Session::goBack.
  bool goBack();

 private:
  void make(const NewVersion& version);

  Session& session_;
  const RunOptions& options_;
  Around around_ = [](const std::function<void()>& act) { act(); };
  Command command_;  // that has begun
  Done done_;
  std::future<NewVersion> compiling_;
  int64_t next_look_ns_ = 0;  // at the files
  ShownPaths paths_, paths_before_;
};

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// The online changes of a run: the new version is compiled, in real time by a thread while the program goes on, and
// takes over. In: commands, and files that change. Out: sentences for the user. Used by run.cpp.
#pragma once

#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>

#include "rung/host.h"
#include "session.h"

namespace rung::host {

class Changes {
 public:
  struct Outcome {
    ChangeReport report;
    bool is_compiled = true;  // else the error of the report says what the compiler says
  };
  static Outcome refused(std::string why, bool is_compiled = true);
  // What others hold on to while another version takes over.
  using Guard = std::function<std::unique_lock<std::mutex>()>;

  Changes(Session& session, const RunOptions& options, Guard guard)
      : session_(session), options_(options), guard_(std::move(guard)) {}

  // Of Command::Change. In virtual time it is made at once. Empty: it is made when it is ready.
  std::optional<Outcome> begin(const Command& command);
  // Makes the change that is ready, or begins one because files have changed. Called now and then; quick where there is
  // nothing to do.
  std::optional<Outcome> attend();
  // The version before goes on, where Session::goBack lets it.
  bool goBack();
  // The paths of the version that runs, as messages show them; empty: those of the options.
  const ShownPaths& paths() const { return shown_.paths; }
  // Its bodies, for the monitor; asked where no other version can take over.
  const std::vector<rung_pou_view>& pous() const { return shown_.keeper ? shown_.pous : options_.monitor.pous; }

 private:
  Outcome make(const NewVersion& version);

  Session& session_;
  const RunOptions& options_;
  const Guard guard_;
  Command command_;  // that has begun
  std::future<NewVersion> compiling_;
  int64_t next_look_ns_ = 0;  // at the files
  // What is shown of the version that runs, and of the one before.
  struct Shown {
    ShownPaths paths;
    std::vector<rung_pou_view> pous;
    std::shared_ptr<const void> keeper;  // of them; null: they are those of the options
  };
  Shown shown_, before_;
};

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// Online changes of a run: see changes.h.
#include "changes.h"

#include <dlfcn.h>

#include <utility>

#include "clock.h"

namespace rung::host {
namespace {

constexpr int64_t kLookNs = 200'000'000;

// A library of `rung build --shared --online-change`, for programs that have no compiler.
NewVersion loadLibrary(const std::string& name, const std::string& path) {
  NewVersion version;
  if (path.empty()) return version.error = "name the library of the new version, made by `rung build`", version;
  void* const library = dlopen(path.find('/') == std::string::npos ? ("./" + path).c_str() : path.c_str(), RTLD_NOW);
  if (library == nullptr) return version.error = dlerror(), version;
  version.keeper = std::shared_ptr<const void>(library, [](void* loaded) { dlclose(loaded); });
  const auto module = reinterpret_cast<rung_module_function>(dlsym(library, (name + "_module").c_str()));
  if (module == nullptr)
    version.error = path + ": it has no function `" + name + "_module`";
  else
    version.module = module();
  return version;
}

}  // namespace

void Changes::begin(const Command& command, Done done) {
  if (compiling_.valid()) {
    Outcome outcome;
    outcome.report.error = "another change has begun and is not complete";
    return done(outcome);
  }
  command_ = command;
  done_ = std::move(done);
  if (command_.rollback_cycles < 0) command_.rollback_cycles = options_.change.rollback_cycles;
  const std::string name = session_.module().description.name, project = command.project;
  const auto compile = options_.change.compile ? options_.change.compile
                                               : [name](const std::string& path) { return loadLibrary(name, path); };
  if (!options_.realtime && options_.monitor.address.empty()) return make(compile(project));
  compiling_ = std::async(std::launch::async, [compile, project] { return compile(project); });
}

void Changes::attend(const Done& of_files) {
  if (compiling_.valid()) {
    if (compiling_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) make(compiling_.get());
    return;
  }
  if (!options_.change.has_changed || monotonicNs() < next_look_ns_) return;
  next_look_ns_ = monotonicNs() + kLookNs;
  if (options_.change.has_changed()) begin(Command{}, of_files);
}

void Changes::make(const NewVersion& version) {
  Outcome outcome;
  outcome.compiles = version.module != nullptr;
  outcome.report.error = version.error;
  if (outcome.compiles)
    around_([&] {
      outcome.report =
          session_.change({version.module, version.keeper, ""}, command_.is_only_asked, command_.rollback_cycles);
    });
  if (outcome.report.error.empty() && !command_.is_only_asked) paths_before_ = std::exchange(paths_, version.paths);
  std::exchange(done_, {})(outcome);
}

bool Changes::goBack() {
  bool went_back = false;
  around_([&] { went_back = session_.goBack(); });
  if (went_back) paths_ = paths_before_;
  return went_back;
}

}  // namespace rung::host

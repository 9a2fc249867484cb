// SPDX-License-Identifier: Apache-2.0
// Online changes of a run: see changes.h.
#include "changes.h"

#include <dlfcn.h>

#include <algorithm>
#include <utility>

#include "clock.h"
#include "processor.h"

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

Changes::Outcome Changes::refused(std::string why, bool is_compiled) {
  Outcome outcome;
  outcome.report.error = std::move(why);
  outcome.is_compiled = is_compiled;
  return outcome;
}

std::optional<Changes::Outcome> Changes::begin(const Command& command) {
  if (compiling_.valid()) return refused("another change has begun and is not complete");
  command_ = command;
  if (command_.rollback_cycles < 0) command_.rollback_cycles = options_.change.rollback_cycles;
  const std::string name = session_.module().description.name, project = command.project;
  const auto compile = options_.change.compile ? options_.change.compile
                                               : [name](const std::string& path) { return loadLibrary(name, path); };
  if (!options_.realtime && options_.monitor.address.empty()) return make(compile(project));
  const uint32_t resources = std::max(session_.module().resources.size(), 1u);
  session_.beAtEase();  // threads, and the compiler, have the priority of the one that begins them
  compiling_ = std::async(std::launch::async, [compile, project, resources] {
    yieldToTasks(resources);
    return compile(project);
  });
  return std::nullopt;
}

std::optional<Changes::Outcome> Changes::attend() {
  if (compiling_.valid()) {
    if (compiling_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    return make(compiling_.get());
  }
  if (!options_.change.has_changed || monotonicNs() < next_look_ns_) return std::nullopt;
  next_look_ns_ = monotonicNs() + kLookNs;
  if (!options_.change.has_changed()) return std::nullopt;
  return begin(Command{});
}

Changes::Outcome Changes::make(const NewVersion& version) {
  if (version.module == nullptr) return refused(version.error, false);
  const std::unique_lock<std::mutex> held = guard_();
  Outcome outcome;
  outcome.report = session_.change(*version.module, version.keeper, command_.is_only_asked, command_.rollback_cycles);
  if (outcome.report.error.empty() && !command_.is_only_asked)
    before_ = std::exchange(shown_, Shown{version.paths, version.pous, version.keeper});
  return outcome;
}

bool Changes::goBack() {
  if (!session_.goBack()) return false;
  shown_ = std::exchange(before_, {});
  return true;
}

}  // namespace rung::host

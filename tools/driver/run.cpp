// SPDX-License-Identifier: Apache-2.0
// `rung run`: interprets the program, or compiles it to a shared object in the cache, and runs it on the bundled host,
// which asks for other versions of it while it runs.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "ir/ir.h"
#include "rung/host.h"
#include "tools/driver/commands.h"
#include "tools/driver/installation.h"
#include "tools/driver/program_version.h"
#include "tools/driver/source_watch.h"

namespace rung::driver {

namespace {

host::ShownPaths pathsOf(const ProgramVersion& version) {
  return host::ShownPaths(version.paths.begin(), version.paths.end());
}

// Another version, for an online change. `inputs`: another project; empty: the same.
host::NewVersion makeVersion(const ProjectOptions& project, const RunOptions& options, const std::string& input,
                             bool has_monitor) {
  ProjectOptions changed = project;
  if (!input.empty()) changed.inputs = {input};
  MessageSink gathered;
  PhaseTimes times;
  const auto made = std::make_shared<ProgramVersion>();
  made->has_monitor = has_monitor;
  host::NewVersion version;
  if (makeProgram(changed, options, false, times, gathered, *made) != kSuccess) {
    version.error = "the new version does not compile\n" + gathered.text;
    while (!version.error.empty() && version.error.back() == '\n') version.error.pop_back();
    return version;
  }
  version.module = made->module;
  version.paths = pathsOf(*made);
  version.pous = made->views.rows();
  version.keeper = made;
  return version;
}

// Where there is a desktop; else the URL has been printed.
void openInBrowser(const std::string& url) {
  if (getenv("DISPLAY") == nullptr && getenv("WAYLAND_DISPLAY") == nullptr) return;
  const pid_t child = fork();
  if (child == 0) {
    if (fork() == 0) execlp("xdg-open", "xdg-open", url.c_str(), nullptr);
    _exit(0);
  }
  if (child > 0) waitpid(child, nullptr, 0);  // of the browser's process init is the parent
}

void prepareMonitor(host::MonitorOptions& monitor, bool opens) {
  monitor.version = std::string("rung ") + version();
  if (!opens) return;
  if (monitor.address.empty()) monitor.address = "0";
  monitor.on_start = openInBrowser;
}

}  // namespace

int runRun(const ProjectOptions& project, const RunOptions& options, Sink& sink) {
  host::RunOptions run_options;
  std::vector<std::string> rest;
  std::string error = host::parseRunOptions(options.host_arguments, run_options, rest);
  if (error.empty() && !rest.empty()) error = "unknown option `" + rest[0] + "` of `rung run`";
  if (!error.empty()) return usageError(sink, error);
  prepareMonitor(run_options.monitor, options.opens_monitor);
  run_options.color = project.report.color;
  run_options.out = sink.programOutput();
  run_options.err = sink.programErrors();

  PhaseTimes times;
  ProjectOptions compiling = project;
  compiling.code.default_interval_ns = run_options.interval_ns;
  compiling.code.counts_steps = true;
  compiling.code.trace_calls = run_options.trace_calls;
  ProgramVersion made;
  made.has_monitor = !run_options.monitor.address.empty();
  compiling.code.online_change = options.watch_files || !run_options.control_path.empty() || made.has_monitor;
  const bool must_interpret = options.engine == Engine::Interpreter || run_options.trace_calls;
  std::optional<SourceWatch> watch;
  if (options.watch_files) watch.emplace(project);
  int exit = makeProgram(compiling, options, must_interpret, times, sink, made);
  if (exit == kSuccess) {
    if (made.program && options.engine == Engine::Auto)
      run_options.hint_when_long = "rung: a long run is faster with --engine=native";
    run_options.paths = pathsOf(made);
    run_options.monitor.pous = made.views.rows();
    run_options.monitor.engine = made.program ? "interp" : "native";
    if (compiling.code.online_change)
      run_options.change.compile = [&](const std::string& input) {
        return makeVersion(compiling, options, input, made.has_monitor);
      };
    if (watch) run_options.change.has_changed = [&] { return watch->hasChanged(); };
    times.begin("run");
    constexpr uint8_t kMemoryChecks = ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast;
    sink.programRuns(true, (made.checks & kMemoryChecks) == kMemoryChecks);
    exit = host::run(*made.module, run_options);
    sink.programRuns(false, false);
    times.end();
  }
  if (project.time_phases) sink.message(times.table());
  return exit;
}

}  // namespace rung::driver

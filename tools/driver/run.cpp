// SPDX-License-Identifier: Apache-2.0
// `rung run`: interprets the program, or compiles it to a shared object in the cache, and runs it on the bundled host.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "ir/ir.h"
#include "rung/host.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/installation.h"
#include "tools/driver/module_library.h"
#include "tools/driver/native.h"
#include "tools/driver/pou_views.h"

namespace rung::driver {

namespace {

// A program as compiled code.
struct Loaded {
  Cache cache;
  ModuleLibrary library;
  const rung_module* module = nullptr;
};

// Compiles the C++ to a shared object and loads it. `has_user_cpp`: the compilation reports what the C++ compiler says
// about it. Returns an exit code.
int load(Compilation& compilation, const NativeRequest& request, bool has_user_cpp, Loaded& to, Sink& sink) {
  const NativeResult result = makeShared(to.cache, request, sink);
  if (has_user_cpp)
    compilation.finish(result);
  else if (result.exit == kInternal)
    sink.internalError(result.message);
  else if (result.exit == kUsage)
    usageError(sink, result.message);
  if (result.exit != kSuccess) return result.exit;
  std::string error = to.library.open(result.path);
  to.module = error.empty() ? to.library.find(compilation.options.moduleName(), error) : nullptr;
  if (to.module != nullptr) return kSuccess;
  sink.internalError(error);
  return kInternal;
}

int runOnHost(const rung_module& module, Compilation& compilation, host::RunOptions& options, Sink& sink) {
  for (const InputFile& file : compilation.inputs.files) options.paths[file.below] = file.shown;
  PouViews views;
  if (!options.monitor.address.empty()) views = PouViews::of(compilation);
  options.monitor.pous = views.rows();
  constexpr uint8_t kMemoryChecks = ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast;
  sink.programRuns(true, (compilation.options.code.checks & kMemoryChecks) == kMemoryChecks);
  const int exit = host::run(module, options);
  sink.programRuns(false, false);
  return exit;
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
  Compilation compilation(compiling, times, sink);
  NativeRequest request;
  request.has_call_paths = true;
  request.parts.resize(1);
  std::unique_ptr<ir::interpreter::Program> program;
  std::string why;
  bool ok = options.mayInterpret() ? compilation.translate(program, why) : compilation.lower();
  if (ok && !program) ok = compilation.checkNatives() && compilation.emit(request.parts[0].files);
  const bool later = ok && compilation.hasUserCpp() && compilation.exitCode() == kSuccess;
  int exit = later ? kSuccess : compilation.finish();
  if (!ok || exit != kSuccess) {
    if (project.time_phases) sink.message(times.table());
    return exit;
  }
  if (!why.empty()) {
    if (options.engine == Engine::Interpreter || run_options.trace_calls)
      return usageError(sink, "this program cannot be interpreted: " + why);
    sink.message("rung: this program runs as compiled C++: " + why + "\n");
  }

  Loaded loaded;
  if (program) loaded.module = &program->description();
  run_options.monitor.engine = program ? "interp" : "native";
  if (!program) {
    times.begin("c++");
    request.level = compilation.options.code.level;
    request.jobs = options.native.jobs;
    request.keep = options.native.keep;
    exit = load(compilation, request, later, loaded, sink);
    if (exit != kSuccess) return exit;
  } else if (options.engine == Engine::Auto) {
    run_options.hint_when_long = "rung: a long run is faster with --engine=native";
  }

  times.begin("run");
  exit = runOnHost(*loaded.module, compilation, run_options, sink);
  times.end();
  if (project.time_phases) sink.message(times.table());
  return exit;
}

}  // namespace rung::driver

// `rung run`: interprets the program, or compiles it to a shared object in the cache, and runs it on the bundled host.
#include <cstdio>

#include "ir/ir.h"
#include "rung/host.h"
#include "tools/rung/commands.h"
#include "tools/rung/compile.h"
#include "tools/rung/crash.h"
#include "tools/rung/module_library.h"
#include "tools/rung/native.h"

namespace rung::tool {

int runRun(const Options& options) {
  host::RunOptions run_options;
  std::vector<std::string> rest;
  std::string error = host::parseRunOptions(options.host_arguments, run_options, rest);
  if (error.empty() && !rest.empty()) error = "unknown option `" + rest[0] + "` of `rung run`";
  if (!error.empty()) return usageError(error);
  run_options.color = useColor(options);

  PhaseTimes times;
  Options compiling = options;
  compiling.default_interval_ns = run_options.interval_ns;
  compiling.trace_calls = run_options.trace_calls;
  Compilation compilation(compiling, times);
  NativeRequest request;
  request.parts.resize(1);
  std::unique_ptr<ir::interpreter::Program> program;
  std::string why;
  bool ok = compilation.translate(false, program, why);
  if (ok && !program) ok = compilation.emit(false, request.parts[0].files);
  const bool later = ok && compilation.hasCppBodies() && compilation.exitCode() == kSuccess;
  int exit = later ? kSuccess : compilation.finish();
  if (!ok || exit != kSuccess) {
    if (options.time_phases) fputs(times.table().c_str(), stderr);
    return exit;
  }
  if (!why.empty()) {
    if (options.engine == Engine::Interpreter || run_options.trace_calls)
      return usageError("this program cannot be interpreted: " + why);
    fprintf(stderr, "rung: this program runs as compiled C++: %s\n", why.c_str());
  }

  Cache cache;
  ModuleLibrary library;
  const rung_module* module = program ? &program->description() : nullptr;
  if (!program) {
    times.begin("c++");
    request.level = compilation.options.level;
    request.jobs = options.jobs;
    request.keep = options.keep;
    NativeResult result = makeShared(cache, request);
    if (later) {
      compilation.finish(result);
    } else {
      if (result.exit == kInternal) printInternalError(result.message.c_str());
      if (result.exit == kUsage) usageError(result.message);
    }
    if (result.exit != kSuccess) return result.exit;
    error = library.open(result.path);
    module = error.empty() ? library.find(compilation.options.moduleName(), error) : nullptr;
    if (module == nullptr) {
      printInternalError(error.c_str());
      return kInternal;
    }
  } else if (options.engine == Engine::Auto) {
    run_options.hint_when_long = "rung: a long run is faster with --engine=native";
  }

  times.begin("run");
  constexpr uint8_t kMemoryChecks = ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast;
  setProgramRuns(true, (compilation.options.checks & kMemoryChecks) == kMemoryChecks);
  exit = host::run(*module, run_options);
  setProgramRuns(false, false);
  times.end();
  if (options.time_phases) fputs(times.table().c_str(), stderr);
  return exit;
}

}  // namespace rung::tool

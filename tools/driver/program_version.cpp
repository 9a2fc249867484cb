// SPDX-License-Identifier: Apache-2.0
// A program that can run: see program_version.h.
#include "tools/driver/program_version.h"

#include "tools/driver/commands.h"

namespace rung::driver {

namespace {

// Compiles the C++ to a shared object and loads it. `has_user_cpp`: the compilation reports what the C++ compiler says
// about it. Returns an exit code.
int load(Compilation& compilation, const NativeRequest& request, bool has_user_cpp, ProgramVersion& to, Sink& sink) {
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

}  // namespace

int makeProgram(const ProjectOptions& project, const RunOptions& options, bool must_interpret, PhaseTimes& times,
                Sink& sink, ProgramVersion& made) {
  Compilation compilation(project, times, sink);
  NativeRequest request;
  request.has_call_paths = true;
  request.parts.resize(1);
  bool ok = options.mayInterpret() ? compilation.translate(made.program, made.why_compiled) : compilation.lower();
  if (ok && !made.program) ok = compilation.checkNatives() && compilation.emit(request.parts[0].files);
  const bool later = ok && compilation.hasUserCpp() && compilation.exitCode() == kSuccess;
  const int exit = later ? kSuccess : compilation.finish();
  if (!ok || exit != kSuccess) return exit;
  if (!made.why_compiled.empty()) {
    if (must_interpret) return usageError(sink, "this program cannot be interpreted: " + made.why_compiled);
    sink.message("rung: this program runs as compiled C++: " + made.why_compiled + "\n");
  }
  made.checks = compilation.options.code.checks;
  for (const InputFile& file : compilation.inputs.files) made.paths.emplace_back(file.below, file.shown);
  if (made.has_monitor) made.views = PouViews::of(compilation);
  if (made.program) {
    made.module = &made.program->description();
    return kSuccess;
  }
  times.begin("c++");
  request.level = compilation.options.code.level;
  request.jobs = options.native.jobs;
  request.keep = options.native.keep;
  return load(compilation, request, later, made, sink);
}

}  // namespace rung::driver

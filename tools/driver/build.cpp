// SPDX-License-Identifier: Apache-2.0
// `rung build`: emit, compile and link to an executable with the bundled host, a shared or a static library.
#include <sys/stat.h>

#include <cstdio>

#include "debugger_scripts.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/native.h"
#include "tools/driver/output_files.h"
#include "tools/driver/pou_views.h"

namespace rung::driver {

namespace {

int writeSymbols(const BuildOptions& options, const std::vector<codegen::OutputFile>& files, Sink& sink) {
  for (const codegen::OutputFile& file : files) {
    if (file.path != codegen::kSymbolFile) continue;
    if (std::string error = writeFile(options.symbols, file.content); !error.empty()) return usageError(sink, error);
  }
  return kSuccess;
}

// gdb loads PROGRAM-gdb.py with PROGRAM.
int writeDebuggerScript(const BuildOptions& options, Sink& sink) {
  const std::string error = writeFile(options.output + "-gdb.py", std::string(embedded::debugger_scripts[0].text));
  return error.empty() ? kSuccess : usageError(sink, error);
}

}  // namespace

int runBuild(const ProjectOptions& project, const BuildOptions& options, Sink& sink) {
  struct stat info;
  if (stat(options.output.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
    return usageError(sink, "`" + options.output + "` is a folder; `-o` needs the name of a file");

  PhaseTimes times;
  ProjectOptions building = project;
  const bool is_for_debugger = options.debug && !project.code.level_given;
  if (is_for_debugger) building.code.level = 0;
  building.code.level_given = project.code.level_given || options.debug;
  Compilation compilation(building, times, sink);
  NativeRequest request;
  request.parts.resize(1);
  const bool ok =
      (options.kind != BuildKind::Executable || compilation.checkNatives()) && compilation.emit(request.parts[0].files);
  const bool later = ok && compilation.hasUserCpp();
  int exit = later ? compilation.exitCode() : compilation.finish();
  if (ok && exit == kSuccess) {
    times.begin("c++");
    Cache cache;
    request.level = is_for_debugger ? 0 : 2;
    request.debug = options.debug;
    request.jobs = options.native.jobs;
    request.keep = options.native.keep;
    if (options.kind == BuildKind::Executable) request.views = PouViews::of(compilation).source();
    NativeResult result =
        makeOutput(cache, request, options.kind, compilation.options.moduleName(), options.output, sink);
    times.end();
    exit = result.exit;
    if (later)
      exit = compilation.finish(result);
    else if (exit == kInternal)
      sink.internalError(result.message);
    else if (exit != kSuccess)
      usageError(sink, result.message);
    if (exit == kSuccess && options.debug) exit = writeDebuggerScript(options, sink);
    if (exit == kSuccess && !options.symbols.empty()) exit = writeSymbols(options, request.parts[0].files, sink);
  }
  if (project.time_phases) sink.message(times.table());
  return exit;
}

}  // namespace rung::driver

// SPDX-License-Identifier: Apache-2.0
// `rung build`: emit, compile and link to an executable with the bundled host, a shared or a static library.
#include <sys/stat.h>

#include <cstdio>

#include "debugger_scripts.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/native.h"
#include "tools/driver/output_files.h"

namespace rung::driver {

namespace {

int writeSymbols(const Options& options, const std::vector<codegen::OutputFile>& files, Sink& sink) {
  for (const codegen::OutputFile& file : files) {
    if (file.path != codegen::kSymbolFile) continue;
    if (std::string error = writeFile(options.symbols, file.content); !error.empty()) return usageError(sink, error);
  }
  return kSuccess;
}

// gdb loads PROGRAM-gdb.py with PROGRAM.
int writeDebuggerScript(const Options& options, Sink& sink) {
  const std::string error = writeFile(options.output + "-gdb.py", std::string(embedded::debugger_scripts[0].text));
  return error.empty() ? kSuccess : usageError(sink, error);
}

}  // namespace

int runBuild(const Options& options, Sink& sink) {
  struct stat info;
  if (stat(options.output.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
    return usageError(sink, "`" + options.output + "` is a folder; `-o` needs the name of a file");

  PhaseTimes times;
  Options building = options;
  if (options.debug && !options.level_given) building.level = 0;
  building.level_given = building.level_given || options.debug;
  Compilation compilation(building, times, sink);
  NativeRequest request;
  request.parts.resize(1);
  const bool ok = (options.build != BuildKind::Executable || compilation.checkNatives()) &&
                  compilation.emit(false, request.parts[0].files);
  const bool later = ok && compilation.hasUserCpp();
  int exit = later ? compilation.exitCode() : compilation.finish();
  if (ok && exit == kSuccess) {
    times.begin("c++");
    Cache cache;
    request.level = options.debug && !options.level_given ? 0 : 2;
    request.debug = options.debug;
    request.jobs = options.jobs;
    request.keep = options.keep;
    NativeResult result =
        makeOutput(cache, request, options.build, compilation.options.moduleName(), options.output, sink);
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
  if (options.time_phases) sink.message(times.table());
  return exit;
}

}  // namespace rung::driver

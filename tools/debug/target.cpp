// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/target.h"

#include "rung/host.h"

namespace rung::debug {
void Target::watchFiles(const driver::ProjectOptions& project, const driver::RunOptions& run) {
  const auto watch = std::make_shared<driver::SourceWatch>(project);
  debugger->newVersion([watch, project, run](std::string& problem) -> std::shared_ptr<driver::ProgramVersion> {
    // Somebody who steps has saved: the files are quiet.
    if (!watch->hasChanged() && !watch->hasChanged()) return nullptr;
    driver::MessageSink gathered;
    driver::PhaseTimes times;
    auto made = std::make_shared<driver::ProgramVersion>();
    if (driver::makeProgram(project, run, true, times, gathered, *made) == driver::kSuccess) return made;
    problem = "the new version does not compile\n" + gathered.text;
    return nullptr;
  });
}

int Target::make(const TargetOptions& options, std::function<void(const std::string& text, bool is_error)> print,
                 driver::Sink& sink, std::string& error) {
  ExecutionOptions wanted;
  std::vector<std::string> rest;
  error = host::parseRunOptions(options.run.host_arguments, wanted.run, rest);
  if (error.empty() && !rest.empty()) error = "unknown option `" + rest[0] + "`";
  if (!error.empty()) return driver::kUsage;

  driver::ProjectOptions compiling = options.project;
  compiling.code.default_interval_ns = wanted.run.interval_ns;
  compiling.code.counts_steps = true;
  compiling.code.debug = true;
  compiling.code.with_tests = !options.test.empty();
  if (!compiling.code.level_given) compiling.code.level = 0;
  driver::RunOptions run = options.run;
  run.engine = driver::Engine::Interpreter;
  driver::PhaseTimes times;
  compiling.code.online_change = run.watch_files;
  version = std::make_shared<driver::ProgramVersion>();
  const int exit = driver::makeProgram(compiling, run, true, times, sink, *version);
  if (exit != driver::kSuccess) return exit;

  wanted.run.paths = host::ShownPaths(version->paths.begin(), version->paths.end());
  wanted.run.out = sink.programOutput();
  wanted.run.err = sink.programErrors();
  wanted.dialect = options.project.dialect;
  wanted.test = options.test;
  wanted.history_bytes = size_t{options.history_mb} << 20;
  wanted.print = std::move(print);
  execution = std::make_unique<Execution>(version, std::move(wanted));
  if (!execution->load(error)) return driver::kUsage;
  debugger = std::make_unique<Debugger>(*execution);
  if (run.watch_files) watchFiles(compiling, run);
  return driver::kSuccess;
}

}  // namespace rung::debug

// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/target.h"

#include "rung/host.h"

namespace rung::debug {
namespace {

// Options of `rung run` that have no meaning without a clock, or whose effects have no past.
std::string refusedOption(const host::RunOptions& run) {
  if (run.realtime) return "--realtime";
  if (!run.monitor.address.empty()) return "--monitor";
  if (!run.control_path.empty()) return "--control";
  if (!run.drivers.empty()) return "--driver";
  if (!run.plot_path.empty()) return "--plot";
  return run.trace_calls ? "--trace-calls" : "";
}

}  // namespace

int Target::make(const TargetOptions& options, std::function<void(const std::string& text, bool is_error)> print,
                 driver::Sink& sink, std::string& error) {
  ExecutionOptions wanted;
  std::vector<std::string> rest;
  error = host::parseRunOptions(options.run.host_arguments, wanted.run, rest);
  if (error.empty() && !rest.empty()) error = "unknown option `" + rest[0] + "`";
  const std::string refused = refusedOption(wanted.run);
  if (error.empty() && !refused.empty()) error = "`" + refused + "` cannot be combined with the debugger";
  if (error.empty() && options.run.engine == driver::Engine::Native)
    error = "the debugger interprets the program; for compiled code there is `rung build -g` and gdb";
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
  const int exit = driver::makeProgram(compiling, run, true, times, sink, version);
  if (exit != driver::kSuccess) return exit;

  wanted.run.paths = host::ShownPaths(version.paths.begin(), version.paths.end());
  wanted.run.out = sink.programOutput();
  wanted.run.err = sink.programErrors();
  wanted.dialect = options.project.dialect;
  wanted.test = options.test;
  wanted.history_bytes = size_t{options.history_mb} << 20;
  wanted.print = std::move(print);
  execution = std::make_unique<Execution>(version, std::move(wanted));
  if (!execution->load(error)) return driver::kUsage;
  debugger = std::make_unique<Debugger>(*execution);
  return driver::kSuccess;
}

}  // namespace rung::debug

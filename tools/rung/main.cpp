// SPDX-License-Identifier: Apache-2.0
// rung: parses the command line and runs the command. All exit codes are those of tools/driver/options.h.
#include <malloc.h>
#include <unistd.h>

#include <climits>
#include <csignal>

#include "frontend/source/invariant.h"
#include "tools/dap/adapter.h"
#include "tools/debug/terminal.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/overwritten.h"
#include "tools/lsp/server.h"
#include "tools/monitor/monitor.h"
#include "tools/rung/console.h"
#include "tools/rung/crash.h"
#include "tools/rung/options.h"
#include "tools/rung/response_files.h"
#include "tools/workspace/fix.h"
#include "tools/workspace/project.h"

namespace {

using rung::tool::Command;
using rung::tool::CommandLine;
using rung::tool::Console;

// Of a program that runs, or of one that it runs.
int runMonitor(const CommandLine& line, Console& console) {
  if (rung::tool::hasUrl(line))
    return rung::monitor::runMonitor(line.project.inputs, line.monitor_rate, line.run, console);
  rung::driver::RunOptions run = line.run;
  run.opens_monitor = true;
  return rung::driver::runRun(line.project, run, console);
}

int runDebug(const CommandLine& line, Console& console) {
  rung::debug::TerminalOptions options;
  options.target = {line.project, line.run, line.debug.test, line.debug.history_mb};
  options.scripts = line.debug.scripts;
  options.commands = line.debug.commands;
  options.is_batch = line.debug.is_batch;
  return rung::debug::runTerminal(options, console);
}

// The options of `rung debug` in the arguments of a launch.
std::string parseLaunch(const std::vector<std::string>& words, rung::debug::TargetOptions& options) {
  std::vector<std::string> arguments = {"debug"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  CommandLine line;
  std::string error = rung::tool::parseCommandLine(arguments, line);
  if (error.empty() && line.help) error = "`--help` is not an option of a launch";
  if (error.empty()) error = rung::workspace::addProject(line.project.inputs, "debug", false);
  options = {line.project, line.run, line.debug.test, line.debug.history_mb};
  return error;
}

int runDap(const CommandLine& line, Console& console) {
  if (line.debug.port == UINT32_MAX) return rung::dap::runAdapter(STDIN_FILENO, STDOUT_FILENO, parseLaunch);
  return rung::dap::runAdapterOnPort(line.debug.port, parseLaunch, console);
}

int runCommand(const CommandLine& line, Console& console) {
  const rung::driver::ProjectOptions& project = line.project;
  const std::vector<std::string>& words = project.inputs;
  switch (line.command) {
    case Command::Check:
      return line.check.fixes == rung::driver::FixSet::None ? rung::driver::runCheck(project, console)
                                                            : rung::workspace::runFix(project, line.check, console);
    case Command::Emit: return rung::driver::runEmit(project, line.emit, console);
    case Command::Build: return rung::driver::runBuild(project, line.build, console);
    case Command::Run: return rung::driver::runRun(project, line.run, console);
    case Command::Test: return rung::driver::runTest(project, line.test, console);
    case Command::Convert: return rung::driver::runConvert(project, line.convert, console);
    case Command::Graph: return rung::driver::runGraph(project, line.graph, console);
    case Command::Fmt: return rung::driver::runFormat(project, line.fmt, console);
    case Command::List: return rung::driver::runList(project, line.list, console);
    case Command::New: return rung::driver::runNew(words[0], line.project_template, console);
    case Command::Init: return rung::driver::runInit(project, console);
    case Command::Cam: return rung::driver::runCam(words, line.cam, line.cam_output, console);
    case Command::Monitor: return runMonitor(line, console);
    case Command::Debug: return runDebug(line, console);
    case Command::Lsp: return rung::lsp::runServer(project, line.lsp_log, STDIN_FILENO, STDOUT_FILENO, console);
    case Command::Dap: return runDap(line, console);
    case Command::Explain: return rung::driver::runExplain(words[0], project.report.color, console);
    case Command::Version: return rung::driver::runVersion(console);
    case Command::None:
    case Command::Help: break;
  }
  return rung::driver::kUsage;
}

}  // namespace

// What one phase has given back serves the next one, instead of going through the system, which clears each page again.
static void keepMemory() {
  mallopt(M_MMAP_THRESHOLD, 256 << 20);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, 1 << 20);
}

int main(int argc, char** argv) {
  keepMemory();
  signal(SIGXFSZ, SIG_IGN);  // makes exceeding a file size limit a write error, like a full disk
  rung::tool::installCrashHandler(argv + 1, argc > 0 ? argc - 1 : 0);
  rung::setPhase("command line");
  Console console;
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; i++) arguments.emplace_back(argv[i]);
  if (arguments.empty()) {
    console.message(rung::tool::helpText(Command::None));
    return rung::driver::kUsage;
  }
  CommandLine line;
  std::vector<std::string>& inputs = line.project.inputs;
  std::string error = rung::tool::expandResponseFiles(arguments);
  if (error.empty()) error = rung::tool::parseCommandLine(arguments, line);
  if (error.empty() && !line.help && rung::tool::readsProject(line))
    error = rung::workspace::addProject(inputs, rung::tool::commandName(line.command), line.command == Command::Test);
  if (error.empty() && !line.help) error = rung::driver::checkDumpName(line.project.code.dump_after);
  if (error.empty() && !line.help) error = rung::driver::checkOutputs(inputs, rung::tool::outputsOf(line));
  if (!error.empty()) return rung::driver::usageError(console, error);
  if (line.help) return rung::driver::printResult(console, rung::tool::helpText(line.command));
  line.project.report.color = rung::tool::useColor(line.color, line.command == Command::Explain ? 1 : 2);
  return runCommand(line, console);
}

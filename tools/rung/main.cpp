// SPDX-License-Identifier: Apache-2.0
// rung: parses the command line and runs the command. All exit codes are those of tools/driver/options.h.
#include <csignal>

#include "frontend/source/invariant.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/overwritten.h"
#include "tools/rung/console.h"
#include "tools/rung/crash.h"
#include "tools/rung/options.h"
#include "tools/workspace/project.h"

namespace {

using rung::tool::Command;
using rung::tool::Console;

int runCommand(const rung::tool::Options& options, Console& console) {
  switch (options.command) {
    case Command::Check: return rung::driver::runCheck(options, console);
    case Command::Emit: return rung::driver::runEmit(options, console);
    case Command::Build: return rung::driver::runBuild(options, console);
    case Command::Run: return rung::driver::runRun(options, console);
    case Command::Test: return rung::driver::runTest(options, console);
    case Command::Convert: return rung::driver::runConvert(options, console);
    case Command::Graph: return rung::driver::runGraph(options, console);
    case Command::Fmt: return rung::driver::runFormat(options, console);
    case Command::List: return rung::driver::runList(options, console);
    case Command::New: return rung::driver::runNew(options, console);
    case Command::Init: return rung::driver::runInit(options, console);
    case Command::Cam: return rung::driver::runCam(options.inputs, options.cam, options.output, console);
    case Command::Explain: return rung::driver::runExplain(options, console);
    case Command::Version: return rung::driver::runVersion(console);
    case Command::None:
    case Command::Help: break;
  }
  return rung::driver::kUsage;
}

}  // namespace

int main(int argc, char** argv) {
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
  rung::tool::Options options;
  std::string error = rung::tool::expandResponseFiles(arguments);
  if (error.empty()) error = rung::tool::parseOptions(arguments, options);
  if (error.empty() && !options.help && rung::tool::readsProject(options.command))
    error = rung::workspace::addProject(options.inputs, rung::tool::commandName(options.command),
                                        options.command == Command::Test);
  if (error.empty() && !options.help) error = rung::driver::checkDumpName(options.dump_after);
  if (error.empty() && !options.help) error = rung::driver::checkOutputs(options);
  if (!error.empty()) return rung::driver::usageError(console, error);
  if (options.help) return rung::driver::printResult(console, rung::tool::helpText(options.command));
  options.color = rung::tool::useColor(options.color_choice, options.command == Command::Explain ? 1 : 2);
  return runCommand(options, console);
}

// rung: parses the command line and runs the command. All exit codes are those of options.h.
#include <csignal>
#include <cstdio>

#include "frontend/source/invariant.h"
#include "tools/rung/commands.h"
#include "tools/rung/compile.h"
#include "tools/rung/crash.h"

namespace {

int runCommand(const rung::tool::Options& options) {
  using rung::tool::Command;
  switch (options.command) {
    case Command::Check: return rung::tool::runCheck(options);
    case Command::Emit: return rung::tool::runEmit(options);
    case Command::Build: return rung::tool::runBuild(options);
    case Command::Run: return rung::tool::runRun(options);
    case Command::Test: return rung::tool::runTest(options);
    case Command::Convert: return rung::tool::runConvert(options);
    case Command::Graph: return rung::tool::runGraph(options);
    case Command::List: return rung::tool::runList(options);
    case Command::Explain: return rung::tool::runExplain(options);
    case Command::Version: return rung::tool::runVersion(options);
    case Command::None:
    case Command::Help: break;
  }
  return rung::tool::kUsage;
}

}  // namespace

int main(int argc, char** argv) {
  signal(SIGXFSZ, SIG_IGN);  // makes exceeding a file size limit a write error, like a full disk
  rung::tool::installCrashHandler(argv + 1, argc > 0 ? argc - 1 : 0);
  rung::setPhase("command line");
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; i++) arguments.emplace_back(argv[i]);
  if (arguments.empty()) {
    fputs(rung::tool::helpText(rung::tool::Command::None).c_str(), stderr);
    return rung::tool::kUsage;
  }
  rung::tool::Options options;
  std::string error = rung::tool::expandResponseFiles(arguments);
  if (error.empty()) error = rung::tool::parseOptions(arguments, options);
  if (error.empty() && !options.help) error = rung::tool::checkDumpName(options.dump_after);
  if (!error.empty()) return rung::tool::usageError(error);
  if (options.help) {
    error = rung::tool::printOut(rung::tool::helpText(options.command));
    return error.empty() ? rung::tool::kSuccess : rung::tool::usageError(error);
  }
  return runCommand(options);
}

// SPDX-License-Identifier: Apache-2.0
// The commands of Rung as functions, one file each. In: inputs and options. Out: the exit code (Exit in options.h), and
// what a command has to say, through a sink. None has state of its own, so a process may call them any number of times
// and in several threads; programs run one at a time, since a crash is handled by the whole process. Called by
// tools/rung, and by anything else that works with programs: servers, plug-ins, tests.
#pragma once

#include <string>
#include <string_view>

#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::driver {

// Parses and checks.
int runCheck(const ProjectOptions& project, Sink& sink);
// Writes C++ below options.output; or passes the tree or the IR to the sink.
int runEmit(const ProjectOptions& project, const EmitOptions& options, Sink& sink);
// Compiles and links to options.output.
int runBuild(const ProjectOptions& project, const BuildOptions& options, Sink& sink);
// Runs the program on the bundled host.
int runRun(const ProjectOptions& project, const RunOptions& options, Sink& sink);
// Runs the POUs marked {test}.
int runTest(const ProjectOptions& project, const TestOptions& options, Sink& sink);
// Writes the program as ST or PLCopen XML below options.output.
int runConvert(const ProjectOptions& project, const ConvertOptions& options, Sink& sink);
// Writes pictures of networks and charts below options.output.
int runGraph(const ProjectOptions& project, const GraphOptions& options, Sink& sink);
// Formats files in place; or tells what it would change.
int runFormat(const ProjectOptions& project, const FormatOptions& options, Sink& sink);
// Libraries, POUs, warnings, or the declaration of options.signature.
int runList(const ProjectOptions& project, const ListOptions& options, Sink& sink);
// Makes a folder with a small project of a template.
int runNew(const std::string& folder, const std::string& project_template, Sink& sink);
// Writes a rung.project for the sources of a folder, the only input, or the current one.
int runInit(const ProjectOptions& project, Sink& sink);
// The page of the code that is wanted.
int runExplain(const std::string& wanted, bool color, Sink& sink);
// The version, and the paths of the parts that generated code needs.
int runVersion(Sink& sink);

// The page of a code, as `rung explain` shows it; empty: no such page.
std::string_view errorPage(std::string_view code);

// Reports a mistake in the options; returns kUsage.
inline int usageError(Sink& sink, std::string_view message) {
  sink.error(message);
  return kUsage;
}
// Passes the result of a command to the sink; returns the exit code.
inline int printResult(Sink& sink, std::string_view text) {
  const std::string error = sink.output(text);
  return error.empty() ? kSuccess : usageError(sink, error);
}

}  // namespace rung::driver

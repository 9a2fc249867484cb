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
int runCheck(const Options& options, Sink& sink);
// Writes C++ below options.output; or passes the tree or the IR to the sink.
int runEmit(const Options& options, Sink& sink);
// Compiles and links to options.output.
int runBuild(const Options& options, Sink& sink);
// Runs the program on the bundled host.
int runRun(const Options& options, Sink& sink);
// Runs the POUs marked {test}.
int runTest(const Options& options, Sink& sink);
// Writes the program as ST or PLCopen XML below options.output.
int runConvert(const Options& options, Sink& sink);
// Writes pictures of networks and charts below options.output.
int runGraph(const Options& options, Sink& sink);
// Formats files in place; or tells what it would change.
int runFormat(const Options& options, Sink& sink);
// Libraries, POUs, warnings, or the declaration of options.signature.
int runList(const Options& options, Sink& sink);
// Makes a folder with a small project of a template.
int runNew(const Options& options, Sink& sink);
// Writes a rung.project for the sources of a folder.
int runInit(const Options& options, Sink& sink);
// The page of the code options.inputs[0].
int runExplain(const Options& options, Sink& sink);
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

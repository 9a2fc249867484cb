// SPDX-License-Identifier: Apache-2.0
// The command line of rung: its commands and options, by tables (option_table.h), and its help.
// In: argv. Out: CommandLine, or a usage error (exit 2). Called by main.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/driver/cam.h"
#include "tools/driver/options.h"
#include "tools/driver/overwritten.h"

namespace rung::tool {

using namespace driver;

enum class Command : uint8_t {
  None,
  Check,
  Emit,
  Build,
  Run,
  Test,
  Convert,
  Graph,
  Fmt,
  List,
  New,
  Init,
  Cam,
  Monitor,
  Debug,
  Lsp,
  Dap,
  Explain,
  Version,
  Help
};
inline constexpr uint32_t kCommandCount = static_cast<uint32_t>(Command::Help) + 1;

// Of `rung debug`.
struct DebugOptions {
  std::vector<std::string> scripts;   // -x FILE
  std::vector<std::string> commands;  // -c COMMAND
  bool is_batch = false;              // --batch
  std::string test;                   // --test NAME
  uint32_t history_mb = 64;           // --history
  uint32_t port = UINT32_MAX;         // --port of `rung dap`; UINT32_MAX: not given
};

enum class Color : uint8_t { Auto, Always, Never };

// A parsed command line: what all commands have in common, and the options of each. Only those of `command` are set.
struct CommandLine {
  Command command = Command::None;
  bool help = false;  // `rung CMD --help`
  Color color = Color::Auto;
  ProjectOptions project;  // its inputs are the words of a command that reads no project too
  CheckOptions check;
  EmitOptions emit;
  BuildOptions build;
  RunOptions run;
  TestOptions test;
  ConvertOptions convert;
  GraphOptions graph;
  FormatOptions fmt;
  ListOptions list;
  std::string project_template = "st";  // --template
  CamOptions cam;
  std::string cam_output;
  std::string lsp_log;  // --log of `rung lsp`
  DebugOptions debug;
  uint32_t monitor_rate = 10;  // --rate of `rung monitor`
};

// Parses the arguments after the program's name. Returns an error message for the user, or an empty string.
[[nodiscard]] std::string parseCommandLine(const std::vector<std::string>& arguments, CommandLine& line);

// The files that the command writes.
std::vector<Output> outputsOf(const CommandLine& line);

// One screen of help: of rung (Command::None) or of one command.
std::string helpText(Command command);
const char* commandName(Command command);
// The commands and their options as data, for a man page and completions. `value`: its name, or its values with `|`;
// empty: none. A help of several lines has line ends.
struct OptionDescription {
  std::string_view name, value, help;
};
struct CommandDescription {
  std::string_view name, arguments, summary;
  std::vector<OptionDescription> options;
};
std::vector<CommandDescription> describeCommands();

// Tells whether the inputs are sources, so that without them the command takes the project around the current folder.
bool readsProject(const CommandLine& line);
// Tells whether `rung monitor` goes to a program that runs; else it runs one.
bool hasUrl(const CommandLine& line);

}  // namespace rung::tool

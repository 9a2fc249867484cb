// SPDX-License-Identifier: Apache-2.0
// The command line of rung: its commands and options, in one table for the parser, "did you mean" and --help.
// In: argv. Out: Options, or a usage error (exit 2). Called by main.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/driver/cam.h"
#include "tools/driver/options.h"

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
  Explain,
  Version,
  Help
};
inline constexpr uint32_t kCommandCount = static_cast<uint32_t>(Command::Help) + 1;

enum class Color : uint8_t { Auto, Always, Never };

struct Options : driver::Options {
  Command command = Command::None;
  bool help = false;  // `rung CMD --help`
  Color color_choice = Color::Auto;
  CamOptions cam;
};

// Parses the arguments after the program's name. Returns an error message for the user, or an empty string.
[[nodiscard]] std::string parseOptions(const std::vector<std::string>& arguments, Options& options);

// Expands `@file` arguments (shell-like: blanks separate, quotes and backslash group) in place; files may name files.
[[nodiscard]] std::string expandResponseFiles(std::vector<std::string>& arguments);

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

// Tells whether the inputs of the command are sources, so that without them it takes the project around the current
// folder.
bool readsProject(Command command);

}  // namespace rung::tool

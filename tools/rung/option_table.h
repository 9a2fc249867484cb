// SPDX-License-Identifier: Apache-2.0
// The tables of the command line: the commands, and the options with the commands that have them, what they set and
// their help. Read by the parser, "did you mean" and --help in options.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tools/rung/options.h"

namespace rung::tool {

constexpr uint32_t bit(Command command) { return 1u << static_cast<uint32_t>(command); }

struct CommandRow {
  Command command;
  const char* name;
  const char* arguments;
  const char* summary;
};

struct OptionRow {
  const char* name;   // as the user types it: "--root", "-o"
  const char* value;  // the name of its value; null: none
  uint32_t commands;
  // Sets what the option means for the command of the line. Returns an error message, or an empty string.
  std::string (*set)(const OptionRow& row, const std::string& value, CommandLine& line);
  const char* help;  // null: not in the help
};

std::span<const CommandRow> commandRows();
std::span<const OptionRow> optionRows();
const OptionRow* findOption(std::string_view name);

}  // namespace rung::tool

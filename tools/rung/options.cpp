// SPDX-License-Identifier: Apache-2.0
// The command line of rung: its parser and its help; see options.h. What an option sets is in option_table.cpp.
#include "tools/rung/options.h"

#include <algorithm>
#include <cstdlib>

#include "frontend/source/diagnostics.h"
#include "tools/driver/new_project.h"
#include "tools/monitor/client.h"
#include "tools/rung/option_table.h"

namespace rung::tool {
namespace {

// Commands announced in the project's documentation.
constexpr std::string_view kLaterCommands[] = {"lint"};

// `-O2`, `-Wno-x`, `-Idir`, `-j4`, `-oout`: the value follows a one-letter option without a blank.
const OptionRow* findGlued(std::string_view word) {
  if (word.size() < 3 || word[1] == '-') return nullptr;
  const OptionRow* row = findOption(word.substr(0, 2));
  return row != nullptr && row->value != nullptr ? row : nullptr;
}

std::string unknownOption(std::string_view word, Command command) {
  std::vector<std::string_view> candidates;
  std::string_view name = word.substr(0, word.find('='));
  for (const OptionRow& row : optionRows())
    if (row.help != nullptr && (row.commands & bit(command))) candidates.push_back(row.name);
  return withSuggestion("unknown option " + backquoted(name) + " of `rung " + commandName(command) + "`", name,
                        candidates) +
         " (`rung " + commandName(command) + " --help` lists all)";
}

std::string elsewhere(const OptionRow& row, Command command) {
  std::string message =
      backquoted(row.name) + " is not an option of `rung " + commandName(command) + "`; it belongs to";
  const char* separator = " ";
  for (const CommandRow& other : commandRows()) {
    if (!(row.commands & bit(other.command))) continue;
    message += separator + backquoted(std::string("rung ") + other.name);
    separator = ", ";
  }
  return message;
}

Command findCommand(std::string_view word) {
  for (const CommandRow& row : commandRows())
    if (word == row.name) return row.command;
  if (word == "help" || word == "--help" || word == "-h") return Command::Help;
  if (word == "--version" || word == "-V") return Command::Version;
  return Command::None;
}

std::string checkEmit(const EmitOptions& options) {
  if (options.kind == EmitKind::Cpp && options.output.empty() && !options.list_outputs)
    return "`rung emit` needs a folder for the C++ files: add `-o DIR`, or `--emit=ir` to print the IR";
  const bool writes =
      !options.output.empty() || !options.depfile.empty() || options.list_outputs || options.bundles > 0;
  if (options.kind != EmitKind::Cpp && writes)
    return "`--emit=ir` and `--emit=tree` print to stdout and take no `-o`, `--depfile`, `--list-outputs` or "
           "`--bundles`";
  if (!options.depfile_target.empty() && options.depfile.empty()) return "`--depfile-target` needs `--depfile`";
  if (!options.depfile.empty() && options.output.empty() && options.depfile_target.empty())
    return "`--depfile` needs `-o` or `--depfile-target`";
  return {};
}

// The interpreter alone counts statements and prints calls.
std::string needsInterpreter(const char* option, const RunOptions& options) {
  if (options.engine != Engine::Native && !options.native.keep) return {};
  return backquoted(option) + " needs the interpreter; remove " +
         (options.native.keep ? "`--keep`" : "`--engine=native`");
}

std::string checkRun(const RunOptions& options) {
  const bool traces = std::find(options.host_arguments.begin(), options.host_arguments.end(), "--trace-calls") !=
                      options.host_arguments.end();
  return traces ? needsInterpreter("--trace-calls", options) : std::string();
}

std::string checkTest(const ProjectOptions& project, const TestOptions& options) {
  if (!project.report.path.empty() && options.separate)
    return "`--diagnostics` and `--separate` cannot be combined; each file is a project of its own";
  return options.counts() ? needsInterpreter(options.coverage ? "--coverage" : "--lcov", options.run) : std::string();
}

std::string checkConvert(const ConvertOptions& options) {
  if (options.output.empty() || options.to == ConvertTo::None)
    return "`rung convert` needs a target and a folder: add `--to st|xml|mes -o DIR`";
  if (options.splits && options.to != ConvertTo::St) return "`--split` goes with `--to st`: other formats are one file";
  return {};
}

std::string checkList(const ProjectOptions& project, const ListOptions& options) {
  if (options.what.empty() && options.signature.empty())
    return "`rung list` takes `libraries`, `pous FILE|DIR ...`, `tasks FILE|DIR ...`, `warnings` or `--signature NAME`";
  if (project.report.format == DiagnosticFormat::Sarif) return "`rung list` takes `--format=text` or `--format=json`";
  return {};
}

// What each option accepts alone, and the command does not accept together. A command that reads a project takes that
// around the current folder when it has no inputs.
std::string checkCombination(const CommandLine& line) {
  const std::vector<std::string>& words = line.project.inputs;
  switch (line.command) {
    case Command::Emit: return checkEmit(line.emit);
    case Command::Build:
      return line.build.output.empty() ? "`rung build` needs a name for its output: add `-o FILE`" : "";
    case Command::Run:
    case Command::Monitor:
    case Command::Debug: return checkRun(line.run);
    case Command::Test: return checkTest(line.project, line.test);
    case Command::Convert: return checkConvert(line.convert);
    case Command::Graph:
      return line.graph.output.empty() ? "`rung graph` needs a folder for the pictures: add `-o DIR`" : "";
    case Command::Fmt: return line.fmt.lines.last != UINT32_MAX && words.size() != 1 ? "`--lines` takes one file" : "";
    case Command::List: return checkList(line.project, line.list);
    case Command::New: return words.size() != 1 ? "`rung new` takes one name, that of the folder to make" : "";
    case Command::Init: return words.size() > 1 ? "`rung init` takes one folder" : "";
    case Command::Cam: return words.empty() ? "`rung cam` needs a subcommand: law, check, show, convert or fit" : "";
    case Command::Lsp: return words.empty() ? "" : "`rung lsp` takes no inputs: the editor names its folders and files";
    case Command::Dap: return words.empty() ? "" : "`rung dap` takes no inputs: the editor names the program";
    case Command::Explain: return words.size() != 1 ? "`rung explain` takes one code, such as E0401" : "";
    case Command::Check:
      return line.check.shows_changes && line.check.fixes == FixSet::None ? "`--diff` needs `--fix` or `--fix=all`"
                                                                          : "";
    case Command::Version:
    case Command::None:
    case Command::Help: break;
  }
  return {};
}

void appendRow(std::string& out, const std::string& left, const char* help) {
  constexpr size_t kColumn = 28;
  out += "  " + left;
  if (left.size() + 2 >= kColumn)
    out += "\n" + std::string(kColumn, ' ');
  else
    out.append(kColumn - 2 - left.size(), ' ');
  for (const char* c = help; *c != '\0'; c++) {
    out += *c;
    if (*c == '\n') out.append(kColumn, ' ');
  }
  out += '\n';
}

// The values of `-O` and `-W` follow without a blank.
std::string synopsis(const OptionRow& row) {
  std::string out = row.name;
  if (row.value == nullptr) return out;
  if (out == "-O" || out == "-W") return out + row.value;
  return out + (out.starts_with("--") ? "=" : " ") + row.value;
}

std::string unknownCommand(const std::string& word) {
  for (const std::string_view later : kLaterCommands)
    if (word == later) return "`rung " + word + "` is not supported in this version of rung";
  std::vector<std::string_view> names;
  for (const CommandRow& row : commandRows()) names.emplace_back(row.name);
  return withSuggestion("unknown command " + backquoted(word), word, names) + " (`rung --help` lists all)";
}

// The option at arguments[at], whose value may be the next argument: then `at` becomes its index.
std::string parseOption(const std::vector<std::string>& arguments, size_t& at, CommandLine& line) {
  const std::string& word = arguments[at];
  const size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
  bool has_value = equals != std::string::npos;
  std::string value = has_value ? word.substr(equals + 1) : "";
  const OptionRow* row = findOption(word);  // `--fix=all` is one
  if (row != nullptr)
    has_value = false;
  else
    row = findOption(word.substr(0, equals));
  if (row == nullptr && (row = findGlued(word)) != nullptr) {
    value = word.substr(2);
    has_value = true;
  }
  if (row == nullptr) return unknownOption(word, line.command);
  if (!(row->commands & bit(line.command))) return elsewhere(*row, line.command);
  if (row->value == nullptr && has_value) {
    const bool may_be_all = findOption(row->name + std::string("=all")) != nullptr;
    return backquoted(row->name) + (may_be_all ? " takes no value but `all`" : " takes no value");
  }
  if (row->value != nullptr && !has_value) {
    if (at + 1 >= arguments.size()) return backquoted(row->name) + " needs a value: " + synopsis(*row);
    value = arguments[++at];
  }
  if (row->value != nullptr && value.empty()) return backquoted(row->name) + " has an empty value";
  return row->set(*row, value, line);
}

// The words after the command: options and inputs.
std::string parseWords(const std::vector<std::string>& arguments, CommandLine& line) {
  bool only_inputs = false;
  for (size_t i = 1; i < arguments.size(); i++) {
    const std::string& word = arguments[i];
    if (word.empty()) return "an input has an empty name";
    if (only_inputs || word[0] != '-' || word == "-") {
      line.project.inputs.push_back(word);
    } else if (word == "--") {
      only_inputs = true;
    } else {
      std::string error = parseOption(arguments, i, line);
      if (!error.empty()) return error;
    }
  }
  return {};
}

bool isVerified() {
  const char* verify = std::getenv("RUNG_VERIFY");
  if (verify != nullptr && verify[0] != '\0') return verify[0] != '0';
#ifdef NDEBUG
  return false;
#else
  return true;
#endif
}

}  // namespace

bool hasUrl(const CommandLine& line) { return !line.project.inputs.empty() && monitor::isUrl(line.project.inputs[0]); }

bool readsProject(const CommandLine& line) {
  if (line.command == Command::Monitor) return !hasUrl(line);
  return (line.command >= Command::Check && line.command <= Command::Fmt) || line.command == Command::Debug;
}

const char* commandName(Command command) {
  for (const CommandRow& row : commandRows())
    if (row.command == command) return row.name;
  return "help";
}

std::vector<Output> outputsOf(const CommandLine& line) {
  std::vector<Output> all;
  for (const std::string& path :
       {line.emit.output, line.build.output, line.convert.output, line.graph.output, line.cam_output})
    all.push_back({"-o", path});
  all.push_back({"--diagnostics", line.project.report.path});
  all.push_back({"--depfile", line.emit.depfile});
  all.push_back({"--symbols", line.build.symbols});
  all.push_back({"--junit", line.test.junit});
  all.push_back({"--lcov", line.test.lcov});
  for (const RunOptions* run : {&line.run, &line.test.run})
    for (const std::string& argument : run->host_arguments)
      for (const std::string option : {"--trace", "--plot", "--retain"})
        if (argument.starts_with(option + "=")) all.push_back({option, argument.substr(option.size() + 1)});
  return all;
}

std::vector<CommandDescription> describeCommands() {
  std::vector<CommandDescription> commands;
  for (const CommandRow& row : commandRows()) {
    CommandDescription command{row.name, row.arguments, row.summary, {}};
    for (const OptionRow& option : optionRows())
      if (option.help != nullptr && (option.commands & bit(row.command)) != 0)
        command.options.push_back({option.name, option.value == nullptr ? "" : option.value, option.help});
    commands.push_back(std::move(command));
  }
  return commands;
}

std::string parseCommandLine(const std::vector<std::string>& arguments, CommandLine& line) {
  if (arguments.empty()) return "expected a command; `rung --help` lists all";
  line.command = findCommand(arguments[0]);
  if (line.command == Command::None) return unknownCommand(arguments[0]);
  if (line.command == Command::Help) {
    line.help = true;
    if (arguments.size() > 1) line.command = findCommand(arguments[1]);
    if (line.command == Command::Help) line.command = Command::None;
    return {};
  }
  // Beyond the limit the rest of a project is unknown, and an editor asks about it while a quote is missing.
  if (line.command == Command::Lsp) line.project.report.max_errors = 1000;
  std::string error = parseWords(arguments, line);
  if (!error.empty() || line.help) return error;
  std::vector<std::string>& words = line.project.inputs;
  if (line.command == Command::List && line.list.signature.empty() && !words.empty()) {
    line.list.what = words.front();
    words.erase(words.begin());
  }
  line.project.code.verify = isVerified();
  return checkCombination(line);
}

std::string helpText(Command command) {
  std::string out;
  if (command == Command::None || command == Command::Help) {
    out = "rung: a compiler for the languages of IEC 61131-3\n\nusage: rung COMMAND [options] [FILE|DIR ...]\n\n";
    for (const CommandRow& row : commandRows()) appendRow(out, row.name, row.summary);
    out +=
        "\n`rung COMMAND --help` lists the options of a command. Inputs are files or\n"
        "folders, by default the project around the current folder; `@file` reads\n"
        "arguments from a file. Diagnostics go to stderr.\n\n"
        "exit codes: 0 success, 1 the input has errors, 2 usage or I/O error, 3 the\n"
        "program faulted, 4 a test failed, 70 internal error\n";
    return out;
  }
  for (const CommandRow& row : commandRows())
    if (row.command == command)
      out = std::string("rung ") + row.name + ": " + row.summary + "\n\nusage: rung " + row.name;
  std::string options;
  for (const OptionRow& row : optionRows())
    if (row.help != nullptr && (row.commands & bit(command))) appendRow(options, synopsis(row), row.help);
  if (!options.empty()) out += " [options]";
  for (const CommandRow& row : commandRows())
    if (row.command == command && row.arguments[0] != '\0') out += std::string(" ") + row.arguments;
  out += '\n';
  if (!options.empty()) out += "\noptions:\n" + options;
  if (command == Command::New) out += "\ntemplates:\n" + templateHelp();
  return out;
}

}  // namespace rung::tool

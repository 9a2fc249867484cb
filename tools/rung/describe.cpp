// SPDX-License-Identifier: Apache-2.0
// Prints the man page of rung, or its completions for a shell, from the table of options.
//   rung_describe man|bash|zsh|fish
// Called by the build (CMakeLists.txt).
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "tools/driver/installation.h"
#include "tools/rung/options.h"

namespace {

using rung::tool::CommandDescription;
using rung::tool::OptionDescription;

// Its values, where the name of the value lists them: `text|json|sarif`.
std::vector<std::string> valuesOf(const OptionDescription& option) {
  std::vector<std::string> values;
  if (option.value.find('|') == std::string_view::npos) return values;
  for (std::string_view rest = option.value; !rest.empty();) {
    const size_t end = std::min(rest.find('|'), rest.size());
    values.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return values;
}

bool isPath(std::string_view value) {
  return value.starts_with("FILE") || value.starts_with("DIR") || value.starts_with("PATH") || value.starts_with("LIB");
}

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string out(text);
  for (size_t at = out.find(from); at != std::string::npos; at = out.find(from, at + to.size()))
    out.replace(at, from.size(), to);
  return out;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : std::string(separator)) + word;
  return out;
}

// Of troff: a minus instead of a hyphen, no control character at a line's start, bold for what is in backquotes.
std::string troff(std::string_view text) {
  std::string out;
  bool bold = false;
  for (const char c : text) {
    if (c == '`') {
      out += bold ? "\\fR" : "\\fB";
      bold = !bold;
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\\') {
      out += "\\e";
    } else {
      out += c == '\n' ? ' ' : c;
    }
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string manPage(const std::vector<CommandDescription>& commands) {
  std::string out = ".TH RUNG 1 \"\" \"rung " + std::string(rung::driver::version()) + "\" \"User Commands\"\n" +
                    ".SH NAME\nrung \\- compiler for the languages of IEC 61131\\-3\n.SH SYNOPSIS\n.B rung\n"
                    ".I COMMAND\n[options] [FILE|DIR ...]\n.SH DESCRIPTION\n" +
                    troff(
                        "Rung checks, runs, tests, draws and formats programs in ST, IL, LD, FBD, CFC, SFC, C++ and "
                        "the NCT machine-tool ladder, and compiles them to C++. Inputs are files or folders, by "
                        "default the project around the current folder. `rung COMMAND --help` shows one command; "
                        "`rung explain CODE` shows the page of a diagnostic.") +
                    "\n.SH COMMANDS\n";
  for (const CommandDescription& command : commands) {
    out +=
        ".SS rung " + std::string(command.name) + " " + troff(command.arguments) + "\n" + troff(command.summary) + "\n";
    for (const OptionDescription& option : command.options)
      out += ".TP\n.BR " + troff(option.name) + (option.value.empty() ? "" : " \" " + troff(option.value) + "\"") +
             "\n" + troff(option.help) + "\n";
  }
  return out +
         ".SH EXIT STATUS\n0 success, 1 the input has errors, 2 usage or I/O error, 3 the program faulted, 4 a test "
         "failed, 70 internal error\n"
         ".SH ENVIRONMENT\n.TP\n.B RUNG_HOME\nfolder with lib/ and share/rung/ of the runtime\n.TP\n.B CXX\nthe C++ "
         "compiler\n";
}

std::string bash(const std::vector<CommandDescription>& commands) {
  std::string names;
  for (const CommandDescription& command : commands) names += (names.empty() ? "" : " ") + std::string(command.name);
  std::string out =
      "# Completion of rung for bash; made from its table of options.\n"
      "_rung() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} options=\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '" +
      names +
      " help' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  if [ \"$word\" = = ]; then word=; fi\n"
      "  if [ \"$before\" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
      "  case $command:$before in\n";
  for (const CommandDescription& command : commands)
    for (const OptionDescription& option : command.options)
      if (const std::vector<std::string> values = valuesOf(option); !values.empty())
        out += "    " + std::string(command.name) + ":" + std::string(option.name) + ") COMPREPLY=($(compgen -W '" +
               joined(values, " ") + "' -- \"$word\")); return ;;\n";
  out += "  esac\n  case $command in\n";
  for (const CommandDescription& command : commands) {
    std::vector<std::string> options;
    for (const OptionDescription& option : command.options) options.emplace_back(option.name);
    out += "    " + std::string(command.name) + ") options='" + joined(options, " ") + "' ;;\n";
  }
  return out +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "    compopt -o filenames 2>/dev/null\n"
         "  fi\n"
         "}\n"
         "complete -F _rung rung\n";
}

std::string zsh(const std::vector<CommandDescription>& commands) {
  const auto quoted = [](std::string_view text) {
    std::string out = replaced(replaced(replaced(text, "\n", " "), "'", "'\\''"), ":", "\\:");
    return replaced(replaced(out, "[", "\\["), "]", "\\]");
  };
  std::string out =
      "#compdef rung\n# Completion of rung for zsh; made from its table of options.\nlocal -a commands\ncommands=(\n";
  for (const CommandDescription& command : commands)
    out += "  '" + std::string(command.name) + ":" + quoted(command.summary) + "'\n";
  out +=
      ")\nif (( CURRENT == 2 )); then\n  _describe command commands\n  return\nfi\nlocal command=$words[2]\n"
      "shift words\n(( CURRENT-- ))\ncase $command in\n";
  for (const CommandDescription& command : commands) {
    out += "  " + std::string(command.name) + ")\n    _arguments";
    for (const OptionDescription& option : command.options) {
      const std::vector<std::string> values = valuesOf(option);
      const std::string action = !values.empty()        ? "(" + joined(values, " ") + ")"
                                 : isPath(option.value) ? "_files"
                                                        : "";
      const std::string spelled =
          std::string(option.name) + (option.name.starts_with("--") && !option.value.empty() ? "="
                                      : option.value.empty()                                 ? ""
                                                                                             : "+");
      out += " \\\n      '*" + spelled + "[" + quoted(option.help) + "]" +
             (option.value.empty() ? "" : ":" + quoted(replaced(option.value, "|", " ")) + ":" + action) + "'";
    }
    out += " \\\n      '*:file:_files' ;;\n";
  }
  return out + "esac\n";
}

std::string fish(const std::vector<CommandDescription>& commands) {
  const auto quoted = [](std::string_view text) {
    return "'" + replaced(replaced(replaced(text, "\n", " "), "\\", "\\\\"), "'", "\\'") + "'";
  };
  std::string out = "# Completion of rung for fish; made from its table of options.\n";
  for (const CommandDescription& command : commands)
    out += "complete -c rung -n __fish_use_subcommand -f -a " + std::string(command.name) + " -d " +
           quoted(command.summary) + "\n";
  for (const CommandDescription& command : commands)
    for (const OptionDescription& option : command.options) {
      out += "complete -c rung -n '__fish_seen_subcommand_from " + std::string(command.name) + "' ";
      out += option.name.starts_with("--") ? "-l " + std::string(option.name.substr(2))
                                           : "-s " + std::string(option.name.substr(1));
      if (const std::vector<std::string> values = valuesOf(option); !values.empty())
        out += " -x -a " + quoted(joined(values, " "));
      else if (!option.value.empty())
        out += isPath(option.value) ? " -r" : " -x";
      out += " -d " + quoted(option.help) + "\n";
    }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string form = argc == 2 ? argv[1] : "";
  const std::vector<CommandDescription> commands = rung::tool::describeCommands();
  std::string text;
  if (form == "man") {
    text = manPage(commands);
  } else if (form == "bash") {
    text = bash(commands);
  } else if (form == "zsh") {
    text = zsh(commands);
  } else if (form == "fish") {
    text = fish(commands);
  } else {
    std::fprintf(stderr, "usage: rung_describe man|bash|zsh|fish\n");
    return 2;
  }
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? 0 : 2;
}

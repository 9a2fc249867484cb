// SPDX-License-Identifier: Apache-2.0
// Commands to a running program: see commands.h.
#include "commands.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>

#include "inputs.h"
#include "symbols.h"

namespace rung::host {
namespace {

constexpr size_t kLongestLine = 4096;  // by a pipe, and what is read from it at once

enum class Operand : uint8_t { None, Word, Paths, Values, Project };
const struct {
  const char* name;
  Command::Kind kind;
  Operand operand;
} kCommands[] = {{"stop", Command::Stop, Operand::None},     {"start", Command::Start, Operand::None},
                 {"cycle", Command::Cycle, Operand::None},   {"reset", Command::Reset, Operand::Word},
                 {"event", Command::Event, Operand::Word},   {"status", Command::Status, Operand::None},
                 {"quit", Command::Quit, Operand::None},     {"change", Command::Change, Operand::Project},
                 {"get", Command::Get, Operand::Paths},      {"set", Command::Set, Operand::Values},
                 {"force", Command::Force, Operand::Values}, {"unforce", Command::Unforce, Operand::Paths},
                 {"forces", Command::Forces, Operand::None}};

// The line up to a comment, which begins with `#` at its begin or after a blank, but not in a string.
std::string_view withoutComment(std::string_view line) {
  char quote = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0 && c == '$')
      ++i;
    else if (quote != 0)
      quote = c == quote ? char{0} : quote;
    else if (c == '\'' || c == '"')
      quote = c;
    else if (c == '#' && (i == 0 || isBlank(line[i - 1])))
      return line.substr(0, i);
  }
  return line;
}

// Takes the first word.
std::string_view takeWord(std::string_view& text) {
  size_t length = 0;
  while (length < text.size() && !isBlank(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text = trimmed(text.substr(length));
  return word;
}

// `PATH`, or `PATH=VALUE`.
std::string readValue(std::string_view item, bool has_text, Command::Value& value) {
  const size_t equals = has_text ? item.find('=') : item.size();
  value.path = trimmed(item.substr(0, equals));
  if (equals == std::string_view::npos || value.path.empty())
    return "expected PATH=VALUE, not `" + std::string(item) + "`";
  if (has_text) value.text = trimmed(item.substr(equals + 1));
  return "";
}

std::string readStart(std::string_view word, rung_start& start) {
  const std::string name = lowerCase(word);
  if (name != "warm" && name != "cold" && name != "origin") return "reset needs warm, cold or origin";
  start = name == "warm" ? RUNG_WARM : name == "cold" ? RUNG_COLD : RUNG_ORIGIN;
  return "";
}

// `[dry-run] [rollback=N] [PROJECT]`
std::string readChange(std::string_view rest, Command& command) {
  constexpr std::string_view kRollback = "rollback=";
  constexpr int64_t kMostCycles = 1'000'000'000;
  while (!rest.empty()) {
    std::string_view after = rest;
    const std::string_view word = takeWord(after);
    const bool is_rollback = word.substr(0, kRollback.size()) == kRollback;
    if (word != "dry-run" && !is_rollback) break;
    rest = after;
    if (!is_rollback) {
      command.is_only_asked = true;
      continue;
    }
    const std::string_view number = word.substr(kRollback.size());
    const std::from_chars_result read =
        std::from_chars(number.data(), number.data() + number.size(), command.rollback_cycles);
    if (read.ec != std::errc{} || read.ptr != number.data() + number.size() || command.rollback_cycles < 0 ||
        command.rollback_cycles > kMostCycles)
      return "`rollback=` needs a number of cycles";
  }
  command.project = rest;
  return "";
}

// What is after the name of a command: empty, or what is wrong.
std::string readOperand(std::string_view name, Operand operand, std::string_view rest, Command& command) {
  const std::string quoted = "`" + std::string(name) + "`";
  if (operand == Operand::Project) return readChange(rest, command);
  if (operand == Operand::None) return rest.empty() ? "" : quoted + " has nothing after it";
  if (operand == Operand::Word) {
    const std::string_view word = takeWord(rest);
    if (word.empty() || !rest.empty()) return quoted + " needs one word after it";
    if (command.kind == Command::Reset) return readStart(word, command.start);
    command.event = word;
    return "";
  }
  const bool has_text = operand == Operand::Values;
  for (const std::string& item : splitList(rest))
    if (std::string what = readValue(item, has_text, command.values.emplace_back()); !what.empty()) return what;
  if (command.values.empty()) return quoted + (has_text ? " needs PATH=VALUE after it" : " needs a path after it");
  return "";
}

}  // namespace

std::string parseCommand(std::string_view text, Command& command) {
  const std::string_view name = takeWord(text);
  for (const auto& row : kCommands) {
    if (lowerCase(name) != row.name) continue;
    command.kind = row.kind;
    return readOperand(name, row.operand, text, command);
  }
  std::string names;
  for (const auto& row : kCommands)
    names += std::string(&row == kCommands ? "" : &row + 1 == std::end(kCommands) ? " or " : ", ") + row.name;
  return "`" + std::string(name) + "` is not a command; write " + names;
}

Commands::~Commands() {
  if (pipe_ >= 0) close(pipe_);
}

bool Commands::take(std::string_view line, bool realtime, std::string& error) {
  ++line_;
  std::string_view text = trimmed(withoutComment(line));
  if (text.empty()) return true;
  Command command;
  command.location = path_ + ":" + std::to_string(line_);
  std::string_view rest = text;
  const std::string_view first = takeWord(rest);
  const std::from_chars_result read = std::from_chars(first.data(), first.data() + first.size(), command.cycle);
  std::string what;
  if (read.ec == std::errc{} && read.ptr == first.data() + first.size() && command.cycle >= 0) {
    text = rest;
  } else {
    command.cycle = -1;
    if (!realtime) what = "expected the number of a cycle before the command";
  }
  if (what.empty() && text.empty()) what = "expected a command after the number of the cycle";
  if (what.empty() && !pending_.empty() && command.cycle >= 0 && command.cycle < pending_.back().cycle)
    what = "the cycles are not in ascending order";
  if (what.empty()) what = parseCommand(text, command);
  if (!what.empty()) return error = command.location + ": " + what, false;
  pending_.push_back(std::move(command));
  return true;
}

bool Commands::open(const std::string& path, bool realtime, std::string& error) {
  path_ = path;
  struct stat status;
  if (realtime && stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode)) {
    pipe_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);  // open for writing too: it never ends
    if (pipe_ < 0) return error = path + ": " + strerror(errno), false;
    return true;
  }
  std::string content;
  if (!readFile(path, content, error)) return false;
  std::istringstream in(content);
  for (std::string line; std::getline(in, line);)
    if (!take(line, realtime, error)) return false;
  return true;
}

void Commands::receive(std::string& error) {
  char buffer[kLongestLine];
  if (received_.size() < sizeof buffer)
    if (const ssize_t n = read(pipe_, buffer, sizeof buffer); n > 0) received_.append(buffer, static_cast<size_t>(n));
  if (received_.size() >= sizeof buffer && received_.find('\n') == std::string::npos) {
    error = path_ + ":" + std::to_string(line_ + 1) + ": the line has more than " + std::to_string(sizeof buffer) +
            " characters";
    received_.clear();
  }
  for (size_t end; error.empty() && (end = received_.find('\n')) != std::string::npos;) {
    const std::string line = received_.substr(0, end);
    received_.erase(0, end + 1);
    take(line, true, error);
  }
}

bool Commands::next(int64_t cycle, Command& command, std::string& error) {
  if (pipe_ >= 0 && pending_.empty()) receive(error);
  if (pending_.empty() || pending_.front().cycle > cycle) return false;
  command = std::move(pending_.front());
  pending_.pop_front();
  return true;
}

}  // namespace rung::host

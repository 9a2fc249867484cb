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

// Empty, or why the words are not a command.
std::string parse(const std::vector<std::string>& words, Command& command) {
  static const struct {
    const char* name;
    Command::Kind kind;
  } kCommands[] = {{"stop", Command::Stop},   {"start", Command::Start}, {"cycle", Command::Cycle},
                   {"reset", Command::Reset}, {"event", Command::Event}, {"status", Command::Status},
                   {"quit", Command::Quit}};
  bool known = false;
  for (const auto& row : kCommands) {
    if (lowerCase(words[0]) != row.name) continue;
    command.kind = row.kind;
    known = true;
  }
  if (!known) return "`" + words[0] + "` is not a command; write stop, start, cycle, reset, event, status or quit";
  const bool has_operand = command.kind == Command::Reset || command.kind == Command::Event;
  if (words.size() != (has_operand ? 2u : 1u))
    return has_operand ? "`" + words[0] + "` needs one word after it" : "`" + words[0] + "` has nothing after it";
  if (command.kind == Command::Event) command.event = words[1];
  if (command.kind != Command::Reset) return "";
  const std::string start = lowerCase(words[1]);
  if (start != "warm" && start != "cold" && start != "origin") return "reset needs warm, cold or origin";
  command.start = start == "warm" ? RUNG_WARM : start == "cold" ? RUNG_COLD : RUNG_ORIGIN;
  return "";
}

}  // namespace

Commands::~Commands() {
  if (pipe_ >= 0) close(pipe_);
}

bool Commands::take(std::string line, bool realtime, std::string& error) {
  ++line_;
  std::istringstream in(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.empty()) return true;
  Command command;
  const std::string& first = words[0];
  const std::from_chars_result read = std::from_chars(first.data(), first.data() + first.size(), command.cycle);
  std::string what;
  if (read.ec == std::errc{} && read.ptr == first.data() + first.size() && command.cycle >= 0) {
    words.erase(words.begin());
  } else {
    command.cycle = -1;
    if (!realtime) what = "expected the number of a cycle before the command";
  }
  if (what.empty() && words.empty()) what = "expected a command after the number of the cycle";
  if (what.empty() && !pending_.empty() && command.cycle >= 0 && command.cycle < pending_.back().cycle)
    what = "the cycles are not in ascending order";
  if (what.empty()) what = parse(words, command);
  if (!what.empty()) {
    error = path_ + ":" + std::to_string(line_) + ": " + what;
    return false;
  }
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

// SPDX-License-Identifier: Apache-2.0
// A user asks this of a running program (--control): `stop`, `start`, `cycle`, `reset warm|cold|origin`, `event NAME`,
// `status`, `quit`, `change [dry-run] [rollback=N] [PROJECT]`, `get PATH,…`, `set PATH=VALUE,…`, `force PATH=VALUE,…`,
// `unforce PATH,…|*`, `forces`, a line each. In virtual time each line begins with the cycle before which it counts; in
// real time it may. In: a file, or in real time a pipe that stays open. Out: commands in their order. Called by
// run.cpp; obeyed by session.cpp.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "rung/module.h"

namespace rung::host {

struct Command {
  enum Kind : uint8_t {
    Stop,
    Start,
    Cycle,
    Reset,
    Event,
    Status,
    Quit,
    Change,
    Get,
    Set,
    Force,
    Unforce,
    Forces
  } kind = Stop;
  struct Value {
    std::string path, text;  // of Get and Unforce without a text
  };
  int64_t cycle = -1;  // -1: at once
  rung_start start = RUNG_WARM;
  std::string event;
  std::string project;  // of Change; empty: the one that runs
  bool is_only_asked = false;
  int64_t rollback_cycles = -1;  // -1: as --rollback says
  std::vector<Value> values;
  std::string location;  // `file:line`, for messages

  bool isAboutValues() const { return kind >= Get; }
};

// Reads a command without a cycle. Empty, or why the text is not one.
std::string parseCommand(std::string_view text, Command& command);

class Commands {
 public:
  ~Commands();
  Commands() = default;
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  // Reads a file whole; in real time opens a pipe. False: `error` has file, line and what is wrong.
  bool open(const std::string& path, bool realtime, std::string& error);
  // The next command that counts before this cycle; false: none. `error` is set for a line that came by a pipe and is
  // none.
  bool next(int64_t cycle, Command& command, std::string& error);

 private:
  bool take(std::string_view line, bool realtime, std::string& error);
  void receive(std::string& error);

  std::string path_;
  int pipe_ = -1;
  uint32_t line_ = 0;
  std::string received_;
  std::deque<Command> pending_;
};

}  // namespace rung::host

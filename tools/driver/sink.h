// SPDX-License-Identifier: Apache-2.0
// Where the commands of the driver write: the driver itself knows no terminal. In: messages, results and diagnostics of
// one command. Implemented by the command line (tools/rung/console.h), by servers and by tests.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "frontend/source/render.h"

namespace rung::driver {

class Sink {
 public:
  virtual ~Sink() = default;

  // Text for people, with its line breaks: diagnostics, notes, times.
  virtual void message(std::string_view text) = 0;
  // Takes the result of the command: IR, a list, a page. Returns an error message, or an empty string.
  [[nodiscard]] virtual std::string output(std::string_view text) = 0;

  // The diagnostics of a project, sorted, when its command is done. Unless overridden, they become one message.
  virtual void diagnostics(const Diagnostics& all, const Sources& sources, const RenderOptions& options);
  // Options that contradict each other, and files that cannot be written.
  virtual void error(std::string_view what);
  // A bug of Rung, not of the program.
  virtual void internalError(std::string_view what);
  // `done` of `all` steps, such as starts of the C++ compiler; the last call has `done == all`.
  virtual void progress(const char* label, size_t done, size_t all);
  // While code of the user's program runs, a crash is the program's; `checked`: all accesses are checked.
  virtual void programRuns(bool runs, bool checked);

  // For the output of programs and tests that run.
  virtual std::FILE* programOutput() { return stdout; }
  virtual std::FILE* programErrors() { return stderr; }
};

// For a file of which only the text or a picture is wanted.
class SilentSink final : public Sink {
 public:
  void message(std::string_view) override {}
  std::string output(std::string_view) override { return {}; }
};

// For what a command says while something else has the terminal.
class MessageSink final : public Sink {
 public:
  void message(std::string_view what) override { text += what; }
  std::string output(std::string_view) override { return {}; }
  std::string text;
};

}  // namespace rung::driver

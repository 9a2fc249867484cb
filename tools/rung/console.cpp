// SPDX-License-Identifier: Apache-2.0
#include "tools/rung/console.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tools/rung/crash.h"

namespace rung::tool {

void Console::message(std::string_view text) {
  fflush(stdout);  // in the order of the command
  fwrite(text.data(), 1, text.size(), stderr);
}

std::string Console::output(std::string_view text) {
  if (fwrite(text.data(), 1, text.size(), stdout) == text.size() && fflush(stdout) == 0) return {};
  return std::string("cannot write to stdout: ") + strerror(errno);
}

void Console::internalError(std::string_view what) { printInternalError(std::string(what).c_str()); }

// A counter, from the second second on.
void Console::progress(const char* label, size_t done, size_t all) {
  if (isatty(2) == 0) return;
  const auto now = std::chrono::steady_clock::now();
  if (label_ != label) begin_ = now;
  label_ = done == all ? nullptr : label;
  if (done == all) {
    if (shown_) fputs("\r\x1b[K", stderr);
    shown_ = false;
  } else if (now - begin_ >= std::chrono::seconds(1)) {
    fprintf(stderr, "\r[%zu/%zu] %s\x1b[K", done, all, label);
    fflush(stderr);
    shown_ = true;
  }
}

void Console::programRuns(bool runs, bool checked) { setProgramRuns(runs, checked); }

bool useColor(Color choice, int descriptor) {
  if (choice != Color::Auto) return choice == Color::Always;
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (no_color != nullptr && no_color[0] != '\0') return false;
  return isatty(descriptor) != 0 && terminal != nullptr && strcmp(terminal, "dumb") != 0;
}

}  // namespace rung::tool

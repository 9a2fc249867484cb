// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/process_copy.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>

namespace rung::workspace {
namespace {

constexpr std::chrono::seconds kLongest{60};

void writeAll(int to, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t written = write(to, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    done += static_cast<size_t>(written);
  }
}

// The copy: says nothing to the user, and ends without what an end of the process does.
[[noreturn]] void runCopy(int to, FunctionRef<std::string()> work) {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, standard);
  writeAll(to, "+" + work());
  _exit(0);
}

// False: it took too long.
bool readAll(int from, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + kLongest;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ready{from, POLLIN, 0};
    const int found = left <= 0 ? 0 : poll(&ready, 1, static_cast<int>(left));
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    char buffer[4096];
    const ssize_t size = read(from, buffer, sizeof buffer);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return size == 0;
    text.append(buffer, static_cast<size_t>(size));
  }
}

}  // namespace

std::optional<std::string> inProcessCopy(FunctionRef<std::string()> work) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t copy = fork();
  if (copy == 0) {
    close(ends[0]);
    runCopy(ends[1], work);
  }
  close(ends[1]);
  std::string text;
  const bool is_whole = copy > 0 && readAll(ends[0], text);
  close(ends[0]);
  if (copy < 0) return std::nullopt;
  if (!is_whole) kill(copy, SIGKILL);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) continue;
  if (!is_whole || status != 0 || !text.starts_with('+')) return std::nullopt;
  return text.substr(1);
}

}  // namespace rung::workspace

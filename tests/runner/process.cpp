// SPDX-License-Identifier: Apache-2.0
// Child processes of the tests: see process.h.
#include "tests/runner/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>

namespace rung::tests {
namespace {

constexpr size_t kMaxOutput = size_t{16} << 20;  // a test that prints more than this is broken

// Reads both pipes until they close or time runs out; false: out of time.
bool drain(int out, int err, int seconds, Output& output) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  pollfd fds[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
  std::string* texts[2] = {&output.out, &output.err};
  while (fds[0].fd >= 0 || fds[1].fd >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    if (poll(fds, 2, static_cast<int>(left.count())) < 0 && errno != EINTR) return false;
    for (int i = 0; i < 2; ++i) {
      if (fds[i].fd < 0 || fds[i].revents == 0) continue;
      char buffer[16384];
      const ssize_t n = read(fds[i].fd, buffer, sizeof buffer);
      if (n > 0) {
        if (texts[i]->size() < kMaxOutput) texts[i]->append(buffer, static_cast<size_t>(n));
      } else if (n == 0 || errno != EINTR) {
        fds[i].fd = -1;
      }
    }
  }
  return true;
}

}  // namespace

Output run(const Command& command) {
  Output output;
  std::vector<char*> arguments;
  for (const std::string& word : command.arguments) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0) return output;
  if (pipe2(err, O_CLOEXEC) != 0) {
    close(out[0]);
    close(out[1]);
    return output;
  }

  const pid_t child = fork();
  if (child == 0) {  // only calls that are safe after a fork of a program with threads
    setpgid(0, 0);
    for (const int by_default : {SIGINT, SIGQUIT})
      signal(by_default, SIG_DFL);  // a shell in the background ignores them
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);  // the child must not inherit signals that a thread of ours blocks
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, 0);
    dup2(out[1], 1);
    dup2(command.merged ? out[1] : err[1], 2);
    if (!command.folder.empty() && chdir(command.folder.c_str()) != 0) _exit(126);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  if (child > 0) {
    const int seconds = command.seconds * (kSanitized ? 10 : 1);
    const bool in_time = drain(out[0], err[0], seconds, output);
    if (!in_time) kill(-child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    output.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (!in_time) {
      output.exit_code = 124;
      output.err += "killed after " + std::to_string(seconds) + " s\n";
    }
  }
  close(out[0]);
  close(err[0]);
  return output;
}

std::string commandLine(const Command& command) {
  std::string text;
  for (const std::string& word : command.arguments) {
    const bool plain = !word.empty() && word.find_first_of(" \t\n'\"$\\*?[](){}<>|&;#~`!") == std::string::npos;
    if (!text.empty()) text += ' ';
    if (plain) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return command.folder.empty() ? text : "(cd " + command.folder + " && " + text + ")";
}

}  // namespace rung::tests

// SPDX-License-Identifier: Apache-2.0
// Child processes; see process.h.
#include "tools/driver/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

extern char** environ;

namespace rung::driver {
namespace {

constexpr std::chrono::milliseconds kPoll(2);

pid_t start(const Process& process) {
  std::vector<char*> argv;
  for (const std::string& argument : process.arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, process.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  if (!process.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, process.folder.c_str());
  pid_t pid = -1;
  if (posix_spawnp(&pid, argv[0], &actions, nullptr, argv.data(), environ) != 0) pid = -1;
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

}  // namespace

const Process* runAll(std::vector<Process>& processes, unsigned jobs, const char* label, Sink& sink) {
  std::vector<std::pair<pid_t, size_t>> running;
  const Process* failed = nullptr;
  size_t next = 0, done = 0;
  while (!running.empty() || (next < processes.size() && failed == nullptr)) {
    while (failed == nullptr && next < processes.size() && running.size() < jobs) {
      pid_t pid = start(processes[next]);
      if (pid < 0) {
        processes[next].exit_code = 127;
        failed = &processes[next];
      } else {
        running.emplace_back(pid, next);
      }
      next++;
    }
    const size_t before = running.size();
    std::erase_if(running, [&](const std::pair<pid_t, size_t>& one) {
      int status = 0;
      const pid_t ended = waitpid(one.first, &status, WNOHANG);  // other threads have children of their own
      if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
      Process& process = processes[one.second];
      process.exit_code = ended < 0 ? 127 : WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      if (process.exit_code != 0 && failed == nullptr) failed = &process;
      return true;
    });
    done += before - running.size();
    if (!running.empty() && running.size() == before) {
      sink.progress(label, done, processes.size());
      std::this_thread::sleep_for(kPoll);
    }
  }
  sink.progress(label, processes.size(), processes.size());
  return failed;
}

unsigned processorCount() {
  long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count < 1 ? 1 : static_cast<unsigned>(count);
}

}  // namespace rung::driver

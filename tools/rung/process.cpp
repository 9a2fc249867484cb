// Child processes; see process.h.
#include "tools/rung/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <thread>

extern char** environ;

namespace rung::tool {
namespace {

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

// A counter on stderr when that is a terminal.
class Progress {
 public:
  Progress(const char* label, size_t all)
      : label_(label), all_(all), begin_(std::chrono::steady_clock::now()), terminal_(isatty(2) != 0) {}
  ~Progress() {
    if (shown_) fputs("\r\x1b[K", stderr);
  }
  void show(size_t done) {
    if (!terminal_ || std::chrono::steady_clock::now() - begin_ < std::chrono::seconds(1)) return;
    fprintf(stderr, "\r[%zu/%zu] %s\x1b[K", done, all_, label_);
    fflush(stderr);
    shown_ = true;
  }

 private:
  const char* label_;
  size_t all_;
  std::chrono::steady_clock::time_point begin_;
  bool terminal_, shown_ = false;
};

}  // namespace

const Process* runAll(std::vector<Process>& processes, unsigned jobs, const char* label) {
  std::vector<std::pair<pid_t, size_t>> running;
  const Process* failed = nullptr;
  size_t next = 0, done = 0;
  Progress progress(label, processes.size());
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
    if (running.empty()) break;
    int status = 0;
    pid_t pid = 0;
    // With a terminal the wait is split, so the counter appears while the first compiler still works.
    if (isatty(2)) {
      pid = waitpid(-1, &status, WNOHANG);
      if (pid == 0) {
        progress.show(done);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
    } else {
      pid = waitpid(-1, &status, 0);
    }
    if (pid < 0 && errno == EINTR) continue;
    if (pid < 0) break;
    for (size_t i = 0; i < running.size(); i++) {
      if (running[i].first != pid) continue;
      Process& process = processes[running[i].second];
      process.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      if (process.exit_code != 0 && failed == nullptr) failed = &process;
      running.erase(running.begin() + static_cast<ptrdiff_t>(i));
      done++;
      break;
    }
  }
  return failed;
}

unsigned processorCount() {
  long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count < 1 ? 1 : static_cast<unsigned>(count);
}

}  // namespace rung::tool

// SPDX-License-Identifier: Apache-2.0
// The processes of tests: see test_process.h. Messages on the pipe: length, kind, then numbers and strings, each with
// its length.
#include "test_process.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>

#include "clock.h"
#include "crashes.h"

namespace rung::host {
namespace {

constexpr int kEndSignals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr int64_t kGraceNs = 3'000'000'000;  // for code that a signal does not stop
constexpr double kLongSeconds = 3;           // tests that a faster engine would shorten

volatile sig_atomic_t end_signals = 0;
void onEndSignal(int) { end_signals = end_signals + 1; }

// ---- messages

enum class Kind : uint8_t { Begin, Result, End };

class Writer {
 public:
  explicit Writer(Kind kind) { number(static_cast<uint64_t>(kind)); }
  void number(uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void real(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    number(bits);
  }
  void text(std::string_view value) {
    number(value.size());
    bytes_ += value;
  }
  void send(int fd) const {
    const uint64_t size = bytes_.size();
    sendAll(fd, reinterpret_cast<const char*>(&size), sizeof size);
    sendAll(fd, bytes_.data(), bytes_.size());
  }

 private:
  static void sendAll(int fd, const char* at, size_t size) {
    while (size > 0) {
      const ssize_t written = write(fd, at, size);
      if (written < 0 && errno != EINTR) _exit(2);  // the parent is gone
      if (written <= 0) continue;
      at += written;
      size -= static_cast<size_t>(written);
    }
  }
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  uint64_t number() {
    uint64_t value = 0;
    if (bytes_.size() < sizeof value) return 0;
    memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  double real() {
    const uint64_t bits = number();
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string text() {
    const size_t size = static_cast<size_t>(number());
    std::string value(bytes_.substr(0, size));
    bytes_.remove_prefix(value.size());
    return value;
  }

 private:
  std::string_view bytes_;
};

void sendResult(int fd, const TestResult& result) {
  Writer message(Kind::Result);
  message.number(result.line);
  message.number(result.kind);
  message.number(result.assertions);
  message.real(result.seconds);
  message.text(result.name);
  message.text(result.file);
  message.text(result.shown_file);
  message.text(result.messages);
  message.send(fd);
}

TestResult readResult(Reader& message) {
  TestResult result;
  result.line = static_cast<uint32_t>(message.number());
  result.kind = static_cast<TestResult::Kind>(message.number());
  result.assertions = message.number();
  result.seconds = message.real();
  result.name = message.text();
  result.file = message.text();
  result.shown_file = message.text();
  result.messages = message.text();
  return result;
}

const char* signalText(int number) {
  switch (number) {
    case SIGSEGV: return "SIGSEGV (access to unmapped memory)";
    case SIGBUS: return "SIGBUS (access beyond the end of a mapped file)";
    case SIGFPE: return "SIGFPE (arithmetic, such as an integer division by zero)";
    case SIGILL: return "SIGILL (illegal instruction)";
    case SIGABRT: return "SIGABRT (abort, such as an uncaught exception)";
    case SIGKILL: return "SIGKILL (killed from outside, perhaps for lack of memory)";
    case SIGTERM: return "SIGTERM";
    default: return "a signal";
  }
}

// ---- the child

void (*crashed)(const char* signal) = nullptr;
void onCrash(int number) {
  signal(number, SIG_DFL);
  crashed(signalText(number));
  raise(number);
}

[[noreturn]] void runChild(const std::vector<uint32_t>& tests, size_t next, const TestOptions& options,
                           const TestProcess& process, int fd, char* where) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);  // only the parent gets what the terminal sends
  crashed = process.crashed;
  for (const int number : {SIGFPE, SIGILL, SIGABRT}) signal(number, onCrash);
  for (const int number : {SIGTERM, SIGHUP}) signal(number, SIG_DFL);
  signal(SIGINT, [](int) {});  // between two tests: the parent knows
  catchCrashes();
  for (; next < tests.size(); ++next) {
    Writer(Kind::Begin).send(fd);
    sendResult(fd, process.run(tests[next], where));
    if (process.interrupted()) _exit(0);
  }
  Writer end(Kind::End);
  end.text(options.collect ? options.collect() : "");
  end.send(fd);
  _exit(0);
}

// ---- the parent

class Parent {
 public:
  Parent(const std::vector<uint32_t>& tests, const TestOptions& options, const TestProcess& process,
         TestResults& results, char* where)
      : tests_(tests), options_(options), process_(process), results_(results), where_(where) {}

  std::string run() {
    while (next_ < tests_.size() && !results_.interrupted) {
      if (const std::string error = start(); !error.empty()) return error;
      attend();
      close(fd_);
    }
    return "";
  }

 private:
  std::string start() {
    int ends[2];
    if (pipe(ends) != 0) return std::string("cannot start a process for the tests: ") + strerror(errno);
    fflush(options_.out);
    fflush(options_.err);
    where_[0] = '\0';
    child_ = fork();
    if (child_ < 0) {
      const int why = errno;
      close(ends[0]);
      close(ends[1]);
      return std::string("cannot start a process for the tests: ") + strerror(why);
    }
    if (child_ == 0) {
      close(ends[0]);
      runChild(tests_, next_, options_, process_, ends[1], where_);
    }
    close(ends[1]);
    fd_ = ends[0];
    buffer_.clear();
    running_ = ended_ = killed_ = false;
    return "";
  }

  // Until the child ends, by itself or not.
  void attend() {
    bool open = true;
    while (open) {
      hint();
      if (end_signals != forwarded_) interrupt();
      if (deadline_ns_ != 0 && monotonicNs() >= deadline_ns_ && !killed_) {
        kill(child_, SIGKILL);
        killed_ = true;
      }
      pollfd waiting{fd_, POLLIN, 0};
      const int ready = poll(&waiting, 1, 50);
      if (ready > 0) open = receive();
    }
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    if (ended_) return;
    if (running_) {
      died(status);
    } else {
      results_.interrupted = true;  // between two tests: only from outside
    }
  }

  bool receive() {
    char bytes[65536];
    const ssize_t count = read(fd_, bytes, sizeof bytes);
    if (count < 0) return errno == EINTR;
    if (count == 0) return false;
    buffer_.append(bytes, static_cast<size_t>(count));
    size_t at = 0;
    for (;;) {
      uint64_t size;
      if (buffer_.size() - at < sizeof size) break;
      memcpy(&size, buffer_.data() + at, sizeof size);
      if (buffer_.size() - at - sizeof size < size) break;
      handle(std::string_view(buffer_).substr(at + sizeof size, size));
      at += sizeof size + size;
    }
    buffer_.erase(0, at);
    return true;
  }

  void handle(std::string_view bytes) {
    Reader message(bytes);
    switch (static_cast<Kind>(message.number())) {
      case Kind::Begin:
        running_ = true;
        begin_ns_ = monotonicNs();
        deadline_ns_ = options_.timeout_ns > 0 ? begin_ns_ + options_.timeout_ns + kGraceNs : 0;
        if (forwarded_ != 0) interruptTest();
        return;
      case Kind::Result:
        running_ = false;
        deadline_ns_ = 0;
        ++next_;
        process_.report(readResult(message));
        if (forwarded_ != 0) stop();
        return;
      case Kind::End:
        ended_ = true;
        if (options_.merge) options_.merge(message.text());
        return;
    }
  }

  void died(int status) {
    TestResult result = process_.describe(tests_[next_++]);
    result.kind = TestResult::Broken;
    result.seconds = secondsHere();
    const std::string where = where_;
    if (killed_ && forwarded_ != 0) {
      result.messages = where.empty() ? "interrupted" : where;
    } else if (killed_) {
      result.messages = where.empty() ? "the time limit is reached (--timeout)" : where;
    } else if (WIFSIGNALED(status)) {
      results_.crash = signalText(WTERMSIG(status));
      result.messages = where.empty() ? "crash: " + results_.crash : where;
    } else {
      result.messages = "the process of the test ended with exit code " + std::to_string(WEXITSTATUS(status));
    }
    if (where.empty())
      result.messages =
          result.shown_file + ':' + std::to_string(result.line) + ": " + result.messages + " in `" + result.name + '`';
    result.messages += '\n';
    process_.report(std::move(result));
    if (forwarded_ != 0) results_.interrupted = true;
  }

  void interrupt() {
    const bool again = forwarded_ != 0;
    forwarded_ = end_signals;
    if (!running_) return stop();
    interruptTest();
    if (again) {
      kill(child_, SIGKILL);
      killed_ = true;
    }
  }
  void interruptTest() {
    kill(child_, SIGINT);
    deadline_ns_ = monotonicNs() + kGraceNs;
  }
  void stop() {
    results_.interrupted = true;
    kill(child_, SIGKILL);
    killed_ = ended_ = true;
  }

  double secondsHere() const { return static_cast<double>(monotonicNs() - begin_ns_) / 1e9; }

  void hint() {
    if (results_.hinted || !running_ || options_.hint_when_long.empty() || isatty(2) == 0) return;
    results_.hinted = results_.seconds + secondsHere() >= kLongSeconds;
    if (results_.hinted) fprintf(options_.err, "%s\n", options_.hint_when_long.c_str());
  }

  const std::vector<uint32_t>& tests_;
  const TestOptions& options_;
  const TestProcess& process_;
  TestResults& results_;
  char* where_;
  size_t next_ = 0;
  pid_t child_ = -1;
  int fd_ = -1;
  std::string buffer_;
  bool running_ = false, ended_ = false, killed_ = false;
  int64_t begin_ns_ = 0, deadline_ns_ = 0;  // of the test that runs
  int forwarded_ = 0;
};

}  // namespace

std::string runInChildren(const std::vector<uint32_t>& tests, const TestOptions& options, const TestProcess& process,
                          TestResults& results) {
  void* const shared = mmap(nullptr, kWhereSize, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return std::string("cannot start a process for the tests: ") + strerror(errno);
  struct sigaction before[std::size(kEndSignals)];
  for (size_t i = 0; i < std::size(kEndSignals); ++i) {
    sigaction(kEndSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = onEndSignal;
    sigaction(kEndSignals[i], &action, nullptr);
  }
  end_signals = 0;
  const std::string error = Parent(tests, options, process, results, static_cast<char*>(shared)).run();
  for (size_t i = 0; i < std::size(kEndSignals); ++i) sigaction(kEndSignals[i], &before[i], nullptr);
  munmap(shared, kWhereSize);
  return error;
}

}  // namespace rung::host

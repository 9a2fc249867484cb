// SPDX-License-Identifier: Apache-2.0
// Differential testing: generated programs must behave alike however they are run.
//   differential [--first=SEED] [--count=N] [--ways=interp|native|all|turns|one|suite] [-j N] [--rung=PATH]
//   [--folder=PATH] differential --print=SEED
// The reference is the interpreter at -O0: slow and plain. Each other way must give its exit code, its fault and its
// trace of all variables, with checks and without. `turns` compiles each batch in three of the twelve native ways,
// another three for the next; `one` in one, and interprets nothing; `suite` compiles one batch in two. A difference is
// shrunk and printed; the exit code is then 1. Seeds go in batches of 25, one dialect each: one run of the C++ compiler
// serves a batch, and the last of each, which may fault, run alone in the same module. Called by tests/runner with few
// seeds and by hand with many: SIGINT and SIGTERM print the summary so far.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>
#include <unordered_map>

#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/program.h"
#include "tests/fuzz/differential/shrink.h"
#include "tests/fuzz/generated/options.h"
#include "tests/runner/process.h"

namespace rung::differential {
namespace {

constexpr uint64_t kBatch = 25;

using generated::Options;

struct Way {
  const char* compiler;  // null: interpreted
  const char* engine;
  const char* level;
};

const Way kJudge = {nullptr, "--engine=interp", "-O0"};
const Way kInterpreted[] = {{nullptr, "--engine=interp", "-O1"}, {nullptr, "--engine=interp", "-O2"}};
const Way kQuickNative[] = {{"g++", "--engine=native", "-O0"}, {"g++", "--engine=native", "-O2"}};
const Way kNative[] = {{"g++", "--engine=native", "-O0"},     {"g++", "--engine=native", "-O1"},
                       {"g++", "--engine=native", "-O2"},     {"clang++", "--engine=native", "-O0"},
                       {"clang++", "--engine=native", "-O1"}, {"clang++", "--engine=native", "-O2"}};
constexpr uint64_t kNativeCount = sizeof kNative / sizeof kNative[0];

// Checks on request make most programs fault, so one batch in four has them instead of the default ones.
bool isRangeBatch(uint64_t seed) { return seed / kBatch % 4 == 3; }

Faults faultsOf(uint64_t seed) {
  const uint64_t position = seed % kBatch;
  if (isRangeBatch(seed)) return position < 15 ? Faults::None : Faults::Range;
  return position < 21 ? Faults::None : position % 2 == 0 ? Faults::Division : Faults::Index;
}

Dialect dialectOf(uint64_t seed) {
  const uint64_t phase = seed / kBatch % 5;
  return phase == 1 ? Dialect::Iec3 : phase == 3 ? Dialect::Iec2 : Dialect::Codesys;
}

const char* optionOf(Dialect dialect) {
  return dialect == Dialect::Codesys ? "--std=codesys" : dialect == Dialect::Iec3 ? "--std=iec3" : "--std=iec2";
}

struct Outcome {
  int exit_code = 0;
  std::string trace;
  std::string errors;  // the headings only

  bool operator==(const Outcome& other) const {
    return exit_code == other.exit_code && trace == other.trace && errors == other.errors;
  }
  bool ran() const { return exit_code == 0 || exit_code == 3; }
};

// The settings of a run, besides the source.
struct Setting {
  Way way;
  std::string checks;
  Dialect dialect;
  int only;  // the program that runs; -1: all that do not fault
};

std::string commandOf(const std::string& rung, const Setting& s) {
  std::string command = s.way.compiler != nullptr ? "CXX=" + std::string(s.way.compiler) + " " : "";
  command += rung + " run " + s.way.engine + " " + s.way.level + " " + optionOf(s.dialect) + " --checks=" + s.checks +
             " --cycles=6 --max-errors=5 --trace=- -j1";
  if (s.only >= 0) command += " --set differential_only=" + std::to_string(s.only);
  return command + " differential.st";
}

// Shared by all workers.
class Progress {
 public:
  explicit Progress(const Options& options) : options_(options), begin_(std::chrono::steady_clock::now()) {}

  // Takes the next batch; false: none is left, or the run was ended.
  bool take(uint64_t& seed) {
    seed = options_.first + next_.fetch_add(kBatch);
    return !ended && seed < options_.first + options_.count;
  }
  void done(uint64_t programs, unsigned differ);
  void print(const char* what) const;
  unsigned differ() const { return differ_; }

  std::atomic<bool> ended = false;

 private:
  const Options& options_;
  std::chrono::steady_clock::time_point begin_;
  std::atomic<uint64_t> next_ = 0, programs_ = 0;
  std::atomic<unsigned> differ_ = 0;
  std::atomic<int64_t> printed_ = 0;  // seconds
};

void Progress::print(const char* what) const {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin_);
  std::printf("%s%llu programs, %u differ, %lld s\n", what, static_cast<unsigned long long>(programs_.load()),
              differ_.load(), static_cast<long long>(seconds.count()));
  std::fflush(stdout);
}

void Progress::done(uint64_t programs, unsigned differ) {
  programs_ += programs;
  differ_ += differ;
  const auto now = std::chrono::steady_clock::now() - begin_;
  const int64_t seconds = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  int64_t last = printed_;
  if (seconds >= last + 60 && printed_.compare_exchange_strong(last, seconds)) print("so far: ");
}

// Compares batches one after the other, in a separate folder.
class Worker {
 public:
  Worker(const Options& options, Progress& progress, std::string folder)
      : options_(options), progress_(progress), folder_(std::move(folder)) {}

  void work();

 private:
  Outcome run(const std::string& text, const Setting& setting);
  const Outcome& judge(const std::string& text, const Setting& setting);
  bool differs(const std::string& text, const Setting& setting);
  unsigned compareBatch(uint64_t first, uint64_t count);
  unsigned compare(uint64_t first, uint64_t count, const Way& way, const std::string& checks);
  unsigned narrow(uint64_t first, uint64_t count, const Setting& setting);
  void report(uint64_t seed, const Setting& setting);

  const Options& options_;
  Progress& progress_;
  std::string folder_;
  std::unordered_map<std::string, Outcome> judged_;  // of the current batch
  std::vector<uint64_t> reported_;                   // of the current batch; shrunk once
  bool refused_ = false;                             // by the reference: no other way needs to be tried
};

// A run that does not end is a difference like any other.
Outcome Worker::run(const std::string& text, const Setting& setting) {
  std::ofstream(folder_ + "/differential.st", std::ios::binary) << text;
  tests::Command command;
  command.folder = folder_;
  command.seconds = 600;
  command.arguments = {"/usr/bin/env", "RUNG_CACHE_DIR=" + folder_ + "/cache", "RUNG_CACHE_SIZE=64"};
  std::istringstream words(commandOf(options_.rung, setting));
  for (std::string word; words >> word;) command.arguments.push_back(word);
  tests::Output output = tests::run(command);
  Outcome outcome;
  outcome.exit_code = output.exit_code;
  outcome.trace = std::move(output.out);
  std::istringstream errors(output.err);
  for (std::string line; std::getline(errors, line);) {
    const bool heading = line.find("error") != std::string::npos || line.find("fault[") != std::string::npos;
    if (heading && line.find("warning") == std::string::npos) outcome.errors += line + "\n";
  }
  return outcome;
}

const Outcome& Worker::judge(const std::string& text, const Setting& setting) {
  const std::string key = setting.checks + std::to_string(setting.only) + optionOf(setting.dialect) + text;
  const auto [entry, fresh] = judged_.try_emplace(key);
  if (fresh) entry->second = run(text, {kJudge, setting.checks, setting.dialect, setting.only});
  return entry->second;
}

// Programs that rung rejects are differences too: they are valid.
bool Worker::differs(const std::string& text, const Setting& setting) {
  const Outcome& wanted = judge(text, setting);
  refused_ |= !wanted.ran();
  return !wanted.ran() || !(run(text, setting) == wanted);
}

// The programs and, when a batch has several, the tasks that they run in.
std::string textOf(uint64_t first, uint64_t count) {
  std::string text = "VAR_GLOBAL differential_only : INT := -1; END_VAR\n";
  std::string instances;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t seed = first + i;
    text += generate(seed, static_cast<unsigned>(seed % kBatch), faultsOf(seed), dialectOf(seed)).print();
    const std::string name = "P" + std::to_string(seed % kBatch);
    instances += "PROGRAM i" + name + " WITH " +
                 (i % 3 == 0   ? "fast"
                  : i % 3 == 1 ? "slow"
                               : "often") +
                 " : " + name + ";\n";
  }
  if (first / kBatch / 2 % 2 == 0) return text;
  return text +
         "CONFIGURATION Plant\nRESOURCE cpu ON PLC\nTASK fast(INTERVAL := T#10ms, PRIORITY := 2);\n"
         "TASK often(INTERVAL := T#10ms, PRIORITY := 1);\nTASK slow(INTERVAL := T#30ms, PRIORITY := 3);\n" +
         instances + "END_RESOURCE\nEND_CONFIGURATION\n";
}

// Prints one program without tasks, as small as possible.
void Worker::report(uint64_t seed, const Setting& setting) {
  if (std::find(reported_.begin(), reported_.end(), seed) != reported_.end()) {
    std::printf("seed %llu differs also: %s\n", static_cast<unsigned long long>(seed),
                commandOf(options_.rung, setting).c_str());
    return;
  }
  reported_.push_back(seed);
  Node program = generate(seed, static_cast<unsigned>(seed % kBatch), faultsOf(seed), dialectOf(seed));
  program.children.insert(program.children.begin(), Node{});
  program.children.front().text = "VAR_GLOBAL differential_only : INT := -1; END_VAR\n";
  program.text += kChild;
  const Outcome wanted = run(program.print(), {kJudge, setting.checks, setting.dialect, setting.only});
  const Outcome other = wanted.ran() ? run(program.print(), setting) : wanted;
  // A smaller program must show the same kind of difference.
  const std::string code = other.errors.substr(0, other.errors.find('\n'));
  const size_t bracket = code.find("error[");
  const std::string error = bracket == std::string::npos ? "" : code.substr(bracket, 12);
  const Setting slow = {kJudge, setting.checks, setting.dialect, setting.only};
  if (!wanted.ran() || !(other == wanted)) {
    shrink(program, [&] {
      if (progress_.ended) return false;
      const std::string text = program.print();
      const Outcome left = run(text, slow);
      if (!wanted.ran()) {
        const bool one = error.empty() || std::count(left.errors.begin(), left.errors.end(), '\n') == 1;
        return left.exit_code == wanted.exit_code && left.errors.find(error) != std::string::npos && one;
      }
      if (!left.ran() || left.exit_code != wanted.exit_code) return false;
      const Outcome right = run(text, setting);
      return right.exit_code == other.exit_code && !(right == left);
    });
  }
  const std::string text = program.print();
  const Outcome left = run(text, slow), right = run(text, setting);
  static std::mutex printing;
  const std::lock_guard<std::mutex> lock(printing);
  std::printf("seed %llu differs: %s\n%s---- judge: exit code %d\n%s%s---- exit code %d\n%s%s\n",
              static_cast<unsigned long long>(seed), commandOf(options_.rung, setting).c_str(), text.c_str(),
              left.exit_code, left.errors.c_str(), left.trace.c_str(), right.exit_code, right.errors.c_str(),
              right.trace.c_str());
  std::fflush(stdout);
}

// The programs among `count` that cause the difference.
unsigned Worker::narrow(uint64_t first, uint64_t count, const Setting& setting) {
  if (count == 0 || progress_.ended || !differs(textOf(first, count), setting)) return 0;
  if (count == 1) {
    report(first, setting);
    return 1;
  }
  const unsigned found = narrow(first, count / 2, setting) + narrow(first + count / 2, count - count / 2, setting);
  if (found == 0) {
    std::printf("seeds %llu to %llu differ together only: %s\n", static_cast<unsigned long long>(first),
                static_cast<unsigned long long>(first + count - 1), commandOf(options_.rung, setting).c_str());
  }
  return found == 0 ? 1 : found;
}

unsigned Worker::compare(uint64_t first, uint64_t count, const Way& way, const std::string& checks) {
  if (refused_) return 0;
  const std::string text = textOf(first, count);
  Setting setting = {way, checks, dialectOf(first), -1};
  if (progress_.ended) return 0;
  if (differs(text, setting)) return narrow(first, count, setting);
  unsigned found = 0;
  for (uint64_t seed = first; seed < first + count && !progress_.ended; ++seed) {
    const Faults faults = faultsOf(seed);
    if (faults == Faults::None) continue;
    // Without the check an index beyond the array is undefined.
    if (checks == "none" && faults == Faults::Index) continue;
    setting.only = static_cast<int>(seed % kBatch);
    // Interpreted, the other programs would cost more than this one; compiled, they cost nothing any more.
    if (!differs(way.compiler == nullptr ? textOf(seed, 1) : text, setting)) continue;
    report(seed, setting);
    ++found;
  }
  return found;
}

unsigned Worker::compareBatch(uint64_t first, uint64_t count) {
  judged_.clear();
  reported_.clear();
  refused_ = false;
  unsigned found = 0;
  const char* on = isRangeBatch(first) ? "all" : "default";
  const std::string& ways = options_.ways;
  if (ways != "native" && ways != "one") {
    for (const char* checks : {on, "none"}) {
      for (const Way& way : kInterpreted) found += compare(first, count, way, checks);
    }
  }
  if (ways == "native" || ways == "all" || ways == "turns" || ways == "one") {
    for (uint64_t i = 0; i < 2 * kNativeCount; ++i) {
      if (ways == "turns" && i % 4 != (first / kBatch + first / kBatch / 4) % 4) continue;
      if (ways == "one" && i != (first / kBatch * 5 + first / kBatch / 12) % (2 * kNativeCount)) continue;
      found += compare(first, count, kNative[i % kNativeCount], i / kNativeCount == 0 ? on : "none");
    }
  }
  if (ways == "suite" && first == options_.first) {
    for (const Way& way : kQuickNative) found += compare(first, count, way, on);
  }
  return found;
}

void Worker::work() {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  for (uint64_t seed = 0; progress_.take(seed);) {
    const uint64_t count = std::min(kBatch, options_.first + options_.count - seed);
    const unsigned found = compareBatch(seed, count);
    if (!progress_.ended || found > 0) progress_.done(progress_.ended ? 0 : count, found);
  }
  std::filesystem::remove_all(folder_, error);
}

// Waits for SIGINT and SIGTERM, which all threads block; a command under way is waited for.
void watchSignals(Progress& progress, const sigset_t& signals) {
  int which = 0;
  if (sigwait(&signals, &which) != 0) return;
  progress.ended = true;
  progress.print("ended by a signal: ");
}

int runAll(const Options& options) {
  Progress progress(options);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(watchSignals, std::ref(progress), std::cref(signals)).detach();
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < options.jobs; ++i) {
    workers.emplace_back([&, i] { Worker(options, progress, options.folder + "/" + std::to_string(i)).work(); });
  }
  for (std::thread& worker : workers) worker.join();
  std::error_code error;
  std::filesystem::remove_all(options.folder, error);
  if (!progress.ended) progress.print("");
  std::fflush(stdout);
  _exit(progress.ended ? 130 : progress.differ() == 0 ? 0 : 1);  // the thread above may still wait
}

}  // namespace
}  // namespace rung::differential

int main(int argc, char** argv) {
  using namespace rung::differential;
  Options options;
  if (!rung::generated::readOptions(argc, argv, "differential", "--ways -j", options)) return 2;
  if (options.has_print) {
    const unsigned index = static_cast<unsigned>(options.print % kBatch);
    const uint64_t seed = options.print;
    std::fputs(generate(seed, index, faultsOf(seed), dialectOf(seed)).print().c_str(), stdout);
    return 0;
  }
  options.first = options.first / kBatch * kBatch;
  return runAll(options);
}

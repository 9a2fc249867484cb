// SPDX-License-Identifier: Apache-2.0
// The one runner of all kinds of tests. Each failure prints the difference and the command that reproduces it; the last
// line is `N passed, N failed`. Called by tools/test.sh and tests/update.
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <thread>

#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {
namespace {

namespace fs = std::filesystem;

const char kHelp[] =
    R"(rung_test_runner [options] [FILE|FOLDER...]     without files: every test

  --update        rewrite golden text (tests/update)
  --ways=LIST     options that programs run with, separated by commas; a space joins two options of one way:
                  --engine=interp -O0,--engine=interp,--engine=native -O0,--engine=native
  -j N            processes at once (default: one per processor)
  --list          only print the jobs
  --quick         leave out tests that say `# other compilers: …`, and name them

  tests/golden/**.st        `// expect: ` headings of `rung check`; `// expect tree:` and other emitted text
  tests/golden/**.test      sessions at a console, also in tests/programs and tests/conformance
  tests/golden/ir/*.ir      passes, with ir_golden
  tests/conformance/**.st   {test} POUs by `rung test`, or `// expect:`
  tests/programs/**         `// run: ` options and `// trace: ` lines
  docs/**.md, README.md     ```st broken, fixed, check, run, test; ```console
  samples/library/**.st     the diagrams in docs/library/diagrams are what these programs draw
  unit/NAME, tools/house    GoogleTest programs, differential; the checks of tools/precommit.sh
  A run of everything writes build/test-results.tsv and compares docs/compliance*.md with it.
)";

struct Arguments {
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool list = false;
  std::string error;
};

// The project is the folder above the build folder, or the current folder, that contains tests/runner.
std::string findRoot(const std::string& bin) {
  std::error_code error;
  for (fs::path start : {fs::current_path(error), fs::path(bin)}) {
    for (; start.has_relative_path(); start = start.parent_path()) {
      if (fs::exists(start / "tests/runner/main.cpp", error)) return start.string();
    }
  }
  return {};
}

Arguments parse(int argc, char** argv, Setting& setting) {
  Arguments arguments;
  std::error_code error;
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (program.empty()) program = fs::weakly_canonical(argv[0], error);  // where /proc is not mounted
  setting.bin = program.parent_path().string();
  setting.rung = setting.bin + "/rung";
  setting.root = findRoot(setting.bin);
#ifdef RUNG_SOURCE_ROOT
  if (setting.root.empty()) setting.root = RUNG_SOURCE_ROOT;
#endif
  setting.ways = {"--engine=interp -O0", "--engine=interp", "--engine=native -O0", "--engine=native"};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--help") {
      std::fputs(kHelp, stdout);
      std::exit(0);
    } else if (word == "--update") {
      setting.update = true;
    } else if (word == "--quick") {
      setting.quick = true;
    } else if (word == "--list") {
      arguments.list = true;
    } else if (word == "-j" && i + 1 < argc) {
      arguments.jobs = static_cast<unsigned>(std::max(1, std::atoi(argv[++i])));
    } else if (startsWith(word, "--ways=")) {
      setting.ways.clear();
      for (size_t at = 7; at <= word.size();) {
        const size_t end = std::min(word.find(',', at), word.size());
        setting.ways.push_back(word.substr(at, end - at));
        at = end + 1;
      }
    } else if (startsWith(word, "-")) {
      arguments.error = "unknown option " + word;
    } else if (startsWith(word, "unit/")) {
      setting.wanted.push_back(word);
    } else if (!fs::exists(word, error) && !fs::exists(setting.root + "/" + word, error)) {
      arguments.error = "no such file: " + word;
    } else {
      const fs::path path = fs::exists(word, error) ? fs::canonical(word, error) : fs::path(setting.root) / word;
      setting.wanted.push_back(path.lexically_relative(setting.root).string());
    }
  }
  if (setting.root.empty()) arguments.error = "run it inside the project";
  return arguments;
}

// Makes a folder for this run below the build folder and removes those of runs that have ended.
void makeScratch(Setting& setting) {
  const fs::path folder = fs::path(setting.bin).parent_path() / "test-scratch";
  std::error_code error;
  fs::create_directories(folder, error);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0 || (kill(pid, 0) != 0 && errno == ESRCH)) fs::remove_all(entry.path(), error);
  }
  setting.scratch = folder / std::to_string(getpid());
  fs::create_directories(setting.scratch, error);
}

// Sets a separate cache and search path: the user's own must neither help nor be changed.
void setEnvironment(const Setting& setting) {
  const char* path = std::getenv("PATH");
  setenv("PATH", (setting.bin + ":" + (path != nullptr ? path : "/usr/bin:/bin")).c_str(), 1);
  setenv("XDG_CACHE_HOME", (setting.bin + "/../test-cache").c_str(), 1);
  setenv("RUNG_SOURCE", setting.root.c_str(), 1);
  setenv("RUNG_VERIFY", "1", 1);
  setenv("LC_ALL", "C.UTF-8", 1);
  unsetenv("RUNG_HOME");
}

void writeRows(const Setting& setting, std::vector<Row> rows) {
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.file != b.file ? a.file < b.file : a.test < b.test; });
  std::string text = "file\ttest\tstatus\tfeatures\tcovers\n";
  for (const Row& row : rows) {
    text += row.file + "\t" + row.test + "\t" + (row.passed ? "passed" : "failed") + "\t" + row.features + "\t" +
            row.covers + "\n";
  }
  writeContent(setting.bin + "/../test-results.tsv", text);
}

// True when docs/compliance*.md agree with the results of this run.
bool complianceIsTrue(const Setting& setting) {
  Command check;
  check.arguments = {"/usr/bin/env", "BUILD=" + setting.bin + "/..", setting.root + "/tools/compliance/compliance.py",
                     "--check", setting.bin + "/../test-results.tsv"};
  check.folder = setting.root;
  check.merged = true;
  const Output output = run(check);
  if (output.exit_code != 0) std::printf("FAILED docs/compliance*.md\n%s", output.out.c_str());
  return output.exit_code == 0;
}

int runAll(const Setting& setting, const Arguments& arguments, std::vector<Job>& jobs) {
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.cost > b.cost; });
  std::atomic<size_t> next{0};
  std::mutex mutex;  // guards what follows
  unsigned passed = 0, failed = 0;
  std::vector<Row> rows;

  const auto work = [&] {
    for (size_t i = next++; i < jobs.size(); i = next++) {
      Result result = jobs[i].run();
      const std::lock_guard lock(mutex);
      passed += result.passed;
      failed += result.failed;
      rows.insert(rows.end(), result.rows.begin(), result.rows.end());
      std::fputs(result.log.c_str(), stdout);
      std::fflush(stdout);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < arguments.jobs; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();

  if (setting.wanted.empty() && !setting.update && !setting.quick) {
    writeRows(setting, std::move(rows));
    if (failed == 0) (complianceIsTrue(setting) ? passed : failed) += 1;
  }
  std::printf("%u passed, %u failed\n", passed, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rung::tests

int main(int argc, char** argv) {
  using namespace rung::tests;
  Setting setting;
  const Arguments arguments = parse(argc, argv, setting);
  if (!arguments.error.empty()) {
    std::fprintf(stderr, "rung_test_runner: %s\n", arguments.error.c_str());
    return 2;
  }
#ifdef RUNG_SANITIZED
  // Frames are larger, and the limits of nesting are for the usual stack. ASan checks stacks of up to 64 MiB.
  const rlimit stack = {60 << 20, RLIM_INFINITY};
  setrlimit(RLIMIT_STACK, &stack);
#endif
  makeScratch(setting);
  setEnvironment(setting);

  std::vector<Job> jobs;
  addUnit(setting, jobs);
  addConformance(setting, jobs);
  addPrograms(setting, jobs);
  addDocumentation(setting, jobs);
  addDiagrams(setting, jobs);
  addConsole(setting, jobs);
  addGolden(setting, jobs);
  int exit_code = 0;
  if (arguments.list) {
    for (const Job& job : jobs) std::printf("%s\n", job.name.c_str());
  } else {
    exit_code = runAll(setting, arguments, jobs);
  }
  std::error_code error;
  if (exit_code == 0) std::filesystem::remove_all(setting.scratch, error);  // else kept for the printed commands
  return exit_code;
}

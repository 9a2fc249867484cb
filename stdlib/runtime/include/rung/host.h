// The bundled host: runs a module in virtual or real time, with CSV inputs, traces, retain files and tests
// (docs/embedding.md). In: a module and the options of `rung run` or `rung test`. Out: exit codes 0, 2, 3, 4 and output
// on stdout and stderr. Linked into the tool (which loads modules as shared objects) and into executables made by
// `rung build`.
#pragma once

#include <csignal>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "rung/module.h"

namespace rung::host {

struct RunOptions {
  int64_t cycles = -1;                                    // --cycles; -1: not given
  int64_t for_ns = -1;                                    // --for
  int64_t interval_ns = 10'000'000;                       // --interval, for programs without tasks
  std::string inputs_path;                                // --inputs
  std::vector<std::pair<std::string, std::string>> sets;  // --set PATH=VALUE
  std::string watch;                                      // --watch PATH,...
  std::string trace_path;                                 // --trace; "-": stdout
  std::string plot_path;                                  // --plot: SVG; "-": stdout
  std::string retain_path;                                // --retain
  std::string files_root = ".";                           // --files-root
  int start = -1;            // --start: rung_start, -1: warm when the retain file exists, else cold
  std::string stop_on;       // --stop-on CONDITION
  bool trace_calls = false;  // --trace-calls, for interpreted modules that report their calls
  bool realtime = false;
  bool color = false;
  std::string hint_when_long;  // printed once on a terminal when the run takes long; empty: nothing
  std::FILE* out = stdout;     // for results, traces to `-` and traced calls
  std::FILE* err = stderr;     // for faults and other messages
};

// Runs and prints like `rung run`.
int run(const rung_module& module, const RunOptions& options);

struct TestOptions {
  std::string filter;          // --filter GLOB
  std::string junit_path;      // --junit
  std::string hint_when_long;  // as in RunOptions
  std::FILE* out = stdout;
  std::FILE* err = stderr;
};
int test(const rung_module& module, const TestOptions& options);

// `rung test` in two steps, for many modules: runs and prints the tests of one, then writes all results.
struct TestResult {
  std::string name, file;
  uint32_t line = 0;
  enum Kind : uint8_t { Passed, Failed, Broken } kind = Passed;  // Broken: a fault, or a file that does not compile
  uint64_t assertions = 0;
  double seconds = 0;
  std::string messages;
};
struct TestResults {
  uint32_t passed = 0, failed = 0;
  std::vector<TestResult> tests;
  double seconds = 0;   // for all of them
  bool hinted = false;  // TestOptions::hint_when_long was printed
};
// True when --filter accepts a test of this name.
bool isChosen(const TestOptions& options, const std::string& name);
// Returns why the module cannot run here, or an empty string. Does not write `options.junit_path`.
std::string runTests(const rung_module& module, const TestOptions& options, TestResults& results);
// Returns 0, 2 or 4, like test().
int reportTests(const TestResults& results, const TestOptions& options);

// main() of an executable made by `rung build`: the options of `rung run` on its own command line.
int applicationMain(const rung_module& module, int argc, char** argv);

// For a handler of SIGSEGV and SIGBUS: does not return when the program's code accessed invalid memory or nested calls
// too deep; the program gets a fault then. `details`: ucontext_t. applicationMain has a handler.
void raiseCrash(int number, const siginfo_t* info, const void* details);
// Finds the current site of interpreted code, or RUNG_NONE; unknown for compiled code.
using FindSite = uint32_t (*)(const rung_context* ctx, const void* details);
void setFindSite(FindSite find);

// Parses the run options from arguments; unknown ones stay in `rest`. Returns an error message, or an empty string.
std::string parseRunOptions(const std::vector<std::string>& arguments, RunOptions& options,
                            std::vector<std::string>& rest);

}  // namespace rung::host

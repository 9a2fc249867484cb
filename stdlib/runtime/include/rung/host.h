// SPDX-License-Identifier: Apache-2.0
// The bundled host: runs a module in virtual or real time, with CSV inputs, traces, retain files and tests
// (docs/embedding.md). In: a module and the options of `rung run` or `rung test`. Out: exit codes 0, 2, 3, 4 and output
// on stdout and stderr. Linked into the tool (which loads modules as shared objects) and into executables made by
// `rung build`.
#pragma once

#include <csignal>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rung/module.h"
#include "rung/pou_view.h"

namespace rung::host {

// Paths of files as the module has them (relative to the project's root), and as messages show them.
using ShownPaths = std::map<std::string, std::string>;
std::string shownPath(const ShownPaths& paths, const std::string& path);

constexpr int64_t kDefaultMaxSteps = 100'000'000;

// How the run is seen and changed by browsers and tools (docs/monitor.md).
struct MonitorOptions {
  std::string address;                                   // --monitor [ADDRESS:]PORT; empty: not at all
  bool is_insecure = false;                              // --monitor-insecure: other machines may reach the address
  std::string engine = "native";                         // that runs the program: `native` or `interp`
  std::string version;                                   // of rung; empty: of the one that compiled the module
  std::vector<rung_pou_view> pous;                       // what is shown of bodies; the rows refer to memory that stays
  std::function<void(const std::string& url)> on_start;  // it serves at this URL; may be empty
};

// Another version of the program, for an online change.
struct NewVersion {
  const rung_module* module = nullptr;
  std::shared_ptr<const void> keeper;  // what the module is part of: it lives while this does
  ShownPaths paths;
  std::vector<rung_pou_view> pous;  // of MonitorOptions; they live as long as `keeper`
  std::string error;                // why there is no module: a line, and what the compiler says about the project
};

struct ChangeOptions {
  int64_t rollback_cycles = 0;  // --rollback: how long a fault of a new version brings back the one before it
  // Compiles a project, '' for the one that runs, for an online change; called in a thread of its own. Empty: a library
  // of `rung build --shared` is loaded instead.
  std::function<NewVersion(const std::string& project)> compile;
  // --watch-files: tells whether the files of the project differ from those when it was asked last. Empty: they do not.
  std::function<bool()> has_changed;
};

struct RunOptions {
  int64_t cycles = -1;                                    // --cycles; -1: not given
  int64_t for_ns = -1;                                    // --for
  int64_t interval_ns = 10'000'000;                       // --interval, for programs without tasks
  std::string inputs_path;                                // --inputs
  std::vector<std::pair<std::string, std::string>> sets;  // --set PATH=VALUE
  std::string watch;                                      // --watch PATH,...
  std::string trace_path;                                 // --trace; "-": stdout
  bool trace_forces = false;                              // --trace-forces: a column of the trace names what is forced
  std::string plot_path;                                  // --plot: SVG; "-": stdout
  std::string retain_path;                                // --retain
  int64_t retain_interval_ns = 1'000'000'000;             // --retain-interval: how often it is written
  std::string files_root = ".";                           // --files-root
  std::map<uint32_t, std::string> serial;                 // --serial N=DEVICE
  std::vector<std::string> drivers;                       // --driver PATH[=ARGUMENT]
  std::string control_path;                               // --control: commands to the running program
  MonitorOptions monitor;
  bool others_go_on = false;  // --on-fault=task: a fault stops its task alone
  int start = -1;             // --start: rung_start, -1: warm when the retain file exists, else cold
  std::string stop_on;        // --stop-on CONDITION
  bool trace_calls = false;   // --trace-calls, for interpreted modules that report their calls
  bool realtime = false;
  int64_t max_steps = kDefaultMaxSteps;  // --max-steps, of an activation; 0: none
  int64_t timeout_ns = 0;                // --timeout; 0: none
  bool color = false;
  ChangeOptions change;
  ShownPaths paths;
  std::string hint_when_long;  // printed once on a terminal when the run takes long; empty: nothing
  std::FILE* out = stdout;     // for results, traces to `-` and traced calls
  std::FILE* err = stderr;     // for faults and other messages
};

// Runs and prints like `rung run`.
int run(const rung_module& module, const RunOptions& options);

struct TestOptions {
  std::vector<std::string> filters;            // --filter GLOB; none: all tests
  std::map<std::string, std::string> skipped;  // {skip 'why'}: test and reason
  std::string junit_path;                      // --junit
  std::string watch, trace_path, plot_path;    // as in RunOptions, of one test
  std::string hint_when_long;                  // as in RunOptions
  int64_t max_steps = kDefaultMaxSteps;        // as in RunOptions
  int64_t timeout_ns = 10'000'000'000;         // --timeout, of each test; 0: none
  ShownPaths paths;
  std::FILE* out = stdout;
  std::FILE* err = stderr;
  // Tests run in a child process. What the first returns there at the end is passed to the second in this one.
  std::function<std::string()> collect;
  std::function<void(std::string_view)> merge;
};
// Returns 0, 2 or 4; no test is not an error here.
int test(const rung_module& module, const TestOptions& options);

// `rung test` in two steps, for many modules: runs and prints the tests of one, then writes all results.
struct TestResult {
  // Broken: a fault, a crash, or a file that does not compile.
  enum Kind : uint8_t { Passed, Skipped, Failed, Broken };
  std::string name;
  std::string file;  // in the module
  uint32_t line = 0;
  Kind kind = Passed;
  uint64_t assertions = 0;
  double seconds = 0;
  std::string messages;
  std::string shown_file;  // ShownPaths
};
struct TestResults {
  uint32_t passed = 0, failed = 0, skipped = 0;
  std::vector<TestResult> tests;
  double seconds = 0;        // for all of them
  bool hinted = false;       // TestOptions::hint_when_long was printed
  bool interrupted = false;  // SIGINT, SIGTERM or SIGHUP: the tests that follow do not run
  std::string crash;         // the signal of the last crash
  uint32_t count() const { return passed + failed + skipped; }
};
// True when --filter accepts a test of this name; that of a test accepts all its cases, `adds(a := 1)`.
bool isChosen(const TestOptions& options, const std::string& name);
// Returns why the module cannot run here, or an empty string. Does not write `options.junit_path`.
std::string runTests(const rung_module& module, const TestOptions& options, TestResults& results);
// Prints the totals and writes the JUnit file; returns 0, 2 or 4.
int reportTests(const TestResults& results, const TestOptions& options);
// Writes only the JUnit file. Returns an error message, or an empty string.
std::string writeJunit(const TestResults& results, const std::string& path, std::FILE* out);

// main() of an executable made by `rung build`: the options of `rung run` on its own command line. `pous`: what
// its monitor shows, up to an empty row; null: nothing.
int applicationMain(const rung_module& module, int argc, char** argv, const rung_pou_view* pous = nullptr);

// For a handler of SIGSEGV and SIGBUS: does not return when the program's code accessed invalid memory or nested calls
// too deep; the program gets a fault then. `details`: ucontext_t. applicationMain has a handler.
void raiseCrash(int number, const siginfo_t* info, const void* details);
// Finds the current site of interpreted code, or RUNG_NONE; unknown for compiled code.
using FindSite = uint32_t (*)(const rung_context* ctx, const void* details);
void setFindSite(FindSite find);

// The values of --timeout and --max-steps. Return an error message, or an empty string.
std::string parseTimeout(const std::string& text, int64_t& ns);
std::string parseMaxSteps(const std::string& text, int64_t& steps);

// Parses the run options from arguments; unknown ones stay in `rest`. Returns an error message, or an empty string.
std::string parseRunOptions(const std::vector<std::string>& arguments, RunOptions& options,
                            std::vector<std::string>& rest);

}  // namespace rung::host

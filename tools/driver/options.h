// SPDX-License-Identifier: Apache-2.0
// The options of the commands: those that all have in common, and a structure for each command. They are data that the
// command line fills in, or a server or test without one. The parsers of values that the command line shares with
// rung.project are here too.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/format/format.h"
#include "frontend/parse/conditions.h"
#include "frontend/parse/parse.h"
#include "frontend/schedule/edge_coils.h"
#include "frontend/source/dialect.h"
#include "frontend/source/render.h"

namespace rung::driver {

enum class EmitKind : uint8_t { Cpp, Ir, Tree };
enum class ConvertTo : uint8_t { None, St, Xml, Messages };
enum class BuildKind : uint8_t { Executable, Shared, Static };
// The engine that runs a program: the interpreter of the IR, or compiled C++.
enum class Engine : uint8_t { Auto, Native, Interpreter };  // Auto: the interpreter when possible

// The exit codes of rung (docs/cli/README.md).
enum Exit : int { kSuccess = 0, kInputErrors = 1, kUsage = 2, kFault = 3, kTestFailed = 4, kInternal = 70 };

struct WarningSwitch {
  std::string name;
  bool on;
};

// The text of a file in an editor.
struct UnsavedFile {
  std::string path, text;
};

// Division by zero, indices, null pointers and casts.
uint8_t defaultChecks();

// What a command reports about the sources, and how.
struct ReportOptions {
  std::vector<WarningSwitch> warnings;  // -W
  bool werror = false;
  uint32_t max_errors = 100;
  uint32_t max_warnings = 20;  // of one code, in text; 0: all
  DiagnosticFormat format = DiagnosticFormat::Text;
  std::string path;    // --diagnostics; empty: to the sink, in `format`
  bool color = false;  // of diagnostics
};

// How the sources become a program.
struct CodeOptions {
  uint8_t checks = defaultChecks();  // ir::Check bits
  bool checks_given = false;
  int level = 1;  // -O
  bool level_given = false;
  uint32_t native_width = 32;  // of intermediate results in codesys
  bool native_width_given = false;
  diagram::EdgeCoils edge_coils = diagram::EdgeCoils::Pulse;
  bool edge_coils_given = false;
  int64_t plc_period_ns = 0, time_slice_ns = 0;  // of an NCT program; 0: as rung.project says
  uint32_t pointer_size = 8;
  std::string dump_after;
  bool verify = false;  // set by RUNG_VERIFY=1 and in debug builds

  // Set by the commands, not by the command line.
  int64_t default_interval_ns = 10'000'000;  // of a program without tasks
  bool with_tests = false;
  std::vector<std::string> mocks;  // sema::Options::mocks
  bool counts_steps = false;
  bool counts_statements = false;  // for coverage
  bool trace_calls = false;
  bool debug = false;          // of interpreted programs: ir/interpreter/debug.h
  bool online_change = false;  // --online-change, and runs that another version may take over
  bool is_bundled = false;     // a unit of the C++ compiler includes several of the sources
};

// What all commands that read a project have in common.
struct ProjectOptions {
  std::vector<std::string> inputs;   // files and folders
  std::vector<UnsavedFile> unsaved;  // read instead of the files on disk
  std::string written;               // a file that the command writes: not a source, although it is among the inputs
  std::vector<std::string> library_paths;  // -I
  std::vector<text::Define> defines;       // -D
  std::string root;                        // --root
  std::string name;                        // --name; empty: plc
  Dialect dialect = kDefaultDialect;
  bool dialect_given = false;
  bool verbose = false;
  bool time_phases = false;
  ReportOptions report;
  CodeOptions code;

  std::string moduleName() const { return name.empty() ? "plc" : name; }
};

// The fixes that `rung check --fix` applies: those that are sure, or all.
enum class FixSet : uint8_t { None, Sure, All };
struct CheckOptions {
  FixSet fixes = FixSet::None;
  bool shows_changes = false;  // --diff: writes nothing
};

struct EmitOptions {
  std::string output;  // -o
  EmitKind kind = EmitKind::Cpp;
  std::string depfile, depfile_target;
  bool list_outputs = false;
  uint32_t bundles = 0;
};

// What is made by a C++ compiler.
struct NativeOptions {
  uint32_t jobs = 0;  // 0: one per processor
  bool keep = false;
};

struct BuildOptions {
  std::string output;
  BuildKind kind = BuildKind::Executable;
  bool debug = false;   // -g
  std::string symbols;  // where the symbol file goes; empty: nowhere
  NativeOptions native;
};

struct RunOptions {
  Engine engine = Engine::Auto;
  NativeOptions native;
  bool watch_files = false;                 // --watch-files: an online change where the project's files change
  std::vector<std::string> host_arguments;  // for rung::host::parseRunOptions, one `--name=value` each
  bool opens_monitor = false;               // and its page in a browser

  bool mayInterpret() const { return engine == Engine::Interpreter || (engine == Engine::Auto && !native.keep); }
};

struct TestOptions {
  RunOptions run;
  std::vector<std::string> filters;
  std::string junit, lcov;
  bool coverage = false;  // as a table
  bool allow_none = false;
  bool separate = false;
  bool list = false;                    // only print which there are
  int64_t timeout_ns = 10'000'000'000;  // of each test; 0: none
  int64_t max_steps = 100'000'000;      // of an activation; 0: none

  bool counts() const { return coverage || !lcov.empty(); }
};

struct ConvertOptions {
  std::string output;
  ConvertTo to = ConvertTo::None;
  bool splits = false;  // --split: one file for each declaration, also of files in ST
};

struct GraphOptions {
  std::string output;
  uint32_t page_width = 1200;  // 0: unlimited
};

struct FormatOptions {
  bool only_checks = false, shows_changes = false;  // --check, --diff
  format::LineRange lines;
};

struct ListOptions {
  std::string what;       // `pous`; empty: the signature
  std::string signature;  // of this function, block or type
};

// The bits of `div,index,…`, `default`, `all` or `none`.
[[nodiscard]] std::string parseNativeWidth(std::string_view bits, uint32_t& width);
[[nodiscard]] std::string parseEdgeCoils(std::string_view name, diagram::EdgeCoils& edge_coils);
[[nodiscard]] std::string parseChecks(std::string_view list, uint8_t& checks);
// NAME or NAME=VALUE.
[[nodiscard]] std::string parseDefine(std::string_view text, std::vector<text::Define>& defines);
[[nodiscard]] std::string parseDialect(std::string_view name, Dialect& dialect);

// `name` in backquotes.
std::string backquoted(std::string_view text);
// The message, and the nearest of the candidates.
std::string withSuggestion(std::string message, std::string_view written,
                           const std::vector<std::string_view>& candidates);
// The position of `value` in `a|b|c`.
[[nodiscard]] std::string parseChoice(std::string_view option, std::string_view value, std::string_view choices,
                                      uint32_t& index);

// True for a valid C identifier, as --name and the stem of a file must be.
bool isModuleName(std::string_view name);

}  // namespace rung::driver

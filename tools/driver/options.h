// SPDX-License-Identifier: Apache-2.0
// The options of all commands: data that the command line fills in, or a server or test without one. The parsers of
// values that the command line shares with rung.project are here too.
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

struct Options {
  std::vector<std::string> inputs;   // files and folders; of `list` and `explain`: what to show
  std::vector<UnsavedFile> unsaved;  // read instead of the files on disk

  // common
  std::string output;                      // -o
  std::vector<std::string> library_paths;  // -I
  std::vector<text::Define> defines;       // -D
  std::string root;                        // --root
  std::string name;                        // --name; empty: plc
  Dialect dialect = kDefaultDialect;
  bool dialect_given = false;
  uint8_t checks = defaultChecks();  // ir::Check bits
  bool checks_given = false;
  int level = 1;  // -O
  bool level_given = false;
  std::vector<WarningSwitch> warnings;
  bool werror = false;
  uint32_t max_errors = 100;
  uint32_t max_warnings = 20;  // of one code, in text; 0: all
  DiagnosticFormat format = DiagnosticFormat::Text;
  std::string diagnostics_path;  // --diagnostics; empty: to the sink, in `format`
  uint32_t jobs = 0;             // 0: one per processor
  bool color = false;            // of diagnostics
  std::string dump_after;
  bool time_phases = false;
  bool verbose = false;
  bool verify = false;  // set by RUNG_VERIFY=1 and in debug builds

  // emit
  EmitKind emit = EmitKind::Cpp;
  std::string depfile, depfile_target;
  bool list_outputs = false;
  uint32_t bundles = 0;

  // convert
  ConvertTo to = ConvertTo::None;
  bool splits = false;  // --split: one file for each declaration, also of files in ST

  // fmt
  bool only_checks = false, shows_changes = false;  // --check, --diff
  format::LineRange lines;

  // graph
  uint32_t page_width = 1200;  // 0: unlimited

  // build
  BuildKind build = BuildKind::Executable;
  bool debug = false;   // -g
  std::string symbols;  // where the symbol file goes; empty: nowhere
  bool keep = false;

  // run: options for the host (rung::host::parseRunOptions), one `--name=value` each
  std::vector<std::string> host_arguments;
  uint32_t pointer_size = 8;
  uint32_t native_width = 32;  // of intermediate results in codesys
  bool native_width_given = false;
  diagram::EdgeCoils edge_coils = diagram::EdgeCoils::Pulse;
  bool edge_coils_given = false;
  bool counts_steps = false;                     // set by run.cpp and test.cpp
  int64_t default_interval_ns = 10'000'000;      // set from --interval by run.cpp
  int64_t plc_period_ns = 0, time_slice_ns = 0;  // of an NCT program; 0: as rung.project says

  // run, test
  Engine engine = Engine::Auto;

  bool trace_calls = false;  // set from --trace-calls by run.cpp

  // test
  std::vector<std::string> filters;
  std::string junit, lcov;
  bool allow_none = false;
  int64_t timeout_ns = 10'000'000'000;  // of each test; 0: none
  int64_t max_steps = 100'000'000;      // of an activation; 0: none
  bool coverage = false;                // as a table
  std::vector<std::string> mocks;       // sema::Options::mocks, set by test.cpp
  bool with_tests = false;              // set by test.cpp
  bool counts() const { return coverage || !lcov.empty(); }
  bool separate = false;

  // list
  std::string signature;

  // new
  std::string project_template = "st";  // --template

  std::string moduleName() const { return name.empty() ? "plc" : name; }
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

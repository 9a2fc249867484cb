// SPDX-License-Identifier: Apache-2.0
// The driver's options for sema: dialect, libraries, mocks, and its callbacks.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/schedule/edge_coils.h"
#include "frontend/source/dialect.h"
#include "frontend/source/files.h"
#include "frontend/source/function_ref.h"
#include "sema/ids.h"
#include "sema/types/areas.h"
#include "sema/types/arithmetic.h"

namespace rung::sema {

struct Project;

// Called for each body that a scheduler has turned into statements, before they are checked: `rung convert` prints
// here, since sema's insertions have no ST source. The types of temporaries follow when the project is checked:
// Project::pous, Var::temporary.
using Scheduled = std::function<void(Project& project, PouId pou)>;

// One file of a library that is built into the compiler.
struct LibraryFile {
  const char* library;  // `Standard`
  const char* path;     // as diagnostics and faults print it
  std::string_view source;
  FileId file = {};  // none: `source` is not in Sources yet
  // A library of the project that has other blocks of the same names: those of this file are not known.
  const char* hidden_by = nullptr;
};
// Another name of a library, for qualified names: Tc2_Standard.TON.
struct LibraryAlias {
  const char *alias, *library;
};
// A library among the sources, `-I X.plcproj`: no task runs its programs, and it may declare POUs and types under names
// that the project or another library has too.
struct LibraryProject {
  std::span<const std::string> names;  // that qualify what it declares
  std::vector<FileId> files;
};
// Runs a function whose inputs are constant. `ready`: checks the body of a function; false: it cannot be run.
// Implemented in a later layer, ir/interpreter/constant_call.h.
using CallConstant = std::function<std::optional<types::Value>(
    Project& project, PouId function, std::span<const types::Value> values, FunctionRef<bool(PouId)> ready)>;

// `duration` of [task NAME] in rung.project: how long a task runs in virtual time.
struct TaskDuration {
  std::string task;
  int64_t duration_ns = 0;
  Loc loc;  // of the section
};

// `[module NAME]` in rung.project.
struct ConfiguredModule {
  types::IoModule module;
  std::string task;  // its bus cycle task, or empty
  Loc task_loc;
};

// The choices of the command line and rung.project.
struct Options {
  Dialect dialect = kDefaultDialect;
  uint32_t pointer_size = 8;
  uint32_t native_width = 32;  // codesys: intermediate results have at least so many bits, 32 or 64
  diagram::EdgeCoils edge_coils = diagram::EdgeCoils::Pulse;  // of LD
  std::string_view name = "plc";                              // of the module: instance paths begin with it
  std::span<const LibraryFile> libraries;  // sources that outlive the project; declarations are parsed on first use
  const std::atomic<bool>* cancelled = nullptr;  // asked before each body: when it is true the rest is not checked
  bool records_mentions = false;                 // each place where the source names an entity
  std::vector<LibraryProject> library_projects;
  std::span<const std::string> project_names;  // qualifiers of what the project itself declares: `TcUnit.FB_TestSuite`
  std::span<const LibraryAlias> library_aliases;
  CallConstant call_constant;  // none: calls of functions are not constant
  // TwinCAT stores any value in a subrange, and code such as TcUnit relies on it (a count of 0 in UINT(1..100)): a
  // project with a .plcproj sets this. In the manuals range types saturate.
  bool free_subranges = false;  // a subrange takes all values of its base type, and begins with its lower bound
  types::MemoryAreas areas = types::standardAreas();
  uint32_t pool_bytes = 0;                   // of the pool for __NEW; 0: the library's default
  Scheduled scheduled;                       // none: no callback
  bool with_tests = false;                   // the program is for `rung test`
  std::vector<std::string> mocks;            // … of the tests that name exactly these
  int64_t default_interval_ns = 10'000'000;  // of the task that is created when there is no CONFIGURATION
  std::vector<TaskDuration> task_durations;
  std::vector<ConfiguredModule> io_modules;
  bool aligned_globals = false;  // a task works on a copy of the globals that it exchanges at the alignment point
};

}  // namespace rung::sema

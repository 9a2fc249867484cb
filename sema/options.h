// What the driver chooses and gives to sema: dialect, libraries, mocks, and what it wants to be asked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/dialect.h"
#include "frontend/source/function_ref.h"
#include "sema/ids.h"
#include "sema/types/arithmetic.h"

namespace rung::sema {

struct Project;

// Told of each body that a scheduler has made statements of, before they are checked: the moment to print them.
// The types of the temporaries follow when the project is checked: Project::pous, Var::temporary.
using Scheduled = std::function<void(Project& project, PouId pou)>;

// One file of a library that is built into the compiler.
struct LibraryFile {
  const char* library;  // `Standard`
  const char* path;     // as diagnostics and faults print it
  std::string_view source;
};
// Another name of a library, for qualified names: Tc2_Standard.TON.
struct LibraryAlias {
  const char *alias, *library;
};
// Runs a function whose inputs are constant. `ready`: checks the body of a function; false: it cannot be run. The later
// layer that can do it is ir/interpreter (constant_call.h).
using CallConstant = std::function<std::optional<types::Value>(
    Project& project, PouId function, std::span<const types::Value> values, FunctionRef<bool(PouId)> ready)>;

// What the command line and rung.project choose.
struct Options {
  Dialect dialect = Dialect::Codesys;
  uint32_t pointer_size = 8;
  std::string_view name = "plc";               // of the module: instance paths begin with it
  std::span<const LibraryFile> libraries;      // texts that outlive the project; declarations are parsed on first use
  std::span<const std::string> project_names;  // qualify what the project itself declares: `TcUnit.FB_TestSuite`
  std::span<const LibraryAlias> library_aliases;
  CallConstant call_constant;                // none: calls of functions are no constants
  bool free_subranges = false;               // a subrange takes all values of its base, as in TwinCAT
  uint32_t pool_bytes = 0;                   // of the pool behind __NEW; 0: as the library has it
  Scheduled scheduled;                       // none: nobody asks
  bool with_tests = false;                   // the program is for `rung test`
  std::vector<std::string> mocks;            // … of the tests that name exactly these
  int64_t default_interval_ns = 10'000'000;  // of the task that is made when there is no CONFIGURATION
};

}  // namespace rung::sema

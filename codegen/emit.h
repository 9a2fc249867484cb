// SPDX-License-Identifier: Apache-2.0
// Code generation: IR to C++ files, the symbol map and the manifest. In: a verified ir::Module. Out: file
// contents by relative path, deterministic to the byte; write.h puts them on disk. Called by the driver.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ir/ir.h"

namespace rung::codegen {

struct EmitOptions {
  std::string module_name = "plc";  // --name: the prefix of every external symbol
  bool line_directives = true;
  // -O2: the C++ compiler optimizes every body, not only those that loop (effort.h), and inlines small blocks and
  // functions of the project across files.
  bool optimize_all = false;
  bool (*is_native_of_rung)(std::string_view function) = nullptr;  // the others get a header; none: no header
  bool bundled = false;       // a C++ file may include several sources: what two of them define is in a header
  bool with_tests = false;    // `rung test`: entries of the tests instead of tasks
  bool counts_steps = false;  // `rung run`, `rung test`: bodies use up rung_context::steps, so that endless loops end
};

// Other tools read this to find variables (codegen/symbols.h); all other files are for the C++ compiler.
inline constexpr const char* kSymbolFile = "symbols.json";

struct OutputFile {
  std::string path;
  std::string content;
  bool has_user_code = false;  // a body in C++: g++ may reject it, and it brings its own macros and names
};

// Headers and sources of the module; `.cpp` files are the ones to compile. Sorted by path.
std::vector<OutputFile> emitCpp(const ir::Module& module, const EmitOptions& options);

// Where the header of a library's native blocks is, and the C++ files that include it; empty: of the project.
std::string nativeFolder(std::string_view library);

// The C++ name of a user's name: `nan` -> `nan_`. Never a keyword, macro or POSIX name, never two user names in one.
std::string mangle(std::string_view name);

}  // namespace rung::codegen

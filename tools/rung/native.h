// From generated C++ to a library or program: g++ for what the cache does not hold, in parallel, then the linker.
// In: generated files of one or more modules. Out: paths of a shared object, or the written output; an internal error
// (70) with the first lines when g++ refuses code that rung made. Called by build, run and test.
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"
#include "tools/rung/cache.h"
#include "tools/rung/options.h"

namespace rung::tool {

// The files of one module, in a folder of their own.
struct NativePart {
  std::string folder;  // inside the work folder; empty: the work folder itself
  std::vector<codegen::OutputFile> files;
};

struct NativeRequest {
  std::vector<NativePart> parts;
  uint32_t batches = 0;  // > 0: so many translation units that include the parts' .cpp files
  int level = 1;         // -O of the C++ compiler, unless $CXXFLAGS says another
  uint32_t jobs = 0;
  bool keep = false;  // keep the generated files and say where
};

// What g++ says of a body that the user wrote in C++, at its own place: the path as diagnostics print it.
struct Refusal {
  std::string path;
  uint32_t line, column;
  std::string message;
};

struct NativeResult {
  int exit = kSuccess;  // kSuccess, kUsage, kInternal, or kInputErrors: g++ refused a body that the user wrote in C++
  std::string message;  // what went wrong
  std::vector<Refusal> refusals;  // kInputErrors: empty where g++ names no place in the body, see `message`
  std::string path;               // the shared object
};

// Compiles and links to a shared object in the cache, or finds it there.
NativeResult makeShared(Cache& cache, const NativeRequest& request);
// Compiles, links and puts the result at `output`: an executable with the bundled host, a shared or a static library.
NativeResult makeOutput(Cache& cache, const NativeRequest& request, BuildKind kind, const std::string& module_name,
                        const std::string& output);

// $CXX or g++, split at blanks.
std::vector<std::string> compilerCommand();

}  // namespace rung::tool

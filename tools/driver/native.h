// SPDX-License-Identifier: Apache-2.0
// From generated C++ to a library or program: runs g++ in parallel for everything that is not in the cache, then the
// linker. In: generated files of one or more modules. Out: paths of a shared object, or the written output; an internal
// error (70) with the first lines when g++ rejects generated code. Called by build, run and test.
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"
#include "tools/driver/cache.h"
#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::driver {

// The files of one module, in a separate folder.
struct NativePart {
  std::string folder;  // inside the work folder; empty: the work folder itself
  std::vector<codegen::OutputFile> files;
};

struct NativeRequest {
  std::vector<NativePart> parts;
  uint32_t batches = 0;  // > 0: the number of translation units that include the parts' .cpp files
  int level = 1;         // -O of the C++ compiler, unless $CXXFLAGS has another
  uint32_t jobs = 0;
  bool keep = false;            // keep the generated files and report their folder
  bool debug = false;           // with debug information
  std::string views;            // of an executable: PouViews::source
  bool has_call_paths = false;  // a fault tells who called: rung/call_paths.h
};

// A message of g++ about a body that the user wrote in C++, with its original location; the path is a display path.
struct Refusal {
  std::string path;
  uint32_t line, column;
  std::string message;
};

struct NativeResult {
  int exit = kSuccess;  // kSuccess, kUsage, kInternal, or kInputErrors: g++ rejected a body that the user wrote in C++
  std::string message;  // the error
  std::vector<Refusal> refusals;  // kInputErrors: empty when g++ names no location in the body, see `message`
  std::string path;               // the shared object
};

// Compiles and links to a shared object in the cache, or finds it there.
NativeResult makeShared(Cache& cache, const NativeRequest& request, Sink& sink);
// Compiles, links and writes `output`: an executable with the bundled host, a shared or a static library.
NativeResult makeOutput(Cache& cache, const NativeRequest& request, BuildKind kind, const std::string& module_name,
                        const std::string& output, Sink& sink);

// $CXX or g++, split at blanks.
std::vector<std::string> compilerCommand();

}  // namespace rung::driver

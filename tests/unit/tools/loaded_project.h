// SPDX-License-Identifier: Apache-2.0
// Projects in the process of a test, for the interpreter or compiled. In: a file or folder of Rung's sources, or an
// absolute path. Out: a module that can run in a session. Used by tests of sessions.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "tests/unit/tools/text_sink.h"
#include "tools/driver/compile.h"
#include "tools/driver/module_library.h"

namespace rung::driver {

// A number that the environment may set.
inline uint32_t setting(const char* name, uint32_t otherwise) {
  const char* const value = std::getenv(name);
  return value == nullptr ? otherwise : static_cast<uint32_t>(std::strtoul(value, nullptr, 10));
}

// A project in this process.
struct Loaded {
  TextSink sink;
  PhaseTimes times;
  std::unique_ptr<Compilation> compilation;
  std::unique_ptr<ir::interpreter::Program> program;
  ModuleLibrary library;
  const rung_module* module = nullptr;

  Loaded(const std::string& project, Engine engine, bool with_tests = false) {
    ProjectOptions options;
    options.inputs = {project.front() == '/' ? project : std::string(RUNG_SOURCE) + "/" + project};
    options.code.with_tests = with_tests;
    options.code.counts_steps = true;
    compilation = std::make_unique<Compilation>(options, times, sink);
    std::string why;
    if (engine != Engine::Native && compilation->translate(program, why)) {
      module = &program->description();
    } else if (engine == Engine::Native) {
      loadNative();
    }
    if (module == nullptr) {
      compilation->finish();
      ADD_FAILURE() << project << ": " << sink.messages << why;
    }
  }

 private:
  void loadNative() {
    NativeRequest request;
    request.parts.resize(1);
    if (!compilation->emit(request.parts[0].files)) return;
    Cache cache;
    const NativeResult native = makeShared(cache, request, sink);
    std::string error = native.exit == kSuccess ? library.open(native.path) : native.message;
    if (error.empty()) module = library.find(compilation->options.moduleName(), error);
    if (module == nullptr) ADD_FAILURE() << error;
  }
};

}  // namespace rung::driver

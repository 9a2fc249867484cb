// SPDX-License-Identifier: Apache-2.0
// A program that can run in this process: interpreted, or compiled to a shared object. In: a project and the options of
// `rung run`. Out: the module, and what it is part of. Called by run.cpp, for the program and for each version that
// takes over later.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ir/interpreter/program.h"
#include "tools/driver/compile.h"
#include "tools/driver/module_library.h"
#include "tools/driver/native.h"
#include "tools/driver/pou_views.h"

namespace rung::driver {

struct ProgramVersion {
  std::unique_ptr<ir::interpreter::Program> program;  // none: compiled C++
  Cache cache;
  ModuleLibrary library;
  const rung_module* module = nullptr;
  std::string why_compiled;                                // why it is not interpreted, where it could be
  std::vector<std::pair<std::string, std::string>> paths;  // of its files, as the module has them and as messages do
  uint8_t checks = 0;
  bool has_monitor = false;  // set before: its bodies are wanted
  PouViews views;
};

// Compiles a project; returns an exit code. `must_interpret`: what cannot be interpreted is an error.
int makeProgram(const ProjectOptions& project, const RunOptions& options, bool must_interpret, PhaseTimes& times,
                Sink& sink, ProgramVersion& made);

}  // namespace rung::driver

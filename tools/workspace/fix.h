// SPDX-License-Identifier: Apache-2.0
// Applies the fixes of diagnostics until none is left. In: a project, and which fixes. Out: the texts of the files that
// change. A fix after which its diagnostic is still there, or the project has more errors, is taken back: each is tried
// in a workspace first. Called by `rung check --fix` and by the language server.
#pragma once

#include <map>
#include <string>

#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::workspace {

struct FixedFile {
  std::string before, after;
  uint32_t fixes = 0;  // that begin in it
};
struct Fixed {
  std::map<std::string, FixedFile> files;  // by the path with which the project reads them
  std::string error;                       // what is wrong with the options or the project as a whole; else empty
};
// `only`: the path of the file that may change; empty: all may.
Fixed applyFixes(const driver::ProjectOptions& project, driver::FixSet fixes, const std::string& only = {});

// `rung check --fix`: writes the files, or shows the changes, and checks what they are then. Returns the exit code.
int runFix(const driver::ProjectOptions& project, const driver::CheckOptions& options, driver::Sink& sink);

}  // namespace rung::workspace

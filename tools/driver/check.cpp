// SPDX-License-Identifier: Apache-2.0
// `rung check`: parses and checks, writes nothing but diagnostics.
#include <cstdio>

#include "tools/driver/commands.h"
#include "tools/driver/compile.h"

namespace rung::driver {

int runCheck(const ProjectOptions& project, Sink& sink) {
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  // A dump or the verifier needs the IR.
  const bool need_ir = project.code.verify || (!project.code.dump_after.empty() && project.code.dump_after != "parse");
  if (need_ir)
    compilation.lower();
  else
    compilation.check();
  int exit = compilation.finish();
  if (project.time_phases) sink.message(times.table());
  return exit;
}

}  // namespace rung::driver

// `rung check`: parses and checks, writes nothing but diagnostics.
#include <cstdio>

#include "tools/rung/commands.h"
#include "tools/rung/compile.h"

namespace rung::tool {

int runCheck(const Options& options) {
  PhaseTimes times;
  Compilation compilation(options, times);
  // A dump or the verifier needs the IR.
  const bool need_ir = options.verify || (!options.dump_after.empty() && options.dump_after != "parse");
  if (need_ir)
    compilation.lower();
  else
    compilation.check();
  int exit = compilation.finish();
  if (options.time_phases) fputs(times.table().c_str(), stderr);
  return exit;
}

}  // namespace rung::tool

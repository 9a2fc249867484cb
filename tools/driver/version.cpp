// SPDX-License-Identifier: Apache-2.0
// `rung version`: the version, and the paths of the parts that generated code needs.
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/installation.h"

namespace rung::driver {

int runVersion(Sink& sink) {
  const Installation& found = installation();
  std::string text = std::string("rung ") + version() + "\n";
  if (found.error.empty())
    text += "runtime headers: " + found.include + "\nruntime library: " + found.runtime_library + "\n";
  else
    text += found.error + "\n";
  return printResult(sink, text);
}

}  // namespace rung::driver

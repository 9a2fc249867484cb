// `rung version`: the version, and the paths of the parts that generated code needs.
#include "tools/rung/commands.h"
#include "tools/rung/compile.h"
#include "tools/rung/installation.h"

namespace rung::tool {

int runVersion(const Options&) {
  const Installation& found = installation();
  std::string text = std::string("rung ") + version() + "\n";
  if (found.error.empty())
    text += "runtime headers: " + found.include + "\nruntime library: " + found.runtime_library + "\n";
  else
    text += found.error + "\n";
  std::string error = printOut(text);
  return error.empty() ? kSuccess : usageError(error);
}

}  // namespace rung::tool

// Where the parts of Rung are that generated code needs: runtime headers and libraries. They are looked for under
// $RUNG_HOME, beside the executable (bin/../lib, bin/../share/rung/include), and where Rung was built.
// In: nothing. Out: paths, or what is missing. Called by native.cpp and by `rung version`.
#pragma once

#include <string>

namespace rung::tool {

struct Installation {
  std::string include;          // holds rung/module.h
  std::string runtime_library;  // librung_runtime.a
  std::string host_library;     // librung_host.a
  std::string error;            // empty: all found
};
const Installation& installation();

// "0.1.0"
const char* version();

}  // namespace rung::tool

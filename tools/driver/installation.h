// SPDX-License-Identifier: Apache-2.0
// Finds the parts of Rung that generated code needs: runtime headers and libraries. Searched under $RUNG_HOME,
// beside the executable (bin/../lib, bin/../share/rung/include), and where Rung was built.
// Out: paths, or an error that names the missing part. Called by native.cpp and by `rung version`.
#pragma once

#include <string>

namespace rung::driver {

struct Installation {
  std::string include;          // contains rung/module.h
  std::string runtime_library;  // librung_runtime.a
  std::string host_library;     // librung_host.a
  std::string error;            // empty: all found
};
const Installation& installation();
// rung_cam_fit.so, which `rung cam fit` loads; empty: not installed. Where RUNG_HOME is set it is looked for only
// there.
std::string camFitModule();

// "0.2.0"
const char* version();

}  // namespace rung::driver

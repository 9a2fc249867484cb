// SPDX-License-Identifier: Apache-2.0
// rung_add_program() of an installed Rung, moved to another folder: the steps are in
// tests/programs/cmake_project/check.sh.
#include <gtest/gtest.h>

#include <cstdlib>

#include "temporary_folder.h"

namespace rung::tool {
namespace {

TEST(BuildStep, CMakeProjectWithNinjaAndMake) {
  if (system("command -v ninja >/dev/null && command -v make >/dev/null") != 0) GTEST_SKIP() << "no ninja or make";
#ifdef RUNG_SANITIZED
  setenv("LDFLAGS", "-fsanitize=address,undefined", 1);  // as the runtime
#endif
  TemporaryFolder folder;
  const std::string prefix = folder.path() + "/moved prefix";
  const std::string line = "cmake --install '" RUNG_BUILD "' --prefix '" + folder.path() +
                           "/prefix' >/dev/null && mv '" + folder.path() + "/prefix' '" + prefix +
                           "' && '" RUNG_SOURCE "/tests/programs/cmake_project/check.sh' '" + prefix + "'";
  EXPECT_EQ(system(line.c_str()), 0);
}

}  // namespace
}  // namespace rung::tool

// SPDX-License-Identifier: Apache-2.0
// Names that `rung check` accepts never fail in a C++ compiler: the words and where they are used are in
// tests/programs/identifiers/check.sh.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace rung::tool {
namespace {

TEST(Identifiers, WordsOfCAndCppAndPosixInEveryPlace) {
  std::string line = "'" RUNG_SOURCE "/tests/programs/identifiers/check.sh' '" RUNG_EXECUTABLE "' g++";
  if (system("command -v clang++ >/dev/null") == 0) line += " clang++";
  EXPECT_EQ(system(line.c_str()), 0);
}

}  // namespace
}  // namespace rung::tool

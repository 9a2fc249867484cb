// What `rung check` accepts never fails in a C++ compiler for its names: tests/programs/identifiers/check.sh has the
// words and the places.
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

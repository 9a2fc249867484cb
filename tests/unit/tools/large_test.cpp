// SPDX-License-Identifier: Apache-2.0
// Large inputs: linear in time and memory, never quadratic. Each is so large that a quadratic step would take minutes
// where the tool takes well under a second, so the limit of CPU time cannot fail on a slow machine.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "temporary_folder.h"

namespace rung::tool {
namespace {

constexpr rlim_t kSeconds = 20;
#ifdef RUNG_SANITIZED
constexpr long kKilobytes = 1200 * 1024;
#else
constexpr long kKilobytes = 300 * 1024;
#endif
#if defined(RUNG_SANITIZED) || !defined(NDEBUG)
constexpr int kBranches = 5000;  // nested statements of the IR: frames are larger
#else
constexpr int kBranches = 20000;
#endif

struct LargeTest : testing::Test {
  // Runs `rung emit` on the source; returns its exit code, or -1 when it took too long.
  int emit(const std::string& text) {
    const std::string in = folder.write("large.st", text), out = folder.path() + "/out";
    const pid_t child = fork();
    if (child == 0) {
      const rlimit limit = {kSeconds, kSeconds};
      setrlimit(RLIMIT_CPU, &limit);
      if (freopen((folder.path() + "/messages").c_str(), "w", stderr) == nullptr) _exit(99);
      execl(RUNG_TOOL, "rung", "emit", in.c_str(), "-o", out.c_str(), nullptr);
      _exit(99);
    }
    int status = 0;
    rusage usage = {};
    wait4(child, &status, 0, &usage);
    EXPECT_LT(usage.ru_maxrss, kKilobytes);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string messages() const {
    std::ifstream in(folder.path() + "/messages");
    return {std::istreambuf_iterator<char>(in), {}};
  }
  TemporaryFolder folder;
};

std::string repeated(int count, const std::string& text) {  // `#`: the number
  std::string out;
  for (int i = 0; i < count; ++i) {
    for (char c : text) c == '#' ? out += std::to_string(i) : out += c;
  }
  return out;
}

TEST_F(LargeTest, Blocks) {
  EXPECT_EQ(emit(repeated(10000,
                          "FUNCTION_BLOCK B#\nVAR_INPUT x : INT; END_VAR\nVAR n : INT; t : CTU; END_VAR\n"
                          "n := n + x;\nt(CU := n > 3, PV := 7);\nEND_FUNCTION_BLOCK\n") +
                 "VAR_GLOBAL\n" + repeated(10000, "g# : B#;\n") + "END_VAR\nPROGRAM Main\n" +
                 repeated(10000, "g#(x := 1);\n") + "END_PROGRAM\n"),
            0);
}
TEST_F(LargeTest, BlocksThatHoldEachOther) {
  EXPECT_EQ(emit("FUNCTION_BLOCK B\nVAR n : INT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK\n"
                 "FUNCTION_BLOCK B0 VAR b : B; END_VAR b(); END_FUNCTION_BLOCK\n" +
                 [] {
                   std::string out;
                   for (int i = 1; i < 2000; ++i) {
                     const std::string n = std::to_string(i);
                     out += "FUNCTION_BLOCK B" + n + " VAR b : B" + std::to_string(i - 1) +
                            "; END_VAR b(); END_FUNCTION_BLOCK\n";
                   }
                   return out;
                 }() +
                 "PROGRAM Main VAR b : B1999; END_VAR b(); END_PROGRAM\n"),
            0);
}
TEST_F(LargeTest, Variables) {
  EXPECT_EQ(emit("PROGRAM Main\nVAR\n" + repeated(100000, "v# : DINT := 3;\n") + "END_VAR\n" +
                 repeated(50000, "v# := v7 + 1;\n") + "END_PROGRAM\n"),
            0);
}
TEST_F(LargeTest, InstancesInOneBlock) {
  EXPECT_EQ(emit(repeated(5000, "FUNCTION_BLOCK B# VAR n : INT; END_VAR n := 1; END_FUNCTION_BLOCK\n") +
                 "PROGRAM Main\nVAR\n" + repeated(5000, "v#, w#, x#, y# : B#;\n") + "END_VAR\n" +
                 repeated(5000, "v#(); w#();\n") + "END_PROGRAM\n"),
            0);
}
TEST_F(LargeTest, InitialValue) {
  EXPECT_EQ(emit("PROGRAM Main\nVAR a : ARRAY[1..100000] OF DINT := [0" + repeated(99999, ",#") +
                 "]; n : DINT; END_VAR\nn := a[n];\nEND_PROGRAM\n"),
            0);
}
TEST_F(LargeTest, NestedIfs) {
  EXPECT_EQ(emit("PROGRAM Main\nVAR n : INT; END_VAR\n" + repeated(1000, "IF n > # THEN\n") + "n := 1;\n" +
                 repeated(1000, "END_IF;\n") + "END_PROGRAM\n"),
            0);
}
TEST_F(LargeTest, Cases) {
  EXPECT_EQ(emit("PROGRAM Main\nVAR n, m : DINT; END_VAR\nCASE n OF\n" + repeated(50000, "#: m := #;\n") +
                 "END_CASE;\nIF n = -1 THEN m := 1;\n" + repeated(kBranches, "ELSIF n = # THEN m := 2;\n") +
                 "END_IF;\nEND_PROGRAM\n"),
            0);
}
// Deeper than any stack: rejected, quickly and with one error.
TEST_F(LargeTest, Terms) {
  EXPECT_EQ(emit("PROGRAM Main\nVAR n : DINT; END_VAR\nn := n" + repeated(100000, "\n + #") + ";\nEND_PROGRAM\n"), 1);
  EXPECT_NE(messages().find("error[E0220]"), std::string::npos);
}

}  // namespace
}  // namespace rung::tool

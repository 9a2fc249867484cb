// SPDX-License-Identifier: Apache-2.0
// The command line: every form of a value, defaults, mistakes, help, response files.
#include "tools/rung/options.h"
#include "frontend/source/dialect.h"
#include "tools/rung/response_files.h"

#include <gtest/gtest.h>

#include "ir/ir.h"
#include "tests/unit/tools/temporary_folder.h"

namespace rung::tool {
namespace {

CommandLine parsed(const std::vector<std::string>& arguments) {
  CommandLine line;
  EXPECT_EQ(parseCommandLine(arguments, line), "");
  return line;
}
std::string errorOf(const std::vector<std::string>& arguments) {
  CommandLine line;
  return parseCommandLine(arguments, line);
}

TEST(Options, EveryFormOfAValue) {
  EXPECT_EQ(parsed({"emit", "a.st", "-o", "out"}).emit.output, "out");
  EXPECT_EQ(parsed({"emit", "a.st", "-oout"}).emit.output, "out");
  EXPECT_EQ(parsed({"check", "a.st", "--name=x"}).project.name, "x");
  EXPECT_EQ(parsed({"check", "a.st", "--name", "x"}).project.name, "x");
  EXPECT_EQ(parsed({"check", "-O2", "a.st"}).project.code.level, 2);
  EXPECT_EQ(parsed({"run", "-j4", "a.st"}).run.native.jobs, 4u);
  EXPECT_EQ(parsed({"check", "-I", "lib", "-Ilib2", "a.st"}).project.library_paths.size(), 2u);
  EXPECT_EQ(parsed({"check", "--", "-strange.st"}).project.inputs[0], "-strange.st");
}

TEST(Options, Defaults) {
  const ProjectOptions options = parsed({"check", "a.st"}).project;
  EXPECT_EQ(options.dialect, Dialect::Codesys);
  EXPECT_EQ(options.code.checks, ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast);
  EXPECT_EQ(options.code.level, 1);
  EXPECT_EQ(options.report.max_errors, 100u);
  EXPECT_EQ(options.moduleName(), "plc");
}

TEST(Options, Checks) {
  uint8_t checks = 0;
  EXPECT_EQ(parseChecks("none", checks), "");
  EXPECT_EQ(checks, 0);
  EXPECT_EQ(parseChecks("default,overflow", checks), "");
  EXPECT_EQ(checks, ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast | ir::kCheckOverflow);
  EXPECT_EQ(parseChecks("dvi", checks), "unknown check `dvi` in `--checks`; did you mean `div`?");
  EXPECT_NE(parseChecks("", checks), "");
}

TEST(Options, EdgeCoils) {
  EXPECT_EQ(parsed({"check", "a.st"}).project.code.edge_coils, diagram::EdgeCoils::Pulse);
  EXPECT_EQ(parsed({"run", "a.st", "--edge-coils=latch"}).project.code.edge_coils, diagram::EdgeCoils::Latch);
  EXPECT_EQ(parsed({"convert", "--to=st", "-o", "out", "a.st", "--edge-coils", "pulse"}).project.code.edge_coils,
            diagram::EdgeCoils::Pulse);
  EXPECT_NE(errorOf({"graph", "a.st", "--edge-coils=latch"}), "");  // a picture shows what is written
}

TEST(Options, Warnings) {
  const ReportOptions options = parsed({"check", "a.st", "-Wno-W0101", "-Wunused", "-Werror"}).project.report;
  ASSERT_EQ(options.warnings.size(), 2u);
  EXPECT_FALSE(options.warnings[0].on);
  EXPECT_EQ(options.warnings[0].name, "W0101");
  EXPECT_TRUE(options.warnings[1].on);
  EXPECT_TRUE(options.werror);
}

TEST(Options, MistakesSayWhatToDo) {
  EXPECT_EQ(errorOf({"chekc", "a.st"}), "unknown command `chekc`; did you mean `check`? (`rung --help` lists all)");
  EXPECT_EQ(
      errorOf({"check", "--max-error=3", "a.st"}),
      "unknown option `--max-error` of `rung check`; did you mean `--max-errors`? (`rung check --help` lists all)");
  EXPECT_EQ(errorOf({"check", "-o", "x", "a.st"}),
            "`-o` is not an option of `rung check`; it belongs to `rung emit`, `rung build`, `rung convert`, `rung "
            "graph`, `rung cam`");
  EXPECT_EQ(errorOf({"check"}), "");  // the project around the current folder
  EXPECT_EQ(errorOf({"check", "a.st", "--std=iec4"}),
            "`iec4` is not a value of `--std`; it takes iec2|iec3|codesys; did you mean `iec2`?");
  EXPECT_EQ(errorOf({"check", "a.st", "-O3"}), "`3` is not a value of `-O`; it takes 0|1|2");
  EXPECT_EQ(errorOf({"check", "a.st", "--max-errors=many"}),
            "`--max-errors` takes a number from 0 to 1000000000, not `many`");
  EXPECT_EQ(errorOf({"check", "a.st", "--name=9x"}),
            "`9x` is not a C identifier; `--name` takes letters, digits and `_`");
  EXPECT_EQ(errorOf({"check", "a.st", "--name"}), "`--name` needs a value: --name=ID");
  EXPECT_EQ(errorOf({"check", "a.st", "--werror=1"}), "`--werror` takes no value");
  EXPECT_NE(errorOf({"emit", "a.st"}), "");
  EXPECT_NE(errorOf({"emit", "a.st", "--emit=ir", "-o", "x"}), "");
  EXPECT_NE(errorOf({"build", "a.st"}), "");
  EXPECT_NE(errorOf({"build", "a.st", "-o", "x", "--shared", "--static"}), "");
  EXPECT_NE(errorOf({"check", ""}), "");
  EXPECT_NE(errorOf({}), "");
}

TEST(Options, HostOptionsArePassedOn) {
  const RunOptions options = parsed({"run", "a.st", "--cycles", "5", "--set=a=3", "--realtime"}).run;
  EXPECT_EQ(options.host_arguments, (std::vector<std::string>{"--cycles=5", "--set=a=3", "--realtime"}));
}

TEST(Options, HelpFitsAScreen) {
  for (uint32_t i = 0; i < kCommandCount; i++) {
    std::string help = helpText(static_cast<Command>(i));
    size_t lines = 0, column = 0, widest = 0;
    for (char c : help) {
      column = c == '\n' ? 0 : column + 1;
      lines += c == '\n';
      widest = std::max(widest, column);
    }
    EXPECT_LE(lines, 58u) << help;
    EXPECT_LE(widest, 110u) << help;
  }
  EXPECT_TRUE(parsed({"run", "--help"}).help);
  EXPECT_EQ(parsed({"help", "run"}).command, Command::Run);
}

TEST(Options, ResponseFiles) {
  TemporaryFolder folder;
  std::string inner = folder.write("inner", "b.st 'c d.st'\n");
  std::string outer = folder.write("outer", "--name x @" + inner + " \"e\\\"f\" ''");
  std::vector<std::string> arguments = {"check", "@" + outer, "z"};
  EXPECT_EQ(expandResponseFiles(arguments), "");
  EXPECT_EQ(arguments, (std::vector<std::string>{"check", "--name", "x", "b.st", "c d.st", "e\"f", "", "z"}));

  arguments = {"@" + folder.path() + "/none"};
  EXPECT_NE(expandResponseFiles(arguments), "");
  arguments = {"@" + folder.write("self", "@" + folder.path() + "/self")};
  EXPECT_NE(expandResponseFiles(arguments), "");
  arguments = {"@" + folder.write("open", "'abc")};
  EXPECT_NE(expandResponseFiles(arguments), "");
}

}  // namespace
}  // namespace rung::tool

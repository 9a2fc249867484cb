// SPDX-License-Identifier: Apache-2.0
// The export of small projects: files and their description, and Rung accepts what it exported.
#include "tools/conformance/export.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "frontend/source/files.h"
#include "tests/unit/tools/temporary_folder.h"
#include "tools/conformance/trial.h"

namespace rung::conformance {
namespace {

class Export : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"keywords.tsv", "words.tsv", "rules.tsv"})
      root_.write(std::string("tools/conformance/") + name,
                  readFile(std::string(RUNG_SOURCE) + "/tools/conformance/" + name).content);
    root_.write("tools/conformance/kept.tsv", "program\treason\n");
    root_.write("tools/conformance/reasons.tsv", "feature\treason\n");
    root_.write("tests/conformance/features.tsv", "feature\teditions\tname\n1\t\tTable\n1/1\t3+4\tFeature\n");
    root_.write("CHANGELOG.md", "# Changes\n\n## 1.2.3 (2026-01-02)\n");
  }
  void add(const std::string& text) const { root_.write("tests/conformance/language/x/one.st", text); }
  void run(const char* profile) {
    ExportOptions options;
    options.root = root_.path();
    options.folder = root_.path() + "/suite";
    options.profiles = {findProfile(profile)};
    ASSERT_EQ(readTables(options.root, suite_), "");
    ASSERT_EQ(exportSuite(options, suite_), "");
  }
  std::string read(const std::string& name) const { return readFile(file(name)).content; }
  std::string file(const std::string& name) const { return root_.path() + "/suite/" + name; }

  TemporaryFolder root_;
  Suite suite_;
};

TEST_F(Export, ATestIsACaseThatRungPasses) {
  add("// Sums.\n// features: 1/1\n{test}\nPROGRAM sums\nVAR n : INT; done : BOOL; END_VAR\nn := n + 2;\n"
      "ASSERT(n > 0);\nIF n = 4 THEN ASSERT_EQ(6, n + 2); END_IF\ndone := n = 4;\nEND_PROGRAM\n");
  run("ed2-text");
  ASSERT_EQ(suite_.cases.size(), 1u);
  const Case& one = suite_.cases[0];
  EXPECT_EQ(one.id, "ed2-text/x/one/sums");
  EXPECT_EQ(one.purpose, "Sums.");
  EXPECT_EQ(one.cycles, 2);
  // The second check is reached in the second cycle.
  EXPECT_EQ(read("ed2-text/x/one/sums.trace.csv"), "cycle,suite.check_1,suite.check_2\n0,1,0\n1,1,1\n");
  EXPECT_TRUE(check(file(one.source), Dialect::Iec2).errors.empty());
  RunSetting setting;
  setting.cycles = one.cycles;
  setting.watch = one.watch;
  const Ran ran = conformance::run(file(one.source), Dialect::Iec2, setting);
  EXPECT_EQ(ran.exit, 0) << ran.messages;
  ASSERT_EQ(ran.trace.size(), 3u);
  EXPECT_TRUE(ran.trace[2].ends_with(",1,1")) << ran.trace[2];
}

TEST_F(Export, TheCyclesOfTestAdvance) {
  add("// Delay.\n// features: 1/1\n{test}\nPROGRAM delay\nVAR t : TON; END_VAR\nt(IN := TRUE, PT := "
      "T#30ms);\nASSERT(NOT t.Q);\n"
      "TEST_ADVANCE(T#20ms);\nt();\nASSERT(NOT t.Q);\nTEST_ADVANCE(T#10ms);\nt();\nASSERT(t.Q);\nEND_PROGRAM\n");
  run("ed3-text");
  ASSERT_EQ(suite_.cases.size(), 1u);
  EXPECT_EQ(suite_.cases[0].cycles, 4);
  EXPECT_EQ(read("ed3-text/x/one/delay.trace.csv"),
            "cycle,suite.check_1,suite.check_2,suite.check_3\n0,1,0,0\n2,1,1,0\n3,1,1,1\n");
}

TEST_F(Export, AnErrorStandsAloneBesideItsControl) {
  add("// Unknown.\n// features: 1/1\nPROGRAM p\nVAR n : INT; END_VAR\nn := missing;\nIF n > 0 THEN\n  other := "
      "1;\nEND_IF;\nEND_PROGRAM\n"
      "// expect: one.st:5:6: error[E0401]: `missing` is not declared\n// expect: one.st:7:3: error[E0401]: `other` is "
      "not declared\n");
  run("ed2-text");
  ASSERT_EQ(suite_.cases.size(), 2u);
  for (const Case& one : suite_.cases) {
    EXPECT_TRUE(check(file(one.control), Dialect::Iec2).errors.empty()) << read(one.control);
    const std::vector<Complaint> errors = check(file(one.source), Dialect::Iec2).errors;
    ASSERT_EQ(errors.size(), 1u) << read(one.source);
    EXPECT_EQ(errors[0].line, one.line);
    EXPECT_NE(one.rule, "");
  }
  EXPECT_EQ(suite_.cases[0].line, 5u);
  EXPECT_EQ(suite_.cases[1].line, 7u);
}

TEST_F(Export, WhatIsOfEdition3IsNotInEdition2) {
  add("// Long.\n// features: 1/1\n{test}\nPROGRAM long\nVAR t : LTIME; END_VAR\nASSERT_EQ(LTIME#0s, "
      "t);\nEND_PROGRAM\n");
  run("ed2-text");
  EXPECT_TRUE(suite_.cases.empty());
  ASSERT_EQ(suite_.refusals.size(), 1u);
  EXPECT_EQ(suite_.refusals[0].reason, "`LTIME` is of edition 3");
}

TEST_F(Export, ImplicitConversionsAreOfEdition3) {
  const std::string text =
      "// Mixed.\n// features: 1/1\n{test}\nPROGRAM mixed\nVAR i : INT := 1; r : REAL := 1.5; d : DINT; END_VAR\nd := "
      "INT_TO_DINT(i);\n"
      "ASSERT(d = 1);\nr := i;\nASSERT(r > 0.5);\nEND_PROGRAM\n";
  add(text);
  run("ed2-text");
  EXPECT_TRUE(suite_.cases.empty());
  ASSERT_EQ(suite_.refusals.size(), 1u);
  EXPECT_TRUE(suite_.refusals[0].reason.ends_with("an implicit conversion, which is of edition 3"))
      << suite_.refusals[0].reason;
}

TEST_F(Export, AChoiceOfRungIsLeftOut) {
  root_.write("tools/conformance/kept.tsv",
              "program\treason\ntests/conformance/language/x/one.st:open:0 = n\tleft "
              "open\ntests/conformance/language/x/one.st:all\tleft "
              "open, too\n");
  add("// Open.\n// features: 1/1\n{test}\nPROGRAM open\nVAR n : INT; END_VAR\nASSERT_EQ(0, n);\nASSERT(n < "
      "1);\nEND_PROGRAM\n"
      "{test}\nPROGRAM all\nASSERT(TRUE);\nEND_PROGRAM\n");
  run("ed3-text");
  ASSERT_EQ(suite_.cases.size(), 1u);
  EXPECT_EQ(suite_.cases[0].checks, std::vector<std::string>{"n < 1"});
  ASSERT_EQ(suite_.refusals.size(), 1u);
  EXPECT_EQ(suite_.refusals[0].reason, "left open, too");
}

}  // namespace
}  // namespace rung::conformance

// SPDX-License-Identifier: Apache-2.0
// rung.project: all sections, mistakes with their location, tasks as a CONFIGURATION.
#include "tools/driver/project_file.h"
#include "frontend/source/dialect.h"

#include <gtest/gtest.h>

namespace rung::driver {
namespace {

class ProjectFileTest : public testing::Test {
 protected:
  void read(const std::string& text) {
    FileId file = sources.add("rung.project", text);
    parseProjectFile(sources, file, diagnostics, project);
  }
  // "line:column: message" of each.
  std::vector<std::string> messages() {
    diagnostics.sort();
    std::vector<std::string> out;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      SourceLocation location = sources.location(diagnostic.loc);
      out.push_back(std::to_string(location.line) + ":" + std::to_string(location.column) + ": " + diagnostic.message);
    }
    return out;
  }
  Sources sources;
  Diagnostics diagnostics{sources};
  ProjectFile project;
};

TEST_F(ProjectFileTest, AllSections) {
  read(
      "# a press\n[project]\nname = press\nstd = iec2\nchecks = div, index\noptimize = 2\nwarnings = no-W0101\n"
      "[axis feed]\nperiod = 360\n[safe]\nvalve.open = FALSE\n[nc]\nmax_feed = 3\n[pool R]\nsize = 9\n"
      "[module slot1]\ntype = AX_EM_1600D\n");
  EXPECT_EQ(messages(), std::vector<std::string>{});
  EXPECT_EQ(project.name, "press");
  EXPECT_EQ(project.level, 2);
  ASSERT_EQ(project.sections.size(), 6u);
  EXPECT_EQ(project.sections[1].name, "feed");
  EXPECT_EQ(project.sections[1].find("period")->value, "360");

  ProjectOptions options;
  applyProjectFile(project, options);
  EXPECT_EQ(options.dialect, Dialect::Iec2);
  EXPECT_EQ(options.moduleName(), "press");
  ProjectOptions chosen;
  chosen.dialect_given = true;
  chosen.dialect = Dialect::Iec3;
  applyProjectFile(project, chosen);
  EXPECT_EQ(chosen.dialect, Dialect::Iec3);  // the command line wins
}

TEST_F(ProjectFileTest, EdgeCoils) {
  read("[project]\nedge-coils = latch\n");
  EXPECT_EQ(messages(), std::vector<std::string>{});
  ProjectOptions options;
  applyProjectFile(project, options);
  EXPECT_EQ(options.code.edge_coils, diagram::EdgeCoils::Latch);
  ProjectOptions chosen;
  chosen.code.edge_coils_given = true;
  applyProjectFile(project, chosen);
  EXPECT_EQ(chosen.code.edge_coils, diagram::EdgeCoils::Pulse);  // the command line wins
}

TEST_F(ProjectFileTest, MistakesHaveTheirLocation) {
  read("std = iec3\n[projekt]\nx = 1\n[project]\n  nmae = a\nstd=iec9\nwhat\n[task]\n[safe all]\n[project\n");
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "1:1: `std` is before the first section; write `[project]` above it",
                "2:2: unknown section `projekt`",
                "5:3: unknown key `nmae` in section `project`",
                "6:5: wrong value for `std`: `iec9` is not a value of `--std`; it takes iec2|iec3|codesys; did "
                "you mean `iec2`?",
                "7:1: expected `[section]`, `key = value` or `# comment`",
                "8:2: section `task` needs a name; write `[task NAME]`",
                "9:2: section `safe` takes no name; write `[safe]`",
                "10:1: expected `[section]`, `key = value` or `# comment`",
            }));
}

TEST_F(ProjectFileTest, ModulesAreChecked) {
  read(
      "[module a]\ntype = AX_EM_1600\n[module b]\ntype = AE1420_AE2420\nstation = c\n[module c]\ntype = "
      "AX_EM_RCM_ET\n[module d]\ntype = AE1420_AE2420\nstation = C\n[module e]\ntype = ax_em_1600d\nstation = "
      "c\ninputs = %IX3.0\n[module f]\ntype = AX_EM_0016DP\noutputs = %IB3\n[module if]\ntype = AX_EM_0016DP\n"
      "[module g]\ntype = AX_EM_0016DP\noutputs = %QW8\n[module h]\ntype = AX_EM_0016DN\n[module i]\ntype = "
      "AX_EM_0016DN\noutputs = %QB99999999\n");
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "2:8: wrong value for `type`: it takes one of HIGH_PULSE_IO, AX_EM_1600D, AX_EM_0016DP, AX_EM_0016DN, "
                "AX_EM_4AD, AX_EM_4DA, AX_EM_4PTC, AE1420_AE2420, AX_EM_RCM_ET",
                "5:11: wrong value for `station`: it takes the name of a module of type AX_EM_RCM_ET, declared above "
                "this one",
                "9:8: wrong value for `type`: this module is not connected to a station; remove `station`",
                "14:10: wrong value for `inputs`: it takes the address of a byte, such as `%IB48`",
                "17:11: wrong value for `outputs`: it takes the address of a byte, such as `%QB48`",
                "18:1: `if` cannot name a module; it is a keyword",
                "27:11: wrong value for `outputs`: it takes the address of a byte, such as `%QB48`",
            }));
  // The outputs of `h` follow those of `g`.
  ASSERT_EQ(project.io_modules.size(), 6u);
  EXPECT_EQ(project.io_modules[3].module.output_offset, 16u);
  EXPECT_EQ(project.io_modules[4].module.output_offset, 18u);
  EXPECT_EQ(project.io_modules[1].module.station, "c");
}

TEST_F(ProjectFileTest, KeySetTwice) {
  read("[project]\nname = a\nname = b\n");
  EXPECT_EQ(messages(), (std::vector<std::string>{"3:1: duplicate key `name` in this section; remove one"}));
  EXPECT_EQ(project.name, "a");
}

TEST_F(ProjectFileTest, TasksBecomeAConfiguration) {
  read(
      "[task fast]\ninterval = 10ms\npriority = 1\nprograms = Main, second : Other\n[task slow]\nkind = "
      "freewheeling\n");
  EXPECT_EQ(messages(), std::vector<std::string>{});
  EXPECT_EQ(sources.sourceText(project.configuration),
            "CONFIGURATION rung_project RESOURCE rung_project_resource ON PLC\n"
            "TASK fast(INTERVAL := T#10ms, PRIORITY := 1);\nTASK slow(KIND := FREEWHEELING);\n"
            "PROGRAM Main WITH fast : Main;\nPROGRAM second WITH fast : Other;\nEND_RESOURCE END_CONFIGURATION\n");
}

TEST_F(ProjectFileTest, ValuesCannotBreakOutOfTheirPlace) {
  read("[task t]\npriority = 1); PROGRAM x\nprograms = a b\n");
  EXPECT_EQ(messages().size(), 2u);
}

}  // namespace
}  // namespace rung::driver

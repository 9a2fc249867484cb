// SPDX-License-Identifier: Apache-2.0
// Tasks and program instances, with and without a CONFIGURATION.
#include <gtest/gtest.h>

#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

TEST(Configuration, without_one_every_program_runs_each_10_ms) {
  const Checked checked("PROGRAM a END_PROGRAM PROGRAM b END_PROGRAM {test} PROGRAM t END_PROGRAM");
  EXPECT_EQ(checked.codes(), "");
  ASSERT_EQ(checked.project.tasks.size(), 1u);
  EXPECT_EQ(checked.project.tasks[0].interval_ns, 10'000'000);
  EXPECT_EQ(checked.names.string(checked.project.tasks[0].name), "MainTask");
  ASSERT_EQ(checked.project.instances.size(), 2u);
  EXPECT_EQ(checked.names.string(checked.project.instances[1].name), "b");
}

TEST(Configuration, plc_prg_runs_alone) {
  const Checked checked("PROGRAM a END_PROGRAM PROGRAM Plc_Prg END_PROGRAM");
  ASSERT_EQ(checked.project.instances.size(), 1u);
  EXPECT_EQ(checked.names.string(checked.project.instances[0].name), "Plc_Prg");
}

TEST(Configuration, tasks_and_their_settings) {
  const Checked checked(
      "PROGRAM Main END_PROGRAM\n"
      "CONFIGURATION c VAR_GLOBAL go : BOOL; END_VAR\n"
      "RESOURCE r ON cpu\n"
      "TASK fast(INTERVAL := T#500us, PRIORITY := 0, WATCHDOG := T#20ms, SENSITIVITY := 2);\n"
      "TASK ev(SINGLE := go, PRIORITY := 3);\n"
      "TASK st(KIND := STATUS, TRIGGER := go);\n"
      "TASK free(KIND := FREEWHEELING);\n"
      "TASK ext(KIND := EXTERNAL, TRIGGER := ax_interrupt);\n"
      "PROGRAM p WITH fast : Main; PROGRAM q WITH ev : Main;\n"
      "END_RESOURCE END_CONFIGURATION");
  EXPECT_EQ(checked.codes(), "");
  ASSERT_EQ(checked.project.tasks.size(), 5u);
  EXPECT_EQ(checked.project.tasks[0].interval_ns, 500'000);
  EXPECT_EQ(checked.project.tasks[0].watchdog_ns, 20'000'000);
  EXPECT_EQ(checked.project.tasks[1].kind, TaskKind::Event);
  EXPECT_EQ(checked.project.tasks[1].trigger, "go");
  EXPECT_EQ(checked.project.tasks[2].kind, TaskKind::Status);
  EXPECT_EQ(checked.project.tasks[3].kind, TaskKind::Freewheeling);
  EXPECT_EQ(checked.project.tasks[4].external_event, "ax_interrupt");
  ASSERT_EQ(checked.project.instances.size(), 2u);
  EXPECT_EQ(checked.project.instances[1].task, 2u);
  EXPECT_EQ(checked.names.string(checked.project.instances[0].resource), "r");
}

TEST(Configuration, programs_of_one_resource_see_its_globals) {
  const Checked checked(
      "PROGRAM a VAR x : INT; END_VAR x := g; END_PROGRAM\n"
      "PROGRAM b VAR x : REAL; END_VAR x := g; END_PROGRAM\n"
      "CONFIGURATION c\n"
      "RESOURCE r ON cpu VAR_GLOBAL g : INT; go : BOOL; END_VAR\n"
      "TASK t(SINGLE := go); TASK u(SINGLE := p.done); PROGRAM p WITH t : a; END_RESOURCE\n"
      "RESOURCE s ON cpu VAR_GLOBAL g : REAL; go : BOOL; END_VAR\n"
      "TASK t(SINGLE := go); TASK u(SINGLE := %IX1.2); PROGRAM p WITH t : b; END_RESOURCE\n"
      "END_CONFIGURATION");
  EXPECT_EQ(checked.codes(), "E0329@5");
  ASSERT_EQ(checked.project.tasks.size(), 4u);
  EXPECT_EQ(checked.project.tasks[0].trigger, "r.go");
  EXPECT_EQ(checked.project.tasks[2].trigger, "s.go");
  EXPECT_EQ(checked.project.tasks[3].trigger, "%IX1.2");
  EXPECT_EQ(checked.names.string(checked.project.tasks[2].resource), "s");
}

TEST(Configuration, plc_prg_runs_beside_tasks_unless_it_is_called) {
  const std::string tasks = "CONFIGURATION c TASK t(INTERVAL := T#10ms); PROGRAM p WITH t : a; END_CONFIGURATION\n";
  const Checked free(tasks +
                     "PROGRAM PLC_PRG END_PROGRAM PROGRAM a END_PROGRAM\n"
                     "{test} PROGRAM tests PLC_PRG(); END_PROGRAM");
  EXPECT_EQ(free.codes(), "");
  ASSERT_EQ(free.project.tasks.size(), 2u);
  EXPECT_EQ(free.project.tasks[1].kind, TaskKind::Freewheeling);
  EXPECT_EQ(free.project.tasks[1].priority, 31u);
  const Checked called(tasks + "PROGRAM PLC_PRG END_PROGRAM PROGRAM a PLC_PRG(); END_PROGRAM");
  EXPECT_EQ(called.project.tasks.size(), 1u);
}

TEST(Configuration, times_of_the_project_file) {
  Options options;
  options.task_durations = {{"FAST", 5'000'000, {}}};
  const Checked checked(
      "PROGRAM a END_PROGRAM CONFIGURATION c TASK fast(INTERVAL := T#10ms);\n"
      "PROGRAM p WITH fast : a; END_CONFIGURATION",
      options);
  ASSERT_EQ(checked.project.tasks.size(), 1u);
  EXPECT_EQ(checked.project.tasks[0].duration_ns, 5'000'000);
}

TEST(Configuration, mistakes) {
  const Checked checked(
      "PROGRAM Main END_PROGRAM FUNCTION_BLOCK b END_FUNCTION_BLOCK PROGRAM idle END_PROGRAM\n"
      "CONFIGURATION c RESOURCE r ON cpu\n"
      "TASK t(INTERVALL := T#10ms, INTERVAL := T#10ms);\n"
      "TASK u(INTERVAL := T#0s);\n"
      "TASK v(INTERVAL := T#1s, PRIORITY := 99);\n"
      "PROGRAM p WITH tt : Main;\n"
      "PROGRAM q WITH t : b;\n"
      "PROGRAM r : Main;\n"
      "END_RESOURCE END_CONFIGURATION");
  EXPECT_EQ(checked.codes(), "W0824@1 E0811@3 E0818@4 E0816@5 E0815@6 E0814@7 W0823@8");
}

TEST(Configuration, an_instance_without_a_type_is_reported_once) {
  const Checked checked("PROGRAM Main END_PROGRAM\nCONFIGURATION c\nPROGRAM p : ;\nEND_CONFIGURATION");
  EXPECT_EQ(checked.diagnostics.errorCount(), 1u) << checked.messages();
}

}  // namespace
}  // namespace rung::sema

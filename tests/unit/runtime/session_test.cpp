// SPDX-License-Identifier: Apache-2.0
// A session of the sample module: activations and cycles one after the other, commands and faults as values. Nothing is
// printed. Real programs: tests/unit/tools/session_test.cpp.
#include "stdlib/runtime/host/session.h"

#include <gtest/gtest.h>

#include "sample_module.h"

using namespace rung::host;

namespace {

Command commandOf(Command::Kind kind) {
  Command command;
  command.kind = kind;
  return command;
}

struct Sessions : testing::Test {
  Session session{sample::module(), {}, {}};

  Sessions() {
    std::string error;
    EXPECT_TRUE(session.load(error)) << error;
    EXPECT_TRUE(session.init().isComplete());
    EXPECT_TRUE(session.begin().isComplete());
    sample::ran.clear();
  }
  sample::Main& main() { return *reinterpret_cast<sample::Main*>(session.memory().block(0)); }
  Ending cycle() {
    const Ending ending = session.cycle();
    if (ending.isComplete()) session.completeCycle();
    return ending;
  }
};

TEST_F(Sessions, ActivationsRunOneAtATime) {
  main().start_event = 1;
  Ending ending;
  EXPECT_TRUE(session.activate(ending));
  EXPECT_EQ(sample::ran, "e");
  EXPECT_TRUE(session.activate(ending));
  EXPECT_EQ(sample::ran, "es");
  EXPECT_TRUE(session.activate(ending));
  EXPECT_EQ(sample::ran, "esf");
  EXPECT_FALSE(session.activate(ending));
  EXPECT_TRUE(ending.isComplete());
  EXPECT_FALSE(session.activate(ending));  // the cycle waits to be completed
  session.completeCycle();
  EXPECT_TRUE(session.activate(ending));
  EXPECT_EQ(sample::ran, "esff");
  EXPECT_EQ(session.cyclesDone(), 1);
  EXPECT_EQ(session.nowNs(), 10'000'000);
}

TEST_F(Sessions, ACycleCompletesWhatAnActivationBegan) {
  Ending ending;
  EXPECT_TRUE(session.activate(ending));
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(sample::ran, "sf");
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(sample::ran, "sff");
}

TEST_F(Sessions, AFaultIsAValueAndAResetGoesOn) {
  EXPECT_TRUE(cycle().isComplete());
  main().divisor = 0;
  const Ending ending = cycle();
  ASSERT_EQ(ending.kind, Ending::Faulted);
  EXPECT_EQ(ending.fault.kind, RUNG_FAULT_DIV);
  EXPECT_EQ(ending.context, &session.context());
  EXPECT_EQ(session.cyclesDone(), 1);
  Command reset = commandOf(Command::Reset);
  reset.start = RUNG_WARM;
  EXPECT_TRUE(session.obey(reset).goes_on);
  EXPECT_TRUE(session.isStopped());
  EXPECT_EQ(main().divisor, 1);
  EXPECT_EQ(main().kept, 6);  // 5 at first, and one cycle
  EXPECT_TRUE(session.obey(commandOf(Command::Start)).goes_on);
  sample::ran.clear();
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(sample::ran, "sf");
  EXPECT_EQ(main().count, 10);
}

TEST_F(Sessions, AStoppedProgramHasSafeOutputsAndRunsSingleCycles) {
  EXPECT_TRUE(cycle().isComplete());
  const uint8_t* const outputs = session.memory().area(1);
  EXPECT_EQ(outputs[0], 4);
  EXPECT_TRUE(session.obey(commandOf(Command::Stop)).goes_on);
  EXPECT_EQ(outputs[0], 0);
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(main().count, 10);
  EXPECT_EQ(session.cyclesDone(), 2);
  EXPECT_TRUE(session.obey(commandOf(Command::Cycle)).goes_on);
  EXPECT_TRUE(session.isSingleCycle());
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(main().count, 20);
  EXPECT_EQ(outputs[0], 4);
  session.stopAfterSingleCycle();
  EXPECT_TRUE(session.isStopped());
  EXPECT_EQ(outputs[0], 0);
}

TEST_F(Sessions, CommandsAnswerWithTexts) {
  Command event = commandOf(Command::Event);
  event.event = "nobody";
  EXPECT_EQ(session.obey(event).warning, "no task waits for the event `nobody`");
  EXPECT_TRUE(cycle().isComplete());
  const Answer status = session.obey(commandOf(Command::Status));
  EXPECT_EQ(status.text.compare(0, 26, "task Slow: 1 activations, "), 0) << status.text;
  EXPECT_FALSE(session.obey(commandOf(Command::Quit)).goes_on);
}

TEST_F(Sessions, AStateUndoesAFault) {
  const SessionState before = session.save();
  main().divisor = 0;
  EXPECT_EQ(cycle().kind, Ending::Faulted);
  session.restore(before);
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(main().count, 10);
}

TEST_F(Sessions, InitBeginsAgain) {
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_TRUE(session.obey(commandOf(Command::Stop)).goes_on);
  EXPECT_TRUE(session.end().isComplete());
  EXPECT_TRUE(session.init().isComplete());
  EXPECT_TRUE(session.begin().isComplete());
  EXPECT_FALSE(session.isStopped());
  EXPECT_EQ(session.cyclesDone(), 0);
  EXPECT_EQ(main().count, 0);
  sample::ran.clear();
  EXPECT_TRUE(cycle().isComplete());
  EXPECT_EQ(sample::ran, "sf");
  EXPECT_EQ(session.nowNs(), 0);
  EXPECT_EQ(session.tasks().stateOf(session.tasks().all()[1]).activations, 1u);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// The state machine of CiA 402 by the table of IEC 61800-7-201: every transition, every state times every command.
#include "drive/state_machine.h"

#include <gtest/gtest.h>

#include "drive_fixture.h"

namespace rung::motion {
namespace {

constexpr uint16_t kShutdown = 0x06, kSwitchOnCommand = 0x07, kEnable = 0x0F, kDisableVoltage = 0x00, kQuickStop = 0x02;
constexpr DriveEvents kQuiet = {false, true, true, false, false};

struct Row {
  DriveState from;
  uint16_t controlword;
  int transition;
};

// All states that wait for a command, times all commands.
constexpr Row kRows[] = {
    {DriveState::SwitchOnDisabled, kShutdown, 2},
    {DriveState::SwitchOnDisabled, kSwitchOnCommand, -1},
    {DriveState::SwitchOnDisabled, kEnable, -1},
    {DriveState::SwitchOnDisabled, kDisableVoltage, -1},
    {DriveState::SwitchOnDisabled, kQuickStop, -1},
    {DriveState::ReadyToSwitchOn, kShutdown, -1},
    {DriveState::ReadyToSwitchOn, kSwitchOnCommand, 3},
    {DriveState::ReadyToSwitchOn, kEnable, 3},
    {DriveState::ReadyToSwitchOn, kDisableVoltage, 7},
    {DriveState::ReadyToSwitchOn, kQuickStop, 7},
    {DriveState::SwitchedOn, kShutdown, 6},
    {DriveState::SwitchedOn, kSwitchOnCommand, -1},
    {DriveState::SwitchedOn, kEnable, 4},
    {DriveState::SwitchedOn, kDisableVoltage, 10},
    {DriveState::SwitchedOn, kQuickStop, 10},
    {DriveState::OperationEnabled, kShutdown, 8},
    {DriveState::OperationEnabled, kSwitchOnCommand, 5},
    {DriveState::OperationEnabled, kEnable, -1},
    {DriveState::OperationEnabled, kDisableVoltage, 9},
    {DriveState::OperationEnabled, kQuickStop, 11},
    {DriveState::QuickStopActive, kDisableVoltage, 12},
    {DriveState::QuickStopActive, kQuickStop, 12},  // the stop has ended, and the option does not stay
};

TEST(StateMachine, EveryStateTimesEveryCommand) {
  for (const Row& row : kRows)
    EXPECT_EQ(row.transition, transitionOf(row.from, row.controlword, row.controlword, kQuiet))
        << static_cast<int>(row.from) << " with " << row.controlword;
}

TEST(StateMachine, LeadsToTheStatesOfTheStandard) {
  constexpr DriveState kTargets[] = {
      DriveState::NotReadyToSwitchOn, DriveState::SwitchOnDisabled,    DriveState::ReadyToSwitchOn,
      DriveState::SwitchedOn,         DriveState::OperationEnabled,    DriveState::SwitchedOn,
      DriveState::ReadyToSwitchOn,    DriveState::SwitchOnDisabled,    DriveState::ReadyToSwitchOn,
      DriveState::SwitchOnDisabled,   DriveState::SwitchOnDisabled,    DriveState::QuickStopActive,
      DriveState::SwitchOnDisabled,   DriveState::FaultReactionActive, DriveState::Fault,
      DriveState::SwitchOnDisabled,   DriveState::OperationEnabled};
  for (int transition = 0; transition <= 16; ++transition)
    EXPECT_EQ(kTargets[transition], stateAfter(transition)) << transition;
}

TEST(StateMachine, AutomaticTransitions) {
  EXPECT_EQ(1, transitionOf(DriveState::NotReadyToSwitchOn, 0, 0, kQuiet));
  EXPECT_EQ(14, transitionOf(DriveState::FaultReactionActive, kEnable, kEnable, kQuiet));
}

TEST(StateMachine, AFaultComesFromEveryOtherState) {
  DriveEvents events = kQuiet;
  events.fault = true;
  for (const DriveState state :
       {DriveState::NotReadyToSwitchOn, DriveState::SwitchOnDisabled, DriveState::ReadyToSwitchOn,
        DriveState::SwitchedOn, DriveState::OperationEnabled, DriveState::QuickStopActive})
    EXPECT_EQ(13, transitionOf(state, kEnable, kEnable, events));
  EXPECT_EQ(-1, transitionOf(DriveState::Fault, 0x80, 0, events)) << "the cause is still there";
}

TEST(StateMachine, AFaultIsResetByARisingEdge) {
  EXPECT_EQ(15, transitionOf(DriveState::Fault, 0x80, 0x00, kQuiet));
  EXPECT_EQ(-1, transitionOf(DriveState::Fault, 0x80, 0x80, kQuiet));
  EXPECT_EQ(-1, transitionOf(DriveState::Fault, kEnable, 0x80, kQuiet));
}

TEST(StateMachine, StopsWaitForTheirRamp) {
  DriveEvents moving = kQuiet;
  moving.ramp_done = false;
  moving.slows_down = true;
  EXPECT_EQ(-1, transitionOf(DriveState::OperationEnabled, kSwitchOnCommand, kEnable, moving));
  EXPECT_EQ(-1, transitionOf(DriveState::OperationEnabled, kShutdown, kEnable, moving));
  EXPECT_EQ(9, transitionOf(DriveState::OperationEnabled, kDisableVoltage, kEnable, moving));
  EXPECT_EQ(-1, transitionOf(DriveState::QuickStopActive, kQuickStop, kQuickStop, moving));
  EXPECT_EQ(12, transitionOf(DriveState::QuickStopActive, kDisableVoltage, kQuickStop, moving));
  EXPECT_EQ(-1, transitionOf(DriveState::FaultReactionActive, kEnable, kEnable, moving));
  moving.slows_down = false;
  EXPECT_EQ(5, transitionOf(DriveState::OperationEnabled, kSwitchOnCommand, kEnable, moving));
}

TEST(StateMachine, AQuickStopThatStaysIsLeftByEnable) {
  DriveEvents stays = kQuiet;
  stays.stays_stopped = true;
  EXPECT_EQ(-1, transitionOf(DriveState::QuickStopActive, kQuickStop, kQuickStop, stays));
  EXPECT_EQ(16, transitionOf(DriveState::QuickStopActive, kEnable, kQuickStop, stays));
}

TEST(StateMachine, NeedsTheSupplyToSwitchOn) {
  DriveEvents dead = kQuiet;
  dead.power = false;
  EXPECT_EQ(-1, transitionOf(DriveState::ReadyToSwitchOn, kSwitchOnCommand, kShutdown, dead));
  EXPECT_EQ(7, transitionOf(DriveState::ReadyToSwitchOn, kDisableVoltage, kShutdown, dead));
}

TEST(StateMachine, StatuswordOfEachState) {
  // Masks 4Fh or 6Fh of the standard.
  EXPECT_EQ(0x00, statusBits(DriveState::NotReadyToSwitchOn) & 0x4F);
  EXPECT_EQ(0x40, statusBits(DriveState::SwitchOnDisabled) & 0x4F);
  EXPECT_EQ(0x21, statusBits(DriveState::ReadyToSwitchOn) & 0x6F);
  EXPECT_EQ(0x23, statusBits(DriveState::SwitchedOn) & 0x6F);
  EXPECT_EQ(0x27, statusBits(DriveState::OperationEnabled) & 0x6F);
  EXPECT_EQ(0x07, statusBits(DriveState::QuickStopActive) & 0x6F);
  EXPECT_EQ(0x0F, statusBits(DriveState::FaultReactionActive) & 0x4F);
  EXPECT_EQ(0x08, statusBits(DriveState::Fault) & 0x4F);
}

}  // namespace
}  // namespace rung::motion

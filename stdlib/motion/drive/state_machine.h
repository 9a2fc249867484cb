// SPDX-License-Identifier: Apache-2.0
// The state machine of a CiA 402 drive: which transition a controlword and the events in the drive cause, and which
// bits of the statusword a state has. Without memory and time: the caller keeps the state. Called by
// simulated_drive.cpp. IEC 61800-7-201, state machine, transitions 0 to 16.
#pragma once

#include <stdint.h>

namespace rung::motion {

enum class DriveState : int16_t {
  NotReadyToSwitchOn,
  SwitchOnDisabled,
  ReadyToSwitchOn,
  SwitchedOn,
  OperationEnabled,
  QuickStopActive,
  FaultReactionActive,
  Fault
};

// Bits of the controlword that the state machine reads.
enum ControlBit : uint16_t {
  kSwitchOn = 1,
  kEnableVoltage = 2,
  kNoQuickStop = 4,
  kEnableOperation = 8,
  kFaultReset = 128,
  kHalt = 256
};

// An event in the drive.
struct DriveEvents {
  bool fault;          // an error is present
  bool power;          // the motor has its supply
  bool ramp_done;      // the motion that a transition waits for has ended
  bool stays_stopped;  // the quick stop option keeps the state Quick stop active
  bool slows_down;     // the option of the transition asked for stops the motor first: the transition waits for it
};

// The transition that the controlword asks for in a state, before any event: 2 to 12; -1: none.
int pendingTransition(DriveState state, uint16_t controlword);

// The number of the transition to be taken now, 0 to 16; -1: none. `last` is the controlword of the step before: a
// fault is reset by a rising edge.
int transitionOf(DriveState state, uint16_t controlword, uint16_t last, const DriveEvents& events);

// The state that a transition leads to.
DriveState stateAfter(int transition);

// Bits 0 to 3, 5 and 6 of the statusword.
uint16_t statusBits(DriveState state);

// The motor has power.
bool isPowered(DriveState state);

}  // namespace rung::motion

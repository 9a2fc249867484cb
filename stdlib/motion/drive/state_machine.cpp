// SPDX-License-Identifier: Apache-2.0
// The state machine of CiA 402: see state_machine.h.
#include "drive/state_machine.h"

namespace rung::motion {
namespace {

enum class Command { None, Shutdown, SwitchOn, EnableOperation, DisableVoltage, QuickStop };

// IEC 61800-7-201, commands in the controlword. The command Disable operation is Switch on, without Enable operation.
Command commandOf(uint16_t controlword) {
  if ((controlword & kEnableVoltage) == 0) return Command::DisableVoltage;
  if ((controlword & kNoQuickStop) == 0) return Command::QuickStop;
  if ((controlword & kSwitchOn) == 0) return Command::Shutdown;
  return (controlword & kEnableOperation) == 0 ? Command::SwitchOn : Command::EnableOperation;
}

int ofSwitchedOn(Command command) {
  switch (command) {
    case Command::EnableOperation: return 4;
    case Command::Shutdown: return 6;
    case Command::DisableVoltage:
    case Command::QuickStop: return 10;
    case Command::None:
    case Command::SwitchOn: return -1;
  }
  return -1;
}

int ofOperationEnabled(Command command) {
  switch (command) {
    case Command::SwitchOn: return 5;
    case Command::Shutdown: return 8;
    case Command::DisableVoltage: return 9;
    case Command::QuickStop: return 11;
    case Command::None:
    case Command::EnableOperation: return -1;
  }
  return -1;
}

}  // namespace

int pendingTransition(DriveState state, uint16_t controlword) {
  const Command command = commandOf(controlword);
  switch (state) {
    case DriveState::SwitchOnDisabled: return command == Command::Shutdown ? 2 : -1;
    case DriveState::ReadyToSwitchOn:
      if (command == Command::DisableVoltage || command == Command::QuickStop) return 7;
      return command == Command::SwitchOn || command == Command::EnableOperation ? 3 : -1;
    case DriveState::SwitchedOn: return ofSwitchedOn(command);
    case DriveState::OperationEnabled: return ofOperationEnabled(command);
    case DriveState::QuickStopActive:
      return command == Command::DisableVoltage ? 12 : command == Command::EnableOperation ? 16 : -1;
    case DriveState::NotReadyToSwitchOn:
    case DriveState::FaultReactionActive:
    case DriveState::Fault: return -1;
  }
  return -1;
}

int transitionOf(DriveState state, uint16_t controlword, uint16_t last, const DriveEvents& events) {
  const bool has_stopped = !events.slows_down || events.ramp_done;
  if (events.fault && state != DriveState::FaultReactionActive && state != DriveState::Fault) return 13;
  const int pending = pendingTransition(state, controlword);
  switch (state) {
    case DriveState::NotReadyToSwitchOn: return 1;
    case DriveState::SwitchOnDisabled:
    case DriveState::SwitchedOn: return pending;
    case DriveState::ReadyToSwitchOn: return pending == 3 && !events.power ? -1 : pending;
    case DriveState::OperationEnabled: return (pending == 5 || pending == 8) && !has_stopped ? -1 : pending;
    case DriveState::QuickStopActive:
      if (pending == 12) return 12;
      if (!events.ramp_done) return -1;
      return !events.stays_stopped ? 12 : pending;
    case DriveState::FaultReactionActive: return has_stopped ? 14 : -1;
    case DriveState::Fault: {
      const bool reset = (controlword & kFaultReset) != 0 && (last & kFaultReset) == 0;
      return reset && !events.fault ? 15 : -1;
    }
  }
  return -1;
}

DriveState stateAfter(int transition) {
  switch (transition) {
    case 0: return DriveState::NotReadyToSwitchOn;
    case 2:
    case 6:
    case 8: return DriveState::ReadyToSwitchOn;
    case 3:
    case 5: return DriveState::SwitchedOn;
    case 4:
    case 16: return DriveState::OperationEnabled;
    case 11: return DriveState::QuickStopActive;
    case 13: return DriveState::FaultReactionActive;
    case 14: return DriveState::Fault;
    default: return DriveState::SwitchOnDisabled;  // 1, 7, 9, 10, 12, 15
  }
}

uint16_t statusBits(DriveState state) {
  switch (state) {
    case DriveState::NotReadyToSwitchOn: return 0x00;
    case DriveState::SwitchOnDisabled: return 0x40;
    case DriveState::ReadyToSwitchOn: return 0x21;
    case DriveState::SwitchedOn: return 0x23;
    case DriveState::OperationEnabled: return 0x27;
    case DriveState::QuickStopActive: return 0x07;
    case DriveState::FaultReactionActive: return 0x0F;
    case DriveState::Fault: return 0x08;
  }
  return 0;
}

bool isPowered(DriveState state) {
  return state == DriveState::OperationEnabled || state == DriveState::QuickStopActive ||
         state == DriveState::FaultReactionActive;
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// The simulated drive: see drive.h. A cycle is: fieldbus, process data in, state machine, motion, process data out.
#include <math.h>
#include <string.h>

#include "drive/drive.h"
#include "drive/errors.h"
#include "drive/modes.h"
#include "drive/objects.h"
#include "drive/probes.h"
#include "drive/process_data.h"
#include "drive/state_machine.h"
#include "fieldbus/coe.h"

namespace rung::motion {
namespace {

using fieldbus::EcatState;

DriveState stateOf(const SimulatedDrive& drive) { return static_cast<DriveState>(drive.state_); }

void start(SimulatedDrive& drive) {
  drive.started_ = 1;
  drive.zero_ = -static_cast<double>(drive.start_position_);
  drive.bus_state_ = static_cast<uint8_t>(EcatState::Init);
  mapDefault(drive, drive.mapped_);
}

void enterBusState(SimulatedDrive& drive, EcatState state) {
  drive.bus_state_ = static_cast<uint8_t>(state);
  drive.exchanged_ = fieldbus::sendsInputs(state) ? mappedObjects(drive) : 0;
  if (fieldbus::sendsInputs(state)) layOut(drive);
}

// The master brings the slave to the state asked for, step by step.
void runFieldbus(SimulatedDrive& drive) {
  if (drive.communication_lost_) {
    drive.bus_wait_ = 0;
    return enterBusState(drive, EcatState::Init);
  }
  while (drive.bus_state_ != drive.requested_state_) {
    if (drive.bus_wait_ < drive.bus_cycles_) {
      ++drive.bus_wait_;
      return;
    }
    const auto now = static_cast<EcatState>(drive.bus_state_);
    const uint8_t wanted = drive.requested_state_;
    const uint8_t next = fieldbus::isState(wanted)
                             ? static_cast<uint8_t>(fieldbus::nextState(now, static_cast<EcatState>(wanted)))
                             : wanted;
    const fieldbus::AlStatus status = fieldbus::requestState({now, drive.bus_error_ != 0}, next);
    enterBusState(drive, status.state);
    drive.bus_error_ = status.error ? 1 : 0;
    drive.bus_wait_ = 0;
    if (status.error) return;
  }
  drive.bus_wait_ = 0;
}

void noteErrors(SimulatedDrive& drive) {
  const DriveState state = stateOf(drive);
  const bool has_supply = state == DriveState::SwitchedOn || isPowered(state);
  const double timeout = drive.following_error_timeout_ * 1e-3;
  if (drive.fault_code_ != 0) drive.error_ = drive.fault_code_;
  if (drive.error_ != 0) return;
  if (drive.power_lost_ && has_supply) drive.error_ = kUndervoltage;
  if (drive.communication_lost_ && isPowered(state)) drive.error_ = kCommunication;
  if (drive.following_time_ > 0 && drive.following_time_ > timeout) drive.error_ = kFollowingError;
}

// The options of the stop that leads out of the state, by the command that is pending.
int stopOption(const SimulatedDrive& drive) {
  switch (stateOf(drive)) {
    case DriveState::QuickStopActive: return drive.quick_stop_option_;
    case DriveState::FaultReactionActive: return drive.power_lost_ ? 0 : drive.fault_option_;
    case DriveState::OperationEnabled:
      switch (pendingTransition(DriveState::OperationEnabled, drive.controlword_)) {
        case 5: return drive.disable_option_;
        case 8: return drive.shutdown_option_;
        default: return 0;
      }
    default: return 0;
  }
}

DriveEvents eventsOf(const SimulatedDrive& drive) {
  const DriveState state = stateOf(drive);
  const bool is_in_fault = state == DriveState::Fault || state == DriveState::FaultReactionActive;
  const int option = stopOption(drive);
  DriveEvents events = {};
  events.fault = is_in_fault ? drive.fault_code_ != 0 : drive.error_ != 0;
  events.power = !drive.power_lost_;
  events.ramp_done = drive.demand_velocity_ == 0 || option == 0;
  events.stays_stopped = drive.quick_stop_option_ >= 5;
  events.slows_down = option != 0;
  return events;
}

void enter(SimulatedDrive& drive, DriveState state, int transition) {
  const bool was_powered = isPowered(stateOf(drive));
  drive.state_ = static_cast<int16_t>(state);
  if (transition == 15) drive.error_ = 0;
  if (transition == 13 && !was_powered) drive.demand_velocity_ = 0;
  if (isPowered(state) != was_powered || transition == 11 || transition == 13 || transition == 16) resetModes(drive);
}

void runStateMachine(SimulatedDrive& drive) {
  noteErrors(drive);
  const int transition = transitionOf(stateOf(drive), drive.controlword_, drive.last_controlword_, eventsOf(drive));
  if (transition >= 0) enter(drive, stateAfter(transition), transition);
}

void takeMode(SimulatedDrive& drive) {
  switch (static_cast<DriveMode>(drive.mode_)) {
    case DriveMode::None:
    case DriveMode::ProfilePosition:
    case DriveMode::ProfileVelocity:
    case DriveMode::Homing:
    case DriveMode::CyclicPosition:
    case DriveMode::CyclicVelocity:
    case DriveMode::CyclicTorque:
      if (drive.mode_ != drive.mode_display_) resetModes(drive);
      drive.mode_display_ = drive.mode_;
  }
}

// Tells whether the drive stops by itself now, and how.
bool brakesNow(const SimulatedDrive& drive, Braking* braking) {
  const DriveState state = stateOf(drive);
  const bool stops = state == DriveState::QuickStopActive || state == DriveState::FaultReactionActive ||
                     (state == DriveState::OperationEnabled && pendingTransition(state, drive.controlword_) >= 0);
  const bool halts = state == DriveState::OperationEnabled && (drive.controlword_ & kHalt) != 0;
  if (stops) *braking = brakingOf(drive, stopOption(drive));
  if (!stops && halts) *braking = brakingOf(drive, drive.halt_option_);
  return stops || halts;
}

// Without power the brake holds the machine.
void stand(SimulatedDrive& drive) {
  drive.demand_ = drive.machine_position_;
  drive.demand_velocity_ = 0;
  drive.machine_velocity_ = 0;
  drive.torque_ = 0;
}

}  // namespace

void stepDrive(SimulatedDrive& drive, rung_drive& data, double seconds) {
  if (!drive.started_) start(drive);
  ++drive.steps_;
  runFieldbus(drive);
  const auto bus_state = static_cast<EcatState>(drive.bus_state_);
  bool is_exchanged = fieldbus::takesOutputs(bus_state);
  data.mapped = drive.exchanged_;
  drive.working_counter_ = 0;
  if (is_exchanged) is_exchanged = exchangeOutputs(drive, data);
  takeMode(drive);
  runStateMachine(drive);

  const double from = drive.machine_position_;
  Braking braking = {};
  const bool is_braking = brakesNow(drive, &braking);
  if (isPowered(stateOf(drive)))
    runMode(drive, is_braking ? &braking : nullptr, seconds);
  else
    stand(drive);
  latchProbes(drive, {from, drive.machine_position_}, drive.inputs_);
  drive.inputs_ = inputsAt(drive, drive.machine_position_);
  drive.last_controlword_ = drive.controlword_;

  constexpr unsigned kVoltage = 0x10, kRemote = 0x200;
  unsigned status = statusBits(stateOf(drive)) | (drive.power_lost_ ? 0 : kVoltage) | kRemote;
  if (isPowered(stateOf(drive))) status |= modeStatus(drive, is_braking);
  drive.statusword_ = static_cast<uint16_t>(status);
  if (fieldbus::sendsInputs(bus_state) && !exchangeInputs(drive, data)) is_exchanged = false;
  data.communication = is_exchanged ? 1 : 0;
}

namespace {

bool isUnderWay(const SimulatedDrive& drive, const rung_object_access& access) {
  return drive.sdo_busy_ && drive.sdo_index_ == access.index && drive.sdo_subindex_ == access.subindex &&
         drive.sdo_length_ == access.length && (drive.sdo_write_ != 0) == (access.is_write != 0) &&
         (!access.is_write || drive.sdo_value_ == access.value);
}

void begin(SimulatedDrive& drive, const rung_object_access& access) {
  drive.sdo_busy_ = 1;
  drive.sdo_began_ = drive.steps_;
  drive.sdo_index_ = access.index;
  drive.sdo_subindex_ = access.subindex;
  drive.sdo_length_ = access.length;
  drive.sdo_write_ = access.is_write != 0 ? 1 : 0;
  drive.sdo_value_ = access.value;
}

int64_t resultOf(uint32_t abort) {
  switch (abort) {
    case fieldbus::kSdoOk: return RUNG_OBJECT_DONE;
    case fieldbus::kSdoNoObject:
    case fieldbus::kSdoNoSubindex:
    case fieldbus::kSdoLength: return RUNG_OBJECT_UNKNOWN;
    case fieldbus::kSdoReadOnly:
    case fieldbus::kSdoWriteOnly: return RUNG_OBJECT_READ_ONLY;
    case fieldbus::kSdoTimeout: return RUNG_OBJECT_FAILED;
    default: return RUNG_OBJECT_RANGE;
  }
}

// One expedited transfer by mailbox: the master's request, and what the drive answers.
int64_t transfer(SimulatedDrive& drive, const rung_object_access& access, uint32_t* value) {
  constexpr size_t kMailbox = 128;
  uint8_t request[kMailbox], answer[kMailbox], bytes[4];
  fieldbus::SdoTransfer client, server = {};
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<uint8_t>(access.value >> 8 * i);
  drive.mailbox_counter_ = fieldbus::nextCounter(drive.mailbox_counter_);
  const size_t size =
      access.is_write != 0
          ? fieldbus::beginDownload(client, access.index, access.subindex, bytes, access.length, drive.mailbox_counter_,
                                    request, kMailbox)
          : fieldbus::beginUpload(client, access.index, access.subindex, drive.mailbox_counter_, request);
  const size_t answered = fieldbus::answerSdo(server, dictionaryOf(drive), request, size, answer, kMailbox);
  const fieldbus::SdoProgress progress =
      fieldbus::continueSdo(client, answer, answered, drive.mailbox_counter_, request, kMailbox);
  if (!progress.is_done) return RUNG_OBJECT_UNKNOWN;  // longer than 4 bytes
  if (progress.abort != fieldbus::kSdoOk) return resultOf(progress.abort);
  if (access.is_write != 0) return RUNG_OBJECT_DONE;
  if (client.size != access.length) return RUNG_OBJECT_UNKNOWN;
  *value = 0;
  for (size_t i = 0; i < client.size; ++i) *value |= uint32_t{client.bytes[i]} << 8 * i;
  return RUNG_OBJECT_DONE;
}

bool isLength(unsigned bytes) { return bytes == 1 || bytes == 2 || bytes == 4; }

}  // namespace

int64_t accessObject(SimulatedDrive& drive, const rung_object_access& access, uint32_t* value) {
  if (!isLength(access.length)) return RUNG_OBJECT_UNKNOWN;
  if (!drive.started_) start(drive);
  if (!isUnderWay(drive, access)) begin(drive, access);
  const bool has_mailbox = fieldbus::hasMailbox(static_cast<EcatState>(drive.bus_state_)) && !drive.sdo_silent_;
  const uint32_t passed = drive.steps_ - drive.sdo_began_;
  if (!has_mailbox || drive.communication_lost_) {
    if (passed < drive.sdo_timeout_) return RUNG_OBJECT_BUSY;
    drive.sdo_busy_ = 0;
    return RUNG_OBJECT_FAILED;
  }
  if (passed < drive.sdo_cycles_) return RUNG_OBJECT_BUSY;
  drive.sdo_busy_ = 0;
  return transfer(drive, access, value);
}

}  // namespace rung::motion

extern "C" {

void rung_sm3_basic_SIMULATED_DRIVE__step(rung_context*, rung_sm3_basic::SIMULATED_DRIVE_type* self, void* drive,
                                          double seconds) {
  static_assert(sizeof(rung_sm3_basic::RUNG_DRIVE_type) == sizeof(rung_drive), "RUNG_DRIVE is a rung_drive");
  rung_drive data;
  memcpy(&data, drive, sizeof data);
  rung::motion::stepDrive(*self, data, seconds);
  memcpy(drive, &data, sizeof data);
}

int32_t rung_sm3_basic_SIMULATED_DRIVE__access(rung_context*, rung_sm3_basic::SIMULATED_DRIVE_type* self,
                                               uint16_t index, uint8_t subindex, uint8_t length, uint8_t is_write,
                                               uint32_t* value) {
  const rung_object_access access = {index, subindex, length, is_write, *value};
  return static_cast<int32_t>(rung::motion::accessObject(*self, access, value));
}

}  // extern "C"

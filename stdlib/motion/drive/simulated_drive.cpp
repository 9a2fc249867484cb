// The simulated drive: see drive.h.
#include <math.h>
#include <string.h>

#include "drive/drive.h"
#include "drive/state_machine.h"
#include "rung/code.h"

namespace rung::motion {
namespace {

enum Mode : int8_t {
  kPosition = 1,
  kVelocity = 3,
  kHoming = 6,
  kCyclicPosition = 8,
  kCyclicVelocity = 9,
  kCyclicTorque = 10
};

// 6064h wraps as a counter of 32 bits does.
int32_t counted(double increments) { return static_cast<int32_t>(static_cast<uint32_t>(llrint(increments))); }

void takeStep(SimulatedDrive& drive, const rung_drive& data) {
  DriveEvents events = {};
  events.fault = drive.fault_code_ != 0;
  events.power = !drive.power_lost_;
  events.ramp_done = drive.demand_velocity_ == 0;
  const auto state = static_cast<DriveState>(drive.state_);
  const int transition = transitionOf(state, data.controlword, drive.last_controlword_, events);
  if (transition >= 0) drive.state_ = static_cast<int16_t>(stateAfter(transition));
  drive.last_controlword_ = data.controlword;
}

void move(SimulatedDrive& drive, const rung_drive& data, double seconds) {
  const double before = drive.demand_;
  if (static_cast<DriveState>(drive.state_) == DriveState::OperationEnabled && data.mode == kCyclicPosition) {
    drive.demand_ += static_cast<int32_t>(static_cast<uint32_t>(data.target_position) -
                                          static_cast<uint32_t>(counted(drive.demand_ - drive.zero_)));
  }
  drive.demand_velocity_ = seconds > 0 ? (drive.demand_ - before) / seconds : 0;
  drive.machine_position_ = drive.demand_;
  drive.machine_velocity_ = drive.demand_velocity_;
}

}  // namespace

void stepDrive(SimulatedDrive& drive, rung_drive& data, double seconds) {
  if (!drive.started_) {
    drive.started_ = true;
    drive.zero_ = -static_cast<double>(drive.start_position_);
    drive.bus_state_ = drive.requested_state_;
    data.mapped = drive.mapped_;
  }
  ++drive.steps_;
  data.communication = drive.bus_state_ == 8 && !drive.communication_lost_;
  if (!data.communication) return;
  takeStep(drive, data);
  move(drive, data, seconds);
  const uint16_t voltage = drive.power_lost_ ? 0 : 0x10;
  data.statusword = statusBits(static_cast<DriveState>(drive.state_)) | voltage | 0x200;
  data.mode_display = data.mode;
  data.position = counted(drive.machine_position_ - drive.zero_);
  data.velocity = counted(drive.machine_velocity_);
  data.error_code = drive.fault_code_;
}

int64_t accessObject(SimulatedDrive&, rung_drive&, const rung_object_access&, uint32_t*) { return RUNG_OBJECT_UNKNOWN; }

}  // namespace rung::motion

extern "C" void rung_sm3_basic_SIMULATED_DRIVE__step(rung_context*, rung_sm3_basic::SIMULATED_DRIVE_type* self,
                                                     void* drive, double seconds) {
  static_assert(sizeof(rung_sm3_basic::RUNG_DRIVE_type) == sizeof(rung_drive), "RUNG_DRIVE is a rung_drive");
  rung_drive data;
  memcpy(&data, drive, sizeof data);
  rung::motion::stepDrive(*self, data, seconds);
  memcpy(drive, &data, sizeof data);
}

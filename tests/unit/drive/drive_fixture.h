// SPDX-License-Identifier: Apache-2.0
// A simulated drive with the initial values of stdlib/motion/SM3_Basic/simulated_drive.st, for unit tests.
#pragma once

#include <string.h>

#include "drive/drive.h"

namespace rung::motion {

struct TestDrive {
  SimulatedDrive drive;
  rung_drive data;

  TestDrive() {
    memset(&drive, 0, sizeof drive);
    memset(&data, 0, sizeof data);
    drive.increments_per_turn_ = 10000;
    drive.inertia_ = 0.001;
    drive.home_from_ = drive.probe_1_from_ = drive.probe_2_from_ = 1;
    drive.sdo_cycles_ = 2;
    drive.sdo_timeout_ = 100;
    drive.requested_state_ = 8;
    drive.mapped_ = 0x1FFFF;
    drive.quick_stop_option_ = drive.fault_option_ = 2;
    drive.disable_option_ = drive.halt_option_ = 1;
    drive.following_error_window_ = UINT32_MAX;
    drive.max_torque_ = drive.max_current_ = 3000;
    drive.rated_current_ = 5000;
    drive.max_profile_velocity_ = UINT32_MAX;
    drive.profile_velocity_ = 100000;
    drive.profile_acceleration_ = drive.profile_deceleration_ = 1000000;
    drive.quick_stop_deceleration_ = 10000000;
    drive.homing_digits_ = 8;
    drive.homing_speed_search_ = 20000;
    drive.homing_speed_zero_ = 2000;
    drive.homing_acceleration_ = 1000000;
    drive.interpolation_period_ = 1;
    drive.interpolation_exponent_ = -3;
  }

  void step(double seconds = 0.001) { stepDrive(drive, data, seconds); }
  void step(uint16_t controlword) {
    data.controlword = controlword;
    step();
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) step();
  }
  void enable(int8_t mode) {
    data.mode = mode;
    step(uint16_t{0});
    for (const uint16_t controlword : {6, 7, 15}) step(controlword);
  }
  // Steps until the statusword has all bits of `mask`; the number of cycles, or -1 after 100 000.
  int runUntil(uint16_t mask) {
    for (int i = 0; i < 100000; ++i) {
      if ((data.statusword & mask) == mask) return i;
      step();
    }
    return -1;
  }
  int64_t access(uint16_t index, uint8_t subindex, uint8_t length, bool is_write, uint32_t* value) {
    const rung_object_access request = {index, subindex, length, static_cast<uint8_t>(is_write ? 1 : 0), *value};
    int64_t result = RUNG_OBJECT_BUSY;
    for (int i = 0; i < 1000 && result == RUNG_OBJECT_BUSY; ++i) {
      result = accessObject(drive, request, value);
      if (result == RUNG_OBJECT_BUSY) step();
    }
    return result;
  }
};

}  // namespace rung::motion

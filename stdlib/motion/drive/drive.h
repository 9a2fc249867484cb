// SPDX-License-Identifier: Apache-2.0
// The simulated drive of an axis: what the axis kernel calls. In: the instance SIMULATED_DRIVE of SM3_Basic, whose
// inputs are settings and faults, and the process data that the axis sends. Out: the process data of the answer. All
// state is in the instance; no host and no clock is needed.
#pragma once

#include "rung/motion.h"
#include "rung/native_blocks.h"

namespace rung::motion {

using SimulatedDrive = rung_sm3_basic::SIMULATED_DRIVE_type;

// One cycle: takes what the axis sends, moves the machine for `seconds`, and fills what comes from the drive.
void stepDrive(SimulatedDrive& drive, rung_drive& data, double seconds);

// One read or write of an object by the service channel: called once a cycle with the same `access` until the result is
// not RUNG_OBJECT_BUSY. Another `access` replaces one that was not answered. Returns a rung_object_result.
int64_t accessObject(SimulatedDrive& drive, const rung_object_access& access, uint32_t* value);

}  // namespace rung::motion

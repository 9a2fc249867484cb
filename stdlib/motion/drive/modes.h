// SPDX-License-Identifier: Apache-2.0
// The modes of operation of the simulated drive: what set value a cycle has in csp, csv, cst, pp, pv and hm, and how
// the drive stops by itself. In: the objects in the instance. Called by simulated_drive.cpp. IEC 61800-7-201, modes of
// operation.
#pragma once

#include "drive/homing.h"
#include "drive/state_machine.h"

namespace rung::motion {

enum class DriveMode : int8_t {
  None = 0,
  ProfilePosition = 1,
  ProfileVelocity = 3,
  Homing = 6,
  CyclicPosition = 8,
  CyclicVelocity = 9,
  CyclicTorque = 10
};

// How the drive brakes: with a deceleration, or without power at once.
struct Braking {
  bool is_at_once;
  double deceleration;
};
// For the options 605Ah to 605Eh; those beyond the quick stop option use 0, 1 and 2 only.
Braking brakingOf(const SimulatedDrive& drive, int option);

// Ends what a mode was doing: the drive got power, lost it, or changed the mode.
void resetModes(SimulatedDrive& drive);

// Moves the machine for one cycle. `braking` is null while the drive follows its mode.
void runMode(SimulatedDrive& drive, const Braking* braking, double seconds);

// Bits 10 to 13 of the statusword while the operation is enabled.
uint16_t modeStatus(const SimulatedDrive& drive, bool is_braking);

}  // namespace rung::motion

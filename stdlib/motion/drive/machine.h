// SPDX-License-Identifier: Apache-2.0
// The simulated machine: switches, touch probe inputs and the Z pulse as functions of its position, its first-order lag
// and its torque. In: the settings in the instance. Called by simulated_drive.cpp, homing.cpp and probes.cpp.
#pragma once

#include "drive/drive.h"

namespace rung::motion {

// Bits of 60FDh: 0 to 2 by CiA 402, the others of the manufacturer.
enum Input : uint32_t {
  kNegativeLimit = 1,
  kPositiveLimit = 2,
  kHomeSwitch = 4,
  kProbeInput1 = 1u << 16,
  kProbeInput2 = 1u << 17
};

// 6064h for a position of the machine: a counter of 32 bits, which wraps.
int32_t countedPosition(const SimulatedDrive& drive, double position);

// A velocity or torque as an object shows it: rounded, at its limits beyond them.
int32_t countedVelocity(double value);

// The inputs that are active at a position of the machine.
uint32_t inputsAt(const SimulatedDrive& drive, double position);

// A part of the machine's way, in one cycle.
struct Way {
  double from, to;
  int direction() const { return to > from ? 1 : to < from ? -1 : 0; }
};

// Where on the way an input changes to `active`: where its range begins or ends, or at the start of the way when it was
// set by hand since the cycle before, whose inputs are `before`. False: nowhere.
bool findEdge(const SimulatedDrive& drive, Way way, uint32_t before, Input input, bool active, double* position);

// The first Z pulse after `way.from` up to `way.to`. False: none.
bool findIndex(const SimulatedDrive& drive, Way way, double* position);

// Moves the machine along while the set value goes from `demand_from` to drive.demand in `seconds`.
void followDemand(SimulatedDrive& drive, double demand_from, double seconds);

// Moves the machine by a torque.
void followTorque(SimulatedDrive& drive, double torque, double seconds);

}  // namespace rung::motion

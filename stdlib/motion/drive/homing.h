// SPDX-License-Identifier: Apache-2.0
// Homing in the drive (mode hm): the methods of CiA 402 (6098h) and those of parameter P5.10 as one plan, and its
// execution over the cycles. State is in the instance. Called by modes.cpp.
// IEC 61800-7-201, homing methods; TM/TP manual 7.1.3.
#pragma once

#include "drive/machine.h"
#include "drive/ramps.h"

namespace rung::motion {

// Which edge of the switch is the reference, relative to the direction in which the search starts.
enum class HomingEdge : int8_t {
  None,          // no switch: the Z pulse, or the present position
  ExitAgainst,   // the near edge, left against the direction of the search
  EntryAlong,    // the near edge, entered along the search
  EntryAgainst,  // the far edge, entered against the search
  ExitAlong      // the far edge, left along the search
};

enum class OnLimit : int8_t { Error, Fault, Reverse };

struct HomingPlan {
  bool is_known;
  int start;  // direction of the search: 1, -1
  HomingEdge edge;
  Input signal;  // the switch
  int index;     // direction of the search for the Z pulse after it: 1, -1; 0: none
  OnLimit on_limit;
};

// By 6098h; 0 is for the digits of P5.10.
HomingPlan homingPlan(int method, unsigned digits);

enum class HomingPhase : int8_t { Idle, Search, Clear, Approach, Index, Attained, Failed, Interrupted };
enum class HomingResult : int8_t { None, Running, Attained, Error };

// Begins a homing from rest.
void startHoming(SimulatedDrive& drive);

// Ends a homing without result: its start bit fell, or the mode changed.
void interruptHoming(SimulatedDrive& drive);

// The set velocity of this cycle.
MotionPoint homingDemand(const SimulatedDrive& drive, MotionPoint from, double seconds);

// The switches that the machine has passed in this cycle. `before`: the inputs of the cycle before.
void observeHoming(SimulatedDrive& drive, Way way, uint32_t before);

// Bits 10, 12 and 13 of the statusword.
uint16_t homingStatus(const SimulatedDrive& drive);

}  // namespace rung::motion

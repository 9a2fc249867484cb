// SPDX-License-Identifier: Apache-2.0
// Touch probes of the simulated drive: 60B8h arms them, 60B9h and 60BAh to 60BDh tell what they have seen. Called by
// simulated_drive.cpp after each motion. IEC 61800-7-201, touch probe function.
#pragma once

#include "drive/machine.h"

namespace rung::motion {

// `before`: the inputs of the cycle before.
void latchProbes(SimulatedDrive& drive, Way way, uint32_t before);

}  // namespace rung::motion

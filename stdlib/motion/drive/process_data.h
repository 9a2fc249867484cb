// SPDX-License-Identifier: Apache-2.0
// The process data of the simulated drive as it goes over the fieldbus: the objects of the assigned PDOs, byte by byte,
// in logical datagrams that the FMMUs of the slave map to its memory. In and out: the objects of rung_drive. The
// working counter tells whether the slave has taken part. Called by simulated_drive.cpp. TM/TP manual 2.1.3 and 2.1.4;
// AX manual 7.1.
#pragma once

#include "drive/drive.h"

namespace rung::motion {

// Lays out the objects of the assigned PDOs, on the step to SafeOperational: the FMMUs hold until PreOperational.
void layOut(SimulatedDrive& drive);

// The master writes what the drive shall do (LWR), and the drive takes it. False: the working counter is wrong.
bool exchangeOutputs(SimulatedDrive& drive, const rung_drive& data);
// The drive leaves what it has to tell, and the master reads it (LRD). False: the working counter is wrong, and `data`
// stays as it is.
bool exchangeInputs(SimulatedDrive& drive, rung_drive& data);

}  // namespace rung::motion

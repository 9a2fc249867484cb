// SPDX-License-Identifier: Apache-2.0
// Error codes of the simulated drive in 603Fh. IEC 61800-7-201, table of error codes.
#pragma once

#include <stdint.h>

namespace rung::motion {

enum DriveError : uint16_t {
  kUndervoltage = 0x3220,   // in the supply of the motor
  kCommunication = 0x7500,  // the fieldbus was lost while the motor had power
  kFollowingError = 0x8611,
  kReferenceLimit = 0x8612  // a limit switch was reached during a homing
};

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// Touch probes: see probes.h. Probe 2 has the bits of probe 1, eight further.
#include "drive/probes.h"

#include <math.h>

namespace rung::motion {
namespace {

enum FunctionBit : unsigned { kEnable = 1, kContinuous = 2, kSource = 12, kZPulse = 4, kRising = 16, kFalling = 32 };

// Tells whether an enabled edge is being waited for: not after its first event, unless all are wanted.
bool isAwaited(unsigned function, unsigned status, unsigned enable_bit, unsigned stored_bit) {
  return (function & enable_bit) != 0 && ((function & kContinuous) != 0 || (status & stored_bit) == 0);
}

void store(SimulatedDrive& drive, int probe, int falling, double position) {
  drive.probe_positions_[2 * probe + falling] = countedPosition(drive, position);
  drive.probe_status_ = static_cast<uint16_t>(drive.probe_status_ | (falling != 0 ? 4 : 2) << 8 * probe);
}

void latch(SimulatedDrive& drive, int probe, Way way, uint32_t before) {
  const unsigned function = drive.probe_function_ >> 8 * probe & 0xFF, status = drive.probe_status_ >> 8 * probe & 0xFF;
  const bool rising = isAwaited(function, status, kRising, 2), falling = isAwaited(function, status, kFalling, 4);
  double position = 0;
  if ((function & kSource) == kZPulse) {
    // The pulse has no width: both its edges are at the same increment.
    if (!findIndex(drive, way, &position)) return;
    if (rising) store(drive, probe, 0, position);
    if (falling) store(drive, probe, 1, position);
    return;
  }
  const Input input = probe == 0 ? kProbeInput1 : kProbeInput2;
  if (rising && findEdge(drive, way, before, input, true, &position)) store(drive, probe, 0, position);
  if (falling && findEdge(drive, way, before, input, false, &position)) store(drive, probe, 1, position);
}

// A probe is armed by its enable bit, and an edge by its own bit: what it has seen before is forgotten.
void arm(SimulatedDrive& drive, int probe) {
  const unsigned now = drive.probe_function_ >> 8 * probe & 0xFF, last = drive.last_probe_function_ >> 8 * probe & 0xFF;
  const unsigned risen = now & ~last;
  unsigned status = drive.probe_status_ >> 8 * probe & 0xFF;
  if ((now & kEnable) == 0) {
    status = 0;
  } else {
    if ((risen & kEnable) != 0) status = 0;
    status |= 1;
    if ((risen & kRising) != 0 || (now & kRising) == 0) status &= ~2u;
    if ((risen & kFalling) != 0 || (now & kFalling) == 0) status &= ~4u;
  }
  drive.probe_status_ = static_cast<uint16_t>((drive.probe_status_ & ~(0xFFu << 8 * probe)) | status << 8 * probe);
}

}  // namespace

void latchProbes(SimulatedDrive& drive, Way way, uint32_t before) {
  for (int probe = 0; probe < 2; ++probe) {
    arm(drive, probe);
    if ((drive.probe_status_ >> 8 * probe & 1) != 0) latch(drive, probe, way, before);
  }
  drive.last_probe_function_ = drive.probe_function_;
}

}  // namespace rung::motion

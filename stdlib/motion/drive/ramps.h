// SPDX-License-Identifier: Apache-2.0
// Motion under constant acceleration in closed form, for one cycle: what the drive's own generators (pp, pv, hm, stops)
// follow. Called by modes.cpp and homing.cpp.
#pragma once

namespace rung::motion {

struct MotionPoint {
  double position, velocity;
};

// Changes the velocity to `target` with `rate` > 0, then keeps it.
MotionPoint rampVelocity(MotionPoint from, double target, double rate, double seconds);

struct ProfileLimits {
  double velocity, acceleration, deceleration;  // > 0
};

// Moves to rest at `target` in the shortest time. At the end it is exactly there, with velocity 0.
MotionPoint moveTo(MotionPoint from, double target, const ProfileLimits& limits, double seconds);

}  // namespace rung::motion

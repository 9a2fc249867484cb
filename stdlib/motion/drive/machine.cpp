// SPDX-License-Identifier: Apache-2.0
// The simulated machine: see machine.h.
#include "drive/machine.h"
#include "drive/rounding.h"

#include <math.h>

namespace rung::motion {
namespace {

struct Range {
  double from, to;
  bool holds(double position) const { return from <= position && position <= to; }
};

Range rangeOf(const SimulatedDrive& drive, Input input) {
  const double far = HUGE_VAL;
  switch (input) {
    case kNegativeLimit:
      return drive.has_limits_ ? Range{-far, static_cast<double>(drive.negative_limit_from_)} : Range{1, 0};
    case kPositiveLimit:
      return drive.has_limits_ ? Range{static_cast<double>(drive.positive_limit_from_), far} : Range{1, 0};
    case kHomeSwitch: return {static_cast<double>(drive.home_from_), static_cast<double>(drive.home_to_)};
    case kProbeInput1: return {static_cast<double>(drive.probe_1_from_), static_cast<double>(drive.probe_1_to_)};
    case kProbeInput2: return {static_cast<double>(drive.probe_2_from_), static_cast<double>(drive.probe_2_to_)};
  }
  return {1, 0};
}

bool isSetByHand(const SimulatedDrive& drive, Input input) {
  switch (input) {
    case kNegativeLimit: return drive.negative_limit_ != 0;
    case kPositiveLimit: return drive.positive_limit_ != 0;
    case kHomeSwitch: return drive.home_switch_ != 0;
    case kProbeInput1: return drive.probe_1_ != 0;
    case kProbeInput2: return drive.probe_2_ != 0;
  }
  return false;
}

constexpr Input kInputs[] = {kNegativeLimit, kPositiveLimit, kHomeSwitch, kProbeInput1, kProbeInput2};

void setTorque(SimulatedDrive& drive, double acceleration) {
  const double limit = drive.max_torque_;
  const double torque = drive.inertia_ * acceleration + drive.damping_ * drive.machine_velocity_ + drive.load_;
  drive.torque_ = torque > limit ? limit : torque < -limit ? -limit : torque;
}

}  // namespace

int32_t countedPosition(const SimulatedDrive& drive, double position) {
  return static_cast<int32_t>(static_cast<uint32_t>(rounded(position - drive.zero_)));
}

int32_t countedVelocity(double value) {
  return value >= INT32_MAX ? INT32_MAX : value <= INT32_MIN ? INT32_MIN : static_cast<int32_t>(rounded(value));
}

uint32_t inputsAt(const SimulatedDrive& drive, double position) {
  uint32_t inputs = 0;
  for (const Input input : kInputs)
    if (isSetByHand(drive, input) || rangeOf(drive, input).holds(position)) inputs |= input;
  return inputs;
}

bool findEdge(const SimulatedDrive& drive, Way way, uint32_t before, Input input, bool active, double* position) {
  const bool now = (inputsAt(drive, way.from) & input) != 0;
  if (now == active && ((before & input) != 0) != active) {
    *position = way.from;
    return true;
  }
  if (way.direction() == 0 || isSetByHand(drive, input)) return false;
  const Range range = rangeOf(drive, input);
  if (range.to < range.from) return false;
  // Entered at the near end, left at the far end.
  const double edge = (way.direction() > 0) == active ? range.from : range.to;
  const bool is_passed = way.direction() > 0
                             ? (active ? way.from < edge && edge <= way.to : way.from <= edge && edge < way.to)
                             : (active ? way.to <= edge && edge < way.from : way.to < edge && edge <= way.from);
  if (is_passed) *position = edge;
  return is_passed;
}

bool findIndex(const SimulatedDrive& drive, Way way, double* position) {
  const double turn = drive.increments_per_turn_;
  if (turn <= 0 || way.direction() == 0) return false;
  const double turns = (way.from - drive.z_pulse_) / turn;
  const double next = way.direction() > 0 ? floor(turns) + 1 : ceil(turns) - 1;
  const double pulse = next * turn + drive.z_pulse_;
  if (way.direction() > 0 ? pulse > way.to : pulse < way.to) return false;
  *position = pulse;
  return true;
}

// The lag is that of x' = (demand - x) / T for a set value that is linear within the cycle, so that a steady velocity v
// lags by exactly v T.
void followDemand(SimulatedDrive& drive, double demand_from, double seconds) {
  if (seconds <= 0) return;
  const double slope = (drive.demand_ - demand_from) / seconds;
  double position = drive.demand_, velocity = drive.demand_velocity_;
  if (drive.time_constant_ > 0) {
    const double lag = drive.time_constant_, left = exp(-seconds / lag);
    const double offset = drive.machine_position_ - demand_from + slope * lag;
    position = drive.demand_ - slope * lag + offset * left;
    velocity = slope - offset / lag * left;
  }
  if (drive.blocked_) position = drive.machine_position_, velocity = 0;
  const double acceleration = (velocity - drive.machine_velocity_) / seconds;
  drive.machine_position_ = position;
  drive.machine_velocity_ = velocity;
  setTorque(drive, acceleration);
}

void followTorque(SimulatedDrive& drive, double torque, double seconds) {
  const double before = drive.machine_velocity_;
  double after = 0;
  if (drive.inertia_ > 0 && !drive.blocked_) {
    // The damping at the end of the cycle: stable however strong it is.
    after =
        (before + seconds * (torque - drive.load_) / drive.inertia_) / (1 + seconds * drive.damping_ / drive.inertia_);
  }
  drive.machine_position_ += (before + after) / 2 * seconds;
  drive.machine_velocity_ = after;
  drive.torque_ = torque;
}

}  // namespace rung::motion

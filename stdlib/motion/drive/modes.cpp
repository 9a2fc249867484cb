// SPDX-License-Identifier: Apache-2.0
// The modes of operation: see modes.h.
#include "drive/modes.h"

#include <math.h>

namespace rung::motion {
namespace {

enum ModeBit : uint16_t {
  kNewSetPoint = 0x10,        // pp
  kChangeImmediately = 0x20,  // pp
  kRelative = 0x40,           // pp
  kStartHoming = 0x10,        // hm
  kTargetReached = 0x400,
  kInternalLimit = 0x800,
  kAcknowledged = 0x1000,      // pp
  kFollows = 0x1000,           // csp, csv, cst
  kStandsStill = 0x1000,       // pv
  kFollowingErrorBit = 0x2000  // csp, pp
};

constexpr double kRounding = 1e-9;  // of a sum of cycle times, s

DriveMode modeOf(const SimulatedDrive& drive) { return static_cast<DriveMode>(drive.mode_display_); }

bool hasRisen(const SimulatedDrive& drive, uint16_t bit) {
  return (drive.controlword_ & bit) != 0 && (drive.last_controlword_ & bit) == 0;
}

MotionPoint demandOf(const SimulatedDrive& drive) { return {drive.demand_, drive.demand_velocity_}; }

void setDemand(SimulatedDrive& drive, MotionPoint point, double seconds) {
  const double before = drive.demand_;
  drive.demand_ = point.position;
  drive.demand_velocity_ = point.velocity;
  followDemand(drive, before, seconds);
}

// 607Dh: 0 and 0 switch the limits off.
int32_t clampedTarget(const SimulatedDrive& drive, int32_t target) {
  if (drive.min_position_limit_ >= drive.max_position_limit_) return target;
  return target < drive.min_position_limit_   ? drive.min_position_limit_
         : target > drive.max_position_limit_ ? drive.max_position_limit_
                                              : target;
}

double clampedVelocity(const SimulatedDrive& drive, double velocity) {
  const double limit = drive.max_profile_velocity_;
  return velocity > limit ? limit : velocity < -limit ? -limit : velocity;
}

// The machine position that 6064h shows as `target`, nearest to the set value: the counter wraps.
double machinePositionOf(const SimulatedDrive& drive, int32_t target) {
  const int32_t now = countedPosition(drive, drive.demand_);
  const auto distance = static_cast<int32_t>(static_cast<uint32_t>(target) - static_cast<uint32_t>(now));
  return rint(drive.demand_ - drive.zero_) + distance + drive.zero_;
}

void brake(SimulatedDrive& drive, const Braking& braking, double seconds) {
  if (braking.is_at_once || braking.deceleration <= 0) return setDemand(drive, {drive.demand_, 0}, seconds);
  setDemand(drive, rampVelocity(demandOf(drive), 0, braking.deceleration, seconds), seconds);
}

void cyclicPosition(SimulatedDrive& drive, double seconds) {
  const double target = machinePositionOf(drive, clampedTarget(drive, drive.target_position_));
  setDemand(drive, {target, seconds > 0 ? (target - drive.demand_) / seconds : 0}, seconds);
}

void cyclicVelocity(SimulatedDrive& drive, double seconds) {
  const double velocity = clampedVelocity(drive, drive.target_velocity_);
  setDemand(drive, {drive.demand_ + velocity * seconds, velocity}, seconds);
}

void cyclicTorque(SimulatedDrive& drive, double seconds) {
  const double limit = drive.max_torque_;
  const double target = drive.target_torque_ > limit    ? limit
                        : drive.target_torque_ < -limit ? -limit
                                                        : drive.target_torque_;
  const double step = drive.torque_slope_ == 0 ? HUGE_VAL : drive.torque_slope_ * seconds;
  const double change = target - drive.demand_torque_;
  drive.demand_torque_ = fabs(change) <= step ? target : drive.demand_torque_ + copysign(step, change);
  followTorque(drive, drive.demand_torque_, seconds);
  drive.demand_ = drive.machine_position_;
  drive.demand_velocity_ = drive.machine_velocity_;
}

// Through 0 with the deceleration, away from 0 with the acceleration.
void profileVelocity(SimulatedDrive& drive, double seconds) {
  const double target = clampedVelocity(drive, drive.target_velocity_);
  const double acceleration = drive.profile_acceleration_, deceleration = drive.profile_deceleration_;
  MotionPoint at = demandOf(drive);
  if (acceleration <= 0 || deceleration <= 0) return brake(drive, {true, 0}, seconds);
  const bool reverses = at.velocity * target < 0;
  if (reverses || fabs(target) < fabs(at.velocity)) {
    const double to = reverses ? 0 : target;
    const double needed = fabs(at.velocity - to) / deceleration;
    const double time = needed < seconds ? needed : seconds;
    at = rampVelocity(at, to, deceleration, time);
    seconds -= time;
    if (seconds > 0) at = rampVelocity(at, target, acceleration, seconds);
    return setDemand(drive, at, seconds + time);
  }
  setDemand(drive, rampVelocity(at, target, acceleration, seconds), seconds);
}

void startSetPoint(SimulatedDrive& drive, double set_point) {
  drive.set_point_ = set_point;
  drive.moves_to_set_point_ = 1;
}

// The handshake of new set-point and acknowledge; one set-point is kept while another is being reached.
void takeSetPoint(SimulatedDrive& drive) {
  if (hasRisen(drive, kNewSetPoint)) {
    const bool is_relative = (drive.controlword_ & kRelative) != 0;
    const double base = drive.has_next_ ? drive.next_set_point_ : drive.set_point_;
    const double set_point = is_relative ? base + drive.target_position_
                                         : machinePositionOf(drive, clampedTarget(drive, drive.target_position_));
    if ((drive.controlword_ & kChangeImmediately) != 0 || !drive.moves_to_set_point_) {
      drive.has_next_ = 0;
      startSetPoint(drive, set_point);
      drive.acknowledged_ = 1;
    } else if (!drive.has_next_) {
      drive.has_next_ = 1;
      drive.next_set_point_ = set_point;
      drive.acknowledged_ = 1;
    }
  }
  if ((drive.controlword_ & kNewSetPoint) == 0 && !drive.has_next_) drive.acknowledged_ = 0;
}

void profilePosition(SimulatedDrive& drive, double seconds) {
  takeSetPoint(drive);
  const double velocity = clampedVelocity(drive, drive.profile_velocity_);
  const ProfileLimits limits = {velocity, static_cast<double>(drive.profile_acceleration_),
                                static_cast<double>(drive.profile_deceleration_)};
  if (!drive.moves_to_set_point_ || limits.velocity <= 0 || limits.acceleration <= 0 || limits.deceleration <= 0)
    return brake(drive, {limits.deceleration <= 0, limits.deceleration}, seconds);
  setDemand(drive, moveTo(demandOf(drive), drive.set_point_, limits, seconds), seconds);
  if (drive.demand_ != drive.set_point_ || drive.demand_velocity_ != 0) return;
  drive.moves_to_set_point_ = 0;
  if (!drive.has_next_) return;
  drive.has_next_ = 0;
  startSetPoint(drive, drive.next_set_point_);
}

void homing(SimulatedDrive& drive, double seconds) {
  if (hasRisen(drive, kStartHoming) && !drive.homing_ignored_) startHoming(drive);
  if ((drive.controlword_ & kStartHoming) == 0) interruptHoming(drive);
  const double from = drive.machine_position_;
  setDemand(drive, homingDemand(drive, demandOf(drive), seconds), seconds);
  observeHoming(drive, {from, drive.machine_position_}, drive.inputs_);
}

bool isInPositionWindow(const SimulatedDrive& drive) {
  if (drive.moves_to_set_point_) return false;
  if (drive.position_window_ == UINT32_MAX) return true;
  return fabs(rint(drive.set_point_ - drive.machine_position_)) <= drive.position_window_;
}

bool isInVelocityWindow(const SimulatedDrive& drive) {
  return fabs(rint(drive.target_velocity_ - drive.machine_velocity_)) <= drive.velocity_window_;
}

// How long the target has been reached, and the following error exceeded.
void watchWindows(SimulatedDrive& drive, double seconds) {
  const DriveMode mode = modeOf(drive);
  const bool is_inside = mode == DriveMode::ProfilePosition   ? isInPositionWindow(drive)
                         : mode == DriveMode::ProfileVelocity ? isInVelocityWindow(drive)
                                                              : false;
  drive.window_time_ = is_inside ? drive.window_time_ + seconds : 0;
  const bool is_watched = mode == DriveMode::ProfilePosition || mode == DriveMode::CyclicPosition;
  const bool is_far = is_watched && drive.following_error_window_ != UINT32_MAX &&
                      fabs(drive.demand_ - drive.machine_position_) > drive.following_error_window_;
  drive.following_time_ = is_far ? drive.following_time_ + seconds : 0;
}

bool hasStopped(const SimulatedDrive& drive) { return drive.demand_velocity_ == 0; }

bool isTargetReached(const SimulatedDrive& drive) {
  const double needed =
      (modeOf(drive) == DriveMode::ProfilePosition ? drive.position_window_time_ : drive.velocity_window_time_) * 1e-3;
  return drive.window_time_ > 0 && drive.window_time_ + kRounding >= needed;
}

}  // namespace

Braking brakingOf(const SimulatedDrive& drive, int option) {
  const double profile = modeOf(drive) == DriveMode::Homing ? drive.homing_acceleration_ : drive.profile_deceleration_;
  if (option == 0) return {true, 0};
  return {false, option == 1 || option == 5 ? profile : static_cast<double>(drive.quick_stop_deceleration_)};
}

void resetModes(SimulatedDrive& drive) {
  interruptHoming(drive);
  drive.homing_phase_ = static_cast<int8_t>(HomingPhase::Idle);
  drive.set_point_ = drive.demand_;
  drive.moves_to_set_point_ = 0;
  drive.has_next_ = 0;
  drive.acknowledged_ = 0;
  drive.demand_torque_ = 0;
  drive.window_time_ = 0;
  drive.following_time_ = 0;
}

void runMode(SimulatedDrive& drive, const Braking* braking, double seconds) {
  if (braking != nullptr) {
    brake(drive, *braking, seconds);
  } else {
    switch (modeOf(drive)) {
      case DriveMode::ProfilePosition: profilePosition(drive, seconds); break;
      case DriveMode::ProfileVelocity: profileVelocity(drive, seconds); break;
      case DriveMode::Homing: homing(drive, seconds); break;
      case DriveMode::CyclicPosition: cyclicPosition(drive, seconds); break;
      case DriveMode::CyclicVelocity: cyclicVelocity(drive, seconds); break;
      case DriveMode::CyclicTorque: cyclicTorque(drive, seconds); break;
      case DriveMode::None: brake(drive, {true, 0}, seconds); break;
    }
  }
  watchWindows(drive, seconds);
}

uint16_t modeStatus(const SimulatedDrive& drive, bool is_braking) {
  const DriveMode mode = modeOf(drive);
  unsigned status = drive.following_time_ > 0 ? kFollowingErrorBit : 0;
  if (mode == DriveMode::CyclicPosition && clampedTarget(drive, drive.target_position_) != drive.target_position_)
    status |= kInternalLimit;
  if (mode == DriveMode::Homing) return static_cast<uint16_t>(homingStatus(drive));
  if (mode == DriveMode::ProfilePosition && drive.acknowledged_) status |= kAcknowledged;
  if (mode == DriveMode::ProfileVelocity && hasStopped(drive)) status |= kStandsStill;
  if (is_braking) return static_cast<uint16_t>(status | (hasStopped(drive) ? kTargetReached : 0));
  switch (mode) {
    case DriveMode::ProfilePosition:
    case DriveMode::ProfileVelocity:
      return static_cast<uint16_t>(status | (isTargetReached(drive) ? kTargetReached : 0));
    case DriveMode::CyclicPosition:
    case DriveMode::CyclicVelocity:
    case DriveMode::CyclicTorque: return static_cast<uint16_t>(status | kFollows);
    case DriveMode::Homing:
    case DriveMode::None: return static_cast<uint16_t>(status);
  }
  return static_cast<uint16_t>(status);
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// Homing of the simulated drive: see homing.h.
#include "drive/homing.h"

#include "drive/errors.h"

namespace rung::motion {
namespace {

constexpr HomingEdge kOfHomeSwitch[] = {HomingEdge::ExitAgainst, HomingEdge::EntryAlong, HomingEdge::EntryAgainst,
                                        HomingEdge::ExitAlong};

// The direction of the last motion before the reference, in which the Z pulse is searched.
int finalDirection(int start, HomingEdge edge) {
  const bool along = edge == HomingEdge::EntryAlong || edge == HomingEdge::ExitAlong;
  return along ? start : -start;
}

HomingPlan switchPlan(int start, HomingEdge edge, Input signal, bool with_index, OnLimit on_limit) {
  return {true, start, edge, signal, with_index ? finalDirection(start, edge) : 0, on_limit};
}

// IEC 61800-7-201, 6098h. Methods 17 to 30 are 1 to 14 without the Z pulse.
HomingPlan planOfMethod(int method) {
  const bool with_index = method <= 14;
  const int kind = method >= 17 && method <= 30 ? method - 16 : method;
  if (kind == 1) return switchPlan(-1, HomingEdge::ExitAgainst, kNegativeLimit, with_index, OnLimit::Error);
  if (kind == 2) return switchPlan(1, HomingEdge::ExitAgainst, kPositiveLimit, with_index, OnLimit::Error);
  if (kind >= 3 && kind <= 6)
    return switchPlan(kind < 5 ? 1 : -1, kOfHomeSwitch[(kind - 3) % 2], kHomeSwitch, with_index, OnLimit::Error);
  if (kind >= 7 && kind <= 14)
    return switchPlan(kind < 11 ? 1 : -1, kOfHomeSwitch[(kind - 7) % 4], kHomeSwitch, with_index, OnLimit::Reverse);
  if (kind == 33 || kind == 34)
    return {true, kind == 34 ? 1 : -1, HomingEdge::None, kHomeSwitch, kind == 34 ? 1 : -1, OnLimit::Error};
  if (kind == 35 || kind == 37) return {true, 1, HomingEdge::None, kHomeSwitch, 0, OnLimit::Error};
  return {};
}

// TM/TP manual 7.1.3: the decimal digits R T Z M.
HomingPlan planOfDigits(unsigned digits) {
  const unsigned m = digits % 10, z = digits / 10 % 10, t = digits / 100 % 10;
  const int start = m % 2 == 0 ? 1 : -1;
  if (m == 8) return planOfMethod(35);
  if (m > 8 || t > 1) return {};
  const OnLimit on_limit = t == 1 ? OnLimit::Reverse : OnLimit::Fault;
  if (m == 4 || m == 5) return {true, start, HomingEdge::None, kHomeSwitch, start, on_limit};
  if (z > 2) return {};
  HomingPlan plan = {true, start, m < 6 ? HomingEdge::EntryAlong : HomingEdge::ExitAlong, kHomeSwitch, 0, on_limit};
  if (m < 2) plan.signal = start > 0 ? kPositiveLimit : kNegativeLimit;
  if (z < 2) plan.index = z == 0 ? -start : start;
  return plan;
}

HomingPhase phaseOf(const SimulatedDrive& drive) { return static_cast<HomingPhase>(drive.homing_phase_); }

void setPhase(SimulatedDrive& drive, HomingPhase phase, int direction) {
  drive.homing_phase_ = static_cast<int8_t>(phase);
  drive.homing_direction_ = static_cast<int8_t>(direction);
}

void setResult(SimulatedDrive& drive, HomingResult result) { drive.homing_result_ = static_cast<int8_t>(result); }

void fail(SimulatedDrive& drive) {
  setPhase(drive, HomingPhase::Failed, 0);
  setResult(drive, HomingResult::Error);
}

void attain(SimulatedDrive& drive, double position) {
  drive.homing_reference_ = position;
  setPhase(drive, HomingPhase::Attained, 0);
}

// The Z pulse after the reference, in the direction in which it is searched.
void searchIndex(SimulatedDrive& drive, Way way) {
  if (way.direction() != drive.homing_index_) return;
  const double reference = drive.homing_reference_;
  if ((reference - way.from) * way.direction() > 0) way.from = reference;
  double pulse = 0;
  if ((way.to - way.from) * way.direction() > 0 && findIndex(drive, way, &pulse)) attain(drive, pulse);
}

void foundReference(SimulatedDrive& drive, Way way, double position) {
  if (drive.homing_index_ == 0) return attain(drive, position);
  drive.homing_reference_ = position;
  setPhase(drive, HomingPhase::Index, drive.homing_index_);
  searchIndex(drive, way);
}

// The machine is on the switch: `entered` where it has just come in, in `direction`.
void leaveOrTake(SimulatedDrive& drive, Way way, const double* entered, int direction) {
  const auto edge = static_cast<HomingEdge>(drive.homing_edge_);
  const int start = drive.homing_start_, last = finalDirection(start, edge);
  const bool is_entry = edge == HomingEdge::EntryAlong || edge == HomingEdge::EntryAgainst;
  if (!is_entry) return setPhase(drive, HomingPhase::Approach, last);
  if (entered != nullptr && direction == last) return foundReference(drive, way, *entered);
  setPhase(drive, HomingPhase::Clear, -last);
}

bool runsIntoLimit(const SimulatedDrive& drive, double position) {
  const Input limit = drive.homing_direction_ > 0 ? kPositiveLimit : kNegativeLimit;
  return drive.homing_direction_ != 0 && static_cast<int>(limit) != drive.homing_signal_ &&
         (inputsAt(drive, position) & limit) != 0;
}

void atLimit(SimulatedDrive& drive) {
  if (drive.homing_on_limit_ == static_cast<int8_t>(OnLimit::Reverse) && !drive.homing_reversed_) {
    drive.homing_reversed_ = 1;
    if (phaseOf(drive) == HomingPhase::Index) drive.homing_index_ = static_cast<int8_t>(-drive.homing_index_);
    return setPhase(drive, phaseOf(drive), -drive.homing_direction_);
  }
  if (drive.homing_on_limit_ == static_cast<int8_t>(OnLimit::Fault)) drive.error_ = kReferenceLimit;
  fail(drive);
}

}  // namespace

HomingPlan homingPlan(int method, unsigned digits) { return method == 0 ? planOfDigits(digits) : planOfMethod(method); }

void startHoming(SimulatedDrive& drive) {
  const HomingPlan plan = homingPlan(drive.homing_method_, drive.homing_digits_);
  setResult(drive, HomingResult::Running);
  const bool moves = plan.edge != HomingEdge::None || plan.index != 0;
  const bool has_speeds =
      drive.homing_speed_search_ != 0 && drive.homing_speed_zero_ != 0 && drive.homing_acceleration_ != 0;
  if (!plan.is_known || (moves && !has_speeds) || drive.homing_fails_) return fail(drive);
  drive.homing_start_ = static_cast<int8_t>(plan.start);
  drive.homing_edge_ = static_cast<int8_t>(plan.edge);
  drive.homing_signal_ = static_cast<int8_t>(plan.signal);
  drive.homing_index_ = static_cast<int8_t>(plan.index);
  drive.homing_on_limit_ = static_cast<int8_t>(plan.on_limit);
  drive.homing_reversed_ = 0;
  drive.homing_reference_ = drive.machine_position_;
  if (!moves) return attain(drive, drive.machine_position_);
  if (plan.edge == HomingEdge::None) return setPhase(drive, HomingPhase::Index, plan.index);
  const bool is_on_switch = (inputsAt(drive, drive.machine_position_) & plan.signal) != 0;
  if (is_on_switch)
    leaveOrTake(drive, {drive.machine_position_, drive.machine_position_}, nullptr, 0);
  else
    setPhase(drive, HomingPhase::Search, plan.start);
}

void interruptHoming(SimulatedDrive& drive) {
  if (drive.homing_result_ != static_cast<int8_t>(HomingResult::Running)) return;
  setPhase(drive, HomingPhase::Interrupted, 0);
  setResult(drive, HomingResult::None);
}

MotionPoint homingDemand(const SimulatedDrive& drive, MotionPoint from, double seconds) {
  const HomingPhase phase = phaseOf(drive);
  if (phase == HomingPhase::Idle || drive.homing_acceleration_ == 0) return {from.position, 0};
  const bool is_fast = phase == HomingPhase::Search || phase == HomingPhase::Clear;
  const double speed = is_fast ? drive.homing_speed_search_ : drive.homing_speed_zero_;
  return rampVelocity(from, drive.homing_direction_ * speed, drive.homing_acceleration_, seconds);
}

void observeHoming(SimulatedDrive& drive, Way way, uint32_t before) {
  const auto signal = static_cast<Input>(drive.homing_signal_);
  const auto edge = static_cast<HomingEdge>(drive.homing_edge_);
  double position = 0;
  switch (phaseOf(drive)) {
    case HomingPhase::Idle: return;
    case HomingPhase::Search:
      if (findEdge(drive, way, before, signal, true, &position))
        return leaveOrTake(drive, {position, way.to}, &position, way.direction());
      break;
    case HomingPhase::Clear:
      if (findEdge(drive, way, before, signal, false, &position))
        return setPhase(drive, HomingPhase::Approach, -drive.homing_direction_);
      break;
    case HomingPhase::Approach: {
      const bool until = edge == HomingEdge::EntryAlong || edge == HomingEdge::EntryAgainst;
      if (way.direction() == drive.homing_direction_ && findEdge(drive, way, before, signal, until, &position))
        return foundReference(drive, {position, way.to}, position);
      break;
    }
    case HomingPhase::Index:
      searchIndex(drive, way);
      if (phaseOf(drive) != HomingPhase::Index) return;
      break;
    case HomingPhase::Attained:
      if (drive.demand_velocity_ != 0) return;
      drive.zero_ = drive.homing_reference_ + drive.home_offset_;
      drive.homed_ = 1;
      setResult(drive, HomingResult::Attained);
      return setPhase(drive, HomingPhase::Idle, 0);
    case HomingPhase::Failed:
    case HomingPhase::Interrupted:
      if (drive.demand_velocity_ == 0) setPhase(drive, HomingPhase::Idle, 0);
      return;
  }
  if (runsIntoLimit(drive, way.to)) atLimit(drive);
}

uint16_t homingStatus(const SimulatedDrive& drive) {
  constexpr uint16_t kReached = 0x400, kAttained = 0x1000, kError = 0x2000;
  const bool stands = phaseOf(drive) == HomingPhase::Idle;
  switch (static_cast<HomingResult>(drive.homing_result_)) {
    case HomingResult::None: return stands ? kReached : 0;
    case HomingResult::Running: return phaseOf(drive) == HomingPhase::Attained ? kAttained : 0;
    case HomingResult::Attained: return kAttained | kReached;
    case HomingResult::Error: return kError | (stands ? kReached : 0);
  }
  return 0;
}

}  // namespace rung::motion

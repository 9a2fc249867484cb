// SPDX-License-Identifier: Apache-2.0
// Set values: plans of commands, their evaluation in each cycle, and the hand-over from one command to the next.
#include "kernel/axis.h"

#include <math.h>

namespace rung::motion {
namespace {

using namespace rung_sm3_basic;

constexpr double kTolerance = 1e-9;      // of a cycle: a profile that ends so shortly after it ends with it
constexpr double kSamePosition = 1e-12;  // of a turn: rounding must not cost a whole turn

Profile& profileOf(double (&words)[50]) { return *reinterpret_cast<Profile*>(words); }
const Profile& profileOf(const double (&words)[50]) { return *reinterpret_cast<const Profile*>(words); }

State baseOf(const Axis& a) { return {a.base_position_, a.base_velocity_, a.base_acceleration_}; }

void setBase(Axis& a, const State& state) {
  a.base_position_ = state.position;
  a.base_velocity_ = state.velocity;
  a.base_acceleration_ = state.acceleration;
}

void setMotion(Axis& a, const State& state) {
  a.position_ = state.position;
  a.velocity_ = state.velocity;
  a.acceleration_ = state.acceleration;
}

Ramp rampOf(const Axis& a, const Request& request) {
  if (a.eRampType_ == sin2_) return Ramp::Sin2;
  if (a.eRampType_ == quadratic_smooth_) return Ramp::QuadraticSmooth;
  return request.jerk_ > 0 ? Ramp::Quadratic : Ramp::Trapezoid;
}

Motion motionOf(const Request& request) { return static_cast<Motion>(request.kind_); }

bool replan(Axis& a, const State& from) {
  a.planned_override_ = a.override_changes_;
  a.paused_ = a.fVelFactor_ == 0 && motionOf(a.request_) != Motion::Brake ? 1 : 0;
  return plan(a, a.request_, from, profileOf(a.profile_)) == Result::Ok;
}

void noteDone(Axis& a, uint32_t serial) {
  for (size_t i = sizeof a.ended_ / sizeof a.ended_[0] - 1; i > 0; --i) a.ended_[i] = a.ended_[i - 1];
  a.ended_[0] = serial;
}

// The owner is done, `rest` seconds before the end of the cycle.
void noteEnd(Axis& a, double rest) {
  noteDone(a, a.owner_);
  a.ended_rest_ = rest;
  a.ended_cycle_ = a.cycle_;
}

// A new command of the axis.
uint32_t adopt(Axis& a, Command& command) {
  command.serial_ = ++a.serials_;
  command.axis_ = &a;
  command.outcome_ = static_cast<uint8_t>(Outcome::Running);
  command.error_ = SMC_NO_ERROR_;
  command.shown_ = 0;
  return command.serial_;
}

void moveOwner(Axis& a);
double turnedFrom(const Axis& a, const Request& request, double position, int16_t direction, const State& from);

void removeWaiting(Axis& a, size_t index);

// The first buffered command takes over from a state, `rest` seconds before the end of the cycle.
void beginNext(Axis& a, State from, double rest) {
  a.request_ = a.waiting_[0].request_;
  a.owner_ = a.waiting_[0].owner_;
  removeWaiting(a, 0);
  if (a.request_.is_relative_ != 0) a.request_.target_ += from.position;
  a.request_.is_relative_ = 0;
  if (a.request_.turns_ != 0)
    a.request_.target_ = turnedFrom(a, a.request_, a.request_.position_, a.request_.direction_, from);
  a.request_.turns_ = 0;
  a.nAxisState_ = a.request_.state_;
  a.supervised_ = a.cycle_;
  if (motionOf(a.request_) == Motion::Follow) {  // it begins with the next cycle
    from.position += from.velocity * rest;
    setMotion(a, from);
    a.handed_over_ = a.cycle_;
    return;
  }
  setBase(a, from);
  a.begun_ = rest;
  a.tick_ = -1;
  if (!replan(a, from)) fail(a, SMC_AXIS_NOT_READY_FOR_MOTION_);
}

// At rest, also when the set values of this cycle are computed again.
void rest(Axis& a, double position) {
  setMotion(a, {position, 0, 0});
  setBase(a, {position, 0, 0});
  a.request_.kind_ = static_cast<uint8_t>(Motion::None);
}

// Of an axis whose command is done: what is superimposed may still move it.
AxisState restingState(const Axis& a) { return a.extra_.owner_ != 0 ? discrete_motion_ : standstill_; }

// The owner's profile is over by `over` seconds.
void endProfile(Axis& a, double over) {
  const Profile& profile = profileOf(a.profile_);
  const double at_end = over < 0 ? 0 : over;
  const bool at_last_velocity = profile.end_velocity == a.request_.last_velocity_;
  if (a.request_.last_velocity_ != 0 && a.request_.speeds_up_ == 0 && !at_last_velocity) {
    const State from = {profile.end_position, profile.end_velocity, 0};
    a.request_.speeds_up_ = 1;
    setBase(a, from);
    a.begun_ = at_end;
    a.tick_ = -1;
    if (replan(a, from)) return moveOwner(a);
  }
  const bool goes_on = motionOf(a.request_) != Motion::Position && motionOf(a.request_) != Motion::Brake;
  if (motionOf(a.request_) == Motion::Continuous) a.nAxisState_ = continuous_motion_;
  if (a.waiting_count_ != 0 && motionOf(a.request_) != Motion::Brake) {
    const bool is_halt = a.request_.end_velocity_ == 0 && a.nAxisState_ == discrete_motion_;
    if (motionOf(a.request_) == Motion::Position || is_halt) noteEnd(a, at_end);
    beginNext(a, {profile.end_position, profile.end_velocity, 0}, at_end);
    a.advanced_ = a.cycle_ - 1;
    advance(a);
    return;
  }
  if (goes_on) {
    State state = at(profile, duration(profile));
    state.position += state.velocity * at_end;
    setMotion(a, state);
    return;
  }
  rest(a, profile.end_position);
  if (motionOf(a.request_) == Motion::Brake || a.owner_ == 0) {
    if (a.nAxisState_ == stopping_ && a.lock_ == 0) a.nAxisState_ = standstill_;
    return;
  }
  noteEnd(a, at_end);
  a.owner_ = 0;
  if (a.nAxisState_ != stopping_) a.nAxisState_ = restingState(a);
}

void moveOwner(Axis& a) {
  const Motion motion = motionOf(a.request_);
  if (motion == Motion::None) return rest(a, a.base_position_);
  if (motion == Motion::Follow) return;
  if (a.planned_override_ != a.override_changes_ && motion != Motion::Brake) {
    a.begun_ = 0;
    a.tick_ = 0;
    replan(a, baseOf(a));
  }
  const Profile& profile = profileOf(a.profile_);
  const double t = a.begun_ + (a.tick_ + 1) * a.fTaskCycle_;
  const bool is_brake = motion == Motion::Brake;
  if (t >= duration(profile) - kTolerance * a.fTaskCycle_ && (a.paused_ == 0 || is_brake))
    endProfile(a, t - duration(profile));
  else
    setMotion(a, at(profile, t));
}

// The added motion at the end of this cycle. True when it is over in it.
bool moveAdded(const Axis& a, Added& added) {
  if (added.owner_ == 0) {
    added.position_ = added.base_position_;
    added.velocity_ = added.acceleration_ = 0;
    return false;
  }
  const Profile& profile = profileOf(added.profile_);
  const double t = (added.tick_ + 1) * a.fTaskCycle_;
  const bool is_over = t >= duration(profile) - kTolerance * a.fTaskCycle_;
  const State state = at(profile, t);
  added.position_ = is_over ? profile.end_position : state.position;
  added.velocity_ = is_over ? 0 : state.velocity;
  added.acceleration_ = is_over ? 0 : state.acceleration;
  if (!is_over) return false;
  added.base_position_ = added.position_;
  added.base_velocity_ = added.base_acceleration_ = 0;
  return true;
}

// Its command is done.
void endAdded(Axis& a, Added& added) {
  noteDone(a, added.owner_);
  added.owner_ = 0;
}

void moveExtra(Axis& a) {
  if (!moveAdded(a, a.extra_)) return;
  endAdded(a, a.extra_);
  if (a.owner_ == 0 && a.nAxisState_ == discrete_motion_) a.nAxisState_ = standstill_;
}

void movePhase(Axis& a) {
  if (moveAdded(a, a.phase_)) endAdded(a, a.phase_);
}

void show(Axis& a) {
  a.fSetPosition_ = shown(a, a.position_ + a.extra_.position_);
  a.fSetVelocity_ = a.velocity_ + a.extra_.velocity_;
  a.fSetAcceleration_ = a.acceleration_ + a.extra_.acceleration_;
  a.fSetJerk_ = a.fTaskCycle_ > 0 ? (a.fSetAcceleration_ - a.set_acceleration_) / a.fTaskCycle_ : 0;
  if (a.fSetVelocity_ != 0) a.last_direction_ = a.fSetVelocity_ > 0 ? 1 : -1;
}

// Limits that a set value must not pass; the axis brakes from there.
void watch(Axis& a) {
  a.bSWEndSwitchActive_ = 0;
  if (a.bSWLimitEnable_ != 0 && period(a) == 0) {
    const double p = a.fSetPosition_;
    const bool above = p >= a.fSWLimitPositive_, below = p <= a.fSWLimitNegative_;
    a.bSWEndSwitchActive_ = above || below ? 1 : 0;
    const bool leaves = (above && a.fSetVelocity_ > 0) || (below && a.fSetVelocity_ < 0);
    if (leaves && a.nAxisState_ != errorstop_ && a.nAxisState_ != homing_) return fail(a, SMC_DI_SWLIMITS_EXCEEDED_);
  }
  if (a.nAxisState_ == errorstop_) return;
  const double v = fabs(a.fSetVelocity_), acceleration = a.fSetAcceleration_;
  const auto exceeds = [](double value, double limit) { return limit > 0 && value > limit * (1 + 1e-9); };
  if (exceeds(v, a.fMaxVelocity_)) return fail(a, SMC_VD_MAX_VELOCITY_EXCEEDED_);
  const bool grows = acceleration * a.fSetVelocity_ >= 0;
  if (grows && exceeds(fabs(acceleration), a.fMaxAcceleration_)) return fail(a, SMC_VD_MAX_ACCELERATION_EXCEEDED_);
  if (!grows && exceeds(fabs(acceleration), a.fMaxDeceleration_)) return fail(a, SMC_VD_MAX_DECELERATION_EXCEEDED_);
}

// Where the owner and the first `count` commands of the buffer end; false: one of them has no target, or not yet.
bool endOf(const Axis& a, size_t count, double& position) {
  const auto hasTarget = [](const Request& request) {
    return motionOf(request) == Motion::Position || motionOf(request) == Motion::Continuous;
  };
  position = a.request_.target_;
  bool is_known = hasTarget(a.request_);
  for (size_t i = 0; i < count; ++i) {
    const Request& request = a.waiting_[i].request_;
    const bool is_relative = request.is_relative_ != 0;
    is_known = hasTarget(request) && request.turns_ == 0 && (is_known || !is_relative);
    position = is_relative ? position + request.target_ : request.target_;
  }
  return is_known;
}

// The velocity, signed, at which `before`, a motion over `way` to `end`, hands over to the next one without a stop.
double blendVelocity(const Request& before, double way, double end, const Request& next) {
  const double first = before.velocity_, second = next.velocity_;
  double velocity = 0;
  switch (static_cast<MC_BUFFER_MODE_type>(next.buffer_mode_)) {
    case Aborting_:
    case Buffered_: return 0;
    case BlendingLow_: velocity = first < second ? first : second; break;
    case BlendingPrevious_: velocity = first; break;
    case BlendingNext_: velocity = second; break;
    case BlendingHigh_: velocity = first > second ? first : second; break;
  }
  if (motionOf(next) == Motion::Follow) return way > 0 ? velocity : -velocity;
  const double on = motionOf(next) == Motion::Velocity ? next.end_velocity_
                                                       : (next.is_relative_ != 0 ? next.target_ : next.target_ - end);
  if (way == 0 || on == 0 || (way > 0) != (on > 0)) return 0;  // it turns there
  return way > 0 ? velocity : -velocity;
}

// Lets the command before this one of the buffer arrive with the velocity that both agree on; before none, with 0.
void blend(Axis& a, size_t index) {
  Request& before = index == 0 ? a.request_ : a.waiting_[index - 1].request_;
  if (motionOf(before) != Motion::Position) return;
  double begin = a.base_position_, end = 0, velocity = 0;
  const bool is_known = endOf(a, index, end) && (index == 0 || endOf(a, index - 1, begin));
  if (is_known && index < a.waiting_count_)
    velocity = blendVelocity(before, end - begin, end, a.waiting_[index].request_);
  const bool is_faster = fabs(velocity) > before.velocity_;
  const double last = is_faster ? velocity : 0, at_end = is_faster ? 0 : velocity;
  if (before.last_velocity_ == last && before.end_velocity_ == at_end) return;
  before.last_velocity_ = last;
  before.end_velocity_ = at_end;
  if (index != 0) return;
  ++a.override_changes_;
  a.advanced_ = a.cycle_ - 1;
}

void removeWaiting(Axis& a, size_t index) {
  --a.waiting_count_;
  for (size_t i = index; i < a.waiting_count_; ++i) a.waiting_[i] = a.waiting_[i + 1];
}

// To where the speed begins to rise to the last velocity; where the way is too short for that, as fast as it goes.
Result planLastVelocity(const Request& request, const State& from, const Limits& limits, Ramp ramp, Profile& profile) {
  const double own = request.last_velocity_ < 0 ? -limits.velocity : limits.velocity;
  if (request.speeds_up_ != 0) return planVelocity(profile, from, request.last_velocity_, limits, ramp);
  const Result result = planVelocity(profile, {request.target_, own, 0}, request.last_velocity_, limits, ramp);
  if (result != Result::Ok) return result;
  const double begin = 2 * request.target_ - profile.end_position;
  const double way = begin - from.position;
  if ((way > 0) == (own > 0) && planPosition(profile, from, begin, own, limits, ramp) == Result::Ok) return Result::Ok;
  const Limits faster = {fabs(request.last_velocity_), limits.acceleration, limits.deceleration, limits.jerk};
  return planPosition(profile, from, request.target_, request.last_velocity_, faster, ramp);
}

double turnedFrom(const Axis& a, const Request& request, double position, int16_t direction, const State& from) {
  const double turn = period(a);
  if (turn == 0) return inner(a, position);
  const double target = position - turn * floor(position / turn);
  double way = target - shown(a, from.position);  // above -turn, below turn
  if (way < -kSamePosition * turn) way += turn;
  const double back = way <= kSamePosition * turn ? way : way - turn;
  const auto direct = static_cast<MC_Direction_type>(direction);
  bool goes_back = false;
  switch (direct) {
    case positive_: break;
    case negative_: goes_back = true; break;
    case current_: goes_back = a.last_direction_ < 0; break;
    case shortest_: goes_back = way > turn / 2; break;
    case fastest_: {
      Profile there, other;
      Request forward = request, backward = request;
      forward.target_ = from.position + way;
      backward.target_ = from.position + back;
      goes_back = plan(a, forward, from, there) == Result::Ok && plan(a, backward, from, other) == Result::Ok &&
                  duration(other) < duration(there);
      break;
    }
  }
  return from.position + (goes_back ? back : way);
}

}  // namespace

bool isPositive(double value) { return value > 0 && value < HUGE_VAL; }
bool isFinite(double value) { return value - value == 0; }

bool isAxis(const Axis* axis) { return axis != nullptr && axis->wAxisStructID_ == 0xFE12; }

Error refusal(const Axis* axis) {
  if (!isAxis(axis)) return SMC_AXIS_IS_NO_AXIS_REF_;
  switch (static_cast<AxisState>(axis->nAxisState_)) {
    case power_off_: return SMC_REGULATOR_OR_START_NOT_SET_;
    case stopping_:
      return axis->lock_ != 0 && axis->lock_called_ + 1 < axis->cycle_ ? SMC_BLOCKING_MC_STOP_WASNT_CALLED_
                                                                       : SMC_AXIS_NOT_READY_FOR_MOTION_;
    case errorstop_:
    case homing_: return SMC_AXIS_NOT_READY_FOR_MOTION_;
    case standstill_:
    case discrete_motion_:
    case continuous_motion_:
    case synchronized_motion_: break;
  }
  return axis->bDriveStartRealState_ != 0 ? SMC_NO_ERROR_ : SMC_REGULATOR_OR_START_NOT_SET_;
}

double period(const Axis& axis) { return axis.fPositionPeriod_ > 0 ? axis.fPositionPeriod_ : 0; }

double shown(const Axis& axis, double position) {
  const double p = position - axis.origin_, turn = period(axis);
  if (turn == 0) return p;
  const double wrapped = p - turn * floor(p / turn);
  return wrapped >= turn ? 0 : wrapped;
}

void showAt(Axis& a, double position) {
  a.origin_ = a.position_ + a.extra_.position_ - position;
  a.fSetPosition_ = shown(a, a.position_ + a.extra_.position_);
  a.fActPosition_ = shown(a, a.actual_position_);
}

void rescale(Axis& a, double increments, double position_period) {
  const double before = a.fScalefactor_ != 0 ? a.fScalefactor_ : 1;
  a.fScalefactor_ = increments;
  a.fPositionPeriod_ = position_period;
  a.origin_ = 0;
  a.position_ *= before / increments;
  a.base_position_ = a.actual_position_ = a.position_;
  a.fSetPosition_ = a.fActPosition_ = shown(a, a.position_);
}

double inner(const Axis& axis, double position) { return position + axis.origin_; }

State startState(const Axis& a) {
  if (a.ended_cycle_ == a.cycle_ && a.owner_ == 0 && a.advanced_ == a.cycle_)
    return {a.position_ + a.extra_.position_, a.velocity_ + a.extra_.velocity_, 0};
  return {a.base_position_ + a.extra_.base_position_, a.base_velocity_ + a.extra_.base_velocity_,
          a.base_acceleration_ + a.extra_.base_acceleration_};
}

Result plan(const Axis& a, const Request& request, const State& from, Profile& profile) {
  const bool is_brake = motionOf(request) == Motion::Brake;
  const double factor = is_brake ? 1 : a.fVelFactor_;
  const double ramps = is_brake ? 1 : a.fAccFactor_;
  Limits limits = {request.velocity_ * factor, request.acceleration_ * ramps, request.deceleration_ * ramps,
                   request.jerk_ * (is_brake ? 1 : a.fJerkFactor_)};
  const Ramp ramp = rampOf(a, request);
  if (motionOf(request) == Motion::Velocity || is_brake || factor == 0)
    return planVelocity(profile, from, factor == 0 ? 0 : request.end_velocity_ * factor, limits, ramp);
  if (request.last_velocity_ != 0) return planLastVelocity(request, from, limits, ramp, profile);
  double end = request.end_velocity_;
  if (fabs(end) > limits.velocity) end = end > 0 ? limits.velocity : -limits.velocity;
  return motionOf(request) == Motion::Continuous ? planContinuous(profile, from, request.target_, end, limits, ramp)
                                                 : planPosition(profile, from, request.target_, end, limits, ramp);
}

Result planUnscaled(Axis& a, const Request& request, const State& from, Profile& profile) {
  const double factor = a.fVelFactor_;
  a.fVelFactor_ = 1;
  const Result result = plan(a, request, from, profile);
  a.fVelFactor_ = factor;
  return result;
}

State beginState(const Axis& a, const Request& request) {
  double end = 0;
  if (request.buffer_mode_ != Aborting_ && a.owner_ != 0 && endOf(a, a.waiting_count_, end)) return {end, 0, 0};
  return startState(a);
}

void mergeExtra(Axis& a) {
  setBase(a, {a.base_position_ + a.extra_.base_position_, a.base_velocity_ + a.extra_.base_velocity_,
              a.base_acceleration_ + a.extra_.base_acceleration_});
  setMotion(a, {a.position_ + a.extra_.position_, a.velocity_ + a.extra_.velocity_,
                a.acceleration_ + a.extra_.acceleration_});
  a.extra_ = {};
}

double turned(const Axis& a, const Request& request, double position, int16_t direction) {
  return turnedFrom(a, request, position, direction, beginState(a, request));
}

void aim(const Axis& a, Request& request, double position, int16_t direction) {
  double end = 0;
  const bool waits = request.buffer_mode_ != Aborting_ && a.owner_ != 0;
  request.target_ = turned(a, request, position, direction);
  request.turns_ = waits && period(a) != 0 && !endOf(a, a.waiting_count_, end) ? 1 : 0;
  request.position_ = position;
  request.direction_ = direction;
}

bool isWaiting(const Axis& a, uint32_t serial) {
  for (size_t i = 0; i < a.waiting_count_; ++i)
    if (a.waiting_[i].owner_ == serial) return true;
  return false;
}

bool begin(Axis& a, Command& command, const Request& request) {
  const bool waits = request.buffer_mode_ != Aborting_ && a.owner_ != 0;
  // A block has one command: a new edge takes the one that waits out of the buffer, but cannot wait for its own motion.
  const bool is_own = command.axis_ == &a && command.serial_ != 0;
  if (waits && is_own && command.serial_ == a.owner_) return false;
  Request wanted = request;
  const State from = startState(a);
  const bool after_end = a.ended_cycle_ == a.cycle_ && a.owner_ == 0 && a.advanced_ == a.cycle_;
  Profile profile = {};
  if (!waits) {
    if (wanted.is_relative_ != 0) wanted.target_ += from.position;
    wanted.is_relative_ = 0;
  }
  if (motionOf(request) != Motion::Follow) {
    Request probe = wanted;
    if (waits && probe.is_relative_ != 0) probe.target_ += from.position;
    if (plan(a, probe, from, profile) != Result::Ok) return false;
  }
  if (waits) {
    for (size_t i = 0; is_own && i < a.waiting_count_; ++i) {
      if (a.waiting_[i].owner_ != command.serial_) continue;
      removeWaiting(a, i);
      blend(a, i);
    }
    if (a.waiting_count_ == kMostWaiting) return false;
    a.waiting_[a.waiting_count_].request_ = wanted;
    a.waiting_[a.waiting_count_].owner_ = adopt(a, command);
    ++a.waiting_count_;
    blend(a, a.waiting_count_ - 1u);
    return true;
  }
  adopt(a, command);
  mergeExtra(a);
  a.owner_ = command.serial_;
  a.waiting_count_ = 0;
  a.coupled_ = 0;
  a.coupled_master_ = nullptr;
  a.request_ = wanted;
  a.nAxisState_ = wanted.state_;
  if (wanted.state_ != homing_) {
    a.homing_ = 0;
    a.mode_wanted_ = driveMode(a.eControllerMode_);
  }
  if (after_end) setBase(a, from);
  a.begun_ = after_end ? a.ended_rest_ : 0;
  a.tick_ = after_end ? -1 : 0;
  a.planned_override_ = a.override_changes_;
  a.paused_ = a.fVelFactor_ == 0 ? 1 : 0;
  profileOf(a.profile_) = profile;
  a.supervised_ = a.cycle_;
  a.advanced_ = a.cycle_ - 1;
  return true;
}

bool renew(Axis& a, const Command& command, const Request& request) {
  size_t index = 0;
  while (index < a.waiting_count_ && a.waiting_[index].owner_ != command.serial_) ++index;
  const bool waits = index < a.waiting_count_;
  Request& renewed = waits ? a.waiting_[index].request_ : a.request_;
  // That of a motion to a position is 0, or what the next one asks for.
  const bool same_end = motionOf(request) == Motion::Position || renewed.end_velocity_ == request.end_velocity_;
  if (renewed.target_ == request.target_ && same_end && renewed.velocity_ == request.velocity_ &&
      renewed.acceleration_ == request.acceleration_ && renewed.deceleration_ == request.deceleration_ &&
      renewed.jerk_ == request.jerk_)
    return true;
  Profile profile = {};
  if (plan(a, request, startState(a), profile) != Result::Ok) return false;
  const int16_t mode = renewed.buffer_mode_;
  renewed = request;
  renewed.buffer_mode_ = mode;
  if (!waits) {
    a.nAxisState_ = request.state_;
    ++a.override_changes_;
    a.advanced_ = a.cycle_ - 1;
  }
  const size_t next = waits ? index + 1 : 0;
  if (waits) blend(a, index);
  if (next < a.waiting_count_) blend(a, next);
  return true;
}

static bool beginAdded(Axis& a, Added& added, Command& command, const Request& request) {
  Profile profile = {};
  const State from = {added.base_position_, added.base_velocity_, added.base_acceleration_};
  if (plan(a, request, from, profile) != Result::Ok) return false;
  added.owner_ = adopt(a, command);
  added.tick_ = 0;
  profileOf(added.profile_) = profile;
  a.advanced_ = a.cycle_ - 1;
  return true;
}

bool beginExtra(Axis& a, Command& command, const Request& request) {
  Request wanted = request;
  wanted.target_ += a.extra_.base_position_;
  if (!beginAdded(a, a.extra_, command, wanted)) return false;
  if (a.nAxisState_ == standstill_) a.nAxisState_ = discrete_motion_;
  return true;
}

bool beginPhase(Axis& a, Command& command, const Request& request) { return beginAdded(a, a.phase_, command, request); }

void advance(Axis& a) {
  if (a.advanced_ == a.cycle_) return;
  a.advanced_ = a.cycle_;
  moveOwner(a);
  moveExtra(a);
  movePhase(a);
  show(a);
  watch(a);
}

bool isStepTooFar(const Axis& a, double position) {
  const double way = fabs(position - a.base_position_);
  return a.fMaxVelocity_ > 0 && way > a.fMaxVelocity_ * a.fTaskCycle_ * (1 + 1e-6) + 1e-9;
}

void follow(Axis& a, const State& state) {
  // A step is not in the velocity of the state, so watch() would not see it; and the axis must not make it. While the
  // drive homes, the set values are where it is.
  if (a.nAxisState_ != homing_ && isStepTooFar(a, state.position)) return fail(a, SMC_VD_MAX_VELOCITY_EXCEEDED_);
  a.advanced_ = a.cycle_ - 1;
  setMotion(a, state);
  advance(a);
}

State phaseState(Axis& a) {
  movePhase(a);
  return {a.phase_.position_, a.phase_.velocity_, a.phase_.acceleration_};
}

bool handOver(Axis& a, Outcome outcome) {
  if (a.waiting_count_ == 0) return false;
  if (outcome == Outcome::Done) noteDone(a, a.owner_);
  a.coupled_ = 0;
  a.coupled_master_ = nullptr;
  beginNext(a, {a.position_, a.velocity_, a.acceleration_}, 0);
  moveOwner(a);
  return true;
}

void release(Axis& a, Outcome outcome) {
  if (handOver(a, outcome)) return;
  if (outcome == Outcome::Done) noteDone(a, a.owner_);
  a.owner_ = 0;
  a.coupled_ = 0;
  a.coupled_master_ = nullptr;
  if (a.velocity_ == 0) {
    rest(a, a.position_);
    a.nAxisState_ = restingState(a);
    return;
  }
  a.nAxisState_ = continuous_motion_;
  a.request_.kind_ = static_cast<uint8_t>(Motion::Velocity);
  a.request_.end_velocity_ = a.velocity_;
  a.request_.velocity_ = fabs(a.velocity_);
  a.request_.acceleration_ = a.request_.deceleration_ = 1;
  a.request_.jerk_ = 0;
  a.begun_ = 0;
  a.tick_ = -1;
  a.acceleration_ = 0;
  replan(a, {a.position_, a.velocity_, 0});
}

bool isProfileOver(const Axis& a) {
  const Profile& profile = profileOf(a.profile_);
  return a.paused_ == 0 && a.planned_override_ == a.override_changes_ &&
         a.begun_ + (a.tick_ + 1) * a.fTaskCycle_ >= duration(profile) - kTolerance * a.fTaskCycle_;
}

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// Native bodies of gear.st: couplings of a slave to a master. The slave follows the set values that the master has when
// the block is called: call it after the block that moves the master.
#include "blocks/coupling.h"

#include <math.h>

#include "cam/table/quintic.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

enum Phase : uint8_t { kWaiting, kApproaching, kInSync, kMissed };

Error gearError(const MC_GearIn_type& block) {
  if (block.Master_ == block.Slave_ || !isAxis(block.Master_)) return SMC_AXIS_IS_NO_AXIS_REF_;
  if (block.RatioDenominator_ == 0) return SMC_GI_RATIO_DENOM_;
  if (!isBufferMode(block.BufferMode_)) return SMC_AXIS_NOT_READY_FOR_MOTION_;
  if (!isPositive(block.Acceleration_) || block.Jerk_ < 0 || !isFinite(block.Jerk_)) return SMC_GI_INVALID_ACC_;
  return isPositive(block.Deceleration_) ? SMC_NO_ERROR_ : SMC_GI_INVALID_DEC_;
}

double ratioOf(const MC_GearIn_type& block) {
  return static_cast<double>(block.RatioNumerator_) / block.RatioDenominator_;
}

void startGear(MC_GearIn_type& block, Call& call) {
  Error error = refusal(block.Slave_);
  if (error == SMC_NO_ERROR_) error = gearError(block);
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  if (waitsInBuffer(block, call, followRequest(block.Deceleration_))) return;
  call.start(followRequest(block.Deceleration_), SMC_AXIS_NOT_READY_FOR_MOTION_);
  couple(call.axis(), *block.Master_, kGear);
  block.ratio_ = ratioOf(block);
  block.in_gear_ = 0;
}

void runGear(MC_GearIn_type& block, Call& call) {
  Axis& slave = call.axis();
  slave.supervised_ = slave.cycle_;
  block.Master_->master_called_ = slave.cycle_ != 0 ? block.Master_->cycle_ : 0;
  const State master = masterOf(*block.Master_, slave);
  const double velocity = block.ratio_ * master.velocity;
  if (block.in_gear_ != 0) {
    const double position = block.slave_zero_ + block.ratio_ * (master.position - block.master_zero_);
    return follow(slave, {position, velocity, block.ratio_ * master.acceleration});
  }
  Profile profile = {};
  Request ramp = {};
  ramp.kind_ = static_cast<uint8_t>(Motion::Velocity);
  ramp.end_velocity_ = velocity;
  ramp.velocity_ = fabs(velocity);
  ramp.acceleration_ = block.Acceleration_;
  ramp.deceleration_ = block.Deceleration_;
  ramp.jerk_ = block.Jerk_;
  const State from = {slave.base_position_, slave.base_velocity_, slave.base_acceleration_};
  if (planUnscaled(slave, ramp, from, profile) != Result::Ok) return fail(slave, SMC_GI_INVALID_ACC_);
  const State now = at(profile, slave.fTaskCycle_);
  if (duration(profile) <= slave.fTaskCycle_ * (1 + 1e-9)) {
    block.in_gear_ = 1;
    block.slave_zero_ = now.position;
    block.master_zero_ = master.position;
  }
  follow(slave, now);
}

double positionRatio(const MC_GearInPos_type& block) {
  return static_cast<double>(block.RatioNumerator_) / block.RatioDenominator_;
}

// y(x) of the approach: from 0 with `slope` to `travel` with `ratio`, curvature 0 at both ends.
struct Curve {
  double length, travel, slope;
  rung::cam::Quintic quintic;
  double position(double x) const { return quintic.way(x / length); }
  double derivative(double x) const { return slope + quintic.slopeChange(x / length) / length; }
  double curvature(double x) const { return quintic.curvatureChange(x / length) / (length * length); }
  // Tells whether it goes back anywhere: the derivative is a quartic, looked at where it may be lowest.
  bool reverses() const {
    const double sign = travel >= 0 ? 1 : -1;
    const double a = 20 * quintic.c5, b = 12 * quintic.c4,
                 c = 6 * quintic.c3;  // s * (a s² + b s + c) is its derivative
    double places[4] = {0, 1, 0, 0};
    const double root = b * b - 4 * a * c;
    if (a != 0 && root >= 0) {
      places[2] = (-b + sqrt(root)) / (2 * a);
      places[3] = (-b - sqrt(root)) / (2 * a);
    } else if (a == 0 && b != 0) {
      places[2] = -c / b;
    }
    for (const double s : places)
      if (s >= 0 && s <= 1 && sign * derivative(s * length) < -1e-9) return true;
    return false;
  }
};

Curve curveOf(const MC_GearInPos_type& block) {
  const double length = block.master_sync_ - block.master_start_;  // signed
  const double travel = block.slave_sync_ - block.slave_start_;
  return {length, travel, block.slope_, rung::cam::quinticOf({0, block.slope_, 0}, {travel, block.ratio_, 0}, length)};
}

void waitForSync(MC_GearInPos_type& block, Call& call) {
  Error error = refusal(block.Slave_);
  if (error == SMC_NO_ERROR_ && (block.Master_ == block.Slave_ || !isAxis(block.Master_)))
    error = SMC_AXIS_IS_NO_AXIS_REF_;
  if (error == SMC_NO_ERROR_ && block.RatioDenominator_ == 0) error = SMC_GI_RATIO_DENOM_;
  const bool finite =
      isFinite(block.MasterSyncPosition_) && isFinite(block.SlaveSyncPosition_) && isFinite(block.MasterStartDistance_);
  if (error == SMC_NO_ERROR_ && (!finite || (block.AvoidReversal_ != 0 && period(*block.Slave_) == 0)))
    error = SMC_AXIS_NOT_READY_FOR_MOTION_;
  if (error == SMC_NO_ERROR_ && !isBufferMode(block.BufferMode_)) error = SMC_AXIS_NOT_READY_FOR_MOTION_;
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  const bool has_waited = block.waits_ != 0 && !call.rises();
  if (waitsInBuffer(block, call, followRequest(0))) return;
  if (!has_waited) call.launch();
  const Axis& master = *block.Master_;
  const double now = stateOf(master).position, turn = period(master);
  const double sign = master.fSetVelocity_ < 0 ? -1 : 1;
  block.ratio_ = positionRatio(block);
  block.phase_ = kWaiting;
  if (block.MasterStartDistance_ <= 0) {  // from where the master is
    const double way =
        turn == 0 ? inner(master, block.MasterSyncPosition_) - now : block.MasterSyncPosition_ - shown(master, now);
    block.master_start_ = now;
    block.master_sync_ = now + (turn != 0 && sign * way < 0 ? way + sign * turn : way);
  } else {
    block.master_sync_ = inner(master, block.MasterSyncPosition_);
    block.master_start_ = block.master_sync_ - sign * block.MasterStartDistance_;
    if (turn > 0) {  // the next time that it comes there
      const double ahead = sign * (block.master_start_ - now);
      const double shift = sign * turn * ceil(-ahead / turn);
      block.master_start_ += shift;
      block.master_sync_ += shift;
    }
  }
  // A linear master that is past the start never comes there.
  if (turn == 0 && sign * (now - block.master_start_) > 0 && block.MasterStartDistance_ > 0) block.phase_ = kMissed;
}

bool beginApproach(MC_GearInPos_type& block, Call& call) {
  Axis& slave = call.axis();
  const State from = startState(slave);
  const double master_velocity = block.Master_->fSetVelocity_;
  const bool turns = period(slave) > 0;
  block.slave_start_ = from.position;
  block.slave_sync_ = turns ? from.position + block.SlaveSyncPosition_ - shown(slave, from.position)
                            : inner(slave, block.SlaveSyncPosition_);
  block.slope_ = master_velocity != 0 ? from.velocity / master_velocity : 0;
  if (block.AvoidReversal_ != 0) {
    const double sign = block.ratio_ * (block.master_sync_ - block.master_start_) < 0 ? -1 : 1;
    int added = 0;
    const auto goesBack = [&] {
      return (block.slave_sync_ - block.slave_start_) * sign < 0 || curveOf(block).reverses();
    };
    while (goesBack() && added < 5) block.slave_sync_ += sign * period(slave), ++added;
    if (goesBack()) {
      fail(slave, SMC_AXIS_NOT_READY_FOR_MOTION_);
      call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
      return false;
    }
  }
  const State at_begin = from;
  call.start(followRequest(0), SMC_AXIS_NOT_READY_FOR_MOTION_);
  couple(slave, *block.Master_, kGear);
  block.slave_start_ = at_begin.position;
  block.phase_ = kApproaching;
  return true;
}

// A command that was buffered has the axis before its master comes: the axis goes on as it was.
void keepOn(Call& call) {
  if (!call.follows()) return;
  Axis& slave = call.axis();
  slave.supervised_ = slave.cycle_;
  follow(slave, {slave.base_position_ + slave.base_velocity_ * slave.fTaskCycle_, slave.base_velocity_, 0});
}

void runApproach(MC_GearInPos_type& block, Call& call) {
  Axis& slave = call.axis();
  slave.supervised_ = slave.cycle_;
  block.Master_->master_called_ = block.Master_->cycle_;
  const State master = masterOf(*block.Master_, slave);
  const Curve curve = curveOf(block);
  const double x = master.position - block.master_start_;
  const double sign = curve.length < 0 ? -1 : 1;
  if (block.phase_ == kApproaching && sign * master.velocity < 0) {
    fail(slave, SMC_GIP_MASTER_DIRECTION_CHANGE_);
    return;
  }
  if (block.phase_ == kApproaching && sign * x >= sign * curve.length) block.phase_ = kInSync;
  if (block.phase_ == kInSync) {
    follow(slave, {block.slave_sync_ + block.ratio_ * (master.position - block.master_sync_),
                   block.ratio_ * master.velocity, block.ratio_ * master.acceleration});
    return;
  }
  const double slope = curve.derivative(x);
  follow(slave, {block.slave_start_ + curve.position(x), slope * master.velocity,
                 curve.curvature(x) * master.velocity * master.velocity + slope * master.acceleration});
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_GearIn(rung_context*, MC_GearIn_type* self) {
  Call call(self->Slave_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    if (call.isOwner() && self->waits_ == 0 && gearError(*self) == SMC_NO_ERROR_) {
      if (ratioOf(*self) != self->ratio_) {  // a new ramp; without a change nothing happens
        self->ratio_ = ratioOf(*self);
        self->in_gear_ = 0;
      }
    } else {
      startGear(*self, call);
    }
  }
  takeOver(*self, call, startGear);
  if (call.follows()) runGear(*self, call);
  if (call.follows() && self->in_gear_ != 0) handOver(call.axis(), Outcome::Aborted);
  call.run();
  self->Active_ = call.isOwner() ? 1 : 0;
  self->InGear_ = call.isOwner() && self->waits_ == 0 && self->in_gear_ != 0 ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_GearOut(rung_context*, MC_GearOut_type* self) { decouple(*self, kGear); }

void rung_sm3_basic_MC_GearInPos(rung_context*, MC_GearInPos_type* self) {
  Call call(self->Slave_, self->command_, self->Execute_ != 0);
  if (call.rises()) waitForSync(*self, call);
  takeOver(*self, call, waitForSync);
  if (call.isRunning() && self->waits_ == 0 && (self->phase_ == kWaiting || self->phase_ == kMissed)) keepOn(call);
  if (call.isRunning() && self->waits_ == 0 && self->phase_ == kWaiting) {
    const double sign = self->master_sync_ < self->master_start_ ? -1 : 1;
    const double now = stateOf(*self->Master_).position;
    const bool enters = sign * (now - self->master_start_) >= -1e-12 * fabs(now);
    const Error error = refusal(self->Slave_);
    if (error != SMC_NO_ERROR_)
      call.refuse(error);
    else if (enters)
      beginApproach(*self, call);
  }
  const bool moves = self->waits_ == 0 && (self->phase_ == kApproaching || self->phase_ == kInSync);
  if (call.follows() && moves) runApproach(*self, call);
  if (call.follows() && moves && self->phase_ == kInSync) handOver(call.axis(), Outcome::Aborted);
  if (moves || self->waits_ != 0) call.run();
  self->Active_ = call.isOwner() ? 1 : 0;
  self->StartSync_ = call.isOwner() && moves && self->phase_ == kApproaching ? 1 : 0;
  self->InSync_ = call.isOwner() && moves && self->phase_ == kInSync ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_Phasing(rung_context*, MC_Phasing_type* self) {
  Call call(self->Slave_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    Axis& slave = call.axis();
    const bool is_coupled = slave.coupled_ != kNone && isAxis(self->Master_) && slave.coupled_master_ == self->Master_;
    Request request = {};
    request.kind_ = static_cast<uint8_t>(Motion::Position);
    request.target_ = self->PhaseShift_;
    request.velocity_ = self->Velocity_;
    request.acceleration_ = self->Acceleration_;
    request.deceleration_ = self->Deceleration_;
    request.jerk_ = self->Jerk_;
    if (!is_coupled)
      call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
    else if (!isPositive(self->Velocity_) || !isPositive(self->Acceleration_) || !isPositive(self->Deceleration_) ||
             self->Jerk_ < 0 || !isFinite(self->Jerk_) || !isFinite(self->PhaseShift_))
      call.refuse(SMC_PH_INVALID_VELACCDEC_);
    else if (self->Master_->fPositionPeriod_ < 0)
      call.refuse(SMC_PH_ROTARYAXIS_PERIOD0_);
    else if (!beginPhase(slave, self->command_, request))
      call.refuse(SMC_PH_INVALID_VELACCDEC_);
  }
  if (call.isRunning() && call.axis().coupled_ == kNone) {  // the coupling has ended
    call.axis().phase_.owner_ = 0;
    self->command_.outcome_ = static_cast<uint8_t>(Outcome::Aborted);
    self->command_.shown_ = 0;
  }
  if (call.isRunning()) phaseState(call.axis());
  call.update();
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

}  // extern "C"

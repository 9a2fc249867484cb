// SPDX-License-Identifier: Apache-2.0
// Native bodies of direct.st: axes that follow positions from the program, and slaves with backlash.
#include "blocks/coupling.h"

#include <math.h>

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

enum Phase : uint8_t { kFollowing, kInGap, kStopping };

bool areDynamics(double velocity, double acceleration, double deceleration, double jerk) {
  return isPositive(velocity) && isPositive(acceleration) && isPositive(deceleration) && jerk >= 0 && isFinite(jerk);
}

// ---- SMC_ControlAxisByPos

// The set position in the kernel's count; on a modulo axis the nearest one.
double targetOf(const SMC_ControlAxisByPos_type& block, const Axis& axis) {
  const double target = inner(axis, block.fSetPosition_), turn = period(axis);
  if (turn == 0) return target;
  return target + turn * floor((startState(axis).position - target) / turn + 0.5);
}

Request wayTo(double target, double velocity, double acceleration, double deceleration, double jerk) {
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Position);
  request.target_ = target;
  request.velocity_ = velocity;
  request.acceleration_ = acceleration;
  request.deceleration_ = deceleration;
  request.jerk_ = jerk;
  return request;
}

Error directError(const SMC_ControlAxisByPos_type& block) {
  const Error error = refusal(block.Axis_);
  if (error != SMC_NO_ERROR_) return error;
  if (!isFinite(block.fSetPosition_)) return SMC_AXIS_NOT_READY_FOR_MOTION_;
  const bool good = areDynamics(block.fGapVelocity_, block.fGapAcceleration_, block.fGapDeceleration_, block.fGapJerk_);
  return good ? SMC_NO_ERROR_ : SMC_CA_INVALID_ACCDEC_VALUES_;
}

bool planGap(SMC_ControlAxisByPos_type& block, Axis& axis, double target) {
  const Request request =
      wayTo(target, block.fGapVelocity_, block.fGapAcceleration_, block.fGapDeceleration_, block.fGapJerk_);
  block.target_ = target;
  block.gap_cycle_ = axis.cycle_;
  return planUnscaled(axis, request, startState(axis), *reinterpret_cast<Profile*>(block.gap_)) == Result::Ok;
}

void runGap(SMC_ControlAxisByPos_type& block, Axis& axis) {
  const Profile& gap = *reinterpret_cast<const Profile*>(block.gap_);
  const double t = (axis.cycle_ - block.gap_cycle_ + 1) * axis.fTaskCycle_;
  if (t < duration(gap) - 1e-9 * axis.fTaskCycle_) return follow(axis, at(gap, t));
  block.phase_ = kFollowing;
  follow(axis, {block.target_, 0, 0});
}

void runDirect(SMC_ControlAxisByPos_type& block, Call& call) {
  Axis& axis = call.axis();
  axis.supervised_ = axis.cycle_;
  if (!isFinite(block.fSetPosition_)) return fail(axis, SMC_AXIS_NOT_READY_FOR_MOTION_);
  const State from = startState(axis);
  const double target = targetOf(block, axis), cycle = axis.fTaskCycle_;
  const bool opens = block.phase_ == kFollowing && block.bAvoidGaps_ != 0 && isStepTooFar(axis, target);
  if (opens || (block.phase_ == kInGap && target != block.target_)) {
    block.phase_ = kInGap;
    if (!planGap(block, axis, target)) return fail(axis, SMC_CA_INVALID_ACCDEC_VALUES_);
  }
  if (block.phase_ == kInGap) return runGap(block, axis);
  const double velocity = (target - from.position) / cycle;
  follow(axis, {target, velocity, (velocity - from.velocity) / cycle});
}

void brakeDirect(SMC_ControlAxisByPos_type& block, Call& call) {
  Axis& axis = call.axis();
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Velocity);
  request.state_ = axis.fSetVelocity_ == 0 ? standstill_ : discrete_motion_;
  request.velocity_ = fabs(axis.fSetVelocity_);
  request.acceleration_ = request.deceleration_ = block.fGapDeceleration_;
  request.jerk_ = block.fGapJerk_;
  block.phase_ = kStopping;
  call.start(request, SMC_CA_INVALID_ACCDEC_VALUES_);
}

// ---- SMC_BacklashCompensation

Error backlashError(const SMC_BacklashCompensation_type& block) {
  const Error error = refusal(block.Slave_);
  if (error != SMC_NO_ERROR_) return error;
  if (block.Master_ == block.Slave_ || !isAxis(block.Master_)) return SMC_AXIS_IS_NO_AXIS_REF_;
  const bool good = areDynamics(block.fCompensationVel_, block.fCompensationAcc_, block.fCompensationDec_,
                                block.fCompensationJerk_) &&
                    block.fBacklash_ >= 0 && isFinite(block.fBacklash_) && block.eBacklashMode_ >= SMC_BL_NEGATIVE_ &&
                    block.eBacklashMode_ <= SMC_BL_AUTO_ && block.eBacklashStartState_ >= SMC_BL_START_NEGATIVE_ &&
                    block.eBacklashStartState_ <= SMC_BL_START_POSITIVE_;
  if (!good) return SMC_AXIS_NOT_READY_FOR_MOTION_;
  const double turn = period(*block.Slave_);
  return turn > 0 && block.fBacklash_ > turn / 2 ? SMC_BC_BL_TOO_BIG_ : SMC_NO_ERROR_;
}

void startBacklash(SMC_BacklashCompensation_type& block, Call& call) {
  const Error error = backlashError(block);
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  Axis& slave = call.axis();
  const double turn = period(slave);
  block.slave_zero_ = inner(slave, 0) - inner(*block.Master_, 0);
  if (turn > 0) {
    const double way = startState(slave).position - (block.slave_zero_ + stateOf(*block.Master_).position);
    block.slave_zero_ += turn * floor(way / turn + 0.5);
  }
  call.start(followRequest(block.fCompensationDec_), SMC_AXIS_NOT_READY_FOR_MOTION_);
  couple(slave, *block.Master_, kBacklash);
  block.first_side_ = block.side_ = block.eBacklashStartState_;
  block.target_ = 0;
  block.is_ramping_ = 0;
}

int16_t sideOf(const SMC_BacklashCompensation_type& block, double master_velocity) {
  if (block.eBacklashMode_ != SMC_BL_AUTO_) return block.eBacklashMode_;
  return master_velocity == 0 ? block.side_ : static_cast<int16_t>(master_velocity > 0 ? 1 : -1);
}

// The offset to the master, `cycles` after the ramp began.
State compensation(const SMC_BacklashCompensation_type& block, const Axis& slave, double cycles) {
  if (block.is_ramping_ == 0) return {block.target_, 0, 0};
  return at(*reinterpret_cast<const Profile*>(block.ramp_), cycles * slave.fTaskCycle_);
}

bool turnOver(SMC_BacklashCompensation_type& block, Axis& slave, int16_t side) {
  const State from = compensation(block, slave, slave.cycle_ - block.ramp_cycle_);
  const Request request = wayTo((side - block.first_side_) * block.fBacklash_, block.fCompensationVel_,
                                block.fCompensationAcc_, block.fCompensationDec_, block.fCompensationJerk_);
  block.side_ = side;
  block.target_ = request.target_;
  block.is_ramping_ = 1;
  block.ramp_cycle_ = slave.cycle_;
  return planUnscaled(slave, request, from, *reinterpret_cast<Profile*>(block.ramp_)) == Result::Ok;
}

void runBacklash(SMC_BacklashCompensation_type& block, Call& call) {
  Axis& slave = call.axis();
  slave.supervised_ = slave.cycle_;
  block.Master_->master_called_ = block.Master_->cycle_;
  const State master = masterOf(*block.Master_, slave);
  const int16_t side = sideOf(block, master.velocity);
  if (side != block.side_ && !turnOver(block, slave, side)) return fail(slave, SMC_AXIS_NOT_READY_FOR_MOTION_);
  const double cycles = slave.cycle_ - block.ramp_cycle_ + 1.0;
  const Profile& ramp = *reinterpret_cast<const Profile*>(block.ramp_);
  if (block.is_ramping_ != 0 && (cycles + 1e-9) * slave.fTaskCycle_ >= duration(ramp)) block.is_ramping_ = 0;
  const State added = compensation(block, slave, cycles);
  follow(slave, {block.slave_zero_ + master.position + added.position, master.velocity + added.velocity,
                 master.acceleration + added.acceleration});
}

}  // namespace

extern "C" {

void rung_sm3_basic_SMC_ControlAxisByPos(rung_context*, SMC_ControlAxisByPos_type* self) {
  Call call(self->Axis_, self->command_, self->bEnable_ != 0);
  if (call.rises()) {
    const Error error = directError(*self);
    if (error != SMC_NO_ERROR_) {
      call.refuse(error);
    } else {
      call.start(followRequest(self->fGapDeceleration_), SMC_AXIS_NOT_READY_FOR_MOTION_);
      self->phase_ = kFollowing;
    }
  }
  if (call.isOwner() && self->bEnable_ == 0 && self->phase_ != kStopping) brakeDirect(*self, call);
  if (call.isOwner() && self->phase_ != kStopping) runDirect(*self, call);
  call.run();
  if (call.isOwner() && self->phase_ == kStopping && isProfileOver(call.axis())) {
    call.axis().velocity_ = call.axis().acceleration_ = 0;
    release(call.axis());
    call.done();
  }
  self->bStopIpo_ = call.isOwner() && self->phase_ == kInGap ? 1 : 0;
  self->bCommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->bBusy_, self->bError_, self->iErrorID_);
}

void rung_sm3_basic_SMC_BacklashCompensation(rung_context*, SMC_BacklashCompensation_type* self) {
  Call call(self->Slave_, self->command_, self->bExecute_ != 0);
  if (call.rises()) startBacklash(*self, call);
  if (call.isOwner()) runBacklash(*self, call);
  call.run();
  self->bCompensating_ = call.isOwner() && self->is_ramping_ != 0 ? 1 : 0;
  self->bCommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->bBusy_, self->bError_, self->iErrorID_);
}

}  // extern "C"

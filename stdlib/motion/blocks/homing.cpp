// SPDX-License-Identifier: Apache-2.0
// Native bodies of homing.st.
#include "blocks/coupling.h"

#include <math.h>

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

enum HomePhase : uint8_t { kMode, kBegins, kSearches, kBack };
enum Phase : uint8_t { kFast, kBraking, kSlow, kIndex, kStopping, kReturning };

constexpr uint32_t kPatience = 1000;  // cycles for the drive's answer
constexpr uint16_t kTargetReached = 1u << 10, kAttained = 1u << 12, kHomingError = 1u << 13;

void refuseHome(Call& call, Axis& axis, Error error) {
  axis.homing_ = 0;
  axis.mode_wanted_ = driveMode(axis.eControllerMode_);
  release(axis, Outcome::Aborted);
  call.refuse(error);
}

void startHome(MC_Home_type& block, Call& call) {
  const bool waits = call.rises() && block.BufferMode_ != Aborting_ && isAxis(block.Axis_) && block.Axis_->owner_ != 0;
  const bool has_waited = !call.rises();
  const Error error = refusal(block.Axis_);
  if (error == SMC_REGULATOR_OR_START_NOT_SET_) return call.refuse(error);
  if (block.BufferMode_ != Aborting_ && block.BufferMode_ != Buffered_)
    return call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
  const bool rests = has_waited ? block.Axis_->velocity_ == 0 : block.Axis_->nAxisState_ == standstill_;
  if (!rests && !waits) return call.refuse(SMC_H_AXIS_WASNT_STANDSTILL_);
  if (!isFinite(block.Position_)) return call.refuse(SMC_H_AXIS_DIDNT_START_HOMING_);
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Follow);
  request.state_ = homing_;
  if (waitsInBuffer(block, call, request)) return;
  call.start(request, SMC_H_AXIS_DIDNT_START_HOMING_);
  block.phase_ = kMode;
  block.cycles_ = 0;
  block.last_cycle_ = call.axis().cycle_ - 1;
}

// The drive searches; the set values follow it.
void runHome(MC_Home_type& block, Call& call) {
  Axis& axis = call.axis();
  axis.supervised_ = axis.cycle_;
  if (axis.bVirtual_ != 0) {
    follow(axis, {axis.position_, 0, 0});
    showAt(axis, block.Position_);
    if (block.cycles_++ > 0) release(axis), call.done();
    return;
  }
  follow(axis, {axis.actual_position_, 0, 0});
  const uint16_t status = axis.drive_.statusword_;
  if (axis.bCommunication_ == 0) return refuseHome(call, axis, SMC_H_AXIS_DIDNT_ANSWER_);
  const uint32_t cycles = ++block.cycles_;
  const auto next = [&](uint8_t phase) {
    block.phase_ = phase;
    block.cycles_ = 0;
  };
  switch (static_cast<HomePhase>(block.phase_)) {
    case kMode:
      axis.mode_wanted_ = 6;
      if (axis.drive_.mode_display_ == 6)
        axis.homing_ = 1, block.had_error_ = (status & kHomingError) != 0, next(kBegins);
      else if (cycles > kPatience)
        refuseHome(call, axis, SMC_H_AXIS_DIDNT_START_HOMING_);
      return;
    case kBegins:
      if ((status & kHomingError) == 0) block.had_error_ = 0;  // of the homing before
      if ((status & kHomingError) != 0 && block.had_error_ == 0)
        return refuseHome(call, axis, SMC_H_ERROR_WHEN_STOPPING_);
      if ((status & (kAttained | kHomingError)) == 0 && cycles > 1) return next(kSearches);
      // A search that takes no time, such as method 35, is over before its begin is seen.
      if ((status & kAttained) != 0 && cycles > 3) return next(kSearches);
      if (cycles > kPatience) refuseHome(call, axis, SMC_H_AXIS_DIDNT_START_HOMING_);
      return;
    case kSearches:
      if ((status & kHomingError) != 0) return refuseHome(call, axis, SMC_H_ERROR_WHEN_STOPPING_);
      if ((status & kAttained) == 0 || (status & kTargetReached) == 0) {
        if ((status & kTargetReached) != 0 && (status & kAttained) == 0 && cycles > kPatience)
          refuseHome(call, axis, SMC_H_AXIS_DIDNT_START_HOMING_);
        return;
      }
      axis.homing_ = 0;
      axis.mode_wanted_ = driveMode(axis.eControllerMode_);
      showAt(axis, block.Position_);
      next(kBack);
      return;
    case kBack:
      if (axis.drive_.mode_display_ == axis.mode_wanted_) {
        release(axis);
        call.done();
      } else if (cycles > kPatience) {
        refuseHome(call, axis, SMC_H_AXIS_DIDNT_ANSWER_);
      }
      return;
  }
}

bool isValid(const SMC_Homing_type& block) {
  const bool is_mode =
      block.nHomingMode_ >= FAST_BSLOW_S_STOP_ && block.nHomingMode_ <= FAST_SLOW_I_S_STOP_ && block.nHomingMode_ != 3;
  return is_mode && isPositive(block.fVelocitySlow_) && isPositive(block.fVelocityFast_) &&
         isPositive(block.fAcceleration_) && isPositive(block.fDeceleration_) && block.fJerk_ >= 0 &&
         isFinite(block.fJerk_) && isFinite(block.fHomePosition_) && isFinite(block.fSignalDelay_) &&
         (block.nDirection_ == negative_ || block.nDirection_ == positive_);
}

bool reverses(const SMC_Homing_type& block) { return block.nHomingMode_ <= FAST_BSLOW_I_S_STOP_; }
bool stopsFirst(const SMC_Homing_type& block) {
  return block.nHomingMode_ == FAST_BSLOW_STOP_S_ || block.nHomingMode_ == FAST_SLOW_STOP_S_;
}
bool hasIndex(const SMC_Homing_type& block) {
  return block.nHomingMode_ == FAST_BSLOW_I_S_STOP_ || block.nHomingMode_ == FAST_SLOW_I_S_STOP_;
}

void go(SMC_Homing_type& block, Call& call, Phase phase, double velocity) {
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Velocity);
  request.state_ = homing_;
  request.velocity_ = fabs(velocity);
  request.end_velocity_ = velocity;
  request.acceleration_ = block.fAcceleration_;
  request.deceleration_ = block.fDeceleration_;
  request.jerk_ = block.fJerk_;
  block.phase_ = phase;
  if (phase == kReturning) {
    request.kind_ = static_cast<uint8_t>(Motion::Position);
    request.velocity_ = block.fVelocityFast_;
    request.end_velocity_ = 0;
    request.target_ = inner(call.axis(), 0);
    if (period(call.axis()) > 0) request.target_ = turned(call.axis(), request, 0, shortest_);
  }
  call.start(request, SMC_3SH_INVALID_VELACC_VALUES_);
}

void startHoming(SMC_Homing_type& block, Call& call) {
  const Axis* const axis = block.Axis_;
  const Error error = refusal(axis);
  if (error != SMC_NO_ERROR_) return call.refuse(error);
  if (axis->nAxisState_ != standstill_) return call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
  if (!isValid(block)) return call.refuse(SMC_3SH_INVALID_VELACC_VALUES_);
  if (block.bIgnoreHWLimit_ != 0 && !reverses(block)) return call.refuse(SMC_3SH_MODE_NEEDS_HWLIMIT_);
  const int fast = block.nDirection_ == negative_ ? -1 : 1;
  block.sign_ = reverses(block) ? -fast : fast;
  block.bStartLatchingIndex_ = 0;
  if (block.bReferenceSwitch_ != 0)
    go(block, call, kFast, fast * block.fVelocityFast_);
  else
    go(block, call, kSlow, block.sign_ * block.fVelocitySlow_);
}

// The end of a search: back to 0 where that is asked for.
void finish(SMC_Homing_type& block, Call& call) {
  if (block.bReturnToZero_ != 0) return go(block, call, kReturning, 0);
  release(call.axis());
  call.done();
}

void runHoming(SMC_Homing_type& block, Call& call) {
  Axis& axis = call.axis();
  const bool is_open = block.bReferenceSwitch_ != 0;
  const bool rests = isProfileOver(axis) && axis.request_.end_velocity_ == 0;
  switch (static_cast<Phase>(block.phase_)) {
    case kFast:
      if (!is_open) go(block, call, kBraking, 0);
      break;
    case kBraking:
      if (rests) go(block, call, kSlow, block.sign_ * block.fVelocitySlow_);
      break;
    case kSlow:
      if (!is_open) break;
      if (hasIndex(block)) {
        block.bStartLatchingIndex_ = 1;
        block.phase_ = kIndex;
        break;
      }
      if (!stopsFirst(block))
        showAt(axis,
               block.fHomePosition_ + (block.fSignalDelay_ + axis.fTaskCycle_) * block.fVelocitySlow_ * block.sign_);
      go(block, call, kStopping, 0);
      break;
    case kIndex:
      if (block.bIndexOccured_ == 0) break;
      block.bStartLatchingIndex_ = 0;
      showAt(axis, axis.fSetPosition_ - block.fIndexPosition_ + block.fHomePosition_);
      go(block, call, kStopping, 0);
      break;
    case kStopping:
      if (!rests) break;
      if (stopsFirst(block)) showAt(axis, block.fHomePosition_);
      finish(block, call);
      break;
    case kReturning: break;
  }
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_Home(rung_context*, MC_Home_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) startHome(*self, call);
  takeOver(*self, call, startHome);
  if (call.follows() && self->last_cycle_ != call.axis().cycle_) {
    self->last_cycle_ = call.axis().cycle_;
    runHome(*self, call);
  }
  call.run();
  self->Active_ = call.isOwner() ? 1 : 0;
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_SMC_Homing(rung_context*, SMC_Homing_type* self) {
  Call call(self->Axis_, self->command_, self->bExecute_ != 0);
  if (call.rises() && !call.isRunning()) startHoming(*self, call);
  call.run();
  if (call.isOwner() && !call.rises()) runHoming(*self, call);
  call.run();
  self->bDone_ = call.is(Outcome::Done) ? 1 : 0;
  self->bCommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  if (!call.isRunning()) self->bStartLatchingIndex_ = 0;
  call.show(self->bBusy_, self->bError_, self->nErrorID_);
}

}  // extern "C"

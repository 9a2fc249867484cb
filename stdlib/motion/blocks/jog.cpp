// SPDX-License-Identifier: Apache-2.0
// Native bodies of jog.st.
#include "kernel/axis.h"

#include <math.h>

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

template <class Block>
Request stopRequest(const Block& block, AxisState state) {
  Request request = {};
  request.kind_ = static_cast<uint8_t>(Motion::Velocity);
  request.state_ = state;
  request.velocity_ = fabs(block.Axis_->fSetVelocity_);
  request.acceleration_ = block.Acceleration_;
  request.deceleration_ = block.Deceleration_;
  request.jerk_ = block.Jerk_;
  return request;
}

template <class Block>
bool areLimits(const Block& block) {
  return isPositive(block.Velocity_) && isPositive(block.Acceleration_) && isPositive(block.Deceleration_) &&
         block.Jerk_ >= 0 && isFinite(block.Jerk_);
}

template <class Block>
void show(Block& block, Call& call) {
  if (call.is(Outcome::Done)) block.command_.outcome_ = static_cast<uint8_t>(Outcome::Idle);
  block.CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(block.Busy_, block.Error_, block.ErrorId_);
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_Jog(rung_context*, MC_Jog_type* self) {
  const bool forward = self->JogForward_ != 0, backward = self->JogBackward_ != 0;
  Call call(self->Axis_, self->command_, forward || backward);
  const int wanted = forward == backward ? 0 : forward ? 1 : -1;
  if (!forward && !backward) self->locked_ = 0;
  if (call.is(Outcome::Aborted) || call.is(Outcome::Failed)) self->locked_ = forward || backward ? 1 : 0;
  const bool may = self->locked_ == 0;
  if (may && wanted != 0 && wanted != (call.isRunning() ? self->direction_ : 0)) {
    const Error error = refusal(self->Axis_);
    if (error != SMC_NO_ERROR_) {
      call.refuse(error);
      self->locked_ = 1;
    } else if (!areLimits(*self)) {
      call.refuse(SMC_MV_INVALID_ACCDEC_VALUES_);
      self->locked_ = 1;
    } else {
      Request request = stopRequest(*self, continuous_motion_);
      const double limit = self->Axis_->fMaxJogVelocity_;
      request.velocity_ = limit > 0 && self->Velocity_ > limit ? limit : self->Velocity_;
      request.end_velocity_ = wanted * request.velocity_;
      call.start(request, SMC_MV_INVALID_ACCDEC_VALUES_);
      self->direction_ = static_cast<int16_t>(wanted);
    }
  } else if (call.isOwner() && wanted == 0 && self->direction_ != 0) {
    call.start(stopRequest(*self, continuous_motion_), SMC_MV_INVALID_ACCDEC_VALUES_);
    self->direction_ = 0;
  }
  call.run();
  if (call.isOwner() && self->direction_ == 0 && isProfileOver(call.axis())) {
    release(call.axis());
    call.done();
  }
  if (!call.isRunning()) self->direction_ = 0;
  show(*self, call);
}

void rung_sm3_basic_SMC_Inch(rung_context*, SMC_Inch_type* self) {
  const bool forward = self->InchForward_ != 0, backward = self->InchBackward_ != 0;
  Call call(self->Axis_, self->command_, forward || backward);
  const bool rises = (forward && self->last_forward_ == 0) || (backward && self->last_backward_ == 0);
  self->last_forward_ = self->InchForward_;
  self->last_backward_ = self->InchBackward_;
  const int wanted = forward == backward ? 0 : forward ? 1 : -1;
  if (rises && wanted != 0) {
    const Error error = refusal(self->Axis_);
    if (error != SMC_NO_ERROR_) {
      call.refuse(error);
    } else if (!areLimits(*self) || !isFinite(self->Distance_)) {
      call.refuse(SMC_MR_INVALID_VELACC_VALUES_);
    } else {
      Request request = stopRequest(*self, discrete_motion_);
      request.kind_ = static_cast<uint8_t>(Motion::Position);
      request.velocity_ = self->Velocity_;
      request.target_ = wanted * self->Distance_;
      request.is_relative_ = 1;
      call.start(request, SMC_MR_INVALID_VELACC_VALUES_);
      self->direction_ = static_cast<int16_t>(wanted);
    }
  } else if (call.isOwner() && wanted != self->direction_ && self->direction_ != 0) {
    call.start(stopRequest(*self, discrete_motion_), SMC_MR_INVALID_VELACC_VALUES_);
    self->direction_ = 0;
  }
  call.run();
  if (call.isOwner() && self->direction_ == 0 && isProfileOver(call.axis())) {
    release(call.axis());
    call.done();
  }
  if (!call.isRunning()) self->direction_ = 0;
  show(*self, call);
}

}  // extern "C"

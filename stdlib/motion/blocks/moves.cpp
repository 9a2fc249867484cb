// SPDX-License-Identifier: Apache-2.0
// Native bodies of moves.st.
#include "kernel/axis.h"

#include <math.h>

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

bool areLimits(double velocity, double acceleration, double deceleration, double jerk) {
  return isPositive(velocity) && isPositive(acceleration) && isPositive(deceleration) && jerk >= 0 && isFinite(jerk);
}

template <class Block>
Request requestOf(const Block& block, Motion motion, AxisState state) {
  Request request = {};
  request.kind_ = static_cast<uint8_t>(motion);
  request.state_ = state;
  request.velocity_ = block.Velocity_;
  request.acceleration_ = block.Acceleration_;
  request.deceleration_ = block.Deceleration_;
  request.jerk_ = block.Jerk_;
  return request;
}

// A rising edge begins the request, or refuses.
void startMove(Call& call, const Axis* axis, Error value_error, const Request& request) {
  const Error error = refusal(axis);
  if (error != SMC_NO_ERROR_)
    call.refuse(error);
  else if (value_error != SMC_NO_ERROR_)
    call.refuse(value_error);
  else
    call.start(request, SMC_AXIS_NOT_READY_FOR_MOTION_);
}

template <class Block>
void showMove(Block& block, Call& call) {
  block.Done_ = call.is(Outcome::Done) ? 1 : 0;
  block.CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  block.Active_ = call.isOwner() ? 1 : 0;
  call.show(block.Busy_, block.Error_, block.ErrorID_);
}

Request absoluteRequest(const MC_MoveAbsolute_type& block, int16_t mode) {
  Request request = requestOf(block, Motion::Position, discrete_motion_);
  request.buffer_mode_ = mode;
  if (isAxis(block.Axis_)) aim(*block.Axis_, request, block.Position_, block.Direction_);
  return request;
}

// With ContinuousUpdate. One that waits may have new commands after it, so its target is found when it begins.
Request updateOf(const MC_MoveAbsolute_type& block, const Call& call) {
  Request request = absoluteRequest(block, Aborting_);
  request.turns_ = !call.isOwner() && period(*block.Axis_) != 0 ? 1 : 0;
  return request;
}

Error absoluteError(const MC_MoveAbsolute_type& block) {
  if (!areLimits(block.Velocity_, block.Acceleration_, block.Deceleration_, block.Jerk_) || !isFinite(block.Position_))
    return SMC_MA_INVALID_VELACC_VALUES_;
  return block.Direction_ < negative_ || block.Direction_ > fastest_ ? SMC_MA_INVALID_DIRECTION_ : SMC_NO_ERROR_;
}

template <class Block>
Error distanceError(const Block& block, Error error) {
  return areLimits(block.Velocity_, block.Acceleration_, block.Deceleration_, block.Jerk_) && isFinite(block.Distance_)
             ? SMC_NO_ERROR_
             : error;
}

Error velocityError(const MC_MoveVelocity_type& block) {
  if (!isPositive(block.Acceleration_) || !isPositive(block.Deceleration_) || block.Jerk_ < 0 ||
      !isFinite(block.Jerk_) || !isFinite(block.Velocity_))
    return SMC_MV_INVALID_ACCDEC_VALUES_;
  const bool is_direction =
      block.Direction_ == negative_ || block.Direction_ == positive_ || block.Direction_ == current_;
  return is_direction ? SMC_NO_ERROR_ : SMC_MV_DIRECTION_NOT_APPLICABLE_;
}

int signOf(const Axis& axis, int16_t direction) {
  return direction == negative_ ? -1 : direction == positive_ ? 1 : axis.last_direction_;
}

Request velocityRequest(const MC_MoveVelocity_type& block) {
  Request request = requestOf(block, Motion::Velocity, continuous_motion_);
  request.buffer_mode_ = block.BufferMode_;
  request.velocity_ = fabs(block.Velocity_);
  if (isAxis(block.Axis_)) request.end_velocity_ = block.Velocity_ * signOf(*block.Axis_, block.Direction_);
  return request;
}

// A move over `way` that goes on: the end velocity with the sign of its direction.
template <class Block>
void continueWith(Request& request, const Block& block, const Axis& axis, double way) {
  const int current = way < 0 ? -1 : way > 0 ? 1 : axis.last_direction_;
  const int sign = block.EndVelocityDirection_ == negative_   ? -1
                   : block.EndVelocityDirection_ == positive_ ? 1
                                                              : current;
  const double limit = fabs(block.EndVelocity_) < block.Velocity_ ? fabs(block.EndVelocity_) : block.Velocity_;
  request.end_velocity_ = sign * limit;
  if (block.EndVelocity_ == 0) request.kind_ = static_cast<uint8_t>(Motion::Position);
}

// A move by a distance from `from`, or from where the axis is. With ContinuousUpdate the place that it counts from
// stays.
template <class Block>
void moveBy(Block& block, Error value_error, double from, bool from_here) {
  Call call(block.Axis_, block.command_, block.Execute_ != 0);
  Request request = requestOf(block, Motion::Position, discrete_motion_);
  request.buffer_mode_ = block.BufferMode_;
  const Error error = distanceError(block, value_error);
  if (call.rises()) {
    request.target_ = from + block.Distance_;
    request.is_relative_ = from_here ? 1 : 0;
    startMove(call, block.Axis_, error, request);
    if (call.isRunning()) block.began_ = call.axis().request_.target_ - block.Distance_;
  } else if (block.ContinuousUpdate_ != 0 && call.isOwner() && error == SMC_NO_ERROR_) {
    request.target_ = block.began_ + block.Distance_;
    renew(call.axis(), block.command_, request);
  }
  call.run();
  showMove(block, call);
}

template <class Block>
void showContinuous(Block& block, Call& call) {
  const bool arrived = call.isOwner() && call.axis().nAxisState_ == continuous_motion_;
  block.InEndVelocity_ = arrived || call.is(Outcome::Done) ? 1 : 0;
  block.CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  block.Active_ = call.isOwner() ? 1 : 0;
  call.show(block.Busy_, block.Error_, block.ErrorID_);
}

bool isEndDirection(int16_t direction) {
  return direction == negative_ || direction == positive_ || direction == current_;
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_MoveAbsolute(rung_context*, MC_MoveAbsolute_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises())
    startMove(call, self->Axis_, absoluteError(*self),
              absoluteError(*self) == SMC_NO_ERROR_ ? absoluteRequest(*self, self->BufferMode_) : Request{});
  else if (self->ContinuousUpdate_ != 0 && call.isRunning() && absoluteError(*self) == SMC_NO_ERROR_)
    renew(call.axis(), self->command_, updateOf(*self, call));
  call.run();
  showMove(*self, call);
}

void rung_sm3_basic_MC_MoveRelative(rung_context*, MC_MoveRelative_type* self) {
  moveBy(*self, SMC_MR_INVALID_VELACC_VALUES_, 0, true);
}

void rung_sm3_basic_MC_MoveAdditive(rung_context*, MC_MoveAdditive_type* self) {
  // From the target of a discrete motion; else as MC_MoveRelative.
  const Axis* const axis = self->Axis_;
  const bool has_target = isAxis(axis) && axis->nAxisState_ == discrete_motion_ && self->BufferMode_ == Aborting_ &&
                          axis->request_.kind_ == static_cast<uint8_t>(Motion::Position);
  moveBy(*self, SMC_MAD_INVALID_VELACC_VALUES_, has_target ? axis->request_.target_ : 0, !has_target);
}

void rung_sm3_basic_MC_MoveSuperImposed(rung_context*, MC_MoveSuperImposed_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    Request request = {};
    request.kind_ = static_cast<uint8_t>(Motion::Position);
    request.target_ = self->Distance_;
    request.velocity_ = self->VelocityDiff_;
    request.acceleration_ = self->Acceleration_;
    request.deceleration_ = self->Deceleration_;
    request.jerk_ = self->Jerk_;
    const Error error = refusal(self->Axis_);
    if (error != SMC_NO_ERROR_)
      call.refuse(error);
    else if (!areLimits(self->VelocityDiff_, self->Acceleration_, self->Deceleration_, self->Jerk_) ||
             !isFinite(self->Distance_) || !beginExtra(call.axis(), self->command_, request))
      call.refuse(SMC_MSI_INVALID_VELACC_VALUES_);
    else
      self->began_ = call.axis().extra_.base_position_;
  }
  call.run();
  if (call.isRunning()) self->CoveredDistance_ = call.axis().extra_.position_ - self->began_;
  if (call.is(Outcome::Done)) self->CoveredDistance_ = self->Distance_;
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_MoveVelocity(rung_context*, MC_MoveVelocity_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises())
    startMove(call, self->Axis_, velocityError(*self), velocityRequest(*self));
  else if (self->ContinuousUpdate_ != 0 && call.isRunning() && velocityError(*self) == SMC_NO_ERROR_)
    renew(call.axis(), self->command_, velocityRequest(*self));
  call.run();
  const bool steady =
      call.isOwner() && isProfileOver(call.axis()) && call.axis().fVelFactor_ == 1 && call.axis().extra_.velocity_ == 0;
  self->InVelocity_ = steady || call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  self->Active_ = call.isOwner() ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_SMC_MoveContinuousAbsolute(rung_context*, SMC_MoveContinuousAbsolute_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    Error error = SMC_NO_ERROR_;
    if (!areLimits(self->Velocity_, self->Acceleration_, self->Deceleration_, self->Jerk_) ||
        !isFinite(self->Position_) || !isFinite(self->EndVelocity_))
      error = SMC_MCA_INVALID_VELACC_VALUES_;
    else if (!isEndDirection(self->EndVelocityDirection_) || self->Direction_ < negative_ ||
             self->Direction_ > fastest_)
      error = SMC_MCA_INVALID_DIRECTION_;
    else if (self->Direction_ == fastest_)
      error = SMC_MCA_DIRECTION_NOT_APPLICABLE_;
    Request request = requestOf(*self, Motion::Continuous, discrete_motion_);
    request.buffer_mode_ = self->BufferMode_;
    if (error == SMC_NO_ERROR_) {
      request.target_ = turned(call.axis(), request, self->Position_, self->Direction_);
      continueWith(request, *self, call.axis(), request.target_ - beginState(call.axis(), request).position);
    }
    startMove(call, self->Axis_, error, request);
  }
  call.run();
  showContinuous(*self, call);
}

void rung_sm3_basic_SMC_MoveContinuousRelative(rung_context*, SMC_MoveContinuousRelative_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    Error error = SMC_NO_ERROR_;
    if (!areLimits(self->Velocity_, self->Acceleration_, self->Deceleration_, self->Jerk_) ||
        !isFinite(self->Distance_) || !isFinite(self->EndVelocity_))
      error = SMC_MCR_INVALID_VELACC_VALUES_;
    else if (!isEndDirection(self->EndVelocityDirection_))
      error = SMC_MCR_INVALID_DIRECTION_;
    Request request = requestOf(*self, Motion::Continuous, discrete_motion_);
    request.buffer_mode_ = self->BufferMode_;
    request.target_ = self->Distance_;
    request.is_relative_ = 1;
    if (error == SMC_NO_ERROR_) continueWith(request, *self, call.axis(), self->Distance_);
    startMove(call, self->Axis_, error, request);
  }
  call.run();
  showContinuous(*self, call);
}

}  // extern "C"

// SPDX-License-Identifier: Apache-2.0
// Native bodies of power.st.
#include "kernel/axis.h"

#include <math.h>

using namespace rung_sm3_basic;
using namespace rung::motion;

extern "C" {

void rung_sm3_basic_MC_Power(rung_context*, MC_Power_type* self) {
  Axis* const axis = self->Axis_;
  self->Status_ = self->Error_ = 0;
  self->ErrorID_ = SMC_NO_ERROR_;
  self->Busy_ = self->Enable_;
  if (!isAxis(axis)) {
    self->Busy_ = 0;
    self->Error_ = self->Enable_;
    self->ErrorID_ = self->Enable_ != 0 ? SMC_AXIS_IS_NO_AXIS_REF_ : SMC_NO_ERROR_;
    return;
  }
  const bool wants = self->Enable_ != 0 && self->bRegulatorOn_ != 0;
  if (axis->bRegulatorOn_ != 0 && !wants && isMoving(*axis) && axis->nAxisState_ != errorstop_)
    fail(*axis, SMC_FB_ACTIVE_AXIS_DISABLED_);
  axis->bRegulatorOn_ = wants ? 1 : 0;
  axis->bDriveStart_ = self->Enable_ != 0 && self->bDriveStart_ != 0 ? 1 : 0;
  self->bRegulatorRealState_ = axis->bRegulatorRealState_;
  self->bDriveStartRealState_ = axis->bDriveStartRealState_;
  if (self->Enable_ == 0) return;
  if (axis->fTaskCycle_ <= 0) self->ErrorID_ = SMC_P_FTASKCYCLE_EMPTY_;
  if (axis->bError_ != 0) self->ErrorID_ = static_cast<int16_t>(axis->dwErrorID_);
  self->Error_ = self->ErrorID_ != SMC_NO_ERROR_ ? 1 : 0;
  if (self->Error_ != 0) self->Busy_ = 0;
  self->Status_ = axis->bRegulatorRealState_ != 0 && axis->bDriveStartRealState_ != 0 && axis->bError_ == 0 ? 1 : 0;
}

void rung_sm3_basic_MC_Reset(rung_context*, MC_Reset_type* self) {
  constexpr uint32_t kPatience = 1000;  // cycles for the drive's answer
  constexpr uint32_t kRepetition = 8;   // cycles with and without the request
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    Axis& axis = call.axis();
    axis.bFBErrorOccurred_ = 0;
    if (axis.nAxisState_ != errorstop_) {
      call.refuse(SMC_R_NO_ERROR_TO_RESET_);
    } else if (axis.bCommunication_ == 0) {
      call.refuse(SMC_R_DRIVE_DOESNT_ANSWER_);
    } else {
      call.launch();
      self->cycles_ = 0;
      axis.reset_request_ = 1;
    }
  }
  if (call.isRunning()) {
    Axis& axis = call.axis();
    const bool has_fault = axis.bVirtual_ == 0 && (axis.drive_.statusword_ & 0x08) != 0;
    // The drive acts on the edge of bit 7, so one that came while its fault was there has no effect: it is repeated.
    axis.reset_request_ = self->cycles_ / kRepetition % 2 == 0 ? 1 : 0;
    ++self->cycles_;
    if (axis.fSetVelocity_ == 0 && !has_fault && axis.bCommunication_ != 0) {
      axis.reset_request_ = 0;
      axis.bError_ = 0;
      axis.dwErrorID_ = 0;
      axis.nAxisState_ = isPowered(axis) ? standstill_ : power_off_;
      call.done();
    } else if (axis.bCommunication_ == 0 || self->cycles_ > kPatience) {
      axis.reset_request_ = 0;
      call.refuse(axis.bCommunication_ == 0 ? SMC_R_DRIVE_DOESNT_ANSWER_
                  : has_fault               ? SMC_R_ERROR_NOT_RESETTABLE_
                                            : SMC_R_DRIVE_DOESNT_ANSWER_IN_TIME_);
    }
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_Stop(rung_context*, MC_Stop_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  Axis* const axis = self->Axis_;
  const bool holds = isAxis(axis) && axis->lock_ != 0 && axis->lock_ == self->command_.serial_;
  if (call.rises()) {
    if (holds && call.isRunning()) {
      fail(*axis, SMC_MS_UNKNOWN_STOPPING_ERROR_);
    } else if (axis->nAxisState_ == errorstop_) {
      call.refuse(SMC_MS_AXIS_IN_ERRORSTOP_);
    } else if (axis->nAxisState_ == power_off_) {
      call.refuse(SMC_REGULATOR_OR_START_NOT_SET_);
    } else if (axis->nAxisState_ == stopping_) {
      call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
    } else if (!isPositive(self->Deceleration_) || self->Jerk_ < 0 || !isFinite(self->Jerk_)) {
      call.refuse(SMC_MS_INVALID_ACCDEC_VALUES_);
    } else {
      Request request = {};
      request.kind_ = static_cast<uint8_t>(Motion::Velocity);
      request.state_ = stopping_;
      request.velocity_ = fabs(axis->fSetVelocity_);
      request.acceleration_ = request.deceleration_ = self->Deceleration_;
      request.jerk_ = self->Jerk_;
      axis->homing_ = 0;
      call.start(request, SMC_MS_INVALID_ACCDEC_VALUES_);
      axis->lock_ = self->command_.serial_;
      self->stopped_ = 0;
    }
  }
  call.run();
  if (isAxis(axis) && axis->lock_ != 0 && axis->lock_ == self->command_.serial_) {
    axis->lock_called_ = axis->cycle_;
    if (call.isOwner() && isProfileOver(*axis)) {
      // At rest: the axis stays locked until Execute falls.
      axis->owner_ = 0;
      axis->request_.kind_ = static_cast<uint8_t>(Motion::None);
      axis->velocity_ = axis->acceleration_ = 0;
      self->stopped_ = 1;
      call.done();
    }
    if (self->stopped_ != 0 && self->Execute_ == 0) {
      axis->lock_ = 0;
      if (axis->nAxisState_ == stopping_) axis->nAxisState_ = standstill_;
    }
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_Halt(rung_context*, MC_Halt_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    const Error error = refusal(self->Axis_);
    if (error != SMC_NO_ERROR_) {
      call.refuse(error);
    } else if (!isPositive(self->Deceleration_) || self->Jerk_ < 0 || !isFinite(self->Jerk_)) {
      call.refuse(SMC_MS_INVALID_ACCDEC_VALUES_);
    } else {
      Axis& axis = call.axis();
      Request request = {};
      request.kind_ = static_cast<uint8_t>(Motion::Velocity);
      request.state_ = axis.nAxisState_ == standstill_ ? standstill_ : discrete_motion_;
      request.velocity_ = fabs(axis.fSetVelocity_);
      request.acceleration_ = request.deceleration_ = self->Deceleration_;
      request.jerk_ = self->Jerk_;
      request.buffer_mode_ = self->BufferMode_;
      call.start(request, SMC_MS_INVALID_ACCDEC_VALUES_);
    }
  }
  call.run();
  if (call.isOwner() && isProfileOver(call.axis())) {
    Axis& axis = call.axis();
    axis.velocity_ = axis.acceleration_ = 0;
    release(axis);
    call.done();
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  self->CommandAborted_ = call.is(Outcome::Aborted) ? 1 : 0;
  self->Active_ = call.isOwner() ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_MC_SetOverride(rung_context*, MC_SetOverride_type* self) {
  Axis* const axis = self->Axis_;
  const auto isFactor = [](double value, bool may_be_0) { return value <= 1 && (may_be_0 ? value >= 0 : value > 0); };
  self->Enabled_ = self->Busy_ = self->Error_ = 0;
  self->ErrorID_ = SMC_NO_ERROR_;
  if (self->Enable_ == 0) return;
  if (!isAxis(axis)) {
    self->ErrorID_ = SMC_AXIS_IS_NO_AXIS_REF_;
  } else if (!isFactor(self->VelFactor_, true) || !isFactor(self->AccFactor_, false) ||
             !isFactor(self->JerkFactor_, false)) {
    self->ErrorID_ = SMC_AXIS_NOT_READY_FOR_MOTION_;
  }
  self->Error_ = self->ErrorID_ != SMC_NO_ERROR_ ? 1 : 0;
  if (self->Error_ != 0) return;
  self->Enabled_ = self->Busy_ = 1;
  if (axis->fVelFactor_ == self->VelFactor_ && axis->fAccFactor_ == self->AccFactor_ &&
      axis->fJerkFactor_ == self->JerkFactor_)
    return;
  axis->fVelFactor_ = self->VelFactor_;
  axis->fAccFactor_ = self->AccFactor_;
  axis->fJerkFactor_ = self->JerkFactor_;
  ++axis->override_changes_;
}

}  // extern "C"

// SPDX-License-Identifier: Apache-2.0
// Native bodies of status.st.
#include "kernel/axis.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

// The outputs that the reading blocks share; true when there is something to read.
template <class Block>
bool read(Block& block) {
  const bool is_axis = isAxis(block.Axis_);
  const bool on = block.Enable_ != 0;
  block.Valid_ = block.Busy_ = on && is_axis ? 1 : 0;
  block.Error_ = on && !is_axis ? 1 : 0;
  block.ErrorID_ = block.Error_ != 0 ? SMC_AXIS_IS_NO_AXIS_REF_ : SMC_NO_ERROR_;
  return block.Valid_ != 0;
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_ReadActualPosition(rung_context*, MC_ReadActualPosition_type* self) {
  if (read(*self)) self->Position_ = self->Axis_->fActPosition_;
}

void rung_sm3_basic_MC_ReadActualVelocity(rung_context*, MC_ReadActualVelocity_type* self) {
  if (read(*self)) self->Velocity_ = self->Axis_->fActVelocity_;
}

void rung_sm3_basic_MC_ReadActualTorque(rung_context*, MC_ReadActualTorque_type* self) {
  if (read(*self)) self->Torque_ = self->Axis_->fActTorque_;
}

void rung_sm3_basic_MC_ReadStatus(rung_context*, MC_ReadStatus_type* self) {
  self->Disabled_ = self->Errorstop_ = self->Stopping_ = self->StandStill_ = self->DiscreteMotion_ = 0;
  self->ContinuousMotion_ = self->SynchronizedMotion_ = self->Homing_ = 0;
  self->ConstantVelocity_ = self->Accelerating_ = self->Decelerating_ = self->FBErrorOccured_ = 0;
  if (!read(*self)) return;
  const Axis& axis = *self->Axis_;
  switch (static_cast<AxisState>(axis.nAxisState_)) {
    case power_off_: self->Disabled_ = 1; break;
    case errorstop_: self->Errorstop_ = 1; break;
    case stopping_: self->Stopping_ = 1; break;
    case standstill_: self->StandStill_ = 1; break;
    case discrete_motion_: self->DiscreteMotion_ = 1; break;
    case continuous_motion_: self->ContinuousMotion_ = 1; break;
    case synchronized_motion_: self->SynchronizedMotion_ = 1; break;
    case homing_: self->Homing_ = 1; break;
  }
  const double v = axis.fSetVelocity_, a = axis.fSetAcceleration_;
  self->ConstantVelocity_ = v != 0 && a == 0 ? 1 : 0;
  self->Accelerating_ = v * a > 0 || (v == 0 && a != 0) ? 1 : 0;
  self->Decelerating_ = v * a < 0 ? 1 : 0;
  self->FBErrorOccured_ = axis.bFBErrorOccurred_;
}

void rung_sm3_basic_MC_ReadAxisError(rung_context*, MC_ReadAxisError_type* self) {
  if (!read(*self)) return;
  self->AxisError_ = self->Axis_->bError_;
  self->AxisErrorID_ = self->Axis_->dwErrorID_;
  self->SWEndSwitchActive_ = self->Axis_->bSWEndSwitchActive_;
}

}  // extern "C"

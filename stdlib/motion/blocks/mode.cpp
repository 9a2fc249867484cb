// SPDX-License-Identifier: Apache-2.0
// Native bodies of mode.st.
#include "kernel/axis.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

// Tells whether the process data has what the mode needs.
bool isMapped(const Axis& a, int16_t mode) {
  const uint32_t needed = mode == SMC_torque_     ? RUNG_DRIVE_TARGET_TORQUE | RUNG_DRIVE_MODE
                          : mode == SMC_velocity_ ? RUNG_DRIVE_TARGET_VELOCITY | RUNG_DRIVE_MODE
                                                  : RUNG_DRIVE_TARGET_POSITION;
  return (a.drive_.mapped_ & needed) == needed;
}

}  // namespace

extern "C" {

void rung_sm3_basic_SMC_SetControllerMode(rung_context*, SMC_SetControllerMode_type* self) {
  constexpr uint32_t kPatience = 1000;  // cycles
  Call call(self->Axis_, self->command_, self->bExecute_ != 0);
  const int16_t mode = self->nControllerMode_;
  if (call.rises()) {
    Axis& axis = call.axis();
    const int16_t state = axis.nAxisState_;
    if (state == errorstop_ || state == stopping_ || state == homing_)
      call.refuse(SMC_SCM_AXIS_IN_WRONG_STATE_);
    else if (driveMode(mode) == 0 || (axis.bVirtual_ != 0 ? mode != SMC_position_ : !isMapped(axis, mode)))
      call.refuse(SMC_SCM_NOT_SUPPORTED_);
    else
      call.launch(), axis.mode_wanted_ = driveMode(mode), self->cycles_ = 0;
  }
  if (call.isRunning()) {
    Axis& axis = call.axis();
    const bool reached = axis.bVirtual_ != 0 || axis.drive_.mode_display_ == driveMode(mode);
    if (reached) {
      axis.eControllerMode_ = mode;
      call.done();
    } else if (++self->cycles_ > kPatience || axis.bCommunication_ == 0) {
      axis.mode_wanted_ = driveMode(axis.eControllerMode_);
      call.refuse(SMC_SCM_NOT_SUPPORTED_);
    }
  }
  self->bDone_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(self->bBusy_, self->bError_, self->nErrorID_);
}

void rung_sm3_basic_SMC_SetTorque(rung_context*, SMC_SetTorque_type* self) {
  Axis* const axis = self->Axis_;
  self->bBusy_ = self->bError_ = 0;
  self->nErrorID_ = SMC_NO_ERROR_;
  if (self->bEnable_ == 0) {
    if (self->was_ != 0 && isAxis(axis)) axis->fSetTorque_ = 0;
    self->was_ = 0;
    return;
  }
  if (!isAxis(axis))
    self->nErrorID_ = SMC_AXIS_IS_NO_AXIS_REF_;
  else if (axis->nAxisState_ == power_off_)
    self->nErrorID_ = SMC_REGULATOR_OR_START_NOT_SET_;
  else if (axis->eControllerMode_ != SMC_torque_ || !isFinite(self->fTorque_))
    self->nErrorID_ = SMC_ST_WRONG_CONTROLLER_MODE_;
  self->bError_ = self->nErrorID_ != SMC_NO_ERROR_ ? 1 : 0;
  if (self->bError_ != 0) return;
  self->was_ = self->bBusy_ = 1;
  axis->fSetTorque_ = self->fTorque_;
}

}  // extern "C"

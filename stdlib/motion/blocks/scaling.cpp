// SPDX-License-Identifier: Apache-2.0
// Native bodies of scaling.st.
#include "kernel/axis.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

Error scalingError(const SMC_ChangeGearingRatio_type& block) {
  if (block.dwRatioTechUnitsDenom_ == 0 || block.iRatioTechUnitsNum_ == 0) return SMC_CGR_ZERO_VALUES_;
  if (block.Axis_->bRegulatorRealState_ != 0 || block.Axis_->bRegulatorOn_ != 0) return SMC_CGR_DRIVE_POWERED_;
  const bool needs_period = block.iMovementType_ == modulo_;
  return needs_period && !isPositive(block.fPositionPeriod_) ? SMC_CGR_INVALID_POSPERIOD_ : SMC_NO_ERROR_;
}

}  // namespace

extern "C" {

void rung_sm3_basic_SMC_ChangeGearingRatio(rung_context*, SMC_ChangeGearingRatio_type* self) {
  Call call(self->Axis_, self->command_, self->bExecute_ != 0);
  if (call.rises()) {
    const Error error = scalingError(*self);
    if (error != SMC_NO_ERROR_) {
      call.refuse(error);
    } else {
      const double increments = static_cast<double>(self->dwRatioTechUnitsDenom_) / self->iRatioTechUnitsNum_;
      const bool is_modulo = self->iMovementType_ == modulo_;
      rescale(call.axis(), increments, is_modulo ? self->fPositionPeriod_ : 0);
      call.launch();
      call.done();
    }
  }
  self->bDone_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(self->bBusy_, self->bError_, self->nErrorID_);
}

}  // extern "C"

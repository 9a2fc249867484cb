// SPDX-License-Identifier: Apache-2.0
// Native body of cam_register.st: the tappets of a cam follow a master, and no slave does.
#include <math.h>

#include "blocks/coupling.h"
#include "blocks/tappets.h"

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

Tappets tappetsOfBlock(SMC_CamRegister_type& block) {
  return {block.cam_, block.tappet_state_, reinterpret_cast<uint8_t*>(block.bTappet_)};
}

// Where the master will be after the dead time.
double masterAhead(const SMC_CamRegister_type& block) {
  const Axis& master = *block.Master_;
  const State state = stateOf(master);
  const double velocity = isPowered(master) ? state.velocity : master.fActVelocity_;
  return state.position + block.ahead_ * velocity;
}

Error take(SMC_CamRegister_type& block) {
  if (!isAxis(block.Master_)) return SMC_AXIS_IS_NO_AXIS_REF_;
  if (!isPositive(block.MasterScaling_) || !isFinite(block.MasterOffset_) || !isFinite(block.DeadTimeCompensation_))
    return SMC_CI_SCALING_INCORRECT_;
  const Error error = select(block.CamTable_, block.cam_);
  if (error != SMC_NO_ERROR_) return error;
  if (block.cam_.table_.tappet_count_ == 0) return SMC_CR_NO_TAPPETS_IN_CAM_;
  for (int i = 0; i < block.cam_.table_.tappet_count_; ++i)
    if (rung::motion::tappetsOf(block.cam_)[i].iGroupID_ < 1) return SMC_CR_TOO_MANY_TAPPETS_;
  return SMC_NO_ERROR_;
}

void start(SMC_CamRegister_type& block) {
  block.cam_ = {};
  block.ErrorID_ = take(block);
  block.Error_ = block.ErrorID_ != SMC_NO_ERROR_ ? 1 : 0;
  if (block.Error_ != 0) return;
  block.Busy_ = 1;
  block.scale_ = block.MasterScaling_;
  block.ahead_ = block.DeadTimeCompensation_;
  block.master_zero_ = masterAhead(block);
  const double x = block.scale_ * shown(*block.Master_, block.master_zero_) + block.MasterOffset_;
  block.table_zero_ = wrapped(x, block.cam_.StartMaster_, block.cam_.EndMaster_);
  block.tappet_state_.hysteresis_ = block.TappetHysteresis_ > 0 ? block.TappetHysteresis_ * block.scale_ : 0;
  Tappets tappets = tappetsOfBlock(block);
  tappets.reset(*block.Master_);
  tappets.refresh();
}

void run(SMC_CamRegister_type& block) {
  const double start = block.cam_.StartMaster_, width = block.cam_.EndMaster_ - start;
  Tappets tappets = tappetsOfBlock(block);
  double x = block.table_zero_ + block.scale_ * (masterAhead(block) - block.master_zero_);
  const double periods = floor((x - start) / width);
  if (periods != 0) {
    block.table_zero_ -= periods * width;
    tappets.shift(-periods * width);
    x -= periods * width;
    block.EndOfProfile_ = 1;
  }
  tappets.move(x);
  tappets.run(*block.Master_);
}

}  // namespace

extern "C" {

void rung_sm3_basic_SMC_CamRegister(rung_context*, SMC_CamRegister_type* self) {
  self->EndOfProfile_ = 0;
  if (self->Enable_ == 0) {
    self->Busy_ = self->Error_ = 0;
    self->ErrorID_ = SMC_NO_ERROR_;
  } else if (self->was_ == 0) {
    start(*self);
  }
  self->was_ = self->Enable_;
  if (self->Busy_ != 0 && isAxis(self->Master_)) run(*self);
}

}  // extern "C"

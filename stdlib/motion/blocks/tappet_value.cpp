// SPDX-License-Identifier: Apache-2.0
// Native body of SMC_GetTappetValue in cam.st: the state of a group from what MC_CamIn has seen its tappets do.
#include "kernel/axis.h"

using namespace rung_sm3_basic;

constexpr int16_t kLastGroup = 512;  // MAX_NUM_TAPPETS

extern "C" void rung_sm3_basic_SMC_GetTappetValue(rung_context*, SMC_GetTappetValue_type* self) {
  const SMC_TappetData_type* const tappets = self->Tappets_;
  if (tappets == nullptr || self->iID_ < 0 || self->iID_ > kLastGroup) {
    self->bTappet_ = 0;
    return;
  }
  const bool restarted = self->starts_ != tappets->starts_;
  if (self->was_called_ == 0)
    self->base_ = self->bInitValue_;
  else if (restarted)
    self->base_ = self->bSetInitValueAtReset_ != 0 ? self->bInitValue_ : self->bTappet_;
  self->was_called_ = 1;
  self->starts_ = tappets->starts_;
  const uint32_t bit = 1u << (self->iID_ % 32);
  const bool is_known = (tappets->known_[self->iID_ / 32] & bit) != 0;
  const bool value = (tappets->value_[self->iID_ / 32] & bit) != 0;  // or, where it is not known, inverted
  self->bTappet_ = (is_known ? value : value != (self->base_ != 0)) ? 1 : 0;
}

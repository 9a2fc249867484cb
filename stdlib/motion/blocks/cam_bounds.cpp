// SPDX-License-Identifier: Apache-2.0
// Native body of cam_bounds.st: the extremes of a cam, some segments in each call, so that a large cam costs no cycle.
#include "cam/table/bounds.h"

#include "blocks/cam_table.h"

using namespace rung_sm3_basic;
using namespace rung::motion;
namespace cam = rung::cam;

namespace {

constexpr int kSegmentsPerCall = 8;

void refuse(CAM_EXTREMES_type& block, Error error) {
  block.Busy_ = 0;
  block.Error_ = 1;
  block.ErrorID_ = error;
}

void show(CAM_EXTREMES_type& block, const cam::Bounds& bounds) {
  block.position_low_ = bounds.position.low;
  block.position_high_ = bounds.position.high;
  block.slope_low_ = bounds.slope.low;
  block.slope_high_ = bounds.slope.high;
  block.curvature_low_ = bounds.curvature.low;
  block.curvature_high_ = bounds.curvature.high;
}

void start(CAM_EXTREMES_type& block) {
  block.Done_ = block.Error_ = 0;
  block.ErrorID_ = SMC_NO_ERROR_;
  block.next_ = 0;
  block.table_ = {};
  const MC_CAM_REF_type* const given = block.CAM_;
  if (isCam(given) && (given->byType_ < POLY_ || given->byType_ > XYVA_)) return refuse(block, SMC_CB_NOT_IMPLEMENTED_);
  const Error error = select(block.CAM_, block.table_);
  if (error != SMC_NO_ERROR_) return refuse(block, error);
  block.Busy_ = 1;
  show(block, cam::emptyBounds());
}

void run(CAM_EXTREMES_type& block) {
  const cam::Table table = tableOf(block.table_);
  cam::Bounds bounds = {{block.position_low_, block.position_high_},
                        {block.slope_low_, block.slope_high_},
                        {block.curvature_low_, block.curvature_high_}};
  const int32_t count = cam::segmentCount(table);
  for (int i = 0; i < kSegmentsPerCall && block.next_ < count; ++i, ++block.next_)
    if (!cam::include(table, block.next_, bounds)) return refuse(block, SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_);
  show(block, bounds);
  if (block.next_ < count) return;
  block.Busy_ = 0;
  block.Done_ = 1;
}

}  // namespace

extern "C" {

void rung_sm3_basic_CAM_EXTREMES(rung_context*, CAM_EXTREMES_type* self) {
  if (self->Execute_ == 0 && self->Busy_ == 0) {  // Done and Error stay for one call at least
    self->Done_ = self->Error_ = 0;
    self->ErrorID_ = SMC_NO_ERROR_;
  }
  if (self->Execute_ != 0 && self->was_ == 0) start(*self);
  self->was_ = self->Execute_;
  if (self->Busy_ != 0) run(*self);
}

}  // extern "C"

// SPDX-License-Identifier: Apache-2.0
// Native bodies of position.st.
#include "kernel/axis.h"

#include <math.h>

using namespace rung_sm3_basic;
using namespace rung::motion;

namespace {

bool isMaster(const Axis& a) { return a.master_called_ != 0 && a.master_called_ + 1 >= a.cycle_; }

// ---- persistent positions

struct Stored {
  const SMC3_PersistPosition_Copy_type* copy;  // null: none is complete
  bool torn;                                   // the newer one was being written
};

Stored newest(const SMC3_PersistPosition_Copy_type (&copies)[2]) {
  const auto complete = [](const SMC3_PersistPosition_Copy_type& is) {
    return is.Sequence_ != 0 && is.Sequence_ == is.SequenceEnd_;
  };
  const bool newer = static_cast<int32_t>(copies[1].Sequence_ - copies[0].Sequence_) > 0;
  const SMC3_PersistPosition_Copy_type &first = copies[newer ? 1 : 0], &second = copies[newer ? 0 : 1];
  if (complete(first)) return {&first, false};
  if (complete(second)) return {&second, first.Sequence_ != 0};
  return {nullptr, false};
}

void store(const Axis& a, SMC3_PersistPosition_Copy_type (&copies)[2], int64_t drive) {
  const Stored last = newest(copies);
  const uint32_t sequence = last.copy == nullptr ? 1 : last.copy->Sequence_ + 1;
  SMC3_PersistPosition_Copy_type& copy = copies[last.copy == &copies[0] ? 1 : 0];
  copy.Sequence_ = sequence == 0 ? 1 : sequence;
  copy.Position_ = a.fActPosition_;
  copy.Drive_ = drive;
  copy.Scalefactor_ = a.fScalefactor_;
  copy.PositionPeriod_ = a.fPositionPeriod_;
  copy.SequenceEnd_ = copy.Sequence_;
}

// Restores once, then stores. `moved` is how far the drive has moved since the copy was stored, in increments.
template <class Block, class Moved>
void persist(Block& block, int64_t drive, Moved&& moved) {
  Axis* const axis = block.Axis_;
  block.bError_ = 0;
  block.eErrorID_ = SMC_NO_ERROR_;
  if (block.bEnable_ == 0) {
    block.bBusy_ = block.bPositionRestored_ = block.bPositionStored_ = block.was_ = 0;
    return;
  }
  if (!isAxis(axis) || block.PersistentData_ == nullptr) {
    block.bError_ = 1;
    block.eErrorID_ = SMC_AXIS_IS_NO_AXIS_REF_;
    block.bBusy_ = 0;
    return;
  }
  block.bBusy_ = 1;
  if (axis->bCommunication_ == 0) return;
  auto& copies = block.PersistentData_->Copies_;
  if (block.was_ == 0) {
    block.was_ = 1;
    const Stored stored = newest(copies);
    if (stored.copy != nullptr) {
      const bool same =
          stored.copy->Scalefactor_ == axis->fScalefactor_ && stored.copy->PositionPeriod_ == axis->fPositionPeriod_;
      block.eRestoringDiag_ = !same         ? SMC3_PPD_AXIS_PROP_CHANGED_
                              : stored.torn ? SMC3_PPD_DATA_STORED_DURING_WRITING_
                                            : SMC3_PPD_RESTORING_OK_;
      if (same) {
        const double scale = axis->fScalefactor_ != 0 ? axis->fScalefactor_ : 1;
        const double position = stored.copy->Position_ + static_cast<double>(moved(*stored.copy)) / scale;
        axis->origin_ = axis->actual_position_ - position;
        axis->fSetPosition_ = shown(*axis, axis->position_ + axis->extra_.position_);
        axis->fActPosition_ = shown(*axis, axis->actual_position_);
        block.bPositionRestored_ = 1;
      }
    }
  }
  store(*axis, copies, drive);
  block.bPositionStored_ = 1;
}

}  // namespace

extern "C" {

void rung_sm3_basic_MC_SetPosition(rung_context*, MC_SetPosition_type* self) {
  Call call(self->Axis_, self->command_, self->Execute_ != 0);
  if (call.rises()) {
    Axis& axis = call.axis();
    if (axis.nAxisState_ == errorstop_ || axis.coupled_ != 0 || isMaster(axis) || !isFinite(self->Position_)) {
      call.refuse(SMC_AXIS_NOT_READY_FOR_MOTION_);
    } else {
      showAt(axis, self->Mode_ != 0 ? axis.fSetPosition_ + self->Position_ : self->Position_);
      call.launch();
      call.done();
    }
  }
  self->Done_ = call.is(Outcome::Done) ? 1 : 0;
  call.show(self->Busy_, self->Error_, self->ErrorID_);
}

void rung_sm3_basic_SMC3_PersistPosition(rung_context*, SMC3_PersistPosition_type* self) {
  const int64_t drive = isAxis(self->Axis_) ? self->Axis_->drive_.position_ : 0;
  persist(*self, drive, [drive](const SMC3_PersistPosition_Copy_type& copy) {
    return static_cast<int32_t>(static_cast<uint32_t>(drive) - static_cast<uint32_t>(copy.Drive_));
  });
}

void rung_sm3_basic_SMC3_PersistPositionSingleturn(rung_context*, SMC3_PersistPositionSingleturn_type* self) {
  const unsigned bits = self->uiNumberOfAbsoluteBits_ < 31 ? self->uiNumberOfAbsoluteBits_ : 31;
  const int64_t turn = int64_t{1} << bits;
  const int64_t drive = isAxis(self->Axis_) ? self->Axis_->drive_.position_ & (turn - 1) : 0;
  persist(*self, drive, [drive, turn](const SMC3_PersistPosition_Copy_type& copy) {
    const int64_t moved = (drive - copy.Drive_) & (turn - 1);
    return moved >= turn / 2 ? moved - turn : moved;  // the shorter way
  });
}

void rung_sm3_basic_SMC3_PersistPositionLogical(rung_context*, SMC3_PersistPositionLogical_type* self) {
  persist(*self, 0, [](const SMC3_PersistPosition_Copy_type&) { return 0; });
}

}  // extern "C"

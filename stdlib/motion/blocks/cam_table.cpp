// SPDX-License-Identifier: Apache-2.0
// Cams of a program, checked; see cam_table.h.
#include "blocks/cam_table.h"

#include <math.h>

namespace rung::motion {

using namespace rung_sm3_basic;

namespace {

// Positions of the numbers in an XY table.
bool takeScale(const MC_CAM_REF_type& from, CamId& id) {
  id.table_.scale_ = 1;
  id.table_.shift_ = 0;
  const double width = from.fTableMasterMax_ - from.fTableMasterMin_;
  const double positions = from.fEditorMasterMax_ - from.fEditorMasterMin_;
  if (from.fTableMasterMax_ == 0 && from.fTableMasterMin_ == 0 && from.fEditorMasterMax_ == 0 &&
      from.fEditorMasterMin_ == 0)
    return true;
  if (!isPositive(width) || !isPositive(positions)) return false;
  id.table_.scale_ = positions / width;
  id.table_.shift_ = from.fEditorMasterMin_ - from.fTableMasterMin_ * id.table_.scale_;
  return true;
}

Error tappetError(const CamId& id) {
  if (id.table_.tappet_count_ == 0) return SMC_NO_ERROR_;
  if (id.table_.tappet_count_ < 0 || id.table_.tappets_ == nullptr) return SMC_CR_NO_TAPPETS_IN_CAM_;
  int pulses = 0;
  for (int i = 0; i < id.table_.tappet_count_; ++i) {
    const Tappet& tappet = tappetsOf(id)[i];
    if (tappet.cta_ == kTime) ++pulses;
    if (tappet.iGroupID_ < 0 || tappet.iGroupID_ > kMostGroup || pulses > kMostPulses) return SMC_CR_TOO_MANY_TAPPETS_;
  }
  return SMC_NO_ERROR_;
}

}  // namespace

bool isCam(const MC_CAM_REF_type* cam) { return cam != nullptr && cam->wCamStructID_ == kCamStructId; }

cam::Table tableOf(const CamId& id) {
  cam::Table table = {};
  table.points = id.table_.elements_;
  table.segments = static_cast<const cam::SegmentKind*>(id.table_.segments_);
  table.count = id.table_.count_;
  table.kind = static_cast<cam::Kind>(id.table_.kind_);
  table.number = static_cast<cam::Number>(id.table_.var_type_);
  table.cubic = id.table_.quality_ == 3;
  table.start = id.StartMaster_;
  table.end = id.EndMaster_;
  table.scale = id.table_.scale_;
  table.shift = id.table_.shift_;
  return table;
}

Error select(MC_CAM_REF_type* from, CamId& id) {
  if (!isCam(from)) return SMC_NO_CAM_REF_TYPE_;
  id.pCT_ = from;
  id.StartMaster_ = from->xStart_;
  id.EndMaster_ = from->xEnd_;
  id.table_.elements_ = from->pce_;
  id.table_.segments_ = from->pSegments_;
  id.table_.tappets_ = from->pt_;
  id.table_.count_ = from->nElements_;
  id.table_.tappet_count_ = from->nTappets_;
  id.table_.kind_ = from->byType_;
  id.table_.var_type_ = from->byVarType_;
  id.table_.quality_ = from->byInterpolationQuality_;
  if (from->byType_ < POLY_ || from->byType_ > XYVA_) return SMC_NO_CAM_REF_TYPE_;
  if (!takeScale(*from, id)) return SMC_CI_SCALING_INCORRECT_;
  if (from->nCapacity_ > 0 && from->nElements_ > from->nCapacity_) return SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_;
  const cam::Table table = tableOf(id);
  switch (cam::check(table)) {
    case cam::Fault::None: break;
    case cam::Fault::NotACam: return SMC_NO_CAM_REF_TYPE_;
    case cam::Fault::DoesNotCover: return SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_;
  }
  int32_t segment = 0;
  cam::Value value = {};
  if (!cam::at(table, table.start, segment, value)) return SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_;
  id.StartSlave_ = value.position;
  if (!cam::at(table, table.end, segment, value)) return SMC_CAM_TABLE_DOES_NOT_COVER_MASTER_SCALE_;
  id.EndSlave_ = value.position;
  return tappetError(id);
}

double wrapped(double x, double start, double end) {
  const double in = x - (end - start) * floor((x - start) / (end - start));
  return in >= end ? start : in;
}

}  // namespace rung::motion

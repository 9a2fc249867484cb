// SPDX-License-Identifier: Apache-2.0
// The cam blocks take this from an MC_CAM_REF: the table that cam/table evaluates, checked, and its tappets. The points
// stay where the program has them; everything else is copied.
#pragma once

#include "cam/table/table.h"
#include "kernel/axis.h"

namespace rung::motion {

using CamId = rung_sm3_basic::MC_CAM_ID_type;
using Tappet = rung_sm3_basic::SMC_CAMTappet_type;

constexpr uint16_t kCamStructId = 0xDC34;  // MC_CAM_REF.wCamStructID
constexpr int kMostGroup = 512;            // MAX_NUM_TAPPETS
constexpr int kMostPulses = 32;
enum TappetDirection : int16_t { kForward = 0, kBoth = 1, kBack = 2 };
enum TappetAction : int16_t { kOn = 0, kOff = 1, kInvert = 2, kTime = 3 };

bool isCam(const rung_sm3_basic::MC_CAM_REF_type* cam);
// Looks at every point and tappet. The flags of `id` are left as they are.
Error select(rung_sm3_basic::MC_CAM_REF_type* from, CamId& id);
cam::Table tableOf(const CamId& id);
inline const Tappet* tappetsOf(const CamId& id) { return static_cast<const Tappet*>(id.table_.tappets_); }

// `x` moved by whole periods into [start, end).
double wrapped(double x, double start, double end);

}  // namespace rung::motion

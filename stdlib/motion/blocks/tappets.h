// SPDX-License-Identifier: Apache-2.0
// Tappets of a cam: each switches its group once when the master passes it in its direction. In: the positions of the
// master in the table, from call to call. Out: bits for SMC_GetTappetValue, or the BOOLs of SMC_CamRegister.
#pragma once

#include "blocks/cam_table.h"

namespace rung::motion {

constexpr double kMostPeriods = 1000;  // that a master may pass in a cycle

class Tappets {
 public:
  using State = rung_sm3_basic::CAM_TAPPETS_type;

  Tappets(const CamId& cam, State& state, rung_sm3_basic::SMC_TappetData_type& bits)
      : cam_(cam), state_(state), bits_(&bits) {}
  // `groups`: those from 1 on
  Tappets(const CamId& cam, State& state, uint8_t* groups) : cam_(cam), state_(state), groups_(groups) {}

  // Forgets what was switched.
  void reset(const Axis& clock);
  // The master is at `x`: in the same period as before or periods away.
  void move(double x);
  // The position before is now seen as one that is `way` further.
  void shift(double way) { state_.position_ += way; }
  // The next position is the first one.
  void refresh() { state_.is_fresh_ = 1; }
  // Those that switch by time.
  void run(const Axis& clock);

 private:
  void setGroup(int group, int16_t action);
  void switchTappet(int index, bool back);
  void pass(double from, double to, bool includes_from, bool includes_to, bool back);

  const CamId& cam_;
  State& state_;
  rung_sm3_basic::SMC_TappetData_type* bits_ = nullptr;
  uint8_t* groups_ = nullptr;
};

}  // namespace rung::motion

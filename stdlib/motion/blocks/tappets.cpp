// SPDX-License-Identifier: Apache-2.0
// Tappets of a cam; see tappets.h.
#include "blocks/tappets.h"

#include <math.h>

namespace rung::motion {

using namespace rung_sm3_basic;

namespace {

enum Pulse : uint8_t { kNoPulse, kDelayed, kActive };

}  // namespace

void Tappets::setGroup(int group, int16_t action) {
  if (group < 0 || group > kMostGroup) return;  // the program has changed it
  if (groups_ != nullptr) {
    if (group == 0) return;
    uint8_t& state = groups_[group - 1];
    state = action == kInvert ? state ^ 1 : action == kOn ? 1 : 0;
    return;
  }
  uint32_t& known = bits_->known_[group / 32];
  uint32_t& value = bits_->value_[group / 32];
  const uint32_t bit = 1u << (group % 32);
  if (action == kInvert) {
    value ^= bit;
    return;
  }
  known |= bit;
  value = action == kOn ? value | bit : value & ~bit;
}

void Tappets::switchTappet(int index, bool back) {
  const Tappet* const tappets = tappetsOf(cam_);
  const Tappet& tappet = tappets[index];
  if (tappet.ctt_ == (back ? kForward : kBack)) return;
  if (tappet.cta_ != kTime) return setGroup(tappet.iGroupID_, tappet.cta_);
  int slot = 0;
  for (int i = 0; i < index; ++i) slot += tappets[i].cta_ == kTime ? 1 : 0;
  if (slot >= kMostPulses) return;
  CAM_PULSE_type& pulse = state_.pulses_[slot];
  pulse.group_ = tappet.iGroupID_;
  pulse.on_at_ = state_.elapsed_ + tappet.dwDelay_ * 1e-6;
  pulse.off_at_ = pulse.on_at_ + tappet.dwDuration_ * 1e-6;
  pulse.state_ = kDelayed;
  if (tappet.dwDelay_ > 0 || tappet.dwDuration_ == 0) return;
  pulse.state_ = kActive;
  setGroup(tappet.iGroupID_, kOn);
}

// Switches those between two positions in the order in which the master passes them: without `from`, but with `to`
// where it goes forward; the other way round where it goes back. So a tappet is passed once, also when the master stops
// on it and goes back.
void Tappets::pass(double from, double to, bool includes_from, bool includes_to, bool back) {
  const Tappet* const tappets = tappetsOf(cam_);
  const double sign = back ? -1 : 1;
  double reached = from;
  while (true) {
    bool any = false;
    double next = 0;
    for (int i = 0; i < cam_.table_.tappet_count_; ++i) {
      const double x = tappets[i].x_, ahead = sign * (x - reached), rest = sign * (to - x);
      if (!(ahead > 0 || (ahead == 0 && includes_from)) || !(rest > 0 || (rest == 0 && includes_to))) continue;
      if (!any || sign * (next - x) > 0) next = x;
      any = true;
    }
    if (!any) return;
    for (int i = 0; i < cam_.table_.tappet_count_; ++i)
      if (tappets[i].x_ == next) switchTappet(i, back);
    reached = next;
    includes_from = false;
  }
}

void Tappets::move(double x) {
  if (cam_.table_.tappet_count_ <= 0) return;
  const double start = cam_.StartMaster_, end = cam_.EndMaster_, width = end - start;
  const bool is_fresh = state_.is_fresh_ != 0;
  state_.is_fresh_ = 0;
  if (is_fresh) {
    state_.position_ = x;
    state_.is_back_ = 0;
    return pass(x, x, true, true, false);
  }
  const double way = x - state_.position_;
  const bool was_back = state_.is_back_ != 0;
  if (way == 0) return;
  const bool back = way < 0;
  if (back != was_back && fabs(way) < state_.hysteresis_) return;
  double from = state_.position_;
  state_.position_ = x;
  state_.is_back_ = back ? 1 : 0;
  const double beyond = back ? from - end : start - from;
  double periods = beyond > 0 ? ceil(beyond / width) : 0;
  if (periods > kMostPeriods) periods = 0;
  from += (back ? -1 : 1) * periods * width;
  bool includes_from = back;
  for (; periods > 0; --periods) {
    pass(from, back ? start : end, includes_from, true, back);
    from = back ? end : start;
    includes_from = true;
  }
  pass(from, x, includes_from, !back, back);
}

void Tappets::run(const Axis& clock) {
  if (state_.elapsed_cycle_ != clock.cycle_) state_.elapsed_ += clock.fTaskCycle_;
  state_.elapsed_cycle_ = clock.cycle_;
  const double now = state_.elapsed_ + 1e-9 * clock.fTaskCycle_;
  for (CAM_PULSE_type& pulse : state_.pulses_) {
    if (pulse.state_ == kDelayed && now >= pulse.on_at_) {
      pulse.state_ = kActive;
      setGroup(pulse.group_, kOn);
    }
    if (pulse.state_ == kActive && now >= pulse.off_at_) {
      pulse.state_ = kNoPulse;
      setGroup(pulse.group_, kOff);
    }
  }
}

void Tappets::reset(const Axis& clock) {
  if (bits_ != nullptr) {
    ++bits_->starts_;
    for (uint32_t& known : bits_->known_) known = 0;
    for (uint32_t& value : bits_->value_) value = 0;
  }
  for (CAM_PULSE_type& pulse : state_.pulses_) pulse.state_ = kNoPulse;
  state_.elapsed_ = 0;
  state_.elapsed_cycle_ = clock.cycle_;
}

}  // namespace rung::motion

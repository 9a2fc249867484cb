// SPDX-License-Identifier: Apache-2.0
// Every profile must hold this: phases that last, limits, continuity, exact arrival. In: a profile and its request;
// out: the first violation in words, empty when there is none. Called by the property tests of profiles.
#pragma once

#include <cstdint>
#include <string>

#include "stdlib/motion/profile/profile.h"

namespace rung::motion {

struct Request {
  State start;
  bool to_position = true;
  double position = 0, end_velocity = 0;
  Limits limits;
  Ramp ramp = Ramp::Quadratic;

  bool isJerkLimited() const { return ramp == Ramp::Quadratic && limits.jerk > 0; }
};

Result plan(Profile& profile, const Request& request);
std::string violation(const Profile& profile, const Request& request);
std::string print(const Request& request);

// Greatest magnitudes on a way of phases with constant jerk.
struct Peaks {
  double speed = 0, growing = 0, falling = 0;  // growing, falling: acceleration while the speed grows and falls
  double path = 0;                             // length of the way, at least

  // Goes on to the end of the phase.
  void take(State& state, double duration, double jerk);
};

// splitmix64: the same numbers on every machine.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  double uniform(double low, double high);
  double magnitude(double low, double high);  // uniform in the logarithm
  double sign() { return (next() & 1) != 0 ? 1 : -1; }
  bool chance(double p) { return uniform(0, 1) < p; }
  int below(int count) { return int(uniform(0, count)); }

 private:
  uint64_t next();
  uint64_t state_;
};

}  // namespace rung::motion

// SPDX-License-Identifier: Apache-2.0
// The motion laws of VDI 2143 as normalised curves: s(z) over z in [0, 1] with s(0) = 0 and s(1) = 1. In: a law, and
// the velocities, accelerations and jerks at both ends where the law takes them. Out: a curve with exact derivatives.
// Called by `rung cam`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cam/laws/curve.h"

namespace rung::cam {

enum class Law : uint8_t {
  QuadraticParabola,
  SimpleSine,
  Cycloid,
  ModifiedSine,
  ModifiedTrapezoid,
  Gutman,
  DoubleHarmonic,
  HarmonicCombination,
  Polynomial2,
  Polynomial3,
  Polynomial4,
  Polynomial5,
  Polynomial6,
  Polynomial7,
  Polynomial8,
  Polynomial9,
  Polynomial10,
  Polynomial11,
};

// A law takes these besides stroke and length: bits of Ends::given.
enum Given : uint8_t {
  kV0 = 1,
  kV1 = 2,
  kA0 = 4,
  kA1 = 8,
  kJ0 = 16,
  kJ1 = 32,
  kTurn = 64,
};

struct LawRow {
  Law law;
  const char* name;
  const char* alias;  // a second name, or empty
  const char* title;
  uint8_t takes;  // Given
  bool is_shock;  // the acceleration steps: the jerk is infinite there
};
std::span<const LawRow> allLaws();
// By name or alias; null: no such law.
const LawRow* findLaw(std::string_view name);

struct Ends {
  double v0 = 0, a0 = 0, j0 = 0;
  double v1 = 0, a1 = 0, j1 = 0;
  double turn = 0.5;  // the turning point: where acceleration becomes deceleration
  uint8_t given = 0;
};

struct LawCurve {
  Curve curve;
  std::string error;  // empty: made
};
[[nodiscard]] LawCurve lawCurve(Law law, const Ends& ends);

// The peaks of velocity, acceleration, jerk and of velocity times acceleration, by magnitude. The jerk of a law with
// is_shock is the one inside.
struct Coefficients {
  double v, a, j, m;
};
Coefficients coefficients(const Curve& curve);

}  // namespace rung::cam

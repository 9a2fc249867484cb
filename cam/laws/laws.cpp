// SPDX-License-Identifier: Apache-2.0
// Motion laws; see laws.h.
//
// Most laws are two pulses of acceleration: the first takes the velocity from v0 to vm, up to the turning point, the
// second, which is the first one mirrored, from vm to v1. So one construction gives rest-rest, rest-motion, motion-rest
// and motion-motion, and any turning point.
#include "cam/laws/laws.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace rung::cam {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint8_t kPulse = kV0 | kV1 | kTurn;
constexpr uint8_t kAll = kV0 | kV1 | kA0 | kA1 | kJ0 | kJ1;

constexpr LawRow kLaws[] = {
    {Law::QuadraticParabola, "quadratic-parabola", "parabola", "quadratic parabola", kPulse, true},
    {Law::SimpleSine, "simple-sine", "harmonic", "simple sine (simple harmonic)", kPulse, true},
    {Law::Cycloid, "cycloid", "inclined-sine", "cycloid (inclined sine, Bestehorn)", kPulse, false},
    {Law::ModifiedSine, "modified-sine", "", "modified sine", kPulse, false},
    {Law::ModifiedTrapezoid, "modified-trapezoid", "", "modified acceleration trapezoid", kPulse, false},
    {Law::Gutman, "gutman", "sinoid", "sinoid of Gutman", kPulse, false},
    {Law::DoubleHarmonic, "double-harmonic", "", "double harmonic, rest to turn", 0, false},
    {Law::HarmonicCombination, "harmonic-combination", "", "harmonic combination", kV0 | kV1 | kA0 | kA1, false},
    {Law::Polynomial2, "polynomial-2", "", "polynomial of degree 2", kV0 | kV1, true},
    {Law::Polynomial3, "polynomial-3", "polynomial-2-3", "polynomial 2-3", kV0 | kV1, true},
    {Law::Polynomial4, "polynomial-4", "", "polynomial of degree 4", kV0 | kV1 | kA0 | kA1, true},
    {Law::Polynomial5, "polynomial-5", "polynomial-3-4-5", "polynomial 3-4-5", kV0 | kV1 | kA0 | kA1, false},
    {Law::Polynomial6, "polynomial-6", "", "polynomial of degree 6", kAll, false},
    {Law::Polynomial7, "polynomial-7", "polynomial-4-5-6-7", "polynomial 4-5-6-7", kAll, false},
    {Law::Polynomial8, "polynomial-8", "", "polynomial of degree 8", kAll, false},
    {Law::Polynomial9, "polynomial-9", "polynomial-5-6-7-8-9", "polynomial 5-6-7-8-9", kAll, false},
    {Law::Polynomial10, "polynomial-10", "", "polynomial of degree 10", kAll, false},
    {Law::Polynomial11, "polynomial-11", "polynomial-6-7-8-9-10-11", "polynomial 6-7-8-9-10-11", kAll, false},
};

// A part of a pulse of acceleration over u in [0, 1]: constant + sines, with t counted from its begin.
struct PulsePart {
  double length;
  double constant = 0;
  std::array<Sine, 3> sines{};
};
using Pulse = std::vector<PulsePart>;

// Velocity and position are integrated from the end of the curve where they are given.
class PulseCurve {
 public:
  PulseCurve(const Pulse& pulse, double v0, double v1, double turn) {
    const double way = wayOf(pulse);
    const double peak = (1 - (1 - way) * (turn * v0 + (1 - turn) * v1)) / way;
    std::vector<Piece> first = half(pulse, 0, v0, peak - v0, turn);
    std::vector<Piece> second = half(pulse, 1, v1, peak - v1, turn - 1);
    for (const Piece& piece : first) curve_.add(piece);
    while (!second.empty()) {
      curve_.add(second.back());
      second.pop_back();
    }
  }

  Curve take() { return std::move(curve_); }

 private:
  // The way of a pulse that takes the velocity from 0 to 1 in a unit of time.
  static double wayOf(const Pulse& pulse) {
    const std::vector<Piece> pieces = half(pulse, 0, 0, 1, 1);
    return pieces.back().at(1, 0);
  }

  // `span` is negative for the mirrored half, which is built backwards from x = 1.
  static std::vector<Piece> half(const Pulse& pulse, double x, double velocity, double change, double span) {
    std::vector<Piece> pieces;
    double position = x;
    for (size_t i = 0; i < pulse.size(); ++i) {
      const PulsePart& part = pulse[i];
      Piece piece;
      piece.origin = x;
      const double next =
          i + 1 == pulse.size() ? (span > 0 ? origin(pieces, x) + span : 1 + span) : x + part.length * span;
      piece.from = span > 0 ? x : next;
      piece.to = span > 0 ? next : x;
      double sine_position = 0, sine_velocity = 0;
      for (size_t k = 0; k < part.sines.size(); ++k) {
        const Sine& sine = part.sines[k];
        if (sine.amplitude == 0) continue;
        const double frequency = sine.frequency / span;
        const double amplitude = -sine.amplitude * change / span / (frequency * frequency);
        piece.sines[k] = {amplitude, frequency, sine.phase};
        sine_position += amplitude * std::sin(sine.phase);
        sine_velocity += amplitude * frequency * std::cos(sine.phase);
      }
      piece.coefficients[0] = position - sine_position;
      piece.coefficients[1] = velocity - sine_velocity;
      piece.coefficients[2] = part.constant * change / span / 2;
      pieces.push_back(piece);
      position = piece.at(next, 0);
      velocity = piece.at(next, 1);
      x = next;
    }
    return pieces;
  }

  static double origin(const std::vector<Piece>& pieces, double x) {
    return pieces.empty() ? x : pieces.front().origin;
  }

  Curve curve_;
};

Curve pulses(const Pulse& pulse, const Ends& ends) { return PulseCurve(pulse, ends.v0, ends.v1, ends.turn).take(); }

Pulse sinePulse(double fundamental, double third) {
  return {{.length = 1, .sines = {{{fundamental, kPi, 0}, {third, 3 * kPi, 0}}}}};
}

// A quarter of a fast sine, then three quarters of one three times as slow.
Pulse modifiedSinePulse() {
  const double peak = kPi / 2;
  return {{.length = 0.25, .sines = {{{peak, 2 * kPi, 0}}}},
          {.length = 0.75, .sines = {{{peak, 2 * kPi / 3, kPi / 2}}}}};
}

Pulse modifiedTrapezoidPulse() {
  const double peak = 2 * kPi / (kPi + 2);
  return {{.length = 0.25, .sines = {{{peak, 2 * kPi, 0}}}},
          {.length = 0.5, .constant = peak},
          {.length = 0.25, .sines = {{{peak, 2 * kPi, kPi / 2}}}}};
}

// c0 + c1 z + a sine and cosine each of half a turn and of a turn: with six boundary values, in closed form. At rest at
// both ends it is the cycloid, with a1 = -pi^2 from rest the double harmonic.
Curve harmonicCombination(const Ends& ends) {
  const double cosine2 = -(ends.a0 + ends.a1) / (8 * kPi * kPi), cosine1 = (ends.a1 - ends.a0) / (2 * kPi * kPi);
  const double slope = 1 + 2 * cosine1;
  const double sine1 = (ends.v0 - ends.v1) / (2 * kPi), sine2 = ((ends.v0 + ends.v1) / 2 - slope) / (2 * kPi);
  Piece piece;
  piece.coefficients[0] = -(cosine1 + cosine2);
  piece.coefficients[1] = slope;
  // a sin x + b cos x is one sine with a phase.
  piece.sines[0] = {std::hypot(sine1, cosine1), kPi, std::atan2(cosine1, sine1)};
  piece.sines[1] = {std::hypot(sine2, cosine2), 2 * kPi, std::atan2(cosine2, sine2)};
  Curve curve;
  curve.add(piece);
  return curve;
}

// Values are given from the position up, and the left end has one more where their number is odd, unless only the right
// end's next one is given. Derivatives beyond the jerk are 0.
LawCurve polynomial(int degree, const Ends& ends) {
  const double left[] = {0, ends.v0, ends.a0, ends.j0, 0, 0}, right[] = {1, ends.v1, ends.a1, ends.j1, 0, 0};
  const uint8_t left_bits[] = {0, kV0, kA0, kJ0, 0, 0}, right_bits[] = {0, kV1, kA1, kJ1, 0, 0};
  size_t on_left = static_cast<size_t>(degree + 1) / 2, on_right = on_left;
  if (degree % 2 == 0) {
    const bool asks_left = (ends.given & left_bits[on_left]) != 0,
               asks_right = (ends.given & right_bits[on_right]) != 0;
    if (asks_left && asks_right)
      return {{},
              "a polynomial of degree " + std::to_string(degree) + " takes the " +
                  (on_left == 1   ? "velocity"
                   : on_left == 2 ? "acceleration"
                                  : "jerk") +
                  " at one end only; use degree " + std::to_string(degree + 1)};
    ++(asks_right ? on_right : on_left);
  }
  const Piece whole = hermite(0, 1, {left, on_left}, {right, on_right});

  // The second half is counted from its end, where the sum of large coefficients would round.
  double mirrored_left[6], mirrored_right[6];
  for (size_t k = 0; k < 6; ++k) {
    const double sign = k % 2 == 0 ? 1 : -1;
    mirrored_left[k] = sign * right[k];
    mirrored_right[k] = sign * left[k];
  }
  Piece from_end = hermite(0, 1, {mirrored_left, on_right}, {mirrored_right, on_left});
  for (size_t k = 1; k <= kMostDegree; k += 2) from_end.coefficients[k] = -from_end.coefficients[k];
  from_end.origin = 1;
  from_end.from = 0.5;
  from_end.to = 1;
  Piece from_begin = whole;
  from_begin.to = 0.5;
  LawCurve made;
  made.curve.add(from_begin);
  made.curve.add(from_end);
  return made;
}

}  // namespace

std::span<const LawRow> allLaws() { return kLaws; }

const LawRow* findLaw(std::string_view name) {
  for (const LawRow& row : kLaws)
    if (name == row.name || (row.alias[0] != '\0' && name == row.alias)) return &row;
  return nullptr;
}

LawCurve lawCurve(Law law, const Ends& ends) {
  switch (law) {
    case Law::QuadraticParabola: return {pulses({{.length = 1, .constant = 1}}, ends), {}};
    case Law::SimpleSine: return {pulses({{.length = 1, .sines = {{{kPi / 2, kPi / 2, kPi / 2}}}}}, ends), {}};
    case Law::Cycloid: return {pulses(sinePulse(kPi / 2, 0), ends), {}};
    case Law::ModifiedSine: return {pulses(modifiedSinePulse(), ends), {}};
    case Law::ModifiedTrapezoid: return {pulses(modifiedTrapezoidPulse(), ends), {}};
    case Law::Gutman: return {pulses(sinePulse(kPi * 15 / 32, kPi * 3 / 32), ends), {}};
    case Law::DoubleHarmonic: return {harmonicCombination({.a1 = -kPi * kPi}), {}};
    case Law::HarmonicCombination: return {harmonicCombination(ends), {}};
    case Law::Polynomial2: return polynomial(2, ends);
    case Law::Polynomial3: return polynomial(3, ends);
    case Law::Polynomial4: return polynomial(4, ends);
    case Law::Polynomial5: return polynomial(5, ends);
    case Law::Polynomial6: return polynomial(6, ends);
    case Law::Polynomial7: return polynomial(7, ends);
    case Law::Polynomial8: return polynomial(8, ends);
    case Law::Polynomial9: return polynomial(9, ends);
    case Law::Polynomial10: return polynomial(10, ends);
    case Law::Polynomial11: return polynomial(11, ends);
  }
  return {};
}

Coefficients coefficients(const Curve& curve) {
  const auto size = [](const Extremes& extremes) { return std::fabs(extremes.peak().value); };
  return {size(curve.extremes(1)), size(curve.extremes(2)), size(curve.extremes(3)), size(curve.powerExtremes())};
}

}  // namespace rung::cam

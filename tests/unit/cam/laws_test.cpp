// SPDX-License-Identifier: Apache-2.0
// Motion laws: derivatives, boundary values, coefficients and symmetry.
#include "cam/laws/laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rung::cam {
namespace {

constexpr double kPi = std::numbers::pi;

Curve curveOf(Law law, const Ends& ends = {}) {
  LawCurve made = lawCurve(law, ends);
  EXPECT_EQ(made.error, "");
  return made.curve;
}

// A law gets whatever it takes in tests of boundary values.
Ends someEnds(const LawRow& row) {
  Ends ends;
  ends.given = row.takes;
  if (row.takes & kV0) ends.v0 = 0.5;
  if (row.takes & kV1) ends.v1 = -0.75;
  if (row.takes & kA0) ends.a0 = 1.25;
  if (row.takes & kA1) ends.a1 = -2;
  if (row.takes & kJ0) ends.j0 = 3;
  if (row.takes & kJ1) ends.j1 = -4;
  if (row.takes & kTurn) ends.turn = 0.375;
  if (row.law == Law::Polynomial2) ends.v1 = 0, ends.given = kV0;
  if (row.law == Law::Polynomial4) ends.a1 = 0, ends.given = kV0 | kV1 | kA0;
  if (row.law == Law::Polynomial6) ends.j1 = 0, ends.given = static_cast<uint8_t>(row.takes & ~kJ1);
  return ends;
}

void expectDerivatives(const Curve& curve) {
  constexpr double kStep = 1e-5;
  for (const Piece& piece : curve.pieces())
    for (int order = 1; order <= 3; ++order)
      for (int i = 1; i < 40; ++i) {
        const double x = piece.from + (piece.to - piece.from) * i / 40;
        const double difference = (piece.at(x + kStep, order - 1) - piece.at(x - kStep, order - 1)) / (2 * kStep);
        const double exact = curve.at(x, order);
        EXPECT_NEAR(exact, difference, 1e-6 * std::max(1.0, curve.extremes(order).peak().value)) << order << " " << x;
      }
}

TEST(Laws, DerivativesAgreeWithFiniteDifferences) {
  for (const LawRow& row : allLaws()) {
    SCOPED_TRACE(row.name);
    expectDerivatives(curveOf(row.law));
    expectDerivatives(curveOf(row.law, someEnds(row)));
  }
}

TEST(Laws, BoundaryValuesAreExact) {
  for (const LawRow& row : allLaws()) {
    SCOPED_TRACE(row.name);
    for (const Ends& ends : {Ends{}, someEnds(row)}) {
      const Curve curve = curveOf(row.law, ends);
      EXPECT_EQ(curve.begin(), 0);
      EXPECT_EQ(curve.end(), 1);
      EXPECT_NEAR(curve.at(0, 0), 0, 1e-15);
      EXPECT_NEAR(curve.at(1, 0), 1, 1e-15);
      EXPECT_NEAR(curve.at(0, 1), ends.v0, 2e-15);
      if (row.law != Law::Polynomial2) {
        EXPECT_NEAR(curve.at(1, 1), ends.v1, 2e-15);
      }
      if (row.is_shock || row.law == Law::DoubleHarmonic) continue;
      EXPECT_NEAR(curve.at(0, 2), ends.a0, 2e-14);
      EXPECT_NEAR(curve.at(1, 2), ends.a1, 2e-14);
      if (!(row.takes & kJ0)) continue;
      EXPECT_NEAR(curve.at(0, 3), ends.j0, 2e-13);
      if (row.law != Law::Polynomial6) {
        EXPECT_NEAR(curve.at(1, 3), ends.j1, 2e-13);
      }
    }
  }
}

TEST(Laws, JointsAreContinuous) {
  for (const LawRow& row : allLaws()) {
    SCOPED_TRACE(row.name);
    for (const Ends& ends : {Ends{}, someEnds(row)}) {
      const Curve curve = curveOf(row.law, ends);
      EXPECT_LT(curve.largestStep(0), 1e-12);
      EXPECT_LT(curve.largestStep(1), 1e-12);
      if (row.law != Law::QuadraticParabola) {
        EXPECT_LT(curve.largestStep(2), 1e-10);
      }
    }
  }
}

struct Reference {
  Law law;
  double v, a, j, m;  // m is 0 where no value is known
};

// In closed form where there is one: the published values are these, rounded.
TEST(Laws, CoefficientsEqualTheirClosedForms) {
  const double root3 = std::sqrt(3.0), pi2 = kPi * kPi, pi3 = pi2 * kPi;
  const Reference references[] = {
      {Law::QuadraticParabola, 2, 4, 0, 8},
      {Law::SimpleSine, kPi / 2, pi2 / 2, pi3 / 2, pi3 / 8},
      {Law::Cycloid, 2, 2 * kPi, 4 * pi2, kPi * 1.5 * root3},
      {Law::ModifiedSine, 4 * kPi / (kPi + 4), 4 * pi2 / (kPi + 4), 16 * pi3 / (kPi + 4), 0},
      {Law::ModifiedTrapezoid, 2, 8 * kPi / (kPi + 2), 32 * pi2 / (kPi + 2), 0},
      {Law::Gutman, 2, 2 * kPi * std::sqrt(2.0 / 3), 6 * pi2, 0},
      {Law::Polynomial3, 1.5, 6, 12, 0},
      {Law::Polynomial5, 1.875, 10 / root3, 60, 0},
      {Law::Polynomial7, 2.1875, 84 / (5 * std::sqrt(5.0)), 52.5, 0},
      {Law::Polynomial9, 315.0 / 128, 0, 78.75, 0},
      {Law::Polynomial11, 693.0 / 256, 0, 0, 0},
      // a = -pi^2 at the end; v(z) is largest where cos(pi z) = cos(2 pi z), at z = 2/3.
      {Law::DoubleHarmonic, kPi * 3 * root3 / 8, pi2, 0, 0},
  };
  for (const Reference& reference : references) {
    SCOPED_TRACE(static_cast<int>(reference.law));
    const Coefficients c = coefficients(curveOf(reference.law));
    EXPECT_NEAR(c.v, reference.v, 1e-12);
    if (reference.a != 0) {
      EXPECT_NEAR(c.a, reference.a, 1e-12);
    }
    if (reference.j != 0) {
      EXPECT_NEAR(c.j, reference.j, 1e-10);
    }
    if (reference.m != 0) {
      EXPECT_NEAR(c.m, reference.m, 1e-12);
    }
  }
}

// To the last digit of the published tables.
TEST(Laws, CoefficientsEqualTheReferenceValues) {
  const Reference references[] = {
      {Law::QuadraticParabola, 2, 4, 0, 8},
      {Law::SimpleSine, 1.5708, 4.9348, 15.503, 3.876},
      {Law::Cycloid, 2, 6.2832, 39.478, 8.162},
      {Law::Polynomial5, 1.875, 5.7735, 60, 6.694},
      {Law::Polynomial7, 2.1875, 7.5132, 52.5, 10.750},
      {Law::Polynomial9, 2.4609, 9.3720, 78.75, 15.436},
      {Law::ModifiedSine, 1.7596, 5.5280, 69.466, 5.458},
      {Law::ModifiedTrapezoid, 2, 4.8881, 61.426, 8.090},
  };
  for (const Reference& reference : references) {
    SCOPED_TRACE(static_cast<int>(reference.law));
    const Coefficients c = coefficients(curveOf(reference.law));
    EXPECT_NEAR(c.v, reference.v, 0.5001e-4);
    EXPECT_NEAR(c.a, reference.a, 0.5001e-4);
    EXPECT_NEAR(c.j, reference.j, 0.5001e-3);
    EXPECT_NEAR(c.m, reference.m, 0.5001e-3);
  }
}

TEST(Laws, RestToRestIsSymmetric) {
  for (const LawRow& row : allLaws()) {
    const bool is_even = row.law == Law::Polynomial2 || row.law == Law::Polynomial4 || row.law == Law::Polynomial6 ||
                         row.law == Law::Polynomial8 || row.law == Law::Polynomial10;
    if (is_even || row.law == Law::DoubleHarmonic) continue;
    SCOPED_TRACE(row.name);
    const Curve curve = curveOf(row.law);
    for (const double z : {0.0625, 0.1875, 0.3125, 0.4375}) {
      EXPECT_NEAR(curve.at(z, 0) + curve.at(1 - z, 0), 1, 1e-14);
      EXPECT_NEAR(curve.at(z, 1), curve.at(1 - z, 1), 1e-13);
      EXPECT_NEAR(curve.at(z, 2), -curve.at(1 - z, 2), 1e-12);
      EXPECT_NEAR(curve.at(z, 3), curve.at(1 - z, 3), 1e-10);
    }
  }
}

// At rest the peak velocity does not depend on the turning point, which has it; the acceleration grows by 0.5 / turn.
TEST(Laws, TurningPointMovesThePeak) {
  for (const Law law : {Law::QuadraticParabola, Law::SimpleSine, Law::Cycloid, Law::ModifiedSine,
                        Law::ModifiedTrapezoid, Law::Gutman}) {
    SCOPED_TRACE(static_cast<int>(law));
    const Curve even = curveOf(law), shifted = curveOf(law, {.turn = 0.25});
    const Extremes velocity = shifted.extremes(1), acceleration = shifted.extremes(2);
    EXPECT_NEAR(velocity.high.value, even.extremes(1).high.value, 1e-12);
    EXPECT_NEAR(velocity.high.x, 0.25, 1e-6);
    EXPECT_NEAR(acceleration.high.value, even.extremes(2).high.value * 2, 1e-11);
    EXPECT_NEAR(acceleration.low.value, even.extremes(2).low.value / 1.5, 1e-11);
  }
}

TEST(Laws, PolynomialsHaveWholeCoefficients) {
  const Curve five = curveOf(Law::Polynomial5), nine = curveOf(Law::Polynomial9);
  const double of_five[] = {0, 0, 0, 10, -15, 6, 0}, of_nine[] = {0, 0, 0, 0, 0, 126, -420, 540, -315, 70, 0};
  for (size_t k = 0; k < std::size(of_five); ++k) EXPECT_EQ(five.pieces()[0].coefficients[k], of_five[k]) << k;
  for (size_t k = 0; k < std::size(of_nine); ++k) EXPECT_EQ(nine.pieces()[0].coefficients[k], of_nine[k]) << k;
}

TEST(Laws, HarmonicCombinationHoldsTheCycloidAndTheDoubleHarmonic) {
  const Curve combination = curveOf(Law::HarmonicCombination), cycloid = curveOf(Law::Cycloid);
  const Curve turn = curveOf(Law::DoubleHarmonic);
  for (const double z : {0.1, 0.3, 0.6, 0.9}) {
    EXPECT_NEAR(combination.at(z, 0), cycloid.at(z, 0), 1e-14);
    const double published = 0.5 * ((1 - std::cos(kPi * z)) - 0.25 * (1 - std::cos(2 * kPi * z)));
    EXPECT_NEAR(turn.at(z, 0), published, 1e-14);
  }
}

TEST(Laws, EvenPolynomialsTakeOneMoreValueAtOneEnd) {
  EXPECT_NE(lawCurve(Law::Polynomial4, {.a0 = 1, .a1 = 1, .given = kA0 | kA1}).error, "");
  const Curve right = curveOf(Law::Polynomial4, {.a1 = 2, .given = kA1});
  EXPECT_NEAR(right.at(1, 2), 2, 1e-13);
}

TEST(Laws, NamesAndAliasesAreFound) {
  for (const LawRow& row : allLaws()) EXPECT_EQ(findLaw(row.name), &row);
  EXPECT_EQ(findLaw("polynomial-3-4-5")->law, Law::Polynomial5);
  EXPECT_EQ(findLaw(""), nullptr);
}

}  // namespace
}  // namespace rung::cam

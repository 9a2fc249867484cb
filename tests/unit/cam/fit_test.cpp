// SPDX-License-Identifier: Apache-2.0
// The fit of cams: error and peaks against known laws, wishes, limits between the points, infeasible requests, time.
#include "cam/fit/fit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

#include "cam/design/peaks.h"
#include "cam/laws/laws.h"

namespace rung::cam {
namespace {

Curve curveOf(Law law) { return lawCurve(law, {}).curve; }

// A law over a stroke and a length, with noise of this part of the stroke.
FitRequest noisy(const Curve& law, size_t count, double stroke, double length, double noise, uint64_t seed) {
  FitRequest request;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, noise * stroke);
  for (size_t i = 0; i < count; ++i) {
    const double z = static_cast<double>(i) / static_cast<double>(count - 1);
    request.samples.push_back({z * length, stroke * law.at(z, 0) + normal(random), 1});
  }
  return request;
}

// Of the fitted curve to the law, and of the peaks of acceleration.
struct Quality {
  double error, acceleration;
};
Quality qualityOf(const FitResult& result, const Curve& law, double stroke, double length) {
  const Curve curve = curveOf(result.cam);
  Quality quality{0, 0};
  for (int i = 0; i <= 10000; ++i) {
    const double z = i / 10000.0;
    quality.error = std::max(quality.error, std::fabs(curve.at(z * length, 0) - stroke * law.at(z, 0)));
  }
  const double peak = std::fabs(law.extremes(2).peak().value) * stroke / (length * length);
  quality.acceleration = std::fabs(curve.extremes(2).peak().value) / peak - 1;
  return quality;
}

bool isSmooth(Law law) {  // its acceleration does not step
  return !lawCurve(law, {}).error.empty() ? false : peaksOf({}, curveOf(law), 1)[3].isInfinite() == false;
}

TEST(Fit, LawsWithNoise) {
  constexpr double kNoise = 1e-4, kStroke = 120, kLength = 360;
  for (const LawRow& row : allLaws()) {
    if (row.is_shock || !isSmooth(row.law)) continue;
    const Curve law = curveOf(row.law);
    for (const uint64_t seed : {1, 2, 3}) {
      for (const Smoothness smoothness : {Smoothness::C2, Smoothness::C3}) {
        FitRequest request = noisy(law, 1000, kStroke, kLength, kNoise, seed);
        request.smoothness = smoothness;
        const FitResult result = fit(request);
        ASSERT_EQ(result.error, "") << row.name;
        const Quality quality = qualityOf(result, law, kStroke, kLength);
        EXPECT_LT(quality.error, 3 * kNoise * kStroke) << row.name << " " << seed;
        EXPECT_LT(std::fabs(quality.acceleration), 0.05) << row.name << " " << seed << " " << result.report.segments;
      }
    }
  }
}

double secondsOf(const FitRequest& request, FitResult& result) {
  const std::clock_t begin = std::clock();
  result = fit(request);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Sines of rising frequency want each of the 100 segments.
FitRequest manyPoints() {
  FitRequest request;
  for (int i = 0; i < 10000; ++i) {
    const double x = i / 9999.0;
    request.samples.push_back({x, std::sin(40 * x + 60 * x * x) + 0.3 * std::sin(150 * x), 1});
  }
  return request;
}

#if defined(RUNG_SANITIZED) || !defined(NDEBUG)
constexpr double kMostSeconds = 60;  // such a build is not the one that is measured
#else
constexpr double kMostSeconds = 1;
#endif

TEST(Fit, TenThousandPointsToHundredSegmentsInASecond) {
  for (const Smoothness smoothness : {Smoothness::C2, Smoothness::C3}) {
    FitRequest request = manyPoints();
    request.smoothness = smoothness;
    FitResult result;
    const double seconds = secondsOf(request, result);
    ASSERT_EQ(result.error, "");
    EXPECT_GE(result.report.segments, 98u);
    EXPECT_LE(result.report.segments, 100u);
    EXPECT_LT(std::fabs(result.report.max_error.value), 1e-3);
    EXPECT_LT(seconds, kMostSeconds);
  }
}

TEST(Fit, SameRequestSameBits) {
  FitRequest request = noisy(curveOf(Law::ModifiedSine), 300, 10, 1, 1e-2, 4);
  request.loss = Loss::Cauchy;
  request.limits.acceleration = 50;
  const FitResult a = fit(request), b = fit(request);
  ASSERT_EQ(a.error, "");
  EXPECT_TRUE(a.cam == b.cam);
}

// Limits hold at the extremes of each piece, and the curve makes use of them.
TEST(Fit, LimitsHoldBetweenThePoints) {
  const Curve law = curveOf(Law::Polynomial5);  // peaks 1.875, 5.7735, 60
  for (const Smoothness smoothness : {Smoothness::C2, Smoothness::C3}) {
    for (const int order : {1, 2, 3}) {
      FitRequest request = noisy(law, 21, 1, 1, 1e-3, 9);
      request.smoothness = smoothness;
      request.most_segments = 32;
      request.exact = {{0, 0}, {1, 1}};
      request.limits.speed = 2;
      const double limit = order == 1 ? 1.7 * 2 : order == 2 ? 5 * 4 : 50 * 8;
      (order == 1 ? request.limits.velocity : order == 2 ? request.limits.acceleration : request.limits.jerk) = limit;
      const FitResult result = fit(request);
      ASSERT_EQ(result.error, "") << order;
      const Peaks peaks = peaksOf(result.cam, curveOf(result.cam), 2);
      const double peak = std::fabs(peaks[static_cast<size_t>(order)].largest().value);
      EXPECT_LE(peak, limit * (1 + 1e-9)) << order;
      EXPECT_GE(peak, limit * 0.999) << order;
      EXPECT_GT(result.report.iterations, 0);
      // A thousand places of the curve, without the code that finds extremes.
      const Curve curve = curveOf(result.cam);
      for (int i = 0; i <= 1000; ++i)
        EXPECT_LE(std::fabs(curve.at(i / 1000.0, order)) * std::pow(2, order), limit * (1 + 1e-9));
      // Only the end derivatives are free: what is continuous is so.
      EXPECT_LT(curve.largestStep(2), 1e-8 * std::fabs(peaks[2].largest().value));
      if (smoothness == Smoothness::C3) {
        EXPECT_LT(curve.largestStep(3), 1e-6 * std::fabs(peaks[3].largest().value));
      }
    }
  }
}

TEST(Fit, PositionLimitsAtTheirBorder) {
  FitRequest request = noisy(curveOf(Law::Polynomial5), 200, 100, 360, 1e-3, 3);
  request.dwells = {{0, 30, 0.0}, {330, 360, 100.0}};
  request.limits.low = 0;
  request.limits.high = 100;
  const FitResult result = fit(request);
  ASSERT_EQ(result.error, "");
  const Extremes extremes = curveOf(result.cam).extremes(0);
  EXPECT_GE(extremes.low.value, -1e-7);
  EXPECT_LE(extremes.high.value, 100 + 1e-7);
}

TEST(Fit, WishesAreMetExactly) {
  FitRequest request;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0, 0.01);
  for (int i = 0; i <= 360; ++i)
    request.samples.push_back({static_cast<double>(i), std::cos(i * std::numbers::pi / 180) + normal(random), 1});
  request.repeat = Repeat::Closed;
  request.exact = {{90, 0.125}, {270.5, -0.1}};
  request.dwells = {{170, 190, {}}, {0, 10, 1.0}};
  for (const Smoothness smoothness : {Smoothness::C2, Smoothness::C3}) {
    request.smoothness = smoothness;
    const FitResult result = fit(request);
    ASSERT_EQ(result.error, "");
    const Curve curve = curveOf(result.cam);
    EXPECT_EQ(curve.at(90, 0), 0.125);
    EXPECT_EQ(curve.at(270.5, 0), -0.1);
    for (const double x : {0.0, 3.3, 10.0}) EXPECT_EQ(curve.at(x, 0), 1.0);
    for (const double x : {170.0, 175.5, 190.0}) {
      EXPECT_NEAR(curve.at(x, 0), curve.at(170, 0), 1e-15);
      EXPECT_NEAR(curve.at(x, 1), 0, 1e-15);
    }
    EXPECT_LT(curve.at(180, 0), -0.9);
    for (const int order : {0, 1, 2}) EXPECT_NEAR(curve.at(0, order), curve.at(360, order), 1e-15);
    if (smoothness == Smoothness::C3) {
      EXPECT_NEAR(curve.at(0, 3), curve.pieces().back().at(360, 3), 1e-9);
    }
  }
}

TEST(Fit, EndsAndPeriods) {
  FitRequest request = noisy(curveOf(Law::Cycloid), 500, 360, 2, 1e-4, 8);
  request.at_start = {0.0, 0.0};
  request.at_end = {0.0, 0.0};
  request.repeat = Repeat::Modulo;
  request.slave_period = 360;
  const FitResult result = fit(request);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.cam.points.front().slope, 0);
  EXPECT_EQ(result.cam.points.back().curvature, 0);
  EXPECT_NEAR(result.cam.points.back().y - result.cam.points.front().y, 360, 1e-12);
  request.repeat = Repeat::Relative;
  EXPECT_EQ(fit(request).cam.points.front().y, 0);
}

TEST(Fit, WeightsAndRobustLoss) {
  const Curve law = curveOf(Law::ModifiedSine);
  FitRequest request = noisy(law, 1000, 1, 1, 1e-4, 6);
  for (size_t i = 7; i < 1000; i += 20) request.samples[i].y += 0.2;  // 50 outliers
  EXPECT_GT(qualityOf(fit(request), law, 1, 1).error, 3e-3);
  for (const Loss loss : {Loss::Huber, Loss::Cauchy, Loss::Tukey}) {
    request.loss = loss;
    const FitResult result = fit(request);
    ASSERT_EQ(result.error, "");
    EXPECT_LT(qualityOf(result, law, 1, 1).error, loss == Loss::Huber ? 6e-4 : 3e-4) << static_cast<int>(loss);
    EXPECT_GE(result.report.outliers, 50u);
    EXPECT_GT(result.report.robust_iterations, 0);
  }
  // A weight of 0 leaves a point out.
  request.loss = Loss::Squares;
  for (size_t i = 7; i < 1000; i += 20) request.samples[i].weight = 0;
  EXPECT_LT(qualityOf(fit(request), law, 1, 1).error, 3e-4);
}

// Few wished points: the smoothest curve through them.
TEST(Fit, WishedPointsOnly) {
  FitRequest request;
  request.samples = {{0, 0, 1}, {90, 20, 1}, {180, 60, 1}, {270, 20, 1}, {360, 0, 1}};
  request.tolerance = 1e-3;
  request.repeat = Repeat::Closed;
  const FitResult result = fit(request);
  ASSERT_EQ(result.error, "");
  EXPECT_LE(std::fabs(result.report.max_error.value), 1e-3);
  EXPECT_LT(curveOf(result.cam).extremes(0).high.value, 61);
}

void expectError(const FitRequest& request, const char* part) {
  const FitResult result = fit(request);
  EXPECT_NE(result.error.find(part), std::string::npos) << result.error;
}

TEST(Fit, InfeasibleRequestsSayWhy) {
  FitRequest request = noisy(curveOf(Law::Polynomial5), 100, 10, 2, 1e-4, 3);
  request.limits.speed = 1;
  request.limits.velocity = 4;
  request.exact = {{0, 0}, {2, 10}};
  expectError(request, "from 0 at 0 to 10 at 2 the slave needs a mean velocity of 5, above the limit 4");
  request.exact.clear();
  request.limits.velocity.reset();
  // From rest to rest over 8 in 1.6 s: at least 4 * 8 / 1.6^2 = 12.5.
  request.dwells = {{0, 0.2, 1.0}, {1.8, 2, 9.0}};
  request.limits.acceleration = 12;
  expectError(request, "an acceleration of at least 12.5, above the limit 12");
  // Above what any curve needs, below what 4 segments can do.
  request.limits.acceleration = 12.6;
  request.most_segments = 5;
  expectError(request, "no curve of 5 segments meets all wishes: the acceleration limit at");
  request.limits.acceleration.reset();
  request.dwells = {{0, 1, 1.0}, {0.5, 2, 3.0}};
  expectError(request, "contradicts another wish");
  request.dwells.clear();
  request.limits.high = 8;
  request.limits.low = 0;
  request.exact = {{1, 9}};
  expectError(request, "outside of the limits");
  request.exact = {{0, 0}, {2, 10}};
  request.limits = {};
  request.repeat = Repeat::Closed;
  expectError(request, "do not meet");
  request = noisy(curveOf(Law::Cycloid), 100, 1, 1, 0.01, 3);
  request.tolerance = 1e-6;
  request.most_segments = 4;
  expectError(request, "above the tolerance 1e-06");
}

}  // namespace
}  // namespace rung::cam

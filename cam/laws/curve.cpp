// SPDX-License-Identifier: Apache-2.0
// Curves in pieces; see curve.h.
#include "cam/laws/curve.h"

#include <algorithm>
#include <cmath>

namespace rung::cam {
namespace {

constexpr int kSamples = 256;     // of a piece; finds the roots of degree 11 and of three sines
constexpr int kBisections = 80;   // more than a double has bits
constexpr double kEqual = 1e-12;  // relative: rounding does not decide which of two equal peaks is reported

double sineAt(const Sine& sine, double t, int order) {
  const double angle = sine.frequency * t + sine.phase;
  double factor = sine.amplitude;
  for (int i = 0; i < order; ++i) factor *= sine.frequency;
  switch (order % 4) {
    case 0: return factor * std::sin(angle);
    case 1: return factor * std::cos(angle);
    case 2: return -factor * std::sin(angle);
    default: return -factor * std::cos(angle);
  }
}

void include(Extremes& extremes, double x, double value) {
  const double margin = kEqual * (std::fabs(extremes.low.value) + std::fabs(extremes.high.value));
  if (value < extremes.low.value - margin) extremes.low = {x, value};
  if (value > extremes.high.value + margin) extremes.high = {x, value};
}

// The ends of the piece and the roots of the slope.
template <typename Value, typename Slope>
void includePiece(Extremes& extremes, const Piece& piece, const Value& value, const Slope& slope) {
  include(extremes, piece.from, value(piece.from));
  const double step = (piece.to - piece.from) / kSamples;
  double a = piece.from, slope_a = slope(a);
  for (int i = 1; i <= kSamples; ++i) {
    const double b = i == kSamples ? piece.to : piece.from + i * step, slope_b = slope(b);
    if (slope_a * slope_b < 0) {
      double low = a, high = b;
      for (int k = 0; k < kBisections; ++k) {
        const double middle = low + (high - low) / 2;
        (slope(middle) * slope_a > 0 ? low : high) = middle;
      }
      include(extremes, low, value(low));
    } else if (slope_b == 0) {
      include(extremes, b, value(b));
    }
    a = b;
    slope_a = slope_b;
  }
  include(extremes, piece.to, value(piece.to));
}

}  // namespace

double Piece::at(double x, int order) const {
  const double t = x - origin;
  double value = 0;
  for (int k = kMostDegree; k >= order; --k) {
    double factor = 1;
    for (int i = 0; i < order; ++i) factor *= k - i;
    value = value * t + coefficients[static_cast<size_t>(k)] * factor;
  }
  for (const Sine& sine : sines)
    if (sine.amplitude != 0) value += sineAt(sine, t, order);
  return value;
}

const Extreme& Extremes::peak() const {
  const double difference = std::fabs(high.value) - std::fabs(low.value);
  if (std::fabs(difference) <= kEqual * std::fabs(high.value)) return low.x < high.x ? low : high;
  return difference > 0 ? high : low;
}

double Curve::at(double x, int order) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end() - 1, x,
                                      [](double at, const Piece& piece) { return at < piece.to; });
  return after->at(x, order);
}

Extremes Curve::extremes(int order) const {
  const double first = pieces_.front().at(begin(), order);
  Extremes extremes{{begin(), first}, {begin(), first}};
  for (const Piece& piece : pieces_)
    includePiece(
        extremes, piece, [&](double x) { return piece.at(x, order); },
        [&](double x) { return piece.at(x, order + 1); });
  return extremes;
}

Extremes Curve::powerExtremes() const {
  const Piece& start = pieces_.front();
  const double first = start.at(begin(), 1) * start.at(begin(), 2);
  Extremes extremes{{begin(), first}, {begin(), first}};
  for (const Piece& piece : pieces_)
    includePiece(
        extremes, piece, [&](double x) { return piece.at(x, 1) * piece.at(x, 2); },
        [&](double x) { return piece.at(x, 2) * piece.at(x, 2) + piece.at(x, 1) * piece.at(x, 3); });
  return extremes;
}

double Curve::largestStep(int order) const {
  double largest = 0;
  for (size_t i = 0; i + 1 < pieces_.size(); ++i) {
    const double at = pieces_[i].to;
    largest = std::max(largest, std::fabs(pieces_[i + 1].at(at, order) - pieces_[i].at(at, order)));
  }
  return largest;
}

// Newton's form with confluent nodes: on a unit interval every gap of nodes is 0 or 1, so whole boundary values give
// whole coefficients without rounding.
Piece hermite(double from, double to, std::span<const double> left, std::span<const double> right) {
  const double length = to - from;
  const size_t count = left.size() + right.size();
  std::array<double, kMostDegree + 1> taylor_left{}, taylor_right{}, differences{};
  double factor = 1;
  for (size_t k = 0; k < count; ++k) {
    if (k < left.size()) taylor_left[k] = left[k] * factor;
    if (k < right.size()) taylor_right[k] = right[k] * factor;
    factor *= length / static_cast<double>(k + 1);
  }

  // Column after column of the triangle of divided differences; its upper edge has the coefficients.
  std::array<double, kMostDegree + 1> column{};
  for (size_t i = 0; i < count; ++i) column[i] = i < left.size() ? taylor_left[0] : taylor_right[0];
  differences[0] = column[0];
  for (size_t order = 1; order < count; ++order) {
    for (size_t i = 0; i + order < count; ++i) {
      if (i + order < left.size())
        column[i] = taylor_left[order];
      else if (i >= left.size())
        column[i] = taylor_right[order];
      else
        column[i] = column[i + 1] - column[i];
    }
    differences[order] = column[0];
  }

  // Horner's rule over the nodes: right ones at 1, left ones at 0.
  Piece piece{.from = from, .to = to, .origin = from};
  auto& c = piece.coefficients;
  for (size_t k = count; k-- > 0;) {
    const double node = k < left.size() ? 0 : 1;
    for (size_t i = kMostDegree; i > 0; --i) c[i] = c[i - 1] - node * c[i];
    c[0] = differences[k] - node * c[0];
  }
  double power = 1;
  for (double& coefficient : c) {
    coefficient /= power;
    power *= length;
  }
  return piece;
}

}  // namespace rung::cam

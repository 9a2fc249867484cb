// SPDX-License-Identifier: Apache-2.0
// Extremes of cam tables; see bounds.h. A derivative's extremes are at the ends of its segment and at the roots of the
// next derivative, which lie between the extremes of that one.
#include "cam/table/bounds.h"

#include <math.h>

namespace rung::cam {
namespace {

constexpr int kDegree = 5;
constexpr int kOrders = 3;  // position, slope, curvature

// c[0] + c[1] s + … + c[degree] s^degree
struct Powers {
  double c[kDegree + 1] = {};
  int degree = kDegree;

  double at(double s) const {
    double value = 0;
    for (int i = degree; i >= 0; --i) value = value * s + c[i];
    return value;
  }
  Powers derivative() const {
    Powers result;
    result.degree = degree > 0 ? degree - 1 : 0;
    for (int i = 0; i < degree; ++i) result.c[i] = (i + 1) * c[i + 1];
    return result;
  }
};

// Where a polynomial changes its sign.
struct Roots {
  double s[kDegree];
  int count = 0;
};

// Bisection: f(low) and f(high) have different signs.
double rootBetween(const Powers& f, double low, double high) {
  const bool rises = f.at(high) > 0;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) return middle;
    ((f.at(middle) > 0) == rises ? high : low) = middle;
  }
}

// In ascending order. Between two extremes there is one root at most.
Roots rootsOf(const Powers& f, double from, double to) {
  Roots roots;
  if (f.degree == 0) return roots;
  const Roots turns = rootsOf(f.derivative(), from, to);
  double low = from;
  for (int i = 0; i <= turns.count; ++i) {
    const double high = i < turns.count ? turns.s[i] : to;
    if (f.at(low) * f.at(high) < 0) roots.s[roots.count++] = rootBetween(f, low, high);
    low = high;
  }
  return roots;
}

double higher(double a, double b) { return a > b ? a : b; }
double lower(double a, double b) { return a < b ? a : b; }

void widen(Range& range, double value) {
  if (value < range.low) range.low = value;
  if (value > range.high) range.high = value;
}

}  // namespace

Bounds emptyBounds() {
  const Range empty = {HUGE_VAL, -HUGE_VAL};
  return {empty, empty, empty};
}

bool include(const Table& table, int32_t segment, Bounds& bounds) {
  Segment part = {};
  if (!segmentOf(table, segment, part)) return false;
  const double length = part.to - part.from;
  const double from = higher(0, (table.start - part.from) / length), to = lower(1, (table.end - part.from) / length);
  if (!(from <= to)) return true;  // beyond the ends of the table
  Powers f;
  for (int i = 0; i <= kDegree; ++i) f.c[i] = part.c[i];
  Range* const ranges[kOrders] = {&bounds.position, &bounds.slope, &bounds.curvature};
  double per_length = 1;
  for (Range* const range : ranges) {
    const Powers next = f.derivative();
    widen(*range, f.at(from) * per_length);
    widen(*range, f.at(to) * per_length);
    const Roots turns = rootsOf(next, from, to);
    for (int i = 0; i < turns.count; ++i) widen(*range, f.at(turns.s[i]) * per_length);
    f = next;
    per_length /= length;
  }
  return true;
}

}  // namespace rung::cam

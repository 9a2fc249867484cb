// SPDX-License-Identifier: Apache-2.0
// Knots and unknowns of a fit; see knots.h.
#include "cam/fit/knots.h"

#include <algorithm>
#include <cmath>

#include "cam/design/text_form.h"
#include "cam/table/quintic.h"

namespace rung::cam {

std::array<std::array<double, 6>, 6> basisOf(double length) {
  constexpr QuinticEnd kNone{0, 0, 0}, kUnits[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::array<std::array<double, 6>, 6> basis{};
  for (size_t i = 0; i < 3; ++i) {
    const Quintic first = quinticOf(kUnits[i], kNone, length), last = quinticOf(kNone, kUnits[i], length);
    basis[i] = {kUnits[i].position, first.c1, first.c2, first.c3, first.c4, first.c5};
    basis[i + 3] = {0, last.c1, last.c2, last.c3, last.c4, last.c5};
  }
  return basis;
}

size_t KnotSystem::rootOf(size_t variable, double& offset) const {
  offset = 0;
  while (variables_[variable].parent != variable) {
    offset += variables_[variable].offset;
    variable = variables_[variable].parent;
  }
  return variable;
}

bool KnotSystem::fix(size_t knot, size_t derivative, double value) {
  double offset = 0;
  Variable& root = variables_[rootOf(3 * knot + derivative, offset)];
  value -= offset;
  if (root.is_fixed) return std::fabs(root.value - value) <= 1e-12 * (1 + std::fabs(value));
  root.is_fixed = true;
  root.value = value;
  return true;
}

// b = a + difference
bool KnotSystem::unite(size_t a, size_t b, double difference) {
  double of_a = 0, of_b = 0;
  const size_t root_a = rootOf(a, of_a), root_b = rootOf(b, of_b);
  const double offset = of_a + difference - of_b;  // of root_b to root_a
  Variable &first = variables_[root_a], &second = variables_[root_b];
  if (root_a == root_b) return std::fabs(offset) <= 1e-12;
  if (first.is_fixed && second.is_fixed)
    return std::fabs(first.value + offset - second.value) <= 1e-12 * (1 + std::fabs(second.value));
  if (second.is_fixed) {
    first.is_fixed = true;
    first.value = second.value - offset;
  }
  second.parent = root_a;
  second.offset = offset;
  return true;
}

std::string KnotSystem::build(const FitRequest& request, std::vector<double> knots, double stroke) {
  knots_ = std::move(knots);
  stroke_ = stroke;
  mean_ = (knots_.back() - knots_.front()) / static_cast<double>(segments());
  variables_.assign(3 * knots_.size(), {});
  for (size_t i = 0; i < variables_.size(); ++i) variables_[i].parent = i;
  const size_t last = knots_.size() - 1;
  const auto knotAt = [&](double x) {
    return static_cast<size_t>(std::lower_bound(knots_.begin(), knots_.end(), x) - knots_.begin());
  };

  for (const ExactPoint& point : request.exact)
    if (!fix(knotAt(point.x), 0, point.y / stroke)) return "two positions are wished at " + exactText(point.x);
  for (const Dwell& dwell : request.dwells) {
    const size_t from = knotAt(dwell.from), to = knotAt(dwell.to);
    std::string contradiction = "the dwell from " + exactText(dwell.from) + " to " + exactText(dwell.to) +
                                " contradicts another wish: the slave cannot rest at two positions";
    for (size_t knot = from; knot <= to; ++knot) {
      if (!fix(knot, 1, 0) || !fix(knot, 2, 0)) return contradiction;
      if (knot > from && !unite(3 * from, 3 * knot, 0)) return contradiction;
    }
    if (dwell.y && !fix(from, 0, *dwell.y / stroke)) return contradiction;
  }
  const auto fixEnd = [&](size_t knot, const EndCondition& end) {
    return (!end.slope || fix(knot, 1, scaled(*end.slope, 1))) &&
           (!end.curvature || fix(knot, 2, scaled(*end.curvature, 2)));
  };
  if (!fixEnd(0, request.at_start) || !fixEnd(last, request.at_end))
    return "the derivatives at an end contradict the dwell there";

  if (request.repeat == Repeat::Never) {
  } else if (!unite(1, 3 * last + 1, 0) || !unite(2, 3 * last + 2, 0)) {
    return "the cam repeats, so velocity and acceleration at both ends are equal, and the wishes for them are not";
  } else if (request.repeat == Repeat::Relative) {
    if (!fix(0, 0, 0)) return "each period is added to the end of the last one, so the cam begins at 0";
  } else {
    const double way = request.samples.back().y - request.samples.front().y;
    const double periods = request.repeat == Repeat::Modulo ? std::round(way / request.slave_period) : 0;
    if (!unite(0, 3 * last, periods * request.slave_period / stroke))
      return "the cam repeats, and the positions wished at both ends do not meet";
  }

  std::vector<int> index(variables_.size(), -1);
  map_.resize(variables_.size());
  count_ = 0;
  for (size_t i = 0; i < variables_.size(); ++i) {
    double offset = 0;
    const size_t root = rootOf(i, offset);
    if (variables_[root].is_fixed) {
      map_[i] = {-1, variables_[root].value + offset};
      continue;
    }
    if (index[root] < 0) index[root] = count_++;
    map_[i] = {index[root], offset};
  }
  return {};
}

size_t KnotSystem::segmentAt(double x) const {
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, x);
  return static_cast<size_t>(after - knots_.begin()) - 1;
}

double KnotSystem::scaled(double value, int order) const {
  for (int i = 0; i < order; ++i) value *= mean_;
  return value / stroke_;
}

BasisRow KnotSystem::row(size_t segment, double t, int order) const {
  const double h = length(segment);
  const auto basis = basisOf(h);
  BasisRow row{segment, {}};
  double per_length = 1;
  for (int i = 0; i < order; ++i) per_length /= h;
  for (size_t f = 0; f < 6; ++f) {
    double value = 0;
    for (int k = 5; k >= order; --k) {
      double factor = basis[f][static_cast<size_t>(k)];
      for (int i = 0; i < order; ++i) factor *= k - i;
      value = value * t + factor;
    }
    row.factors[f] = value * per_length;
  }
  return row;
}

}  // namespace rung::cam

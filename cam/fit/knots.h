// SPDX-License-Identifier: Apache-2.0
// A curve of quintic pieces as numbers to solve for: position, slope and second derivative at each knot, some of them
// known, equal to each other, or a known distance apart. In: knots and wishes. Out: for each derivative at a knot the
// unknown that it is; rows of the linear system. Called by fit.cpp and robust.cpp.
// Positions are in units of `stroke`, master positions in those of a mean segment.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cam/fit/fit.h"

namespace rung::cam {

// A derivative at a knot: unknowns[index] + offset, or the offset where the index is -1.
struct Unknown {
  int index = -1;
  double offset = 0;
};

// The value of a derivative at a place: the sum of six factors times the derivatives at the ends of the segment.
struct BasisRow {
  size_t segment = 0;
  std::array<double, 6> factors{};
};

class KnotSystem {
 public:
  // An error, or an empty string: wishes that contradict each other.
  [[nodiscard]] std::string build(const FitRequest& request, std::vector<double> knots, double stroke);

  const std::vector<double>& knots() const { return knots_; }
  size_t segments() const { return knots_.size() - 1; }
  int unknowns() const { return count_; }
  const Unknown& at(size_t knot, size_t derivative) const { return map_[3 * knot + derivative]; }
  const Unknown& at(const BasisRow& row, size_t factor) const { return map_[3 * row.segment + factor]; }
  size_t segmentAt(double x) const;
  double stroke() const { return stroke_; }
  double mean() const { return mean_; }
  // Of the segment, in mean segments.
  double length(size_t segment) const { return (knots_[segment + 1] - knots_[segment]) / mean_; }

  // `t` from 0 to 1 in the segment.
  BasisRow row(size_t segment, double t, int order) const;
  double parameter(size_t segment, double x) const {
    return (x - knots_[segment]) / (knots_[segment + 1] - knots_[segment]);
  }
  // From a value of this derivative to units of the system.
  double scaled(double value, int order) const;

 private:
  size_t rootOf(size_t variable, double& offset) const;
  bool fix(size_t knot, size_t derivative, double value);
  bool unite(size_t a, size_t b, double difference);

  std::vector<double> knots_;
  double stroke_ = 1, mean_ = 1;
  struct Variable {
    size_t parent;
    double offset = 0;  // to the parent
    bool is_fixed = false;
    double value = 0;
  };
  std::vector<Variable> variables_;
  std::vector<Unknown> map_;
  int count_ = 0;
};

// The coefficients of t^0 to t^5 of the six functions of a segment of this length.
std::array<std::array<double, 6>, 6> basisOf(double length);

}  // namespace rung::cam

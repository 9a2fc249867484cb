// SPDX-License-Identifier: Apache-2.0
// The model of a fit: the curve over given knots with the least squared error, and the same within limits. In: knots
// and the weights of points. Out: a solution and its measures. Which knots there are is the search's matter, fit.cpp,
// which calls all of this.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cam/design/peaks.h"
#include "cam/fit/fit.h"
#include "cam/fit/knots.h"
#include "cam/fit/quadratic_program.h"

namespace rung::cam {

inline constexpr double kFitRounding = 1e-10;  // of the stroke: a smaller error is not noise

struct Solution {
  KnotSystem system;
  Eigen::VectorXd z;
  double squares = 0;    // weighted
  double criterion = 0;  // the Bayesian information criterion
  double largest = 0;    // error
};

class Model {
 public:
  Model(const FitRequest& request, double stroke);

  enum class Outcome : uint8_t { Solved, NeedsSegments, Impossible };
  // Without limits. `error` says why there is none.
  Outcome solve(std::vector<double> knots, Solution& solution, std::string& error) const;
  bool hasLimits(const KnotSystem& system) const;
  // Makes the solution keep the limits. False: `why` has the reason, which more segments may remove.
  bool constrain(Solution& best, std::string& why, int& iterations) const;

  void measure(Solution& solution) const;
  double errorOf(const Solution& solution, const Sample& sample) const;
  std::vector<double> errorsOf(const Solution& solution, bool squares) const;
  double smoothing(const KnotSystem& system) const;
  double stroke() const { return stroke_; }

  // Not left out by its weight, and not an outlier: one that says more about the noise than about the curve.
  bool counts(size_t sample) const {
    return weights_[sample] > 0 && weights_[sample] >= request_.samples[sample].weight / 2;
  }
  // With the robust loss a sample counts with this part of its weight.
  void reweight(size_t sample, double part) { weights_[sample] = request_.samples[sample].weight * part; }

 private:
  struct Bound;
  struct Constraint;
  struct Violation;
  Eigen::MatrixXd matrix(const KnotSystem& system, Eigen::VectorXd& g) const;
  bool addJoints(const KnotSystem& system, QuadraticProgram& program, std::vector<Constraint>& constraints) const;
  std::vector<Bound> bounds(const KnotSystem& system) const;
  std::vector<Violation> violationsOf(const Solution& best, const std::vector<Bound>& all) const;
  static bool addLimit(const KnotSystem& system, const Violation& violation, QuadraticProgram& program,
                       std::vector<Constraint>& constraints);
  static std::string contradiction(const QuadraticProgram& program, const std::vector<Constraint>& constraints);

  const FitRequest& request_;
  double stroke_ = 1, total_weight_ = 0;
  std::vector<double> weights_;  // of the samples
};

const char* nameOf(LimitKind kind);
std::string shortText(double value);

}  // namespace rung::cam

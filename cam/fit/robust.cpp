// SPDX-License-Identifier: Apache-2.0
// Robust weights; see robust.h.
#include "cam/fit/robust.h"

#include <ceres/ceres.h>

#include <cmath>
#include <memory>

namespace rung::cam {
namespace {

// (row times the derivatives - y) * weight, over those that are unknown.
class RowCost final : public ceres::CostFunction {
 public:
  RowCost(const KnotSystem& system, const BasisRow& row, double y, double weight, std::vector<double*>& blocks,
          std::vector<double>& x)
      : constant_(-y * weight) {
    set_num_residuals(1);
    for (size_t f = 0; f < 6; ++f) {
      const Unknown& unknown = system.at(row, f);
      const double factor = row.factors[f] * weight;
      constant_ += factor * unknown.offset;
      if (unknown.index < 0) continue;
      double* const block = &x[static_cast<size_t>(unknown.index)];
      size_t at = 0;
      while (at < blocks.size() && blocks[at] != block) ++at;
      if (at == blocks.size()) {
        blocks.push_back(block);
        factors_.push_back(0);
        mutable_parameter_block_sizes()->push_back(1);
      }
      factors_[at] += factor;
    }
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = constant_;
    for (size_t i = 0; i < factors_.size(); ++i) {
      residuals[0] += factors_[i] * parameters[i][0];
      if (jacobians != nullptr && jacobians[i] != nullptr) jacobians[i][0] = factors_[i];
    }
    return true;
  }

 private:
  double constant_;
  std::vector<double> factors_;
};

ceres::LossFunction* lossOf(Loss loss, double scale) {
  switch (loss) {
    case Loss::Squares: return nullptr;
    case Loss::Huber: return new ceres::HuberLoss(scale);
    case Loss::Cauchy: return new ceres::CauchyLoss(scale);
    case Loss::Tukey: return new ceres::TukeyLoss(scale);
  }
  return nullptr;
}

void addRow(ceres::Problem& problem, const KnotSystem& system, const BasisRow& row, double y, double weight,
            ceres::LossFunction* loss, std::vector<double>& x) {
  std::vector<double*> blocks;
  auto cost = std::make_unique<RowCost>(system, row, y, weight, blocks, x);
  if (!blocks.empty()) problem.AddResidualBlock(cost.release(), loss, blocks);
}

}  // namespace

double lossWeight(Loss loss, double error, double scale) {
  const std::unique_ptr<ceres::LossFunction> function(lossOf(loss, scale));
  if (function == nullptr) return 1;
  double rho[3];
  function->Evaluate(error * error, rho);
  return rho[1];
}

RobustWeights robustWeights(const KnotSystem& system, const FitRequest& request, double smoothing, double scale,
                            const std::vector<double>& start) {
  std::vector<double> x = start;
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  const std::unique_ptr<ceres::LossFunction> loss(lossOf(request.loss, scale));
  for (const Sample& sample : request.samples) {
    const size_t segment = system.segmentAt(sample.x);
    const BasisRow row = system.row(segment, system.parameter(segment, sample.x), 0);
    addRow(problem, system, row, sample.y / system.stroke(), std::sqrt(sample.weight), loss.get(), x);
  }
  for (size_t segment = 0; segment < system.segments(); ++segment)
    for (const double t : {0.0, 0.5, 1.0})
      addRow(problem, system, system.row(segment, t, 3), 0, std::sqrt(smoothing * system.length(segment) / 3), nullptr,
             x);

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = 1;  // the same sums in the same order
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  RobustWeights out;
  out.iterations = static_cast<int>(summary.iterations.size());
  for (const Sample& sample : request.samples) {
    const size_t segment = system.segmentAt(sample.x);
    const BasisRow row = system.row(segment, system.parameter(segment, sample.x), 0);
    double error = -sample.y / system.stroke();
    for (size_t f = 0; f < 6; ++f) {
      const Unknown& unknown = system.at(row, f);
      error += row.factors[f] * (unknown.offset + (unknown.index < 0 ? 0 : x[static_cast<size_t>(unknown.index)]));
    }
    out.weights.push_back(lossWeight(request.loss, error * std::sqrt(sample.weight), scale));
  }
  return out;
}

}  // namespace rung::cam

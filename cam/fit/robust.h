// SPDX-License-Identifier: Apache-2.0
// How much each point counts under a robust loss, by Ceres: the curve of the least loss without limits, and the weight
// of each point there. In: points and unknowns. Out: weights from 0 to 1. Called by fit.cpp.
#pragma once

#include <vector>

#include "cam/fit/knots.h"

namespace rung::cam {

struct RobustWeights {
  std::vector<double> weights;  // of the samples
  int iterations = 0;
};
// `x`: where to begin. `scale`: of the loss, in units of the system.
RobustWeights robustWeights(const KnotSystem& system, const FitRequest& request, double smoothing, double scale,
                            const std::vector<double>& x);

// The weight of an error under the loss.
double lossWeight(Loss loss, double error, double scale);

}  // namespace rung::cam

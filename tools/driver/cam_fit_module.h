// SPDX-License-Identifier: Apache-2.0
// Fits a cam with the part of Rung that is loaded on demand. In: a request. Out: the result, or why there is no such
// part. Called by cam_fit.cpp.
#pragma once

#include <string>

#include "cam/fit/fit.h"

namespace rung::driver {

// The error is about the installation, not about the points.
[[nodiscard]] std::string fitWithModule(const cam::FitRequest& request, cam::FitResult& result);

}  // namespace rung::driver

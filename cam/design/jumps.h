// SPDX-License-Identifier: Apache-2.0
// The jumps of a cam's position, which no axis can follow: where two pieces of its curve meet, and where it repeats.
// In: a curve or a cam. Out: the jumps that are larger than rounding makes them. Called by the check of cam files
// (frontend/import/cam/cam_checks.cpp) and the rule for cams that a program declares (sema/checks/cam_tables.cpp).
#pragma once

#include <optional>
#include <vector>

#include "cam/design/cam.h"

namespace rung::cam {

struct Jump {
  double x = 0, size = 0;
};

// Where two pieces meet, in order.
std::vector<Jump> jumpsOf(const Curve& curve);

// Where the cam ends and begins again, on a slave that repeats it in this way; none: it does not jump there.
std::optional<double> jumpOfRepeat(const Cam& cam, const Curve& curve, Repeat repeat);

}  // namespace rung::cam

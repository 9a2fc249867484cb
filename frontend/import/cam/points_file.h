// SPDX-License-Identifier: Apache-2.0
// Points to fit a cam to, as CSV: `x,y` or `x,y,weight` on a line, after an optional header; docs/cam.md. In: the text
// of a file. Out: points in ascending order of x; all mistakes reported. Called by `rung cam fit`.
#pragma once

#include <vector>

#include "frontend/source/diagnostics.h"

namespace rung::importer::cams {

struct MeasuredPoint {
  double x = 0, y = 0, weight = 1;
};

// False: errors have been reported.
[[nodiscard]] bool readPoints(const Sources& sources, FileId file, Diagnostics& diagnostics,
                              std::vector<MeasuredPoint>& points);

}  // namespace rung::importer::cams

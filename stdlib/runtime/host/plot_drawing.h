// SPDX-License-Identifier: Apache-2.0
// Draws timing diagrams as SVG: a lane for each variable over a common axis, of time or another quantity. BOOLs are
// levels, enumerations boxes with the item's name, numbers curves on an axis of their own. The colours follow a light
// or dark page. In: the columns of the lanes. Out: the text of the picture. Called by plot.cpp and `rung cam show`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rung::host {

// One or several rows of a variable; NaN: nothing to draw.
struct PlotColumn {
  double first, low, high, last;
};

enum class PlotKind : uint8_t { Level, Item, Number, Duration };

struct PlotLane {
  struct Item {
    double value;
    std::string name;
  };
  struct Mark {
    double column, value;
    std::string text;
  };
  std::string name;
  PlotKind kind = PlotKind::Number;
  bool is_whole = false;  // of numbers: no fractions between the ticks
  double unit_ns = 1;     // of durations
  std::vector<Item> items;
  std::vector<PlotColumn> columns;
  std::vector<double> limits;  // dashed lines across a lane of numbers
  std::vector<Mark> marks;     // dots on its curve
};

// The common axis, where it is not the time.
struct PlotRange {
  double from, to;
  std::string name;
};

// The axis of a lane: equally spaced round values around all of its own, at most five.
struct PlotAxis {
  double low = 0, high = 0, step = 0;  // step 0: one value
  int count() const;
};
PlotAxis axisFor(double low, double high, bool is_whole);

// `columns`: how many of them the time from 0 to `end_ns` is; the last may be a part.
std::string drawPlot(const std::vector<PlotLane>& lanes, double columns, int64_t end_ns);
std::string drawPlot(const std::vector<PlotLane>& lanes, double columns, const PlotRange& range);

}  // namespace rung::host

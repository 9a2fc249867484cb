// SPDX-License-Identifier: Apache-2.0
// The plan of a chart: the positions of its steps, transitions, lines and jumps. In: steps and transitions as parsed.
// chart_positions.cpp takes the positions of the file; chart_plan.cpp finds the branches and lays them out;
// chart_picture.cpp measures and draws. Private to frontend/render.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "frontend/render/svg.h"
#include "frontend/syntax/tree.h"

namespace rung::picture {

constexpr int32_t kBranchGap = 30;
constexpr int32_t kDouble = 4;  // between the lines of a simultaneous divergence

struct ChartNode {
  bool step;
  uint32_t index;  // in the steps or transitions of the POU
  Rect area;       // around the point where the line comes in from above; the line leaves at `below`
  int32_t below = 0;
  Point origin;
};
struct ChartLine {
  Point from, to;
  bool doubled = false;
};
struct ChartJump {
  Point at;  // where its line begins
  NameId step;
};
struct ChartPlan {
  std::vector<ChartNode> nodes;  // steps, then transitions with a target
  std::vector<ChartLine> lines;
  std::vector<ChartJump> jumps;
  Rect bounds;
};

constexpr int32_t kJumpHeight = 40;
constexpr int32_t kStretch = 15;  // of vertical line between a node and the next

struct ChartEdge {
  uint32_t to;  // kNoNode: undefined step
  NameId name;  // of the step, for a jump
  bool back = false;
};
constexpr uint32_t kNoNode = UINT32_MAX;
// The successors of each node, in the order in which they are evaluated.
std::vector<std::vector<ChartEdge>> edgesOf(const Tree& tree, const Names& names, const PouDecl& pou,
                                            const ChartPlan& plan);

// Takes the positions of the file, if it has them and lines can be drawn between them.
bool takeChartPositions(const Tree& tree, const Names& names, const PouDecl& pou, ChartPlan& plan);
// In: measured `nodes`. Out: all other members.
void planChart(const Tree& tree, const Names& names, const PouDecl& pou, ChartPlan& plan);
// Steps and transitions with their sizes.
ChartPlan measureChart(const Tree& tree, const Names& names, const PouDecl& pou);

}  // namespace rung::picture

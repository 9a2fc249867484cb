// SPDX-License-Identifier: Apache-2.0
// The positions of steps and transitions in the file in which a chart was drawn. Names and actions may be larger here
// than there, so rows and columns are spread where nodes would be too close to each other. The file's divergences and
// jumps are reconstructed from the connections: a bar is drawn between the nodes above and below it, and a link upwards
// is an arrow with the name of its step. A chart in which lines would run through nodes or through each other is laid
// out automatically instead.
#include <algorithm>

#include "frontend/render/chart_plan.h"
#include "frontend/render/spread.h"
#include "frontend/syntax/sfc.h"

namespace rung::picture {
namespace {

constexpr size_t kMostPlacedSteps = 2'000;  // compared pairwise

class Placer {
 public:
  Placer(const Tree& tree, const Names& names, const PouDecl& pou, ChartPlan& plan)
      : tree_(tree), names_(names), pou_(pou), plan_(plan) {}
  bool run();

 private:
  struct Line {
    ChartLine line;
    uint32_t group;  // one branching or one line
  };
  const SfcPosition& positionOf(uint32_t node) const {
    const ChartNode& n = plan_.nodes[node];
    return n.step ? tree_.list(pou_.steps)[n.index].position : tree_.list(pou_.transitions)[n.index].position;
  }
  bool readPositions();
  bool sortEdges();
  void spreadNodes();
  void addLine(Point a, Point b, bool doubled = false) {
    if (a != b) lines_.push_back({{a, b, doubled}, group_});
  }
  void drawLines(uint32_t node);
  void drawMeeting(uint32_t node);
  void addJump(Point from, int32_t bottom, NameId step);
  bool isReadable() const;
  Point below(uint32_t node) const {
    const ChartNode& n = plan_.nodes[node];
    return {n.origin.x, n.origin.y + n.below};
  }

  const Tree& tree_;
  const Names& names_;
  const PouDecl& pou_;
  ChartPlan& plan_;
  std::vector<Point> wanted_;
  std::vector<std::vector<uint32_t>> down_, up_;  // by node: targets and sources of its lines
  std::vector<std::vector<NameId>> jumps_;        // by node
  std::vector<Line> lines_;
  uint32_t group_ = 0;
};

bool Placer::readPositions() {
  if (plan_.nodes.empty() || plan_.nodes.size() > kMostPlacedSteps) return false;
  std::vector<std::pair<int32_t, int32_t>> all;
  for (uint32_t k = 0; k < plan_.nodes.size(); ++k) {
    const SfcPosition& position = positionOf(k);
    constexpr int32_t kMax = 1 << 20;
    if (!position.placed || std::abs(position.x) > kMax || std::abs(position.y) > kMax) return false;
    const int32_t middle = position.x + std::clamp(position.width, 0, 1000) / 2;
    wanted_.push_back({(middle + (middle >= 0 ? kGrid / 2 : -kGrid / 2)) / kGrid * kGrid, position.y});
    all.emplace_back(wanted_[k].x, wanted_[k].y);
  }
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

// Sorts edges into lines and jumps. False: a branching that is neither a divergence nor a convergence.
bool Placer::sortEdges() {
  const auto edges = edgesOf(tree_, names_, pou_, plan_);
  down_.resize(plan_.nodes.size());
  up_.resize(plan_.nodes.size());
  jumps_.resize(plan_.nodes.size());
  for (uint32_t k = 0; k < edges.size(); ++k)
    for (const ChartEdge& edge : edges[k]) {
      const bool leads_down = edge.to != kNoNode && wanted_[edge.to].y > wanted_[k].y;
      if (!leads_down && plan_.nodes[k].step) return false;  // a transition above its step
      if (leads_down) {
        down_[k].push_back(edge.to);
        up_[edge.to].push_back(k);
      } else {
        jumps_[k].push_back(edge.name);
      }
    }
  for (uint32_t k = 0; k < edges.size(); ++k) {
    if (down_[k].size() < 2) continue;
    for (size_t i = 0; i < down_[k].size();) {
      const uint32_t to = down_[k][i];
      if (up_[to].size() < 2) {
        ++i;
        continue;
      }
      if (plan_.nodes[k].step) return false;
      jumps_[k].push_back(tree_.list(pou_.steps)[plan_.nodes[to].index].name.name);
      down_[k].erase(down_[k].begin() + static_cast<std::ptrdiff_t>(i));
      std::erase(up_[to], k);
    }
  }
  for (uint32_t k = 0; k < edges.size(); ++k)
    if (jumps_[k].size() + (down_[k].empty() ? 0u : 1u) > 1) return false;  // jumps beside other branches
  return true;
}

void Placer::spreadNodes() {
  const size_t count = plan_.nodes.size();
  Axis x, y;
  for (uint32_t k = 0; k < count; ++k) {
    const ChartNode& n = plan_.nodes[k];
    x.wanted.push_back(wanted_[k].x);
    x.before.push_back(-n.area.x);
    x.after.push_back(n.area.right());
    y.wanted.push_back(wanted_[k].y);
    y.before.push_back(0);
    y.after.push_back(std::max(n.area.height, n.below + (jumps_[k].empty() ? 0 : kJumpHeight)));
  }
  const auto connected = [&](uint32_t a, uint32_t b) {
    return std::find(down_[a].begin(), down_[a].end(), b) != down_[a].end();
  };
  const auto gapY = [&](uint32_t a, uint32_t b) {
    if (connected(a, b) || connected(b, a)) {
      const uint32_t upper = connected(a, b) ? a : b, lower = upper == a ? b : a;
      const bool single = down_[upper].size() == 1 && up_[lower].size() == 1;
      return single && wanted_[a].x == wanted_[b].x ? kStretch : 2 * kStretch + kDouble;
    }
    const bool apart = wanted_[a].x - x.before[a] >= wanted_[b].x + x.after[b] ||
                       wanted_[b].x - x.before[b] >= wanted_[a].x + x.after[a];
    return apart ? -1 : kStretch;
  };
  const std::vector<int32_t> ys = spread(y, gapY);
  const auto gapX = [&](uint32_t a, uint32_t b) {
    return std::max(ys[a], ys[b]) < std::min(ys[a] + y.after[a], ys[b] + y.after[b]) ? kBranchGap : -1;
  };
  const std::vector<int32_t> xs = spread(x, gapX);
  for (uint32_t k = 0; k < count; ++k) plan_.nodes[k].origin = {xs[k], ys[k]};
}

void Placer::addJump(Point from, int32_t bottom, NameId step) {
  addLine(from, {from.x, bottom});
  plan_.jumps.push_back({{from.x, bottom}, step});
}

// Lines from a node down to nodes with no other predecessor.
void Placer::drawLines(uint32_t node) {
  ++group_;
  const Point from = below(node);
  if (!jumps_[node].empty()) return addJump(from, from.y, jumps_[node][0]);
  if (down_[node].empty() || up_[down_[node][0]].size() > 1) return;
  int32_t top = INT32_MAX, left = from.x, right = from.x;
  for (const uint32_t to : down_[node]) {
    const Point p = plan_.nodes[to].origin;
    top = std::min(top, p.y);
    left = std::min(left, p.x);
    right = std::max(right, p.x);
  }
  const bool doubled = down_[node].size() > 1 && !plan_.nodes[node].step;
  const int32_t bar = top - kStretch - (doubled ? kDouble : 0), more = doubled ? 10 : 0;
  if (left == right) return addLine(from, plan_.nodes[down_[node][0]].origin);
  addLine(from, {from.x, bar});
  addLine({left - more, bar}, {right + more, bar}, doubled);
  for (const uint32_t to : down_[node]) {
    const Point p = plan_.nodes[to].origin;
    addLine({p.x, bar + (doubled ? kDouble : 0)}, p);
  }
}

// A convergence of several lines above a node.
void Placer::drawMeeting(uint32_t node) {
  if (up_[node].size() < 2) return;
  ++group_;
  const Point to = plan_.nodes[node].origin;
  int32_t bottom = INT32_MIN, left = to.x, right = to.x;
  for (const uint32_t k : up_[node]) {
    const Point p = below(k);
    bottom = std::max(bottom, p.y);
    left = std::min(left, p.x);
    right = std::max(right, p.x);
  }
  const bool doubled = !plan_.nodes[node].step;
  const int32_t bar = std::max(bottom + kStretch, to.y - kStretch - (doubled ? kDouble : 0)), more = doubled ? 10 : 0;
  for (const uint32_t k : up_[node]) {
    const Point p = below(k);
    addLine(p, {p.x, bar});
  }
  addLine({left - more, bar}, {right + more, bar}, doubled);
  addLine({to.x, bar + (doubled ? kDouble : 0)}, to);
}

bool Placer::isReadable() const {
  const auto box = [](const ChartLine& line) {
    const int32_t x = std::min(line.from.x, line.to.x), y = std::min(line.from.y, line.to.y);
    return Rect{x, y, std::abs(line.to.x - line.from.x),
                std::abs(line.to.y - line.from.y) + (line.doubled ? kDouble : 0)};
  };
  // A line may touch a node at its ends; it leaves a step beside the actions, which may be taller than the step.
  const auto cuts = [](const Rect& line, const Rect& node) {
    return line.right() > node.x && line.x < node.right() && line.bottom() > node.y && line.y < node.bottom();
  };
  std::vector<Rect> nodes;
  for (const ChartNode& n : plan_.nodes) {
    const int32_t half = -n.area.x;
    nodes.push_back({n.origin.x - half, n.origin.y, 2 * half, n.below});
    nodes.push_back({n.origin.x + half, n.origin.y, n.area.width - 2 * half, n.area.height});
  }
  for (const ChartJump& jump : plan_.jumps) {
    const int32_t width = textWidth(names_.string(jump.step)) + 4;
    nodes.push_back({jump.at.x - width / 2, jump.at.y + 1, width, kJumpHeight - 4});
  }
  for (size_t k = 0; k < nodes.size(); ++k) {
    for (size_t i = 0; i < k; ++i)
      if (nodes[k].overlaps(nodes[i])) return false;
    for (const Line& line : lines_)
      if (cuts(box(line.line), nodes[k])) return false;
  }
  // Lines of different branchings may cross, but not touch otherwise.
  for (size_t k = 0; k < lines_.size(); ++k)
    for (size_t i = 0; i < k; ++i) {
      if (lines_[k].group == lines_[i].group) continue;
      const Rect a = box(lines_[k].line), b = box(lines_[i].line);
      if (a.x > b.right() || b.x > a.right() || a.y > b.bottom() || b.y > a.bottom()) continue;
      const bool cross = (a.width == 0) != (b.width == 0);
      const Rect& across = a.width == 0 ? b : a;
      const Rect& upright = a.width == 0 ? a : b;
      if (!cross || upright.x <= across.x || upright.x >= across.right() || upright.y >= across.y ||
          upright.bottom() <= across.bottom())
        return false;
    }
  return true;
}

bool Placer::run() {
  if (!readPositions() || !sortEdges()) return false;
  spreadNodes();
  for (uint32_t k = 0; k < plan_.nodes.size(); ++k) {
    drawLines(k);
    drawMeeting(k);
  }
  if (!isReadable()) {
    plan_.jumps.clear();
    return false;
  }
  plan_.bounds = plan_.nodes[0].area.at(plan_.nodes[0].origin);
  for (const ChartNode& n : plan_.nodes) plan_.bounds.include(n.area.at(n.origin));
  for (const Line& line : lines_) {
    plan_.lines.push_back(line.line);
    plan_.bounds.include({line.line.from.x, line.line.from.y, 0, 0});
    plan_.bounds.include({line.line.to.x, line.line.to.y + kDouble, 0, 0});
  }
  for (const ChartJump& jump : plan_.jumps) {
    const int32_t width = textWidth(names_.string(jump.step)) + 10;
    plan_.bounds.include({jump.at.x - width / 2, jump.at.y, width, kJumpHeight});
  }
  return true;
}

}  // namespace

bool takeChartPositions(const Tree& tree, const Names& names, const PouDecl& pou, ChartPlan& plan) {
  return Placer(tree, names, pou, plan).run();
}

}  // namespace rung::picture

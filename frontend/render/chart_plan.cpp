// SPDX-License-Identifier: Apache-2.0
// The layout of charts, from top to bottom. Nodes (steps and transitions) that can be reached only through a node are
// laid out below it: its branches side by side, then the nodes where they meet again (those that it dominates), each
// below the ends that are connected to it. An end that cannot reach its step by a straight line becomes a jump, and so
// do all links back. So every chart has a picture, and a chart of nested branches looks as in the standard. IEC 61131-3
// ed. 3, 6.7.4; TM/TP manual 5.5.
#include "frontend/render/chart_plan.h"

#include <algorithm>
#include <unordered_map>

#include "frontend/syntax/sfc.h"

namespace rung::picture {
namespace {

struct Open {  // a line to a node further down
  Point at;
  uint32_t target;
};
// The layout of a node and all nodes below it; coordinates are relative to the point where its line comes in.
struct Block {
  std::vector<std::pair<uint32_t, Point>> inner;
  std::vector<ChartLine> lines;
  std::vector<ChartJump> jumps;
  std::vector<Open> open;
  int32_t left = 0, right = 0, bottom = 0;
};

class ChartArranger {
 public:
  ChartArranger(const Tree& tree, const Names& names, const PouDecl& pou, ChartPlan& plan)
      : tree_(tree), names_(names), pou_(pou), plan_(plan) {}
  void run();

 private:
  using Edge = ChartEdge;
  void findOrder();
  void findDominators();
  uint32_t common(uint32_t a, uint32_t b) const;
  bool isBranch(uint32_t node, const Edge& edge) const {
    return edge.to != kNoNode && !edge.back && above_[edge.to] == node && in_[edge.to].size() == 1;
  }
  NameId nameOf(const Edge& edge) const;
  NameId jumpName(uint32_t target) const;
  int32_t jumpWidth(NameId name) const { return textWidth(names_.string(name)) + 10; }
  void arrange(uint32_t node);
  void addBranches(uint32_t node, Block& block, bool side_by_side_only);
  void addMeeting(uint32_t node, Block& block);
  void makeJump(Block& block, size_t open);
  void join(Block& block, uint32_t child, Point at);
  void placeAll();

  const Tree& tree_;
  const Names& names_;
  const PouDecl& pou_;
  ChartPlan& plan_;
  uint32_t root_ = 0;  // an artificial node above all nodes without predecessor
  std::vector<std::vector<Edge>> out_;
  std::vector<std::vector<uint32_t>> in_;  // without links back
  std::vector<uint32_t> order_, rank_;     // each before those below it
  std::vector<uint32_t> above_;            // the nearest node through which all paths lead
  std::vector<std::vector<uint32_t>> below_;
  std::vector<Block> blocks_;
};

// A depth-first walk from the initial steps; an edge to a node that is still open is a link back.
void ChartArranger::findOrder() {
  enum class State : uint8_t { New, Open, Done };
  std::vector<State> state(root_ + 1, State::New);
  struct Frame {
    uint32_t node, next;
  };
  const auto walk = [&](uint32_t from) {
    if (state[from] != State::New) return;
    out_[root_].push_back({from, {}});
    state[from] = State::Open;
    std::vector<Frame> stack{{from, 0}};
    while (!stack.empty()) {
      const uint32_t node = stack.back().node;
      if (stack.back().next == out_[node].size()) {
        state[node] = State::Done;
        order_.push_back(node);
        stack.pop_back();
        continue;
      }
      Edge& edge = out_[node][stack.back().next++];
      if (edge.to == kNoNode) continue;
      edge.back = state[edge.to] == State::Open;
      if (state[edge.to] != State::New) continue;
      state[edge.to] = State::Open;
      stack.push_back({edge.to, 0});
    }
  };
  for (const bool initial : {true, false})
    for (uint32_t k = 0; k < root_; ++k)
      if (plan_.nodes[k].step && tree_.list(pou_.steps)[plan_.nodes[k].index].initial == initial) walk(k);
  for (uint32_t k = 0; k < root_; ++k) walk(k);
  order_.push_back(root_);
  std::reverse(order_.begin(), order_.end());
  rank_.resize(order_.size());
  for (uint32_t k = 0; k < order_.size(); ++k) rank_[order_[k]] = k;
  in_.resize(order_.size());
  for (const uint32_t node : order_) {
    for (const Edge& edge : out_[node])
      if (edge.to != kNoNode && !edge.back) in_[edge.to].push_back(node);
  }
  // A step reached from an earlier chain is not a start.
  std::erase_if(out_[root_], [&](const Edge& edge) {
    if (in_[edge.to].size() < 2) return false;
    std::erase(in_[edge.to], root_);
    return true;
  });
}

uint32_t ChartArranger::common(uint32_t a, uint32_t b) const {
  while (a != b) {
    if (rank_[a] > rank_[b])
      a = above_[a];
    else
      b = above_[b];
  }
  return a;
}

void ChartArranger::findDominators() {
  above_.assign(order_.size(), kNoNode);
  below_.resize(order_.size());
  for (const uint32_t node : order_) {
    if (node == root_) continue;
    uint32_t all = in_[node].empty() ? root_ : in_[node][0];
    for (const uint32_t from : in_[node]) all = common(all, from);
    above_[node] = all;
    below_[all].push_back(node);
  }
}

NameId ChartArranger::jumpName(uint32_t target) const {
  const ChartNode& node = plan_.nodes[target];
  if (node.step) return tree_.list(pou_.steps)[node.index].name.name;
  return tree_.list(pou_.transitions)[node.index].target.name;
}

NameId ChartArranger::nameOf(const Edge& edge) const { return edge.name ? edge.name : jumpName(edge.to); }

// Merges the layout below `child`, with its line coming in at `at`.
void ChartArranger::join(Block& block, uint32_t child, Point at) {
  Block& inner = blocks_[child];
  block.inner.push_back({child, at});
  for (const Open& open : inner.open) block.open.push_back({open.at + at, open.target});
  inner.open.clear();
  block.left = std::min(block.left, at.x + inner.left);
  block.right = std::max(block.right, at.x + inner.right);
  block.bottom = std::max(block.bottom, at.y + inner.bottom);
}

void ChartArranger::addBranches(uint32_t node, Block& block, bool side_by_side_only) {
  const std::vector<Edge>& edges = out_[node];
  if (edges.empty()) return;
  const bool several = edges.size() > 1;
  const bool doubled = several && node != root_ && !plan_.nodes[node].step;
  const int32_t begin = node == root_ ? 0 : plan_.nodes[node].below;
  const int32_t bar = side_by_side_only ? 0 : plan_.nodes[node].area.bottom() + kStretch;
  const int32_t top = side_by_side_only || !several ? bar : bar + (doubled ? kDouble : 0) + kStretch;
  std::vector<int32_t> at(edges.size());
  int32_t x = 0;
  for (size_t k = 0; k < edges.size(); ++k) {
    const bool branch = isBranch(node, edges[k]);
    const int32_t half = branch ? 0 : jumpWidth(nameOf(edges[k])) / 2;
    const int32_t left = branch ? -blocks_[edges[k].to].left : half, right = branch ? blocks_[edges[k].to].right : half;
    if (k > 0) x += left + kBranchGap;
    at[k] = x;
    x += right;
  }
  const int32_t middle = side_by_side_only ? 0 : (at.front() + at.back()) / 2;
  for (int32_t& column : at) column -= middle;
  if (!side_by_side_only) block.lines.push_back({{0, begin}, {0, bar}});
  if (several && !side_by_side_only) {
    const int32_t more = doubled ? 10 : 0;
    block.lines.push_back({{at.front() - more, bar}, {at.back() + more, bar}, doubled});
    block.left = std::min(block.left, at.front() - more);
    block.right = std::max(block.right, at.back() + more);
    for (const int32_t column : at) block.lines.push_back({{column, bar + (doubled ? kDouble : 0)}, {column, top}});
  }
  for (size_t k = 0; k < edges.size(); ++k) {
    const Point p{at[k], top};
    block.bottom = std::max(block.bottom, top);
    if (isBranch(node, edges[k])) {
      join(block, edges[k].to, p);
      continue;
    }
    const int32_t half = jumpWidth(nameOf(edges[k])) / 2;
    block.left = std::min(block.left, p.x - half);
    block.right = std::max(block.right, p.x + half);
    if (edges[k].back || edges[k].to == kNoNode) {
      block.jumps.push_back({p, nameOf(edges[k])});
      block.bottom = std::max(block.bottom, top + kJumpHeight);
    } else {
      block.open.push_back({p, edges[k].to});
    }
  }
}

// Its line ends below everything placed so far, so nothing is in its way.
void ChartArranger::makeJump(Block& block, size_t open) {
  const Open end = block.open[open];
  block.lines.push_back({end.at, {end.at.x, block.bottom}});
  block.jumps.push_back({{end.at.x, block.bottom}, jumpName(end.target)});
  block.open.erase(block.open.begin() + static_cast<std::ptrdiff_t>(open));
}

// Draws the convergence of branches in `node`.
void ChartArranger::addMeeting(uint32_t node, Block& block) {
  const Block& inner = blocks_[node];
  int32_t first = INT32_MAX, last = INT32_MIN;
  size_t count = 0;
  for (const Open& open : block.open) {
    if (open.target != node) continue;
    first = std::min(first, open.at.x);
    last = std::max(last, open.at.x);
    ++count;
  }
  if (count == 0) first = last = 0;
  const int32_t x = (first + last) / 2;
  const int32_t from = std::min(first, x + inner.left) - kBranchGap / 2,
                to = std::max(last, x + inner.right) + kBranchGap / 2;
  bool jumps = false;
  for (size_t k = 0; k < block.open.size();) {
    const Open& open = block.open[k];
    if (open.target != node && open.at.x > from && open.at.x < to) {
      makeJump(block, k);
      jumps = true;
    } else {
      ++k;
    }
  }
  if (jumps) block.bottom += kJumpHeight;
  const bool doubled = !plan_.nodes[node].step && count > 1;
  const int32_t bar = block.bottom + kStretch, more = doubled ? 10 : 0;
  for (size_t k = 0; k < block.open.size();) {
    if (block.open[k].target != node) {
      ++k;
      continue;
    }
    block.lines.push_back({block.open[k].at, {block.open[k].at.x, bar}});
    block.open.erase(block.open.begin() + static_cast<std::ptrdiff_t>(k));
  }
  int32_t top = bar;
  if (count > 1) {
    block.lines.push_back({{first - more, bar}, {last + more, bar}, doubled});
    block.left = std::min(block.left, first - more);
    block.right = std::max(block.right, last + more);
    top += (doubled ? kDouble : 0) + kStretch;
    block.lines.push_back({{x, bar + (doubled ? kDouble : 0)}, {x, top}});
  }
  join(block, node, {x, top});
}

void ChartArranger::arrange(uint32_t node) {
  Block& block = blocks_[node];
  if (node != root_) {
    const Rect& area = plan_.nodes[node].area;
    block.left = area.x;
    block.right = area.right();
    block.bottom = area.bottom();
  }
  addBranches(node, block, node == root_);
  std::vector<uint32_t> meetings;
  for (const uint32_t below : below_[node]) {
    const bool branch = std::any_of(out_[node].begin(), out_[node].end(),
                                    [&](const Edge& edge) { return edge.to == below && isBranch(node, edge); });
    if (!branch) meetings.push_back(below);
  }
  for (const uint32_t meeting : meetings) addMeeting(meeting, block);
}

void ChartArranger::placeAll() {
  std::vector<std::pair<uint32_t, Point>> stack{{root_, {}}};
  const auto shifted = [](Point p, Point by) { return p + by; };
  while (!stack.empty()) {
    const auto [node, at] = stack.back();
    stack.pop_back();
    if (node != root_) plan_.nodes[node].origin = at;
    for (ChartLine line : blocks_[node].lines) {
      line.from = shifted(line.from, at);
      line.to = shifted(line.to, at);
      if (line.from != line.to) plan_.lines.push_back(line);
    }
    for (const ChartJump& jump : blocks_[node].jumps) plan_.jumps.push_back({jump.at + at, jump.step});
    for (auto inner = blocks_[node].inner.rbegin(); inner != blocks_[node].inner.rend(); ++inner)
      stack.push_back({inner->first, inner->second + at});
  }
  const Block& all = blocks_[root_];
  plan_.bounds = {all.left, 0, all.right - all.left, all.bottom};
}

void ChartArranger::run() {
  root_ = static_cast<uint32_t>(plan_.nodes.size());
  out_ = edgesOf(tree_, names_, pou_, plan_);
  out_.emplace_back();
  findOrder();
  findDominators();
  blocks_.resize(order_.size());
  for (auto node = order_.rbegin(); node != order_.rend(); ++node) arrange(*node);
  placeAll();
}

}  // namespace

std::vector<std::vector<ChartEdge>> edgesOf(const Tree& tree, const Names& names, const PouDecl& pou,
                                            const ChartPlan& plan) {
  const auto steps = tree.list(pou.steps);
  const auto transitions = tree.list(pou.transitions);
  std::unordered_map<uint32_t, uint32_t> step_of;  // by the name's key
  for (uint32_t k = 0; k < steps.size(); ++k) step_of.emplace(names.key(steps[k].name.name).index, k);
  std::vector<std::vector<ChartEdge>> out(plan.nodes.size());
  for (uint32_t k = static_cast<uint32_t>(steps.size()); k < plan.nodes.size(); ++k) {
    const SfcTransition& t = transitions[plan.nodes[k].index];
    for (const Ident& from : tree.list(t.from))
      if (const auto found = step_of.find(names.key(from.name).index); found != step_of.end())
        out[found->second].push_back({k, {}});
    for (const Ident& to : tree.list(t.to)) {
      const auto found = step_of.find(names.key(to.name).index);
      out[k].push_back({found == step_of.end() ? kNoNode : found->second, to.name});
    }
  }
  for (uint32_t k = 0; k < steps.size(); ++k)  // by priority, from left to right
    std::stable_sort(out[k].begin(), out[k].end(), [&](const ChartEdge& a, const ChartEdge& b) {
      const auto weight = [&](const ChartEdge& e) {
        const SfcTransition& t = transitions[plan.nodes[e.to].index];
        return t.has_priority ? t.priority : UINT32_MAX;
      };
      return weight(a) < weight(b);
    });
  return out;
}

void planChart(const Tree& tree, const Names& names, const PouDecl& pou, ChartPlan& plan) {
  if (!takeChartPositions(tree, names, pou, plan)) ChartArranger(tree, names, pou, plan).run();
}

}  // namespace rung::picture

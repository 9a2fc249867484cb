// SPDX-License-Identifier: Apache-2.0
// Routes wires along the grid: each net is a tree of right-angled lines that grows pin by pin, by the cheapest path
// from the pin to the existing tree. Paths go around elements; corners, crossings and lanes beside other wires cost,
// and sharing the lane of another net costs so much that it happens only when there is no other path. Several sources
// of one pin are one net if each of them is connected to the same pins; otherwise their wires meet at the pin.
#include <algorithm>
#include <queue>

#include "frontend/render/network_plan.h"

namespace rung::picture {
namespace {

constexpr int32_t kMargin = 12;          // cells around the elements
constexpr size_t kMaxCells = 8'000'000;  // above this, wires are straight and ignore obstacles
constexpr uint32_t kCorner = 4, kCrossing = 6, kTouch = 60, kShared = 400, kThrough = 5000;
constexpr uint32_t kCarefulSteps = 3'000'000;
constexpr uint32_t kMaxSteps = 15'000'000;  // of all searches: above this, too
constexpr uint32_t kRight = 0, kDown = 1, kLeft = 2, kUp = 3;

// ---- nets

bool before(const End& a, const End& b) { return a.item != b.item ? a.item < b.item : a.terminal < b.terminal; }

// The links sorted by one of their ends, with lookup of the other.
class Sides {
 public:
  Sides(const std::vector<Link>& links, End Link::*near, End Link::*far) : links_(links), near_(near), far_(far) {
    for (uint32_t k = 0; k < links.size(); ++k) sorted_.push_back(k);
    std::stable_sort(sorted_.begin(), sorted_.end(),
                     [&](uint32_t a, uint32_t b) { return before(links[a].*near, links[b].*near); });
  }
  std::span<const uint32_t> linksOf(const End& end) const {
    const auto less = [&](uint32_t link, const End& e) { return before(links_[link].*near_, e); };
    const auto first = std::lower_bound(sorted_.begin(), sorted_.end(), end, less);
    auto last = first;
    while (last != sorted_.end() && links_[*last].*near_ == end) ++last;
    return {sorted_.data() + (first - sorted_.begin()), static_cast<size_t>(last - first)};
  }
  std::vector<End> endsOf(const End& end) const {
    std::vector<End> ends;
    for (const uint32_t link : linksOf(end)) ends.push_back(links_[link].*far_);
    std::sort(ends.begin(), ends.end(), before);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

 private:
  const std::vector<Link>& links_;
  End Link::*near_;
  End Link::*far_;
  std::vector<uint32_t> sorted_;
};

// ---- paths

struct Window {  // in pixels, both corners included
  int32_t x0 = INT32_MAX, y0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
  void include(Point p) { *this = {std::min(x0, p.x), std::min(y0, p.y), std::max(x1, p.x), std::max(y1, p.y)}; }
};
struct Way {
  uint32_t cost = UINT32_MAX;
  std::vector<Point> points;  // from the pin to the tree
};

class Router {
 public:
  explicit Router(Plan& plan) : plan_(plan) {}
  void run();

 private:
  struct Cell {
    uint32_t across = kNone, down = kNone;  // the nets on the edges from here to the right and downwards
    uint32_t corner = kNone;                // the net that turns, ends or branches here
    bool blocked = false;
  };
  struct Step {  // of a search: a cell with the direction of entry
    uint32_t stamp = 0, cost = 0;
    uint32_t from = 0;  // the direction in which the previous cell was entered; kNone: the first cell
  };

  bool setGrid();
  size_t indexOf(Point p) const {
    return static_cast<size_t>((p.y - top_) / kGrid) * columns_ + static_cast<size_t>((p.x - left_) / kGrid);
  }
  Point pointOf(size_t cell) const {
    return {left_ + static_cast<int32_t>(cell % columns_) * kGrid,
            top_ + static_cast<int32_t>(cell / columns_) * kGrid};
  }
  size_t next(size_t cell, uint32_t direction) const {
    return direction == kRight  ? cell + 1
           : direction == kLeft ? cell - 1
           : direction == kDown ? cell + columns_
                                : cell - columns_;
  }
  uint32_t& edge(size_t cell, uint32_t direction) {
    if (direction == kRight) return cells_[cell].across;
    if (direction == kDown) return cells_[cell].down;
    return direction == kLeft ? cells_[cell - 1].across : cells_[cell - columns_].down;
  }
  void keepPinsFree();
  const End* railOf(const Net& net) const;
  bool isConnected(const Net& net, const End& end) const;
  bool routeStraight(uint32_t net, const End& from, const End& to);
  void routeRows(uint32_t net);
  void lead(uint32_t net);
  void routeBlindly(uint32_t net);
  void grow(Point from, Point to, uint32_t net);
  Point outside(const End& end) const;
  uint32_t stepCost(uint32_t net, size_t cell, uint32_t entered, uint32_t direction, size_t start);
  Way search(uint32_t net, const End& end, Window window);
  void keep(uint32_t net, const std::vector<Point>& points);
  void setDots(uint32_t net);
  void setBounds();

  Plan& plan_;
  int32_t left_ = 0, top_ = 0;
  size_t columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
  std::vector<Step> steps_;     // four per cell
  std::vector<uint32_t> tree_;  // by cell: the stamp of the tree that contains it
  uint32_t stamp_ = 0, search_ = 0;
  uint32_t taken_ = 0;  // steps of all searches
  Window tree_box_;
};

// False: too large.
bool Router::setGrid() {
  Rect all = plan_.items[0].bounds();
  for (const Item& item : plan_.items) all.include(item.bounds());
  left_ = all.x - kMargin * kGrid;
  top_ = all.y - kMargin * kGrid;
  columns_ = static_cast<size_t>(all.width / kGrid) + 2 * kMargin + 1;
  rows_ = static_cast<size_t>(all.height / kGrid) + 2 * kMargin + 1;
  if (columns_ * rows_ > kMaxCells) return false;
  cells_.resize(columns_ * rows_);
  steps_.resize(4 * cells_.size());
  tree_.resize(cells_.size());
  for (const Item& item : plan_.items) {
    const Rect r = item.bounds();
    for (int32_t y = r.y; y <= r.bottom(); y += kGrid)
      for (int32_t x = r.x; x <= r.right(); x += kGrid) cells_[indexOf({x, y})].blocked = true;
  }
  return true;
}

const End* Router::railOf(const Net& net) const {
  for (const std::vector<End>* ends : {&net.sources, &net.targets})
    for (const End& end : *ends)
      if (plan_.terminal(end).length > 0) return &end;
  return nullptr;
}

// No wire turns or runs where the wire of a pin begins.
void Router::keepPinsFree() {
  for (uint32_t k = 0; k < plan_.nets.size(); ++k)
    for (const std::vector<End>* ends : {&plan_.nets[k].sources, &plan_.nets[k].targets})
      for (const End& end : *ends)
        if (plan_.terminal(end).length == 0) cells_[indexOf(outside(end))].corner = k;
}

// The first cell of a wire outside of its element.
Point Router::outside(const End& end) const {
  const Point p = plan_.point(end);
  return {p.x + (plan_.terminal(end).output ? kGrid : -kGrid), p.y};
}

// Adds a line to the tree; its edges belong to the net, unless `net` is kNone.
void Router::grow(Point from, Point to, uint32_t net) {
  const uint32_t direction = from.y == to.y ? (to.x > from.x ? kRight : kLeft) : (to.y > from.y ? kDown : kUp);
  const size_t last = indexOf(to);
  for (size_t cell = indexOf(from);; cell = next(cell, direction)) {
    tree_[cell] = stamp_;
    if (cell == last) break;
    if (net != kNone) edge(cell, direction) = net;
  }
  tree_box_.include(from);
  tree_box_.include(to);
  if (net != kNone) cells_[indexOf(from)].corner = cells_[last].corner = net;
}

// Adds `points`, without those between collinear lines, as a line of the net.
void Router::keep(uint32_t net, const std::vector<Point>& points) {
  std::vector<Point> line;
  for (const Point p : points) {
    if (!line.empty() && line.back() == p) continue;
    while (line.size() > 1) {
      const Point a = line[line.size() - 2], b = line.back();
      if (!(a.x == b.x && b.x == p.x) && !(a.y == b.y && b.y == p.y)) break;
      line.pop_back();
    }
    line.push_back(p);
  }
  if (!cells_.empty())
    for (size_t k = 1; k < line.size(); ++k) grow(line[k - 1], line[k], net);
  plan_.nets[net].lines.push_back(std::move(line));
}

// Both pins are in one row without obstacles between. Other nets with the same pin join in front of it.
bool Router::routeStraight(uint32_t net, const End& from, const End& to) {
  Point a = plan_.point(from), b = plan_.point(to);
  if (const int32_t rail = plan_.terminal(from).length; rail > 0 && b.y > a.y && b.y < a.y + rail) a.y = b.y;
  if (const int32_t rail = plan_.terminal(to).length; rail > 0 && a.y > b.y && a.y < b.y + rail) b.y = a.y;
  if (a.y != b.y || a.x >= b.x) return false;
  for (Point p = a; p.x < b.x; p.x += kGrid) {
    const Cell& cell = cells_[indexOf(p)];
    const bool meets = p.x + kGrid >= b.x;
    if (p.x > a.x && cell.blocked) return false;
    if (!meets && p.x > a.x && cell.corner != kNone && cell.corner != net) return false;
    if (!meets && cell.across != kNone && cell.across != net) return false;
  }
  keep(net, {b, a});
  return true;
}

// Straight wires are routed first: all others go around them.
void Router::routeRows(uint32_t index) {
  const Net& net = plan_.nets[index];
  const bool rail = railOf(net) != nullptr;
  for (const End& from : net.sources)
    for (const End& to : net.targets)
      if (routeStraight(index, from, to) && !rail) return;
}

bool Router::isConnected(const Net& net, const End& end) const {
  const Point p = plan_.point(end);
  return std::any_of(net.lines.begin(), net.lines.end(),
                     [&](const std::vector<Point>& line) { return line.front() == p || line.back() == p; });
}

uint32_t Router::stepCost(uint32_t net, size_t cell, uint32_t entered, uint32_t direction, size_t start) {
  uint32_t cost = 1;
  const size_t to = next(cell, direction);
  const auto foreign = [&](uint32_t other) { return other != kNone && other != net; };
  if (foreign(edge(cell, direction))) cost += kShared;
  if (cells_[to].blocked && tree_[to] != stamp_) cost += kThrough;
  if (foreign(cells_[to].corner)) cost += kTouch;
  const bool vertical = direction == kDown || direction == kUp;
  if (foreign(vertical ? cells_[to - 1].across : cells_[to - columns_].down) ||
      foreign(vertical ? cells_[to].across : cells_[to].down))
    cost += kCrossing;
  if (entered == direction) return cost;
  cost += kCorner;
  const Cell& corner = cells_[cell];
  const bool touches = foreign(corner.across) || foreign(corner.down) || foreign(cells_[cell - 1].across) ||
                       foreign(cells_[cell - columns_].down);
  return touches && cell != start ? cost + kTouch : cost;
}

// From a pin to the tree, inside the window: A* with the distance to the bounding box of the tree. In a large picture
// the distance is weighted 1.5 times: nearly the cheapest path, found in a fraction of the steps.
Way Router::search(uint32_t net, const End& end, Window window) {
  struct Entry {
    uint32_t estimate, cost;
    size_t state;
    bool operator>(const Entry& o) const {
      return estimate != o.estimate ? estimate > o.estimate : cost != o.cost ? cost < o.cost : state > o.state;
    }
  };
  window.x0 = std::max(window.x0, left_ + kGrid);
  window.y0 = std::max(window.y0, top_ + kGrid);
  window.x1 = std::min(window.x1, left_ + static_cast<int32_t>(columns_ - 2) * kGrid);
  window.y1 = std::min(window.y1, top_ + static_cast<int32_t>(rows_ - 2) * kGrid);
  const int32_t weight = taken_ < kCarefulSteps ? 2 : 3;
  const auto distance = [&](size_t cell) {
    const Point p = pointOf(cell);
    const int32_t dx = std::max({tree_box_.x0 - p.x, p.x - tree_box_.x1, 0});
    const int32_t dy = std::max({tree_box_.y0 - p.y, p.y - tree_box_.y1, 0});
    return static_cast<uint32_t>((dx + dy) / kGrid * weight / 2);
  };
  ++search_;
  const size_t start = indexOf(outside(end));
  const size_t first = 4 * start + (plan_.terminal(end).output ? kRight : kLeft);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  steps_[first] = {search_, 0, kNone};
  open.push({distance(start), 0, first});
  while (!open.empty()) {
    const Entry entry = open.top();
    open.pop();
    if (steps_[entry.state].cost != entry.cost) continue;
    if (++taken_ > kMaxSteps) return {};
    const size_t cell = entry.state / 4;
    const auto entered = static_cast<uint32_t>(entry.state % 4);
    if (tree_[cell] == stamp_) {
      Way way{entry.cost, {pointOf(cell)}};
      for (size_t state = entry.state; steps_[state].from != kNone;) {
        const size_t back = next(state / 4, (state % 4 + 2) % 4);
        way.points.push_back(pointOf(back));
        state = 4 * back + steps_[state].from;
      }
      way.points.push_back(plan_.point(end));
      std::reverse(way.points.begin(), way.points.end());
      return way;
    }
    for (uint32_t direction = 0; direction < 4; ++direction) {
      if (direction == (entered + 2) % 4) continue;
      const size_t to = next(cell, direction);
      const Point p = pointOf(to);
      if (p.x < window.x0 || p.x > window.x1 || p.y < window.y0 || p.y > window.y1) continue;
      const uint32_t cost = entry.cost + stepCost(net, cell, entered, direction, start);
      Step& step = steps_[4 * to + direction];
      if (step.stamp == search_ && step.cost <= cost) continue;
      step = {search_, cost, entered};
      open.push({cost + distance(to), cost, 4 * to + direction});
    }
  }
  return {};
}

// Grows from the rail, from straight lines, or from the first source.
void Router::lead(uint32_t index) {
  Net& net = plan_.nets[index];
  ++stamp_;
  tree_box_ = {};
  const End* rail = railOf(net);
  if (rail != nullptr) {
    const Point top = plan_.point(*rail);
    grow(top, {top.x, top.y + plan_.terminal(*rail).length}, kNone);
  }
  for (const std::vector<Point>& line : net.lines)
    for (size_t k = 1; k < line.size(); ++k) grow(line[k - 1], line[k], index);
  if (rail == nullptr && net.lines.empty()) keep(index, {plan_.point(net.sources[0]), outside(net.sources[0])});
  std::vector<End> open;
  for (const std::vector<End>* ends : {&net.sources, &net.targets})
    for (const End& end : *ends)
      if ((rail == nullptr || end != *rail) && !isConnected(net, end)) open.push_back(end);
  const Point origin = plan_.point(rail != nullptr ? *rail : net.sources[0]);
  const auto distance = [&](const End& end) {
    const Point p = plan_.point(end);
    return std::abs(p.x - origin.x) + std::abs(p.y - origin.y);
  };
  std::stable_sort(open.begin(), open.end(), [&](const End& a, const End& b) { return distance(a) < distance(b); });
  for (const End& end : open) {
    Window window = tree_box_;
    window.include(outside(end));
    constexpr int32_t kAround = 12 * kGrid;
    Way way = search(index, end, {window.x0 - kAround, window.y0 - kAround, window.x1 + kAround, window.y1 + kAround});
    if (way.cost >= kThrough)
      if (Way wider = search(index, end, {INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX}); wider.cost < way.cost)
        way = std::move(wider);
    if (way.points.empty()) {
      const Point from = plan_.point(end), out = outside(end), to = net.lines.empty() ? origin : net.lines[0].back();
      way.points = {from, out, {out.x, to.y}, to};
    }
    keep(index, way.points);
  }
}

// Ignores obstacles.
void Router::routeBlindly(uint32_t index) {
  const Net net = plan_.nets[index];
  for (const End& from : net.sources) {
    for (const End& to : net.targets) {
      Point a = plan_.point(from), b = plan_.point(to);
      if (plan_.terminal(from).length > 0) a.y = b.y;
      if (plan_.terminal(to).length > 0) b.y = a.y;
      const int32_t x = b.x - kGrid, back = std::max(a.y, b.y) + 2 * kGrid;
      if (a.x < x)
        keep(index, {a, {x, a.y}, {x, b.y}, b});
      else
        keep(index, {a, {a.x + kGrid, a.y}, {a.x + kGrid, back}, {x, back}, {x, b.y}, b});
    }
  }
}

// Junctions of a net's lines, and of nets in front of a pin.
void Router::setDots(uint32_t index) {
  Net& net = plan_.nets[index];
  for (const std::vector<Point>& line : net.lines) {
    const size_t cell = indexOf(line.back());
    const int degree = (cells_[cell].across == index) + (cells_[cell].down == index) +
                       (cells_[cell - 1].across == index) + (cells_[cell - columns_].down == index);
    if (degree > 2) net.dots.push_back(line.back());
  }
}

void Router::setBounds() {
  if (plan_.items.empty()) return;
  plan_.bounds = plan_.items[0].bounds();
  for (const Item& item : plan_.items) plan_.bounds.include(item.bounds());
  for (const Net& net : plan_.nets)
    for (const std::vector<Point>& line : net.lines)
      for (const Point p : line) plan_.bounds.include({p.x, p.y, 0, 0});
}

void Router::run() {
  const auto nets = static_cast<uint32_t>(plan_.nets.size());
  if (nets > 0 && setGrid()) {
    ++stamp_;
    keepPinsFree();
    for (uint32_t k = 0; k < nets; ++k) routeRows(k);
    for (uint32_t k = 0; k < nets; ++k) lead(k);
    for (uint32_t k = 0; k < nets; ++k) setDots(k);
  } else {
    for (uint32_t k = 0; k < nets; ++k) routeBlindly(k);
  }
  std::vector<End> ends;
  for (const Net& net : plan_.nets) ends.insert(ends.end(), net.targets.begin(), net.targets.end());
  std::sort(ends.begin(), ends.end(), before);
  for (Net& net : plan_.nets)
    for (const End& end : net.targets)
      if (std::upper_bound(ends.begin(), ends.end(), end, before) -
                  std::lower_bound(ends.begin(), ends.end(), end, before) >
              1 &&
          plan_.terminal(end).length == 0)
        net.dots.push_back(outside(end));
  setBounds();
}

}  // namespace

void makeNets(Plan& plan) {
  const Sides froms(plan.links, &Link::from, &Link::to), tos(plan.links, &Link::to, &Link::from);
  const auto isRail = [&](const End& end) { return plan.terminal(end).length > 0; };
  std::vector<bool> done(plan.links.size());
  for (uint32_t k = 0; k < plan.links.size(); ++k) {
    if (done[k]) continue;
    Net net{{plan.links[k].from}, froms.endsOf(plan.links[k].from), {}, {}};
    const std::vector<End> together = tos.endsOf(net.targets[0]);
    bool one = together.size() > 1 && !isRail(net.targets[0]);
    for (const End& to : net.targets) one = one && tos.endsOf(to) == together;
    for (const End& from : together) one = one && !isRail(from) && froms.endsOf(from) == net.targets;
    if (one) net.sources = together;
    for (const End& from : net.sources)
      for (const uint32_t link : froms.linksOf(from)) done[link] = true;
    plan.nets.push_back(std::move(net));
  }
}

void routeWires(Plan& plan) {
  makeNets(plan);
  Router(plan).run();
}

}  // namespace rung::picture

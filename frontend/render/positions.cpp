// SPDX-License-Identifier: Apache-2.0
// The positions of elements in the file. Their unit depends on the editor: pixels, or cells as high as a pin. Names and
// boxes may be larger here than there, so rows and columns are spread where elements would overlap; elements in one row
// or column stay in it, and the order from left to right and from top to bottom is kept.
#include <algorithm>

#include "frontend/render/network_plan.h"
#include "frontend/render/spread.h"
#include "frontend/syntax/diagram.h"

namespace rung::picture {
namespace {

constexpr size_t kMostPlacedElements = 20'000;  // compared pairwise
constexpr int32_t kCell = 20;                   // pixels per cell of an editor

bool isFrame(ElementKind kind) { return isBox(kind) || kind == ElementKind::Comment; }

// Editors that count cells leave one or two between elements, those that count pixels many more.
int32_t unitOf(const Body& body, const Plan& plan) {
  int32_t highest = 0;
  std::vector<int32_t> rows;
  for (const Item& item : plan.items) {
    const DiagramElement& e = body.elements[item.element];
    if (isRail(e.kind)) continue;
    highest = std::max(highest, e.height);
    rows.push_back(e.y);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  int32_t least = INT32_MAX;
  for (size_t k = 1; k < rows.size(); ++k) least = std::min(least, rows[k] - rows[k - 1]);
  return highest <= 12 && rows.size() > 1 && least <= 4 ? kCell : 1;
}

// Pins are closer together or further apart here than in the file, so the wire of a variable beside its pin would get a
// corner: the variable moves to the row of the pin, if that is near and free.
void snapToPins(const Body& body, Plan& plan) {
  constexpr int32_t kNear = 30;
  std::vector<uint32_t> uses(plan.items.size());
  for (const Link& link : plan.links) {
    ++uses[link.from.item];
    ++uses[link.to.item];
  }
  const auto moves = [&](uint32_t item) {
    const ElementKind kind = body.elements[plan.items[item].element].kind;
    return uses[item] == 1 && (kind == ElementKind::Input || kind == ElementKind::Output ||
                               kind == ElementKind::Connector || kind == ElementKind::Continuation);
  };
  std::vector<const Link*> near;
  for (const Link& link : plan.links)
    if (moves(link.from.item) != moves(link.to.item)) near.push_back(&link);
  if (near.size() * plan.items.size() > 20'000'000) return;
  const auto pinRow = [&](const Link* link) { return plan.point(moves(link->from.item) ? link->to : link->from).y; };
  std::stable_sort(near.begin(), near.end(), [&](const Link* a, const Link* b) { return pinRow(a) < pinRow(b); });
  for (const bool upwards : {true, false})  // moving up makes room from the top on, moving down from the bottom
    for (size_t k = 0; k < near.size(); ++k) {
      const Link& link = *near[upwards ? k : near.size() - 1 - k];
      const bool reads = moves(link.from.item);
      Item& item = plan.items[reads ? link.from.item : link.to.item];
      const int32_t by = plan.point(reads ? link.to : link.from).y - plan.point(reads ? link.from : link.to).y;
      if (by == 0 || (by < 0) != upwards || std::abs(by) > kNear) continue;
      Rect bounds = item.bounds();
      bounds.y += by;
      const bool free = std::none_of(plan.items.begin(), plan.items.end(), [&](const Item& other) {
        return &other != &item &&
               other.bounds().overlaps({bounds.x - kGrid, bounds.y, bounds.width + 2 * kGrid, bounds.height});
      });
      if (free) item.origin.y += by;
    }
}

// The wanted positions of all items on both axes, and roughly where they will be.
struct Wanted {
  Axis x, y;
  std::vector<Rect> guess;
};

int64_t onGrid(int64_t n) { return (n >= 0 ? n + kGrid / 2 : n - kGrid / 2) / kGrid * kGrid; }

Wanted wantedPositions(const Body& body, Plan& plan) {
  constexpr int64_t kLimit = 1 << 29;
  const int32_t unit = unitOf(body, plan);
  Wanted wanted;
  for (Item& item : plan.items) {
    const DiagramElement& e = body.elements[item.element];
    if (isRail(e.kind)) item.area.width = 0;
    // Elements on one line stay aligned by their middle; boxes are positioned by their upper edge.
    const int64_t middle = isFrame(e.kind) || isRail(e.kind) ? 0 : unit == kCell ? kGrid : e.height / 2;
    const int64_t centre =
        e.kind == ElementKind::Contact || e.kind == ElementKind::Coil ? int64_t{e.width} * unit / 2 : 0;
    wanted.x.wanted.push_back(onGrid(int64_t{e.x} * unit + centre));
    wanted.y.wanted.push_back(onGrid(int64_t{e.y} * unit + middle));
    wanted.x.before.push_back(-item.area.x);
    wanted.x.after.push_back(item.area.right());
    wanted.y.before.push_back(-item.area.y);
    wanted.y.after.push_back(item.area.bottom());
    const int64_t x = std::clamp(wanted.x.wanted.back(), -kLimit, kLimit);
    wanted.guess.push_back(item.area.at({static_cast<int32_t>(x), 0}));
  }
  return wanted;
}

bool isRailItem(const Body& body, const Plan& plan, uint32_t k) {
  return isRail(body.elements[plan.items[k].element].kind);
}

// First the rows, then the columns of what overlaps in its rows.
void placeItems(const Body& body, Plan& plan) {
  const Wanted wanted = wantedPositions(body, plan);
  const std::vector<Rect>& guess = wanted.guess;
  const Axis& y = wanted.y;
  const auto rail = [&](uint32_t k) { return isRailItem(body, plan, k); };
  // Variables may be as close to each other as the pins to which they are connected.
  const auto gapY = [&](uint32_t a, uint32_t b) {
    if (rail(a) || rail(b) || guess[a].x >= guess[b].right() + kElementGap ||
        guess[b].x >= guess[a].right() + kElementGap)
      return -1;
    return plan.items[a].area.height <= kElementGap && plan.items[b].area.height <= kElementGap ? 0 : kElementGap;
  };
  const std::vector<int32_t> ys = spread(y, gapY);
  const auto gapX = [&](uint32_t a, uint32_t b) {
    const int32_t above = std::max(ys[a] - y.before[a], ys[b] - y.before[b]);
    const int32_t below = std::min(ys[a] + y.after[a], ys[b] + y.after[b]);
    return rail(a) || rail(b) || above < below ? kElementGap : -1;
  };
  const std::vector<int32_t> xs = spread(wanted.x, gapX);
  for (uint32_t k = 0; k < plan.items.size(); ++k) plan.items[k].origin = {xs[k], ys[k]};
}

// A rail is as long as the rows of its links need.
void stretchRails(const Body& body, Plan& plan) {
  for (uint32_t k = 0; k < plan.items.size(); ++k) {
    if (!isRailItem(body, plan, k)) continue;
    Item& item = plan.items[k];
    const DiagramElement& e = body.elements[item.element];
    int32_t top = item.origin.y, bottom = top + std::clamp(e.height, 40, 100'000);
    for (const Link& link : plan.links) {
      if (link.from.item != k && link.to.item != k) continue;
      const int32_t row = plan.point(link.from.item == k ? link.to : link.from).y;
      top = std::min(top, row - kGrid);
      bottom = std::max(bottom, row + kGrid);
    }
    item.origin.y = top;
    item.terminals[0].length = (bottom - top + kGrid - 1) / kGrid * kGrid;
    item.area = {0, 0, 0, item.terminals[0].length};
  }
}

bool hasOverlaps(const Plan& plan) {
  const size_t count = plan.items.size();
  std::vector<uint32_t> order(count);
  for (uint32_t k = 0; k < count; ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return plan.items[a].bounds().y < plan.items[b].bounds().y; });
  for (size_t k = 0; k < count; ++k) {
    const Rect mine = plan.items[order[k]].bounds();
    for (size_t other = k + 1; other < count; ++other) {
      const Rect theirs = plan.items[order[other]].bounds();
      if (theirs.y >= mine.bottom()) break;
      if (mine.overlaps(theirs)) return true;
    }
  }
  return false;
}

}  // namespace

bool takeFilePositions(const Body& body, Plan& plan) {
  if (plan.items.size() > kMostPlacedElements) return false;
  for (const Item& item : plan.items) {
    const DiagramElement& e = body.elements[item.element];
    if (!e.placed && e.kind != ElementKind::Comment) return false;
  }
  placeItems(body, plan);
  stretchRails(body, plan);
  snapToPins(body, plan);
  return !hasOverlaps(plan);
}

}  // namespace rung::picture

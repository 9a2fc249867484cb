// SPDX-License-Identifier: Apache-2.0
// Long networks on a page. A network wider than the page is cut between its elements into bands, which are drawn below
// each other; a cut wire ends in a flag with a number and continues at the flag with the same number. In: elements with
// their positions. Out: a plan for each band, in separate coordinates. Each band has the rails that it needs.
#include <algorithm>
#include <numeric>

#include "frontend/render/network_plan.h"
#include "frontend/syntax/diagram.h"

namespace rung::picture {
namespace {

bool isRailItem(const Item& item) { return !item.terminals.empty() && item.terminals[0].length > 0; }

Item makeContinuation(uint32_t number, bool begins) {
  const int32_t width = roundUp(textWidth(std::to_string(number)) + 16);
  Item item{kNone, {0, -kGrid, width, 2 * kGrid}, {0, -kGrid, width, 2 * kGrid}, {}, {}, number};
  item.terminals.push_back({{begins ? width : 0, 0}, begins, kNone, {}});
  return item;
}

class Splitter {
 public:
  Splitter(const Plan& plan, std::span<const uint32_t> parts, uint32_t count, uint32_t& continuations)
      : plan_(plan),
        parts_(parts),
        plans_(count),
        rails_(count),
        item_of_(plan.items.size(), kNone),
        continuations_(continuations) {
    for (uint32_t k = 0; k < plan.items.size(); ++k) {
      if (isRailItem(plan.items[k])) continue;
      item_of_[k] = add(parts[k], plan.items[k]);
    }
  }
  std::vector<Plan> run();

 private:
  uint32_t add(uint32_t part, Item item) {
    plans_[part].items.push_back(std::move(item));
    return static_cast<uint32_t>(plans_[part].items.size() - 1);
  }
  End inside(const End& end) const { return {item_of_[end.item], end.terminal}; }
  End railIn(uint32_t part, const End& rail);
  void addNet(const Net& net);

  struct Rail {
    uint32_t from, item;
  };
  const Plan& plan_;
  std::span<const uint32_t> parts_;
  std::vector<Plan> plans_;
  std::vector<std::vector<Rail>> rails_;  // by part: its rails so far
  std::vector<uint32_t> item_of_;         // in its part
  uint32_t& continuations_;
};

End Splitter::railIn(uint32_t part, const End& rail) {
  for (const Rail& known : rails_[part])
    if (known.from == rail.item) return {known.item, rail.terminal};
  rails_[part].push_back({rail.item, add(part, plan_.items[rail.item])});
  return {rails_[part].back().item, rail.terminal};
}

// Connects each source with each target.
void Splitter::addNet(const Net& net) {
  const auto rail = [&](const End& end) { return isRailItem(plan_.items[end.item]); };
  for (const End& from : net.sources)
    for (const End& to : net.targets) {
      if (rail(from) && rail(to)) continue;
      const uint32_t a = rail(from) ? parts_[to.item] : parts_[from.item], b = rail(to) ? a : parts_[to.item];
      if (a != b) continue;
      plans_[a].links.push_back({rail(from) ? railIn(a, from) : inside(from), rail(to) ? railIn(a, to) : inside(to)});
    }
  uint32_t number = 0;
  for (const bool begins : {false, true}) {
    const std::vector<End>& near = begins ? net.targets : net.sources;
    const std::vector<End>& far = begins ? net.sources : net.targets;
    std::vector<std::pair<uint32_t, uint32_t>> created;  // part, its continuation
    for (const End& end : near) {
      const uint32_t part = parts_[end.item];
      if (rail(end) || std::all_of(far.begin(), far.end(),
                                   [&](const End& other) { return rail(other) || parts_[other.item] == part; }))
        continue;
      auto continuation =
          std::find_if(created.begin(), created.end(), [&](const auto& known) { return known.first == part; });
      if (continuation == created.end()) {
        if (number == 0) number = ++continuations_;
        created.emplace_back(part, add(part, makeContinuation(number, begins)));
        continuation = created.end() - 1;
      }
      const End at{continuation->second, 0};
      plans_[part].links.push_back(begins ? Link{at, inside(end)} : Link{inside(end), at});
    }
  }
}

std::vector<Plan> Splitter::run() {
  Plan whole = plan_;
  makeNets(whole);
  // Numbered from top to bottom.
  std::stable_sort(whole.nets.begin(), whole.nets.end(), [&](const Net& a, const Net& b) {
    const End& x = a.sources[0];
    const End& y = b.sources[0];
    if (parts_[x.item] != parts_[y.item]) return parts_[x.item] < parts_[y.item];
    return plan_.point(x).y < plan_.point(y).y;
  });
  for (const Net& net : whole.nets) addNet(net);
  return std::move(plans_);
}

// ---- parts

// The parts connected by wires, ignoring rails.
std::vector<uint32_t> connectedParts(const Plan& plan) {
  std::vector<uint32_t> part(plan.items.size());
  std::iota(part.begin(), part.end(), 0u);
  const auto find = [&](uint32_t k) {
    while (part[k] != k) k = part[k] = part[part[k]];
    return k;
  };
  for (const Link& link : plan.links) {
    if (isRailItem(plan.items[link.from.item]) || isRailItem(plan.items[link.to.item])) continue;
    part[find(link.from.item)] = find(link.to.item);
  }
  for (uint32_t k = 0; k < part.size(); ++k) part[k] = find(k);
  return part;
}

// Numbers parts by their rank `first`; parts of equal rank become one. Returns the number of parts.
uint32_t renumber(std::vector<uint32_t>& part, const std::vector<int64_t>& first) {
  std::vector<int64_t> ranks;
  for (const uint32_t p : part)
    if (first[p] != INT64_MAX) ranks.push_back(first[p]);
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  for (uint32_t& p : part)
    p = first[p] == INT64_MAX
            ? 0
            : static_cast<uint32_t>(std::lower_bound(ranks.begin(), ranks.end(), first[p]) - ranks.begin());
  return static_cast<uint32_t>(ranks.size());
}

// ---- bands

// A group of elements that overlap horizontally: it cannot be cut.
struct Column {
  int32_t left, right;
  std::vector<uint32_t> items;
};

std::vector<Column> columnsOf(const Body& body, const Plan& plan, int32_t most) {
  std::vector<uint32_t> order;
  for (uint32_t k = 0; k < plan.items.size(); ++k) {
    const Item& item = plan.items[k];
    if (!isRailItem(item) && item.element != kNone && body.elements[item.element].kind != ElementKind::Comment)
      order.push_back(k);
  }
  const auto boundsOfItem = [&](uint32_t k) { return plan.items[k].bounds(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return boundsOfItem(a).x < boundsOfItem(b).x; });
  std::vector<Column> columns;
  for (const uint32_t k : order) {
    const Rect r = boundsOfItem(k);
    // A variable at its pin belongs to the column of the pin.
    if (columns.empty() || r.x > columns.back().right + kGrid || r.right() - columns.back().left > most)
      columns.push_back({r.x, r.right(), {}});
    columns.back().right = std::max(columns.back().right, r.right());
    columns.back().items.push_back(k);
  }
  return columns;
}

// Continuations are in the rows of their pins, unless another one is there.
void placeContinuations(Plan& plan, bool begin, int32_t x) {
  struct Wanted {
    int32_t y;
    uint32_t item;
  };
  std::vector<Wanted> continuations;
  for (const Link& link : plan.links) {
    const uint32_t continuation = begin ? link.from.item : link.to.item;
    if (plan.items[continuation].continuation == 0) continue;
    const bool known = std::any_of(continuations.begin(), continuations.end(),
                                   [&](const Wanted& w) { return w.item == continuation; });
    if (!known) continuations.push_back({plan.point(begin ? link.to : link.from).y, continuation});
  }
  std::stable_sort(continuations.begin(), continuations.end(),
                   [](const Wanted& a, const Wanted& b) { return a.y < b.y; });
  int32_t free = INT32_MIN;
  for (const Wanted& continuation : continuations) {
    const int32_t y = std::max(continuation.y, free);
    plan.items[continuation.item].origin = {begin ? x : x - plan.items[continuation.item].frame.width, y};
    free = y + kElementGap;
  }
}

int32_t continuationsOf(const Plan& plan, bool begin, int32_t& width) {
  int32_t count = 0;
  for (const Item& item : plan.items) {
    if (item.continuation == 0 || item.terminals[0].output != begin) continue;
    ++count;
    width = std::max(width, item.frame.width);
  }
  return count;
}

}  // namespace

void fitRails(Plan& plan, int32_t left, int32_t right) {
  for (uint32_t k = 0; k < plan.items.size(); ++k) {
    Item& item = plan.items[k];
    if (!isRailItem(item)) continue;
    const bool gives = item.terminals[0].output;
    int32_t top = INT32_MAX, bottom = INT32_MIN;
    for (const Link& link : plan.links) {
      if ((gives ? link.from.item : link.to.item) != k) continue;
      const int32_t y = plan.point(gives ? link.to : link.from).y;
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
    item.terminals[0].length = top > bottom ? 0 : bottom - top + 2 * kElementGap;
    item.area = {0, 0, 0, item.terminals[0].length};
    item.origin = top > bottom ? Point{} : Point{gives ? left : right, top - kElementGap};
  }
}

Rect boundsOf(const Plan& plan) {
  if (plan.items.empty()) return {};
  Rect all = plan.items[0].bounds();
  for (const Item& item : plan.items) all.include(item.bounds());
  return all;
}

std::vector<Plan> splitByWires(const Plan& plan) {
  std::vector<uint32_t> part = connectedParts(plan);
  std::vector<bool> leads_on(plan.items.size());
  for (const Link& link : plan.links)
    if (!isRailItem(plan.items[link.to.item])) leads_on[link.from.item] = true;
  // In the order of their last elements, since they are drawn beside each other.
  std::vector<int64_t> first(plan.items.size(), INT64_MAX);
  for (const bool ends : {true, false})
    for (uint32_t k = 0; k < plan.items.size(); ++k)
      if (!isRailItem(plan.items[k]) && leads_on[k] != ends && first[part[k]] == INT64_MAX)
        first[part[k]] = plan.items[k].element == kNone ? 0 : static_cast<int64_t>(plan.items[k].element);
  const uint32_t count = renumber(part, first);
  uint32_t continuations = 0;
  return Splitter(plan, part, count, continuations).run();
}

std::vector<Plan> splitByRows(const Plan& plan) {
  std::vector<uint32_t> part = connectedParts(plan);
  struct Rows {
    int32_t top = INT32_MAX, bottom = INT32_MIN;
    uint32_t part = 0;
  };
  std::vector<Rows> rows(plan.items.size());
  for (uint32_t k = 0; k < plan.items.size(); ++k) {
    if (isRailItem(plan.items[k])) continue;
    Rows& r = rows[part[k]];
    r.top = std::min(r.top, plan.items[k].bounds().y);
    r.bottom = std::max(r.bottom, plan.items[k].bounds().bottom());
    r.part = part[k];
  }
  std::erase_if(rows, [](const Rows& r) { return r.top > r.bottom; });
  std::stable_sort(rows.begin(), rows.end(), [](const Rows& a, const Rows& b) { return a.top < b.top; });
  std::vector<int64_t> first(plan.items.size(), INT64_MAX);
  int64_t now = -1;
  int32_t bottom = INT32_MIN;
  for (const Rows& r : rows) {
    if (now < 0 || r.top >= bottom) ++now;
    bottom = std::max(bottom, r.bottom);
    first[r.part] = now;
  }
  const uint32_t count = renumber(part, first);
  uint32_t continuations = 0;
  std::vector<Plan> plans = Splitter(plan, part, count, continuations).run();
  int32_t left = 0, right = 0;
  for (const Item& item : plan.items)
    if (isRailItem(item)) (item.terminals[0].output ? left : right) = item.origin.x;
  for (Plan& strip : plans) fitRails(strip, left, right);
  return plans;
}

std::vector<Plan> wrap(const Body& body, Plan plan, int32_t page, uint32_t& continuations) {
  if (boundsOf(plan).width <= page) {
    std::vector<Plan> whole;
    whole.push_back(std::move(plan));
    return whole;
  }
  constexpr int32_t kForContinuations = 2 * kElementGap + 30;  // on each side
  const std::vector<Column> columns = columnsOf(body, plan, page - 2 * kForContinuations);
  std::vector<uint32_t> band(plan.items.size());
  std::vector<int32_t> begins;
  for (const Column& column : columns) {
    if (begins.empty() || column.right - begins.back() > page - (begins.size() > 1 ? 2 : 1) * kForContinuations)
      begins.push_back(column.left);
    for (const uint32_t k : column.items) band[k] = static_cast<uint32_t>(begins.size() - 1);
  }
  for (uint32_t k = 0; k < plan.items.size(); ++k) {
    const Item& item = plan.items[k];
    if (isRailItem(item) || body.elements[item.element].kind != ElementKind::Comment) continue;
    for (uint32_t b = 0; b < begins.size(); ++b)
      if (item.origin.x >= begins[b]) band[k] = b;
  }
  std::vector<Plan> bands = Splitter(plan, band, static_cast<uint32_t>(begins.size()), continuations).run();
  const int32_t origin = boundsOf(plan).x;
  for (uint32_t b = 0; b < bands.size(); ++b) {
    Plan& p = bands[b];
    int32_t width = 0;
    const int32_t in = continuationsOf(p, true, width);
    const bool railed = std::any_of(p.items.begin(), p.items.end(),
                                    [](const Item& item) { return isRailItem(item) && item.terminals[0].output; });
    const int32_t continuation_x = railed ? kElementGap : 0;
    const int32_t begin =
        b == 0 && in == 0 ? begins[0] - origin : continuation_x + width + kElementGap + std::min(in, 20) * kGrid;
    for (Item& item : p.items)
      if (item.continuation == 0 && !isRailItem(item)) item.origin.x += begin - begins[b];
    int32_t end = 0;
    for (const Item& item : p.items)
      if (item.continuation == 0 && !isRailItem(item)) end = std::max(end, item.bounds().right());
    width = 0;
    const int32_t out = continuationsOf(p, false, width);
    end = roundUp(std::max(end + kElementGap + std::min(out, 20) * kGrid + width, out > 0 ? page : 0));
    placeContinuations(p, true, continuation_x);
    placeContinuations(p, false, end);
    fitRails(p, 0, end);
  }
  return bands;
}

}  // namespace rung::picture

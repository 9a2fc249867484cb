// SPDX-License-Identifier: Apache-2.0
// A body of networks as a picture: each network is planned separately and drawn below the one before, beside a strip
// with its number and under its title.
#include <algorithm>

#include "frontend/render/network_plan.h"
#include "frontend/render/picture.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/diagram.h"

namespace rung::picture {
namespace {

constexpr int32_t kStrip = 40, kHeader = 30, kPageMargin = 20, kBetweenBands = 30;
constexpr int32_t kLeastPage = 300;  // an element and the modifiers beside it

// CODESYS puts a connector without a name into each wire.
bool isJoint(const DiagramElement& e) { return e.kind == ElementKind::Connector && !e.name.name; }
// CODESYS writes one for each network.
bool isEmptyComment(const Body& body, const DiagramElement& e) {
  const std::string_view text = body.string(e.comment, e.comment_length);
  return e.kind == ElementKind::Comment && std::all_of(text.begin(), text.end(), isBlankCharacter);
}
constexpr uint32_t kMaxJoints = 1000;  // followed from one pin: joints may form a loop

class Planner {
 public:
  explicit Planner(const Body& body)
      : body_(body),
        unlisted_(unlistedOutputs(body.tree, body.names, body.elements)),
        item_of_(body.elements.size(), kNone) {}
  // `elements`: of one network; its rails are shared where the file gives no positions. The bands are not routed yet.
  std::vector<Plan> plan(std::span<const uint32_t> elements, int32_t page);
  bool wiresStayInside(std::span<const uint32_t> network_of) const;
  bool placed() const { return placed_; }  // the last network has the positions of the file

 private:
  Plan items(std::span<const uint32_t> elements, bool one_rail);
  void addLinks(Plan& plan);
  void addRightRail(Plan& plan);
  void addLinks(Plan& plan, const DiagramWire& wire, const End& to, uint32_t& joints);
  uint32_t outputOf(const Item& item, NameId pin) const;
  uint32_t inputOf(const Item& item, uint32_t pin) const;
  bool ladder() const { return body_.diagram.language == NetworkLanguage::Ladder; }

  const Body& body_;
  std::vector<std::vector<NameId>> unlisted_;
  std::vector<uint32_t> item_of_;  // by element: its item in the current plan
  bool placed_ = false;
};

bool Planner::wiresStayInside(std::span<const uint32_t> network_of) const {
  for (uint32_t k = 0; k < body_.elements.size(); ++k) {
    if (isRail(body_.elements[k].kind)) continue;
    for (const DiagramPin& pin : body_.tree.list(body_.elements[k].pins))
      for (const DiagramWire& wire : body_.tree.list(pin.wires))
        if (wire.from != kNoElement && !isRail(body_.elements[wire.from].kind) &&
            network_of[wire.from] != network_of[k])
          return false;
  }
  return true;
}

uint32_t Planner::outputOf(const Item& item, NameId pin) const {
  std::vector<NameId> names;
  std::vector<uint32_t> terminals;
  for (uint32_t k = 0; k < item.terminals.size(); ++k) {
    if (!item.terminals[k].output) continue;
    names.push_back(item.terminals[k].name);
    terminals.push_back(k);
  }
  if (terminals.empty()) return kNone;
  const size_t found = rung::outputOf(body_.names, names, pin);
  return terminals[found < terminals.size() ? found : 0];
}

uint32_t Planner::inputOf(const Item& item, uint32_t pin) const {
  uint32_t first = kNone;
  for (uint32_t k = 0; k < item.terminals.size(); ++k) {
    const Terminal& t = item.terminals[k];
    if (t.output) continue;
    if (t.pin == pin) return k;
    if (first == kNone) first = k;
  }
  return first;
}

Plan Planner::items(std::span<const uint32_t> elements, bool one_rail) {
  Plan plan;
  uint32_t rails[2] = {kNone, kNone};
  std::fill(item_of_.begin(), item_of_.end(), kNone);
  for (const uint32_t k : elements) {
    const ElementKind kind = body_.elements[k].kind;
    if (isJoint(body_.elements[k]) || isEmptyComment(body_, body_.elements[k])) continue;
    uint32_t* const rail = !one_rail || !isRail(kind) ? nullptr : &rails[kind == ElementKind::RightRail];
    if (rail != nullptr && *rail != kNone) {
      item_of_[k] = *rail;
      continue;
    }
    item_of_[k] = static_cast<uint32_t>(plan.items.size());
    if (rail != nullptr) *rail = item_of_[k];
    plan.items.push_back(measure(body_, k, unlisted_[k]));
  }
  return plan;
}

// Follows joints.
void Planner::addLinks(Plan& plan, const DiagramWire& wire, const End& to, uint32_t& joints) {
  if (wire.from == kNoElement) return;
  if (isJoint(body_.elements[wire.from])) {
    if (++joints > kMaxJoints) return;
    for (const DiagramPin& pin : body_.tree.list(body_.elements[wire.from].pins))
      for (const DiagramWire& before : body_.tree.list(pin.wires)) addLinks(plan, before, to, joints);
    return;
  }
  const uint32_t from = item_of_[wire.from];
  if (from == kNone) return;
  const End end{from, outputOf(plan.items[from], wire.pin.name)};
  if (end.terminal != kNone) plan.links.push_back({end, to});
}

void Planner::addLinks(Plan& plan) {
  for (uint32_t k = 0; k < body_.elements.size(); ++k) {
    const uint32_t to = item_of_[k];
    if (to == kNone) continue;
    const std::span<const DiagramPin> pins = body_.tree.list(body_.elements[k].pins);
    for (uint32_t p = 0; p < pins.size(); ++p) {
      const End end{to, inputOf(plan.items[to], p)};
      if (end.terminal == kNone) continue;
      uint32_t joints = 0;
      for (const DiagramWire& wire : body_.tree.list(pins[p].wires)) addLinks(plan, wire, end, joints);
    }
  }
}

// Coils of a ladder diagram end at the right rail, even if the file does not draw it.
void Planner::addRightRail(Plan& plan) {
  std::vector<bool> used(plan.items.size());
  for (const Link& link : plan.links) used[link.from.item] = true;
  uint32_t rail = kNone;
  for (uint32_t k = 0; k < plan.items.size(); ++k)
    if (body_.elements[plan.items[k].element].kind == ElementKind::RightRail) rail = k;
  const auto items = static_cast<uint32_t>(plan.items.size());
  for (uint32_t k = 0; k < items; ++k) {
    if (used[k] || body_.elements[plan.items[k].element].kind != ElementKind::Coil) continue;
    if (rail == kNone) {
      rail = items;
      plan.items.push_back({kNone, {0, 0, 0, 40}, {}, {}, {{{0, 0}, false, kNone, {}, 40}}});
    }
    plan.links.push_back({{k, outputOf(plan.items[k], {})}, {rail, 0}});
  }
}

void addTo(std::vector<Plan>& all, std::vector<Plan> more) {
  for (Plan& plan : more) all.push_back(std::move(plan));
}

std::vector<Plan> Planner::plan(std::span<const uint32_t> elements, int32_t page) {
  std::vector<Plan> bands;
  uint32_t continuations = 0;
  Plan placed = items(elements, false);
  addLinks(placed);
  placed_ = takeFilePositions(body_, placed);
  if (placed_) {
    // A CFC is two-dimensional, not read in lines: it keeps its positions.
    if (body_.diagram.language == NetworkLanguage::Continuous || boundsOf(placed).width <= page)
      bands.push_back(std::move(placed));
    else
      for (Plan& rows : splitByRows(placed)) addTo(bands, wrap(body_, std::move(rows), page, continuations));
    return bands;
  }
  Plan free = items(elements, true);
  addLinks(free);
  if (ladder()) addRightRail(free);
  Plan whole = free;
  arrange(body_, whole);
  if (boundsOf(whole).width <= page) {
    bands.push_back(std::move(whole));
    return bands;
  }
  for (Plan& part : splitByWires(free)) {
    arrange(body_, part);
    addTo(bands, wrap(body_, std::move(part), page, continuations));
  }
  return bands;
}

void moveBy(Plan& plan, Point by) {
  for (Item& item : plan.items) item.origin = item.origin + by;
  for (Net& net : plan.nets) {
    for (std::vector<Point>& line : net.lines)
      for (Point& p : line) p = p + by;
    for (Point& p : net.dots) p = p + by;
  }
  plan.bounds = plan.bounds.at(by);
}

void drawPlan(Svg& svg, const Body& body, const Plan& plan) {
  for (const Net& net : plan.nets) {
    if (body.path_of != nullptr) svg.open(liveAttributes(body, plan, net));
    for (const std::vector<Point>& line : net.lines) svg.path(route(line.data(), line.size()));
    for (const Point p : net.dots) svg.cycle(p, 2, "d");
    if (body.path_of != nullptr) svg.close();
  }
  if (body.path_of != nullptr) {
    for (const Net& net : openOutputs(body, plan)) {
      svg.open(liveAttributes(body, plan, net));
      svg.close();
    }
  }
  for (const Item& item : plan.items) drawItem(svg, body, item);
}

// Aligns the right rails of all networks, with their coils.
void alignRightRails(std::vector<std::vector<Plan>>& networks, const Body& body) {
  int32_t right = 0;
  const auto rightRail = [&](const Item& item) {
    return !item.terminals.empty() && item.terminals[0].length > 0 && !item.terminals[0].output;
  };
  for (const std::vector<Plan>& bands : networks)
    for (const Plan& plan : bands)
      for (const Item& item : plan.items)
        if (rightRail(item) || item.continuation != 0) right = std::max(right, item.bounds().right());
  for (std::vector<Plan>& bands : networks)
    for (Plan& plan : bands) {
      const auto rail = std::find_if(plan.items.begin(), plan.items.end(), rightRail);
      if (rail == plan.items.end()) continue;
      const int32_t by = right - rail->origin.x;
      rail->origin.x = right;
      const auto index = static_cast<uint32_t>(rail - plan.items.begin());
      for (const Link& link : plan.links) {
        Item& item = plan.items[link.from.item];
        if (link.to.item == index && item.element != kNone && body.elements[item.element].kind == ElementKind::Coil)
          item.origin.x += by;
      }
    }
}

// Stacks the bands of a network, with their wires.
Plan stacked(std::vector<Plan>& bands) {
  Plan all;
  for (Plan& plan : bands) {
    routeWires(plan);
    if (all.items.empty()) {
      all = std::move(plan);
      continue;
    }
    // A band that begins with a continuation or a rail is aligned with the first band.
    moveBy(plan, {all.bounds.x - plan.bounds.x, all.bounds.bottom() + kBetweenBands - plan.bounds.y});
    const auto first = static_cast<uint32_t>(all.items.size());
    for (Net& net : plan.nets) {
      for (std::vector<End>* ends : {&net.sources, &net.targets})
        for (End& end : *ends) end.item += first;
      all.nets.push_back(std::move(net));
    }
    for (Item& item : plan.items) all.items.push_back(std::move(item));
    all.bounds.include(plan.bounds);
  }
  return all;
}

}  // namespace

std::vector<Plan> planNetworks(const Body& body, int32_t page) {
  const auto networks = static_cast<uint32_t>(body.diagram.networks.count);
  std::vector<uint32_t> network_of(body.elements.size());
  for (uint32_t k = 0; k < network_of.size(); ++k)
    network_of[k] = body.elements[k].network <= networks ? body.elements[k].network : 0;
  Planner planner(body);
  if (!planner.wiresStayInside(network_of)) std::fill(network_of.begin(), network_of.end(), 0);
  std::vector<std::vector<uint32_t>> elements(networks + 1);
  for (uint32_t k = 0; k < network_of.size(); ++k) {
    if (!isRail(body.elements[k].kind)) {
      elements[network_of[k]].push_back(k);
      continue;
    }
    for (std::vector<uint32_t>& network : elements) network.push_back(k);  // a rail belongs to each network
  }
  std::vector<std::vector<Plan>> bands;
  bool laid_out = body.diagram.language == NetworkLanguage::Ladder;
  for (const std::vector<uint32_t>& network : elements) {
    const bool rails =
        std::all_of(network.begin(), network.end(), [&](uint32_t k) { return isRail(body.elements[k].kind); });
    bands.push_back(rails ? std::vector<Plan>() : planner.plan(network, page == 0 ? INT32_MAX : page));
    laid_out = laid_out && (rails || !planner.placed());
  }
  if (laid_out) alignRightRails(bands, body);
  std::vector<Plan> plans;
  plans.reserve(bands.size());
  for (std::vector<Plan>& network : bands) plans.push_back(stacked(network));
  return plans;
}

// CODESYS has no numbers for them in its explicit order: they run with their readers.
static bool isComposer(const DiagramElement& e) {
  return e.kind == ElementKind::Compose || e.kind == ElementKind::Select;
}

// The numbers of the file. If it has none, elements are counted; if some elements have none, `3.1` is the first of
// those that run after the element with number 3.
static std::vector<std::string> executionNumbers(std::span<const DiagramElement> elements,
                                                 std::span<const uint32_t> order) {
  std::vector<std::string> numbers(elements.size());
  bool numbered = false;
  for (size_t k = 0; k < elements.size(); ++k) {
    if (elements[k].order == 0) continue;
    numbers[k] = std::to_string(elements[k].order);
    numbered = true;
  }
  uint32_t last = 0, after = 0;
  for (const uint32_t k : order) {
    if (elements[k].order != 0) {
      last = elements[k].order;
      after = 0;
    } else if (!numbered || !isComposer(elements[k])) {
      numbers[k] = (numbered ? std::to_string(last) + "." : "") + std::to_string(++after);
    }
  }
  return numbers;
}

std::string drawNetworks(const Tree& tree, const Names& names, const Diagram& diagram, std::string_view name,
                         int32_t page, const NetworkNotes& notes) {
  const std::vector<std::string> numbers = executionNumbers(tree.list(diagram.elements), notes.execution_order);
  const Body body{tree, names, diagram, tree.list(diagram.elements), numbers, notes.in_outs, notes.path_of};
  const int32_t left = diagram.networks.empty() ? kPageMargin : kStrip + kPageMargin;
  std::vector<Plan> plans = planNetworks(body, page == 0 ? 0 : std::max(page - left - kPageMargin, kLeastPage));
  int32_t y = 0, right = 0;
  Svg svg;
  for (uint32_t k = 0; k < plans.size(); ++k) {
    Plan& plan = plans[k];
    if (k == 0 && plan.items.empty()) continue;
    const int32_t top = y;
    if (k > 0) y += kHeader;
    moveBy(plan, {left - plan.bounds.x, y + kPageMargin - plan.bounds.y});
    y = roundUp(plan.bounds.bottom() + kPageMargin);
    right = std::max(right, plan.bounds.right());
    if (k > 0) {
      const DiagramNetwork& network = tree.list(diagram.networks)[k - 1];
      std::string title(body.string(network.title, network.title_length));
      if (network.disabled) title += title.empty() ? "(disabled)" : " (disabled)";
      svg.rect({0, top, kStrip, y - top}, "n");
      svg.text({kStrip / 2, top + 20}, Anchor::Middle, std::to_string(network.number), "b");
      svg.text({left, top + 20}, Anchor::Start, title, network.disabled ? "g" : "b");
      right = std::max(right, left + textWidth(title));
      if (network.disabled) svg.line({kStrip / 2 - 12, top + 16}, {kStrip / 2 + 12, top + 16});
      if (network.disabled) svg.openFaded();
    }
    drawPlan(svg, body, plan);
    if (k > 0 && tree.list(diagram.networks)[k - 1].disabled) svg.close();
  }
  return svg.finish(name, right + kPageMargin, std::max(y, 2 * kPageMargin));
}

}  // namespace rung::picture

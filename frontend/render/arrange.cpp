// SPDX-License-Identifier: Apache-2.0
// The automatic layout of networks: columns by data flow, from left to right; rows so that the source of an element's
// first pin is in the element's row. A variable that only one pin uses is attached to that pin. In ladder diagrams
// coils are at the right rail, and each contact at the left rail has a separate row. Labels and comments have separate
// lines, in file order. Elements are placed in the post-order of a walk from the last elements back along the wires:
// the sources of an element are placed before it, so all of them can still be moved down when the element needs room.
#include <algorithm>

#include "frontend/render/network_plan.h"
#include "frontend/syntax/diagram.h"

namespace rung::picture {
namespace {

class Arranger {
 public:
  Arranger(const Body& body, Plan& plan) : body_(body), plan_(plan) {}
  void run();

 private:
  struct Node {
    std::vector<uint32_t> in, out;  // links, without rails and attached variables
    std::vector<uint32_t> attached;
    uint32_t host = kNone;  // the item to which it is attached
    uint32_t column = 0;
    uint32_t first = 0, rank = 0;  // in `order_`: the start of its sources, and its own index
    bool joins = false;            // of a walk's root: an earlier walk found one of its sources
    Rect cluster;                  // with attached items
    enum class State : uint8_t { New, Open, Done } state = State::New;
  };
  const DiagramElement& element(uint32_t item) const { return body_.elements[plan_.items[item].element]; }
  bool isNode(uint32_t item) const;
  // On separate lines: no element beside it.
  bool isIsolated(uint32_t item) const {
    return element(item).kind == ElementKind::Label || element(item).kind == ElementKind::Comment;
  }
  bool ladder() const { return body_.diagram.language == NetworkLanguage::Ladder; }
  void attach();
  void walk(uint32_t root);
  void setColumns();
  void placeItem(uint32_t item);
  void reserve(uint32_t item);
  void moveDown(uint32_t first, uint32_t end, int32_t by);
  uint32_t alignedLink(uint32_t item) const;
  void setX();
  void setAttached();

  const Body& body_;
  Plan& plan_;
  std::vector<Node> nodes_;
  std::vector<bool> feedback_;  // links of feedback loops
  std::vector<uint32_t> order_;
  std::vector<int32_t> skyline_;  // by column: where the next element may begin
};

bool Arranger::isNode(uint32_t item) const {
  if (plan_.items[item].element == kNone || nodes_[item].host != kNone) return false;
  return !isRail(element(item).kind);
}

// A variable is attached to its pin if that is its only one and there is enough room between pins.
void Arranger::attach() {
  std::vector<uint32_t> uses_from(plan_.items.size()), uses_to(plan_.items.size());
  std::vector<std::vector<uint32_t>> terminal_uses(plan_.items.size());
  for (uint32_t k = 0; k < plan_.items.size(); ++k) terminal_uses[k].resize(plan_.items[k].terminals.size());
  for (const Link& link : plan_.links) {
    ++uses_from[link.from.item];
    ++uses_to[link.to.item];
    ++terminal_uses[link.from.item][link.from.terminal];
    ++terminal_uses[link.to.item][link.to.terminal];
  }
  const auto isText = [&](uint32_t item, ElementKind kind) {
    return plan_.items[item].element != kNone && element(item).kind == kind && plan_.items[item].area.height <= 20;
  };
  for (const Link& link : plan_.links) {
    const uint32_t from = link.from.item, to = link.to.item;
    if (plan_.items[from].element == kNone || plan_.items[to].element == kNone || from == to) continue;
    const bool input = isText(from, ElementKind::Input) && uses_from[from] == 1 &&
                       terminal_uses[to][link.to.terminal] == 1 && !isRail(element(to).kind);
    const bool output = isText(to, ElementKind::Output) && uses_to[to] == 1 &&
                        terminal_uses[from][link.from.terminal] == 1 && !isRail(element(from).kind) &&
                        element(from).kind != ElementKind::Input;
    if (input && nodes_[to].host == kNone && nodes_[from].attached.empty()) {
      nodes_[from].host = to;
      nodes_[to].attached.push_back(from);
    } else if (output && nodes_[from].host == kNone && nodes_[to].attached.empty()) {
      nodes_[to].host = from;
      nodes_[from].attached.push_back(to);
    }
  }
}

// The sources of `root` come before it; a wire that closes a loop is a feedback link.
void Arranger::walk(uint32_t root) {
  struct Frame {
    uint32_t item, next;
  };
  std::vector<Frame> stack{{root, 0}};
  nodes_[root].state = Node::State::Open;
  nodes_[root].first = static_cast<uint32_t>(order_.size());
  while (!stack.empty()) {
    Frame& top = stack.back();
    Node& node = nodes_[top.item];
    if (top.next == node.in.size()) {
      node.state = Node::State::Done;
      node.rank = static_cast<uint32_t>(order_.size());
      order_.push_back(top.item);
      stack.pop_back();
      continue;
    }
    const uint32_t link = node.in[top.next++];
    const uint32_t from = plan_.links[link].from.item;
    if (nodes_[from].state == Node::State::Done) {
      if (nodes_[from].rank < nodes_[root].first) nodes_[root].joins = true;
    } else if (nodes_[from].state == Node::State::Open) {
      feedback_[link] = true;
    } else {
      nodes_[from].state = Node::State::Open;
      nodes_[from].first = static_cast<uint32_t>(order_.size());
      stack.push_back({from, 0});
    }
  }
}

void Arranger::setColumns() {
  uint32_t last = 0;
  for (const uint32_t item : order_) {
    Node& node = nodes_[item];
    for (const uint32_t link : node.in)
      if (!feedback_[link]) node.column = std::max(node.column, nodes_[plan_.links[link].from.item].column + 1);
    last = std::max(last, node.column);
  }
  for (auto item = order_.rbegin(); item != order_.rend(); ++item) {
    Node& node = nodes_[*item];
    const ElementKind kind = element(*item).kind;
    const bool ends = kind == ElementKind::Coil || kind == ElementKind::Jump || kind == ElementKind::Return;
    if (ladder() && ends && node.out.empty()) node.column = last;
    if (ladder() || !node.in.empty() || node.out.empty()) continue;
    uint32_t nearest = kNone;  // an element without inputs is placed near its reader
    for (const uint32_t link : node.out)
      if (!feedback_[link]) nearest = std::min(nearest, nodes_[plan_.links[link].to.item].column);
    if (nearest != kNone && nearest > 0) node.column = nearest - 1;
  }
  skyline_.assign(last + 1, 0);
}

// Keeps the row of a long wire free.
void Arranger::reserve(uint32_t item) {
  for (const uint32_t k : nodes_[item].out) {
    const Link& link = plan_.links[k];
    const int32_t below = plan_.point(link.from).y + kGrid;
    for (uint32_t c = nodes_[item].column + 1; c < nodes_[link.to.item].column; ++c)
      skyline_[c] = std::max(skyline_[c], below);
  }
}

void Arranger::moveDown(uint32_t first, uint32_t end, int32_t by) {
  for (uint32_t k = first; k < end; ++k) {
    const uint32_t item = order_[k];
    plan_.items[item].origin.y += by;
    const Node& node = nodes_[item];
    int32_t& free = skyline_[node.column];
    free = std::max(free, node.cluster.at(plan_.items[item].origin).bottom() + kElementGap);
    reserve(item);
  }
}

// The wire to be drawn straight.
uint32_t Arranger::alignedLink(uint32_t item) const {
  uint32_t best = kNone;
  int32_t highest = 0;
  for (const uint32_t link : nodes_[item].in) {
    if (feedback_[link]) continue;
    const int32_t y = plan_.terminal(plan_.links[link].to).at.y;
    if (best == kNone || y < highest) {
      best = link;
      highest = y;
    }
  }
  return best;
}

void Arranger::placeItem(uint32_t item) {
  Node& node = nodes_[item];
  Item& it = plan_.items[item];
  int32_t y = skyline_[node.column] - node.cluster.y;
  if (const uint32_t link = alignedLink(item); link != kNone) {
    const int32_t wanted = plan_.point(plan_.links[link].from).y - plan_.terminal(plan_.links[link].to).at.y;
    if (wanted >= y)
      y = wanted;
    else if (nodes_[plan_.links[link].from.item].rank >= node.first)
      moveDown(node.first, node.rank, y - wanted);
  }
  it.origin.y = y;
  skyline_[node.column] = node.cluster.at(it.origin).bottom() + kElementGap;
  reserve(item);
}

// Columns as wide as their widest element; between them a lane for each wire that changes its row.
void Arranger::setX() {
  const size_t columns = skyline_.size();
  std::vector<int32_t> left(columns), right(columns), lanes(columns + 1);
  for (const uint32_t item : order_) {
    const Node& node = nodes_[item];
    if (isIsolated(item)) continue;
    left[node.column] = std::max(left[node.column], -node.cluster.x);
    right[node.column] = std::max(right[node.column], node.cluster.right());
  }
  std::vector<End> last(columns + 1, End{kNone, kNone});
  for (uint32_t k = 0; k < plan_.links.size(); ++k) {
    const Link& link = plan_.links[k];
    if (!isNode(link.to.item) || !isNode(link.from.item)) continue;
    if (!feedback_[k] && plan_.point(link.from).y == plan_.point(link.to).y) continue;
    const auto count = [&](uint32_t channel) {
      if (last[channel] == link.from) return;
      last[channel] = link.from;
      ++lanes[channel];
    };
    count(nodes_[link.to.item].column);
    if (feedback_[k]) count(nodes_[link.from.item].column + 1);
  }
  int32_t x = ladder() ? kElementGap : 0;
  std::vector<int32_t> at(columns);
  for (size_t c = 0; c < columns; ++c) {
    x += c > 0 || lanes[c] > 0 ? kElementGap + std::min(lanes[c], 60) * kGrid : 0;
    at[c] = x + left[c];
    x = at[c] + right[c];
  }
  x += kElementGap + lanes[columns] * kGrid;
  for (const uint32_t item : order_)
    plan_.items[item].origin.x = isIsolated(item) ? (ladder() ? kElementGap : 0) : at[nodes_[item].column];
  setAttached();
  fitRails(plan_, 0, x);
}

void Arranger::setAttached() {
  for (const Link& link : plan_.links) {
    const uint32_t from = link.from.item, to = link.to.item;
    if (nodes_[from].host == to) {
      const Point end = plan_.point(link.to);
      plan_.items[from].origin = {end.x - kGrid - plan_.terminal(link.from).at.x,
                                  end.y - plan_.terminal(link.from).at.y};
    } else if (nodes_[to].host == from) {
      const Point end = plan_.point(link.from);
      plan_.items[to].origin = {end.x + kGrid - plan_.terminal(link.to).at.x, end.y - plan_.terminal(link.to).at.y};
    }
  }
}

void Arranger::run() {
  nodes_.resize(plan_.items.size());
  feedback_.resize(plan_.links.size());
  attach();
  for (uint32_t k = 0; k < plan_.links.size(); ++k) {
    const Link& link = plan_.links[k];
    if (!isNode(link.from.item) || !isNode(link.to.item)) continue;
    nodes_[link.to.item].in.push_back(k);
    nodes_[link.from.item].out.push_back(k);
  }
  std::vector<uint32_t> roots;
  for (uint32_t k = 0; k < plan_.items.size(); ++k)
    if (isNode(k) && nodes_[k].out.empty()) roots.push_back(k);
  for (uint32_t k = 0; k < plan_.items.size(); ++k)
    if (isNode(k) && !nodes_[k].out.empty()) roots.push_back(k);  // loops without an end
  std::vector<uint32_t> ends;
  std::vector<bool> apart;  // shares no source with elements placed before
  for (const uint32_t root : roots) {
    if (nodes_[root].state != Node::State::New) continue;
    walk(root);
    ends.push_back(static_cast<uint32_t>(order_.size()));
    apart.push_back(!nodes_[root].joins);
  }
  setColumns();
  for (const uint32_t item : order_) {
    Node& node = nodes_[item];
    node.cluster = plan_.items[item].area;
    plan_.items[item].origin = {};
  }
  setAttached();
  for (const uint32_t item : order_)
    for (const uint32_t guest : nodes_[item].attached) nodes_[item].cluster.include(plan_.items[guest].bounds());
  size_t tree = 0;
  for (uint32_t k = 0; k < order_.size(); ++k) {
    if (k == 0 || k == ends[tree]) {
      if (k > 0) ++tree;
      if (apart[tree] || isIsolated(order_[k - 1]))
        std::fill(skyline_.begin(), skyline_.end(), *std::max_element(skyline_.begin(), skyline_.end()));
    }
    placeItem(order_[k]);
  }
  setX();
}

}  // namespace

void arrange(const Body& body, Plan& plan) { Arranger(body, plan).run(); }

}  // namespace rung::picture

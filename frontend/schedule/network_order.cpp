// SPDX-License-Identifier: Apache-2.0
// The connections of a body, and the execution order of its elements.
#include <algorithm>
#include <compare>
#include <numeric>
#include <utility>

#include "frontend/schedule/diagnostics.h"
#include "frontend/schedule/network_graph.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/standard_names.h"

namespace rung::diagram {
namespace {

// Of one element; if there are more, a table is used to find the pin.
constexpr uint32_t kFewSources = 8;

bool isRail(ElementKind kind) { return kind == ElementKind::Rail || kind == ElementKind::RightRail; }

// Has an effect even without readers.
bool acts(const DiagramElement& e) {
  switch (e.kind) {
    case ElementKind::Coil:
    case ElementKind::Box:
    case ElementKind::Output:
    case ElementKind::Jump:
    case ElementKind::Label:
    case ElementKind::Return:
    case ElementKind::Execute: return true;
    case ElementKind::InOut: return !e.pins.empty();
    case ElementKind::Compose:
    case ElementKind::Select: return e.order != 0;
    case ElementKind::Rail:
    case ElementKind::RightRail:
    case ElementKind::Contact:
    case ElementKind::Input:
    case ElementKind::Connector:
    case ElementKind::Continuation:
    case ElementKind::Comment: break;
  }
  return false;
}

}  // namespace

bool keepsState(const Element& e) { return e.kind == ElementKind::Box && (e.operand || e.hidden); }

bool runsInLoops(const DiagramElement& e) {
  return e.kind == ElementKind::Box || e.kind == ElementKind::Execute || e.kind == ElementKind::Compose ||
         e.kind == ElementKind::Select;
}

// Wires are followed through it. A connector that joins several wires or changes their value is an element.
bool Graph::isLink(uint32_t element) const {
  const Element& e = elements[element];
  if (e.kind == ElementKind::Continuation) return true;
  if (e.kind != ElementKind::Connector) return false;
  const DiagramPin* pin = inputPin(element);
  if (pin == nullptr || pin->wires.empty()) return true;
  return pin->wires.count < 2 && !isModified(e) && !isModified(*pin);
}

const DiagramPin* Graph::inputPin(uint32_t element) const {
  for (const DiagramPin& pin : tree_->list(elements[element].pins))
    if (pin.direction != PinDirection::Output) return &pin;
  return nullptr;
}

// For a wire without a pin name the only one besides ENO.
const DiagramPin* Graph::outputPin(uint32_t source) const {
  const Source& s = sources[source];
  const ElementKind kind = elements[s.element].kind;
  if (kind == ElementKind::Rail || kind == ElementKind::Compose) return nullptr;  // without modifiers
  const DiagramPin* only = nullptr;
  for (const DiagramPin& pin : tree_->list(elements[s.element].pins)) {
    if (pin.direction != PinDirection::Output) continue;
    if (s.pin.name) {
      if (names_->same(pin.name.name, s.pin.name)) return &pin;
    } else if (!isEnableOutput(names_->string(pin.name.name)) || elements[s.element].kind == ElementKind::Execute) {
      if (only != nullptr) return nullptr;
      only = &pin;
    }
  }
  return only;
}

bool Graph::isPowered(const DiagramPin& pin) const {
  for (uint32_t w = 0; w < pin.wires.count; ++w)
    if (elements[sources[sourceOf(pin, w)].element].kind == ElementKind::Rail) return true;
  return false;
}

bool Graph::runs(uint32_t element) const {
  const ElementKind kind = elements[element].kind;
  return acts(elements[element]) || kind == ElementKind::Compose || kind == ElementKind::Select;
}

bool Graph::isOrdered(uint32_t element) const { return elements[element].order != 0 && acts(elements[element]); }

bool Graph::isTarget(uint32_t element) const {
  const Element& e = elements[element];
  if (e.kind != ElementKind::Output && e.kind != ElementKind::Coil && e.kind != ElementKind::InOut) return false;
  const DiagramPin* pin = inputPin(element);
  return pin != nullptr && pin->wires.count == 1;
}

const DiagramPin* Graph::enableOf(uint32_t element) const {
  if (elements[element].kind != ElementKind::Box || keepsState(elements[element])) return nullptr;
  for (const DiagramPin& pin : tree_->list(elements[element].pins)) {
    if (pin.direction == PinDirection::Output || pin.wires.empty()) continue;
    if (!isEnable(names_->string(pin.name.name))) continue;
    return isAlwaysTrue(pin) ? nullptr : &pin;
  }
  return nullptr;
}

// The source of the wire into a connector. Each is followed once, however many elements refer to it.
//   fails   an unconnected connector                 E1007
//   fails   a loop of connectors                     E1006
Graph::End Graph::endOf(uint32_t link) {
  constexpr uint32_t kOpen = kNone - 1, kWalked = kNone - 2;
  if (ends_.empty()) ends_.resize(elements.size(), {kOpen, {}});
  std::vector<uint32_t> path;
  End end{link, {}};
  while (end.element != kNone && isLink(end.element)) {
    const uint32_t at = end.element;
    const Element& e = elements[at];
    if (ends_[at].element == kWalked) diagnostics_->report(diag::WireLoop, e.loc);
    if (ends_[at].element != kOpen) {
      end = ends_[at].element == kWalked ? End{kNone, {}} : ends_[at];
      break;
    }
    ends_[at].element = kWalked;
    path.push_back(at);
    if (e.kind == ElementKind::Continuation) {
      end.element = e.network;  // connect() stored the connector there, or reported that it is missing
    } else if (e.pins.empty() || tree_->list(e.pins)[0].wires.empty()) {
      diagnostics_->report(diag::NotWired, e.loc, {nameOf(e)});
      end.element = kNone;
    } else {
      const DiagramWire& wire = tree_->list(tree_->list(e.pins)[0].wires)[0];
      end = {wire.from, wire.pin};
    }
  }
  for (const uint32_t at : path) ends_[at] = end;
  return end;
}

uint32_t Graph::nextInput(InputWalk& walk) const {
  const Element& e = elements[walk.element];
  while (walk.pin < e.pins.count) {
    const DiagramPin& pin = tree_->list(e.pins)[walk.pin];
    if (walk.wire < pin.wires.count) return sourceOf(pin, walk.wire++);
    ++walk.pin;
    walk.wire = 0;
  }
  return kNone;
}

uint32_t Graph::find(uint32_t element, NameId pin) const {
  uint32_t steps = 0;
  for (uint32_t s = first_source[element]; s != kNone; s = sources[s].next) {
    if (names_->same(sources[s].pin.name, pin)) return s;
    if (++steps < kFewSources) continue;
    const auto known = by_pin_.find(keyOf(element, pin));
    return known == by_pin_.end() ? kNone : known->second;
  }
  return kNone;
}

uint32_t Graph::sourceAt(uint32_t element, const Ident& pin) {
  const ElementKind kind = elements[element].kind;
  const bool has_pins = kind == ElementKind::Box || kind == ElementKind::Execute || kind == ElementKind::Select;
  const Ident named = has_pins ? pin : Ident{{}, pin.loc};
  if (const uint32_t known = find(element, named.name); known != kNone) return known;
  Source source{};
  source.element = element;
  source.pin = named;
  source.next = first_source[element];
  first_source[element] = static_cast<uint32_t>(sources.size());
  by_pin_.emplace(keyOf(element, named.name), first_source[element]);
  sources.push_back(source);
  return first_source[element];
}

//   fails   a continuation without its connector        E1008
//   fails   two connectors of one name                  E1009
bool Graph::connect() {
  bool ok = true;                                         // a second error on the same cause is not counted
  std::vector<std::pair<uint32_t, uint32_t>> connectors;  // name key, element
  for (uint32_t k = 0; k < elements.size(); ++k) {
    const Element& e = elements[k];
    if (e.kind == ElementKind::Connector && e.name.name) connectors.emplace_back(names_->key(e.name.name).index, k);
  }
  std::sort(connectors.begin(), connectors.end());
  for (size_t k = 1; k < connectors.size(); ++k) {
    if (connectors[k].first != connectors[k - 1].first) continue;
    ok = false;
    const Ident& name = elements[connectors[k].second].name;
    diagnostics_->report(diag::DuplicateConnector, name.loc, {names_->string(name.name)})
        .declaredHere(elements[connectors[k - 1].second].name.loc);
  }
  for (Element& e : elements) {
    if (e.kind != ElementKind::Continuation) continue;
    const auto found = std::lower_bound(connectors.begin(), connectors.end(),
                                        std::pair{e.name.name ? names_->key(e.name.name).index : 0u, 0u});
    const bool known = e.name.name && found != connectors.end() && found->first == names_->key(e.name.name).index;
    if (!known) diagnostics_->report(diag::NoConnector, e.loc, {names_->string(e.name.name)});
    e.network = known ? found->second : kNone;
    ok = ok && known;
  }
  first_source.assign(elements.size(), kNone);
  first_wire_ = kNone;
  uint32_t end = 0;
  for (const Element& e : elements)
    for (const DiagramPin& pin : tree_->list(e.pins)) {
      if (pin.wires.empty()) continue;
      first_wire_ = std::min(first_wire_, pin.wires.first);
      end = std::max(end, pin.wires.first + pin.wires.count);
    }
  source_of_wire_.assign(first_wire_ == kNone ? 0 : end - first_wire_, kNone);
  for (uint32_t k = 0; k < elements.size(); ++k) {
    if (isLink(k)) continue;
    const bool ends = elements[k].kind == ElementKind::RightRail;
    for (const DiagramPin& pin : tree_->list(elements[k].pins))
      for (uint32_t w = 0; w < pin.wires.count; ++w) {
        const DiagramWire& wire = tree_->list(pin.wires)[w];
        // The pin of a wire through connectors is that of the wire into the first of them.
        const End origin = isLink(wire.from) ? endOf(wire.from) : End{wire.from, wire.pin};
        if (origin.element == kNone) {
          ok = false;
          continue;
        }
        const uint32_t source = sourceAt(origin.element, origin.pin);
        source_of_wire_[pin.wires.first + w - first_wire_] = source;
        if (ends) continue;
        ++sources[source].uses;
        sources[source].user = k;
      }
  }
  return ok;
}

// Elements belong to one network when wires other than those of power rails connect them, or when the file says so.
void Graph::separate() {
  std::vector<uint32_t> parent(elements.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  const auto join = [&](uint32_t a, uint32_t b) { parent[root(std::max(a, b))] = root(std::min(a, b)); };
  std::vector<std::pair<uint32_t, uint32_t>> numbered;  // network of the file, element
  for (uint32_t k = 0; k < elements.size(); ++k) {
    const Element& e = elements[k];
    if (isRail(e.kind) || isLink(k)) continue;
    if (e.network != 0) numbered.emplace_back(e.network, k);
    for (const DiagramPin& pin : tree_->list(e.pins))
      for (uint32_t w = 0; w < pin.wires.count; ++w) {
        const uint32_t from = sources[sourceOf(pin, w)].element;
        if (!isRail(elements[from].kind)) join(k, from);
      }
  }
  std::sort(numbered.begin(), numbered.end());
  for (size_t k = 1; k < numbered.size(); ++k)
    if (numbered[k].first == numbered[k - 1].first) join(numbered[k].second, numbered[k - 1].second);
  network.resize(elements.size());
  for (uint32_t k = 0; k < elements.size(); ++k) network[k] = root(k);
}

void Graph::sortRoots() {
  bool placed = false;
  const DiagramElement* first = nullptr;
  for (const Element& e : elements) {
    if (!e.placed || isRail(e.kind) || e.kind == ElementKind::Comment) continue;
    if (first == nullptr) first = &e;
    placed = placed || e.x != first->x || e.y != first->y;
    ordered = ordered || e.order != 0;
  }
  for (const Element& e : elements) ordered = ordered || e.order != 0;

  struct Key {
    uint32_t number_in_file;  // the network's number in the file
    int32_t y, x;
    uint32_t at;
    auto operator<=>(const Key&) const = default;
  };
  const auto keyOf = [&](uint32_t k) {
    const Element& e = elements[k];
    const bool has_position = placed && e.placed;
    return Key{e.kind == ElementKind::Continuation ? 0 : e.network, has_position ? e.y : 0, has_position ? e.x : 0, k};
  };
  std::vector<Key> network_key(elements.size(), Key{UINT32_MAX, INT32_MAX, INT32_MAX, UINT32_MAX});
  for (uint32_t k = 0; k < elements.size(); ++k) {
    if (isRail(elements[k].kind) || elements[k].kind == ElementKind::Comment || isLink(k)) continue;
    network_key[network[k]] = std::min(network_key[network[k]], keyOf(k));
  }
  struct Root {
    uint32_t order;
    Key network;
    Key own;
  };
  std::vector<Root> sorted;
  for (uint32_t k = 0; k < elements.size(); ++k) {
    if (!acts(elements[k])) continue;
    const uint32_t order = elements[k].order;
    sorted.push_back({order != 0 ? order : UINT32_MAX, network_key[network[k]], keyOf(k)});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Root& a, const Root& b) {
    if (a.order != b.order) return a.order < b.order;
    if (a.network != b.network) return a.network < b.network;
    return a.own < b.own;
  });
  roots.clear();
  for (const Root& root : sorted) roots.push_back(root.own.at);
}

// Forbids an execution order number that two elements have. TM/TP manual 5.6.
//   fails   two outputs with ORDER 3        E1017
void Graph::checkExecutionOrder() {
  for (size_t k = 1; k < roots.size(); ++k) {
    const Element& before = elements[roots[k - 1]];
    const Element& e = elements[roots[k]];
    if (e.order == 0 || e.order != before.order) continue;
    diagnostics_->report(diag::DuplicateExecutionOrder, e.loc, {std::to_string(e.order)}).declaredHere(before.loc);
  }
}

// Excludes the elements of disabled networks.
void Graph::exclude(const Diagram& diagram) {
  for (Element& e : elements) {
    if (e.network == 0 || e.network > diagram.networks.count) continue;
    if (!tree_->list(diagram.networks)[e.network - 1].disabled) continue;
    e.kind = ElementKind::Comment;
    e.pins = {};
    e.negated = false;
    e.edge = EdgeKind::None;
    e.storage = PinStorage::None;
  }
}

bool Graph::build(const Tree& tree, const Names& names, Diagnostics& diagnostics, const Diagram& diagram,
                  const NetworkVariables& variables) {
  tree_ = &tree;
  names_ = &names;
  diagnostics_ = &diagnostics;
  elements.clear();
  for (const DiagramElement& e : tree.list(diagram.elements))
    elements.push_back({e, variables.hidden(e), variables.stored(e)});
  exclude(diagram);
  if (!connect()) return false;
  separate();
  sortRoots();
  orderLoops();
  checkExecutionOrder();
  return true;
}

}  // namespace rung::diagram

// SPDX-License-Identifier: Apache-2.0
// What a monitor needs to show networks running: which element is where, what it reads or writes, and where the value
// of each wire is found. The value of a wire is that of its source when this is a variable or a pin of an instance,
// else that of a target that keeps it. Where neither is, a monitor concludes it from the power rail and the contacts.
#include <algorithm>

#include "frontend/render/network_plan.h"

namespace rung::picture {
namespace {

const char* wordOf(EdgeKind edge) {
  return edge == EdgeKind::None ? "" : edge == EdgeKind::Rising ? "rising" : "falling";
}
const char* wordOf(PinStorage storage) {
  return storage == PinStorage::None ? "" : storage == PinStorage::Set ? "set" : "reset";
}
const char* yesIf(bool condition) { return condition ? "true" : ""; }

std::string numberOf(const DiagramElement& e) { return std::to_string(e.number); }

// Where the value at one end of a wire is found.
struct LivePath {
  std::string path;
  bool is_negated = false;  // the wire has the negation of it
};

class EndPaths {
 public:
  EndPaths(const Body& body, const Plan& plan) : body_(body), plan_(plan) {}

  LivePath of(const End& end) const {
    const Item& item = plan_.items[end.item];
    if (item.element == kNone) return {};
    const DiagramElement& e = body_.elements[item.element];
    const Terminal& terminal = item.terminals[end.terminal];
    const bool keeps = e.edge == EdgeKind::None && e.storage == PinStorage::None;
    if (e.kind == ElementKind::Box) return pinOf(e, terminal);
    const bool is_source = e.kind == ElementKind::Input || (e.kind == ElementKind::InOut && terminal.output);
    const bool is_target = !terminal.output && (e.kind == ElementKind::Output || e.kind == ElementKind::InOut ||
                                                e.kind == ElementKind::Coil);
    if (!(is_source || is_target) || !keeps || !e.operand) return {};
    return {(*body_.path_of)(e.operand), e.negated};
  }

  bool isInput(const End& end) const {
    const uint32_t element = plan_.items[end.item].element;
    return element != kNone && body_.elements[element].kind == ElementKind::Input;
  }

  // `rail`, `5` or `5:Q`; empty: a rail that ends wires.
  std::string nameOf(const End& end) const {
    const Item& item = plan_.items[end.item];
    if (item.element == kNone) return {};
    const DiagramElement& e = body_.elements[item.element];
    if (e.kind == ElementKind::Rail) return "rail";
    if (isRail(e.kind)) return {};
    const std::string_view pin = body_.names.string(item.terminals[end.terminal].name);
    return numberOf(e) + (pin.empty() ? "" : ":") + std::string(pin);
  }

 private:
  LivePath pinOf(const DiagramElement& e, const Terminal& terminal) const {
    const std::string_view pin = body_.names.string(terminal.name);
    if (!e.operand || pin.empty()) return {};
    const DiagramPin* const modifiers = terminal.pin == kNone ? nullptr : &body_.tree.list(e.pins)[terminal.pin];
    if (modifiers != nullptr && (modifiers->edge != EdgeKind::None || modifiers->storage != PinStorage::None))
      return {};
    const std::string instance = (*body_.path_of)(e.operand);
    if (instance.empty()) return {};
    return {instance + "." + std::string(pin), modifiers != nullptr && modifiers->negated};
  }

  const Body& body_;
  const Plan& plan_;
};

}  // namespace

std::vector<Svg::Attribute> liveAttributes(const Body& body, const DiagramElement& e) {
  const std::string number = numberOf(e);
  return {{"id", elementId(e.number)},
          {"data-element", number},
          {"data-kind", std::string(kElementWords[static_cast<size_t>(e.kind)])},
          {"data-path", e.operand ? (*body.path_of)(e.operand) : std::string()},
          {"data-negated", yesIf(e.negated)},
          {"data-edge", wordOf(e.edge)},
          {"data-storage", wordOf(e.storage)}};
}

std::vector<Svg::Attribute> liveAttributes(const Body& body, const Plan& plan, const Net& net) {
  const EndPaths paths(body, plan);
  LivePath found;
  // Several sources are joined by OR, so the value of one is not that of the wire. A literal needs none.
  const bool is_single = net.sources.size() == 1;
  if (is_single) found = paths.of(net.sources[0]);
  if (!is_single || !paths.isInput(net.sources[0]))
    for (size_t i = 0; i < net.targets.size() && found.path.empty(); ++i) found = paths.of(net.targets[i]);
  std::string from, to;
  for (const auto& [ends, names] : {std::pair{&net.sources, &from}, std::pair{&net.targets, &to}})
    for (const End& end : *ends)
      if (const std::string name = paths.nameOf(end); !name.empty()) *names += (names->empty() ? "" : " ") + name;
  const Point at = net.sources.empty() ? Point{} : plan.point(net.sources[0]);
  return {{"data-from", from},
          {"data-to", to},
          {"data-path", found.path},
          {"data-negated", yesIf(found.is_negated)},
          {"data-x", std::to_string(at.x)},
          {"data-y", std::to_string(at.y)}};
}

std::vector<Net> openOutputs(const Body& body, const Plan& plan) {
  std::vector<Net> open;
  for (uint32_t i = 0; i < plan.items.size(); ++i) {
    const Item& item = plan.items[i];
    if (item.element == kNone || body.elements[item.element].kind != ElementKind::Box) continue;
    for (uint32_t t = 0; t < item.terminals.size(); ++t) {
      const End end{i, t};
      const bool is_wired = std::any_of(plan.nets.begin(), plan.nets.end(), [&](const Net& net) {
        return std::find(net.sources.begin(), net.sources.end(), end) != net.sources.end();
      });
      if (item.terminals[t].output && !is_wired) open.push_back({{end}, {}, {}, {}});
    }
  }
  return open;
}

}  // namespace rung::picture

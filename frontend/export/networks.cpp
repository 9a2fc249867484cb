// SPDX-License-Identifier: Apache-2.0
// Networks as TC6 elements: <LD>, <FBD>, and a <CFC> in addData; see exporter.h. Elements keep their order and, if they
// have one, their position; others are arranged in rows, one for each element with an effect, in source order.
#include <algorithm>
#include <unordered_set>
#include <vector>

#include "frontend/export/diagnostics.h"
#include "frontend/export/exporter.h"
#include "frontend/import/plcopen/networks.h"
#include "frontend/syntax/box_outputs.h"
#include "frontend/syntax/diagram.h"

namespace rung::exporter {
namespace {

constexpr int kElementRow = 40, kElementColumn = 120;

std::string_view elementName(ElementKind kind) {
  switch (kind) {
    case ElementKind::Rail: return "leftPowerRail";
    case ElementKind::RightRail: return "rightPowerRail";
    case ElementKind::Contact: return "contact";
    case ElementKind::Coil: return "coil";
    case ElementKind::Box:
    case ElementKind::Execute: return "block";
    case ElementKind::Input: return "inVariable";
    case ElementKind::Output: return "outVariable";
    case ElementKind::InOut: return "inOutVariable";
    case ElementKind::Connector: return "connector";
    case ElementKind::Continuation: return "continuation";
    case ElementKind::Jump: return "jump";
    case ElementKind::Label: return "label";
    case ElementKind::Return: return "return";
    case ElementKind::Compose:
    case ElementKind::Select: return "vendorElement";
    case ElementKind::Comment: return "comment";
  }
  return {};
}

bool isLadder(ElementKind kind) {
  return kind == ElementKind::Rail || kind == ElementKind::RightRail || kind == ElementKind::Contact ||
         kind == ElementKind::Coil;
}

class NetworkExport {
 public:
  NetworkExport(Export& to, const Diagram& diagram)
      : to_(to),
        diagram_(diagram),
        elements_(to.tree.list(diagram.elements)),
        unlisted_(unlistedOutputs(to.tree, to.names, elements_)) {}

  void run();

 private:
  struct Position {
    int64_t x, y;
  };
  void number();
  void computePositions();
  bool isLeftOut(const DiagramElement& e) const;
  void network(uint32_t network);
  void element(uint32_t k);
  void attributes(const DiagramElement& e);
  void content(const DiagramElement& e);
  void pins(const DiagramElement& e);
  void pinList(std::string_view list, const DiagramElement& e, PinDirection direction,
               std::span<const NameId> unlisted = {});
  void modifiers(bool negated, EdgeKind edge, PinStorage storage, std::string_view suffix = {});
  void wires(const DiagramPin& pin);
  void input(const DiagramElement& e);
  void data(const DiagramElement& e);
  std::string pathOf(ExprId path) const;
  std::string operand(const DiagramElement& e) const;
  std::string statements(const DiagramElement& e) const;

  Export& to_;
  const Diagram& diagram_;
  std::span<const DiagramElement> elements_;
  std::vector<std::vector<NameId>> unlisted_;  // by element: outputs that wires name but no pin does
  std::vector<uint64_t> numbers_;              // by element
  std::vector<Position> positions_;            // by element
  std::vector<uint64_t> titles_;               // by network: the number of the element that shows its title
};

bool NetworkExport::isLeftOut(const DiagramElement& e) const {
  return e.network != 0 && to_.tree.list(diagram_.networks)[e.network - 1].disabled;
}

// The numbers of elements contain the number of their network; those that would denote another network are replaced.
void NetworkExport::number() {
  std::vector<uint64_t> networks{0};
  for (const DiagramNetwork& n : to_.tree.list(diagram_.networks))
    networks.push_back(n.number > networks.back() ? n.number : networks.back() + 1);
  std::vector<uint64_t> next;
  next.reserve(networks.size());
  for (const uint64_t n : networks) next.push_back(n * importer::plcopen::kNumbersPerNetwork + 1);
  titles_.resize(networks.size());
  std::unordered_set<uint64_t> taken;
  numbers_.resize(elements_.size());
  for (size_t k = 0; k < elements_.size(); ++k) {
    const DiagramElement& e = elements_[k];
    if (e.number / importer::plcopen::kNumbersPerNetwork != networks[e.network]) continue;
    numbers_[k] = e.number;
    taken.insert(e.number);
  }
  const auto fresh = [&](uint32_t network) {
    while (!taken.insert(next[network]).second) ++next[network];
    return next[network];
  };
  for (size_t k = 0; k < elements_.size(); ++k)
    if (elements_[k].number / importer::plcopen::kNumbersPerNetwork != networks[elements_[k].network])
      numbers_[k] = fresh(elements_[k].network);
  for (uint32_t n = 1; n < networks.size(); ++n) titles_[n] = fresh(n);
}

// If some elements have a position, the others get none: an invented one would change the execution order.
void NetworkExport::computePositions() {
  positions_.resize(elements_.size(), {0, 0});
  const bool any = std::any_of(elements_.begin(), elements_.end(), [](const DiagramElement& e) { return e.placed; });
  std::vector<uint32_t> depth(elements_.size(), 0), rows;
  int64_t row = 0;
  for (uint32_t k = 0; k < elements_.size(); ++k) {
    const DiagramElement& e = elements_[k];
    if (any) {
      if (e.placed) positions_[k] = {e.x, e.y};
      continue;
    }
    for (const DiagramPin& pin : to_.tree.list(e.pins))
      for (const DiagramWire& wire : to_.tree.list(pin.wires))
        if (wire.from < k) depth[k] = std::max(depth[k], depth[wire.from] + 1);
    if (rows.size() <= depth[k]) rows.resize(depth[k] + 1, 0);
    const uint32_t height = 1 + e.pins.count;
    positions_[k] = {static_cast<int64_t>(depth[k]) * kElementColumn, (row + rows[depth[k]]) * kElementRow};
    rows[depth[k]] += height;
    const bool ends = e.kind == ElementKind::Coil || e.kind == ElementKind::Output || e.kind == ElementKind::Box ||
                      e.kind == ElementKind::Execute || e.kind == ElementKind::Jump || e.kind == ElementKind::Return ||
                      e.kind == ElementKind::Label || e.kind == ElementKind::InOut;
    if (!ends) continue;
    row += *std::max_element(rows.begin(), rows.end());
    rows.clear();
  }
}

std::string NetworkExport::pathOf(ExprId path) const {
  if (!path) return {};
  if (to_.tree.kind(path) == ExprKind::Name) return std::string(to_.string(to_.tree.as<NameExpr>(path).name));
  const auto& member = to_.tree.as<MemberExpr>(path);
  return pathOf(member.base) + "." + std::string(to_.string(member.member));
}

// The source between the parentheses of the element.
std::string NetworkExport::operand(const DiagramElement& e) const {
  if (!e.operand) return {};
  const SourceText::Span span =
      to_.source->parenthesesAround(to_.source->at(e.loc), to_.source->at(to_.tree.begin(e.operand)));
  std::string_view text = to_.source->cut(span.begin, span.end);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  return std::string(text);
}

// The statements of an execute box, between {network ST} and {end_network}.
std::string NetworkExport::statements(const DiagramElement& e) const {
  const std::string_view text = to_.source->cut(to_.source->at(e.loc), to_.source->at(e.end));
  size_t begin = text.rfind("{network");
  begin = begin == std::string_view::npos ? text.size() : text.find('}', begin) + 1;
  return std::string(text.substr(begin, std::min(text.rfind("{end_network"), text.size()) - begin));
}

void NetworkExport::modifiers(bool negated, EdgeKind edge, PinStorage storage, std::string_view suffix) {
  const std::string end(suffix);
  if (negated) to_.xml.attribute("negated" + end, "true");
  if (edge != EdgeKind::None) to_.xml.attribute("edge" + end, edge == EdgeKind::Rising ? "rising" : "falling");
  if (storage != PinStorage::None) to_.xml.attribute("storage" + end, storage == PinStorage::Set ? "set" : "reset");
}

void NetworkExport::wires(const DiagramPin& pin) {
  to_.xml.open("connectionPointIn");
  for (const DiagramWire& wire : to_.tree.list(pin.wires)) {
    to_.xml.open("connection").attribute("refLocalId", std::to_string(numbers_[wire.from]));
    if (wire.pin.name) to_.xml.attribute("formalParameter", to_.string(wire.pin.name));
    to_.xml.close();
  }
  to_.xml.close();
}

void NetworkExport::input(const DiagramElement& e) {
  for (const DiagramPin& pin : to_.tree.list(e.pins))
    if (pin.direction != PinDirection::Output) wires(pin);
}

void NetworkExport::pinList(std::string_view list, const DiagramElement& e, PinDirection direction,
                            std::span<const NameId> unlisted) {
  to_.xml.open(list);
  for (const DiagramPin& pin : to_.tree.list(e.pins)) {
    if (pin.direction != direction) continue;
    to_.xml.open("variable").attribute("formalParameter", to_.string(pin.name.name));
    modifiers(pin.negated, pin.edge, pin.storage);
    if (direction != PinDirection::Output) wires(pin);
    if (direction != PinDirection::Input) to_.xml.leaf("connectionPointOut");
    to_.xml.close();
  }
  for (const NameId output : unlisted) {
    to_.xml.open("variable").attribute("formalParameter", output ? to_.string(output) : "");
    to_.xml.leaf("connectionPointOut");
    to_.xml.close();
  }
  to_.xml.close();
}

void NetworkExport::pins(const DiagramElement& e) {
  pinList("inputVariables", e, PinDirection::Input);
  pinList("inOutVariables", e, PinDirection::InOut);
  pinList("outputVariables", e, PinDirection::Output, unlisted_[static_cast<size_t>(&e - elements_.data())]);
}

// Vendor-specific data.
void NetworkExport::data(const DiagramElement& e) {
  AddData data(to_);
  if (e.kind == ElementKind::Execute) {
    data.open("stcode");
    to_.xml.element("STCode", statements(e));
    data.close();
  }
  if (e.kind == ElementKind::Compose || e.kind == ElementKind::Select) {
    data.open("cfcelementtype");
    to_.xml.element("ElementType", e.kind == ElementKind::Compose ? "composer" : "selector");
    data.close();
  }
  const bool leaves = e.kind == ElementKind::Jump || e.kind == ElementKind::Return;
  if ((leaves && e.edge != EdgeKind::None) ||
      (e.kind == ElementKind::Connector && (e.negated || e.edge != EdgeKind::None))) {
    data.openOwn();
    to_.xml.open("wire");
    modifiers(e.negated, e.edge, PinStorage::None);
    to_.xml.close();
    data.close();
  } else if (leaves && e.negated) {
    data.open("negated");
    to_.xml.open("negated").attribute("value", "true").close();
    data.close();
  }
  if (e.holding) {
    data.openOwn();
    to_.xml.open("coil").attribute("holding", "true").close();
    data.close();
  }
}

void NetworkExport::element(uint32_t k) {
  const DiagramElement& e = elements_[k];
  const bool structure = e.kind == ElementKind::Compose || e.kind == ElementKind::Select;
  to_.xml.open(elementName(e.kind)).attribute("localId", std::to_string(numbers_[k]));
  attributes(e);
  to_.xml.open("position")
      .attribute("x", std::to_string(positions_[k].x))
      .attribute("y", std::to_string(positions_[k].y))
      .close();
  if (structure) to_.xml.formatted("alternativeText", pathOf(e.path));
  if (structure || e.kind == ElementKind::Box || e.kind == ElementKind::Execute)
    pins(e);
  else
    input(e);
  content(e);
  data(e);
  to_.xml.close();
}

void NetworkExport::attributes(const DiagramElement& e) {
  const bool linked = e.kind == ElementKind::Connector || e.kind == ElementKind::Continuation;
  const bool sized = e.width != 0 || e.height != 0 || e.kind == ElementKind::Comment;
  if (sized) to_.xml.attribute("height", std::to_string(e.height)).attribute("width", std::to_string(e.width));
  if (e.kind == ElementKind::Box || e.kind == ElementKind::Execute) {
    to_.xml.attribute("typeName", e.kind == ElementKind::Execute ? "EXECUTE" : pathOf(e.path));
    if (e.operand) to_.xml.attribute("instanceName", operand(e));
  }
  if (linked) to_.xml.attribute("name", e.name.name ? to_.string(e.name.name) : "");
  if (e.kind == ElementKind::Jump || e.kind == ElementKind::Label) to_.xml.attribute("label", to_.string(e.name.name));
  if (e.order != 0 && !linked && e.kind != ElementKind::Comment)
    to_.xml.attribute("executionOrderId", std::to_string(e.order));
  if (e.kind == ElementKind::Contact || e.kind == ElementKind::Coil || e.kind == ElementKind::Input ||
      e.kind == ElementKind::Output)
    modifiers(e.negated, e.edge, e.storage);
  if (e.kind == ElementKind::InOut) {
    modifiers(e.negated, e.edge, e.storage, "In");
    for (const DiagramPin& pin : to_.tree.list(e.pins))
      if (pin.direction == PinDirection::Output) modifiers(pin.negated, pin.edge, pin.storage, "Out");
  }
}

// Its output, and its variable, expression or text.
void NetworkExport::content(const DiagramElement& e) {
  switch (e.kind) {
    case ElementKind::Rail: to_.xml.open("connectionPointOut").attribute("formalParameter", "").close(); break;
    case ElementKind::Contact:
    case ElementKind::Coil:
      to_.xml.leaf("connectionPointOut");
      to_.xml.element("variable", operand(e));
      break;
    case ElementKind::Input:
    case ElementKind::InOut:
      to_.xml.leaf("connectionPointOut");
      to_.xml.element("expression", operand(e));
      break;
    case ElementKind::Output: to_.xml.element("expression", operand(e)); break;
    case ElementKind::Continuation: to_.xml.leaf("connectionPointOut"); break;
    case ElementKind::Comment: to_.xml.formatted("content", to_.tree.string({e.comment, e.comment_length})); break;
    case ElementKind::RightRail:
    case ElementKind::Box:
    case ElementKind::Connector:
    case ElementKind::Jump:
    case ElementKind::Label:
    case ElementKind::Return:
    case ElementKind::Execute:
    case ElementKind::Compose:
    case ElementKind::Select: break;
  }
}

// The start of a network: its title, or the warning that it is omitted.
void NetworkExport::network(uint32_t index) {
  const DiagramNetwork& n = to_.tree.list(diagram_.networks)[index - 1];
  if (n.disabled) {
    to_.diagnostics.report(diag::XmlNetworkSkipped, n.loc, {std::to_string(n.number)});
    return;
  }
  if (n.title_length == 0) return;
  to_.xml.open("vendorElement").attribute("localId", std::to_string(titles_[index]));
  to_.xml.open("position").attribute("x", "0").attribute("y", "0").close();
  to_.xml.formatted("alternativeText", to_.tree.string({n.title, n.title_length}));
  {
    AddData data(to_);
    data.open("fbdelementtype");
    to_.xml.element("ElementType", "networktitle");
    data.close();
  }
  to_.xml.close();
}

void NetworkExport::run() {
  number();
  computePositions();
  const bool cfc = diagram_.language == NetworkLanguage::Continuous;
  const bool ladder =
      diagram_.language == NetworkLanguage::Ladder ||
      std::any_of(elements_.begin(), elements_.end(), [](const DiagramElement& e) { return isLadder(e.kind); });
  if (cfc) {
    to_.xml.formatted("ST", "");
    to_.xml.open("addData");
    to_.openVendorData("cfc");
  }
  to_.xml.open(cfc ? "CFC" : ladder ? "LD" : "FBD");
  uint32_t seen = 0;
  for (uint32_t k = 0; k < elements_.size(); ++k) {
    while (seen < elements_[k].network) network(++seen);
    if (!isLeftOut(elements_[k])) element(k);
  }
  while (seen < diagram_.networks.count) network(++seen);
  to_.xml.close();
  if (!cfc) return;
  to_.xml.close();
  to_.xml.close();
}

}  // namespace

void exportNetworks(Export& to, const Diagram& diagram) { NetworkExport(to, diagram).run(); }

}  // namespace rung::exporter

// SPDX-License-Identifier: Apache-2.0
// Networks; see networks.h. Elements keep their localId as number, so that the parser resolves wires and reports errors
// in them, at their locations in the XML.
#include "frontend/import/plcopen/networks.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/import.h"
#include "frontend/source/names.h"
#include "frontend/syntax/standard_names.h"

namespace rung::importer::plcopen {
namespace {

constexpr int32_t kVariableGap = 40;  // from a box to the variable at its output
// Numbers for elements without a localId, larger than those of editors.
constexpr uint64_t kOwnNumbers = 9'000'000'000'000'000'000u;

struct Row {
  std::string_view name;
  ElementKind kind;
};
constexpr Row kRows[] = {{"leftPowerRail", ElementKind::Rail},
                         {"rightPowerRail", ElementKind::RightRail},
                         {"contact", ElementKind::Contact},
                         {"coil", ElementKind::Coil},
                         {"block", ElementKind::Box},
                         {"inVariable", ElementKind::Input},
                         {"outVariable", ElementKind::Output},
                         {"inOutVariable", ElementKind::InOut},
                         {"connector", ElementKind::Connector},
                         {"continuation", ElementKind::Continuation},
                         {"jump", ElementKind::Jump},
                         {"label", ElementKind::Label},
                         {"return", ElementKind::Return},
                         {"comment", ElementKind::Comment},
                         {"actionBlock", ElementKind::Output},
                         {"step", ElementKind::Input},
                         {"vendorElement", ElementKind::Compose}};

// TON and TOF by their symbols, T---0 and 0---T. IEC 61131-3 ed. 3 table 46, 2d and 3d.
std::string_view timerOf(std::string_view symbol) {
  if (symbol.size() < 3 || symbol.find_first_not_of('-', 1) != symbol.size() - 1) return {};
  if (symbol.front() == 'T' && symbol.back() == '0') return "TON";
  return symbol.front() == '0' && symbol.back() == 'T' ? "TOF" : std::string_view{};
}

bool hasWires(ElementKind kind) {
  return kind != ElementKind::Rail && kind != ElementKind::Input && kind != ElementKind::Comment &&
         kind != ElementKind::Continuation;
}

class DiagramReader {
 public:
  explicit DiagramReader(Reading& reading)
      : reading_(reading), document_(reading.document), out_(reading.out), writer_(reading.out) {}

  void readBody(const DrawnBody& diagram);
  void readCondition(const DrawnBody& diagram);

 private:
  void collect(const Element& body);
  void read(const Element& e);
  void readActions(const Element& body);
  void readNetworkOf(const Element& e);
  bool readKind(const Element& e, NetworkElement& out) const;
  void readParts(const Element& e, NetworkElement& out) const;
  void readBox(const Element& e, NetworkElement& out) const;
  void readBoxName(const Element& e, NetworkElement& out) const;
  void readPins(const Element& e, NetworkElement& out) const;
  std::vector<WireSource> wiresOf(const Element* point, std::string_view reader = {}) const;
  std::vector<WireSource> wiresOfRail(const Element& rail) const;
  void beginNetwork(Loc loc, uint64_t network);
  bool isTitle(const Element& e) const;
  void writeVariablesAtOutputs(const Element& box, const xml::Excerpt& number);
  std::vector<WireSource> wiresOfInput(const Element& pin) const;
  const Element* sourceOf(const Element& connection) const;
  xml::Excerpt sourcePin(const Element& connection, std::string_view reader) const;
  xml::Excerpt operandOf(const Element& e) const;
  xml::Excerpt valueOf(const Element& e, std::string_view attribute) const;
  Modifiers modifiersOf(const Element& e, std::string_view suffix = {}) const;
  void readInOut(const Element& e, NetworkElement& out) const;
  uint64_t orderOf(const Element& e) const;
  xml::Excerpt idOf(const Element& e);

  std::string value(const Element& e, std::string_view name) const { return document_.value(e, name); }
  uint64_t numberOf(const Element& e) const;
  bool negatedByVendor(const Element& e) const;
  std::string onlyOutput(const Element& box, bool first = false) const;
  bool hasOutput(const Element& box, std::string_view pin) const;

  Reading& reading_;
  const xml::Document& document_;
  xml::SourceMappedText& out_;
  NetworkWriter writer_;
  std::unordered_map<uint64_t, const Element*> by_number_;
  std::vector<const Element*> elements_;
  std::map<uint64_t, std::string> titles_;  // by network, without empty ones
  uint64_t network_ = 0;                    // current network, derived from element numbers (CODESYS)
  uint64_t next_own_ = kOwnNumbers;
  bool counts_from_zero_ = false;  // executionOrderId 0 is a valid number
};

const Row* rowOf(const Element& e) {
  const auto* found =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& row) { return row.name == e.name; });
  return found == std::end(kRows) ? nullptr : found;
}

uint64_t DiagramReader::numberOf(const Element& e) const {
  const std::string text = value(e, "localId");
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? number : UINT64_MAX;
}

// Bachmann writes the negation of jumps and returns in addData.
bool DiagramReader::negatedByVendor(const Element& e) const {
  const Element* negated = dataOf(reading_, e, "negated");
  return negated != nullptr && isTrue(reading_, *negated, "value");
}

void DiagramReader::collect(const Element& body) {
  std::vector<uint64_t> execution_orders;
  for (const Element& e : document_.children(body)) {
    if (rowOf(e) == nullptr) continue;
    if (isTitle(e)) {
      const Element* text = document_.child(e, "alternativeText");
      const std::string title = text == nullptr ? std::string() : document_.text(*text, reading_.sources);
      const uint64_t number = numberOf(e);
      if (number != UINT64_MAX && !isBlank(title)) titles_.emplace(number / kNumbersPerNetwork, trimmed(title));
    }
    by_number_.emplace(numberOf(e), &e);
    if (e.name == "step") continue;
    elements_.push_back(&e);
    const bool acts =
        e.name == "block" || e.name == "outVariable" || e.name == "jump" || e.name == "return" || e.name == "label";
    uint64_t execution_order = 0;
    const std::string order = value(e, "executionOrderId");
    if (acts && std::from_chars(order.data(), order.data() + order.size(), execution_order).ec == std::errc{})
      execution_orders.push_back(execution_order);
  }
  // Editors that number every element begin with 0; in others 0 means no number.
  std::sort(execution_orders.begin(), execution_orders.end());
  counts_from_zero_ = execution_orders.size() > 1 && execution_orders[0] == 0;
  for (size_t k = 1; k < execution_orders.size(); ++k)
    counts_from_zero_ = counts_from_zero_ && execution_orders[k] > execution_orders[k - 1];
}

bool DiagramReader::hasOutput(const Element& box, std::string_view pin) const {
  for (const char* list : {"outputVariables", "inOutVariables"})
    for (const Element& p : document_.children(document_.child(box, list)))
      if (sameIdentifier(value(p, "formalParameter"), pin)) return true;
  return false;
}

// The only output of a box besides ENO, or the first one; else empty.
std::string DiagramReader::onlyOutput(const Element& box, bool first) const {
  std::string only;
  int count = 0;
  for (const Element& p : document_.children(document_.child(box, "outputVariables"))) {
    const std::string name = value(p, "formalParameter");
    if (isEnableOutput(name)) continue;
    if (first) return name;
    only = name;
    ++count;
  }
  return count == 1 ? only : std::string();
}

xml::Excerpt DiagramReader::idOf(const Element& e) {
  const xml::Attribute* number = document_.attribute(e, "localId");
  if (number != nullptr && numberOf(e) != UINT64_MAX) return {document_, *number};
  return {e.loc, std::to_string(next_own_++)};
}

const Element* DiagramReader::sourceOf(const Element& connection) const {
  uint64_t number = 0;
  const std::string text = value(connection, "refLocalId");
  std::from_chars(text.data(), text.data() + text.size(), number);
  const auto found = by_number_.find(number);
  return found == by_number_.end() ? nullptr : found->second;
}

// The output of a box that the wire comes from. CODESYS names the variable of the coil that reads it where it means the
// first output.
xml::Excerpt DiagramReader::sourcePin(const Element& connection, std::string_view reader) const {
  const Element* const source = sourceOf(connection);
  if (source == nullptr || (source->name != "block" && source->name != "vendorElement")) return {};
  const xml::Attribute* pin = document_.attribute(connection, "formalParameter");
  const std::string name = pin == nullptr ? std::string() : document_.decoded(*pin);
  if (isIdentifier(name) && hasOutput(*source, name)) return {document_, *pin};
  if (const std::string only = onlyOutput(*source); isIdentifier(only)) return xml::Excerpt(only);
  if (!reader.empty() && sameIdentifier(name, reader))
    if (const std::string main = onlyOutput(*source, true); isIdentifier(main)) return xml::Excerpt(main);
  if (isIdentifier(name)) return {document_, *pin};  // the parser or the scheduler reports it at its location
  return {};
}

// The sources of the wires into `point`.
std::vector<WireSource> DiagramReader::wiresOf(const Element* point, std::string_view reader) const {
  std::vector<WireSource> wires;
  for (const Element& c : document_.children(point)) {
    const xml::Attribute* from = c.name == "connection" ? document_.attribute(c, "refLocalId") : nullptr;
    if (from != nullptr) wires.push_back({{document_, *from}, sourcePin(c, reader)});
  }
  return wires;
}

// Warns of an input whose wire starts nowhere: OpenPLC Editor 4 draws an empty box for each input that is not used,
// and does not save the box. Its compiler leaves such inputs out of the call.
//   warns  <connection refLocalId="99"/>, without an element 99          W1094
std::vector<WireSource> DiagramReader::wiresOfInput(const Element& pin) const {
  const Element* const point = document_.child(pin, "connectionPointIn");
  std::vector<WireSource> wires = wiresOf(point);
  if (wires.size() != 1) return wires;
  const Element& connection = *document_.child(*point, "connection");
  const xml::Attribute* const from = document_.attribute(connection, "refLocalId");
  if (from == nullptr || sourceOf(connection) != nullptr) return wires;
  reading_.diagnostics.report(diag::XmlInputFromNothing, from->loc, {value(pin, "formalParameter"), from->raw})
      .length(static_cast<uint32_t>(from->raw.size()));
  return {};
}

Modifiers DiagramReader::modifiersOf(const Element& e, std::string_view suffix) const {
  const std::string end(suffix);
  return {isTrue(reading_, e, "negated" + end), edgeOf(value(e, "edge" + end)), storageOf(value(e, "storage" + end))};
}

// A variable that is written and read has modifiers for both.
void DiagramReader::readInOut(const Element& e, NetworkElement& out) const {
  out.operand = operandOf(e);
  out.modifiers = modifiersOf(e, "In");
  const Modifiers read = modifiersOf(e, "Out");
  if (!read.negated && read.edge == EdgeKind::None && read.storage == PinStorage::None) return;
  NetworkPin& pin = out.pins.emplace_back();
  pin.name = {e.loc, "OUT"};
  pin.direction = PinDirection::Output;
  pin.modifiers = read;
}

uint64_t DiagramReader::orderOf(const Element& e) const {
  uint64_t order = 0;
  const std::string text = value(e, "executionOrderId");
  if (std::from_chars(text.data(), text.data() + text.size(), order).ec != std::errc{}) return 0;
  return counts_from_zero_ ? order + 1 : order;
}

xml::Excerpt DiagramReader::operandOf(const Element& e) const {
  const Element* text = document_.child(e, "expression");
  if (text == nullptr) text = document_.child(e, "variable");
  return text == nullptr ? xml::Excerpt() : xml::Excerpt(document_, *text);
}

xml::Excerpt DiagramReader::valueOf(const Element& e, std::string_view attribute) const {
  const xml::Attribute* found = document_.attribute(e, attribute);
  return found == nullptr || found->raw.empty() ? xml::Excerpt() : xml::Excerpt(document_, *found);
}

void DiagramReader::readPins(const Element& e, NetworkElement& out) const {
  struct List {
    const char* name;
    PinDirection direction;
  };
  out.has_pins = true;
  for (const List list : {List{"inputVariables", PinDirection::Input}, List{"inOutVariables", PinDirection::InOut},
                          List{"outputVariables", PinDirection::Output}}) {
    size_t count = 0;
    for (const Element& p : document_.children(document_.child(e, list.name))) {
      if (p.name != "variable") continue;
      NetworkPin& pin = out.pins.emplace_back();
      const xml::Attribute* name = document_.attribute(p, "formalParameter");
      const std::string spelling = name == nullptr ? std::string() : document_.decoded(*name);
      if (!isControl(spelling)) ++count;
      if (isIdentifier(spelling))
        pin.name = {document_, *name};
      else
        pin.name = {p.loc, unnamedPin(list.direction, count)};
      pin.direction = list.direction;
      pin.modifiers = modifiersOf(p);
      if (list.direction == PinDirection::Input) pin.wires = wiresOfInput(p);
      if (list.direction == PinDirection::InOut) pin.wires = wiresOf(document_.child(p, "connectionPointIn"));
    }
  }
}

// The callee of the box, and its instance. A method is called through its instance.
void DiagramReader::readBoxName(const Element& e, NetworkElement& out) const {
  const xml::Attribute* type = document_.attribute(e, "typeName");
  const std::string type_name = value(e, "typeName"), instance_name = value(e, "instanceName");
  std::string call_type;
  for (const char* kind : {"fbdcalltype", "cfccalltype", "ldcalltype"})
    if (const Element* call = dataOf(reading_, e, kind)) call_type = document_.text(*call, reading_.sources);
  const bool member = call_type == "method" || call_type == "action";
  if (member && isPath(instance_name) && isPath(type_name)) {
    out.name = {type->loc, instance_name + "." + type_name.substr(type_name.rfind('.') + 1)};
    return;
  }
  if (const std::string_view timer = timerOf(type_name); !timer.empty())
    out.name = {type->loc, std::string(timer)};
  else if (!type_name.empty())
    out.name = {document_, *type};
  if (!instance_name.empty()) out.operand = {document_, *document_.attribute(e, "instanceName")};
}

void DiagramReader::readBox(const Element& e, NetworkElement& out) const {
  const Element* st = dataOf(reading_, e, "stcode");
  if (sameIdentifier(value(e, "typeName"), "EXECUTE") && st != nullptr) {
    out.kind = ElementKind::Execute;
    out.statements = {document_, *st};
  } else {
    readBoxName(e, out);
  }
  readPins(e, out);
}

// A title begins a network, and so does an element number in the next range of ten thousand million (CODESYS).
void DiagramReader::readNetworkOf(const Element& e) {
  const uint64_t number = numberOf(e);
  if (number == UINT64_MAX || number < kNumbersPerNetwork) return;
  const uint64_t network = number / kNumbersPerNetwork;
  if (network == network_ || network > UINT32_MAX) return;
  beginNetwork(e.loc, network);
}

void DiagramReader::beginNetwork(Loc loc, uint64_t network) {
  network_ = network;
  const auto title = titles_.find(network);
  const uint64_t first = titles_.count(0);  // the title of the first network has a number below ten thousand million
  writer_.beginNetwork(loc, network + first, false, title == titles_.end() ? std::string_view{} : title->second);
}

bool DiagramReader::isTitle(const Element& e) const {
  const Element* type = e.name == "vendorElement" ? dataOf(reading_, e, "fbdelementtype") : nullptr;
  return type != nullptr && document_.text(*type, reading_.sources) == "networktitle";
}

// Elements of CODESYS other than those of TC6. False: they are not part of the network.
bool DiagramReader::readKind(const Element& e, NetworkElement& out) const {
  if (e.name != "vendorElement") return true;
  const Element* type = dataOf(reading_, e, "fbdelementtype");
  if (type == nullptr) type = dataOf(reading_, e, "cfcelementtype");
  const std::string what = type == nullptr ? std::string() : document_.text(*type, reading_.sources);
  if (what == "selector") out.kind = ElementKind::Select;
  return what == "composer" || what == "selector";
}

// The parts that depend on the kind of element.
void DiagramReader::readParts(const Element& e, NetworkElement& out) const {
  switch (out.kind) {
    case ElementKind::Box: return readBox(e, out);
    case ElementKind::Compose:
    case ElementKind::Select:
      if (const Element* name = document_.child(e, "alternativeText")) out.name = {document_, *name};
      return readPins(e, out);
    case ElementKind::Comment:
      if (const Element* content = document_.child(e, "content"))
        out.comment = document_.text(*content, reading_.sources);
      return;
    case ElementKind::Label:
    case ElementKind::Jump: out.name = labelOf(valueOf(e, "label"), value(e, "label")); break;
    case ElementKind::Connector:
    case ElementKind::Continuation: out.name = connectorOf(valueOf(e, "name"), value(e, "name")); break;
    case ElementKind::Contact:
    case ElementKind::Coil:
    case ElementKind::Input:
    case ElementKind::Output:
      out.operand = operandOf(e);
      out.modifiers = modifiersOf(e);
      break;
    case ElementKind::InOut: readInOut(e, out); break;
    case ElementKind::Rail:
    case ElementKind::RightRail:
    case ElementKind::Return:
    case ElementKind::Execute: break;
  }
  if (out.kind == ElementKind::Jump || out.kind == ElementKind::Return)
    out.modifiers.negated = isTrue(reading_, e, "negated") || negatedByVendor(e);
  const Element* own = dataOf(reading_, e, "extension");  // exported by Rung
  if (own == nullptr) return;
  out.holding = out.kind == ElementKind::Coil && isTrue(reading_, *own, "holding");
  if (out.kind == ElementKind::Jump || out.kind == ElementKind::Return || out.kind == ElementKind::Connector)
    out.modifiers = modifiersOf(*own);
}

void DiagramReader::read(const Element& e) {
  NetworkElement out(rowOf(e)->kind, e.loc, {});
  if (!readKind(e, out)) return;
  if (e.name != "vendorElement") readNetworkOf(e);
  out.number = idOf(e);
  if (e.name == "step") {
    if (const xml::Attribute* name = document_.attribute(e, "name")) out.operand = {document_, *name};
    out.operand.text = ".X";
    return writer_.write(out);
  }
  if (e.name == "actionBlock")
    out.operand = xml::Excerpt(wireOf(document_, e));
  else
    readParts(e, out);
  if (out.kind != ElementKind::Input) out.order = orderOf(e);
  out.area = areaOf(document_, e);
  if (out.kind == ElementKind::RightRail) {
    out.input = wiresOfRail(e);
  } else if (hasWires(out.kind) && !out.has_pins) {
    const Element* variable = out.kind == ElementKind::Coil ? document_.child(e, "variable") : nullptr;
    out.input = wiresOf(document_.child(e, "connectionPointIn"),
                        variable == nullptr ? std::string() : document_.text(*variable, reading_.sources));
  }
  writer_.write(out);
  if (out.kind == ElementKind::Box) writeVariablesAtOutputs(e, out.number);
}

// The rail has a point for each wire. A wire from nowhere is left out: it does nothing.
std::vector<WireSource> DiagramReader::wiresOfRail(const Element& rail) const {
  std::vector<WireSource> wires;
  for (const Element& point : document_.children(rail)) {
    if (point.name != "connectionPointIn") continue;
    for (const Element& c : document_.children(point)) {
      const xml::Attribute* from = c.name == "connection" ? document_.attribute(c, "refLocalId") : nullptr;
      if (from != nullptr && sourceOf(c) != nullptr) wires.push_back({{document_, *from}, sourcePin(c, {})});
    }
  }
  return wires;
}

// In ladders CODESYS writes the variable at an output into the output itself.
void DiagramReader::writeVariablesAtOutputs(const Element& box, const xml::Excerpt& number) {
  size_t count = 0;
  for (const Element& p : document_.children(document_.child(box, "outputVariables"))) {
    const xml::Attribute* name = document_.attribute(p, "formalParameter");
    const std::string spelling = name == nullptr ? std::string() : document_.decoded(*name);
    if (!isControl(spelling)) ++count;
    const Element* point = document_.child(p, "connectionPointOut");
    const Element* text = point == nullptr ? nullptr : document_.child(*point, "expression");
    if (text == nullptr || document_.text(*text, reading_.sources).empty()) continue;
    NetworkElement variable(ElementKind::Output, text->loc, {text->loc, std::to_string(next_own_++)});
    variable.operand = xml::Excerpt(document_, *text);
    xml::Excerpt pin(unnamedPin(PinDirection::Output, count));
    if (isIdentifier(spelling)) pin = {document_, *name};
    variable.input.push_back({number, pin});
    variable.area = areaOf(document_, box);
    if (variable.area.x != 0 || variable.area.y != 0) {
      variable.area.x += variable.area.width + kVariableGap;
      variable.area.y += static_cast<int32_t>(count) * kVariableGap / 2;
    }
    variable.area.width = variable.area.height = 0;
    writer_.write(variable);
  }
}

// After everything else: below all positions, or in a separate network.
void DiagramReader::readActions(const Element& body) {
  const auto block =
      std::find_if(elements_.begin(), elements_.end(), [](const Element* e) { return e->name == "actionBlock"; });
  if (block == elements_.end()) return;
  const Loc loc = (*block)->loc;
  if (network_ != 0) writer_.beginNetwork(loc, UINT32_MAX);
  NetworkElement calls(ElementKind::Execute, loc, {loc, std::to_string(kOwnNumbers - 2)});
  calls.area.placed = std::any_of(elements_.begin(), elements_.end(),
                                  [&](const Element* e) { return document_.child(*e, "position") != nullptr; });
  calls.area.y = 1'000'000'000;
  writer_.beginStatements(calls);
  writeActionCalls(document_, body, out_);
  writer_.endStatements(loc);
}

void DiagramReader::readBody(const DrawnBody& diagram) {
  collect(diagram.body);
  writer_.beginBody(diagram.body.loc, diagram.language);
  if (titles_.count(0) != 0) beginNetwork(diagram.body.loc, 0);
  for (const Element* e : elements_) read(*e);
  readActions(diagram.body);
  writer_.endBody(diagram.body.end);
}

// Only the elements connected to the condition, in file order.
void DiagramReader::readCondition(const DrawnBody& diagram) {
  collect(diagram.body);
  std::vector<uint64_t> wanted;
  const auto want = [&](const Element* point) {
    for (const Element& c : document_.children(point)) {
      const std::string text = value(c, "refLocalId");
      uint64_t number = 0;
      if (c.name == "connection" && std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc{})
        wanted.push_back(number);
    }
  };
  want(diagram.condition);
  for (const Element* end : diagram.ends) wanted.push_back(numberOf(*end));
  std::unordered_set<uint64_t> seen;
  std::vector<const Element*> used;
  for (size_t k = 0; k < wanted.size(); ++k) {
    const auto found = by_number_.find(wanted[k]);
    if (found == by_number_.end() || !seen.insert(wanted[k]).second) continue;
    used.push_back(found->second);
    const Element& e = *found->second;
    if (e.name == "step") continue;
    want(document_.child(e, "connectionPointIn"));
    for (const char* list : {"inputVariables", "inOutVariables"})
      for (const Element& p : document_.children(document_.child(e, list)))
        want(document_.child(p, "connectionPointIn"));
  }
  std::sort(used.begin(), used.end());
  const Element& begin = diagram.condition != nullptr ? *diagram.condition : *diagram.ends[0];
  writer_.beginBody(begin.loc, NetworkLanguage::Ladder);
  for (const Element* e : used) read(*e);
  if (diagram.condition != nullptr) {
    NetworkElement target(ElementKind::Output, begin.loc, {begin.loc, std::to_string(kOwnNumbers - 1)});
    target.operand = {begin.loc, diagram.target};
    target.input = wiresOf(diagram.condition);
    writer_.write(target);
  }
  writer_.endBody(diagram.condition != nullptr ? begin.end : begin.loc);
}

}  // namespace

Area areaOf(const xml::Document& document, const xml::Element& e) {
  const xml::Element* position = document.child(e, "position");
  if (position == nullptr) return {};
  const auto number = [&](const xml::Element& from, std::string_view name) {
    return coordinateOf(document.value(from, name));
  };
  return {true, number(*position, "x"), number(*position, "y"), number(e, "width"), number(e, "height")};
}

void writeNetworks(Reading& reading, const DrawnBody& diagram) {
  DiagramReader reader(reading);
  if (diagram.condition != nullptr || !diagram.ends.empty())
    reader.readCondition(diagram);
  else
    reader.readBody(diagram);
}

}  // namespace rung::importer::plcopen

// SPDX-License-Identifier: Apache-2.0
// Bodies: ST and IL are copied, LD and FBD are written in the notation of networks (frontend/parse/network.cpp). Wires
// refer to the ids of output points, which are unique only within a network; elements get new numbers.
#include <algorithm>
#include <charconv>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/iec10/parts.h"
#include "frontend/import/network_writer.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/standard_names.h"

namespace rung::importer::iec10 {
namespace {

// The names of objects and what they are in the notation.
struct ObjectRow {
  std::string_view type;
  ElementKind kind;
};
constexpr ObjectRow kObjectRows[] = {{"LeftPowerRail", ElementKind::Rail},
                                     {"RightPowerRail", ElementKind::RightRail},
                                     {"Contact", ElementKind::Contact},
                                     {"Coil", ElementKind::Coil},
                                     {"Block", ElementKind::Box},
                                     {"DataSource", ElementKind::Input},
                                     {"DataSink", ElementKind::Output},
                                     {"Jump", ElementKind::Jump},
                                     {"CfcJump", ElementKind::Jump},
                                     {"CfcLabel", ElementKind::Label},
                                     {"Return", ElementKind::Return},
                                     {"Connector", ElementKind::Connector},
                                     {"Continuation", ElementKind::Continuation},
                                     {"Comment", ElementKind::Comment}};

const ObjectRow* objectRow(std::string_view type) {
  const auto* found = std::find_if(std::begin(kObjectRows), std::end(kObjectRows),
                                   [&](const ObjectRow& row) { return row.type == type; });
  return found == std::end(kObjectRows) ? nullptr : found;
}

bool hasInput(ElementKind kind) {
  return kind != ElementKind::Rail && kind != ElementKind::Input && kind != ElementKind::Continuation &&
         kind != ElementKind::Label;
}

class Networks {
 public:
  Networks(Reading& import, const std::string& name)
      : import_(import), document_(import.document), name_(name), writer_(import.out) {}

  void write(const std::vector<const Element*>& contents);

 private:
  struct Source {
    uint64_t element;
    const xml::Attribute* pin;  // null: `other` is its name
    std::string other;          // empty: the element has one output
  };

  std::vector<const Element*> childrenOf(const Element& owner, std::initializer_list<std::string_view> names) const;
  bool collect(const Element& network);
  void addOutput(const Element& owner, const Source& source);
  bool checkWires(const Element& owner);
  void writeNetwork(const Element& network);
  void writeObject(const Element& e, ElementKind kind, uint64_t number);
  void readBox(const Element& e, NetworkElement& out);
  NetworkPin pinOf(const Element& pin, std::string_view unnamed, PinDirection direction);
  std::vector<WireSource> wiresOf(const Element& point);
  std::vector<WireSource> inputOf(const Element& e);
  Modifiers modifiersOf(const Element& e) const;
  Area areaOf(const Element& e) const;
  uint64_t orderOf(const Element& e);
  xml::Excerpt attributeOf(const Element& e, std::string_view attribute) const;
  xml::Excerpt reference(const Element& e, std::string_view attribute) const;
  const Element* data(const Element& e, std::string_view name) const;
  xml::Excerpt nextId(Loc loc) { return {loc, std::to_string(++last_element_)}; }

  Reading& import_;
  const xml::Document& document_;
  const std::string& name_;
  NetworkWriter writer_;
  uint64_t last_element_ = 0, last_network_ = 0;
  uint64_t first_order_ = 1, order_end_ = 1;         // of the current network
  std::unordered_map<std::string, Source> sources_;  // by id, of the current network
  std::vector<std::pair<const Element*, uint64_t>> objects_;
};

std::vector<const Element*> Networks::childrenOf(const Element& owner,
                                                 std::initializer_list<std::string_view> names) const {
  std::vector<const Element*> out;
  for (const xml::Element& e : document_.children(owner))
    if (std::find(names.begin(), names.end(), e.name) != names.end()) out.push_back(&e);
  return out;
}

// The element with this name in the AddData of `e`.
const Element* Networks::data(const Element& e, std::string_view name) const {
  for (const Element* all : childrenOf(e, {"AddData"}))
    for (const Element* one : childrenOf(*all, {"Data"}))
      for (const xml::Element& found : document_.children(*one))
        if (found.name == name) return &found;
  return nullptr;
}

void Networks::addOutput(const Element& owner, const Source& source) {
  for (const Element* point : childrenOf(owner, {"ConnectionPointOut"}))
    sources_[document_.value(*point, "connectionPointOutId")] = source;
}

// Forbids a wire from an undefined output point. IEC 61131-10, Connection.
//   fails   <Connection refConnectionPointOutId="7"/>          E1001
bool Networks::checkWires(const Element& owner) {
  bool ok = true;
  for (const xml::Element& e : document_.children(owner)) {
    if (e.name != "Connection" && e.name != "FeedbackConnection") {
      ok = checkWires(e) && ok;
      continue;
    }
    const xml::Attribute* from = document_.attribute(e, "refConnectionPointOutId");
    const std::string id = document_.value(e, "refConnectionPointOutId");
    if (from != nullptr && sources_.count(id) != 0) continue;
    import_.diagnostics.report(diag::WireFromNothing, from == nullptr ? e.loc : from->loc,
                               {"with the connectionPointOutId " + id});
    ok = false;
  }
  return ok;
}

// Numbers the objects of a network and finds their outputs.
//   fails   <FbdObject xsi:type="Unknown"/>          E1087
bool Networks::collect(const Element& network) {
  sources_.clear();
  objects_.clear();
  bool ok = true;
  for (const Element* e : childrenOf(network, {"LdObject", "FbdObject", "CommonObject"})) {
    const std::string type = typeOf(import_, *e);
    if (type == "Unconnected") continue;
    if (objectRow(type) == nullptr) {
      import_.diagnostics.report(diag::ArchiveObject, document_.locOf(*e, "type"),
                                 {type.empty() ? e->name : type, "FBD or LD", name_});
      ok = false;
      continue;
    }
    const uint64_t number = ++last_element_;
    objects_.emplace_back(e, number);
    addOutput(*e, {number, nullptr, {}});
    for (const auto& [lists, direction] :
         {std::pair{"InOutVariables", PinDirection::InOut}, std::pair{"OutputVariables", PinDirection::Output}})
      for (const Element* list : childrenOf(*e, {lists})) {
        size_t count = 0;
        for (const xml::Element& pin : document_.children(*list)) {
          const xml::Attribute* name = document_.attribute(pin, "parameterName");
          const bool named = name != nullptr && isIdentifier(name->raw);
          addOutput(pin, {number, named ? name : nullptr, unnamedPin(direction, ++count)});
        }
      }
    const Element* control = data(*e, "ExecutionControl");
    const Element* eno = control == nullptr ? nullptr : document_.child(*control, "Eno");
    if (eno != nullptr) addOutput(*eno, {number, nullptr, std::string(kEnableOutput)});
  }
  return checkWires(network) && ok;
}

std::vector<WireSource> Networks::wiresOf(const Element& point) {
  std::vector<WireSource> wires;
  for (const Element* c : childrenOf(point, {"Connection", "FeedbackConnection"})) {
    const Source& source = sources_[document_.value(*c, "refConnectionPointOutId")];
    WireSource& wire = wires.emplace_back();
    wire.element = {document_.locOf(*c, "refConnectionPointOutId"), std::to_string(source.element)};
    wire.pin = source.pin == nullptr ? xml::Excerpt(source.other) : xml::Excerpt(document_, *source.pin);
  }
  return wires;
}

std::vector<WireSource> Networks::inputOf(const Element& e) {
  std::vector<WireSource> wires;
  for (const Element* point : childrenOf(e, {"ConnectionPointIn"}))
    for (WireSource& wire : wiresOf(*point)) wires.push_back(std::move(wire));
  return wires;
}

Modifiers Networks::modifiersOf(const Element& e) const {
  bool negated = isTrue(import_, e, "negated");
  if (const Element* own = data(e, "Negation"))
    negated = negated || isTrue(import_, *own, "inNegated") || isTrue(import_, *own, "outNegated");
  if (const Element* own = data(e, "negated")) negated = negated || isTrue(import_, *own, "value");
  const Element* own = data(e, "StorageMode");
  const std::string latch = own == nullptr ? document_.value(e, "latch") : document_.value(*own, "mode");
  return {negated, edgeOf(document_.value(e, "edge")), storageOf(latch)};
}

// Bachmann numbers the execution order from 0 in each network. 0: none.
uint64_t Networks::orderOf(const Element& e) {
  const Element* priority = data(e, "EvaluationPriority");
  const xml::Attribute* order = priority == nullptr ? nullptr : document_.attribute(*priority, "priorityInNetwork");
  uint32_t number = 0;
  if (order == nullptr) return 0;
  const auto [end, error] = std::from_chars(order->raw.data(), order->raw.data() + order->raw.size(), number);
  if (error != std::errc{} || number > 1'000'000'000) return 0;
  order_end_ = std::max(order_end_, first_order_ + number + 1);
  return first_order_ + number;
}

Area Networks::areaOf(const Element& e) const {
  const Element* position = document_.child(e, "RelPosition");
  if (position == nullptr) return {};
  const auto number = [&](const Element* from, std::string_view name) {
    return from == nullptr ? 0 : coordinateOf(document_.value(*from, name));
  };
  const Element* size = document_.child(e, "Size");
  return {true, number(position, "x"), number(position, "y"), number(size, "x"), number(size, "y")};
}

xml::Excerpt Networks::attributeOf(const Element& e, std::string_view attribute) const {
  const xml::Attribute* found = document_.attribute(e, attribute);
  return found == nullptr || found->raw.empty() ? xml::Excerpt() : xml::Excerpt(document_, *found);
}

// The name of a label, an identifier.
xml::Excerpt Networks::reference(const Element& e, std::string_view attribute) const {
  return labelOf(attributeOf(e, attribute), document_.value(e, attribute));
}

NetworkPin Networks::pinOf(const Element& pin, std::string_view unnamed, PinDirection direction) {
  NetworkPin out;
  const xml::Attribute* name = document_.attribute(pin, "parameterName");
  if (name != nullptr && isIdentifier(name->raw))
    out.name = {document_, *name};
  else
    out.name = {pin.loc, std::string(unnamed)};
  out.direction = direction;
  out.modifiers = modifiersOf(pin);
  if (direction != PinDirection::Output) out.wires = inputOf(pin);
  return out;
}

void Networks::readBox(const Element& e, NetworkElement& out) {
  out.name = attributeOf(e, "typeName");
  out.operand = attributeOf(e, "instanceName");
  out.order = orderOf(e);
  out.has_pins = true;
  if (const Element* control = data(e, "ExecutionControl")) {
    if (const Element* en = document_.child(*control, "En"))
      out.pins.push_back(pinOf(*en, kEnable, PinDirection::Input));
    if (const Element* eno = document_.child(*control, "Eno"))
      out.pins.push_back(pinOf(*eno, kEnableOutput, PinDirection::Output));
  }
  struct List {
    std::string_view name, pins;
    PinDirection direction;
  };
  for (const auto& [name, pins, direction] : {List{"InputVariables", "InputVariable", PinDirection::Input},
                                              List{"InOutVariables", "InOutVariable", PinDirection::InOut},
                                              List{"OutputVariables", "OutputVariable", PinDirection::Output}}) {
    size_t count = 0;
    for (const Element* list : childrenOf(e, {name}))
      for (const Element* pin : childrenOf(*list, {pins}))
        out.pins.push_back(pinOf(*pin, unnamedPin(direction, ++count), direction));
  }
}

void Networks::writeObject(const Element& e, ElementKind kind, uint64_t number) {
  NetworkElement out(kind, e.loc, {e.loc, std::to_string(number)});
  const bool ladder = kind == ElementKind::Contact || kind == ElementKind::Coil;
  const bool variable = ladder || kind == ElementKind::Input || kind == ElementKind::Output;
  if (kind == ElementKind::Comment) {
    const Element* content = document_.child(e, "Content");
    if (content != nullptr) out.comment = textOf(import_, *content);
    return writer_.write(out);
  }
  out.area = areaOf(e);
  if (kind == ElementKind::Box) {
    readBox(e, out);
    return writer_.write(out);
  }
  if (kind == ElementKind::Jump)
    out.name = reference(e, document_.attribute(e, "targetLabel") ? "targetLabel" : "targetNetworkLabel");
  if (kind == ElementKind::Label) out.name = reference(e, "label");
  if (kind == ElementKind::Connector || kind == ElementKind::Continuation)
    out.name = connectorOf(attributeOf(e, "label"), document_.value(e, "label"));
  if (variable) out.operand = attributeOf(e, ladder ? "operand" : "identifier");
  if (variable || kind == ElementKind::Jump || kind == ElementKind::Return) out.modifiers = modifiersOf(e);
  if (kind != ElementKind::Input) out.order = orderOf(e);
  if (hasInput(kind)) out.input = inputOf(e);
  writer_.write(out);
}

void Networks::writeNetwork(const Element& network) {
  first_order_ = order_end_;
  if (!collect(network)) return;
  writer_.beginNetwork(network.loc, ++last_network_);
  if (hasName(import_, network, "label")) {
    NetworkElement label(ElementKind::Label, network.loc, nextId(network.loc));
    label.name = reference(network, "label");
    writer_.write(label);
  }
  for (const auto& [e, number] : objects_) writeObject(*e, objectRow(typeOf(import_, *e))->kind, number);
}

uint64_t evaluationOrder(const Reading& import, const Element& element) {
  const std::string text = import.document.value(element, "evaluationOrder");
  uint64_t order = 0;
  std::from_chars(text.data(), text.data() + text.size(), order);
  return order;
}

// Writes the networks of all sections as one body, with ST between them as execute boxes.
void Networks::write(const std::vector<const Element*>& contents) {
  const bool ladder =
      std::none_of(contents.begin(), contents.end(), [&](const Element* e) { return typeOf(import_, *e) == "FBD"; });
  writer_.beginBody(contents[0]->loc, ladder ? NetworkLanguage::Ladder : NetworkLanguage::Blocks);
  for (const Element* content : contents) {
    if (const Element* text = document_.child(*content, "ST")) {
      writer_.beginNetwork(text->loc, ++last_network_);
      writer_.beginStatements({ElementKind::Execute, text->loc, nextId(text->loc)});
      writeText(import_, *text);
      import_.out.put(text->end, "\n");
      writer_.endStatements(text->end);
      continue;
    }
    std::vector<const Element*> networks = childrenOf(*content, {"Rung", "Network"});
    std::stable_sort(networks.begin(), networks.end(), [&](const Element* a, const Element* b) {
      return evaluationOrder(import_, *a) < evaluationOrder(import_, *b);
    });
    for (const Element* network : networks) writeNetwork(*network);
  }
  writer_.endBody(contents.back()->end);
}

}  // namespace

// Forbids bodies in unsupported languages.
//   fails   <BodyContent xsi:type="SFC">          E1054
void writeMainBody(Reading& import, const xml::Element& body, const std::string& name) {
  std::vector<const Element*> contents;
  bool drawn = false;
  for (const xml::Element& e : import.document.children(body)) {
    if (e.name != "BodyContent") continue;
    const std::string type = typeOf(import, e);
    const bool text = type == "ST" || type == "IL";
    const bool networks = type == "LD" || type == "FBD" || type == "LdSection";
    if (!text && !networks) {
      import.diagnostics.report(diag::XmlBodyLanguage, import.document.locOf(e, "type"), {name, type});
      return;
    }
    drawn = drawn || networks;
    contents.push_back(&e);
  }
  std::stable_sort(contents.begin(), contents.end(), [&](const Element* a, const Element* b) {
    return evaluationOrder(import, *a) < evaluationOrder(import, *b);
  });
  if (drawn) return Networks(import, name).write(contents);
  for (const Element* content : contents)
    for (const std::string_view language : {"ST", "IL"})
      if (const Element* text = import.document.child(*content, language)) {
        import.out.put(text->loc, "");
        writeText(import, *text);
        import.out.word("\n");
      }
}

}  // namespace rung::importer::iec10

// SPDX-License-Identifier: Apache-2.0
// CFC bodies of TwinCAT; see archive.h. Elements have pins with ids, and connections link the ids of pins. Elements are
// in execution order. The texts of a box are the names of its inputs and outputs, its type and, for a function block,
// its instance.
#include <algorithm>
#include <charconv>
#include <unordered_map>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/network_writer.h"
#include "frontend/import/twincat/archive.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::importer::twincat {
namespace {

struct SourcePin {
  const xml::Element* name;  // <v>; null: `other` is the name
  std::string other;         // empty: the pins of the element have no names
  uint64_t element;          // number in the notation
};
struct ObjectKind {
  std::string_view type;
  ElementKind kind;
};
constexpr ObjectKind kObjects[] = {{"CFCInputElement", ElementKind::Input},
                                   {"CFCOutputElement", ElementKind::Output},
                                   {"CFCBoxElement", ElementKind::Box},
                                   {"CFCComposerElement", ElementKind::Compose},
                                   {"CFCSelectorElement", ElementKind::Select},
                                   {"CFCSourceConnectionMark", ElementKind::Connector},
                                   {"CFCSinkConnectionMark", ElementKind::Continuation},
                                   {"CFCCommentElement", ElementKind::Comment}};

const ObjectKind* objectNamed(std::string_view type) {
  const auto* found =
      std::find_if(std::begin(kObjects), std::end(kObjects), [&](const ObjectKind& row) { return row.type == type; });
  return found == std::end(kObjects) ? nullptr : found;
}

bool isBox(ElementKind kind) {
  return kind == ElementKind::Box || kind == ElementKind::Compose || kind == ElementKind::Select;
}

class CfcReader {
 public:
  explicit CfcReader(const ArchivedBody& body)
      : archive_(body.archive), name_(body.name), diagnostics_(body.diagnostics), writer_(body.out) {}

  void run(const xml::Element& body);

 private:
  bool collect(const Element& item, uint64_t number);
  bool checkPin(const Element& pin);
  bool checkConnection(const Element& connection);
  std::vector<const Element*> pinsOf(const Element& item, std::string_view one, std::string_view many) const;
  std::vector<const Element*> inputsOf(const Element& item) const { return pinsOf(item, "Input", "Inputs"); }
  std::vector<const Element*> outputsOf(const Element& item) const { return pinsOf(item, "Output", "Outputs"); }
  std::vector<const Element*> textsOf(const Element& item) const;
  void write(const Element& item, ElementKind kind, uint64_t number);
  void readBox(const Element& item, const std::vector<const Element*>& texts, NetworkElement& out);
  void addModifiers(const Element& pin, Modifiers& out) const;
  NetworkPin pinOf(const Element& pin, PinDirection direction);
  std::vector<WireSource> wiresOf(const Element& pin) const;
  Area areaOf(const Element& item) const;
  const Element* name(const Element* text) const {
    return text != nullptr && isPath(archive_.text(*text)) ? text : nullptr;
  }

  const Archive& archive_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  NetworkWriter writer_;
  std::unordered_map<uint64_t, SourcePin> pins_;                     // by id
  std::unordered_map<uint64_t, std::vector<const Element*>> wires_;  // by the id of the destination pin
};

std::vector<const xml::Element*> CfcReader::pinsOf(const Element& item, std::string_view one,
                                                   std::string_view many) const {
  std::vector<const Element*> pins;
  const Element* list = archive_.member(item, many);
  const Element* inner = list == nullptr ? nullptr : archive_.member(*list, "InnerList");
  for (const Element& e : archive_.items(inner)) pins.push_back(&e);
  const Element* single = archive_.member(item, one);
  if (pins.empty() && single != nullptr) pins.push_back(single);
  return pins;
}

std::vector<const xml::Element*> CfcReader::textsOf(const Element& item) const {
  std::vector<const Element*> texts;
  for (const Element* text : pinsOf(item, "Text", "Texts")) texts.push_back(archive_.member(*text, "Text"));
  return texts;
}

//   fails   a pin that sets in a way other than Set, Reset      E1087
bool CfcReader::checkPin(const Element& pin) {
  const Element* stores = archive_.member(pin, "SetReset");
  const std::string how = stores == nullptr ? std::string("None") : archive_.text(*stores);
  if (how == "None" || how == "Set" || how == "Reset") return true;
  diagnostics_.report(diag::ArchiveObject, stores->loc, {how, "CFC", name_});
  return false;
}

// Collects pins and connections.
//   fails   <o t="CFCParrotElement">                            E1087
bool CfcReader::collect(const Element& item, uint64_t number) {
  const std::string type = archive_.typeOf(item);
  if (type == "CFCConnection") {
    wires_[archive_.number(item, "DestPinId")].push_back(&item);
    return true;
  }
  const ObjectKind* object = objectNamed(type);
  if (object == nullptr) {
    archive_.reportObject(diagnostics_, item, "CFC", name_);
    return false;
  }
  const bool is_box = isBox(object->kind);
  std::vector<const Element*> texts;
  if (is_box) {  // type and instance are last
    texts = textsOf(item);
    size_t tail = archive_.text(item, "KindOfCall") == "FunctionBlock" ? 2 : 1;
    while (!texts.empty() && tail > 0) {
      if (texts.back() != nullptr && !archive_.text(*texts.back()).empty()) --tail;
      texts.pop_back();
    }
  }
  size_t at = 0;
  bool ok = true;
  for (const PinDirection direction : {PinDirection::Input, PinDirection::Output}) {
    size_t count = 0;
    for (const Element* pin : direction == PinDirection::Input ? inputsOf(item) : outputsOf(item)) {
      const Element* text = at < texts.size() ? name(texts[at]) : nullptr;
      ++at;
      pins_[archive_.number(*pin, "Id")] = {text, is_box ? pinName(direction, count++) : std::string(), number};
      ok = checkPin(*pin) && ok;
    }
  }
  return ok;
}

// Forbids a connection from an undefined pin.
//   fails   <v n="SourcePinId">99L</v>          E1001
bool CfcReader::checkConnection(const Element& connection) {
  const uint64_t id = archive_.number(connection, "SourcePinId");
  if (pins_.count(id) != 0) return true;
  const Element* source = archive_.member(connection, "SourcePinId");
  diagnostics_.report(diag::WireFromNothing, source == nullptr ? connection.loc : archive_.locOf(*source),
                      {"with the pin " + std::to_string(id)});
  return false;
}

void CfcReader::addModifiers(const Element& pin, Modifiers& out) const {
  if (archive_.isTrue(pin, "Negated")) out.negated = !out.negated;
  if (const PinStorage storage = storageOf(archive_.text(pin, "SetReset")); storage != PinStorage::None)
    out.storage = storage;
}

std::vector<WireSource> CfcReader::wiresOf(const Element& pin) const {
  std::vector<WireSource> wires;
  const auto found = wires_.find(archive_.number(pin, "Id"));
  if (found == wires_.end()) return wires;
  for (const Element* connection : found->second) {
    const SourcePin& source = pins_.at(archive_.number(*connection, "SourcePinId"));
    WireSource& wire = wires.emplace_back();
    wire.element = {connection->loc, std::to_string(source.element)};
    wire.pin = source.name == nullptr ? xml::Excerpt(source.other) : archive_.excerptOf(*source.name);
  }
  return wires;
}

// "x, y, width, height"
Area CfcReader::areaOf(const Element& item) const {
  const std::string text = archive_.text(item, "Bounds");
  Area area;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int32_t* const value : {&area.x, &area.y, &area.width, &area.height}) {
    while (at != end && (*at == ' ' || *at == ',')) ++at;
    const auto [next, error] = std::from_chars(at, end, *value);
    if (error != std::errc{}) return {};
    at = next;
  }
  area.placed = area.width != 0 || area.height != 0;
  return area;
}

NetworkPin CfcReader::pinOf(const Element& pin, PinDirection direction) {
  const SourcePin& named = pins_[archive_.number(pin, "Id")];
  NetworkPin out;
  out.name = named.name == nullptr ? xml::Excerpt(pin.loc, named.other) : archive_.excerptOf(*named.name);
  out.direction = direction;
  addModifiers(pin, out.modifiers);
  if (direction != PinDirection::Output) out.wires = wiresOf(pin);
  return out;
}

void CfcReader::readBox(const Element& item, const std::vector<const Element*>& texts, NetworkElement& out) {
  const bool instance = archive_.text(item, "KindOfCall") == "FunctionBlock" && texts.size() >= 2;
  if (!texts.empty()) out.name = archive_.excerptOf(*texts[texts.size() - (instance ? 2 : 1)]);
  if (instance) out.operand = archive_.excerptOf(*texts.back());
  out.has_pins = true;
  for (const Element* pin : inputsOf(item)) {
    const bool in_out = archive_.typeOf(*pin) == "CFCInOutPin";
    out.pins.push_back(pinOf(*pin, in_out ? PinDirection::InOut : PinDirection::Input));
  }
  for (const Element* pin : outputsOf(item)) out.pins.push_back(pinOf(*pin, PinDirection::Output));
}

void CfcReader::write(const Element& item, ElementKind kind, uint64_t number) {
  NetworkElement out(kind, item.loc, {item.loc, std::to_string(number)});
  out.area = areaOf(item);
  std::vector<const Element*> texts = textsOf(item);
  std::erase_if(texts, [&](const Element* text) { return text == nullptr || archive_.text(*text).empty(); });
  if (isBox(kind)) {
    readBox(item, texts, out);
  } else if (kind == ElementKind::Comment) {
    const Element* text = archive_.member(item, "Text");
    if (text != nullptr)
      out.comment = archive_.commentOf(archive_.member(*text, "Text") != nullptr ? *text : item, "Text");
  } else {
    const xml::Excerpt last = texts.empty() ? xml::Excerpt() : archive_.excerptOf(*texts.back());
    if (kind == ElementKind::Connector || kind == ElementKind::Continuation)
      out.name = texts.empty() ? xml::Excerpt(item.loc, "n") : connectorOf(last, archive_.text(*texts.back()));
    else
      out.operand = last;
    const std::vector<const Element*> inputs = inputsOf(item);
    for (const Element* pin : inputs) addModifiers(*pin, out.modifiers);
    for (const Element* pin : outputsOf(item)) addModifiers(*pin, out.modifiers);
    if (!inputs.empty()) out.input = wiresOf(*inputs[0]);
  }
  if (isBox(kind) || kind == ElementKind::Output) out.order = number;
  writer_.write(out);
}

void CfcReader::run(const Element& body) {
  const Element* list = archive_.member(body, "Items");
  const Element* items = list == nullptr ? nullptr : archive_.member(*list, "InnerList");
  uint64_t number = 0;
  bool ok = true;
  for (const Element& e : archive_.items(items))
    if (!Archive::isNothing(e)) ok = collect(e, ++number) && ok;
  for (const auto& [end, connections] : wires_)
    for (const Element* connection : connections) ok = checkConnection(*connection) && ok;
  if (!ok) return;
  writer_.beginBody(body.loc, NetworkLanguage::Continuous);
  number = 0;
  for (const Element& e : archive_.items(items)) {
    if (Archive::isNothing(e)) continue;
    ++number;
    if (const ObjectKind* object = objectNamed(archive_.typeOf(e))) write(e, object->kind, number);
  }
  writer_.endBody(body.end);
}

}  // namespace

void writeCfc(const ArchivedBody& body) { CfcReader(body).run(body.object); }

}  // namespace rung::importer::twincat

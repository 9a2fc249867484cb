// CFC bodies of TwinCAT; see archive.h. Elements have pins with ids, and connections link the ids of pins. Elements are
// in execution order. The texts of a box are the names of its inputs and outputs, its type and, for a function block,
// its instance.
#include <algorithm>
#include <charconv>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/twincat/archive.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::vendor {
namespace {

struct Pin {
  const xml::Element* name;  // <v>; null: `other` is the name
  std::string other;         // empty: the pins of the element have no names
  uint64_t element;          // number in the notation
};
struct Word {
  std::string_view type, word;
};
constexpr Word kKeywords[] = {{"CFCInputElement", "input"},
                              {"CFCOutputElement", "output"},
                              {"CFCBoxElement", "box"},
                              {"CFCComposerElement", "compose"},
                              {"CFCSelectorElement", "select"},
                              {"CFCSourceConnectionMark", "connector"},
                              {"CFCSinkConnectionMark", "continuation"},
                              {"CFCCommentElement", "comment"}};

class CfcReader {
 public:
  CfcReader(const Archive& archive, const std::string& name, Diagnostics& diagnostics, xml::SourceMappedText& out)
      : archive_(archive), name_(name), diagnostics_(diagnostics), out_(out) {}

  void run(const xml::Element& body);

 private:
  using Element = xml::Element;

  bool collect(const Element& item, uint64_t number);
  bool checkConnection(const Element& connection);
  std::vector<const Element*> pinsOf(const Element& item, std::string_view one, std::string_view many) const;
  std::vector<const Element*> textsOf(const Element& item) const;
  void write(const Element& item, std::string_view word, uint64_t number);
  void writePins(const Element& item);
  void writeModifiers(const Element& pin);
  void writeWires(const Element& pin);
  void writePosition(const Element& item);
  void writeName(const Element& item, const Element* text);
  bool isBox(std::string_view type) const {
    return type == "CFCBoxElement" || type == "CFCComposerElement" || type == "CFCSelectorElement";
  }
  const Element* name(const Element* text) const {
    return text != nullptr && isPath(archive_.text(*text)) ? text : nullptr;
  }

  const Archive& archive_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  xml::SourceMappedText& out_;
  std::unordered_map<uint64_t, Pin> pins_;                           // by id
  std::unordered_map<uint64_t, std::vector<const Element*>> wires_;  // by the id of the destination pin
};

std::vector<const xml::Element*> CfcReader::pinsOf(const Element& item, std::string_view one,
                                                   std::string_view many) const {
  std::vector<const Element*> pins;
  const Element* list = archive_.member(item, many);
  const Element* inner = list == nullptr ? nullptr : archive_.member(*list, "InnerList");
  for (const Element* e = archive_.first(inner); e != nullptr; e = archive_.next(*e)) pins.push_back(e);
  const Element* single = archive_.member(item, one);
  if (pins.empty() && single != nullptr) pins.push_back(single);
  return pins;
}

std::vector<const xml::Element*> CfcReader::textsOf(const Element& item) const {
  std::vector<const Element*> texts;
  for (const Element* text : pinsOf(item, "Text", "Texts")) texts.push_back(archive_.member(*text, "Text"));
  return texts;
}

// Collects pins and connections.
//   fails   <o t="CFCParrotElement">                            E1087
//   fails   a pin that sets in a way other than Set, Reset      E1087
bool CfcReader::collect(const Element& item, uint64_t number) {
  const std::string type = archive_.typeOf(item);
  if (type == "CFCConnection") {
    wires_[archive_.number(item, "DestPinId")].push_back(&item);
    return true;
  }
  if (std::none_of(std::begin(kKeywords), std::end(kKeywords), [&](const Word& word) { return word.type == type; })) {
    const xml::Attribute* type_attribute = archive_.document().attribute(item, "t");
    diagnostics_.report(diag::ArchiveObject, type_attribute == nullptr ? item.loc : type_attribute->loc,
                        {type.empty() ? "?" : type, "CFC", name_});
    return false;
  }
  std::vector<const Element*> texts = textsOf(item);
  if (isBox(type)) {  // type and instance are last
    size_t tail = archive_.text(item, "KindOfCall") == "FunctionBlock" ? 2 : 1;
    while (!texts.empty() && tail > 0) {
      if (texts.back() != nullptr && !archive_.text(*texts.back()).empty()) --tail;
      texts.pop_back();
    }
  } else {
    texts.clear();
  }
  size_t at = 0;
  bool ok = true;
  for (const bool output : {false, true}) {
    size_t count = 0;
    for (const Element* pin : pinsOf(item, output ? "Output" : "Input", output ? "Outputs" : "Inputs")) {
      const std::string counted = count == 0 && output ? "" : std::to_string(count + (output ? 0 : 1));
      const std::string other = !isBox(type) ? "" : (output ? "OUT" : "IN") + counted;
      pins_[archive_.number(*pin, "Id")] = {at < texts.size() ? name(texts[at]) : nullptr, other, number};
      ++at;
      ++count;
      const Element* stores = archive_.member(*pin, "SetReset");
      const std::string how = stores == nullptr ? std::string("None") : archive_.text(*stores);
      if (how == "None" || how == "Set" || how == "Reset") continue;
      diagnostics_.report(diag::ArchiveObject, stores->loc, {how, "CFC", name_});
      ok = false;
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

void CfcReader::writeModifiers(const Element& pin) {
  if (archive_.isTrue(pin, "Negated")) out_.word(" NOT");
  const std::string how = archive_.text(pin, "SetReset");
  if (how == "Set" || how == "Reset") out_.word(how == "Set" ? " SET" : " RESET");
}

void CfcReader::writeWires(const Element& pin) {
  const auto found = wires_.find(archive_.number(pin, "Id"));
  if (found == wires_.end()) return;
  bool first = true;
  for (const Element* connection : found->second) {
    if (!first) out_.word(" OR ");
    first = false;
    const auto source = pins_.find(archive_.number(*connection, "SourcePinId"));
    out_.put(connection->loc, std::to_string(source->second.element));
    if (source->second.name == nullptr && source->second.other.empty()) continue;
    out_.word("(");
    if (source->second.name != nullptr)
      archive_.write(*source->second.name, out_);
    else
      out_.word(source->second.other);
    out_.word(")");
  }
}

// "x, y, width, height"
void CfcReader::writePosition(const Element& item) {
  const Element* bounds = archive_.member(item, "Bounds");
  if (bounds == nullptr) return;
  const std::string text = archive_.text(*bounds);
  int values[4] = {};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int& value : values) {
    while (at != end && (*at == ' ' || *at == ',')) ++at;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{}) return;
    at = next;
  }
  if (values[2] == 0 && values[3] == 0) return;
  std::string position = " AT ";
  for (int k = 0; k < 4; ++k) position += (k == 0 ? "" : ", ") + std::to_string(values[k]);
  out_.put(bounds->loc, position);
}

// Names of connectors are arbitrary: in the notation they are converted to identifiers.
void CfcReader::writeName(const Element& item, const Element* text) {
  out_.word(" ");
  if (text != nullptr && isPath(archive_.text(*text))) return archive_.write(*text, out_);
  std::string created = "n";
  for (const char c : text == nullptr ? std::string() : archive_.text(*text)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    created += plain ? std::string(1, c) : std::to_string(static_cast<unsigned char>(c)) + "x";
  }
  out_.put(text == nullptr ? item.loc : text->loc, created);
}

void CfcReader::writePins(const Element& item) {
  out_.word(" [");
  bool first = true;
  const auto writeNameOf = [&](const Element& pin) {
    if (!first) out_.word(", ");
    first = false;
    const Pin& named = pins_[archive_.number(pin, "Id")];
    if (named.name != nullptr)
      archive_.write(*named.name, out_);
    else
      out_.put(pin.loc, named.other);
    writeModifiers(pin);
  };
  for (const Element* pin : pinsOf(item, "Input", "Inputs")) {
    writeNameOf(*pin);
    out_.word(" := ");
    writeWires(*pin);
    if (archive_.typeOf(*pin) == "CFCInOutPin") out_.word(" =>");
  }
  for (const Element* pin : pinsOf(item, "Output", "Outputs")) {
    writeNameOf(*pin);
    out_.word(" =>");
  }
  out_.word("]");
}

void CfcReader::write(const Element& item, std::string_view word, uint64_t number) {
  out_.put(item.loc, std::string(word) + " " + std::to_string(number));
  std::vector<const Element*> texts = textsOf(item);
  std::erase_if(texts, [&](const Element* text) { return text == nullptr || archive_.text(*text).empty(); });
  const std::string type = archive_.typeOf(item);
  const Element* last = texts.empty() ? nullptr : texts.back();
  if (isBox(type)) {
    const bool instance = archive_.text(item, "KindOfCall") == "FunctionBlock" && texts.size() >= 2;
    const Element* called = instance ? texts[texts.size() - 2] : last;
    if (called != nullptr) {
      out_.word(" ");
      archive_.write(*called, out_);
    }
    if (instance) {
      out_.word(" (");
      archive_.write(*last, out_);
      out_.word(")");
    }
    out_.word(" ORDER " + std::to_string(number));
    writePosition(item);
    writePins(item);
  } else if (word == "comment") {
    if (const Element* text = archive_.member(item, "Text"))
      archive_.writeString(archive_.member(*text, "Text") != nullptr ? *text : item, "Text", out_);
    writePosition(item);
  } else {
    const bool mark = word == "connector" || word == "continuation";
    const std::vector<const Element*> inputs = pinsOf(item, "Input", "Inputs");
    const std::vector<const Element*> outputs = pinsOf(item, "Output", "Outputs");
    if (mark) {
      writeName(item, last);
    } else {
      out_.word(" (");
      if (last != nullptr) archive_.write(*last, out_);
      out_.word(")");
    }
    for (const Element* pin : inputs) writeModifiers(*pin);
    for (const Element* pin : outputs) writeModifiers(*pin);
    if (word == "output") out_.word(" ORDER " + std::to_string(number));
    writePosition(item);
    if (!inputs.empty() && wires_.count(archive_.number(*inputs[0], "Id")) != 0) {
      out_.word(" := ");
      writeWires(*inputs[0]);
    }
  }
  out_.word(";\n");
}

void CfcReader::run(const Element& body) {
  const Element* list = archive_.member(body, "Items");
  const Element* items = list == nullptr ? nullptr : archive_.member(*list, "InnerList");
  uint64_t number = 0;
  bool ok = true;
  for (const Element* e = archive_.first(items); e != nullptr; e = archive_.next(*e))
    if (!Archive::isNothing(*e)) ok = collect(*e, ++number) && ok;
  for (const auto& [end, connections] : wires_)
    for (const Element* connection : connections) ok = checkConnection(*connection) && ok;
  if (!ok) return;
  out_.put(body.loc, "{network CFC}\n");
  number = 0;
  for (const Element* e = archive_.first(items); e != nullptr; e = archive_.next(*e)) {
    if (Archive::isNothing(*e)) continue;
    ++number;
    const std::string type = archive_.typeOf(*e);
    for (const Word& word : kKeywords)
      if (word.type == type) write(*e, word.word, number);
  }
  out_.put(body.end, "{end_network}\n");
}

}  // namespace

void writeCfc(const Archive& archive, const xml::Element& body, const std::string& name, Diagnostics& diagnostics,
              xml::SourceMappedText& out) {
  const xml::Element* object = archive.root(body, "CFCImplementationObject");
  if (object == nullptr) {
    diagnostics.report(diag::ArchiveEmpty, body.loc, {name, "CFCImplementationObject"});
    return;
  }
  CfcReader(archive, name, diagnostics, out).run(*object);
}

}  // namespace rung::vendor

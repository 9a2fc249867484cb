// Networks; see networks.h. The output is the notation of frontend/parse/network.cpp: elements keep their localId as
// number, so that the parser resolves wires and reports errors in them, at their locations in the XML.
#include "frontend/import/plcopen/networks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"

namespace rung::plcopen {
namespace {

// Numbers for elements without a localId, larger than those of editors.
constexpr uint64_t kOwnNumbers = 9'000'000'000'000'000'000u;

bool isNameChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}
// A name or a path of names.
bool isPath(std::string_view text) {
  bool at_begin = true;
  for (const char c : text) {
    if (c == '.' && !at_begin) {
      at_begin = true;
    } else if (isNameChar(c) && !(at_begin && c >= '0' && c <= '9')) {
      at_begin = false;
    } else {
      return false;
    }
  }
  return !at_begin;
}
bool isName(std::string_view text) { return isPath(text) && text.find('.') == std::string_view::npos; }

// A string of the notation, on one line.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '$') out += '$';
    out += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  return out + "'";
}

class Writer {
 public:
  Writer(const Sources& sources, const xml::Document& document, xml::SourceMappedText& out)
      : sources_(sources), document_(document), out_(out) {}

  void writeBody(const DrawnBody& diagram);
  void writeCondition(const DrawnBody& diagram);

 private:
  using Element = xml::Element;

  void collect(const Element& body);
  void writeElement(const Element& e);
  void writeActions(const Element& body);
  void writeNetworkOf(const Element& e);
  void writeBox(const Element& e);
  void writeBoxName(const Element& e);
  void writePins(const Element& e);
  void writePin(const Element& pin, std::string_view fallback, bool input, bool output);
  void writeWires(const Element& point);
  void writeInput(const Element& e);
  void writeOperand(const Element& e);
  void writePinModifiers(const Element& e, std::string_view negated = "negated");
  void writeOrder(const Element& e);
  void writePosition(const Element& e);
  void writeNumber(const Element& e);
  void writeText(const Element& e, const Element* content);
  void writeReference(const Element& e, std::string_view attribute);

  std::string value(const Element& e, std::string_view name) const { return document_.value(e, name); }
  bool isSet(const Element& e, std::string_view name) const {
    const std::string text = value(e, name);
    return sameIdentifier(text, "true") || text == "1";
  }
  uint64_t numberOf(const Element& e) const;
  bool negatedByVendor(const Element& e) const;
  const Element* data(const Element& e, std::string_view kind) const;
  std::string onlyOutput(const Element& box) const;
  bool hasOutput(const Element& box, std::string_view pin) const;

  const Sources& sources_;
  const xml::Document& document_;
  xml::SourceMappedText& out_;
  std::unordered_map<uint64_t, const Element*> by_number_;
  std::vector<const Element*> elements_;
  uint64_t network_ = 0;  // current network, derived from element numbers (CODESYS)
  uint64_t next_own_ = kOwnNumbers;
  bool counts_from_zero_ = false;  // executionOrderId 0 is a valid number
};

bool isElement(std::string_view name) {
  static constexpr std::string_view kNames[] = {
      "leftPowerRail", "rightPowerRail", "contact", "coil",  "block",  "inVariable", "outVariable",   "inOutVariable",
      "connector",     "continuation",   "jump",    "label", "return", "comment",    "vendorElement", "actionBlock"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

uint64_t Writer::numberOf(const Element& e) const {
  const std::string text = value(e, "localId");
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? number : UINT64_MAX;
}

// The content of the first addData of this kind.
const xml::Element* Writer::data(const Element& e, std::string_view kind) const {
  for (const Element* all = document_.firstChild(e); all != nullptr; all = document_.next(*all)) {
    if (all->name != "addData") continue;
    for (const Element* d = document_.firstChild(*all); d != nullptr; d = document_.next(*d)) {
      const std::string name = value(*d, "name");
      if (name.size() > kind.size() && name.ends_with(kind) && name[name.size() - kind.size() - 1] == '/')
        return document_.firstChild(*d);
    }
  }
  return nullptr;
}

// Bachmann writes the negation of jumps and returns in addData.
bool Writer::negatedByVendor(const Element& e) const {
  const Element* negated = data(e, "negated");
  return negated != nullptr && isSet(*negated, "value");
}

void Writer::collect(const Element& body) {
  std::vector<uint64_t> execution_orders;
  for (const Element* e = document_.firstChild(body); e != nullptr; e = document_.next(*e)) {
    if (e->name == "step") by_number_.emplace(numberOf(*e), e);
    if (!isElement(e->name)) continue;
    elements_.push_back(e);
    by_number_.emplace(numberOf(*e), e);
    const bool acts = e->name == "block" || e->name == "outVariable" || e->name == "jump" || e->name == "return" ||
                      e->name == "label";
    uint64_t execution_order = 0;
    const std::string order = value(*e, "executionOrderId");
    if (acts && std::from_chars(order.data(), order.data() + order.size(), execution_order).ec == std::errc{})
      execution_orders.push_back(execution_order);
  }
  // Editors that number every element begin with 0; in others 0 means no number.
  std::sort(execution_orders.begin(), execution_orders.end());
  counts_from_zero_ = execution_orders.size() > 1 && execution_orders[0] == 0;
  for (size_t k = 1; k < execution_orders.size(); ++k)
    counts_from_zero_ = counts_from_zero_ && execution_orders[k] > execution_orders[k - 1];
}

bool Writer::hasOutput(const Element& box, std::string_view pin) const {
  for (const char* list : {"outputVariables", "inOutVariables"}) {
    const Element* pins = document_.child(box, list);
    for (const Element* p = pins == nullptr ? nullptr : document_.firstChild(*pins); p != nullptr;
         p = document_.next(*p))
      if (sameIdentifier(value(*p, "formalParameter"), pin)) return true;
  }
  return false;
}

// The only output of a box besides ENO, or empty.
std::string Writer::onlyOutput(const Element& box) const {
  const Element* pins = document_.child(box, "outputVariables");
  std::string only;
  int count = 0;
  for (const Element* p = pins == nullptr ? nullptr : document_.firstChild(*pins); p != nullptr;
       p = document_.next(*p)) {
    const std::string name = value(*p, "formalParameter");
    if (sameIdentifier(name, "ENO")) continue;
    only = name;
    ++count;
  }
  return count == 1 ? only : std::string();
}

void Writer::writeNumber(const Element& e) {
  const xml::Attribute* number = document_.attribute(e, "localId");
  if (number != nullptr && numberOf(e) != UINT64_MAX)
    out_.add(document_, *number);
  else
    out_.put(e.loc, std::to_string(next_own_++));
}

// The sources of the wires into `point`: number(pin) OR number(pin).
void Writer::writeWires(const Element& point) {
  bool first = true;
  for (const Element* c = document_.firstChild(point); c != nullptr; c = document_.next(*c)) {
    if (c->name != "connection") continue;
    const xml::Attribute* from = document_.attribute(*c, "refLocalId");
    if (from == nullptr) continue;
    if (!first) out_.word(" OR ");
    first = false;
    out_.add(document_, *from);
    uint64_t number = 0;
    const std::string text = value(*c, "refLocalId");
    std::from_chars(text.data(), text.data() + text.size(), number);
    const auto found = by_number_.find(number);
    if (found == by_number_.end() || (found->second->name != "block" && found->second->name != "vendorElement"))
      continue;
    const xml::Attribute* pin = document_.attribute(*c, "formalParameter");
    const std::string name = pin == nullptr ? std::string() : value(*c, "formalParameter");
    if (isName(name) && hasOutput(*found->second, name)) {
      out_.word("(");
      out_.add(document_, *pin);
      out_.word(")");
    } else if (const std::string only = onlyOutput(*found->second); isName(only)) {
      out_.word("(" + only + ")");
    } else if (isName(name)) {  // the parser or the scheduler reports it at its location
      out_.word("(");
      out_.add(document_, *pin);
      out_.word(")");
    }
  }
}

void Writer::writeInput(const Element& e) {
  const Element* point = document_.child(e, "connectionPointIn");
  if (point == nullptr || document_.child(*point, "connection") == nullptr) return;
  out_.word(" := ");
  writeWires(*point);
}

void Writer::writePinModifiers(const Element& e, std::string_view negated) {
  if (isSet(e, negated)) out_.word(" NOT");
  const std::string edge = value(e, "edge"), storage = value(e, "storage");
  if (edge == "rising" || edge == "falling") out_.word(edge == "rising" ? " RISING" : " FALLING");
  if (storage == "set" || storage == "reset") out_.word(storage == "set" ? " SET" : " RESET");
}

void Writer::writeOrder(const Element& e) {
  const xml::Attribute* order = document_.attribute(e, "executionOrderId");
  uint64_t execution_order = 0;
  const std::string text = value(e, "executionOrderId");
  if (order == nullptr || std::from_chars(text.data(), text.data() + text.size(), execution_order).ec != std::errc{})
    return;
  if (counts_from_zero_) ++execution_order;
  if (execution_order != 0) out_.put(order->loc, " ORDER " + std::to_string(execution_order));
}

void Writer::writePosition(const Element& e) {
  if (const std::string position = positionOf(document_, e); !position.empty()) out_.put(e.loc, position);
}

// ( expression )
void Writer::writeOperand(const Element& e) {
  const Element* text = document_.child(e, "expression");
  if (text == nullptr) text = document_.child(e, "variable");
  out_.word(" (");
  if (text != nullptr) out_.add(document_, *text);
  out_.word(")");
}

// A string of the notation: comments and titles.
void Writer::writeText(const Element& e, const Element* content) {
  if (content == nullptr) return;
  out_.put(e.loc, " " + quoted(document_.text(*content, sources_)));
}

// The name in an attribute of a label or connector.
void Writer::writeReference(const Element& e, std::string_view attribute) {
  const xml::Attribute* name = document_.attribute(e, attribute);
  if (name == nullptr || value(e, attribute).empty()) return;
  out_.word(" ");
  if (isName(value(e, attribute))) {
    out_.add(document_, *name);
    return;
  }
  if (attribute == "name") {  // names of connectors are arbitrary
    out_.put(name->loc, quoted(value(e, attribute)));
    return;
  }
  // Creates an identifier for the name of a label.
  std::string created = "n";
  for (const char c : value(e, attribute)) {
    if (isNameChar(c))
      created += c;
    else
      created += std::to_string(static_cast<unsigned char>(c)) + "x";
  }
  out_.put(name->loc, created);
}

void Writer::writePin(const Element& pin, std::string_view fallback, bool input, bool output) {
  const xml::Attribute* name = document_.attribute(pin, "formalParameter");
  if (name != nullptr && isName(value(pin, "formalParameter")))
    out_.add(document_, *name);
  else
    out_.put(pin.loc, fallback);
  writePinModifiers(pin);
  if (input) {
    out_.word(" := ");
    if (const Element* point = document_.child(pin, "connectionPointIn")) writeWires(*point);
  }
  if (output) out_.word(" =>");
}

void Writer::writePins(const Element& e) {
  struct List {
    const char* name;
    bool input, output;
  };
  out_.word(" [");
  bool first = true;
  for (const List list : {List{"inputVariables", true, false}, List{"inOutVariables", true, true},
                          List{"outputVariables", false, true}}) {
    const Element* pins = document_.child(e, list.name);
    int count = 0;
    for (const Element* p = pins == nullptr ? nullptr : document_.firstChild(*pins); p != nullptr;
         p = document_.next(*p)) {
      if (p->name != "variable") continue;
      if (!first) out_.word(", ");
      first = false;
      ++count;
      writePin(*p, (list.input ? "IN" : "OUT") + (count == 1 && !list.input ? std::string() : std::to_string(count)),
               list.input, list.output);
    }
  }
  out_.word("]");
}

// TON and TOF by their symbols, T---0 and 0---T. IEC 61131-3 ed. 3 table 46, 2d and 3d.
std::string_view timerOf(std::string_view symbol) {
  if (symbol.size() < 3 || symbol.find_first_not_of('-', 1) != symbol.size() - 1) return {};
  if (symbol.front() == 'T' && symbol.back() == '0') return "TON";
  return symbol.front() == '0' && symbol.back() == 'T' ? "TOF" : std::string_view{};
}

// The callee of the box, and its instance. A method is called through its instance.
void Writer::writeBoxName(const Element& e) {
  const xml::Attribute* type = document_.attribute(e, "typeName");
  const xml::Attribute* instance = document_.attribute(e, "instanceName");
  const std::string type_name = value(e, "typeName"), instance_name = value(e, "instanceName");
  std::string call_type;
  for (const char* kind : {"fbdcalltype", "cfccalltype", "ldcalltype"})
    if (const Element* call = data(e, kind)) call_type = document_.text(*call, sources_);
  const bool member = call_type == "method" || call_type == "action";
  if (member && !instance_name.empty() && isPath(instance_name) && isPath(type_name)) {
    out_.word(" ");
    const size_t dot = type_name.rfind('.');
    out_.put(type->loc, instance_name + "." + type_name.substr(dot == std::string::npos ? 0 : dot + 1));
    return;
  }
  if (const std::string_view timer = timerOf(type_name); !timer.empty()) {
    out_.word(" ");
    out_.put(type->loc, timer);
  } else if (type != nullptr && !type_name.empty()) {
    out_.word(" ");
    out_.add(document_, *type);
  }
  if (!instance_name.empty()) {
    out_.word(" (");
    out_.add(document_, *instance);
    out_.word(")");
  }
}

void Writer::writeBox(const Element& e) {
  const Element* st = data(e, "stcode");
  const bool execute = sameIdentifier(value(e, "typeName"), "EXECUTE") && st != nullptr;
  out_.word(execute ? "execute " : "box ");
  writeNumber(e);
  if (!execute) writeBoxName(e);
  writeOrder(e);
  writePosition(e);
  writePins(e);
  if (!execute) return;
  out_.word(" {network ST}\n");
  out_.add(document_, *st);
  out_.word("\n{end_network}");
}

// A title begins a network, and so does an element number in the next range of ten thousand million (CODESYS).
void Writer::writeNetworkOf(const Element& e) {
  const uint64_t number = numberOf(e);
  if (number == UINT64_MAX || number < kNumbersPerNetwork) return;
  const uint64_t network = number / kNumbersPerNetwork;
  if (network == network_ || network > UINT32_MAX) return;
  network_ = network;
  out_.put(e.loc, "NETWORK " + std::to_string(network) + ";\n");
}

void Writer::writeElement(const Element& e) {
  const std::string_view kind = e.name;
  if (kind == "vendorElement") {
    const Element* type = data(e, "fbdelementtype");
    if (type == nullptr) type = data(e, "cfcelementtype");
    const std::string what = type == nullptr ? std::string() : document_.text(*type, sources_);
    if (what != "composer" && what != "selector") return;
    out_.word(what == "composer" ? "compose " : "select ");
    writeNumber(e);
    out_.word(" ");
    if (const Element* name = document_.child(e, "alternativeText")) out_.add(document_, *name);
    writeOrder(e);
    writePosition(e);
    writePins(e);
    out_.word(";\n");
    return;
  }
  writeNetworkOf(e);
  if (kind == "actionBlock") {
    out_.word("output ");
    writeNumber(e);
    out_.word(" (" + wireOf(document_, e) + ")");
    writeOrder(e);
    writePosition(e);
    writeInput(e);
    out_.word(";\n");
    return;
  }
  if (kind == "step") {
    out_.word("input ");
    writeNumber(e);
    out_.word(" (");
    if (const xml::Attribute* name = document_.attribute(e, "name")) out_.add(document_, *name);
    out_.word(".X);\n");
    return;
  }
  if (kind == "block") {
    writeBox(e);
    out_.word(";\n");
    return;
  }
  static constexpr std::pair<std::string_view, std::string_view> kKeywords[] = {{"leftPowerRail", "rail "},
                                                                                {"rightPowerRail", "right_rail "},
                                                                                {"contact", "contact "},
                                                                                {"coil", "coil "},
                                                                                {"inVariable", "input "},
                                                                                {"outVariable", "output "},
                                                                                {"inOutVariable", "inout "},
                                                                                {"connector", "connector "},
                                                                                {"continuation", "continuation "},
                                                                                {"jump", "jump "},
                                                                                {"label", "label "},
                                                                                {"return", "return "},
                                                                                {"comment", "comment "}};
  for (const auto& [name, word] : kKeywords)
    if (kind == name) out_.word(word);
  writeNumber(e);
  if (kind == "comment") {
    writeText(e, document_.child(e, "content"));
  } else if (kind == "jump" || kind == "label") {
    writeReference(e, "label");
    if (kind == "jump" && (isSet(e, "negated") || negatedByVendor(e))) out_.word(" NOT");
  } else if (kind == "return") {
    if (isSet(e, "negated") || negatedByVendor(e)) out_.word(" NOT");
  } else if (kind == "connector" || kind == "continuation") {
    writeReference(e, "name");
  } else if (kind == "contact" || kind == "coil" || kind == "inVariable" || kind == "outVariable") {
    writeOperand(e);
    writePinModifiers(e);
    const Element* own = kind == "coil" ? data(e, "extension") : nullptr;  // exported by Rung
    if (own != nullptr && isSet(*own, "holding")) out_.word(" HOLDING");
  } else if (kind == "inOutVariable") {
    writeOperand(e);
    writePinModifiers(e, "negatedIn");
  }
  if (kind != "inVariable") writeOrder(e);
  writePosition(e);
  if (kind == "rightPowerRail") {  // end of wires, without a place in the execution order
    out_.word(";\n");
    return;
  }
  if (kind != "leftPowerRail" && kind != "inVariable" && kind != "comment" && kind != "continuation") writeInput(e);
  out_.word(";\n");
}

// After everything else: below all positions, or in a separate network.
void Writer::writeActions(const Element& body) {
  const auto block =
      std::find_if(elements_.begin(), elements_.end(), [](const Element* e) { return e->name == "actionBlock"; });
  if (block == elements_.end()) return;
  if (network_ != 0) out_.put((*block)->loc, "NETWORK " + std::to_string(UINT32_MAX) + ";\n");
  const bool placed = std::any_of(elements_.begin(), elements_.end(),
                                  [&](const Element* e) { return document_.child(*e, "position") != nullptr; });
  out_.put((*block)->loc,
           "execute " + std::to_string(kOwnNumbers - 2) + (placed ? " AT 0, 1000000000" : "") + " {network ST}\n");
  writeActionCalls(document_, body, out_);
  out_.word("{end_network};\n");
}

void Writer::writeBody(const DrawnBody& diagram) {
  collect(diagram.body);
  const char* word = diagram.language == NetworkLanguage::Ladder   ? "LD"
                     : diagram.language == NetworkLanguage::Blocks ? "FBD"
                                                                   : "CFC";
  out_.put(diagram.body.loc, std::string("{network ") + word + "}\n");
  for (const Element* e : elements_) writeElement(*e);
  writeActions(diagram.body);
  out_.put(diagram.body.end, "{end_network}\n");
}

// Only the elements connected to the condition, in file order.
void Writer::writeCondition(const DrawnBody& diagram) {
  collect(diagram.body);
  std::vector<uint64_t> wanted;
  const auto want = [&](const Element& point) {
    for (const Element* c = document_.firstChild(point); c != nullptr; c = document_.next(*c)) {
      const std::string text = value(*c, "refLocalId");
      uint64_t number = 0;
      if (c->name == "connection" && std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc{})
        wanted.push_back(number);
    }
  };
  if (diagram.condition != nullptr) want(*diagram.condition);
  for (const Element* end : diagram.ends) wanted.push_back(numberOf(*end));
  std::unordered_map<uint64_t, bool> seen;
  std::vector<const Element*> used;
  for (size_t k = 0; k < wanted.size(); ++k) {
    const auto found = by_number_.find(wanted[k]);
    if (found == by_number_.end() || !seen.emplace(wanted[k], true).second) continue;
    used.push_back(found->second);
    const Element& e = *found->second;
    if (e.name == "step") continue;
    if (const Element* point = document_.child(e, "connectionPointIn")) want(*point);
    for (const char* list : {"inputVariables", "inOutVariables"}) {
      const Element* pins = document_.child(e, list);
      for (const Element* p = pins == nullptr ? nullptr : document_.firstChild(*pins); p != nullptr;
           p = document_.next(*p))
        if (const Element* point = document_.child(*p, "connectionPointIn")) want(*point);
    }
  }
  std::sort(used.begin(), used.end());
  out_.put((diagram.condition != nullptr ? diagram.condition : diagram.ends[0])->loc, "{network LD}\n");
  for (const Element* e : used) writeElement(*e);
  if (diagram.condition == nullptr) return out_.word("{end_network}\n");
  out_.put(diagram.condition->loc, "output " + std::to_string(kOwnNumbers - 1) + " (" + diagram.target + ") := ");
  writeWires(*diagram.condition);
  out_.put(diagram.condition->end, ";\n{end_network}\n");
}

}  // namespace

std::string positionOf(const xml::Document& document, const xml::Element& e) {
  const xml::Element* position = document.child(e, "position");
  if (position == nullptr) return {};
  const auto number = [&](const xml::Element& from, std::string_view name) {
    const std::string text = document.value(from, name);
    double v = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), v).ec != std::errc{} || !std::isfinite(v)) v = 0;
    return std::to_string(std::lround(std::clamp(v, -1e9, 1e9)));
  };
  const std::string size = number(e, "width") + ", " + number(e, "height");
  return " AT " + number(*position, "x") + ", " + number(*position, "y") +
         (size == "0, 0" ? std::string() : ", " + size);
}

void writeNetworks(const Sources& sources, const xml::Document& document, const DrawnBody& diagram,
                   xml::SourceMappedText& out) {
  Writer writer(sources, document, out);
  if (diagram.condition != nullptr || !diagram.ends.empty())
    writer.writeCondition(diagram);
  else
    writer.writeBody(diagram);
}

}  // namespace rung::plcopen

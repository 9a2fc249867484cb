// Bodies: ST and IL are copied, LD and FBD are written in the notation of networks (frontend/parse/network.cpp). Wires
// refer to the ids of output points, which are unique only within a network; elements get new numbers.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/iec10/parts.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::iec10 {
namespace {

using Element = xml::Element;
using plcopen::isTrue;

bool isName(std::string_view text) { return !text.empty() && plcopen::identifierOf(text) == text; }

// The names of objects and their keywords in the notation.
constexpr std::pair<std::string_view, std::string_view> kKeywords[] = {{"LeftPowerRail", "rail"},
                                                                       {"RightPowerRail", "right_rail"},
                                                                       {"Contact", "contact"},
                                                                       {"Coil", "coil"},
                                                                       {"Block", "box"},
                                                                       {"DataSource", "input"},
                                                                       {"DataSink", "output"},
                                                                       {"Jump", "jump"},
                                                                       {"CfcJump", "jump"},
                                                                       {"CfcLabel", "label"},
                                                                       {"Return", "return"},
                                                                       {"Connector", "connector"},
                                                                       {"Continuation", "continuation"},
                                                                       {"Comment", "comment"}};

// The name of a pin without a name in the file: IN1, IN2, OUT, OUT2.
std::string otherName(std::string_view kind, size_t count) {
  return std::string(kind) + (kind == "OUT" && count == 1 ? "" : std::to_string(count));
}

class Networks {
 public:
  Networks(Import& import, const std::string& name) : import_(import), document_(import.document), name_(name) {}

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
  void writeObject(const Element& e, std::string_view word, uint64_t number);
  void writeBox(const Element& e);
  void writePin(const Element& pin, std::string_view other, bool input, bool output);
  void writeWires(const Element& point);
  void writeInput(const Element& e);
  void writeModifiers(const Element& e);
  void writePosition(const Element& e);
  void writeOrder(const Element& e);
  void writeReference(const Element& e, std::string_view attribute);
  const Element* data(const Element& e, std::string_view name) const;
  std::string_view keywordOf(const Element& e) const {
    const std::string type = typeOf(import_, e);
    for (const auto& [name, word] : kKeywords)
      if (type == name) return word;
    return {};
  }

  Import& import_;
  const xml::Document& document_;
  const std::string& name_;
  uint64_t last_element_ = 0, last_network_ = 0;
  uint64_t first_order_ = 1, order_end_ = 1;         // of the current network
  std::unordered_map<std::string, Source> sources_;  // by id, of the current network
  std::vector<std::pair<const Element*, uint64_t>> objects_;
};

std::vector<const Element*> Networks::childrenOf(const Element& owner,
                                                 std::initializer_list<std::string_view> names) const {
  std::vector<const Element*> out;
  for (const Element* e = document_.firstChild(owner); e != nullptr; e = document_.next(*e))
    if (std::find(names.begin(), names.end(), e->name) != names.end()) out.push_back(e);
  return out;
}

// The element with this name in the AddData of `e`.
const Element* Networks::data(const Element& e, std::string_view name) const {
  for (const Element* all : childrenOf(e, {"AddData"}))
    for (const Element* one : childrenOf(*all, {"Data"}))
      for (const Element* found = document_.firstChild(*one); found != nullptr; found = document_.next(*found))
        if (found->name == name) return found;
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
  for (const Element* e = document_.firstChild(owner); e != nullptr; e = document_.next(*e)) {
    if (e->name != "Connection" && e->name != "FeedbackConnection") {
      ok = checkWires(*e) && ok;
      continue;
    }
    const xml::Attribute* from = document_.attribute(*e, "refConnectionPointOutId");
    const std::string id = document_.value(*e, "refConnectionPointOutId");
    if (from != nullptr && sources_.count(id) != 0) continue;
    import_.diagnostics.report(diag::WireFromNothing, from == nullptr ? e->loc : from->loc,
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
    if (keywordOf(*e).empty()) {
      const xml::Attribute* type_attribute = document_.attribute(*e, "type");
      import_.diagnostics.report(diag::ArchiveObject, type_attribute == nullptr ? e->loc : type_attribute->loc,
                                 {type.empty() ? e->name : type, "FBD or LD", name_});
      ok = false;
      continue;
    }
    const uint64_t number = ++last_element_;
    objects_.emplace_back(e, number);
    addOutput(*e, {number, nullptr, {}});
    for (const auto& [lists, own] : {std::pair{"InOutVariables", "IN"}, std::pair{"OutputVariables", "OUT"}})
      for (const Element* list : childrenOf(*e, {lists})) {
        size_t count = 0;
        for (const Element* pin = document_.firstChild(*list); pin != nullptr; pin = document_.next(*pin)) {
          const xml::Attribute* name = document_.attribute(*pin, "parameterName");
          const bool named = name != nullptr && isName(name->raw);
          addOutput(*pin, {number, named ? name : nullptr, otherName(own, ++count)});
        }
      }
    if (const Element* control = data(*e, "ExecutionControl"))
      if (const Element* eno = document_.child(*control, "Eno"))
        for (const Element* point : childrenOf(*eno, {"ConnectionPointOut"}))
          sources_[document_.value(*point, "connectionPointOutId")] = {number, nullptr, "ENO"};
  }
  return checkWires(network) && ok;
}

void Networks::writeWires(const Element& point) {
  bool first = true;
  for (const Element* c : childrenOf(point, {"Connection", "FeedbackConnection"})) {
    const xml::Attribute* from = document_.attribute(*c, "refConnectionPointOutId");
    const Source source = sources_[document_.value(*c, "refConnectionPointOutId")];
    if (!first) import_.out.word(" OR ");
    first = false;
    import_.out.put(from->loc, std::to_string(source.element));
    if (source.pin == nullptr && source.other.empty()) continue;
    import_.out.word("(");
    if (source.pin != nullptr)
      import_.out.add(document_, *source.pin);
    else
      import_.out.word(source.other);
    import_.out.word(")");
  }
}

void Networks::writeInput(const Element& e) {
  std::vector<const Element*> points = childrenOf(e, {"ConnectionPointIn"});
  std::erase_if(points, [&](const Element* p) { return childrenOf(*p, {"Connection", "FeedbackConnection"}).empty(); });
  bool first = true;
  for (const Element* point : points) {
    import_.out.word(first ? " := " : " OR ");
    first = false;
    writeWires(*point);
  }
}

void Networks::writeModifiers(const Element& e) {
  bool negated = isTrue(import_, e, "negated");
  if (const Element* own = data(e, "Negation"))
    negated = negated || isTrue(import_, *own, "inNegated") || isTrue(import_, *own, "outNegated");
  if (const Element* own = data(e, "negated")) negated = negated || isTrue(import_, *own, "value");
  if (negated) import_.out.word(" NOT");
  const std::string edge = document_.value(e, "edge");
  if (sameIdentifier(edge, "rising") || sameIdentifier(edge, "falling"))
    import_.out.word(sameIdentifier(edge, "rising") ? " RISING" : " FALLING");
  std::string latch = document_.value(e, "latch");
  if (const Element* own = data(e, "StorageMode")) latch = document_.value(*own, "mode");
  if (sameIdentifier(latch, "set") || sameIdentifier(latch, "reset"))
    import_.out.word(sameIdentifier(latch, "set") ? " SET" : " RESET");
}

// Bachmann numbers the execution order from 0 in each network.
void Networks::writeOrder(const Element& e) {
  const Element* priority = data(e, "EvaluationPriority");
  const xml::Attribute* order = priority == nullptr ? nullptr : document_.attribute(*priority, "priorityInNetwork");
  uint32_t number = 0;
  if (order == nullptr) return;
  const auto [end, error] = std::from_chars(order->raw.data(), order->raw.data() + order->raw.size(), number);
  if (error != std::errc{} || number > 1'000'000'000) return;
  order_end_ = std::max(order_end_, first_order_ + number + 1);
  import_.out.put(order->loc, " ORDER " + std::to_string(first_order_ + number));
}

void Networks::writePosition(const Element& e) {
  const Element* position = document_.child(e, "RelPosition");
  if (position == nullptr) return;
  const auto number = [&](const Element& from, std::string_view name) {
    const std::string text = document_.value(from, name);
    double v = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), v).ec != std::errc{} || !std::isfinite(v)) v = 0;
    return std::to_string(std::lround(std::clamp(v, -1e9, 1e9)));
  };
  std::string position_clause = " AT " + number(*position, "x") + ", " + number(*position, "y");
  if (const Element* size = document_.child(e, "Size"))
    position_clause += ", " + number(*size, "x") + ", " + number(*size, "y");
  import_.out.put(position->loc, position_clause);
}

// Names of connectors are arbitrary: in the notation they are converted to identifiers.
void Networks::writeReference(const Element& e, std::string_view attribute) {
  const xml::Attribute* name = document_.attribute(e, attribute);
  if (name == nullptr || name->raw.empty()) return;
  import_.out.word(" ");
  if (isName(name->raw)) return import_.out.add(document_, *name);
  std::string created = "n";
  for (const char c : name->raw) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    created += plain ? std::string(1, c) : std::to_string(static_cast<unsigned char>(c)) + "x";
  }
  import_.out.put(name->loc, created);
}

void Networks::writePin(const Element& pin, std::string_view other, bool input, bool output) {
  const xml::Attribute* name = document_.attribute(pin, "parameterName");
  if (name != nullptr && isName(name->raw))
    import_.out.add(document_, *name);
  else
    import_.out.put(pin.loc, other);
  writeModifiers(pin);
  if (input) {
    import_.out.word(" := ");
    for (const Element* point : childrenOf(pin, {"ConnectionPointIn"})) writeWires(*point);
  }
  if (output) import_.out.word(" =>");
}

void Networks::writeBox(const Element& e) {
  if (const xml::Attribute* type = document_.attribute(e, "typeName"); type != nullptr && !type->raw.empty()) {
    import_.out.word(" ");
    import_.out.add(document_, *type);
  }
  const xml::Attribute* instance = document_.attribute(e, "instanceName");
  if (instance != nullptr && !instance->raw.empty()) {
    import_.out.word(" (");
    import_.out.add(document_, *instance);
    import_.out.word(")");
  }
  writeOrder(e);
  writePosition(e);
  import_.out.word(" [");
  bool first = true;
  const auto separate = [&] {
    if (!first) import_.out.word(", ");
    first = false;
  };
  if (const Element* control = data(e, "ExecutionControl")) {
    if (const Element* en = document_.child(*control, "En")) {
      separate();
      writePin(*en, "EN", true, false);
    }
    if (const Element* eno = document_.child(*control, "Eno")) {
      separate();
      writePin(*eno, "ENO", false, true);
    }
  }
  for (const auto& [lists, pins] :
       {std::pair{"InputVariables", "InputVariable"}, std::pair{"InOutVariables", "InOutVariable"},
        std::pair{"OutputVariables", "OutputVariable"}}) {
    const std::string_view kind = pins;
    size_t count = 0;
    for (const Element* list : childrenOf(e, {lists}))
      for (const Element* pin : childrenOf(*list, {pins})) {
        separate();
        ++count;
        const std::string other = otherName(kind == "OutputVariable" ? "OUT" : "IN", count);
        writePin(*pin, other, kind != "OutputVariable", kind != "InputVariable");
      }
  }
  import_.out.word("]");
}

void Networks::writeObject(const Element& e, std::string_view word, uint64_t number) {
  import_.out.put(e.loc, std::string(word) + " " + std::to_string(number));
  if (word == "box") {
    writeBox(e);
  } else if (word == "comment") {
    const Element* content = document_.child(e, "Content");
    std::string text = content == nullptr ? std::string() : plcopen::textOf(import_, *content), quoted;
    for (const char c : text) {
      if (c == '\'' || c == '$') quoted += '$';
      quoted += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
    }
    import_.out.put(e.loc, " '" + quoted + "'");
  } else {
    if (word == "jump") writeReference(e, document_.attribute(e, "targetLabel") ? "targetLabel" : "targetNetworkLabel");
    if (word == "label" || word == "connector" || word == "continuation") writeReference(e, "label");
    const bool variable = word == "contact" || word == "coil" || word == "input" || word == "output";
    if (variable) {
      const xml::Attribute* operand =
          document_.attribute(e, word == "contact" || word == "coil" ? "operand" : "identifier");
      import_.out.word(" (");
      if (operand != nullptr) import_.out.add(document_, *operand);
      import_.out.word(")");
    }
    if (variable || word == "jump" || word == "return") writeModifiers(e);
    if (word != "input") writeOrder(e);
    writePosition(e);
    if (word != "rail" && word != "input" && word != "continuation" && word != "label") writeInput(e);
  }
  import_.out.word(";\n");
}

void Networks::writeNetwork(const Element& network) {
  first_order_ = order_end_;
  if (!collect(network)) return;
  import_.out.put(network.loc, "NETWORK " + std::to_string(++last_network_) + ";\n");
  if (plcopen::hasName(import_, network, "label")) {
    import_.out.put(network.loc, "label " + std::to_string(++last_element_));
    writeReference(network, "label");
    import_.out.word(";\n");
  }
  for (const auto& [e, number] : objects_) writeObject(*e, keywordOf(*e), number);
}

uint64_t orderOf(const Import& import, const Element& element) {
  const std::string text = import.document.value(element, "evaluationOrder");
  uint64_t order = 0;
  std::from_chars(text.data(), text.data() + text.size(), order);
  return order;
}

// Writes the networks of all sections as one body, with ST between them as execute boxes.
void Networks::write(const std::vector<const Element*>& contents) {
  const bool ladder =
      std::none_of(contents.begin(), contents.end(), [&](const Element* e) { return typeOf(import_, *e) == "FBD"; });
  import_.out.put(contents[0]->loc, ladder ? "{network LD}\n" : "{network FBD}\n");
  for (const Element* content : contents) {
    if (const Element* text = document_.child(*content, "ST")) {
      import_.out.put(text->loc, "NETWORK " + std::to_string(++last_network_) + ";\nexecute " +
                                     std::to_string(++last_element_) + " {network ST}\n");
      plcopen::writeText(import_, *text);
      import_.out.put(text->end, "\n{end_network};\n");
      continue;
    }
    std::vector<const Element*> networks = childrenOf(*content, {"Rung", "Network"});
    std::stable_sort(networks.begin(), networks.end(),
                     [&](const Element* a, const Element* b) { return orderOf(import_, *a) < orderOf(import_, *b); });
    for (const Element* network : networks) writeNetwork(*network);
  }
  import_.out.put(contents.back()->end, "{end_network}\n");
}

}  // namespace

// Forbids bodies in unsupported languages.
//   fails   <BodyContent xsi:type="SFC">          E1054
void writeMainBody(Import& import, const xml::Element& body, const std::string& name) {
  std::vector<const Element*> contents;
  bool drawn = false;
  for (const Element* e = import.document.firstChild(body); e != nullptr; e = import.document.next(*e)) {
    if (e->name != "BodyContent") continue;
    const std::string type = typeOf(import, *e);
    const bool text = type == "ST" || type == "IL";
    const bool networks = type == "LD" || type == "FBD" || type == "LdSection";
    if (!text && !networks) {
      const xml::Attribute* type_attribute = import.document.attribute(*e, "type");
      import.diagnostics.report(diag::XmlBodyLanguage, type_attribute == nullptr ? e->loc : type_attribute->loc,
                                {name, type});
      return;
    }
    drawn = drawn || networks;
    contents.push_back(e);
  }
  std::stable_sort(contents.begin(), contents.end(),
                   [&](const Element* a, const Element* b) { return orderOf(import, *a) < orderOf(import, *b); });
  if (drawn) return Networks(import, name).write(contents);
  for (const Element* content : contents)
    for (const std::string_view language : {"ST", "IL"})
      if (const Element* text = import.document.child(*content, language)) {
        import.out.put(text->loc, "");
        plcopen::writeText(import, *text);
        import.out.word("\n");
      }
}

}  // namespace rung::iec10

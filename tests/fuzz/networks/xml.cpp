// SPDX-License-Identifier: Apache-2.0
// Drawings as PLCopen TC6 XML, each editor with its habits: see docs/files.md.
#include <algorithm>
#include <map>

#include "tests/fuzz/generated/options.h"
#include "tests/fuzz/networks/drawing.h"

namespace rung::network_differential {
namespace {

constexpr const char* kVendorData = "http://www.3s-software.com/plcopenxml/";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

class Writer {
 public:
  Writer(const Drawing& drawing, Editor editor, uint64_t seed)
      : drawing_(drawing), editor_(editor), state_(seed + 99) {}
  std::string body();

 private:
  bool chance(unsigned percent) { return generated::nextRandom(state_) % 100 < percent; }
  bool vendor() const { return editor_ == Editor::Vendor; }
  uint64_t id(uint64_t number) const {
    const auto found = ids_.find(number);
    return found == ids_.end() ? number : found->second;
  }
  void number();
  std::string positionXml(const Element& e) const;
  std::string point(const Wires& wires, const Element& to);
  std::string pin(const Pin& pin, const Element& e, size_t at);
  std::string pinName(const Element& e, const Pin& pin, size_t at) const;
  std::string element(const Element& e);
  std::string box(const Element& e);
  std::string head(const std::string& kind, const Element& e, const std::string& more);
  static std::string sense(Sense edge) {
    return edge == Sense::None ? "" : edge == Sense::Rising ? " edge=\"rising\"" : " edge=\"falling\"";
  }

  const Drawing& drawing_;
  Editor editor_;
  uint64_t state_;
  std::map<uint64_t, uint64_t> ids_;
  std::map<uint64_t, const Element*> by_number_;
  std::string connectors_;  // those that CODESYS puts into each wire of a CFC
  uint64_t next_connector_ = 100000;
  unsigned first_order_ = 1;
};

void Writer::number() {
  std::map<unsigned, uint64_t> counts;
  for (const Element& e : drawing_.elements) {
    by_number_[e.number] = &e;
    if (vendor() && drawing_.language != Language::Ordered && drawing_.language != Language::Flow)
      ids_[e.number] = e.kind == "rail" ? 0 : e.network * 10000000000u + ++counts[e.network];
    if (vendor() && e.kind == "rail") ids_[e.number] = 0;
    if (editor_ == Editor::Ordered) ids_[e.number] = e.number * 4294967311u + 7;
    if (e.order == 1 && e.kind != "coil" && vendor()) first_order_ = 0;
  }
}

std::string Writer::positionXml(const Element& e) const {
  const bool pixels = editor_ == Editor::Pixels;
  return "<position x=\"" + std::to_string(pixels ? e.x : 0) + "\" y=\"" + std::to_string(pixels ? e.y : 0) + "\"/>";
}

std::string Writer::head(const std::string& kind, const Element& e, const std::string& more) {
  std::string text = "<" + kind + " localId=\"" + std::to_string(id(e.number)) + "\"" + more;
  if (e.order != 0 && e.kind != "input")
    text += " executionOrderId=\"" + std::to_string(e.order + first_order_ - 1) + "\"";
  if (editor_ == Editor::Pixels && e.kind == "box" && e.order == 0)
    text += " width=\"60\" height=\"40\" executionOrderId=\"0\"";
  if (editor_ == Editor::Pixels && e.kind == "contact") text += " width=\"21\" height=\"15\"";
  return text + ">" + positionXml(e);
}

// CODESYS gives the pins of operators no names.
std::string Writer::pinName(const Element& e, const Pin& pin, size_t at) const {
  const bool control = pin.name == "EN" || pin.name == "ENO";
  static constexpr const char* kOperators[] = {"AND", "OR", "XOR", "NOT", "ADD", "SUB", "MUL", "DIV", "MOD",
                                               "GT",  "GE", "LT",  "LE",  "EQ",  "NE",  "MAX", "MIN"};
  const bool named =
      std::none_of(std::begin(kOperators), std::end(kOperators), [&](const char* op) { return e.name == op; });
  if (vendor() && !control && !named) return pin.output ? "Out1" : "In" + std::to_string(at);
  if (editor_ == Editor::Plain && pin.output && pin.name == "OUT" && e.name != "Split") return "";
  return pin.name;
}

std::string Writer::point(const Wires& wires, const Element& to) {
  std::string text = "<connectionPointIn>";
  for (const Wire& wire : wires) {
    const Element& from = *by_number_.at(wire.from);
    uint64_t number = id(wire.from);
    std::string pin;
    if (from.kind == "box" || from.kind == "execute") {
      size_t outputs = 0, at = 0, inputs = 0;
      for (size_t k = 0; k < from.pins.size(); ++k) {
        if (from.pins[k].output && from.pins[k].name != "ENO") ++outputs;
        if (from.pins[k].name == wire.pin) at = k;
      }
      for (size_t k = 0; k <= at; ++k) inputs += !from.pins[k].output && from.pins[k].name != "EN" ? 1 : 0;
      pin = pinName(from, from.pins[at], inputs);
      if (outputs == 1 && wire.pin != "ENO" && chance(20)) pin.clear();
    } else if (vendor() && chance(30)) {
      pin = chance(50) ? "sfc" : from.operand;
    }
    if (vendor() && (drawing_.language == Language::Ordered || drawing_.language == Language::Flow)) {
      const uint64_t connector = next_connector_++;
      connectors_ += "<connector name=\"\" localId=\"" + std::to_string(connector) +
                     "\"><position x=\"0\" y=\"0\"/><connectionPointIn><connection refLocalId=\"" +
                     std::to_string(number) + "\" formalParameter=\"" + escaped(pin) +
                     "\"/></connectionPointIn></connector>\n";
      number = connector;
      pin.clear();
    }
    text += "<connection refLocalId=\"" + std::to_string(number) + "\"";
    if (!pin.empty()) text += " formalParameter=\"" + escaped(pin) + "\"";
    if (editor_ == Editor::Pixels)
      text += "><position x=\"" + std::to_string(to.x) + "\" y=\"" + std::to_string(to.y) + "\"/><position x=\"" +
              std::to_string(from.x) + "\" y=\"" + std::to_string(from.y) + "\"/></connection>";
    else
      text += "/>";
  }
  return text + "</connectionPointIn>";
}

std::string Writer::pin(const Pin& pin, const Element& e, size_t at) {
  std::string text = "<variable formalParameter=\"" + pinName(e, pin, at) + "\"" + sense(pin.edge);
  if (pin.negated) text += " negated=\"true\"";
  if (!pin.storage.empty()) text += " storage=\"" + pin.storage + "\"";
  text += ">";
  if (!pin.output && !pin.wires.empty()) text += point(pin.wires, e);
  if (pin.output || pin.in_out) text += "<connectionPointOut/>";
  return text + "</variable>";
}

std::string Writer::box(const Element& e) {
  const bool execute = e.kind == "execute";
  std::string more = " typeName=\"" + (execute ? "EXECUTE" : e.name) + "\"";
  if (!e.operand.empty()) more += " instanceName=\"" + e.operand + "\"";
  std::string text = head("block", e, more);
  const auto list = [&](const char* name, bool input, bool in_out) {
    text += std::string("<") + name + ">";
    size_t at = 0;
    for (const Pin& p : e.pins) {
      if (p.output == input || p.in_out != in_out) continue;
      at += p.name == "EN" ? 0 : 1;
      text += pin(p, e, at);
    }
    text += std::string("</") + name + ">";
  };
  list("inputVariables", true, false);
  list("inOutVariables", true, true);
  list("outputVariables", false, false);
  if (execute || vendor()) {
    text += "<addData>";
    if (execute)
      text += std::string("<data name=\"") + kVendorData + "stcode\" handleUnknown=\"implementation\"><STCode>" +
              escaped(e.statements) + "</STCode></data>";
    if (vendor())
      text += std::string("<data name=\"") + kVendorData + "fbdcalltype\" handleUnknown=\"implementation\"><CallType>" +
              (execute              ? "execute"
               : !e.operand.empty() ? "functionblock"
                                    : "operator") +
              "</CallType></data>";
    text += "</addData>";
  }
  return text + "</block>\n";
}

std::string Writer::element(const Element& e) {
  const auto input = [&] { return e.pins.empty() ? std::string() : point(e.pins[0].wires, e); };
  const std::string negated = e.negated ? " negated=\"true\"" : vendor() ? " negated=\"false\"" : "";
  if (e.kind == "box" || e.kind == "execute") return box(e);
  if (e.kind == "rail")
    return head("leftPowerRail", e, "") + "<connectionPointOut formalParameter=\"\"/></leftPowerRail>\n";
  if (e.kind == "contact")
    return head("contact", e, negated + sense(e.edge)) + input() + "<connectionPointOut/><variable>" +
           escaped(e.operand) + "</variable></contact>\n";
  if (e.kind == "coil")
    return head("coil", e, negated + sense(e.edge) + (e.storage.empty() ? "" : " storage=\"" + e.storage + "\"")) +
           input() + "<connectionPointOut/><variable>" + escaped(e.operand) + "</variable></coil>\n";
  if (e.kind == "input")
    return head("inVariable", e, negated) + "<connectionPointOut/><expression>" + escaped(e.operand) +
           "</expression></inVariable>\n";
  if (e.kind == "output")
    return head("outVariable", e, negated) + input() + "<expression>" + escaped(e.operand) +
           "</expression></outVariable>\n";
  if (e.kind == "inout")
    return head("inOutVariable", e, "") + "<connectionPointIn/><connectionPointOut/><expression>" + escaped(e.operand) +
           "</expression></inOutVariable>\n";
  if (e.kind == "comment")
    return head("comment", e, " height=\"30\" width=\"100\"") +
           "<content><xhtml:p xmlns:xhtml=\"http://www.w3.org/1999/xhtml\"><![CDATA[" + e.statements +
           "]]></xhtml:p></content></comment>\n";
  if (e.kind == "label") return head("label", e, " label=\"" + e.name + "\"") + "</label>\n";
  if (e.kind == "jump" || e.kind == "return") {
    const std::string name = e.kind == "jump" ? " label=\"" + e.name + "\"" : "";
    const bool by_data = editor_ == Editor::Ordered && e.negated;
    return head(e.kind, e, name + (by_data ? "" : negated)) + input() +
           (by_data ? "<addData><data name=\"www.bachmann.at/plc/plcopenxml/negated\" handleUnknown=\"implementation\">"
                      "<negated value=\"true\"/></data></addData>"
                    : "") +
           "</" + e.kind + ">\n";
  }
  if (e.kind == "connector") return head("connector", e, " name=\"" + e.name + "\"") + input() + "</connector>\n";
  return head("continuation", e, " name=\"" + e.name + "\"") + "<connectionPointOut/></continuation>\n";
}

std::string Writer::body() {
  number();
  const bool cfc = drawing_.language == Language::Ordered || drawing_.language == Language::Flow;
  const std::string kind = drawing_.language == Language::Ladder ? "LD"
                           : cfc && editor_ != Editor::Ordered   ? "CFC"
                                                                 : "FBD";
  std::vector<const Element*> order;
  for (const Element& e : drawing_.elements) order.push_back(&e);
  if (editor_ == Editor::Pixels)
    for (size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[generated::nextRandom(state_) % k]);
  std::string text, right;
  bool has_rail = false;
  unsigned network = 0;
  for (const Element* e : order) {
    if (vendor() && e->kind == "rail") {
      if (!has_rail) text += element(*e);
      has_rail = true;
      continue;
    }
    if (vendor() && !cfc && e->network != network) {
      network = e->network;
      text +=
          "<vendorElement localId=\"" + std::to_string(network * 10000000000u) +
          "\"><position x=\"0\" y=\"0\"/><alternativeText><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">title</xhtml>"
          "</alternativeText><addData><data name=\"" +
          kVendorData +
          "fbdelementtype\" handleUnknown=\"implementation\"><ElementType>networktitle</ElementType></data>"
          "</addData></vendorElement>\n";
    }
    text += element(*e);
    if (e->kind == "coil") right += "<connection refLocalId=\"" + std::to_string(id(e->number)) + "\"/>";
  }
  if (drawing_.language == Language::Ladder)
    text += "<rightPowerRail localId=\"2147483646\"><position x=\"0\" y=\"0\"/><connectionPointIn>" + right +
            "</connectionPointIn></rightPowerRail>\n";
  text = "<" + kind + ">\n" + text + connectors_ + "</" + kind + ">\n";
  if (cfc && vendor())
    return std::string("<body><ST><xhtml xmlns=\"http://www.w3.org/1999/xhtml\"/></ST><addData><data name=\"") +
           kVendorData + "cfc\" handleUnknown=\"implementation\">" + text + "</data></addData></body>\n";
  return "<body>" + text + "</body>\n";
}

// `a, b : BOOL; list : ARRAY[1..2] OF DINT; ` as structured variables.
std::string structured(const std::string& section, const std::string& text) {
  std::string out = "<" + section + ">";
  for (size_t at = 0; at < text.size();) {
    const size_t end = text.find(';', at), colon = text.find(" : ", at);
    if (end == std::string::npos) break;
    const std::string type = text.substr(colon + 3, end - colon - 3);
    std::string type_xml;
    if (type.compare(0, 6, "ARRAY[") == 0) {
      const size_t dots = type.find(".."), close = type.find(']');
      type_xml = "<array><dimension lower=\"" + type.substr(6, dots - 6) + "\" upper=\"" +
                 type.substr(dots + 2, close - dots - 2) + "\"/><baseType><" + type.substr(close + 5) +
                 "/></baseType></array>";
    } else if (type == "BOOL" || type == "INT" || type == "DINT" || type == "REAL" || type == "WORD" ||
               type == "TIME") {
      type_xml = "<" + type + "/>";
    } else {
      type_xml = "<derived name=\"" + type + "\"/>";
    }
    for (size_t name = at; name < colon;) {
      size_t comma = std::min(text.find(',', name), colon);
      out += "<variable name=\"" + text.substr(name, comma - name) + "\"><type>" + type_xml + "</type></variable>\n";
      name = comma + 2;
    }
    at = end + 2;
  }
  return out + "</" + section + ">";
}

std::string interfaceOf(const Logic& logic, const std::string& name, Editor editor) {
  const std::string text = declarations(logic);
  if (editor == Editor::Vendor)
    return std::string("<interface><addData><data name=\"") + kVendorData +
           "interfaceasplaintext\" handleUnknown=\"implementation\"><InterfaceAsPlainText><xhtml "
           "xmlns=\"http://www.w3.org/1999/xhtml\">" +
           "FUNCTION_BLOCK " + name + "\n" + escaped(text) +
           "</xhtml></InterfaceAsPlainText></data></addData></interface>\n";
  std::string out = "<interface>";
  const std::pair<const char*, const char*> sections[] = {
      {"VAR_INPUT ", "inputVars"}, {"VAR_OUTPUT ", "outputVars"}, {"VAR ", "localVars"}};
  for (const auto& [word, section] : sections) {
    const size_t at = text.find(word) + std::string(word).size();
    out += structured(section, text.substr(at, text.find("END_VAR", at) - at));
  }
  return out + "</interface>\n";
}

}  // namespace

std::string xmlPou(const Logic& logic, const Drawing& drawing, const std::string& name, Editor editor, uint64_t seed) {
  return "<pou name=\"" + name + "\" pouType=\"functionBlock\">\n" + interfaceOf(logic, name, editor) +
         Writer(drawing, editor, seed).body() + "</pou>\n";
}

std::string xmlProject(const std::string& pous, Editor editor) {
  const char* space =
      editor == Editor::Pixels ? "http://www.plcopen.org/xml/tc6_0201" : "http://www.plcopen.org/xml/tc6_0200";
  return std::string(editor == Editor::Vendor ? "\xEF\xBB\xBF" : "") +
         "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<project xmlns=\"" + space +
         "\"><fileHeader companyName=\"\" productName=\"generated\" productVersion=\"1\" "
         "creationDateTime=\"2026-01-01T00:00:00\"/>"
         "<contentHeader name=\"generated\"/>\n<types><dataTypes/><pous>\n" +
         pous + "</pous></types><instances><configurations/></instances></project>\n";
}

}  // namespace rung::network_differential

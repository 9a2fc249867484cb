// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/network_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "frontend/source/scanner.h"
#include "frontend/syntax/standard_names.h"

namespace rung::importer {
namespace {

// A string of the notation, on one line.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\r' && k + 1 < text.size() && text[k + 1] == '\n') continue;
    if (c == '\'' || c == '$') out += '$';
    out += c == '\n' || c == '\r' ? "$N" : c == '\t' ? "$T" : std::string(1, c);
  }
  return out + "'";
}

// `n` and the characters of the name, those that identifiers cannot have by their codes.
std::string createdLabel(std::string_view spelling) {
  std::string created = "n";
  for (const char c : spelling)
    created += isNameCharacter(c) ? std::string(1, c) : std::to_string(static_cast<unsigned char>(c)) + "x";
  return created;
}

std::string_view functionOf(std::string_view symbol) {
  static constexpr std::pair<std::string_view, std::string_view> kSymbols[] = {
      {"=", "EQ"},  {"<>", "NE"}, {"<", "LT"},  {">", "GT"},  {"<=", "LE"},   {">=", "GE"},  {"+", "ADD"},
      {"-", "SUB"}, {"*", "MUL"}, {"/", "DIV"}, {"&", "AND"}, {"**", "EXPT"}, {":=", "MOVE"}};
  for (const auto& [known, function] : kSymbols)
    if (symbol == known) return function;
  return {};
}

std::string_view wordOf(NetworkLanguage language) {
  switch (language) {
    case NetworkLanguage::Ladder: return "LD";
    case NetworkLanguage::Blocks: return "FBD";
    case NetworkLanguage::Continuous: return "CFC";
  }
  return {};
}

}  // namespace

std::string clauseOf(const Area& area) {
  if (!area.placed) return {};
  std::string clause = " AT " + std::to_string(area.x) + ", " + std::to_string(area.y);
  if (area.width != 0 || area.height != 0)
    clause += ", " + std::to_string(area.width) + ", " + std::to_string(area.height);
  return clause;
}

void NetworkWriter::beginBody(Loc loc, NetworkLanguage language) {
  out_.put(loc, "{network " + std::string(wordOf(language)) + "}\n");
}

void NetworkWriter::beginNetwork(Loc loc, uint64_t number, bool disabled, std::string_view title) {
  out_.put(loc, "NETWORK " + std::to_string(number) + (disabled ? " DISABLED" : ""));
  if (!title.empty()) out_.word(" " + quoted(title));
  out_.word(";\n");
}

// The inputs of SEL and MUX that a file numbers, In1, In2 and In3, by their names G, IN0 and IN1, or K, IN0 and IN1.
void NetworkWriter::nameSelectorPins(std::string_view selector, std::vector<NetworkPin>& pins) const {
  std::vector<NetworkPin*> inputs;
  for (NetworkPin& pin : pins)
    if (pin.direction == PinDirection::Input && !sameIdentifier(out_.spellingOf(pin.name), kEnable))
      inputs.push_back(&pin);
  for (size_t i = 0; i < inputs.size(); ++i)
    if (!sameIdentifier(out_.spellingOf(inputs[i]->name), "IN" + std::to_string(i + 1))) return;
  for (size_t i = 0; i < inputs.size(); ++i)
    inputs[i]->name = {inputs[i]->name.begin(), i == 0 ? std::string(selector) : "IN" + std::to_string(i - 1)};
}

void NetworkWriter::write(NetworkElement element) {
  if (element.kind == ElementKind::Box && element.operand.empty()) {
    const std::string called = out_.spellingOf(element.name);
    if (const std::string_view function = functionOf(called); !function.empty())
      element.name = {element.name.begin(), std::string(function)};
    if (sameIdentifier(called, "SEL")) nameSelectorPins("G", element.pins);
    if (sameIdentifier(called, "MUX")) nameSelectorPins("K", element.pins);
  }
  writeParts(element);
  if (!element.statements.empty()) {
    out_.word(" {network ST}\n");
    out_.add(element.statements);
    out_.word("\n{end_network}");
  }
  out_.word(";\n");
}

void NetworkWriter::beginStatements(const NetworkElement& element) {
  writeParts(element);
  out_.word(" {network ST}\n");
}

void NetworkWriter::writeParts(const NetworkElement& e) {
  out_.put(e.loc, std::string(kElementWords[static_cast<size_t>(e.kind)]) + " ");
  out_.add(e.number);
  if (!e.name.empty()) {
    out_.word(" ");
    out_.add(e.name);
  }
  if (!e.operand.empty()) {
    out_.word(" (");
    out_.add(e.operand);
    out_.word(")");
  }
  if (!e.comment.empty()) out_.put(e.loc, " " + quoted(e.comment));
  writeModifiers(e.modifiers);
  if (e.holding) out_.word(" HOLDING");
  if (e.order != 0) out_.word(" ORDER " + std::to_string(e.order));
  out_.word(clauseOf(e.area));
  if (e.has_pins || !e.pins.empty()) writePins(e.pins);
  if (e.input.empty()) return;
  out_.word(" := ");
  writeWires(e.input);
}

void NetworkWriter::writeModifiers(const Modifiers& modifiers) {
  if (modifiers.negated) out_.word(" NOT");
  if (modifiers.edge != EdgeKind::None) out_.word(modifiers.edge == EdgeKind::Rising ? " RISING" : " FALLING");
  if (modifiers.storage != PinStorage::None) out_.word(modifiers.storage == PinStorage::Set ? " SET" : " RESET");
}

void NetworkWriter::writePins(const std::vector<NetworkPin>& pins) {
  const char* before = " [";
  for (const NetworkPin& pin : pins) {
    out_.word(before);
    before = ", ";
    out_.add(pin.name);
    writeModifiers(pin.modifiers);
    if (pin.direction != PinDirection::Output) {
      out_.word(" := ");
      writeWires(pin.wires);
    }
    if (pin.direction != PinDirection::Input) out_.word(" =>");
  }
  out_.word(pins.empty() ? " []" : "]");
}

void NetworkWriter::writeWires(const std::vector<WireSource>& wires) {
  bool first = true;
  for (const WireSource& wire : wires) {
    if (!first) out_.word(" OR ");
    first = false;
    out_.add(wire.element);
    if (wire.pin.empty()) continue;
    out_.word("(");
    out_.add(wire.pin);
    out_.word(")");
  }
}

xml::Excerpt labelOf(xml::Excerpt name, std::string_view spelling) {
  if (spelling.empty() || isIdentifier(spelling)) return name;
  return {name.begin(), createdLabel(spelling)};
}

xml::Excerpt connectorOf(xml::Excerpt name, std::string_view spelling) {
  if (spelling.empty() || isIdentifier(spelling)) return name;
  return {name.begin(), quoted(spelling)};
}

std::string unnamedPin(PinDirection direction, size_t nth) {
  if (direction != PinDirection::Output) return "IN" + std::to_string(nth);
  return nth == 1 ? "OUT" : "OUT" + std::to_string(nth);
}

int32_t coordinateOf(std::string_view text) {
  double v = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), v).ec != std::errc{} || !std::isfinite(v)) return 0;
  return static_cast<int32_t>(std::lround(std::clamp(v, -1e9, 1e9)));
}

EdgeKind edgeOf(std::string_view word) {
  if (sameIdentifier(word, "rising")) return EdgeKind::Rising;
  return sameIdentifier(word, "falling") ? EdgeKind::Falling : EdgeKind::None;
}

PinStorage storageOf(std::string_view word) {
  if (sameIdentifier(word, "set")) return PinStorage::Set;
  return sameIdentifier(word, "reset") ? PinStorage::Reset : PinStorage::None;
}

}  // namespace rung::importer

// SPDX-License-Identifier: Apache-2.0
// The notation of networks, between {network} and {end_network}. All readers of LD, FBD and CFC (TC6 XML, TwinCAT
// archives) write it into source-mapped text, and tests write it by hand, so that expressions, locations and errors
// come from one parser. Wires are numbers, resolved once at the end, so dangling and repeated ids have one message for
// all formats. docs/networks.md describes it completely.
//   body    = "{network" [LD | FBD | CFC] "}" {NETWORK number [DISABLED] [title] ";" | element ";"} "{end_network}"
//   element = word number [name | string] {"(" e ")" | NOT | RISING | FALLING | SET | RESET | HOLDING
//                          | ORDER n | AT x, y [, w, h]
//                          | ":=" wires | pins | statements}
//   pins    = "[" pin {"," pin} "]"
//   name    = identifier | keyword | string, for a name with other characters: of a connector, or in a picture
//   pin     = name {NOT | RISING | FALLING | SET | RESET} (":=" [wires] ["=>"] | "=>")
//   wires   = number ["(" pin ")"] {OR number ["(" pin ")"]}
//   statements = "{network ST}" statements "{end_network}"
#include <algorithm>
#include <charconv>
#include <utility>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/network.h"
#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/diagram.h"

namespace rung::text {
namespace {

// The variable or expression of the element is mandatory.
bool needsOperand(ElementKind kind) {
  return kind == ElementKind::Contact || kind == ElementKind::Coil || kind == ElementKind::Input ||
         kind == ElementKind::Output || kind == ElementKind::InOut;
}

// Its name follows the number, even if it is a keyword.
bool isNamed(ElementKind kind) {
  return kind == ElementKind::Box || kind == ElementKind::Jump || kind == ElementKind::Label ||
         kind == ElementKind::Connector || kind == ElementKind::Continuation || kind == ElementKind::Compose ||
         kind == ElementKind::Select;
}

// The characters between the quotes; `$N` is a new line, `$T` a tab, `$` and another character that character.
std::string plainText(std::string_view quoted) {
  std::string out;
  for (size_t k = 1; k + 1 < quoted.size(); ++k) {
    const bool escaped = quoted[k] == '$' && k + 2 < quoted.size();
    if (escaped) ++k;
    const char c = foldedCharacter(quoted[k]);
    out += escaped && c == 'n' ? '\n' : escaped && c == 't' ? '\t' : quoted[k];
  }
  return out;
}

}  // namespace

// Takes a keyword of any kind as a name: pins and boxes are called AND, MOD, DO. A string has any characters.
bool NetworkParser::takeWord(Ident& out) {
  if (at(Tok::StringLiteral)) {
    out = {names_.intern(plainText(textOf(t_))), here()};
    advance();
    return true;
  }
  const bool word = (isName(kind()) || nameReserved(t_)) && !(atLineStart() && lineEnds());
  if (!word) {
    fail(diag::MissingName, t_, {describe(t_)});
    return false;
  }
  out = {isName(kind()) ? nameOf(t_) : names_.intern(textOf(t_)), here()};
  advance();
  return true;
}

bool NetworkParser::takeNumber(uint64_t& out) {
  const std::string_view digits = at(Tok::Number) ? textOf(t_) : std::string_view{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out);
  if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size()) {
    fail(diag::ElementNumber, t_, {describe(t_)});
    return false;
  }
  advance();
  return true;
}

bool NetworkParser::takeCoordinate(int32_t& out) {
  const bool minus = accept(Tok::Minus);
  uint64_t value = 0;
  if (!takeNumber(value)) return false;
  const auto limited = static_cast<int32_t>(std::min<uint64_t>(value, 1u << 30));
  out = minus ? -limited : limited;
  return true;
}

// NOT, RISING, FALLING, SET, RESET
template <class Modifiable>
bool NetworkParser::takeModifier(Modifiable& out) {
  if (at(Tok::Not)) {
    out.negated = !out.negated;
  } else if (is(t_, "RISING")) {
    out.edge = EdgeKind::Rising;
  } else if (is(t_, "FALLING")) {
    out.edge = EdgeKind::Falling;
  } else if (is(t_, "SET")) {
    out.storage = PinStorage::Set;
  } else if (is(t_, "RESET")) {
    out.storage = PinStorage::Reset;
  } else {
    return false;
  }
  advance();
  return true;
}

// wires = number ["(" pin ")"] {OR number ["(" pin ")"]}
void NetworkParser::parseWires(DiagramPin& pin) {
  const size_t first = wires_.size();
  do {
    DiagramWire wire{kNoElement, {}, here()};
    uint64_t number = 0;
    if (!takeNumber(number)) break;
    if (accept(Tok::LeftParen)) {
      if (!takeWord(wire.pin)) break;
      if (!expect(Tok::RightParen)) break;
    }
    wires_.push_back(wire);
    wire_numbers_.push_back(number);
  } while (accept(Tok::Or));
  pin.wires = listFrom(wires_, first);
}

// pins = [pin {"," pin}] "]"; pin = name {modifier} (":=" [wires] ["=>"] | "=>")
void NetworkParser::parsePins(std::vector<DiagramPin>& out) {
  while (!panic_ && !at(Tok::RightBracket)) {
    DiagramPin pin{};
    if (!takeWord(pin.name)) return;
    while (takeModifier(pin)) {
    }
    if (accept(Tok::Arrow)) {
      pin.direction = PinDirection::Output;
    } else {
      if (!expect(Tok::Assign)) return;
      if (at(Tok::Number)) parseWires(pin);
      if (!panic_ && accept(Tok::Arrow)) pin.direction = PinDirection::InOut;
    }
    out.push_back(pin);
    if (!accept(Tok::Comma)) break;
  }
  if (!panic_) expect(Tok::RightBracket);
}

// path = name {"." name}: the callee of a box, the label of a jump.
ExprId NetworkParser::parseElementPath(Ident& name) {
  if (!takeWord(name)) return {};
  ExprId path = ended(build_.name(name));
  while (accept(Tok::Dot)) {
    Ident member;
    if (!takeWord(member)) return {};
    path = ended(build_.member(path, member.name, member.loc));
  }
  return path;
}

// ORDER n
void NetworkParser::parseOrder(DiagramElement& e) {
  advance();
  uint64_t order = 0;
  const Token* const number = t_;
  if (takeNumber(order) && order == 0) slip(diag::OrderZero, number);
  e.order = static_cast<uint32_t>(std::min<uint64_t>(order, UINT32_MAX));
}

// AT x, y [, w, h]
void NetworkParser::parsePosition(DiagramElement& e) {
  advance();
  int32_t* const coordinates[] = {&e.x, &e.y, &e.width, &e.height};
  for (int32_t* const coordinate : coordinates)
    if (!takeCoordinate(*coordinate) || !accept(Tok::Comma)) break;
  e.placed = true;
}

// NETWORK statements END_NETWORK
void NetworkParser::parseStatementsOf(DiagramElement& e) {
  advance();
  ++stmt_depth_;
  e.body = parseStatements(0);
  --stmt_depth_;
  panic_ = false;
  expect(Tok::EndNetwork);
}

// part = modifier | HOLDING | ORDER n | AT x, y [, w, h] | "(" [expr] ")" | ":=" wires | "[" pins | statements | string
void NetworkParser::parsePart(DiagramElement& e, std::vector<DiagramPin>& pins, std::string_view word) {
  if (takeModifier(e)) return;
  if (e.kind == ElementKind::Coil && is(t_, "HOLDING")) {
    e.holding = true;
    advance();
  } else if (is(t_, "ORDER") && peek() == Tok::Number) {
    parseOrder(e);
  } else if (is(t_, "AT") && (peek() == Tok::Number || peek() == Tok::Minus)) {
    parsePosition(e);
  } else if (accept(Tok::LeftParen)) {
    if (accept(Tok::RightParen)) return;
    e.operand = parseExpr();
    if (!panic_) expect(Tok::RightParen);
  } else if (accept(Tok::Assign)) {
    DiagramPin pin{};
    parseWires(pin);
    pins.push_back(pin);
  } else if (accept(Tok::LeftBracket)) {
    parsePins(pins);
  } else if (at(Tok::Network)) {
    parseStatementsOf(e);
  } else if (at(Tok::StringLiteral) && needsOperand(e.kind) && !e.operand) {
    Ident name;
    if (takeWord(name)) e.operand = ended(build_.name(name));
  } else if (at(Tok::StringLiteral)) {
    const StringId text = tree_.addString(plainText(textOf(t_)));
    e.comment = text.first;
    e.comment_length = text.length;
    advance();
  } else {
    fail(diag::NoPartOfElement, t_, {describe(t_), word});
  }
}

// element = word number [path] {part}
void NetworkParser::parseElement(std::vector<DiagramElement>& out, uint32_t network) {
  const Token* word = t_;
  const auto* known =
      std::find_if(std::begin(kElementWords), std::end(kElementWords), [&](std::string_view w) { return is(word, w); });
  if (known == std::end(kElementWords)) {
    fail(diag::NoElement, t_, {textOf(t_)});
    return;
  }
  advance();
  DiagramElement e{};
  e.kind = static_cast<ElementKind>(known - std::begin(kElementWords));
  e.network = network;
  e.loc = here();
  if (!takeNumber(e.number)) return;
  const Token* named = t_;
  const bool attribute = is(t_, "AT") || is(t_, "ORDER");
  const bool begins_name = isName(kind()) || nameReserved(t_) || at(Tok::StringLiteral);
  if (isNamed(e.kind) && begins_name && begins(t_) == Begins::Nothing && !(attribute && peek() == Tok::Number))
    e.path = parseElementPath(e.name);
  std::vector<DiagramPin> pins;
  while (!panic_ && !at(Tok::Semicolon) && !at(Tok::End)) parsePart(e, pins, *known);
  e.end = here();
  if (panic_) return;
  const bool open =
      (e.kind == ElementKind::Box || e.kind == ElementKind::Jump || e.kind == ElementKind::Label) && !e.name.name;
  if (open || (needsOperand(e.kind) && !e.operand)) {
    fail(diag::ElementUnnamed, named - 1, {*known, open ? "name" : "variable"});
    return;
  }
  e.pins = tree_.addList<DiagramPin>(pins);
  out.push_back(e);
}

// Resolves the numbers in wires to elements.
//   fails   output 5 (y) := 3;  without an element 3                             E1001
//   fails   two elements 3                                                       E1002
void NetworkParser::connectWires(std::span<const DiagramElement> elements) {
  std::vector<std::pair<uint64_t, uint32_t>> numbers;
  numbers.reserve(elements.size());
  for (uint32_t k = 0; k < elements.size(); ++k) numbers.emplace_back(elements[k].number, k);
  std::sort(numbers.begin(), numbers.end());
  for (size_t k = 1; k < numbers.size(); ++k) {
    if (numbers[k].first != numbers[k - 1].first) continue;
    diagnostics_
        .report(diag::DuplicateElementNumber, elements[numbers[k].second].loc, {std::to_string(numbers[k].first)})
        .declaredHere(elements[numbers[k - 1].second].loc);
  }
  size_t next = 0;  // of wire_numbers_, which are in the order of the file
  for (const DiagramElement& element : elements) {
    for (const DiagramPin& pin : tree_.list(element.pins)) {
      for (DiagramWire& wire : tree_.list(pin.wires)) {
        const uint64_t number = wire_numbers_[next++];
        const auto found = std::lower_bound(numbers.begin(), numbers.end(), std::pair{number, 0u});
        if (found != numbers.end() && found->first == number)
          wire.from = found->second;
        else
          diagnostics_.report(diag::WireFromNothing, wire.loc, {std::to_string(number)});
      }
    }
  }
}

// body = "{network" [LD | FBD | CFC] "}" {NETWORK number [DISABLED] [title] ";" | element ";"} "{end_network}"
void NetworkParser::parseNetworks(PouDecl& d) {
  const Token* open = t_;
  const std::string_view opener = textOf(t_);
  d.body_kind = BodyKind::Network;
  d.diagram.language = opener.find("CFC") != std::string_view::npos   ? NetworkLanguage::Continuous
                       : opener.find("FBD") != std::string_view::npos ? NetworkLanguage::Blocks
                                                                      : NetworkLanguage::Ladder;
  advance();
  const uint32_t errors = diagnostics_.errorCount();
  std::vector<DiagramElement> elements;
  std::vector<DiagramNetwork> networks;
  uint32_t network = 0;
  while (!at(Tok::EndNetwork) && !at(Tok::End) && !atBlockEnd()) {
    panic_ = false;
    const Token* const first = t_;
    if (is(t_, "NETWORK")) {
      advance();
      DiagramNetwork n{};
      n.loc = here();
      uint64_t number = 0;
      if (takeNumber(number)) {
        n.number = static_cast<uint32_t>(std::min<uint64_t>(number, UINT32_MAX));
        if (is(t_, "DISABLED")) {
          n.disabled = true;
          advance();
        }
        if (at(Tok::StringLiteral)) {
          const StringId title = tree_.addString(plainText(textOf(t_)));
          n.title = title.first;
          n.title_length = title.length;
          advance();
        }
        networks.push_back(n);
        network = static_cast<uint32_t>(networks.size());
      }
    } else {
      parseElement(elements, network);
    }
    if (!panic_) expect(Tok::Semicolon);
    if (panic_ && (!atUnfinished() || t_ == first)) {
      const Skipping skipping(*this);
      while (!at(Tok::Semicolon) && !at(Tok::EndNetwork) && !at(Tok::End) && !endsPart(kind())) advance();
      accept(Tok::Semicolon);
    }
  }
  panic_ = false;
  const bool cut_off = at(Tok::End) && diagnostics_.errorCount() != errors;  // which was reported
  if (!accept(Tok::EndNetwork) && !cut_off) {
    missingEnd("{end_network}", open, "{network}");
  }
  if (diagnostics_.errorCount() == errors) connectWires(elements);
  wire_numbers_.clear();
  if (diagnostics_.errorCount() != errors) {  // elements with syntax errors would be reported as missing
    d.body_kind = BodyKind::None;
    return;
  }
  d.diagram.networks = tree_.addList<DiagramNetwork>(networks);
  d.diagram.elements = tree_.addList<DiagramElement>(elements);
}

}  // namespace rung::text

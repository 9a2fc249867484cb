// SPDX-License-Identifier: Apache-2.0
// Draws a module rung by rung; see drawing.h. The power of a row is the list of elements that its next element is wired
// to, as in the notation: several are joined by OR.
#include "frontend/import/nct/drawing.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "frontend/import/nct/bodies.h"
#include "frontend/import/network_writer.h"
#include "frontend/source/names.h"

namespace rung::importer::nct {
namespace {

using Feed = std::vector<WireSource>;

// A name that may have any characters.
std::string drawnName(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '$') out += '$';
    out += c;
  }
  return out + "'";
}

// @ and % of a contact are edges, which its symbol shows.
std::string_view withoutQuery(std::string_view operand) {
  return operand.starts_with('@') || operand.starts_with('%') ? operand.substr(1) : operand;
}
EdgeKind queryOf(std::string_view operand) {
  if (operand.starts_with('@')) return EdgeKind::Rising;
  return operand.starts_with('%') ? EdgeKind::Falling : EdgeKind::None;
}

// CGE a b and FLGE a b read as a >= b.
std::string_view relationOf(std::string_view word) {
  static constexpr std::pair<std::string_view, std::string_view> kRelations[] = {
      {"LT", " < "}, {"LE", " <= "}, {"EQ", " = "}, {"NE", " <> "}, {"GE", " >= "}, {"GT", " > "}};
  for (const auto& [ending, sign] : kRelations)
    if (sameIdentifier(word.substr(word.size() - 2), ending)) return sign;
  return " ? ";
}

class Drawer {
 public:
  explicit Drawer(xml::SourceMappedText& out) : out_(out), writer_(out) {}

  void draw(const Module& module, const std::string& name) {
    if (!module.given) return;
    elements_ = module.elements;
    next_number_ = 1;
    uint64_t network = 0;
    out_.put(module.loc, "PROGRAM " + name + "\n");
    writer_.beginBody(module.loc, NetworkLanguage::Ladder);
    rail_ = write(ElementKind::Rail, module.loc, {});
    for (uint32_t k = 0; k < elements_.size();) {
      const Element& element = elements_[k++];
      const uint32_t first = k;
      if (element.shape == Shape::Rung)
        while (k < elements_.size() && elements_[k].shape != Shape::Rung && elements_[k].shape != Shape::Marker) ++k;
      writer_.beginNetwork(element.word.loc, ++network, false, titleOf(element));
      nodes_.clear();
      if (element.shape == Shape::Rung && !element.is_broken) drawSeries(first, k, {rail_});
    }
    writer_.endBody(module.loc);
    out_.put(module.loc, "END_PROGRAM\n");
  }

 private:
  // Its remark; a marker names itself: `SBN 4: tool change`.
  static std::string titleOf(const Element& element) {
    std::string title;
    if (element.shape == Shape::Marker) {
      title = std::string(element.word.text);
      for (uint32_t k = 0; k < element.operand_count; ++k) title += " " + std::string(element.operands[k].text);
    }
    if (!title.empty() && !element.remark.empty()) title += ": ";
    return title + std::string(element.remark);
  }

  // The power after the elements; empty: the row is closed.
  Feed drawSeries(uint32_t begin, uint32_t end, Feed power) {
    for (uint32_t at = begin; at < end && !power.empty();) {
      uint32_t next = afterElement(elements_, at);
      const bool takes_box = elements_[at].shape == Shape::PinsBegin && next < end;
      power = takes_box ? drawPinned(at, elements_[next], power) : drawElement(at, std::move(power));
      at = takes_box ? next + 1 : next;
    }
    return power;
  }

  Feed drawElement(uint32_t at, Feed power) {
    const Element& element = elements_[at];
    switch (element.shape) {
      case Shape::Contact: return {drawContact(element, power)};
      case Shape::CompareContact: return {drawComparison(element, power)};
      case Shape::Coil: drawCoil(element, power); return {};
      case Shape::Jump: drawJump(element, power); return {};
      case Shape::Compare: drawBox(element, {pinOf("EN", power)}, {}); return {};
      case Shape::Box:
      case Shape::Order:
      case Shape::Message:
      case Shape::Service:
      case Shape::Pinned: return {drawBox(element, {pinOf("EN", power)}, "ENO")};
      case Shape::Timer: return {drawBox(element, {pinOf("EN", power)}, "Q")};
      case Shape::GroupBegin: return drawGroup(at, power);
      case Shape::PinsBegin: return power;
      case Shape::To: {
        Feed& node = nodes_[nodeOf(element)];
        node.insert(node.end(), power.begin(), power.end());
        return {};
      }
      case Shape::At: {
        const Feed& node = nodes_[nodeOf(element)];
        power.insert(power.end(), node.begin(), node.end());
        return power;
      }
      case Shape::Marker:
      case Shape::Rung:
      case Shape::BranchBegin:
      case Shape::GroupEnd:
      case Shape::PinsEnd: return power;
    }
    return power;
  }

  Feed drawGroup(uint32_t at, const Feed& power) {
    const uint32_t end = afterElement(elements_, at) - 1;
    Feed joined;
    for (uint32_t branch = at; branch != end; branch = elements_[branch].next) {
      const Feed after = drawSeries(branch + 1, elements_[branch].next, power);
      joined.insert(joined.end(), after.begin(), after.end());
    }
    return joined;
  }

  // [ CK … | R … ] and the box after it.
  Feed drawPinned(uint32_t at, const Element& box, const Feed& power) {
    const uint32_t close = afterElement(elements_, at) - 1;
    std::vector<NetworkPin> pins;
    for (uint32_t branch = at; branch != close; branch = elements_[branch].next)
      pins.push_back(pinOf(elements_[branch].pin.text, drawSeries(branch + 1, elements_[branch].next, power)));
    return {drawBox(box, std::move(pins), "Q")};
  }

  static NetworkPin pinOf(std::string_view name, Feed power) {
    return {xml::Excerpt(drawnName(name)), PinDirection::Input, {}, std::move(power)};
  }
  static std::string nodeOf(const Element& element) {
    return element.operand_count == 0 ? std::string() : foldedIdentifier(element.operands[0].text);
  }
  static std::string_view operandOf(const Element& element, size_t k) {
    return k < element.operand_count ? element.operands[k].text : std::string_view{};
  }

  NetworkElement elementOf(ElementKind kind, Loc loc) {
    return {kind, loc, xml::Excerpt(std::to_string(next_number_++))};
  }
  WireSource write(NetworkElement element, std::string_view pin = {}) {
    WireSource source{element.number, pin.empty() ? xml::Excerpt() : xml::Excerpt(std::string(pin))};
    writer_.write(std::move(element));
    return source;
  }
  WireSource write(ElementKind kind, Loc loc, Feed power) {
    NetworkElement element = elementOf(kind, loc);
    element.input = std::move(power);
    return write(std::move(element));
  }

  WireSource drawContact(const Element& element, const Feed& power) {
    NetworkElement contact = elementOf(ElementKind::Contact, element.word.loc);
    const std::string_view operand = operandOf(element, 0);
    contact.comment = withoutQuery(operand);
    contact.modifiers.negated = sameIdentifier(element.word.text, "INN");
    contact.modifiers.edge = queryOf(operand);
    contact.input = power;
    return write(std::move(contact));
  }

  WireSource drawComparison(const Element& element, const Feed& power) {
    NetworkElement contact = elementOf(ElementKind::Contact, element.word.loc);
    contact.comment = std::string(operandOf(element, 0)) + std::string(relationOf(element.word.text)) +
                      std::string(operandOf(element, 1));
    contact.input = power;
    return write(std::move(contact));
  }

  void drawCoil(const Element& element, const Feed& power) {
    NetworkElement coil = elementOf(ElementKind::Coil, element.word.loc);
    const std::string_view word = element.word.text;
    coil.comment = operandOf(element, 0);
    coil.modifiers.negated = sameIdentifier(word, "OUTN");
    if (sameIdentifier(word, "DIFU")) coil.modifiers.edge = EdgeKind::Rising;
    if (sameIdentifier(word, "DIFD")) coil.modifiers.edge = EdgeKind::Falling;
    if (sameIdentifier(word, "SET")) coil.modifiers.storage = PinStorage::Set;
    if (sameIdentifier(word, "RST")) coil.modifiers.storage = PinStorage::Reset;
    coil.input = power;
    write(std::move(coil));
  }

  // A call of a subroutine is a box.
  void drawJump(const Element& element, const Feed& power) {
    if (sameIdentifier(element.word.text, "SBS")) {
      drawBox(element, {pinOf("EN", power)}, {});
      return;
    }
    const bool returns = sameIdentifier(element.word.text, "RET");
    NetworkElement jump = elementOf(returns ? ElementKind::Return : ElementKind::Jump, element.word.loc);
    if (!returns) jump.name = xml::Excerpt(drawnName("JME " + std::string(operandOf(element, 0))));
    jump.input = power;
    write(std::move(jump));
  }

  // Its operands are in the box, a line each, as on the screen of the control.
  WireSource drawBox(const Element& element, std::vector<NetworkPin> pins, std::string_view output) {
    NetworkElement box = elementOf(ElementKind::Box, element.word.loc);
    box.name = xml::Excerpt(drawnName(element.word.text));
    for (size_t k = 0; k < element.operand_count; ++k)
      box.comment += (k == 0 ? "" : "\n") + std::string(operandOf(element, k));
    if (!output.empty()) pins.push_back({xml::Excerpt(std::string(output)), PinDirection::Output, {}, {}});
    box.has_pins = true;
    box.pins = std::move(pins);
    return write(std::move(box), output);
  }

  xml::SourceMappedText& out_;
  NetworkWriter writer_;
  std::span<const Element> elements_;
  std::map<std::string, Feed> nodes_;  // TO and AT, of the rung
  WireSource rail_;
  uint64_t next_number_ = 1;
};

}  // namespace

void writeDrawing(const Program& program, xml::SourceMappedText& out) {
  Drawer drawer(out);
  const std::string name(program.name.text);
  drawer.draw(program.main, name + "_Main");
  drawer.draw(program.int0, name + "_Int0");
}

}  // namespace rung::importer::nct

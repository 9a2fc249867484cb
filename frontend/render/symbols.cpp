// SPDX-License-Identifier: Apache-2.0
// The symbols of LD, FBD and CFC: the size of each element, the positions of its pins, and its drawing.
// IEC 61131-3 ed. 3, tables 74 to 76 (LD) and 8.3 (FBD); TM/TP manual 5.1 to 5.3 and 5.6.
#include <algorithm>

#include "frontend/render/network_plan.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/st_printer.h"
#include "frontend/syntax/standard_names.h"

namespace rung::picture {
namespace {

constexpr int32_t kPitch = 20;        // from pin to pin
constexpr int32_t kFirstPin = 30;     // below the upper edge of a box
constexpr int32_t kStub = 10;         // the line of a pin, which holds the circle of a negation
constexpr int32_t kSymbol = 40;       // the width of a contact or coil
constexpr size_t kCommentWidth = 60;  // characters

// How an element is drawn.
enum class Form : uint8_t { Rail, Contact, Text, Box, Comment };
Form formOf(ElementKind kind) {
  switch (kind) {
    case ElementKind::Rail:
    case ElementKind::RightRail: return Form::Rail;
    case ElementKind::Contact:
    case ElementKind::Coil: return Form::Contact;
    case ElementKind::Input:
    case ElementKind::Output:
    case ElementKind::InOut:
    case ElementKind::Connector:
    case ElementKind::Continuation:
    case ElementKind::Jump:
    case ElementKind::Label:
    case ElementKind::Return: return Form::Text;
    case ElementKind::Box:
    case ElementKind::Execute:
    case ElementKind::Compose:
    case ElementKind::Select: return Form::Box;
    case ElementKind::Comment: return Form::Comment;
  }
  return Form::Text;
}

std::string operandText(const Body& body, const DiagramElement& e) {
  if (e.operand) return printSt(body.tree, body.names, e.operand);
  return std::string(body.names.string(e.name.name));
}

// The title of a box is the name of its type.
std::string titleOf(const Body& body, const DiagramElement& e) {
  if (e.kind == ElementKind::Execute) return "EXECUTE";
  if (e.path) return printSt(body.tree, body.names, e.path);
  return std::string(body.names.string(e.name.name));
}

std::vector<std::string> textOf(const Body& body, const DiagramElement& e) {
  if (e.kind == ElementKind::Execute) return linesOf(printSt(body.tree, body.names, e.body, 0, {}));
  return wrapped(body.string(e.comment, e.comment_length), kCommentWidth);
}

// Lines in a box, below its pins.
bool hasText(const DiagramElement& e) {
  return e.kind == ElementKind::Execute || (e.kind == ElementKind::Box && e.comment_length != 0);
}

int32_t widthOf(const std::vector<std::string>& lines) {
  int32_t width = 0;
  for (const std::string& line : lines) width = std::max(width, textWidth(line));
  return width;
}

bool isControlPin(const Body& body, NameId name) { return isControl(body.names.string(name)); }

// The letters in a contact or coil: | / |, | P |, ( S ).
std::string lettersOf(const DiagramElement& e) {
  std::string letters = e.negated ? "/" : "";
  if (e.edge != EdgeKind::None) letters += e.edge == EdgeKind::Rising ? "P" : "N";
  if (e.storage != PinStorage::None) letters += e.storage == PinStorage::Set ? "S" : "R";
  return letters;
}

const DiagramPin* pinOf(const Body& body, const DiagramElement& e, const Terminal& t) {
  return t.pin == kNone ? nullptr : &body.tree.list(e.pins)[t.pin];
}

// ---- sizes

struct Rows {
  std::vector<Terminal> left, right;
};

// EN and ENO are in the first row, all other pins in file order.
Rows rowsOf(const Body& body, const DiagramElement& e, std::span<const NameId> unlisted_outputs) {
  Rows rows;
  const std::span<const DiagramPin> pins = body.tree.list(e.pins);
  for (uint32_t k = 0; k < pins.size(); ++k) {
    const bool output = pins[k].direction == PinDirection::Output;
    (output ? rows.right : rows.left).push_back({{}, output, k, pins[k].name.name});
  }
  for (const NameId name : unlisted_outputs) rows.right.push_back({{}, true, kNone, name});
  for (std::vector<Terminal>* side : {&rows.left, &rows.right})
    std::stable_partition(side->begin(), side->end(), [&](const Terminal& t) { return isControlPin(body, t.name); });
  return rows;
}

constexpr int32_t kInOutMark = 13;
bool isInOut(const Body& body, const DiagramElement& e, const Terminal& t) {
  return t.pin != kNone && body.isInOut(e, t.pin);
}

int32_t labelWidth(const Body& body, const DiagramElement& e, const Terminal& t) {
  const DiagramPin* pin = pinOf(body, e, t);
  const int32_t mark = pin == nullptr ? 0 : isInOut(body, e, t) ? kInOutMark : pin->edge != EdgeKind::None ? 8 : 0;
  return textWidth(body.names.string(t.name)) + mark;
}

void measureBox(const Body& body, const DiagramElement& e, std::span<const NameId> unlisted_outputs, Item& item) {
  const Rows rows = rowsOf(body, e, unlisted_outputs);
  const size_t count = std::max(rows.left.size(), rows.right.size());
  int32_t width = textWidth(titleOf(body, e)) + 16;
  for (size_t k = 0; k < count; ++k) {
    const int32_t left = k < rows.left.size() ? labelWidth(body, e, rows.left[k]) : 0;
    const int32_t right = k < rows.right.size() ? labelWidth(body, e, rows.right[k]) : 0;
    width = std::max(width, left + right + (left > 0 && right > 0 ? 30 : 16));
  }
  const auto pins = static_cast<int32_t>(count);
  int32_t height = std::max(kFirstPin + pins * kPitch - kGrid, 40);
  if (hasText(e)) {
    const std::vector<std::string> text = textOf(body, e);
    width = std::max(width, widthOf(text) + 20);
    height += static_cast<int32_t>(text.size()) * kLine + 6;
  }
  if (e.kind == ElementKind::Compose || e.kind == ElementKind::Select) width = std::max(width, 80);
  if (e.placed && e.width < 1000) width = std::max(width, e.width);
  item.frame = {0, 0, roundUp(width), roundUp(height)};
  item.area = {-kStub, 0, item.frame.width + 2 * kStub, item.frame.height};
  const std::string instance = operandText(body, e);
  const bool named = e.operand || e.kind == ElementKind::Compose || e.kind == ElementKind::Select;
  const bool numbered = !body.number(item.element).empty();
  if (named || numbered) {
    const int32_t above = roundUp(textWidth(instance) + (numbered ? 70 : 0));
    const int32_t wider = std::max(0, above - item.area.width);
    item.area.x -= roundUp(wider / 2);
    item.area.width += 2 * roundUp(wider / 2);
    item.area.y -= 20;
    item.area.height += 20;
  }
  const auto placeTerminals = [&](const std::vector<Terminal>& side, int32_t x) {
    int32_t y = kFirstPin;
    for (Terminal t : side) {
      t.at = {x, y};
      y += kPitch;
      item.terminals.push_back(t);
    }
  };
  // A name that is wider than its box also keeps wires away from the pins.
  placeTerminals(rows.left, item.area.x);
  placeTerminals(rows.right, item.area.right());
}

// Elements on a line: one terminal on each side, half way down.
void addLineTerminals(const Body& body, const DiagramElement& e, bool input, bool output, Item& item) {
  const bool listed = !e.pins.empty() && body.tree.list(e.pins)[0].direction != PinDirection::Output;
  if (input) item.terminals.push_back({{item.area.x, 0}, false, listed ? 0 : kNone, {}});
  if (output) item.terminals.push_back({{item.area.right(), 0}, true, kNone, {}});
}

// ---- drawing

void drawModifiers(Svg& svg, const DiagramPin& pin, Point border, bool left) {
  const int32_t out = left ? -1 : 1;
  if (pin.negated) svg.cycle({border.x + out * 4, border.y}, 4, "w");
  if (pin.storage != PinStorage::None)
    svg.text({border.x + out * 6, border.y - 5}, Anchor::Middle, pin.storage == PinStorage::Set ? "S" : "R", "s");
  if (pin.edge == EdgeKind::None) return;
  // The triangle of a rising edge points into the box, the triangle of a falling edge out of it.
  const bool inwards = pin.edge == EdgeKind::Rising;
  const int32_t base = border.x + (inwards ? 0 : -out * 7), tip = border.x + (inwards ? -out * 7 : 0);
  const Point points[] = {{base, border.y - 4}, {tip, border.y}, {base, border.y + 4}};
  svg.path(route(points, 3) + (inwards ? "" : "Z"));
}

// A double arrow at the pin of an in-out variable: it is read and written.
void drawInOut(Svg& svg, Point border) {
  const int32_t from = border.x + 3, to = border.x + 14, y = border.y;
  const Point line[] = {{from, y}, {to, y}};
  const Point left[] = {{from + 3, y - 3}, {from, y}, {from + 3, y + 3}};
  const Point right[] = {{to - 3, y - 3}, {to, y}, {to - 3, y + 3}};
  svg.path(route(line, 2) + route(left, 3) + route(right, 3));
}

// A number that is not in the file is grey.
void drawOrder(Svg& svg, const Body& body, const Item& item, Point corner) {
  const std::string_view text = body.number(item.element);
  if (text.empty()) return;
  const bool computed = body.elements[item.element].order == 0;
  const int32_t width = static_cast<int32_t>(text.size()) * 6 + 6;
  svg.rect({corner.x - width, corner.y - 12, width, 12}, computed ? "r" : "o");
  svg.text({corner.x - width / 2, corner.y - 3}, Anchor::Middle, text, computed ? "s g" : "s");
}

void drawBox(Svg& svg, const Body& body, const DiagramElement& e, const Item& item) {
  const Rect frame = item.frame.at(item.origin);
  const int32_t middle = frame.x + frame.width / 2;
  svg.rect(frame, "w");
  svg.text({middle, frame.y + 14}, Anchor::Middle, titleOf(body, e), "b");
  if (e.operand) svg.text({middle, frame.y - 6}, Anchor::Middle, operandText(body, e));
  if (e.kind == ElementKind::Compose) svg.text({frame.x, frame.y - 4}, Anchor::Start, "compose", "s g");
  if (e.kind == ElementKind::Select) svg.text({frame.x, frame.y - 4}, Anchor::Start, "select", "s g");
  int32_t below = frame.y + 20;
  for (const Terminal& t : item.terminals) {
    const Point end = item.origin + t.at;
    const bool left = t.at.x <= 0;
    const Point border{left ? frame.x : frame.right(), end.y};
    svg.line(end, border);
    const DiagramPin* pin = pinOf(body, e, t);
    const bool in_out = isInOut(body, e, t);
    if (in_out) drawInOut(svg, border);
    const int32_t inset = in_out ? 4 + kInOutMark : pin != nullptr && pin->edge != EdgeKind::None ? 12 : 4;
    svg.text({border.x + (left ? inset : -inset), end.y + 4}, left ? Anchor::Start : Anchor::End,
             body.names.string(t.name));
    if (pin != nullptr) drawModifiers(svg, *pin, border, left);
    below = std::max(below, end.y + kGrid);
  }
  if (hasText(e)) svg.lines({frame.x + 10, below}, textOf(body, e));
  const int32_t behind_name = e.operand ? middle + textWidth(operandText(body, e)) / 2 + 30 : 0;
  drawOrder(svg, body, item, {std::max(frame.right(), behind_name), frame.y});
}

void drawContact(Svg& svg, const Body& body, const DiagramElement& e, const Item& item) {
  const Rect area = item.bounds();
  const int32_t x = area.x + area.width / 2, y = item.origin.y;
  const bool coil = e.kind == ElementKind::Coil;
  const int32_t half = coil ? 9 : 6;
  svg.text({x, y - 15}, Anchor::Middle, operandText(body, e));
  svg.line({area.x, y}, {x - half, y});
  svg.line({x + half, y}, {area.right(), y});
  const auto n = [](int32_t k) { return std::to_string(k); };
  if (coil) {
    svg.path("M" + n(x - 5) + " " + n(y - 9) + "Q" + n(x - 13) + " " + n(y) + " " + n(x - 5) + " " + n(y + 9) + "M" +
                 n(x + 5) + " " + n(y - 9) + "Q" + n(x + 13) + " " + n(y) + " " + n(x + 5) + " " + n(y + 9),
             "k");
  } else {
    svg.path("M" + n(x - 6) + " " + n(y - 10) + "V" + n(y + 10) + "M" + n(x + 6) + " " + n(y - 10) + "V" + n(y + 10),
             "k");
  }
  const std::string letters = lettersOf(e);
  if (letters == "/")
    svg.path("M" + n(x - 4) + " " + n(y + 9) + "L" + n(x + 4) + " " + n(y - 9));
  else if (!letters.empty())
    svg.text({x, y + 4}, Anchor::Middle, letters, letters.size() > 1 ? "s" : "");
}

// Variables, jumps, connectors: a framed string with terminals on its sides.
void drawText(Svg& svg, const Body& body, const DiagramElement& e, const Item& item) {
  const Rect frame = item.frame.at(item.origin);
  const int32_t y = item.origin.y;
  const bool boxed = body.diagram.language == NetworkLanguage::Continuous;
  for (const Terminal& t : item.terminals) {
    const Point end = item.origin + t.at, border{t.output ? frame.right() : frame.x, y};
    if (end.x != border.x) svg.line(end, border);
  }
  const auto n = [](int32_t k) { return std::to_string(k); };
  std::string shown = operandText(body, e);
  std::string_view kind;
  const int32_t top = frame.y + 1, bottom = frame.bottom() - 1;
  if (e.kind == ElementKind::Connector || e.kind == ElementKind::Continuation) {
    const int32_t notch = e.kind == ElementKind::Continuation ? 8 : 0;
    svg.path("M" + n(frame.x) + " " + n(top) + "H" + n(frame.right() - 8) + "L" + n(frame.right()) + " " + n(y) + "L" +
                 n(frame.right() - 8) + " " + n(bottom) + "H" + n(frame.x) +
                 (notch > 0 ? "L" + n(frame.x + notch) + " " + n(y) : std::string()) + "Z",
             "w");
  } else if (e.kind == ElementKind::Jump) {
    for (const int32_t x : {frame.x, frame.x + 6})
      svg.path("M" + n(x) + " " + n(y - 5) + "L" + n(x + 6) + " " + n(y) + "L" + n(x) + " " + n(y + 5), "k");
    svg.text({frame.x + 18, y + 4}, Anchor::Start, shown, "b");
    return drawOrder(svg, body, item, {frame.right(), frame.y});
  } else if (e.kind == ElementKind::Return) {
    shown = "RETURN";
    kind = "b";
    svg.path("M" + n(frame.x + 6) + " " + n(top) + "L" + n(frame.x) + " " + n(y) + "L" + n(frame.x + 6) + " " +
                 n(bottom) + "H" + n(frame.right() - 6) + "L" + n(frame.right()) + " " + n(y) + "L" +
                 n(frame.right() - 6) + " " + n(top) + "Z",
             "w");
  } else if (e.kind == ElementKind::Label) {
    shown += ':';
    kind = "b";
  } else if (boxed) {
    svg.rect({frame.x, top, frame.width, bottom - top}, "x");
  }
  svg.text({frame.x + frame.width / 2, y + 4}, Anchor::Middle, shown, kind);
  DiagramPin modifiers{};
  modifiers.negated = e.negated;
  modifiers.edge = e.edge;
  modifiers.storage = e.storage;
  const bool writes = e.kind == ElementKind::Output || e.kind == ElementKind::InOut || e.kind == ElementKind::Jump ||
                      e.kind == ElementKind::Return;
  if (!item.terminals.empty()) drawModifiers(svg, modifiers, {writes ? frame.x : frame.right(), y}, writes);
  if (e.kind == ElementKind::InOut)
    for (const DiagramPin& pin : body.tree.list(e.pins))
      if (pin.direction == PinDirection::Output) drawModifiers(svg, pin, {frame.right(), y}, false);
  drawOrder(svg, body, item, {frame.right(), frame.y + 1});
}

void drawComment(Svg& svg, const Body& body, const DiagramElement& e, const Item& item) {
  const Rect frame = item.frame.at(item.origin);
  svg.rect(frame, "c");
  svg.lines({frame.x + 6, frame.y}, textOf(body, e));
}

// A connector as in ed. 3, 8.1.3, with a number instead of a name.
void drawContinuation(Svg& svg, const Item& item) {
  const Rect f = item.frame.at(item.origin);
  const auto n = [](int32_t k) { return std::to_string(k); };
  const int32_t tip = f.right() - 8;
  svg.path("M" + n(f.x) + " " + n(f.y + 2) + "H" + n(tip) + "L" + n(f.right()) + " " + n(item.origin.y) + "L" + n(tip) +
               " " + n(f.bottom() - 2) + "H" + n(f.x) + "Z",
           "o");
  svg.text({f.x + (f.width - 8) / 2 + 1, item.origin.y + 4}, Anchor::Middle, std::to_string(item.continuation));
}

// A variable, or one of the forms with a text: connectors, jumps, labels.
void measureForm(const Body& body, const DiagramElement& e, Item& item) {
  const bool has_modifier = e.negated || e.edge != EdgeKind::None || e.storage != PinStorage::None;
  const bool form = e.kind != ElementKind::Input && e.kind != ElementKind::Output && e.kind != ElementKind::InOut &&
                    e.kind != ElementKind::Label;
  const bool boxed = body.diagram.language == NetworkLanguage::Continuous;
  const int32_t text = textWidth(e.kind == ElementKind::Return ? "RETURN" : operandText(body, e));
  const int32_t width = roundUp(text + (form ? 24 : boxed ? 16 : 8));
  const bool reads =
      e.kind == ElementKind::Input || e.kind == ElementKind::Continuation || e.kind == ElementKind::Label;
  const bool gives = e.kind != ElementKind::Output && e.kind != ElementKind::Jump && e.kind != ElementKind::Return &&
                     e.kind != ElementKind::Label;
  item.frame = {0, -kGrid, width, 2 * kGrid};
  item.area = item.frame;
  if (has_modifier) {
    item.area.width += kGrid;
    if (!reads) item.area.x -= kGrid;
  }
  if (!body.number(item.element).empty()) {
    item.area.y -= kGrid;
    item.area.height += kGrid;
  }
  addLineTerminals(body, e, !reads, gives, item);
}

}  // namespace

Item measure(const Body& body, uint32_t element, std::span<const NameId> unlisted_outputs) {
  const DiagramElement& e = body.elements[element];
  Item item{element, {}, {}, {}, {}};
  const int32_t name = textWidth(operandText(body, e));
  switch (formOf(e.kind)) {
    case Form::Rail:
      item.area = {0, 0, kGrid, 40};
      item.terminals.push_back({{0, 0}, e.kind == ElementKind::Rail, kNone, {}, 40});
      break;
    case Form::Contact: {
      const int32_t half = std::max(kSymbol / 2, roundUp((name + 1) / 2));
      item.area = {-half, -30, 2 * half, 40};
      addLineTerminals(body, e, true, true, item);
      break;
    }
    case Form::Text: measureForm(body, e, item); break;
    case Form::Box: measureBox(body, e, unlisted_outputs, item); break;
    case Form::Comment: {
      const std::vector<std::string> text = textOf(body, e);
      item.frame = {0, 0, roundUp(widthOf(text) + 12), roundUp(static_cast<int32_t>(text.size()) * kLine + 8)};
      item.area = item.frame;
      break;
    }
  }
  return item;
}

std::string elementId(uint64_t number) { return "e" + std::to_string(number); }

void drawItem(Svg& svg, const Body& body, const Item& item) {
  if (item.continuation != 0) return drawContinuation(svg, item);
  if (!item.terminals.empty() && item.terminals[0].length > 0) {
    const Point top = item.origin + item.terminals[0].at;
    return svg.line(top, {top.x, top.y + item.terminals[0].length}, "t");
  }
  if (item.element == kNone) return;
  const DiagramElement& e = body.elements[item.element];
  if (body.path_of != nullptr)
    svg.open(liveAttributes(body, e));
  else
    svg.open(elementId(e.number));
  switch (formOf(e.kind)) {
    case Form::Rail: break;
    case Form::Contact: drawContact(svg, body, e, item); break;
    case Form::Text: drawText(svg, body, e, item); break;
    case Form::Box: drawBox(svg, body, e, item); break;
    case Form::Comment: drawComment(svg, body, e, item); break;
  }
  svg.close();
}

}  // namespace rung::picture

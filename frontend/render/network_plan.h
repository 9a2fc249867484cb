// SPDX-License-Identifier: Apache-2.0
// The plan of a picture of networks: elements with their sizes, positions and pins, and the wires between them. In: the
// elements of a body as parsed. symbols.cpp measures and draws elements, arrange.cpp and positions.cpp position them,
// wrap.cpp cuts networks that are too wide, route.cpp routes the wires, live.cpp finds the values; network_picture.cpp
// calls all of these. Private to frontend/render.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "frontend/render/picture.h"
#include "frontend/render/svg.h"
#include "frontend/syntax/box_outputs.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/tree.h"

namespace rung::picture {

constexpr uint32_t kNone = UINT32_MAX;
constexpr int32_t kElementGap = 20;  // between elements: room for a wire

inline bool isRail(ElementKind kind) { return kind == ElementKind::Rail || kind == ElementKind::RightRail; }

struct Body {
  const Tree& tree;
  const Names& names;
  const Diagram& diagram;
  std::span<const DiagramElement> elements;
  std::span<const std::string> numbers = {};   // by element: its place in the execution order; empty: none is shown
  const std::vector<bool>* in_outs = nullptr;  // NetworkNotes
  const PathOf* path_of = nullptr;             // the same

  std::string_view number(uint32_t element) const {
    return element < numbers.size() ? std::string_view(numbers[element]) : std::string_view();
  }
  bool isInOut(const DiagramElement& e, uint32_t pin) const {
    const size_t index = e.pins.first + pin;
    return tree.list(e.pins)[pin].direction == PinDirection::InOut ||
           (in_outs != nullptr && index < in_outs->size() && (*in_outs)[index]);
  }
  std::string_view string(uint32_t first, uint32_t length) const { return tree.string({first, length}); }
};

// The end of a wire. `at` is relative to the item's origin and lies on the grid, like all points in a plan.
struct Terminal {
  Point at;
  bool output;
  uint32_t pin;  // in the element's list; kNone: the result of the element, or an output that the file does not list
  NameId name;
  int32_t length = 0;  // of a rail, downwards: wires end at any point of it
};

struct Item {
  uint32_t element;  // in the body
  Rect area;         // with its names; no other element overlaps it
  Rect frame;        // of the part drawn as a box
  Point origin;
  std::vector<Terminal> terminals;
  uint32_t continuation = 0;  // number of the mark where a wire continues in another band; then no element

  Rect bounds() const { return area.at(origin); }
};

struct End {
  uint32_t item, terminal;
  friend bool operator==(const End&, const End&) = default;
};
// Connected terminals, drawn as one tree of lines: each source is connected with each target.
struct Net {
  std::vector<End> sources, targets;
  std::vector<std::vector<Point>> lines;
  std::vector<Point> dots;  // where lines meet
};

struct Link {  // one wire of the file
  End from, to;
};

struct Plan {
  std::vector<Item> items;
  std::vector<Link> links;
  std::vector<Net> nets;
  Rect bounds;  // of the whole plan

  Point point(const End& end) const {
    const Item& item = items[end.item];
    return item.origin + item.terminals[end.terminal].at;
  }
  const Terminal& terminal(const End& end) const { return items[end.item].terminals[end.terminal]; }
};

// Measures one element, without a position. `unlisted`: outputs of a box that wires name but the file does not list.
Item measure(const Body& body, uint32_t element, std::span<const NameId> unlisted);
void drawItem(Svg& svg, const Body& body, const Item& item);

// What a monitor needs to show an element, or the wires of a net, running (live.cpp).
std::vector<Svg::Attribute> liveAttributes(const Body& body, const DiagramElement& e);
std::vector<Svg::Attribute> liveAttributes(const Body& body, const Plan& plan, const Net& net);
// Nets without lines, of outputs that nothing reads: their values are of interest, too.
std::vector<Net> openOutputs(const Body& body, const Plan& plan);

// Positions elements by data flow, from left to right.
void arrange(const Body& body, Plan& plan);
// Takes the positions of the file, spread where names need it. False: it has none, or two elements share one.
bool takeFilePositions(const Body& body, Plan& plan);

// Cuts a plan that is wider than `page` into bands; `continuations` counts the numbers at their ends.
std::vector<Plan> wrap(const Body& body, Plan plan, int32_t page, uint32_t& continuations);
// The separately wired parts of a plan: before it has positions, and in groups that overlap vertically.
std::vector<Plan> splitByWires(const Plan& plan);
std::vector<Plan> splitByRows(const Plan& plan);
// Extends rails from above their first wire to below the last.
void fitRails(Plan& plan, int32_t left, int32_t right);
Rect boundsOf(const Plan& plan);

// Makes nets of the links.
void makeNets(Plan& plan);
// Makes nets of the links and routes them around the elements; `bounds` becomes the area of elements and wires.
void routeWires(Plan& plan);

// First the elements outside of networks, then each network, in separate coordinates; an empty plan if there are none.
// `page`: the maximum width of networks; 0: unlimited.
std::vector<Plan> planNetworks(const Body& body, int32_t page = 0);

}  // namespace rung::picture

// The plan of a picture of networks: elements with their sizes, places and pins, and the wires between them. In: the
// elements of a body as the parser leaves them. symbols.cpp measures and draws elements, arrange.cpp and positions.cpp
// give them places, wrap.cpp cuts what is too wide, route.cpp leads the wires; network_picture.cpp does all of it in
// turn. Private to frontend/picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "frontend/picture/svg.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/tree.h"

namespace rung::picture {

constexpr uint32_t kNone = UINT32_MAX;
constexpr int32_t kElementGap = 20;  // between elements: room for a wire

inline bool isRail(ElementKind kind) { return kind == ElementKind::Rail || kind == ElementKind::RightRail; }
inline bool isBox(ElementKind kind) {
  return kind == ElementKind::Box || kind == ElementKind::Execute || kind == ElementKind::Compose ||
         kind == ElementKind::Select;
}

struct Body {
  const Tree& tree;
  const Names& names;
  const Diagram& diagram;
  std::span<const DiagramElement> elements;

  std::string_view string(uint32_t first, uint32_t length) const { return tree.string({first, length}); }
};

// Where a wire ends. `at` counts from the item's origin and lies on the grid, like every place in a plan.
struct Terminal {
  Point at;
  bool output;
  uint32_t pin;  // in the element's list; kNone: what the element gives, or an output that the file does not list
  NameId name;
  int32_t length = 0;  // of a rail, downwards: wires end anywhere on it
};

struct Item {
  uint32_t element;  // in the body
  Rect area;         // with its names; nothing else stands there
  Rect frame;        // of what is drawn as a box
  Point origin;
  std::vector<Terminal> terminals;
  uint32_t continuation = 0;  // where a wire goes on in another band: the number; no element

  Rect bounds() const { return area.at(origin); }
};

struct End {
  uint32_t item, terminal;
  friend bool operator==(const End&, const End&) = default;
};
// What is connected, drawn as one tree of lines: each source with each target.
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
  Rect bounds;  // of all of it

  Point point(const End& end) const {
    const Item& item = items[end.item];
    return item.origin + item.terminals[end.terminal].at;
  }
  const Terminal& terminal(const End& end) const { return items[end.item].terminals[end.terminal]; }
};

// One element, at no place yet. `unlisted`: outputs of a box that wires name and the file does not list.
Item measure(const Body& body, uint32_t element, std::span<const NameId> unlisted);
void drawItem(Svg& svg, const Body& body, const Item& item);

// Gives places by data flow, from left to right.
void arrange(const Body& body, Plan& plan);
// Gives the places of the file, stretched where names need it. False: it has none, or two elements share one.
bool takeFilePositions(const Body& body, Plan& plan);

// Cuts what is wider than `page` into bands; `continuations` counts the numbers at their ends.
std::vector<Plan> wrap(const Body& body, Plan plan, int32_t page, uint32_t& continuations);
// What no wires connect, each by itself: before it has places, and of what stands above each other.
std::vector<Plan> splitByWires(const Plan& plan);
std::vector<Plan> splitByRows(const Plan& plan);
// Rails go from above their first wire to below the last.
void fitRails(Plan& plan, int32_t left, int32_t right);
Rect boundsOf(const Plan& plan);

// What the links connect.
void makeNets(Plan& plan);
// Makes nets of the links and leads them around the elements; `bounds` becomes what elements and wires take.
void routeWires(Plan& plan);

// One for each network behind what stands in none, each in coordinates of its own; empty where nothing does.
// `page`: as wide as networks may be; 0: as wide as they are.
std::vector<Plan> planNetworks(const Body& body, int32_t page = 0);

}  // namespace rung::picture

// SPDX-License-Identifier: Apache-2.0
// A picture as SVG: lines, boxes and strings in one fixed-width font that every viewer has, so that widths are known
// without asking a font. In: shapes in pixels. Out: one well-formed file, equal bytes for equal calls. Called by the
// drawings of networks and charts.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rung::picture {

struct Point {
  int32_t x = 0, y = 0;
  friend bool operator==(Point, Point) = default;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
};
struct Rect {
  int32_t x = 0, y = 0, width = 0, height = 0;
  int32_t right() const { return x + width; }
  int32_t bottom() const { return y + height; }
  Rect at(Point origin) const { return {x + origin.x, y + origin.y, width, height}; }
  bool overlaps(const Rect& o) const { return x < o.right() && o.x < right() && y < o.bottom() && o.y < bottom(); }
  void include(const Rect& o);
};

constexpr int32_t kGrid = 10;
constexpr int32_t kLine = 15;  // line height
inline int32_t roundUp(int32_t n) { return (n + kGrid - 1) / kGrid * kGrid; }

// In pixels; characters of East Asian scripts are two wide.
int32_t textWidth(std::string_view text);

std::vector<std::string> linesOf(std::string_view text);
// Wraps at blanks, so that lines are at most `most` long wherever a blank allows it.
std::vector<std::string> wrapped(std::string_view text, size_t most);

enum class Anchor : uint8_t { Start, Middle, End };

class Svg {
 public:
  // `kind`: a class of the style sheet in svg.cpp; empty: thin black lines, upright text.
  void path(std::string_view data, std::string_view kind = {});
  void line(Point a, Point b, std::string_view kind = {});
  void rect(const Rect& r, std::string_view kind = {});
  void cycle(Point centre, int32_t radius, std::string_view kind = {});
  void text(Point base, Anchor anchor, std::string_view text, std::string_view kind = {});
  // Below each other; `above` is one line above the first.
  void lines(Point above, const std::vector<std::string>& lines);
  struct Attribute {
    std::string_view name;
    std::string value;
  };
  void open(std::string_view id);  // a group of shapes
  // The same, with the attributes that have a value.
  void open(std::span<const Attribute> attributes);
  void openFaded();  // a group of disabled elements
  void close();

  std::string finish(std::string_view title, int32_t width, int32_t height) const;

 private:
  std::string body_;
};

// "M10 20H50V40": right-angled lines through the points.
std::string route(const Point* points, size_t count);

}  // namespace rung::picture

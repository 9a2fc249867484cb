// SPDX-License-Identifier: Apache-2.0
// Timing diagrams as SVG: see plot_drawing.h.
#include "plot_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string_view>

namespace rung::host {
namespace {

constexpr double kCharacter = 7.5;  // of a sans serif font of 12 pixels, rather too wide
constexpr int kSmallCharacter = 6;  // of 10 pixels
constexpr int kWidth = 720, kRight = 24, kTop = 14, kBottom = 34, kGap = 16;
constexpr int kLevel = 20, kNumber = 72;
constexpr size_t kMostEdges = 24;  // more would hide the curves

const char* const kStyle =
    "<style>text{font:12px sans-serif;fill:#24292f}.s text{font-size:10px;fill:#6e7781}"
    ".grid{stroke:#d8dee4}.edge{stroke:#afb8c1;stroke-dasharray:2 3}path{fill:none}"
    ".level,.curve,.item{stroke-width:1.6}.level{stroke:#0a61c4}.high{fill:#0a61c4;opacity:.13}"
    ".curve{stroke:#b3470b}.item{stroke:#57606a}.page{fill:#fff}"
    "@media(prefers-color-scheme:dark){text{fill:#e6edf3}.s text{fill:#9198a1}.grid{stroke:#30363d}"
    ".edge{stroke:#656c76}.level{stroke:#58a6ff}.high{fill:#58a6ff;opacity:.2}.curve{stroke:#ffa657}"
    ".item{stroke:#9198a1}.page{fill:#0d1117}}</style>\n";

const char* const kLimitStyle =
    "<style>.limit{stroke:#cf222e;stroke-dasharray:5 3}.mark{fill:#b3470b}"
    "@media(prefers-color-scheme:dark){.limit{stroke:#ff7b72}.mark{fill:#ffa657}}</style>\n";

// Tenths of a pixel are precise enough.
std::string pixels(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.1f", value);
  std::string out = text;
  if (out.compare(out.size() - 2, 2, ".0") == 0) out.resize(out.size() - 2);
  return out == "-0" ? "0" : out;
}

std::string escapedForSvg(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string textAt(double x, double y, const char* anchor, std::string_view text) {
  return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" text-anchor=\"" + anchor + "\">" + escapedForSvg(text) +
         "</text>\n";
}

std::string lineFrom(const char* style, double x, double y, const std::string& to) {
  return std::string("<path class=\"") + style + "\" d=\"M" + pixels(x) + " " + pixels(y) + to + "\"/>\n";
}

// The smallest of 1, 2, 5 times a power of ten that is not below `least`.
double roundStep(double least) {
  double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (power * factor >= least * (1 - 1e-9)) return power * factor;
  return power * 10;
}

struct TimeUnit {
  double ns;
  const char* name;
};
TimeUnit unitFor(double span_ns) {
  if (span_ns >= 180e9) return {60e9, "min"};
  if (span_ns >= 1e9) return {1e9, "s"};
  if (span_ns >= 1e6) return {1e6, "ms"};
  if (span_ns >= 1e3) return {1e3, "us"};
  return {1, "ns"};
}

std::string shortNumber(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.6g", value == 0 ? 0.0 : value);  // -0
  return text;
}

// A lane's place, and what it shows on its axis.
class Drawing {
 public:
  Drawing(const std::vector<PlotLane>& lanes, double columns, const PlotRange& range)
      : lanes_(lanes), columns_(std::max(columns, 1e-9)), range_(range) {
    int ticks = 0;
    double names = 3 * kCharacter;
    for (const PlotLane& lane : lanes) {
      names = std::max(names, kCharacter * static_cast<double>(lane.name.size()));
      axes_.push_back(axisOf(lane));
      for (const std::string& text : tickTexts(axes_.size() - 1))
        ticks = std::max(ticks, kSmallCharacter * static_cast<int>(text.size()));
    }
    names_ = 12 + static_cast<int>(names);
    left_ = names_ + 8 + ticks + 6;
  }

  std::string draw() {
    int height = kTop + kBottom - kGap;
    for (size_t i = 0; i < lanes_.size(); ++i) height += heightOf(i) + kGap;
    bottom_ = height - kBottom + 6;
    const std::string width_text = std::to_string(left_ + kWidth + kRight), height_text = std::to_string(height);
    svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width_text + "\" height=\"" + height_text +
           "\" viewBox=\"0 0 " + width_text + " " + height_text + "\" role=\"img\">\n" + kStyle +
           (hasLimits() ? kLimitStyle : "") + "<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n";
    drawRange();
    drawEdges();
    int top = kTop;
    for (size_t i = 0; i < lanes_.size(); ++i) {
      drawLane(i, top);
      top += heightOf(i) + kGap;
    }
    return svg_ + "</svg>\n";
  }

 private:
  int heightOf(size_t lane) const { return hasAxis(lanes_[lane]) && axes_[lane].count() > 1 ? kNumber : kLevel; }
  static bool hasAxis(const PlotLane& lane) { return lane.kind == PlotKind::Number || lane.kind == PlotKind::Duration; }
  bool hasLimits() const {
    return std::any_of(lanes_.begin(), lanes_.end(),
                       [](const PlotLane& lane) { return !lane.limits.empty() || !lane.marks.empty(); });
  }
  double x(double column) const { return left_ + kWidth * std::min(column / columns_, 1.0); }

  static PlotAxis axisOf(const PlotLane& lane) {
    if (!hasAxis(lane)) return {0, 1, 1};
    double low = NAN, high = NAN;
    for (const PlotColumn& column : lane.columns) {
      low = std::fmin(low, column.low);
      high = std::fmax(high, column.high);
    }
    if (std::isnan(low)) return {};
    for (const double limit : lane.limits) {
      low = std::fmin(low, limit);
      high = std::fmax(high, limit);
    }
    if (lane.kind == PlotKind::Number) return axisFor(low, high, lane.is_whole);
    const double scale = lane.unit_ns / unitOf(lane, low, high).ns;
    PlotAxis axis = axisFor(low * scale, high * scale, false);
    return {axis.low / scale, axis.high / scale, axis.step / scale};
  }
  static TimeUnit unitOf(const PlotLane& lane, double low, double high) {
    return unitFor(std::max(std::fabs(low), std::fabs(high)) * lane.unit_ns);
  }

  std::vector<std::string> tickTexts(size_t lane_number) const {
    const PlotLane& lane = lanes_[lane_number];
    const PlotAxis& axis = axes_[lane_number];
    std::vector<std::string> texts;
    if (!hasAxis(lane)) return texts;
    const bool is_empty = std::all_of(lane.columns.begin(), lane.columns.end(),
                                      [](const PlotColumn& column) { return std::isnan(column.low); });
    for (int i = 0; !is_empty && i < axis.count(); ++i) {
      const double value = tick(axis, i);
      if (lane.kind == PlotKind::Number) {
        texts.push_back(shortNumber(value));
      } else {
        const TimeUnit unit = unitOf(lane, axis.low, axis.high);
        texts.push_back(shortNumber(value * lane.unit_ns / unit.ns) + " " + unit.name);
      }
    }
    return texts;
  }
  static double tick(const PlotAxis& axis, int i) {
    const double value = axis.low + i * axis.step;
    return std::fabs(value) < axis.step * 1e-6 ? 0 : value;
  }

  void drawRange() {
    const double total = range_.to > range_.from ? range_.to - range_.from : 1;
    const double step = roundStep(total / 8), first = std::ceil(range_.from / step - 1e-9) * step;
    svg_ += "<g class=\"s\">\n";
    for (int i = 0; first + i * step <= range_.from + total * (1 + 1e-9); ++i) {
      const double value = first + i * step, at = left_ + kWidth * ((value - range_.from) / total);
      svg_ += lineFrom("grid", at, kTop - 6, "V" + pixels(bottom_));
      svg_ += textAt(at, bottom_ + 14, "middle", shortNumber(std::fabs(value) < step * 1e-6 ? 0 : value));
    }
    svg_ += "</g>\n" + textAt(names_, bottom_ + 14, "end", range_.name);
  }

  // A dotted line through all lanes where a level changes: what happens at the same time is seen.
  void drawEdges() {
    std::set<std::string> edges;
    for (const PlotLane& lane : lanes_) {
      if (lane.kind != PlotKind::Level) continue;
      for (size_t i = 1; i < lane.columns.size(); ++i)
        if (lane.columns[i - 1].last != lane.columns[i].first && !std::isnan(lane.columns[i].first))
          edges.insert(pixels(x(static_cast<double>(i))));
    }
    if (edges.empty() || edges.size() > kMostEdges) return;
    svg_ += "<path class=\"edge\" d=\"";
    for (const std::string& at : edges) svg_ += "M" + at + " " + pixels(kTop - 6) + "V" + pixels(bottom_);
    svg_ += "\"/>\n";
  }

  void drawLane(size_t number, int top) {
    const PlotLane& lane = lanes_[number];
    const int height = heightOf(number);
    svg_ += textAt(names_, top + height / 2.0 + 4, "end", lane.name);
    switch (lane.kind) {
      case PlotKind::Level:
        drawHighs(lane, top);
        svg_ += curve(lane, "level", {0, 1, 1}, top, height);
        break;
      case PlotKind::Item: drawItems(lane, top); break;
      case PlotKind::Number:
      case PlotKind::Duration:
        drawAxis(number, top);
        svg_ += curve(lane, "curve", axes_[number], top, height);
        drawLimits(number, top);
    }
  }

  void drawLimits(size_t number, int top) {
    const PlotLane& lane = lanes_[number];
    const int height = heightOf(number);
    for (const double limit : lane.limits)
      svg_ += lineFrom("limit", left_, y(axes_[number], top, height, limit), "h" + std::to_string(kWidth));
    if (lane.marks.empty()) return;
    svg_ += "<g class=\"s\">\n";
    for (const PlotLane::Mark& mark : lane.marks) {
      const double at_x = x(mark.column), at_y = y(axes_[number], top, height, mark.value);
      svg_ += "<circle class=\"mark\" cx=\"" + pixels(at_x) + "\" cy=\"" + pixels(at_y) + "\" r=\"2.5\"/>\n";
      const double width = kSmallCharacter * static_cast<double>(mark.text.size());
      const bool is_left = at_x + 5 + width > left_ + kWidth;
      svg_ += textAt(is_left ? at_x - 5 : at_x + 5, at_y < top + 10 ? at_y + 9 : at_y - 3, is_left ? "end" : "start",
                     mark.text);
    }
    svg_ += "</g>\n";
  }

  static double y(const PlotAxis& axis, int top, int height, double value) {
    return axis.high > axis.low ? top + height - (value - axis.low) / (axis.high - axis.low) * height
                                : top + height / 2.0;
  }

  void drawAxis(size_t number, int top) {
    const PlotAxis& axis = axes_[number];
    const std::vector<std::string> texts = tickTexts(number);
    svg_ += "<g class=\"s\">\n";
    for (size_t i = 0; i < texts.size(); ++i) {
      const double at = y(axis, top, heightOf(number), tick(axis, static_cast<int>(i)));
      svg_ += lineFrom("grid", left_, at, "h" + std::to_string(kWidth));
      svg_ += textAt(left_ - 4, at + 3.5, "end", texts[i]);
    }
    svg_ += "</g>\n";
  }

  void drawHighs(const PlotLane& lane, int top) {
    std::string boxes;
    for (size_t i = 0; i < lane.columns.size();) {
      if (lane.columns[i].high != 1 || lane.columns[i].low != 1) {
        ++i;
        continue;
      }
      size_t end = i;
      while (end < lane.columns.size() && lane.columns[end].low == 1) ++end;
      const std::string bottom = std::to_string(top + kLevel);
      boxes += "M" + pixels(x(static_cast<double>(i))) + " " + bottom + "V" + std::to_string(top) + "H" +
               pixels(x(static_cast<double>(end))) + "V" + bottom + "Z";
      i = end;
    }
    if (!boxes.empty()) svg_ += "<path class=\"high\" d=\"" + boxes + "\"/>\n";
  }

  // Steps, as the program's cycles are; a column of several rows shows the range of its values.
  std::string curve(const PlotLane& lane, const char* style, const PlotAxis& axis, int top, int height) const {
    std::string path, at_y;
    bool is_drawing = false;
    const auto up = [&](double value) {
      const std::string to = pixels(y(axis, top, height, value));
      if (to != at_y) path += "V" + to;
      at_y = to;
    };
    for (size_t i = 0; i < lane.columns.size(); ++i) {
      const PlotColumn& column = lane.columns[i];
      const std::string at = pixels(x(static_cast<double>(i)));
      if (std::isnan(column.low)) {
        if (is_drawing) path += "H" + at;
        is_drawing = false;
        continue;
      }
      const double from = std::isnan(column.first) ? column.low : column.first;
      const double to = std::isnan(column.last) ? column.high : column.last;
      const std::string first_y = pixels(y(axis, top, height, from));
      const bool changes = column.low < column.high;
      if (!is_drawing) {
        path += "M" + at + " " + first_y;
        at_y = first_y;
      } else if (first_y != at_y || changes) {
        path += "H" + at;
      }
      is_drawing = true;
      up(from);
      if (changes) {
        up(column.low);
        up(column.high);
        up(to);
      }
    }
    if (is_drawing) path += "H" + pixels(x(static_cast<double>(lane.columns.size())));
    return std::string("<path class=\"") + style + "\" d=\"" + path + "\"/>\n";
  }

  // A box for each stretch of one item; a box without a name: several within one column, or too narrow.
  void drawItems(const PlotLane& lane, int top) {
    std::string boxes, texts;
    for (size_t i = 0; i < lane.columns.size();) {
      const PlotColumn& column = lane.columns[i];
      size_t end = i + 1;
      const bool is_single = column.low == column.high;
      while (end < lane.columns.size() && is_single && lane.columns[end].low == column.low &&
             lane.columns[end].high == column.low)
        ++end;
      const double from = x(static_cast<double>(i)), to = x(static_cast<double>(end));
      i = end;
      if (std::isnan(column.low)) continue;
      const double slant = std::min(3.0, (to - from) / 2);
      const std::string middle = pixels(top + kLevel / 2.0);
      boxes += "M" + pixels(from) + " " + middle + "L" + pixels(from + slant) + " " + std::to_string(top) + "H" +
               pixels(to - slant) + "L" + pixels(to) + " " + middle + "L" + pixels(to - slant) + " " +
               std::to_string(top + kLevel) + "H" + pixels(from + slant) + "Z";
      const std::string name = is_single ? nameOf(lane, column.low) : "";
      if (static_cast<int>(name.size()) * kSmallCharacter + 6 <= to - from)
        texts += textAt((from + to) / 2, top + kLevel / 2.0 + 3.5, "middle", name);
    }
    svg_ += "<path class=\"item\" d=\"" + boxes + "\"/>\n<g class=\"s\">\n" + texts + "</g>\n";
  }
  static std::string nameOf(const PlotLane& lane, double value) {
    for (const PlotLane::Item& item : lane.items)
      if (item.value == value) return item.name;
    return shortNumber(value);
  }

  const std::vector<PlotLane>& lanes_;
  const double columns_;
  const PlotRange range_;
  std::vector<PlotAxis> axes_;
  int names_ = 0, left_ = 0;  // where the names end, where the lanes begin
  int bottom_ = 0;            // of the lanes
  std::string svg_;
};

}  // namespace

int PlotAxis::count() const { return step > 0 ? static_cast<int>(std::lround((high - low) / step)) + 1 : 1; }

PlotAxis axisFor(double low, double high, bool is_whole) {
  if (!(high > low)) return {low, low, 0};
  double step = roundStep((high - low) / 3);
  if (is_whole) step = std::max(step, 1.0);
  return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step};
}

std::string drawPlot(const std::vector<PlotLane>& lanes, double columns, int64_t end_ns) {
  const double total = std::max(static_cast<double>(end_ns), 1.0);
  const TimeUnit unit = unitFor(total);
  return drawPlot(lanes, columns, {0, total / unit.ns, std::string("t/") + unit.name});
}

std::string drawPlot(const std::vector<PlotLane>& lanes, double columns, const PlotRange& range) {
  return Drawing(lanes, columns, range).draw();
}

}  // namespace rung::host

// The trace as an SVG: see plot.h.
#include "plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "trace.h"
#include "value_format.h"

namespace rung::host {
namespace {

constexpr size_t kMaxColumns = 2000;
constexpr int kCharacter = 7, kWidth = 800, kRight = 20, kTop = 16, kGap = 14, kLane = 64, kBoolLane = 20, kAxis = 30;

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

// Tenths of a pixel are precise enough.
std::string pixels(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.1f", value);
  std::string out = text;
  if (out.compare(out.size() - 2, 2, ".0") == 0) out.resize(out.size() - 2);
  return out;
}

std::string textAt(double x, double y, const char* anchor, std::string_view text) {
  return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" text-anchor=\"" + anchor + "\">" + escapedForSvg(text) +
         "</text>\n";
}

// 1, 2 or 5 times a power of ten, so that at most eight ticks fit.
int64_t tickOf(int64_t total_ns) {
  int64_t tick = 1;
  for (int64_t power = 1; power <= total_ns; power *= 10) {
    for (const int64_t factor : {1, 2, 5}) {
      tick = power * factor;
      if (total_ns / tick <= 8) return tick;
    }
  }
  return tick;
}

std::string timeText(int64_t ns) {
  return ns % 1'000'000'000 == 0 ? std::to_string(ns / 1'000'000'000) + " s" : millisecondsOf(ns) + " ms";
}

int heightOf(const Variable& variable) { return variable.type->kind == RUNG_BOOL ? kBoolLane : kLane; }

}  // namespace

bool Plot::open(const std::string& path, std::FILE* out, const std::vector<Variable>& variables, std::string& error) {
  for (const Variable& variable : variables) {
    double value;
    if (!numberOf(module_, variable, value)) continue;
    lanes_.push_back({variable, {}, 0, 0, "", "", false});
    left_ = std::max(left_, kCharacter * static_cast<int>(variable.path.size()) + 16);
  }
  if (lanes_.empty()) {
    error = "--plot: none of the variables is a number or a BOOL";
    return false;
  }
  return file_.open(path, out, error);
}

void Plot::row() {
  if (!file_.isOpen()) return;
  if (rows_ / rows_per_column_ == static_cast<int64_t>(kMaxColumns)) halve();
  const bool starts = rows_ % rows_per_column_ == 0;
  ++rows_;
  for (Lane& lane : lanes_) {
    double value;
    if (!numberOf(module_, lane.variable, value) || !std::isfinite(value)) value = NAN;
    if (starts) {
      lane.columns.push_back({value, value, value, value});
    } else {
      Column& column = lane.columns.back();
      column.low = std::fmin(column.low, value);
      column.high = std::fmax(column.high, value);
      column.last = value;
    }
    if (std::isnan(value)) continue;
    for (const bool high : {false, true}) {
      if (lane.has_value && !(high ? value > lane.high : value < lane.low)) continue;
      (high ? lane.high : lane.low) = value;
      std::string& text = high ? lane.high_text : lane.low_text;
      text.clear();
      formatValue(module_, lane.variable, text);
    }
    lane.has_value = true;
  }
}

// Merges pairs of columns, so each represents twice as many rows.
void Plot::halve() {
  for (Lane& lane : lanes_) {
    for (size_t i = 0; i + 1 < lane.columns.size(); i += 2) {
      const Column &a = lane.columns[i], &b = lane.columns[i + 1];
      lane.columns[i / 2] = {a.first, std::fmin(a.low, b.low), std::fmax(a.high, b.high), b.last};
    }
    lane.columns.resize(kMaxColumns / 2);
  }
  rows_per_column_ *= 2;
}

void Plot::draw(const Lane& lane, int top, int height, std::string& svg) const {
  const bool is_bool = lane.variable.type->kind == RUNG_BOOL;
  const double low = is_bool ? 0 : lane.low, high = is_bool ? 1 : lane.high;
  const auto y = [&](double value) {
    return high > low ? top + height - (value - low) / (high - low) * height : top + height / 2.0;
  };
  svg += textAt(left_ - 8, top + height / 2.0 + 4, "end", lane.variable.path);
  if (!is_bool && lane.has_value) {
    svg += "<g class=\"scale\">" + textAt(left_ + kWidth, top - 2, "end", lane.high_text);
    if (high > low) svg += textAt(left_ + kWidth, top + height + 11, "end", lane.low_text);
    svg += "</g>\n";
  }
  svg += "<path class=\"line\" d=\"";
  const double width = static_cast<double>(kWidth) * static_cast<double>(rows_per_column_) / static_cast<double>(rows_);
  bool drawing = false;
  for (size_t i = 0; i < lane.columns.size(); ++i) {
    const Column& column = lane.columns[i];
    if (std::isnan(column.low)) {
      drawing = false;
      continue;
    }
    const double from = std::isnan(column.first) ? column.low : column.first;
    const double to = std::isnan(column.last) ? column.high : column.last;
    const double x = left_ + static_cast<double>(i) * width;
    svg += (drawing ? "V" : "M" + pixels(x) + " ") + pixels(y(from));
    if (column.low < column.high)
      svg += "V" + pixels(y(column.low)) + "V" + pixels(y(column.high)) + "V" + pixels(y(to));
    svg += "H" + pixels(std::fmin(x + width, left_ + kWidth));
    drawing = true;
  }
  svg += "\"/>\n";
}

bool Plot::close(int64_t row_ns, std::string& error) {
  if (!file_.isOpen()) return true;
  int height = kTop + kAxis;
  for (const Lane& lane : lanes_) height += heightOf(lane.variable) + kGap;
  const std::string width_text = std::to_string(left_ + kWidth + kRight), height_text = std::to_string(height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width_text + "\" height=\"" + height_text +
                    "\" viewBox=\"0 0 " + width_text + " " + height_text +
                    "\">\n<style>text{font:12px sans-serif;fill:#222}.scale text{font-size:10px;fill:#777}"
                    ".line{fill:none;stroke:#1860a8;stroke-width:1.5}.grid{stroke:#ddd}</style>\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  const int bottom = height - kAxis;
  const int64_t total = rows_ * row_ns, tick = tickOf(total);
  for (int64_t time = 0; time <= total; time += tick) {
    const double x =
        left_ + static_cast<double>(kWidth) * static_cast<double>(time) / static_cast<double>(total > 0 ? total : 1);
    svg += "<path class=\"grid\" d=\"M" + pixels(x) + " " + std::to_string(kTop) + "V" + std::to_string(bottom) +
           "\"/>\n" + textAt(x, bottom + 16, "middle", timeText(time));
  }
  int top = kTop;
  for (const Lane& lane : lanes_) {
    draw(lane, top, heightOf(lane.variable), svg);
    top += heightOf(lane.variable) + kGap;
  }
  file_.write(svg + "</svg>\n");
  return file_.close(error);
}

}  // namespace rung::host

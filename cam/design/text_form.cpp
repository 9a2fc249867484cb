// SPDX-License-Identifier: Apache-2.0
// The writer of `.cam` files; see text_form.h.
#include "cam/design/text_form.h"

#include <charconv>

#include "cam/design/words.h"

namespace rung::cam {
namespace {

std::string exactReal(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

class LineWriter {
 public:
  explicit LineWriter(const Cam& cam) : cam_(cam) {}

  std::string write() {
    line({"cam", cam_.name});
    writeRepeat();
    line({"master", exactText(cam_.start), exactText(cam_.end), cam_.master_unit});
    line({"slave", cam_.slave_unit});
    writeLimits();
    if (cam_.capacity != 0) line({"capacity", std::to_string(cam_.capacity)});
    writeRows();
    for (const Tappet& tappet : cam_.tappets) writeTappet(tappet);
    return std::move(out_);
  }

 private:
  // Empty words are left out, and so is a line with nothing but its key.
  void line(std::initializer_list<std::string_view> words) {
    std::string text;
    size_t count = 0;
    for (const std::string_view word : words) {
      if (word.empty()) continue;
      if (count++ > 0) text += ' ';
      text += word;
    }
    if (count > 1) out_ += text + "\n";
  }

  void writeRepeat() {
    switch (cam_.repeat) {
      case Repeat::Never: return;
      case Repeat::Closed: return line({"repeat", "closed"});
      case Repeat::Modulo: return line({"repeat", "modulo", exactText(cam_.slave_period)});
      case Repeat::Relative: return line({"repeat", "relative"});
    }
  }

  void writeLimits() {
    const Limits& limits = cam_.limits;
    if (limits.speed) line({"speed", exactText(*limits.speed)});
    if (limits.low && limits.high) line({"limit", "position", exactText(*limits.low), exactText(*limits.high)});
    for (const LimitRow& row : kLimitRows)
      if (limits.*row.value) line({"limit", row.word, exactText(*(limits.*row.value))});
  }

  std::string number(double value) const {
    return cam_.number == Number::Real ? exactReal(static_cast<float>(value)) : exactText(value);
  }

  void writeRows() {
    const std::string_view word = wordOf(kRowWords, cam_.kind);
    if (cam_.kind == Kind::Equidistant || cam_.kind == Kind::Pairs) {
      line({"number", wordOf(kNumberWords, cam_.number)});
      line({"interpolation", cam_.cubic ? "cubic" : "linear"});
    }
    if (const auto& scale = cam_.scale)
      line({"scale", exactText(scale->table_min), exactText(scale->table_max), exactText(scale->master_min),
            exactText(scale->master_max)});
    switch (cam_.kind) {
      case Kind::QuinticPoints:
        for (size_t i = 0; i < cam_.points.size(); ++i) {
          const Point& p = cam_.points[i];
          line({word, exactText(p.x), exactText(p.y), exactText(p.slope), exactText(p.curvature),
                cam_.segments[i] == SegmentKind::Line ? "line" : ""});
        }
        return;
      case Kind::Polynomials:
        for (const Polynomial& p : cam_.polynomials)
          line({word, exactText(p.x), exactText(p.c[0]), exactText(p.c[1]), exactText(p.c[2]), exactText(p.c[3]),
                exactText(p.c[4]), exactText(p.c[5])});
        return;
      case Kind::Equidistant:
        for (const double value : cam_.numbers) line({word, number(value)});
        return;
      case Kind::Pairs:
        for (size_t i = 0; i + 1 < cam_.numbers.size(); i += 2)
          line({word, number(cam_.numbers[i]), number(cam_.numbers[i + 1])});
        return;
    }
  }

  void writeTappet(const Tappet& tappet) {
    const std::string delay = "delay " + std::to_string(tappet.delay) + "us";
    const std::string duration = "duration " + std::to_string(tappet.duration) + "us";
    line({"tappet", exactText(tappet.x), std::to_string(tappet.group), wordOf(kActionWords, tappet.action),
          wordOf(kDirectionWords, tappet.direction), tappet.delay != 0 ? delay : "",
          tappet.duration != 0 ? duration : ""});
  }

  const Cam& cam_;
  std::string out_;
};

}  // namespace

std::string exactText(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

std::string textOf(const Cam& cam) { return LineWriter(cam).write(); }

}  // namespace rung::cam

// SPDX-License-Identifier: Apache-2.0
// `rung cam show`: a cam as a picture: position, velocity, acceleration and jerk over the master, with their peaks and
// limits, and the switches of its tappets.
#include <algorithm>
#include <cmath>
#include <map>

#include "cam/design/text_form.h"
#include "cam/design/words.h"
#include "stdlib/runtime/host/plot_drawing.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

using host::PlotColumn;
using host::PlotKind;
using host::PlotLane;

constexpr int kColumns = 1440;  // two for each pixel
constexpr const char* kNames[] = {"s", "v", "a", "j"};

class Picture {
 public:
  Picture(const cam::Cam& cam, std::optional<double> speed)
      : cam_(cam), curve_(curveOf(cam)), speed_(speed), peaks_(peaksOf(cam, curve_, speed.value_or(1))) {}

  std::string draw() {
    std::vector<PlotLane> lanes;
    for (int order = 0; order <= 3; ++order) lanes.push_back(lane(order));
    addTappets(lanes);
    const std::string unit = cam_.master_unit.empty() ? "" : "/" + cam_.master_unit;
    return host::drawPlot(lanes, kColumns, {cam_.start, cam_.end, "x" + unit});
  }

  const cam::Peaks& peaks() const { return peaks_; }

 private:
  double masterAt(int column) const {
    return column == kColumns ? cam_.end : cam_.start + (cam_.end - cam_.start) * column / kColumns;
  }
  double columnOf(double x) const { return (x - cam_.start) / (cam_.end - cam_.start) * kColumns; }

  PlotLane lane(int order) const {
    PlotLane lane;
    lane.name = kNames[order];
    const std::string unit = unitOf(cam_, order, speed_.has_value());
    if (!unit.empty()) lane.name += "/(" + unit + ")";
    if (order == 0 && !unit.empty()) lane.name = "s/" + unit;
    const double factor = std::pow(speed_.value_or(1), order);
    // The value on both sides of a joint: a step is drawn where it is.
    const std::span<const cam::Piece> pieces = curve_.pieces();
    size_t piece = 0;
    for (int i = 0; i < kColumns; ++i) {
      const double from = masterAt(i), to = masterAt(i + 1);
      while (piece + 1 < pieces.size() && pieces[piece].to <= from) ++piece;
      PlotColumn column{pieces[piece].at(from, order), 0, 0, 0};
      column.low = column.high = column.first;
      const auto include = [&](double value) {
        column.low = std::min(column.low, value);
        column.high = std::max(column.high, value);
        column.last = value;
      };
      size_t inner = piece;
      for (; inner + 1 < pieces.size() && pieces[inner].to < to; ++inner) {
        include(pieces[inner].at(pieces[inner].to, order));
        include(pieces[inner + 1].at(pieces[inner].to, order));
      }
      include(pieces[inner].at(to, order));
      lane.columns.push_back({column.first * factor, column.low * factor, column.high * factor, column.last * factor});
    }
    addMarks(order, lane);
    return lane;
  }

  void addMarks(int order, PlotLane& lane) const {
    const cam::Limits& limits = cam_.limits;
    if (order == 0) {
      if (limits.low) lane.limits = {*limits.low, *limits.high};
    } else if (const std::optional<double>& limit = limits.*cam::kLimitRows[order - 1].value; limit && speed_) {
      lane.limits = {-*limit, *limit};
    }
    const cam::Peak& peak = peaks_[static_cast<size_t>(order)];
    if (peak.isInfinite()) {
      lane.marks.push_back({columnOf(peak.step.x), curve_.at(peak.step.x, order) * std::pow(speed_.value_or(1), order),
                            "infinite at " + format("%.5g", peak.step.x)});
      return;
    }
    const auto mark = [&](const cam::Extreme& extreme) {
      if (extreme.value != 0) lane.marks.push_back({columnOf(extreme.x), extreme.value, format("%.5g", extreme.value)});
    };
    mark(peak.high);
    if (peak.low.value != peak.high.value) mark(peak.low);
  }

  // A lane for each group, as it switches while the master goes forward; of a cam that repeats, in its second period.
  void addTappets(std::vector<PlotLane>& lanes) const {
    std::map<int32_t, std::vector<cam::Tappet>> groups;
    for (const cam::Tappet& tappet : cam_.tappets)
      if (tappet.direction != cam::TappetDirection::Backward) groups[tappet.group].push_back(tappet);
    for (auto& [group, tappets] : groups) {
      std::stable_sort(tappets.begin(), tappets.end(),
                       [](const cam::Tappet& a, const cam::Tappet& b) { return a.x < b.x; });
      PlotLane lane;
      lane.name = "tappet " + std::to_string(group);
      lane.kind = PlotKind::Level;
      Switch state;
      if (cam_.repeat != cam::Repeat::Never) goForward(tappets, state, nullptr);
      for (auto& [from, to] : state.pulses) from -= cam_.end - cam_.start, to -= cam_.end - cam_.start;
      goForward(tappets, state, &lane);
      lanes.push_back(std::move(lane));
    }
  }

  struct Switch {
    bool is_on = false;
    std::vector<std::pair<double, double>> pulses;  // master positions
  };

  // One period; fills the lane, unless it is null.
  void goForward(const std::vector<cam::Tappet>& tappets, Switch& state, PlotLane* lane) const {
    size_t next = 0;
    for (int i = 0; i < kColumns; ++i) {
      const double from = masterAt(i), to = masterAt(i + 1);
      for (; next < tappets.size() && (tappets[next].x < to || i + 1 == kColumns); ++next) pass(tappets[next], state);
      const bool is_pulsed = std::any_of(state.pulses.begin(), state.pulses.end(),
                                         [&](const auto& pulse) { return pulse.first < to && from < pulse.second; });
      const double value = state.is_on || is_pulsed ? 1 : 0;
      if (lane != nullptr) lane->columns.push_back({value, value, value, value});
    }
  }

  // Without a speed a pulse has no length in the master, and is drawn as a needle.
  void pass(const cam::Tappet& tappet, Switch& state) const {
    const double needle = (cam_.end - cam_.start) / kColumns, microsecond = speed_.value_or(0) * 1e-6;
    switch (tappet.action) {
      case cam::TappetAction::On: state.is_on = true; return;
      case cam::TappetAction::Off: state.is_on = false; return;
      case cam::TappetAction::Invert: state.is_on = !state.is_on; return;
      case cam::TappetAction::Pulse: {
        const double from = tappet.x + tappet.delay * microsecond;
        state.pulses.emplace_back(from, from + std::max(needle, tappet.duration * microsecond));
      }
    }
  }

  const cam::Cam& cam_;
  const cam::Curve curve_;
  const std::optional<double> speed_;
  const cam::Peaks peaks_;
};

}  // namespace

int runCamShow(const CamRun& run, Sink& sink) {
  if (run.inputs.size() != 1) return usageError(sink, "`rung cam show` takes one `.cam` file");
  if (run.output.empty()) return usageError(sink, "`rung cam show` needs a name for the picture: add `-o FILE.svg`");
  CamInput input;
  readCamInput(run.inputs[0], input);
  if (!input.is_read) return finishCamInput(input, sink);
  const std::optional<double> speed = speedOf(run, input.cam);
  Picture picture(input.cam, speed);
  const std::string error = writeFile(run.output, picture.draw());
  return error.empty() ? printResult(sink, tableOfPeaks(input.cam, picture.peaks(), speed)) : usageError(sink, error);
}

}  // namespace rung::driver

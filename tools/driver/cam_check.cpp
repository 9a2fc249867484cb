// SPDX-License-Identifier: Apache-2.0
// `rung cam check`: whether cams keep their limits at a speed of the master, by the exact extremes of each piece.
#include "cam/design/text_form.h"
#include "cam/design/words.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/diagnostics.h"

namespace rung::driver {
namespace {

constexpr const char* kQuantities[] = {"position", "velocity", "acceleration", "jerk"};

int orderOf(cam::LimitKind kind) {
  switch (kind) {
    case cam::LimitKind::Low:
    case cam::LimitKind::High: return 0;
    case cam::LimitKind::Velocity: return 1;
    case cam::LimitKind::Acceleration: return 2;
    case cam::LimitKind::Jerk: return 3;
  }
  return 0;
}

Loc placeOf(const importer::cams::CamSource& places, cam::LimitKind kind) {
  switch (kind) {
    case cam::LimitKind::Low:
    case cam::LimitKind::High: return places.position;
    case cam::LimitKind::Velocity: return places.velocity;
    case cam::LimitKind::Acceleration: return places.acceleration;
    case cam::LimitKind::Jerk: return places.jerk;
  }
  return {};
}

void reportLimits(CamInput& input, const cam::Peaks& peaks, double speed) {
  for (const cam::Exceeded& exceeded : exceededLimits(input.cam.limits, peaks)) {
    const int order = orderOf(exceeded.kind);
    const std::string is = exceeded.is_infinite ? "is infinite" : "is " + format("%.10g", exceeded.peak.value);
    input.diagnostics.report(
        diag::CamLimit, placeOf(input.places, exceeded.kind),
        {kQuantities[order], input.cam.name, is, format("%.10g", exceeded.peak.x), cam::exactText(exceeded.limit),
         order == 0 ? std::string() : " at the speed " + cam::exactText(speed) + " of the master"});
  }
}

bool hasLimitsPerSecond(const cam::Limits& limits) { return limits.velocity || limits.acceleration || limits.jerk; }

std::string extremeText(const cam::Extreme& extreme) {
  return padded(format("%.6g", extreme.value), 13) + "at " + padded(format("%.6g", extreme.x), 11);
}

std::string limitText(const cam::Limits& limits, int order) {
  if (order == 0) return limits.low ? cam::exactText(*limits.low) + " to " + cam::exactText(*limits.high) : "";
  const std::optional<double>& limit = limits.*cam::kLimitRows[order - 1].value;
  return limit ? cam::exactText(*limit) : "";
}

int checkOne(const std::string& path, const CamRun& run, std::string& tables, Sink& sink) {
  CamInput input;
  readCamInput(path, input);
  if (input.is_read) {
    const std::optional<double> speed = speedOf(run, input.cam);
    if (!speed && hasLimitsPerSecond(input.cam.limits))
      input.diagnostics.report(diag::CamNoSpeed, input.places.name, {input.cam.name});
    const cam::Peaks peaks = peaksOf(input.cam, curveOf(input.cam), speed.value_or(1));
    if (!input.diagnostics.hasErrors()) reportLimits(input, peaks, speed.value_or(1));
    tables += tableOfPeaks(input.cam, peaks, speed);
  }
  return finishCamInput(input, sink);
}

}  // namespace

std::optional<double> speedOf(const CamRun& run, const cam::Cam& cam) {
  return run.options.speed ? run.options.speed : cam.limits.speed;
}

std::string unitOf(const cam::Cam& cam, int order, bool is_per_second) {
  const std::string master = is_per_second ? "s" : cam.master_unit;
  if (cam.slave_unit.empty() || order == 0 || master.empty()) return order == 0 ? cam.slave_unit : "";
  constexpr const char* kPowers[] = {"", "", "²", "³"};
  return cam.slave_unit + "/" + master + kPowers[order];
}

std::string tableOfPeaks(const cam::Cam& cam, const cam::Peaks& peaks, std::optional<double> speed) {
  std::string out = cam.name + ": master " + cam::exactText(cam.start) + " to " + cam::exactText(cam.end);
  const std::string unit = cam.master_unit.empty() ? "" : " " + cam.master_unit;
  out += unit;
  out += speed ? " at " + cam::exactText(*speed) + unit + "/s\n" : "\n";
  out += padded("", 14) + padded("lowest", 27) + padded("highest", 27) + "limit\n";
  for (int order = 0; order <= 3; ++order) {
    const cam::Peak& peak = peaks[static_cast<size_t>(order)];
    std::string line = padded(kQuantities[order], 14);
    if (peak.isInfinite())
      line += padded("infinite", 13) + "at " + padded(format("%.6g", peak.step.x), 38);
    else
      line += extremeText(peak.low) + extremeText(peak.high);
    line += limitText(cam.limits, order);
    const std::string of = unitOf(cam, order, speed.has_value());
    if (!of.empty()) line += (line.back() == ' ' ? "" : " ") + of;
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

int runCamCheck(const CamRun& run, Sink& sink) {
  if (run.inputs.empty()) return usageError(sink, "`rung cam check` needs `.cam` files");
  if (!run.output.empty()) return usageError(sink, "`rung cam check` takes no `-o`");
  std::string tables;
  int exit = kSuccess;
  for (const std::string& path : run.inputs) exit = std::max(exit, checkOne(path, run, tables, sink));
  const int printed = tables.empty() ? kSuccess : printResult(sink, tables);
  return std::max(exit, printed);
}

}  // namespace rung::driver

// SPDX-License-Identifier: Apache-2.0
// `rung cam fit`: a cam through points, with a report of its errors and peaks.
#include <algorithm>

#include "cam/design/text_form.h"
#include "frontend/import/cam/points_file.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/cam_fit_module.h"
#include "tools/driver/commands.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/output_files.h"

namespace rung::driver {

namespace {

cam::FitRequest requestOf(const CamOptions& options, const std::vector<importer::cams::MeasuredPoint>& points) {
  cam::FitRequest request;
  for (const importer::cams::MeasuredPoint& point : points) request.samples.push_back({point.x, point.y, point.weight});
  for (const CamOptions::Pair& exact : options.exact) request.exact.push_back({exact.first, exact.second});
  for (const CamOptions::Pair& dwell : options.dwells)
    request.dwells.push_back({dwell.first, dwell.second, dwell.third});
  const cam::Ends& ends = options.ends;
  if (ends.given & cam::kV0) request.at_start.slope = ends.v0;
  if (ends.given & cam::kA0) request.at_start.curvature = ends.a0;
  if (ends.given & cam::kV1) request.at_end.slope = ends.v1;
  if (ends.given & cam::kA1) request.at_end.curvature = ends.a1;
  request.repeat = options.repeat == "closed"     ? cam::Repeat::Closed
                   : options.repeat == "relative" ? cam::Repeat::Relative
                   : options.repeat == "modulo"   ? cam::Repeat::Modulo
                                                  : cam::Repeat::Never;
  request.slave_period = options.period.value_or(0);
  request.limits.speed = options.speed;
  request.limits.velocity = options.max_velocity;
  request.limits.acceleration = options.max_acceleration;
  request.limits.jerk = options.max_jerk;
  if (options.position) {
    request.limits.low = options.position->first;
    request.limits.high = options.position->second;
  }
  if (options.range) {
    request.start = options.range->first;
    request.end = options.range->second;
  }
  request.smoothness = options.has_smooth_jerk ? cam::Smoothness::C3 : cam::Smoothness::C2;
  request.loss = options.loss == "huber"    ? cam::Loss::Huber
                 : options.loss == "cauchy" ? cam::Loss::Cauchy
                 : options.loss == "tukey"  ? cam::Loss::Tukey
                                            : cam::Loss::Squares;
  request.loss_scale = options.loss_scale;
  request.most_segments = options.segments;
  request.tolerance = options.tolerance;
  return request;
}

std::string reportOf(const cam::FitResult& result, const cam::FitRequest& request, std::optional<double> speed) {
  const cam::FitReport& report = result.report;
  std::string out = std::to_string(request.samples.size()) + " points, " + std::to_string(report.segments) +
                    " segments, continuous " + (request.smoothness == cam::Smoothness::C2 ? "acceleration" : "jerk") +
                    "\nlargest error " + format("%.6g", report.max_error.value) + " at " +
                    format("%.6g", report.max_error.x) + ", rms error " + format("%.6g", report.rms_error) + "\n";
  if (report.iterations > 0) out += std::to_string(report.iterations) + " iterations to keep the limits\n";
  if (request.loss != cam::Loss::Squares)
    out += std::to_string(report.robust_iterations) + " iterations of the loss, " + std::to_string(report.outliers) +
           " outliers\n";
  return out + tableOfPeaks(result.cam, peaksOf(result.cam, curveOf(result.cam), speed.value_or(1)), speed);
}

// As comments of a `.cam` file.
std::string commented(const std::string& text) {
  std::string out = "# ";
  for (size_t i = 0; i < text.size(); ++i) {
    out += text[i];
    if (text[i] == '\n' && i + 1 < text.size()) out += "# ";
  }
  return out;
}

}  // namespace

int runCamFit(const CamRun& run, Sink& sink) {
  const CamOptions& options = run.options;
  if (run.inputs.size() != 1) return usageError(sink, "`rung cam fit` takes one CSV file of points");
  if ((options.max_velocity || options.max_acceleration || options.max_jerk) && !options.speed)
    return usageError(sink, "limits are per second; add `--speed V` for the master");
  if (options.loss_scale && (options.loss.empty() || options.loss == "squares"))
    return usageError(sink, "`--loss-scale` needs `--loss huber`, `cauchy` or `tukey`");

  const std::string& path = run.inputs[0];
  CamInput input;
  std::vector<importer::cams::MeasuredPoint> points;
  const FileId file = readCamSource(path, input);
  if (!file || !readPoints(input.sources, file, input.diagnostics, points)) return finishCamInput(input, sink);
  const cam::FitRequest request = requestOf(options, points);
  cam::FitResult result;
  if (const std::string missing = fitWithModule(request, result); !missing.empty()) return usageError(sink, missing);
  if (!result.error.empty()) {
    input.diagnostics.report(diag::CamFit, {}, {result.error}).path(path);
    return finishCamInput(input, sink);
  }
  result.cam.name = options.name;
  result.cam.master_unit = options.master_unit;
  result.cam.slave_unit = options.slave_unit;
  const std::string text = textOf(result.cam), shown = reportOf(result, request, options.speed);
  if (run.output.empty()) return printResult(sink, commented(shown) + text);
  const std::string error = writeFile(run.output, text);
  return error.empty() ? printResult(sink, shown) : usageError(sink, error);
}

}  // namespace rung::driver

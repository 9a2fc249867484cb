// SPDX-License-Identifier: Apache-2.0
// `rung cam law`: the motion laws and their coefficients, and one of them as points or as a `.cam` file.
#include <algorithm>
#include <cmath>

#include "cam/design/text_form.h"
#include "frontend/import/formats.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

constexpr int kDegreeOfCams = 5;

std::string exact(double value) { return cam::exactText(value == 0 ? 0.0 : value); }  // -0

std::string listOfLaws() {
  std::string out =
      padded("law", 22) + padded("C_v", 9) + padded("C_a", 9) + padded("C_j", 9) + padded("C_m", 9) + "\n";
  for (const cam::LawRow& row : cam::allLaws()) {
    const cam::LawCurve made = cam::lawCurve(row.law, {});
    const cam::Coefficients c = cam::coefficients(made.curve);
    out += padded(row.name, 22) + padded(format("%.4f", c.v), 9) + padded(format("%.4f", c.a), 9) +
           padded(row.is_shock ? "inf" : format("%.3f", c.j), 9) + padded(format("%.3f", c.m), 9) + row.title + "\n";
  }
  return out;
}

// The ends of the normalised law.
cam::Ends normalised(const CamOptions& options) {
  cam::Ends ends = options.ends;
  const double v = options.length / options.stroke, a = v * options.length, j = a * options.length;
  ends.v0 *= v;
  ends.v1 *= v;
  ends.a0 *= a;
  ends.a1 *= a;
  ends.j0 *= j;
  ends.j1 *= j;
  return ends;
}

double scaleOf(const CamOptions& options, int order) {
  double scale = options.stroke;
  for (int i = 0; i < order; ++i) scale /= options.length;
  return scale;
}

std::string points(const cam::Curve& curve, const CamOptions& options) {
  std::string out = "x,y,v,a,j\n";
  for (uint32_t i = 0; i < options.points; ++i) {
    const double z = static_cast<double>(i) / (options.points - 1);
    out += exact(z * options.length);
    for (int order = 0; order <= 3; ++order) out += "," + exact(scaleOf(options, order) * curve.at(z, order));
    out += "\n";
  }
  return out;
}

// As lines that readers of the CSV skip.
std::string summary(const cam::LawRow& row, const cam::Curve& curve, const CamOptions& options) {
  const cam::Coefficients c = cam::coefficients(curve);
  std::string out = std::string("# ") + row.title + "\n# C_v " + format("%.6g", c.v) + "  C_a " + format("%.6g", c.a) +
                    "  C_j " + (row.is_shock ? "inf (" + format("%.6g", c.j) + " inside)" : format("%.6g", c.j)) +
                    "  C_m " + format("%.6g", c.m) + "\n";
  for (int order = 1; order <= 3; ++order) {
    const cam::Extreme peak = curve.extremes(order).peak();
    out += std::string("# peak ") + "svaj"[order] + " " + format("%.6g", scaleOf(options, order) * peak.value) +
           " at " + format("%.6g", peak.x * options.length) + "\n";
  }
  return out;
}

std::string checkNumbers(const cam::LawRow& row, const CamOptions& options) {
  if (options.stroke == 0) return "`--stroke` is 0; a motion law needs a way to go";
  if (options.length <= 0) return "`--length` is not above 0";
  if (options.ends.turn <= 0 || options.ends.turn >= 1) return "`--turn` is not between 0 and 1";
  for (const CamNumber& number : camNumbers())
    if (options.ends.given & number.given & ~row.takes)
      return backquoted(row.name) + " takes no " + backquoted(number.name);
  return {};
}

// Of laws whose polynomials have a higher degree, or sines, a cam is an approximation.
bool isExact(const cam::Curve& curve) {
  return std::all_of(curve.pieces().begin(), curve.pieces().end(), [](const cam::Piece& piece) {
    return std::all_of(piece.coefficients.begin() + kDegreeOfCams + 1, piece.coefficients.end(),
                       [](double factor) { return factor == 0; }) &&
           std::all_of(piece.sines.begin(), piece.sines.end(), [](const cam::Sine& s) { return s.amplitude == 0; });
  });
}

bool hasShockInside(const cam::Curve& curve) {
  const std::span<const cam::Piece> pieces = curve.pieces();
  for (size_t i = 1; i < pieces.size(); ++i)
    if (std::fabs(pieces[i].at(pieces[i].from, 2) - pieces[i - 1].at(pieces[i].from, 2)) > 1e-9) return true;
  return false;
}

cam::Point pointAt(const cam::Curve& curve, double z, const CamOptions& options) {
  const auto of = [&](int order) { return scaleOf(options, order) * curve.at(z, order); };
  return {z * options.length, of(0), of(1), of(2)};
}

// The joints of the law and, unless the cam is exact with them, `--points` at equal distances.
void addPoints(const cam::Curve& curve, const CamOptions& options, cam::Cam& cam) {
  std::vector<double> places = {0, 1};
  for (const cam::Piece& piece : curve.pieces()) places.push_back(piece.from);
  for (uint32_t i = 1; !isExact(curve) && i + 1 < options.points; ++i)
    places.push_back(static_cast<double>(i) / (options.points - 1));
  std::sort(places.begin(), places.end());
  for (const double z : places) {
    const cam::Point point = pointAt(curve, z, options);
    if (cam.points.empty() || point.x > cam.points.back().x + 1e-9 * options.length) cam.points.push_back(point);
  }
  cam.segments.assign(cam.points.size(), cam::SegmentKind::Quintic);
}

void addPolynomials(const cam::Curve& curve, const CamOptions& options, cam::Cam& cam) {
  cam.kind = cam::Kind::Polynomials;
  for (const cam::Piece& piece : curve.pieces()) {
    cam::Polynomial row{piece.from * options.length, {}};
    double factorial = 1;
    for (int order = 0; order <= kDegreeOfCams; ++order) {
      if (order > 0) factorial *= order;
      row.c[order] = scaleOf(options, order) * piece.at(piece.from, order) / factorial;
    }
    cam.polynomials.push_back(row);
  }
}

// The law as a cam; not `made` where its acceleration steps and a curve is not a polynomial.
bool makeCam(const cam::Curve& curve, const CamOptions& options, cam::Cam& cam) {
  cam.name = options.name;
  cam.end = options.length;
  cam.master_unit = options.master_unit;
  cam.slave_unit = options.slave_unit;
  cam.limits.speed = options.speed;
  if (!hasShockInside(curve))
    addPoints(curve, options, cam);
  else if (isExact(curve))
    addPolynomials(curve, options, cam);
  else
    return false;
  return true;
}

// How far the cam is from the law, in units of the slave.
double largestError(const cam::Curve& law, const cam::Cam& cam, const CamOptions& options) {
  constexpr int kSamples = 20;  // of a segment
  const cam::Curve curve = curveOf(cam);
  double error = 0;
  for (const cam::Piece& piece : curve.pieces())
    for (int i = 0; i <= kSamples; ++i) {
      const double x = piece.from + (piece.to - piece.from) * i / kSamples;
      error = std::max(error, std::fabs(piece.at(x, 0) - options.stroke * law.at(x / options.length, 0)));
    }
  return error;
}

int writeCam(const std::string& law, const cam::Curve& curve, const std::string& shown, const CamOptions& options,
             const std::string& output, Sink& sink) {
  cam::Cam cam;
  if (!makeCam(curve, options, cam))
    return usageError(sink,
                      backquoted(law) + " has a step of the acceleration inside, which points of a cam cannot have");
  const std::string error = writeFile(output, textOf(cam));
  if (!error.empty()) return usageError(sink, error);
  const double distance = largestError(curve, cam, options);
  const bool is_exact = distance <= 1e-12 * std::fabs(options.stroke);
  return printResult(sink, shown + "# " + std::to_string(cam.rowCount()) + " rows, " +
                               (is_exact ? "exact" : "largest error " + format("%.3g", distance)) + "\n");
}

int runOne(const std::string& name, const CamOptions& options, const std::string& output, Sink& sink) {
  const cam::LawRow* row = cam::findLaw(name);
  if (row == nullptr) {
    std::vector<std::string_view> names;
    for (const cam::LawRow& law : cam::allLaws()) names.push_back(law.name);
    return usageError(
        sink, withSuggestion("unknown motion law " + backquoted(name), name, names) + " (`rung cam law` lists all)");
  }
  std::string error = checkNumbers(*row, options);
  if (!error.empty()) return usageError(sink, error);
  const cam::LawCurve made = cam::lawCurve(row->law, normalised(options));
  if (!made.error.empty()) return usageError(sink, made.error);

  const bool is_cam = importer::hasExtension(output, ".cam");
  for (const char* of_cam : {"--name", "--master-unit", "--slave-unit", "--speed"})
    if (!is_cam && std::find(options.given.begin(), options.given.end(), of_cam) != options.given.end())
      return usageError(sink, backquoted(of_cam) + " is about a cam; add `-o FILE.cam`");
  if (is_cam) return writeCam(name, made.curve, summary(*row, made.curve, options), options, output, sink);
  const std::string shown = summary(*row, made.curve, options), rows = points(made.curve, options);
  if (output.empty()) return printResult(sink, shown + rows);
  error = writeFile(output, rows);
  return error.empty() ? printResult(sink, shown) : usageError(sink, error);
}

}  // namespace

int runCamLaw(const CamRun& run, Sink& sink) {
  if (run.inputs.size() > 1) return usageError(sink, "`rung cam law` takes one law");
  if (run.inputs.size() == 1) return runOne(run.inputs[0], run.options, run.output, sink);
  if (!run.output.empty()) return usageError(sink, "`-o` needs a law: `rung cam law NAME -o FILE`");
  return printResult(sink, listOfLaws());
}

}  // namespace rung::driver

// `rung cam law`: the motion laws and their coefficients, and the points of one.
#include <cmath>

#include "cam/design/text_form.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

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

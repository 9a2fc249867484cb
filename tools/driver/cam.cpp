// `rung cam law`: the motion laws and their coefficients, and the points of one; see cam.h.
#include "tools/driver/cam.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "tools/driver/commands.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

constexpr uint32_t kMostPoints = 1'000'000;

struct NumberRow {
  const char* name;
  uint8_t given;  // cam::Given; 0: not of the ends
  double* (*of)(CamOptions&);
};
constexpr NumberRow kNumbers[] = {
    {"--stroke", 0, [](CamOptions& o) { return &o.stroke; }},
    {"--length", 0, [](CamOptions& o) { return &o.length; }},
    {"--v0", cam::kV0, [](CamOptions& o) { return &o.ends.v0; }},
    {"--v1", cam::kV1, [](CamOptions& o) { return &o.ends.v1; }},
    {"--a0", cam::kA0, [](CamOptions& o) { return &o.ends.a0; }},
    {"--a1", cam::kA1, [](CamOptions& o) { return &o.ends.a1; }},
    {"--j0", cam::kJ0, [](CamOptions& o) { return &o.ends.j0; }},
    {"--j1", cam::kJ1, [](CamOptions& o) { return &o.ends.j1; }},
    {"--turn", cam::kTurn, [](CamOptions& o) { return &o.ends.turn; }},
};

std::string format(const char* pattern, double value) {
  char text[64];
  snprintf(text, sizeof text, pattern, value == 0 ? 0.0 : value);  // -0
  return text;
}

// The shortest digits that read back as the same number.
std::string exact(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value);
  return {text, end.ptr};
}

std::string padded(std::string text, size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

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
  for (const NumberRow& number : kNumbers)
    if (options.ends.given & number.given & ~row.takes)
      return backquoted(row.name) + " takes no " + backquoted(number.name);
  return {};
}

int runLaw(const std::string& name, const CamOptions& options, const std::string& output, Sink& sink) {
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

std::string setCamOption(std::string_view name, std::string_view value, CamOptions& options) {
  double number = 0;
  const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_number = code == std::errc() && end == value.data() + value.size() && std::isfinite(number);
  if (name == "--points") {
    if (!is_number || number < 2 || number > kMostPoints || number != std::floor(number))
      return "`--points` takes a number from 2 to 1000000, not " + backquoted(value);
    options.points = static_cast<uint32_t>(number);
    return {};
  }
  if (!is_number) return backquoted(name) + " takes a number, not " + backquoted(value);
  for (const NumberRow& row : kNumbers) {
    if (name != row.name) continue;
    *row.of(options) = number;
    options.ends.given |= row.given;
  }
  return {};
}

int runCam(const std::vector<std::string>& inputs, const CamOptions& options, const std::string& output, Sink& sink) {
  if (inputs.size() > 2 || inputs[0] != "law") return usageError(sink, "`rung cam` takes `law` or `law NAME`");
  if (inputs.size() == 2) return runLaw(inputs[1], options, output, sink);
  if (!output.empty()) return usageError(sink, "`-o` needs a law: `rung cam law NAME -o FILE`");
  return printResult(sink, listOfLaws());
}

}  // namespace rung::driver

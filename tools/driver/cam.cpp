// SPDX-License-Identifier: Apache-2.0
// `rung cam`: its options and subcommands; see cam.h.
#include "tools/driver/cam.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "frontend/parse/parse.h"
#include "frontend/source/scanner.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/diagnostics.h"

namespace rung::driver {
namespace {

constexpr uint32_t kMostPoints = 1'000'000;

constexpr CamNumber kNumbers[] = {
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

struct Subcommand {
  std::string_view name;
  std::string_view options;  // separated by blanks
  int (*run)(const CamRun& run, Sink& sink);
};
constexpr Subcommand kSubcommands[] = {
    {"law", "--stroke --length --v0 --v1 --a0 --a1 --j0 --j1 --turn --points --name --master-unit --slave-unit --speed",
     runCamLaw},
    {"check", "--speed", runCamCheck},
    {"show", "--speed", runCamShow},
    {"convert", "--name", runCamConvert},
    {"fit",
     "--name --segments --tolerance --smooth --repeat --range --exact --dwell --v0 --a0 --v1 --a1 --speed "
     "--max-velocity --max-acceleration --max-jerk --position --loss --loss-scale --master-unit --slave-unit",
     runCamFit},
};

struct NumberOption {
  std::string_view name;
  std::optional<double> CamOptions::*of;
  bool is_positive;
};
constexpr NumberOption kNumberOptions[] = {
    {"--speed", &CamOptions::speed, true},
    {"--tolerance", &CamOptions::tolerance, true},
    {"--loss-scale", &CamOptions::loss_scale, true},
    {"--max-velocity", &CamOptions::max_velocity, true},
    {"--max-acceleration", &CamOptions::max_acceleration, true},
    {"--max-jerk", &CamOptions::max_jerk, true},
};

struct CountOption {
  std::string_view name;
  uint32_t CamOptions::*of;
  uint32_t low, high;
};
constexpr CountOption kCountOptions[] = {
    {"--points", &CamOptions::points, 2, kMostPoints},
    {"--segments", &CamOptions::segments, 1, 500},
};

bool readNumber(std::string_view text, double& number) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

std::string readCount(const CountOption& row, std::string_view value, uint32_t& count) {
  double number = 0;
  if (!readNumber(value, number) || number < row.low || number > row.high || number != std::floor(number))
    return backquoted(row.name) + " takes a number from " + std::to_string(row.low) + " to " +
           std::to_string(row.high) + ", not " + backquoted(value);
  count = static_cast<uint32_t>(number);
  return {};
}

// `1:2` or `1:2:3`
bool readPair(std::string_view text, bool may_have_third, CamOptions::Pair& pair) {
  const size_t first = text.find(':');
  if (first == std::string_view::npos) return false;
  const size_t second = text.find(':', first + 1);
  if (!readNumber(text.substr(0, first), pair.first) ||
      !readNumber(text.substr(first + 1, second == std::string_view::npos ? second : second - first - 1), pair.second))
    return false;
  if (second == std::string_view::npos) return true;
  double third = 0;
  if (!may_have_third || !readNumber(text.substr(second + 1), third)) return false;
  pair.third = third;
  return true;
}

bool isUnit(std::string_view text) {
  return text.size() <= 40 && text.find_first_of(" \t\r\n#") == std::string_view::npos && isUtf8(text);
}

std::string setRepeat(std::string_view value, CamOptions& options) {
  options.repeat = value.substr(0, value.find(':'));
  if (value == "closed" || value == "relative") return {};
  double period = 0;
  if (options.repeat != "modulo" || value.size() < 8 || !readNumber(value.substr(7), period) || period <= 0)
    return "`--repeat` takes closed, relative or modulo:PERIOD, not " + backquoted(value);
  options.period = period;
  return {};
}

std::string setWords(std::string_view name, std::string_view value, CamOptions& options) {
  if (name == "--name") {
    options.name = value;
    if (!isIdentifier(value) || value.size() > cam::kMostName || text::isReservedWord(value))
      return "`--name` takes an identifier, not " + backquoted(value);
    return {};
  }
  if (name == "--repeat") return setRepeat(value, options);
  if (name == "--master-unit" || name == "--slave-unit") {
    if (!isUnit(value)) return backquoted(name) + " takes one word, not " + backquoted(value);
    (name == "--master-unit" ? options.master_unit : options.slave_unit) = value;
    return {};
  }
  if (name == "--loss" || name == "--smooth") {
    uint32_t choice = 0;
    std::string error = parseChoice(name, value, name == "--loss" ? "squares|huber|cauchy|tukey" : "c2|c3", choice);
    if (name == "--loss")
      options.loss = value;
    else
      options.has_smooth_jerk = choice == 1;
    return error;
  }
  CamOptions::Pair pair;
  const bool is_dwell = name == "--dwell", is_exact = name == "--exact";
  if (!readPair(value, is_dwell, pair) || (!is_exact && pair.first >= pair.second))
    return backquoted(name) + " takes " +
           (is_dwell   ? "FROM:TO or FROM:TO:Y"
            : is_exact ? "X:Y"
                       : "LOW:HIGH") +
           ", not " + backquoted(value);
  if (is_dwell)
    options.dwells.push_back(pair);
  else if (is_exact)
    options.exact.push_back(pair);
  else
    (name == "--range" ? options.range : options.position) = pair;
  return {};
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    words.push_back(text.substr(0, text.find(' ')));
    text.remove_prefix(std::min(text.size(), words.back().size() + 1));
  }
  return words;
}

}  // namespace

std::span<const CamNumber> camNumbers() { return kNumbers; }

std::string format(const char* pattern, double value) {
  char text[64];
  snprintf(text, sizeof text, pattern, value == 0 ? 0.0 : value);  // -0
  return text;
}

std::string padded(std::string text, size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

int CamInput::exitCode() const { return io_error ? kUsage : diagnostics.hasErrors() ? kInputErrors : kSuccess; }

FileId readCamSource(const std::string& path, CamInput& input) {
  ReadResult read = readFile(path);
  if (read.error.empty() && read.content.size() >= UINT32_MAX / 2) read.error = "it is too large";
  if (read.error.empty()) return input.sources.add(path, std::move(read.content));
  input.diagnostics.report(diag::CannotRead, {}, {path, read.error}).path(path);
  input.io_error = true;
  return {};
}

void readCamInput(const std::string& path, CamInput& input) {
  const FileId file = readCamSource(path, input);
  if (!file) return;
  if (importer::hasExtension(path, ".csv")) {
    std::string blanks(input.sources.original(file));
    std::replace(blanks.begin(), blanks.end(), ',', ' ');
    input.sources.activate(file, std::move(blanks));
  }
  input.is_read = importer::cams::readCam(input.sources, file, input.diagnostics, input.cam, &input.places);
}

void readCamText(const std::string& path, std::string text, CamInput& input) {
  const FileId file = input.sources.add(path, std::move(text));
  input.is_read = importer::cams::readCam(input.sources, file, input.diagnostics, input.cam, &input.places);
}

int finishCamInput(CamInput& input, Sink& sink) {
  input.diagnostics.sort();
  if (!input.diagnostics.all().empty()) sink.diagnostics(input.diagnostics, input.sources, {});
  return input.exitCode();
}

std::string setCamOption(std::string_view name, std::string_view value, CamOptions& options) {
  const bool repeats = name == "--exact" || name == "--dwell";
  if (!repeats && std::find(options.given.begin(), options.given.end(), name) != options.given.end())
    return backquoted(name) + " is given twice";
  options.given.emplace_back(name);
  for (const NumberOption& row : kNumberOptions) {
    if (name != row.name) continue;
    double number = 0;
    if (!readNumber(value, number)) return backquoted(name) + " takes a number, not " + backquoted(value);
    if (row.is_positive && number <= 0) return backquoted(name) + " takes a number above 0, not " + backquoted(value);
    options.*row.of = number;
    return {};
  }
  for (const CountOption& row : kCountOptions)
    if (name == row.name) return readCount(row, value, options.*row.of);
  for (const CamNumber& row : kNumbers) {
    if (name != row.name) continue;
    if (!readNumber(value, *row.of(options))) return backquoted(name) + " takes a number, not " + backquoted(value);
    options.ends.given |= row.given;
    return {};
  }
  return setWords(name, value, options);
}

int runCam(const std::vector<std::string>& inputs, const CamOptions& options, const std::string& output, Sink& sink) {
  std::vector<std::string_view> names;
  for (const Subcommand& subcommand : kSubcommands) {
    names.push_back(subcommand.name);
    if (inputs[0] != subcommand.name) continue;
    const std::vector<std::string_view> known = wordsOf(subcommand.options);
    for (const std::string& name : options.given)
      if (std::find(known.begin(), known.end(), name) == known.end())
        return usageError(sink, backquoted(name) + " is not an option of `rung cam " + inputs[0] + "`");
    return subcommand.run({{inputs.begin() + 1, inputs.end()}, options, output}, sink);
  }
  return usageError(sink,
                    withSuggestion("unknown subcommand " + backquoted(inputs[0]) + " of `rung cam`", inputs[0], names) +
                        " (`rung cam --help` lists all)");
}

}  // namespace rung::driver

// `rung cam`: its options and subcommands; see cam.h.
#include "tools/driver/cam.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

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
    {"law", "--stroke --length --v0 --v1 --a0 --a1 --j0 --j1 --turn --points", runCamLaw},
    {"check", "--speed", runCamCheck},
    {"show", "--speed", runCamShow},
};

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

void readCamInput(const std::string& path, CamInput& input) {
  ReadResult read = readFile(path);
  const bool is_refused = !read.error.empty() || read.content.size() >= UINT32_MAX / 2;
  if (is_refused) {
    const std::string why = read.error.empty() ? "it is too large" : read.error;
    input.diagnostics.report(diag::CannotRead, {}, {path, why}).path(path);
    input.io_error = true;
    return;
  }
  const FileId file = input.sources.add(path, std::move(read.content));
  input.is_read = importer::cams::readCam(input.sources, file, input.diagnostics, input.cam, &input.places);
}

int finishCamInput(CamInput& input, Sink& sink) {
  input.diagnostics.sort();
  if (!input.diagnostics.all().empty()) sink.diagnostics(input.diagnostics, input.sources, {});
  return input.exitCode();
}

std::string setCamOption(std::string_view name, std::string_view value, CamOptions& options) {
  options.given.emplace_back(name);
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
  if (name == "--speed") {
    if (number <= 0) return "`--speed` takes a number above 0, not " + backquoted(value);
    options.speed = number;
    return {};
  }
  for (const CamNumber& row : kNumbers) {
    if (name != row.name) continue;
    *row.of(options) = number;
    options.ends.given |= row.given;
  }
  return {};
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

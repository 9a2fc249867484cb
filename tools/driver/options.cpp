// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/options.h"

#include "frontend/source/diagnostics.h"
#include "frontend/source/scanner.h"
#include "ir/ir.h"

namespace rung::driver {
namespace {

struct CheckRow {
  const char* name;
  uint8_t bits;
};
constexpr uint8_t kDefaultChecks = ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast;
constexpr uint8_t kAllChecks = kDefaultChecks | ir::kCheckSubrange | ir::kCheckConvert | ir::kCheckOverflow;
constexpr CheckRow kChecks[] = {
    {"div", ir::kCheckDiv},
    {"index", ir::kCheckIndex},
    {"null", ir::kCheckNull},
    {"cast", ir::kCheckCast},
    {"subrange", ir::kCheckSubrange},
    {"convert", ir::kCheckConvert},
    {"overflow", ir::kCheckOverflow},
    {"default", kDefaultChecks},
    {"all", kAllChecks},
    {"none", 0},
};

}  // namespace

uint8_t defaultChecks() { return kDefaultChecks; }

std::string backquoted(std::string_view text) { return "`" + std::string(text) + "`"; }

std::string withSuggestion(std::string message, std::string_view written,
                           const std::vector<std::string_view>& candidates) {
  std::string_view near = nearest(written, candidates);
  if (!near.empty()) message += "; did you mean " + backquoted(near) + "?";
  return message;
}

// The position of `value` in `a|b|c`.
std::string parseChoice(std::string_view option, std::string_view value, std::string_view choices, uint32_t& index) {
  uint32_t position = 0;
  std::vector<std::string_view> names;
  for (std::string_view rest = choices;;) {
    size_t bar = rest.find('|');
    std::string_view name = rest.substr(0, bar);
    if (name == value) {
      index = position;
      return {};
    }
    names.push_back(name);
    if (bar == std::string_view::npos) break;
    rest.remove_prefix(bar + 1);
    position++;
  }
  return withSuggestion(
      backquoted(value) + " is not a value of " + backquoted(option) + "; it takes " + std::string(choices), value,
      names);
}

bool isModuleName(std::string_view name) { return name.size() <= 200 && isIdentifier(name); }

std::string parseDialect(std::string_view name, Dialect& dialect) {
  std::vector<Dialect> dialects;
  std::string names;
  for (const LanguageProfile& profile : kProfiles) {
    if (!profile.is_chosen) continue;
    names.append(dialects.empty() ? "" : "|").append(profile.name);
    dialects.push_back(profile.dialect);
  }
  uint32_t choice = 0;
  std::string error = parseChoice("--std", name, names, choice);
  if (error.empty()) dialect = dialects[choice];
  return error;
}

std::string parseNativeWidth(std::string_view bits, uint32_t& width) {
  uint32_t choice = 0;
  std::string error = parseChoice("--native-width", bits, "32|64", choice);
  if (error.empty()) width = choice == 0 ? 32 : 64;
  return error;
}

std::string parseEdgeCoils(std::string_view name, diagram::EdgeCoils& edge_coils) {
  uint32_t choice = 0;
  std::string error = parseChoice("--edge-coils", name, "pulse|latch", choice);
  if (error.empty()) edge_coils = choice == 0 ? diagram::EdgeCoils::Pulse : diagram::EdgeCoils::Latch;
  return error;
}

std::string parseDefine(std::string_view text, std::vector<text::Define>& defines) {
  const size_t equal = text.find('=');
  const std::string_view name = text.substr(0, equal);
  if (!isModuleName(name)) return backquoted(name) + " is not a name; `-D` takes NAME or NAME=VALUE";
  defines.push_back({std::string(name), equal == text.npos ? "" : std::string(text.substr(equal + 1))});
  return {};
}

std::string parseChecks(std::string_view list, uint8_t& checks) {
  uint8_t bits = 0;
  std::vector<std::string_view> names;
  for (const CheckRow& row : kChecks) names.push_back(row.name);
  for (std::string_view rest = list;;) {
    size_t comma = rest.find(',');
    std::string_view name = rest.substr(0, comma);
    bool known = false;
    for (const CheckRow& row : kChecks) {
      if (name != row.name) continue;
      bits |= row.bits;
      known = true;
    }
    if (!known) return withSuggestion("unknown check " + backquoted(name) + " in `--checks`", name, names);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  checks = bits;
  return {};
}

}  // namespace rung::driver

// SPDX-License-Identifier: Apache-2.0
// Forced variables: see forces.h.
#include "forces.h"

#include <algorithm>

#include "value_format.h"

namespace rung::host {
namespace {

constexpr uint32_t kMostForces = 10'000;  // each costs every activation some nanoseconds

}  // namespace

std::string Forces::check(const Variable& variable, std::string_view value) const {
  if (!symbols_.isShared(variable))
    return "`" + variable.path + "` is a terminal of a simulated module; `set` it, and it keeps its value";
  return checkValue(symbols_.module(), variable, value);
}

bool Forces::hasRoom(size_t more) const { return more <= kMostForces - table_.count; }

void Forces::force(const Variable& variable, std::string_view value) {
  rows_.resize(table_.count + size_t{1});
  values_.resize(table_.value_bytes + size_t{variable.type->size});
  table_.rows = rows_.data();
  table_.values = values_.data();
  table_.capacity = static_cast<uint32_t>(rows_.size());
  table_.value_capacity = static_cast<uint32_t>(values_.size());
  unforce(variable);
  names_.push_back(variable);
  const std::string_view literal = trimmed(value);
  rung_force_text(&table_, &symbols_.module().description, &variable, literal.data(), literal.size());
}

void Forces::unforce(const Variable& variable) {
  rung_unforce(&table_, &variable);
  names_.erase(std::remove_if(names_.begin(), names_.end(),
                              [&](const Variable& named) { return rung_is_same_variable(&named, &variable); }),
               names_.end());
}

void Forces::unforceAll() {
  table_.count = table_.value_bytes = 0;
  names_.clear();
}

// The value to which a variable is forced.
std::string Forces::valueOf(const Variable& name) const {
  const auto* const row = std::find_if(table_.rows, table_.rows + table_.count, [&](const rung_forced& forced) {
    return rung_is_same_variable(&forced.variable, &name);
  });
  std::string text;
  formatCopied(symbols_.module(), name, table_.values + row->value, text);
  return text;
}

std::vector<std::pair<std::string, std::string>> Forces::values() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const Variable& name : names_) all.emplace_back(name.path, valueOf(name));
  return all;
}

std::string Forces::list() const {
  std::string lines;
  for (const auto& [path, value] : values()) lines += path + " = " + value + '\n';
  return lines;
}

std::vector<std::string> Forces::takeFrom(const Forces& before) {
  std::vector<std::string> lost;
  for (const Variable& name : before.names_) {
    Variable variable;
    std::string error;
    const std::string value = before.valueOf(name);
    if (symbols_.find(name.path, variable, error) && check(variable, value).empty())
      force(variable, value);
    else
      lost.push_back(name.path);
  }
  return lost;
}

bool Forces::touches(const Variable& variable) const {
  const uint8_t* const at = variable.address();
  if (at == nullptr || !symbols_.isShared(variable)) return false;
  return std::any_of(table_.rows, table_.rows + table_.count, [&](const rung_forced& row) {
    const auto* const forced = static_cast<const uint8_t*>(rung_address(variable.context, &row.variable));
    if (forced == nullptr || forced >= at + variable.type->size || at >= forced + row.variable.type->size) return false;
    return variable.bit == 255 || row.variable.bit == 255 || variable.bit == row.variable.bit;
  });
}

void Forces::transfer(StateArchive& archive) {
  rows_.resize(table_.count);
  values_.resize(table_.value_bytes);
  archive.list(rows_);
  archive.list(values_);
  table_.rows = rows_.data();
  table_.values = values_.data();
  table_.count = table_.capacity = static_cast<uint32_t>(rows_.size());
  table_.value_bytes = table_.value_capacity = static_cast<uint32_t>(values_.size());
  archive.sequence(names_, Variable(), [&](Variable& name) {
    archive.value(static_cast<rung_variable&>(name));
    archive.value(name.context);
    archive.text(name.path);
  });
}

}  // namespace rung::host

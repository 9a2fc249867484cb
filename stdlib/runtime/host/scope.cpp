// SPDX-License-Identifier: Apache-2.0
// The trace on the controller of a run: see scope.h.
#include "scope.h"

#include <algorithm>
#include <mutex>

#include "value_format.h"

namespace rung::host {
namespace {

constexpr uint32_t kBytesAtOnce = 32u << 10;  // copied while tasks may wait

std::string limit(const char* what, uint32_t most) {
  return std::string("a scope has at most ") + std::to_string(most) + ' ' + what;
}

}  // namespace

std::string Scope::findChannels(const ScopeOrder& order, std::vector<Variable>& variables) const {
  if (order.paths.empty()) return "a scope needs a variable";
  if (order.paths.size() > kMostChannels) return limit("variables", kMostChannels);
  std::string error;
  for (const std::string& path : order.paths) {
    Variable& variable = variables.emplace_back();
    if (!symbols_.find(path, variable, error)) return error;
    if (!symbols_.isShared(variable)) return backquoted(path) + " is not a variable of the program";
    if (variable.type->kind >= RUNG_ARRAY) return backquoted(path) + " has no value of its own; name a variable in it";
  }
  return "";
}

std::string Scope::findTrigger(const ScopeOrder& order, rung_scope& scope) const {
  if (order.condition == RUNG_SCOPE_NONE) return "";
  Variable variable;
  std::string error;
  if (!symbols_.find(order.trigger, variable, error)) return error;
  if (!symbols_.isShared(variable) || !rung_scope_is_trigger(&variable))
    return backquoted(order.trigger) + " cannot be a trigger; use a BOOL, a number or a time";
  if (order.level.empty() && variable.type->kind != RUNG_BOOL)
    return "the trigger " + backquoted(order.trigger) + " needs a level";
  const std::string level = order.level.empty() ? "TRUE" : order.level;
  const LoadedModule& module = symbols_.module();
  rung_variable place = variable;
  place.flags &= ~uint32_t{RUNG_FIELD_CONSTANT | RUNG_FIELD_READ_ONLY};  // the level is not written to it
  uint64_t value = 0;
  if (const rung_access why = rung_parse_value(&module.description, &place, level.data(), level.size(), &value))
    return whyRefused(module, variable, why, level);
  scope.trigger = variable;
  scope.level = rung_scope_number(&variable, &value);
  return "";
}

std::string Scope::start(const ScopeOrder& order) {
  std::vector<Variable> variables;
  rung_scope scope{};
  std::string error = findChannels(order, variables);
  if (error.empty()) error = findTrigger(order, scope);
  if (!error.empty()) return error;
  if (order.rows < 2 || order.rows > kMostRows) return "a scope has 2 to " + std::to_string(kMostRows) + " rows";
  if (order.condition != RUNG_SCOPE_NONE && order.rows_before >= order.rows)
    return "no row is left after the trigger; use fewer before it, or more in all";
  std::vector<rung_variable> channels(variables.begin(), variables.end());
  scope.channel_count = static_cast<uint32_t>(channels.size());
  const uint64_t bytes = uint64_t{order.rows} * rung_scope_row_size(channels.data(), scope.channel_count);
  if (bytes > kMostBytes) return limit("bytes", kMostBytes) + "; use fewer rows or variables";
  std::vector<uint8_t> ring(bytes);
  scope.channels = channels.data();
  scope.ring = ring.data();
  scope.ring_size = static_cast<uint32_t>(bytes);
  scope.divider = order.divider;
  scope.condition = static_cast<uint8_t>(order.condition);
  scope.rows_before = order.rows_before;
  rung_scope_start(&scope);
  const std::lock_guard<Exchange> lock(image_);
  variables_.swap(variables);
  channels_.swap(channels);
  ring_.swap(ring);
  scope_ = scope;
  task_ = order.task;
  return "";
}

void Scope::stop() {
  const std::lock_guard<Exchange> lock(image_);
  rung_scope_stop(&scope_);
}

ScopeState Scope::state() const {
  const std::lock_guard<Exchange> lock(image_);
  const bool has_trigger = scope_.is_triggered != 0;
  return {static_cast<rung_scope_state>(scope_.state), scope_.taken - scope_.kept, scope_.taken,
          has_trigger ? scope_.trigger_row : RUNG_NONE};
}

ScopeRows Scope::read(uint32_t from, uint32_t count) const {
  ScopeRows rows;
  rows.first = from;
  if (scope_.row_size == 0) return rows;
  count = std::min(count, std::max(kBytesAtOnce / scope_.row_size, 1u));
  rows.bytes.resize(size_t{count} * scope_.row_size);
  const std::lock_guard<Exchange> lock(image_);
  rows.count = rung_scope_read(&scope_, &rows.first, rows.bytes.data(), count);
  return rows;
}

std::string Scope::value(const uint8_t* row, uint32_t channel) const {
  const rung_module& module = symbols_.module().description;
  std::string text(rung_text_capacity(&module, &channels_[channel]), '\0');
  const void* const value = rung_scope_value(&scope_, row, channel);
  text.resize(rung_format_value(&module, &channels_[channel], value, text.data(), static_cast<uint32_t>(text.size())));
  return text;
}

}  // namespace rung::host

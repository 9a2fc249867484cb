// SPDX-License-Identifier: Apache-2.0
// Values for clients of the monitor: see monitor_values.h.
#include "monitor_values.h"

#include "json.h"
#include "value_format.h"

namespace rung::host {

// ---- lists

bool WatchList::add(const Symbols& symbols, const std::string& path, std::string& error, bool& is_unknown) {
  Variable variable;
  is_unknown = !symbols.find(path, variable, error);
  if (is_unknown) return false;
  const bool is_leaf = variable.type->kind < RUNG_ARRAY || variable.type->kind == RUNG_POINTER;
  const uint64_t count = is_leaf ? 1 : symbols.count(*variable.type, Symbols::Detail::Watched);
  if (count > kMost - variables_.size())
    return error = "more than " + std::to_string(kMost) + " variables, at `" + path + "`", false;
  const size_t first = variables_.size();
  variable.path = path;  // the name that the client knows
  if (is_leaf)
    variables_.push_back(variable);
  else
    symbols.expand(variable, variables_, Symbols::Detail::Watched);
  for (size_t i = first; i < variables_.size(); ++i) bytes_ += 1 + variables_[i].type->size;
  return true;
}

WatchList WatchList::movedTo(const Symbols& symbols) const {
  WatchList list;
  for (const Variable& before : variables_) {
    Variable variable;
    std::string ignored;
    const bool is_there = symbols.find(before.path, variable, ignored) &&
                          (variable.type->kind < RUNG_ARRAY || variable.type->kind == RUNG_POINTER);
    if (!is_there) variable.type = nullptr;
    variable.path = before.path;
    list.bytes_ += 1 + sizeOf(variable);
    list.variables_.push_back(std::move(variable));
  }
  return list;
}

// Before each value a byte that is 0 where there is none.
void WatchList::copy(uint8_t* to) const {
  for (const Variable& variable : variables_) {
    const size_t size = sizeOf(variable);
    const bool is_there = variable.type != nullptr && rung_read_value(variable.context, &variable, to + 1, size);
    *to = is_there ? 1 : 0;
    to += 1 + size;
  }
}

void WatchList::append(const LoadedModule& module, const uint8_t* copied, std::string& json) const {
  std::string text;
  const char* separator = "";
  each(copied, [&](const Variable& variable, const uint8_t* value) {
    json += separator;
    separator = ",";
    appendJsonText(json, variable.path);
    json += ':';
    text.clear();
    if (value == nullptr) {
      json += "null";
    } else {
      formatCopied(module, variable, value, text);
      appendJsonText(json, text);
    }
  });
}

void WatchList::appendLines(const LoadedModule& module, const uint8_t* copied, std::string& text) const {
  each(copied, [&](const Variable& variable, const uint8_t* value) {
    text += variable.path + " = ";
    if (value != nullptr) formatCopied(module, variable, value, text);
    text += '\n';
  });
}

// ---- samples

void Sample::want(std::vector<SharedList> lists, int64_t now_ns) {
  lists_ = std::move(lists);
  copies_.resize(lists_.size());
  for (size_t i = 0; i < lists_.size(); ++i) copies_[i].resize(lists_[i]->bytes());
  wanted_ns_.store(now_ns, std::memory_order_relaxed);
  state_.store(State::Wanted, std::memory_order_release);
}

bool Sample::take(int64_t cycle, int64_t time_ns) {
  State expected = State::Wanted;
  if (!state_.compare_exchange_strong(expected, State::Taking, std::memory_order_acquire)) return false;
  for (size_t i = 0; i < lists_.size(); ++i) lists_[i]->copy(copies_[i].data());
  cycle_ = cycle;
  time_ns_ = time_ns;
  state_.store(State::Taken, std::memory_order_release);
  return true;
}

void Sample::release() {
  lists_.clear();
  state_.store(State::Idle, std::memory_order_release);
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// The trace as CSV: see trace.h.
#include "trace.h"

#include <algorithm>

#include "csv.h"
#include "value_format.h"

namespace rung::host {

std::string millisecondsOf(int64_t ns) {
  std::string text = std::to_string(ns / 1'000'000);
  int64_t fraction = ns % 1'000'000;
  if (fraction == 0) return text;
  std::string digits = std::to_string(1'000'000 + fraction).substr(1);
  while (digits.back() == '0') digits.pop_back();
  return text + '.' + digits;
}

namespace {
constexpr size_t kMostListed = 200;          // values at the end of a run
constexpr uint64_t kMostTraced = 1'000'000;  // columns of a trace
}  // namespace

bool Trace::add(const Variable& variable, Symbols::Detail detail, Use use, std::string& error) {
  const uint64_t parts = symbols_->count(*variable.type, detail);
  if (use == Use::Rows && parts > kMostTraced - total_) {
    error = "more than " + std::to_string(kMostTraced) + " variables, at " + backquoted(variable.path) +
            "; choose some with --watch";
    return false;
  }
  total_ += std::min(parts, UINT64_MAX - total_);
  symbols_->expand(variable, variables_, detail, use == Use::Rows ? SIZE_MAX : kMostListed);
  return true;
}

bool Trace::choose(const std::string& watch, Use use, std::string& error) {
  if (watch.empty()) {
    for (const Variable& root : symbols_->programRoots())
      if (!add(root, Symbols::Detail::Own, use, error)) return false;
    return true;
  }
  for (const std::string& path : splitList(watch)) {
    Variable variable;
    if (!symbols_->find(path, variable, error)) return false;
    variable.path = path;  // the header shows names as the user wrote them
    if (variable.type->kind == RUNG_POINTER) {
      variables_.push_back(variable);
      ++total_;
    } else if (!add(variable, Symbols::Detail::Watched, use, error)) {
      return false;
    }
  }
  return true;
}

bool Trace::chooseProgram(const std::string& name, std::string& error) {
  Variable program;
  if (!symbols_->find(name, program, error)) return false;
  symbols_->expand(program, variables_, Symbols::Detail::Own);
  return true;
}

bool Trace::open(const std::string& path, std::FILE* out, std::string& error) {
  if (path.empty()) return true;
  if (!file_.open(path, out, error)) return false;
  buffer_ = "cycle,time_ms";
  for (const Variable& variable : variables_) {
    buffer_ += ',';
    appendCell(buffer_, variable.path);
  }
  if (forces_ != nullptr) buffer_ += std::string(",") + kForcedColumn;
  buffer_ += '\n';
  return true;
}

void Trace::appendForced() {
  cell_.clear();
  for (const Variable& variable : variables_) {
    if (forces_->isEmpty() || variable.isEmpty() || !forces_->touches(variable)) continue;
    cell_ += (cell_.empty() ? "" : " ") + variable.path;
  }
  buffer_ += ',';
  appendCell(buffer_, cell_);
}

void Trace::row(int64_t cycle, int64_t time_ns) {
  if (!file_.isOpen()) return;
  buffer_ += std::to_string(cycle);
  buffer_ += ',';
  buffer_ += millisecondsOf(time_ns);
  for (const Variable& variable : variables_) {
    buffer_ += ',';
    if (variable.isEmpty()) continue;
    if (variable.type->kind >= RUNG_CHAR && variable.type->kind <= RUNG_USTRING) {
      cell_.clear();
      formatValue(symbols_->module(), variable, cell_);
      appendCell(buffer_, cell_);
    } else {
      formatValue(symbols_->module(), variable, buffer_);  // never needs quotes
    }
  }
  if (forces_ != nullptr) appendForced();
  buffer_ += '\n';
  if (buffer_.size() < size_t{1} << 16) return;
  file_.write(buffer_);
  buffer_.clear();
}

bool Trace::close(std::string& error) {
  if (!file_.isOpen()) return true;
  file_.write(buffer_);
  return file_.close(error);
}

std::string Trace::lastRow() const {
  std::string lines;
  for (const Variable& variable : variables_) {
    if (variable.isEmpty()) continue;
    lines += variable.path;
    lines += " = ";
    formatValue(symbols_->module(), variable, lines);
    lines += '\n';
  }
  if (total_ > variables_.size())
    lines += "and " + std::to_string(total_ - variables_.size()) +
             " more; choose some with --watch, or see all in --trace\n";
  return lines;
}

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// The trace as an SVG: see plot.h.
#include "plot.h"

#include <cmath>
#include <string_view>

#include "value_format.h"

namespace rung::host {
namespace {

constexpr int64_t kMaxColumns = 2000;

PlotLane laneOf(const LoadedModule& module, const Variable& variable) {
  const rung_type& type = *variable.type;
  PlotLane lane;
  lane.name = variable.path;
  lane.is_whole = type.kind != RUNG_REAL && type.kind != RUNG_LREAL;
  if (type.kind == RUNG_BOOL) lane.kind = PlotKind::Level;
  if (type.kind == RUNG_TIME || type.kind == RUNG_LTIME) {
    lane.kind = PlotKind::Duration;
    lane.unit_ns = type.kind == RUNG_TIME ? 1e6 : 1;
  }
  if (type.kind == RUNG_ENUM) {
    lane.kind = PlotKind::Item;
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_enum_item& item = module.enum_items[type.first + i];
      lane.items.push_back({static_cast<double>(item.value), module.strings + item.name});
    }
  }
  return lane;
}

// The name of the program says nothing where all variables are its own.
void shorten(std::vector<PlotLane>& lanes) {
  const size_t length = lanes.front().name.find('.') + 1;
  const std::string program = lanes.front().name.substr(0, length);
  for (const PlotLane& lane : lanes)
    if (length == 0 || lane.name.size() <= length || lane.name.compare(0, length, program) != 0) return;
  for (PlotLane& lane : lanes) lane.name.erase(0, length);
}

}  // namespace

bool Plot::open(const std::string& path, std::FILE* out, const std::vector<Variable>& variables, std::string& error) {
  for (const Variable& variable : variables) {
    double value;
    if (!numberOf(*module_, variable, value)) continue;
    variables_.push_back(variable);
    lanes_.push_back(laneOf(*module_, variable));
  }
  if (lanes_.empty()) {
    error = "--plot: none of the variables is a number or a BOOL";
    return false;
  }
  shorten(lanes_);
  values_.resize(lanes_.size());
  return file_.open(path, out, error);
}

void Plot::row() {
  if (!file_.isOpen()) return;
  for (size_t i = 0; i < variables_.size(); ++i)
    if (variables_[i].isEmpty() || !numberOf(*module_, variables_[i], values_[i]) || !std::isfinite(values_[i]))
      values_[i] = NAN;
  add(values_);
}

void Plot::hold(int64_t rows) {
  if (!file_.isOpen() || rows_ == 0) return;
  for (int64_t i = 0; i < rows; ++i) add(values_);
}

void Plot::add(const std::vector<double>& values) {
  if (rows_ / rows_per_column_ == kMaxColumns) halve();
  const bool starts = rows_ % rows_per_column_ == 0;
  ++rows_;
  for (size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (starts) {
      lanes_[i].columns.push_back({value, value, value, value});
    } else {
      PlotColumn& column = lanes_[i].columns.back();
      column.low = std::fmin(column.low, value);
      column.high = std::fmax(column.high, value);
      column.last = value;
    }
  }
}

// Merges pairs of columns, so each represents twice as many rows.
void Plot::halve() {
  for (PlotLane& lane : lanes_) {
    for (size_t i = 0; i + 1 < lane.columns.size(); i += 2) {
      const PlotColumn &a = lane.columns[i], &b = lane.columns[i + 1];
      lane.columns[i / 2] = {a.first, std::fmin(a.low, b.low), std::fmax(a.high, b.high), b.last};
    }
    lane.columns.resize(kMaxColumns / 2);
  }
  rows_per_column_ *= 2;
}

bool Plot::close(int64_t row_ns, std::string& error) {
  if (!file_.isOpen()) return true;
  const double columns = static_cast<double>(rows_) / static_cast<double>(rows_per_column_);
  file_.write(drawPlot(lanes_, columns, rows_ * row_ns));
  return file_.close(error);
}

}  // namespace rung::host

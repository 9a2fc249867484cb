// SPDX-License-Identifier: Apache-2.0
// Values set from outside: see inputs.h.
#include "inputs.h"

#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "csv.h"
#include "value_format.h"

namespace rung::host {
namespace {

constexpr size_t kMostBytes = size_t{1} << 30;  // of inputs and commands

constexpr int64_t kMaxCycle = 1'000'000'000;  // 115 days of cycles of 10 ms

// An unquoted `a[1,2]` in a header was split at its comma: joins it again while brackets are open.
CsvRow joinBrackets(const CsvRow& header) {
  CsvRow joined;
  bool open = false;
  for (size_t i = 0; i < header.cells.size(); ++i) {
    if (open) {
      joined.cells.back() += ',' + header.cells[i];
    } else {
      joined.cells.push_back(header.cells[i]);
      joined.positions.push_back(header.positions[i]);
    }
    const std::string& cell = joined.cells.back();
    open = std::count(cell.begin(), cell.end(), '[') > std::count(cell.begin(), cell.end(), ']');
  }
  return joined;
}

}  // namespace

bool readFile(const std::string& path, std::string& content, std::string& error) {
  struct stat status;
  if (path != "-" && stat(path.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode))) {
    error = path + ": a device; name a file, or - for standard input";
    return false;
  }
  FILE* const file = path == "-" ? stdin : fopen(path.c_str(), "rb");
  if (file == nullptr) {
    error = path + ": " + strerror(errno);
    return false;
  }
  char buffer[1 << 16];
  content.clear();
  for (size_t n; content.size() <= kMostBytes && (n = fread(buffer, 1, sizeof buffer, file)) > 0;)
    content.append(buffer, n);
  const bool is_too_long = content.size() > kMostBytes, ok = ferror(file) == 0 && !is_too_long;
  if (!ok) error = path + ": " + (is_too_long ? "it has more than 1 GiB" : strerror(errno));
  if (file != stdin) fclose(file);
  return ok;
}

bool Inputs::load(const std::string& path, std::string& error) {
  std::string content;
  std::vector<CsvRow> rows;
  if (!readFile(path, content, error)) return false;
  const std::string location = (path == "-" ? "standard input" : path) + ":";
  if (!readCsv(content, rows, error)) return error = location + error, false;
  const auto fail = [&](const CsvRow& row, size_t cell, const std::string& what) {
    error = location + std::to_string(row.positions[cell].line) + ":" + std::to_string(row.positions[cell].column) +
            ": " + what;
    return false;
  };
  if (rows.empty()) return error = location + "1:1: expected the header `cycle,<path>,...`", false;

  const CsvRow header = joinBrackets(rows[0]);
  const std::vector<std::string>& names = header.cells;
  if (lowerCase(names[0]) != "cycle")
    return fail(header, 0, "the first column must be `cycle`, not `" + names[0] + "`");
  constexpr uint32_t kIgnored = ~0u;
  std::vector<uint32_t> columns = {kIgnored};
  for (size_t i = 1; i < names.size(); ++i) {
    if (names[i] == "time_ms") {  // a trace may serve as input
      columns.push_back(kIgnored);
      continue;
    }
    Variable variable;
    std::string what;
    if (!symbols_->find(names[i], variable, what)) {
      if (names[i] != kForcedColumn || i + 1 != names.size()) return fail(header, i, what);
      columns.push_back(kIgnored);
      continue;
    }
    columns.push_back(static_cast<uint32_t>(variables_.size()));
    variables_.push_back(std::move(variable));
  }

  for (size_t r = 1; r < rows.size(); ++r) {
    CsvRow& row = rows[r];
    int64_t cycle = 0;
    const std::string& first = row.cells[0];
    const std::from_chars_result read = std::from_chars(first.data(), first.data() + first.size(), cycle);
    if (read.ec == std::errc::result_out_of_range || (read.ec == std::errc{} && cycle > kMaxCycle))
      return fail(row, 0, "cycle `" + first + "` is too large; the last one is " + std::to_string(kMaxCycle));
    if (read.ec != std::errc{} || read.ptr != first.data() + first.size() || cycle < 0)
      return fail(row, 0, "`" + first + "` is not a cycle number; write 0, 1, 2, ...");
    if (row.cells.size() > columns.size())
      return fail(row, columns.size(),
                  "the row has " + std::to_string(row.cells.size()) + " cells, but the header has " +
                      std::to_string(columns.size()));
    last_cycle_ = std::max(last_cycle_, cycle);
    for (size_t i = 1; i < row.cells.size(); ++i) {
      if (columns[i] == kIgnored || row.cells[i].empty()) continue;
      const std::string what = checkValue(symbols_->module(), variables_[columns[i]], row.cells[i]);
      if (!what.empty()) return fail(row, i, what);
      settings_.push_back({cycle, columns[i], std::move(row.cells[i])});
    }
  }
  std::stable_sort(settings_.begin(), settings_.end(),
                   [](const Setting& a, const Setting& b) { return a.cycle < b.cycle; });
  return true;
}

void Inputs::apply(int64_t cycle) {
  for (; next_ < settings_.size() && settings_[next_].cycle <= cycle; ++next_) {
    const Variable& variable = variables_[settings_[next_].variable];
    if (!variable.isEmpty()) assignValue(symbols_->module(), variable, settings_[next_].value);
  }
}

void Inputs::goTo(int64_t cycle) {
  next_ = 0;
  while (next_ < settings_.size() && settings_[next_].cycle < cycle) ++next_;
}

std::string applySet(const Symbols& symbols, const std::string& path, const std::string& value) {
  Variable variable;
  std::string error;
  if (!symbols.find(path, variable, error)) return error;
  return assignValue(symbols.module(), variable, value);
}

}  // namespace rung::host

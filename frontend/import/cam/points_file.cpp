// SPDX-License-Identifier: Apache-2.0
// Points in CSV; see points_file.h.
#include "frontend/import/cam/points_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "frontend/import/diagnostics.h"

namespace rung::importer::cams {
namespace {

class PointReader {
 public:
  PointReader(const Sources& sources, FileId file, Diagnostics& diagnostics, std::vector<MeasuredPoint>& points)
      : source_(sources.sourceText(file)), begin_(sources.begin(file)), diagnostics_(diagnostics), points_(points) {}

  void read() {
    bool is_first = true;
    for (size_t begin = 0; begin < source_.size() && !diagnostics_.full();) {
      const size_t end = std::min(source_.find('\n', begin), source_.size());
      split(source_.substr(begin, end - begin));
      begin = end + 1;
      if (cells_.empty()) continue;
      if (!is_first || !isHeader()) readRow();
      is_first = false;
    }
    if (points_.size() < 2 && !has_errors_)
      diagnostics_.report(diag::PointsTooFew, begin_, {std::to_string(points_.size())});
    std::stable_sort(points_.begin(), points_.end(),
                     [](const MeasuredPoint& a, const MeasuredPoint& b) { return a.x < b.x; });
  }

 private:
  // Commas, semicolons, tabs and blanks separate; `#` begins a comment.
  void split(std::string_view line) {
    cells_.clear();
    line = line.substr(0, line.find('#'));
    for (size_t at = 0; at < line.size();) {
      const size_t begin = line.find_first_not_of(" \t\r,;", at);
      if (begin == std::string_view::npos) return;
      at = std::min(line.find_first_of(" \t\r,;", begin), line.size());
      cells_.push_back(line.substr(begin, at - begin));
    }
  }

  bool isHeader() const {
    return std::none_of(cells_.begin(), cells_.end(), [](std::string_view cell) {
      double number = 0;
      return std::from_chars(cell.data(), cell.data() + cell.size(), number).ptr != cell.data();
    });
  }

  Report report(Diag diag, std::string_view word, std::initializer_list<std::string_view> args = {}) {
    has_errors_ = true;
    const Loc loc{begin_.offset + static_cast<uint32_t>(word.data() - source_.data())};
    return diagnostics_.report(diag, loc, args).length(static_cast<uint32_t>(word.size()));
  }

  void readRow() {
    if (cells_.size() < 2 || cells_.size() > 3) {
      report(diag::PointRow, cells_.size() < 2 ? cells_[0] : cells_[3]);
      return;
    }
    MeasuredPoint point;
    double* const numbers[] = {&point.x, &point.y, &point.weight};
    for (size_t i = 0; i < cells_.size(); ++i)
      if (!readNumber(cells_[i], *numbers[i])) return;
    if (point.weight < 0) {
      report(diag::CamValue, cells_[2], {"weight", "a number of 0 or more"});
      return;
    }
    points_.push_back(point);
  }

  bool readNumber(std::string_view cell, double& number) {
    const auto [end, code] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    const bool is_number = end == cell.data() + cell.size();
    if (is_number && code == std::errc() && std::isfinite(number)) return true;
    const bool is_beyond = is_number && code == std::errc::result_out_of_range;
    report(is_beyond ? diag::CamOutOfRange : is_number ? diag::CamNan : diag::CamNotANumber, cell, {cell, "LREAL"});
    return false;
  }

  std::string_view source_;
  Loc begin_;
  Diagnostics& diagnostics_;
  std::vector<MeasuredPoint>& points_;
  std::vector<std::string_view> cells_;
  bool has_errors_ = false;
};

}  // namespace

bool readPoints(const Sources& sources, FileId file, Diagnostics& diagnostics, std::vector<MeasuredPoint>& points) {
  const uint32_t errors = diagnostics.errorCount();
  PointReader(sources, file, diagnostics, points).read();
  return diagnostics.errorCount() == errors;
}

}  // namespace rung::importer::cams

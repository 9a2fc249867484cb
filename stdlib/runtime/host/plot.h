// The trace as a picture (--plot): an SVG with a lane per variable over the time. In: the rows of a run. Out: a file of
// bounded size, however long the run: each column keeps the lowest and highest value of its rows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "output_file.h"
#include "symbols.h"

namespace rung::host {

class Plot {
 public:
  explicit Plot(const rung_module& module) : module_(module) {}
  // Takes the numbers, times, enumerations and BOOLs among the variables. False: `error` has the message.
  bool open(const std::string& path, std::FILE* out, const std::vector<Variable>& variables, std::string& error);
  void row();
  bool close(int64_t row_ns, std::string& error);

 private:
  struct Column {
    double first, low, high, last;  // NaN: nothing to draw
  };
  struct Lane {
    Variable variable;
    std::vector<Column> columns;
    double low = 0, high = 0;
    std::string low_text, high_text;
    bool has_value = false;
  };
  void halve();
  void draw(const Lane& lane, int top, int height, std::string& svg) const;

  const rung_module& module_;
  std::vector<Lane> lanes_;
  int64_t rows_ = 0, rows_per_column_ = 1;
  int left_ = 60;  // of the lanes: room for their names
  OutputFile file_;
};

}  // namespace rung::host

// SPDX-License-Identifier: Apache-2.0
// The trace as a picture (--plot): an SVG with a lane per variable over the time. In: the rows of a run. Out: a file of
// bounded size, however long the run: each column keeps the lowest and highest value of its rows. Used by run.cpp and
// test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "output_file.h"
#include "plot_drawing.h"
#include "symbols.h"

namespace rung::host {

class Plot {
 public:
  explicit Plot(const LoadedModule& module) : module_(&module) {}
  // Takes the numbers, times, enumerations and BOOLs among the variables. False: `error` has the message.
  bool open(const std::string& path, std::FILE* out, const std::vector<Variable>& variables, std::string& error);
  // Another version of the program goes on. The lanes of variables that it does not have end.
  void moveTo(const Symbols& symbols) {
    module_ = &symbols.module();
    symbols.findAgain(variables_);
  }
  void row();
  // The last row lasts this many more.
  void hold(int64_t rows);
  bool close(int64_t row_ns, std::string& error);

 private:
  void add(const std::vector<double>& values);
  void halve();

  const LoadedModule* module_;
  std::vector<Variable> variables_;
  std::vector<PlotLane> lanes_;  // of the same number
  std::vector<double> values_;   // of the last row
  int64_t rows_ = 0, rows_per_column_ = 1;
  OutputFile file_;
};

}  // namespace rung::host

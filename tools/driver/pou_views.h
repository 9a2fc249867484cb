// SPDX-License-Identifier: Apache-2.0
// The bodies of a project as its monitor shows them: networks and charts as pictures whose elements and wires have the
// paths of their values, text with the paths of the variables in each line. In: a checked compilation. Out: rows for
// rung::host::RunOptions, or the C++ of such a table for an executable. Called by run.cpp and build.cpp.
#pragma once

#include <string>
#include <vector>

#include "rung/pou_view.h"

namespace rung::driver {

class Compilation;

class PouViews {
 public:
  // Also draws the ladder of an NCT program, which a compilation has only as statements.
  static PouViews of(Compilation& compilation);

  // They refer to this.
  std::vector<rung_pou_view> rows() const;
  // A source that defines `rung_pou_views()`: an array that ends with an empty row.
  std::string source() const;

 private:
  struct View {
    std::string name, block, language, content;
  };
  std::vector<View> views_;
  friend class PouViewer;
};

}  // namespace rung::driver

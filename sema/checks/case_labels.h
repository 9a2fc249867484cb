// SPDX-License-Identifier: Apache-2.0
// Forbids CASE labels that overlap or run backwards; see case_labels.cpp.
#pragma once

#include "sema/bodies/bodies.h"

namespace rung::sema {

struct CaseLabels {
  struct Label {
    int64_t low, high;
    Loc loc;
  };
  std::vector<Label> list;
  bool ok = false;  // of the current label
};
void addCaseLabel(Context& context, CaseLabels& labels, int64_t low, int64_t high, Loc loc, bool is_signed);
void checkCaseLabels(Context& context, CaseLabels& labels, TypeId selector, bool is_signed);

}  // namespace rung::sema

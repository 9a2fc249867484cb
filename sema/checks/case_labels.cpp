// SPDX-License-Identifier: Apache-2.0
// Forbids a CASE label that an earlier one covers, and a range with its bounds reversed. IEC 61131-3 ed. 3, 7.3.3.3.3:
// only the first branch would ever run.
//   passes  1, 2: …   3..9: …
//   fails   1, 2: …   2: …       9..3: …
// Called at the end of each CASE. Sorts: n labels cost n log n.
#include "sema/checks/case_labels.h"

#include <algorithm>

#include "sema/checks/diagnostics.h"

namespace rung::sema {

namespace {

bool less(int64_t a, int64_t b, bool is_signed) {
  return is_signed ? a < b : static_cast<uint64_t>(a) < static_cast<uint64_t>(b);
}

std::string toString(Context& context, int64_t low, int64_t high, TypeId selector) {
  const auto one = [&](int64_t value) {
    return types::toString(context.types(), context.names(), types::Value{selector, static_cast<uint64_t>(value)});
  };
  return low == high ? one(low) : one(low) + ".." + one(high);
}

}  // namespace

void addCaseLabel(Context& context, CaseLabels& labels, int64_t low, int64_t high, Loc loc, bool is_signed) {
  if (less(high, low, is_signed)) {
    context.report(diag::RangeReversed, loc, {std::to_string(low), std::to_string(high)});
    return;
  }
  labels.list.push_back({low, high, loc});
}

void checkCaseLabels(Context& context, CaseLabels& labels, TypeId selector, bool is_signed) {
  using Label = CaseLabels::Label;
  std::sort(labels.list.begin(), labels.list.end(), [&](const Label& a, const Label& b) {
    if (a.low != b.low) return less(a.low, b.low, is_signed);
    return a.loc < b.loc;
  });
  const Label* widest = nullptr;  // of the labels so far, the one that reaches furthest
  for (const Label& label : labels.list) {
    if (widest != nullptr && !less(widest->high, label.low, is_signed)) {
      const Label& later = widest->loc < label.loc ? label : *widest;
      const Label& first = widest->loc < label.loc ? *widest : label;
      context.report(diag::DuplicateLabel, later.loc, {toString(context, later.low, later.high, selector)})
          .note(first.loc, diag::FirstLabel);
    }
    if (widest == nullptr || less(widest->high, label.high, is_signed)) widest = &label;
  }
}

}  // namespace rung::sema

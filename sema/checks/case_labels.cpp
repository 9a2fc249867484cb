// SPDX-License-Identifier: Apache-2.0
// Forbids a CASE label that an earlier one covers, and a range with its bounds reversed. IEC 61131-3 ed. 3, 7.3.3.3.3:
// only the first branch would ever run.
//   passes  1, 2: …   3..9: …
//   fails   1, 2: …   2: …       9..3: …
// Called at the end of each CASE. Sorts: n labels cost n log n.
#include "sema/bodies/expressions.h"
#include "sema/checks/rules.h"
#include "sema/fixes.h"

#include <algorithm>

namespace rung::sema {

namespace {

struct Label {
  int64_t low, high;
  Loc loc;
};

bool less(int64_t a, int64_t b, bool is_signed) {
  return is_signed ? a < b : static_cast<uint64_t>(a) < static_cast<uint64_t>(b);
}

std::string labelText(Context& context, int64_t low, int64_t high, TypeId selector) {
  const auto one = [&](int64_t value) {
    return types::toString(context.types(), context.names(), types::Value{selector, static_cast<uint64_t>(value)});
  };
  return low == high ? one(low) : one(low) + ".." + one(high);
}

// The value of a label that fits the selector; none after a report.
std::optional<int64_t> valueOfLabel(Context& context, ExprId label) {
  if (context.type(label) == types::kError) return std::nullopt;
  return constantInteger(context, label);
}

// None: a label without a value, or a range that runs backwards, which is reported.
std::optional<Label> labelOf(Context& context, ExprId label, bool is_signed) {
  const Tree& tree = context.tree();
  const Loc loc = tree.begin(label);
  if (tree.kind(label) != ExprKind::Range) {
    const std::optional<int64_t> value = valueOfLabel(context, label);
    return value ? std::optional<Label>({*value, *value, loc}) : std::nullopt;
  }
  const RangeExpr& range = tree.as<RangeExpr>(label);
  const std::optional<int64_t> low = valueOfLabel(context, range.low), high = valueOfLabel(context, range.high);
  if (!low || !high) return std::nullopt;
  if (!less(*high, *low, is_signed)) return Label{*low, *high, loc};
  context.report(diag::RangeReversed, loc, {std::to_string(*low), std::to_string(*high)})
      .fix(exchanged(context, range.low, range.high));
  return std::nullopt;
}

}  // namespace

void checkCaseLabels(Context& context, const CaseStmt& node) {
  const Tree& tree = context.tree();
  const TypeId selector = typeOf(tree, node.selector);
  const types::TypeKind kind = context.types().plainKind(selector);
  if (!types::TypeTable::isInteger(kind) && !types::TypeTable::isBits(kind)) return;
  const bool is_signed = context.types().isSigned(kind);
  std::vector<Label> labels;
  for (const CaseBranch& branch : tree.list(node.branches))
    for (const ExprId written : tree.list(branch.labels))
      if (const std::optional<Label> label = labelOf(context, written, is_signed)) labels.push_back(*label);
  std::sort(labels.begin(), labels.end(), [&](const Label& a, const Label& b) {
    if (a.low != b.low) return less(a.low, b.low, is_signed);
    return a.loc < b.loc;
  });
  const Label* widest = nullptr;  // of the labels so far, the one that reaches furthest
  for (const Label& label : labels) {
    if (widest != nullptr && !less(widest->high, label.low, is_signed)) {
      const Label& later = widest->loc < label.loc ? label : *widest;
      const Label& first = widest->loc < label.loc ? *widest : label;
      context.report(diag::DuplicateLabel, later.loc, {labelText(context, later.low, later.high, selector)})
          .note(first.loc, diag::FirstLabel);
    }
    if (widest == nullptr || less(widest->high, label.high, is_signed)) widest = &label;
  }
}

}  // namespace rung::sema

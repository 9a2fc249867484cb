// SPDX-License-Identifier: Apache-2.0
// Forbids a constant index outside of the array's bounds. IEC 61131-3 ed. 3, 6.4.4.5.
//   passes  readings[5] := 1;   (ARRAY[1..5])
//   fails   readings[9] := 1;
// Called by expressions.cpp for each index of each dimension.
#include "sema/checks/constant_index.h"

#include "sema/checks/diagnostics.h"

namespace rung::sema {

void checkConstantIndex(Context& context, ExprId index, const types::Dimension* dimension, TypeId array) {
  if (dimension == nullptr) return;
  const std::optional<int64_t> value = constantInteger(context, index);
  if (!value || (*value >= dimension->low && *value <= dimension->high)) return;
  context.report(diag::IndexOutOfRange, context.tree().begin(index),
                 {std::to_string(*value), std::to_string(dimension->low), std::to_string(dimension->high),
                  context.types().toString(array)});
}

}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Forbids a constant index outside of the array's bounds. IEC 61131-3 ed. 3, 6.4.4.5.
//   passes  readings[5] := 1;   (ARRAY[1..5])
//   fails   readings[9] := 1;
// Called for each indexed array or string.
#include "sema/bodies/expressions.h"
#include "sema/checks/rules.h"

namespace rung::sema {

namespace {

// Of an array in one dimension, or of the characters of a string; none for ARRAY[*].
std::optional<types::Dimension> boundsOf(const Context& context, const IndexExpr& node, uint32_t dimension) {
  const types::TypeInfo& info = context.types().info(context.types().resolve(context.type(node.base)));
  if (types::TypeTable::isString(info.kind)) {
    const bool from_one = context.profile().characters_from_one;
    const bool writes = meaning(node.h).writes_character;  // not the zero at the end
    return types::Dimension{from_one ? 1 : 0, int64_t{info.length} - (writes && !from_one ? 1 : 0)};
  }
  if (info.dimensions.empty()) return std::nullopt;
  return info.dimensions[dimension];
}

}  // namespace

void checkConstantIndex(Context& context, const IndexExpr& node) {
  const Tree& tree = context.tree();
  for (uint32_t i = 0; i < node.indices.count; ++i) {
    const ExprId index = tree.list(node.indices)[i];
    if (typeOf(tree, index) == types::kError) return;
    const std::optional<types::Dimension> bounds = boundsOf(context, node, i);
    const std::optional<int64_t> value = bounds ? constantInteger(context, index) : std::nullopt;
    if (!value || (*value >= bounds->low && *value <= bounds->high)) continue;
    context.report(diag::IndexOutOfRange, tree.begin(index),
                   {std::to_string(*value), std::to_string(bounds->low), std::to_string(bounds->high),
                    context.types().toString(typeOf(tree, node.base))});
  }
}

}  // namespace rung::sema

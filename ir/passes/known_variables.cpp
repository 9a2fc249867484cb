// SPDX-License-Identifier: Apache-2.0
// See known_variables.h.
#include "ir/passes/known_variables.h"

#include "ir/passes/support.h"
#include "sema/types/arithmetic.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeTable;

KnownVariables::KnownVariables(const Module& module, const Exposure& exposure, const Body& body)
    : module_(module),
      types_(module.types),
      body_(body),
      private_(ir::privateLocals(module, body)),
      self_first_(static_cast<uint32_t>(body.locals.size())) {
  const TypeId self = body.self ? types_.resolve(body.self) : TypeId{};
  const size_t count = self ? types_.info(self).fields.size() : 0;
  references_first_ = self_first_ + static_cast<uint32_t>(count);
  is_exposed_.resize(count);
  for (uint32_t i = 0; i < count; ++i) is_exposed_[i] = exposure.isExposed(self, i);
}

uint32_t KnownVariables::ownField(const Expr& e) const {
  const uint32_t field = e.as<FieldExpr>().field;
  const TypeInfo& self = types_.info(types_.resolve(body_.self));
  if (self.record_kind == types::RecordKind::Union || self.fields[field].by_reference) return kNone;
  return numberOfField(field);
}

uint32_t KnownVariables::referenceAt(const Expr& place) const {
  if (!isOwnField(place) || !isReference(module_, body_, place)) return kNone;
  return references_first_ + place.as<FieldExpr>().field;
}

uint32_t KnownVariables::after(ExprId id) const {
  while (const auto* convert = body_.expr(id).tryAs<ConvertExpr>()) {
    const TypeId from = body_.expr(convert->operand).type, to = body_.expr(id).type;
    const bool keeps_pointer = isPointer(from) && (isPointer(to) || TypeTable::bitWidth(types_.plainKind(to)) == 64);
    if (!keeps_pointer && (!isIntegral(to) || !isIntegral(from) || !types::isLossless(types_, from, to))) return kNone;
    id = convert->operand;
  }
  return at(id);
}

TypeId KnownVariables::typeOf(uint32_t variable) const {
  if (isLocal(variable)) return body_.locals[variable].type;
  return types_.info(types_.resolve(body_.self)).fields[fieldOf(variable)].type;
}

}  // namespace rung::ir

// SPDX-License-Identifier: Apache-2.0
// The numbers of variables: see variables.h.
#include "codegen/variables.h"

namespace rung::codegen {

using ir::ExprId;
using ir::ExprKind;

Variables::Variables(const ir::Module& module, const ir::Body& body)
    : module_(&module), body_(&body), local_count_(static_cast<uint32_t>(body.locals.size())) {
  if (!body.self) return;
  record_ = module.types.resolve(body.self);
  if (body.kind == ir::BodyKind::Block) field_count_ = static_cast<uint32_t>(module.types.info(record_).fields.size());
}

uint32_t Variables::at(ExprId place) const {
  while (const auto* bits = body_->expr(place).tryAs<ir::BitsExpr>()) place = bits->base;
  const ir::Expr& e = body_->expr(place);
  const uint32_t* local = ir::localOf(e);
  if (local != nullptr && !body_->locals[*local].by_reference) return *local;
  const auto* field = e.tryAs<ir::FieldExpr>();
  if (field != nullptr && body_->expr(field->base).kind == ExprKind::Self && field->field < field_count_)
    return local_count_ + field->field;
  return kNoVariable;
}

uint32_t Variables::stringAt(ExprId place) const {
  const ir::Expr& e = body_->expr(place);
  if (module_->types.kind(e.type) != types::TypeKind::String) return kNoVariable;
  const uint32_t* index = ir::localOf(e);
  return index != nullptr ? *index : at(place);
}

std::string Variables::lines(const std::vector<std::string>& rows) const {
  std::string out;
  for (uint32_t i = 0; i < rows.size(); ++i) {
    if (rows[i].empty()) continue;
    out += module_->names.string(isField(i) ? field(i).name : local(i).name);
    out += rows[i];
    out += '\n';
  }
  return out;
}

}  // namespace rung::codegen

// SPDX-License-Identifier: Apache-2.0
// The variables that range analysis knows, by number: the private locals, the fields of self and, again by field, the
// pointers in fields that are references. In: a body. Out: the number of the variable that an expression names. Used by
// range_facts.h and counters.h.
#pragma once

#include <vector>

#include "ir/exposure.h"
#include "ir/passes/interval.h"
#include "ir/walk.h"

namespace rung::ir {

class KnownVariables {
 public:
  static constexpr uint32_t kNone = ~0u;

  KnownVariables(const Module& module, const Exposure& exposure, const Body& body);

  uint32_t count() const { return references_first_ + (references_first_ - self_first_); }
  const std::vector<bool>& privateLocals() const { return private_; }

  // A variable that has an interval, or is a pointer; else kNone.
  uint32_t at(ExprId id) const {
    const Expr& e = body_.expr(id);
    if (!isTracked(e.type)) return kNone;
    if (const uint32_t* local = localOf(e)) return private_[*local] ? *local : kNone;
    return isOwnField(e) ? ownField(e) : kNone;
  }
  // The variable whose value an expression is, also through conversions that keep every value.
  uint32_t after(ExprId id) const;
  // The pointer in a field of self that is a reference.
  uint32_t referenceAt(const Expr& place) const;

  bool isField(uint32_t variable) const { return variable >= self_first_ && variable < references_first_; }
  bool isLocal(uint32_t variable) const { return variable < self_first_; }
  uint32_t fieldOf(uint32_t variable) const { return variable - self_first_; }
  uint32_t numberOfField(uint32_t field) const { return self_first_ + field; }
  // A field that something reaches by its address.
  bool isExposed(uint32_t variable) const { return isField(variable) && is_exposed_[fieldOf(variable)] != 0; }
  // The type of a local or field; none of a reference.
  TypeId typeOf(uint32_t variable) const;

  bool isPointer(TypeId type) const {
    const types::TypeKind kind = types_.kind(type);
    return kind == types::TypeKind::Pointer || kind == types::TypeKind::Reference;
  }
  bool isIntegral(TypeId type) const {
    if (type.index >= static_cast<uint32_t>(types::TypeKind::Count_)) return hasInterval(types_, type);
    const auto kind = static_cast<types::TypeKind>(type.index);
    return kind == types::TypeKind::Bool || types::TypeTable::isInteger(kind) || types::TypeTable::isBits(kind);
  }
  bool isTracked(TypeId type) const { return isIntegral(type) || isPointer(type); }

 private:
  bool isOwnField(const Expr& e) const {
    const auto* field = e.tryAs<FieldExpr>();
    return field != nullptr && body_.expr(field->base).kind == ExprKind::Self;
  }
  uint32_t ownField(const Expr& e) const;

  const Module& module_;
  const types::TypeTable& types_;
  const Body& body_;
  std::vector<bool> private_;
  std::vector<uint8_t> is_exposed_;  // by field of self
  uint32_t self_first_, references_first_;
};

}  // namespace rung::ir

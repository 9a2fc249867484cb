// SPDX-License-Identifier: Apache-2.0
// The answers to the schedulers of IL, diagrams and NCT (frontend/syntax/signatures.h), taken from the declarations.
// In: names and paths of a body as parsed. Out: kinds and pins; the path itself is not marked or changed.
// Created by statements.cpp for each body that is not in ST, and by variables.cpp for hidden variables of networks.
#pragma once

#include <deque>
#include <unordered_map>
#include <vector>

#include "frontend/syntax/signatures.h"
#include "sema/context.h"

namespace rung::sema {

class ProjectSignatures final : public Signatures {
 public:
  explicit ProjectSignatures(Context& context) : context_(context) {}
  Signature of(NameId name) override;
  Signature of(ExprId path) override;
  bool fits(ExprId instance, ExprId block) override;
  std::string typeUnlessBool(ExprId path) override;
  std::span<const DeclId> madeSections(const PouDecl& pou) override;

 private:
  // The meaning of a part of a path: a named entity, or a value of a type.
  struct Resolved {
    Entity entity;
    TypeId type;
  };
  Resolved resolve(ExprId path);
  Resolved resolveStep(ExprId path);
  Resolved ownObject(ExprKind kind);  // of THIS or SUPER
  Resolved resolve(Entity entity);
  Resolved memberOf(const Resolved& base, NameId member);
  Signature signatureOf(const Resolved& resolved);
  Signature signatureOf(PouId pou, SignatureKind kind);
  TypeExprId plainResult(const Pou& pou) const;
  TypeId plainType(TypeId type) const;

  Context& context_;
  std::unordered_map<uint32_t, std::vector<PinSignature>> pins_;  // by PouId
};

}  // namespace rung::sema

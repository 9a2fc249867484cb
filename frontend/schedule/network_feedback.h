// SPDX-License-Identifier: Apache-2.0
// Values that are read before they are computed, in feedback loops or by elements that are earlier in the execution
// order, and results of functions whose EN may be FALSE. A variable keeps each from the last cycle. Variables are laid
// out before bodies are checked, so its type is found from names and from the declarations of the POU alone. Private to
// frontend/schedule, called by network_declare.cpp.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "frontend/schedule/network_graph.h"

namespace rung::diagram {

// The sources that need a variable. The scheduler reports those without a known type.
std::vector<uint32_t> readBeforeExecution(const Tree& tree, const Names& names, const Graph& graph);

// The result types of boxes, as far as declarations determine them; none: unknown. network_box_types.cpp.
class BoxTypes {
 public:
  BoxTypes(Tree& tree, Names& names, Signatures& signatures, const PouDecl& pou, const Graph& graph)
      : tree_(tree), names_(names), signatures_(signatures), pou_(pou), graph_(graph) {}

  TypeExprId of(uint32_t source) { return ofSource(source, 0); }

 private:
  TypeExprId ofBox(uint32_t element, uint32_t depth);
  TypeExprId ofCall(uint32_t element, uint32_t depth);
  TypeExprId ofOperands(uint32_t element, bool selects, uint32_t depth);
  TypeExprId ofReaders(uint32_t element);
  TypeExprId ofSource(uint32_t source, uint32_t depth);
  TypeExprId ofExpr(ExprId expr, uint32_t depth);
  TypeExprId ofLiteral(const LiteralExpr& literal);
  TypeExprId ofStep(ExprId expr, uint32_t depth);
  TypeExprId ofBinary(const BinaryExpr& binary, uint32_t depth);
  TypeExprId ofName(NameId name);
  TypeExprId ofMember(TypeExprId type, NameId member, uint32_t depth);
  TypeExprId ofVariable(const PouDecl& pou, NameId name, uint32_t depth);
  TypeExprId ofVariable(Slice<DeclId> vars, NameId name);
  TypeExprId resolved(TypeExprId type);
  TypeExprId named(std::string_view type, Loc loc);
  DeclId declared(NameId name);
  void index(Slice<DeclId> decls);
  const PouDecl* ownerOf(const PouDecl& member);

  Tree& tree_;
  Names& names_;
  Signatures& signatures_;
  const PouDecl& pou_;
  const Graph& graph_;
  std::vector<TypeExprId> known_;  // by element
  std::vector<bool> tried_;
  std::vector<std::pair<uint32_t, uint32_t>> reads_;   // element and its reader; sorted, filled on first use
  std::vector<std::pair<uint32_t, DeclId>> declared_;  // types, POUs and globals by their keys; also on first use
  std::vector<const PouDecl*> pous_;                   // those with members
};

}  // namespace rung::diagram

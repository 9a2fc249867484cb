// Functions and operators whose value is read before their turn: by wires that lead in a circle, or by elements whose
// turn comes earlier. They keep the value of the last cycle in a variable, whose type must be known when variables are
// declared, long before bodies are checked; what the names and the declarations of the POU tell is enough for that.
// Private to frontend/diagram, called by declare.cpp.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "frontend/diagram/graph.h"

namespace rung::diagram {

// The elements that need a variable. What has no type is left to the scheduler, which reports it.
std::vector<uint32_t> readBeforeExecution(const Tree& tree, const Graph& graph);

// The types of what boxes give, as far as declarations tell; none: not known. box_types.cpp.
class BoxTypes {
 public:
  BoxTypes(Tree& tree, Names& names, Signatures& signatures, const PouDecl& pou, const Graph& graph)
      : tree_(tree), names_(names), signatures_(signatures), pou_(pou), graph_(graph) {}

  TypeExprId of(uint32_t box) { return ofBox(box, 0); }

 private:
  TypeExprId ofBox(uint32_t element, uint32_t depth);
  TypeExprId ofCall(uint32_t element, uint32_t depth);
  TypeExprId ofOperands(uint32_t element, bool selects, uint32_t depth);
  TypeExprId ofReaders(uint32_t element);
  TypeExprId ofSource(uint32_t source, uint32_t depth);
  TypeExprId ofExpr(ExprId expr, uint32_t depth);
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
  std::vector<TypeExprId> known_;  // of each element
  std::vector<bool> tried_;
  std::vector<std::pair<uint32_t, uint32_t>> reads_;   // element, who reads it; sorted, filled when it is needed
  std::vector<std::pair<uint32_t, DeclId>> declared_;  // types, POUs and globals by their keys; the same
  std::vector<const PouDecl*> pous_;                   // that have members
};

}  // namespace rung::diagram

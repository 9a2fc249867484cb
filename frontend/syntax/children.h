// SPDX-License-Identifier: Apache-2.0
// Walks over the nodes below a node, made from the columns of nodes.def that list the fields with other nodes.
// forEachField: the ids and lists of a node itself, as clone.cpp copies them. forEachChild: every id in them, in source
// order, also those in branches, arguments and items. forEachOperand: the expressions among the children.
#pragma once

#include "frontend/syntax/diagram.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/tree.h"

namespace rung {

// The case of one kind: its fields are those of a node `n`.
#define RUNG_VISIT(kind, Node, ...)                        \
  case kind: {                                             \
    [[maybe_unused]] auto& n = tree.template as<Node>(id); \
    return visitFields(visit __VA_OPT__(, ) __VA_ARGS__);  \
  }
template <class Visit, class... Fields>
void visitFields(Visit& visit, Fields&... fields) {
  (visit(fields), ...);
}
template <class T, class Visit>
void forEachField(T& tree, ExprId id, Visit&& visit) {
  switch (tree.kind(id)) {
#define RUNG_EXPR(kind, word, shape, ...) RUNG_VISIT(ExprKind::kind, kind##Expr, __VA_ARGS__)
#include "frontend/syntax/nodes.def"
  }
}
template <class T, class Visit>
void forEachField(T& tree, StmtId id, Visit&& visit) {
  switch (tree.kind(id)) {
#define RUNG_STMT(kind, word, ...) RUNG_VISIT(StmtKind::kind, kind##Stmt, __VA_ARGS__)
#include "frontend/syntax/nodes.def"
  }
}
template <class T, class Visit>
void forEachField(T& tree, TypeExprId id, Visit&& visit) {
  switch (tree.kind(id)) {
#define RUNG_TYPE_EXPR(kind, word, ...) RUNG_VISIT(TypeExprKind::kind, kind##TypeExpr, __VA_ARGS__)
#include "frontend/syntax/nodes.def"
  }
}
template <class T, class Visit>
void forEachField(T& tree, DeclId id, Visit&& visit) {
  switch (tree.kind(id)) {
#define RUNG_DECL(kind, word, ...) RUNG_VISIT(DeclKind::kind, kind##Decl, __VA_ARGS__)
#include "frontend/syntax/nodes.def"
  }
}
#undef RUNG_VISIT

template <class E, class T>
concept Is = std::is_same_v<std::remove_const_t<E>, T>;
template <class Id>
concept NodeId = Is<Id, ExprId> || Is<Id, StmtId> || Is<Id, TypeExprId> || Is<Id, DeclId>;

// Visits the ids in the elements of lists. `visit` takes an id of each kind, by reference.
template <class T, class Visit>
class ChildWalk {
 public:
  ChildWalk(T& tree, Visit& visit) : tree_(tree), visit_(visit) {}

  // One field of a node.
  template <class Field>
  void operator()(Field& field) const {
    in(field);
  }

 private:
  template <NodeId Id>
  void in(Id& id) const {
    if (id) visit_(id);
  }
  template <class Element>
  void in(const Slice<Element>& list) const {
    for (auto& element : tree_.list(list)) of(element);
  }
  void in(const Diagram& diagram) const { in(diagram.elements); }
  template <class... Fields>
  void all(Fields&... fields) const {
    (in(fields), ...);
  }

  template <NodeId Id>
  void of(Id& id) const {
    in(id);
  }
  template <class E>
  requires Is<E, Argument> || Is<E, FieldInit> || Is<E, EnumItem>
  void of(E& item) const { in(item.value); }
  template <Is<IfBranch> E>
  void of(E& branch) const {
    all(branch.condition, branch.body);
  }
  template <Is<CaseBranch> E>
  void of(E& branch) const {
    all(branch.labels, branch.body);
  }
  template <Is<ArrayBound> E>
  void of(E& bound) const {
    all(bound.low, bound.high);
  }
  template <Is<IlInstruction> E>
  void of(E& instruction) const {
    all(instruction.callee, instruction.operands);
    for (auto& nested : tree_.list(instruction.nested)) in(nested.list);
  }
  template <Is<SfcStep> E>
  void of(E& step) const {
    all(step.min.value, step.max.value);
    for (auto& association : tree_.list(step.actions)) in(association.time.value);
  }
  template <Is<SfcTransition> E>
  void of(E& transition) const {
    if (!transition.body) in(transition.condition.value);  // otherwise in an action among the members
  }
  template <Is<DiagramElement> E>
  void of(E& element) const {
    all(element.path, element.operand, element.body);
  }

  T& tree_;
  Visit& visit_;
};

template <class T, class Id, class Visit>
void forEachChild(T& tree, Id id, Visit&& visit) {
  forEachField(tree, id, ChildWalk<T, std::remove_reference_t<Visit>>(tree, visit));
}

template <class T, class Visit>
void forEachOperand(T& tree, ExprId id, Visit&& visit) {
  forEachChild(tree, id, [&](auto& child) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, ExprId>) visit(child);
  });
}

// The sections of a POU, as written and as schedulers made them.
template <class Visit>
void forEachSection(const Tree& tree, const PouDecl& pou, std::span<const DeclId> made, Visit&& visit) {
  for (const DeclId section : tree.list(pou.sections)) visit(tree.as<SectionDecl>(section));
  for (const DeclId section : made) visit(tree.as<SectionDecl>(section));
}

// Tells whether `test` is true of an operand.
template <class Test>
bool anyOperand(const Tree& tree, ExprId id, Test&& test) {
  bool found = false;
  forEachOperand(tree, id, [&](ExprId operand) { found = found || test(operand); });
  return found;
}

}  // namespace rung

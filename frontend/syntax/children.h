// Walks over the nodes below a node, made from the columns of nodes.def that list the fields with other nodes.
// forEachField: the ids and lists of a node itself, as clone.cpp copies them. forEachChild: every id in them, in source
// order, also those in branches, arguments and items. forEachOperand: the expressions among the children.
// An inserted node (Tree::insert) is a child like any other.
#pragma once

#include "frontend/syntax/diagram.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/tree.h"

namespace rung {

template <class T, class Visit>
void forEachField(T& tree, ExprId id, Visit&& visit) {
  const auto fields = [&](auto&... field) { (visit(field), ...); };
  switch (tree.kind(id)) {
#define RUNG_EXPR(kind, word, shape, ...)                        \
  case ExprKind::kind: {                                         \
    [[maybe_unused]] auto& n = tree.template as<kind##Expr>(id); \
    return fields(__VA_ARGS__);                                  \
  }
#include "frontend/syntax/nodes.def"
  }
}
template <class T, class Visit>
void forEachField(T& tree, StmtId id, Visit&& visit) {
  const auto fields = [&](auto&... field) { (visit(field), ...); };
  switch (tree.kind(id)) {
#define RUNG_STMT(kind, word, ...)                               \
  case StmtKind::kind: {                                         \
    [[maybe_unused]] auto& n = tree.template as<kind##Stmt>(id); \
    return fields(__VA_ARGS__);                                  \
  }
#include "frontend/syntax/nodes.def"
  }
}
template <class T, class Visit>
void forEachField(T& tree, TypeExprId id, Visit&& visit) {
  const auto fields = [&](auto&... field) { (visit(field), ...); };
  switch (tree.kind(id)) {
#define RUNG_TYPE_EXPR(kind, word, ...)                              \
  case TypeExprKind::kind: {                                         \
    [[maybe_unused]] auto& n = tree.template as<kind##TypeExpr>(id); \
    return fields(__VA_ARGS__);                                      \
  }
#include "frontend/syntax/nodes.def"
  }
}
template <class T, class Visit>
void forEachField(T& tree, DeclId id, Visit&& visit) {
  const auto fields = [&](auto&... field) { (visit(field), ...); };
  switch (tree.kind(id)) {
#define RUNG_DECL(kind, word, ...)                               \
  case DeclKind::kind: {                                         \
    [[maybe_unused]] auto& n = tree.template as<kind##Decl>(id); \
    return fields(__VA_ARGS__);                                  \
  }
#include "frontend/syntax/nodes.def"
  }
}

template <class Id>
concept NodeId = std::is_same_v<std::remove_const_t<Id>, ExprId> || std::is_same_v<std::remove_const_t<Id>, StmtId> ||
    std::is_same_v<std::remove_const_t<Id>, TypeExprId> || std::is_same_v<std::remove_const_t<Id>, DeclId>;

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

  template <NodeId Id>
  void of(Id& id) const {
    in(id);
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, Argument> || std::is_same_v<std::remove_const_t<E>, FieldInit> ||
      std::is_same_v<std::remove_const_t<E>, EnumItem>
  void of(E& item) const { in(item.value); }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, IfBranch>
  void of(E& branch) const {
    in(branch.condition);
    in(branch.body);
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, CaseBranch>
  void of(E& branch) const {
    in(branch.labels);
    in(branch.body);
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, ArrayBound>
  void of(E& bound) const {
    in(bound.low);
    in(bound.high);
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, IlInstruction>
  void of(E& instruction) const {
    in(instruction.callee);
    in(instruction.operands);
    for (auto& nested : tree_.list(instruction.nested)) in(nested.list);
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, SfcStep>
  void of(E& step) const {
    in(step.min.value);
    in(step.max.value);
    for (auto& association : tree_.list(step.actions)) in(association.time.value);
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, SfcTransition>
  void of(E& transition) const {
    if (!transition.body) in(transition.condition.value);  // otherwise in an action among the members
  }
  template <class E>
  requires std::is_same_v<std::remove_const_t<E>, DiagramElement>
  void of(E& element) const {
    in(element.path);
    in(element.operand);
    in(element.body);
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

// The sections of a POU, as written and hidden.
template <class Visit>
void forEachSection(const Tree& tree, const PouDecl& pou, Visit&& visit) {
  for (const DeclId section : tree.list(pou.sections)) visit(tree.as<SectionDecl>(section));
  for (const DeclId section : tree.list(pou.hidden)) visit(tree.as<SectionDecl>(section));
}

// Whether `test` is true of an operand.
template <class Test>
bool anyOperand(const Tree& tree, ExprId id, Test&& test) {
  bool found = false;
  forEachOperand(tree, id, [&](ExprId operand) { found = found || test(operand); });
  return found;
}

}  // namespace rung

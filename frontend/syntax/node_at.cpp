// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/node_at.h"

#include <algorithm>

#include "frontend/syntax/children.h"

namespace rung {
namespace {

bool isInHalves(const Tree& tree, DeclId id) {
  return tree.kind(id) == DeclKind::Property && tree.as<PropertyDecl>(id).in_halves;
}

class Finder {
 public:
  Finder(const Tree& tree, Loc at) : tree_(tree), at_(at) {}

  template <class Id>
  bool find(Id id);
  template <class Id>
  bool search(Slice<Id> slice);

  std::vector<NodeRef> path;

 private:
  bool has(Range range) const { return range.begin <= at_ && at_ < range.end; }
  bool hasNode(DeclId id) const {
    if (has(extentOf(tree_, id))) return true;
    if (!isInHalves(tree_, id)) return false;
    const PropertyDecl& property = tree_.as<PropertyDecl>(id);
    return (property.get && has(tree_.range(property.get))) || (property.set && has(tree_.range(property.set)));
  }
  template <class Id>
  bool hasNode(Id id) const {
    return has(tree_.range(id));
  }

  // One field of a node.
  template <NodeId Id>
  bool in(const Id& id) {
    return id && find(id);
  }
  template <NodeId Id>
  bool in(const Slice<Id>& list) {
    return search(list);
  }
  bool in(const Slice<IfBranch>& branches) {
    return any(branches, [&](const IfBranch& branch) { return in(branch.condition) || search(branch.body); });
  }
  bool in(const Slice<CaseBranch>& branches) {
    return any(branches, [&](const CaseBranch& branch) { return search(branch.labels) || search(branch.body); });
  }
  template <class Field>
  bool in(const Field& field) {
    bool found = false;
    const auto visit = [&](auto& child) { found = found || in(child); };
    ChildWalk<const Tree, decltype(visit)>(tree_, visit)(field);
    return found;
  }
  template <class Branch, class Test>
  bool any(Slice<Branch> branches, Test test) {
    const std::span<const Branch> list = tree_.list(branches);
    return std::any_of(list.begin(), list.end(), test);
  }

  const Tree& tree_;
  Loc at_;
};

template <class Id>
bool Finder::find(Id id) {
  if (!hasNode(id)) return false;
  path.push_back(id);
  bool found = false;
  forEachField(tree_, id, [&](const auto& field) { found = found || in(field); });
  return true;
}

// The ends of the nodes of a list ascend. Those of the statements that a chain `a := b := c;` becomes are equal, and
// they begin in reverse order.
template <class Id>
bool Finder::search(Slice<Id> slice) {
  const std::span<const Id> list = tree_.list(slice);
  const auto end = [&](Id id) { return extentOf(tree_, id).end; };
  auto candidate = std::partition_point(list.begin(), list.end(), [&](Id id) { return end(id) <= at_; });
  if (candidate != list.end())
    for (const Loc last = end(*candidate); candidate != list.end() && end(*candidate) == last; ++candidate)
      if (find(*candidate)) return true;
  if constexpr (std::is_same_v<Id, DeclId>)  // the second half of a property
    return std::any_of(list.begin(), list.end(), [&](DeclId id) { return isInHalves(tree_, id) && find(id); });
  return false;
}

}  // namespace

Range extentOf(const Tree& tree, NodeRef node) {
  Range range;
  withId(node, [&](auto id) { range = tree.range(id); });
  if (node.category != NodeRef::Category::Decl || tree.kind(DeclId{node.word}) != DeclKind::Pou) return range;
  const std::span<const DeclId> members = tree.list(tree.as<PouDecl>(DeclId{node.word}).members);
  if (!members.empty() && !isInHalves(tree, members.back()))
    range.end = std::max(range.end, tree.range(members.back()).end);
  return range;
}

std::vector<NodeRef> nodeAt(const Tree& tree, const FileUnit& unit, Loc at) {
  Finder finder(tree, at);
  finder.search(unit.decls);
  return std::move(finder.path);
}

}  // namespace rung

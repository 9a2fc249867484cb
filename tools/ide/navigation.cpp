// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/navigation.h"

#include <algorithm>

#include "frontend/syntax/children.h"
#include "frontend/syntax/node_at.h"
#include "tools/ide/outer_names.h"

namespace rung::ide {
namespace {

class Navigator {
 public:
  Navigator(const View& view, NavigationKind kind)
      : view_(view), scope_(view.meanings().scope()), project_(scope_.project()), kind_(kind) {}

  std::vector<Destination> from(Entity entity) {
    switch (kind_) {
      case NavigationKind::Declaration: add(entity); break;
      case NavigationKind::Definition: add(definitionOf(entity)); break;
      case NavigationKind::Type: add(typeOf(entity)); break;
      case NavigationKind::Implementation: implementations(entity); break;
    }
    return std::move(destinations_);
  }

 private:
  void add(Entity entity) {
    const std::optional<Destination> found = entity ? destinationOf(view_, entity) : std::nullopt;
    if (found) destinations_.push_back(*found);
  }

  Entity definitionOf(Entity entity) const {
    if (entity.entityKind() != EntityKind::Var) return entity;
    const VarId external = project_.vars[entity.index].external;
    return external ? Entity::of(EntityKind::Var, external.index) : entity;
  }

  // Of an array, a pointer or a reference the type that it leads to.
  Entity typeOf(Entity entity) const {
    TypeId type = scope_.typeOf(entity);
    for (int steps = 0; steps < 10; ++steps) {
      const types::TypeInfo& info = project_.types.info(type);
      const bool leads_on = info.kind == types::TypeKind::Array || info.kind == types::TypeKind::Pointer ||
                            info.kind == types::TypeKind::Reference;
      if (!leads_on) break;
      type = info.base;
    }
    return type ? Entity::of(EntityKind::Type, type.index) : Entity{};
  }

  // The blocks that implement an interface or extend a block, and their methods in place of one.
  void implementations(Entity entity) {
    const bool is_type = entity.entityKind() == EntityKind::Type;
    const PouId pou = is_type                                  ? scope_.blockOf({entity.index})
                      : entity.entityKind() == EntityKind::Pou ? PouId{entity.index}
                                                               : PouId{};
    if (!pou) return add(definitionOf(entity));
    const PouId owner = project_.pou(pou).owner;
    for (uint32_t i = 1; i < project_.pous.size(); ++i) {
      const PouId candidate{i};
      if (project_.pou(candidate).instance.of || !isDerived(candidate, owner ? owner : pou)) continue;
      if (!owner) {
        add(Entity::of(EntityKind::Pou, i));
        continue;
      }
      for (const PouId member : project_.pou(candidate).members)
        if (project_.names.same(project_.pou(member).name, project_.pou(pou).name))
          add(Entity::of(EntityKind::Pou, member.index));
    }
    if (destinations_.empty()) add(entity);
  }

  // From something else, in one or more steps.
  bool isDerived(PouId pou, PouId from, int depth = 0) const {
    if (depth > 50) return false;
    const sema::Pou& of = project_.pou(pou);
    const auto leads = [&](PouId to) { return to == from || isDerived(to, from, depth + 1); };
    return (of.base && leads(of.base)) || std::any_of(of.object.interfaces.begin(), of.object.interfaces.end(), leads);
  }

  const View& view_;
  const Scope& scope_;
  const sema::Project& project_;
  NavigationKind kind_;
  std::vector<Destination> destinations_;
};

// The label of a JMP in the same body.
std::optional<Navigation> labelAt(const View& view, Loc at) {
  const Tree& tree = view.tree();
  const FileUnit* const unit = view.unitWith(at);
  if (unit == nullptr) return std::nullopt;
  const std::vector<NodeRef> nodes = nodeAt(tree, *unit, at);
  if (nodes.empty() || nodes.back().category != NodeRef::Category::Stmt) return std::nullopt;
  const StmtId jump{nodes.back().word};
  if (tree.kind(jump) != StmtKind::Jump) return std::nullopt;
  const NameId label = view.names().key(tree.as<JumpStmt>(jump).label.name);
  Navigation result{view.nameInFile(tree.as<JumpStmt>(jump).label.loc), {}};
  const auto search = [&](auto& self, StmtId id) -> void {
    if (tree.kind(id) == StmtKind::Label && view.names().key(tree.as<LabelStmt>(id).label.name) == label)
      result.destinations.push_back({view.nameInFile(tree.as<LabelStmt>(id).label.loc), view.inFile(tree.range(id))});
    forEachChild(tree, id, [&](const auto& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, StmtId>) self(self, child);
    });
  };
  for (const NodeRef node : nodes)
    if (node.category == NodeRef::Category::Decl && tree.kind(DeclId{node.word}) == DeclKind::Pou)
      for (const StmtId stmt : tree.list(tree.as<PouDecl>(DeclId{node.word}).body)) search(search, stmt);
  return result;
}

// Of a namespace each block that has it.
std::optional<Navigation> outerDeclarations(const View& view, FileId file, uint32_t byte) {
  const std::optional<OuterName> name = outerNameAt(view, file, byte);
  if (!name || name->kind == OuterKind::List) return std::nullopt;
  Navigation result{name->at, {}};
  for (const Reference& reference : name->references)
    if (reference.is_declaration) result.destinations.push_back({reference.at, reference.at});
  if (result.destinations.empty()) return std::nullopt;
  return result;
}

}  // namespace

std::optional<NamePlace> nameAt(const View& view, FileId file, uint32_t byte) {
  const Loc at = view.parsedAt(file, byte);
  return at && view.snapshot().project() != nullptr ? view.meanings().at(at) : std::nullopt;
}

std::optional<Destination> destinationOf(const View& view, Entity entity) {
  const Scope& scope = view.meanings().scope();
  const Loc loc = scope.locOf(entity);
  Destination destination{view.nameInFile(loc), {}};
  if (!destination.name || view.pathOf(destination.name.file).empty()) return std::nullopt;
  destination.range = destination.name;
  if (entity.entityKind() == EntityKind::Pou) {
    const DeclId decl = scope.project().pous[entity.index].decl;
    const FileRange whole = decl ? view.inFile(view.tree().range(decl)) : FileRange{};
    if (whole.file == destination.name.file && whole.begin <= destination.name.begin &&
        destination.name.end <= whole.end)
      destination.range = whole;
  }
  return destination;
}

std::optional<Navigation> navigate(const View& view, FileId file, uint32_t byte, NavigationKind kind) {
  if (std::optional<Navigation> found = outerDeclarations(view, file, byte)) return found;
  const std::optional<NamePlace> place = nameAt(view, file, byte);
  if (!place) {
    const Loc at = view.parsedAt(file, byte);
    return at ? labelAt(view, at) : std::nullopt;
  }
  Navigation result{view.nameInFile(place->loc), Navigator(view, kind).from(place->entity)};
  if (result.destinations.empty()) return std::nullopt;
  return result;
}

}  // namespace rung::ide

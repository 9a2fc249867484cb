// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/hierarchy.h"

#include <algorithm>
#include <map>

#include "tools/ide/family.h"
#include "tools/ide/keywords.h"

namespace rung::ide {
namespace {

class Calls {
 public:
  explicit Calls(const View& view) : view_(view), scope_(view.meanings().scope()), project_(scope_.project()) {}

  std::optional<HierarchyItem> itemOf(Entity entity) const {
    const std::optional<Destination> at = destinationOf(view_, entity);
    if (!at) return std::nullopt;
    HierarchyItem item{entity, std::string(view_.names().string(scope_.nameOf(entity))), {}, SymbolKind::Property, *at};
    PouId owner;
    if (entity.entityKind() == EntityKind::Pou) {
      item.kind = symbolKindOf(project_.pous[entity.index].kind);
      owner = project_.pous[entity.index].owner;
    } else {
      owner = project_.properties[entity.index].owner;
    }
    if (owner) item.container = view_.names().string(project_.pou(owner).name);
    return item;
  }

  // What runs when this is called: of an instance its block.
  Entity calledBy(Entity entity) const {
    if (entity.entityKind() == EntityKind::Property) return entity;
    if (entity.entityKind() == EntityKind::Program) return declared(project_.instances[entity.index].program);
    if (entity.entityKind() == EntityKind::Pou) return declared({entity.index});
    TypeId type = scope_.recordOf(scope_.typeOf(entity));
    while (project_.types.info(type).kind == types::TypeKind::Array)
      type = scope_.recordOf(project_.types.info(type).base);
    const PouId block = scope_.blockOf(type);
    return block ? declared(block) : Entity{};
  }

  // Calls `visit` with the caller, what it calls, and where.
  void forEach(FunctionRef<void(Entity caller, Entity callee, const FileRange& at)> visit) const {
    for (uint32_t i = 1; i < project_.pous.size(); ++i) {
      const sema::Pou& pou = project_.pous[i];
      if (pou.library || pou.body.mentions.empty()) continue;
      const Entity caller = declared({i});
      for (const sema::Mention& mention : pou.body.mentions) {
        const bool is_property = mention.entity.entityKind() == EntityKind::Property;
        if (mention.access != sema::Access::Call && !is_property) continue;
        const FileRange at = view_.nameInFile(mention.loc);
        const Entity callee = at && isWritten(at, mention.entity) ? calledBy(mention.entity) : Entity{};
        if (callee) visit(caller, callee, at);
      }
    }
  }

 private:
  Entity declared(PouId pou) const {
    const PouId of = project_.pou(pou).instance.of;
    return scope_.declaredEntity(of ? of : pou);
  }

  // Not a conversion or an operator that calls a function of the library.
  bool isWritten(const FileRange& at, Entity entity) const {
    const std::string_view text = view_.textOf(at.file).substr(at.begin, at.end - at.begin);
    return sameIdentifier(text, view_.names().string(scope_.nameOf(entity)));
  }

  const View& view_;
  const Scope& scope_;
  const sema::Project& project_;
};

// One entry for each POU, with its calls in the order of the text.
class Callers {
 public:
  explicit Callers(const Calls& calls) : calls_(calls) {}

  void add(Entity entity, const FileRange& at) {
    const uint32_t kind = entity.kind;
    const auto [known, is_new] = index_.try_emplace(std::pair(kind, uint32_t{entity.index}), all_.size());
    if (is_new) {
      std::optional<HierarchyItem> item = calls_.itemOf(entity);
      if (!item) {
        index_.erase(known);
        return;
      }
      all_.push_back({std::move(*item), {}});
    }
    std::vector<FileRange>& places = all_[known->second].calls;
    if (std::find(places.begin(), places.end(), at) == places.end()) places.push_back(at);
  }

  std::vector<Caller> take() { return std::move(all_); }

 private:
  const Calls& calls_;
  std::map<std::pair<uint32_t, uint32_t>, size_t> index_;
  std::vector<Caller> all_;
};

std::vector<HierarchyItem> itemsOf(const View& view, const std::vector<PouId>& pous) {
  std::vector<HierarchyItem> items;
  for (const PouId pou : pous)
    if (auto item = Calls(view).itemOf(Entity::of(EntityKind::Pou, pou.index))) items.push_back(std::move(*item));
  return items;
}

// STRUCT EXTENDS.
class Structures {
 public:
  explicit Structures(const View& view)
      : view_(view), tree_(view.tree()), scope_(view.meanings().scope()), project_(scope_.project()) {}

  bool has(Entity entity) const { return static_cast<bool>(structureOf(entity)); }

  std::optional<HierarchyItem> itemOf(Entity entity) const {
    const Entity type = Entity::of(EntityKind::Type, structureOf(entity).index);
    const std::optional<Destination> at = destinationOf(view_, type);
    if (!at) return std::nullopt;
    return HierarchyItem{type, std::string(view_.names().string(scope_.nameOf(type))), {}, SymbolKind::Structure, *at};
  }

  // What a structure extends, or those that extend it.
  std::vector<HierarchyItem> related(Entity structure, bool is_base) const {
    std::vector<HierarchyItem> items;
    for (const FileUnit& unit : tree_.files)
      visit(tree_.list(unit.decls), [&](Entity derived, Entity base) {
        if ((is_base ? derived : base).index != structure.index) return;
        if (auto item = itemOf(is_base ? base : derived)) items.push_back(std::move(*item));
      });
    return items;
  }

 private:
  TypeId structureOf(Entity entity) const {
    const EntityKind kind = entity.entityKind();
    if (kind != EntityKind::Type && kind != EntityKind::Var && kind != EntityKind::Property) return {};
    TypeId type = scope_.recordOf(scope_.typeOf(entity));
    while (project_.types.info(type).kind == types::TypeKind::Array)
      type = scope_.recordOf(project_.types.info(type).base);
    const types::TypeInfo& info = project_.types.info(type);
    const bool is_structure = info.kind == types::TypeKind::Record && info.record_kind == types::RecordKind::Struct;
    return is_structure && !scope_.blockOf(type) ? type : TypeId{};
  }

  void visit(std::span<const DeclId> decls, FunctionRef<void(Entity derived, Entity base)> use) const {
    for (const DeclId id : decls) {
      if (tree_.kind(id) == DeclKind::Namespace) visit(tree_.list(tree_.as<NamespaceDecl>(id).decls), use);
      if (tree_.kind(id) != DeclKind::Type) continue;
      const TypeDecl& decl = tree_.as<TypeDecl>(id);
      if (!decl.type || tree_.kind(decl.type) != TypeExprKind::Struct) continue;
      const TypeExprId base = tree_.as<StructTypeExpr>(decl.type).base;
      if (!base || tree_.kind(base) != TypeExprKind::Named) continue;
      const std::span<const Ident> path = tree_.list(tree_.as<NamedTypeExpr>(base).path);
      if (!path.empty()) use(typeNamed(decl.name), typeNamed(path.back().name));
    }
  }
  Entity typeNamed(NameId name) const { return scope_.typeNamed(view_.names().key(name)); }

  const View& view_;
  const Tree& tree_;
  const Scope& scope_;
  const sema::Project& project_;
};

bool isDerivable(const sema::Pou& pou) {
  return pou.kind == PouKind::FunctionBlock || pou.kind == PouKind::Class || pou.kind == PouKind::Interface;
}

std::vector<PouId> basesOf(const sema::Pou& pou) {
  std::vector<PouId> bases = pou.object.interfaces;
  if (pou.base) bases.insert(bases.begin(), pou.base);
  return bases;
}

}  // namespace

std::optional<HierarchyItem> callableAt(const View& view, FileId file, uint32_t byte) {
  const std::optional<NamePlace> place = nameAt(view, file, byte);
  if (!place) return std::nullopt;
  const Calls calls(view);
  const Entity called = calls.calledBy(place->entity);
  return called ? calls.itemOf(called) : std::nullopt;
}

std::vector<Caller> incomingCalls(const View& view, Entity callee) {
  const Calls calls(view);
  const Family family(view.meanings().scope(), callee);
  Callers callers(calls);
  calls.forEach([&](Entity caller, Entity called, const FileRange& at) {
    if (family.has(called)) callers.add(caller, at);
  });
  return callers.take();
}

std::vector<Caller> outgoingCalls(const View& view, Entity caller) {
  const Calls calls(view);
  Callers callees(calls);
  calls.forEach([&](Entity from, Entity called, const FileRange& at) {
    if (from.kind == caller.kind && from.index == caller.index) callees.add(called, at);
  });
  return callees.take();
}

std::optional<HierarchyItem> derivableAt(const View& view, FileId file, uint32_t byte) {
  const std::optional<NamePlace> place = nameAt(view, file, byte);
  if (place && Structures(view).has(place->entity)) return Structures(view).itemOf(place->entity);
  std::optional<HierarchyItem> item = callableAt(view, file, byte);
  const bool is_type = item && item->entity.entityKind() == EntityKind::Pou &&
                       isDerivable(view.snapshot().project()->pous[item->entity.index]);
  return is_type ? item : std::nullopt;
}

std::vector<HierarchyItem> supertypesOf(const View& view, Entity type) {
  if (type.entityKind() == EntityKind::Type) return Structures(view).related(type, true);
  return itemsOf(view, basesOf(view.snapshot().project()->pous[type.index]));
}

std::vector<HierarchyItem> subtypesOf(const View& view, Entity type) {
  if (type.entityKind() == EntityKind::Type) return Structures(view).related(type, false);
  const auto& pous = view.snapshot().project()->pous;
  std::vector<PouId> derived;
  for (uint32_t i = 1; i < pous.size(); ++i) {
    const std::vector<PouId> bases = basesOf(pous[i]);
    if (!pous[i].instance.of && std::find(bases.begin(), bases.end(), PouId{type.index}) != bases.end())
      derived.push_back({i});
  }
  return itemsOf(view, derived);
}

}  // namespace rung::ide

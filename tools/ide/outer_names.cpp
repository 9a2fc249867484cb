// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/outer_names.h"

#include <algorithm>
#include <array>
#include <map>

#include "frontend/source/names.h"
#include "frontend/source/scanner.h"
#include "frontend/source/text.h"
#include "frontend/syntax/children.h"
#include "tools/ide/free_names.h"
#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

using Path = std::vector<std::string>;

struct OuterPlace {
  OuterKind kind;
  Path path;
  Loc loc;
  bool is_declaration = false;
};

// What is around a declaration.
struct Surroundings {
  Path space;
  Path part;  // the configuration, then the resource
  std::string shown_space, shown_part;
};

Path with(Path path, std::string last) {
  path.push_back(std::move(last));
  return path;
}

class OuterNames {
 public:
  explicit OuterNames(const View& view)
      : view_(view), tree_(view.tree()), project_(*view.snapshot().project()), meanings_(view.meanings()) {
    for (const FileUnit& unit : tree_.files) declared(unit.decls, {});
  }

  // Where one of the names is used or declared that are written so.
  std::vector<OuterPlace> placesOf(std::string_view name) {
    wanted_ = foldedIdentifier(name);
    if (!isDeclared(wanted_)) return {};
    for (const FileUnit& unit : tree_.files)
      if (isOfProject(unit) && hasName(view_.sources().sourceText(unit.file), name)) walk(unit.decls, {});
    return std::move(places_);
  }
  bool has(OuterKind kind, const Path& path) const {
    if (kind != OuterKind::List) return declared(kind).count(path) != 0;
    return std::any_of(project_.global_lists.begin() + 1, project_.global_lists.end(),
                       [&](const sema::GlobalList& list) { return folded(list.name) == path.back(); });
  }
  // Whether a configuration or resource has the name.
  bool hasPart(const std::string& name) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part.first.back() == name; });
  }
  // As it is declared, with the names around it; empty: nowhere.
  std::string shown(OuterKind kind, const Path& path) const {
    if (kind == OuterKind::List) return {};
    const auto found = declared(kind).find(path);
    return found == declared(kind).end() ? std::string() : found->second;
  }

 private:
  using Declared = std::map<Path, std::string>;

  const Declared& declared(OuterKind kind) const {
    return kind == OuterKind::Namespace ? spaces_ : kind == OuterKind::Task ? tasks_ : parts_;
  }
  std::string spelled(const std::string& around, NameId name) const {
    return (around.empty() ? around : around + ".") + std::string(view_.names().string(name));
  }
  bool isDeclared(const std::string& name) const {
    for (const Declared* names : {&spaces_, &parts_, &tasks_})
      for (const auto& [path, shown] : *names)
        if (path.back() == name) return true;
    return has(OuterKind::List, {name});
  }
  bool isOfProject(const FileUnit& unit) const {
    const Loc begin = view_.sources().originalLocation(view_.sources().begin(unit.file));
    return !view_.pathOf(view_.sources().fileOf(begin)).empty();
  }

  std::string folded(NameId name) const { return foldedIdentifier(view_.names().string(name)); }

  void add(OuterKind kind, Path path, Loc loc, bool is_declaration = false) {
    if (loc && path.back() == wanted_) places_.push_back({kind, std::move(path), loc, is_declaration});
  }

  // ---- what there is

  void declared(Slice<DeclId> decls, const Surroundings& around) {
    for (const DeclId id : tree_.list(decls)) {
      const DeclKind kind = tree_.kind(id);
      if (kind == DeclKind::Namespace) {
        Surroundings inner = around;
        for (const Ident& name : tree_.list(tree_.as<NamespaceDecl>(id).path)) {
          inner.space.push_back(folded(name.name));
          inner.shown_space = spelled(inner.shown_space, name.name);
          spaces_.emplace(inner.space, inner.shown_space);
        }
        declared(tree_.as<NamespaceDecl>(id).decls, inner);
      } else if (kind == DeclKind::Configuration || kind == DeclKind::Resource) {
        const Surroundings inner{around.space, partOf(id, around), {}, spelled(around.shown_part, nameOf(id))};
        parts_.emplace(inner.part, inner.shown_part);
        declared(membersOf(id), inner);
      } else if (kind == DeclKind::Task) {
        const NameId name = tree_.as<TaskDecl>(id).name;
        tasks_.emplace(with(around.part, folded(name)), spelled(around.shown_part, name));
      }
    }
  }

  NameId nameOf(DeclId id) const {
    return tree_.kind(id) == DeclKind::Configuration ? tree_.as<ConfigurationDecl>(id).name
                                                     : tree_.as<ResourceDecl>(id).name;
  }
  Path partOf(DeclId id, const Surroundings& around) const { return with(around.part, folded(nameOf(id))); }

  Slice<DeclId> membersOf(DeclId id) const {
    return tree_.kind(id) == DeclKind::Configuration ? tree_.as<ConfigurationDecl>(id).members
                                                     : tree_.as<ResourceDecl>(id).members;
  }

  // ---- where it is named

  void walk(Slice<DeclId> decls, const Surroundings& around) {
    for (const DeclId id : tree_.list(decls)) walk(id, around);
  }

  void walk(DeclId id, const Surroundings& around) {
    switch (tree_.kind(id)) {
      case DeclKind::Namespace: return space(tree_.as<NamespaceDecl>(id), around);
      case DeclKind::Using: return opened(tree_.as<UsingDecl>(id), around);
      case DeclKind::Configuration:
      case DeclKind::Resource: {
        const Surroundings inner{around.space, partOf(id, around), {}, {}};
        const bool is_configuration = tree_.kind(id) == DeclKind::Configuration;
        add(is_configuration ? OuterKind::Configuration : OuterKind::Resource, inner.part, tree_.loc(id), true);
        return walk(membersOf(id), inner);
      }
      case DeclKind::Task:
        add(OuterKind::Task, with(around.part, folded(tree_.as<TaskDecl>(id).name)), tree_.loc(id), true);
        return children(id, around);
      case DeclKind::ProgramInstance: return instance(id, around);
      case DeclKind::Section:
        if (tree_.as<SectionDecl>(id).section == SectionKind::Config)
          for (const DeclId var : tree_.list(tree_.as<SectionDecl>(id).vars))
            if (tree_.kind(var) == DeclKind::Var) instancePath(tree_.list(tree_.as<VarDecl>(var).names), around);
        return children(id, around);
      case DeclKind::Type:
      case DeclKind::Pou:
      case DeclKind::Property:
      case DeclKind::Var: return children(id, around);
    }
  }

  template <class Id>
  void children(Id id, const Surroundings& around) {
    forEachChild(tree_, id, [&](const auto& child) { walk(child, around); });
  }

  void space(const NamespaceDecl& decl, Surroundings around) {
    for (const Ident& name : tree_.list(decl.path)) {
      around.space.push_back(folded(name.name));
      add(OuterKind::Namespace, around.space, name.loc, true);
    }
    walk(decl.decls, around);
  }

  void opened(const UsingDecl& decl, const Surroundings& around) { qualified(tree_.list(decl.path), around, 0); }

  // PROGRAM one WITH task : Space.Type(block WITH task).
  void instance(DeclId id, const Surroundings& around) {
    const ProgramInstanceDecl& decl = tree_.as<ProgramInstanceDecl>(id);
    if (decl.task.name) task(decl.task, around);
    qualified(tree_.list(decl.type), around, 1);
    const std::span<const Ident> blocks = tree_.list(decl.block_tasks);
    for (size_t i = 1; i < blocks.size(); i += 2) task(blocks[i], around);
    children(id, around);
  }

  // Of the resource, or of its configuration.
  void task(const Ident& name, const Surroundings& around) {
    for (Path part = around.part;; part.pop_back()) {
      const Path path = with(part, folded(name.name));
      if (tasks_.count(path) != 0) return add(OuterKind::Task, path, name.loc);
      if (part.empty()) return;
    }
  }

  // The namespaces at the front of a path, without the `last` ones. True: there is one.
  bool qualified(std::span<const Ident> path, const Surroundings& around, size_t last) {
    if (path.size() <= last) return false;
    Path found;
    for (Path space = around.space;; space.pop_back()) {
      if (const Path inner = with(space, folded(path[0].name)); spaces_.count(inner) != 0) found = inner;
      if (!found.empty() || space.empty()) break;
    }
    for (size_t i = 0; !found.empty(); found.push_back(folded(path[i].name))) {
      if (spaces_.count(found) == 0) return i > 0;
      add(OuterKind::Namespace, found, path[i].loc);
      if (++i + last >= path.size()) return true;
    }
    return false;
  }

  // [configuration.] [resource.] instance.variable, or [list.] variable.
  void instancePath(std::span<const Ident> path, const Surroundings& around) {
    Path part;
    for (size_t i = 0; i < path.size() && i < 2; ++i) {
      const std::string name = folded(path[i].name);
      Path found = with(part, name);
      if (parts_.count(found) == 0 && !around.part.empty()) found = {around.part[0], name};
      if (parts_.count(found) == 0) {
        const Entity known = entityAt(path[i].loc);
        return known.entityKind() == EntityKind::GlobalList ? list(known, path[i]) : void();
      }
      add(found.size() == 1 ? OuterKind::Configuration : OuterKind::Resource, found, path[i].loc);
      part = found;
    }
  }

  Entity entityAt(Loc loc) const {
    const std::optional<NamePlace> place = meanings_.at(view_.sources().current(loc));
    return place && place->loc == view_.sources().current(loc) ? place->entity : Entity{};
  }

  // The list of a namespace, of a configuration or a resource has the name of that.
  void list(Entity entity, const Ident& name) {
    const sema::GlobalList& list = project_.global_lists[entity.index];
    if (list.resource) return add(OuterKind::Resource, {folded(list.configuration), folded(list.resource)}, name.loc);
    if (list.configuration) return add(OuterKind::Configuration, {folded(list.configuration)}, name.loc);
    add(OuterKind::List, {folded(list.name)}, name.loc);
  }

  void walk(StmtId id, const Surroundings& around) { children(id, around); }
  void walk(TypeExprId id, const Surroundings& around) {
    if (tree_.kind(id) == TypeExprKind::Named) qualified(tree_.list(tree_.as<NamedTypeExpr>(id).path), around, 1);
    children(id, around);
  }

  void walk(ExprId id, const Surroundings& around) {
    if (tree_.kind(id) == ExprKind::Member && memberPath(id, around)) return;
    children(id, around);
  }

  // True: a path of names alone, all of which were looked at.
  bool memberPath(ExprId id, const Surroundings& around) {
    std::vector<Ident> path;
    for (; tree_.kind(id) == ExprKind::Member; id = tree_.base(id)) {
      const MemberExpr& node = tree_.as<MemberExpr>(id);
      path.insert(path.begin(), Ident{node.member, node.h.loc});
    }
    if (tree_.kind(id) != ExprKind::Name) return false;
    path.insert(path.begin(), Ident{tree_.as<NameExpr>(id).name, tree_.loc(id)});
    if (!around.part.empty()) {
      const size_t before = places_.size();
      instancePath(path, around);
      if (places_.size() != before) return true;
    }
    const Entity first = entityAt(path[0].loc);
    const EntityKind kind = first.entityKind();
    const bool is_value = kind == EntityKind::Var || kind == EntityKind::Program || kind == EntityKind::Property;
    if (is_value || qualified(path, around, 1)) return true;
    if (kind == EntityKind::GlobalList) list(first, path[0]);
    return true;
  }

  const View& view_;
  const Tree& tree_;
  const sema::Project& project_;
  const Meanings& meanings_;
  Declared spaces_, parts_, tasks_;
  std::string wanted_;
  std::vector<OuterPlace> places_;
};

// The value of an attribute of the XML element that begins at or around a byte.
FileRange attributeAt(const View& view, FileId file, uint32_t byte, std::string_view element, std::string_view name) {
  const std::string_view text = view.textOf(file);
  const std::string tag = "<" + std::string(element), assigned = " " + std::string(name) + "=\"";
  const size_t begin = text.rfind(tag, byte);
  const size_t end = begin == std::string_view::npos ? begin : text.find('>', begin);
  if (end == std::string_view::npos) return {};
  const size_t at = text.substr(0, end).find(assigned, begin);
  if (at == std::string_view::npos) return {};
  const size_t value = at + assigned.size();
  return {file, static_cast<uint32_t>(value), static_cast<uint32_t>(text.find('"', value))};
}

bool isText(const View& view, const FileRange& at, std::string_view name) {
  return at && sameIdentifier(view.textOf(at.file).substr(at.begin, at.end - at.begin), name);
}

}  // namespace

std::string_view wordOf(OuterKind kind) {
  constexpr std::array<std::string_view, 5> kWords = {"namespace", "configuration", "resource", "task", "list"};
  return kWords[static_cast<size_t>(kind)];
}

std::optional<OuterName> outerNameAt(const View& view, FileId file, uint32_t byte) {
  if (view.snapshot().project() == nullptr) return std::nullopt;
  const std::string_view text = view.textOf(file);
  uint32_t begin = std::min(byte, static_cast<uint32_t>(text.size())), end = begin;
  while (begin > 0 && isNameCharacter(text[begin - 1])) --begin;
  while (end < text.size() && isNameCharacter(text[end])) ++end;
  if (begin == end) return std::nullopt;
  OuterNames names(view);
  const std::vector<OuterPlace> places = names.placesOf(text.substr(begin, end - begin));
  const auto wanted = std::find_if(places.begin(), places.end(), [&](const OuterPlace& place) {
    const FileRange range = view.bytesInFile(place.loc, static_cast<uint32_t>(place.path.back().size()));
    return range.file == file && range.begin <= byte && byte <= range.end && isText(view, range, place.path.back());
  });
  if (wanted == places.end()) return std::nullopt;
  OuterName result{wanted->kind, {}, {}, names.shown(wanted->kind, wanted->path), wanted->path, {}, true};
  const auto size = static_cast<uint32_t>(wanted->path.back().size());
  result.at = view.bytesInFile(wanted->loc, size);
  result.name = view.textOf(file).substr(result.at.begin, size);
  if (result.full.empty()) result.full = result.name;
  for (const OuterPlace& place : places) {
    if (place.kind != wanted->kind || place.path != wanted->path) continue;
    const FileRange range = view.bytesInFile(place.loc, size);
    if (isText(view, range, result.name))
      result.references.push_back({range, ReferenceKind::Name, place.is_declaration});
    else
      result.is_complete = false;
  }
  const auto before = [](const Reference& a, const Reference& b) {
    return std::pair(a.at.file.index, a.at.begin) < std::pair(b.at.file.index, b.at.begin);
  };
  std::sort(result.references.begin(), result.references.end(), before);
  const auto is_same = [](const Reference& a, const Reference& b) { return a.at == b.at; };
  result.references.erase(std::unique(result.references.begin(), result.references.end(), is_same),
                          result.references.end());
  return result;
}

bool isOuterNameTaken(const View& view, const OuterName& name, std::string_view new_name) {
  Path path = name.path;
  path.back() = foldedIdentifier(new_name);
  if (path == name.path) return false;
  const OuterNames names(view);
  if (name.kind != OuterKind::Configuration && name.kind != OuterKind::Resource) return names.has(name.kind, path);
  // `Cpu.one` names a configuration, a resource or an instance.
  const auto& instances = view.snapshot().project()->instances;
  return names.hasPart(path.back()) || std::any_of(instances.begin(), instances.end(), [&](const auto& instance) {
           return sameIdentifier(view.names().string(instance.name), new_name);
         });
}

ListDeclaration declarationOfList(const View& view, const OuterName& list) {
  const sema::Project& project = *view.snapshot().project();
  for (size_t i = 1; i < project.global_lists.size(); ++i) {
    const sema::GlobalList& known = project.global_lists[i];
    if (!sameIdentifier(view.names().string(known.name), list.name)) continue;
    const FileRange section = view.bytesInFile(known.loc, 1);
    if (!section || view.pathOf(section.file).empty()) continue;
    for (const auto& [element, attribute] : {std::pair("GVL", "Name"), std::pair("globalVars", "name")})
      if (const FileRange at = attributeAt(view, section.file, section.begin + 1, element, attribute);
          isText(view, at, list.name))
        return {section.file, at, section};
    if (sameIdentifier(listNameOf(view.pathOf(section.file)), list.name)) return {section.file, {}, section};
  }
  return {};
}

}  // namespace rung::ide

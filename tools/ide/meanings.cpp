// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/meanings.h"

#include <algorithm>
#include <unordered_set>

#include "frontend/syntax/children.h"
#include "frontend/syntax/node_at.h"
#include "tools/ide/keywords.h"

namespace rung::ide {
namespace {

bool holds(Range range, Loc at) { return range.begin <= at && at < range.end; }

// Collects the names of one parsed text.
class Collector {
 public:
  Collector(const View& view, const Scope& scope, const Meanings& meanings, const FileUnit& unit)
      : view_(view), tree_(view.tree()), scope_(scope), project_(scope.project()), meanings_(meanings), unit_(unit) {}

  // What was found first holds: what the check resolved, then what is written.
  std::vector<NamePlace> collect() {
    addMentions();
    for (const NamePlace& place : places_) resolved_.insert(place.loc.offset);
    for (const DeclId decl : tree_.list(unit_.decls)) declaration(decl, {});
    places_.insert(places_.end(), aliases_.begin(), aliases_.end());
    std::stable_sort(places_.begin(), places_.end(),
                     [](const NamePlace& a, const NamePlace& b) { return a.loc < b.loc; });
    const auto is_same = [](const NamePlace& a, const NamePlace& b) { return a.loc == b.loc; };
    places_.erase(std::unique(places_.begin(), places_.end(), is_same), places_.end());
    return std::move(places_);
  }

 private:
  void add(Loc loc, Entity entity, bool is_declaration = false) {
    const EntityKind kind = entity.entityKind();
    if (loc && kind != EntityKind::None && kind != EntityKind::Error)
      places_.push_back({view_.sources().current(loc), entity, is_declaration});
  }
  NameId keyOf(NameId name) const { return view_.names().key(name); }

  // ---- what the check knows

  void addMentions() {
    const Loc begin = view_.sources().begin(unit_.file);
    const Range file{begin, {begin.offset + static_cast<uint32_t>(view_.sources().sourceText(unit_.file).size()) + 1}};
    for (uint32_t i = 1; i < project_.pous.size(); ++i) {
      const sema::Pou& pou = project_.pous[i];
      if (!pou.decl || pou.instance.of || !holds(file, view_.sources().current(tree_.loc(pou.decl)))) continue;
      if (tree_.kind(pou.decl) == DeclKind::Pou) {
        chart(tree_.as<PouDecl>(pou.decl), {i});
        networks(tree_.as<PouDecl>(pou.decl), {i});
      }
      for (const sema::Mention& mention : pou.body.mentions) addMention(mention);
    }
    for (const sema::Mention& mention : project_.mentions)
      if (holds(file, view_.sources().current(mention.loc))) addMention(mention);
  }

  // Code that was made from a name has its location too, but names something else. A block or function of a library may
  // have several names.
  void addMention(const sema::Mention& mention) {
    Entity entity = mention.entity;
    if (entity.entityKind() == EntityKind::Pou) entity = scope_.declaredEntity(originOf({entity.index}));
    std::string_view written = view_.sources().tokenAt(mention.loc);
    written = written.substr(0, written.find('#'));
    std::string_view name = view_.names().string(scope_.nameOf(entity));
    name = name.substr(name.rfind('.') + 1);
    if (sameIdentifier(written, name))
      add(mention.loc, entity);
    else if (isOfLibrary(entity) && kindOfWord(written) == WordKind::None)
      aliases_.push_back({view_.sources().current(mention.loc), entity});
  }

  bool isOfLibrary(Entity entity) const {
    if (entity.entityKind() == EntityKind::Pou) return project_.pous[entity.index].library;
    if (entity.entityKind() != EntityKind::Var) return false;
    const PouId pou = project_.vars[entity.index].pou;
    return pou && project_.pou(pou).library;
  }

  PouId originOf(PouId pou) const {
    const PouId of = project_.pou(pou).instance.of;
    return of ? of : pou;
  }

  void pins(Slice<Argument> arguments, PouId pou) {
    const std::span<const Argument> list = tree_.list(arguments);
    const auto hasName = [](const Argument& argument) { return static_cast<bool>(argument.pin.name); };
    if (std::none_of(list.begin(), list.end(), hasName)) return;
    const std::vector<VarId> pins = scope_.pinsOf(pou);
    for (const Argument& argument : list) {
      if (!argument.pin.name) continue;
      const auto is_named = [&](NameId name) { return keyOf(name) == keyOf(argument.pin.name); };
      for (const VarId pin : pins) {
        const sema::Var& var = project_.var(pin);
        const std::vector<NameId>& aliases = var.pragmas.aliases;
        if (is_named(var.name) || std::any_of(aliases.begin(), aliases.end(), is_named))
          add(argument.pin.loc, Entity::of(EntityKind::Var, pin.index));
      }
    }
  }

  // ---- what is written

  void declaration(DeclId id, PouId pou) {
    const DeclHeader& header = tree_.decl(id);
    if (header.kind == DeclKind::Pou)
      if (const PouId own = scope_.pouOf(id)) {
        pou = own;
        // A condition of a chart is an action without a name.
        const std::string_view name = view_.names().string(tree_.as<PouDecl>(id).name);
        const bool has_name = sameIdentifier(view_.sources().tokenAt(header.loc), name);
        if (has_name && project_.pou(own).object.accessor == sema::AccessorKind::None)
          add(header.loc, Entity::of(EntityKind::Pou, own.index), true);
      }
    if (header.kind == DeclKind::Var)
      for (const Ident& name : tree_.list(tree_.as<VarDecl>(id).names))
        add(name.loc, scope_.declaredAt(name.loc), true);
    if (header.kind == DeclKind::Type) add(header.loc, scope_.typeNamed(keyOf(tree_.as<TypeDecl>(id).name)), true);
    if (header.kind == DeclKind::Property || header.kind == DeclKind::ProgramInstance)
      add(header.loc, scope_.declaredAt(header.loc), true);
    if (header.kind == DeclKind::ProgramInstance)
      if (const auto type = tree_.list(tree_.as<ProgramInstanceDecl>(id).type); !type.empty())
        add(type.back().loc, scope_.typeNamed(keyOf(type.back().name)));
    forEachChild(tree_, id, [&](const auto& child) { written(child, pou); });
  }

  // Steps, and the actions and steps that a chart names.
  void chart(const PouDecl& decl, PouId pou) {
    const auto named = [&](const Ident& ident) { add(ident.loc, scope_.lookUp(pou, keyOf(ident.name))); };
    for (const SfcStep& step : tree_.list(decl.steps)) {
      add(step.name.loc, scope_.lookUp(pou, keyOf(step.name.name)), true);
      for (const SfcAssociation& association : tree_.list(step.actions)) {
        add(association.action.loc, action(pou, keyOf(association.action.name)));
        for (const Ident& indicator : tree_.list(association.indicators)) named(indicator);
      }
    }
    for (const SfcTransition& transition : tree_.list(decl.transitions))
      for (const Slice<Ident> steps : {transition.from, transition.to})
        for (const Ident& step : tree_.list(steps)) named(step);
  }

  // Boxes, their pins, and the pins that wires name. A function gives its result at a pin of its name.
  void networks(const PouDecl& decl, PouId pou) {
    const std::span<const DiagramElement> elements = tree_.list(decl.diagram.elements);
    for (const DiagramElement& element : elements) {
      if (element.path) add(tree_.loc(element.path), boxOf(element, pou));
      for (const DiagramPin& pin : tree_.list(element.pins)) {
        boxPin(pou, element, pin.name);
        for (const DiagramWire& wire : tree_.list(pin.wires))
          if (wire.from < elements.size()) boxPin(pou, elements[wire.from], wire.pin);
      }
    }
  }

  // The type of a box with an instance, which may have a variable's name.
  Entity boxOf(const DiagramElement& element, PouId pou) const {
    const bool is_type = element.operand && tree_.kind(element.path) == ExprKind::Name;
    const Entity type = is_type ? scope_.typeNamed(keyOf(tree_.as<NameExpr>(element.path).name)) : Entity{};
    return type ? type : meanings_.valueOf(pou, element.path).entity;
  }

  void boxPin(PouId pou, const DiagramElement& element, const Ident& pin) {
    if (!pin.name || !element.path) return;
    const PouId callee = calledBy(meanings_.valueOf(pou, element.operand ? element.operand : element.path).entity);
    if (!callee) return;
    if (project_.pou(callee).result && keyOf(pin.name) == keyOf(project_.pou(callee).name))
      add(pin.loc, Entity::of(EntityKind::Pou, callee.index));
    for (const VarId var : scope_.pinsOf(callee))
      if (keyOf(project_.var(var).name) == keyOf(pin.name)) add(pin.loc, Entity::of(EntityKind::Var, var.index));
  }

  // A chart has a hidden variable of the same name for each of its actions.
  Entity action(PouId pou, NameId key) const {
    for (const PouId member : project_.pou(pou).members)
      if (keyOf(project_.pou(member).name) == key) return Entity::of(EntityKind::Pou, member.index);
    return scope_.lookUp(pou, key);
  }

  void written(DeclId id, PouId pou) { declaration(id, pou); }
  void written(StmtId id, PouId pou) {
    forEachChild(tree_, id, [&](const auto& child) { written(child, pou); });
  }
  void written(TypeExprId id, PouId pou) {
    if (tree_.kind(id) == TypeExprKind::Named) {
      const std::span<const Ident> path = tree_.list(tree_.as<NamedTypeExpr>(id).path);
      if (!path.empty()) add(path.back().loc, scope_.typeNamed(keyOf(path.back().name)));
    }
    if (tree_.kind(id) == TypeExprKind::Enum)
      for (const EnumItem& item : tree_.list(tree_.as<EnumTypeExpr>(id).items))
        add(item.item.loc, scope_.declaredAt(item.item.loc), true);
    forEachChild(tree_, id, [&](const auto& child) { written(child, pou); });
  }
  void written(ExprId id, PouId pou) {
    writtenName(id, pou);
    forEachChild(tree_, id, [&](const auto& child) { written(child, pou); });
  }

  void writtenName(ExprId id, PouId pou) {
    const ExprKind kind = tree_.kind(id);
    if ((kind == ExprKind::Name || kind == ExprKind::Member) && resolved_.count(tree_.loc(id).offset) == 0)
      add(tree_.loc(id), meanings_.valueOf(pou, id).entity);
    if (kind == ExprKind::TypedName) {
      const TypedNameExpr& node = tree_.as<TypedNameExpr>(id);
      const Entity type = scope_.typeNamed(keyOf(node.type_name.name));
      add(node.type_name.loc, type);
      add(node.item.loc, scope_.memberOf(type, keyOf(node.item.name)));
    }
    if (kind == ExprKind::Call && tree_.as<CallExpr>(id).callee) {
      const CallExpr& node = tree_.as<CallExpr>(id);
      const auto isOpen = [&](const Argument& argument) {
        return argument.pin.name && resolved_.count(argument.pin.loc.offset) == 0;
      };
      const std::span<const Argument> arguments = tree_.list(node.arguments);
      if (std::none_of(arguments.begin(), arguments.end(), isOpen)) return;
      if (const PouId of = calledBy(meanings_.valueOf(pou, node.callee).entity)) pins(node.arguments, of);
    }
  }

  PouId calledBy(Entity callee) const {
    if (callee.entityKind() == EntityKind::Pou) return {callee.index};
    if (callee.entityKind() == EntityKind::Program) return project_.instances[callee.index].program;
    return scope_.blockOf(scope_.recordOf(scope_.typeOf(callee)));
  }

  const View& view_;
  const Tree& tree_;
  const Scope& scope_;
  const sema::Project& project_;
  const Meanings& meanings_;
  const FileUnit& unit_;
  std::vector<NamePlace> places_;
  std::vector<NamePlace> aliases_;         // counted where nothing else is known
  std::unordered_set<uint32_t> resolved_;  // the locations of the names that the check knows
};

}  // namespace

Meanings::Meanings(const View& view) : view_(view), scope_(*view.snapshot().project()) {}

const std::vector<NamePlace>& Meanings::of(const FileUnit& unit) const {
  if (const auto known = places_.find(unit.file.index); known != places_.end()) return known->second;
  return places_.emplace(unit.file.index, Collector(view_, scope_, *this, unit).collect()).first->second;
}

std::optional<NamePlace> Meanings::at(Loc parsed) const {
  const FileUnit* unit = view_.unitWith(parsed);
  if (unit == nullptr) return std::nullopt;
  const std::vector<NamePlace>& places = of(*unit);
  const auto next =
      std::partition_point(places.begin(), places.end(), [&](const NamePlace& place) { return place.loc <= parsed; });
  if (next == places.begin()) return std::nullopt;
  const NamePlace& place = next[-1];
  const std::string_view token = view_.sources().tokenAt(place.loc);
  const auto length = static_cast<uint32_t>(token.substr(0, token.find('#')).size());
  if (parsed.offset > place.loc.offset + length) return std::nullopt;
  return place;
}

// By declarations alone: bodies may be deep.
PouId Meanings::pouIn(Slice<DeclId> decls, Loc at) const {
  const Tree& tree = view_.tree();
  for (const DeclId id : tree.list(decls)) {
    const DeclKind kind = tree.kind(id);
    if (kind == DeclKind::Property)  // whose second half may be outside of it
      for (const DeclId accessor : {tree.as<PropertyDecl>(id).get, tree.as<PropertyDecl>(id).set})
        if (accessor && holds(tree.range(accessor), at)) return scope_.pouOf(accessor);
    if (!holds(extentOf(tree, id), at)) continue;
    if (kind == DeclKind::Namespace) return pouIn(tree.as<NamespaceDecl>(id).decls, at);
    if (kind != DeclKind::Pou) return {};
    const PouId inner = pouIn(tree.as<PouDecl>(id).members, at);
    return inner ? inner : scope_.pouOf(id);
  }
  return {};
}

PouId Meanings::pouAt(Loc parsed) const {
  const FileUnit* unit = view_.unitWith(parsed);
  return unit == nullptr ? PouId{} : pouIn(unit->decls, parsed);
}

// THIS is a pointer to the object, and SUPER the object as its base.
TypeId Meanings::typeOfObject(PouId from, bool is_base) const {
  if (!from) return {};
  const sema::Pou& pou = scope_.project().pou(from);
  const PouId object = pou.owner ? pou.owner : from;
  const PouId meant = is_base ? scope_.project().pou(object).base : object;
  return meant ? scope_.project().pou(meant).record : TypeId{};
}

// From the value of what precedes it; of a leaf there is none.
Value Meanings::stepFrom(PouId from, const Value& base, ExprId step) const {
  const Tree& tree = view_.tree();
  const types::TypeTable& types = scope_.project().types;
  const ExprKind kind = tree.kind(step);
  const auto keyOf = [&](NameId name) { return view_.names().key(name); };
  const auto valueOf = [&](Entity entity) { return Value{entity, scope_.typeOf(entity)}; };
  if (kind == ExprKind::Name) return valueOf(scope_.lookUp(from, keyOf(tree.as<NameExpr>(step).name)));
  if (kind == ExprKind::This || kind == ExprKind::Super) return {{}, typeOfObject(from, kind == ExprKind::Super)};
  if (kind == ExprKind::Member) {
    const NameId member = keyOf(tree.as<MemberExpr>(step).member);
    return valueOf(base.entity ? scope_.memberOf(base.entity, member) : scope_.memberOf(base.type, member));
  }
  if (kind == ExprKind::Index) return {{}, types.info(types.resolve(base.type)).base};
  if (kind == ExprKind::Deref) {
    const bool is_object = tree.kind(tree.as<DerefExpr>(step).base) == ExprKind::This;
    return {{}, is_object ? base.type : types.info(types.resolve(base.type)).base};
  }
  const bool is_call = kind == ExprKind::Call && base.entity.entityKind() == EntityKind::Pou;
  return {{}, is_call ? scope_.project().pous[base.entity.index].result : TypeId{}};
}

// Each step is resolved once, from the leaf on.
Value Meanings::valueOf(PouId from, ExprId written) const {
  const Tree& tree = view_.tree();
  std::vector<ExprId> steps;
  Value value;
  for (ExprId at = written; at;) {
    if (const auto known = values_.find(at.word); known != values_.end()) {
      value = known->second;
      break;
    }
    steps.push_back(at);
    const ExprKind kind = tree.kind(at);
    if (kind == ExprKind::Call) {
      at = tree.as<CallExpr>(at).callee;
    } else if (kind == ExprKind::Member || kind == ExprKind::Index || kind == ExprKind::Deref) {
      at = tree.base(at);
    } else {
      break;
    }
  }
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    value = stepFrom(from, value, *step);
    values_.emplace(step->word, value);
  }
  return value;
}

}  // namespace rung::ide

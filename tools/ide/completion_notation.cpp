// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion_notation.h"

#include <algorithm>

#include "frontend/syntax/sfc.h"
#include "tools/ide/completion_offers.h"

namespace rung::ide {
namespace {

class NotationCompleter : Offers {
 public:
  NotationCompleter(const View& view, const LibraryIndex& libraries, const Cursor& cursor,
                    const CompletionContext& context, const Notation& notation)
      : Offers(view, libraries, cursor, context, std::nullopt), notation_(notation) {}

  Completion complete() {
    offer();
    return std::move(result_);
  }

 private:
  void offer() {
    const Notation& at = notation_;
    const auto use = [&](NameId name, Entity entity) { addWhole(name, entity); };
    switch (at.place) {
      case NotationPlace::None:
      case NotationPlace::Value:
      case NotationPlace::Target: return;  // expressions
      case NotationPlace::Step: return visible([&](Entity entity) { return isStep(entity); }, use);
      case NotationPlace::Action:
        context_.expected = types::kBool;
        return visible(
            [&](Entity entity) {
              const bool is_var = entity.entityKind() == EntityKind::Var && !isStep(entity);
              return isAction(entity) ||
                     (is_var && fits(scope_.typeOf(entity)) && !project_.vars[entity.index].constant);
            },
            use);
      case NotationPlace::Callee: return callees();
      case NotationPlace::Instance:
        return visible(
            [&](Entity entity) {
              return entity.entityKind() == EntityKind::Var && at.callee &&
                     scope_.blockOf(scope_.recordOf(scope_.typeOf(entity))) == at.callee;
            },
            use);
      case NotationPlace::Pin: return pinsOfBox(true);
      case NotationPlace::Output: return pinsOfBox(false);
    }
  }

  // A name that needs no trial.
  void addWhole(NameId name, Entity entity) {
    CompletionItem& item = add(text(name), kindOf(entity), kLocal);
    item.entity = entity;
  }

  bool isStep(Entity entity) const {
    if (entity.entityKind() != EntityKind::Var || !project_.vars[entity.index].of_chart) return false;
    const PouId pou = project_.vars[entity.index].pou;
    const DeclId decl = pou ? project_.pou(pou).decl : DeclId{};
    if (!decl || view_.tree().kind(decl) != DeclKind::Pou) return false;
    const auto steps = view_.tree().list(view_.tree().as<PouDecl>(decl).steps);
    return std::any_of(steps.begin(), steps.end(), [&](const SfcStep& step) {
      return view_.names().same(step.name.name, project_.vars[entity.index].name);
    });
  }

  bool isAction(Entity entity) const {
    return entity.entityKind() == EntityKind::Pou && project_.pous[entity.index].kind == PouKind::Action &&
           !isMade(view_.names().string(project_.pous[entity.index].name));
  }

  // Blocks and functions that have the pins which the box has; with an instance those whose instance it is.
  void callees() {
    const Notation& at = notation_;
    const NameId instance = at.instance.empty() ? NameId{} : view_.names().find(at.instance);
    const Entity of = instance ? scope_.lookUp(cursor_.pou, view_.names().key(instance)) : Entity{};
    const PouId block = scope_.blockOf(scope_.recordOf(scope_.typeOf(of)));
    visible(
        [&](Entity entity) {
          if (entity.entityKind() != EntityKind::Pou) return false;
          if (block) return block.index == entity.index;
          const PouKind kind = project_.pous[entity.index].kind;
          if (kind == PouKind::Program || kind == PouKind::Interface || !at.instance.empty()) return false;
          return std::all_of(at.given.begin(), at.given.end(),
                             [&](const std::string& pin) { return hasPin({entity.index}, pin); });
        },
        [&](NameId name, Entity entity) { addWhole(name, entity); });
  }

  bool hasPin(PouId pou, std::string_view name) const {
    if (sameIdentifier(name, "EN") || sameIdentifier(name, "ENO")) return true;
    const std::vector<VarId> pins = scope_.pinsOf(pou);
    return std::any_of(pins.begin(), pins.end(),
                       [&](VarId pin) { return sameIdentifier(view_.names().string(project_.var(pin).name), name); });
  }

  // Those of a box that it does not show yet, or its outputs.
  void pinsOfBox(bool is_list) {
    const Notation& at = notation_;
    const bool is_signed = isFollowedBy(":=");
    for (const VarId pin : scope_.pinsOf(at.callee)) {
      const std::string name = text(project_.var(pin).name);
      const bool is_output = project_.var(pin).section == SectionKind::Output;
      const bool is_given = is_list && std::any_of(at.given.begin(), at.given.end(), [&](const std::string& given) {
                              return sameIdentifier(given, name);
                            });
      if (is_given || !matches(name) || (is_list ? is_signed && is_output != at.is_output : !is_output)) continue;
      CompletionItem& item = add(name, CompletionKind::Pin, kPin);
      item.entity = Entity::of(EntityKind::Var, pin.index);
      item.detail = project_.types.toString(project_.var(pin).type);
      if (is_list && !is_signed) item.fit = Fit::Part;
      if (item.fit == Fit::Part || at.clause.before.empty()) continue;
      item.fit = Fit::Tried;
      item.key = name;
      if (is_list) continue;
      item.tried = at.box.empty() ? defaults_.typedLiteralOf(project_.var(pin).type) : at.box + "." + name;
      if (item.tried.empty()) item.fit = Fit::Whole;
    }
  }

  const Notation& notation_;
};

}  // namespace

Completion completionInNotation(const View& view, const LibraryIndex& libraries, const Cursor& cursor,
                                const CompletionContext& context, const Notation& notation) {
  return NotationCompleter(view, libraries, cursor, context, notation).complete();
}

}  // namespace rung::ide

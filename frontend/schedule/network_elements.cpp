// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/network_elements.h"

#include <algorithm>

#include "frontend/syntax/diagram.h"

namespace rung::diagram {

std::string describe(const Tree& tree, const Names& names, const DiagramElement& element) {
  static const char* const kKeywords[] = {"rail",   "right rail",  "contact",   "coil",         "box",    "input",
                                          "output", "in-out",      "connector", "continuation", "jump",   "label",
                                          "return", "execute box", "composer",  "selector",     "comment"};
  std::string text = kKeywords[static_cast<size_t>(element.kind)];
  const auto quote = [&](NameId name) { text += " `" + std::string(names.string(name)) + "`"; };
  if (element.name.name)
    quote(element.name.name);
  else if (element.operand && tree.kind(element.operand) == ExprKind::Name)
    quote(tree.as<NameExpr>(element.operand).name);
  return text;
}

ElementLocator::ElementLocator(const Tree& tree, const Names& names) : tree_(tree), names_(names) {
  for (const FileUnit& unit : tree.files)
    for (const DeclId decl : tree.list(unit.decls)) collect(decl, {});
  std::sort(bodies_.begin(), bodies_.end(), [](const Body& a, const Body& b) { return a.begin < b.begin; });
}

void ElementLocator::collect(DeclId decl, NameId owner) {
  if (tree_.kind(decl) == DeclKind::Namespace) {
    for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(decl).decls)) collect(inner, owner);
    return;
  }
  if (tree_.kind(decl) == DeclKind::Property) {
    const PropertyDecl& property = tree_.as<PropertyDecl>(decl);
    for (const DeclId accessor : {property.get, property.set})
      if (accessor) collect(accessor, owner);
    return;
  }
  if (tree_.kind(decl) != DeclKind::Pou) return;
  const PouDecl& pou = tree_.as<PouDecl>(decl);
  if (!pou.diagram.elements.empty()) bodies_.push_back({pou.body_begin, pou.body_end, decl, owner});
  for (const DeclId member : tree_.list(pou.members)) collect(member, pou.name);
}

std::string ElementLocator::at(Loc loc) const {
  auto body = std::upper_bound(bodies_.begin(), bodies_.end(), loc, [](Loc at, const Body& b) { return at < b.begin; });
  if (body == bodies_.begin() || !(loc < (--body)->end)) return {};
  const PouDecl& pou = tree_.as<PouDecl>(body->pou);
  const auto elements = tree_.list(pou.diagram.elements);
  auto element = std::upper_bound(elements.begin(), elements.end(), loc,
                                  [](Loc at, const DiagramElement& e) { return at < e.loc; });
  if (element == elements.begin() || !(loc < (--element)->end || loc == element->loc)) return {};
  std::string text;
  if (element->network != 0 && element->network <= pou.diagram.networks.count)
    text = "network " + std::to_string(tree_.list(pou.diagram.networks)[element->network - 1].number) + " of ";
  text += "`";
  if (body->owner) text += std::string(names_.string(body->owner)) + ".";
  return text + std::string(names_.string(pou.name)) + "`, " + describe(tree_, names_, *element) + ", number " +
         std::to_string(element->number);
}

}  // namespace rung::diagram

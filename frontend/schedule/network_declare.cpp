// SPDX-License-Identifier: Apache-2.0
// The hidden variables that networks need in addition to those declared.
#include <algorithm>
#include <string>
#include <vector>

#include "frontend/schedule/network_feedback.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/syntax/children.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/standard_names.h"
#include "frontend/syntax/tree_builder.h"

namespace rung::diagram {
namespace {

class Declarer {
 public:
  Declarer(Tree& tree, Names& names, Signatures& signatures, NetworkVariables& variables, const PouDecl& pou,
           std::string_view prefix)
      : tree_(tree), names_(names), signatures_(signatures), variables_(variables), prefix_(prefix) {
    forEachSection(tree_, pou, signatures_.madeSections(pou), [&](const SectionDecl& section) {
      for (const DeclId var : tree_.list(section.vars))
        for (const Ident& name : tree_.list(tree_.as<VarDecl>(var).names))
          taken_.push_back(names_.key(name.name).index);
    });
    std::sort(taken_.begin(), taken_.end());
  }

  void run(Slice<DiagramElement> elements) {
    const Tree& written = tree_;
    for (const DiagramElement& e : written.list(elements)) {
      if (const NameId hidden = ofElement(e)) variables_.hide(e, hidden);
      for (const DiagramPin& pin : written.list(e.pins)) {
        if (pin.edge == EdgeKind::None) continue;
        const std::string base = sensor(pin.edge) + number(e) + "_" + std::string(names_.string(pin.name.name));
        variables_.hide(pin, declare(base, sensorType(pin.edge, pin.name.loc), pin.name.loc));
      }
    }
  }

  // Variables for values of other cycles. Call after run(), which tells blocks from functions.
  void keepValues(Diagnostics& diagnostics, const PouDecl& pou) {
    const Tree& written = tree_;
    Graph graph;
    if (!graph.build(tree_, names_, diagnostics, pou.diagram, variables_)) return;
    BoxTypes types(tree_, names_, signatures_, pou, graph);
    for (const uint32_t source : readBeforeExecution(tree_, names_, graph)) {
      const Source& s = graph.sources[source];
      const Element& e = graph.elements[s.element];
      const TypeExprId type = types.of(source);
      if (!type) continue;
      std::string base = (e.name.name ? std::string(names_.string(e.name.name)) : "wire") + "_" + number(e);
      const DiagramPin* own = nullptr;
      uint32_t results = 0;
      for (const DiagramPin& pin : tree_.list(e.pins)) {
        if (pin.direction != PinDirection::Output) continue;
        if (s.pin.name && names_.same(pin.name.name, s.pin.name)) own = &pin;
        results += isEnableOutput(names_.string(pin.name.name)) ? 0 : 1;
      }
      if (s.pin.name && (results > 1 || isEnableOutput(names_.string(s.pin.name))))
        base += "_" + std::string(names_.string(s.pin.name));
      const NameId name = declare(base, type, e.loc);
      if (own != nullptr)
        variables_.store(*own, name);
      else
        variables_.store(written.list(pou.diagram.elements)[s.element], name);
    }
  }

  const std::vector<DeclId>& vars() const { return vars_; }

 private:
  static std::string sensor(EdgeKind edge) { return std::string(edgeDetector(edge)) + "_"; }
  static std::string number(const DiagramElement& e) { return std::to_string(e.number); }

  NameId ofElement(const DiagramElement& e) {
    const bool composes = e.kind == ElementKind::Compose;
    if (e.edge != EdgeKind::None && !composes && e.kind != ElementKind::Box)
      return declare(sensor(e.edge) + number(e), sensorType(e.edge, e.loc), e.loc);
    const bool nameless = e.kind == ElementKind::Box && !e.operand && e.path;
    if (!composes && !(nameless && signatures_.of(e.path).kind == SignatureKind::Block)) return {};
    return declare(std::string(names_.string(e.name.name)) + "_" + number(e), typeOf(e.path), e.name.loc);
  }

  TypeExprId sensorType(EdgeKind edge, Loc loc) {
    const Ident name{names_.intern(edgeDetector(edge)), loc};
    return TreeBuilder(tree_).namedType({&name, 1}, loc);
  }
  // The path of a box as a type expression.
  TypeExprId typeOf(ExprId path) {
    std::vector<Ident> idents;
    const Loc loc = tree_.loc(path);
    for (; tree_.kind(path) == ExprKind::Member; path = tree_.as<MemberExpr>(path).base)
      idents.push_back({tree_.as<MemberExpr>(path).member, tree_.loc(path)});
    idents.push_back({tree_.as<NameExpr>(path).name, tree_.loc(path)});
    std::reverse(idents.begin(), idents.end());
    return TreeBuilder(tree_).namedType(idents, loc);
  }
  NameId declare(const std::string& base, TypeExprId type, Loc loc) {
    std::string spelling = std::string(prefix_) + base;
    NameId name = names_.intern(spelling);
    while (std::binary_search(taken_.begin(), taken_.end(), names_.key(name).index))
      name = names_.intern(spelling += "x");
    const Ident ident{name, loc};
    vars_.push_back(TreeBuilder(tree_).variable(ident, type));
    return name;
  }

  Tree& tree_;
  Names& names_;
  Signatures& signatures_;
  NetworkVariables& variables_;
  std::string_view prefix_;
  std::vector<uint32_t> taken_;  // keys of the names that the POU declares, sorted
  std::vector<DeclId> vars_;
};

}  // namespace

DeclId declareNetworks(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
                       NetworkVariables& variables, const PouDecl& pou, SectionKind kind, std::string_view prefix) {
  Declarer declarer(tree, names, signatures, variables, pou, prefix);
  declarer.run(pou.diagram.elements);
  declarer.keepValues(diagnostics, pou);
  if (declarer.vars().empty()) return {};
  const Loc loc = tree.loc(declarer.vars().front());
  return TreeBuilder(tree).section(kind, declarer.vars(), loc, SectionMaker::Networks);
}

}  // namespace rung::diagram

// SPDX-License-Identifier: Apache-2.0
// `rung graph`: each body in LD, FBD, CFC or SFC, and each module of an NCT ladder, as an SVG file named after its POU:
// Pump.svg, Pump.Start.svg. Pictures show the source: the program need not compile, only parse. Nothing is written when
// there are errors.
#include <algorithm>
#include <unordered_set>

#include "frontend/render/picture.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/syntax/sfc.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

class Grapher {
 public:
  Grapher(Compilation& compilation, uint32_t page)
      : tree_(compilation.tree),
        names_(compilation.names),
        unreported_(compilation.sources),
        in_outs_(compilation.inOutsOfBoxes()),
        page_(static_cast<int32_t>(page)) {}
  std::vector<TextFile> pictures();

 private:
  void visit(Slice<DeclId> decls, const std::string& prefix);
  void visit(DeclId id, const std::string& prefix);
  void visitPou(const PouDecl& pou, const std::string& name);
  void add(const PouDecl& pou, const std::string& name);

  std::string networks(const Diagram& diagram, const std::string& name);

  Tree& tree_;
  Names& names_;
  Diagnostics unreported_;  // what keeps a body from running does not keep it from being drawn
  const std::vector<bool> in_outs_;
  const int32_t page_;
  std::unordered_set<std::string> taken_;  // lower case: a file system may ignore the case of letters
  std::vector<TextFile> pictures_;
};

void Grapher::add(const PouDecl& pou, const std::string& name) {
  if (pou.body_kind != BodyKind::Network && pou.body_kind != BodyKind::Sfc) return;
  std::string file = name;
  for (uint32_t n = 2; !taken_.insert(foldedIdentifier(file)).second; ++n) file = name + "_" + std::to_string(n);
  pictures_.push_back({file + ".svg", pou.body_kind == BodyKind::Sfc ? picture::drawChart(tree_, names_, pou, name)
                                                                     : networks(pou.diagram, name)});
}

// A chart is not read in lines: it has the numbers of its execution order, those of other languages would say nothing.
std::string Grapher::networks(const Diagram& diagram, const std::string& name) {
  picture::NetworkNotes notes{{}, &in_outs_};
  if (diagram.language == NetworkLanguage::Continuous)
    notes.execution_order = diagram::executionOrder(tree_, names_, unreported_, diagram);
  return picture::drawNetworks(tree_, names_, diagram, name, page_, notes);
}

// A condition of a transition with a body is an action that the parser made; its picture is named after the transition.
void Grapher::visitPou(const PouDecl& pou, const std::string& name) {
  add(pou, name);
  for (const DeclId member : tree_.list(pou.members)) {
    const auto transitions = tree_.list(pou.transitions);
    const auto created =
        std::find_if(transitions.begin(), transitions.end(), [&](const SfcTransition& t) { return t.body == member; });
    if (created == transitions.end())
      visit(member, name + ".");
    else
      add(tree_.as<PouDecl>(member), name + "." + std::string(names_.string(created->target.name)));
  }
}

void Grapher::visit(DeclId id, const std::string& prefix) {
  switch (tree_.kind(id)) {
    case DeclKind::Pou: {
      const auto& pou = tree_.as<PouDecl>(id);
      return visitPou(pou, prefix + std::string(names_.string(pou.name)));
    }
    case DeclKind::Property: {
      const auto& property = tree_.as<PropertyDecl>(id);
      const std::string name = prefix + std::string(names_.string(property.name));
      if (property.get) visitPou(tree_.as<PouDecl>(property.get), name + ".Get");
      if (property.set) visitPou(tree_.as<PouDecl>(property.set), name + ".Set");
      return;
    }
    case DeclKind::Namespace: {
      const auto& space = tree_.as<NamespaceDecl>(id);
      std::string inner = prefix;
      for (const Ident& part : tree_.list(space.path)) inner += std::string(names_.string(part.name)) + ".";
      return visit(space.decls, inner);
    }
    case DeclKind::Type:
    case DeclKind::Using:
    case DeclKind::Section:
    case DeclKind::Var:
    case DeclKind::Configuration:
    case DeclKind::Resource:
    case DeclKind::Task:
    case DeclKind::ProgramInstance: return;
  }
}

void Grapher::visit(Slice<DeclId> decls, const std::string& prefix) {
  for (const DeclId id : tree_.list(decls)) visit(id, prefix);
}

std::vector<TextFile> Grapher::pictures() {
  for (const FileUnit& unit : tree_.files) visit(unit.decls, {});
  return std::move(pictures_);
}

}  // namespace

int runGraph(const ProjectOptions& project, const GraphOptions& options, Sink& sink) {
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  std::vector<TextFile> pictures;
  compilation.for_pictures = true;
  const bool parsed = compilation.parse() && !compilation.diagnostics.hasErrors();
  if (parsed) pictures = Grapher(compilation, options.page_width).pictures();
  const int exit = compilation.finish();
  if (exit != kSuccess) return exit;
  if (pictures.empty())
    return usageError(sink, "nothing to draw: no POU has a body in LD, FBD, CFC or SFC; `rung list pous` lists all");
  return writeFiles(options.output, pictures, sink);
}

}  // namespace rung::driver

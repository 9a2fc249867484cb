// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/diagram.h"

#include <algorithm>
#include <unordered_set>

#include "frontend/render/picture.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/node_at.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/st_printer.h"
#include "tools/driver/compile.h"
#include "tools/driver/file_provider.h"
#include "tools/ide/scope.h"

namespace rung::ide {
namespace {

// Bytes of the file.
struct Span {
  uint32_t begin = 0, end = 0;
  bool has(uint32_t byte) const { return begin <= byte && byte <= end; }
  uint32_t size() const { return end - begin; }
};

// A body that can be drawn, and where its POU is.
struct Body {
  DeclId decl;
  std::string name;
  Span span;
};

class Drawer {
 public:
  Drawer(const driver::ProjectOptions& options, const std::string& path, const std::string& text, const Scope* known)
      : path_(path), text_(text), known_(known), compilation_(options, times_, silent_), tree_(compilation_.tree) {
    compilation_.for_pictures = true;
  }

  std::optional<DrawnBody> draw(std::optional<uint32_t> byte) {
    if (!compilation_.parse()) return std::nullopt;
    for (const FileUnit& unit : tree_.files)
      for (const DeclId id : tree_.list(unit.decls)) visit(id, {});
    const Body* const body = chosen(byte);
    if (body == nullptr) return std::nullopt;
    const PouDecl& pou = tree_.as<PouDecl>(body->decl);
    DrawnBody drawn{body->name, body->name + " (" + languageOf(pou) + ")", svgOf(pou, body->name), elementsOf(pou), {}};
    keepDrawn(drawn);
    if (byte) drawn.cursor = elementAt(pou, drawn.elements, *byte);
    return drawn;
  }

 private:
  // ---- bodies

  void visit(DeclId id, const std::string& prefix) {
    if (tree_.kind(id) == DeclKind::Namespace) {
      const auto& space = tree_.as<NamespaceDecl>(id);
      std::string inner = prefix;
      for (const Ident& part : tree_.list(space.path)) inner += text(part.name) + ".";
      for (const DeclId decl : tree_.list(space.decls)) visit(decl, inner);
    } else if (tree_.kind(id) == DeclKind::Property) {
      const auto& property = tree_.as<PropertyDecl>(id);
      const std::string name = prefix + text(property.name);
      if (property.get) visitPou(property.get, name + ".Get");
      if (property.set) visitPou(property.set, name + ".Set");
    } else if (tree_.kind(id) == DeclKind::Pou) {
      visitPou(id, prefix + text(tree_.as<PouDecl>(id).name));
    }
  }

  void visitPou(DeclId id, const std::string& name) {
    const auto& pou = tree_.as<PouDecl>(id);
    if (pou.body_kind == BodyKind::Network || pou.body_kind == BodyKind::Sfc) {
      bodies_.push_back({id, name, spanOf(extentOf(tree_, id)).value_or(Span{UINT32_MAX, 0})});
      // Its declaration may be made: a ladder of NCT.
      for (const DrawnElement& element : elementsOf(pou)) {
        bodies_.back().span.begin = std::min(bodies_.back().span.begin, element.begin);
        bodies_.back().span.end = std::max(bodies_.back().span.end, element.end);
      }
    }
    for (const DeclId member : tree_.list(pou.members)) visit(member, name + ".");
  }

  const Body* chosen(std::optional<uint32_t> byte) const {
    if (bodies_.empty()) return nullptr;
    if (!byte) return &bodies_.front();
    const Body* best = nullptr;
    for (const Body& body : bodies_)
      if (body.span.has(*byte) && (best == nullptr || body.span.size() < best->span.size())) best = &body;
    return best;
  }

  const char* languageOf(const PouDecl& pou) const {
    if (pou.body_kind == BodyKind::Sfc) return "SFC";
    if (compilation_.inputs.has_ladder) return "NCT";
    switch (pou.diagram.language) {
      case NetworkLanguage::Ladder: return "LD";
      case NetworkLanguage::Blocks: return "FBD";
      case NetworkLanguage::Continuous: return "CFC";
    }
    return "";
  }

  // ---- the picture

  std::string svgOf(const PouDecl& pou, const std::string& name) {
    const auto noPath = [](ExprId) { return std::string(); };  // gives each element its id
    const picture::PathOf path_of = noPath;
    if (pou.body_kind == BodyKind::Sfc) return picture::drawChart(tree_, compilation_.names, pou, name, &path_of);
    const std::vector<bool> in_outs = inOutsOf(pou);
    picture::NetworkNotes notes{{}, &in_outs, &path_of};
    Diagnostics unreported(compilation_.sources);
    if (pou.diagram.language == NetworkLanguage::Continuous)
      notes.execution_order = diagram::executionOrder(tree_, compilation_.names, unreported, pou.diagram);
    return picture::drawNetworks(tree_, compilation_.names, pou.diagram, name, 0, notes);
  }

  // By the index of a pin in the tree.
  std::vector<bool> inOutsOf(const PouDecl& pou) const {
    std::vector<bool> in_outs;
    if (known_ == nullptr) return in_outs;
    for (const DiagramElement& element : tree_.list(pou.diagram.elements)) {
      if (element.kind != ElementKind::Box || !element.path) continue;
      const PouId callee = pouNamed(printSt(tree_, compilation_.names, element.path));
      if (!callee) continue;
      const std::vector<VarId> pins = known_->pinsOf(callee);
      for (uint32_t k = 0; k < element.pins.count; ++k) {
        const std::string name = text(tree_.list(element.pins)[k].name.name);
        const bool is_in_out = std::any_of(pins.begin(), pins.end(), [&](VarId pin) {
          const sema::Var& var = known_->project().var(pin);
          return var.section == SectionKind::InOut && sameIdentifier(known_->project().names.string(var.name), name);
        });
        if (!is_in_out) continue;
        in_outs.resize(std::max<size_t>(in_outs.size(), element.pins.first + k + 1));
        in_outs[element.pins.first + k] = true;
      }
    }
    return in_outs;
  }

  PouId pouNamed(const std::string& name) const {
    const Names& names = known_->project().names;
    const NameId id = names.find(name);
    const Entity found = id ? known_->typeNamed(names.key(id)) : Entity{};
    return found.entityKind() == EntityKind::Pou ? PouId{found.index} : PouId{};
  }

  // ---- where it comes from

  void add(std::vector<DrawnElement>& to, std::string id, std::optional<Span> span) const {
    if (span) to.push_back({std::move(id), span->begin, span->end});
  }

  std::vector<DrawnElement> elementsOf(const PouDecl& pou) const {
    std::vector<DrawnElement> elements;
    if (pou.body_kind == BodyKind::Sfc)
      addChart(pou, elements);
    else
      addNetworks(pou, elements);
    if (compilation_.inputs.has_ladder) extendToNext(elements);
    return elements;
  }

  // Of an element of a ladder only its beginning is known.
  void extendToNext(std::vector<DrawnElement>& elements) const {
    std::stable_sort(elements.begin(), elements.end(),
                     [](const DrawnElement& a, const DrawnElement& b) { return a.begin < b.begin; });
    for (size_t at = 0; at < elements.size(); ++at) {
      size_t end = std::min(text_.find_first_of("\r\n", elements[at].begin), text_.size());
      if (at + 1 < elements.size() && elements[at + 1].begin > elements[at].begin)
        end = std::min<size_t>(end, elements[at + 1].begin);
      while (end > elements[at].begin + 1 && isBlankCharacter(text_[end - 1])) --end;
      elements[at].end = std::max(elements[at].end, static_cast<uint32_t>(end));
    }
  }

  void addNetworks(const PouDecl& pou, std::vector<DrawnElement>& to) const {
    for (const DiagramElement& element : tree_.list(pou.diagram.elements))
      add(to, picture::elementId(element.number), withWord(spanOf({element.loc, element.end})));
  }

  // The word before the number of an element in the notation belongs to it.
  std::optional<Span> withWord(std::optional<Span> span) const {
    if (!span) return span;
    size_t end = span->begin;
    while (end > 0 && text_[end - 1] == ' ') --end;
    size_t begin = end;
    while (begin > 0 && isNameCharacter(text_[begin - 1])) --begin;
    const std::string_view word = std::string_view(text_).substr(begin, end - begin);
    const bool is_word = std::any_of(std::begin(kElementWords), std::end(kElementWords),
                                     [&](std::string_view known) { return sameIdentifier(known, word); });
    if (is_word) span->begin = static_cast<uint32_t>(begin);
    return span;
  }

  void addChart(const PouDecl& pou, std::vector<DrawnElement>& to) const {
    for (uint32_t k = 0; k < pou.steps.count; ++k) {
      const SfcStep& step = tree_.list(pou.steps)[k];
      add(to, picture::stepId(k), tokenAt(step.name.loc));
      for (uint32_t a = 0; a < step.actions.count; ++a)
        add(to, picture::actionId(k, a), tokenAt(tree_.list(step.actions)[a].action.loc));
    }
    for (uint32_t k = 0; k < pou.transitions.count; ++k) {
      const SfcTransition& transition = tree_.list(pou.transitions)[k];
      add(to, picture::transitionId(k), spanOf({transition.begin, transition.end}));
    }
  }

  // Without what the picture does not show: rails, empty comments.
  static void keepDrawn(DrawnBody& drawn) {
    constexpr std::string_view kId = " id=\"";
    std::unordered_set<std::string_view> ids;
    const std::string_view svg = drawn.svg;
    for (size_t at = svg.find(kId); at != std::string_view::npos; at = svg.find(kId, at)) {
      at += kId.size();
      ids.insert(svg.substr(at, svg.find('"', at) - at));
    }
    std::erase_if(drawn.elements, [&](const DrawnElement& element) { return ids.count(element.id) == 0; });
    std::stable_sort(drawn.elements.begin(), drawn.elements.end(),
                     [](const DrawnElement& a, const DrawnElement& b) { return a.begin < b.begin; });
  }

  // The smallest one with the byte. In a step what begins last before it; in the body of an action the action.
  std::string elementAt(const PouDecl& pou, const std::vector<DrawnElement>& elements, uint32_t byte) const {
    const DrawnElement* best = nullptr;
    for (const DrawnElement& element : elements)
      if (element.begin <= byte && byte <= element.end &&
          (best == nullptr || element.end - element.begin <= best->end - best->begin))
        best = &element;
    if (best != nullptr) return best->id;
    if (pou.body_kind != BodyKind::Sfc) return {};
    if (const std::string action = actionWith(pou, byte); !action.empty()) return action;
    for (const DrawnElement& element : elements)
      if (element.begin <= byte) best = &element;
    return best != nullptr && !best->id.starts_with(kTransition) ? best->id : std::string();
  }

  std::string actionWith(const PouDecl& pou, uint32_t byte) const {
    for (const DeclId member : tree_.list(pou.members)) {
      const std::optional<Span> span = spanOf(extentOf(tree_, member));
      if (!span || !span->has(byte) || tree_.kind(member) != DeclKind::Pou) continue;
      const NameId name = tree_.as<PouDecl>(member).name;
      for (uint32_t k = 0; k < pou.steps.count; ++k) {
        const SfcStep& step = tree_.list(pou.steps)[k];
        for (uint32_t a = 0; a < step.actions.count; ++a)
          if (compilation_.names.same(tree_.list(step.actions)[a].action.name, name)) return picture::actionId(k, a);
      }
    }
    return {};
  }

  bool isHere(Loc at) const {
    const FileId file = at ? compilation_.sources.fileOf(at) : FileId{};
    return file && driver::absolutePath(std::string(compilation_.sources.displayPath(file))) == path_;
  }

  // What was parsed, in the file; none: it was made.
  std::optional<Span> spanOf(Range parsed) const {
    const Sources& sources = compilation_.sources;
    if (!parsed.begin || parsed.end <= parsed.begin) return tokenAt(parsed.begin);
    const Loc begin = sources.originalLocation(parsed.begin), last = sources.originalLocation({parsed.end.offset - 1});
    if (!isHere(begin)) return std::nullopt;
    if (!isHere(last) || last < begin) return tokenAt(parsed.begin);
    const uint32_t base = sources.begin(sources.fileOf(begin)).offset;
    return Span{begin.offset - base, last.offset - base + 1};
  }

  std::optional<Span> tokenAt(Loc parsed) const {
    const Sources& sources = compilation_.sources;
    const Loc begin = parsed ? sources.originalLocation(parsed) : Loc{};
    if (!isHere(begin)) return std::nullopt;
    const uint32_t at = begin.offset - sources.begin(sources.fileOf(begin)).offset;
    return Span{at, at + static_cast<uint32_t>(sources.tokenAt(parsed).size())};
  }

  std::string text(NameId name) const { return std::string(compilation_.names.string(name)); }

  static constexpr std::string_view kTransition = "transition";

  const std::string& path_;
  const std::string& text_;
  const Scope* known_;
  driver::PhaseTimes times_;
  driver::SilentSink silent_;
  driver::Compilation compilation_;
  Tree& tree_;
  std::vector<Body> bodies_;
};

}  // namespace

std::optional<DrawnBody> drawBodyAt(const driver::ProjectOptions& options, const std::string& path,
                                    const std::string& text, std::optional<uint32_t> byte, const Scope* known) {
  driver::ProjectOptions own = options;
  own.inputs = {path};
  own.dialect_given = true;
  own.unsaved = {{path, text}};
  return Drawer(own, path, text, known).draw(byte);
}

}  // namespace rung::ide

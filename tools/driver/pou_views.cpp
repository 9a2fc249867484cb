// SPDX-License-Identifier: Apache-2.0
// The bodies of a project as its monitor shows them: see pou_views.h.
#include "tools/driver/pou_views.h"

#include <algorithm>

#include "codegen/names.h"
#include "frontend/render/picture.h"
#include "frontend/schedule/network_schedule.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/st_printer.h"
#include "tools/driver/compile.h"
#include "tools/driver/value_paths.h"

namespace rung::driver {

namespace {

const char* languageOf(const PouDecl& pou) {
  switch (pou.body_kind) {
    case BodyKind::Network:
      return pou.diagram.language == NetworkLanguage::Ladder   ? "LD"
             : pou.diagram.language == NetworkLanguage::Blocks ? "FBD"
                                                               : "CFC";
    case BodyKind::Sfc: return "SFC";
    case BodyKind::Il: return "IL";
    case BodyKind::Cpp: return "C++";
    case BodyKind::St:
    case BodyKind::None:
    case BodyKind::Native: return "ST";
  }
  return "ST";
}

bool hasBody(const PouDecl& pou) { return pou.body_kind != BodyKind::None && pou.body_kind != BodyKind::Native; }

}  // namespace

class PouViewer {
 public:
  explicit PouViewer(Compilation& compilation) : compilation_(compilation), tree_(compilation.tree) {}

  // Of a checked project.
  void addPous(PouViews& to) {
    const ValuePaths paths(*compilation_.project);
    for (const sema::Pou& pou : compilation_.project->pous) {
      if (!pou.decl || pou.library || pou.excluded || pou.instance.of || tree_.kind(pou.decl) != DeclKind::Pou)
        continue;
      const auto& decl = tree_.as<PouDecl>(pou.decl);
      // A ladder of NCT is drawn from another reading of its file.
      const bool is_ladder = compilation_.sources.hasAnyUnderscores(pou.file);
      if (!hasBody(decl) || is_ladder) continue;
      const auto path_of = [&](ExprId written) { return paths.of(written); };
      to.views_.push_back({nameOf(pou), blockOf(pou), languageOf(decl), contentOf(decl, pou, path_of, paths)});
    }
  }

  // Of a project that was read for pictures: symbols and addresses of NCT are the same everywhere.
  void addLadder(PouViews& to) {
    for (const FileUnit& unit : tree_.files) {
      if (!compilation_.sources.hasAnyUnderscores(unit.file)) continue;
      for (const DeclId id : tree_.list(unit.decls)) {
        if (tree_.kind(id) != DeclKind::Pou) continue;
        const auto& pou = tree_.as<PouDecl>(id);
        const auto path_of = [&](ExprId written) { return ladderPath(written); };
        const std::string name(compilation_.names.string(pou.name));
        if (pou.body_kind == BodyKind::Network) to.views_.push_back({name, "", "NCT", networks(pou, name, path_of)});
      }
    }
  }

 private:
  std::string nameOf(const sema::Pou& pou) const {
    const std::string own(compilation_.names.string(pou.name));
    return pou.owner ? nameOf(compilation_.project->pou(pou.owner)) + "." + own : own;
  }
  // Whose instances have the variables; empty: a function.
  std::string blockOf(const sema::Pou& pou) const {
    if (pou.owner) return blockOf(compilation_.project->pou(pou.owner));
    return pou.kind == PouKind::Function ? std::string() : std::string(compilation_.names.string(pou.name));
  }

  std::string contentOf(const PouDecl& decl, const sema::Pou& pou, const picture::PathOf& path_of,
                        const ValuePaths& paths) {
    if (decl.body_kind == BodyKind::Network) return networks(decl, nameOf(pou), path_of);
    if (decl.body_kind == BodyKind::Sfc)
      return picture::drawChart(tree_, compilation_.names, decl, nameOf(pou), &path_of);
    return text(tree_.range(pou.decl), paths);
  }

  std::string networks(const PouDecl& pou, const std::string& name, const picture::PathOf& path_of) {
    picture::NetworkNotes notes;
    Diagnostics unreported(compilation_.sources);
    if (pou.diagram.language == NetworkLanguage::Continuous)
      notes.execution_order = diagram::executionOrder(tree_, compilation_.names, unreported, pou.diagram);
    notes.path_of = &path_of;
    return picture::drawNetworks(tree_, compilation_.names, pou.diagram, name, 0, notes);
  }

  // A symbol or an address; the notation has a comparison as a name, too.
  std::string ladderPath(ExprId written) const {
    const std::string text = printSt(tree_, compilation_.names, written);
    const auto isPart = [](char c) { return isNameCharacter(c) || c == '.'; };
    return std::all_of(text.begin(), text.end(), isPart) ? text : std::string();
  }

  // {"file": "main.st", "lines": [{"line": 5, "text": "y := y + step;", "paths": [".y", ".step"]}]}
  std::string text(Range range, const ValuePaths& paths) const {
    const Sources& sources = compilation_.sources;
    const FileId file = sources.fileOf(range.begin);
    const std::string_view source = sources.sourceText(file);
    const uint32_t base = sources.begin(file).offset;
    size_t at = range.begin.offset - base;
    at = at == 0 ? 0 : source.rfind('\n', at - 1) + 1;  // npos + 1 is 0
    const size_t end = std::min<size_t>(range.end.offset - base, source.size());
    std::string out =
        "{\"file\": " + jsonQuote(sources.displayPath(sources.location(range.begin).file)) + ", \"lines\": [";
    for (const char* between = ""; at < end; between = ",") {
      const size_t line_end = std::min(source.find('\n', at), source.size());
      const Range line{{base + static_cast<uint32_t>(at)}, {base + static_cast<uint32_t>(line_end) + 1}};
      std::string_view shown = source.substr(at, line_end - at);
      if (shown.ends_with('\r')) shown.remove_suffix(1);
      out += between + std::string("\n{\"line\": ") + std::to_string(sources.lineNumber(line.begin)) +
             ", \"text\": " + jsonQuote(shown) + ", \"paths\": [" + pathsIn(line, paths) + "]}";
      at = line_end + 1;
    }
    return out + "]}\n";
  }

  // Each once, in the order of the text.
  static std::string pathsIn(Range line, const ValuePaths& paths) {
    std::vector<std::string> shown;
    std::string out;
    for (const ValuePaths::Mention& mention : paths.in(line)) {
      if (std::find(shown.begin(), shown.end(), mention.path) != shown.end()) continue;
      out += (shown.empty() ? "" : ", ") + jsonQuote(mention.path);
      shown.push_back(mention.path);
    }
    return out;
  }

  Compilation& compilation_;
  Tree& tree_;
};

PouViews PouViews::of(Compilation& compilation) {
  PouViews views;
  PouViewer(compilation).addPous(views);
  if (compilation.inputs.has_ladder) {
    PhaseTimes times;
    SilentSink silent;
    Compilation ladder(compilation.options, times, silent);
    ladder.for_pictures = true;
    if (ladder.parse()) PouViewer(ladder).addLadder(views);
  }
  std::stable_sort(views.views_.begin(), views.views_.end(),
                   [](const View& a, const View& b) { return a.name < b.name; });
  return views;
}

std::vector<rung_pou_view> PouViews::rows() const {
  std::vector<rung_pou_view> rows;
  for (const View& view : views_)
    rows.push_back({view.name.c_str(), view.block.c_str(), view.language.c_str(), view.content.c_str()});
  return rows;
}

std::string PouViews::source() const {
  std::string out =
      "#include \"rung/pou_view.h\"\nconst rung_pou_view* rung_pou_views();\n"
      "const rung_pou_view* rung_pou_views() {\nstatic const rung_pou_view views[] = {\n";
  for (const View& view : views_) {
    const char* between = "{";
    for (const std::string* part : {&view.name, &view.block, &view.language, &view.content}) {
      out += between;
      codegen::appendQuoted(out, *part);
      between = ", ";
    }
    out += "},\n";
  }
  return out + "{}};\nreturn views;\n}\n";
}

}  // namespace rung::driver

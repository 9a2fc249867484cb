// SPDX-License-Identifier: Apache-2.0
// `rung convert`: the program as Structured Text. Bodies in ST and all declarations stay as written; bodies that a
// scheduler turned into statements are printed, with their comments and the temporaries that they need. Files of other
// tools become the ST that Rung reads from them, one file for each of their POUs. `--to xml`: the whole program as one
// PLCopen XML file. `--to mes`: the messages of an NCT ladder as a message file. Printing happens between scheduling
// and checking (sema::Options::scheduled), because sema inserts nodes that ST cannot express; only the types of
// temporaries are asked for afterwards. Nothing is written when there are errors.
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "frontend/export/plcopen.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/st_printer.h"
#include "sema/project.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/declaration_files.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

struct Body {
  sema::PouId pou;
  Loc begin, end;    // the part that it replaces
  Loc declarations;  // where the temporaries are declared: before the first member or the body
  bool own_line;
  std::string text;
  std::string sections = {};            // of a chart: its variables
  std::vector<DeclId> actions = {};     // … and the actions inside it
  std::vector<std::string> taken = {};  // names that a base has, which get a suffix
  std::string_view suffix = {};
};
struct Edit {
  Loc begin, end;
  std::string text;
  bool begins_line = false;
};

size_t lineOf(std::string_view text, size_t at) {
  while (at > 0 && text[at - 1] != '\n') --at;
  return at;
}

// The comments of a body, each at the beginning of its line, so it goes in front of the statement of that line.
std::vector<StComment> commentsOf(std::string_view text, size_t begin, size_t end, uint32_t base) {
  std::vector<StComment> comments;
  Scanner scanner(text);
  scanner.moveTo(begin);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End && unit.begin < end; unit = scanner.next()) {
    if (unit.kind != UnitKind::Comment) continue;
    const size_t line = std::max(begin, lineOf(text, unit.begin));
    comments.push_back({{base + static_cast<uint32_t>(line)}, scanner.textOf(unit)});
  }
  return comments;
}

// The titles of networks and the comments drawn in them, as comments of ST.
std::vector<std::pair<Loc, std::string>> drawnComments(const Tree& tree, const Diagram& diagram) {
  std::vector<std::pair<Loc, std::string>> drawn;
  const auto add = [&](Loc at, std::string_view text) {
    if (std::all_of(text.begin(), text.end(), isBlankCharacter)) return;
    std::string comment = "// ";
    for (const char c : text)
      if (c == '\n') {
        comment.erase(comment.find_last_not_of(' ') + 1);
        comment += "\n// ";
      } else if (c != '\r') {
        comment += c;
      }
    drawn.emplace_back(at, std::move(comment));
  };
  for (const DiagramNetwork& n : tree.list(diagram.networks)) add(n.loc, tree.string({n.title, n.title_length}));
  for (const DiagramElement& e : tree.list(diagram.elements))
    if (e.kind == ElementKind::Comment) add(e.loc, tree.string({e.comment, e.comment_length}));
  return drawn;
}

// The sections that a chart needs.
template <class Visit>
void forEachSectionOfChart(const sema::Project& project, const PouDecl& decl, const Visit& visit) {
  for (const DeclId id : project.madeSections(decl))
    if (const SectionDecl& section = project.tree.as<SectionDecl>(id); section.maker == SectionMaker::Chart)
      visit(section);
}

std::string_view wordOf(SectionKind kind) {
  return kind == SectionKind::Temp ? "VAR_TEMP" : kind == SectionKind::Inst ? "VAR_INST" : "VAR";
}

class Converter {
 public:
  Converter(Compilation& compilation, bool splits)
      : compilation_(compilation), sources_(compilation.sources), splits_(splits) {
    compilation.scheduled = [this](sema::Project&, sema::PouId pou) { print(pou); };
  }

  std::vector<TextFile> outputs();
  std::string taskOfPrograms() const;  // after outputs()

 private:
  bool becomesFolder(const InputFile& input) const;
  bool split(const InputFile& input, const std::string& folder, std::vector<TextFile>& out) const;
  void print(sema::PouId pou);
  void printChart(sema::PouId id, const PouDecl& decl);
  void printConditions(sema::PouId id);
  std::vector<StComment> chartComments(const PouDecl& decl) const;
  std::string withComments(const ChartText& chart, std::span<const StComment> comments) const;
  std::string statementsOfChart(const sema::Pou& pou, const PouDecl& decl) const;
  std::string nameOf(DeclId variable) const;
  std::string declarationOf(DeclId variable) const;
  std::string sectionsOfChart(const PouDecl& decl, const std::map<std::string, std::string>& inherited,
                              std::vector<std::string>& taken) const;
  std::string temporaries(const Body& body) const;
  void printHidden(sema::PouId id);
  std::string typeOf(sema::PouId id, NameId variable) const;
  std::map<std::string, std::string> chartVariablesOfBases(sema::PouId id) const;
  std::string convert(FileId file) const;
  std::string convert(Loc begin, Loc end) const;
  std::string action(DeclId id) const;

  Compilation& compilation_;
  const Sources& sources_;
  const bool splits_;  // every file becomes a folder
  std::vector<Body> bodies_;
  std::vector<Edit> hidden_;                      // the variables that networks need
  std::unordered_set<uint32_t> conditions_done_;  // POUs, by their location
  bool is_split_ = false;                         // some file became a folder
};

// In upper case.
std::string Converter::nameOf(DeclId variable) const {
  const VarDecl& decl = compilation_.tree.as<VarDecl>(variable);
  return upper(compilation_.names.string(compilation_.tree.list(decl.names)[0].name));
}

// `  name : type := value;`
std::string Converter::declarationOf(DeclId variable) const {
  return "  " + printSt(compilation_.tree, compilation_.names, compilation_.tree.as<VarDecl>(variable)) + "\n";
}

// The variables of charts in the blocks that it extends, by name; the first one that declares it counts.
std::map<std::string, std::string> Converter::chartVariablesOfBases(sema::PouId id) const {
  std::map<std::string, std::string> lines;
  const sema::Project& project = *compilation_.project;
  const Tree& tree = compilation_.tree;
  for (sema::PouId base = project.pou(id).base; base; base = project.pou(base).base) {
    if (!project.pou(base).decl) continue;
    forEachSectionOfChart(project, tree.as<PouDecl>(project.pou(base).decl), [&](const SectionDecl& section) {
      for (const DeclId variable : tree.list(section.vars)) lines[nameOf(variable)] = declarationOf(variable);
    });
  }
  return lines;
}

// The sections of a chart without the variables that a base has: the same variable does for both, because only one of
// the charts runs. Another variable of the same name is `taken`.
std::string Converter::sectionsOfChart(const PouDecl& decl, const std::map<std::string, std::string>& inherited,
                                       std::vector<std::string>& taken) const {
  std::string text;
  forEachSectionOfChart(*compilation_.project, decl, [&](const SectionDecl& section) {
    text.append(wordOf(section.section)).append("\n");
    for (const DeclId variable : compilation_.tree.list(section.vars)) {
      const std::string line = declarationOf(variable);
      const auto known = inherited.find(nameOf(variable));
      const bool is_inherited = known != inherited.end() && known->second == line;
      if (is_inherited && section.section != SectionKind::Temp) continue;
      if (known != inherited.end()) taken.push_back(known->first);
      text += line;
    }
    text += "END_VAR\n";
  });
  std::sort(taken.begin(), taken.end());
  return text;
}

// `A.x` as `A_Derived.x`, for each of these names.
std::string renamed(std::string_view text, const std::vector<std::string>& names, std::string_view suffix) {
  std::string out;
  size_t done = 0;
  bool member = false;
  Scanner scanner(text);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next()) {
    const std::string_view word = scanner.textOf(unit);
    if (unit.kind == UnitKind::Name && !member && std::binary_search(names.begin(), names.end(), upper(word))) {
      out += text.substr(done, unit.end - done);
      out += "_" + std::string(suffix);
      done = unit.end;
    }
    member = unit.kind == UnitKind::Other && word == ".";
  }
  return out + std::string(text.substr(done));
}

// Called while sema is running, before it changes the statements of the scheduler.
void Converter::print(sema::PouId id) {
  const sema::Project& project = *compilation_.project;
  const sema::Pou& pou = project.pou(id);
  if (pou.library || pou.instance.of || compilation_.diagnostics.hasErrors()) return;
  const PouDecl& decl = compilation_.tree.as<PouDecl>(pou.decl);
  printHidden(pou.kind == PouKind::Action ? pou.owner : id);
  if (decl.body_kind == BodyKind::Sfc) return printChart(id, decl);
  const std::string_view text = sources_.original(pou.file);
  const uint32_t base = sources_.begin(pou.file).offset;
  const size_t begin = decl.body_begin.offset - base, end = decl.body_end.offset - base;
  const size_t line = lineOf(text, begin);
  const bool own_line = text.substr(line, begin - line).find_first_not_of(" \t") == std::string_view::npos;
  const size_t from = own_line ? line : begin;
  const auto indent = static_cast<uint32_t>(std::min<size_t>(begin - from, 8));
  std::vector<StComment> comments = commentsOf(text, begin, end, base);
  const auto drawn = drawnComments(compilation_.tree, decl.diagram);
  for (const auto& [at, comment] : drawn) comments.push_back({at, comment});
  std::stable_sort(comments.begin(), comments.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  Body body{id, {base + static_cast<uint32_t>(from)}, decl.body_end, {}, own_line, own_line ? "" : "\n"};
  body.declarations = body.begin;
  for (const DeclId member : compilation_.tree.list(decl.members)) {
    const size_t at = lineOf(text, compilation_.tree.loc(member).offset - base);
    body.declarations = std::min(body.declarations, Loc{base + static_cast<uint32_t>(at)});
  }
  body.text += printSt(compilation_.tree, compilation_.names, pou.body.statements, indent, comments);
  if (!body.text.empty() && body.text.back() == '\n') body.text.pop_back();  // the source has a newline after the body
  bodies_.push_back(std::move(body));
}

std::string Converter::typeOf(sema::PouId id, NameId variable) const {
  const sema::Project& project = *compilation_.project;
  for (const sema::VarId v : project.pou(id).vars)
    if (project.var(v).name == variable) return project.types.toString(project.var(v).type);
  return {};
}

// Declares the variables that the networks of a POU and its actions need, before its first member or its body.
void Converter::printHidden(sema::PouId id) {
  const Tree& tree = compilation_.tree;
  const PouDecl& decl = tree.as<PouDecl>(compilation_.project->pou(id).decl);
  std::string lines;
  for (const DeclId s : compilation_.project->madeSections(decl)) {
    const SectionDecl& section = tree.as<SectionDecl>(s);
    if (section.maker != SectionMaker::Networks) continue;
    for (const DeclId v : tree.list(section.vars)) {
      const VarDecl& var = tree.as<VarDecl>(v);
      const NameId name = tree.list(var.names)[0].name;
      lines += "  " + std::string(compilation_.names.string(name)) + " : " + typeOf(id, name) + ";\n";
    }
  }
  if (lines.empty()) return;
  const std::string_view text = sources_.original(sources_.fileOf(decl.h.begin));
  const uint32_t base = sources_.begin(sources_.fileOf(decl.h.begin)).offset;
  size_t at = lineOf(text, decl.body_begin.offset - base);
  for (const DeclId member : tree.list(decl.members)) at = std::min(at, lineOf(text, tree.loc(member).offset - base));
  const Loc loc{base + static_cast<uint32_t>(at)};
  if (std::any_of(hidden_.begin(), hidden_.end(), [&](const Edit& edit) { return edit.begin == loc; })) return;
  hidden_.push_back({loc, loc, (decl.pou_kind == PouKind::Method ? "VAR_INST\n" : "VAR\n") + lines + "END_VAR\n"});
}

// The comments outside of actions and conditions: quoted code brings its own.
std::vector<StComment> Converter::chartComments(const PouDecl& decl) const {
  const FileId file = sources_.fileOf(decl.body_begin);
  const std::string_view text = sources_.original(file);
  const uint32_t base = sources_.begin(file).offset;
  std::vector<std::pair<Loc, Loc>> quoted;
  for (const DeclId member : compilation_.tree.list(decl.members)) {
    if (compilation_.tree.kind(member) != DeclKind::Pou) continue;
    const PouDecl& action = compilation_.tree.as<PouDecl>(member);
    quoted.push_back({action.h.begin, action.h.end});
  }
  for (const SfcTransition& t : compilation_.tree.list(decl.transitions))
    quoted.push_back({t.condition.begin, t.condition.end});
  std::vector<StComment> comments = commentsOf(text, decl.body_begin.offset - base, decl.body_end.offset - base, base);
  std::erase_if(comments, [&](const StComment& comment) {
    const Loc at{base + static_cast<uint32_t>(comment.text.data() - text.data())};
    return std::any_of(quoted.begin(), quoted.end(), [&](const auto& q) { return q.first <= at && at < q.second; });
  });
  return comments;
}

// Puts each comment in front of the first line made from its location or a later one; for a step that is where its
// active cycles begin.
std::string Converter::withComments(const ChartText& chart, std::span<const StComment> comments) const {
  const std::string_view text = chart.text;
  const size_t first = lineOf(text, std::min(text.find("sfc_set := sfc_steps"), text.size()));
  std::vector<ChartText::Line> lines = chart.lines;
  std::erase_if(lines, [&](const ChartText::Line& line) { return line.begin < first; });
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.origin < b.origin; });
  std::vector<std::pair<size_t, std::string_view>> places;
  for (const StComment& comment : comments) {
    const auto line =
        std::lower_bound(lines.begin(), lines.end(), comment.at, [](const auto& a, Loc at) { return a.origin < at; });
    places.push_back({line == lines.end() ? text.size() : line->begin, comment.text});
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string out;
  size_t done = 0;
  for (const auto& [place, comment] : places) {
    out += text.substr(done, place - done);
    done = place;
    out.append(std::min(text.find_first_not_of(' ', place), text.size()) - place, ' ');
    out += comment;
    out += '\n';
  }
  return out + std::string(text.substr(done));
}

std::string Converter::statementsOfChart(const sema::Pou& pou, const PouDecl& decl) const {
  const Tree& tree = compilation_.tree;
  std::vector<Ident> members;
  for (const SfcStep& step : tree.list(decl.steps)) {
    members.push_back(step.name);
    for (const SfcAssociation& association : tree.list(step.actions)) members.push_back(association.action);
  }
  return withComments(rung::printChart(tree, compilation_.names, sources_, pou.body.statements, members),
                      chartComments(decl));
}

// The ST of a chart; its actions go between the variables and the statements.
void Converter::printChart(sema::PouId id, const PouDecl& decl) {
  const sema::Pou& pou = compilation_.project->pou(id);
  Body body{id, decl.body_begin, decl.body_end, decl.body_begin, true, statementsOfChart(pou, decl)};
  body.sections = sectionsOfChart(decl, chartVariablesOfBases(id), body.taken);
  body.suffix = compilation_.names.string(decl.name);
  body.text = renamed(body.text, body.taken, body.suffix);
  body.sections = renamed(body.sections, body.taken, body.suffix);
  for (const DeclId member : compilation_.tree.list(decl.members)) {
    if (compilation_.tree.kind(member) != DeclKind::Pou) continue;
    const PouDecl& action = compilation_.tree.as<PouDecl>(member);
    if (decl.body_begin <= action.h.begin && action.h.begin < decl.body_end) body.actions.push_back(member);
  }
  for (const DeclId member : compilation_.tree.list(decl.members))
    body.declarations = std::min(body.declarations, compilation_.tree.decl(member).begin);
  if (body.text.ends_with('\n')) body.text.pop_back();
  bodies_.push_back(std::move(body));
  if (pou.owner) printConditions(pou.owner);
}

// Conditions in the actions of a POU without a chart: a variable and an action each.
void Converter::printConditions(sema::PouId id) {
  const sema::Pou& pou = compilation_.project->pou(id);
  const PouDecl& decl = compilation_.tree.as<PouDecl>(pou.decl);
  if (decl.transitions.empty() || !decl.steps.empty() || !conditions_done_.insert(decl.h.begin.offset).second) return;
  Body variables{{}, decl.body_begin, {}, {}, true, {}};
  for (const DeclId member : compilation_.tree.list(decl.members))
    if (compilation_.tree.kind(member) == DeclKind::Pou)
      variables.begin = std::min(variables.begin, compilation_.tree.decl(member).begin);
  for (const SfcTransition& t : compilation_.tree.list(decl.transitions)) {
    variables.begin = std::min(variables.begin, t.begin);
    Body body{{}, t.begin, t.end, t.begin, true, {}};
    body.actions.push_back(t.body);
    bodies_.push_back(std::move(body));
  }
  variables.end = variables.declarations = variables.begin;
  variables.text = sectionsOfChart(decl, {}, variables.taken);
  bodies_.push_back(std::move(variables));
}

// An action that the parser made of a transition has only a body: instructions, statements, or the expression to
// assign.
std::string Converter::action(DeclId id) const {
  const Tree& tree = compilation_.tree;
  const PouDecl& decl = tree.as<PouDecl>(id);
  if (decl.h.begin != decl.body_begin) return convert(decl.h.begin, decl.h.end) + "\n";
  std::string text = "ACTION " + std::string(compilation_.names.string(decl.name)) + ":\n";
  std::string body = convert(decl.body_begin, decl.body_end);
  Slice<StmtId> statements = decl.body;
  for (const Body& converted : bodies_) {
    const sema::Pou& pou = compilation_.project->pou(converted.pou);
    if (pou.decl != id) continue;
    body = temporaries(converted) + converted.text;
    statements = pou.body.statements;
  }
  const StmtId first = statements.empty() ? StmtId{} : tree.list(statements)[0];
  if (first && tree.loc(first) == decl.body_begin && tree.kind(first) == StmtKind::Assign)
    text += std::string(compilation_.names.string(tree.as<NameExpr>(tree.as<AssignStmt>(first).target).name)) +
            " := " + body + ";";
  else
    text += body;
  return text + "\nEND_ACTION\n";
}

std::string Converter::temporaries(const Body& body) const {
  const sema::Project& project = *compilation_.project;
  const sema::Pou& pou = project.pou(body.pou);
  std::string lines;
  for (const sema::VarId id : pou.vars) {
    const sema::Var& var = project.var(id);
    if (var.temporary == 0) continue;
    lines += "  " + std::string(compilation_.names.string(var.name)) + " : " + project.types.toString(var.type) + ";\n";
  }
  if (lines.empty()) return {};
  const bool function = pou.kind == PouKind::Function || pou.kind == PouKind::Method;
  return std::string(function ? "VAR\n" : "VAR_TEMP\n") + lines + "END_VAR\n";
}

std::string Converter::convert(FileId file) const {
  const Loc begin = sources_.begin(file);
  return convert(begin, {begin.offset + static_cast<uint32_t>(sources_.original(file).size())});
}

// A part of a file, with its bodies converted.
std::string Converter::convert(Loc begin, Loc end) const {
  const FileId file = sources_.fileOf(begin);
  const std::string_view text = sources_.original(file).substr(0, end.offset - sources_.begin(file).offset);
  const uint32_t base = sources_.begin(file).offset;
  std::vector<const Body*> bodies;
  for (const Body& body : bodies_)
    if (!(body.begin < begin) && !(end < body.end)) bodies.push_back(&body);
  std::stable_sort(bodies.begin(), bodies.end(), [](const Body* a, const Body* b) {
    return a->begin != b->begin ? a->begin < b->begin : a->end < b->end;
  });
  std::vector<Edit> edits;
  for (const Edit& edit : hidden_)
    if (!(edit.begin < begin) && edit.begin < end) edits.push_back(edit);
  Loc done_to = begin;
  for (const Body* body : bodies) {
    if (body->begin < done_to) continue;  // of an action in a chart, converted with it
    done_to = body->end;
    std::string declared = temporaries(*body);
    if (!body->sections.empty() || !body->actions.empty()) {
      std::string actions;
      for (const DeclId member : body->actions) actions += action(member);
      if (!body->taken.empty()) actions = renamed(actions, body->taken, body->suffix);
      declared.insert(0, body->sections);
      if (body->declarations != body->begin)
        edits.push_back({body->declarations, body->declarations, std::exchange(declared, {}), true});
      edits.push_back({body->begin, body->end, declared + actions + body->text, true});
      continue;
    }
    if (!declared.empty() && body->declarations == body->begin && !body->own_line) {
      declared.insert(0, 1, '\n');
      declared.pop_back();
    }
    edits.push_back({body->declarations, body->declarations, std::move(declared)});
    edits.push_back({body->begin, body->end, body->text});
  }
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  std::string out;
  size_t done = begin.offset - base;
  for (const Edit& edit : edits) {
    out += text.substr(done, edit.begin.offset - base - done);
    if (edit.begins_line) {
      while (out.ends_with(' ')) out.pop_back();
      if (!out.empty() && !out.ends_with('\n')) out += '\n';
    }
    out += edit.text;
    done = edit.end.offset - base;
  }
  return out + std::string(text.substr(done));
}

// rung.project without the list of its sources: the folder has no others.
std::string projectContent(std::string_view text) {
  std::string out;
  for (size_t p = 0; p < text.size();) {
    const size_t end = std::min(text.find('\n', p), text.size() - 1) + 1;
    const std::string_view line = text.substr(p, end - p);
    const size_t word = std::min(line.find_first_not_of(" \t"), line.size());
    const size_t after = line.find_first_of(" \t=", word);
    if (line.substr(word, after - word) != "sources") out += line;
    p = end;
  }
  return out;
}

// Tells whether a file becomes a folder: that of a tool which keeps a project in one file, or any other on request.
bool Converter::becomesFolder(const InputFile& input) const {
  return importer::formatOf(input.kind).has(importer::kHoldsProject) || splits_;
}

// One file for each declaration, below `folder`; false: the file stays whole.
bool Converter::split(const InputFile& input, const std::string& folder, std::vector<TextFile>& out) const {
  if (!becomesFolder(input)) return false;
  const std::vector<FileUnit>& units = compilation_.tree.files;
  const auto unit = std::find_if(units.begin(), units.end(), [&](const FileUnit& u) { return u.file == input.file; });
  if (unit == units.end()) return false;
  const std::vector<FilePart> parts =
      declarationFiles(compilation_.tree, compilation_.names, sources_, *unit, listNameOf(input.below));
  if (parts.size() < 2) return false;
  std::unordered_map<std::string, size_t> made;  // by name: names differ by more than their case
  for (const FilePart& part : parts) {
    std::string text = convert(part.begin, part.end);
    text.erase(0, std::min(text.find_first_not_of("\r\n"), text.size()));
    if (!text.ends_with('\n')) text += '\n';
    const auto [at, is_new] = made.emplace(upper(part.name), out.size());
    if (is_new)
      out.push_back({folder + part.name + ".st", std::move(text)});
    else
      out[at->second].text += '\n' + text;
  }
  return true;
}

std::vector<TextFile> Converter::outputs() {
  std::vector<TextFile> out;
  std::unordered_set<std::string> taken;
  size_t count = 0;
  for (const InputFile& input : compilation_.inputs.files) {
    if (fs::path(input.below).extension() == ".st") taken.insert(input.below);
    if (!input.is_library) ++count;
  }
  for (const InputFile& input : compilation_.inputs.files) {
    if (input.is_library) continue;
    std::string path = input.below;
    const std::string stem = fs::path(path).replace_extension().generic_string();
    if (split(input, count == 1 ? "" : stem + "/", out)) {
      is_split_ = true;
      continue;
    }
    if (fs::path(path).extension() != ".st") {
      path = stem + ".st";
      for (uint32_t n = 2; !taken.insert(path).second; ++n) path = stem + "_" + std::to_string(n) + ".st";
    }
    out.push_back({path, convert(input.file)});
  }
  return out;
}

// A folder of ST needs this besides its files, as sections of rung.project: the memory of an NCT control, which a
// ladder brings with it.
std::string settingsOf(const Compilation& compilation) {
  const ProjectFile& project = compilation.inputs.project;
  std::string settings;
  if (project.file) settings = projectContent(compilation.sources.original(project.file));
  const std::vector<InputFile>& files = compilation.inputs.files;
  const bool has_ladder = std::any_of(files.begin(), files.end(), [](const InputFile& input) {
    return importer::formatOf(input.kind).has(importer::kHasControl);
  });
  const bool has_section = std::any_of(project.sections.begin(), project.sections.end(),
                                       [](const ProjectSection& section) { return section.kind == "nct"; });
  if (has_ladder && !has_section) settings += "\n[nct]\n";
  return settings;
}

// Without a configuration programs run in the order of their files, which splitting changes: a task that keeps it.
std::string Converter::taskOfPrograms() const {
  const sema::Project& project = *compilation_.project;
  if (!is_split_ || project.instances.size() < 2 || compilation_.inputs.project.configuration) return {};
  for (const FileUnit& unit : compilation_.tree.files)
    for (const DeclId decl : compilation_.tree.list(unit.decls))
      if (compilation_.tree.kind(decl) == DeclKind::Configuration) return {};
  std::string programs;
  for (const sema::ProgramInstance& instance : project.instances)
    programs += (programs.empty() ? "" : ", ") + std::string(compilation_.names.string(instance.name));
  return "\n[task MainTask]\ninterval = 10ms\npriority = 1\nprograms = " + programs + "\n";
}

// The name of the single file: that of the project's folder, or of its only file.
std::string projectName(const Compilation& compilation) {
  const InputFile* only = nullptr;
  size_t count = 0;
  for (const InputFile& input : compilation.inputs.files) {
    if (input.is_library) continue;
    only = &input;
    ++count;
  }
  const fs::path path = count == 1 ? fs::path(only->below).stem() : fs::path(compilation.inputs.root).filename();
  return path.empty() ? "project" : path.generic_string();
}

std::string projectXml(Compilation& compilation) {
  std::vector<FileUnit> units;  // rung.project keeps its own settings
  for (const FileUnit& unit : compilation.tree.files)
    if (std::any_of(compilation.inputs.files.begin(), compilation.inputs.files.end(),
                    [&](const InputFile& input) { return input.file == unit.file && !input.is_library; }))
      units.push_back(unit);
  return exporter::writeProject({compilation.tree, compilation.names, compilation.sources, units},
                                projectName(compilation), compilation.diagnostics);
}

// The message file of the ladder; no file: there are no messages.
std::optional<TextFile> messageFile(const Inputs& inputs) {
  if (inputs.messages.empty()) return {};
  std::vector<importer::Message> messages = inputs.messages;
  std::sort(messages.begin(), messages.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  std::string text;
  for (const importer::Message& message : messages) text += std::to_string(message.number) + '\t' + message.text + '\n';
  const auto ladder = std::find_if(inputs.files.begin(), inputs.files.end(), [](const InputFile& input) {
    return importer::formatOf(input.kind).has(importer::kHasControl);
  });
  return TextFile{fs::path(ladder->below).stem().generic_string() + ".mes", std::move(text)};
}

// The output folder must differ from that of the sources, or the next run would read both.
std::string refusal(const Compilation& compilation, const std::string& output) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(output, error);
  const fs::path root = fs::weakly_canonical(compilation.inputs.root, error);
  if (folder != root) return {};
  return "`-o " + output + "` is the folder of the sources; use another one";
}

}  // namespace

int runConvert(const ProjectOptions& project, const ConvertOptions& options, Sink& sink) {
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  std::optional<Converter> converter;
  std::vector<TextFile> outputs;
  if (options.to == ConvertTo::St) converter.emplace(compilation, options.splits);
  if (options.to == ConvertTo::Xml)
    compilation.parsed = [&] { outputs.push_back({projectName(compilation) + ".xml", projectXml(compilation)}); };
  if (compilation.check()) {
    times.begin("print");
    if (converter) outputs = converter->outputs();
    if (options.to == ConvertTo::Messages) {
      if (std::optional<TextFile> messages = messageFile(compilation.inputs)) outputs.push_back(std::move(*messages));
    } else {
      std::string settings = settingsOf(compilation);
      if (converter) settings += converter->taskOfPrograms();
      settings.erase(0, std::min(settings.find_first_not_of('\n'), settings.size()));
      if (compilation.inputs.project.file || !settings.empty())
        outputs.push_back({"rung.project", std::move(settings)});
    }
    times.end();
  }
  int exit = compilation.finish();
  if (exit == kSuccess)
    if (const std::string problem = refusal(compilation, options.output); !problem.empty())
      exit = usageError(sink, problem);
  if (exit == kSuccess && outputs.empty()) exit = usageError(sink, "no messages to write: no ladder has any");
  if (exit == kSuccess) exit = writeFiles(options.output, outputs, sink);
  return exit;
}

}  // namespace rung::driver

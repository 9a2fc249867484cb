// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/declaration_edits.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "frontend/source/scanner.h"
#include "frontend/source/source_around.h"

namespace rung {
namespace {

size_t beginOfLine(const SourceAround& text, size_t at) {
  while (at > 0 && text[at - 1] != '\n') --at;
  return at;
}

size_t endOfLine(const SourceAround& text, size_t at) {
  while (at < text.size() && text[at] != '\n') ++at;
  return at;
}

bool isFirstOnLine(const SourceAround& text, size_t at) {
  while (at > 0 && text.isSpace(at - 1)) --at;
  return at == 0 || text[at - 1] == '\n';
}

bool hasComment(std::string_view source) {
  Scanner scanner(source);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
    if (unit.kind == UnitKind::Comment || unit.kind == UnitKind::Pragma) return true;
  return false;
}

// The section whose only declaration this is; none: it has others.
DeclId sectionOnlyFor(const Tree& tree, const PouDecl& pou, DeclId decl) {
  for (const DeclId section : tree.list(pou.sections)) {
    const std::span<const DeclId> vars = tree.list(tree.as<SectionDecl>(section).vars);
    if (vars.size() == 1 && vars[0] == decl) return section;
  }
  return {};
}

// One of several names before the colon, with a comma beside it.
Fix::Edit withoutName(const SourceAround& text, std::span<const Ident> names, size_t index, size_t length) {
  const size_t at = text.at(names[index].loc);
  if (index + 1 < names.size()) return {names[index].loc, names[index + 1].loc, {}};
  size_t begin = at;
  while (begin > 0 && text[begin - 1] != ',') --begin;
  return {text.loc(begin == 0 ? at : begin - 1), text.loc(at + length), {}};
}

// The keyword END_VAR of a section; none: it is missing or was not written.
Loc endVarOf(const SourceAround& text, const SectionDecl& section) {
  constexpr std::string_view kEnd = "END_VAR";
  const size_t end = text.at(section.h.end);
  if (end > text.size() || end < kEnd.size()) return {};
  const size_t at = end - kEnd.size();
  return sameIdentifier(text.source().substr(at, kEnd.size()), kEnd) ? text.loc(at) : Loc{};
}

const char* wordOf(SectionKind section) {
  if (section == SectionKind::Input) return "VAR_INPUT";
  return section == SectionKind::Global ? "VAR_GLOBAL" : "VAR";
}

// None: it has no header of its own, as GET of a property.
Loc endOfHeader(const Written& written, const PouDecl& pou) {
  const std::string_view name = written.names.string(pou.name);
  Loc end{pou.h.loc.offset + static_cast<uint32_t>(name.size())};
  if (!sameIdentifier(sourceText(written.sources, {pou.h.loc, end}), name)) return {};
  const auto extend = [&](TypeExprId type) {
    if (type) end = std::max(end, written.tree.range(type).end);
  };
  extend(pou.result);
  for (const TypeExprId base : written.tree.list(pou.bases)) extend(base);
  for (const TypeExprId implemented : written.tree.list(pou.implements)) extend(implemented);
  const SourceAround text(written.sources, end);
  size_t at = text.at(end);
  while (text.isSpace(at)) ++at;
  return text[at] == ';' ? text.loc(at + 1) : end;
}

}  // namespace

const SectionDecl* findSection(const Written& written, Slice<DeclId> declarations, SectionKind kind) {
  const SectionDecl* found = nullptr;
  for (const DeclId id : written.tree.list(declarations)) {
    if (written.tree.kind(id) != DeclKind::Section) continue;
    const SectionDecl& section = written.tree.as<SectionDecl>(id);
    if (section.section == kind && section.qualifiers == Qualifiers{} && section.maker == SectionMaker::None)
      found = &section;
  }
  return found;
}

Fix::Edit declarationIn(const Written& written, const SectionDecl& section, const std::string& variable) {
  const SourceAround text(written.sources, section.h.loc);
  const Loc end = section.h.end ? endVarOf(text, section) : Loc{};
  if (!end) return {};
  const size_t at = text.at(end);
  if (!isFirstOnLine(text, at)) {
    const bool is_apart = at > 0 && isBlankCharacter(text[at - 1]);
    return {end, end, (is_apart ? "" : " ") + variable + "; "};
  }
  std::string indent = indentAt(written.sources, end) + "  ";
  const std::span<const DeclId> vars = written.tree.list(section.vars);
  if (!vars.empty()) indent = indentAt(written.sources, written.tree.decl(vars.back()).begin);
  const Loc line = text.loc(beginOfLine(text, at));
  return {line, line, indent + variable + ";\n"};
}

Fix::Edit declarationIn(const Written& written, const PouDecl& pou, SectionKind kind, const std::string& variable) {
  if (const SectionDecl* found = findSection(written, pou.sections, kind))
    return declarationIn(written, *found, variable);
  const Loc at = kind == SectionKind::Input ? endOfHeader(written, pou) : endOfSections(written, pou);
  if (!at) return {};
  const std::string indent = indentAt(written.sources, pou.h.loc);
  return {at, at, "\n" + indent + wordOf(kind) + "\n" + indent + "  " + variable + ";\n" + indent + "END_VAR"};
}

Removal declarationGone(const Written& written, const PouDecl& pou, DeclId id, Loc name) {
  const Tree& tree = written.tree;
  if (tree.kind(id) != DeclKind::Var) return {};
  const VarDecl& decl = tree.as<VarDecl>(id);
  const SourceAround text(written.sources, name);
  const std::span<const Ident> names = tree.list(decl.names);
  if (names.size() > 1) {
    const auto at = std::find_if(names.begin(), names.end(), [&](const Ident& one) { return one.loc == name; });
    if (at == names.end()) return {};
    const size_t length = written.names.string(at->name).size();
    Removal removal{withoutName(text, names, static_cast<size_t>(at - names.begin()), length)};
    removal.has_comment = hasComment(sourceText(written.sources, {removal.edit.begin, removal.edit.end}));
    return removal;
  }
  const DeclId section = sectionOnlyFor(tree, pou, id);
  const DeclHeader& gone = section ? tree.decl(section) : decl.h;
  if (!gone.begin || !gone.end) return {};
  const size_t begin = text.at(gone.begin), end = section ? text.at(gone.end) : text.pastSemicolon(text.at(gone.end));
  if (end > text.size() || begin >= end) return {};
  const Range range = withBlanks(written.sources, {text.loc(begin), text.loc(end)});
  const bool has_comment =
      hasComment(text.source().substr(begin, endOfLine(text, end) - begin)) || !decl.h.pragmas.empty() || decl.h.doc;
  return {{range.begin, range.end, {}}, has_comment};
}

Loc endOfSections(const Written& written, const PouDecl& pou) {
  Loc end = endOfHeader(written, pou);
  for (const DeclId id : written.tree.list(pou.sections)) {
    const SectionDecl& section = written.tree.as<SectionDecl>(id);
    if (section.maker == SectionMaker::None) end = std::max(end, section.h.end);
  }
  return end;
}

std::string indentAt(const Sources& sources, Loc loc) {
  const SourceAround text(sources, loc);
  if (!loc) return {};
  const size_t line = beginOfLine(text, text.at(loc));
  size_t end = line;
  while (text.isSpace(end)) ++end;
  return std::string(text.source().substr(line, end - line));
}

Range withBlanks(const Sources& sources, Range range) {
  const SourceAround text(sources, range.begin);
  size_t begin = text.at(range.begin), end = text.at(range.end), line_end = end;
  while (text.isSpace(line_end)) ++line_end;
  if (text[line_end] == '\r') ++line_end;
  if (isFirstOnLine(text, begin) && text[line_end] == '\n')
    return {text.loc(beginOfLine(text, begin)), text.loc(std::min(line_end + 1, text.size()))};
  while (text.isSpace(end)) ++end;
  if (text[line_end] == '\n')
    while (begin > 0 && text.isSpace(begin - 1)) --begin;
  return {text.loc(begin), text.loc(end)};
}

std::string sourceText(const Sources& sources, Range range) {
  const SourceAround text(sources, range.begin);
  if (range.end <= range.begin || text.at(range.end) > text.size()) return {};
  return std::string(text.source().substr(text.at(range.begin), range.end.offset - range.begin.offset));
}

bool isWholeSource(const Sources& sources, Loc loc) {
  const Loc copied = sources.copiedFrom(loc);
  if (!copied) return false;
  return sources.editedFile(sources.fileOf(loc)) == sources.fileOf(copied);
}

}  // namespace rung

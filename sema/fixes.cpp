// SPDX-License-Identifier: Apache-2.0
#include "sema/fixes.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {
namespace {

// The source around a location, as text and offsets.
struct Text {
  std::string_view source;
  uint32_t base = 0;

  size_t at(Loc loc) const { return loc.offset - base; }
  Loc loc(size_t at) const { return {base + static_cast<uint32_t>(at)}; }
  size_t size() const { return source.size(); }
  char operator[](size_t at) const { return at < source.size() ? source[at] : '\n'; }
};

Text textAt(const Context& context, Loc loc) {
  const Sources& sources = context.symbols.sources;
  const FileId file = sources.fileOf(loc);
  if (!file) return {};
  return {sources.original(file), sources.begin(file).offset};
}

bool isSpace(char c) { return c == ' ' || c == '\t'; }

size_t beginOfLine(const Text& text, size_t at) {
  while (at > 0 && text[at - 1] != '\n') --at;
  return at;
}

size_t endOfLine(const Text& text, size_t at) {
  while (at < text.size() && text[at] != '\n') ++at;
  return at;
}

bool isFirstOnLine(const Text& text, size_t at) {
  while (at > 0 && isSpace(text[at - 1])) --at;
  return at == 0 || text[at - 1] == '\n';
}

// ---- expressions

// How many `)` of a source have their `(` before it.
size_t closedBefore(std::string_view source) {
  size_t open = 0, closed = 0;
  Scanner scanner(source);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next()) {
    const std::string_view sign = scanner.textOf(unit);
    if (sign == "(") ++open;
    if (sign == ")" && open > 0)
      --open;
    else if (sign == ")")
      ++closed;
  }
  return closed;
}

// ---- declarations

// Of the source of a declaration: the end with its `;`.
size_t pastSemicolon(const Text& text, size_t end) {
  size_t at = end;
  while (at < text.size() && isBlankCharacter(text[at])) ++at;
  return text[at] == ';' && (end == 0 || text[end - 1] != ';') ? at + 1 : end;
}

// What to take away so that no blank line stays. A comment on the line stays.
Range withBlanks(const Text& text, size_t begin, size_t end) {
  size_t line_end = end;
  while (isSpace(text[line_end])) ++line_end;
  if (text[line_end] == '\r') ++line_end;
  if (isFirstOnLine(text, begin) && text[line_end] == '\n')
    return {text.loc(beginOfLine(text, begin)), text.loc(std::min(line_end + 1, text.size()))};
  while (isSpace(text[end])) ++end;
  if (text[line_end] == '\n')
    while (begin > 0 && isSpace(text[begin - 1])) --begin;
  return {text.loc(begin), text.loc(end)};
}

bool hasComment(std::string_view source) {
  Scanner scanner(source);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
    if (unit.kind == UnitKind::Comment || unit.kind == UnitKind::Pragma) return true;
  return false;
}

// An initial value that only writes a number, a text or a name.
bool isPlain(const Tree& tree, ExprId init) {
  if (!init) return true;
  const ExprKind kind = tree.kind(init);
  return kind == ExprKind::Literal || kind == ExprKind::Name || kind == ExprKind::TypedName || kind == ExprKind::Unary;
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
Fix::Edit withoutName(const Text& text, std::span<const Ident> names, size_t index, size_t length) {
  const size_t at = text.at(names[index].loc);
  if (index + 1 < names.size()) return {names[index].loc, names[index + 1].loc, {}};
  size_t begin = at;
  while (begin > 0 && text[begin - 1] != ',') --begin;
  return {text.loc(begin == 0 ? at : begin - 1), text.loc(at + length), {}};
}

// The keyword END_VAR of a section; none: it is missing or was not written.
Loc endWordOf(const Text& text, const SectionDecl& section) {
  constexpr std::string_view kEnd = "END_VAR";
  const size_t end = text.at(section.h.end);
  if (end > text.size() || end < kEnd.size()) return {};
  const size_t at = end - kEnd.size();
  return sameIdentifier(text.source.substr(at, kEnd.size()), kEnd) ? text.loc(at) : Loc{};
}

const char* wordOf(SectionKind section) {
  if (section == SectionKind::Input) return "VAR_INPUT";
  if (section == SectionKind::Global) return "VAR_GLOBAL";
  return "VAR";
}

bool isPlainSection(const SectionDecl& section, SectionKind kind) {
  return section.section == kind && section.qualifiers == Qualifiers{} && section.maker == SectionMaker::None;
}

// The declaration as the last one of a section.
Fix::Edit inSection(const Context& context, const SectionDecl& section, const NewVariable& variable) {
  const Text text = textAt(context, section.h.loc);
  const Loc end = section.h.end ? endWordOf(text, section) : Loc{};
  if (!end) return {};
  const std::string declaration = variable.name + " : " + variable.type + ";";
  const size_t at = text.at(end);
  if (!isFirstOnLine(text, at)) {
    const bool is_apart = at > 0 && isBlankCharacter(text[at - 1]);
    return {end, end, (is_apart ? "" : " ") + declaration + " "};
  }
  std::string indent = indentAt(context, end) + "  ";
  const std::span<const DeclId> vars = context.tree().list(section.vars);
  if (!vars.empty()) indent = indentAt(context, context.tree().decl(vars.back()).begin);
  const Loc line = text.loc(beginOfLine(text, at));
  return {line, line, indent + declaration + "\n"};
}

Loc endOfHeader(const Context& context, const PouDecl& pou) {
  Loc end{pou.h.loc.offset + static_cast<uint32_t>(string(context, pou.name).size())};
  const auto extend = [&](TypeExprId type) {
    if (type) end = std::max(end, context.tree().range(type).end);
  };
  extend(pou.result);
  for (const TypeExprId base : context.tree().list(pou.bases)) extend(base);
  for (const TypeExprId implemented : context.tree().list(pou.implements)) extend(implemented);
  const Text text = textAt(context, end);
  size_t at = text.at(end);
  while (isSpace(text[at])) ++at;
  return text[at] == ';' ? text.loc(at + 1) : end;
}

const SectionDecl* findSection(const Context& context, std::span<const DeclId> sections, SectionKind kind) {
  const SectionDecl* found = nullptr;
  for (const DeclId id : sections) {
    if (context.tree().kind(id) != DeclKind::Section) continue;
    const SectionDecl& section = context.tree().as<SectionDecl>(id);
    if (isPlainSection(section, kind)) found = &section;
  }
  return found;
}

// The POU that has the sections which a body sees.
PouId declaringPou(const Context& context, PouId pou) {
  const Pou& of = context.symbols.pou(pou);
  return of.kind == PouKind::Action && of.owner ? of.owner : pou;
}

}  // namespace

Range sourceRange(const Context& context, ExprId expr) {
  const ExprHeader& header = context.tree().expr(expr);
  Loc begin = context.tree().begin(expr);
  if (!begin || !header.end || header.end <= begin) return {};
  const Text text = textAt(context, begin);
  size_t at = text.at(begin);
  if (text.at(header.end) > text.size()) return {};
  for (size_t closed = closedBefore(text.source.substr(at, header.end.offset - begin.offset)); closed > 0; --closed) {
    do {
      if (at == 0) return {};
      --at;
    } while (isBlankCharacter(text[at]));
    if (text[at] != '(') return {};
  }
  return {text.loc(at), header.end};
}

std::string sourceText(const Context& context, Range range) {
  const Text text = textAt(context, range.begin);
  if (range.end <= range.begin || text.at(range.end) > text.size()) return {};
  return std::string(text.source.substr(text.at(range.begin), range.end.offset - range.begin.offset));
}

Fix callAround(const Context& context, ExprId expr, const std::string& function) {
  if (context.tree().kind(expr) == ExprKind::Assign) return {};  // which needs parentheses of its own
  const Range range = sourceRange(context, expr);
  Fix fix{"Write `" + function + "(...)`", {}, false};
  if (range.begin < range.end) fix.edits = {{range.begin, range.begin, function + "("}, {range.end, range.end, ")"}};
  return fix;
}

Fix exchanged(const Context& context, ExprId first, ExprId second) {
  const Range one = sourceRange(context, first), other = sourceRange(context, second);
  const std::string was = sourceText(context, one), is = sourceText(context, other);
  if (was.empty() || is.empty()) return {};
  return {"Exchange `" + was + "` and `" + is + "`", {{one.begin, one.end, is}, {other.begin, other.end, was}}, true};
}

Fix otherSign(const Context& context, Loc from, Loc to, std::string_view sign, std::string_view by, Sureness sureness) {
  const Text text = textAt(context, from);
  if (!from || !to || to <= from || text.at(to) > text.size()) return {};
  const size_t found = text.source.find(sign, text.at(from));
  if (found == std::string_view::npos || found >= text.at(to)) return {};
  return {"Write `" + std::string(by) + "`",
          {{text.loc(found), text.loc(found + sign.size()), std::string(by)}},
          sureness == Sureness::Sure};
}

Fix withoutArgument(const Context& context, const CallExpr& call, const Argument& argument) {
  const Range value = argument.value ? sourceRange(context, argument.value) : Range{argument.loc, argument.loc};
  const Loc begin = argument.pin.name ? std::min(argument.loc, argument.pin.loc) : value.begin;
  const Text text = textAt(context, begin);
  if (!begin || !(begin < value.end) || !call.end) return {};
  const std::string shown = sourceText(context, {begin, value.end});
  size_t from = text.at(begin), to = text.at(value.end);
  size_t before = from;
  while (before > 0 && isBlankCharacter(text[before - 1])) --before;
  if (before > 0 && text[before - 1] == ',') {
    from = before - 1;
  } else {
    size_t after = to;
    while (isBlankCharacter(text[after]) && after < text.size()) ++after;
    if (text[after] == ',') to = after + 1;
    while (text[after] == ',' && isSpace(text[to])) ++to;
  }
  return {"Remove `" + shown + "`", {{text.loc(from), text.loc(to), {}}}, false};
}

Fix withoutArguments(const Context& context, const CallExpr& call, const Argument& from) {
  Fix fix = withoutArgument(context, call, from);
  if (fix.edits.empty()) return fix;
  const Text text = textAt(context, call.end);
  if (text[text.at(call.end)] != ')' || !(fix.edits[0].begin < call.end)) return {};
  fix.edits[0].end = call.end;
  return fix;
}

Fix withoutStatement(const Context& context, Loc begin, Loc end) {
  const Text text = textAt(context, begin);
  if (!begin || end <= begin || text.at(end) > text.size()) return {};
  const size_t past = pastSemicolon(text, text.at(end));
  const Range range = withBlanks(text, text.at(begin), past);
  return {"Remove `" + sourceText(context, {begin, text.loc(past)}) + "`", {{range.begin, range.end, {}}}, false};
}

Fix withoutVariable(const Context& context, const Var& var) {
  if (!var.decl || !var.pou || context.tree().kind(var.decl) != DeclKind::Var) return {};
  const Tree& tree = context.tree();
  const VarDecl& decl = tree.as<VarDecl>(var.decl);
  const Text text = textAt(context, var.loc);
  const std::string name = toString(context, var.name);
  Fix fix{"Remove `" + name + "`", {}, false};
  const std::span<const Ident> names = tree.list(decl.names);
  if (names.size() > 1) {
    const auto at = std::find_if(names.begin(), names.end(), [&](const Ident& one) { return one.loc == var.loc; });
    if (at == names.end()) return {};
    fix.edits = {withoutName(text, names, static_cast<size_t>(at - names.begin()), name.size())};
    fix.is_sure = !hasComment(sourceText(context, {fix.edits[0].begin, fix.edits[0].end}));
    return fix;
  }
  const PouDecl& pou = tree.as<PouDecl>(context.symbols.pou(var.pou).decl);
  const DeclId section = sectionOnlyFor(tree, pou, var.decl);
  const DeclHeader& gone = section ? tree.decl(section) : decl.h;
  if (!gone.begin || !gone.end) return {};
  const size_t begin = text.at(gone.begin), end = section ? text.at(gone.end) : pastSemicolon(text, text.at(gone.end));
  if (end > text.size() || begin >= end) return {};
  const Range range = withBlanks(text, begin, end);
  const size_t line_end = endOfLine(text, end);
  const bool keeps_all = !hasComment(text.source.substr(begin, line_end - begin)) && decl.h.pragmas.empty() &&
                         !decl.h.doc && isPlain(tree, decl.init) && !var.keeping.retain && !var.keeping.persistent;
  fix.edits = {{range.begin, range.end, {}}};
  fix.is_sure = keeps_all;
  return fix;
}

Fix declaredInPou(const Context& context, PouId pou, SectionKind section, const NewVariable& variable) {
  const PouId id = declaringPou(context, pou);
  const Pou& owner = context.symbols.pou(id);
  if (owner.library || !owner.decl || context.tree().kind(owner.decl) != DeclKind::Pou || variable.type.empty())
    return {};
  const PouDecl& decl = context.tree().as<PouDecl>(owner.decl);
  const std::string as = section == SectionKind::Input ? " as an input of type " : " as ";
  Fix fix{"Declare `" + variable.name + "`" + as + variable.type, {}, false};
  if (const SectionDecl* found = findSection(context, context.tree().list(decl.sections), section)) {
    Fix::Edit edit = inSection(context, *found, variable);
    if (edit.begin) fix.edits.push_back(std::move(edit));
    return fix;
  }
  const bool comes_first = section == SectionKind::Input;
  const Loc at = comes_first ? endOfHeader(context, decl) : endOfSections(context, decl);
  const std::string indent = indentAt(context, decl.h.loc);
  if (at)
    fix.edits = {{at, at,
                  "\n" + indent + wordOf(section) + "\n" + indent + "  " + variable.name + " : " + variable.type +
                      ";\n" + indent + "END_VAR"}};
  return fix;
}

Fix declaredGlobally(const Context& context, PouId pou, const NewVariable& variable) {
  Fix fix{"Declare `" + variable.name + "` as a global variable of type " + variable.type, {}, false};
  const SectionDecl* found = nullptr;
  for (const FileUnit& unit : context.tree().files)
    if (const SectionDecl* section = findSection(context, context.tree().list(unit.decls), SectionKind::Global))
      if (found == nullptr || unit.file == context.file) found = section;
  if (found != nullptr) {
    Fix::Edit edit = inSection(context, *found, variable);
    if (edit.begin) fix.edits.push_back(std::move(edit));
    return fix;
  }
  PouId outer = pou;
  while (context.symbols.pou(outer).owner) outer = context.symbols.pou(outer).owner;
  const DeclId decl = context.symbols.pou(outer).decl;
  if (!decl || !isWholeSource(context, context.tree().decl(decl).begin)) return fix;
  const Loc at = context.tree().decl(decl).begin;
  const Text text = textAt(context, at);
  if (isFirstOnLine(text, text.at(at)))
    fix.edits = {{at, at, "VAR_GLOBAL\n  " + variable.name + " : " + variable.type + ";\nEND_VAR\n"}};
  return fix;
}

void addDeclarations(const Context& context, Report report, NameId name, TypeId type) {
  if (!report || !type || type == types::kError || !context.pou || context.library) return;
  const NewVariable variable{toString(context, name), context.types().toString(type)};
  report.fix(declaredInPou(context, context.pou, SectionKind::Local, variable));
  const PouKind kind = context.symbols.pou(context.pou).kind;
  if (kind != PouKind::Program) report.fix(declaredInPou(context, context.pou, SectionKind::Input, variable));
  report.fix(declaredGlobally(context, context.pou, variable));
}

void declareUnknown(const Context& context, ExprId name, TypeId type) {
  if (!name || context.tree().kind(name) != ExprKind::Name) return;
  const NameExpr& node = context.tree().as<NameExpr>(name);
  Diagnostic* const reported = context.symbols.diagnostics.reportedAt(diag::UnknownName, node.h.loc);
  if (reported == nullptr) return;
  for (const Fix& fix : reported->fixes)
    if (fix.title.starts_with("Declare ")) return;
  addDeclarations(context, Report(reported), node.name, type);
}

Loc endOfSections(const Context& context, const PouDecl& pou) {
  Loc end = endOfHeader(context, pou);
  for (const DeclId id : context.tree().list(pou.sections)) {
    const SectionDecl& section = context.tree().as<SectionDecl>(id);
    if (section.maker == SectionMaker::None) end = std::max(end, section.h.end);
  }
  return end;
}

std::string indentAt(const Context& context, Loc loc) {
  const Text text = textAt(context, loc);
  if (!loc) return {};
  const size_t line = beginOfLine(text, text.at(loc));
  size_t end = line;
  while (isSpace(text[end])) ++end;
  return std::string(text.source.substr(line, end - line));
}

bool isWholeSource(const Context& context, Loc loc) {
  const Sources& sources = context.symbols.sources;
  const Loc copied = sources.copiedFrom(loc);
  if (!copied) return false;
  return sources.editedFile(sources.fileOf(loc)) == sources.fileOf(copied);
}

}  // namespace rung::sema

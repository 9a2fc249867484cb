// SPDX-License-Identifier: Apache-2.0
#include "sema/fixes.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "frontend/source/source_around.h"
#include "frontend/syntax/declaration_edits.h"
#include "sema/diagnostics.h"
#include "sema/shorthands.h"

namespace rung::sema {
namespace {

Written writtenIn(const Context& context) { return {context.symbols.sources, context.tree(), context.names()}; }

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

// A word or sign between two places, outside of comments; none: it is not there.
Loc findUnit(const Context& context, Loc from, Loc to, std::string_view word) {
  const SourceAround text(context.symbols.sources, from);
  if (!from || to <= from || text.at(to) > text.size()) return {};
  Scanner scanner(text.source().substr(0, text.at(to)));
  scanner.moveTo(text.at(from));
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    const std::string_view found = scanner.textOf(unit);
    if (sameIdentifier(found, word)) return text.loc(unit.begin);
    if (word.size() == 2 && found == word.substr(0, 1) && text[unit.end] == word[1]) return text.loc(unit.begin);  // :=
  }
  return {};
}

Loc beginWithBlanks(const Context& context, Loc loc) {
  const SourceAround text(context.symbols.sources, loc);
  size_t at = text.at(loc);
  while (at > 0 && text.isSpace(at - 1)) --at;
  return text.loc(at);
}

// ---- declarations

// An initial value that only writes a number, a text or a name.
bool isPlain(const Tree& tree, ExprId init) {
  if (!init) return true;
  const ExprKind kind = tree.kind(init);
  return kind == ExprKind::Literal || kind == ExprKind::Name || kind == ExprKind::TypedName || kind == ExprKind::Unary;
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
  const SourceAround text(context.symbols.sources, begin);
  size_t at = text.at(begin);
  if (text.at(header.end) > text.size()) return {};
  for (size_t closed = closedBefore(text.source().substr(at, header.end.offset - begin.offset)); closed > 0; --closed) {
    do {
      if (at == 0) return {};
      --at;
    } while (isBlankCharacter(text[at]));
    if (text[at] != '(') return {};
  }
  return {text.loc(at), header.end};
}

std::string sourceText(const Context& context, Range range) { return rung::sourceText(context.symbols.sources, range); }

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
  const SourceAround text(context.symbols.sources, from);
  if (!from || !to || to <= from || text.at(to) > text.size()) return {};
  const size_t found = text.source().find(sign, text.at(from));
  if (found == std::string_view::npos || found >= text.at(to)) return {};
  return {"Write `" + std::string(by) + "`",
          {{text.loc(found), text.loc(found + sign.size()), std::string(by)}},
          sureness == Sureness::Sure};
}

Fix withoutWord(const Context& context, Loc from, Loc to, std::string_view word, Sureness sureness) {
  const Loc found = findUnit(context, from, to, word);
  if (!found) return {};
  const Loc end{found.offset + static_cast<uint32_t>(word.size())};
  return {
      "Remove `" + std::string(word) + "`", {{beginWithBlanks(context, found), end, {}}}, sureness == Sureness::Sure};
}

Fix otherWord(const Context& context, Loc from, Loc to, std::string_view word, std::string_view by, Sureness sureness) {
  const Loc found = findUnit(context, from, to, word);
  if (!found) return {};
  const Loc end{found.offset + static_cast<uint32_t>(word.size())};
  return {"Write `" + std::string(by) + "`", {{found, end, std::string(by)}}, sureness == Sureness::Sure};
}

Fix withoutPart(const Context& context, Loc from, std::string_view sign, Loc end) {
  const Loc found = findUnit(context, from, end, sign);
  if (!found) return {};
  const Range part{found, end};
  return {"Remove `" + sourceText(context, part) + "`", {{beginWithBlanks(context, found), end, {}}}, false};
}

Fix withPragma(const Context& context, DeclId decl, std::string_view pragma) {
  const Loc at = decl ? context.tree().decl(decl).begin : Loc{};
  if (!at) return {};
  return {"Write `" + std::string(pragma) + "`", {{at, at, std::string(pragma) + "\n" + indentAt(context, at)}}, false};
}

Fix withoutArgument(const Context& context, const CallExpr& call, const Argument& argument) {
  const Range value = argument.value ? sourceRange(context, argument.value) : Range{argument.loc, argument.loc};
  const Loc begin = argument.pin.name ? std::min(argument.loc, argument.pin.loc) : value.begin;
  const SourceAround text(context.symbols.sources, begin);
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
    while (text[after] == ',' && text.isSpace(to)) ++to;
  }
  return {"Remove `" + shown + "`", {{text.loc(from), text.loc(to), {}}}, false};
}

Fix withoutArguments(const Context& context, const CallExpr& call, const Argument& from) {
  Fix fix = withoutArgument(context, call, from);
  if (fix.edits.empty()) return fix;
  const SourceAround text(context.symbols.sources, call.end);
  if (text[text.at(call.end)] != ')' || !(fix.edits[0].begin < call.end)) return {};
  fix.edits[0].end = call.end;
  return fix;
}

Fix withoutStatement(const Context& context, Loc begin, Loc end) {
  const SourceAround text(context.symbols.sources, begin);
  if (!begin || end <= begin || text.at(end) > text.size()) return {};
  const size_t past = text.pastSemicolon(text.at(end));
  const Range range = withBlanks(context.symbols.sources, {begin, text.loc(past)});
  return {"Remove `" + sourceText(context, {begin, text.loc(past)}) + "`", {{range.begin, range.end, {}}}, false};
}

Fix withoutVariable(const Context& context, const Var& var) {
  if (!var.decl || !var.pou || context.tree().kind(var.decl) != DeclKind::Var) return {};
  const Pou& owner = context.symbols.pou(var.pou);
  if (!owner.decl || context.tree().kind(owner.decl) != DeclKind::Pou) return {};
  const Removal removal =
      declarationGone(writtenIn(context), context.tree().as<PouDecl>(owner.decl), var.decl, var.loc);
  if (!removal.edit.begin) return {};
  const bool is_alone = context.tree().as<VarDecl>(var.decl).names.count == 1;
  const bool loses =
      removal.has_comment || (is_alone && !isPlain(context.tree(), context.tree().as<VarDecl>(var.decl).init));
  return {"Remove `" + toString(context, var.name) + "`",
          {removal.edit},
          !loses && !var.keeping.retain && !var.keeping.persistent};
}

Fix declaredInPou(const Context& context, PouId pou, SectionKind section, const NewVariable& variable) {
  const Pou& owner = context.symbols.pou(declaringPou(context, pou));
  if (owner.library || !owner.decl || context.tree().kind(owner.decl) != DeclKind::Pou || variable.type.empty())
    return {};
  const PouDecl& decl = context.tree().as<PouDecl>(owner.decl);
  const std::string as = section == SectionKind::Input ? " as an input of type " : " as ";
  Fix::Edit edit = declarationIn(writtenIn(context), decl, section, variable.name + " : " + variable.type);
  if (!edit.begin) return {};
  return {"Declare `" + variable.name + "`" + as + variable.type, {std::move(edit)}, false};
}

Fix declaredGlobally(const Context& context, PouId pou, const NewVariable& variable) {
  const std::string title = "Declare `" + variable.name + "` as a global variable of type " + variable.type;
  const std::string declaration = variable.name + " : " + variable.type;
  const Written written = writtenIn(context);
  const SectionDecl* found = nullptr;
  for (const FileUnit& unit : context.tree().files)
    if (const SectionDecl* section = findSection(written, unit.decls, SectionKind::Global))
      if (found == nullptr || unit.file == context.file) found = section;
  if (found != nullptr) {
    Fix::Edit edit = declarationIn(written, *found, declaration);
    return edit.begin ? Fix{title, {std::move(edit)}, false} : Fix{};
  }
  PouId outer = pou;
  while (context.symbols.pou(outer).owner) outer = context.symbols.pou(outer).owner;
  const DeclId decl = context.symbols.pou(outer).decl;
  const Loc at = decl ? context.tree().decl(decl).begin : Loc{};
  if (!at || !isWholeSource(context, at) || withBlanks(context.symbols.sources, {at, at}).begin != at) return {};
  return {title, {{at, at, "VAR_GLOBAL\n  " + declaration + ";\nEND_VAR\n"}}, false};
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

Loc endOfSections(const Context& context, const PouDecl& pou) { return rung::endOfSections(writtenIn(context), pou); }
std::string indentAt(const Context& context, Loc loc) { return rung::indentAt(context.symbols.sources, loc); }
bool isWholeSource(const Context& context, Loc loc) { return rung::isWholeSource(context.symbols.sources, loc); }

}  // namespace rung::sema

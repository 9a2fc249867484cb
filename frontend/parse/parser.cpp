// SPDX-License-Identifier: Apache-2.0
// Files and POUs; the interface of the parser.
#include "frontend/parse/parser.h"

#include <algorithm>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/standard_names.h"

namespace rung::text {

// ---- files

// {declaration}
Slice<DeclId> Parser::parseDecls() {
  std::vector<DeclId> decls;
  while (!at(Tok::End)) parseTopLevel(decls);
  return tree_.addList<DeclId>(decls);
}

// expr, and nothing after it
ExprId Parser::parseLoneExpression() {
  if (at(Tok::End)) return {};
  const ExprId e = parseExpr();
  if (!panic_ && !at(Tok::End)) fail(isOperand(kind()) ? diag::MissingOperator : diag::StrayToken, t_, {describe(t_)});
  return panic_ ? ExprId{} : e;
}

// field ":=" init {"," …}, and nothing after it
Slice<FieldInit> Parser::parseLoneFieldInits() {
  const std::vector<FieldInit> fields = parseFieldInits(Tok::End);
  if (!panic_ && !at(Tok::End)) fail(diag::MissingToken, t_, {",", describe(t_)});
  return tree_.addList<FieldInit>(fields);
}

// file = {TYPE … | POU | CONFIGURATION … | VAR_GLOBAL … | NAMESPACE … | USING …}
void Parser::parseTopLevel(std::vector<DeclId>& out) {
  panic_ = false;
  stmt_depth_ = expr_depth_ = 0;
  if (accept(Tok::Semicolon)) return;
  if (at(Tok::Type)) return parseTypes(out);
  if (at(Tok::Using)) return parseUsing(out);
  static constexpr TokSet kPous = {Tok::Function, Tok::FunctionBlock, Tok::Interface, Tok::Class, Tok::Program};
  static constexpr TokSet kSections = {Tok::VarGlobal, Tok::VarConfig, Tok::VarAccess};
  DeclId decl;
  if (at(Tok::Namespace) && !enterDecl(Tok::EndNamespace)) return;
  if (kPous.has(kind()))
    decl = parsePou();
  else if (at(Tok::VarExternal))
    return parseStrayExternal();
  else if (kSections.has(kind()))
    decl = parseSection();
  else if (at(Tok::Namespace))
    decl = parseNamespace();
  else if (at(Tok::Configuration))
    decl = parseConfiguration();
  else
    return parseUnknownTopLevel();
  out.push_back(decl);
}

// VAR_EXTERNAL outside of a POU. Its variables count as lost, so that their uses draw no error.
void Parser::parseStrayExternal() {
  slip(diag::ExternalOutside, t_);
  tree_.lost_names = true;
  const Skipping skipping(*this);
  parseSection();
}

// A misspelled keyword is corrected; anything else is reported and skipped.
void Parser::parseUnknownTopLevel() {
  if (at(Tok::Ident)) {
    static constexpr Tok kKeywords[] = {Tok::Function, Tok::FunctionBlock, Tok::Program,
                                        Tok::Type,     Tok::Configuration, Tok::VarGlobal};
    if (const Tok meant = nearKeyword(t_, kKeywords);
        meant != Tok::End && (isName(peek()) || (t_[1].flags & kLineStart) != 0)) {
      correctSpelling(meant);
      return;
    }
  }
  if (at(Tok::Struct) && isName(peek())) return skipStructOfC();
  if (at(Tok::Error)) {
    last_error_ = t_;
  } else {
    slip(diag::NotAtFileLevel, t_, {describe(t_)});
  }
  tree_.lost_names = true;
  const Skipping skipping(*this);
  advance();
  skipToTopLevel();
}

void Parser::skipToTopLevel() {
  while (!at(Tok::End) && !atTopLevelWord()) advance();
}

// Before a declaration that may hold others of its kind. False: too deep, it was skipped up to its `end`.
bool Parser::enterDecl(Tok end) {
  if (++decl_depth_ <= kMaxDeclDepth) return true;
  tooDeep("declarations", kMaxDeclDepth);
  const Tok begin = kind();
  uint32_t open = 0;
  const Skipping skipping(*this);
  do {
    if (at(begin)) ++open;
    if (at(end)) --open;
    advance();
  } while (open > 0 && !at(Tok::End));
  accept(Tok::Semicolon);
  tree_.lost_names = true;
  panic_ = false;
  --decl_depth_;
  return false;
}

namespace {

struct PouKeywords {
  Tok word, end;
  PouKind kind;
};
constexpr PouKeywords kPouKeywords[] = {{Tok::Function, Tok::EndFunction, PouKind::Function},
                                        {Tok::FunctionBlock, Tok::EndFunctionBlock, PouKind::FunctionBlock},
                                        {Tok::Program, Tok::EndProgram, PouKind::Program},
                                        {Tok::Class, Tok::EndClass, PouKind::Class},
                                        {Tok::Interface, Tok::EndInterface, PouKind::Interface},
                                        {Tok::Method, Tok::EndMethod, PouKind::Method},
                                        {Tok::Action, Tok::EndAction, PouKind::Action}};

}  // namespace

// pou = keyword modifiers name usings [EXTENDS types] [IMPLEMENTS types] [":" type], usings, sections, members,
// statements, [END_…]
// keyword = FUNCTION | FUNCTION_BLOCK | PROGRAM | CLASS | INTERFACE | METHOD | ACTION
DeclId Parser::parsePou() {
  const Token* open = t_;
  PouDecl d{};
  d.h = declHeader(DeclKind::Pou);
  const Tok word = kind();
  const PouKeywords* keywords = kPouKeywords;
  while (keywords->word != word) ++keywords;
  d.pou_kind = keywords->kind;
  const Tok end = keywords->end;
  if (!d.h.pragmas.empty()) d.h.begin = tree_.list(d.h.pragmas)[0].loc;
  advance();
  const bool is_member = d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action;
  if (!is_member) variables_.clear();
  const size_t outer_variables = variables_.size();
  parseModifiers(d.access, d.modifiers, true);
  parsePouName(d);
  std::vector<DeclId> usings;
  while (at(Tok::Using)) parseUsing(usings);
  parseBases(d);
  parsePouResult(d, word);
  declared_in_body_ = lost_ = eno_used_ = false;
  pou_end_ = end;
  pou_closes_ = Known::NotYet;
  while (at(Tok::Using)) parseUsing(usings);
  panic_ = false;
  d.usings = tree_.addList<DeclId>(usings);
  parsePouParts(d);
  d.is_broken = lost_ || declared_in_body_;
  d.uses_eno = eno_used_;
  if (pragmaNamed(d.h.pragmas, "native")) d.body_kind = BodyKind::Native;
  closePou(d, open, word, end);
  variables_.resize(std::min(outer_variables, variables_.size()));
  return tree_.add<DeclId>(d);
}

// [EXTENDS types] [IMPLEMENTS types]: in the header, or in codesys after VAR_GENERIC CONSTANT
void Parser::parseBases(PouDecl& d) {
  if (at(Tok::Extends)) d.bases = parseTypeNames();
  if (at(Tok::Implements)) d.implements = parseTypeNames();
}

// name; of the functional form of an operator a keyword
void Parser::parsePouName(PouDecl& d) {
  Ident name{{}, here()};
  if (atLineStart()) {
    missing(diag::MissingNameAfter, {describe(t_ - 1)});
  } else if (peek() == Tok::Colon && ((kind() >= Tok::And && kind() <= Tok::Mod) ||
                                      (isTypeWord(kind()) && pragmaNamed(d.h.pragmas, "native")))) {
    // The functional form of an operator, FUNCTION AND : ANY_BIT, and the library's FUNCTION TIME : TIME.
    name = {names_.intern(textOf(t_)), here()};
    advance();
  } else if (!parseNewName(name)) {
    const Skipping skipping(*this);
    while (!atLineStart() && !at(Tok::Colon) && !at(Tok::Semicolon)) advance();
    panic_ = false;
    tree_.lost_names = true;
  }
  d.name = name.name;
  d.h.loc = name.loc;
}

// [":" type] [";"], and the end of the header's line
void Parser::parsePouResult(PouDecl& d, Tok word) {
  // One token too many before the result.
  if (word != Tok::Action && !atLineStart() && !at(Tok::Colon) && !isTypeWord(kind()) && peek() == Tok::Colon &&
      (t_[1].flags & kLineStart) == 0) {
    slip(diag::StrayToken, t_, {describe(t_)});
    skip();
  }
  if (word == Tok::Action) {
    accept(Tok::Colon);
  } else if (at(Tok::Colon)) {
    advance();
    declares_ = true;
    d.result = parseType();
    declares_ = false;
    if (!d.result) d.result = build_.errorType(d.h.loc);
  } else if ((isTypeWord(kind()) || (isName(kind()) && word == Tok::Function)) && !atLineStart() && !atMember()) {
    slip(diag::MissingToken, t_, {":", describe(t_)});
    d.result = parseType();
  }
  if (panic_) {
    const Skipping skipping(*this);
    while (!atLineStart() && !at(Tok::End) && !atSection() && !at(Tok::Semicolon)) advance();
    panic_ = false;
  }
  accept(Tok::Semicolon);
  // One token too many on the line of the header.
  if (!atLineStart() && !at(Tok::End) && (t_[1].flags & kLineStart) != 0 && !atBlockEnd() && !atSection() &&
      !atMember()) {
    slip(diag::StrayToken, t_, {describe(t_)});
    skip();
  }
}

// END_…, or what ends the POU without it
void Parser::closePou(PouDecl& d, const Token* open, Tok word, Tok end) {
  if (accept(end)) {
    d.closed = true;
    d.h.end = endOf(t_ - 1);
    accept(Tok::Semicolon);
    if (d.pou_kind != PouKind::Method && d.pou_kind != PouKind::Action && atMember()) {
      std::vector<DeclId> members(tree_.list(d.members).begin(), tree_.list(d.members).end());
      while (atMember()) parseMember(members);
      d.members = tree_.addList<DeclId>(members);
    }
  } else {
    d.h.end = index() > 0 ? endOf(t_ - 1) : here();
    const bool outer_ends = (d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action) && isReserved(kind());
    if (!atTopLevelWord() && !at(Tok::End) && !outer_ends) {
      // An END_… of something else, which block repair would have removed.
      if (at(Tok::CppFile))
        reportCppFile(diag::CppFileAfterBody, here());
      else if (d.body_kind == BodyKind::Cpp)
        slip(diag::AfterCppBody, t_, {describe(t_)});
      else
        slip(diag::StrayEnd, t_, {textOf(t_)});
      const Skipping skipping(*this);
      advance();
      if (d.pou_kind != PouKind::Method && d.pou_kind != PouKind::Action) {  // its rest does not belong to file level
        while (!at(end) && !at(Tok::End) && (atMember() || !atTopLevelWord())) advance();
        accept(end);
      }
    } else if (!profile_.optional_ends) {
      missingEnd(spelling(end), open, spelling(word));
    }
  }
}

// Sections, members and statements; members precede the statements (edition 3), follow them, or follow the END_…
// (exports of CODESYS).
void Parser::parsePouParts(PouDecl& d) {
  const bool is_member = d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action;
  std::vector<DeclId> members;
  std::vector<SfcTransition> transitions;
  const size_t first = decls_.size();
  while (at(Tok::CppFile) || (atSection() && (!at(Tok::VarGlobal) || pouCloses()))) {
    if (acceptCppFile(d)) continue;
    const DeclId section = parseSection();
    decls_.push_back(section);
    const bool is_generic = tree_.as<SectionDecl>(section).qualifiers.generic;
    if (is_generic && d.bases.empty() && d.implements.empty()) parseBases(d);
  }
  d.sections = listFrom(decls_, first);
  parseMembersOf(d, members, transitions);
  if (atSfc())
    parseSfc(d, members, transitions);
  else
    parseBody(d);
  if (!is_member && atMember()) {
    while (atMember()) parseMember(members);
    const bool has_body = !d.body.empty() || !d.il.empty() || d.body_kind == BodyKind::Sfc ||
                          d.body_kind == BodyKind::Network || d.body_kind == BodyKind::Cpp;
    if (!has_body) parseBody(d);
  }
  d.transitions = tree_.addList<SfcTransition>(transitions);
  d.members = tree_.addList<DeclId>(members);
  checkCppFile(d);
}

// {C++ file} … {END_C++}: the definitions at file level of a body in C++ (syntax manual 5.8.2), among the declarations.
bool Parser::acceptCppFile(PouDecl& d) {
  if (!at(Tok::CppFile)) return false;
  if (d.cpp_file_begin != d.cpp_file_end) {
    reportCppFile(diag::SecondCppFile, here());
  } else {
    d.cpp_file_begin = here();
    d.cpp_file_end = endOf(t_);
  }
  advance();
  return true;
}

// `{C++ file}` alone: what follows it may be many lines.
void Parser::reportCppFile(Diag diag, Loc at) {
  const std::string_view text = source_.substr(at.offset - base_);
  diagnostics_.report(diag, at).length(static_cast<uint32_t>(text.find('}') + 1));
}

//   passes  FUNCTION f : INT {C++ file} int one() { return 1; } {END_C++} {C++} F = one(); {END_C++} END_FUNCTION
//   fails   FUNCTION f : INT {C++ file} {END_C++} f := 1; END_FUNCTION          E0176
void Parser::checkCppFile(const PouDecl& d) {
  if (d.cpp_file_begin != d.cpp_file_end && d.body_kind != BodyKind::Cpp)
    reportCppFile(diag::CppFileWithoutBody, d.cpp_file_begin);
}

// Statements, instructions or {C++}: a body is in one language.
void Parser::parseBody(PouDecl& d) {
  while (acceptCppFile(d)) {
  }
  const Token* first = t_;
  d.body_begin = d.body_end = here();
  if (accept(Tok::CppBody)) {
    d.body_kind = BodyKind::Cpp;
  } else if (at(Tok::Network)) {
    parseNetworks(d);
  } else if (atIl()) {
    d.body_kind = BodyKind::Il;
    d.il = parseIl(false);
  } else {
    d.body_kind = BodyKind::St;
    d.body = parseStatements(0);
  }
  if (t_ != first) d.body_end = endOf(t_ - 1);
}

// ---- the interface

FileUnit parseFile(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics, Trivia* comments) {
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  std::vector<Comment> kept;
  parser.read(0, static_cast<uint32_t>(sources.sourceText(file).size()), comments != nullptr ? &kept : nullptr);
  if (comments != nullptr) comments->add(kept);
  FileUnit unit{file, parser.parseDecls()};
  unit.skipped = tree.addList<Range>(parser.skipped());
  tree.files.push_back(unit);
  return unit;
}

Slice<DeclId> parseDeclarations(Tree& tree, Names& names, const Sources& sources, Loc begin, Loc end, Dialect dialect,
                                Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, sources.fileOf(begin), dialect, diagnostics);
  parser.readBetween(begin, end);
  return parser.parseDecls();
}

Slice<FieldInit> parseFieldInits(Tree& tree, Names& names, const Sources& sources, Loc begin, Loc end, Dialect dialect,
                                 Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, sources.fileOf(begin), dialect, diagnostics);
  parser.readBetween(begin, end);
  return parser.parseLoneFieldInits();
}

ExprId parseExpression(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                       Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  parser.readAll();
  return parser.parseLoneExpression();
}

}  // namespace rung::text

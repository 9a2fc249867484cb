// Files, POUs and configurations; tokens and error reporting of the parser.
#include "frontend/parse/parser.h"

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagnostics.h"
#include "frontend/syntax/sfc.h"
#include "frontend/syntax/standard_names.h"

namespace rung::text {

Parser::Parser(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect, Diagnostics& diagnostics)
    : tree_(tree),
      names_(names),
      sources_(sources),
      file_(file),
      dialect_(dialect),
      diagnostics_(diagnostics),
      base_(sources.begin(file).offset),
      source_(sources.sourceText(file)) {
  eno_ = names.intern(kEnableOutput);
  const std::string_view path = sources.path(file);
  il_file_ = path.size() > 3 && sameIdentifier(path.substr(path.size() - 3), ".il");
}

void Parser::read(uint32_t begin, uint32_t end) {
  lex(stream_, names_, sources_, file_, begin, end, dialect_, diagnostics_);
  resolveObjectKeywords(stream_);
  balanceBlocks(stream_, names_, sources_, file_, dialect_, diagnostics_);
  tokens_ = std::move(stream_.tokens);
  t_ = tokens_.data();
}

// ---- tokens

uint32_t Parser::lengthOf(const Token* t) const {
  if (isName(t->kind) || isTypeWord(t->kind))
    return (t->flags & kSynthetic) != 0 ? 0 : static_cast<uint32_t>(names_.string({t->value}).size());
  return t->value;
}

std::string Parser::describe(const Token* t) const {
  while ((t->flags & kSynthetic) != 0 && t > tokens_.data()) --t;
  if (t->kind == Tok::End) return spelling(Tok::End);
  std::string_view text = textOf(t);
  std::string shown = "`";
  // A long literal is truncated, between UTF-8 characters.
  if (text.size() > 40) {
    size_t n = 37;
    while (n > 0 && (static_cast<unsigned char>(text[n]) & 0xC0) == 0x80) --n;
    shown.append(text.substr(0, n));
    shown += "...";
  } else {
    shown.append(text);
  }
  shown += '`';
  return shown;
}

// ---- errors

// One syntax error per line: the next error on the line most likely follows from the first.
bool Parser::mayReport(const Token* t) {
  if (panic_) return false;
  const auto sameLine = [](const Token* a, const Token* b) {
    if (a > b) std::swap(a, b);
    while (a < b)
      if (((++a)->flags & kLineStart) != 0) return false;
    return true;
  };
  if (last_error_ != nullptr && sameLine(last_error_, t)) {
    if (t > last_error_) last_error_ = t;
    return false;
  }
  // Reported by the lexer or the block repair.
  for (const Token* p = t; t - p < 200; --p) {
    if ((p->flags & kReported) != 0) {
      last_error_ = t;
      return false;
    }
    if ((p->flags & kLineStart) != 0 || p == tokens_.data()) break;
  }
  for (const Token* p = t + 1; p - t < 200 && (p->flags & kLineStart) == 0 && p->kind != Tok::End; ++p) {
    if ((p->flags & kReported) != 0) {
      last_error_ = t;
      return false;
    }
  }
  return true;
}

Report Parser::fail(Diag diag, const Token* t, std::initializer_list<std::string_view> args) {
  const bool report = mayReport(t);
  panic_ = true;
  if (!report) return Report(nullptr);
  last_error_ = t;
  return diagnostics_.report(diag, loc(t), args).length(t->kind == Tok::End ? 1 : lengthOf(t));
}

Report Parser::slip(Diag diag, const Token* t, std::initializer_list<std::string_view> args) {
  if (!mayReport(t)) return Report(nullptr);
  last_error_ = t;
  return diagnostics_.report(diag, loc(t), args).length(t->kind == Tok::End ? 1 : lengthOf(t));
}

Report Parser::missing(Diag diag, std::initializer_list<std::string_view> args) {
  const Token* before = t_;
  if (before > tokens_.data()) --before;
  while ((before->flags & kSynthetic) != 0 && before > tokens_.data()) --before;
  if (!mayReport(before)) return Report(nullptr);
  last_error_ = before;
  return diagnostics_.report(diag, endOf(before), args).length(1);
}

bool Parser::expect(Tok wanted) {
  if (accept(wanted)) return true;
  if (panic_) return false;
  const Tok candidates[] = {wanted};
  if (at(Tok::Ident) && isReserved(wanted) && nearKeyword(t_, candidates) == wanted) {
    correctSpelling(wanted);
    advance();
    return false;
  }
  if (atLineStart() || at(Tok::End))
    missing(diag::MissingToken, {spelling(wanted), describe(t_)});
  else if (isOperand(kind()) || at(Tok::Minus) || at(Tok::Array) || at(Tok::Struct) || at(Tok::Colon) ||
           at(Tok::Semicolon))
    slip(diag::MissingToken, t_, {spelling(wanted), describe(t_)});
  else
    fail(diag::WrongKeyword, t_, {textOf(t_), spelling(wanted)});
  return false;
}

Tok Parser::nearKeyword(const Token* t, std::span<const Tok> candidates) const {
  return nearestKeyword(textOf(t), candidates);
}

bool Parser::correctSpelling(Tok wanted) {
  slip(diag::MisspelledKeyword, t_, {textOf(t_), spelling(wanted)});
  const uint32_t length = lengthOf(t_);
  t_->kind = wanted;
  if (!isName(wanted) && !isTypeWord(wanted)) t_->value = length;
  t_->flags |= kReported;
  return true;
}

void Parser::tooDeep(const char* what, uint32_t limit) {
  const std::string number = std::to_string(limit);
  fail(diag::TooDeep, t_, {what, number});
}

// ---- files

Slice<DeclId> Parser::parseDecls() {
  std::vector<DeclId> decls;
  while (!at(Tok::End)) parseTopLevel(decls);
  return tree_.addList<DeclId>(decls);
}

ExprId Parser::parseLoneExpression() {
  if (at(Tok::End)) return {};
  const ExprId e = parseExpr();
  if (!panic_ && !at(Tok::End)) fail(isOperand(kind()) ? diag::MissingOperator : diag::StrayToken, t_, {describe(t_)});
  return panic_ ? ExprId{} : e;
}

Slice<DeclId> Parser::parseLoneSections() {
  std::vector<DeclId> sections;
  while (atSection()) sections.push_back(parseSection());
  return tree_.addList<DeclId>(sections);
}

Slice<StmtId> Parser::parseLoneStatements() { return parseStatements(0); }

bool Parser::atTopLevelWord() const {
  const Tok k = kind();
  return k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Program || k == Tok::Type ||
         k == Tok::Configuration || k == Tok::VarGlobal || isObjectWord(k) || k == Tok::Using || k == Tok::EndNamespace;
}

// file = {TYPE … | POU | CONFIGURATION … | VAR_GLOBAL … | NAMESPACE … | USING …}
void Parser::parseTopLevel(std::vector<DeclId>& out) {
  panic_ = false;
  stmt_depth_ = expr_depth_ = 0;
  switch (static_cast<int>(kind())) {
    case static_cast<int>(Tok::Semicolon): advance(); return;
    case static_cast<int>(Tok::Type): parseTypes(out); return;
    case static_cast<int>(Tok::Function):
    case static_cast<int>(Tok::FunctionBlock):
    case static_cast<int>(Tok::Interface):
    case static_cast<int>(Tok::Class):
    case static_cast<int>(Tok::Program): out.push_back(parsePou()); return;
    case static_cast<int>(Tok::Namespace): out.push_back(parseNamespace()); return;
    case static_cast<int>(Tok::Using): parseUsing(out); return;
    case static_cast<int>(Tok::Configuration): out.push_back(parseConfiguration()); return;
    case static_cast<int>(Tok::VarGlobal):
    case static_cast<int>(Tok::VarConfig):
    case static_cast<int>(Tok::VarAccess):
    case static_cast<int>(Tok::VarExternal): out.push_back(parseSection()); return;
    default: break;
  }
  if (at(Tok::Ident)) {
    static constexpr Tok kKeywords[] = {Tok::Function, Tok::FunctionBlock, Tok::Program,
                                        Tok::Type,     Tok::Configuration, Tok::VarGlobal};
    if (const Tok meant = nearKeyword(t_, kKeywords);
        meant != Tok::End && (isName(peek()) || (t_[1].flags & kLineStart) != 0)) {
      correctSpelling(meant);
      return;
    }
  }
  if (at(Tok::Error)) {
    last_error_ = t_;
  } else {
    slip(diag::NotAtFileLevel, t_, {describe(t_)});
  }
  tree_.lost_names = true;
  advance();
  skipToTopLevel();
}

void Parser::skipToTopLevel() {
  while (!at(Tok::End) && !atTopLevelWord()) advance();
}

// False: a POU without END_…, which codesys allows, so that a VAR_GLOBAL after it begins a list of globals.
bool Parser::pouCloses() {
  if (dialect_ != Dialect::Codesys) return true;
  if (pou_closes_ == Known::NotYet) {
    const Token* t = t_;
    while (t->kind != pou_end_ && t->kind != Tok::End && t->kind != Tok::Function && t->kind != Tok::FunctionBlock &&
           t->kind != Tok::Program && t->kind != Tok::Type && t->kind != Tok::Configuration && !isObjectWord(t->kind))
      ++t;
    pou_closes_ = t->kind == pou_end_ && pou_end_ != Tok::End ? Known::Yes : Known::No;
  }
  return pou_closes_ == Known::Yes;
}

// pou = keyword modifiers name usings [EXTENDS types] [IMPLEMENTS types] [":" type], usings, sections, members,
// statements, [END_…]
// keyword = FUNCTION | FUNCTION_BLOCK | PROGRAM | CLASS | INTERFACE | METHOD | ACTION
DeclId Parser::parsePou() {
  const Token* open = t_;
  PouDecl d{};
  d.h = {DeclKind::Pou, 0, 0, here(), takeDoc(), takePragmas()};
  const Tok word = kind();
  struct PouKeywords {
    Tok word, end;
    PouKind kind;
  };
  static constexpr PouKeywords kKeywords[] = {{Tok::Function, Tok::EndFunction, PouKind::Function},
                                              {Tok::FunctionBlock, Tok::EndFunctionBlock, PouKind::FunctionBlock},
                                              {Tok::Program, Tok::EndProgram, PouKind::Program},
                                              {Tok::Class, Tok::EndClass, PouKind::Class},
                                              {Tok::Interface, Tok::EndInterface, PouKind::Interface},
                                              {Tok::Method, Tok::EndMethod, PouKind::Method},
                                              {Tok::Action, Tok::EndAction, PouKind::Action}};
  const PouKeywords* keywords = kKeywords;
  while (keywords->word != word) ++keywords;
  d.pou_kind = keywords->kind;
  const Tok end = keywords->end;
  d.begin = here();
  for (const Pragma& p : tree_.list(d.h.pragmas)) {
    d.begin = p.loc;
    break;
  }
  advance();
  parseModifiers(d.access, d.modifiers, true);
  Ident name{{}, here()};
  if (atLineStart()) {
    missing(diag::MissingName, {describe(t_)});
  } else if (peek() == Tok::Colon && ((kind() >= Tok::And && kind() <= Tok::Mod) ||
                                      (isTypeWord(kind()) && pragmaNamed(d.h.pragmas, "native")))) {
    // The functional form of an operator, FUNCTION AND : ANY_BIT, and the library's FUNCTION TIME : TIME.
    name = {names_.intern(textOf(t_)), here()};
    advance();
  } else if (!parseName(name)) {
    while (!atLineStart() && !at(Tok::Colon) && !at(Tok::Semicolon)) advance();
    panic_ = false;
    tree_.lost_names = true;
  }
  d.name = name.name;
  d.h.loc = name.loc;
  std::vector<DeclId> usings;
  while (at(Tok::Using)) parseUsing(usings);
  if (at(Tok::Extends)) d.bases = parseTypeNames();
  if (at(Tok::Implements)) d.implements = parseTypeNames();
  if (word == Tok::Action) {
    accept(Tok::Colon);
  } else if (at(Tok::Colon)) {
    advance();
    d.result = parseType();
  } else if ((isTypeWord(kind()) || (isName(kind()) && word == Tok::Function)) && !atLineStart() && !atMember()) {
    slip(diag::MissingToken, t_, {":", describe(t_)});
    d.result = parseType();
  }
  if (panic_) {
    while (!atLineStart() && !at(Tok::End) && !atSection() && !at(Tok::Semicolon)) advance();
    panic_ = false;
  }
  accept(Tok::Semicolon);
  // One token too many on the line of the header.
  if (!atLineStart() && !at(Tok::End) && (t_[1].flags & kLineStart) != 0 && !atBlockEnd() && !atSection() &&
      !atMember()) {
    slip(diag::StrayToken, t_, {describe(t_)});
    advance();
  }
  declared_in_body_ = lost_ = eno_used_ = false;
  pou_end_ = end;
  pou_closes_ = Known::NotYet;
  while (at(Tok::Using)) parseUsing(usings);
  panic_ = false;
  d.usings = tree_.addList<DeclId>(usings);
  parsePouParts(d);
  if (lost_ || declared_in_body_) d.h.bits |= kBrokenDeclarations;
  d.uses_eno = eno_used_;
  if (pragmaNamed(d.h.pragmas, "native")) d.body_kind = BodyKind::Native;
  if (accept(end)) {
    d.closed = true;
    d.end = {loc(t_ - 1).offset + lengthOf(t_ - 1)};
    accept(Tok::Semicolon);
    if (d.pou_kind != PouKind::Method && d.pou_kind != PouKind::Action && atMember()) {
      std::vector<DeclId> members;
      for (DeclId member : tree_.list(d.members)) members.push_back(member);
      while (atMember()) parseMember(members);
      d.members = tree_.addList<DeclId>(members);
    }
  } else {
    d.end = index() > 0 ? endOf(t_ - 1) : here();
    const bool outer_ends = (d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action) && isReserved(kind());
    if (!atTopLevelWord() && !at(Tok::End) && !outer_ends) {
      // An END_… of something else, which block repair would have removed.
      if (d.body_kind == BodyKind::Cpp)
        slip(diag::AfterCppBody, t_, {describe(t_)});
      else
        slip(diag::StrayEnd, t_, {textOf(t_)});
      advance();
      if (d.pou_kind != PouKind::Method && d.pou_kind != PouKind::Action) {  // its rest does not belong to file level
        while (!at(end) && !at(Tok::End) && (atMember() || !atTopLevelWord())) advance();
        accept(end);
      }
    } else if (dialect_ != Dialect::Codesys) {
      const std::string line = std::to_string(sources_.location(loc(open)).line);
      missing(diag::MissingEnd, {spelling(end), spelling(word), line});
    }
  }
  return tree_.add<DeclId>(d);
}

// Sections, members and statements; members precede the statements (edition 3), follow them, or follow the END_…
// (exports of CODESYS).
void Parser::parsePouParts(PouDecl& d) {
  const bool is_member = d.pou_kind == PouKind::Method || d.pou_kind == PouKind::Action;
  std::vector<DeclId> members;
  std::vector<SfcTransition> transitions;
  const size_t first = decls_.size();
  while (atSection() && (!at(Tok::VarGlobal) || pouCloses())) {
    const DeclId section = parseSection();
    decls_.push_back(section);
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
}

// Statements, instructions or {C++}: a body is in one language.
void Parser::parseBody(PouDecl& d) {
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

// ---- configurations

// CONFIGURATION name {section | resource | task | program} END_CONFIGURATION
DeclId Parser::parseConfiguration() {
  const Token* open = t_;
  ConfigurationDecl d{{DeclKind::Configuration, 0, 0, here(), takeDoc(), takePragmas()}, {}, {}};
  advance();
  Ident name;
  if (parseName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
  }
  panic_ = false;
  accept(Tok::Semicolon);
  const size_t first = decls_.size();
  parseMembers(Tok::EndConfiguration, decls_);
  if (accept(Tok::EndConfiguration)) {
    accept(Tok::Semicolon);
  } else {
    const std::string line = std::to_string(sources_.location(loc(open)).line);
    missing(diag::MissingEnd, {"END_CONFIGURATION", "CONFIGURATION", line});
  }
  d.members = listFrom(decls_, first);
  return tree_.add<DeclId>(d);
}

void Parser::parseMembers(Tok end, std::vector<DeclId>& out) {
  for (;;) {
    if (accept(Tok::Semicolon)) continue;
    if (at(end) || at(Tok::End) || at(Tok::EndConfiguration) || at(Tok::EndResource) || at(Tok::Configuration) ||
        at(Tok::Function) || at(Tok::FunctionBlock) || at(Tok::Type))
      return;
    DeclId member;
    if (atSection()) {
      member = parseSection();
    } else if (at(Tok::Resource)) {
      member = parseResource();
    } else if (at(Tok::Task)) {
      member = parseTask();
    } else if (at(Tok::Program)) {
      member = parseProgramInstance();
    } else {
      static constexpr Tok kKeywords[] = {Tok::Resource, Tok::Task, Tok::Program, Tok::VarGlobal};
      if (at(Tok::Ident) && isName(peek())) {
        if (const Tok meant = nearKeyword(t_, kKeywords); meant != Tok::End) {
          correctSpelling(meant);
          continue;
        }
      }
      slip(diag::NotInConfiguration, t_, {describe(t_)});
      do advance();
      while (!at(Tok::End) && !atLineStart() && !at(Tok::Semicolon));
      continue;
    }
    out.push_back(member);
    if (panic_) {
      panic_ = false;
      while (!at(Tok::End) && !atLineStart() && !at(Tok::Semicolon)) advance();
    }
  }
}

// RESOURCE name ON type {member} END_RESOURCE
DeclId Parser::parseResource() {
  const Token* open = t_;
  ResourceDecl d{{DeclKind::Resource, 0, 0, here(), takeDoc(), takePragmas()}, {}, {}, {}};
  advance();
  Ident name, target;
  if (parseName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
  }
  if (!panic_ && !accept(Tok::On)) {
    if (isName(kind()) && !atLineStart())
      slip(diag::MissingToken, t_, {"ON", describe(t_)});
    else
      missing(diag::MissingToken, {"ON", describe(t_)}), panic_ = true;
  }
  if (!panic_) {
    if (atLineStart())
      missing(diag::MissingName, {describe(t_)});
    else if (parseName(target))
      d.target = target.name;
  }
  if (panic_) {
    while (!at(Tok::End) && !atLineStart() && !at(Tok::Semicolon)) advance();
    panic_ = false;
  }
  const size_t first = decls_.size();
  parseMembers(Tok::EndResource, decls_);
  if (accept(Tok::EndResource)) {
    accept(Tok::Semicolon);
  } else {
    const std::string line = std::to_string(sources_.location(loc(open)).line);
    missing(diag::MissingEnd, {"END_RESOURCE", "RESOURCE", line});
  }
  d.members = listFrom(decls_, first);
  return tree_.add<DeclId>(d);
}

// TASK name "(" settings ")" ";"
DeclId Parser::parseTask() {
  TaskDecl d{{DeclKind::Task, 0, 0, here(), takeDoc(), takePragmas()}, {}, {}};
  advance();
  Ident name;
  if (!parseName(name)) {
    tree_.lost_names = true;
  } else {
    d.name = name.name;
    d.h.loc = name.loc;
    Loc end;
    if (at(Tok::LeftParen))
      d.settings = parseArguments(end);
    else if (!at(Tok::Semicolon))
      fail(diag::MissingToken, t_, {"(", describe(t_)});
  }
  endStatement(nullptr);
  return tree_.add<DeclId>(d);
}

// PROGRAM [RETAIN | NON_RETAIN] name [WITH task] ":" type ["(" arguments ")"] ";"
DeclId Parser::parseProgramInstance() {
  ProgramInstanceDecl d{};
  d.h = {DeclKind::ProgramInstance, 0, 0, here(), takeDoc(), takePragmas()};
  advance();
  if ((at(Tok::Retain) || at(Tok::NonRetain)) && isName(peek())) {
    d.section_bits = at(Tok::Retain) ? kRetain : kNonRetain;
    advance();
  }
  Ident name;
  if (parseName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
    if (accept(Tok::With)) {
      parseName(d.task);
    } else if (isName(kind()) && peek() == Tok::Colon && !atLineStart()) {
      if (isName(peek(2))) slip(diag::MissingToken, t_, {"WITH", describe(t_)});
      parseName(d.task);
    }
    if (!panic_) expect(Tok::Colon);
    if (!panic_) parseNamePath(d.type);
    Loc end;
    if (!panic_ && at(Tok::LeftParen)) {
      in_program_instance_ = true;
      d.arguments = parseArguments(end);
      in_program_instance_ = false;
      d.block_tasks = tree_.addList<Ident>(block_tasks_);
      block_tasks_.clear();
    }
  }
  endStatement(nullptr);
  return tree_.add<DeclId>(d);
}

// ---- the interface

FileUnit parseFile(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  parser.read(0, static_cast<uint32_t>(sources.sourceText(file).size()));
  const FileUnit unit{file, parser.parseDecls()};
  tree.files.push_back(unit);
  return unit;
}

Slice<DeclId> parseDeclarations(Tree& tree, Names& names, const Sources& sources, Loc begin, Loc end, Dialect dialect,
                                Diagnostics& diagnostics) {
  const FileId file = sources.fileOf(begin);
  const uint32_t base = sources.begin(file).offset;
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  parser.read(begin.offset - base, end.offset - base);
  return parser.parseDecls();
}

Slice<DeclId> parseSections(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                            Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  parser.read(0, static_cast<uint32_t>(sources.sourceText(file).size()));
  return parser.parseLoneSections();
}

Slice<StmtId> parseStatements(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                              Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  parser.read(0, static_cast<uint32_t>(sources.sourceText(file).size()));
  return parser.parseLoneStatements();
}

ExprId parseExpression(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                       Diagnostics& diagnostics) {
  Parser parser(tree, names, sources, file, dialect, diagnostics);
  parser.read(0, static_cast<uint32_t>(sources.sourceText(file).size()));
  return parser.parseLoneExpression();
}

}  // namespace rung::text

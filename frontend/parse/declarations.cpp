// SPDX-License-Identifier: Apache-2.0
// Names and sections, and resynchronization after errors in declarations.
#include "frontend/parse/declarations.h"

#include <algorithm>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"

namespace rung::text {

bool endsDeclarations(Tok k) {
  return endsPart(k) || k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Program || k == Tok::Configuration ||
         k == Tok::Type || (k >= Tok::Var && k <= Tok::VarConfig) || isObjectWord(k);
}

bool beginsDeclaration(const Token* t) {
  if (!isName(t->kind)) return false;
  const Tok next = t[1].kind;
  return next == Tok::Colon || next == Tok::Comma || next == Tok::At;
}

namespace {

static_assert(SectionKind{} == SectionKind::Local);
constexpr TokMap<SectionKind> kSections = {
    {Tok::VarInput, SectionKind::Input},       {Tok::VarOutput, SectionKind::Output},
    {Tok::VarInOut, SectionKind::InOut},       {Tok::VarTemp, SectionKind::Temp},
    {Tok::VarExternal, SectionKind::External}, {Tok::VarGlobal, SectionKind::Global},
    {Tok::VarStat, SectionKind::Stat},         {Tok::VarInst, SectionKind::Inst},
    {Tok::VarAccess, SectionKind::Access},     {Tok::VarConfig, SectionKind::Config}};
constexpr TokMap<bool Qualifiers::*> kSectionQualifiers = {{Tok::Constant, &Qualifiers::constant},
                                                           {Tok::Retain, &Qualifiers::retain},
                                                           {Tok::Persistent, &Qualifiers::persistent},
                                                           {Tok::NonRetain, &Qualifiers::non_retain}};

// Words of the textual languages that are names in codesys: of annex B of edition 2 and annex A of edition 3, and of
// the latter alone.
constexpr std::string_view kWordsOfBoth[] = {
    "ACTION",       "ANY",        "AT", "BY",         "CONFIGURATION", "CONSTANT", "FROM",   "F_EDGE",
    "INITIAL_STEP", "NON_RETAIN", "ON", "READ_ONLY",  "READ_WRITE",    "RESOURCE", "RETAIN", "R_EDGE",
    "STEP",         "TASK",       "TO", "TRANSITION", "WITH"};
constexpr std::string_view kWordsOfEdition3[] = {"CHAR",  "CONTINUE", "LDATE",  "LDT",
                                                 "LTIME", "LTOD",     "REF_TO", "WCHAR"};

bool reserves(const LanguageProfile& profile, std::string_view name) {
  const auto is_name = [&](std::string_view word) { return sameIdentifier(name, word); };
  return (profile.reserved_words && std::any_of(std::begin(kWordsOfBoth), std::end(kWordsOfBoth), is_name)) ||
         (profile.reserved_words_of_edition_3 &&
          std::any_of(std::begin(kWordsOfEdition3), std::end(kWordsOfEdition3), is_name));
}

}  // namespace

// Reports and skips one token that is not allowed here when the token after it is.
void DeclarationParser::skipStray(bool fits_after, Diag diag) {
  if (panic_ || !fits_after || endsDeclarations(kind()) || begins(t_) != Begins::Nothing) return;
  if (at(Tok::Error))
    last_error_ = t_;
  else
    slip(diag, t_, {describe(t_)});
  skip();
}

bool DeclarationParser::beginsType(const Token* t) const {
  return isTypeWord(t->kind) || t->kind == Tok::Array || t->kind == Tok::Struct || t->kind == Tok::RefTo ||
         (isName(t->kind) && (t->flags & kLineStart) == 0) || t->kind == Tok::LeftParen;
}

// name, of what is declared: reported where a keyword of the dialect stands for it.
bool DeclarationParser::parseNewName(Ident& out) {
  if (isName(kind()) && reserves(profile_, textOf(t_))) slip(diag::ReservedName, t_, {textOf(t_)});
  return parseName(out);
}

// name
bool DeclarationParser::parseName(Ident& out) {
  if (atLineStart() && lineEnds()) {
    fail(diag::MissingName, t_, {describe(t_)});
    return false;
  }
  if (isName(kind()) || isNullName(t_)) {
    out = ident(t_);
    advance();
    return true;
  }
  if (nameReserved(t_)) {
    const Tok next = peek();
    if ((next == Tok::Colon || next == Tok::Comma || next == Tok::At || next == Tok::Assign ||
         next == Tok::RightParen || next == Tok::Semicolon) ||
        ((t_[1].flags & kLineStart) != 0 && !atLineStart())) {
      slip(diag::ReservedName, t_, {textOf(t_)});
      lost_ = true;
      out = {names_.intern(textOf(t_)), here()};
      advance();
      return true;
    }
  }
  fail(diag::MissingName, t_, {describe(t_)});
  return false;
}

// path = name {"." name}
void DeclarationParser::parseNamePath(Slice<Ident>& out) {
  const size_t first = idents_.size();
  do {
    if ((isName(kind()) || isTypeWord(kind())) && !(atLineStart() && lineEnds())) {
      idents_.push_back(ident(t_));
      advance();
    } else {
      fail(diag::MissingName, t_, {describe(t_)});
      break;
    }
  } while (accept(Tok::Dot));
  out = listFrom(idents_, first);
}

// VAR_xxx {CONSTANT | RETAIN | NON_RETAIN | PERSISTENT} {variable} END_VAR
DeclId DeclarationParser::parseSection() {
  const Token* open = t_;
  SectionDecl d{declHeader(DeclKind::Section), kSections[kind()], AccessLevel::None, {}, SectionMaker::None, {}};
  if ((open->flags & (kSynthetic | kReported)) != 0) lost_ = true;  // it is unknown which section was meant
  d.qualifiers.generic = d.qualifiers.constant = at(Tok::VarGeneric);
  advance();
  while (peek() != Tok::Colon && peek() != Tok::Comma && peek() != Tok::At) {
    bool Qualifiers::*const qualifier = kSectionQualifiers[kind()];
    if (qualifier == nullptr && !atLineStart() && acceptAccess(d.access)) continue;
    if (qualifier == nullptr) break;
    d.qualifiers.*qualifier = true;
    advance();
  }
  // CONSTNAT on the line of the section
  if (at(Tok::Ident) && !atLineStart() && (t_[1].flags & kLineStart) != 0) {
    static constexpr Tok kKeywords[] = {Tok::Constant, Tok::Retain, Tok::NonRetain, Tok::Persistent};
    if (const Tok meant = nearKeyword(t_, kKeywords); meant != Tok::End) {
      correctSpelling(meant);
      d.qualifiers.*kSectionQualifiers[meant] = true;
      advance();
    }
  }
  const size_t first = decls_.size();
  parseVars(d.section, Tok::EndVar, decls_);
  if (accept(Tok::EndVar)) {
    accept(Tok::Semicolon);
  } else {
    missingEnd("END_VAR", open, spelling(open->kind));
  }
  d.vars = listFrom(decls_, first);
  if (lost_ && d.section == SectionKind::Global) tree_.lost_names = true;
  return finish(d);
}

void DeclarationParser::syncDeclaration(Tok end) {
  panic_ = false;
  if (atUnfinished()) return;
  const Skipping skipping(*this);
  uint32_t structures = 0;  // their fields are not declarations of this list
  for (;; advance()) {
    if (at(Tok::Struct) || at(Tok::Union)) ++structures;
    if (structures > 0 && !at(Tok::End) && !at(Tok::EndType) && !at(Tok::EndVar)) {
      if (at(Tok::EndStruct) || at(Tok::EndUnion)) --structures;
      continue;
    }
    if (accept(Tok::Semicolon)) return;
    if (at(end) || endsDeclarations(kind())) return;
    if (atLineStart() && beginsDeclaration(t_)) return;
  }
}

}  // namespace rung::text

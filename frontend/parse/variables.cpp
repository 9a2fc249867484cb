// SPDX-License-Identifier: Apache-2.0
// Variables of a section or structure: names, address, type and initial value.
#include <charconv>
#include <utility>

#include "frontend/parse/declarations.h"
#include "frontend/parse/diagnostics.h"
#include "frontend/source/dialect.h"

namespace rung::text {

// {variable}, up to the `end` of the section
void DeclarationParser::parseVars(SectionKind section, Tok end, std::vector<DeclId>& out) {
  const bool outer = std::exchange(declares_, true);
  while (!at(end) && !endsDeclarations(kind())) {
    if (accept(Tok::Semicolon)) continue;
    const Token* before = t_;
    if (at(Tok::Comma)) lost_ = true;  // the name before it is missing
    skipStray(!isName(kind()) && !nameReserved(t_) && beginsDeclaration(t_ + 1) && !at(Tok::At), diag::NotADeclaration);
    const DeclId var = parseVar(section);
    if (var) out.push_back(var);
    if (t_ == before) skip();
  }
  declares_ = outer;
}

// variable = names [AT address] ":" type [R_EDGE | F_EDGE] [":=" init] ";"
DeclId DeclarationParser::parseVar(SectionKind section) {
  VarDecl d{declHeader(DeclKind::Var), {}, {}, {}, EdgeKind::None, false, false, {}, {}};
  const size_t first = idents_.size();
  if (!(at(Tok::At) && peek() == Tok::Address)) parseVarNames(section);
  lost_ = lost_ || panic_;
  if (!panic_ && at(Tok::At)) parseLocation(d);
  if (!panic_ && !at(Tok::Colon)) skipStray(peek() == Tok::Colon, diag::StrayToken);
  if (!panic_ && !accept(Tok::Colon)) reportNoColon();
  if (!panic_ && section == SectionKind::Access) parseAccessTarget(d);
  lost_ = lost_ || panic_;
  if (idents_.size() > first) d.h.loc = idents_[first].loc;
  d.names = listFrom(idents_, first);
  const Loc type_begin = here();
  if (!panic_) parseVarType(d, section);
  const bool no_type = !d.type;
  if (no_type) d.type = build_.errorType(d.h.loc);
  if (!panic_) parseVarInit(d);
  endVar(d);
  if (no_type) holdSkipped(d.type, type_begin);
  return finish(d);
}

// names = name {"," name}; of VAR_CONFIG a path: name {"." name}. Left on idents_.
void DeclarationParser::parseVarNames(SectionKind section) {
  const bool dotted = section == SectionKind::Config;
  const size_t first = idents_.size();
  do {
    Ident name;
    if (!isName(kind()) && !isNullName(t_) && !nameReserved(t_)) return reportNoName(idents_.size() > first);
    if (isName(kind())) chain_target_ = t_;  // a name of the list, also on a line of its own
    if (!parseNewName(name)) return;
    if (!in_structure_) variables_.push_back(name.name);
    idents_.push_back(name);
  } while (nameFollows(dotted));
}

void DeclarationParser::reportNoName(bool after_comma) {
  if (at(Tok::Error)) {
    last_error_ = t_;
    panic_ = true;
  } else if (atLineStart() && after_comma) {
    fail(diag::MissingName, t_ - 1, {describe(t_ - 1)});
  } else {
    fail(after_comma || at(Tok::Colon) || at(Tok::Comma) ? diag::MissingName : diag::NotADeclaration, t_,
         {describe(t_)});
  }
}

// After a name of a list or path: consumes what separates it from the next one.
bool DeclarationParser::nameFollows(bool dotted) {
  if (accept(Tok::Comma) || (dotted && accept(Tok::Dot))) return true;
  if (dotted && at(Tok::LeftBracket)) {
    // an array element in the path: the index is part of the instance, which VAR_CONFIG names as a whole
    while (!at(Tok::RightBracket) && !at(Tok::End) && !at(Tok::Semicolon)) advance();
    accept(Tok::RightBracket);
    if (accept(Tok::Dot)) return true;
  }
  // `a b : INT`
  if (isName(kind()) && !(at(Tok::At) && (peek() == Tok::Address || peek() == Tok::Colon)) && !atLineStart() &&
      beginsDeclaration(t_)) {
    slip(diag::MissingToken, t_, {",", describe(t_)});
    return true;
  }
  return false;
}

// AT address: AT %IX0.0; in a structure AT %I*: a variable in the image without an address yet; AT %B0: an offset.
void DeclarationParser::parseLocation(VarDecl& d) {
  const Token* word = t_;
  advance();
  if (!at(Tok::Address)) {
    fail(diag::MissingAddress, word);
    return;
  }
  const bool open = textOf(t_).ends_with('*');
  if (!in_structure_) {
    if (!readLocation(d)) last_error_ = t_;
  } else if (!profile_.incomplete_members && open) {
    if (!address_reported_) diagnostics_.report(diag::OpenAddressInStructure, here(), {textOf(t_)});
    address_reported_ = true;
  } else if (open) {
    readLocation(d);
  } else {
    readRelativeAddress(d);
  }
  advance();
}

// The address at the current token. False: it was reported.
bool DeclarationParser::readLocation(VarDecl& d) {
  d.located = true;
  d.address_loc = here();
  if (!readAddress(textOf(t_), here(), diagnostics_, d.address, numbers_)) return false;
  d.address.path = tree_.addList<uint32_t>(numbers_);
  return true;
}

void DeclarationParser::reportNoColon() {
  if (at(Tok::Assign) || at(Tok::LeftParen) || at(Tok::Dot) || at(Tok::LeftBracket) || at(Tok::PlusAssign))
    fail(diag::NotADeclaration, t_, {describe(t_)});
  else if (atLineStart())
    missing(diag::MissingToken, {":", describe(t_)}), panic_ = true;
  else if (isTypeWord(kind()) || at(Tok::Array) || at(Tok::Struct) ||
           (isName(kind()) && (peek() == Tok::Semicolon || peek() == Tok::Assign)))
    slip(diag::MissingToken, t_, {":", describe(t_)});
  else if (at(Tok::Semicolon) || at(Tok::Equal))
    fail(diag::MissingToken, t_, {":", describe(t_)});
  else
    fail(diag::NotADeclaration, t_, {describe(t_)});
}

// access name : path : type direction, or : %address : type direction
void DeclarationParser::parseAccessTarget(VarDecl& d) {
  if (at(Tok::Address)) {
    readLocation(d);
    advance();
  } else {
    parseAccessPath(d);
  }
  if (!panic_) expect(Tok::Colon);
}

// type [R_EDGE | F_EDGE] [READ_ONLY | READ_WRITE]: the edge follows the type; some programs write it before the type.
void DeclarationParser::parseVarType(VarDecl& d, SectionKind section) {
  const bool outer = std::exchange(in_variable_, true);
  d.type = parseType();
  in_variable_ = outer;
  if (!panic_ && (at(Tok::REdge) || at(Tok::FEdge))) {
    d.edge = at(Tok::REdge) ? EdgeKind::Rising : EdgeKind::Falling;
    advance();
  }
  if (section == SectionKind::Access) {
    d.read_only = !at(Tok::ReadWrite);
    if (!panic_ && (at(Tok::ReadOnly) || at(Tok::ReadWrite))) advance();
  }
}

// [":=" init | "REF=" expr]
void DeclarationParser::parseVarInit(VarDecl& d) {
  if (at(Tok::Equal) || (at(Tok::Colon) && peek() == Tok::Equal)) {
    slip(diag::AssignWithEqual, t_, {at(Tok::Equal) ? "=" : ": ="});
    if (at(Tok::Colon)) advance();
    advance();
    d.init = parseInit();
  } else if (accept(Tok::Assign)) {
    d.init = parseDeclaredInit(d.type);
  } else if (at(Tok::RefModifier) && peek() == Tok::Equal && profile_.reference_initialisers) {  // REF= x
    advance();
    advance();
    d.init = parseExpr();
  } else if ((at(Tok::Number) || at(Tok::True) || at(Tok::False) || at(Tok::StringLiteral) || at(Tok::Duration)) &&
             !atLineStart()) {
    slip(diag::MissingToken, t_, {":=", describe(t_)});
    d.init = parseInit();
  }
}

// The `;`, after which a doc comment may follow.
void DeclarationParser::endVar(VarDecl& d) {
  if (!panic_ && at(Tok::Semicolon)) {
    if (!d.h.doc) d.h.doc = docAfter(t_);
    advance();
    return;
  }
  if (!panic_) {
    if (at(Tok::RightParen) || at(Tok::RightBracket))
      fail(diag::StrayParen, t_, {textOf(t_)});
    else if (atLineStart() || endsDeclarations(kind()))
      missing(diag::MissingSemicolon, {describe(t_ - 1)});
    else if (isName(kind()) && (peek() == Tok::Colon || peek() == Tok::Comma))
      missing(diag::MissingSemicolon, {describe(t_ - 1)});
    else if (at(Tok::Error))
      last_error_ = t_, panic_ = true;
    else
      fail(diag::StrayToken, t_, {describe(t_)});
  }
  if (panic_) syncDeclaration(Tok::EndVar);
}

// AT %B2, %W1, %X3.0 of a member: its offset in the structure, in units of the given size.
void DeclarationParser::readRelativeAddress(VarDecl& d) {
  const std::string_view text = textOf(t_);
  d.address_loc = here();
  d.address.size = text.size() > 1 ? static_cast<char>(text[1] & ~0x20) : ' ';
  numbers_.clear();
  bool ok = std::string_view("XBWDL").find(d.address.size) != std::string_view::npos && text.size() > 2;
  for (size_t i = 2; ok && i < text.size();) {
    uint32_t number = 0;
    const auto read = std::from_chars(text.data() + i, text.data() + text.size(), number);
    ok = read.ec == std::errc{} && number < (1u << 24);
    numbers_.push_back(number);
    i = static_cast<size_t>(read.ptr - text.data());
    if (i == text.size()) break;
    ok = ok && text[i] == '.' && ++i < text.size();
  }
  const bool bit = d.address.size == 'X';
  ok = ok && !numbers_.empty() && numbers_.size() <= (bit ? 2u : 1u) && (numbers_.size() < 2 || numbers_[1] < 8);
  if (!ok) {
    fail(diag::RelativeAddress, t_, {text});
    return;
  }
  d.located = true;
  d.address.size_given = true;
  d.address.path = tree_.addList<uint32_t>(numbers_);
}

// path = {name "."} (name ["[" expr {"," expr} "]"] {"." …} | address)
void DeclarationParser::parseAccessPath(VarDecl& d) {
  ExprId path;
  if (!isName(kind())) fail(diag::MissingName, t_, {describe(t_)});
  while (!panic_ && isName(kind())) {
    const Ident name = ident(t_);
    path = path ? build_.member(path, name.name, name.loc) : build_.name(name);
    advance();
    ended(path);
    if (at(Tok::LeftBracket)) {
      advance();
      const size_t first = exprs_.size();
      do {
        exprs_.push_back(parseExpr());
      } while (!panic_ && accept(Tok::Comma));
      closeParen(Tok::RightBracket, false);
      path = ended(build_.index(path, listFrom(exprs_, first), name.loc));
    }
    if (panic_ || !accept(Tok::Dot)) break;
    if (at(Tok::Address)) {  // the resource, then an address
      readLocation(d);
      advance();
      return;
    }
  }
  d.init = path;
}

}  // namespace rung::text

// Sections and variables, names, pragmas and doc comments.
#include <algorithm>
#include <utility>

#include <charconv>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parser.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"

namespace rung::text {

bool endsDeclarations(Tok k) {
  return endsPart(k) || k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Program || k == Tok::Configuration ||
         k == Tok::Type || (k >= Tok::Var && k <= Tok::VarConfig) || isObjectWord(k);
}

namespace {

bool beginsDeclaration(const Token* t) {
  if (!isName(t->kind)) return false;
  const Tok next = t[1].kind;
  return next == Tok::Colon || next == Tok::Comma || next == Tok::At;
}

SectionKind sectionOf(Tok k) {
  switch (static_cast<int>(k)) {
    case static_cast<int>(Tok::VarInput): return SectionKind::Input;
    case static_cast<int>(Tok::VarOutput): return SectionKind::Output;
    case static_cast<int>(Tok::VarInOut): return SectionKind::InOut;
    case static_cast<int>(Tok::VarTemp): return SectionKind::Temp;
    case static_cast<int>(Tok::VarExternal): return SectionKind::External;
    case static_cast<int>(Tok::VarGlobal): return SectionKind::Global;
    case static_cast<int>(Tok::VarStat): return SectionKind::Stat;
    case static_cast<int>(Tok::VarInst): return SectionKind::Inst;
    case static_cast<int>(Tok::VarAccess): return SectionKind::Access;
    case static_cast<int>(Tok::VarConfig): return SectionKind::Config;
    default: return SectionKind::Local;
  }
}

}  // namespace

// ---- pragmas and doc comments

Slice<Pragma> Parser::takePragmas() {
  if ((t_->flags & kPragma) == 0) return {};
  const auto& all = stream_.pragmas;
  auto it = std::lower_bound(all.begin(), all.end(), t_->offset,
                             [](const PragmaRange& p, uint32_t offset) { return p.token_offset < offset; });
  std::vector<Pragma> list;
  for (; it != all.end() && it->token_offset == t_->offset; ++it) list.push_back(readPragma(*it));
  return tree_.addList<Pragma>(list);
}

// {name}  {name 'value'}  {name := 'value'}  {name: "value"}  {attribute 'name' := 'value'}; in any other pragma the
// rest after the name is the value, unchanged.
Pragma Parser::readPragma(const PragmaRange& pragma) {
  std::string_view rest = source_.substr(pragma.begin + 1, pragma.end - pragma.begin - 2);
  const auto skip = [&] {
    while (!rest.empty() && (static_cast<unsigned char>(rest.front()) <= ' ')) rest.remove_prefix(1);
    while (!rest.empty() && (static_cast<unsigned char>(rest.back()) <= ' ')) rest.remove_suffix(1);
  };
  const auto word = [&] {
    size_t n = 0;
    while (n < rest.size() &&
           (rest[n] == '_' || rest[n] == '+' || (rest[n] | 0x20) >= 'a' || (rest[n] >= '0' && rest[n] <= '9')) &&
           static_cast<unsigned char>(rest[n]) < 0x80 && rest[n] != '{' && rest[n] != '|' && rest[n] != '[' &&
           rest[n] != '^')
      ++n;
    const std::string_view w = rest.substr(0, n);
    rest.remove_prefix(n);
    skip();
    return w;
  };
  const auto quoted = [&](std::string_view& out) {
    if (rest.empty() || (rest.front() != '\'' && rest.front() != '"')) return false;
    const size_t close = rest.find(rest.front(), 1);
    if (close == std::string_view::npos) return false;
    out = rest.substr(1, close - 1);
    rest.remove_prefix(close + 1);
    skip();
    return true;
  };
  skip();
  std::string_view name = word(), value;
  if (sameIdentifier(name, "attribute")) {
    if (!quoted(name)) name = word();
  }
  if (rest.substr(0, 2) == ":=") {
    rest.remove_prefix(2);
    skip();
  } else if (rest.substr(0, 1) == ":") {
    rest.remove_prefix(1);
    skip();
  }
  if (!quoted(value)) value = rest;
  return {names_.intern(name), tree_.addString(value), Loc{base_ + pragma.begin}};
}

bool Parser::pragmaNamed(Slice<Pragma> pragmas, std::string_view name) const {
  for (const Pragma& p : const_cast<const Tree&>(tree_).list(pragmas))
    if (sameIdentifier(names_.string(p.name), name)) return true;
  return false;
}

Loc Parser::takeDoc() {
  if ((t_->flags & kDoc) == 0) return {};
  const auto& all = stream_.docs;
  const auto it = std::lower_bound(all.begin(), all.end(), t_->offset,
                                   [](const DocRange& d, uint32_t offset) { return d.token_offset < offset; });
  return it != all.end() && it->token_offset == t_->offset ? Loc{base_ + it->begin} : Loc{};
}

Loc Parser::docAfter(const Token* t) const {
  if ((t->flags & kDocAfter) == 0) return {};
  const auto& all = stream_.docs_after;
  const auto it = std::lower_bound(all.begin(), all.end(), t->offset,
                                   [](const DocRange& d, uint32_t offset) { return d.token_offset < offset; });
  return it != all.end() && it->token_offset == t->offset ? Loc{base_ + it->begin} : Loc{};
}

// ---- names

// Reports and skips one token that is not allowed here when the token after it is.
void Parser::skipStray(bool fits_after, Diag diag) {
  if (panic_ || !fits_after || endsDeclarations(kind())) return;
  if (at(Tok::Error))
    last_error_ = t_;
  else
    slip(diag, t_, {describe(t_)});
  advance();
}

bool Parser::beginsType(const Token* t) const {
  return isTypeWord(t->kind) || t->kind == Tok::Array || t->kind == Tok::Struct || t->kind == Tok::RefTo ||
         (isName(t->kind) && (t->flags & kLineStart) == 0) || t->kind == Tok::LeftParen;
}

bool Parser::parseName(Ident& out) {
  if (isName(kind()) || isNullName(t_)) {
    out = ident(t_);
    advance();
    return true;
  }
  if (nameReserved(t_)) {
    const Tok next = peek();
    if ((next == Tok::Colon || next == Tok::Comma || next == Tok::At || next == Tok::Assign ||
         next == Tok::RightParen || next == Tok::Semicolon) ||
        (t_[1].flags & kLineStart) != 0) {
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

void Parser::parseNamePath(Slice<Ident>& out) {
  const size_t first = idents_.size();
  do {
    if (isName(kind()) || isTypeWord(kind())) {
      idents_.push_back(ident(t_));
      advance();
    } else {
      fail(diag::MissingName, t_, {describe(t_)});
      break;
    }
  } while (accept(Tok::Dot));
  out = listFrom(idents_, first);
}

// ---- sections

// VAR_xxx {CONSTANT | RETAIN | NON_RETAIN | PERSISTENT} {variable} END_VAR
DeclId Parser::parseSection() {
  const Token* open = t_;
  SectionDecl d{{DeclKind::Section, 0, 0, here(), takeDoc(), takePragmas()}, sectionOf(kind()), AccessLevel::None, {}};
  if ((open->flags & (kSynthetic | kReported)) != 0) lost_ = true;  // it is unknown which section was meant
  advance();
  while (peek() != Tok::Colon && peek() != Tok::Comma && peek() != Tok::At) {
    const int bit = at(Tok::Constant)     ? kConstant
                    : at(Tok::Retain)     ? kRetain
                    : at(Tok::Persistent) ? kPersistent
                    : at(Tok::NonRetain)  ? int{kNonRetain}
                                          : 0;
    if (bit == 0 && !atLineStart() && acceptAccess(d.access)) continue;
    if (bit == 0) break;
    d.h.bits = static_cast<uint8_t>(d.h.bits | bit);
    advance();
  }
  // CONSTNAT on the line of the section
  if (at(Tok::Ident) && !atLineStart() && (t_[1].flags & kLineStart) != 0) {
    static constexpr Tok kKeywords[] = {Tok::Constant, Tok::Retain, Tok::NonRetain, Tok::Persistent};
    if (const Tok meant = nearKeyword(t_, kKeywords); meant != Tok::End) {
      correctSpelling(meant);
      d.h.bits |= meant == Tok::Constant     ? kConstant
                  : meant == Tok::Retain     ? kRetain
                  : meant == Tok::Persistent ? kPersistent
                                             : kNonRetain;
      advance();
    }
  }
  const size_t first = decls_.size();
  parseVars(d.section, Tok::EndVar, decls_);
  if (accept(Tok::EndVar)) {
    accept(Tok::Semicolon);
  } else {
    const std::string line = std::to_string(sources_.location(loc(open)).line);
    missing(diag::MissingEnd, {"END_VAR", spelling(open->kind), line});
  }
  d.vars = listFrom(decls_, first);
  if (lost_ && d.section == SectionKind::Global) tree_.lost_names = true;
  return tree_.add<DeclId>(d);
}

void Parser::parseVars(SectionKind section, Tok end, std::vector<DeclId>& out) {
  for (;;) {
    if (accept(Tok::Semicolon)) continue;
    if (at(end) || endsDeclarations(kind())) return;
    const Token* before = t_;
    skipStray(!isName(kind()) && !nameReserved(t_) && beginsDeclaration(t_ + 1) && !at(Tok::At), diag::NotADeclaration);
    const DeclId var = parseVar(section);
    if (var) out.push_back(var);
    if (t_ == before) advance();
  }
}

// variable = names [AT address] ":" type [R_EDGE | F_EDGE] [":=" init] ";"
DeclId Parser::parseVar(SectionKind section) {
  VarDecl d{{DeclKind::Var, 0, 0, here(), takeDoc(), takePragmas()}, {}, {}, {}, EdgeKind::None, false, {}, {}};
  const size_t first = idents_.size();
  const auto lost = [&] { lost_ = lost_ || panic_; };
  const bool dotted = section == SectionKind::Config;
  if (!(at(Tok::At) && peek() == Tok::Address)) {
    for (;;) {
      Ident name;
      if (!isName(kind()) && !isNullName(t_) && !nameReserved(t_)) {
        if (at(Tok::Error)) {
          last_error_ = t_;
          panic_ = true;
        } else if (atLineStart() && idents_.size() > first) {
          fail(diag::MissingName, t_ - 1, {describe(t_ - 1)});
        } else {
          fail(idents_.size() > first || at(Tok::Colon) || at(Tok::Comma) ? diag::MissingName : diag::NotADeclaration,
               t_, {describe(t_)});
        }
        break;
      }
      if (!parseName(name)) break;
      idents_.push_back(name);
      if (accept(Tok::Comma)) continue;
      if (dotted && accept(Tok::Dot)) continue;
      if (dotted && at(Tok::LeftBracket)) {
        // an array element in the path: the index is part of the instance, which VAR_CONFIG names as a whole
        while (!at(Tok::RightBracket) && !at(Tok::End) && !at(Tok::Semicolon)) advance();
        accept(Tok::RightBracket);
        if (accept(Tok::Dot)) continue;
      }
      // `a b : INT`
      if (isName(kind()) && !(at(Tok::At) && peek() == Tok::Address) && !atLineStart() && beginsDeclaration(t_)) {
        slip(diag::MissingToken, t_, {",", describe(t_)});
        continue;
      }
      break;
    }
  }
  lost();
  if (!panic_ && at(Tok::At)) {
    const Token* word = t_;
    advance();
    if (at(Tok::Address) && in_structure_) {
      // AT %I*: a variable in the image without an address yet; AT %B0: an offset in the structure
      if (dialect_ == Dialect::Codesys && textOf(t_).ends_with('*')) {
        if (!address_reported_) diagnostics_.report(diag::OpenAddressInStructure, here(), {textOf(t_)});
        address_reported_ = true;
      } else if (textOf(t_).ends_with('*')) {
        d.located = true;
        d.address_loc = here();
        readAddress(textOf(t_), here(), diagnostics_, d.address, numbers_);
      } else {
        readRelativeAddress(d);
      }
      advance();
    } else if (at(Tok::Address)) {
      d.located = true;
      d.address_loc = here();
      if (readAddress(textOf(t_), here(), diagnostics_, d.address, numbers_))
        d.address.path = tree_.addList<uint32_t>(numbers_);
      else
        last_error_ = t_;
      advance();
    } else {
      fail(diag::MissingValueAfter, word, {"`AT`"});
    }
  }
  if (!panic_ && !at(Tok::Colon)) skipStray(peek() == Tok::Colon, diag::StrayToken);
  if (!panic_ && !accept(Tok::Colon)) {
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
  if (!panic_ && section == SectionKind::Access) {
    // access name : path : type direction, or : %address : type direction
    if (at(Tok::Address)) {
      d.located = true;
      d.address_loc = here();
      if (readAddress(textOf(t_), here(), diagnostics_, d.address, numbers_))
        d.address.path = tree_.addList<uint32_t>(numbers_);
      advance();
    } else {
      parseAccessPath(d);
    }
    if (!panic_) expect(Tok::Colon);
  }
  lost();
  if (idents_.size() > first) d.h.loc = idents_[first].loc;
  d.names = listFrom(idents_, first);
  if (!panic_) {
    // The edge follows the type; some programs write it before the type.
    const bool outer = std::exchange(in_variable_, true);
    d.type = parseType();
    in_variable_ = outer;
    if (!panic_ && (at(Tok::REdge) || at(Tok::FEdge))) {
      d.edge = at(Tok::REdge) ? EdgeKind::Rising : EdgeKind::Falling;
      advance();
    }
    if (section == SectionKind::Access) {
      d.h.bits = at(Tok::ReadWrite) ? 0 : 1;
      if (!panic_ && (at(Tok::ReadOnly) || at(Tok::ReadWrite))) advance();
    }
  }
  if (!d.type) d.type = tree_.add<TypeExprId>(ErrorTypeExpr{{TypeExprKind::Error, 0, 0, d.h.loc, {}}});
  if (!panic_) {
    if (at(Tok::Equal) || (at(Tok::Colon) && peek() == Tok::Equal)) {
      slip(diag::AssignWithEqual, t_, {at(Tok::Equal) ? "=" : ": ="});
      if (at(Tok::Colon)) advance();
      advance();
      d.init = parseInit();
    } else if (accept(Tok::Assign)) {
      d.init = parseDeclaredInit(d.type);
    } else if ((at(Tok::Number) || at(Tok::True) || at(Tok::False) || at(Tok::StringLiteral) || at(Tok::Duration)) &&
               !atLineStart()) {
      slip(diag::MissingToken, t_, {":=", describe(t_)});
      d.init = parseInit();
    }
  }
  if (!panic_ && at(Tok::Semicolon)) {
    if (!d.h.doc) d.h.doc = docAfter(t_);
    advance();
  } else {
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
  return tree_.add<DeclId>(d);
}

void Parser::syncDeclaration(Tok end) {
  panic_ = false;
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

// AT %B2, %W1, %X3.0 of a member: its offset in the structure, in units of the given size.
void Parser::readRelativeAddress(VarDecl& d) {
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
void Parser::parseAccessPath(VarDecl& d) {
  ExprId path;
  if (!isName(kind())) fail(diag::MissingName, t_, {describe(t_)});
  while (!panic_ && isName(kind())) {
    const Ident name = ident(t_);
    ExprHeader header = exprHeader(path ? ExprKind::Member : ExprKind::Name, name.loc);
    path = path ? tree_.add<ExprId>(MemberExpr{header, path, name.name, {}})
                : tree_.add<ExprId>(NameExpr{header, name.name, {}});
    advance();
    if (at(Tok::LeftBracket)) {
      advance();
      const size_t first = exprs_.size();
      do {
        exprs_.push_back(parseExpr());
      } while (!panic_ && accept(Tok::Comma));
      closeParen(Tok::RightBracket, false);
      path = tree_.add<ExprId>(IndexExpr{exprHeader(ExprKind::Index, name.loc), path, listFrom(exprs_, first)});
    }
    if (panic_ || !accept(Tok::Dot)) break;
    if (at(Tok::Address)) {  // the resource, then an address
      d.located = true;
      d.address_loc = here();
      if (readAddress(textOf(t_), here(), diagnostics_, d.address, numbers_))
        d.address.path = tree_.addList<uint32_t>(numbers_);
      advance();
      return;
    }
  }
  d.init = path;
}

}  // namespace rung::text

// Objects: METHOD, ACTION, PROPERTY with its accessors, the modifiers of headers, NAMESPACE and USING.
// CLASS and INTERFACE are POUs of parser.cpp.
#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parser.h"
#include "frontend/source/dialect.h"

namespace rung::text {

// Keywords that are names unless a declaration begins with them: `METHOD Start`. Others become names here, so that the
// parser and the block repair need no further check; PROPERTY_GET and PROPERTY_SET are one kind with PROPERTY.
void resolveObjectKeywords(TokenStream& stream) {
  std::vector<Token>& tokens = stream.tokens;
  size_t kept = 0;
  for (const uint32_t i : stream.blocks) {
    Tok& k = tokens[i].kind;
    if (k == Tok::PropertyGet || k == Tok::PropertySet) k = Tok::Property;
    if (isObjectWord(k) || k == Tok::Using) {
      const Tok before = i == 0 ? Tok::Semicolon : tokens[i - 1].kind;
      const Token& next = tokens[i + 1];
      const bool names_something = isName(next.kind) && (next.flags & kLineStart) == 0;
      const bool behind_operator = (before > Tok::Semicolon && before <= Tok::EqualLess) ||
                                   (before >= Tok::And && before <= Tok::Not) || before == Tok::Mod;
      const bool line_start = (tokens[i].flags & kLineStart) != 0;
      if (!names_something || (!line_start && behind_operator)) {
        k = Tok::Ident;
        continue;
      }
    }
    stream.blocks[kept++] = i;
  }
  stream.blocks.resize(kept);
}

namespace {

AccessLevel accessOf(std::string_view word) {
  return sameIdentifier(word, "PUBLIC")      ? AccessLevel::Public
         : sameIdentifier(word, "PRIVATE")   ? AccessLevel::Private
         : sameIdentifier(word, "PROTECTED") ? AccessLevel::Protected
         : sameIdentifier(word, "INTERNAL")  ? AccessLevel::Internal
                                             : AccessLevel::None;
}
uint8_t modifierOf(std::string_view word) {
  return sameIdentifier(word, "ABSTRACT")   ? uint8_t{kAbstract}
         : sameIdentifier(word, "FINAL")    ? uint8_t{kFinal}
         : sameIdentifier(word, "OVERRIDE") ? uint8_t{kOverride}
                                            : uint8_t{0};
}

}  // namespace

bool Parser::acceptAccess(AccessLevel& access) {
  const AccessLevel level = at(Tok::Ident) ? accessOf(textOf(t_)) : AccessLevel::None;
  if (level == AccessLevel::None) return false;
  access = level;
  advance();
  return true;
}

// {PUBLIC | PRIVATE | PROTECTED | INTERNAL | ABSTRACT | FINAL | OVERRIDE} before a name, or (of accessors) at the end
// of the line.
// Forbids contradictory modifiers: two access levels, and ABSTRACT FINAL, which could never be instantiated.
//   fails   FUNCTION_BLOCK ABSTRACT FINAL Pump                                         E0345
void Parser::parseModifiers(AccessLevel& access, uint8_t& modifiers, bool before_name) {
  const Token* access_word = nullptr;
  const Token* final_word = nullptr;  // FINAL or ABSTRACT
  while (at(Tok::Ident) && !atLineStart()) {
    const bool name_follows =
        isName(peek()) && (t_[1].flags & kLineStart) == 0 && peek() != Tok::Extends && peek() != Tok::Implements;
    if (before_name && !name_follows) return;
    const Token* const word = t_;
    const Token** earlier = nullptr;
    const uint8_t modifier = modifierOf(textOf(t_));
    if ((modifiers & modifier) != 0) {
      diagnostics_.report(diag::DuplicateKeyword, loc(word), {textOf(word)});
      advance();
    } else if (modifier != 0) {
      modifiers = static_cast<uint8_t>(modifiers | modifier);
      if ((modifier & (kAbstract | kFinal)) != 0) earlier = &final_word;
      advance();
    } else if (acceptAccess(access)) {
      earlier = &access_word;
    } else {
      return;
    }
    if (earlier == nullptr) continue;
    if (*earlier != nullptr && sameIdentifier(textOf(*earlier), textOf(word)))
      diagnostics_.report(diag::DuplicateKeyword, loc(word), {textOf(word)});
    else if (*earlier != nullptr)
      diagnostics_.report(diag::KeywordsContradict, loc(word), {textOf(word), textOf(*earlier)});
    *earlier = word;
  }
}

// type {"," type}
Slice<TypeExprId> Parser::parseTypeNames() {
  std::vector<TypeExprId> list;
  advance();
  do {
    NamedTypeExpr named{{TypeExprKind::Named, 0, 0, here(), {}}, {}, {}, false, {}};
    parseNamePath(named.path);
    if (panic_) break;
    list.push_back(tree_.add<TypeExprId>(named));
  } while (accept(Tok::Comma));
  return tree_.addList<TypeExprId>(list);
}

// METHOD … END_METHOD | ACTION … END_ACTION | PROPERTY … END_PROPERTY
void Parser::parseMember(std::vector<DeclId>& out) {
  const bool declared_in_body = declared_in_body_, lost = lost_;
  const Tok pou_end = pou_end_;
  const Known pou_closes = pou_closes_;
  panic_ = false;
  if (!at(Tok::Property))
    out.push_back(parsePou());
  else if (is(t_, "PROPERTY"))
    out.push_back(parseProperty());
  else
    parseHalfProperty(out);
  panic_ = false;
  declared_in_body_ = declared_in_body;
  lost_ = lost;
  pou_end_ = pou_end;
  pou_closes_ = pou_closes;
}

bool Parser::atAccessor() const {
  if (!at(Tok::Get) && !at(Tok::Set)) return false;
  const Tok next = peek();
  return (t_[1].flags & kLineStart) != 0 || next == Tok::Semicolon || next < Tok::Semicolon || next > Tok::EqualLess;
}

// [PROPERTY | PROPERTY_GET | PROPERTY_SET] modifiers name ":" type [";"]
Ident Parser::parsePropertyHeader(PropertyDecl& d) {
  d.h = {DeclKind::Property, 0, 0, here(), takeDoc(), takePragmas()};
  d.begin = here();
  advance();
  parseModifiers(d.access, d.modifiers, true);
  Ident name{{}, here()};
  if (parseName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
  }
  if (!panic_ && expect(Tok::Colon)) d.type = parseType();
  if (panic_) {
    while (!atLineStart() && !at(Tok::End)) advance();
    panic_ = false;
  }
  if (!d.type) d.type = tree_.add<TypeExprId>(ErrorTypeExpr{{TypeExprKind::Error, 0, 0, d.h.loc, {}}});
  accept(Tok::Semicolon);
  return name;
}

// PROPERTY header {GET sections statements [END_GET] | SET … [END_SET]} [END_PROPERTY]
DeclId Parser::parseProperty() {
  PropertyDecl d{};
  const Token* open = t_;
  const Ident name = parsePropertyHeader(d);
  ++in_property_;
  while (atAccessor()) {
    const bool is_set = at(Tok::Set);
    const DeclId accessor = parseAccessor(name, d);
    DeclId& slot = is_set ? d.set : d.get;
    if (slot) diagnostics_.report(diag::DuplicateKeyword, tree_.loc(accessor), {is_set ? "SET" : "GET"});
    slot = accessor;
  }
  --in_property_;
  if (accept(Tok::EndProperty)) {
    accept(Tok::Semicolon);
  } else if (dialect_ != Dialect::Codesys) {
    const std::string line = std::to_string(sources_.location(loc(open)).line);
    missing(diag::MissingEnd, {"END_PROPERTY", "PROPERTY", line});
  }
  return tree_.add<DeclId>(d);
}

// PROPERTY_GET header sections statements END_PROPERTY | PROPERTY_SET …: edition 4. Two of the same name are one
// property.
void Parser::parseHalfProperty(std::vector<DeclId>& out) {
  PropertyDecl d{};
  const Token* open = t_;
  const bool is_set = is(t_, "PROPERTY_SET");
  const Ident name = parsePropertyHeader(d);
  d.h.bits = kInHalves;
  PouDecl accessor{};
  accessor.h = {DeclKind::Pou, 0, 0, d.h.loc, {}, {}};
  accessor.access = d.access;
  accessor.modifiers = d.modifiers;
  accessor.begin = here();
  (is_set ? d.set : d.get) = parseAccessorBody(accessor, name, d, is_set, Tok::EndProperty);
  if (t_[-1].kind != Tok::EndProperty && t_[-1].kind != Tok::Semicolon) {
    const std::string line = std::to_string(sources_.location(loc(open)).line);
    missing(diag::MissingEnd, {"END_PROPERTY", is_set ? "PROPERTY_SET" : "PROPERTY_GET", line});
  }
  for (const DeclId known : out) {
    if (tree_.kind(known) != DeclKind::Property) continue;
    auto& other = tree_.as<PropertyDecl>(known);
    if (other.h.bits != kInHalves || (is_set ? other.set : other.get)) continue;
    if (!names_.same(other.name, d.name)) continue;
    (is_set ? other.set : other.get) = is_set ? d.set : d.get;
    other.modifiers &= d.modifiers;  // of the whole property; each half keeps its own
    return;
  }
  out.push_back(tree_.add<DeclId>(d));
}

DeclId Parser::parseAccessor(const Ident& property, const PropertyDecl& of) {
  PouDecl d{};
  d.h = {DeclKind::Pou, 0, 0, here(), takeDoc(), takePragmas()};
  d.access = of.access;
  d.modifiers = of.modifiers;
  d.begin = here();
  const bool is_set = at(Tok::Set);
  advance();
  parseModifiers(d.access, d.modifiers, false);
  accept(Tok::Semicolon);
  return parseAccessorBody(d, property, of, is_set, is_set ? Tok::EndSet : Tok::EndGet);
}

// sections statements [`end`]
DeclId Parser::parseAccessorBody(PouDecl& d, const Ident& property, const PropertyDecl& of, bool is_set, Tok end) {
  d.name = property.name;
  d.pou_kind = PouKind::Method;
  const size_t first = decls_.size();
  if (is_set) {
    VarDecl value{{DeclKind::Var, 0, 0, property.loc, {}, {}}, {}, of.type, {}, EdgeKind::None, false, {}, {}};
    value.names = tree_.addList<Ident>({&property, 1});
    SectionDecl input{{DeclKind::Section, 0, 0, property.loc, {}, {}}, SectionKind::Input, AccessLevel::None, {}};
    const DeclId var = tree_.add<DeclId>(value);
    input.vars = tree_.addList<DeclId>({&var, 1});
    decls_.push_back(tree_.add<DeclId>(input));
  } else {
    d.result = of.type;
  }
  declared_in_body_ = lost_ = false;
  pou_end_ = end;
  pou_closes_ = Known::Yes;
  while (atSection()) {
    const DeclId section = parseSection();
    decls_.push_back(section);
  }
  d.sections = listFrom(decls_, first);
  parseBody(d);
  if (lost_ || declared_in_body_) d.h.bits |= kBrokenDeclarations;
  d.closed = true;
  if (accept(end)) accept(Tok::Semicolon);
  d.end = index() > 0 ? endOf(t_ - 1) : here();
  return tree_.add<DeclId>(d);
}

// NAMESPACE [INTERNAL] a.b {declaration} END_NAMESPACE
DeclId Parser::parseNamespace() {
  NamespaceDecl d{{DeclKind::Namespace, 0, 0, here(), takeDoc(), takePragmas()}, {}, {}};
  const Token* open = t_;
  advance();
  AccessLevel access{};
  uint8_t modifiers = 0;
  parseModifiers(access, modifiers, true);
  if (access == AccessLevel::Internal) d.h.bits |= kInternal;
  d.h.loc = here();
  parseNamePath(d.path);
  panic_ = false;
  accept(Tok::Semicolon);
  std::vector<DeclId> decls;
  while (!at(Tok::End) && !at(Tok::EndNamespace)) parseTopLevel(decls);
  d.decls = tree_.addList<DeclId>(decls);
  if (accept(Tok::EndNamespace)) {
    accept(Tok::Semicolon);
  } else {
    const std::string line = std::to_string(sources_.location(loc(open)).line);
    missing(diag::MissingEnd, {"END_NAMESPACE", "NAMESPACE", line});
  }
  return tree_.add<DeclId>(d);
}

// USING a.b {"," c} ";"
void Parser::parseUsing(std::vector<DeclId>& out) {
  advance();
  do {
    UsingDecl d{{DeclKind::Using, 0, 0, here(), {}, {}}, {}};
    parseNamePath(d.path);
    if (panic_) break;
    out.push_back(tree_.add<DeclId>(d));
  } while (accept(Tok::Comma));
  endStatement(nullptr);
}

}  // namespace rung::text

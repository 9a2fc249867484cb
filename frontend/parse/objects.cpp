// SPDX-License-Identifier: Apache-2.0
// Objects: METHOD, ACTION, PROPERTY with its accessors, the modifiers of headers, NAMESPACE and USING.
// CLASS and INTERFACE are POUs of parser.cpp.
#include <algorithm>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parser.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::text {

// METHOD : INT on a line of its own: as a variable's declaration or as a statement it would end with a semicolon.
static bool lineLacksSemicolon(const std::vector<Token>& tokens, size_t at) {
  for (size_t i = at + 1; i < tokens.size() && (tokens[i].flags & kLineStart) == 0; ++i)
    if (tokens[i].kind == Tok::Semicolon) return false;
  return true;
}

// `class AT %MW2`, and `STEP class AT 0, 40` of a chart.
static bool isPlaced(const Token* name) {
  return name[1].kind == Tok::At &&
         (name[2].kind == Tok::Address || name[2].kind == Tok::Number || name[2].kind == Tok::Minus);
}

// Words after which the name of something follows on the same line: `TRANSITION class FROM`, `PROGRAM class WITH`.
static bool needsName(Tok kind) {
  static constexpr TokSet kWords = {Tok::Function, Tok::FunctionBlock, Tok::Program,    Tok::Class,     Tok::Interface,
                                    Tok::Method,   Tok::Property,      Tok::Action,     Tok::Namespace, Tok::Extends,
                                    Tok::Resource, Tok::Task,          Tok::Transition, Tok::With};
  return kWords.has(kind);
}

// Keywords that are names unless a declaration begins with them: `METHOD Start`. Others become names here, so that the
// parser and the block repair need no further check; PROPERTY_GET and PROPERTY_SET are one kind with PROPERTY.
void resolveObjectKeywords(TokenStream& stream) {
  std::vector<Token>& tokens = stream.tokens;
  const bool closes_methods = std::any_of(stream.blocks.begin(), stream.blocks.end(),
                                          [&](uint32_t b) { return tokens[b].kind == Tok::EndMethod; });
  size_t kept = 0;
  for (const uint32_t i : stream.blocks) {
    Tok& k = tokens[i].kind;
    if (k == Tok::PropertyGet || k == Tok::PropertySet) k = Tok::Property;
    if (isObjectWord(k) || k == Tok::Using) {
      const Tok before = i == 0 ? Tok::Semicolon : tokens[i - 1].kind;
      const Token& next = tokens[i + 1];
      const bool names_something = isName(next.kind) && (next.flags & kLineStart) == 0 && !isPlaced(&tokens[i]);
      const bool behind_operator = (before > Tok::Semicolon && before <= Tok::EqualLess) ||
                                   (before >= Tok::And && before <= Tok::Not) || before == Tok::Mod;
      const bool line_start = (tokens[i].flags & kLineStart) != 0;
      const bool lost_its_name =
          k == Tok::Method && line_start && !names_something && closes_methods && lineLacksSemicolon(tokens, i);
      if ((!names_something && !lost_its_name) || (!line_start && (behind_operator || needsName(before)))) {
        k = Tok::Ident;
        continue;
      }
    }
    stream.blocks[kept++] = i;
  }
  stream.blocks.resize(kept);
}

// METHOD … END_METHOD | ACTION … END_ACTION | PROPERTY … END_PROPERTY
void Parser::parseMember(std::vector<DeclId>& out) {
  const bool declared_in_body = declared_in_body_, lost = lost_;
  const Tok pou_end = pou_end_;
  const Known pou_closes = pou_closes_;
  panic_ = false;
  const Tok end = at(Tok::Property) ? Tok::EndProperty : at(Tok::Method) ? Tok::EndMethod : Tok::EndAction;
  if (!enterDecl(end)) return;
  if (!at(Tok::Property))
    out.push_back(parsePou());
  else if (is(t_, "PROPERTY"))
    out.push_back(parseProperty());
  else
    parseHalfProperty(out);
  --decl_depth_;
  panic_ = false;
  declared_in_body_ = declared_in_body;
  lost_ = lost;
  pou_end_ = pou_end;
  pou_closes_ = pou_closes;
}

// [PROPERTY | PROPERTY_GET | PROPERTY_SET] modifiers name ":" type [";"]
Ident Parser::parsePropertyHeader(PropertyDecl& d) {
  d.h = declHeader(DeclKind::Property);
  advance();
  parseModifiers(d.access, d.modifiers, true);
  Ident name{{}, here()};
  if (parseNewName(name)) {
    d.name = name.name;
    d.h.loc = name.loc;
  }
  declares_ = true;
  if (!panic_ && expect(Tok::Colon)) {
    if (atLineStart() && atAccessor())
      missing(diag::MissingTypeAfter, {describe(t_ - 1)});
    else
      d.type = parseType();
  }
  declares_ = false;
  if (panic_) {
    const Skipping skipping(*this);
    while (!atLineStart() && !at(Tok::End)) advance();
    panic_ = false;
  }
  if (!d.type) d.type = build_.errorType(d.h.loc);
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
  } else if (!profile_.optional_ends) {
    missingEnd("END_PROPERTY", open, "PROPERTY");
  }
  return finish(d);
}

// PROPERTY_GET header sections statements END_PROPERTY | PROPERTY_SET …: edition 4. Two of the same name are one
// property.
void Parser::parseHalfProperty(std::vector<DeclId>& out) {
  PropertyDecl d{};
  const Token* open = t_;
  const bool is_set = is(t_, "PROPERTY_SET");
  const Ident name = parsePropertyHeader(d);
  d.in_halves = true;
  PouDecl accessor{};
  accessor.h = header(DeclKind::Pou, d.h.loc);
  accessor.access = d.access;
  accessor.modifiers = d.modifiers;
  accessor.h.begin = here();
  (is_set ? d.set : d.get) = parseAccessorBody(accessor, name, d, is_set, Tok::EndProperty);
  if (t_[-1].kind != Tok::EndProperty && t_[-1].kind != Tok::Semicolon) {
    missingEnd("END_PROPERTY", open, is_set ? "PROPERTY_SET" : "PROPERTY_GET");
  }
  for (const DeclId known : out) {
    if (tree_.kind(known) != DeclKind::Property) continue;
    auto& other = tree_.as<PropertyDecl>(known);
    if (!other.in_halves || (is_set ? other.set : other.get)) continue;
    if (!names_.same(other.name, d.name)) continue;
    (is_set ? other.set : other.get) = is_set ? d.set : d.get;
    other.modifiers &= d.modifiers;  // of the whole property; each half keeps its own
    return;
  }
  out.push_back(finish(d));
}

// (GET | SET) modifiers [";"] sections statements [END_GET | END_SET]
DeclId Parser::parseAccessor(const Ident& property, const PropertyDecl& of) {
  PouDecl d{};
  d.h = declHeader(DeclKind::Pou);
  d.access = of.access;
  d.modifiers = of.modifiers;
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
    const DeclId value = build_.variable(property, of.type);
    decls_.push_back(build_.section(SectionKind::Input, {&value, 1}, property.loc));
  } else {
    d.result = of.type;
  }
  declared_in_body_ = lost_ = false;
  const size_t outer_variables = variables_.size();
  pou_end_ = end;
  pou_closes_ = Known::Yes;
  while (at(Tok::CppFile) || atSection()) {
    if (acceptCppFile(d)) continue;
    const DeclId section = parseSection();
    decls_.push_back(section);
  }
  d.sections = listFrom(decls_, first);
  parseBody(d);
  checkCppFile(d);
  variables_.resize(outer_variables);
  d.is_broken = lost_ || declared_in_body_;
  d.closed = true;
  if (accept(end)) accept(Tok::Semicolon);
  d.h.end = index() > 0 ? endOf(t_ - 1) : here();
  return tree_.add<DeclId>(d);
}

// NAMESPACE [INTERNAL] a.b {declaration} END_NAMESPACE
DeclId Parser::parseNamespace() {
  NamespaceDecl d{declHeader(DeclKind::Namespace), {}, {}, false};
  const Token* open = t_;
  advance();
  AccessLevel access{};
  uint8_t modifiers = 0;
  parseModifiers(access, modifiers, true);
  d.is_internal = access == AccessLevel::Internal;
  d.h.loc = here();
  const Token* const path = t_;
  parseNamePath(d.path);
  if (d.path.count > kMaxDeclDepth) {
    const std::string limit = std::to_string(kMaxDeclDepth);
    fail(diag::TooDeep, path, {"namespaces", limit});
    d.path.count = 1;
  }
  panic_ = false;
  accept(Tok::Semicolon);
  std::vector<DeclId> decls;
  while (!at(Tok::End) && !at(Tok::EndNamespace)) parseTopLevel(decls);
  d.decls = tree_.addList<DeclId>(decls);
  if (accept(Tok::EndNamespace)) {
    accept(Tok::Semicolon);
  } else {
    missingEnd("END_NAMESPACE", open, "NAMESPACE");
  }
  --decl_depth_;
  return finish(d);
}

// USING a.b {"," c} ";"
void Parser::parseUsing(std::vector<DeclId>& out) {
  advance();
  do {
    UsingDecl d{header(DeclKind::Using, here()), {}};
    parseNamePath(d.path);
    if (panic_) break;
    out.push_back(finish(d));
  } while (accept(Tok::Comma));
  endStatement();
}

}  // namespace rung::text

// SPDX-License-Identifier: Apache-2.0
// Types: the entries of TYPE … END_TYPE, and the types of variables and entries. In: the current tokens. Out: TypeDecl
// and type expressions. Called by declarations.cpp, objects.cpp and parser.cpp.
#include <algorithm>
#include <utility>

#include "frontend/parse/declarations.h"
#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"

namespace rung::text {

// ---- TYPE

// TYPE [access] {[access] name [EXTENDS type] ":" type [":=" init] [";"]} END_TYPE
void DeclarationParser::parseTypes(std::vector<DeclId>& out) {
  const Token* open = t_;
  Slice<Pragma> pragmas = takePragmas();
  Loc doc = takeDoc();
  declares_ = true;
  advance();
  AccessLevel access{};
  uint8_t modifiers = 0;
  if (!atLineStart()) parseModifiers(access, modifiers, false);
  for (;;) {
    if (accept(Tok::Semicolon)) continue;
    if (accept(Tok::EndType)) {
      declares_ = false;
      accept(Tok::Semicolon);
      return;
    }
    if (endsDeclarations(kind())) {
      declares_ = false;
      missingEnd("END_TYPE", open, "TYPE");
      return;
    }
    if (t_[0].flags & kPragma) pragmas = takePragmas();
    if (t_[0].flags & kDoc) doc = takeDoc();
    const DeclId entry = parseTypeEntry(pragmas, doc, access);
    if (entry) out.push_back(entry);
    pragmas = {};
    doc = {};
  }
}

// STRUCT name {fields} END_STRUCT
void Cursor::skipStructOfC() {
  slip(diag::StructForm, t_, {textOf(t_ + 1)});
  tree_.lost_names = true;
  const Skipping skipping(*this);
  while (!at(Tok::End) && !at(Tok::EndStruct) && !at(Tok::EndType)) advance();
  accept(Tok::EndStruct);
  accept(Tok::Semicolon);
}

// [access] name [EXTENDS type] ":" type [":=" init] [";"]
DeclId DeclarationParser::parseTypeEntry(Slice<Pragma> pragmas, Loc doc, AccessLevel access) {
  lost_ = false;
  while (at(Tok::Ident) && isName(peek()) && (is(t_, "PUBLIC") || is(t_, "INTERNAL") || is(t_, "ABSTRACT"))) {
    if (is(t_, "INTERNAL")) access = AccessLevel::Internal;
    advance();
  }
  if (at(Tok::Struct) && isName(peek())) {
    skipStructOfC();
    return {};
  }
  skipStray(!isName(kind()) && isName(peek()) && peek(2) == Tok::Colon, diag::MissingName);
  TypeDecl d{header(DeclKind::Type, here(), doc, pragmas), {}, {}, {}, access == AccessLevel::Internal};
  Ident name;
  if (!parseNewName(name)) {
    tree_.lost_names = true;
    if (!endsDeclarations(kind())) advance();
    syncDeclaration(Tok::EndType);
    return {};
  }
  d.name = name.name;
  TypeExprId base;
  if (at(Tok::Extends)) {
    advance();
    base = parseNamedType();
  }
  if (!panic_ && !at(Tok::Colon)) skipStray(peek() == Tok::Colon, diag::StrayToken);
  if (!panic_) expect(Tok::Colon);
  in_variable_ = false;
  const Loc type_begin = here();
  if (!panic_) d.type = parseType();
  if (panic_ || !d.type || lost_) tree_.lost_names = true;
  const bool no_type = !d.type;
  if (no_type) d.type = build_.errorType(d.h.loc);
  const bool is_struct = tree_.kind(d.type) == TypeExprKind::Struct;
  if (base && is_struct) tree_.as<StructTypeExpr>(d.type).base = base;
  if (!panic_) {
    if (acceptAssign()) d.init = parseInit();
  }
  if (!panic_ && !accept(Tok::Semicolon) && !(is_struct && (at(Tok::EndType) || atLineStart()))) {
    if (atLineStart() || endsDeclarations(kind()) || (isName(kind()) && peek() == Tok::Colon))
      missing(diag::MissingSemicolon, {describe(t_ - 1)});
    else if (at(Tok::RightParen) || at(Tok::RightBracket))
      fail(diag::StrayParen, t_, {textOf(t_)});
    else
      fail(diag::StrayToken, t_, {describe(t_)});
  }
  if (panic_) {
    tree_.lost_names = true;  // another declaration may have been skipped
    syncDeclaration(Tok::EndType);
  }
  if (no_type) holdSkipped(d.type, type_begin);
  return finish(d);
}

// ---- type expressions

// type = array | structure | enumeration | (REF_TO | POINTER TO | REFERENCE TO) type | named type
TypeExprId DeclarationParser::parseType() {
  if (++type_depth_ > kMaxTypeDepth) {
    tooDeep("types", kMaxTypeDepth);
    --type_depth_;
    return {};
  }
  TypeExprId type;
  if (atLineStart() && lineEnds()) {
    fail(diag::MissingType, t_, {describe(t_)});
    --type_depth_;
    return {};
  }
  if (!beginsType(t_) && (!isName(kind()) || atLineStart()) && !at(Tok::Union) && !at(Tok::Semicolon))
    skipStray(beginsType(t_ + 1) && (t_[1].flags & kLineStart) == 0, diag::MissingType);
  const Loc start = here();
  if (at(Tok::Array)) {
    type = parseArray();
  } else if (at(Tok::Struct) || at(Tok::Union)) {
    type = parseStruct();
  } else if (at(Tok::LeftParen)) {
    type = parseEnum({});
  } else if (at(Tok::RefTo) || ((at(Tok::Pointer) || at(Tok::Reference)) && peek() == Tok::To)) {
    const PointerForm form = at(Tok::RefTo)     ? PointerForm::RefTo
                             : at(Tok::Pointer) ? PointerForm::Pointer
                                                : PointerForm::Reference;
    advance();
    if (form != PointerForm::RefTo) advance();
    const TypeExprId target = parseType();
    type = tree_.add<TypeExprId>(PointerTypeExpr{header(TypeExprKind::Pointer, start), target, form});
  } else if (isName(kind()) || isTypeWord(kind())) {
    type = parseNamedType();
  } else if (at(Tok::Error)) {
    last_error_ = t_;
    panic_ = true;
  } else {
    const Token* const marked = atLineStart() ? t_ - 1 : t_;
    fail(diag::MissingType, marked, {describe(marked)});
  }
  --type_depth_;
  return ended(type);
}

// name {"." name} [generics] [elements | arguments] | string | INT "(" low ".." high ")" | INT "(" items ")"
TypeExprId DeclarationParser::namedType() {
  const Loc start = here();
  // USTRING is a keyword of edition 4 only: a type of the project may have its name.
  const bool is_utf8 = at(Tok::Ident) && is(t_, "USTRING") && (peek() == Tok::LeftBracket || peek() == Tok::LeftParen);
  if (is_utf8) return stringType(StringEncoding::Utf8);
  if (at(Tok::String)) return stringType(StringEncoding::Bytes);
  if (at(Tok::Wstring)) return stringType(StringEncoding::Wide);
  NamedTypeExpr named{header(TypeExprKind::Named, start), {}, {}, false, {}, {}};
  Token* const first = t_;
  parseNamePath(named.path);
  if (!panic_ && at(Tok::Less) && profile_.type_arguments) named.generics = parseGenerics();
  const TypeExprId base = ended(tree_.add<TypeExprId>(named));
  if (panic_) return base;
  if (const Tok meant = misspelledType(first); meant != Tok::End) {
    t_ = first;
    correctSpelling(meant);
    return meant == Tok::Array ? parseArray() : parseType();
  }
  if (in_variable_ && at(Tok::LeftBracket) && peek() == Tok::LeftParen) {
    tree_.as<NamedTypeExpr>(base).elements = parseElementArguments();
    return base;
  }
  if (!at(Tok::LeftParen)) return base;
  if (in_variable_ && !isTypeWord(first->kind) && !rangeFollows()) {  // of FB_Init
    Loc end;
    NamedTypeExpr& block = tree_.as<NamedTypeExpr>(base);
    block.arguments = parseArguments(end);
    block.has_arguments = true;
    return base;
  }
  // `INT (a, b := 2)` is an enumeration, `INT (0..9)` a subrange.
  const Tok next = peek(2);
  if (isName(peek()) && (next == Tok::Comma || next == Tok::RightParen || next == Tok::Assign)) return parseEnum(base);
  advance();
  SubrangeTypeExpr d{header(TypeExprKind::Subrange, start), base, {}, {}};
  d.low = parseExpr();
  if (!panic_) expect(Tok::DotDot);
  d.high = panic_ ? build_.error(here()) : parseExpr();
  closeParen(Tok::RightParen, false);
  return tree_.add<TypeExprId>(d);
}

// string = (STRING | WSTRING | USTRING) ["[" expr "]" | "(" expr ")"]
TypeExprId DeclarationParser::stringType(StringEncoding code) {
  StringTypeExpr d{header(TypeExprKind::String, here()), {}, code};
  advance();
  if (at(Tok::LeftBracket) || at(Tok::LeftParen)) {
    const Tok close = at(Tok::LeftBracket) ? Tok::RightBracket : Tok::RightParen;
    advance();
    d.length = parseExpr();
    closeParen(close, false);
  }
  return tree_.add<TypeExprId>(d);
}

// The keyword that a name before `[` or TO is most likely meant to be; End: none.
Tok DeclarationParser::misspelledType(const Token* name) const {
  static constexpr Tok kArray[] = {Tok::Array}, kPointers[] = {Tok::Pointer, Tok::Reference};
  if (name->kind != Tok::Ident) return Tok::End;
  if (at(Tok::LeftBracket)) return nearKeyword(name, kArray);
  return at(Tok::To) && t_ == name + 1 ? nearKeyword(name, kPointers) : Tok::End;
}

// elements = "[" arguments {"," arguments} "]": of FB_Init of each element
Slice<ExprId> DeclarationParser::parseElementArguments() {
  std::vector<ExprId> elements;
  advance();
  do {
    if (!at(Tok::LeftParen)) break;
    const Loc open = here();
    Loc end;
    const Slice<Argument> arguments = parseArguments(end);
    elements.push_back(ended(build_.call({}, arguments, open, end)));
  } while (!panic_ && accept(Tok::Comma));
  if (!panic_) expect(Tok::RightBracket);
  return tree_.addList<ExprId>(elements);
}

// generics = "<" generic {"," generic} ">"; generic = primary | "(" name ":=" expr ")"
Slice<Argument> DeclarationParser::parseGenerics() {
  std::vector<Argument> list;
  advance();
  do {
    Argument a{};
    a.loc = here();
    if (at(Tok::LeftParen) && isName(peek()) && peek(2) == Tok::Assign) {
      advance();
      a.pin = ident(t_);
      advance();
      advance();
      a.value = parseExpr();
      closeParen(Tok::RightParen, false);
    } else {
      a.value = at(Tok::Minus) ? parseUnary() : parsePrimary();
    }
    list.push_back(a);
  } while (!panic_ && accept(Tok::Comma));
  if (!panic_) expect(Tok::Greater);
  return tree_.addList<Argument>(list);
}

// Tells whether the parentheses here contain `low .. high`.
bool DeclarationParser::rangeFollows() const {
  uint32_t depth = 0;
  for (const Token* t = t_; t->kind != Tok::End && t->kind != Tok::Semicolon; ++t) {
    if (t->kind == Tok::LeftParen) ++depth;
    if (t->kind == Tok::RightParen && --depth == 0) return false;
    if (t->kind == Tok::DotDot && depth == 1) return true;
  }
  return false;
}

// STRUCT [EXTENDS type] [OVERLAP] {variable} END_STRUCT, UNION {variable} END_UNION
TypeExprId DeclarationParser::parseStruct() {
  const Token* open = t_;
  StructTypeExpr d{header(TypeExprKind::Struct, here()), {}, {}, at(Tok::Union), false};
  const Tok end = d.is_union ? Tok::EndUnion : Tok::EndStruct;
  advance();
  if (at(Tok::Extends) && isName(peek())) {
    advance();
    d.base = parseNamedType();
  }
  if (at(Tok::Ident) && is(t_, "OVERLAP") && isName(peek())) {
    d.overlaps = true;
    advance();
  }
  const size_t first = decls_.size();
  const bool outer = std::exchange(in_structure_, true);
  address_reported_ = false;
  parseVars(SectionKind::Local, end, decls_);
  in_structure_ = outer;
  if (!accept(end)) {
    missingEnd(spelling(end), open, spelling(open->kind));
  }
  d.fields = listFrom(decls_, first);
  return tree_.add<TypeExprId>(d);
}

// "(" name [":=" expr] {"," name [":=" expr]} ")" [type]
TypeExprId DeclarationParser::parseEnum(TypeExprId base) {
  EnumTypeExpr d{header(TypeExprKind::Enum, here()), {}, base};
  advance();
  std::vector<EnumItem> items;
  while (!panic_ && !at(Tok::RightParen)) {
    EnumItem item{};
    if (!parseNewName(item.item)) break;
    if (acceptAssign()) item.value = parseExpr();
    items.push_back(item);
    if (accept(Tok::Comma)) {
      if (at(Tok::RightParen)) {
        if (profile_.trailing_commas)
          removal(diagnostics_.report(diag::TrailingCommaWarning, loc(t_ - 1)), t_ - 1, Sureness::Proposal);
        else
          slip(diag::TrailingComma, t_ - 1);
      }
      continue;
    }
    if (!panic_ && isName(kind()) && (peek() == Tok::Comma || peek() == Tok::RightParen || peek() == Tok::Assign)) {
      missingComma();
      continue;
    }
    break;
  }
  bool lost = panic_;
  closeParen(Tok::RightParen, true);
  lost = lost || panic_ || t_[-1].kind != Tok::RightParen;
  lost_ = lost_ || lost;
  d.items = tree_.addList<EnumItem>(items);
  if (lost) return build_.errorType(d.h.loc);  // with items that are not known
  if (!d.base && (isName(kind()) || isTypeWord(kind())) && !atLineStart()) d.base = parseNamedType();
  return tree_.add<TypeExprId>(d);
}

// ARRAY "[" (low ".." high | "*") {"," …} "]" OF type
TypeExprId DeclarationParser::parseArray() {
  ArrayTypeExpr d{header(TypeExprKind::Array, here()), {}, {}};
  advance();
  if (!accept(Tok::LeftBracket)) {
    if (at(Tok::LeftParen)) {
      slip(diag::WrongKeyword, t_, {"(", "["});
      advance();
    } else {
      slip(diag::MissingToken, t_, {"[", describe(t_)});
    }
  }
  std::vector<ArrayBound> bounds;
  do {
    if (at(Tok::Star)) {
      advance();
      bounds.push_back({});
      continue;
    }
    ArrayBound bound{parseExpr(), {}};
    if (!panic_ && !accept(Tok::DotDot)) {
      if (at(Tok::RightBracket) && tree_.kind(bound.low) == ExprKind::Literal &&
          tree_.as<LiteralExpr>(bound.low).literal() == LiteralKind::Integer) {
        const uint64_t size = tree_.as<LiteralExpr>(bound.low).value();
        const std::string written = std::to_string(size), last = std::to_string(size == 0 ? 0 : size - 1);
        slip(diag::ArraySize, t_ - 1, {written, last})
            .replace(loc(t_ - 1), endOf(t_ - 1), "0.." + last, Sureness::Sure);
        bound.high = build_.literal(LiteralKind::Integer, size == 0 ? 0 : size - 1, tree_.loc(bound.low));
        tree_.as<LiteralExpr>(bound.low).setValue(0);
      } else if (isOperand(kind())) {
        slip(diag::MissingToken, t_, {"..", describe(t_)});
      } else {
        fail(diag::MissingToken, t_, {"..", describe(t_)});
      }
    }
    if (!bound.high) bound.high = panic_ ? build_.error(here()) : parseExpr();
    bounds.push_back(bound);
  } while (!panic_ && accept(Tok::Comma));
  if (!panic_ && at(Tok::RightParen)) {
    slip(diag::WrongKeyword, t_, {")", "]"});
    advance();
  } else if (!panic_ && at(Tok::Of)) {
    slip(diag::MissingToken, t_, {"]", describe(t_)});
  } else {
    closeParen(Tok::RightBracket, false);
  }
  d.bounds = tree_.addList<ArrayBound>(bounds);
  if (!panic_) expect(Tok::Of);
  if (!panic_) d.element = parseType();
  return tree_.add<TypeExprId>(d);
}

}  // namespace rung::text

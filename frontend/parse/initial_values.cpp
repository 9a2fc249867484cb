// SPDX-License-Identifier: Apache-2.0
// Initial values of declarations: expressions, arrays with repetitions, structures. In: the tokens after `:=`. Out:
// expressions of the tree; sema decides whether `n(1, 2)` is a call or a repetition.
#include <utility>

#include "frontend/parse/declarations.h"
#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"

namespace rung::text {

// The value after `:=` of a declaration. CODESYS 2.3 writes the values of an array without brackets.
ExprId DeclarationParser::parseDeclaredInit(TypeExprId type) {
  if (!profile_.values_without_brackets || at(Tok::LeftBracket) || tree_.kind(type) != TypeExprKind::Array)
    return parseInit();
  const Loc start = here();
  const size_t first = exprs_.size();
  parseElements(Tok::Semicolon);
  if (exprs_.size() == first) return build_.error(start);
  if (exprs_.size() == first + 1 && tree_.kind(exprs_[first]) != ExprKind::Repeat) {
    const ExprId only = exprs_[first];
    exprs_.resize(first);
    return only;
  }
  return ended(build_.arrayInit(listFrom(exprs_, first), start));
}

// init = expr | "[" elements "]" | "(" [field ":=" init {"," …}] ")"
ExprId DeclarationParser::parseInit() {
  if (at(Tok::LeftBracket)) return parseArrayInit();
  if (at(Tok::LeftParen) && isName(peek()) && peek(2) == Tok::Assign) return parseStructInit();
  if (at(Tok::LeftParen) && peek() == Tok::RightParen && profile_.empty_structure_values) return parseStructInit();
  return parseExpr();
}

// elements = element {"," element}; element = init | count "(" [elements] ")". Left on exprs_.
void DeclarationParser::parseElements(Tok close) {
  while (!panic_ && !at(close)) {
    parseElement();
    if (accept(Tok::Comma)) continue;
    if (!panic_ && isOperand(kind()) && !atLineStart()) {
      slip(diag::MissingToken, t_, {",", describe(t_)});
      continue;
    }
    break;
  }
}

// element = init | (number | name) "(" [init {"," init}] ")"
void DeclarationParser::parseElement() {
  // N(1, 2) looks like a call; sema tells them apart.
  const bool named =
      isName(kind()) && peek() == Tok::LeftParen &&
      (peek(2) == Tok::LeftBracket || (peek(2) == Tok::LeftParen && isName(peek(3)) && peek(4) == Tok::Assign));
  if (!named && !(at(Tok::Number) && peek() == Tok::LeftParen)) {
    exprs_.push_back(parseInit());
    return;
  }
  const Loc count_loc = here();
  const ExprId count = named ? build_.name(nameOf(t_), count_loc) : parseNumber({}, false, count_loc);
  if (named) advance();
  ended(count);
  advance();
  const size_t inner = exprs_.size();
  while (!panic_ && !at(Tok::RightParen)) {
    exprs_.push_back(parseInit());
    if (!accept(Tok::Comma)) break;
  }
  closeParen(Tok::RightParen, true);
  const Slice<ExprId> elements = listFrom(exprs_, inner);
  exprs_.push_back(ended(build_.repeat(count, elements, count_loc)));
}

// "[" [elements] "]"
ExprId DeclarationParser::parseArrayInit() {
  const Loc start = here();
  if (isName(peek()) && peek(2) == Tok::Assign && declares_) {  // [x := 1.0, y := 2.0]
    advance();
    slip(diag::StructureInBrackets, t_ - 1, {textOf(t_)});
    const std::vector<FieldInit> fields = parseFieldInits(Tok::RightBracket);
    const Loc close = here();
    const bool is_closed = at(Tok::RightBracket);
    closeParen(Tok::RightBracket, true);
    Diagnostic* const reported = is_closed ? diagnostics_.reportedAt(diag::StructureInBrackets, start) : nullptr;
    Report(reported).fix(
        {"Write parentheses", {{start, {start.offset + 1}, "("}, {close, {close.offset + 1}, ")"}}, true});
    return ended(build_.structInit(fields, start));
  }
  if (!enterExpr("initial values")) return build_.error(start);
  advance();
  const size_t first = exprs_.size();
  parseElements(Tok::RightBracket);
  closeParen(Tok::RightBracket, true);
  --expr_depth_;
  return ended(build_.arrayInit(listFrom(exprs_, first), start));
}

// "(" [field ":=" init {"," …}] ")"
ExprId DeclarationParser::parseStructInit() {
  const Loc start = here();
  if (!enterExpr("initial values")) return build_.error(start);
  advance();
  const std::vector<FieldInit> fields = parseFieldInits(Tok::RightParen);
  closeParen(Tok::RightParen, true);
  --expr_depth_;
  return ended(build_.structInit(fields, start));
}

// init | element {"," element}: the value of a member. CODESYS 2.3 writes the values of an array without brackets: `a
// := 1, 2(0), b := 3`.
ExprId DeclarationParser::parseFieldValue(Tok close) {
  if (!profile_.values_without_brackets || at(Tok::LeftBracket)) return parseInit();
  const Loc start = here();
  const size_t first = exprs_.size();
  for (;;) {
    parseElement();
    if (panic_ || !at(Tok::Comma) || peek() == close ||
        ((isName(peek()) || isNullName(t_ + 1)) && peek(2) == Tok::Assign))
      break;
    advance();
  }
  if (exprs_.size() == first + 1 && tree_.kind(exprs_[first]) != ExprKind::Repeat) {
    const ExprId only = exprs_[first];
    exprs_.resize(first);
    return only;
  }
  return ended(build_.arrayInit(listFrom(exprs_, first), start));
}

// field ":=" init {"," …}
std::vector<FieldInit> DeclarationParser::parseFieldInits(Tok close) {
  std::vector<FieldInit> fields;
  while (!panic_ && !at(close)) {
    FieldInit field{};
    if (!parseName(field.field)) break;
    if (!acceptAssign()) {
      fail(diag::MissingToken, t_, {":=", describe(t_)});
      break;
    }
    field.value = parseFieldValue(close);
    fields.push_back(field);
    if (accept(Tok::Comma)) continue;
    if (!panic_ && isName(kind()) && peek() == Tok::Assign) {
      missingComma();
      continue;
    }
    break;
  }
  return fields;
}

}  // namespace rung::text

// SPDX-License-Identifier: Apache-2.0
// Modifiers of headers: access levels, ABSTRACT, FINAL, OVERRIDE; and lists of type names after EXTENDS and IMPLEMENTS.
#include "frontend/parse/declarations.h"
#include "frontend/parse/diagnostics.h"

namespace rung::text {

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

bool DeclarationParser::acceptAccess(AccessLevel& access) {
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
void DeclarationParser::parseModifiers(AccessLevel& access, uint8_t& modifiers, bool before_name) {
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
      removal(diagnostics_.report(diag::DuplicateKeyword, loc(word), {textOf(word)}), word, Sureness::Sure);
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
      removal(diagnostics_.report(diag::DuplicateKeyword, loc(word), {textOf(word)}), word, Sureness::Sure);
    else if (*earlier != nullptr)
      diagnostics_.report(diag::KeywordsContradict, loc(word), {textOf(word), textOf(*earlier)});
    *earlier = word;
  }
}

// CODESYS ignores a comma after the last name.
bool DeclarationParser::endsWithComma() {
  if (!profile_.trailing_commas || (isName(kind()) && !isObjectWord(kind()) && !at(Tok::Implements))) return false;
  removal(diagnostics_.report(diag::ListEndsWithComma, loc(t_ - 1)), t_ - 1, Sureness::Proposal);
  return true;
}

// types = (EXTENDS | IMPLEMENTS) path [generics] {"," path [generics]} [","]
Slice<TypeExprId> DeclarationParser::parseTypeNames() {
  std::vector<TypeExprId> list;
  advance();
  do {
    NamedTypeExpr named{header(TypeExprKind::Named, here()), {}, {}, false, {}, {}};
    parseNamePath(named.path);
    if (!panic_ && at(Tok::Less) && profile_.type_arguments) named.generics = parseGenerics();
    if (panic_) break;
    list.push_back(ended(tree_.add<TypeExprId>(named)));
  } while (accept(Tok::Comma) && !endsWithComma());
  return tree_.addList<TypeExprId>(list);
}

}  // namespace rung::text

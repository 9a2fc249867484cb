// SPDX-License-Identifier: Apache-2.0
#include "frontend/format/spacing.h"

#include "frontend/source/names.h"

namespace rung::format {
namespace {

using text::Tok;
using text::TokSet;

constexpr TokSet kBinary = {Tok::Assign,      Tok::Arrow,     Tok::PlusAssign,   Tok::MinusAssign, Tok::StarAssign,
                            Tok::SlashAssign, Tok::TryAssign, Tok::Plus,         Tok::Minus,       Tok::Star,
                            Tok::Slash,       Tok::Power,     Tok::Equal,        Tok::NotEqual,    Tok::Less,
                            Tok::LessEqual,   Tok::Greater,   Tok::GreaterEqual, Tok::Ampersand};
// Keywords before an operand: a parenthesis after them is not that of a call.
constexpr TokSet kBeforeOperand = {Tok::And,   Tok::AndThen, Tok::Or,    Tok::OrElse, Tok::Xor, Tok::Mod, Tok::If,
                                   Tok::Elsif, Tok::While,   Tok::Until, Tok::Case,   Tok::Of,  Tok::To,  Tok::By};
constexpr TokSet kCalled = {Tok::Ident,  Tok::RightParen, Tok::RightBracket, Tok::Caret,
                            Tok::String, Tok::Wstring,    Tok::Array};

// REF=, S= and R= are one operator.
bool isModifiedEqual(std::string_view source, const Piece& before, const Piece& next) {
  if (next.token != Tok::Equal || next.blank) return false;
  const std::string_view word = source.substr(before.begin, before.end - before.begin);
  return sameIdentifier(word, "REF") || sameIdentifier(word, "S") || sameIdentifier(word, "R");
}

}  // namespace

bool isSeparated(std::string_view source, const Piece& before, const Piece& next, Colons colons) {
  if (next.kind != PieceKind::Token || before.kind != PieceKind::Token) return next.blank;
  if (next.gap != Gap::Free) return next.gap == Gap::Blank;
  const Tok a = before.token, b = next.token;
  if (b == Tok::Semicolon || b == Tok::Comma || b == Tok::RightParen || b == Tok::RightBracket) return false;
  if (a == Tok::LeftParen || a == Tok::LeftBracket) return false;
  if (a == Tok::Semicolon || a == Tok::Comma || a == Tok::Network) return true;
  if (a == Tok::Dot || b == Tok::Dot || b == Tok::Caret || a == Tok::Hash || b == Tok::Hash) return false;
  if (before.is_unary) return false;
  if (b == Tok::Colon) return next.is_label ? false : colons == Colons::Declares || next.blank;
  if (a == Tok::Colon) return true;
  if (isModifiedEqual(source, before, next)) return false;
  if (kBinary.has(b) || kBinary.has(a)) return true;
  if (text::isReserved(b)) return true;
  if (b == Tok::LeftParen && kBeforeOperand.has(a)) return true;
  if ((b == Tok::LeftParen || b == Tok::LeftBracket) && kCalled.has(a)) return false;
  return next.blank;
}

}  // namespace rung::format

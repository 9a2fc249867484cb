// SPDX-License-Identifier: Apache-2.0
#include "frontend/format/pieces.h"

#include <algorithm>

#include "frontend/parse/lexer.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/files.h"
#include "frontend/source/names.h"

namespace rung::format {
namespace {

using text::Tok;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

// + and - after an operator, an opening bracket, a comma or a keyword.
bool isSign(const Piece& piece, const Piece* before) {
  if (piece.token != Tok::Minus && piece.token != Tok::Plus) return false;
  if (before == nullptr) return true;
  static constexpr text::TokSet kValues = {
      Tok::Number, Tok::Duration, Tok::Address,   Tok::StringLiteral, Tok::WideStringLiteral,
      Tok::Date,   Tok::DateTime, Tok::TimeOfDay, Tok::RightParen,    Tok::RightBracket,
      Tok::Caret,  Tok::True,     Tok::False,     Tok::Null};
  return !kValues.has(before->token) && !text::isName(before->token);
}

// Words that are names elsewhere: POINTER before TO, AT before an address, CONSTANT after VAR, and the others between
// two names, where no name can be.
bool isKeyword(const std::vector<text::Token>& tokens, size_t k) {
  const Tok token = tokens[k].kind, next = tokens[k + 1].kind, before = k == 0 ? Tok::End : tokens[k - 1].kind;
  if (token == Tok::Null) return false;  // a member or an item may have this name
  if (text::isReserved(token) || text::isTypeWord(token)) return true;
  static constexpr text::TokSet kModifiers = {Tok::Constant, Tok::Retain, Tok::NonRetain, Tok::Persistent};
  static constexpr text::TokSet kBetween = {Tok::Extends, Tok::Implements, Tok::With, Tok::On};
  static constexpr text::TokSet kBefore = {Tok::Method,   Tok::Property,   Tok::Interface, Tok::Action,
                                           Tok::Class,    Tok::Namespace,  Tok::Using,     Tok::InitialStep,
                                           Tok::Resource, Tok::Transition, Tok::Task};
  if (token == Tok::Pointer || token == Tok::Reference) return next == Tok::To;
  if (token == Tok::At) return next == Tok::Address;
  if (kModifiers.has(token)) return (before >= Tok::Var && before <= Tok::VarConfig) || kModifiers.has(before);
  // `METHOD PUBLIC On` ends the line with its name.
  if (kBetween.has(token)) {
    const bool ends_line = (tokens[k + 1].flags & text::kLineStart) != 0;
    return !ends_line && !kBefore.has(before) && text::isName(before) && text::isName(next);
  }
  return kBefore.has(token) && text::isName(next);
}

}  // namespace

std::vector<Piece> piecesOf(std::string_view source, Dialect dialect) {
  Sources sources;
  Names names;
  Diagnostics unused(sources);  // the parser reports what is wrong
  const FileId file = sources.add("", std::string(source));
  if (!file) return {};
  const uint32_t base = sources.begin(file).offset;
  const std::string_view text = sources.sourceText(file);
  std::vector<Comment> comments;
  text::TokenStream stream;
  stream.comments = &comments;
  text::lex(stream, names, sources, file, 0, static_cast<uint32_t>(text.size()), dialect, unused);
  text::resolveObjectKeywords(stream);

  std::vector<Piece> pieces;
  pieces.reserve(stream.tokens.size() + comments.size() + stream.pragmas.size());
  for (size_t k = 0; stream.tokens[k].kind != Tok::End; ++k) {
    const text::Token& token = stream.tokens[k];
    const bool is_name = text::isName(token.kind) || text::isTypeWord(token.kind);
    const uint32_t length = !is_name                ? token.value
                            : token.name_length > 0 ? token.name_length
                                                    : static_cast<uint32_t>(names.string(NameId{token.value}).size());
    pieces.push_back({token.offset, token.offset + length, PieceKind::Token, token.kind, 0, false});
    pieces.back().is_keyword = isKeyword(stream.tokens, k);
  }
  for (const Comment& comment : comments)
    pieces.push_back(
        {comment.range.begin.offset - base, comment.range.end.offset - base, PieceKind::Comment, Tok::End, 0, false});
  for (const text::PragmaRange& pragma : stream.pragmas)
    pieces.push_back({pragma.begin, pragma.end, PieceKind::Pragma, Tok::End, 0, false});
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.begin < b.begin; });

  uint32_t at = 0;
  const Piece* before = nullptr;
  for (Piece& piece : pieces) {
    if (piece.begin < at) return {};
    for (uint32_t k = at; k < piece.begin; ++k) {
      if (!isBlank(text[k])) return {};
      piece.newlines += text[k] == '\n' ? 1 : 0;
      piece.blank = true;
    }
    at = piece.end;
    if (piece.kind != PieceKind::Token) continue;
    piece.is_unary = isSign(piece, before);
    before = &piece;
  }
  for (; at < text.size(); ++at)
    if (!isBlank(text[at])) return {};
  return pieces;
}

}  // namespace rung::format

// SPDX-License-Identifier: Apache-2.0
// The lexer of the text languages. In: the source of a file, which ends in a NUL. Out: one array of tokens, closed by
// kLookahead End tokens, with the pragmas and doc comments beside it. Names are interned directly from the source.
// Literals are evaluated by literals.h only when the parser consumes them, so a token that recovery skips causes no
// diagnostic. Called by parser.cpp.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/parse/parse.h"
#include "frontend/parse/tokens.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/source/names.h"
#include "frontend/syntax/trivia.h"

namespace rung::text {

enum TokenFlag : uint8_t {
  kLineStart = 1,   // the first token of its line
  kPragma = 2,      // pragmas precede it
  kDoc = 4,         // `///` lines above it
  kDocAfter = 8,    // `///` follows on its line
  kReported = 16,   // the lexer has reported this token
  kSynthetic = 32,  // inserted by recovery, at the offset of the next real token
};
struct Token {
  uint32_t offset;  // in the file
  uint32_t value;   // NameId of names and type words, length of all others
  Tok kind;
  uint8_t flags;
  uint16_t name_length;  // of names and type words; 0: see Names
};

// Pragmas and doc comments are looked up by the token to which they belong.
struct PragmaRange {
  uint32_t token_offset;  // of the token that follows
  uint32_t begin, end;    // with its braces
};
struct DocRange {
  uint32_t token_offset;  // of the token that follows, or of the preceding one for `///` after it
  uint32_t begin;
};

constexpr uint32_t kLookahead = 4;

struct TokenStream {
  std::vector<Token> tokens;
  std::vector<PragmaRange> pragmas;
  std::vector<DocRange> docs;
  std::vector<DocRange> docs_after;
  std::vector<Comment>* comments = nullptr;  // gets all comments; none: they are not kept
  std::vector<uint32_t> blocks;              // indices of the keywords that open or close blocks, for recover.h
};

// Reads [begin, end) of the file's source.
void lex(TokenStream& out, Names& names, const Sources& sources, FileId file, uint32_t begin, uint32_t end,
         Dialect dialect, Diagnostics& diagnostics);

// Tells whether a line begins with an instruction of IL that cannot begin a statement or declaration: an operator such
// as LD or JMP, followed by an operand (il.cpp).
bool beginsIl(Tok kind, std::string_view text, const Token& next);

// Turns object keywords that begin no declaration into names (objects.cpp).
void resolveObjectKeywords(TokenStream& stream);

// Tells whether a word is the keyword of an elementary type, such as INT, which no variable can have as its name.
bool isElementaryType(std::string_view word);

}  // namespace rung::text

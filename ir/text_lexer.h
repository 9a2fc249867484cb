// SPDX-License-Identifier: Apache-2.0
// Tokens of IR text. In: the content of a file. Out: all tokens, the last of kind End. `;` is white space: a line that
// begins with it is a comment, elsewhere it separates fields or statements for the reader's eye.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"

namespace rung::ir::text_form {

enum class TokenKind : uint8_t {
  End,
  Name,    // if, up, Ramp; `loop` in backticks: quoted
  Number,  // 12, 0.5, 1e+20
  Text,    // 'abc'
  String,  // "abc"
  Punct,   // one character, or `..`
  Bad,     // a character that begins no token, or a string without end
};

struct Token {
  TokenKind kind = TokenKind::End;
  bool quoted = false;  // Name: in backticks, so never a keyword
  bool first_in_line = false;
  Loc loc;
  std::string_view text;  // Name, Text, String: without quotes, escapes as written
};

std::vector<Token> tokenize(std::string_view text, Loc begin);

// Resolves $-escapes of a quoted string: `$$`, `$'`, `$0A`.
std::string unescape(std::string_view text);

}  // namespace rung::ir::text_form

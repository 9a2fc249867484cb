// SPDX-License-Identifier: Apache-2.0
// Tokens of IR text: see text_lexer.h.
#include "ir/text_lexer.h"

namespace rung::ir::text_form {

namespace {
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
int hexDigit(char c) {
  if (isDigit(c)) return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}
}  // namespace

std::vector<Token> tokenize(std::string_view text, Loc begin) {
  std::vector<Token> tokens;
  size_t i = 0;
  bool first_in_line = true;
  while (true) {
    while (i < text.size()) {  // blanks and comments
      char c = text[i];
      if (c == '\n') {
        first_in_line = true;
      } else if (c == ';' && first_in_line) {
        while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
      } else if (c != ' ' && c != '\t' && c != '\r' && c != ';') {
        break;
      }
      ++i;
    }
    Token token;
    token.loc = Loc{begin.offset + static_cast<uint32_t>(i)};
    token.first_in_line = first_in_line;
    first_in_line = false;
    if (i >= text.size()) {
      token.first_in_line = true;
      tokens.push_back(token);
      return tokens;
    }
    const size_t start = i;
    const char c = text[i++];
    if (isNameStart(c)) {
      token.kind = TokenKind::Name;
      while (i < text.size() && (isNameStart(text[i]) || isDigit(text[i]))) ++i;
      token.text = text.substr(start, i - start);
    } else if (isDigit(c)) {
      token.kind = TokenKind::Number;
      while (i < text.size() && isDigit(text[i])) ++i;
      if (i + 1 < text.size() && text[i] == '.' && isDigit(text[i + 1])) {
        ++i;
        while (i < text.size() && isDigit(text[i])) ++i;
      }
      if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        size_t exponent = i + 1;
        if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
        if (exponent < text.size() && isDigit(text[exponent])) {
          i = exponent;
          while (i < text.size() && isDigit(text[i])) ++i;
        }
      }
      token.text = text.substr(start, i - start);
    } else if (c == '\'' || c == '"' || c == '`') {
      token.kind = c == '`' ? TokenKind::Name : c == '"' ? TokenKind::String : TokenKind::Text;
      token.quoted = true;
      while (i < text.size() && text[i] != c && text[i] != '\n') i += text[i] == '$' ? 2 : 1;
      if (i >= text.size() || text[i] != c) {
        token.kind = TokenKind::Bad;
        i = i > text.size() ? text.size() : i;
        token.text = text.substr(start, i - start);
      } else {
        token.text = text.substr(start + 1, i - start - 1);
        ++i;
      }
    } else {
      static constexpr std::string_view kPunct = "{}()[],:=!^.#-@$%";
      token.kind = kPunct.find(c) != std::string_view::npos ? TokenKind::Punct : TokenKind::Bad;
      if (c == '.' && i < text.size() && text[i] == '.') ++i;
      token.text = text.substr(start, i - start);
    }
    tokens.push_back(token);
  }
}

std::string unescape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '$' || i + 1 >= text.size()) {
      out += text[i];
      continue;
    }
    const int high = hexDigit(text[i + 1]);
    const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
    if (high >= 0 && low >= 0) {
      out += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      out += text[++i];
    }
  }
  return out;
}

}  // namespace rung::ir::text_form

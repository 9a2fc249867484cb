// SPDX-License-Identifier: Apache-2.0
// Tokens of IR text: see text_lexer.h.
#include "ir/text_lexer.h"

#include <algorithm>

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

class Lexer {
 public:
  Lexer(std::string_view text, Loc begin) : text_(text), begin_(begin) {}

  std::vector<Token> run() {
    std::vector<Token> tokens;
    bool first_in_line = true;
    for (;;) {
      skipBlanks(first_in_line);
      Token token;
      token.loc = Loc{begin_.offset + static_cast<uint32_t>(at_)};
      token.first_in_line = first_in_line || at_ >= text_.size();
      first_in_line = false;
      if (at_ < text_.size()) read(token);
      tokens.push_back(token);
      if (token.kind == TokenKind::End) return tokens;
    }
  }

 private:
  bool atEnd() const { return at_ >= text_.size(); }
  void skipDigits() {
    while (!atEnd() && isDigit(text_[at_])) ++at_;
  }

  // Blanks and comments.
  void skipBlanks(bool& first_in_line) {
    for (; !atEnd(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') {
        first_in_line = true;
      } else if (c == ';' && first_in_line) {
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      } else if (c != ' ' && c != '\t' && c != '\r' && c != ';') {
        return;
      }
    }
  }

  void read(Token& token) {
    const size_t start = at_;
    const char c = text_[at_++];
    if (c == '\'' || c == '"' || c == '`') return readQuoted(token, c);
    if (isNameStart(c)) {
      token.kind = TokenKind::Name;
      while (!atEnd() && (isNameStart(text_[at_]) || isDigit(text_[at_]))) ++at_;
    } else if (isDigit(c)) {
      token.kind = TokenKind::Number;
      skipNumber();
    } else {
      static constexpr std::string_view kPunct = "{}()[],:=!^.#-@$%";
      token.kind = kPunct.find(c) != std::string_view::npos ? TokenKind::Punct : TokenKind::Bad;
      if (c == '.' && !atEnd() && text_[at_] == '.') ++at_;
    }
    token.text = text_.substr(start, at_ - start);
  }

  // The digits, the fraction and the exponent; `3..5` has no fraction.
  void skipNumber() {
    skipDigits();
    if (at_ + 1 < text_.size() && text_[at_] == '.' && isDigit(text_[at_ + 1])) {
      ++at_;
      skipDigits();
    }
    if (atEnd() || (text_[at_] != 'e' && text_[at_] != 'E')) return;
    size_t exponent = at_ + 1;
    if (exponent < text_.size() && (text_[exponent] == '+' || text_[exponent] == '-')) ++exponent;
    if (exponent >= text_.size() || !isDigit(text_[exponent])) return;
    at_ = exponent;
    skipDigits();
  }

  // Up to the same quote on the same line; `$` escapes.
  void readQuoted(Token& token, char quote) {
    const size_t start = at_;
    token.kind = quote == '`' ? TokenKind::Name : quote == '"' ? TokenKind::String : TokenKind::Text;
    token.quoted = true;
    while (!atEnd() && text_[at_] != quote && text_[at_] != '\n') at_ += text_[at_] == '$' ? 2 : 1;
    at_ = std::min(at_, text_.size());
    if (atEnd() || text_[at_] != quote) {
      token.kind = TokenKind::Bad;
      token.text = text_.substr(start - 1, at_ - (start - 1));
    } else {
      token.text = text_.substr(start, at_ - start);
      ++at_;
    }
  }

  std::string_view text_;
  Loc begin_;
  size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, Loc begin) { return Lexer(text, begin).run(); }

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

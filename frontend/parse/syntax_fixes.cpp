// SPDX-License-Identifier: Apache-2.0
#include "frontend/parse/syntax_fixes.h"

#include "frontend/source/scanner.h"

namespace rung::text {
namespace {

bool isWord(std::string_view text) { return !text.empty() && isNameCharacter(text.front()); }
bool isBlankAt(std::string_view source, size_t at) { return at >= source.size() || isBlankCharacter(source[at]); }

size_t beginOfLine(std::string_view source, size_t at) {
  const size_t end = at == 0 ? std::string_view::npos : source.rfind('\n', at - 1);
  return end == std::string_view::npos ? 0 : end + 1;
}

// The end of the line that follows a token, its comments included; `before`: another token is on this line.
size_t endOfLineAfter(std::string_view source, size_t after, size_t before) {
  size_t at = after;
  while (at < before && source[at] != '\n') {
    const std::string_view rest = source.substr(at, 2);
    if (rest == "(*" || rest == "//" || rest == "/*")
      at = endOfComment(source, at);
    else if (source[at] == '{')
      at = endOfPragma(source, at);
    else
      ++at;
  }
  if (at >= before) return before;
  return at > after && source[at - 1] == '\r' ? at - 1 : at;
}

}  // namespace

std::string_view indentOf(std::string_view source, size_t at) {
  const size_t line = beginOfLine(source, at);
  size_t end = line;
  while (end < at && (source[end] == ' ' || source[end] == '\t')) ++end;
  return source.substr(line, end - line);
}

Insertion insertedAfter(std::string_view source, size_t after, std::string_view word) {
  const bool is_apart = isWord(word) || word == ":=" || word == "=>";
  std::string text = (is_apart ? " " : "") + std::string(word);
  if ((is_apart || word == ",") && !isBlankAt(source, after) && source[after] != ';') text += ' ';
  return {after, std::move(text)};
}

std::string inPlaceOf(std::string_view source, size_t begin, size_t end, std::string_view word) {
  const bool is_word = isWord(word) || (!word.empty() && isNameCharacter(word.back()));
  std::string text(word);
  if (is_word && begin > 0 && isNameCharacter(source[begin - 1])) text.insert(0, " ");
  if (is_word && end < source.size() && isNameCharacter(source[end])) text += ' ';
  return text;
}

Insertion endOfBlock(std::string_view source, size_t open, size_t after, size_t before, std::string_view end_word) {
  const std::string word(end_word);
  const bool on_one_line = source.substr(open, after - open).find('\n') == std::string_view::npos;
  if (on_one_line) return {after, " " + word};
  const size_t end = endOfLineAfter(source, after, before);
  if (end == before && before < source.size()) return {before, word + " "};
  return {end, "\n" + std::string(indentOf(source, open)) + word};
}

size_t beginOfRemoval(std::string_view source, size_t token) {
  size_t begin = token;
  while (begin > 0 && (source[begin - 1] == ' ' || source[begin - 1] == '\t')) --begin;
  return begin;
}

}  // namespace rung::text

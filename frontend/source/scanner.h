// SPDX-License-Identifier: Apache-2.0
// Divides ST into comments, pragmas, strings, names and numbers without parsing it. In: a source. Out: its units one
// after the other; blanks are left out, any other character is a unit of its own. For readers of vendor files, which
// look for the beginnings and ends of POUs, and for all others that handle source as text. The lexer of frontend/parse
// finds the same ends, and reports what is not closed.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "frontend/source/text.h"

namespace rung {

enum class UnitKind : uint8_t { End, Comment, Pragma, String, Name, Number, Other };

struct Unit {
  UnitKind kind;
  size_t begin, end;
};

class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  Unit next();
  // The next unit that is not a comment or a pragma.
  Unit nextCode();
  std::string_view textOf(const Unit& unit) const { return source_.substr(unit.begin, unit.end - unit.begin); }
  void moveTo(size_t at) { at_ = at; }
  size_t at() const { return at_; }

 private:
  std::string_view source_;
  size_t at_ = 0;
  bool nests_ = true;  // false after (* @NESTEDCOMMENTS := 'No' *) of CODESYS 2.3
};

// The offset after the comment, string or pragma that begins at `at`. Not closed: the end of the source; of a string,
// the end of its line.
size_t endOfComment(std::string_view source, size_t at, bool nests = true);
size_t endOfString(std::string_view source, size_t at);
size_t endOfPragma(std::string_view source, size_t at);  // strings in a pragma may contain braces

// The first word of a source after comments and pragmas, in upper case: FUNCTION_BLOCK. Empty: it begins otherwise.
std::string firstWord(std::string_view source);

// Tells whether the source begins with a declaration outside of POUs: PROGRAM, TYPE, VAR_GLOBAL, …
bool startsDeclaration(std::string_view source);
// END_FUNCTION for FUNCTION; empty for words that do not begin a POU.
std::string_view endWordOf(std::string_view word);

bool isBlankCharacter(char c);
// Whether one of these words begins a pragma: {word …}.
bool hasPragma(std::string_view text, std::initializer_list<std::string_view> words);
bool isNameCharacter(char c);           // ASCII only
bool isIdentifier(std::string_view s);  // in ASCII
bool isPath(std::string_view s);        // identifiers, separated by dots

// Without the byte order mark of UTF-8.
std::string_view withoutMark(std::string_view source);

}  // namespace rung

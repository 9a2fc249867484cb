// SPDX-License-Identifier: Apache-2.0
// The kinds of tokens, and sets and tables over them. tokens.def lists the kinds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace rung::text {

enum class Tok : uint8_t {
#define RUNG_TOKEN(name, what) name,
#define RUNG_PUNCT(name, spelling) name,
#define RUNG_WORD(name, spelling) name,
#define RUNG_TYPE_WORD(name, spelling) name,
#define RUNG_SOFT_WORD(name, spelling) name,
#include "frontend/parse/tokens.def"
};
constexpr uint32_t kTokCount = static_cast<uint32_t>(Tok::EndSlip) + 1;

// Usable as a name: an identifier, or a soft keyword.
inline bool isName(Tok kind) { return kind == Tok::Ident || kind >= Tok::At; }
inline bool isTypeWord(Tok kind) { return kind >= Tok::Bool && kind <= Tok::Wstring; }
// Keywords that begin the declaration of an object where a name follows, and are names elsewhere
// (resolveObjectKeywords).
inline bool isObjectWord(Tok kind) {
  return kind == Tok::Method || kind == Tok::Property || kind == Tok::Action || kind == Tok::Interface ||
         kind == Tok::Class || kind == Tok::Namespace;
}
// END_… of a declaration, a block of variables or a POU or its part, and the end of the file; not of statements.
bool endsPart(Tok kind);
inline bool isReserved(Tok kind) { return kind >= Tok::And && kind <= Tok::EndResource; }
// The fixed spelling of an operator or keyword; for other tokens the description in messages ("a number").
const char* spelling(Tok kind);

// Kinds of tokens as a set.
class TokSet {
 public:
  constexpr TokSet(std::initializer_list<Tok> kinds) {
    for (const Tok kind : kinds) has_[static_cast<size_t>(kind)] = true;
  }
  constexpr bool has(Tok kind) const { return has_[static_cast<size_t>(kind)]; }

 private:
  std::array<bool, kTokCount> has_{};
};

// A value for some kinds of tokens; the others have the value T{}.
template <class T>
class TokMap {
 public:
  struct Row {
    Tok kind;
    T value;
  };
  constexpr TokMap(std::initializer_list<Row> rows) {
    for (const Row& row : rows) values_[static_cast<size_t>(row.kind)] = row.value;
  }
  constexpr const T& operator[](Tok kind) const { return values_[static_cast<size_t>(kind)]; }

 private:
  std::array<T, kTokCount> values_{};
};

// The blocks of statements: the keywords of each, and the one that ends its header (End: it has none).
struct StatementBlock {
  Tok begin, end, connective;
};
inline constexpr StatementBlock kStatementBlocks[] = {
    {Tok::If, Tok::EndIf, Tok::Then},     {Tok::Case, Tok::EndCase, Tok::Of},      {Tok::For, Tok::EndFor, Tok::Do},
    {Tok::While, Tok::EndWhile, Tok::Do}, {Tok::Repeat, Tok::EndRepeat, Tok::End}, {Tok::Try, Tok::EndTry, Tok::End}};

constexpr bool beginsBlock(Tok kind) {
  for (const StatementBlock& block : kStatementBlocks)
    if (block.begin == kind) return true;
  return false;
}
constexpr bool endsBlock(Tok kind) {
  for (const StatementBlock& block : kStatementBlocks)
    if (block.end == kind) return true;
  return false;
}

}  // namespace rung::text

// SPDX-License-Identifier: Apache-2.0
// A source divided for the formatter: tokens, comments and pragmas in the order of the source, with nothing but blanks
// between them. In: ST, IL, textual SFC or networks, also a fragment of them. Out: the pieces, whose spelling never
// changes except for the case of keywords. Used by outline.cpp and format.cpp.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "frontend/parse/tokens.h"
#include "frontend/source/dialect.h"

namespace rung::format {

enum class PieceKind : uint8_t { Token, Comment, Pragma };
// Of the notation of networks: NETWORK, the word that begins an element, and all else outside of its expressions and
// statements.
enum class NetworkPiece : uint8_t { None, Heading, Element, Part };
enum class Gap : uint8_t { Free, None, Blank };  // before the piece; Free: as the tokens need it

struct Piece {
  uint32_t begin, end;
  PieceKind kind;
  text::Tok token;    // of a Token
  uint32_t newlines;  // before it, since the piece before
  bool blank;         // white space is before it
  bool is_keyword = false;
  bool is_label = false;  // a colon that ends a label
  bool is_unary = false;  // a sign
  bool breaks = false;    // of networks: a row may begin here
  bool begins = false;    // a statement, an element of a network, or a keyword that ends or divides a block of them
  uint32_t level = 0;     // then: its indentation
  NetworkPiece network = NetworkPiece::None;
  Gap gap = Gap::Free;
};

// Empty, too, when something between the pieces is not a blank: then nothing can be said about the source.
std::vector<Piece> piecesOf(std::string_view source, Dialect dialect);

}  // namespace rung::format

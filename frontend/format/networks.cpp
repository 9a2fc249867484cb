// SPDX-License-Identifier: Apache-2.0
// A walk along the grammar of frontend/parse/network.cpp. The source has been parsed without an error; where it does
// not follow the grammar, the walk goes on at the next `;`.
#include "frontend/format/networks.h"

#include <algorithm>
#include <initializer_list>

#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"

namespace rung::format {
namespace {

using text::Tok;

class NetworkMarker {
 public:
  NetworkMarker(std::string_view source, std::vector<Piece>& pieces) : source_(source), pieces_(pieces) { skip(); }

  void run() {
    while (!atEnd()) {
      const bool opens = at(Tok::Network);
      advance();
      if (opens) markBody();
    }
  }

 private:
  bool atEnd() const { return at_ >= pieces_.size(); }
  const Piece& piece() const { return pieces_[at_]; }
  bool at(Tok token) const { return !atEnd() && piece().token == token; }
  bool atWord() const {
    return !atEnd() && (text::isName(piece().token) || text::isReserved(piece().token) ||
                        text::isTypeWord(piece().token) || piece().token == Tok::StringLiteral);
  }
  bool isAnyOf(std::initializer_list<std::string_view> words) const {
    const std::string_view text = source_.substr(piece().begin, piece().end - piece().begin);
    return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return sameIdentifier(w, text); });
  }
  bool nextIs(Tok token) const {
    for (size_t k = at_ + 1; k < pieces_.size(); ++k)
      if (pieces_[k].kind == PieceKind::Token) return pieces_[k].token == token;
    return false;
  }

  // To the next token; comments and pragmas may be anywhere.
  void skip() {
    while (!atEnd() && piece().kind != PieceKind::Token) ++at_;
  }
  void advance() {
    ++at_;
    skip();
  }
  void take(Gap gap = Gap::Free) {
    if (pieces_[at_].network == NetworkPiece::None) pieces_[at_].network = NetworkPiece::Part;
    pieces_[at_].gap = gap;
    advance();
  }
  void takeKeyword() {
    pieces_[at_].is_keyword = true;
    take(Gap::Blank);
  }
  void takeName(Gap gap, bool may_be_operator = false) {
    if (!may_be_operator) pieces_[at_].is_keyword = false;
    take(gap);
  }

  void markBody() {
    while (!atEnd() && !at(Tok::EndNetwork)) {
      if (atWord() && isAnyOf({"NETWORK"}))
        markHeading();
      else
        markElement();
      if (at(Tok::Semicolon)) take();
    }
    advance();
  }

  // NETWORK number [DISABLED] [title]
  void markHeading() {
    pieces_[at_].network = NetworkPiece::Heading;
    takeKeyword();
    while (!endsElement()) {
      if (atWord() && isAnyOf({"DISABLED"}))
        takeKeyword();
      else
        take(Gap::Blank);
    }
  }

  bool endsElement() const { return atEnd() || at(Tok::Semicolon) || at(Tok::EndNetwork); }

  void markElement() {
    if (at(Tok::Semicolon)) return;
    const bool is_box = isAnyOf({"box"});
    const bool is_named = is_box || isAnyOf({"connector", "continuation", "jump", "label", "compose", "select"});
    const bool is_coil = isAnyOf({"coil"});
    pieces_[at_].network = NetworkPiece::Element;
    take(Gap::Blank);
    if (at(Tok::Number)) take(Gap::Blank);
    const bool is_attribute = atWord() && isAnyOf({"AT", "ORDER"}) && nextIs(Tok::Number);
    if (is_named && atWord() && !is_attribute) markPath(is_box);
    while (!endsElement()) markPart(is_coil);
  }

  // The name of a box, a label or a connector.
  void markPath(bool is_box) {
    takeName(Gap::Blank, is_box);
    while (at(Tok::Dot)) {
      take();
      if (atWord()) takeName(Gap::Free, is_box);
    }
  }

  void markPart(bool is_coil) {
    if (atWord() && (isAnyOf({"NOT", "RISING", "FALLING", "SET", "RESET"}) || (is_coil && isAnyOf({"HOLDING"})))) {
      takeKeyword();
    } else if (atWord() && isAnyOf({"AT", "ORDER"})) {
      takeKeyword();
      markNumbers();
    } else if (at(Tok::LeftParen)) {
      markOperand();
    } else if (at(Tok::Assign)) {
      take(Gap::Blank);
      markWires();
    } else if (at(Tok::LeftBracket)) {
      markPins();
    } else if (at(Tok::Network)) {
      markStatements();
    } else {
      take(Gap::Blank);
    }
  }

  // 50, -40
  void markNumbers() {
    while (at(Tok::Number) || at(Tok::Minus) || at(Tok::Comma)) {
      if (at(Tok::Minus)) {
        pieces_[at_].is_unary = true;
        take(Gap::Blank);
        if (at(Tok::Number)) take(Gap::None);
      } else {
        take(at(Tok::Comma) ? Gap::None : Gap::Blank);
      }
    }
  }

  void markOperand() {
    uint32_t depth = 0;
    take(Gap::Blank);
    while (!atEnd() && !(depth == 0 && at(Tok::RightParen))) {
      if (at(Tok::LeftParen)) ++depth;
      if (at(Tok::RightParen)) --depth;
      advance();
    }
    if (!atEnd()) take(Gap::None);
  }

  // number ["(" pin ")"] {OR number ["(" pin ")"]}
  void markWires() {
    while (at(Tok::Number)) {
      take(Gap::Blank);
      if (at(Tok::LeftParen)) {
        take(Gap::None);
        if (atWord()) takeName(Gap::None);
        if (at(Tok::RightParen)) take(Gap::None);
      }
      if (!at(Tok::Or)) return;
      pieces_[at_].breaks = true;
      take(Gap::Blank);
    }
  }

  void markPins() {
    pieces_[at_].breaks = true;
    take(Gap::Blank);
    bool is_first = true;
    while (!endsElement() && !at(Tok::RightBracket)) {
      if (atWord()) {
        pieces_[at_].breaks = !is_first;
        takeName(is_first ? Gap::None : Gap::Blank);
      }
      is_first = false;
      while (!endsElement() && !at(Tok::Comma) && !at(Tok::RightBracket)) {
        if (at(Tok::Assign)) {
          take(Gap::Blank);
          markWires();
        } else if (atWord()) {
          takeKeyword();
        } else {
          take(Gap::Blank);
        }
      }
      if (at(Tok::Comma)) take();
    }
    if (at(Tok::RightBracket)) take(Gap::None);
  }

  // {network ST} statements {end_network}
  void markStatements() {
    take(Gap::Blank);
    while (!atEnd() && !at(Tok::EndNetwork)) advance();
    if (!atEnd()) take(Gap::Blank);
  }

  std::string_view source_;
  std::vector<Piece>& pieces_;
  size_t at_ = 0;
};

}  // namespace

void markNetworks(std::string_view source, std::vector<Piece>& pieces) {
  static constexpr auto kOpens = [](const Piece& piece) { return piece.token == Tok::Network; };
  if (std::any_of(pieces.begin(), pieces.end(), kOpens)) NetworkMarker(source, pieces).run();
}

}  // namespace rung::format

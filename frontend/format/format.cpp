// SPDX-License-Identifier: Apache-2.0
// Lines become rows of output: first each with its blanks, then the columns of rows that belong together. A row that
// is too long becomes several, at a comma or before an operator, in the outermost brackets where that helps.
#include "frontend/format/format.h"

#include <algorithm>
#include <optional>

#include "frontend/format/networks.h"
#include "frontend/format/outline.h"
#include "frontend/format/pieces.h"
#include "frontend/format/spacing.h"
#include "frontend/source/names.h"
#include "frontend/source/text.h"

namespace rung::format {
namespace {

using text::Tok;
using text::TokSet;

constexpr uint32_t kBeforeComment = 2;
constexpr uint32_t kInside = 1u << 16;                       // the depth of breaks inside of statements
constexpr uint32_t kOperatorColumn = 2, kOperandColumn = 8;  // of IL; the operand's from the operator

struct Row {
  std::string code, comment;
  uint32_t blank_lines = 0;
  LineKind kind = LineKind::Statement;
  uint32_t level = 0;
  bool is_verbatim = false;
};

uint32_t widthOf(std::string_view text) {
  const size_t line = text.rfind('\n');
  if (line != std::string_view::npos) text.remove_prefix(line + 1);
  return static_cast<uint32_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

// Text that is appended to, and the column it has reached.
struct Code {
  std::string text;
  uint32_t column = 0;

  void put(std::string_view more) {
    text += more;
    column = widthOf(more) + (more.find('\n') == std::string_view::npos ? column : 0);
  }
  void padTo(uint32_t wanted) {
    if (column < wanted) put(std::string(wanted - column, ' '));
  }
};

char inCase(char c, KeywordCase wanted) {
  return wanted == KeywordCase::Upper ? upper(c) : wanted == KeywordCase::Lower ? foldedCharacter(c) : c;
}

class Formatter {
 public:
  Formatter(std::string_view source, const Style& style, LineRange range)
      : source_(source), style_(style), range_(range), is_windows_(source.find("\r\n") != std::string_view::npos) {}

  std::string run(const Bodies& bodies, Dialect dialect) {
    pieces_ = piecesOf(source_, dialect);
    markNetworks(source_, pieces_);
    if (pieces_.empty()) return std::string(source_);
    lines_ = outlineOf(source_, pieces_, bodies);
    alignDeclarations();
    number_ = 1;
    uint32_t counted = 0;
    for (size_t k = 0; k < lines_.size(); ++k) {
      const Piece& first = pieces_[lines_[k].first];
      number_ += newlinesIn(counted, first.begin);
      counted = first.begin;
      const uint32_t begin_number = number_;
      const uint32_t end_number = begin_number + newlinesIn(first.begin, pieces_[lines_[k].last - 1].end);
      addRows(k, begin_number <= range_.last && end_number >= range_.first);
    }
    alignComments();
    return joined();
  }

 private:
  std::string_view textOf(const Piece& piece) const { return source_.substr(piece.begin, piece.end - piece.begin); }
  uint32_t newlinesIn(uint32_t begin, uint32_t end) const {
    return static_cast<uint32_t>(std::count(source_.begin() + begin, source_.begin() + end, '\n'));
  }

  // The text of a piece: keywords in their case, the words of elements in small letters.
  std::string spelled(const Piece& piece) const {
    std::string text(textOf(piece));
    const bool is_element = piece.network == NetworkPiece::Element;
    if (!piece.is_keyword && !is_element) return text;
    const KeywordCase wanted =
        is_element && style_.keywords == KeywordCase::Upper ? KeywordCase::Lower : style_.keywords;
    for (char& c : text) c = inCase(c, wanted);
    return text;
  }

  // ---- declarations

  // The colon that the types after it are aligned at; none: the line has none, or it or the end of its declaration, on
  // a line below, has several declarations.
  std::optional<uint32_t> colonOf(size_t index) const {
    if (lines_[index].kind != LineKind::Declaration || lines_[index].continues) return {};
    std::optional<uint32_t> colon;
    for (size_t row = index; row < lines_.size() && (row == index || lines_[row].continues); ++row) {
      const Line& line = lines_[row];
      for (uint32_t k = line.first; k < line.last; ++k) {
        if (pieces_[k].kind != PieceKind::Token) continue;
        if (pieces_[k].token == Tok::Colon && !colon && row == index) colon = k;
        if (pieces_[k].token == Tok::Semicolon && k + 1 < line.last && pieces_[k + 1].kind == PieceKind::Token)
          return {};
      }
    }
    return colon;
  }

  // a, b, c : INT; a long list would move the types of all others far to the right.
  bool isList(const Line& line, uint32_t colon) const {
    return std::any_of(pieces_.begin() + line.first, pieces_.begin() + colon,
                       [](const Piece& piece) { return piece.token == Tok::Comma; });
  }

  // Declarations without a blank line between them share the column of their colons.
  void alignDeclarations() {
    colon_columns_.assign(lines_.size(), 0);
    if (!style_.align) return;
    for (size_t k = 0; k < lines_.size();) {
      size_t end = k;
      uint32_t column = 0;
      const uint32_t level = lines_[k].level;
      for (; end < lines_.size(); ++end) {
        const Line& line = lines_[end];
        const bool belongs = line.kind == LineKind::Declaration || line.kind == LineKind::Remark || line.continues;
        if (!belongs || (end > k && pieces_[line.first].newlines > 1) || (!line.continues && line.level != level))
          break;
        if (const std::optional<uint32_t> colon = colonOf(end); colon && !isList(line, *colon))
          column = std::max(column, widthOf(rendered(line.first, *colon, level * style_.indent)) + 1);
      }
      if (end == k) ++end;
      for (size_t row = k; row < end; ++row)
        if (colonOf(row)) colon_columns_[row] = column;
      k = end;
    }
  }
  std::string rendered(uint32_t first, uint32_t last, uint32_t indent) const {
    std::string out(indent, ' ');
    for (uint32_t k = first; k < last; ++k) {
      if (k > first && isSeparated(source_, pieces_[k - 1], pieces_[k], Colons::Declares)) out += ' ';
      out += spelled(pieces_[k]);
    }
    return out;
  }

  // ---- rows

  struct Bracket {
    uint32_t content, closer;  // columns
  };

  void addRows(size_t index, bool may_change) {
    const Line& line = lines_[index];
    uint32_t last = line.last;
    Row row;
    if (!line.continues) statement_kind_ = line.kind;
    row.kind = statement_kind_;
    row.level = line.level;
    row.blank_lines = pieces_[line.first].newlines > 0 ? pieces_[line.first].newlines - 1 : 0;
    if (may_change) row.blank_lines = std::min(row.blank_lines, style_.blank_lines);
    if (index == 0) row.blank_lines = 0;
    if (last - line.first > 1 && pieces_[last - 1].kind == PieceKind::Comment) row.comment = textOf(pieces_[--last]);
    const size_t first_row = rows_.size();
    if (!line.continues && line.kind != LineKind::Remark) beginStatement(line.level);
    if (line.kind == LineKind::Il && !line.continues) {
      row.code = instruction(line, last);
      noteBrackets(line, last);
      rows_.push_back(std::move(row));
    } else {
      layOut(line, last, colon_columns_[index], std::move(row));
    }
    if (!may_change) keep(first_row, line);
  }

  // The line as it was.
  void keep(size_t first_row, const Line& line) {
    Row row = std::move(rows_[first_row]);
    rows_.resize(first_row);
    const size_t newline =
        pieces_[line.first].begin == 0 ? std::string_view::npos : source_.rfind('\n', pieces_[line.first].begin - 1);
    const size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    const size_t end = std::min(source_.find('\n', pieces_[line.last - 1].end), source_.size());
    row.code = source_.substr(begin, end - begin);
    if (row.code.ends_with('\r')) row.code.pop_back();
    row.comment.clear();
    row.is_verbatim = true;
    rows_.push_back(std::move(row));
  }

  void beginStatement(uint32_t level) {
    brackets_.clear();
    base_ = level * style_.indent;
    value_column_ = 0;
  }

  // label: OP    operand, …
  std::string instruction(const Line& line, uint32_t last) const {
    uint32_t k = line.first;
    std::string out;
    while (k < last && pieces_[k].kind != PieceKind::Token) out += std::string(textOf(pieces_[k++])) + " ";
    if (k + 1 < last && pieces_[k + 1].is_label) {
      out += std::string(textOf(pieces_[k])) + ":";
      k += 2;
      if (k < last) out += ' ';
    }
    if (k == last) return out;
    if (out.size() < kOperatorColumn) out.resize(kOperatorColumn, ' ');
    const size_t operation = out.size();
    out += operatorOf(pieces_[k++]);
    if (k < last && pieces_[k].blank) {
      out += ' ';
      if (out.size() < operation + kOperandColumn) out.resize(operation + kOperandColumn, ' ');
    }
    for (uint32_t p = k; p < last; ++p) {
      if (p > k && isOperandSeparated(pieces_[p - 1], pieces_[p])) out += ' ';
      out += spelled(pieces_[p]);
    }
    return out;
  }
  static bool isOperandSeparated(const Piece& before, const Piece& next) {
    static constexpr TokSet kAssigns = {Tok::Assign, Tok::Arrow};
    if (next.token == Tok::Comma || next.token == Tok::RightParen) return false;
    return next.blank || before.token == Tok::Comma || kAssigns.has(before.token) || kAssigns.has(next.token);
  }
  // Operators are names to the lexer; functions keep their spelling.
  std::string operatorOf(const Piece& piece) const {
    static constexpr std::string_view kOperators[] = {
        "LD",   "LDN",  "ST",    "STN",  "S",   "R",    "NOT",   "AND",  "ANDN", "OR",   "ORN",   "XOR",
        "XORN", "ADD",  "SUB",   "MUL",  "DIV", "MOD",  "GT",    "GE",   "EQ",   "NE",   "LE",    "LT",
        "JMP",  "JMPC", "JMPCN", "JMPN", "CAL", "CALC", "CALCN", "CALN", "RET",  "RETC", "RETCN", "RETN"};
    std::string text(textOf(piece));
    const bool known = std::any_of(std::begin(kOperators), std::end(kOperators),
                                   [&](std::string_view one) { return sameIdentifier(one, text); });
    if (known)
      for (char& c : text) c = inCase(c, style_.keywords);
    return text;
  }

  void noteBrackets(const Line& line, uint32_t last) {
    for (uint32_t k = line.first; k < last; ++k) {
      if (pieces_[k].kind != PieceKind::Token) continue;
      if (pieces_[k].token == Tok::LeftParen) brackets_.push_back({kOperatorColumn + kOperandColumn, kOperatorColumn});
      if (pieces_[k].token == Tok::RightParen && !brackets_.empty()) brackets_.pop_back();
    }
  }

  // Where a row begins.
  uint32_t columnOf(const Piece& first, bool continues, const Line& line) const {
    const bool begins_line = &first == &pieces_[line.first];
    if (!continues) return (begins_line ? line.level : first.level) * style_.indent;
    const bool closes = first.token == Tok::RightParen || first.token == Tok::RightBracket;
    if (!brackets_.empty()) return closes ? brackets_.back().closer : brackets_.back().content;
    return value_column_ != 0 ? value_column_ : base_ + 2 * style_.indent;
  }

  // A place to break the row before a piece: the depth of its blocks or brackets there.
  struct Break {
    uint32_t piece, depth, end;  // `end`: the column that the row then reaches
  };
  // Between statements or elements of a network it is that of their blocks, elsewhere it is deeper.
  uint32_t depthOf(const Piece& piece) const {
    if (piece.begins) return piece.level;
    return kInside + 2 * static_cast<uint32_t>(brackets_.size()) + (piece.network == NetworkPiece::Part ? 1 : 0);
  }

  bool isBreak(const Piece& before, const Piece& next) const {
    const LineKind kind = statement_kind_;
    if (next.kind != PieceKind::Token || before.kind != PieceKind::Token) return false;
    if (kind == LineKind::Header || kind == LineKind::Il) return false;
    if (kind == LineKind::Declaration && brackets_.empty() && value_column_ == 0) return false;
    if (next.begins) return kind == LineKind::Statement;
    if (next.network != NetworkPiece::None) return next.breaks;
    if (before.token == Tok::Comma) return true;
    static constexpr TokSet kJoins = {Tok::And,    Tok::Or,   Tok::Xor,      Tok::AndThen,
                                      Tok::OrElse, Tok::Plus, Tok::Ampersand};
    return kJoins.has(next.token) && !next.is_unary;
  }

  void layOut(const Line& line, uint32_t last, uint32_t colon_column, Row row) {
    uint32_t first = line.first;
    bool continues = line.continues;
    for (;;) {
      const std::vector<Bracket> brackets = brackets_;
      const uint32_t value_column = value_column_;
      std::vector<Break> breaks;
      const Code code = written(line, first, last, continues, colon_column, &breaks);
      const std::optional<uint32_t> at = breakOf(code, breaks);
      if (!at) {
        row.code = code.text;
        rows_.push_back(std::move(row));
        return;
      }
      brackets_ = brackets;
      value_column_ = value_column;
      Row before = row;
      before.code = written(line, first, *at, continues, colon_column, nullptr).text;
      before.comment.clear();
      rows_.push_back(std::move(before));
      row.blank_lines = 0;
      first = *at;
      continues = !pieces_[first].begins;
      if (!continues) beginStatement(pieces_[first].level);
    }
  }

  bool isTooLong(const Code& code) const { return style_.width != 0 && code.column > style_.width; }

  // The outermost break within the width, and of these the last, or the end of a block that begins above; else the
  // first one at all.
  std::optional<uint32_t> breakOf(const Code& code, const std::vector<Break>& breaks) const {
    if (!isTooLong(code) || breaks.empty() || code.text.find('\n') != std::string::npos) return {};
    const Break* best = nullptr;
    for (const Break& one : breaks) {
      if (one.end > style_.width || (best != nullptr && one.depth > best->depth)) continue;
      best = &one;
      if (one.depth < kInside && one.depth * style_.indent < base_) break;
    }
    return best == nullptr ? breaks.front().piece : best->piece;
  }

  // The pieces [first, last) in a row; follows the brackets. With `breaks`, which are noted, it stops where the row is
  // too long and has one.
  Code written(const Line& line, uint32_t first, uint32_t last, bool continues, uint32_t colon_column,
               std::vector<Break>* breaks) {
    const Colons colons =
        line.kind == LineKind::Declaration || line.kind == LineKind::Header ? Colons::Declares : Colons::Free;
    bool colon_seen = continues || colon_column == 0;
    Code out;
    out.padTo(columnOf(pieces_[first], continues, line));
    for (uint32_t k = first; k < last; ++k) {
      const Piece& piece = pieces_[k];
      if (k > first) {
        if (breaks != nullptr && isBreak(pieces_[k - 1], piece)) breaks->push_back({k, depthOf(piece), out.column});
        if (breaks != nullptr && !breaks->empty() && isTooLong(out)) return out;
        if (isSeparated(source_, pieces_[k - 1], piece, colons)) out.put(" ");
      }
      if (piece.kind == PieceKind::Token && piece.token == Tok::Colon && !colon_seen) {
        colon_seen = true;
        out.padTo(colon_column);
      }
      out.put(spelled(piece));
      if (piece.kind == PieceKind::Token) follow(piece, out.column, k + 1 >= last);
    }
    return out;
  }

  // `column`: the end of the piece.
  void follow(const Piece& piece, uint32_t column, bool ends_line) {
    static constexpr TokSet kConditions = {Tok::If, Tok::Elsif, Tok::While, Tok::Until, Tok::Case};
    if (piece.token == Tok::LeftParen || piece.token == Tok::LeftBracket) {
      const uint32_t outer = brackets_.empty() ? base_ : brackets_.back().closer;
      brackets_.push_back(ends_line ? Bracket{outer + style_.indent, outer} : Bracket{column, column - 1});
      return;
    }
    if (piece.token == Tok::RightParen || piece.token == Tok::RightBracket) {
      if (!brackets_.empty()) brackets_.pop_back();
      return;
    }
    if (piece.token == Tok::Semicolon && brackets_.empty()) value_column_ = 0;
    if (!brackets_.empty() || value_column_ != 0) return;
    if ((piece.token == Tok::Assign && !ends_line) || kConditions.has(piece.token)) value_column_ = column + 1;
  }

  // ---- columns of comments

  void alignComments() {
    for (size_t k = 0; k < rows_.size();) {
      size_t end = k;
      uint32_t column = 0;
      for (; end < rows_.size(); ++end) {
        const Row& row = rows_[end];
        const bool shares =
            !row.comment.empty() || (row.kind == LineKind::Declaration && rows_[k].kind == LineKind::Declaration);
        if (!shares || row.is_verbatim || (end > k && row.blank_lines > 0) || row.kind != rows_[k].kind) break;
        if (!row.comment.empty()) column = std::max(column, widthOf(row.code) + kBeforeComment);
      }
      if (end == k) ++end;
      for (size_t row = k; row < end; ++row) {
        if (rows_[row].comment.empty()) continue;
        rows_[row].code.append(column - widthOf(rows_[row].code), ' ');
        rows_[row].code += rows_[row].comment;
      }
      k = end;
    }
  }

  std::string joined() const {
    const std::string_view newline = is_windows_ ? "\r\n" : "\n";
    std::string out;
    out.reserve(source_.size() + source_.size() / 8);
    for (const Row& row : rows_) {
      for (uint32_t k = 0; k < row.blank_lines; ++k) out += newline;
      out += row.code;
      if (!row.is_verbatim && row.code.find('\n') == std::string::npos)
        while (!out.empty() && out.back() == ' ') out.pop_back();
      out += newline;
    }
    return out;
  }

  std::string_view source_;
  const Style& style_;
  LineRange range_;
  bool is_windows_;
  std::vector<Piece> pieces_;
  std::vector<Line> lines_;
  std::vector<uint32_t> colon_columns_;  // of lines; 0: not aligned
  std::vector<Row> rows_;
  std::vector<Bracket> brackets_;                  // open in the current statement
  LineKind statement_kind_ = LineKind::Statement;  // of the line in which the statement begins
  uint32_t base_ = 0;                              // the column of the statement
  uint32_t value_column_ = 0;  // where the value or condition of the statement begins; 0: none so far
  uint32_t number_ = 1;
};

}  // namespace

std::string formatted(std::string_view source, const Bodies& bodies, const Style& style, Dialect dialect,
                      LineRange range) {
  return Formatter(source, style, range).run(bodies, dialect);
}

}  // namespace rung::format

// SPDX-License-Identifier: Apache-2.0
// A pass over the pieces with a stack of what is open. A token at the beginning of a statement decides what the
// statement is; a line takes the level of the statement that begins in it.
#include "frontend/format/outline.h"

#include <algorithm>

#include "frontend/source/names.h"

namespace rung::format {
namespace {

using text::Tok;
using text::TokSet;

constexpr TokSet kSections = {Tok::Var,       Tok::VarInput,    Tok::VarOutput,  Tok::VarInOut,
                              Tok::VarTemp,   Tok::VarExternal, Tok::VarGlobal,  Tok::VarStat,
                              Tok::VarAccess, Tok::VarInst,     Tok::VarGeneric, Tok::VarConfig};
constexpr TokSet kPous = {Tok::Program,   Tok::Function,   Tok::FunctionBlock, Tok::Method,        Tok::Property,
                          Tok::Action,    Tok::Interface,  Tok::Class,         Tok::Configuration, Tok::Resource,
                          Tok::Namespace, Tok::Transition, Tok::InitialStep,   Tok::Type};
constexpr TokSet kMiddles = {Tok::Else, Tok::Elsif, Tok::Until, Tok::Catch, Tok::Finally};

// The keyword that a closing one closes; End: it closes nothing.
constexpr text::TokMap<Tok> kDeclarationEnds = {
    {Tok::EndVar, Tok::Var},
    {Tok::EndStruct, Tok::Struct},
    {Tok::EndUnion, Tok::Union},
    {Tok::EndType, Tok::Type},
    {Tok::EndProgram, Tok::Program},
    {Tok::EndFunction, Tok::Function},
    {Tok::EndFunctionBlock, Tok::FunctionBlock},
    {Tok::EndMethod, Tok::Method},
    {Tok::EndProperty, Tok::Property},
    {Tok::EndAction, Tok::Action},
    {Tok::EndStep, Tok::InitialStep},
    {Tok::EndTransition, Tok::Transition},
    {Tok::EndInterface, Tok::Interface},
    {Tok::EndClass, Tok::Class},
    {Tok::EndNamespace, Tok::Namespace},
    {Tok::EndConfiguration, Tok::Configuration},
    {Tok::EndResource, Tok::Resource},
    {Tok::EndNetwork, Tok::Network},
};
Tok beginOf(Tok end) {
  for (const text::StatementBlock& block : text::kStatementBlocks)
    if (block.end == end) return block.begin;
  return kDeclarationEnds[end];
}

// Its content is a level deeper.
bool indents(Tok begin) {
  return text::beginsBlock(begin) || begin == Tok::Var || begin == Tok::Struct || begin == Tok::Union ||
         begin == Tok::Configuration || begin == Tok::Resource || begin == Tok::InitialStep || begin == Tok::Transition;
}

class Outliner {
 public:
  Outliner(std::string_view source, std::vector<Piece>& pieces, const Bodies& bodies)
      : source_(source), pieces_(pieces), bodies_(bodies) {}

  std::vector<Line> run() {
    for (uint32_t k = 0; k < pieces_.size();) {
      uint32_t last = k + 1;
      while (last < pieces_.size() && pieces_[last].newlines == 0) ++last;
      addLine(k, last);
      k = last;
    }
    for (const size_t remark : remarks_) lines_[remark].level = 0;
    return std::move(lines_);
  }

 private:
  struct Open {
    Tok begin;
    uint32_t level;
    bool indents;
    bool in_header = false;                     // of a block: before THEN, DO or OF
    bool labelled = false, after_else = false;  // of a CASE
  };

  bool holds(const std::vector<Span>& spans, uint32_t at) const {
    const auto after =
        std::upper_bound(spans.begin(), spans.end(), at, [](uint32_t k, const Span& s) { return k < s.begin; });
    return after != spans.begin() && at < std::prev(after)->end;
  }
  std::string_view textOf(const Piece& piece) const { return source_.substr(piece.begin, piece.end - piece.begin); }
  bool is(uint32_t piece, std::string_view word) const { return sameIdentifier(textOf(pieces_[piece]), word); }

  uint32_t bodyLevel() const {
    if (open_.empty()) return 0;
    const Open& top = open_.back();
    if (top.begin == Tok::Case && !top.after_else) return top.level + (top.labelled ? 2 : 1);
    return top.level + (top.indents ? 1 : 0);
  }
  bool inDeclarations() const {
    return !open_.empty() &&
           (open_.back().begin == Tok::Var || open_.back().begin == Tok::Struct || open_.back().begin == Tok::Union);
  }

  void addLine(uint32_t first, uint32_t last) {
    Line line{first, last};
    uint32_t code = first;
    while (code < last && pieces_[code].kind != PieceKind::Token) ++code;
    if (code == last) {
      addRemark(line);
      return;
    } else if (holds(bodies_.il, pieces_[code].begin)) {
      addInstruction(line, code);
    } else {
      addCode(line, code);
    }
    placeRemarks(line);
    lines_.push_back(line);
  }

  // Comments belong to what follows, unless that ends a block.
  void addRemark(Line line) {
    line.kind = LineKind::Remark;
    line.continues = !at_start_;
    line.level = at_start_ ? bodyLevel() : level_;
    if (at_start_) remarks_.push_back(lines_.size());
    lines_.push_back(line);
  }
  void placeRemarks(const Line& next) {
    for (const size_t remark : remarks_)
      lines_[remark].level = closes_ ? std::max(lines_[remark].level, next.level) : next.level;
    remarks_.clear();
  }

  void addInstruction(Line& line, uint32_t code) {
    line.kind = LineKind::Il;
    line.continues = depth_ > 0;
    closes_ = false;
    level_ = 0;
    for (uint32_t k = code; k < line.last; ++k) {
      if (pieces_[k].kind != PieceKind::Token) continue;
      if (k == code && k + 1 < line.last && pieces_[k + 1].token == Tok::Colon) pieces_[k + 1].is_label = true;
      countBrackets(pieces_[k].token);
    }
    // An operator may leave its parenthesis open: `AND(`, and a line `)` closes it.
    if (line.last - code <= 2 || !line.continues) depth_ = isPinList(line, code) ? depth_ : 0;
    at_start_ = true;
  }
  // CAL timer( with its pins on the lines below.
  bool isPinList(const Line& line, uint32_t code) const {
    return depth_ > 0 && (line.continues || (line.last > code + 2 && textOf(pieces_[code]).substr(0, 3) != "AND" &&
                                             sameIdentifier(textOf(pieces_[code]).substr(0, 3), "CAL")));
  }

  void addCode(Line& line, uint32_t code) {
    const Tok first = pieces_[code].token;
    closes_ = depth_ == 0 &&
              (beginOf(first) != Tok::End || kMiddles.has(first) || first == Tok::EndGet || first == Tok::EndSet);
    const bool opens = depth_ == 0 && (kSections.has(first) || first == Tok::Struct || first == Tok::Union);
    const bool extends = first == Tok::Extends || first == Tok::Implements;
    if (closes_ || opens) at_start_ = true;
    line.continues = !at_start_ || (extends && !inDeclarations());
    header_ = false;
    bool is_first = true;
    for (uint32_t k = code; k < line.last; ++k) {
      if (pieces_[k].kind != PieceKind::Token) continue;
      const bool starts = at_start_ && depth_ == 0;
      if (starts) beginStatement(k);
      pieces_[k].begins = starts && pieces_[k].token != Tok::Semicolon && !inDeclarations();
      pieces_[k].level = level_;
      if (is_first) {
        line.level = level_;
        if (starts && !line.continues && (kPous.has(first) || kSections.has(first) || isStep(k))) header_ = true;
        if (header_)
          line.kind = LineKind::Header;
        else if (inDeclarations() && starts && isDeclared(k, line.last))
          line.kind = LineKind::Declaration;
      }
      is_first = false;
      advance(k, starts);
    }
    if (header_ && depth_ == 0) at_start_ = true;
  }

  bool isStep(uint32_t k) const {
    return is(k, "STEP") && k + 1 < pieces_.size() && text::isName(pieces_[k + 1].token);
  }

  // name {, name} [AT address] :
  bool isDeclared(uint32_t k, uint32_t last) const {
    for (; k < last; ++k) {
      const Piece& piece = pieces_[k];
      if (piece.kind != PieceKind::Token) continue;
      if (piece.token == Tok::Colon) return true;
      if (!text::isName(piece.token) && piece.token != Tok::Comma && piece.token != Tok::Address) return false;
    }
    return false;
  }

  // A label of CASE: everything up to a colon.
  bool isCaseLabel(uint32_t k) const {
    if (open_.empty() || open_.back().begin != Tok::Case || open_.back().after_else || open_.back().in_header)
      return false;
    uint32_t depth = 0;
    for (; k < pieces_.size(); ++k) {
      if (pieces_[k].kind != PieceKind::Token) continue;
      const Tok token = pieces_[k].token;
      if (token == Tok::LeftParen || token == Tok::LeftBracket) ++depth;
      if (token == Tok::RightParen || token == Tok::RightBracket) --depth;
      if (token == Tok::Colon && depth == 0) return true;
      if (token == Tok::Semicolon || token == Tok::Assign || text::beginsBlock(token) || text::endsBlock(token))
        return false;
    }
    return false;
  }

  void beginStatement(uint32_t k) {
    const Tok token = pieces_[k].token;
    in_label_ = false;
    if (pieces_[k].network == NetworkPiece::Heading && !open_.empty()) {
      level_ = open_.back().level;
      return;
    }
    if (const Tok begin = beginOf(token); begin != Tok::End) {
      const auto found = std::find_if(open_.rbegin(), open_.rend(), [&](const Open& o) { return o.begin == begin; });
      level_ = found == open_.rend() ? 0 : found->level;
      return;
    }
    if (kMiddles.has(token) && !open_.empty()) {
      level_ = open_.back().level;
      return;
    }
    in_label_ = isCaseLabel(k);
    level_ = in_label_ ? open_.back().level + 1 : bodyLevel();
  }

  void countBrackets(Tok token) {
    if (token == Tok::LeftParen || token == Tok::LeftBracket) ++depth_;
    if ((token == Tok::RightParen || token == Tok::RightBracket) && depth_ > 0) --depth_;
  }
  void push(Tok begin, bool deeper, bool in_header = false) { open_.push_back({begin, level_, deeper, in_header}); }
  void close(Tok begin) {
    for (size_t k = open_.size(); k-- > 0;) {
      if (open_[k].begin != begin) continue;
      open_.resize(k);
      return;
    }
  }

  // Elements after NETWORK are a level deeper, and the statements inside of an element.
  void advanceInNetwork(uint32_t k) {
    const Tok token = pieces_[k].token;
    countBrackets(token);
    at_start_ = token == Tok::Semicolon || token == Tok::Network;
    if (token == Tok::Network) push(token, true);
    if (token == Tok::EndNetwork) close(Tok::Network);
    if (pieces_[k].network == NetworkPiece::Heading && !open_.empty()) open_.back().indents = true;
  }

  // The colon ends a label of CASE or of a jump.
  bool isLabel(uint32_t k) const {
    const bool follows_name = k > 0 && k - 1 == statement_;
    return in_label_ || (follows_name && !inDeclarations() && !header_ && openKind() != Tok::Type);
  }

  // A program in a resource is an instance, on one line.
  void pushPou(uint32_t k) {
    const Tok token = pieces_[k].token;
    const bool is_instance = token == Tok::Program && (openKind() == Tok::Configuration || openKind() == Tok::Resource);
    const bool ends_line = k + 1 >= pieces_.size() || pieces_[k + 1].newlines > 0;
    if (!is_instance) push(token, token == Tok::Type ? ends_line : indents(token));
  }

  // Changes the state by a token; `starts`: it is the first of a statement.
  void advance(uint32_t k, bool starts) {
    const Tok token = pieces_[k].token;
    if (pieces_[k].network != NetworkPiece::None) {
      advanceInNetwork(k);
      return;
    }
    const uint32_t depth = depth_;
    countBrackets(token);
    if (depth_ > 0 || depth > 0) {
      at_start_ = false;
      if (depth_ == 0 && in_catch_) at_start_ = true;
      return;
    }
    in_catch_ = false;
    at_start_ = false;
    if (const Tok begin = beginOf(token); begin != Tok::End) {
      close(begin);
      at_start_ = true;
    } else if (token == Tok::Semicolon || token == Tok::EndGet || token == Tok::EndSet) {
      at_start_ = true;
    } else if (text::beginsBlock(token) && starts) {
      push(token, true, token != Tok::Repeat && token != Tok::Try);
      at_start_ = token == Tok::Repeat || token == Tok::Try;
    } else if (token == Tok::Then || token == Tok::Do ||
               (token == Tok::Of && !open_.empty() && open_.back().in_header)) {
      if (!open_.empty()) open_.back().in_header = false;
      at_start_ = true;
    } else if (token == Tok::Else || token == Tok::Finally) {
      if (!open_.empty()) open_.back().after_else = true;
      at_start_ = true;
    } else if (token == Tok::Catch) {
      in_catch_ = true;
      at_start_ = k + 1 >= pieces_.size() || pieces_[k + 1].token != Tok::LeftParen;
    } else if (token == Tok::Colon && isLabel(k)) {
      pieces_[k].is_label = true;
      if (in_label_) open_.back().labelled = true;
      in_label_ = false;
      at_start_ = true;
    } else if (token == Tok::Network) {
      push(token, false);
      at_start_ = true;
    } else if (kSections.has(token)) {
      push(Tok::Var, true);
      at_start_ = true;
    } else if (token == Tok::Struct || token == Tok::Union) {
      push(token, true);
      at_start_ = true;
    } else if (starts && isStep(k)) {
      push(Tok::InitialStep, true);
    } else if (starts && kPous.has(token)) {
      pushPou(k);
    } else if (starts || (k > 0 && isModifier(k))) {
      at_start_ = isModifier(k);
    }
    if (starts) statement_ = k;
  }
  Tok openKind() const { return open_.empty() ? Tok::End : open_.back().begin; }
  // CONSTANT, RETAIN, … after VAR.
  bool isModifier(uint32_t k) const {
    static constexpr TokSet kModifiers = {Tok::Constant, Tok::Retain, Tok::NonRetain, Tok::Persistent};
    if (!kModifiers.has(pieces_[k].token)) return false;
    while (k > 0 && kModifiers.has(pieces_[k].token)) --k;
    return kSections.has(pieces_[k].token);
  }

  std::string_view source_;
  std::vector<Piece>& pieces_;
  const Bodies& bodies_;
  std::vector<Line> lines_;
  std::vector<Open> open_;
  std::vector<size_t> remarks_;      // that wait for the line they belong to
  uint32_t depth_ = 0;               // of brackets
  uint32_t level_ = 0;               // of the current statement
  uint32_t statement_ = UINT32_MAX;  // its first piece
  bool at_start_ = true, header_ = false, in_label_ = false, in_catch_ = false;
  bool closes_ = false;  // the current line begins with a word that ends or divides a block
};

}  // namespace

std::vector<Line> outlineOf(std::string_view source, std::vector<Piece>& pieces, const Bodies& bodies) {
  return Outliner(source, pieces, bodies).run();
}

}  // namespace rung::format

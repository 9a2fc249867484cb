// SPDX-License-Identifier: Apache-2.0
#include "frontend/parse/recover.h"

#include <algorithm>
#include <array>
#include <string>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/syntax_fixes.h"
#include "frontend/source/dialect.h"
#include "frontend/source/scanner.h"
#include "frontend/source/text.h"

namespace rung::text {
namespace {

bool isOperatorSign(Tok k) { return (k >= Tok::Plus && k <= Tok::EqualLess) || (k >= Tok::And && k <= Tok::Mod); }
bool isVarWord(Tok k) { return k >= Tok::Var && k <= Tok::VarConfig; }

// The keyword that closes a block opened by `open`, or End when it opens no block.
Tok closerOf(Tok open) {
  static_assert(Tok{} == Tok::End);
  for (const StatementBlock& block : kStatementBlocks)
    if (block.begin == open) return block.end;
  static constexpr TokMap<Tok> kClosers = {{Tok::Type, Tok::EndType},
                                           {Tok::Struct, Tok::EndStruct},
                                           {Tok::Union, Tok::EndUnion},
                                           {Tok::Function, Tok::EndFunction},
                                           {Tok::FunctionBlock, Tok::EndFunctionBlock},
                                           {Tok::Program, Tok::EndProgram},
                                           {Tok::Configuration, Tok::EndConfiguration},
                                           {Tok::Resource, Tok::EndResource},
                                           {Tok::Method, Tok::EndMethod},
                                           {Tok::Property, Tok::EndProperty},
                                           {Tok::Action, Tok::EndAction},
                                           {Tok::Interface, Tok::EndInterface},
                                           {Tok::Class, Tok::EndClass}};
  return isVarWord(open) ? Tok::EndVar : kClosers[open];
}

constexpr Tok kDeclarationClosers[] = {
    Tok::EndType,          Tok::EndStruct,  Tok::EndUnion,         Tok::EndVar,      Tok::EndFunction,
    Tok::EndFunctionBlock, Tok::EndProgram, Tok::EndConfiguration, Tok::EndResource, Tok::EndMethod,
    Tok::EndProperty,      Tok::EndAction,  Tok::EndInterface,     Tok::EndClass};
constexpr auto kClosers = [] {
  std::array<Tok, std::size(kStatementBlocks) + std::size(kDeclarationClosers)> closers{};
  size_t count = 0;
  for (const StatementBlock& block : kStatementBlocks) closers[count++] = block.end;
  for (const Tok closer : kDeclarationClosers) closers[count++] = closer;
  return closers;
}();
bool isCloser(Tok k) { return std::find(kClosers.begin(), kClosers.end(), k) != kClosers.end(); }
bool isMember(Tok k) { return k == Tok::Method || k == Tok::Property || k == Tok::Action; }
bool isPouOpener(Tok k) {
  return k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Program || k == Tok::Interface || k == Tok::Class ||
         isMember(k);
}
bool isPouCloser(Tok k) {
  return k == Tok::EndFunction || k == Tok::EndFunctionBlock || k == Tok::EndProgram || k == Tok::EndInterface ||
         k == Tok::EndClass || k == Tok::EndMethod || k == Tok::EndProperty || k == Tok::EndAction;
}
bool isMemberCloser(Tok k) { return k == Tok::EndMethod || k == Tok::EndProperty || k == Tok::EndAction; }
bool hasHeader(Tok k) {
  return std::any_of(std::begin(kStatementBlocks), std::end(kStatementBlocks),
                     [&](const StatementBlock& block) { return block.begin == k && block.connective != Tok::End; });
}

// The keywords that can open a block closed by `closer`.
std::span<const Tok> openersFor(Tok closer) {
  static constexpr Tok kVars[] = {Tok::Var,         Tok::VarInput,  Tok::VarOutput, Tok::VarInOut,  Tok::VarTemp,
                                  Tok::VarExternal, Tok::VarGlobal, Tok::VarStat,   Tok::VarAccess, Tok::VarConfig};
  static constexpr Tok kOthers[] = {Tok::Type,    Tok::Struct,        Tok::Union,    Tok::Function, Tok::FunctionBlock,
                                    Tok::Program, Tok::Configuration, Tok::Resource, Tok::Method,   Tok::Property,
                                    Tok::Action,  Tok::Interface,     Tok::Class};
  if (closer == Tok::EndVar) return kVars;
  for (const StatementBlock& block : kStatementBlocks)
    if (block.end == closer) return {&block.begin, 1};
  for (const Tok& t : kOthers)
    if (closerOf(t) == closer) return {&t, 1};
  return {};
}

class Balancer {
 public:
  Balancer(TokenStream& stream, const Names& names, const Sources& sources, FileId file, Dialect dialect,
           Diagnostics& diagnostics)
      : stream_(stream),
        tokens_(stream.tokens),
        names_(names),
        sources_(sources),
        profile_(profileOf(dialect)),
        diagnostics_(diagnostics),
        base_(sources.begin(file).offset),
        source_(sources.sourceText(file)),
        count_(static_cast<uint32_t>(tokens_.size()) - kLookahead) {}

  void run();

 private:
  struct Open {
    Tok kind;
    uint32_t index;
    uint32_t column;
    bool line_start;           // the first token of its line
    bool is_chain;             // the IF of an ELSE IF
    uint32_t suspect;          // where its END_… seems to be missing; 0: not known
    uint32_t chain_child;      // index of the IF of an inner ELSE IF that took its END_IF; 0: none
    Tok connective;            // THEN, DO or OF of its header
    uint32_t line;             // of the keyword; computed on demand
    uint32_t until = 0;        // of REPEAT
    bool after_until = false;  // the suspect is the line after its condition
  };
  struct Orphan {  // THEN, DO or OF without its IF, WHILE, CASE, …
    uint32_t index, line_first, column;
  };
  enum class EditKind : uint8_t { Insert, Remove, Correction };
  struct Edit {
    uint32_t index;
    EditKind kind;
    Tok word;
  };

  // ---- reading tokens
  bool atLineStart(uint32_t i) const { return (tokens_[i].flags & kLineStart) != 0; }
  bool isProgramInstance(uint32_t i) const {
    uint32_t n = i + 1;
    if ((tokens_[n].kind == Tok::Retain || tokens_[n].kind == Tok::NonRetain) && isName(tokens_[n + 1].kind))
      return true;
    if (isName(tokens_[n].kind) && tokens_[n + 1].kind == Tok::With) return true;
    if (!in_configuration_) return false;
    // An instance without its name or task: the configuration ends before any END_PROGRAM.
    for (uint32_t k = n; k < count_ && k < n + 2000; ++k) {
      if (tokens_[k].kind == Tok::EndResource || tokens_[k].kind == Tok::EndConfiguration) return true;
      if (tokens_[k].kind == Tok::EndProgram) break;
    }
    // An instance ends with `;` on its line or has arguments, a POU's header does not.
    if (isName(tokens_[n].kind) && tokens_[n + 1].kind == Tok::Colon && isName(tokens_[n + 2].kind) &&
        tokens_[n + 3].kind == Tok::LeftParen)
      return true;
    for (uint32_t k = n; k < count_ && k < n + 40 && !atLineStart(k) && !isVarWord(tokens_[k].kind); ++k)
      if (tokens_[k].kind == Tok::Semicolon) return true;
    return false;
  }
  bool isResource(uint32_t i) const {
    const Tok next = tokens_[i + 1].kind;
    if (in_configuration_ && atLineStart(i) && next != Tok::Colon && next != Tok::Comma && next != Tok::At &&
        next != Tok::Assign)
      return true;
    return isName(next) &&
           (tokens_[i + 2].kind == Tok::On || (atLineStart(i) && isName(tokens_[i + 2].kind) && !atLineStart(i + 2)));
  }
  bool opens(uint32_t i) const {
    const Tok k = tokens_[i].kind;
    if (k == Tok::Program) return !isProgramInstance(i);
    if (k == Tok::Resource) return isResource(i);
    if (isMember(k)) return std::find(members_closed_.begin(), members_closed_.end(), k) != members_closed_.end();
    return closerOf(k) != Tok::End;
  }
  // Keywords that begin a new region regardless of open blocks.
  bool beginsRegion(uint32_t i) const {
    const Tok k = tokens_[i].kind;
    if (!atLineStart(i) && i > 0 && !isCloser(tokens_[i - 1].kind) && tokens_[i - 1].kind != Tok::Semicolon)
      return false;
    return k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Type || k == Tok::Configuration ||
           k == Tok::Interface || k == Tok::Class || (k == Tok::Program && !isProgramInstance(i));
  }
  std::string_view textOf(uint32_t i) const {
    const Token& t = tokens_[i];
    const size_t length = isName(t.kind) || isTypeWord(t.kind) ? names_.string({t.value}).size() : t.value;
    return source_.substr(t.offset, length);
  }
  Loc loc(uint32_t i) const { return {base_ + tokens_[i].offset}; }
  Loc endOf(uint32_t i) const { return {loc(i).offset + static_cast<uint32_t>(textOf(i).size())}; }
  // Adds the fix that takes the token away, with the `;` after it.
  void removal(Report report, uint32_t i, Sureness sureness) const {
    const auto begin = static_cast<uint32_t>(beginOfRemoval(source_, tokens_[i].offset));
    const bool has_semicolon = endsBlock(tokens_[i].kind) && tokens_[i + 1].kind == Tok::Semicolon;
    report.remove({base_ + begin}, endOf(has_semicolon ? i + 1 : i), textOf(i), sureness);
  }
  // END_… of a statement or a structure ends with `;`.
  static std::string wordWithSemicolon(Tok closer) {
    const bool is_open = !isPouCloser(closer) && closer != Tok::EndVar && closer != Tok::EndType &&
                         closer != Tok::EndConfiguration && closer != Tok::EndResource;
    return spelling(closer) + std::string(is_open ? ";" : "");
  }
  uint32_t columnOf(uint32_t i) const {
    uint32_t offset = tokens_[i].offset;
    const uint32_t end = offset;
    while (offset > 0 && source_[offset - 1] != '\n') --offset;
    return end - offset;
  }
  std::string describe(uint32_t i) const {
    if (tokens_[i].kind == Tok::End) return spelling(Tok::End);
    std::string shown(1, '`');
    shown.append(textOf(i).substr(0, 40));
    shown += '`';
    return shown;
  }
  std::string lineOf(const Open& open) const { return std::to_string(sources_.location(loc(open.index)).line); }

  // ---- the two passes over a region
  bool balanced(size_t first_block, size_t end_block);
  void repair(uint32_t first, uint32_t end);
  void visit(uint32_t i);
  void visitOpener(uint32_t i, Tok k);
  void visitMisspelled(uint32_t i);
  void removeDuplicate(uint32_t i);
  void suspectLine(uint32_t i);
  bool looksOutside(const Open& top, uint32_t i) const;
  bool beginsStatement(uint32_t i) const;
  void takeConnective(uint32_t i);
  void open(uint32_t i, Tok kind);
  void close(uint32_t i, Tok closer);
  size_t findBlock(uint32_t i, Tok closer) const;
  bool closeOther(uint32_t i, Tok closer, size_t found);
  bool endsMissingBlock(uint32_t i, Tok closer, size_t found);
  void stray(uint32_t i, Tok closer);
  bool openAtHeader(uint32_t low, Tok closer);
  bool openAtContent(uint32_t i, uint32_t low, Tok closer);
  bool openSection(uint32_t i);
  void leftOutermost(uint32_t i, Tok closer);
  bool comesBehind(uint32_t i, Tok closer) const {
    while (++i < region_end_)
      if (tokens_[i].kind == closer) return true;
    return false;
  }
  bool insideExpression(uint32_t i) const;
  void spoil(uint32_t i);
  void missingOpener(uint32_t at, Tok word);
  void leaveOpen(const Open& open, uint32_t forced);
  uint32_t findOpener(uint32_t i, Tok closer, Tok& meant);
  bool belongs(Tok connective, Tok opener) const;
  Loc gapBefore(uint32_t i, uint32_t& length) const;
  void edit(uint32_t index, EditKind kind, Tok word) { edits_.push_back({index, kind, word}); }
  void markReported(uint32_t i) { tokens_[i].flags |= kReported; }
  void apply();

  TokenStream& stream_;
  std::vector<Token>& tokens_;
  const Names& names_;
  const Sources& sources_;
  const LanguageProfile& profile_;
  Diagnostics& diagnostics_;
  uint32_t base_;
  std::string_view source_;
  uint32_t count_;
  bool in_configuration_ = false;
  std::vector<Tok> members_closed_;  // METHOD, PROPERTY, ACTION whose END_… the file writes (all of them in iec)

  std::vector<Open> stack_;
  std::vector<Orphan> orphans_;
  std::vector<Edit> edits_;
  uint32_t region_first_ = 0, region_end_ = 0;
  uint32_t line_first_ = 0, line_column_ = 0;
  uint32_t pending_header_ = 0;  // index + 1 of the IF, ELSIF, FOR, WHILE, CASE or ARRAY waiting for its THEN, DO or OF
  uint32_t decl_start_ = 0;      // first token of a line where declarations without a VAR may begin
  uint32_t outside_start_ = 0;   // first token after the last closed POU
  uint32_t searches_ = 0;
  bool global_section_ = false;  // the last section was at file level
};

void Balancer::run() {
  // Regions are delimited by keywords that occur only at file level, so that an error in one POU does not affect
  // others.
  const std::vector<uint32_t>& blocks = stream_.blocks;
  for (const Tok member : {Tok::Method, Tok::Property, Tok::Action}) {
    const auto closes = [&](uint32_t b) { return tokens_[b].kind == closerOf(member); };
    if (!profile_.optional_ends || std::any_of(blocks.begin(), blocks.end(), closes)) members_closed_.push_back(member);
  }
  size_t start = 0;
  bool any = false;
  std::vector<std::pair<uint32_t, uint32_t>> broken;
  for (size_t b = 0; b < blocks.size();) {
    start = b;
    in_configuration_ = tokens_[blocks[b]].kind == Tok::Configuration;
    ++b;
    while (b < blocks.size() && !beginsRegion(blocks[b])) ++b;
    if (!balanced(start, b)) {
      const uint32_t first = start == 0 ? 0 : blocks[start];
      const uint32_t end = b < blocks.size() ? blocks[b] : count_;
      broken.push_back({first, end});
      any = true;
    }
  }
  if (!any) return;
  for (const auto& [first, end] : broken) repair(first, end);
  apply();
}

bool Balancer::balanced(size_t first_block, size_t end_block) {
  static thread_local std::vector<Tok> stack;
  stack.clear();
  for (size_t b = first_block; b < end_block; ++b) {
    const uint32_t i = stream_.blocks[b];
    const Tok k = tokens_[i].kind;
    if (opens(i)) {
      // Sections contain no blocks but structures; structures contain no statements.
      if (!stack.empty() && (isVarWord(stack.back()) || stack.back() == Tok::Type) && k != Tok::Struct &&
          k != Tok::Union)
        return false;
      stack.push_back(k);
    } else if (isCloser(k)) {
      if (stack.empty() || closerOf(stack.back()) != k) return false;
      stack.pop_back();
    }
  }
  if (profile_.optional_ends && stack.size() == 1 && isPouOpener(stack.back())) return true;
  return stack.empty();
}

void Balancer::repair(uint32_t first, uint32_t end) {
  stack_.clear();
  orphans_.clear();
  region_first_ = first;
  region_end_ = end;
  pending_header_ = 0;
  decl_start_ = outside_start_ = first;
  in_configuration_ = tokens_[first].kind == Tok::Configuration;
  line_first_ = first;
  line_column_ = columnOf(first);
  for (uint32_t i = first; i < end; ++i) {
    if (atLineStart(i)) {
      line_first_ = i;
      line_column_ = columnOf(i);
    }
    visit(i);
  }
  while (!stack_.empty()) {
    const Open open = stack_.back();
    stack_.pop_back();
    if (isPouOpener(open.kind) && profile_.optional_ends) continue;
    leaveOpen(open, end);
  }
}

// If the line above token i is blank, the missing keyword most likely belongs there: returns that gap, else the token.
Loc Balancer::gapBefore(uint32_t i, uint32_t& length) const {
  length = 1;
  if (i > 0) {
    const Token& before = tokens_[i - 1];
    uint32_t p = before.offset + static_cast<uint32_t>(textOf(i - 1).size());
    while (p < tokens_[i].offset && source_[p] != '\n') ++p;
    if (p < tokens_[i].offset) {
      ++p;
      const uint32_t line = p;
      while (p < tokens_[i].offset && (source_[p] == ' ' || source_[p] == '\t')) ++p;
      if (p < source_.size() && (source_[p] == '\n' || source_[p] == '\r')) return {base_ + (p > line ? p - 1 : p)};
    }
  }
  if (tokens_[i].kind != Tok::End) {
    length = static_cast<uint32_t>(textOf(i).size());
    return loc(i);
  }
  if (i == 0) return loc(i);
  return {base_ + tokens_[i - 1].offset + static_cast<uint32_t>(textOf(i - 1).size())};
}

// Whether the line of token i, inside of a section, begins as a statement does.
bool Balancer::beginsStatement(uint32_t i) const {
  const Tok k = tokens_[i].kind, next = tokens_[i + 1].kind;
  return (isName(k) || beginsBlock(k)) &&
         (next == Tok::Assign || next == Tok::LeftParen || beginsBlock(k) || next == Tok::Dot ||
          next == Tok::LeftBracket || beginsIl(k, textOf(i), tokens_[i + 1]));
}

// Whether the line of token i, which is in the block `top` by its keywords, looks as if it followed the block's end.
bool Balancer::looksOutside(const Open& top, uint32_t i) const {
  const Tok k = tokens_[i].kind, next = tokens_[i + 1].kind;
  const bool names_something = isName(k) && (next == Tok::Colon || next == Tok::Comma || next == Tok::At);
  if (isVarWord(top.kind)) return !names_something && beginsStatement(i);
  if (top.kind == Tok::Type || line_column_ > top.column) return false;
  const bool is_else = k == Tok::Else || k == Tok::Elsif || k == Tok::Elseif;
  const bool middle = (is_else && (top.kind == Tok::If || (k == Tok::Else && top.kind == Tok::Case))) ||
                      (k == Tok::Until && top.kind == Tok::Repeat) || k == Tok::Then || k == Tok::Do || k == Tok::Of;
  const bool label =
      top.kind == Tok::Case && (k == Tok::Number || names_something || next == Tok::Hash || next == Tok::DotDot);
  return top.line_start && !label && (!middle || line_column_ < top.column) &&
         !(k == Tok::Ident && foldedCharacter(textOf(i)[0]) == 'e' && nearestKeyword(textOf(i), kClosers) != Tok::End);
}

// A line that is not indented deeper than the block it should be in: the block's end is likely missing before it.
void Balancer::suspectLine(uint32_t i) {
  if (stack_.empty() || isCloser(tokens_[i].kind)) return;
  Open& top = stack_.back();
  // After UNTIL and its condition only END_REPEAT is left to write.
  if (top.kind == Tok::Repeat && top.until != 0 && !top.after_until) {
    top.suspect = i;
    top.after_until = true;
  }
  const bool is_indented = !isPouOpener(top.kind) && top.kind != Tok::Configuration && top.kind != Tok::Resource;
  if (top.suspect == 0 && top.index < i && is_indented && looksOutside(top, i)) top.suspect = i;
}

// The words that a header waits for: THEN, DO and OF.
void Balancer::takeConnective(uint32_t i) {
  if (pending_header_ == 0) {
    orphans_.push_back({i, line_first_, line_column_});
    return;
  }
  const uint32_t header = pending_header_ - 1;
  if (!stack_.empty() && stack_.back().index == header) stack_.back().connective = tokens_[i].kind;
  pending_header_ = 0;
}

void Balancer::visit(uint32_t i) {
  const Tok k = tokens_[i].kind;
  if (i == line_first_) suspectLine(i);
  if (k == Tok::Until && !stack_.empty() && stack_.back().kind == Tok::Repeat) stack_.back().until = i;
  if (k == Tok::Elsif || k == Tok::Elseif || k == Tok::Array) {
    pending_header_ = i + 1;
    return;
  }
  if (k == Tok::Then || k == Tok::Do || k == Tok::Of) return takeConnective(i);
  if (k == Tok::Semicolon) {
    pending_header_ = 0;
    return;
  }
  const bool is_closer = isCloser(k), is_opener = opens(i);
  if ((is_closer || is_opener) && insideExpression(i)) return spoil(i);
  if (is_closer) return close(i, k);
  if (is_opener) return visitOpener(i, k);
  if (k == Tok::Ident && i > region_first_) visitMisspelled(i);
}

// Opens a block, unless its keyword is the second word of `END IF` or written twice.
void Balancer::visitOpener(uint32_t i, Tok k) {
  const bool continues_line = i > region_first_ && !atLineStart(i);
  if (continues_line && tokens_[i - 1].kind == Tok::EndSlip) {
    const std::string written = std::string(textOf(i - 1)) + " " + std::string(textOf(i));
    const Tok closer = closerOf(k);
    diagnostics_.report(diag::MisspelledKeyword, loc(i - 1), {written, spelling(closer)})
        .length(static_cast<uint32_t>(written.size()))
        .replace(loc(i - 1), endOf(i), spelling(closer), Sureness::Sure);
    markReported(i);
    edit(i - 1, EditKind::Remove, Tok::End);
    edit(i, EditKind::Correction, closer);
    return close(i, closer);
  }
  if (continues_line && tokens_[i - 1].kind == k) return removeDuplicate(i);
  open(i, k);
}

void Balancer::removeDuplicate(uint32_t i) {
  removal(diagnostics_.report(diag::DuplicateKeyword, loc(i), {textOf(i)}), i, Sureness::Sure);
  markReported(i);
  edit(i, EditKind::Remove, Tok::End);
}

// END_FI, ENDIF, END_FUCTION
void Balancer::visitMisspelled(uint32_t i) {
  const std::string_view word = textOf(i);
  if (!atLineStart(i) && tokens_[i - 1].kind != Tok::Semicolon &&
      !(word.size() > 4 && sameIdentifier(word.substr(0, 4), "END_")))
    return;
  static constexpr TokSet kAfterNames = {Tok::Assign,    Tok::Dot,         Tok::Colon,
                                         Tok::LeftParen, Tok::LeftBracket, Tok::Comma};
  if (word.size() < 4 || foldedCharacter(word[0]) != 'e' || kAfterNames.has(tokens_[i + 1].kind)) return;
  Tok meant = nearestKeyword(word, kClosers);
  if (meant == Tok::End) return;
  // Of two close candidates, the one that closes the open block.
  if (!stack_.empty() && closerOf(stack_.back().kind) != meant) {
    const Tok wanted[] = {closerOf(stack_.back().kind)};
    if (nearestKeyword(word, wanted) != Tok::End) meant = wanted[0];
  }
  diagnostics_.report(diag::MisspelledKeyword, loc(i), {word, spelling(meant)})
      .length(static_cast<uint32_t>(word.size()))
      .replace(spelling(meant), Sureness::Sure);
  markReported(i);
  edit(i, EditKind::Correction, meant);
  close(i, meant);
}

void Balancer::open(uint32_t i, Tok kind) {
  // A section that is still open where the next one, a statement or a POU begins.
  if (!stack_.empty() && (isVarWord(stack_.back().kind) || stack_.back().kind == Tok::Type) && kind != Tok::Struct &&
      kind != Tok::Union) {
    const Open section = stack_.back();
    stack_.pop_back();
    leaveOpen(section, i);
  }
  const bool chain = kind == Tok::If && i > region_first_ && tokens_[i - 1].kind == Tok::Else && !atLineStart(i);
  stack_.push_back({kind, i, line_column_, i == line_first_ || chain || kind == Tok::Struct || kind == Tok::Union,
                    chain, 0, 0, Tok::End, 0});
  if (hasHeader(kind)) pending_header_ = i + 1;
  if (isVarWord(kind)) global_section_ = kind == Tok::VarGlobal || kind == Tok::VarConfig || kind == Tok::VarAccess;
  if (isPouOpener(kind)) {
    decl_start_ = i + 1;
    while (decl_start_ < region_end_ && !atLineStart(decl_start_)) ++decl_start_;
  }
}

bool Balancer::belongs(Tok connective, Tok opener) const {
  for (const StatementBlock& block : kStatementBlocks)
    if (block.begin == opener) return block.connective == connective;
  return connective == Tok::End;
}

// The number of blocks up to the nearest one that the keyword closes, within the POU; 0: none.
size_t Balancer::findBlock(uint32_t i, Tok closer) const {
  size_t found = stack_.size();
  for (; found > 0; --found) {
    const Tok k = stack_[found - 1].kind;
    if (closerOf(k) == closer) break;
    if (isPouOpener(k) && !isPouCloser(closer)) return 0;
  }
  if (found == 0 || i != line_first_ || stack_[found - 1].column == line_column_ || isPouCloser(closer)) return found;
  // If the indentation matches an outer block, the inner ones are left open.
  for (size_t outer = found; outer-- > 1;) {
    const Open& o = stack_[outer - 1];
    if (isPouOpener(o.kind)) break;
    if (closerOf(o.kind) == closer && o.line_start && o.column == line_column_) return outer;
  }
  return found;
}

// Corrects the keyword that opened the innermost block, or this one at its end, where only one of them can be meant.
bool Balancer::closeOther(uint32_t i, Tok closer, size_t found) {
  if (stack_.empty() || found == stack_.size()) return false;
  const Open& top = stack_.back();
  const bool opens_pou = isPouOpener(top.kind);
  if (opens_pou && (!isPouCloser(closer) || found != 0)) return false;
  const bool found_by_column = found > 0 && stack_[found - 1].column == line_column_;
  const bool same_column = i == line_first_ && top.line_start && top.column == line_column_;
  if (!opens_pou && (!same_column || found_by_column)) return false;
  const std::span<const Tok> openers = openersFor(closer);
  const bool function_without_result = top.kind == Tok::Function && tokens_[top.index + 2].kind != Tok::Colon;
  if ((beginsBlock(top.kind) && !belongs(top.connective, top.kind) && belongs(top.connective, openers[0])) ||
      (function_without_result && isPouCloser(closer))) {
    diagnostics_.report(diag::WrongKeyword, loc(top.index), {textOf(top.index), spelling(openers[0])})
        .replace(spelling(openers[0]), Sureness::Sure);
    markReported(top.index);
    edit(top.index, EditKind::Correction, openers[0]);
  } else {
    const Tok right = closerOf(top.kind);
    diagnostics_.report(diag::WrongEnd, loc(i), {textOf(i), spelling(top.kind), lineOf(top), spelling(right)})
        .replace(spelling(right), Sureness::Sure);
    markReported(i);
    edit(i, EditKind::Correction, right);
  }
  stack_.pop_back();
  leftOutermost(i, closer);
  return true;
}

// `END_IF` of a line whose IF is missing or misspelled must not close the blocks around it.
bool Balancer::endsMissingBlock(uint32_t i, Tok closer, size_t found) {
  const Open& outer = stack_[found - 1];
  if (found == stack_.size() || i != line_first_ || outer.column == line_column_ || !beginsBlock(outer.kind))
    return false;
  const bool orphan = std::any_of(orphans_.begin(), orphans_.end(), [&](const Orphan& o) {
    return o.index > stack_.back().index && o.column == line_column_ && belongs(tokens_[o.index].kind, outer.kind);
  });
  Tok meant = Tok::End;
  return orphan || (stack_.back().column < line_column_ && findOpener(i, closer, meant) != 0);
}

void Balancer::close(uint32_t i, Tok closer) {
  // END_IF END_IF
  if (i > region_first_ && tokens_[i - 1].kind == closer && i != line_first_ &&
      (stack_.empty() || stack_.back().column < line_column_ || isPouOpener(stack_.back().kind)))
    return removeDuplicate(i);
  if ((closer == Tok::EndStruct || closer == Tok::EndUnion) && !stack_.empty() &&
      (stack_.back().kind == Tok::Type || isVarWord(stack_.back().kind)) &&
      openAtContent(i, stack_.back().index + 1, closer))
    return;
  const size_t found = findBlock(i, closer);
  // END_ACTION without ACTION is not a misspelled END_… of its block, which still follows.
  if (found == 0 && isMemberCloser(closer) && !stack_.empty() && isPouOpener(stack_.back().kind) &&
      !isMember(stack_.back().kind) && comesBehind(i, closerOf(stack_.back().kind)))
    return stray(i, closer);
  if (closeOther(i, closer, found)) return;
  if (found == 0 || endsMissingBlock(i, closer, found)) return stray(i, closer);
  while (stack_.size() > found) {
    const Open open = stack_.back();
    stack_.pop_back();
    leaveOpen(open, i);
  }
  const Open done = stack_.back();
  stack_.pop_back();
  if (done.is_chain && !stack_.empty()) stack_.back().chain_child = done.index;
  if (isVarWord(done.kind)) {
    decl_start_ = i + 1;
    while (decl_start_ < region_end_ && !atLineStart(decl_start_)) ++decl_start_;
  }
  leftOutermost(i, closer);
}

void Balancer::leftOutermost(uint32_t i, Tok closer) {
  if (closer == Tok::EndVar && stack_.empty() && global_section_ && line_column_ == 0) outside_start_ = i + 1;
  if (stack_.empty() && (isPouCloser(closer) || closer == Tok::EndType || closer == Tok::EndConfiguration))
    outside_start_ = i + 1;
}

// A block without end. forced: the last token at which the end could be missing.
void Balancer::leaveOpen(const Open& open, uint32_t forced) {
  const Tok closer = closerOf(open.kind);
  if (open.chain_child != 0) {
    const uint32_t child = open.chain_child;
    const std::string written = std::string(textOf(child - 1)) + " " + std::string(textOf(child));
    diagnostics_.report(diag::ElseIf, loc(child - 1), {written})
        .length(tokens_[child].offset + 2 - tokens_[child - 1].offset)
        .replace(loc(child - 1), {loc(child).offset + 2}, spelling(Tok::Elsif), Sureness::Sure);
    markReported(child);
    edit(child - 1, EditKind::Remove, Tok::End);
    edit(child, EditKind::Correction, Tok::Elsif);
    if (open.is_chain && !stack_.empty()) stack_.back().chain_child = open.index;
    return;
  }
  const uint32_t at = open.suspect != 0 && open.suspect < forced ? open.suspect : forced;
  uint32_t length = 1;
  Loc gap = gapBefore(at, length);
  if (open.after_until && at == open.suspect) {
    gap = {loc(at - 1).offset + static_cast<uint32_t>(textOf(at - 1).size())};
    length = 1;
    markReported(at - 1);
  }
  const Insertion end = endOfBlock(source_, tokens_[open.index].offset, at == 0 ? 0 : endOf(at - 1).offset - base_,
                                   tokens_[at].offset, wordWithSemicolon(closer));
  Report report =
      diagnostics_.report(diag::MissingEnd, gap, {spelling(closer), textOf(open.index), lineOf(open)}).length(length);
  const bool lacks_more =
      (open.kind == Tok::Repeat && open.until == 0) || (at > 0 && isOperatorSign(tokens_[at - 1].kind));
  const Sureness sureness = open.after_until ? Sureness::Proposal : Sureness::Sure;  // a later END_REPEAT may be its
  if (!lacks_more) report.insert({base_ + static_cast<uint32_t>(end.at)}, end.text, sureness);
  markReported(at);
  if (at == count_ && at > 0) markReported(at - 1);
  edit(at, EditKind::Insert, closer);
  if (isVarWord(open.kind)) decl_start_ = at;
}

// The keyword on an earlier line that was most likely meant to open the block closed by `closer`.
uint32_t Balancer::findOpener(uint32_t i, Tok closer, Tok& meant) {
  if (++searches_ > 50) return 0;
  const std::span<const Tok> openers = openersFor(closer);
  const uint32_t low = stack_.empty() ? outside_start_ : stack_.back().index + 1;
  for (uint32_t k = i; k-- > low;) {
    const bool behind_colon =
        (closer == Tok::EndStruct || closer == Tok::EndUnion) && k > 0 && tokens_[k - 1].kind == Tok::Colon;
    if (tokens_[k].kind != Tok::Ident || (!atLineStart(k) && !behind_colon)) continue;
    const Tok next = tokens_[k + 1].kind;
    if (next == Tok::Assign || next == Tok::Colon || next == Tok::Comma || next == Tok::Dot) continue;
    meant = nearestKeyword(textOf(k), openers);
    if (meant != Tok::End) return k + 1;
  }
  return 0;
}

// The header of a block is there, its first keyword is missing or another word.
bool Balancer::openAtHeader(uint32_t low, Tok closer) {
  const std::span<const Tok> openers = openersFor(closer);
  if (openers.empty() || !hasHeader(openers[0])) return false;
  const Orphan* best = nullptr;
  for (const Orphan& o : orphans_)
    if (o.index >= low && belongs(tokens_[o.index].kind, openers[0]) && (o.column == line_column_ || best == nullptr))
      best = &o;
  if (best == nullptr) return false;
  const uint32_t at = best->line_first;
  orphans_.erase(orphans_.begin() + (best - orphans_.data()));
  const Tok next = tokens_[at + 1].kind;
  if (!atLineStart(at + 1) &&
      (isName(next) || next == Tok::Not || next == Tok::Number ||
       (!isName(tokens_[at].kind) && tokens_[at].kind != Tok::LeftParen && next == Tok::LeftParen))) {
    diagnostics_.report(diag::WrongKeyword, loc(at), {textOf(at), spelling(openers[0])})
        .length(static_cast<uint32_t>(textOf(at).size()))
        .replace(spelling(openers[0]), Sureness::Sure);
    markReported(at);
    edit(at, EditKind::Correction, openers[0]);
    return true;
  }
  diagnostics_.report(diag::MissingOpener, loc(at), {spelling(openers[0]), describe(at)})
      .length(static_cast<uint32_t>(textOf(at).size()))
      .insert(loc(at), std::string(spelling(openers[0])) + " ", Sureness::Sure);
  markReported(at);
  edit(at, EditKind::Insert, openers[0]);
  return true;
}

// `name : <line end>` without STRUCT; `name ON type` without RESOURCE; the indented lines above UNTIL without REPEAT.
bool Balancer::openAtContent(uint32_t i, uint32_t low, Tok closer) {
  static constexpr TokSet kByContent = {Tok::EndStruct, Tok::EndUnion, Tok::EndResource, Tok::EndRepeat};
  if (!kByContent.has(closer)) return false;
  const std::span<const Tok> openers = openersFor(closer);
  uint32_t at = 0;
  uint32_t until = 0;
  for (uint32_t k = i, steps = 0; k-- > low && at == 0 && steps < 20000; ++steps) {
    if (closer == Tok::EndResource) {
      if (atLineStart(k) && isName(tokens_[k].kind) && tokens_[k + 1].kind == Tok::On) at = k;
    } else if (closer == Tok::EndRepeat) {
      if (tokens_[k].kind == Tok::Until && until == 0) until = k;
      if (until != 0 && k < until && atLineStart(k) && columnOf(k) <= line_column_) {
        at = k + 1;
        while (at < until && !atLineStart(at)) ++at;
      }
    } else if (atLineStart(k + 1) && isName(tokens_[k + 1].kind) && tokens_[k + 2].kind == Tok::Colon &&
               (tokens_[k].kind == Tok::Colon || (isName(tokens_[k].kind) && atLineStart(k)))) {
      at = k + 1;
    }
  }
  if (at == 0) return false;
  if (closer == Tok::EndStruct || closer == Tok::EndUnion) {
    diagnostics_.report(diag::MissingOpener, {loc(at - 1).offset + 1}, {spelling(openers[0]), describe(at)})
        .length(1)
        .insert(endOf(at - 1), " " + std::string(spelling(openers[0])), Sureness::Sure);
    markReported(at - 1);
    edit(at, EditKind::Insert, openers[0]);
  } else {
    missingOpener(at, openers[0]);
  }
  return true;
}

// Another word is written where VAR should be; it may have been reported and removed already.
bool Balancer::openSection(uint32_t i) {
  if (decl_start_ < i && (tokens_[decl_start_].flags & kReported) != 0 && !isName(tokens_[decl_start_].kind)) {
    markReported(decl_start_ + 1);
    edit(decl_start_ + 1, EditKind::Insert, Tok::Var);
    decl_start_ = i + 1;
    return true;
  }
  if (decl_start_ < i && !isName(tokens_[decl_start_].kind) &&
      (atLineStart(decl_start_ + 1) ||
       (isName(tokens_[decl_start_ + 1].kind) &&
        (tokens_[decl_start_ + 2].kind == Tok::Colon || tokens_[decl_start_ + 2].kind == Tok::Comma ||
         tokens_[decl_start_ + 2].kind == Tok::At)))) {
    diagnostics_.report(diag::WrongKeyword, loc(decl_start_), {textOf(decl_start_), "VAR"})
        .length(static_cast<uint32_t>(textOf(decl_start_).size()))
        .replace("VAR", Sureness::Sure);
    markReported(decl_start_);
    edit(decl_start_, EditKind::Correction, Tok::Var);
    decl_start_ = i + 1;
    return true;
  }
  return false;
}

void Balancer::stray(uint32_t i, Tok closer) {
  Tok meant = Tok::End;
  if (const uint32_t found = findOpener(i, closer, meant); found != 0) {
    const uint32_t k = found - 1;
    diagnostics_.report(diag::MisspelledKeyword, loc(k), {textOf(k), spelling(meant)})
        .length(static_cast<uint32_t>(textOf(k).size()))
        .replace(spelling(meant), Sureness::Sure);
    markReported(k);
    edit(k, EditKind::Correction, meant);
    leftOutermost(i, closer);
    return;
  }
  const uint32_t low = stack_.empty() ? outside_start_ : stack_.back().index + 1;
  if (openAtHeader(low, closer) || openAtContent(i, low, closer)) return;
  if (closer == Tok::EndVar && openSection(i)) return;
  const std::span<const Tok> openers = openersFor(closer);
  uint32_t insert = 0;
  if (closer == Tok::EndVar && decl_start_ < i && isName(tokens_[decl_start_].kind)) insert = decl_start_ + 1;
  if ((isPouCloser(closer) || closer == Tok::EndConfiguration || closer == Tok::EndType) && stack_.empty() &&
      outside_start_ < i) {
    const uint32_t at = outside_start_;
    if (!isName(tokens_[at].kind) && !opens(at) && (isName(tokens_[at + 1].kind) || atLineStart(at + 1))) {
      diagnostics_.report(diag::WrongKeyword, loc(at), {textOf(at), spelling(openers[0])})
          .length(static_cast<uint32_t>(textOf(at).size()))
          .replace(spelling(openers[0]), Sureness::Sure);
      markReported(at);
      edit(at, EditKind::Correction, openers[0]);
      leftOutermost(i, closer);
      return;
    }
    insert = at + 1;
  }
  if (insert != 0) {
    missingOpener(insert - 1, openers[0]);
    leftOutermost(i, closer);
    decl_start_ = i + 1;
    return;
  }
  removal(diagnostics_.report(diag::StrayEnd, loc(i), {textOf(i)}), i, Sureness::Proposal);
  markReported(i);
  edit(i, EditKind::Remove, Tok::End);
}

void Balancer::missingOpener(uint32_t at, Tok word) {
  uint32_t length = static_cast<uint32_t>(textOf(at).size());
  // A keyword with its name on the same line is missing on this line, the others on the blank line above.
  const Loc gap =
      isPouOpener(word) || word == Tok::Configuration || word == Tok::Resource ? loc(at) : gapBefore(at, length);
  diagnostics_.report(diag::MissingOpener, gap, {spelling(word), describe(at)})
      .length(length)
      .insert(loc(at), std::string(spelling(word)) + " ", Sureness::Sure);
  markReported(at);
  edit(at, EditKind::Insert, word);
}

// A block keyword where only a value is allowed: `x := a + IF;`, `state END_VAR INT := 0;`
bool Balancer::insideExpression(uint32_t i) const {
  if (atLineStart(i) || i == region_first_) return false;
  const Tok k = tokens_[i].kind, before = tokens_[i - 1].kind, next = tokens_[i + 1].kind;
  if (before == Tok::Dot || before == Tok::Assign || before == Tok::LeftParen || before == Tok::Comma ||
      before == Tok::LeftBracket || (before >= Tok::Plus && before <= Tok::EqualLess) ||
      (before >= Tok::And && before <= Tok::Mod))
    return true;
  if (pending_header_ != 0 && beginsBlock(k) && before != Tok::EndSlip && before != k) return true;
  if (isPouOpener(k) && before != Tok::Semicolon && !isCloser(before)) return true;
  const bool is_statement_word = beginsBlock(k) || endsBlock(k);
  if (is_statement_word && !stack_.empty() && (isVarWord(stack_.back().kind) || stack_.back().kind == Tok::Struct) &&
      before != Tok::Semicolon && stack_.back().index + 1 != i)
    return true;
  // `f IF (x);`: after a value, a statement begins only where its header follows.
  if (hasHeader(k) && before != Tok::EndSlip &&
      (isName(before) || (before >= Tok::Number && before <= Tok::Ident) || before == Tok::RightParen)) {
    for (uint32_t n = i + 1; n < count_ && !atLineStart(n) && tokens_[n].kind != Tok::Semicolon; ++n)
      if (tokens_[n].kind == Tok::Then || tokens_[n].kind == Tok::Do || tokens_[n].kind == Tok::Of) return false;
    return true;
  }
  return (k == Tok::EndVar || k == Tok::EndStruct) && before != Tok::Semicolon && !isVarWord(before) &&
         before != Tok::Struct && !atLineStart(i + 1) && next != Tok::Semicolon && !isVarWord(next);
}

// Makes the token an error token that has been reported.
void Balancer::spoil(uint32_t i) {
  diagnostics_.report(diag::MissingValue, loc(i), {describe(i)}).length(static_cast<uint32_t>(textOf(i).size()));
  markReported(i);
  edit(i, EditKind::Correction, Tok::Error);
}

void Balancer::apply() {
  std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.index < b.index; });
  std::vector<Token> out;
  out.reserve(tokens_.size() + edits_.size());
  size_t e = 0;
  for (uint32_t i = 0; i < tokens_.size(); ++i) {
    bool removed = false;
    Tok corrected = Tok::End;
    for (; e < edits_.size() && edits_[e].index == i; ++e) {
      switch (edits_[e].kind) {
        case EditKind::Insert:
          out.push_back({tokens_[i].offset, 0, edits_[e].word,
                         static_cast<uint8_t>(kSynthetic | (tokens_[i].flags & kLineStart)), 0});
          if (!isCloser(edits_[e].word)) tokens_[i].flags &= static_cast<uint8_t>(~kLineStart);
          break;
        case EditKind::Remove: removed = true; break;
        case EditKind::Correction: corrected = edits_[e].word; break;
      }
    }
    if (removed) {
      // The next token takes its position on the line.
      if (i + 1 < tokens_.size()) tokens_[i + 1].flags |= tokens_[i].flags & (kLineStart | kPragma | kDoc | kReported);
      continue;
    }
    Token token = tokens_[i];
    if (corrected != Tok::End) {
      token.value = static_cast<uint32_t>(textOf(i).size());
      token.kind = corrected;
    }
    out.push_back(token);
  }
  tokens_ = std::move(out);
}

}  // namespace

void balanceBlocks(TokenStream& stream, const Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics) {
  Balancer(stream, names, sources, file, dialect, diagnostics).run();
}

Tok nearestKeyword(std::string_view written, std::span<const Tok> candidates) {
  std::vector<std::string_view> spellings;
  spellings.reserve(candidates.size());
  for (Tok t : candidates) spellings.push_back(spelling(t));
  const std::string_view found = nearest(upper(written), spellings);
  if (found.empty()) return Tok::End;
  for (Tok t : candidates)
    if (found == spelling(t)) return t;
  return Tok::End;
}

}  // namespace rung::text

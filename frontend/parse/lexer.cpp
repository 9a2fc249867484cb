// SPDX-License-Identifier: Apache-2.0
#include "frontend/parse/lexer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/foreign.h"
#include "frontend/source/dialect.h"
#include "frontend/source/invariant.h"
#include "frontend/source/nested_comments.h"
#include "frontend/source/text.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::text {
namespace {

enum CharClass : uint8_t { kStray, kSpace, kNewline, kLetter, kDigit, kPunct, kQuote, kNul };

constexpr std::array<uint8_t, 256> makeClasses() {
  std::array<uint8_t, 256> c{};
  c[0] = kNul;
  c[' '] = c['\t'] = c['\f'] = c['\v'] = kSpace;
  c['\n'] = c['\r'] = kNewline;
  for (int i = 'a'; i <= 'z'; ++i) c[static_cast<size_t>(i)] = c[static_cast<size_t>(i - 32)] = kLetter;
  c['_'] = kLetter;
  for (int i = '0'; i <= '9'; ++i) c[static_cast<size_t>(i)] = kDigit;
  for (char p : {';', ':', ',', '.', '(', ')', '[', ']', '^', '#', '=', '+',
                 '-', '*', '/', '<', '>', '&', '!', '|', '%', '{', '?'})
    c[static_cast<unsigned char>(p)] = kPunct;
  c['\''] = c['"'] = kQuote;
  return c;
}
constexpr std::array<uint8_t, 256> kClasses = makeClasses();

constexpr std::array<bool, 256> makeWordChars() {
  std::array<bool, 256> w{};
  for (size_t i = 0; i < 256; ++i) w[i] = kClasses[i] == kLetter || kClasses[i] == kDigit;
  return w;
}
constexpr std::array<bool, 256> kWordChar = makeWordChars();

struct Spelling {
  const char* text;
  uint8_t length;
};
constexpr uint8_t lengthOf(const char* s) {
  uint8_t n = 0;
  while (s[n] != 0) ++n;
  return n;
}
constexpr Spelling kSpellings[] = {
#define RUNG_TOKEN(name, what) {what, lengthOf(what)},
#define RUNG_PUNCT(name, spelling) {spelling, lengthOf(spelling)},
#define RUNG_WORD(name, spelling) {spelling, lengthOf(spelling)},
#define RUNG_TYPE_WORD(name, spelling) {spelling, lengthOf(spelling)},
#define RUNG_SOFT_WORD(name, spelling) {spelling, lengthOf(spelling)},
#include "frontend/parse/tokens.def"
};

// The keyword table: open addressing on length and three letters, so that nearly every name hits an empty slot.
constexpr size_t kWordSlots = 1024;
constexpr uint32_t wordHash(const char* s, uint32_t n) {
  const auto a = static_cast<unsigned char>(s[0] | 0x20);
  const auto b = static_cast<unsigned char>(s[n / 2] | 0x20);
  const auto c = static_cast<unsigned char>(s[n - 1] | 0x20);
  return (n * 131u + a * 7u + b * 61u + c * 313u + (static_cast<unsigned char>(s[n > 5 ? 5 : 0] | 0x20) * 29u)) &
         (kWordSlots - 1);
}
struct KeywordTable {
  uint8_t slot[kWordSlots] = {};
  constexpr KeywordTable() {
    for (uint32_t k = static_cast<uint32_t>(Tok::And); k < kTokCount; ++k) {
      uint32_t h = wordHash(kSpellings[k].text, kSpellings[k].length);
      while (slot[h] != 0) h = (h + 1) & (kWordSlots - 1);
      slot[h] = static_cast<uint8_t>(k);
    }
  }
};
constexpr KeywordTable kKeywords;
constexpr uint32_t kLongestKeyword = 18;  // END_FUNCTION_BLOCK

Tok findKeyword(const char* s, uint32_t n) {
  if (n > kLongestKeyword) return Tok::Ident;
  for (uint32_t h = wordHash(s, n);; h = (h + 1) & (kWordSlots - 1)) {
    const uint8_t k = kKeywords.slot[h];
    if (k == 0) return Tok::Ident;
    if (kSpellings[k].length != n) continue;
    uint32_t i = 0;
    while (i < n && foldedCharacter(s[i]) == foldedCharacter(kSpellings[k].text[i])) ++i;
    if (i == n) return static_cast<Tok>(k);
  }
}

// Keywords that open, divide or close blocks; recover.cpp checks that they balance.
constexpr std::array<bool, kTokCount> makeBlockKeywords() {
  std::array<bool, kTokCount> b{};
  for (const StatementBlock& block : kStatementBlocks)
    b[static_cast<size_t>(block.begin)] = b[static_cast<size_t>(block.end)] = true;
  for (Tok t : {Tok::Type,
                Tok::EndType,
                Tok::Struct,
                Tok::EndStruct,
                Tok::Union,
                Tok::EndUnion,
                Tok::Var,
                Tok::VarInput,
                Tok::VarOutput,
                Tok::VarInOut,
                Tok::VarTemp,
                Tok::VarExternal,
                Tok::VarGlobal,
                Tok::VarStat,
                Tok::VarAccess,
                Tok::VarInst,
                Tok::VarConfig,
                Tok::EndVar,
                Tok::VarGeneric,
                Tok::Function,
                Tok::EndFunction,
                Tok::FunctionBlock,
                Tok::EndFunctionBlock,
                Tok::Program,
                Tok::EndProgram,
                Tok::Method,
                Tok::EndMethod,
                Tok::Property,
                Tok::PropertyGet,
                Tok::PropertySet,
                Tok::EndProperty,
                Tok::Action,
                Tok::EndAction,
                Tok::Interface,
                Tok::EndInterface,
                Tok::Class,
                Tok::EndClass,
                Tok::Namespace,
                Tok::Using,
                Tok::Configuration,
                Tok::EndConfiguration,
                Tok::Resource,
                Tok::EndResource})
    b[static_cast<size_t>(t)] = true;
  return b;
}
constexpr std::array<bool, kTokCount> kBlockKeyword = makeBlockKeywords();

// Keywords that sources of CODESYS and TwinCAT use as names; in the other dialects parseNewName reports them: its
// version 2.3 had no LTIME, LDATE, LTOD and LDT, no version has CHAR, WCHAR and REF_TO, and the others are keywords
// only where a statement or declaration has them.
bool isForeignType(Tok kind) {
  static constexpr TokSet kTypes = {Tok::Ltime, Tok::Ldate, Tok::Ltod, Tok::Ldt, Tok::Char, Tok::Wchar, Tok::RefTo};
  return kTypes.has(kind);
}
bool isPartWord(Tok kind) {
  static constexpr TokSet kWords = {Tok::To, Tok::By, Tok::Continue};
  return kWords.has(kind);
}
bool isPlantWord(Tok kind) { return kind == Tok::Configuration || kind == Tok::Resource; }  // a name follows
bool mayBeName(Tok kind) { return isForeignType(kind) || isPartWord(kind) || isPlantWord(kind); }

enum class Prefix : uint8_t { None, Duration, Date, TimeOfDay, DateTime };
Prefix prefixOf(std::string_view word) {
  struct Row {
    const char* word;
    Prefix prefix;
  };
  static constexpr Row kRows[] = {{"T", Prefix::Duration},
                                  {"TIME", Prefix::Duration},
                                  {"LT", Prefix::Duration},
                                  {"LTIME", Prefix::Duration},
                                  {"D", Prefix::Date},
                                  {"DATE", Prefix::Date},
                                  {"LD", Prefix::Date},
                                  {"LDATE", Prefix::Date},
                                  {"TOD", Prefix::TimeOfDay},
                                  {"LTOD", Prefix::TimeOfDay},
                                  {"TIME_OF_DAY", Prefix::TimeOfDay},
                                  {"LTIME_OF_DAY", Prefix::TimeOfDay},
                                  {"DT", Prefix::DateTime},
                                  {"LDT", Prefix::DateTime},
                                  {"DATE_AND_TIME", Prefix::DateTime},
                                  {"LDATE_AND_TIME", Prefix::DateTime}};
  for (const Row& row : kRows)
    if (sameIdentifier(word, row.word)) return row.prefix;
  return Prefix::None;
}

class Lexer {
 public:
  Lexer(TokenStream& out, Names& names, const Sources& sources, FileId file, Dialect dialect, Diagnostics& diagnostics)
      : out_(out),
        names_(names),
        profile_(profileOf(dialect)),
        diagnostics_(diagnostics),
        base_(sources.begin(file).offset),
        source_(sources.sourceText(file)),
        path_(sources.path(file)),
        any_underscores_(sources.hasAnyUnderscores(file)),
        names_seen_(names.count()) {}

  void run(uint32_t begin, uint32_t end);

 private:
  using Byte = unsigned char;

  uint32_t at(const char* p) const { return static_cast<uint32_t>(p - source_.data()); }
  Loc loc(const char* p) const { return {base_ + at(p)}; }
  void push(Tok kind, const char* begin, uint32_t value, uint32_t name_length = 0) {
    const auto length = static_cast<uint16_t>(name_length <= UINT16_MAX ? name_length : 0);
    out_.tokens.push_back({at(begin), value, kind, flags_, length});
    flags_ = 0;
  }
  void flushPending(const char* token);
  const char* commentOrPragma(const char* begin);
  const char* word(const char* p);
  const char* number(const char* p);
  const char* quoted(const char* p);
  const char* address(const char* p);
  struct Punct {
    Tok kind;
    uint8_t length;
  };
  static Punct punctAt(const char* p);
  const char* punct(const char* p);
  const char* blockComment(const char* p, bool slash);
  const char* debugLine(const char* begin) const;
  const char* lineComment(const char* p);
  static bool isDoc(const char* p) { return p[2] == '/' && p[3] != '/'; }
  void keep(const char* begin, const char* end, CommentKind kind) {
    if (out_.comments != nullptr) out_.comments->push_back({{loc(begin), loc(end)}, kind});
  }
  const char* pragma(const char* p);
  uint32_t cppOpening(const char* p) const;
  const char* cpp(const char* p);
  // `ST?` of Instruction List, without a space.
  bool behindSt(const char* p) const {
    return at(p) >= 2 && sameIdentifier({p - 2, 2}, "ST") && (at(p) == 2 || !kWordChar[static_cast<Byte>(p[-3])]);
  }
  const char* stray(const char* p);
  const char* prefixed(const char* begin, const char* p, Prefix prefix);
  void message(const char* begin, const char* end);
  void switchWarnings(const char* begin, const char* end);
  void checkPragma(std::string_view word, const char* rest, const char* end);
  void checkUnderscores(const char* begin, const char* end);
  bool continuesOverLines(const char* p, char quote) const;
  void resolveDeclaredWords();
  const char* endOfLine(const char* p) const {
    while (p < end_ && *p != '\n' && *p != '\r') ++p;
    return p;
  }
  Tok last() const { return out_.tokens.empty() ? Tok::End : out_.tokens.back().kind; }

  TokenStream& out_;
  Names& names_;
  const LanguageProfile& profile_;
  bool nests_ = true;  // CODESYS 2.3: comments nest in the current object
  Diagnostics& diagnostics_;
  uint32_t base_;
  std::string_view source_;
  std::string_view path_;
  bool any_underscores_;
  const char* end_ = nullptr;
  uint32_t names_seen_;
  uint8_t flags_ = kLineStart;
  uint32_t pending_pragmas_ = 0;  // pragmas at the end of out_.pragmas that wait for their token
  bool may_be_name_ = false;      // a word that mayBeName was read
  uint32_t doc_ = 0;              // first `///` line above the next token; 0: none, else offset + 1
};

// Pragmas and docs wait for the token that follows them.
void Lexer::flushPending(const char* token) {
  const uint32_t offset = at(token);
  if (pending_pragmas_ > 0) {
    for (size_t i = out_.pragmas.size() - pending_pragmas_; i < out_.pragmas.size(); ++i)
      out_.pragmas[i].token_offset = offset;
    pending_pragmas_ = 0;
    flags_ |= kPragma;
  }
  if (doc_ != 0) {
    out_.docs.push_back({offset, doc_ - 1});
    doc_ = 0;
    flags_ |= kDoc;
  }
}

// After the comment or pragma that begins here; null: none does.
const char* Lexer::commentOrPragma(const char* begin) {
  if (*begin == '/' && begin[1] == '/') {
    const char* const p = lineComment(begin);
    keep(begin, p > begin && p[-1] == '\r' ? p - 1 : p, isDoc(begin) ? CommentKind::Doc : CommentKind::Line);
    return p;
  }
  if ((*begin == '(' || *begin == '/') && begin[1] == '*') {
    const char* const p = blockComment(begin, *begin == '/');
    keep(begin, p, CommentKind::Block);
    return p;
  }
  return *begin == '{' && cppOpening(begin) == 0 ? pragma(begin) : nullptr;
}

void Lexer::run(uint32_t begin, uint32_t end) {
  const char* p = source_.data() + begin;
  end_ = source_.data() + end;
  out_.tokens.reserve((end - begin) / 4 + 16);
  if (const void* nul = std::memchr(p, 0, end - begin); nul != nullptr) {
    diagnostics_.report(diag::BinaryFile, loc(static_cast<const char*>(nul)), {path_});
    end_ = p;
  }
  while (p < end_) {
    const auto cls = static_cast<CharClass>(kClasses[static_cast<Byte>(*p)]);
    if (cls == kSpace || cls == kNewline) {
      ++p;
      if (cls == kNewline) flags_ |= kLineStart;
      continue;
    }
    if (const char* const after = cls == kPunct ? commentOrPragma(p) : nullptr; after != nullptr) {
      p = after;
      continue;
    }
    if ((pending_pragmas_ | doc_) != 0) flushPending(p);
    switch (cls) {
      case kLetter: p = word(p); break;
      case kDigit: p = number(p); break;
      case kPunct: p = *p == '{' ? cpp(p) : punct(p); break;
      case kQuote: p = quoted(p); break;
      case kStray:
      case kNul: p = stray(p); break;
      case kSpace:
      case kNewline: break;
    }
  }
  flushPending(end_);
  flags_ |= kLineStart;
  for (uint32_t i = 0; i < kLookahead; ++i) out_.tokens.push_back({at(end_), 0, Tok::End, flags_, 0});
  if (may_be_name_) resolveDeclaredWords();
}

const char* Lexer::word(const char* begin) {
  const char* p = begin + 1;
  while (kWordChar[static_cast<Byte>(*p)]) ++p;
  if (static_cast<Byte>(*p) >= 0x80) return stray(begin);
  const auto length = static_cast<uint32_t>(p - begin);
  if (*p == '#' && p < end_)
    if (const Prefix prefix = prefixOf({begin, length}); prefix != Prefix::None) return prefixed(begin, p + 1, prefix);
  const Tok kind = findKeyword(begin, length);
  may_be_name_ = may_be_name_ || mayBeName(kind);
  if (kBlockKeyword[static_cast<size_t>(kind)]) out_.blocks.push_back(static_cast<uint32_t>(out_.tokens.size()));
  if (isReserved(kind)) {
    push(kind, begin, length);
    return p;
  }
  const NameId name = names_.intern({begin, length});
  if (names_.count() != names_seen_) {  // a new spelling: checked only once
    names_seen_ = names_.count();
    checkUnderscores(begin, p);
  }
  push(kind, begin, name.index, length);
  return p;
}

// Tells whether the token declares a variable or member, by what is on both sides of it.
static bool isDeclared(const std::vector<Token>& tokens, size_t i) {
  const Tok next = tokens[i + 1].kind;
  if (next != Tok::Colon && next != Tok::Comma && !(next == Tok::At && tokens[i + 2].kind == Tok::Address))
    return false;
  if (i == 0 || (tokens[i].flags & kLineStart) != 0) return true;
  const Tok before = tokens[i - 1].kind;
  static constexpr TokSet kBefore = {Tok::Semicolon, Tok::Struct, Tok::Union,
                                     Tok::Constant,  Tok::Retain, Tok::Persistent};
  return kBefore.has(before) || (before >= Tok::Var && before <= Tok::VarConfig) ||
         (before == Tok::Comma && next == Tok::Colon);
}

// In a source that declares a variable or member with the name of such a keyword, a type is that name wherever a type
// is not possible, and the other words wherever they cannot be keywords; everywhere after a dot.
void Lexer::resolveDeclaredWords() {
  std::vector<Token>& tokens = out_.tokens;
  bool declared[kTokCount] = {};
  for (size_t i = 0; i < tokens.size(); ++i)
    if (mayBeName(tokens[i].kind) && isDeclared(tokens, i)) declared[static_cast<size_t>(tokens[i].kind)] = true;
  static constexpr TokSet kOperandFollows = {Tok::If,  Tok::Elsif, Tok::While, Tok::Until,      Tok::Case,
                                             Tok::Not, Tok::And,   Tok::Or,    Tok::Xor,        Tok::Mod,
                                             Tok::For, Tok::To,    Tok::By,    Tok::LeftBracket};
  Tok before = Tok::Semicolon;
  for (size_t i = 0; i < tokens.size(); ++i) {
    Token& token = tokens[i];
    const Tok last = std::exchange(before, token.kind), next = i + 1 < tokens.size() ? tokens[i + 1].kind : Tok::End;
    if (!mayBeName(token.kind) || next == Tok::Hash) continue;
    const bool type = last == Tok::Colon || last == Tok::Of || last == Tok::To || last == Tok::RefTo;
    const bool operand = (last > Tok::Colon && last <= Tok::EqualLess && last != Tok::RightParen &&
                          last != Tok::RightBracket && last != Tok::Caret) ||
                         kOperandFollows.has(last) || next == Tok::Assign || next == Tok::Arrow || next == Tok::Comma ||
                         next == Tok::Colon || next == Tok::RightParen || next == Tok::Dot ||
                         (next == Tok::At && i + 2 < tokens.size() && tokens[i + 2].kind == Tok::Address);
    const bool name = isPlantWord(token.kind) ? !isName(next) : isPartWord(token.kind) ? operand : !type;
    const bool member = last == Tok::Dot && isReserved(token.kind);
    const bool pin = (last == Tok::LeftParen || last == Tok::LeftBracket || last == Tok::Comma) &&
                     (next == Tok::Assign || next == Tok::Arrow);
    if (!member && !pin && (!declared[static_cast<size_t>(token.kind)] || !name)) continue;
    if (isReserved(token.kind)) {
      const auto length = static_cast<uint16_t>(token.value);
      token.value = names_.intern(source_.substr(token.offset, length)).index;
      token.name_length = length;
    }
    token.kind = before = Tok::Ident;
  }
}

void Lexer::checkUnderscores(const char* begin, const char* end) {
  if (any_underscores_) return;
  std::string_view name(begin, static_cast<size_t>(end - begin));
  // TO___XWORD, INT_TO___UXINT: the conversions to the types whose names begin so. TwinCAT, "Overloading".
  for (const std::string_view type : {"___XWORD", "___UXINT", "___XINT"}) {
    const size_t rest = name.size() > type.size() + 1 ? name.size() - type.size() : 0;
    if (rest >= 2 && sameIdentifier(name.substr(rest), type) && sameIdentifier(name.substr(rest - 2, 2), "TO"))
      name = name.substr(0, rest);
  }
  if (name.size() < 2 || (name.back() != '_' && name.find("__") == std::string_view::npos)) return;
  if (profile_.double_underscores) {
    if (name.substr(0, 2) != "__") diagnostics_.report(diag::UnderscoresInNameWarning, loc(begin), {name});
  } else {
    diagnostics_.report(diag::UnderscoresInName, loc(begin), {name});
  }
}

// T#1d2h  D#2026-12-31  TOD#12:30:00.5  DT#2026-12-31-12:30:00: p points after the #.
const char* Lexer::prefixed(const char* begin, const char* p, Prefix prefix) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  Tok kind = Tok::Duration;
  if (prefix == Prefix::Duration) {
    if (*p == '-' || *p == '+') ++p;
    while (kWordChar[static_cast<Byte>(*p)] || (*p == '.' && digit(p[1]))) ++p;
  } else {
    kind = prefix == Prefix::Date ? Tok::Date : prefix == Prefix::TimeOfDay ? Tok::TimeOfDay : Tok::DateTime;
    int dashes = prefix == Prefix::Date ? 2 : prefix == Prefix::DateTime ? 3 : 0;
    while (kWordChar[static_cast<Byte>(*p)] || ((*p == ':' || *p == '.') && digit(p[1])) ||
           (*p == '-' && dashes > 0 && digit(p[1]))) {
      if (*p == '-') --dashes;
      ++p;
    }
  }
  push(kind, begin, static_cast<uint32_t>(p - begin));
  return p;
}

// 12  1_000  16#FF  1.5  1.5e-3; `1..5` is 1, .., 5. Letters that follow are part of it, so that 12ab is one malformed
// number.
const char* Lexer::number(const char* begin) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const char* p = begin;
  while (digit(*p) || *p == '_') ++p;
  if (*p == '#') {
    ++p;
    while (kWordChar[static_cast<Byte>(*p)]) ++p;
  } else {
    if (*p == '.' && digit(p[1]) && last() != Tok::Dot) {
      ++p;
      while (digit(*p) || *p == '_') ++p;
    }
    if ((*p == 'e' || *p == 'E') && (digit(p[1]) || ((p[1] == '+' || p[1] == '-') && digit(p[2])))) {
      p += 2;
      while (digit(*p)) ++p;
    }
    while (kWordChar[static_cast<Byte>(*p)]) ++p;
  }
  push(Tok::Number, begin, static_cast<uint32_t>(p - begin));
  return p;
}

// CODESYS: a string may continue on the next lines. A quote is missing where another string begins on the line that
// would end this one.
bool Lexer::continuesOverLines(const char* p, char quote) const {
  if (!profile_.strings_over_lines) return false;
  uint32_t quotes = 0;
  for (; p < end_ && (quotes == 0 || (*p != '\n' && *p != '\r')); ++p) {
    if (*p == '$' && p + 1 < end_)
      ++p;
    else if (*p == quote)
      ++quotes;
  }
  return quotes % 2 == 1;
}

const char* Lexer::quoted(const char* begin) {
  const char quote = *begin;
  const char* p = begin + 1;
  while (*p != quote) {
    const bool line_ends = *p == '\n' || *p == '\r';
    if ((line_ends && !continuesOverLines(p, quote)) || p >= end_) {
      const std::string_view line(begin, static_cast<size_t>(p - begin));
      const size_t last = line.find_last_not_of(" \t;)");  // the signs at its end most likely follow the string
      diagnostics_.report(diag::UnterminatedString, loc(begin), {std::string_view(&quote, 1)})
          .length(static_cast<uint32_t>(line.size()))
          .insert(loc(begin + (last == 0 || line[last] == '$' ? line.size() : last + 1)), {&quote, 1},
                  Sureness::Proposal);
      flags_ |= kReported;
      push(quote == '\'' ? Tok::StringLiteral : Tok::WideStringLiteral, begin, static_cast<uint32_t>(p - begin));
      return p;
    }
    if (*p == '$' && p[1] != '\n' && p[1] != '\r' && p + 1 < end_) ++p;
    ++p;
  }
  ++p;
  push(quote == '\'' ? Tok::StringLiteral : Tok::WideStringLiteral, begin, static_cast<uint32_t>(p - begin));
  return p;
}

const char* Lexer::address(const char* begin) {
  const char* p = begin + 1;
  while (kWordChar[static_cast<Byte>(*p)] || *p == '*' || (*p == '.' && p[1] >= '0' && p[1] <= '9')) {
    if (*p == '*') {
      ++p;
      break;
    }
    ++p;
  }
  push(Tok::Address, begin, static_cast<uint32_t>(p - begin));
  return p;
}

// The operator or delimiter at p. Length 0: there is no such, or its neighbours decide.
Lexer::Punct Lexer::punctAt(const char* p) {
  const auto one = [](Tok kind) { return Punct{kind, 1}; };
  const auto two = [](Tok kind) { return Punct{kind, 2}; };
  switch (*p) {
    case ';': return one(Tok::Semicolon);
    case ':': return p[1] == '=' ? two(Tok::Assign) : one(Tok::Colon);
    case ',': return one(Tok::Comma);
    case '.': return p[1] == '.' ? two(Tok::DotDot) : one(Tok::Dot);
    case '(': return one(Tok::LeftParen);
    case ')': return one(Tok::RightParen);
    case '[': return one(Tok::LeftBracket);
    case ']': return one(Tok::RightBracket);
    case '^': return one(Tok::Caret);
    case '#': return one(Tok::Hash);
    case '=':
      return p[1] == '>'   ? two(Tok::Arrow)
             : p[1] == '=' ? two(Tok::EqualEqual)
             : p[1] == '<' ? two(Tok::EqualLess)
                           : one(Tok::Equal);
    case '+': return p[1] == '=' ? two(Tok::PlusAssign) : one(Tok::Plus);
    case '-': return p[1] == '=' ? two(Tok::MinusAssign) : one(Tok::Minus);
    case '*': return p[1] == '*' ? two(Tok::Power) : p[1] == '=' ? two(Tok::StarAssign) : one(Tok::Star);
    case '/': return p[1] == '=' ? two(Tok::SlashAssign) : one(Tok::Slash);
    case '<': return p[1] == '>' ? two(Tok::NotEqual) : p[1] == '=' ? two(Tok::LessEqual) : one(Tok::Less);
    case '>': return p[1] == '=' ? two(Tok::GreaterEqual) : one(Tok::Greater);
    case '&': return p[1] == '&' ? two(Tok::AmpersandTwice) : one(Tok::Ampersand);
    case '?': return p[1] == '=' ? two(Tok::TryAssign) : Punct{Tok::Question, 0};
    case '!': return p[1] == '=' ? two(Tok::BangEqual) : one(Tok::Bang);
    case '|': return p[1] == '|' ? two(Tok::BarTwice) : one(Tok::Bar);
    case '%':
      return kClasses[static_cast<Byte>(p[1])] == kLetter && p[1] != '_' ? Punct{Tok::Address, 0} : one(Tok::Percent);
    default: return {Tok::End, 0};
  }
}

const char* Lexer::punct(const char* p) {
  Punct found = punctAt(p);
  if (found.kind == Tok::Address) return address(p);
  if (found.kind == Tok::Question && behindSt(p)) found.length = 1;
  if (found.length == 0) return stray(p);
  push(found.kind, p, found.length);
  return p + found.length;
}

const char* Lexer::lineComment(const char* p) {
  if (isDoc(p)) {
    const bool after = (flags_ & kLineStart) == 0 && !out_.tokens.empty();
    if (after) {
      out_.tokens.back().flags |= kDocAfter;
      out_.docs_after.push_back({out_.tokens.back().offset, at(p)});
    } else if (doc_ == 0) {
      doc_ = at(p) + 1;
    }
  }
  const auto* newline = static_cast<const char*>(std::memchr(p, '\n', static_cast<size_t>(end_ - p)));
  return newline != nullptr ? newline : end_;
}

// `(*DBG:…*)` on a line of its own: C code for the debugger that the editor of OpenPLC adds, and that its runtime takes
// away by lines. The text may contain `*)`. Null: another comment.
const char* Lexer::debugLine(const char* begin) const {
  if ((flags_ & kLineStart) == 0 || end_ - begin < 8 || std::string_view(begin, 6) != "(*DBG:") return nullptr;
  const auto* const newline = static_cast<const char*>(std::memchr(begin, '\n', static_cast<size_t>(end_ - begin)));
  const char* p = newline != nullptr ? newline : end_;
  while (p > begin && (p[-1] == '\r' || p[-1] == ' ' || p[-1] == '\t')) --p;
  return p - begin >= 8 && p[-1] == ')' && p[-2] == '*' ? p : nullptr;
}

const char* Lexer::blockComment(const char* begin, bool slash) {
  if (const char* const end = debugLine(begin); end != nullptr) return end;
  const char open = slash ? '/' : '(', close = slash ? '/' : ')';
  const char* p = begin + 2;
  const bool nests = profile_.nested_comments && nests_;
  bool reported = false;
  uint32_t depth = 1;
  for (; p < end_; ++p) {
    if (*p == '*' && p[1] == close) {
      p += 2;
      if (--depth == 0) {
        if (const char* const nesting = nestingOf({begin, static_cast<size_t>(p - begin)})) nests_ = *nesting == 'Y';
        return p;
      }
      --p;
    } else if (*p == open && p[1] == '*') {
      // `(*)` and `/*/` close the comment in edition 2, where comments do not nest.
      if (nests) {
        ++depth;
        ++p;
      } else if (nests_ && p[2] != close) {
        if (!reported) diagnostics_.report(diag::NestedComment, loc(p), {std::string_view(p, 2)}).length(2);
        reported = true;
        ++depth;  // its end is most likely there, too
        ++p;
      }
    } else if (*p == '\n' || *p == '\r') {
      flags_ |= kLineStart;
    }
  }
  diagnostics_.report(diag::UnterminatedComment, loc(begin), {slash ? "*/" : "*)"})
      .length(2)
      .insert(loc(endOfLine(begin)), slash ? " */" : " *)", Sureness::Proposal);
  return end_;
}

// The length of `{C++}` or `{C++ file}` at `p`; 0: neither.
uint32_t Lexer::cppOpening(const char* p) const {
  if (end_ - p <= 5 || !sameIdentifier({p, 4}, "{C++")) return 0;
  if (p[4] == '}') return 5;
  const char* word = p + 4;
  while (*word == ' ' || *word == '\t') ++word;
  if (word == p + 4 || end_ - word < 5 || !sameIdentifier({word, 4}, "file")) return 0;
  word += 4;
  while (*word == ' ' || *word == '\t') ++word;
  return *word == '}' ? static_cast<uint32_t>(word + 1 - p) : 0;
}

// {C++} … {END_C++}, {C++ file} … {END_C++}
const char* Lexer::cpp(const char* begin) {
  const uint32_t opening = cppOpening(begin);
  const char* p = begin + opening;
  while (p < end_ && !(*p == '{' && end_ - p >= 9 && sameIdentifier({p, 9}, "{END_C++}"))) ++p;
  if (p == end_) {
    diagnostics_.report(diag::UnterminatedPragma, loc(begin), {"{END_C++}"}).length(opening);
    return end_;
  }
  p += 9;
  push(opening == 5 ? Tok::CppBody : Tok::CppFile, begin, static_cast<uint32_t>(p - begin));
  return p;
}

// {network}, {network CFC}, {end_network}: the delimiters of a body of networks. End: another pragma.
Tok networkKeyword(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  const size_t length = static_cast<size_t>(std::find_if(text.begin(), text.end(), blank) - text.begin());
  const std::string_view word = text.substr(0, length);
  if (sameIdentifier(word, "network")) return Tok::Network;
  return sameIdentifier(word, "end_network") ? Tok::EndNetwork : Tok::End;
}

// { … }: strings inside may contain braces.
const char* Lexer::pragma(const char* begin) {
  const std::string_view rest(begin, static_cast<size_t>(end_ - begin));
  if (const size_t end = endOfDoubleBrace(rest, 0); end != std::string_view::npos) {
    diagnostics_.report(diag::CodeInC, loc(begin)).length(2);
    return begin + end;
  }
  const char* p = begin + 1;
  while (p < end_ && *p != '}') {
    if (*p == '\'' || *p == '"') {
      const char* q = p + 1;
      while (q < end_ && *q != *p && *q != '\n') ++q;
      if (q < end_ && *q == *p) p = q;
    }
    ++p;
  }
  if (p >= end_) {
    diagnostics_.report(diag::UnterminatedPragma, loc(begin), {"}"})
        .length(1)
        .insert(loc(endOfLine(begin)), "}", Sureness::Proposal);
    p = begin;
    while (p < end_ && *p != '\n') ++p;
    return p;
  }
  if (const Tok network = networkKeyword({begin + 1, static_cast<size_t>(p - begin - 1)}); network != Tok::End) {
    push(network, begin, static_cast<uint32_t>(p + 1 - begin));
    return p + 1;
  }
  message(begin + 1, p);
  out_.pragmas.push_back({0, at(begin), at(p) + 1});
  ++pending_pragmas_;
  return p + 1;
}

// A name close to that of a known pragma is most likely a typing error and reported; other unknown pragmas are ignored.
void Lexer::checkPragma(std::string_view word, const char* rest, const char* end) {
  static const std::vector<std::string_view> kPragmas = {
      "attribute", "test",        "info",        "warning",   "error",  "text",      "define",   "undefine",
      "IF",        "ELSIF",       "ELSE",        "END_IF",    "region", "endregion", "native",   "alias",
      "required",  "optional",    "extensible",  "lazy",      "pure",   "operator",  "replaces", "std",
      "sized",     "list",        "entry",       "active",    "exit",   "fault",     "no_copy",  "bytes",
      "long_time", "test_only",   "mock",        "skip",      "setup",  "teardown",  "case",     "prefix",
      "slice",     "safe_values", "before_task", "after_task"};
  static const std::vector<std::string_view> kAttributes = {
      "qualified_only",     "strict",          "test",      "no_final_scan",    "obsolete",
      "to_string",          "call_after_init", "pack_mode", "global_init_slot", "call_after_global_init_slot",
      "initialize_on_call", "is_connected",    "reflection"};
  const std::vector<std::string_view>* known = &kPragmas;
  if (sameIdentifier(word, "attribute")) {
    while (rest < end && *rest != '\'') ++rest;
    if (rest == end) return;
    const char* close = static_cast<const char*>(std::memchr(rest + 1, '\'', static_cast<size_t>(end - rest - 1)));
    if (close == nullptr) return;
    word = {rest + 1, static_cast<size_t>(close - rest - 1)};
    known = &kAttributes;
    // Documented by CODESYS or TwinCAT, and a program may depend on what they do.
    if (sameIdentifier("parameterstringof", word))
      diagnostics_.report(diag::AttributeIgnored, loc(word.data()), {word});
  }
  for (const std::string_view name : *known)
    if (sameIdentifier(name, word) && !sameIdentifier(name, "IF") && !sameIdentifier(name, "exit")) return;
  if (holdsC({word.data(), static_cast<size_t>(end - word.data())})) {
    diagnostics_.report(diag::CodeInC, loc(word.data())).length(1);
    return;
  }
  if (sameIdentifier(word, "IF") || sameIdentifier(word, "exit")) return;
  const std::string_view near = nearest(word, *known);
  if (near.empty()) return;
  diagnostics_.report(diag::UnknownPragma, loc(word.data()), {word}).didYouMean(near);
}

// {warning disable W0108}, {warning restore C0195, unused-variable}: codes and names of warnings, and the codes of
// CODESYS. Codes of CODESYS that match no warning are ignored, as its warnings do not exist here.
void Lexer::switchWarnings(const char* begin, const char* end) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == ','; };
  const auto word = [&] {
    while (begin < end && isBlank(*begin)) ++begin;
    const char* const from = begin;
    while (begin < end && !isBlank(*begin)) ++begin;
    return std::string_view(from, static_cast<size_t>(begin - from));
  };
  const std::string_view action = word();
  const bool restores = sameIdentifier(action, "restore");
  if (!restores && !sameIdentifier(action, "disable")) {
    static const std::vector<std::string_view> kActions = {"disable", "restore"};
    diagnostics_.report(diag::UnknownPragma, loc(action.data()), {action}).didYouMean(nearest(action, kActions));
    return;
  }
  for (std::string_view name = word(); !name.empty(); name = word()) {
    const std::vector<Diag> warnings = warningsNamed(name);
    for (const Diag warning : warnings) diagnostics_.switchWarning(warning, restores, loc(action.data()), loc(end_));
    if (warnings.empty() && !isCodesysCode(name))
      diagnostics_.report(diag::UnknownWarning, loc(name.data()), {name})
          .length(static_cast<uint32_t>(name.size()))
          .didYouMean(nearestWarning(name));
  }
}

// {info 'string'}, {text 'string'}, {WARNING: "string"}, {error 'string'}
void Lexer::message(const char* begin, const char* end) {
  const auto skip = [&] {
    while (begin < end && (*begin == ' ' || *begin == '\t')) ++begin;
  };
  skip();
  const char* word_begin = begin;
  while (begin < end && kWordChar[static_cast<Byte>(*begin)]) ++begin;
  const std::string_view word(word_begin, static_cast<size_t>(begin - word_begin));
  const bool info = sameIdentifier(word, "info") || sameIdentifier(word, "text"),
             warning = sameIdentifier(word, "warning"), error = sameIdentifier(word, "error");
  if (!info && !warning && !error) return checkPragma(word, begin, end);
  skip();
  if (begin < end && *begin == ':') ++begin;
  skip();
  if (begin == end) return;
  if (*begin != '\'' && *begin != '"') {
    if (warning) switchWarnings(begin, end);
    return;
  }
  const char quote = *begin++;
  const char* string_end = end;
  while (string_end > begin && string_end[-1] != quote) --string_end;
  if (string_end > begin) --string_end;
  const std::string_view text(begin, static_cast<size_t>(string_end - begin));
  const Diag diag = info ? diag::PragmaInfo : warning ? diag::PragmaWarning : diag::PragmaError;
  diagnostics_.report(diag, loc(word_begin), {text});
}

// A run of characters that cannot begin a token: one error for all of it.
const char* Lexer::stray(const char* begin) {
  const char* p = begin;
  const auto c = static_cast<Byte>(*p);
  if (c >= 0x80 || kClasses[c] == kLetter) {
    while (p < end_ && (static_cast<Byte>(*p) >= 0x80 || kWordChar[static_cast<Byte>(*p)])) ++p;
  } else {
    ++p;
    while (p < end_ && (kClasses[static_cast<Byte>(*p)] == kStray && static_cast<Byte>(*p) < 0x20)) ++p;
  }
  std::string shown;
  if (c < 0x20 || c == 0x7f) {
    static const char* kHex = "0123456789ABCDEF";
    shown = std::string("16#") + kHex[c >> 4] + kHex[c & 15];
  } else {
    shown.assign(begin, static_cast<size_t>(p - begin < 40 ? p - begin : 40));
    if (findInvalidUtf8(shown) != std::string::npos) shown = "a byte that is not UTF-8";
  }
  if (c >= 0x80 || kClasses[c] == kLetter)
    diagnostics_.report(diag::NotAscii, loc(begin), {shown}).length(static_cast<uint32_t>(p - begin));
  else
    diagnostics_.report(c == '}' ? diag::StrayBrace : diag::StrayCharacter, loc(begin), {shown})
        .length(static_cast<uint32_t>(p - begin))
        .remove(loc(begin), loc(p), shown, Sureness::Proposal);
  flags_ |= kReported;
  push(Tok::Error, begin, static_cast<uint32_t>(p - begin));
  return p;
}

}  // namespace

bool endsPart(Tok kind) {
  static constexpr TokSet kEnds = {
      Tok::End,         Tok::EndVar,           Tok::EndStruct,    Tok::EndUnion,         Tok::EndType,
      Tok::EndFunction, Tok::EndFunctionBlock, Tok::EndProgram,   Tok::EndConfiguration, Tok::EndResource,
      Tok::EndMethod,   Tok::EndProperty,      Tok::EndGet,       Tok::EndSet,           Tok::EndAction,
      Tok::EndStep,     Tok::EndTransition,    Tok::EndInterface, Tok::EndClass,         Tok::EndNamespace};
  return kEnds.has(kind);
}

const char* spelling(Tok kind) { return kSpellings[static_cast<size_t>(kind)].text; }

void lex(TokenStream& out, Names& names, const Sources& sources, FileId file, uint32_t begin, uint32_t end,
         Dialect dialect, Diagnostics& diagnostics) {
  Lexer(out, names, sources, file, dialect, diagnostics).run(begin, end);
}

bool isElementaryType(std::string_view word) {
  return isTypeWord(findKeyword(word.data(), static_cast<uint32_t>(word.size())));
}

bool isReservedWord(std::string_view word) {
  if (word.empty()) return false;
  const Tok kind = findKeyword(word.data(), static_cast<uint32_t>(word.size()));
  return isReserved(kind) && !mayBeName(kind);
}

}  // namespace rung::text

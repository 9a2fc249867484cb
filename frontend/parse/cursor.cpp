// SPDX-License-Identifier: Apache-2.0
// Tokens and error reporting of the parser.
#include "frontend/parse/cursor.h"

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/parse/syntax_fixes.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/children.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::text {

Cursor::Cursor(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect, Diagnostics& diagnostics)
    : tree_(tree),
      names_(names),
      sources_(sources),
      file_(file),
      profile_(profileOf(dialect)),
      diagnostics_(diagnostics),
      base_(sources.begin(file).offset),
      source_(sources.sourceText(file)) {}

void Cursor::read(uint32_t begin, uint32_t end, std::vector<Comment>* comments) {
  stream_.comments = comments;
  lex(stream_, names_, sources_, file_, begin, end, profile_.dialect, diagnostics_);
  resolveObjectKeywords(stream_);
  balanceBlocks(stream_, names_, sources_, file_, profile_.dialect, diagnostics_);
  tokens_ = std::move(stream_.tokens);
  t_ = tokens_.data();
}

// ---- what recovery skips

void Cursor::noteSkipped(const Token* first) {
  if (t_ <= first) return;
  Range range{loc(first), endWithoutSemicolon(loc(first))};
  if (!(range.begin < range.end)) return;
  holdSkipped(range.begin);  // it is a part of this
  if (!skipped_.empty() && range.begin <= skipped_.back().end) {
    range.begin = skipped_.back().begin;
    skipped_.pop_back();
  }
  skipped_.push_back(range);
}

// The end of the last token that was read, without the `;` that ends a statement or declaration.
Loc Cursor::endWithoutSemicolon(Loc begin) const {
  const Loc end = endOfPrevious();
  if (!(begin < end)) return begin;
  std::string_view text = source_.substr(begin.offset - base_, end.offset - begin.offset);
  if (text.ends_with(';')) text.remove_suffix(1);
  while (!text.empty() && isBlankCharacter(text.back())) text.remove_suffix(1);
  return {begin.offset + static_cast<uint32_t>(text.size())};
}

void Cursor::holdSkipped(ExprId expr, const Token* first) {
  if (skipped_.empty() || skipped_.back().begin != loc(first)) return;
  const Loc end = skipped_.back().end;
  std::vector<ExprId> path;  // to the last leaf
  for (ExprId at = expr; at;) {
    if (tree_.expr(at).in_parens != 0) return;  // it ends before them
    path.push_back(at);
    at = {};
    forEachOperand(tree_, path.back(), [&](ExprId operand) { at = operand; });
  }
  const ExprHeader& error = tree_.expr(path.back());
  if (error.kind != ExprKind::Error || (!error.end && error.loc != loc(first))) return;
  for (const ExprId id : path) tree_.expr(id).end = end;
  holdSkipped(loc(first));
}

void Cursor::holdSkipped(TypeExprId error, Loc begin) {
  const Loc end = endWithoutSemicolon(begin);
  if (!(begin < end)) return;
  tree_.typeExpr(error).loc = begin;
  tree_.typeExpr(error).end = end;
  holdSkipped(begin);
}

// ---- tokens

uint32_t Cursor::lengthOfRareName(const Token* t) const {
  return (t->flags & kSynthetic) != 0 ? 0 : static_cast<uint32_t>(names_.string({t->value}).size());
}

Loc Cursor::endOfRead() const {
  const Token* t = t_;
  while (t > tokens_.data())
    if (((--t)->flags & kSynthetic) == 0) return endOf(t);
  return here();
}

std::string Cursor::describe(const Token* t) const {
  while ((t->flags & kSynthetic) != 0 && t > tokens_.data()) --t;
  if (t->kind == Tok::End && t->offset < source_.size())  // of a pragma
    return std::string("`").append(source_.substr(t->offset, 1)).append("`");
  if (t->kind == Tok::End) return spelling(Tok::End);
  std::string_view text = textOf(t);
  std::string shown = "`";
  // A long literal is truncated, between UTF-8 characters.
  if (text.size() > 40) {
    size_t n = 37;
    while (n > 0 && (static_cast<unsigned char>(text[n]) & 0xC0) == 0x80) --n;
    shown.append(text.substr(0, n));
    shown += "...";
  } else {
    shown.append(text);
  }
  shown += '`';
  return shown;
}

bool Cursor::isOperand(Tok kind) const {
  return (kind >= Tok::Number && kind <= Tok::Ident) || isName(kind) || isTypeWord(kind) || kind == Tok::True ||
         kind == Tok::False || kind == Tok::Null || kind == Tok::LeftParen || kind == Tok::Not;
}

// ---- errors

// One syntax error per line: the next error on the line most likely follows from the first.
bool Cursor::mayReport(const Token* t) {
  if (panic_) return false;
  const auto sameLine = [](const Token* a, const Token* b) {
    if (a > b) std::swap(a, b);
    while (a < b)
      if (((++a)->flags & kLineStart) != 0) return false;
    return true;
  };
  if (last_error_ != nullptr && sameLine(last_error_, t)) {
    if (t > last_error_) last_error_ = t;
    return false;
  }
  // Reported by the lexer or the block repair.
  for (const Token* p = t; t - p < 200; --p) {
    if ((p->flags & kReported) != 0) {
      last_error_ = t;
      return false;
    }
    if ((p->flags & kLineStart) != 0 || p == tokens_.data()) break;
  }
  for (const Token* p = t + 1; p - t < 200 && (p->flags & kLineStart) == 0 && p->kind != Tok::End; ++p) {
    if ((p->flags & kReported) != 0) {
      last_error_ = t;
      return false;
    }
  }
  return true;
}

// The last token before t that is in the source.
const Token* Cursor::readBefore(const Token* t) const {
  do {
    if (t > tokens_.data()) --t;
  } while ((t->flags & kSynthetic) != 0 && t > tokens_.data());
  return t;
}

Report Cursor::insertion(Report report, const Token* before, std::string_view word, Sureness sureness) const {
  if (!report) return report;
  const Token* next = before + 1;
  while ((next->flags & kSynthetic) != 0 && next->kind != Tok::End) ++next;
  const bool ends_line = (next->flags & kLineStart) != 0 || next->kind == Tok::End;
  const bool needs_value = word == ":=" || word == ".." || word == "(" || (word == ":" && declares_);
  const bool ends_list = next->kind == Tok::Semicolon || next->kind == Tok::RightParen || next->kind == Tok::End;
  if (word == "label:" || word == "UNTIL" || (ends_line && needs_value) || (ends_list && word == ",")) return report;
  static constexpr TokSet kContinue = {Tok::Then, Tok::Do, Tok::Of, Tok::To, Tok::By};
  const bool ends_statement =
      (word == ")" || word == "]") && ends_line && !in_il_ && begins(next) == Begins::New && !kContinue.has(next->kind);
  const Token* const first = before > tokens_.data() ? before - 1 : before;
  const bool may_bind =
      word == "," && !declares_ && isName(before->kind) && (first->kind == Tok::LeftParen || first->kind == Tok::Comma);
  if (may_bind) {  // `f(pin 1)`
    sureness = Sureness::Proposal;
    report.insert(endOf(before), insertedAfter(source_, endOf(before).offset - base_, ":=").text, sureness);
  }
  const Insertion added = insertedAfter(source_, endOf(before).offset - base_,
                                        ends_statement ? std::string(word) + ";" : std::string(word));
  return report.insert(endOf(before), added.text, sureness);
}

Report Cursor::removal(Report report, const Token* t, Sureness sureness) const {
  if (!report) return report;
  const auto begin = static_cast<uint32_t>(beginOfRemoval(source_, t->offset));
  return report.remove({base_ + begin}, endOf(t), textOf(t), sureness);
}

Report Cursor::replaced(Report report, const Token* first, const Token* last, std::string_view text,
                        Sureness sureness) const {
  if (!report) return report;
  const uint32_t end = endOf(last).offset - base_;
  return report.replace(loc(first), endOf(last), inPlaceOf(source_, first->offset, end, text), sureness);
}

Report Cursor::withFix(Report report, Diag diag, const Token* t, std::initializer_list<std::string_view> args,
                       Sureness sureness) const {
  if (!report) return report;
  const auto arg = [&](size_t index) { return args.begin()[index]; };
  if (diag == diag::MissingToken) return insertion(report, readBefore(t), arg(0), sureness);
  if (diag == diag::WrongKeyword || diag == diag::MisspelledKeyword)
    return arg(1).find('`') == std::string_view::npos ? replaced(report, t, t, arg(1), sureness) : report;
  if (diag == diag::AssignWithEqual) return replaced(report, t, arg(0) == ": =" ? t + 1 : t, ":=", sureness);
  if (diag == diag::CompareWithAssign) return replaced(report, t, t, "=", sureness);
  if (diag == diag::ForeignOperator && !arg(1).ends_with("(...)"))  // SHL(...) needs its operands
    return replaced(report, t, arg(0) == ": =" ? t + 1 : t, arg(1), sureness);
  if (diag == diag::MissingOperator) return insertion(report, readBefore(t), ";", Sureness::Proposal);
  if (diag == diag::TrailingComma) return removal(report, t, sureness);
  if (diag == diag::StrayEnd || diag == diag::StrayParen || diag == diag::StrayToken)
    return t->kind == Tok::End ? report : removal(report, t, Sureness::Proposal);
  return report;
}

Report Cursor::fail(Diag diag, const Token* t, std::initializer_list<std::string_view> args) {
  bool unfinished = false;
  const Report report = reportMissing(diag, t, args, Sureness::Proposal, unfinished);
  panic_ = true;
  return report;
}

Report Cursor::slip(Diag diag, const Token* t, std::initializer_list<std::string_view> args) {
  bool unfinished = false;
  const Report report = reportMissing(diag, t, args, Sureness::Sure, unfinished);
  panic_ = panic_ || unfinished;
  return report;
}

Report Cursor::missing(Diag diag, std::initializer_list<std::string_view> args) {
  const Token* const before = readBefore(t_);
  if (!mayReport(before)) return Report(nullptr);
  last_error_ = before;
  const Report report = diagnostics_.report(diag, endOf(before), args).length(1);
  if (diag == diag::MissingSemicolon) return insertion(report, before, ";", Sureness::Sure);
  return diag == diag::MissingToken ? insertion(report, before, args.begin()[0], Sureness::Sure) : report;
}

bool Cursor::expect(Tok wanted) {
  if (accept(wanted)) return true;
  if (panic_) return false;
  const Tok candidates[] = {wanted};
  if (at(Tok::Ident) && isReserved(wanted) && nearKeyword(t_, candidates) == wanted) {
    correctSpelling(wanted);
    advance();
    return false;
  }
  if (atLineStart() || at(Tok::End)) {
    missing(diag::MissingToken, {spelling(wanted), describe(t_)});
    if (begins(t_) == Begins::New) {
      panic_ = true;
      unfinished_ = t_;
    }
  } else if (isOperand(kind()) || at(Tok::Minus) || at(Tok::Array) || at(Tok::Struct) || at(Tok::Colon) ||
             at(Tok::Semicolon)) {
    slip(diag::MissingToken, t_, {spelling(wanted), describe(t_)});
  } else {
    fail(diag::WrongKeyword, t_, {textOf(t_), spelling(wanted)});
  }
  return false;
}

Tok Cursor::nearKeyword(const Token* t, std::span<const Tok> candidates) const {
  return nearestKeyword(textOf(t), candidates);
}

bool Cursor::correctSpelling(Tok wanted) {
  slip(diag::MisspelledKeyword, t_, {textOf(t_), spelling(wanted)});
  const uint32_t length = lengthOf(t_);
  t_->kind = wanted;
  if (!isName(wanted) && !isTypeWord(wanted)) t_->value = length;
  t_->flags |= kReported;
  return true;
}

void Cursor::tooDeep(const char* what, uint32_t limit) {
  const std::string number = std::to_string(limit);
  fail(diag::TooDeep, t_, {what, number});
}

void Cursor::missingEnd(std::string_view end, const Token* open, std::string_view word) {
  const std::string line = std::to_string(sources_.location(loc(open)).line);
  const Token* const before = readBefore(t_);
  Report report = missing(diag::MissingEnd, {end, word, line});
  if (!report || beginsBlock(open->kind)) return;  // the blocks balance: the end of this one is further on
  const Insertion added = endOfBlock(source_, open->offset, endOf(before).offset - base_, t_->offset, end);
  const Loc at{base_ + static_cast<uint32_t>(added.at)};
  report.insert(at, added.text, Sureness::Sure);
}

}  // namespace rung::text

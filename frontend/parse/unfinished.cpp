// SPDX-License-Identifier: Apache-2.0
// Lines that are not finished, as while typing. In: a token that is the first of its line, where the line above still
// needs something. Out: whether it begins something new, so that what is missing is missing at the end of the line
// above. Called by the parsers where they read an operand, a name or a type, and by the reports of missing tokens.
//
// A line begins something new with a keyword, `name :=`, `name.x :=`, `name :`, `name ,` of a declaration, `name AT`,
// a label, an instruction or an element of a network. `name(…)` does only where it cannot be an operand: when it calls
// a variable, or its `;` comes before the brackets around it are closed. In an open list `name := value` followed by
// `,` or `)` is an element of the list. A multi-line expression that is complete is never taken apart.
#include <algorithm>

#include "frontend/parse/cursor.h"
#include "frontend/parse/diagnostics.h"

namespace rung::text {
namespace {

constexpr uint32_t kMaxScan = 200;  // tokens that decide; longer lines are taken to continue

bool isOperator(Tok k) { return (k >= Tok::Plus && k <= Tok::EqualLess) || (k >= Tok::And && k <= Tok::Mod); }
bool isAssignSign(Tok k) { return k == Tok::Assign || (k >= Tok::PlusAssign && k <= Tok::TryAssign); }
bool opensBracket(Tok k) { return k == Tok::LeftParen || k == Tok::LeftBracket; }
bool closesBracket(Tok k) { return k == Tok::RightParen || k == Tok::RightBracket; }

// Reserved words that neither are nor join operands, and what else never continues an expression or a type.
bool isBoundary(Tok k) {
  static constexpr TokSet kContinue = {Tok::True,   Tok::False, Tok::Null, Tok::Array,
                                       Tok::Struct, Tok::Union, Tok::RefTo};
  if (k == Tok::End || k == Tok::Network || k == Tok::EndNetwork || k == Tok::CppBody || k == Tok::CppFile ||
      isObjectWord(k))
    return true;
  return isReserved(k) && !isTypeWord(k) && !isOperator(k) && !kContinue.has(k);
}

// Tells whether a line that ends with this token needs another one. TASK, RESOURCE, ON and WITH may be names.
bool needsMore(const Token* t, bool declares) {
  const Tok k = t->kind;
  if (k == Tok::Task || k == Tok::Resource) return (t->flags & kLineStart) != 0;
  if (k == Tok::On || k == Tok::With)
    return (t->flags & kLineStart) == 0 && (t[-1].flags & kLineStart) == 0 &&
           t[-2].kind == (k == Tok::On ? Tok::Resource : Tok::Program);
  static constexpr TokSet kOpen = {Tok::Dot,   Tok::DotDot, Tok::Comma, Tok::LeftParen, Tok::LeftBracket, Tok::Hash,
                                   Tok::Arrow, Tok::If,     Tok::Elsif, Tok::While,     Tok::Until,       Tok::Case,
                                   Tok::For,   Tok::To,     Tok::By,    Tok::RefTo,     Tok::Array,       Tok::Program};
  if (kOpen.has(k) || isAssignSign(k) || isOperator(k)) return true;
  return declares && (k == Tok::Colon || k == Tok::Of || k == Tok::Extends || k == Tok::Implements);
}

// `a.b[i]^`, from a name to the token after it.
const Token* pastPath(const Token* t) {
  ++t;
  for (uint32_t steps = 0; steps < kMaxScan; ++steps) {
    if (t->kind == Tok::Caret) {
      ++t;
    } else if (t->kind == Tok::Dot && (isName(t[1].kind) || t[1].kind == Tok::Number)) {
      t += 2;
    } else if (t->kind == Tok::LeftBracket) {
      uint32_t depth = 0;
      const Token* end = t;
      for (; end->kind != Tok::End && end->kind != Tok::Semicolon && end - t < kMaxScan; ++end) {
        if (opensBracket(end->kind)) ++depth;
        if (closesBracket(end->kind) && --depth == 0) break;
      }
      if (!closesBracket(end->kind)) return t;
      t = end + 1;
    } else {
      return t;
    }
  }
  return t;
}

bool isLetterAssign(const Token* t) {  // S= R= REF=
  return (t->kind == Tok::SetModifier || t->kind == Tok::ResetModifier || t->kind == Tok::RefModifier) &&
         t[1].kind == Tok::Equal;
}

// The token that ends the construct which begins at another, outside of its own brackets.
enum class Ends : uint8_t { InList, WithColon, AsStatement, InHeader, Unknown };

Ends endOfConstruct(const Token* first, bool declares) {
  uint32_t depth = 0;
  bool assigned = false;
  bool ended = false;  // its lines are read; only the end of a list around it is of interest
  for (const Token* t = first; t - first < kMaxScan; ++t) {
    const Tok k = t->kind;
    if (k == Tok::Semicolon) return Ends::AsStatement;
    if (k == Tok::Then || k == Tok::Do || k == Tok::To || k == Tok::By || (k == Tok::Of && !declares))
      return Ends::InHeader;
    if (t != first && (t->flags & kLineStart) != 0 && !needsMore(t - 1, declares) && !isOperator(k) &&
        !closesBracket(k) && k != Tok::Comma && !opensBracket(k) && k != Tok::Dot)
      ended = true;
    if (t != first && isBoundary(k)) return Ends::AsStatement;
    if (opensBracket(k)) ++depth;
    if (closesBracket(k) && depth-- == 0) return Ends::InList;
    if (depth != 0 || ended) continue;
    if (isAssignSign(k) || k == Tok::Arrow) assigned = true;
    if (assigned && k == Tok::Comma) return Ends::InList;
    if (!assigned && k == Tok::Colon && t[1].kind != Tok::Equal) return Ends::WithColon;
  }
  return Ends::Unknown;
}

}  // namespace

bool Cursor::isVariable(const Token* t) const {
  const NameId key = names_.key(nameOf(t));
  for (const NameId variable : variables_)
    if (names_.key(variable) == key) return true;
  return false;
}

// Tells whether a bracket of the statement or declaration is open before t; `otherwise` where its beginning is too far
// away, as in a long list.
bool Cursor::inBrackets(const Token* t, bool otherwise) const {
  uint32_t closed = 0;
  for (const Token* p = t; p > tokens_.data() && t - p < kMaxScan;) {
    --p;
    if (closesBracket(p->kind)) ++closed;
    if (opensBracket(p->kind) && closed-- == 0) return true;
    if (p->kind == Tok::Semicolon || (isBoundary(p->kind) && p->kind != Tok::Of)) return false;
    if (t - p == kMaxScan) return otherwise;
  }
  return false;
}

Cursor::Begins Cursor::begins(const Token* t) const {
  if ((t->flags & kLineStart) == 0 || t == tokens_.data() || t == chain_target_) return Begins::Nothing;
  if (isBoundary(t->kind)) return Begins::New;
  if (in_il_) return isName(t->kind) && beginsIl(t->kind, textOf(t), t[1]) ? Begins::New : Begins::Nothing;
  if (!isName(t->kind) && (declares_ || isOperator(t->kind))) return Begins::Nothing;
  const Ends ends = endOfConstruct(t, declares_);
  if (ends == Ends::WithColon) {
    // The labels of a CASE may take several lines.
    const bool among_labels =
        !declares_ && (t[-1].kind == Tok::Comma || t[-1].kind == Tok::DotDot) && !inBrackets(t, true);
    return among_labels ? Begins::Nothing : Begins::New;
  }
  if (!isName(t->kind) || ends == Ends::InHeader || ends == Ends::Unknown) return Begins::Nothing;
  const Token* const next = pastPath(t);
  const bool assigns = isAssignSign(next->kind) || isLetterAssign(next);
  if (declares_ && t[1].kind == Tok::Comma && !inBrackets(t, true)) return Begins::New;
  if (ends == Ends::InList || (declares_ && assigns && inBrackets(t, true))) {
    const Tok before = t[-1].kind;
    const bool separated = before == Tok::Comma || opensBracket(before) || before == Tok::Dot;
    const bool binds = next->kind == Tok::Assign || next->kind == Tok::Arrow;
    return next == t + 1 && binds && !separated ? Begins::Element : Begins::Nothing;
  }
  // `motor.` above an indented `IN := TRUE`, not a variable, is one path over two lines.
  if (assigns && t[-1].kind == Tok::Dot)
    return !isVariable(t) && columnOf(t) > columnOf(lineOf(t - 1)) ? Begins::Nothing : Begins::New;
  if (assigns) return declares_ ? Begins::Nothing : Begins::New;  // a type over two lines, `T := value`
  if (t[-1].kind == Tok::Dot && next->kind == Tok::LeftParen && isVariable(t) && columnOf(t) <= columnOf(lineOf(t - 1)))
    return Begins::New;
  if ((isName(t[1].kind) || t[1].kind == Tok::Number) && (t[1].flags & kLineStart) == 0) return Begins::New;
  if (next->kind != Tok::LeftParen) return Begins::Nothing;
  return (next == t + 1 && t[-1].kind != Tok::Dot && isVariable(t)) || inBrackets(t, false) ? Begins::New
                                                                                            : Begins::Nothing;
}

const Token* Cursor::lineOf(const Token* t) const {
  while (t > tokens_.data() && (t->flags & kLineStart) == 0) --t;
  return t;
}

uint32_t Cursor::columnOf(const Token* t) const {
  uint32_t column = 0;
  while (column < t->offset && source_[t->offset - column - 1] != '\n') ++column;
  return column;
}

bool Cursor::lineEnds() {
  if (!atLineStart() || t_ == tokens_.data() || !needsMore(t_ - 1, declares_)) return false;
  if (atUnfinished()) return panic_;  // once recovered, this token begins what it begins
  return begins(t_) != Begins::Nothing;
}

void Cursor::acceptChainOverLines() {
  if (!profile_.chained_assignments || !lineEnds() || !isName(kind()) || pastPath(t_)->kind != Tok::Assign) return;
  diagnostics_.report(diag::ChainOverLines, endOfPrevious(), {textOf(t_)}).length(1);
  chain_target_ = t_;
}

// Reports what is missing at t, or at the end of the line above when t begins something new there.
Report Cursor::reportMissing(Diag diag, const Token* t, std::initializer_list<std::string_view> args, Sureness sureness,
                             bool& unfinished) {
  struct Row {
    Diag here, after;
  };
  static constexpr Row kRows[] = {
      {diag::MissingValue, diag::MissingValueAfter},   {diag::MissingName, diag::MissingNameAfter},
      {diag::MissingType, diag::MissingTypeAfter},     {diag::ElementNumber, diag::ElementNumberAfter},
      {diag::NoPartOfElement, diag::MissingSemicolon}, {diag::MissingToken, diag::MissingToken},
      {diag::WrongKeyword, diag::MissingToken}};
  const Token* before = t;
  unfinished = false;
  if (diag == diag::MissingOperator && t > tokens_.data() && t[-1].kind == Tok::Caret && !atLineStart()) {  // a ^ b
    if (!mayReport(t)) return Report(nullptr);
    last_error_ = t;
    const Report report = diagnostics_.report(diag::ForeignOperator, loc(t - 1), {"^", "XOR"}).length(1);
    return replaced(report, t - 1, t - 1, "XOR", Sureness::Sure);
  }
  for (const Row& row : kRows) {
    if (row.here != diag || t == tokens_.data() || t[-1].kind == Tok::Semicolon) continue;
    const Begins begun = begins(t);
    if (begun == Begins::Nothing) break;
    unfinished = begun == Begins::New;
    do --before;
    while ((before->flags & kSynthetic) != 0 && before > tokens_.data());
    if (unfinished && t == t_) unfinished_ = t;
    if (!mayReport(before)) return Report(nullptr);
    last_error_ = before;
    const std::string shown = diag == diag::WrongKeyword ? describe(t) : describe(before);
    if (diag == diag::WrongKeyword || diag == diag::MissingToken) {
      const std::string_view word = args.begin()[diag == diag::WrongKeyword ? 1 : 0];
      const std::string_view next = diag == diag::WrongKeyword ? shown : args.begin()[1];
      return insertion(diagnostics_.report(row.after, endOf(before), {word, next}).length(1), before, word, sureness);
    }
    const Report report = diagnostics_.report(row.after, endOf(before), {shown}).length(1);
    return row.after == diag::MissingSemicolon ? insertion(report, before, ";", sureness) : report;
  }
  if (!mayReport(t)) return Report(nullptr);
  last_error_ = t;
  const Report report = diagnostics_.report(diag, loc(t), args).length(t->kind == Tok::End ? 1 : lengthOf(t));
  return withFix(report, diag, t, args, sureness);
}

}  // namespace rung::text

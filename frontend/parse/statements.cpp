// SPDX-License-Identifier: Apache-2.0
// Statements, and resynchronization after errors.
#include "frontend/parse/statements.h"

#include <algorithm>
#include <utility>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::text {

bool isEndWord(Tok k) { return endsBlock(k) || endsPart(k); }

bool isPouWord(Tok k) {
  static constexpr TokSet kPous = {Tok::Function, Tok::FunctionBlock, Tok::Program, Tok::Type, Tok::Configuration};
  return kPous.has(k) || isObjectWord(k);
}

bool isStatementWord(Tok k) {
  static constexpr TokSet kWords = {Tok::Exit, Tok::Continue, Tok::Return, Tok::Jmp};
  return beginsBlock(k) || kWords.has(k);
}

bool isAssign(Tok k) { return k == Tok::Assign || (k >= Tok::PlusAssign && k <= Tok::TryAssign); }

// ---- where a body ends

bool StatementParser::atBlockEnd() {
  const Tok k = kind();
  return isEndWord(k) || isPouWord(k) || k == Tok::EndNetwork ||
         (k == Tok::VarGlobal && stmt_depth_ == 0 && !pouCloses()) || (in_property_ > 0 && atAccessor());
}

// False: a POU without END_…, which codesys allows, so that a VAR_GLOBAL after it begins a list of globals.
bool StatementParser::pouCloses() {
  if (!profile_.optional_ends) return true;
  if (pou_closes_ == Known::NotYet) {
    const Token* t = t_;
    while (t->kind != pou_end_ && t->kind != Tok::End && t->kind != Tok::Function && t->kind != Tok::FunctionBlock &&
           t->kind != Tok::Program && t->kind != Tok::Type && t->kind != Tok::Configuration && !isObjectWord(t->kind))
      ++t;
    pou_closes_ = t->kind == pou_end_ && pou_end_ != Tok::End ? Known::Yes : Known::No;
  }
  return pou_closes_ == Known::Yes;
}

bool StatementParser::atTopLevelWord() const {
  const Tok k = kind();
  return k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Program || k == Tok::Type ||
         k == Tok::Configuration || k == Tok::VarGlobal || isObjectWord(k) || k == Tok::Using || k == Tok::EndNamespace;
}

bool StatementParser::atAccessor() const {
  if (!at(Tok::Get) && !at(Tok::Set)) return false;
  const Tok next = peek();
  return (t_[1].flags & kLineStart) != 0 || next == Tok::Semicolon || next < Tok::Semicolon || next > Tok::EqualLess;
}

// After one error for a body in two languages: the rest of it.
void StatementParser::skipBody() {
  const Skipping skipping(*this);
  while (!at(Tok::End) && kind() != pou_end_ && !atTopLevelWord()) advance();
}

// ---- statements

bool StatementParser::startsStatement(const Token* t) const {
  if (isStatementWord(t->kind)) return true;
  if (!isName(t->kind)) return false;
  const Tok next = t[1].kind;
  if (isAssign(next)) return true;
  if ((t->flags & kLineStart) == 0) return false;
  if (next != Tok::LeftParen && next != Tok::Dot && next != Tok::LeftBracket && next != Tok::Caret &&
      next != Tok::Semicolon && next != Tok::Colon && next != Tok::Equal)
    return false;
  // The line may continue an expression of the line above.
  const Tok before = t == tokens_.data() ? Tok::Semicolon : t[-1].kind;
  return !(before >= Tok::Plus && before <= Tok::EqualLess) && !(before >= Tok::And && before <= Tok::Mod) &&
         before != Tok::Comma && before != Tok::LeftParen && before != Tok::Assign && before != Tok::LeftBracket;
}

// statements = {statement}
Slice<StmtId> StatementParser::parseStatements(uint8_t stops) {
  const size_t first = stmts_.size();
  while (!atListEnd(stops)) {
    const Token* before = t_;
    const size_t pushed = stmts_.size();
    parseStatement();
    for (size_t k = pushed; k < stmts_.size(); ++k) endOne(stmts_[k]);
    if (t_ == before && t_->kind == before->kind && (t_->flags & kReported) == 0) skip();  // guarantees progress
  }
  return listFrom(stmts_, first);
}

// A statement ends with the last token that was read.
void StatementParser::endOne(StmtId id) {
  StmtHeader& h = tree_.stmt(id);
  h.end = endOfPrevious();
  if (h.kind == StmtKind::Error) holdSkipped(h.loc);
}

bool StatementParser::atListEnd(uint8_t stops) {
  if (at(Tok::Ident)) return (stops & kStopLabel) != 0 && atCaseLabel();
  if (at(Tok::Else)) return (stops & kStopElse) != 0;
  if (at(Tok::Elsif) || (at(Tok::Elseif) && peek() != Tok::Assign)) return (stops & kStopElsif) != 0;
  if (at(Tok::Until)) return (stops & kStopUntil) != 0;
  if (at(Tok::Catch) || at(Tok::Finally)) return (stops & kStopTry) != 0;
  if (at(Tok::Elseif)) return false;
  return atBlockEnd() || ((stops & kStopLabel) != 0 && atCaseLabel());
}

// statement = keyword statement | assignment | call | label | section (reported)
void StatementParser::parseStatement() {
  statement_start_ = t_;
  const Loc start = here();
  if (parseKeywordStatement(start)) return;
  if (at(Tok::Address)) return parseExprStatement();
  if ((at(Tok::And) || at(Tok::Or) || at(Tok::Xor) || at(Tok::Mod)) && peek() == Tok::LeftParen)
    return parseExprStatement();
  if (skipForeign()) return;
  if (at(Tok::Dot) && profile_.global_operator && isName(peek()) && t_[1].offset == t_->offset + 1)
    return parseExprStatement();
  if (isName(kind()) || (isTypeWord(kind()) && peek() == Tok::LeftParen)) return parseExprStatement();
  if (atSection()) {
    if (!declared_in_body_) slip(diag::DeclarationInBody, t_);
    declared_in_body_ = true;
    const Skipping skipping(*this);
    parseSection();
    return;
  }
  parseStray(start);
}

// A statement that its first token decides. False: it begins otherwise.
bool StatementParser::parseKeywordStatement(Loc start) {
  if (at(Tok::Ident)) return false;
  const Token* first = t_;
  static constexpr TokMap<void (StatementParser::*)()> kBlocks = {
      {Tok::If, &StatementParser::parseIf},         {Tok::Case, &StatementParser::parseCase},
      {Tok::For, &StatementParser::parseFor},       {Tok::While, &StatementParser::parseWhile},
      {Tok::Repeat, &StatementParser::parseRepeat}, {Tok::Try, &StatementParser::parseTry}};
  if (const auto block = kBlocks[kind()]; block != nullptr) {
    (this->*block)();
    return true;
  }
  if (accept(Tok::Semicolon)) {
    stmts_.push_back(build_.empty(start));
    return true;
  }
  if (accept(Tok::Exit)) {
    stmts_.push_back(build_.exit(start));
  } else if (accept(Tok::Continue)) {
    stmts_.push_back(build_.loopContinue(start));
  } else if (accept(Tok::Return)) {
    parseReturn(start);
  } else if (accept(Tok::Jmp)) {
    Ident label{};
    if (isName(kind())) {
      label = ident(t_);
      advance();
    } else {
      fail(diag::MissingName, atLineStart() ? first : t_, {describe(t_)});
    }
    stmts_.push_back(build_.jump(label, start));
  } else {
    return false;
  }
  endStatement();
  return true;
}

// After RETURN: ["(" condition ")"]. CODESYS, "ST Statement: RETURN": it leaves when the condition is TRUE.
void StatementParser::parseReturn(Loc start) {
  const StmtId leave = build_.returnStatement(start);
  if (!at(Tok::LeftParen) || atLineStart()) {
    stmts_.push_back(leave);
    return;
  }
  if (!profile_.return_conditions) slip(diag::ReturnCondition, t_);
  advance();
  const ExprId condition = parseCompared(parseExpr());
  closeParen(Tok::RightParen, false);
  tree_.stmt(leave).end = endOfPrevious();
  stmts_.push_back(build_.ifStatement(condition, {&leave, 1}, start, kConditionalOp));
}

// Reports a token that cannot begin a statement.
void StatementParser::parseStray(Loc start) {
  if (at(Tok::Error)) {
    last_error_ = t_;
    panic_ = true;
  } else if (at(Tok::Else) || at(Tok::Elsif) || at(Tok::Until) || at(Tok::Then) || at(Tok::Do) || at(Tok::Of)) {
    const Tok word = kind();
    slip(diag::StrayEnd, t_, {textOf(t_)});
    const Skipping skipping(*this);
    advance();
    // A lone ELSIF keeps its branch; its condition is parsed and dropped.
    if (word == Tok::Elsif) parseHeader(Tok::Then);
    return;
  } else {
    fail(diag::NotAStatement, t_, {describe(t_)});
  }
  stmts_.push_back(build_.errorStatement(start));
  advance();
  syncStatement();
}

// assignment = lvalue (":=" | "S=" | "R=" | "REF=" | "+=" | "-=" | "*=" | "/=") expr ";"
// call       = expr "(" arguments ")" ";"
// label      = name ":"
void StatementParser::parseExprStatement() {
  Token* const first = t_;
  if (parseLabelOrDeclaration()) return;
  const ExprId target = parsePrimary();
  const Token* op = t_;
  AssignOp assign = AssignOp::Assign;
  // a++
  if (!panic_ && (at(Tok::Plus) || at(Tok::Minus)) && peek() == kind() && t_[1].offset == t_->offset + 1) {
    const std::string_view written = source_.substr(t_->offset, 2);
    const std::string shown(source_.substr(first->offset, (t_ - 1)->offset + lengthOf(t_ - 1) - first->offset));
    Report report = slip(diag::IncrementOfC, t_,
                         {written, shown.size() > 60 ? textOf(first) : std::string_view(shown), written.substr(1)})
                        .length(2);
    replaced(report, first, t_ + 1, shown + " := " + shown + " " + written[0] + " 1", Sureness::Sure);
    advance();
    advance();
    stmts_.push_back(build_.errorStatement(loc(first)));
    return endStatement();
  }
  if (!panic_ && acceptAssign(assign)) return finishAssign(first, target, assign, op);
  if (panic_) {
    stmts_.push_back(build_.errorStatement(loc(first)));
    return endStatement();
  }
  if (tree_.kind(target) == ExprKind::Call) {
    if (!at(Tok::Semicolon) && misspelledStart(first)) return;
    stmts_.push_back(build_.callStatement(target));
    return endStatement();
  }
  if (misspelledStart(first)) return;
  const ExprKind written = tree_.kind(target);
  if (profile_.bare_names_as_statements && at(Tok::Semicolon) &&
      (written == ExprKind::Name || written == ExprKind::Member || written == ExprKind::Index ||
       written == ExprKind::Deref)) {  // an action is called by its bare name
    const Loc start = tree_.loc(target);
    const ExprId call = ended(build_.call(target, Slice<Argument>{}, start, endOf(t_ - 1), true));
    stmts_.push_back(build_.callStatement(call));
    return endStatement();
  }
  reportNoEffect(first);
}

// name ":", and a declaration among the statements, which is reported: `x : INT;`
bool StatementParser::parseLabelOrDeclaration() {
  if (isName(kind()) && peek() == Tok::Colon) {
    const Tok third = peek(2);
    if (third == Tok::Equal) {
      // `a : = 5`
    } else if (isTypeWord(third) || third == Tok::Array || third == Tok::Struct ||
               (isName(third) && peek(3) == Tok::Semicolon && (t_[2].flags & kLineStart) == 0)) {
      if (!declared_in_body_) fail(diag::DeclarationInBody, t_);
      declared_in_body_ = true;
      stmts_.push_back(build_.errorStatement(here()));
      advance();
      syncStatement();
      return true;
    } else {
      const Ident label = ident(t_);
      advance();
      advance();
      stmts_.push_back(build_.label(label));
      return true;
    }
  }
  return false;
}

// The operator of an assignment, or what is written for `:=` by mistake.
bool StatementParser::acceptAssign(AssignOp& op) {
  struct Written {
    bool is_operator = false;
    AssignOp op = AssignOp::Assign;
  };
  static constexpr TokMap<Written> kOperators = {
      {Tok::Assign, {true, AssignOp::Assign}},        {Tok::PlusAssign, {true, AssignOp::Add}},
      {Tok::MinusAssign, {true, AssignOp::Subtract}}, {Tok::StarAssign, {true, AssignOp::Multiply}},
      {Tok::SlashAssign, {true, AssignOp::Divide}},   {Tok::TryAssign, {true, AssignOp::Attempt}}};
  static constexpr TokMap<Written> kLetters = {{Tok::SetModifier, {true, AssignOp::Set}},
                                               {Tok::ResetModifier, {true, AssignOp::Reset}},
                                               {Tok::RefModifier, {true, AssignOp::Reference}}};
  if (const Written& written = kOperators[kind()]; written.is_operator) {
    op = written.op;
    advance();
    return true;
  }
  if (const Written& written = kLetters[kind()]; written.is_operator) {  // S= R= REF=
    if (peek() != Tok::Equal || t_[1].offset != t_->offset + lengthOf(t_) || atLineStart()) return false;
    op = written.op;
    advance();
    advance();
    return true;
  }
  if (at(Tok::Equal) || at(Tok::EqualEqual)) {
    slip(diag::AssignWithEqual, t_, {spelling(kind())});
  } else if (at(Tok::Arrow)) {
    slip(diag::ForeignOperator, t_, {"=>", ":="});
  } else if (at(Tok::Colon) && peek() == Tok::Equal) {
    slip(diag::ForeignOperator, t_, {": =", ":="});
    advance();
  } else {
    return false;
  }
  advance();
  return true;
}

// The value after the operator.
void StatementParser::finishAssign(Token* first, ExprId target, AssignOp assign, const Token* op) {
  if (assign == AssignOp::Assign && atListOfValues()) {
    slip(diag::ListInBody, t_);
    stmts_.push_back(build_.errorStatement(loc(first)));
    const bool outer = std::exchange(declares_, true);
    parseInit();
    declares_ = outer;
    return endStatement();
  }
  if (assign == AssignOp::Assign) acceptChainOverLines();
  Token* const value_start = t_;
  const ExprId value = parseExpr();
  if (atRowOperator() && !panic_) {
    parseRow(target, assign, value, value_start, op);
    return endStatement();
  }
  if (at(Tok::Assign) && !panic_) {
    parseChain(target, value, value_start, op);
  } else {
    if (!panic_ && !at(Tok::Semicolon) && misspelledStart(first)) return;
    stmts_.push_back(build_.assign(assign, target, value, loc(op)));
  }
  return endStatement();
}

// An expression that is neither assigned nor called.
void StatementParser::reportNoEffect(const Token* first) {
  stmts_.push_back(build_.errorStatement(loc(first)));
  const bool ends = at(Tok::Semicolon) || atLineStart() || atBlockEnd() || startsStatement(t_);
  if (ends) {
    const std::string shown(source_.substr(first->offset, (t_ - 1)->offset + lengthOf(t_ - 1) - first->offset));
    slip(diag::NoEffect, first, {shown.size() > 60 ? textOf(first) : std::string_view(shown)});
    if (at(Tok::Semicolon)) advance();
    return;
  }
  if (isOperand(kind()) && !at(Tok::LeftParen))
    fail(diag::MissingToken, t_, {":=", describe(t_)});
  else if (at(Tok::RightParen) || at(Tok::RightBracket))
    fail(diag::StrayParen, t_, {textOf(t_)});
  else
    fail(diag::StrayToken, t_, {describe(t_)});
  syncStatement();
}

// Tells whether `[1, 2]` or `(x := 1, y := 2)` is written as a value; `(x := 1)` is an assignment or comparison.
bool StatementParser::atListOfValues() const {
  if (at(Tok::LeftBracket)) return true;
  if (!at(Tok::LeftParen) || !isName(peek()) || peek(2) != Tok::Assign) return false;
  uint32_t depth = 0;
  for (const Token* t = t_; t->kind != Tok::Semicolon && t->kind != Tok::End && t - t_ < 1000; ++t) {
    if (t->kind == Tok::LeftParen || t->kind == Tok::LeftBracket) ++depth;
    if ((t->kind == Tok::RightParen || t->kind == Tok::RightBracket) && --depth == 0) break;
    if (depth == 1 && t->kind == Tok::Comma) return true;
  }
  return false;
}

// S= or R= after a value: `a S= b R= c`.
bool StatementParser::atRowOperator() const {
  return profile_.set_reset_assignments && (at(Tok::SetModifier) || at(Tok::ResetModifier)) && peek() == Tok::Equal &&
         t_[1].offset == t_->offset + lengthOf(t_) && !atLineStart();
}

// A row of assignments with S= and R=, from the right: each takes the operand at the end of the row. CODESYS and
// TwinCAT, "Assignment operator 'S='".
void StatementParser::parseRow(ExprId target, AssignOp assign, ExprId value, Token* value_start, const Token* op) {
  struct Link {
    ExprId target;
    AssignOp assign;
    Loc op;
  };
  std::vector<Link> links{{target, assign, loc(op)}};
  while (!panic_ && (at(Tok::Assign) || atRowOperator())) {
    Link link{value, AssignOp::Assign, here()};
    acceptAssign(link.assign);
    links.push_back(link);
    value_start = t_;
    value = parseExpr();
  }
  const bool only_modifiers = std::all_of(links.begin(), links.end(), [](const Link& link) {
    return link.assign == AssignOp::Set || link.assign == AssignOp::Reset;
  });
  if (only_modifiers) {  // IF operand THEN b := FALSE; a := TRUE; END_IF, which evaluates the operand once
    std::vector<StmtId> body;
    for (size_t i = links.size(); i-- > 0;) {
      const ExprId stored = build_.boolean(links[i].assign == AssignOp::Set, links[i].op);
      tree_.expr(stored).end = links[i].op;
      body.push_back(build_.assign(AssignOp::Assign, links[i].target, stored, links[i].op));
      tree_.stmt(body.back()).end = endOfPrevious();
    }
    stmts_.push_back(build_.ifStatement(value, body, tree_.begin(target)));
    return;
  }
  // Read again for each assignment: a call in it would run as often.
  for (const Token* t = value_start; t < t_; ++t)
    if (t->kind == Tok::LeftParen && (isName(t[-1].kind) || isTypeWord(t[-1].kind))) {
      slip(diag::ChainedCall, t - 1);
      break;
    }
  const bool panicked = panic_;
  Token* const end = t_;
  for (size_t i = links.size(); i-- > 0;) {
    stmts_.push_back(build_.assign(links[i].assign, links[i].target, value, links[i].op));
    if (i == 0) break;
    t_ = value_start;
    value = parseExpr();
  }
  t_ = end;
  panic_ = panicked;
}

// a := b := c assigns c to b, then b to a. Targets are parsed again from their tokens, since each use needs separate
// nodes.
void StatementParser::parseChain(ExprId target, ExprId value, Token* value_start, const Token* op) {
  if (!profile_.chained_assignments) slip(diag::ChainedAssign, t_);
  struct Link {
    ExprId target;
    Token* start;  // where it begins as a value
    Loc op;
  };
  std::vector<Link> links{{target, nullptr, loc(op)}};
  while (at(Tok::Assign) && !panic_) {
    const ExprKind k = tree_.kind(value);
    if (k == ExprKind::Literal || k == ExprKind::Binary || k == ExprKind::Unary || k == ExprKind::Call) {
      fail(diag::CompareWithAssign, t_);
      break;
    }
    // Read twice, as a target and as a value: a call in it would run twice.
    for (const Token* t = value_start; t < t_; ++t)
      if (t->kind == Tok::LeftParen && (isName(t[-1].kind) || isTypeWord(t[-1].kind))) {
        slip(diag::ChainedCall, t - 1);
        break;
      }
    links.push_back({value, value_start, here()});
    advance();
    acceptChainOverLines();
    value_start = t_;
    value = parseExpr();
  }
  const bool panicked = panic_;
  Token* const end = t_;
  for (size_t i = links.size(); i-- > 0;) {
    stmts_.push_back(build_.assign(AssignOp::Assign, links[i].target, value, links[i].op));
    if (i == 0) break;
    t_ = links[i].start;
    chain_target_ = t_;
    value = parseExpr();
  }
  t_ = end;
  panic_ = panicked;
}

// The name that begins this statement is a misspelled keyword: corrects it and returns to it.
bool StatementParser::misspelledStart(const Token* first) {
  if (first->kind != Tok::Ident || (first->flags & kReported) != 0) return false;
  static constexpr Tok kCandidates[] = {Tok::Elsif,    Tok::Else,   Tok::Until, Tok::Exit,
                                        Tok::Continue, Tok::Return, Tok::Jmp};
  static constexpr Tok kPous[] = {Tok::Function, Tok::FunctionBlock, Tok::Program, Tok::Configuration};
  Tok meant = nearKeyword(first, kCandidates);
  const Tok next = first[1].kind;
  if (meant == Tok::End && isName(next) && (first[1].flags & kLineStart) == 0) meant = nearKeyword(first, kPous);
  if (meant == Tok::End) return false;
  if ((meant == Tok::Exit || meant == Tok::Continue || meant == Tok::Return) && next != Tok::Semicolon &&
      (first[1].flags & kLineStart) == 0)
    return false;
  t_ = const_cast<Token*>(first);
  return correctSpelling(meant);
}

void StatementParser::endStatement() {
  if (accept(Tok::Semicolon)) {
    panic_ = false;
    return;
  }
  if (panic_) return skipStatement();
  if (at(Tok::RightParen) || at(Tok::RightBracket)) {
    fail(diag::StrayParen, t_, {textOf(t_)});
    skip();
    if (accept(Tok::Semicolon)) {
      panic_ = false;
      return;
    }
  } else if (atLineStart() || atBlockEnd() || startsStatement(t_) || at(Tok::Else) || at(Tok::Elsif) ||
             at(Tok::Until) || atSection()) {
    missing(diag::MissingSemicolon, {describe(t_ - 1)});
    return;
  } else if (isOperand(kind())) {
    fail(diag::MissingOperator, t_, {describe(t_)});
  } else if (at(Tok::Error)) {
    last_error_ = t_;
  } else {
    fail(diag::StrayToken, t_, {describe(t_)});
  }
  syncStatement();
}

// After an error in the statement that was made last.
void StatementParser::skipStatement() {
  const Token* first = t_;
  syncStatement();
  if (stmts_.empty() || tree_.loc(stmts_.back()) < loc(statement_start_)) return;
  const StmtId last = stmts_.back();
  if (tree_.kind(last) == StmtKind::Assign) holdSkipped(tree_.as<AssignStmt>(last).value, first);
  if (tree_.kind(last) == StmtKind::Call) holdSkipped(tree_.as<CallStmt>(last).call, first);
}

void StatementParser::syncStatement() {
  panic_ = false;
  if (atUnfinished()) return;
  const Skipping skipping(*this);
  // A list without its `(`, perhaps over several lines: up to its `;`.
  if (at(Tok::Comma)) {
    const Token* t = t_;
    while (t->kind != Tok::Semicolon && t->kind != Tok::End && !isReserved(t->kind) && t - t_ < 500) ++t;
    if (t->kind == Tok::Semicolon) {
      t_ = const_cast<Token*>(t) + 1;
      return;
    }
  }
  uint32_t depth = 0;
  for (;; advance()) {
    const Tok k = kind();
    if (k == Tok::Semicolon) {
      // A `;` in place of `,` is skipped inside parentheses that are closed on the same line.
      if (depth > 0) {
        const Token* t = t_ + 1;
        while ((t->flags & kLineStart) == 0 && t->kind != Tok::End && t->kind != Tok::Semicolon &&
               t->kind != Tok::RightParen)
          ++t;
        if (t->kind == Tok::RightParen && (t->flags & kLineStart) == 0) continue;
      }
      advance();
      return;
    }
    if (k == Tok::LeftParen) ++depth;
    if (k == Tok::RightParen && depth > 0) --depth;
    if (atBlockEnd() || isStatementWord(k) || k == Tok::Else || k == Tok::Elsif || k == Tok::Until || atSection())
      return;
    if (atLineStart() && (startsStatement(t_) || atCaseLabel())) return;
  }
}

}  // namespace rung::text

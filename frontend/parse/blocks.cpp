// SPDX-License-Identifier: Apache-2.0
// Statements with blocks: IF, CASE, FOR, WHILE, REPEAT, __TRY; their headers and ends.
#include "frontend/parse/diagnostics.h"
#include "frontend/parse/statements.h"

namespace rung::text {

// expr connective, where the connective is THEN, DO or OF: the header of a block.
ExprId StatementParser::parseHeader(Tok connective) {
  const ExprId condition = parseCompared(parseExpr());
  const Token* const end = t_;
  finishHeader(connective);
  holdSkipped(condition, end);
  return condition;
}

void StatementParser::finishHeader(Tok connective) {
  if (!panic_) {
    if (accept(connective)) return;
    const Tok candidates[] = {connective};
    if (at(Tok::Then) || at(Tok::Do) || at(Tok::Of)) {
      slip(diag::WrongKeyword, t_, {textOf(t_), spelling(connective)});
      advance();
      return;
    }
    if (at(Tok::Ident) && (!atLineStart() || (t_[1].flags & kLineStart) != 0) &&
        nearKeyword(t_, candidates) == connective) {
      correctSpelling(connective);
      advance();
      return;
    }
    if ((t_->flags & kPragma) != 0 && (t_ - 1)->kind != Tok::Semicolon) {
      missing(diag::PragmaForBlock, {spelling(connective)});
      return;
    }
    if (atLineStart() || at(Tok::Semicolon) || atBlockEnd() || startsStatement(t_) || atSection() || at(Tok::Else)) {
      missing(diag::MissingToken, {spelling(connective), describe(t_)});
      if (at(Tok::Semicolon) && (t_[1].flags & kLineStart) != 0) advance();
      return;
    }
  }
  if (panic_ && atUnfinished()) {
    panic_ = false;
    return;
  }
  skipHeader(connective);
}

// If the keyword still follows, the tokens before it are wrong; otherwise it is missing here.
void StatementParser::skipHeader(Tok connective) {
  const Token* t = t_;
  while (t->kind != connective && t->kind != Tok::Semicolon && !isEndWord(t->kind) && !isStatementWord(t->kind) &&
         !isAssign(t->kind) && t - t_ < 500)
    ++t;
  if (t->kind == connective) {
    if (at(Tok::RightParen) || at(Tok::RightBracket))
      fail(diag::StrayParen, t_, {textOf(t_)});
    else if (isOperand(kind()))
      fail(diag::MissingOperator, t_, {describe(t_)});
    else
      fail(diag::WrongKeyword, t_, {textOf(t_), spelling(connective)});
    {
      const Skipping skipping(*this);
      t_ = const_cast<Token*>(t);
    }
    advance();
    panic_ = false;
    return;
  }
  if (!panic_) {
    if (at(Tok::RightParen) || at(Tok::RightBracket))
      fail(diag::StrayParen, t_, {textOf(t_)});
    else
      slip(diag::MissingToken, t_, {spelling(connective), describe(t_)});
  }
  const Skipping skipping(*this);
  while (!atBlockEnd() && !at(Tok::Semicolon) && !atLineStart() && !isStatementWord(kind()) && !startsStatement(t_) &&
         !at(Tok::Else))
    advance();
  if (at(Tok::Semicolon) && (t_[1].flags & kLineStart) != 0) advance();
  panic_ = false;
}

// False: too deep, the block was skipped.
bool StatementParser::enterBlock() {
  if (++stmt_depth_ <= kMaxStmtDepth) return true;
  tooDeep("statements", kMaxStmtDepth);
  uint32_t open = 0;
  const Skipping skipping(*this);
  do {
    const Tok k = kind();
    if (beginsBlock(k)) ++open;
    if (endsBlock(k)) --open;
    advance();
  } while (open > 0 && !at(Tok::End));
  accept(Tok::Semicolon);
  panic_ = false;
  --stmt_depth_;
  return false;
}

// END_… [";"]
void StatementParser::closeBlock(const Token* open, Tok end) {
  --stmt_depth_;
  if (accept(end)) {
    accept(Tok::Semicolon);
    return;
  }
  missingEnd(spelling(end), open, spelling(open->kind));
}

// IF expr THEN statements {ELSIF expr THEN statements} [ELSE statements] END_IF
void StatementParser::parseIf() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  const size_t first = if_branches_.size();
  IfBranch branch{parseHeader(Tok::Then), {}};
  branch.body = parseStatements(kStopElse | kStopElsif);
  if_branches_.push_back(branch);
  while (at(Tok::Elsif) || at(Tok::Elseif)) {
    if (at(Tok::Elseif)) correctSpelling(Tok::Elsif);
    advance();
    IfBranch next{parseHeader(Tok::Then), {}};
    next.body = parseStatements(kStopElse | kStopElsif);
    if_branches_.push_back(next);
  }
  Slice<StmtId> otherwise;
  if (accept(Tok::Else)) otherwise = parseStatements(0);
  closeBlock(open, Tok::EndIf);
  stmts_.push_back(build_.ifStatement(listFrom(if_branches_, first), otherwise, loc(open)));
}

// A case label ends in `:`, `,` or `..`; the beginning of a statement never does.
bool StatementParser::atCaseLabel() const {
  const Token* t = t_;
  static constexpr TokSet kBegins = {
      Tok::Number, Tok::Minus, Tok::Plus,  Tok::LeftParen, Tok::StringLiteral, Tok::WideStringLiteral,
      Tok::True,   Tok::False, Tok::Colon, Tok::DotDot,    Tok::Comma,         Tok::Duration};
  if (kBegins.has(t->kind)) return true;
  if (isTypeWord(t->kind)) return t[1].kind == Tok::Hash;
  if (!isName(t->kind)) return false;
  if (t[1].kind == Tok::Hash) return true;
  ++t;
  while (t->kind == Tok::Dot && isName(t[1].kind)) t += 2;
  if (t->kind == Tok::Colon) return t[1].kind != Tok::Equal;
  static constexpr TokSet kContinues = {Tok::Comma, Tok::DotDot, Tok::Plus, Tok::Minus, Tok::Star};
  if (kContinues.has(t->kind)) return true;
  if (t->kind != Tok::LeftParen) return false;
  // MAX(1, LIMIT): a call statement has no colon or comma after it.
  uint32_t open = 0;
  do {
    if (t->kind == Tok::LeftParen) ++open;
    if (t->kind == Tok::RightParen) --open;
    ++t;
  } while (open != 0 && t->kind != Tok::Semicolon && t->kind != Tok::End &&
           !(isReserved(t->kind) && isEndWord(t->kind)));
  return open == 0 && (t->kind == Tok::Colon || t->kind == Tok::Comma || t->kind == Tok::DotDot);
}

// labels = label {"," label} ":" with label = expr [".." expr]
void StatementParser::parseCaseLabels(std::vector<ExprId>& out) {
  const Token* first = t_;
  for (;;) {
    const Loc start = here();
    ExprId low = parseExpr();
    if (!panic_ && at(Tok::DotDot)) {
      advance();
      const ExprId high = parseExpr();
      low = ended(build_.range(low, high, start));
    }
    out.push_back(low);
    if (!panic_ && accept(Tok::Comma)) continue;
    if (!panic_ && accept(Tok::Colon)) return;
    if (!panic_ && !atLineStart() && at(Tok::Number)) {
      slip(diag::MissingToken, t_, {",", describe(t_)});
      continue;
    }
    break;
  }
  if (!panic_) {
    if (at(Tok::Assign) || at(Tok::Semicolon) || at(Tok::Equal)) {
      slip(diag::WrongKeyword, t_, {textOf(t_), ":"});
      advance();
      return;
    }
    if (atLineStart() || atBlockEnd() || startsStatement(t_)) {
      missing(diag::MissingToken, {":", describe(t_)});
      return;
    }
    fail(diag::MissingToken, t_, {":", describe(t_)});
  }
  // After the error: the colon of this line, if there is one.
  const Token* t = t_;
  while (t->kind != Tok::Colon && t->kind != Tok::Semicolon && t->kind != Tok::Assign && !isEndWord(t->kind) &&
         ((t->flags & kLineStart) == 0 || t == first))
    ++t;
  panic_ = false;
  if (t->kind == Tok::Colon)
    t_ = const_cast<Token*>(t) + 1;
  else if (t_ == first)
    advance();
}

// CASE expr OF {labels statements} [ELSE statements] END_CASE
void StatementParser::parseCase() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  CaseStmt s{header(StmtKind::Case, loc(open)), {}, {}, {}, false};
  s.selector = parseHeader(Tok::Of);
  const size_t first = case_branches_.size();
  while (!at(Tok::Else) && !atBlockEnd()) {
    CaseBranch branch{};
    const size_t labels = exprs_.size();
    if (atCaseLabel()) {
      parseCaseLabels(exprs_);
    } else {
      const Token* before = t_;
      slip(diag::MissingToken, t_, {"label:", describe(t_)});
      exprs_.push_back(build_.error(here()));
      if (!isName(kind()) && !startsStatement(t_) && t_ == before && !at(Tok::Semicolon)) advance();
    }
    branch.labels = listFrom(exprs_, labels);
    branch.body = parseStatements(kStopElse | kStopLabel);
    case_branches_.push_back(branch);
  }
  if (accept(Tok::Else)) {
    if (at(Tok::Colon)) {
      slip(diag::StrayToken, t_, {describe(t_)});
      advance();
    }
    s.has_else = true;
    s.otherwise = parseStatements(0);
  }
  closeBlock(open, Tok::EndCase);
  s.branches = listFrom(case_branches_, first);
  stmts_.push_back(tree_.add<StmtId>(s));
}

// FOR lvalue := expr TO expr [BY expr] DO statements END_FOR
void StatementParser::parseFor() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  ForStmt s{header(StmtKind::For, loc(open)), {}, {}, {}, {}, {}};
  s.control = parsePrimary();
  if (!panic_ && !accept(Tok::Assign)) {
    if (at(Tok::Equal) || at(Tok::EqualEqual)) {
      slip(diag::AssignWithEqual, t_, {textOf(t_)});
      advance();
    } else if (at(Tok::Colon) && peek() == Tok::Equal) {
      slip(diag::ForeignOperator, t_, {": =", ":="});
      advance();
      advance();
    } else if (isOperand(kind()) || at(Tok::Minus)) {
      slip(diag::MissingToken, t_, {":=", describe(t_)});
    } else {
      fail(diag::MissingToken, t_, {":=", describe(t_)});
    }
  }
  s.from = panic_ ? build_.error(here()) : parseExpr();
  if (!panic_) expect(Tok::To);
  s.to = panic_ ? build_.error(here()) : parseExpr();
  if (!panic_ && at(Tok::Ident)) {
    const Tok candidates[] = {Tok::By, Tok::Do};
    if (nearKeyword(t_, candidates) == Tok::By && peek() != Tok::Assign) correctSpelling(Tok::By);
  }
  if (!panic_ && accept(Tok::By)) s.step = parseExpr();
  finishHeader(Tok::Do);
  s.body = parseStatements(0);
  closeBlock(open, Tok::EndFor, s);
}

// WHILE expr DO statements END_WHILE
void StatementParser::parseWhile() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  WhileStmt s{header(StmtKind::While, loc(open)), {}, {}};
  s.condition = parseHeader(Tok::Do);
  s.body = parseStatements(0);
  closeBlock(open, Tok::EndWhile, s);
}

// REPEAT statements UNTIL expr [";"] END_REPEAT
void StatementParser::parseRepeat() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  RepeatStmt s{header(StmtKind::Repeat, loc(open)), {}, {}};
  s.body = parseStatements(kStopUntil);
  if (accept(Tok::Until)) {
    s.until = parseCompared(parseExpr());
    accept(Tok::Semicolon);
    if (!at(Tok::EndRepeat)) {
      if (!panic_ && !atLineStart() && !atBlockEnd())
        fail(at(Tok::RightParen) ? diag::StrayParen : diag::StrayToken, t_,
             {at(Tok::RightParen) ? std::string(")") : describe(t_)});
      const Skipping skipping(*this);
      while (!at(Tok::EndRepeat) && !atBlockEnd() && !atLineStart()) advance();
    }
    panic_ = false;
  } else {
    // Not reported when the line before, most likely its condition, has an error.
    s.until = build_.error(here());
    if (last_error_ == nullptr || last_error_ < statement_start_) slip(diag::MissingToken, t_, {"UNTIL", describe(t_)});
  }
  closeBlock(open, Tok::EndRepeat, s);
}

// __TRY statements [__CATCH ["(" lvalue ")"] statements] [__FINALLY statements] __ENDTRY
void StatementParser::parseTry() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  TryStmt s{header(StmtKind::Try, loc(open)), {}, {}, {}, {}, false};
  s.body = parseStatements(kStopTry);
  if (accept(Tok::Catch)) {
    s.catches = true;
    if (accept(Tok::LeftParen)) {
      s.code = parseExpr();
      expect(Tok::RightParen);
    }
    s.handler = parseStatements(kStopTry);
  }
  if (accept(Tok::Finally)) s.finally = parseStatements(0);
  closeBlock(open, Tok::EndTry, s);
}

}  // namespace rung::text

// Statements, and resynchronization after errors.
#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parser.h"
#include "frontend/parse/recover.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagnostics.h"

namespace rung::text {
namespace {

bool isEndWord(Tok k) {
  return k == Tok::EndIf || k == Tok::EndCase || k == Tok::EndFor || k == Tok::EndWhile || k == Tok::EndRepeat ||
         k == Tok::EndTry || endsPart(k);
}
bool isPouWord(Tok k) {
  return k == Tok::Function || k == Tok::FunctionBlock || k == Tok::Program || k == Tok::Type ||
         k == Tok::Configuration || isObjectWord(k);
}
bool isStatementWord(Tok k) {
  return k == Tok::If || k == Tok::Case || k == Tok::For || k == Tok::While || k == Tok::Repeat || k == Tok::Try ||
         k == Tok::Exit || k == Tok::Continue || k == Tok::Return || k == Tok::Jmp;
}
bool isAssign(Tok k) { return k == Tok::Assign || (k >= Tok::PlusAssign && k <= Tok::TryAssign); }

}  // namespace

bool Parser::atBlockEnd() {
  const Tok k = kind();
  return isEndWord(k) || isPouWord(k) || k == Tok::EndNetwork ||
         (k == Tok::VarGlobal && stmt_depth_ == 0 && !pouCloses()) || (in_property_ > 0 && atAccessor());
}

bool Parser::startsStatement(const Token* t) const {
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
Slice<StmtId> Parser::parseStatements(uint8_t stops) {
  const size_t first = stmts_.size();
  for (;;) {
    switch (static_cast<int>(kind())) {
      case static_cast<int>(Tok::Else):
        if ((stops & kStopElse) != 0) return listFrom(stmts_, first);
        break;
      case static_cast<int>(Tok::Elsif):
      case static_cast<int>(Tok::Elseif):
        if (at(Tok::Elseif) && peek() == Tok::Assign) break;
        if ((stops & kStopElsif) != 0) return listFrom(stmts_, first);
        break;
      case static_cast<int>(Tok::Until):
        if ((stops & kStopUntil) != 0) return listFrom(stmts_, first);
        break;
      case static_cast<int>(Tok::Catch):
      case static_cast<int>(Tok::Finally):
        if ((stops & kStopTry) != 0) return listFrom(stmts_, first);
        break;
      default:
        if (atBlockEnd()) return listFrom(stmts_, first);
        if ((stops & kStopLabel) != 0 && atCaseLabel()) return listFrom(stmts_, first);
        break;
    }
    const Token* before = t_;
    parseStatement();
    if (t_ == before && t_->kind == before->kind && (t_->flags & kReported) == 0) advance();  // guarantees progress
  }
}

void Parser::parseStatement() {
  const Token* first = t_;
  statement_start_ = t_;
  const Loc start = here();
  switch (static_cast<int>(kind())) {
    case static_cast<int>(Tok::Semicolon):
      advance();
      stmts_.push_back(tree_.add<StmtId>(EmptyStmt{header(StmtKind::Empty, start)}));
      return;
    case static_cast<int>(Tok::If): return parseIf();
    case static_cast<int>(Tok::Case): return parseCase();
    case static_cast<int>(Tok::For): return parseFor();
    case static_cast<int>(Tok::While): return parseWhile();
    case static_cast<int>(Tok::Repeat): return parseRepeat();
    case static_cast<int>(Tok::Try): return parseTry();
    case static_cast<int>(Tok::Exit):
      advance();
      stmts_.push_back(tree_.add<StmtId>(ExitStmt{header(StmtKind::Exit, start)}));
      return endStatement(first);
    case static_cast<int>(Tok::Continue):
      advance();
      stmts_.push_back(tree_.add<StmtId>(ContinueStmt{header(StmtKind::Continue, start)}));
      return endStatement(first);
    case static_cast<int>(Tok::Return):
      advance();
      stmts_.push_back(tree_.add<StmtId>(ReturnStmt{header(StmtKind::Return, start)}));
      return endStatement(first);
    case static_cast<int>(Tok::Jmp): {
      advance();
      JumpStmt s{header(StmtKind::Jump, start), {}};
      if (isName(kind())) {
        s.label = ident(t_);
        advance();
      } else if (atLineStart()) {
        fail(diag::MissingName, first, {describe(t_)});
      } else {
        fail(diag::MissingName, t_, {describe(t_)});
      }
      stmts_.push_back(tree_.add<StmtId>(s));
      return endStatement(first);
    }
    case static_cast<int>(Tok::Address): return parseExprStatement();
    case static_cast<int>(Tok::And):
    case static_cast<int>(Tok::Or):
    case static_cast<int>(Tok::Xor):
    case static_cast<int>(Tok::Mod):
      if (peek() == Tok::LeftParen) return parseExprStatement();
      break;
    default: break;
  }
  if (chartInSt() || instructionInSt()) return;
  if (isName(kind()) || (isTypeWord(kind()) && peek() == Tok::LeftParen)) return parseExprStatement();
  if (atSection()) {
    if (!declared_in_body_) slip(diag::DeclarationInBody, t_);
    declared_in_body_ = true;
    parseSection();
    return;
  }
  if (at(Tok::Error)) {
    last_error_ = t_;
    panic_ = true;
  } else if (at(Tok::Else) || at(Tok::Elsif) || at(Tok::Until) || at(Tok::Then) || at(Tok::Do) || at(Tok::Of)) {
    const Tok word = kind();
    slip(diag::StrayEnd, t_, {textOf(t_)});
    advance();
    // A lone ELSIF keeps its branch; its condition is parsed and dropped.
    if (word == Tok::Elsif) parseHeader(Tok::Then);
    return;
  } else {
    fail(diag::NotAStatement, t_, {describe(t_)});
  }
  stmts_.push_back(tree_.add<StmtId>(ErrorStmt{header(StmtKind::Error, start)}));
  advance();
  syncStatement();
}

// Steps among the statements of a body that began in ST: one error for all of them.
bool Parser::chartInSt() {
  if (!atSfc()) return false;
  slip(diag::SfcNotInChart, t_, {describe(t_)});
  while (!at(Tok::End) && kind() != pou_end_ && !atTopLevelWord()) advance();
  return true;
}

// assignment = lvalue (":=" | "S=" | "R=" | "REF=" | "+=" | "-=" | "*=" | "/=") expr ";"
// call       = expr "(" arguments ")" ";"
// label      = name ":"
void Parser::parseExprStatement() {
  Token* const first = t_;
  // A declaration among the statements: `x : INT;`
  if (isName(kind()) && peek() == Tok::Colon) {
    const Tok third = peek(2);
    if (third == Tok::Equal) {
      // `a : = 5`
    } else if (isTypeWord(third) || third == Tok::Array || third == Tok::Struct ||
               (isName(third) && peek(3) == Tok::Semicolon && (t_[2].flags & kLineStart) == 0)) {
      if (!declared_in_body_) fail(diag::DeclarationInBody, t_);
      declared_in_body_ = true;
      stmts_.push_back(tree_.add<StmtId>(ErrorStmt{header(StmtKind::Error, here())}));
      advance();
      syncStatement();
      return;
    } else {
      const Ident label = ident(t_);
      advance();
      advance();
      stmts_.push_back(tree_.add<StmtId>(LabelStmt{header(StmtKind::Label, label.loc), label}));
      return;
    }
  }
  const ExprId target = parsePrimary();
  const Token* op = t_;
  AssignOp assign = AssignOp::Assign;
  bool is_assign = !panic_;
  if (!panic_) {
    switch (static_cast<int>(kind())) {
      case static_cast<int>(Tok::Assign): advance(); break;
      case static_cast<int>(Tok::PlusAssign):
        assign = AssignOp::Add;
        advance();
        break;
      case static_cast<int>(Tok::MinusAssign):
        assign = AssignOp::Subtract;
        advance();
        break;
      case static_cast<int>(Tok::StarAssign):
        assign = AssignOp::Multiply;
        advance();
        break;
      case static_cast<int>(Tok::SlashAssign):
        assign = AssignOp::Divide;
        advance();
        break;
      case static_cast<int>(Tok::TryAssign):
        assign = AssignOp::Attempt;
        advance();
        break;
      case static_cast<int>(Tok::Equal):
      case static_cast<int>(Tok::EqualEqual):
        slip(diag::AssignWithEqual, t_, {spelling(kind())});
        advance();
        break;
      case static_cast<int>(Tok::Arrow):
        slip(diag::ForeignOperator, t_, {"=>", ":="});
        advance();
        break;
      case static_cast<int>(Tok::Colon):
        if (peek() == Tok::Equal) {
          slip(diag::ForeignOperator, t_, {": =", ":="});
          advance();
          advance();
        } else {
          is_assign = false;
        }
        break;
      case static_cast<int>(Tok::SetModifier):
      case static_cast<int>(Tok::ResetModifier):
      case static_cast<int>(Tok::RefModifier):
        is_assign = peek() == Tok::Equal && t_[1].offset == t_->offset + lengthOf(t_) && !atLineStart();
        if (is_assign) {
          assign = at(Tok::SetModifier)     ? AssignOp::Set
                   : at(Tok::ResetModifier) ? AssignOp::Reset
                                            : AssignOp::Reference;
          advance();
          advance();
        }
        break;
      default: is_assign = false; break;
    }
  }
  if (is_assign) {
    Token* const value_start = t_;
    const ExprId value = parseExpr();
    if (at(Tok::Assign) && !panic_) {
      parseChain(target, value, value_start, op);
    } else {
      if (!panic_ && !at(Tok::Semicolon) && misspelledStart(first)) return;
      stmts_.push_back(tree_.add<StmtId>(
          AssignStmt{header(StmtKind::Assign, loc(op), static_cast<uint8_t>(assign)), target, value}));
    }
    return endStatement(first);
  }
  if (panic_) {
    stmts_.push_back(tree_.add<StmtId>(ErrorStmt{header(StmtKind::Error, loc(first))}));
    return endStatement(first);
  }
  if (tree_.kind(target) == ExprKind::Call) {
    if (!at(Tok::Semicolon) && misspelledStart(first)) return;
    stmts_.push_back(tree_.add<StmtId>(CallStmt{header(StmtKind::Call, tree_.loc(target)), target}));
    return endStatement(first);
  }
  if (misspelledStart(first)) return;
  const ExprKind written = tree_.kind(target);
  if (dialect_ == Dialect::Codesys && at(Tok::Semicolon) &&
      (written == ExprKind::Name || written == ExprKind::Member)) {  // an action is called by its bare name
    const Loc start = tree_.loc(target);
    const ExprId call =
        tree_.add<ExprId>(CallExpr{exprHeader(ExprKind::Call, start, 0, kBareCall), target, {}, endOf(t_ - 1), {}});
    stmts_.push_back(tree_.add<StmtId>(CallStmt{header(StmtKind::Call, start), call}));
    return endStatement(first);
  }
  stmts_.push_back(tree_.add<StmtId>(ErrorStmt{header(StmtKind::Error, loc(first))}));
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

// a := b := c assigns c to b, then b to a. Targets are parsed again from their tokens, since each use needs separate
// nodes.
void Parser::parseChain(ExprId target, ExprId value, Token* value_start, const Token* op) {
  if (dialect_ != Dialect::Codesys) slip(diag::ChainedAssign, t_);
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
    value_start = t_;
    value = parseExpr();
  }
  const bool panicked = panic_;
  Token* const end = t_;
  for (size_t i = links.size(); i-- > 0;) {
    stmts_.push_back(tree_.add<StmtId>(AssignStmt{header(StmtKind::Assign, links[i].op), links[i].target, value}));
    if (i == 0) break;
    t_ = links[i].start;
    value = parseExpr();
  }
  t_ = end;
  panic_ = panicked;
}

// The name that begins this statement is a misspelled keyword: corrects it and returns to it.
bool Parser::misspelledStart(const Token* first) {
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

void Parser::endStatement(const Token*) {
  if (accept(Tok::Semicolon)) {
    panic_ = false;
    return;
  }
  if (panic_) return syncStatement();
  if (at(Tok::RightParen) || at(Tok::RightBracket)) {
    fail(diag::StrayParen, t_, {textOf(t_)});
    advance();
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

void Parser::syncStatement() {
  panic_ = false;
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

// The condition of a block's header and the keyword after it.
ExprId Parser::parseHeader(Tok connective) {
  const ExprId condition = parseCompared(parseExpr());
  finishHeader(connective);
  return condition;
}

void Parser::finishHeader(Tok connective) {
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
  // If the keyword still follows, the tokens before it are wrong; otherwise it is missing here.
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
    t_ = const_cast<Token*>(t) + 1;
    panic_ = false;
    return;
  }
  if (!panic_) {
    if (at(Tok::RightParen) || at(Tok::RightBracket))
      fail(diag::StrayParen, t_, {textOf(t_)});
    else
      slip(diag::MissingToken, t_, {spelling(connective), describe(t_)});
  }
  while (!atBlockEnd() && !at(Tok::Semicolon) && !atLineStart() && !isStatementWord(kind()) && !startsStatement(t_) &&
         !at(Tok::Else))
    advance();
  if (at(Tok::Semicolon) && (t_[1].flags & kLineStart) != 0) advance();
  panic_ = false;
}

// False: too deep, the block was skipped.
bool Parser::enterBlock() {
  if (++stmt_depth_ <= kMaxStmtDepth) return true;
  tooDeep("statements", kMaxStmtDepth);
  uint32_t open = 0;
  do {
    const Tok k = kind();
    if (k == Tok::If || k == Tok::Case || k == Tok::For || k == Tok::While || k == Tok::Repeat || k == Tok::Try) ++open;
    if (k == Tok::EndIf || k == Tok::EndCase || k == Tok::EndFor || k == Tok::EndWhile || k == Tok::EndRepeat ||
        k == Tok::EndTry)
      --open;
    advance();
  } while (open > 0 && !at(Tok::End));
  accept(Tok::Semicolon);
  panic_ = false;
  --stmt_depth_;
  return false;
}

// END_… and the optional `;` after it.
void Parser::closeBlock(const Token* open, Tok end) {
  --stmt_depth_;
  if (accept(end)) {
    accept(Tok::Semicolon);
    return;
  }
  const std::string line = std::to_string(sources_.location(loc(open)).line);
  missing(diag::MissingEnd, {spelling(end), spelling(open->kind), line});
}

// IF expr THEN statements {ELSIF expr THEN statements} [ELSE statements] END_IF
void Parser::parseIf() {
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
  stmts_.push_back(
      tree_.add<StmtId>(IfStmt{header(StmtKind::If, loc(open)), listFrom(if_branches_, first), otherwise}));
}

// A case label ends in `:`, `,` or `..`; the beginning of a statement never does.
bool Parser::atCaseLabel() const {
  const Token* t = t_;
  switch (static_cast<int>(t->kind)) {
    case static_cast<int>(Tok::Number):
    case static_cast<int>(Tok::Minus):
    case static_cast<int>(Tok::Plus):
    case static_cast<int>(Tok::LeftParen):
    case static_cast<int>(Tok::StringLiteral):
    case static_cast<int>(Tok::WideStringLiteral):
    case static_cast<int>(Tok::True):
    case static_cast<int>(Tok::False):
    case static_cast<int>(Tok::Colon):
    case static_cast<int>(Tok::DotDot):
    case static_cast<int>(Tok::Comma):
    case static_cast<int>(Tok::Duration): return true;
    default: break;
  }
  if (isTypeWord(t->kind)) return t[1].kind == Tok::Hash;
  if (!isName(t->kind)) return false;
  if (t[1].kind == Tok::Hash) return true;
  ++t;
  while (t->kind == Tok::Dot && isName(t[1].kind)) t += 2;
  switch (static_cast<int>(t->kind)) {
    case static_cast<int>(Tok::Colon): return t[1].kind != Tok::Equal;
    case static_cast<int>(Tok::Comma):
    case static_cast<int>(Tok::DotDot):
    case static_cast<int>(Tok::Plus):
    case static_cast<int>(Tok::Minus):
    case static_cast<int>(Tok::Star): return true;
    case static_cast<int>(Tok::LeftParen): break;
    default: return false;
  }
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
void Parser::parseCaseLabels(std::vector<ExprId>& out) {
  const Token* first = t_;
  for (;;) {
    const Loc start = here();
    ExprId low = parseExpr();
    if (!panic_ && at(Tok::DotDot)) {
      advance();
      const ExprId high = parseExpr();
      low = tree_.add<ExprId>(RangeExpr{exprHeader(ExprKind::Range, start), low, high});
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
void Parser::parseCase() {
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
      exprs_.push_back(errorExpr(here()));
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
void Parser::parseFor() {
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
  s.from = panic_ ? errorExpr(here()) : parseExpr();
  if (!panic_) expect(Tok::To);
  s.to = panic_ ? errorExpr(here()) : parseExpr();
  if (!panic_ && at(Tok::Ident)) {
    const Tok candidates[] = {Tok::By, Tok::Do};
    if (nearKeyword(t_, candidates) == Tok::By && peek() != Tok::Assign) correctSpelling(Tok::By);
  }
  if (!panic_ && accept(Tok::By)) s.step = parseExpr();
  finishHeader(Tok::Do);
  s.body = parseStatements(0);
  closeBlock(open, Tok::EndFor);
  stmts_.push_back(tree_.add<StmtId>(s));
}

// WHILE expr DO statements END_WHILE
void Parser::parseWhile() {
  const Token* open = t_;
  if (!enterBlock()) return;
  advance();
  WhileStmt s{header(StmtKind::While, loc(open)), {}, {}};
  s.condition = parseHeader(Tok::Do);
  s.body = parseStatements(0);
  closeBlock(open, Tok::EndWhile);
  stmts_.push_back(tree_.add<StmtId>(s));
}

// REPEAT statements UNTIL expr [";"] END_REPEAT
void Parser::parseRepeat() {
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
      while (!at(Tok::EndRepeat) && !atBlockEnd() && !atLineStart()) advance();
    }
    panic_ = false;
  } else {
    // Not reported when the line before, most likely its condition, has an error.
    s.until = errorExpr(here());
    if (last_error_ == nullptr || last_error_ < statement_start_) slip(diag::MissingToken, t_, {"UNTIL", describe(t_)});
  }
  closeBlock(open, Tok::EndRepeat);
  stmts_.push_back(tree_.add<StmtId>(s));
}

// __TRY statements [__CATCH ["(" lvalue ")"] statements] [__FINALLY statements] __ENDTRY
void Parser::parseTry() {
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
  closeBlock(open, Tok::EndTry);
  stmts_.push_back(tree_.add<StmtId>(s));
}

}  // namespace rung::text

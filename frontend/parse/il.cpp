// SPDX-License-Identifier: Apache-2.0
// Bodies in Instruction List: one instruction a line, kept as IlInstruction until il_schedule.cpp turns them into
// statements. IEC 61131-3 ed. 2 annex B.2, ed. 3 tables 67 to 70; TM/TP manual 5.4.
//   instruction = [label ":"] [operator operands | function operands | ")"]
//   operands    = operand {"," operand} | "(" operand {"," operand} ")" | "(" [pin ":=" operand …] ")" | "(" [operand]
// The last form defers the operator up to a `)` on its own line.
#include <algorithm>
#include <optional>
#include <utility>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/il.h"
#include "frontend/parse/syntax_fixes.h"
#include "frontend/syntax/standard_names.h"

namespace rung::text {
namespace {

struct Instruction {
  IlKind kind;
  BinaryOp op;
  uint8_t flags;
};
struct InstructionWord {
  std::string_view word;
  IlKind kind;
  uint8_t flags;
};
// Besides the operators of frontend/syntax/standard_names.h.
constexpr InstructionWord kInstructions[] = {
    {"LD", IlKind::Load, 0},
    {"LDN", IlKind::Load, kIlNegated},
    {"ST", IlKind::Store, 0},
    {"STN", IlKind::Store, kIlNegated},
    {"S", IlKind::Set, 0},
    {"R", IlKind::Reset, 0},
    {"NOT", IlKind::Not, 0},
    {"CAL", IlKind::Call, 0},
    {"CALC", IlKind::Call, kIlConditional},
    {"CALCN", IlKind::Call, kIlConditional | kIlNegated},
    {"CALN", IlKind::Call, kIlConditional | kIlNegated},
    {"JMP", IlKind::Jump, 0},
    {"JMPC", IlKind::Jump, kIlConditional},
    {"JMPCN", IlKind::Jump, kIlConditional | kIlNegated},
    {"JMPN", IlKind::Jump, kIlConditional | kIlNegated},
    {"RET", IlKind::Return, 0},
    {"RETC", IlKind::Return, kIlConditional},
    {"RETCN", IlKind::Return, kIlConditional | kIlNegated},
    {"RETN", IlKind::Return, kIlConditional | kIlNegated},
};
constexpr size_t kLongestInstruction = 5;

// AND, OR and XOR may be followed by N.
bool takesNegation(BinaryOp op) { return op == BinaryOp::And || op == BinaryOp::Or || op == BinaryOp::Xor; }

std::optional<Instruction> findInstruction(std::string_view text) {
  if (text.empty() || text.size() > kLongestInstruction) return std::nullopt;
  if (const OperatorFunction* function = operatorFunction(text)) return Instruction{IlKind::Binary, function->op, 0};
  if (foldedCharacter(text.back()) == 'n')
    if (const OperatorFunction* function = operatorFunction(text.substr(0, text.size() - 1));
        function != nullptr && takesNegation(function->op))
      return Instruction{IlKind::Binary, function->op, kIlNegated};
  const char first = static_cast<char>(text[0] & ~0x20);  // most statements begin with a name of the program
  for (const InstructionWord& row : kInstructions)
    if (row.word[0] == first && row.word.size() == text.size() && sameIdentifier(row.word, text))
      return Instruction{row.kind, {}, row.flags};
  return std::nullopt;
}

// ADD, MUL, AND, OR, XOR take a list: `ADD 10, 12, 14`.
bool takesSeveral(BinaryOp op) {
  return op == BinaryOp::Add || op == BinaryOp::Multiply || op == BinaryOp::And || op == BinaryOp::Or ||
         op == BinaryOp::Xor;
}
bool endsOperand(Tok k) {
  return (k >= Tok::Number && k <= Tok::Ident) || isName(k) || k == Tok::True || k == Tok::False || k == Tok::Null ||
         k == Tok::RightParen || k == Tok::RightBracket || k == Tok::Caret;
}
bool isInfix(Tok k) { return (k >= Tok::Plus && k <= Tok::EqualLess) || (k >= Tok::And && k <= Tok::Mod); }

std::optional<Instruction> instructionAt(Tok kind, std::string_view text) {
  if (isName(kind) || kind == Tok::And || kind == Tok::Or || kind == Tok::Xor || kind == Tok::Not || kind == Tok::Mod ||
      kind == Tok::Jmp)
    return findInstruction(text);
  if (kind != Tok::Ampersand) return std::nullopt;
  return Instruction{IlKind::Binary, BinaryOp::And, 0};
}

}  // namespace

IlParser::IlParser(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics)
    : StatementParser(tree, names, sources, file, dialect, diagnostics) {
  const std::string_view path = sources.path(file);
  il_file_ = path.size() > 3 && sameIdentifier(path.substr(path.size() - 3), ".il");
}

bool beginsIl(Tok kind, std::string_view text, const Token& next) {
  if (!isName(kind) || (next.flags & kLineStart) != 0) return false;
  const std::optional<Instruction> word = findInstruction(text);
  return word && (isName(next.kind) || next.kind == Tok::Number || next.kind == Tok::True || next.kind == Tok::False ||
                  next.kind == Tok::Address);
}

// Tells whether an instruction may begin here, judged by its first token only.
bool IlParser::isInstruction(const Token* t) const {
  if (t->kind == Tok::RightParen) return true;
  if (isName(t->kind) && t[1].kind == Tok::Colon) return true;
  return instructionAt(t->kind, textOf(t)).has_value();
}

// `LD x`, `JMP done`, `RET` on its own line, but not the statements `LD := 1;` and `AND(a, b);`.
bool IlParser::isPlainInstruction(const Token* t) const {
  const std::optional<Instruction> word = instructionAt(t->kind, textOf(t));
  if (!word) return false;
  const Token* next = t + 1;
  const bool alone = (next->flags & kLineStart) != 0 || next->kind == Tok::End;
  const bool operand = !alone && next->kind != Tok::LeftParen && t[2].kind != Tok::Equal &&  // not `r REF= x`
                       (isOperand(next->kind) || next->kind == Tok::Minus || next->kind == Tok::Plus);
  switch (word->kind) {
    case IlKind::Load:
    case IlKind::Call: return operand || (alone && next->kind != Tok::Assign);
    case IlKind::Store:
      if (next->kind == Tok::Question) return true;
      [[fallthrough]];
    case IlKind::Set:
    case IlKind::Reset:
    case IlKind::Binary: return operand;
    case IlKind::Not:
    case IlKind::Return: return alone;
    case IlKind::Jump:  // in ST a `;` would follow
      return operand && ((t[2].flags & kLineStart) != 0 || t[2].kind == Tok::End) &&
             (word->flags != 0 || isInstruction(t + 2) || isReserved(t[2].kind) || t[2].kind == Tok::End);
    case IlKind::Label:
    case IlKind::Close:
    case IlKind::Function: break;
  }
  return false;
}

// Tells whether the body that begins here is in IL, decided by its first instruction. In a .il file a body is IL unless
// it can only be ST.
bool IlParser::atIl() const {
  const Token* t = t_;
  while (isName(t->kind) && t[1].kind == Tok::Colon && !isTypeWord(t[2].kind)) t += 2;
  if (isPlainInstruction(t)) return true;
  if (isName(t->kind) && t[1].kind == Tok::Assign) return false;
  // A malformed first line does not make the other lines ST.
  const auto ends = [](Tok k) {
    return k == Tok::End || k == Tok::Semicolon || k == Tok::EndTransition || k == Tok::EndStep ||
           (isReserved(k) && !isInfix(k) && k != Tok::Not && k != Tok::Jmp && k != Tok::True && k != Tok::False);
  };
  // A line of an ST expression may begin with AND, OR, XOR or MOD.
  for (const Token* line = t; line - t < 200 && !ends(line->kind); ++line)
    if ((line->flags & kLineStart) != 0 && line != t && !isInfix(line->kind) &&
        beginsIl(line->kind, textOf(line), line[1]))
      return true;
  if (il_file_ && (isName(t->kind) || isInstruction(t))) {
    while (t->kind != Tok::Semicolon && t->kind != Tok::End && (t[1].flags & kLineStart) == 0) ++t;
    return t->kind != Tok::Semicolon;
  }
  // A function that does not read the accumulator: `MAX(IN1 := a, IN2 := b)`, `ST x` on the next line.
  if (!isName(t->kind)) return false;
  ++t;
  uint32_t open = 0;
  for (const Token* first = t; t - first < 2000 && t->kind != Tok::Semicolon && t->kind != Tok::End; ++t) {
    if (open == 0 && (t->flags & kLineStart) != 0) break;
    if (t->kind == Tok::LeftParen) ++open;
    if (t->kind == Tok::RightParen && open > 0) --open;
  }
  return open == 0 && !isInfix(t->kind) && isPlainInstruction(t);
}

// instructions = {instruction}: up to the end of the body, or of the `(` around a nested list.
Slice<IlInstruction> IlParser::parseIl(bool nested) {
  const size_t first = il_.size(), first_open = il_open_.size();
  const size_t outside = std::exchange(il_outside_, first_open);
  const bool outer = in_il_;
  in_il_ = true;
  while (!atBlockEnd() && !(nested && at(Tok::RightParen) && il_open_.size() == first_open)) {
    const Token* before = t_;
    if (at(Tok::RightParen) && il_open_.size() == first_open) {
      slip(diag::StrayParen, t_, {")"});
      advance();
      continue;
    }
    if (atSection()) {
      if (!declared_in_body_) slip(diag::DeclarationInBody, t_);
      declared_in_body_ = true;
      parseSection();
      continue;
    }
    if (statementInIl()) {
      il_.resize(first);
      il_open_.resize(first_open);
      break;
    }
    parseInstruction();
    endInstruction();
    if (t_ == before) advance();
  }
  while (il_open_.size() > first_open) {  // closed here, so that the scheduler can rely on it
    const Token* open = il_open_.back();
    il_open_.pop_back();
    slip(diag::IlParenOpen, open, {textOf(open)});
    for (size_t k = il_.size(); k-- > first;) {
      IlInstruction& deferred = il_[k];
      if ((deferred.flags & kIlDeferred) == 0 || deferred.loc != loc(open)) continue;
      deferred.flags &= static_cast<uint8_t>(~kIlDeferred);
      deferred.operands = unknownOperand(deferred.loc);
      break;
    }
  }
  in_il_ = outer;
  il_outside_ = outside;
  return listFrom(il_, first);
}

// instruction = [label ":"] [operator ["?"] operands | name operands | ")"]
void IlParser::parseInstruction() {
  IlInstruction i{};
  i.kind = IlKind::Label;
  if (peek() == Tok::Colon && (isName(kind()) || nameReserved(t_))) {
    if (!isName(kind())) slip(diag::ReservedName, t_, {textOf(t_)});
    i.label = isName(kind()) ? ident(t_) : Ident{names_.intern(textOf(t_)), here()};
    advance();
    advance();
    const bool closes = at(Tok::RightParen) && il_open_.size() == il_outside_;
    if (atLineStart() || atBlockEnd() || peek() == Tok::Colon || closes) {
      i.loc = i.label.loc;
      il_.push_back(i);
      return;
    }
  }
  const Token* op = t_;
  std::optional<Instruction> word = instructionAt(kind(), textOf(t_));
  i.loc = here();
  i.word = isName(kind()) ? nameOf(t_) : names_.intern(textOf(t_));
  if (at(Tok::RightParen)) {
    advance();
    i.kind = IlKind::Close;
    il_open_.pop_back();
  } else if (word && peek() != Tok::Assign && peek() != Tok::Dot) {
    advance();
    if (op->kind == Tok::Ampersand && at(Tok::Ident) && is(t_, "N") && t_->offset == op->offset + 1) {
      word->flags = kIlNegated;
      advance();
    }
    const bool attempt = word->kind == IlKind::Store && accept(Tok::Question);
    i.kind = word->kind;
    i.op = word->op;
    i.flags = attempt ? uint8_t{kIlAttempt} : word->flags;
    parseOperands(i, op);
  } else if (isName(kind())) {
    i.kind = IlKind::Function;
    i.callee = parseIlCallee();
    parseOperands(i, op);
  } else {
    fail(diag::NotAnInstruction, t_, {describe(t_)});
    i.kind = IlKind::Load;  // of an unknown value
  }
  if (panic_) resynchronize(i);
  if (i.kind != IlKind::Label || i.label.name) il_.push_back(i);
}

// An error in it has been reported; a placeholder operand prevents follow-up errors.
void IlParser::resynchronize(IlInstruction& i) {
  if (i.kind == IlKind::Jump || i.kind == IlKind::Call) i.kind = IlKind::Label;  // its label is valid all the same
  if (i.kind == IlKind::Label || !i.operands.empty() || (i.flags & kIlDeferred) != 0) return;
  i.operands = unknownOperand(i.loc);
}

// After an instruction: the end of its line. Anything else is skipped and reported once.
void IlParser::endInstruction() {
  if (!panic_ && !atLineStart() && !atBlockEnd() && !at(Tok::RightParen)) {
    if (isPlainInstruction(t_) || (il_open_.size() > 0 && isInstruction(t_))) {
      if (!il_line_reported_)
        diagnostics_.report(diag::InstructionsOnLine, here())
            .fix({"Begin a line", {{here(), here(), "\n" + std::string(indentOf(source_, t_->offset))}}, false});
      il_line_reported_ = true;
      return;
    }
    if (isInfix(kind()))
      fail(diag::IlExpression, t_, {textOf(t_)});
    else
      fail(diag::AfterInstruction, t_, {describe(t_)});
  }
  if (!panic_) return;
  panic_ = false;
  size_t open = 0;
  const Token* last = t_;
  for (; !atBlockEnd() && !atLineStart(); advance()) {
    if (at(Tok::LeftParen)) ++open;
    if (at(Tok::RightParen) && open > 0) --open;
    last = t_;
  }
  for (; open > 0; --open) {  // its `)` may follow
    IlInstruction defer{};
    defer.kind = IlKind::Binary;
    defer.op = BinaryOp::And;
    defer.flags = kIlDeferred;
    defer.loc = loc(last);
    defer.word = names_.intern("(");
    defer.operands = unknownOperand(defer.loc);
    il_.push_back(defer);
    il_open_.push_back(last);
  }
}

// operands = nothing | label (of a jump) | callee ["(" pins ")"] (of a call) | "(" … ")" | list
void IlParser::parseOperands(IlInstruction& i, const Token* op) {
  switch (i.kind) {
    case IlKind::Not:
    case IlKind::Return:
    case IlKind::Label:
    case IlKind::Close: return;
    case IlKind::Jump:
      if (atLineStart() || atBlockEnd())
        fail(diag::IlOperandMissing, op, {textOf(op)});
      else
        parseName(i.target);
      return;
    case IlKind::Call:
      if (atLineStart() || atBlockEnd()) {
        fail(diag::IlOperandMissing, op, {textOf(op)});
        return;
      }
      if (!isName(kind())) {
        fail(diag::MissingName, t_, {describe(t_)});
        return;
      }
      i.callee = parseIlCallee();
      if (at(Tok::LeftParen) && !panic_) parseIlPins(i);
      return;
    case IlKind::Binary:
    case IlKind::Function:
      if (at(Tok::LeftParen) && (!atLineStart() || op + 1 == t_)) return parseIlParens(i, op);
      break;
    case IlKind::Load:
    case IlKind::Store:
    case IlKind::Set:
    case IlKind::Reset: break;
  }
  const bool none = atLineStart() || atBlockEnd() || at(Tok::RightParen);
  if (none) {
    if (i.kind != IlKind::Function) fail(diag::IlOperandMissing, op, {textOf(op)});
    return;
  }
  parseIlList(i, op);
}

// operand {"," operand}
void IlParser::parseIlList(IlInstruction& i, const Token* op) {
  const size_t first = arguments_.size();
  const bool several = i.kind == IlKind::Function || (i.kind == IlKind::Binary && takesSeveral(i.op));
  do {
    if (arguments_.size() > first && !several) {
      fail(diag::IlOperandCount, t_, {textOf(op)});
      break;
    }
    Argument a{};
    a.loc = here();
    a.value = parseUnary();
    arguments_.push_back(a);
  } while (!panic_ && accept(Tok::Comma));
  i.operands = listFrom(arguments_, first);
}

// callee = name {"." name | "[" expr {"," expr} "]"}, without its arguments
ExprId IlParser::parseIlCallee() {
  const Loc start = here();
  height_ = 1;
  ExprId base;
  if ((at(Tok::This) || at(Tok::Super)) && (peek() == Tok::Dot || peek() == Tok::Caret)) {
    base = at(Tok::This) ? build_.thisObject(start) : build_.superObject(start);
  } else {
    base = build_.name(nameOf(t_), start);
  }
  advance();
  return parsePostfix(ended(base), false);
}

// "(" arguments ")", which may hold lists of instructions.
void IlParser::parseIlPins(IlInstruction& i) {
  const size_t nested = il_nested_.size();
  Loc end;
  i.flags |= kIlFormal | kIlInParens;
  i.operands = parseArguments(end);
  i.nested = listFrom(il_nested_, nested);
}

// "(" pins ")" | "(" list ")" | "(" [unary]: after an operator or a function; the last one defers it up to its `)`.
void IlParser::parseIlParens(IlInstruction& i, const Token* op) {
  const Token* first = t_ + 1;
  const Token* pin = first->kind == Tok::Not ? first + 1 : first;
  const bool formal = first->kind == Tok::RightParen || ((isName(pin->kind) || isTypeWord(pin->kind)) &&
                                                         (pin[1].kind == Tok::Assign || pin[1].kind == Tok::Arrow));
  if (formal) {
    if (i.kind == IlKind::Binary) {  // ADD(IN1 := a, IN2 := b): the function of that name
      if (first->kind == Tok::RightParen) {
        fail(diag::IlOperandMissing, op, {textOf(op)});
        return;
      }
      i.kind = IlKind::Function;
      i.callee = build_.name(names_.intern(textOf(op)), loc(op));
    }
    return parseIlPins(i);
  }
  if (listFollows(first)) {
    advance();
    i.flags |= kIlInParens;
    parseIlList(i, op);
    closeParen(Tok::RightParen, true);
    return;
  }
  il_open_.push_back(op);
  advance();
  i.flags |= kIlDeferred;
  if (atLineStart() || atBlockEnd()) return;
  const size_t arguments = arguments_.size();
  Argument a{};
  a.loc = here();
  a.value = parseUnary();
  arguments_.push_back(a);
  i.operands = listFrom(arguments_, arguments);
}

// `(a, b)` or `(a)`, but not `(a` followed by instructions.
bool IlParser::listFollows(const Token* first) const {
  uint32_t open = 0;
  for (const Token* t = first; t - first < 2000 && t->kind != Tok::End; ++t) {
    if (open == 0 && t != first) {
      const Tok before = t[-1].kind;
      if ((t->flags & kLineStart) != 0 && before != Tok::Comma && t->kind != Tok::Comma) return false;
      if (endsOperand(before) &&
          (endsOperand(t->kind) || t->kind == Tok::And || t->kind == Tok::Or || t->kind == Tok::Xor ||
           t->kind == Tok::Not || t->kind == Tok::Mod) &&
          t->kind != Tok::RightParen && t->kind != Tok::RightBracket && t->kind != Tok::Caret)
        return false;
      if (t->kind == Tok::Comma) return true;
    }
    if (t->kind == Tok::LeftParen || t->kind == Tok::LeftBracket) ++open;
    if (t->kind == Tok::RightParen || t->kind == Tok::RightBracket) {
      if (open == 0) return t != first;
      --open;
    }
  }
  return false;
}

// `pin := (LD a  AND b)`: the value is the accumulator at the end of the list.
bool IlParser::atNestedIl() const { return in_il_ && at(Tok::LeftParen) && (isPlainInstruction(t_ + 1)); }

// "(" instructions ")" as a value
void IlParser::parseNestedIl(uint32_t operand) {
  if (++expr_depth_ > kMaxExprDepth) {
    tooDeep("parentheses", kMaxExprDepth);
    --expr_depth_;
    return;
  }
  advance();
  const Slice<IlInstruction> list = parseIl(true);
  il_nested_.push_back({operand, list});
  expect(Tok::RightParen);
  --expr_depth_;
}

// A list in parentheses without `)` ends where the next instruction begins.
void IlParser::closeIlParen(Tok close) {
  if (!panic_) {
    if (accept(close)) return;
    if (atLineStart() || atBlockEnd())
      missing(diag::MissingToken, {spelling(close), describe(t_)});
    else
      fail(diag::NotInArguments, t_, {describe(t_)});
  }
  const Skipping skipping(*this);
  while (!atBlockEnd() && !at(Tok::RightParen) && !(atLineStart() && isInstruction(t_))) advance();
  if (at(Tok::RightParen)) advance();
  panic_ = false;
}

// Statements among the instructions: one error for the whole body, since their effect is unknown.
bool IlParser::statementInIl() {
  const Token* t = t_;
  const bool word = isReserved(t->kind) && !instructionAt(t->kind, textOf(t)) && t[1].kind != Tok::Colon;
  while (isName(t->kind) && (t[1].kind == Tok::Dot || t[1].kind == Tok::Caret) && isName(t[2].kind)) t += 2;
  if (!word && !(isName(t->kind) && t[1].kind == Tok::Assign)) return false;
  slip(diag::StatementInIl, t_, {textOf(t_)});
  skipBody();
  return true;
}

// Instructions among the statements of a body that began in ST: one error for all of them.
bool IlParser::instructionInSt() {
  if (!isPlainInstruction(t_)) return false;
  slip(diag::InstructionInSt, t_, {textOf(t_)});
  skipBody();
  return true;
}

}  // namespace rung::text

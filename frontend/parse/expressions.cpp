// Expressions: precedence climbing over kOperators, postfix chains, literals and arguments.
#include <algorithm>
#include <array>
#include <cstring>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parser.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/standard_names.h"

namespace rung::text {
namespace {

struct Operator {
  uint8_t precedence = 0;  // 0: not an operator
  BinaryOp op = BinaryOp::Or;
};
constexpr uint32_t kPowerPrecedence = 8;

// expr = or {...}; weakest first: OR, XOR, AND, = <>, < > <= >=, + -, * / MOD, **. All associate to the left.
constexpr std::array<Operator, kTokCount> makeOperators() {
  std::array<Operator, kTokCount> t{};
  const auto set = [&](Tok tok, uint8_t precedence, BinaryOp op) { t[static_cast<size_t>(tok)] = {precedence, op}; };
  set(Tok::Or, 1, BinaryOp::Or);
  set(Tok::OrElse, 1, BinaryOp::OrElse);
  set(Tok::BarTwice, 1, BinaryOp::Or);
  set(Tok::Bar, 1, BinaryOp::Or);
  set(Tok::Xor, 2, BinaryOp::Xor);
  set(Tok::And, 3, BinaryOp::And);
  set(Tok::AndThen, 3, BinaryOp::AndThen);
  set(Tok::Ampersand, 3, BinaryOp::And);
  set(Tok::AmpersandTwice, 3, BinaryOp::And);
  set(Tok::Equal, 4, BinaryOp::Equal);
  set(Tok::EqualEqual, 4, BinaryOp::Equal);
  set(Tok::NotEqual, 4, BinaryOp::NotEqual);
  set(Tok::BangEqual, 4, BinaryOp::NotEqual);
  set(Tok::Less, 5, BinaryOp::Less);
  set(Tok::LessEqual, 5, BinaryOp::LessEqual);
  set(Tok::EqualLess, 5, BinaryOp::LessEqual);
  set(Tok::Greater, 5, BinaryOp::Greater);
  set(Tok::GreaterEqual, 5, BinaryOp::GreaterEqual);
  set(Tok::Plus, 6, BinaryOp::Add);
  set(Tok::Minus, 6, BinaryOp::Subtract);
  set(Tok::Star, 7, BinaryOp::Multiply);
  set(Tok::Slash, 7, BinaryOp::Divide);
  set(Tok::Mod, 7, BinaryOp::Modulo);
  set(Tok::Percent, 7, BinaryOp::Modulo);
  set(Tok::Power, kPowerPrecedence, BinaryOp::Power);
  return t;
}
constexpr std::array<Operator, kTokCount> kOperators = makeOperators();

// The ST operator for an operator of another language.
const char* nativeOperator(Tok kind) {
  switch (static_cast<int>(kind)) {
    case static_cast<int>(Tok::EqualEqual): return "=";
    case static_cast<int>(Tok::BangEqual): return "<>";
    case static_cast<int>(Tok::Bang): return "NOT";
    case static_cast<int>(Tok::AmpersandTwice): return "AND";
    case static_cast<int>(Tok::BarTwice):
    case static_cast<int>(Tok::Bar): return "OR";
    case static_cast<int>(Tok::Percent): return "MOD";
    case static_cast<int>(Tok::EqualLess): return "<=";
    default: return nullptr;
  }
}

}  // namespace

bool Parser::isOperand(Tok kind) const {
  return (kind >= Tok::Number && kind <= Tok::Ident) || isName(kind) || isTypeWord(kind) || kind == Tok::True ||
         kind == Tok::False || kind == Tok::Null || kind == Tok::LeftParen || kind == Tok::Not;
}

ExprId Parser::parseExpr(uint32_t least) {
  ExprId left = parseUnary();
  uint32_t height = height_;
  for (;;) {
    const Operator row = kOperators[static_cast<size_t>(t_->kind)];
    if (row.precedence < least || row.precedence == 0) {
      height_ = height;
      return left;
    }
    const Token* op = t_;
    if (height >= kMaxExprHeight) {
      tooDeep("operators", kMaxChain);
      height_ = height;
      return left;
    }
    if (op->kind >= Tok::EqualEqual && op->kind <= Tok::EqualLess)
      slip(diag::ForeignOperator, op, {spelling(op->kind), nativeOperator(op->kind)});
    advance();
    // The value is missing: the next line begins with a new statement.
    if (atLineStart() && !panic_ && isName(kind()) && peek() == Tok::Assign) {
      fail(diag::MissingValueAfter, op, {describe(op)});
      return errorExpr(loc(op));
    }
    const ExprId right = parseExpr(row.precedence + 1u);
    height = std::max(height, height_) + 1;
    if (height > kMaxExprHeight + 1) {
      tooDeep("operators", kMaxChain);
      height_ = 1;
      return errorExpr(loc(op));
    }
    if (row.op == BinaryOp::Power && dialect_ != Dialect::Codesys && tree_.kind(left) == ExprKind::Unary &&
        tree_.expr(left).in_parens == 0 && tree_.as<UnaryExpr>(left).op() == UnaryOp::Negate)
      diagnostics_.report(diag::NegatedPower, tree_.loc(left), {"tighter"});
    left =
        tree_.add<ExprId>(BinaryExpr{exprHeader(ExprKind::Binary, loc(op), static_cast<uint8_t>(row.op)), left, right});
  }
}

// unary = ["-" | "+" | NOT] operand. In codesys `**` binds tighter than the sign, in the standard weaker.
ExprId Parser::parseUnary() {
  UnaryOp op;
  switch (static_cast<int>(kind())) {
    case static_cast<int>(Tok::Minus): op = UnaryOp::Negate; break;
    case static_cast<int>(Tok::Plus): op = UnaryOp::Plus; break;
    case static_cast<int>(Tok::Bang): slip(diag::ForeignOperator, t_, {"!", "NOT"}); [[fallthrough]];
    case static_cast<int>(Tok::Not):
      // NOT(EN := x, IN := y): the functional form, with pins
      if (peek() == Tok::LeftParen && peek(3) == Tok::Assign && (is(t_ + 2, kEnable) || is(t_ + 2, "IN"))) {
        return parsePrimary();
      }
      op = UnaryOp::Not;
      break;
    default: return parsePrimary();
  }
  const Loc start = here();
  if (++expr_depth_ > kMaxExprDepth) {
    tooDeep("expressions", kMaxExprDepth);
    --expr_depth_;
    return errorExpr(start);
  }
  advance();
  const ExprId operand = dialect_ == Dialect::Codesys ? parseExpr(kPowerPrecedence) : parseUnary();
  --expr_depth_;
  if (++height_ > kMaxExprHeight + 1) {
    tooDeep("operators", kMaxChain);
    height_ = 1;
    return errorExpr(start);
  }
  if (op == UnaryOp::Negate && tree_.kind(operand) == ExprKind::Binary && tree_.expr(operand).in_parens == 0)
    diagnostics_.report(diag::NegatedPower, start, {"looser"});
  return tree_.add<ExprId>(UnaryExpr{exprHeader(ExprKind::Unary, start, static_cast<uint8_t>(op)), operand});
}

ExprId Parser::parsePrimary() {
  const Loc start = here();
  height_ = 1;
  switch (static_cast<int>(kind())) {
    case static_cast<int>(Tok::Number): return parseNumber({}, false, start);
    case static_cast<int>(Tok::StringLiteral):
    case static_cast<int>(Tok::WideStringLiteral): return parseStringLiteral({}, start);
    case static_cast<int>(Tok::Duration):
    case static_cast<int>(Tok::Date):
    case static_cast<int>(Tok::TimeOfDay):
    case static_cast<int>(Tok::DateTime): return parseTime();
    case static_cast<int>(Tok::True):
    case static_cast<int>(Tok::False): {
      const bool value = at(Tok::True);
      advance();
      return boolLiteral(value, {}, start);
    }
    case static_cast<int>(Tok::Null): {
      advance();
      return tree_.add<ExprId>(
          LiteralExpr{exprHeader(ExprKind::Literal, start, static_cast<uint8_t>(LiteralKind::Null)), {}, 0, 0});
    }
    case static_cast<int>(Tok::Address): return parsePostfix(parseAddress());
    case static_cast<int>(Tok::LeftParen): {
      if (++expr_depth_ > kMaxExprDepth) {
        tooDeep("parentheses", kMaxExprDepth);
        --expr_depth_;
        return errorExpr(start);
      }
      advance();
      ExprId inner = parseExpr();
      if (at(Tok::Assign)) inner = parseCompared(inner);
      closeParen(Tok::RightParen, false);
      --expr_depth_;
      tree_.expr(inner).in_parens = 1;
      return parsePostfix(inner);
    }
    default: break;
  }
  if (isName(kind()) || isTypeWord(kind())) {
    if (peek() == Tok::Hash) return parseTyped();
    if ((at(Tok::This) || at(Tok::Super)) && peek() != Tok::LeftParen) {
      const bool is_this = at(Tok::This);
      advance();
      return parsePostfix(is_this ? tree_.add<ExprId>(ThisExpr{exprHeader(ExprKind::This, start)})
                                  : tree_.add<ExprId>(SuperExpr{exprHeader(ExprKind::Super, start)}));
    }
    if (names_.same(nameOf(t_), eno_)) eno_used_ = true;
    const ExprId name = tree_.add<ExprId>(NameExpr{exprHeader(ExprKind::Name, start), nameOf(t_), {}});
    advance();
    const Tok next = kind();
    if (next == Tok::Dot || next == Tok::LeftParen || next == Tok::LeftBracket || next == Tok::Caret)
      return parsePostfix(name);
    return name;
  }
  // The functional form of operators that are keywords: AND(a, b)
  if ((at(Tok::And) || at(Tok::Or) || at(Tok::Xor) || at(Tok::Mod) || at(Tok::Not)) && peek() == Tok::LeftParen) {
    const ExprId name = tree_.add<ExprId>(NameExpr{exprHeader(ExprKind::Name, start), names_.intern(textOf(t_)), {}});
    advance();
    return parsePostfix(name);
  }
  if (at(Tok::Error)) {
    last_error_ = t_;
    advance();
    panic_ = true;
    return errorExpr(start);
  }
  // At the start of a line, the error is at the end of the line above.
  const Token* before = t_ - 1;
  const bool is_punctuation = kind() > Tok::Semicolon && kind() <= Tok::EqualLess;
  if (((atLineStart() && !is_punctuation) || at(Tok::End)) && index() > 0 && before->kind != Tok::Semicolon)
    fail(diag::MissingValueAfter, before, {describe(before)});
  else
    fail(diag::MissingValue, t_, {describe(t_)});
  return errorExpr(start);
}

// postfix = {"." (name | bit | "%X" bit) | "[" expr {"," expr} "]" | "^" | "(" arguments ")"}; without `calls` it ends
// at a `(`.
ExprId Parser::parsePostfix(ExprId base, bool calls) {
  uint32_t height = height_;
  for (;; ++height) {
    height_ = height;
    const Tok next = kind();
    if (next != Tok::Dot && next != Tok::LeftParen && next != Tok::LeftBracket && next != Tok::Caret) return base;
    if (next == Tok::LeftParen && !calls) return base;
    if (height >= kMaxExprHeight) {
      tooDeep("accesses", kMaxChain);
      return base;
    }
    switch (static_cast<int>(next)) {
      case static_cast<int>(Tok::Dot): {
        const Token* dot = t_;
        advance();
        const Loc at_member = here();
        const bool same_line = !atLineStart();
        if (isName(kind()) || isNullName(t_) || (isTypeWord(kind()) && same_line)) {
          base = tree_.add<ExprId>(MemberExpr{exprHeader(ExprKind::Member, at_member), base, nameOf(t_), {}});
          advance();
        } else if (at(Tok::Number)) {
          NumberValue value;
          const std::string_view digits = textOf(t_);
          if (readNumber(digits, at_member, diagnostics_, value) &&
              (value.is_real || value.is_based || value.integer > 63))
            fail(diag::MissingName, t_, {describe(t_)});
          base = tree_.add<ExprId>(BitAccessExpr{exprHeader(ExprKind::BitAccess, at_member), base,
                                                 static_cast<uint32_t>(value.integer & 63), 1});
          advance();
        } else if (at(Tok::Address)) {
          // %X3 %B1 %W0 %D0; the lexer reads the `.7` of `%B1.7` as part of an address
          const std::string_view token = textOf(t_);
          const std::string_view part = token.substr(0, token.find('.'));
          const std::string_view bit = token.substr(std::min(part.size() + 1, token.size()));
          const char size = part.size() > 2 ? static_cast<char>(part[1] & ~0x20) : '\0';
          const uint32_t width = size == 'X' ? 1 : size == 'B' ? 8 : size == 'W' ? 16 : size == 'D' ? 32 : 0;
          uint32_t position = 0;
          bool ok = width != 0 && part.size() <= 4;
          for (char c : part.substr(ok ? 2 : part.size())) {
            ok = ok && c >= '0' && c <= '9';
            position = position * 10 + static_cast<uint32_t>(c - '0');
          }
          ok = ok && bit.size() <= 2 && bit.find_first_not_of("0123456789") == std::string_view::npos;
          ok = ok && token.size() == part.size() + (bit.empty() ? 0 : bit.size() + 1);
          if (!ok) fail(diag::AddressForm, t_, {token});
          base = tree_.add<ExprId>(BitAccessExpr{exprHeader(ExprKind::BitAccess, at_member), base, ok ? position : 0,
                                                 static_cast<uint8_t>(ok ? width : 1)});
          if (ok && !bit.empty()) {
            uint32_t number = 0;
            for (const char c : bit) number = number * 10 + static_cast<uint32_t>(c - '0');
            const Loc at_bit = Loc{at_member.offset + static_cast<uint32_t>(part.size()) + 1};
            base = tree_.add<ExprId>(BitAccessExpr{exprHeader(ExprKind::BitAccess, at_bit), base, number, 1});
          }
          advance();
        } else {
          if (same_line)
            fail(diag::MissingName, t_, {describe(t_)});
          else
            fail(diag::MissingName, dot, {describe(dot)});
          return errorExpr(loc(dot));
        }
        break;
      }
      case static_cast<int>(Tok::LeftBracket): {
        const Loc start = tree_.loc(base);
        if (++expr_depth_ > kMaxExprDepth) {
          tooDeep("indices", kMaxExprDepth);
          --expr_depth_;
          return base;
        }
        advance();
        const size_t first = exprs_.size();
        do {
          exprs_.push_back(parseExpr());
          height = std::max(height, height_);
        } while (!panic_ && accept(Tok::Comma));
        closeParen(Tok::RightBracket, false);
        --expr_depth_;
        base = tree_.add<ExprId>(IndexExpr{exprHeader(ExprKind::Index, start), base, listFrom(exprs_, first)});
        break;
      }
      case static_cast<int>(Tok::Caret):
        base = tree_.add<ExprId>(DerefExpr{exprHeader(ExprKind::Deref, here()), base});
        advance();
        break;
      default: {
        const Loc start = tree_.loc(base);
        if (++expr_depth_ > kMaxExprDepth) {
          tooDeep("calls", kMaxExprDepth);
          --expr_depth_;
          return base;
        }
        Loc end;
        height_ = 0;
        if (isNew(base)) {
          base = parseNew(base);
          height = std::max(height, height_);
          --expr_depth_;
          break;
        }
        const Slice<Argument> arguments = parseArguments(end);
        height = std::max(height, height_);
        --expr_depth_;
        base = tree_.add<ExprId>(CallExpr{exprHeader(ExprKind::Call, start), base, arguments, end, {}});
        break;
      }
    }
  }
}

bool Parser::isNew(ExprId callee) const {
  return tree_.kind(callee) == ExprKind::Name &&
         sameIdentifier(names_.string(tree_.as<NameExpr>(callee).name), "__NEW");
}

// new = "__NEW" "(" type ["," expr] ")"
ExprId Parser::parseNew(ExprId callee) {
  NewExpr node{};
  node.h = exprHeader(ExprKind::New, tree_.loc(callee));
  advance();
  const bool was_in_variable = in_variable_;
  in_variable_ = true;  // after the name of a block type come arguments of FB_Init
  node.allocated = parseType();
  in_variable_ = was_in_variable;
  if (!panic_ && accept(Tok::Comma)) node.count = parseExpr();
  closeParen(Tok::RightParen, false);
  return tree_.add<ExprId>(node);
}

// arguments = "(" [argument {"," argument} [","]] ")"
// argument  = expr | name ":=" [expr] | [NOT] name "=>" [target]
Slice<Argument> Parser::parseArguments(Loc& end) {
  const size_t first = arguments_.size();
  uint32_t height = 0;
  advance();
  bool open = !at(Tok::RightParen);
  while (open) {
    Argument a{};
    a.loc = here();
    const bool negated = at(Tok::Not) && (isName(peek()) || isTypeWord(peek())) && peek(2) == Tok::Arrow;
    const Token* pin = negated ? t_ + 1 : t_;
    Tok binder = pin[1].kind;
    if (binder == Tok::Colon && isName(pin->kind)) {  // `IN : TRUE`
      slip(diag::WrongKeyword, pin + 1, {":", ":="});
      binder = Tok::Assign;
    }
    if ((isName(pin->kind) || isTypeWord(pin->kind)) && (binder == Tok::Assign || binder == Tok::Arrow)) {
      a.pin = ident(pin);
      a.negated = negated;
      a.is_output = binder == Tok::Arrow;
      t_ = const_cast<Token*>(pin) + 2;
      if (at(Tok::Comma) || at(Tok::RightParen)) {
        if (dialect_ != Dialect::Codesys) slip(diag::EmptyBinding, pin, {textOf(pin)});
      } else if (atNestedIl()) {
        parseNestedIl(static_cast<uint32_t>(arguments_.size() - first));
      } else {
        a.value = parseExpr();
      }
    } else {
      a.value = parseExpr();
    }
    height = std::max(height, height_);
    arguments_.push_back(a);
    if (at(Tok::With) && !panic_) {  // PROGRAM p : Main (block WITH task)
      const ExprId block = a.value;
      const bool named = block && tree_.kind(block) == ExprKind::Name && !a.pin.name;
      if (!in_program_instance_ || !named || !isName(peek())) fail(diag::StrayToken, t_, {describe(t_)});
      arguments_.pop_back();
      advance();
      if (!panic_) {
        block_tasks_.push_back({tree_.as<NameExpr>(block).name, a.loc});
        block_tasks_.push_back(ident(t_));
        advance();
      }
    }
    if (!panic_) {
      if (at(Tok::RightParen)) break;
      if (at(Tok::Comma)) {
        if (peek() == Tok::RightParen) {
          if (dialect_ == Dialect::Codesys)
            diagnostics_.report(diag::TrailingCommaWarning, here());
          else
            slip(diag::TrailingComma, t_);
          advance();
          break;
        }
        advance();
        continue;
      }
      // `f(a := 1; b := 2)`
      if (at(Tok::Semicolon) && isName(peek()) && (peek(2) == Tok::Assign || peek(2) == Tok::Arrow)) {
        const Token* t = t_ + 1;
        while (t->kind != Tok::Semicolon && t->kind != Tok::RightParen && t->kind != Tok::End &&
               (t->flags & kLineStart) == 0)
          ++t;
        if (t->kind == Tok::RightParen) {
          slip(diag::WrongKeyword, t_, {";", ","});
          advance();
          continue;
        }
      }
      // `f(a b)` and, over lines, `f(a := 1 <line end> b := 2)`: the comma is missing if the list is closed later.
      bool closes = false;
      if (isOperand(kind())) {
        uint32_t depth = 0;
        for (const Token* t = t_; t->kind != Tok::Semicolon && t->kind != Tok::End && !isReserved(t->kind); ++t) {
          if (t->kind == Tok::LeftParen) ++depth;
          if (t->kind == Tok::RightParen && depth-- == 0) {
            closes = true;
            break;
          }
          if (t - t_ > 2000) break;
        }
      }
      if (closes) {
        if (atLineStart())
          missing(diag::MissingToken, {",", describe(t_)});
        else
          slip(diag::MissingToken, t_, {",", describe(t_)});
        continue;
      }
      if (at(Tok::Assign) || at(Tok::Arrow)) fail(diag::NotInArguments, t_, {describe(t_)});
    }
    break;
  }
  end = here();
  closeParen(Tok::RightParen, true);
  height_ = height;
  return listFrom(arguments_, first);
}

// `:=` after a condition or in parentheses most likely means `=`, and is parsed as `=`.
ExprId Parser::parseCompared(ExprId left) {
  if (!at(Tok::Assign) || panic_) return left;
  const Loc op = here();
  const uint32_t height = height_;
  slip(diag::CompareWithAssign, t_);
  advance();
  const ExprId right = parseExpr();
  height_ = std::max(height, height_) + 1;
  return tree_.add<ExprId>(
      BinaryExpr{exprHeader(ExprKind::Binary, op, static_cast<uint8_t>(BinaryOp::Equal)), left, right});
}

// Consumes the closing bracket; if it is missing, reports it and finds the resynchronization point.
void Parser::closeParen(Tok close, bool is_arguments) {
  if (in_il_) return closeIlParen(close);
  if (!panic_) {
    if (accept(close)) return;
    const Tok k = kind();
    const bool ends = k == Tok::Semicolon || k == Tok::End || (isReserved(k) && !isOperand(k)) || startsStatement(t_);
    if (ends) {
      if (atLineStart() || k == Tok::End)
        missing(diag::MissingToken, {spelling(close), describe(t_)});
      else
        slip(diag::MissingToken, t_, {spelling(close), describe(t_)});
      return;
    }
    if (k == Tok::RightParen || k == Tok::RightBracket) {
      slip(diag::MissingToken, t_, {spelling(close), describe(t_)});
      if (k != Tok::RightParen || close != Tok::RightBracket) advance();
      return;
    }
    if (is_arguments)
      fail(diag::NotInArguments, t_, {describe(t_)});
    else if (isOperand(k))
      fail(diag::MissingOperator, t_, {describe(t_)});
    else
      fail(diag::MissingToken, t_, {spelling(close), describe(t_)});
  }
  // The closing partner, even on a later line, within the statement.
  uint32_t depth = 0;
  for (Token* t = t_; t - t_ < 5000; ++t) {
    const Tok k = t->kind;
    if (k == Tok::LeftParen || k == Tok::LeftBracket) ++depth;
    if (k == Tok::RightParen || k == Tok::RightBracket) {
      if (depth == 0 && k == close) {
        t_ = t + 1;
        panic_ = false;
        return;
      }
      if (depth == 0) break;
      --depth;
    }
    if (k == Tok::Semicolon || k == Tok::End ||
        (isReserved(k) && !isOperand(k) && kOperators[static_cast<size_t>(k)].precedence == 0))
      break;
  }
  depth = 0;
  for (;; advance()) {
    const Tok k = kind();
    if (k == Tok::LeftParen || k == Tok::LeftBracket) ++depth;
    if (k == Tok::RightParen || k == Tok::RightBracket) {
      if (depth == 0) {
        if (k == close) {
          advance();
          panic_ = false;
        }
        return;
      }
      --depth;
    }
    if (k == Tok::Semicolon || k == Tok::End ||
        (isReserved(k) && !isOperand(k) && kOperators[static_cast<size_t>(k)].precedence == 0))
      return;
    if (atLineStart() && startsStatement(t_)) return;
  }
}

ExprId Parser::boolLiteral(bool value, NameId prefix, Loc loc) {
  return tree_.add<ExprId>(LiteralExpr{exprHeader(ExprKind::Literal, loc, static_cast<uint8_t>(LiteralKind::Bool)),
                                       prefix, value ? 1u : 0u, 0});
}

// INT#-5  INT#16#FF  BOOL#TRUE  STRING#'x'  Color#Red
ExprId Parser::parseTyped() {
  const Token* type = t_;
  const Loc start = here();
  const NameId prefix = nameOf(t_);
  advance();
  advance();
  bool negative = false;
  if ((at(Tok::Minus) || at(Tok::Plus)) && peek() == Tok::Number) {
    negative = at(Tok::Minus);
    advance();
  }
  if (at(Tok::Number)) return parseNumber(prefix, negative, start);
  if (at(Tok::StringLiteral) || at(Tok::WideStringLiteral)) return parseStringLiteral(prefix, start);
  if (at(Tok::True) || at(Tok::False)) {
    const bool value = at(Tok::True);
    if (isTypeWord(type->kind) && type->kind != Tok::Bool) {
      slip(diag::LiteralPrefix, t_, {textOf(t_), textOf(type)});
      advance();
      return errorExpr(start);
    }
    advance();
    return boolLiteral(value, prefix, start);
  }
  if (isName(kind())) {
    const ExprId e =
        tree_.add<ExprId>(TypedNameExpr{exprHeader(ExprKind::TypedName, start), ident(type), ident(t_), {}});
    advance();
    return e;
  }
  fail(diag::MissingValue, t_, {describe(t_)});
  return errorExpr(start);
}

ExprId Parser::parseNumber(NameId prefix, bool negative, Loc start) {
  const Token* token = t_;
  advance();
  NumberValue value;
  if (!readNumber(textOf(token), loc(token), diagnostics_, value)) {
    last_error_ = token;
    return errorExpr(start);
  }
  uint8_t bits = static_cast<uint8_t>((negative ? kLiteralNegative : 0) | (value.is_based ? kLiteralBased : 0));
  if (prefix) {
    const Token* type = token - (negative || token[-1].kind == Tok::Plus ? 3 : 2);
    const bool is_real_type = type->kind == Tok::Real || type->kind == Tok::Lreal;
    if (type->kind == Tok::Bool && !value.is_real && value.integer <= 1 && !negative)
      return boolLiteral(value.integer != 0, prefix, start);
    if (is_real_type && !value.is_real && !value.is_based) {
      value.is_real = true;
      value.real = static_cast<double>(value.integer);
    }
    if (isTypeWord(type->kind) &&
        ((value.is_real && !is_real_type) || (is_real_type && value.is_based) || type->kind == Tok::Bool ||
         type->kind == Tok::String || type->kind == Tok::Wstring)) {
      slip(diag::LiteralPrefix, token, {textOf(token), textOf(type)});
      return errorExpr(start);
    }
    if (value.is_real && negative) value.real = -value.real;
  }
  LiteralExpr e{exprHeader(ExprKind::Literal, start,
                           static_cast<uint8_t>(value.is_real ? LiteralKind::Real : LiteralKind::Integer), bits),
                prefix, 0, 0};
  if (value.is_real) {
    uint64_t raw = 0;
    std::memcpy(&raw, &value.real, sizeof raw);
    e.setValue(raw);
  } else {
    e.setValue(value.integer);
  }
  return tree_.add<ExprId>(e);
}

// The string types of edition 4 and its short prefixes, with the keyword whose quotes they take.
struct StringPrefix {
  const char* word;
  const char* type;
  Tok quotes;
};
static constexpr StringPrefix kStringPrefixes[] = {
    {"S", "STRING", Tok::String},  {"W", "WSTRING", Tok::Wstring},      {"U", "USTRING", Tok::String},
    {"C", "CHAR", Tok::Char},      {"WC", "WCHAR", Tok::Wchar},         {"UC", "UCHAR", Tok::Char},
    {"UCHAR", "UCHAR", Tok::Char}, {"USTRING", "USTRING", Tok::String},
};

ExprId Parser::parseStringLiteral(NameId prefix, Loc start) {
  const Token* token = t_;
  advance();
  bool wide = token->kind == Tok::WideStringLiteral;
  if ((token->flags & kReported) != 0) last_error_ = token;
  if (prefix) {
    Tok type = token[-2].kind;
    for (const StringPrefix& row : kStringPrefixes) {
      if (!is(token - 2, row.word)) continue;
      prefix = names_.intern(row.type);
      type = row.quotes;
    }
    const bool double_byte = type == Tok::Wstring || type == Tok::Wchar;  // with either quote: ed. 3 table 6, 4c and 4d
    const bool ok = type == Tok::String || type == Tok::Char ? !wide : double_byte || !isTypeWord(type);
    wide = wide || double_byte;
    if (!ok) {
      slip(diag::LiteralPrefix, token, {textOf(token), textOf(token - 2)});
      return errorExpr(start);
    }
  }
  readString(textOf(token), wide, loc(token), diagnostics_, buffer_);
  const StringId text = tree_.addString(buffer_);
  return tree_.add<ExprId>(LiteralExpr{
      exprHeader(ExprKind::Literal, start, static_cast<uint8_t>(wide ? LiteralKind::WString : LiteralKind::String)),
      prefix, text.first, text.length});
}

ExprId Parser::parseTime() {
  const Token* token = t_;
  advance();
  TimeValue value;
  bool ok = false;
  switch (static_cast<int>(token->kind)) {
    case static_cast<int>(Tok::Duration): ok = readDuration(textOf(token), loc(token), diagnostics_, value); break;
    case static_cast<int>(Tok::Date): ok = readDate(textOf(token), loc(token), diagnostics_, value); break;
    case static_cast<int>(Tok::TimeOfDay): ok = readTimeOfDay(textOf(token), loc(token), diagnostics_, value); break;
    default: ok = readDateTime(textOf(token), loc(token), diagnostics_, value); break;
  }
  if (!ok) {
    last_error_ = token;
    return errorExpr(loc(token));
  }
  const auto bits =
      static_cast<uint8_t>((value.is_long ? kLiteralLong : 0) | (value.is_negative ? kLiteralNegative : 0));
  LiteralExpr e{exprHeader(ExprKind::Literal, loc(token), static_cast<uint8_t>(value.kind), bits), {}, 0, 0};
  e.setValue(value.value);
  return tree_.add<ExprId>(e);
}

ExprId Parser::parseAddress() {
  const Token* token = t_;
  advance();
  AddressExpr e{exprHeader(ExprKind::Address, loc(token)), {}};
  if (!readAddress(textOf(token), loc(token), diagnostics_, e.address, numbers_)) {
    last_error_ = token;
    return errorExpr(loc(token));
  }
  e.address.path = tree_.addList<uint32_t>(numbers_);
  return tree_.add<ExprId>(e);
}

}  // namespace rung::text

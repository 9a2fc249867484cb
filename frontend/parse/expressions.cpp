// SPDX-License-Identifier: Apache-2.0
// Expressions: precedence climbing over kOperators, postfix chains, literals and arguments.
#include <algorithm>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/expressions.h"
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
constexpr TokMap<Operator> kOperators = {
    {Tok::Or, {1, BinaryOp::Or}},
    {Tok::OrElse, {1, BinaryOp::OrElse}},
    {Tok::BarTwice, {1, BinaryOp::Or}},
    {Tok::Bar, {1, BinaryOp::Or}},
    {Tok::Xor, {2, BinaryOp::Xor}},
    {Tok::And, {3, BinaryOp::And}},
    {Tok::AndThen, {3, BinaryOp::AndThen}},
    {Tok::Ampersand, {3, BinaryOp::And}},
    {Tok::AmpersandTwice, {3, BinaryOp::And}},
    {Tok::Equal, {4, BinaryOp::Equal}},
    {Tok::EqualEqual, {4, BinaryOp::Equal}},
    {Tok::NotEqual, {4, BinaryOp::NotEqual}},
    {Tok::BangEqual, {4, BinaryOp::NotEqual}},
    {Tok::Less, {5, BinaryOp::Less}},
    {Tok::LessEqual, {5, BinaryOp::LessEqual}},
    {Tok::EqualLess, {5, BinaryOp::LessEqual}},
    {Tok::Greater, {5, BinaryOp::Greater}},
    {Tok::GreaterEqual, {5, BinaryOp::GreaterEqual}},
    {Tok::Plus, {6, BinaryOp::Add}},
    {Tok::Minus, {6, BinaryOp::Subtract}},
    {Tok::Star, {7, BinaryOp::Multiply}},
    {Tok::Slash, {7, BinaryOp::Divide}},
    {Tok::Mod, {7, BinaryOp::Modulo}},
    {Tok::Percent, {7, BinaryOp::Modulo}},
    {Tok::Power, {kPowerPrecedence, BinaryOp::Power}},
};

// The ST operator for an operator of another language.
constexpr TokMap<const char*> kNativeOperators = {
    {Tok::EqualEqual, "="}, {Tok::BangEqual, "<>"}, {Tok::Bang, "NOT"},    {Tok::AmpersandTwice, "AND"},
    {Tok::BarTwice, "OR"},  {Tok::Bar, "OR"},       {Tok::Percent, "MOD"}, {Tok::EqualLess, "<="},
};

}  // namespace

ExpressionParser::ExpressionParser(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                                   Diagnostics& diagnostics)
    : Cursor(tree, names, sources, file, dialect, diagnostics),
      eno_(names.intern(kEnableOutput)),
      this_struct_(names.intern("THISSTRUCT")) {}

// expr = unary {operator expr}, with operators that bind at least as tight as `least`; those of equal precedence from
// the left.
ExprId ExpressionParser::parseExpr(uint32_t least) {
  ExprId left = parseUnary();
  uint32_t height = height_;
  for (;;) {
    const Operator row = kOperators[t_->kind];
    if (row.precedence < least || row.precedence == 0) {
      height_ = height;
      return left;
    }
    const Token* op = t_;
    // a << 2, a >> 2
    if ((at(Tok::Less) || at(Tok::Greater)) && peek() == kind() && t_[1].offset == t_->offset + 1) {
      const bool left_shift = at(Tok::Less);
      slip(diag::ForeignOperator, op, {left_shift ? "<<" : ">>", left_shift ? "SHL(...)" : "SHR(...)"}).length(2);
      advance();
      advance();
      parseExpr(row.precedence + 1u);
      left = build_.error(loc(op));
      continue;
    }
    if (height >= kMaxExprHeight) {
      tooDeep("operators", kMaxChain);
      height_ = height;
      return left;
    }
    // The syntax manual 001, table of 5.4.1.3.2, prints `%` as the sign of MOD.
    const bool is_mod_sign = op->kind == Tok::Percent && profile_.percent_is_modulo;
    if (op->kind >= Tok::EqualEqual && op->kind <= Tok::EqualLess && !is_mod_sign)
      slip(diag::ForeignOperator, op, {spelling(op->kind), kNativeOperators[op->kind]});
    advance();
    const ExprId right = parseExpr(row.precedence + 1u);
    height = std::max(height, height_) + 1;
    if (height > kMaxExprHeight + 1) {
      tooDeep("operators", kMaxChain);
      height_ = 1;
      return build_.error(loc(op));
    }
    if (row.op == BinaryOp::Power && profile_.negation_before_power && tree_.kind(left) == ExprKind::Unary &&
        tree_.expr(left).in_parens == 0 && tree_.as<UnaryExpr>(left).op() == UnaryOp::Negate)
      diagnostics_.report(diag::NegatedPower, tree_.loc(left), {"tighter"});
    if (row.op == BinaryOp::Or && profile_.warns_of_xor_beside_or && isBareXor(right))
      diagnostics_.report(diag::XorBesideOr, tree_.loc(right));
    left = ended(build_.binary(row.op, left, right, loc(op)));
  }
}

// Without parentheses: after an OR, CODESYS would combine its first operand with the OR.
bool ExpressionParser::isBareXor(ExprId id) const {
  return tree_.kind(id) == ExprKind::Binary && tree_.expr(id).in_parens == 0 &&
         tree_.as<BinaryExpr>(id).op() == BinaryOp::Xor;
}

// False: too deep, which is reported.
bool ExpressionParser::enterExpr(const char* what) {
  if (++expr_depth_ <= kMaxExprDepth) return true;
  tooDeep(what, kMaxExprDepth);
  --expr_depth_;
  return false;
}

// `:=`, or `=` with an error.
bool ExpressionParser::acceptAssign() {
  if (!at(Tok::Equal)) return accept(Tok::Assign);
  slip(diag::AssignWithEqual, t_, {"="});
  advance();
  return true;
}

// Between two elements of a list.
void ExpressionParser::missingComma() {
  if (atLineStart())
    missing(diag::MissingToken, {",", describe(t_)});
  else
    slip(diag::MissingToken, t_, {",", describe(t_)});
}

// unary = ["-" | "+" | NOT] operand. In codesys `**` binds tighter than the sign, in the standard weaker.
ExprId ExpressionParser::parseUnary() {
  const bool is_not = at(Tok::Not) || at(Tok::Bang);
  if (!is_not && !at(Tok::Minus) && !at(Tok::Plus)) return parsePrimary();
  const UnaryOp op = is_not ? UnaryOp::Not : at(Tok::Minus) ? UnaryOp::Negate : UnaryOp::Plus;
  if (at(Tok::Bang)) slip(diag::ForeignOperator, t_, {"!", "NOT"});
  // NOT(EN := x, IN := y): the functional form, with pins
  if (is_not && peek() == Tok::LeftParen && peek(3) == Tok::Assign && (is(t_ + 2, kEnable) || is(t_ + 2, "IN")))
    return parsePrimary();
  const Loc start = here();
  if (!enterExpr("expressions")) return build_.error(start);
  advance();
  const ExprId operand = profile_.negation_before_power ? parseUnary() : parseExpr(kPowerPrecedence);
  --expr_depth_;
  if (++height_ > kMaxExprHeight + 1) {
    tooDeep("operators", kMaxChain);
    height_ = 1;
    return build_.error(start);
  }
  if (op == UnaryOp::Negate && tree_.kind(operand) == ExprKind::Binary && tree_.expr(operand).in_parens == 0)
    diagnostics_.report(diag::NegatedPower, start, {"looser"});
  return ended(build_.unary(op, operand, start));
}

// operand = name | literal | address | "(" expr ")" | NULL | (AND | OR | XOR | MOD | NOT) "(" arguments ")" | "." name,
// with what follows
ExprId ExpressionParser::parsePrimary() {
  const Loc start = here();
  height_ = 1;
  if (atLineStart() && lineEnds()) return missingOperand();
  if (isName(kind()) || isTypeWord(kind())) return parseOperandName();
  if (at(Tok::Number)) return ended(parseNumber({}, false, start));
  if (at(Tok::StringLiteral) || at(Tok::WideStringLiteral)) return ended(parseStringLiteral({}, start));
  if (kind() >= Tok::Duration && kind() <= Tok::DateTime) return ended(parseTime());
  if (at(Tok::True) || at(Tok::False)) {
    const bool value = at(Tok::True);
    advance();
    return ended(build_.boolean(value, start));
  }
  if (accept(Tok::Null)) return ended(build_.literal(LiteralKind::Null, 0, start));
  if (at(Tok::Address)) return parsePostfix(ended(parseAddress()));
  if (at(Tok::LeftParen)) return parseInParens();
  // CODESYS, "Operator: Global Namespace".
  if (at(Tok::Dot) && profile_.global_operator && isName(peek()) && t_[1].offset == t_->offset + 1) {
    advance();
    const ExprId name = build_.name(nameOf(t_), here());
    tree_.expr(name).op = kGlobalName;
    advance();
    return parsePostfix(ended(name));
  }
  // The functional form of operators that are keywords: AND(a, b)
  if ((at(Tok::And) || at(Tok::Or) || at(Tok::Xor) || at(Tok::Mod) || at(Tok::Not)) && peek() == Tok::LeftParen) {
    const ExprId name = build_.name(names_.intern(textOf(t_)), start);
    advance();
    return parsePostfix(ended(name));
  }
  return missingOperand();
}

// name | type "#" value | THIS | SUPER, with what follows
ExprId ExpressionParser::parseOperandName() {
  const Loc start = here();
  if (peek() == Tok::Hash) return ended(parseTyped());
  if ((at(Tok::This) || at(Tok::Super)) && peek() != Tok::LeftParen) {
    const ExprId object = at(Tok::This) ? build_.thisObject(start) : build_.superObject(start);
    advance();
    return parsePostfix(ended(object));
  }
  // SUPER(): the body of the base, as the standard writes it; CODESYS writes SUPER^().
  if (at(Tok::Super) && peek(2) == Tok::RightParen) {
    const ExprId object = build_.superObject(start);
    advance();
    return parsePostfix(ended(build_.deref(ended(object), start)));
  }
  if (names_.same(nameOf(t_), eno_)) eno_used_ = true;
  // In the initial value of a member: the structure itself. TwinCAT compiles it; its help has no page on it.
  if (declares_ && profile_.this_struct && names_.same(nameOf(t_), this_struct_)) {
    advance();
    return parsePostfix(ended(build_.deref(ended(build_.thisObject(start)), start)));
  }
  const ExprId name = build_.name(nameOf(t_), start);
  advance();
  ended(name);
  const Tok next = kind();
  if (next == Tok::Dot || next == Tok::LeftParen || next == Tok::LeftBracket || next == Tok::Caret)
    return parsePostfix(name);
  return name;
}

// "(" expr ")", with what follows
ExprId ExpressionParser::parseInParens() {
  const Loc start = here();
  if (!enterExpr("parentheses")) return build_.error(start);
  advance();
  const ExprId inner = parseCompared(parseExpr(), false);
  closeParen(Tok::RightParen, false);
  --expr_depth_;
  tree_.parenthesize(inner, start, endOfPrevious());
  return parsePostfix(inner);
}

ExprId ExpressionParser::missingOperand() {
  const Loc start = here();
  if (at(Tok::Error)) {
    last_error_ = t_;
    advance();
    panic_ = true;
    return ended(build_.error(start));
  }
  if (begins(t_) == Begins::Element) {  // the list goes on
    slip(diag::MissingValue, t_, {describe(t_)});
    unfinished_ = t_;
    return build_.error(start);
  }
  fail(at(Tok::LeftBracket) && !declares_ ? diag::ListInBody : diag::MissingValue, t_, {describe(t_)});
  return build_.error(start);
}

// postfix = {"." (name | bit | "%X" bit) | "[" expr {"," expr} "]" | "^" | "(" arguments ")"}; without `calls` it ends
// at a `(`.
ExprId ExpressionParser::parsePostfix(ExprId base, bool calls) {
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
    if (next == Tok::Caret) {
      base = build_.deref(base, here());
      advance();
      ended(base);
      continue;
    }
    if (next == Tok::Dot) {
      base = parseDot(base);
      if (tree_.kind(base) == ExprKind::Error) return base;
      continue;
    }
    const char* const what = next == Tok::LeftBracket ? "indices" : "calls";
    if (++expr_depth_ > kMaxExprDepth) {
      tooDeep(what, kMaxExprDepth);
      --expr_depth_;
      return base;
    }
    base = ended(next == Tok::LeftBracket ? parseIndex(base, height) : parseCall(base, height));
    --expr_depth_;
  }
}

// A named instance whose ENO is read keeps it (sema::Var::eno_memory).
void ExpressionParser::noteEnoOf(ExprId base) {
  NameId name;
  if (tree_.kind(base) == ExprKind::Name) name = tree_.as<NameExpr>(base).name;
  if (tree_.kind(base) == ExprKind::Member) name = tree_.as<MemberExpr>(base).member;
  if (!name) return;
  const uint32_t key = names_.key(name).index;
  if (tree_.eno_read_of.size() <= key) tree_.eno_read_of.resize(key + 1);
  tree_.eno_read_of[key] = true;
}

// "." (name | bit | "%X" bit)
ExprId ExpressionParser::parseDot(ExprId base) {
  const Token* dot = t_;
  advance();
  const Loc at_member = here();
  const bool same_line = !atLineStart();
  if (!same_line && lineEnds()) {
    fail(diag::MissingName, t_, {describe(t_)});
    return build_.error(loc(dot));
  }
  if (isName(kind()) || isNullName(t_) || (isTypeWord(kind()) && same_line)) {
    if (names_.same(nameOf(t_), eno_)) noteEnoOf(base);
    base = build_.member(base, nameOf(t_), at_member);
  } else if (at(Tok::Number)) {
    NumberValue value;
    if (readNumber(textOf(t_), at_member, diagnostics_, value) &&
        (value.is_real || value.is_based || value.integer > 63))
      fail(diag::MissingName, t_, {describe(t_)});
    base = build_.bitAccess(base, static_cast<uint32_t>(value.integer & 63), 1, at_member);
  } else if (at(Tok::Address)) {
    base = parsePartAccess(base, at_member);
  } else {
    const Token* const marked = same_line ? t_ : dot;
    fail(diag::MissingName, marked, {describe(marked)});
    return build_.error(loc(dot));
  }
  advance();
  return ended(base);
}

// %X3 %B1 %W0 %D0; the lexer reads the `.7` of `%B1.7` as part of an address.
ExprId ExpressionParser::parsePartAccess(ExprId base, Loc at_member) {
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
  base = build_.bitAccess(base, ok ? position : 0, static_cast<uint8_t>(ok ? width : 1), at_member);
  if (!ok || bit.empty()) return base;
  uint32_t number = 0;
  for (const char c : bit) number = number * 10 + static_cast<uint32_t>(c - '0');
  const uint32_t end = at_member.offset + static_cast<uint32_t>(part.size());
  tree_.expr(base).end = Loc{end};
  return build_.bitAccess(base, number, 1, Loc{end + 1});
}

// "[" expr {"," expr} "]"
ExprId ExpressionParser::parseIndex(ExprId base, uint32_t& height) {
  const Loc start = tree_.loc(base);
  advance();
  const size_t first = exprs_.size();
  do {
    exprs_.push_back(parseExpr());
    height = std::max(height, height_);
  } while (!panic_ && accept(Tok::Comma));
  closeParen(Tok::RightBracket, false);
  return build_.index(base, listFrom(exprs_, first), start);
}

// "(" arguments ")" of a call, or of __NEW
ExprId ExpressionParser::parseCall(ExprId base, uint32_t& height) {
  const Loc start = tree_.loc(base);
  Loc end;
  height_ = 0;
  if (isNew(base)) {
    const ExprId created = parseNew(base);
    height = std::max(height, height_);
    return created;
  }
  if (isSizeOfType(base)) {
    const ExprId size = parseSizeOfType(base);
    height = std::max(height, height_);
    return size;
  }
  const Slice<Argument> arguments = parseArguments(end);
  height = std::max(height, height_);
  return build_.call(base, arguments, start, end);
}

bool ExpressionParser::isNew(ExprId callee) const {
  return tree_.kind(callee) == ExprKind::Name &&
         sameIdentifier(names_.string(tree_.as<NameExpr>(callee).name), "__NEW");
}

// new = "__NEW" "(" type ["," expr] ")"
ExprId ExpressionParser::parseNew(ExprId callee) {
  TypeExprId allocated;
  ExprId count;
  advance();
  const bool was_in_variable = in_variable_;
  in_variable_ = true;  // after the name of a block type come arguments of FB_Init
  allocated = parseType();
  in_variable_ = was_in_variable;
  if (!panic_ && accept(Tok::Comma)) count = parseExpr();
  closeParen(Tok::RightParen, false);
  return build_.newObject(allocated, count, tree_.loc(callee));
}

// Tells whether SIZEOF or XSIZEOF is followed by a type that no expression begins with. CODESYS.
bool ExpressionParser::isSizeOfType(ExprId callee) const {
  if (!profile_.size_of_types || tree_.kind(callee) != ExprKind::Name) return false;
  const std::string_view name = names_.string(tree_.as<NameExpr>(callee).name);
  if (!sameIdentifier(name, "SIZEOF") && !sameIdentifier(name, "XSIZEOF")) return false;
  const Tok first = peek(), second = peek(2);
  if (first == Tok::Array) return true;
  if (first == Tok::Pointer || first == Tok::Reference) return second == Tok::To;
  return (first == Tok::String || first == Tok::Wstring) && (second == Tok::LeftParen || second == Tok::LeftBracket);
}

// "SIZEOF" "(" type ")"
ExprId ExpressionParser::parseSizeOfType(ExprId callee) {
  const Loc start = tree_.loc(callee);
  advance();
  Argument argument{};
  argument.loc = here();
  argument.value = build_.typeOperand(parseType(), argument.loc);
  const Loc end = here();
  closeParen(Tok::RightParen, false);
  return build_.call(callee, tree_.addList<Argument>({&argument, 1}), start, end);
}

// arguments = "(" [argument {"," argument} [","]] ")"
// argument  = expr | name ":=" [expr] | [NOT] name "=>" [target]
Slice<Argument> ExpressionParser::parseArguments(Loc& end) {
  const size_t first = arguments_.size();
  uint32_t height = 0;
  advance();
  bool open = !at(Tok::RightParen);
  while (open) {
    const Argument a = parseArgument(first);
    height = std::max(height, height_);
    arguments_.push_back(a);
    if (at(Tok::With) && !panic_) parseWithTask(a);
    open = !panic_ && continuesArguments();
  }
  end = here();
  closeParen(Tok::RightParen, true);
  height_ = height;
  return listFrom(arguments_, first);
}

// expr | name ":=" [expr] | [NOT] name "=>" [target]; `first`: where the list begins on arguments_.
Argument ExpressionParser::parseArgument(size_t first) {
  Argument a{};
  a.loc = here();
  if (atLineStart() && lineEnds()) {
    a.value = missingOperand();
    return a;
  }
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
      if (!profile_.empty_bindings) slip(diag::EmptyBinding, pin, {textOf(pin)});
    } else if (atNestedIl()) {
      parseNestedIl(static_cast<uint32_t>(arguments_.size() - first));
    } else {
      a.value = parseExpr();
    }
  } else {
    a.value = parseExpr();
  }
  return a;
}

// PROGRAM p : Main (block WITH task)
void ExpressionParser::parseWithTask(const Argument& argument) {
  const ExprId block = argument.value;
  const bool named = block && tree_.kind(block) == ExprKind::Name && !argument.pin.name;
  if (!in_program_instance_ || !named || !isName(peek())) fail(diag::StrayToken, t_, {describe(t_)});
  arguments_.pop_back();
  advance();
  if (!panic_) {
    block_tasks_.push_back({tree_.as<NameExpr>(block).name, argument.loc});
    block_tasks_.push_back(ident(t_));
    advance();
  }
}

// After an argument: whether another one follows. Reports what is between them.
bool ExpressionParser::continuesArguments() {
  if (at(Tok::RightParen)) return false;
  if (at(Tok::Comma)) {
    if (peek() == Tok::RightParen) {
      if (profile_.trailing_commas)
        removal(diagnostics_.report(diag::TrailingCommaWarning, here()), t_, Sureness::Proposal);
      else
        slip(diag::TrailingComma, t_);
      advance();
      return false;
    }
    advance();
    return true;
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
      return true;
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
    return true;
  }
  if (at(Tok::Assign) || at(Tok::Arrow)) fail(diag::NotInArguments, t_, {describe(t_)});
  return false;
}

// After a condition or in parentheses, `:=` assigns in codesys: its value is that of the target. In iec it most likely
// means `=`, and is parsed as `=`.
ExprId ExpressionParser::parseCompared(ExprId left, bool in_condition) {
  if (!at(Tok::Assign) || panic_) return left;
  const Loc op = here();
  const uint32_t height = height_;
  const ExprShape shape_of_left = shape(tree_.kind(left));
  const bool variable =
      tree_.kind(left) == ExprKind::Name || tree_.kind(left) == ExprKind::Address || shape_of_left == ExprShape::Step;
  const bool assigns = profile_.assignment_expressions && variable && tree_.expr(left).in_parens == 0;
  if (!assigns)
    slip(diag::CompareWithAssign, t_);
  else if (in_condition)
    diagnostics_.report(diag::AssignInCondition, here()).replace("=", Sureness::Proposal);
  advance();
  const ExprId right = assigns ? parseCompared(parseExpr(), false) : parseExpr();
  if (assigns) {
    height_ = std::max(height, height_) + 1;
    return ended(build_.assignment(left, right, op));
  }
  height_ = std::max(height, height_) + 1;
  return ended(build_.binary(BinaryOp::Equal, left, right, op));
}

// Consumes the closing bracket; if it is missing, reports it and finds the resynchronization point.
void ExpressionParser::closeParen(Tok close, bool is_arguments) {
  if (in_il_) return closeIlParen(close);
  if (!panic_ && (accept(close) || !failsToClose(close, is_arguments))) return;
  if (!atUnfinished() && !skipToPartner(close)) skipToEndOfParen(close);
}

// Reports what is there in place of the closing bracket. False: parsing goes on as if the bracket was there.
bool ExpressionParser::failsToClose(Tok close, bool is_arguments) {
  const Tok k = kind();
  const bool ends = k == Tok::Semicolon || k == Tok::End || (isReserved(k) && !isOperand(k)) || startsStatement(t_) ||
                    begins(t_) == Begins::New;
  if (ends) {
    if (atLineStart() || k == Tok::End)
      missing(diag::MissingToken, {spelling(close), describe(t_)});
    else
      slip(diag::MissingToken, t_, {spelling(close), describe(t_)});
    return false;
  }
  if (k == Tok::RightParen || k == Tok::RightBracket) {
    slip(diag::MissingToken, t_, {spelling(close), describe(t_)});
    if (k != Tok::RightParen || close != Tok::RightBracket) advance();
    return false;
  }
  if (is_arguments)
    fail(diag::NotInArguments, t_, {describe(t_)});
  else if (isOperand(k))
    fail(diag::MissingOperator, t_, {describe(t_)});
  else
    fail(diag::MissingToken, t_, {spelling(close), describe(t_)});
  return true;
}

bool ExpressionParser::endsExpression(Tok k) const {
  return k == Tok::Semicolon || k == Tok::End || (isReserved(k) && !isOperand(k) && kOperators[k].precedence == 0);
}

// After the closing partner, even on a later line, within the statement. False: there is none.
bool ExpressionParser::skipToPartner(Tok close) {
  uint32_t depth = 0;
  for (Token* t = t_; t - t_ < 5000 && !endsExpression(t->kind); ++t) {
    if (t->kind == Tok::LeftParen || t->kind == Tok::LeftBracket) ++depth;
    if (t->kind != Tok::RightParen && t->kind != Tok::RightBracket) continue;
    if (depth == 0 && t->kind == close) {
      t_ = t + 1;
      panic_ = false;
      return true;
    }
    if (depth == 0) break;
    --depth;
  }
  return false;
}

// To another closing bracket or the end of the statement.
void ExpressionParser::skipToEndOfParen(Tok close) {
  uint32_t depth = 0;
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
    if (endsExpression(k) || (atLineStart() && startsStatement(t_))) return;
  }
}

}  // namespace rung::text

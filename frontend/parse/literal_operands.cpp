// SPDX-License-Identifier: Apache-2.0
// Literals and addresses as operands: their tokens become nodes, by the values that literals.h reads.
#include <cstring>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/expressions.h"
#include "frontend/source/dialect.h"

namespace rung::text {

// INT#-5  INT#16#FF  BOOL#TRUE  STRING#'x'  Color#Red
ExprId ExpressionParser::parseTyped() {
  const Token* type = t_;
  const Loc start = here();
  const NameId prefix = nameOf(t_);
  advance();
  advance();
  if (atLineStart() && lineEnds()) return missingOperand();
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
      return build_.error(start);
    }
    advance();
    return build_.boolean(value, start, prefix);
  }
  if (isName(kind())) {
    const ExprId e = build_.typedName(ident(type), ident(t_));
    advance();
    return e;
  }
  fail(diag::MissingValue, t_, {describe(t_)});
  return build_.error(start);
}

// A number as the lexer found it: digits, base#digits or a real.
ExprId ExpressionParser::parseNumber(NameId prefix, bool negative, Loc start) {
  const Token* token = t_;
  advance();
  NumberValue value;
  if (!readNumber(textOf(token), loc(token), diagnostics_, value)) {
    last_error_ = token;
    return build_.error(start);
  }
  if (value.has_underscore_pair && !profile_.double_underscores_in_numbers)
    diagnostics_.report(diag::NumberUnderscore, loc(token), {textOf(token)})
        .replace(loc(token), endOf(token), withSingleUnderscores(textOf(token)), Sureness::Sure);
  const LiteralForm form{.is_negative = negative, .is_based = value.is_based};
  if (prefix) {
    const Token* type = token - (negative || token[-1].kind == Tok::Plus ? 3 : 2);
    const bool is_real_type = type->kind == Tok::Real || type->kind == Tok::Lreal;
    if (type->kind == Tok::Bool && !value.is_real && value.integer <= 1 && !negative)
      return build_.boolean(value.integer != 0, start, prefix);
    if (is_real_type && !value.is_real && !value.is_based) {
      value.is_real = true;
      value.real = static_cast<double>(value.integer);
    }
    if (isTypeWord(type->kind) &&
        ((value.is_real && !is_real_type) || (is_real_type && value.is_based) || type->kind == Tok::Bool ||
         type->kind == Tok::String || type->kind == Tok::Wstring)) {
      slip(diag::LiteralPrefix, token, {textOf(token), textOf(type)});
      return build_.error(start);
    }
    if (value.is_real && negative) value.real = -value.real;
  }
  uint64_t raw = value.integer;
  if (value.is_real) std::memcpy(&raw, &value.real, sizeof raw);
  return build_.literal(value.is_real ? LiteralKind::Real : LiteralKind::Integer, raw, start, prefix, form);
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
    {"UCHAR", "UCHAR", Tok::Char}, {"USTRING", "USTRING", Tok::String}, {"UTF8", "STRING", Tok::String},
};

// "'" characters "'" or the same in double quotes, after a prefix such as STRING# or W#
ExprId ExpressionParser::parseStringLiteral(NameId prefix, Loc start) {
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
      return build_.error(start);
    }
  }
  readString(textOf(token), wide, loc(token), diagnostics_, buffer_);
  return build_.text(wide ? LiteralKind::WString : LiteralKind::String, buffer_, start, prefix);
}

// T#… | D#… | TOD#… | DT#… and their long forms
ExprId ExpressionParser::parseTime() {
  const Token* token = t_;
  advance();
  TimeValue value;
  value.is_unsigned = profile_.unsigned_dates;
  const auto read = token->kind == Tok::Duration    ? readDuration
                    : token->kind == Tok::Date      ? readDate
                    : token->kind == Tok::TimeOfDay ? readTimeOfDay
                                                    : readDateTime;
  const bool ok = read(textOf(token), loc(token), diagnostics_, value);
  if (!ok) {
    last_error_ = token;
    return build_.error(loc(token));
  }
  const LiteralForm form{.is_long = value.is_long, .is_negative = value.is_negative, .overflows = value.overflows};
  return build_.literal(value.kind, value.value, loc(token), {}, form);
}

// "%" area [size] number {"." number}
ExprId ExpressionParser::parseAddress() {
  const Token* token = t_;
  advance();
  DirectAddress address{};
  if (!readAddress(textOf(token), loc(token), diagnostics_, address, numbers_)) {
    last_error_ = token;
    return build_.error(loc(token));
  }
  address.path = tree_.addList<uint32_t>(numbers_);
  return build_.address(address, loc(token));
}

}  // namespace rung::text

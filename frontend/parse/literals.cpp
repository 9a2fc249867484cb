// SPDX-License-Identifier: Apache-2.0
#include "frontend/parse/literals.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "frontend/parse/diagnostics.h"
#include "frontend/source/scanner.h"
#include "frontend/source/text.h"

namespace rung::text {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
int hexDigit(char c) {
  if (isDigit(c)) return c - '0';
  c = foldedCharacter(c);
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

// 0x10, 0b101 and 0o17 of C and others, as IEC writes them: 16#10. Empty: something else.
std::string basedForm(std::string_view text) {
  if (text.size() < 3 || text[0] != '0') return {};
  const char letter = foldedCharacter(text[1]);
  const int base = letter == 'x' ? 16 : letter == 'o' ? 8 : letter == 'b' ? 2 : 0;
  const std::string_view digits = text.substr(2);
  const bool fits = base != 0 && std::all_of(digits.begin(), digits.end(),
                                             [&](char c) { return hexDigit(c) >= 0 && hexDigit(c) < base; });
  return fits ? std::to_string(base) + '#' + std::string(digits) : std::string();
}

constexpr uint64_t kSecond = 1000000000u, kMinute = 60 * kSecond, kHour = 60 * kMinute, kDay = 24 * kHour;

struct TimeUnit {
  std::string_view name;
  uint64_t nanoseconds;
  uint64_t end;  // of its numbers after another unit: 24 hours are a day
};
// In the order in which a duration has them.
constexpr TimeUnit kUnits[] = {{"d", kDay, UINT64_MAX}, {"h", kHour, 24},   {"m", kMinute, 60}, {"s", kSecond, 60},
                               {"ms", 1000000, 1000},   {"us", 1000, 1000}, {"ns", 1, 1000}};

// The number of a unit in kUnits, or their count.
size_t findUnit(std::string_view text) {
  size_t unit = 0;
  while (unit < std::size(kUnits) && !sameIdentifier(text, kUnits[unit].name)) ++unit;
  return unit;
}
bool isTimeUnit(std::string_view text) { return findUnit(text) < std::size(kUnits); }

Loc endOf(std::string_view text, Loc loc) { return {loc.offset + static_cast<uint32_t>(text.size())}; }

}  // namespace

std::string withSingleUnderscores(std::string_view number) {
  std::string out;
  for (size_t i = 0; i < number.size(); ++i) {
    const bool joins = i > 0 && i + 1 < number.size() && hexDigit(number[i - 1]) >= 0 &&
                       (number[i + 1] == '_' || hexDigit(number[i + 1]) >= 0);
    if (number[i] == '_' && !joins) continue;
    out += number[i];
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

namespace {

// `_` only between digits; several in a row are left to the caller.
bool checkUnderscores(std::string_view digits, std::string_view text, Loc loc, Diagnostics& diagnostics,
                      NumberValue& value) {
  const auto isUnderscoreOrDigit = [](char c) { return c == '_' || hexDigit(c) >= 0; };
  for (size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] != '_') continue;
    if (i == 0 || i + 1 == digits.size() || !isUnderscoreOrDigit(digits[i - 1]) ||
        !isUnderscoreOrDigit(digits[i + 1])) {
      diagnostics.report(diag::NumberUnderscore, loc, {text})
          .replace(loc, endOf(text, loc), withSingleUnderscores(text), Sureness::Sure);
      return false;
    }
    value.has_underscore_pair = value.has_underscore_pair || digits[i + 1] == '_';
  }
  return true;
}

// Reads the unsigned number at the front of text; false when it has no digit or does not fit.
bool takeNumber(std::string_view& text, uint64_t& value) {
  value = 0;
  size_t i = 0;
  for (; i < text.size() && (isDigit(text[i]) || (text[i] == '_' && i > 0)); ++i) {
    if (text[i] == '_') continue;
    if (__builtin_mul_overflow(value, 10u, &value) ||
        __builtin_add_overflow(value, static_cast<uint64_t>(text[i] - '0'), &value))
      return false;
  }
  if (i == 0 || text[i - 1] == '_') return false;
  text.remove_prefix(i);
  return true;
}
// The digits at the front of text, which it loses.
std::string_view takeDigits(std::string_view& text) {
  size_t n = 0;
  while (n < text.size() && (isDigit(text[n]) || text[n] == '_')) ++n;
  const std::string_view digits = text.substr(0, n);
  text.remove_prefix(n);
  return digits;
}
bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

std::string_view afterHash(std::string_view text) { return text.substr(text.find('#') + 1); }
bool isLong(std::string_view text) { return foldedCharacter(text.front()) == 'l'; }

// A fraction ".25" of a unit in nanoseconds, truncated to nanoseconds.
uint64_t fractionOf(std::string_view digits, uint64_t unit) {
  uint64_t value = 0, scale = unit;
  // unit is at most a day: 8.64e13; each digit divides once.
  __uint128_t sum = 0, place = static_cast<__uint128_t>(scale) * 1000000u;
  for (char c : digits) {
    if (c == '_') continue;
    place /= 10;
    sum += place * static_cast<unsigned>(c - '0');
  }
  value = static_cast<uint64_t>(sum / 1000000u);
  return value;
}

// Days since 1970-01-01 of the Gregorian calendar (Howard Hinnant's days_from_civil).
int64_t daysFromCivil(int64_t y, unsigned m, unsigned d) {
  y -= m <= 2;
  const int64_t era = (y >= 0 ? y : y - 399) / 400;
  const auto yoe = static_cast<unsigned>(y - era * 400);
  const unsigned doy = (153 * (m > 2 ? m - 3 : m + 9) + 2) / 5 + d - 1;
  const unsigned doe = yoe * 365 + yoe / 4 - yoe / 100 + doy;
  return era * 146097 + static_cast<int64_t>(doe) - 719468;
}

// y-m-d at the front of text.
bool takeDate(std::string_view& text, std::string_view whole, const char* sample, bool is_unsigned, Loc loc,
              Diagnostics& diagnostics, int64_t& days) {
  uint64_t y = 0, m = 0, d = 0;
  if (!takeNumber(text, y) || !take(text, '-') || !takeNumber(text, m) || !take(text, '-') || !takeNumber(text, d)) {
    diagnostics.report(diag::DateForm, loc, {whole, sample});
    return false;
  }
  static constexpr unsigned kLengths[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (y % 4 == 0 && y % 100 != 0) || y % 400 == 0;
  // The range of 64 bits of nanoseconds, in whole years, and up to 2554-07-21 without a sign.
  const uint64_t from = 1678, to = is_unsigned ? 2554 : 2261;
  const bool late = is_unsigned && y == 2554 && (m > 7 || (m == 7 && d > 21));
  const bool ok =
      !late && y >= from && y <= to && m >= 1 && m <= 12 && d >= 1 && d <= kLengths[m - 1] + (m == 2 && leap ? 1u : 0u);
  if (!ok) {
    diagnostics.report(
        diag::NoSuchDay, loc,
        {afterHash(whole).substr(0, afterHash(whole).size() - text.size()), std::to_string(from), std::to_string(to)});
    return false;
  }
  days = daysFromCivil(static_cast<int64_t>(y), static_cast<unsigned>(m), static_cast<unsigned>(d));
  return true;
}

// h:m[:s[.fraction]] up to the end of text.
bool takeTime(std::string_view text, std::string_view whole, const char* sample, bool hours_free, Loc loc,
              Diagnostics& diagnostics, uint64_t& nanoseconds) {
  uint64_t h = 0, m = 0, s = 0, fraction = 0;
  bool ok = takeNumber(text, h) && take(text, ':') && takeNumber(text, m);
  if (ok && take(text, ':')) {
    ok = takeNumber(text, s);
    if (ok && take(text, '.')) {
      const std::string_view digits = takeDigits(text);
      fraction = fractionOf(digits, kSecond);
      ok = !digits.empty();
    }
  }
  if (!ok || !text.empty() || m > 59 || s > 59 || h > (hours_free ? 1193u : 23u)) {
    diagnostics.report(diag::TimeOfDayForm, loc, {whole, sample});
    return false;
  }
  if (h > 23) diagnostics.report(diag::TimeOfDayLong, loc, {whole});
  nanoseconds = h * kHour + m * kMinute + s * kSecond + fraction;
  return true;
}

// Appends a digit to a number; false when it does not fit.
bool appendDigit(uint64_t& number, unsigned base, unsigned digit) {
  return !__builtin_mul_overflow(number, static_cast<uint64_t>(base), &number) &&
         !__builtin_add_overflow(number, static_cast<uint64_t>(digit), &number);
}

// 2, 8, 10 or 16; 0: another base is written.
unsigned baseOf(std::string_view text) {
  for (const unsigned base : {2u, 8u, 10u, 16u})
    if (text == std::to_string(base)) return base;
  return 0;
}

// base "#" digits
bool readBased(std::string_view text, size_t hash, Loc loc, Diagnostics& diagnostics, NumberValue& value) {
  const std::string_view base_digits = text.substr(0, hash), digits = text.substr(hash + 1);
  const unsigned base = baseOf(base_digits);
  if (base == 0) {
    diagnostics.report(diag::NumberBase, loc, {text});
    return false;
  }
  if (digits.empty()) {
    diagnostics.report(diag::NumberDigit, loc, {text, base_digits});
    return false;
  }
  value.is_based = true;
  for (char c : digits) {
    if (c == '_') continue;
    const int digit = hexDigit(c);
    if (digit < 0 || digit >= static_cast<int>(base)) {
      diagnostics.report(diag::NumberDigit, loc, {std::string_view(&c, 1), base_digits});
      return false;
    }
    if (!appendDigit(value.integer, base, static_cast<unsigned>(digit))) {
      diagnostics.report(diag::NumberTooLarge, loc, {text});
      return false;
    }
  }
  return checkUnderscores(digits, text, loc, diagnostics, value);
}

// Reports what follows the digits of a number: a unit, as in `5s`, or other letters.
void reportSuffix(std::string_view text, std::string_view suffix, Loc loc, Diagnostics& diagnostics) {
  if (isTimeUnit(suffix)) {
    diagnostics.report(diag::DurationWithoutPrefix, loc, {text}).insert(loc, "T#", Sureness::Sure);
    return;
  }
  const std::string based = basedForm(text);
  Report report = diagnostics.report(diag::NumberSuffix, loc, {text});
  if (!based.empty())
    report.note({}, Note{"write `{0}`"}, {based}).replace(loc, endOf(text, loc), based, Sureness::Sure);
}

// digits ["." digits] ["E" ["+"|"-"] digits]
bool readReal(std::string_view text, Loc loc, Diagnostics& diagnostics, NumberValue& value) {
  value.is_real = true;
  std::string plain;
  for (char c : text)
    if (c != '_') plain += c;
  const char* const plain_end = plain.data() + plain.size();
  const auto [end, error] = std::from_chars(plain.data(), plain_end, value.real);
  if (end != plain_end) {
    reportSuffix(text, std::string_view(end, plain_end), loc, diagnostics);
    return false;
  }
  if (error == std::errc::result_out_of_range) {
    // Underflow is zero; overflow is reported here, since later phases could not tell it from infinity.
    const size_t e = plain.find_first_of("eE");
    const bool tiny = e != std::string::npos && plain[e + 1] == '-';
    value.real = 0;
    if (!tiny) {
      diagnostics.report(diag::NumberTooLarge, loc, {text});
      return false;
    }
  }
  return checkUnderscores(text.substr(0, text.find_first_of("eE")), text, loc, diagnostics, value);
}

// The everyday case: a few decimal digits, which fit.
bool readShort(std::string_view text, NumberValue& value) {
  if (text.size() >= 10) return false;
  uint64_t number = 0;
  for (const char c : text) {
    if (!isDigit(c)) return false;
    number = number * 10 + static_cast<uint64_t>(c - '0');
  }
  value.integer = number;
  return true;
}

}  // namespace

bool readNumber(std::string_view text, Loc loc, Diagnostics& diagnostics, NumberValue& value) {
  value = {};
  if (readShort(text, value)) return true;
  if (const size_t hash = text.find('#'); hash != std::string_view::npos)
    return readBased(text, hash, loc, diagnostics, value);
  size_t i = 0;
  while (i < text.size() && (isDigit(text[i]) || text[i] == '_')) ++i;
  if (i < text.size() && (text[i] == '.' || (foldedCharacter(text[i]) == 'e' && i + 1 < text.size())))
    return readReal(text, loc, diagnostics, value);
  if (i != text.size()) {
    reportSuffix(text, text.substr(i), loc, diagnostics);
    return false;
  }
  for (char c : text) {
    if (c == '_') continue;
    if (!appendDigit(value.integer, 10, static_cast<unsigned>(c - '0'))) {
      diagnostics.report(diag::NumberTooLarge, loc, {text});
      return false;
    }
  }
  return checkUnderscores(text, text, loc, diagnostics, value);
}

namespace {

// duration = ["-"] number unit {["_"] number unit}. Only the first unit may exceed its range, as in T#100s12ms; the
// value tells whether another one does. IEC 61131-3 ed. 2, 2.2.3.1.
class DurationReader {
 public:
  DurationReader(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value)
      : text_(text), rest_(afterHash(text)), loc_(loc), diagnostics_(diagnostics), value_(value) {}

  bool run() {
    value_.is_negative = take(rest_, '-');
    if (!value_.is_negative) take(rest_, '+');
    if (rest_.empty()) return fail(diag::TimeUnit);
    Part last;
    for (bool first = true; !rest_.empty(); first = false) {
      if (!first && take(rest_, '_') && rest_.empty()) return fail(diag::TimeEndsWithUnderscore);
      if (last.has_fraction) {
        diagnostics_.report(diag::TimeFraction, last.loc, {last.text}).length(static_cast<uint32_t>(last.text.size()));
        return false;
      }
      Part part;
      if (!readPart(part, first ? 0 : last.unit + 1) || !add(part, first)) return false;
      last = part;
    }
    if (!fits_ || (value_.is_negative && sum_ > (1ull << 63))) return fail(diag::TimeTooLong);
    value_.value = value_.is_negative ? 0 - sum_ : sum_;
    return true;
  }

 private:
  struct Part {
    Loc loc;
    std::string_view text, digits, fraction;
    bool has_fraction = false;
    size_t unit = 0;
  };

  bool fail(Diag message) {
    diagnostics_.report(message, loc_, {text_});
    return false;
  }
  Loc here() const { return {loc_.offset + static_cast<uint32_t>(text_.size() - rest_.size())}; }

  // number unit, where the unit is at least next_unit.
  bool readPart(Part& part, size_t next_unit) {
    part.loc = here();
    part.text = rest_;
    part.digits = takeDigits(rest_);
    part.has_fraction = take(rest_, '.');
    if (part.has_fraction) part.fraction = takeDigits(rest_);
    size_t n = 0;
    while (n < rest_.size() && !isDigit(rest_[n]) && rest_[n] != '_' && rest_[n] != '.') ++n;
    const std::string_view unit = rest_.substr(0, n);
    part.unit = findUnit(unit);
    if (part.unit == std::size(kUnits) || part.digits.empty()) {
      const bool is_incomplete = unit.empty() || part.digits.empty();
      const std::string_view shown = is_incomplete ? part.text : unit;
      diagnostics_.report(diag::TimeUnit, is_incomplete ? part.loc : here(), {shown})
          .length(static_cast<uint32_t>(shown.size()));
      return false;
    }
    if (part.unit < next_unit) {
      diagnostics_.report(diag::TimeUnitOrder, here(), {unit}).length(static_cast<uint32_t>(n));
      return false;
    }
    rest_.remove_prefix(n);
    part.text.remove_suffix(rest_.size());
    return true;
  }

  bool add(const Part& part, bool first) {
    NumberValue grouped;
    if (!checkUnderscores(part.digits, text_, loc_, diagnostics_, grouped)) return false;
    const TimeUnit& unit = kUnits[part.unit];
    uint64_t amount = 0, product = 0;
    std::string_view digits = part.digits;
    const bool is_number = takeNumber(digits, amount);
    value_.overflows = value_.overflows || (!first && (!is_number || amount >= unit.end));
    fits_ = fits_ && is_number && !__builtin_mul_overflow(amount, unit.nanoseconds, &product) &&
            !__builtin_add_overflow(sum_, product, &sum_) &&
            !__builtin_add_overflow(sum_, fractionOf(part.fraction, unit.nanoseconds), &sum_);
    return true;
  }

  std::string_view text_, rest_;
  Loc loc_;
  Diagnostics& diagnostics_;
  TimeValue& value_;
  uint64_t sum_ = 0;  // nanoseconds, without the sign
  bool fits_ = true;
};

}  // namespace

bool readDuration(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value) {
  value.kind = LiteralKind::Duration;
  value.is_long = isLong(text);
  return DurationReader(text, loc, diagnostics, value).run();
}

bool readDate(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value) {
  value.kind = LiteralKind::Date;
  value.is_long = isLong(text);
  std::string_view rest = afterHash(text);
  int64_t days = 0;
  if (!takeDate(rest, text, "D#2026-12-31", value.is_unsigned && value.is_long, loc, diagnostics, days)) return false;
  if (!rest.empty()) {
    diagnostics.report(diag::DateForm, loc, {text, "D#2026-12-31"});
    return false;
  }
  value.is_negative = days < 0;
  value.value = static_cast<uint64_t>(days) * kDay;
  return true;
}

bool readTimeOfDay(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value) {
  value.kind = LiteralKind::TimeOfDay;
  value.is_long = isLong(text);
  return takeTime(afterHash(text), text, "TOD#23:59:59.999", !value.is_long, loc, diagnostics, value.value);
}

bool readDateTime(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value) {
  static const char* const kSample = "DT#2026-12-31-23:59:59";
  value.kind = LiteralKind::DateTime;
  value.is_long = isLong(text);
  std::string_view rest = afterHash(text);
  int64_t days = 0;
  uint64_t time = 0;
  if (!takeDate(rest, text, kSample, value.is_unsigned && value.is_long, loc, diagnostics, days)) return false;
  if (!take(rest, '-')) {
    diagnostics.report(diag::DateForm, loc, {text, kSample});
    return false;
  }
  if (!takeTime(rest, text, kSample, false, loc, diagnostics, time)) return false;
  const uint64_t begin = static_cast<uint64_t>(days) * kDay;
  if (days >= 0 && begin + time < begin) {  // later on the last day
    diagnostics.report(diag::TimeTooLong, loc, {text});
    return false;
  }
  value.is_negative = days < 0;
  value.value = static_cast<uint64_t>(days) * kDay + time;
  return true;
}

namespace {

// Decodes the characters between the quotes.
class StringReader {
 public:
  StringReader(std::string_view inner, bool wide, Loc loc, Diagnostics& diagnostics, std::string& value)
      : inner_(inner), digits_(wide ? 4 : 2), loc_(loc), diagnostics_(diagnostics), value_(value) {}

  bool run() {
    for (size_t i = 0; i < inner_.size();) {
      if (inner_[i] == '$') {
        i = readEscape(i);
        continue;
      }
      endSurrogate();
      value_ += inner_[i++];
    }
    endSurrogate();
    return ok_;
  }

 private:
  bool isWide() const { return digits_ == 4; }
  void report(Diag message, size_t begin, std::string_view shown, std::string_view more = {}) {
    ok_ = false;
    diagnostics_.report(message, Loc{loc_.offset + 1 + static_cast<uint32_t>(begin)}, {shown, more})
        .length(static_cast<uint32_t>(shown.size()));
  }
  void reportNoCodePoint(size_t begin, size_t end) {
    report(diag::NoCodePoint, begin, inner_.substr(begin, end - begin));
  }

  // Half of a surrogate pair, `$D83D` without `$DD79` after it, is not a character.
  void endSurrogate() {
    if (high_surrogate_ != 0) reportNoCodePoint(surrogate_at_, surrogate_at_ + 5);
    high_surrogate_ = 0;
  }

  static bool isLowSurrogate(uint32_t code) { return code >= 0xDC00 && code < 0xE000; }

  // $41, in a wide string $0041: the code at `start`; false: there are other characters.
  bool findCode(size_t start, uint32_t& code) const {
    if (start + digits_ >= inner_.size()) return false;
    for (size_t k = 1; k <= digits_; ++k) {
      const int digit = hexDigit(inner_[start + k]);
      if (digit < 0) return false;
      code = code * 16 + static_cast<uint32_t>(digit);
    }
    return true;
  }

  // The character of $$, $' and $L; '\0': it is none of them.
  static char simpleEscape(char c) {
    switch (foldedCharacter(c)) {
      case '$':
      case '\'':
      case '"': return c;
      case 'l':
      case 'n': return '\n';
      case 'p': return '\f';
      case 'r': return '\r';
      case 't': return '\t';
      default: return '\0';
    }
  }

  // Reads from the `$` at start, and returns the end of it.
  size_t readEscape(size_t start) {
    const char next = start + 1 < inner_.size() ? inner_[start + 1] : '\0';
    uint32_t code = 0;
    const bool is_code = findCode(start, code);
    if (high_surrogate_ != 0 && !(is_code && isLowSurrogate(code))) endSurrogate();
    if (const char simple = simpleEscape(next); simple != '\0') {
      value_ += simple;
      return start + 2;
    }
    if (next == '{') return readCodePoint(start);
    if (is_code) {
      append(code, start);
      return start + 1 + digits_;
    }
    report(diag::StringEscape, start, inner_.substr(start, next == '\0' ? 1 : 2), isWide() ? "four" : "two");
    return start + 2;
  }

  // ${1F579}
  size_t readCodePoint(size_t start) {
    const size_t begin = start + 2, end = std::min(inner_.find('}', start), inner_.size());
    uint64_t point = 0;
    bool is_point = end < inner_.size() && end > begin;
    for (size_t k = begin; is_point && k < end; ++k) {
      const int digit = hexDigit(inner_[k]);
      is_point = digit >= 0 && point < 0x110000;
      point = point * 16 + static_cast<uint64_t>(digit);
    }
    if (is_point && point < 0x110000 && !(point >= 0xD800 && point < 0xE000))
      appendUtf8(value_, static_cast<uint32_t>(point));
    else
      reportNoCodePoint(start, end + 1);
    return end + 1;
  }

  void append(uint32_t code, size_t start) {
    if (!isWide()) {
      value_ += static_cast<char>(code);
    } else if (code >= 0xD800 && code < 0xDC00) {
      high_surrogate_ = code;
      surrogate_at_ = start;
    } else if (isLowSurrogate(code) && high_surrogate_ != 0) {
      appendUtf8(value_, 0x10000 + ((high_surrogate_ - 0xD800) << 10) + (code - 0xDC00));
      high_surrogate_ = 0;
    } else if (isLowSurrogate(code)) {
      reportNoCodePoint(start, start + 5);
    } else {
      appendUtf8(value_, code);
    }
  }

  std::string_view inner_;
  size_t digits_;  // of a character's code
  Loc loc_;
  Diagnostics& diagnostics_;
  std::string& value_;
  uint32_t high_surrogate_ = 0;  // read, and waiting for its other half; 0: none
  size_t surrogate_at_ = 0;
  bool ok_ = true;
};

}  // namespace

bool readString(std::string_view text, bool wide, Loc loc, Diagnostics& diagnostics, std::string& value) {
  std::string_view inner = text.substr(1);
  if (!inner.empty() && inner.back() == text.front()) inner.remove_suffix(1);
  value.clear();
  return StringReader(inner, wide, loc, diagnostics, value).run();
}

// Of the part that an address names: a bit, 8, 16, 32 or 64 bits.
static bool isSize(char c) { return c == 'x' || c == 'b' || c == 'w' || c == 'd' || c == 'l'; }

// %area [size] (number {. number} | *)
bool readAddress(std::string_view text, Loc loc, Diagnostics& diagnostics, DirectAddress& address,
                 std::vector<uint32_t>& path) {
  address = {};
  path.clear();
  std::string_view rest = text.substr(1);
  // The areas are sema's to know.
  address.area = rest.empty() ? '\0' : upper(rest.front());
  bool ok = address.area >= 'A' && address.area <= 'Z' && !isSize(foldedCharacter(address.area));
  address.size = 'X';
  if (ok) rest.remove_prefix(1);
  if (ok && !rest.empty()) {
    const char size = foldedCharacter(rest.front());
    if (isSize(size)) {
      address.size = upper(size);
      address.size_given = true;
      rest.remove_prefix(1);
    }
  }
  if (ok && take(rest, '*')) {
    address.incomplete = true;
    ok = rest.empty();
  } else if (ok) {
    do {
      uint64_t number = 0;
      ok = takeNumber(rest, number) && number <= 0xffffffffu;
      path.push_back(static_cast<uint32_t>(number));
    } while (ok && take(rest, '.'));
    ok = ok && rest.empty();
  }
  if (!ok) diagnostics.report(diag::AddressForm, loc, {text});
  return ok;
}

}  // namespace rung::text

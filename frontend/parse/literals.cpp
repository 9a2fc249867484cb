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

bool isTimeUnit(std::string_view text) {
  static constexpr std::string_view kUnits[] = {"d", "h", "m", "s", "ms", "us", "ns"};
  return std::any_of(std::begin(kUnits), std::end(kUnits),
                     [&](std::string_view unit) { return sameIdentifier(text, unit); });
}

// `_` only between digits; several in a row are left to the caller.
bool checkUnderscores(std::string_view digits, std::string_view text, Loc loc, Diagnostics& diagnostics,
                      NumberValue& value) {
  const auto isUnderscoreOrDigit = [](char c) { return c == '_' || hexDigit(c) >= 0; };
  for (size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] != '_') continue;
    if (i == 0 || i + 1 == digits.size() || !isUnderscoreOrDigit(digits[i - 1]) ||
        !isUnderscoreOrDigit(digits[i + 1])) {
      diagnostics.report(diag::NumberUnderscore, loc, {text});
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

constexpr uint64_t kSecond = 1000000000u, kMinute = 60 * kSecond, kHour = 60 * kMinute, kDay = 24 * kHour;

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
      size_t n = 0;
      while (n < text.size() && (isDigit(text[n]) || text[n] == '_')) ++n;
      fraction = fractionOf(text.substr(0, n), kSecond);
      ok = n > 0;
      text.remove_prefix(n);
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

}  // namespace

bool readNumber(std::string_view text, Loc loc, Diagnostics& diagnostics, NumberValue& value) {
  value = {};
  if (text.size() < 10) {  // the everyday case: a few decimal digits
    uint64_t n = 0;
    size_t i = 0;
    while (i < text.size() && isDigit(text[i])) n = n * 10 + static_cast<uint64_t>(text[i++] - '0');
    if (i == text.size()) {
      value.integer = n;
      return true;
    }
  }
  if (const size_t hash = text.find('#'); hash != std::string_view::npos) {
    const std::string_view base_digits = text.substr(0, hash), digits = text.substr(hash + 1);
    const uint32_t base = base_digits == "2"    ? 2
                          : base_digits == "8"  ? 8
                          : base_digits == "16" ? 16
                          : base_digits == "10" ? 10
                                                : 0;
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
      if (__builtin_mul_overflow(value.integer, static_cast<uint64_t>(base), &value.integer) ||
          __builtin_add_overflow(value.integer, static_cast<uint64_t>(digit), &value.integer)) {
        diagnostics.report(diag::NumberTooLarge, loc, {text});
        return false;
      }
    }
    return checkUnderscores(digits, text, loc, diagnostics, value);
  }
  size_t i = 0;
  while (i < text.size() && (isDigit(text[i]) || text[i] == '_')) ++i;
  value.is_real = i < text.size() && (text[i] == '.' || (foldedCharacter(text[i]) == 'e' && i + 1 < text.size()));
  if (value.is_real) {
    std::string plain;
    for (char c : text)
      if (c != '_') plain += c;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value.real);
    if (end != plain.data() + plain.size() && isTimeUnit(std::string_view(end, plain.data() + plain.size()))) {
      diagnostics.report(diag::DurationWithoutPrefix, loc, {text});
      return false;
    }
    if (end != plain.data() + plain.size()) {
      diagnostics.report(diag::NumberSuffix, loc, {text});
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
  if (i != text.size() && isTimeUnit(text.substr(i))) {
    diagnostics.report(diag::DurationWithoutPrefix, loc, {text});
    return false;
  }
  if (i != text.size()) {
    const std::string based = basedForm(text);
    Report report = diagnostics.report(diag::NumberSuffix, loc, {text});
    if (!based.empty()) report.note({}, Note{"write `{0}`"}, {based});
    return false;
  }
  for (char c : text) {
    if (c == '_') continue;
    if (__builtin_mul_overflow(value.integer, 10u, &value.integer) ||
        __builtin_add_overflow(value.integer, static_cast<uint64_t>(c - '0'), &value.integer)) {
      diagnostics.report(diag::NumberTooLarge, loc, {text});
      return false;
    }
  }
  return checkUnderscores(text, text, loc, diagnostics, value);
}

// duration = ["-"] number unit {["_"] number unit}. Only the first unit may exceed its range, as in T#100s12ms; value
// tells which other one does. IEC 61131-3 ed. 2, 2.2.3.1.
bool readDuration(std::string_view text, Loc loc, Diagnostics& diagnostics, TimeValue& value) {
  value.kind = LiteralKind::Duration;
  value.is_long = isLong(text);
  std::string_view rest = afterHash(text);
  const auto at = [&] { return Loc{loc.offset + static_cast<uint32_t>(text.size() - rest.size())}; };
  value.is_negative = take(rest, '-');
  if (!value.is_negative) take(rest, '+');
  struct Unit {
    const char* name;
    uint64_t nanoseconds;
  };
  static constexpr Unit kUnits[] = {{"d", kDay},     {"h", kHour}, {"m", kMinute}, {"s", kSecond},
                                    {"ms", 1000000}, {"us", 1000}, {"ns", 1}};
  size_t next_unit = 0;
  bool had_fraction = false;
  bool first = true;
  uint64_t sum = 0;
  bool fits = true;
  Loc last_part;
  std::string_view last_text;
  if (rest.empty()) {
    diagnostics.report(diag::TimeUnit, loc, {text});
    return false;
  }
  while (!rest.empty()) {
    if (next_unit > 0 && take(rest, '_') && rest.empty()) {
      diagnostics.report(diag::TimeEndsWithUnderscore, loc, {text});
      return false;
    }
    const Loc part = at();
    const std::string_view part_text = rest;
    if (had_fraction) {
      diagnostics.report(diag::TimeFraction, last_part, {last_text}).length(static_cast<uint32_t>(last_text.size()));
      return false;
    }
    size_t n = 0;
    while (n < rest.size() && (isDigit(rest[n]) || rest[n] == '_')) ++n;
    std::string_view digits = rest.substr(0, n);
    rest.remove_prefix(n);
    std::string_view fraction;
    if (take(rest, '.')) {
      n = 0;
      while (n < rest.size() && (isDigit(rest[n]) || rest[n] == '_')) ++n;
      fraction = rest.substr(0, n);
      rest.remove_prefix(n);
      had_fraction = true;
    }
    n = 0;
    while (n < rest.size() && !isDigit(rest[n]) && rest[n] != '_' && rest[n] != '.') ++n;
    const std::string_view unit = rest.substr(0, n);
    size_t u = 0;
    while (u < 7 && !sameIdentifier(unit, kUnits[u].name)) ++u;
    if (u == 7 || digits.empty()) {
      const std::string_view shown = unit.empty() || digits.empty() ? part_text : unit;
      diagnostics.report(diag::TimeUnit, unit.empty() || digits.empty() ? part : at(), {shown})
          .length(static_cast<uint32_t>(shown.size()));
      return false;
    }
    if (u < next_unit) {
      diagnostics.report(diag::TimeUnitOrder, at(), {unit}).length(static_cast<uint32_t>(n));
      return false;
    }
    rest.remove_prefix(n);
    last_part = part;
    last_text = part_text.substr(0, part_text.size() - rest.size());
    next_unit = u + 1;
    uint64_t amount = 0, product = 0;
    NumberValue grouped;
    if (!checkUnderscores(digits, text, loc, diagnostics, grouped)) return false;
    const uint64_t most = u == 1 ? 24 : u < 4 ? 60 : 1000;  // of a unit after the first
    uint64_t written = 0;
    std::string_view copy = digits;
    value.overflows = value.overflows || (!first && (!takeNumber(copy, written) || written >= most));
    first = false;
    fits = fits && takeNumber(digits, amount) && !__builtin_mul_overflow(amount, kUnits[u].nanoseconds, &product) &&
           !__builtin_add_overflow(sum, product, &sum) &&
           !__builtin_add_overflow(sum, fractionOf(fraction, kUnits[u].nanoseconds), &sum);
  }
  if (!fits || (value.is_negative && sum > (1ull << 63))) {
    diagnostics.report(diag::TimeTooLong, loc, {text});
    return false;
  }
  value.value = value.is_negative ? 0 - sum : sum;
  return true;
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

bool readString(std::string_view text, bool wide, Loc loc, Diagnostics& diagnostics, std::string& value) {
  std::string_view inner = text.substr(1);
  if (!inner.empty() && inner.back() == text.front()) inner.remove_suffix(1);
  value.clear();
  bool ok = true;
  uint32_t high_surrogate = 0;
  size_t surrogate_at = 0;
  const auto reportNoCodePoint = [&](size_t begin, size_t end) {
    const std::string_view shown = inner.substr(begin, end - begin);
    diagnostics.report(diag::NoCodePoint, Loc{loc.offset + 1 + static_cast<uint32_t>(begin)}, {shown})
        .length(static_cast<uint32_t>(shown.size()));
    ok = false;
  };
  // Half of a surrogate pair, `$D83D` without `$DD79` after it, is not a character.
  const auto endSurrogate = [&] {
    if (high_surrogate != 0) reportNoCodePoint(surrogate_at, surrogate_at + 5);
    high_surrogate = 0;
  };
  for (size_t i = 0; i < inner.size(); ++i) {
    const char c = inner[i];
    if (c != '$') {
      endSurrogate();
      value += c;
      continue;
    }
    const size_t start = i;
    const char next = i + 1 < inner.size() ? inner[i + 1] : '\0';
    const size_t digits = wide ? 4 : 2;
    bool is_code = i + digits < inner.size();
    uint32_t code = 0;
    for (size_t k = 1; is_code && k <= digits; ++k) {
      const int h = hexDigit(inner[i + k]);
      is_code = h >= 0;
      code = code * 16 + static_cast<uint32_t>(h);
    }
    ++i;
    if (high_surrogate != 0 && !(is_code && code >= 0xDC00 && code < 0xE000)) endSurrogate();
    switch (foldedCharacter(next)) {
      case '$':
      case '\'':
      case '"': value += next; continue;
      case 'l': value += '\n'; continue;
      case 'n': value += '\n'; continue;
      case 'p': value += '\f'; continue;
      case 'r': value += '\r'; continue;
      case 't': value += '\t'; continue;
      default: break;
    }
    if (next == '{') {
      const size_t end = std::min(inner.find('}', i), inner.size());
      uint64_t point = 0;
      bool is_point = end < inner.size() && end > i + 1;
      for (size_t k = i + 1; is_point && k < end; ++k) {
        const int h = hexDigit(inner[k]);
        is_point = h >= 0 && point < 0x110000;
        point = point * 16 + static_cast<uint64_t>(h);
      }
      if (is_point && point < 0x110000 && !(point >= 0xD800 && point < 0xE000)) {
        appendUtf8(value, static_cast<uint32_t>(point));
      } else {
        reportNoCodePoint(start, end + 1);
      }
      i = end;
      continue;
    }
    if (!is_code) {
      const std::string_view shown = inner.substr(start, next == '\0' ? 1 : 2);
      diagnostics
          .report(diag::StringEscape, Loc{loc.offset + 1 + static_cast<uint32_t>(start)},
                  {shown, wide ? "four" : "two"})
          .length(static_cast<uint32_t>(shown.size()));
      ok = false;
      continue;
    }
    i = start + digits;
    if (!wide) {
      value += static_cast<char>(code);
    } else if (code >= 0xD800 && code < 0xDC00) {
      high_surrogate = code;
      surrogate_at = start;
    } else if (code >= 0xDC00 && code < 0xE000 && high_surrogate != 0) {
      appendUtf8(value, 0x10000 + ((high_surrogate - 0xD800) << 10) + (code - 0xDC00));
      high_surrogate = 0;
    } else if (code >= 0xDC00 && code < 0xE000) {
      reportNoCodePoint(start, start + 5);
    } else {
      appendUtf8(value, code);
    }
  }
  endSurrogate();
  return ok;
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

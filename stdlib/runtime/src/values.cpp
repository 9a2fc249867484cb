// SPDX-License-Identifier: Apache-2.0
// Formats and parses values, see rung/values.h. Dates count from 1970-01-01 in the Gregorian calendar: DATE and DT in
// 32-bit seconds, TOD in 32-bit milliseconds since midnight, the L-forms in 64-bit nanoseconds.
#include "rung/values.h"

#include <string.h>

#include "rung/code.h"
#include "rung/reals.h"
#include "text.h"

namespace {

constexpr uint64_t kNsPerMs = 1'000'000, kNsPerSecond = 1'000'000'000;
constexpr uint64_t kSecondsPerDay = 86'400, kNsPerDay = kSecondsPerDay * kNsPerSecond;

// ---- formatting

class Writer {
 public:
  Writer(char* out, uint32_t capacity) : out_(out), capacity_(capacity) {}
  void put(char c) {
    if (length_ < capacity_) out_[length_++] = c;
  }
  void put(const char* text) {
    while (*text != 0) put(*text++);
  }
  void number(uint64_t value, int digits = 1) {
    char buffer[20];
    int n = 0;
    for (; value != 0 || n < digits; value /= 10) buffer[n++] = static_cast<char>('0' + value % 10);
    while (n > 0) put(buffer[--n]);
  }
  void hex(uint32_t value, int digits) {
    while (digits-- > 0) put("0123456789ABCDEF"[value >> (4 * digits) & 15]);
  }
  uint32_t finish() {
    out_[length_] = 0;
    return length_;
  }

 private:
  char* out_;
  uint32_t capacity_;
  uint32_t length_ = 0;
};

template <class T>
T load(const void* from) {
  T value;
  memcpy(&value, from, sizeof value);
  return value;
}

void formatSigned(Writer& to, int64_t value) {
  if (value < 0) to.put('-');
  to.number(value < 0 ? 0 - static_cast<uint64_t>(value) : static_cast<uint64_t>(value));
}

void formatReal(Writer& to, double value, bool is_single) {
  char buffer[RUNG_REAL_ROOM + 1];
  buffer[rung_real_format(value, is_single, buffer)] = 0;
  to.put(buffer);
  if (strpbrk(buffer, ".eNI") == nullptr) to.put(".0");  // and not of `NaN` or `Inf`
}

void formatDuration(Writer& to, uint64_t magnitude, bool negative, bool nanoseconds) {
  to.put(nanoseconds ? "LTIME#" : "T#");
  if (negative) to.put('-');
  if (magnitude == 0) return to.put(nanoseconds ? "0ns" : "0ms");
  struct Unit {
    uint64_t ns;
    const char* name;
  };
  static const Unit units[] = {{kNsPerDay, "d"},
                               {3600 * kNsPerSecond, "h"},
                               {60 * kNsPerSecond, "m"},
                               {kNsPerSecond, "s"},
                               {kNsPerMs, "ms"},
                               {1000, "us"},
                               {1, "ns"}};
  for (const Unit& unit : units) {
    if (magnitude < unit.ns) continue;
    to.number(magnitude / unit.ns);
    to.put(unit.name);
    magnitude %= unit.ns;
  }
}

struct Civil {
  int64_t year;
  uint32_t month, day;
};

// Howard Hinnant's days_from_civil and its inverse, with 1970-01-01 as day 0.
Civil civilOf(int64_t days) {
  days += 719468;
  const int64_t era = (days >= 0 ? days : days - 146096) / 146097;
  const uint32_t day_of_era = static_cast<uint32_t>(days - era * 146097);
  const uint32_t year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const uint32_t day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const uint32_t shifted = (5 * day_of_year + 2) / 153;
  const uint32_t month = shifted < 10 ? shifted + 3 : shifted - 9;
  return {static_cast<int64_t>(year_of_era) + era * 400 + (month <= 2 ? 1 : 0), month,
          day_of_year - (153 * shifted + 2) / 5 + 1};
}
int64_t daysOf(int64_t year, uint32_t month, uint32_t day) {
  year -= month <= 2 ? 1 : 0;
  const int64_t era = (year >= 0 ? year : year - 399) / 400;
  const uint32_t year_of_era = static_cast<uint32_t>(year - era * 400);
  const uint32_t day_of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  const uint32_t day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return era * 146097 + static_cast<int64_t>(day_of_era) - 719468;
}

void formatDate(Writer& to, int64_t days) {
  const Civil civil = civilOf(days);
  to.number(static_cast<uint64_t>(civil.year), 4);
  to.put('-');
  to.number(civil.month, 2);
  to.put('-');
  to.number(civil.day, 2);
}

// hh:mm:ss, and the fraction, unless zero, without trailing zeros.
void formatClock(Writer& to, uint64_t ns) {
  to.number(ns / (3600 * kNsPerSecond), 2);
  to.put(':');
  to.number(ns / (60 * kNsPerSecond) % 60, 2);
  to.put(':');
  to.number(ns / kNsPerSecond % 60, 2);
  uint64_t fraction = ns % kNsPerSecond;
  if (fraction == 0) return;
  int digits = 9;
  for (; fraction % 10 == 0; fraction /= 10) --digits;
  to.put('.');
  to.number(fraction, digits);
}

// One character of a string between `quote`s; `code` below 0x80.
void formatAscii(Writer& to, uint32_t code, char quote, int hex_digits) {
  switch (code) {
    case '$': return to.put("$$");
    case '\n': return to.put("$L");
    case '\r': return to.put("$R");
    case '\f': return to.put("$P");
    case '\t': return to.put("$T");
    default: break;
  }
  if (code == static_cast<unsigned char>(quote)) {
    to.put('$');
    to.put(quote);
  } else if (code >= 0x20 && code < 0x7f) {
    to.put(static_cast<char>(code));
  } else {
    to.put('$');
    to.hex(code, hex_digits);
  }
}

// Length of the UTF-8 sequence of a character above 0x7f at the front of `size` bytes, or 0 when there is none.
uint32_t utf8Length(const unsigned char* text, uint32_t size) {
  const uint32_t length = text[0] >= 0xf0 && text[0] <= 0xf4 ? 4 : text[0] >= 0xe0 ? 3 : text[0] >= 0xc2 ? 2 : 0;
  if (length == 0 || length > size || text[0] > 0xf4) return 0;
  for (uint32_t i = 1; i < length; ++i)
    if ((text[i] & 0xc0) != 0x80) return 0;
  const bool overlong = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
  const bool outside = (text[0] == 0xed && text[1] > 0x9f) || (text[0] == 0xf4 && text[1] > 0x8f);
  return overlong || outside ? 0 : length;
}

// Strings end with NUL, at the latest after `size` characters.
void formatString(Writer& to, const unsigned char* text, uint32_t size = UINT32_MAX) {
  to.put('\'');
  for (uint32_t at = 0; at < size && text[at] != 0;) {
    const uint32_t length = text[at] < 0x80 ? 0 : utf8Length(text + at, size - at);
    if (length == 0) formatAscii(to, text[at++], '\'', 2);
    for (uint32_t i = 0; i < length; ++i) to.put(static_cast<char>(text[at++]));
  }
  to.put('\'');
}

void putUtf8(Writer& to, uint32_t code) {
  char bytes[4];
  const uint32_t count = rung_utf8(code, bytes);
  for (uint32_t i = 0; i < count; ++i) to.put(bytes[i]);
}

void formatWString(Writer& to, const char16_t* text, uint32_t size = UINT32_MAX) {
  to.put('"');
  for (uint32_t i = 0; i < size && rung_unit(text, i) != 0; ++i) {
    const uint32_t unit = rung_unit(text, i), next = i + 1 < size ? rung_unit(text, i + 1) : 0u;
    if (unit < 0x80) {
      formatAscii(to, unit, '"', 4);
    } else if (unit >= 0xd800 && unit < 0xdc00 && next >= 0xdc00 && next < 0xe000) {
      putUtf8(to, 0x10000 + ((unit - 0xd800) << 10) + (next - 0xdc00u));
      ++i;
    } else if (unit >= 0xd800 && unit < 0xe000) {
      to.put('$');
      to.hex(unit, 4);
    } else {
      putUtf8(to, unit);
    }
  }
  to.put('"');
}

void formatTime(Writer& to, bool is_signed, uint32_t ms) {
  const bool negative = is_signed && ms >> 31 != 0;
  formatDuration(to, (negative ? 0 - ms : ms) * kNsPerMs, negative, false);
}

void formatLongTime(Writer& to, bool is_signed, uint64_t ns) {
  const bool negative = is_signed && ns >> 63 != 0;
  formatDuration(to, negative ? 0 - ns : ns, negative, true);
}

void formatDateAndClock(Writer& to, uint64_t ns) {
  formatDate(to, static_cast<int64_t>(ns / kNsPerDay));
  to.put('-');
  formatClock(to, ns % kNsPerDay);
}

// A date, a time of day, or both, with the prefix of its literal.
void formatMoment(Writer& to, uint8_t kind, const void* value) {
  switch (kind) {
    case RUNG_DATE: to.put("D#"); return formatDate(to, load<uint32_t>(value) / static_cast<int64_t>(kSecondsPerDay));
    case RUNG_LDATE: to.put("LDATE#"); return formatDate(to, static_cast<int64_t>(load<uint64_t>(value) / kNsPerDay));
    case RUNG_TOD: to.put("TOD#"); return formatClock(to, load<uint32_t>(value) * kNsPerMs);
    case RUNG_LTOD: to.put("LTOD#"); return formatClock(to, load<uint64_t>(value));
    case RUNG_DT: to.put("DT#"); return formatDateAndClock(to, load<uint32_t>(value) * kNsPerSecond);
    default: to.put("LDT#"); return formatDateAndClock(to, load<uint64_t>(value));
  }
}

// A CHAR, WCHAR or UCHAR, as a string of one character.
void formatCharacter(Writer& to, uint8_t kind, const void* value) {
  if (kind == RUNG_WCHAR) {
    const char16_t text[2] = {load<char16_t>(value), 0};
    return formatWString(to, text);
  }
  if (kind == RUNG_CHAR) {
    const unsigned char text[2] = {load<unsigned char>(value), 0};
    return formatString(to, text);
  }
  char text[5];
  rung_ustring_of_code(text, 4, load<uint32_t>(value));
  formatString(to, reinterpret_cast<const unsigned char*>(text));
}

// ---- parsing

struct Reader {
  const char* at;
  const char* end;
  bool done() const { return at == end; }
  char peek() const { return at == end ? '\0' : *at; }
  bool take(char c) {
    if (rung_lower(peek()) != c || at == end) return false;
    ++at;
    return true;
  }
  // Takes a word in any case, whole or not at all.
  bool take(const char* word) {
    const char* p = at;
    for (; *word != 0; ++word, ++p)
      if (p == end || rung_lower(*p) != *word) return false;
    at = p;
    return true;
  }
  bool digits(uint64_t& value, uint32_t base = 10, int* count = nullptr) {
    value = 0;
    int n = 0;
    for (; at != end; ++at) {
      if (*at == '_' && n > 0) continue;
      const uint32_t digit = rung_digit(*at);
      if (digit >= base) break;
      if (value > (UINT64_MAX - digit) / base) return false;
      value = value * base + digit;
      ++n;
    }
    if (count != nullptr) *count = n;
    return n > 0;
  }
};

const char* const kTypeNames[] = {"bool", "byte",  "word", "dword", "lword", "sint", "int",  "dint",
                                  "lint", "usint", "uint", "udint", "ulint", "real", "lreal"};

// Skips `INT#` before a number: the name of any elementary type, since the value must fit anyway.
void skipTypePrefix(Reader& from) {
  for (const char* name : kTypeNames) {
    Reader ahead = from;
    if (ahead.take(name) && ahead.take('#')) {
      from = ahead;
      return;
    }
  }
}

struct Integer {
  uint64_t magnitude = 0;
  bool negative = false;
};

bool readInteger(Reader from, Integer& value) {
  skipTypePrefix(from);
  value.negative = from.take('-');
  if (!value.negative) from.take('+');
  if (!from.digits(value.magnitude)) return false;
  if (value.magnitude <= 16 && from.take('#')) {
    const uint64_t base = value.magnitude;
    if ((base != 2 && base != 8 && base != 16) || !from.digits(value.magnitude, static_cast<uint32_t>(base)))
      return false;
  }
  return from.done();
}

struct IntegerFormat {
  uint8_t bytes;
  bool is_signed;
};
IntegerFormat formatOf(uint8_t kind) {
  switch (kind) {
    case RUNG_BYTE:
    case RUNG_USINT: return {1, false};
    case RUNG_WORD:
    case RUNG_UINT: return {2, false};
    case RUNG_DWORD:
    case RUNG_UDINT: return {4, false};
    case RUNG_LWORD:
    case RUNG_ULINT: return {8, false};
    case RUNG_SINT: return {1, true};
    case RUNG_INT: return {2, true};
    case RUNG_DINT: return {4, true};
    case RUNG_LINT: return {8, true};
    default: return {0, false};
  }
}

bool storeInteger(const Integer& value, IntegerFormat format_of, void* to) {
  const int width = format_of.bytes * 8;
  const uint64_t most = UINT64_MAX >> (64 - width + (format_of.is_signed ? 1 : 0));
  if (value.negative && value.magnitude != 0) {
    if (!format_of.is_signed || value.magnitude > most + 1) return false;
  } else if (value.magnitude > most) {
    return false;
  }
  const uint64_t bits = value.negative ? 0 - value.magnitude : value.magnitude;
  memcpy(to, &bits, format_of.bytes);  // little-endian
  return true;
}

bool readReal(Reader from, bool is_single, double& value) {
  skipTypePrefix(from);
  const bool negative = from.take('-');
  if (!negative) from.take('+');
  if (from.take("nan") && from.done()) {
    value = __builtin_nan("");
    return true;
  }
  if (from.take("inf")) {
    value = __builtin_inf();
  } else {
    char text[400];
    size_t size = 0;
    for (; !from.done(); ++from.at) {
      if (*from.at == '_') continue;
      if (size == sizeof text) return false;
      text[size++] = *from.at;
    }
    if (size == 0 || text[0] < '0' || text[0] > '9') return false;
    from.at = from.end;
    size_t read = size;
    const rung_real_result result = rung_real_parse(text, &read, is_single, &value);
    if (read != size) {
      Integer integer;  // 16#FF
      if (!readInteger({text, text + size}, integer)) return false;
      value = is_single ? static_cast<double>(static_cast<float>(integer.magnitude))
                        : static_cast<double>(integer.magnitude);
    } else if (result != RUNG_REAL_READ) {
      return false;
    }
  }
  if (negative) value = -value;
  return from.done();
}

// `T#1d2h7m19s45.7ms`, `TIME#-5s`, `LT#500us`: nanoseconds.
bool readDuration(Reader from, Integer& value) {
  if (!(from.take("ltime#") || from.take("time#") || from.take("lt#") || from.take("t#"))) return false;
  value.negative = from.take('-');
  value.magnitude = 0;
  uint64_t last_unit = UINT64_MAX;
  do {
    uint64_t whole = 0, fraction = 0;
    int fraction_digits = 0;
    if (!from.digits(whole)) return false;
    if (from.take('.') && (!from.digits(fraction, 10, &fraction_digits) || fraction_digits > 18)) return false;
    uint64_t unit = 0;
    if (from.take("ms"))
      unit = kNsPerMs;
    else if (from.take("us"))
      unit = 1000;
    else if (from.take("ns"))
      unit = 1;
    else if (from.take('d'))
      unit = kNsPerDay;
    else if (from.take('h'))
      unit = 3600 * kNsPerSecond;
    else if (from.take('m'))
      unit = 60 * kNsPerSecond;
    else if (from.take('s'))
      unit = kNsPerSecond;
    if (unit == 0 || unit >= last_unit) return false;
    last_unit = unit;
    if (whole > (UINT64_MAX - value.magnitude) / unit) return false;
    value.magnitude += whole * unit;
    double scale = 1;
    for (int i = 0; i < fraction_digits; ++i) scale *= 10;
    // Not negative: the conversion rounds down.
    value.magnitude += static_cast<uint64_t>(static_cast<double>(fraction) * static_cast<double>(unit) / scale + 1e-9);
    from.take('_');
  } while (!from.done());
  return true;
}

bool readCalendar(Reader& from, int64_t& days) {
  uint64_t year, month, day;
  if (!from.digits(year) || !from.take('-') || !from.digits(month) || !from.take('-') || !from.digits(day))
    return false;
  static const uint8_t lengths[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (month < 1 || month > 12 || year < 1970 || year > 2554) return false;
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  if (day < 1 || day > lengths[month - 1] + (month == 2 && leap ? 1u : 0u)) return false;
  days = daysOf(static_cast<int64_t>(year), static_cast<uint32_t>(month), static_cast<uint32_t>(day));
  return true;
}

bool readClock(Reader& from, uint64_t& ns) {
  uint64_t hours, minutes, seconds = 0, fraction = 0;
  int digits = 0;
  if (!from.digits(hours) || !from.take(':') || !from.digits(minutes)) return false;
  if (from.take(':') && !from.digits(seconds)) return false;
  if (from.take('.') && (!from.digits(fraction, 10, &digits) || digits > 9)) return false;
  for (; digits > 0 && digits < 9; ++digits) fraction *= 10;
  if (hours > 23 || minutes > 59 || seconds > 59) return false;
  ns = ((hours * 60 + minutes) * 60 + seconds) * kNsPerSecond + fraction;
  return true;
}

// Nanoseconds since 1970-01-01 (DATE, DT) or since midnight (TOD).
bool readDate(uint8_t kind, Reader from, uint64_t& ns) {
  int64_t days = 0;
  uint64_t clock = 0;
  switch (kind) {
    case RUNG_DATE:
    case RUNG_LDATE:
      if (!(from.take("ldate#") || from.take("date#") || from.take("ld#") || from.take("d#"))) return false;
      if (!readCalendar(from, days)) return false;
      break;
    case RUNG_TOD:
    case RUNG_LTOD:
      if (!(from.take("ltime_of_day#") || from.take("time_of_day#") || from.take("ltod#") || from.take("tod#")))
        return false;
      if (!readClock(from, clock)) return false;
      break;
    default:
      if (!(from.take("ldate_and_time#") || from.take("date_and_time#") || from.take("ldt#") || from.take("dt#")))
        return false;
      if (!readCalendar(from, days) || !from.take('-') || !readClock(from, clock)) return false;
      break;
  }
  ns = static_cast<uint64_t>(days) * kNsPerDay + clock;
  return from.done();
}

// The next character of a quoted string: a code unit of `hex_digits` digits or a code point in braces; false at the
// closing quote. `bad` is set for an invalid escape.
bool readEscaped(Reader& from, char quote, int hex_digits, uint32_t& code, bool& bad) {
  if (from.done() || *from.at == quote) return false;
  if (*from.at != '$') {
    code = static_cast<unsigned char>(*from.at++);
    return true;
  }
  ++from.at;
  const char c = rung_lower(from.peek());
  static const char kNames[] = "lnrpt$'\"";
  static const char kCodes[] = "\n\n\r\f\t$'\"";
  if (c != 0) {
    if (const char* found = strchr(kNames, c)) {
      code = static_cast<unsigned char>(kCodes[found - kNames]);
      ++from.at;
      return true;
    }
  }
  code = 0;
  const bool is_point = from.take('{');
  for (int i = 0; is_point ? from.peek() != '}' || i == 0 : i < hex_digits; ++i) {
    const uint32_t digit = rung_digit(from.peek());
    if (digit > 15) return bad = true, false;
    code = code * 16 + digit;
    if (code >= 0x110000) return bad = true, false;
    ++from.at;
  }
  if (!is_point) return true;
  ++from.at;
  bad = code >= 0xd800 && code < 0xe000;
  return !bad;
}

// Reads `'...'`; with `to` null only checks. At most `length` characters are stored, then NUL.
bool readString(Reader from, uint32_t length, char* to) {
  if (!from.take("string#")) from.take("ustring#");
  if (!from.take('\'')) return false;
  uint32_t n = 0, code = 0;
  bool bad = false;
  for (;;) {
    const bool is_point = from.end - from.at > 1 && from.at[0] == '$' && from.at[1] == '{';
    if (!readEscaped(from, '\'', 2, code, bad)) break;
    if (to == nullptr) continue;
    if (is_point) {
      n += rung_ustring_of_code(to + n, length - n, code);
    } else if (n < length) {
      to[n++] = static_cast<char>(code);
    }
  }
  if (to != nullptr) to[n] = 0;
  return !bad && from.take('\'') && from.done();
}

bool readWString(Reader from, uint32_t length, char16_t* to) {
  from.take("wstring#");
  if (!from.take('"')) return false;
  uint32_t n = 0, code = 0;
  bool bad = false;
  for (;;) {
    const unsigned char* at = reinterpret_cast<const unsigned char*>(from.at);
    // The closing quote is ASCII, so a sequence never reads past it.
    if (!from.done() && *at >= 0x80) {
      const auto left = static_cast<size_t>(from.end - from.at);
      const uint32_t bytes = utf8Length(at, left < 4 ? static_cast<uint32_t>(left) : 4);
      if (bytes == 0) return false;
      code = at[0] & (0xffu >> (bytes + 1));
      for (uint32_t i = 1; i < bytes; ++i) code = code << 6 | (at[i] & 0x3fu);
      from.at += bytes;
    } else if (!readEscaped(from, '"', 4, code, bad)) {
      break;
    }
    if (to == nullptr) continue;
    if (code >= 0x10000) {
      if (n + 1 < length) {
        rung_set_unit(to, n++, static_cast<char16_t>(0xd800 + ((code - 0x10000) >> 10)));
        rung_set_unit(to, n++, static_cast<char16_t>(0xdc00 + ((code - 0x10000) & 0x3ff)));
      } else {
        length = n;  // never half of a pair
      }
    } else if (n < length) {
      rung_set_unit(to, n++, static_cast<char16_t>(code));
    }
  }
  if (to != nullptr) rung_set_unit(to, n, 0);
  return !bad && from.take('"') && from.done();
}

template <class T>
void store(void* to, T value) {
  memcpy(to, &value, sizeof value);
}

}  // namespace

uint32_t rung_format(uint8_t kind, bool is_signed, const void* value, char* out, uint32_t capacity) {
  Writer to(out, capacity);
  switch (static_cast<rung_type_kind>(kind)) {
    case RUNG_BOOL: to.put(load<uint8_t>(value) != 0 ? "TRUE" : "FALSE"); break;
    case RUNG_BYTE:
    case RUNG_USINT: to.number(load<uint8_t>(value)); break;
    case RUNG_WORD:
    case RUNG_UINT: to.number(load<uint16_t>(value)); break;
    case RUNG_DWORD:
    case RUNG_UDINT: to.number(load<uint32_t>(value)); break;
    case RUNG_LWORD:
    case RUNG_ULINT: to.number(load<uint64_t>(value)); break;
    case RUNG_SINT: formatSigned(to, load<int8_t>(value)); break;
    case RUNG_INT: formatSigned(to, load<int16_t>(value)); break;
    case RUNG_DINT: formatSigned(to, load<int32_t>(value)); break;
    case RUNG_LINT: formatSigned(to, load<int64_t>(value)); break;
    case RUNG_REAL: formatReal(to, static_cast<double>(load<float>(value)), true); break;
    case RUNG_LREAL: formatReal(to, load<double>(value), false); break;
    case RUNG_TIME: formatTime(to, is_signed, load<uint32_t>(value)); break;
    case RUNG_LTIME: formatLongTime(to, is_signed, load<uint64_t>(value)); break;
    case RUNG_DATE:
    case RUNG_LDATE:
    case RUNG_TOD:
    case RUNG_LTOD:
    case RUNG_DT:
    case RUNG_LDT: formatMoment(to, kind, value); break;
    case RUNG_CHAR:
    case RUNG_WCHAR:
    case RUNG_UCHAR: formatCharacter(to, kind, value); break;
    case RUNG_STRING:
    case RUNG_USTRING: formatString(to, static_cast<const unsigned char*>(value)); break;
    case RUNG_WSTRING: formatWString(to, static_cast<const char16_t*>(value)); break;
    case RUNG_ENUM:
    case RUNG_ARRAY:
    case RUNG_RECORD:
    case RUNG_POINTER: break;  // parsed by the host: they need the module's tables
  }
  return to.finish();
}

uint32_t rung_format_string(uint8_t kind, const void* value, uint32_t length, char* out, uint32_t capacity) {
  Writer to(out, capacity);
  if (kind == RUNG_WSTRING)
    formatWString(to, static_cast<const char16_t*>(value), length);
  else
    formatString(to, static_cast<const unsigned char*>(value), length);
  return to.finish();
}

namespace {

bool parseBool(const Reader& from, void* value) {
  Reader word = from;
  if (word.take("bool#"), word.take("true") && word.done()) return store<uint8_t>(value, 1), true;
  word = from;
  if (word.take("bool#"), word.take("false") && word.done()) return store<uint8_t>(value, 0), true;
  Integer integer;
  if (!readInteger(from, integer) || integer.negative || integer.magnitude > 1) return false;
  store<uint8_t>(value, static_cast<uint8_t>(integer.magnitude));
  return true;
}

bool parseReal(const Reader& from, bool is_single, void* value) {
  double real = 0;
  if (!readReal(from, is_single, real)) return false;
  if (is_single)
    store(value, static_cast<float>(real));
  else
    store(value, real);
  return true;
}

bool parseDate(uint8_t kind, const Reader& from, void* value) {
  uint64_t ns;
  if (!readDate(kind, from, ns)) return false;
  if (kind == RUNG_LDATE || kind == RUNG_LTOD || kind == RUNG_LDT) return store(value, ns), true;
  const uint64_t scaled = ns / (kind == RUNG_TOD ? kNsPerMs : kNsPerSecond);
  if (scaled > UINT32_MAX) return false;
  store(value, static_cast<uint32_t>(scaled));
  return true;
}

bool parseTime(bool is_long, bool is_signed, const Reader& from, void* value) {
  Integer ns;
  if (!readDuration(from, ns)) return false;
  if (!is_long) ns.magnitude /= kNsPerMs;
  return storeInteger(ns, {static_cast<uint8_t>(is_long ? 8 : 4), is_signed}, value);
}

// Nothing is stored where the text is not of the kind: it is read once only to check it.
bool parseString(uint8_t kind, const Reader& from, uint32_t length, void* value) {
  if (kind == RUNG_WSTRING)
    return readWString(from, length, nullptr) && readWString(from, length, static_cast<char16_t*>(value));
  char* const string = static_cast<char*>(value);
  if (!readString(from, length, nullptr)) return false;
  const bool is_read = readString(from, length, string);
  if (kind == RUNG_USTRING)
    rung_ustring_of_string(string, rung_ustring_whole(string, rung_string_length(string)), string);
  return is_read;
}

bool parseCharacter(uint8_t kind, const Reader& from, void* value) {
  if (kind == RUNG_WCHAR) {
    char16_t one[2];
    if (!parseString(RUNG_WSTRING, from, 1, one)) return false;
    store(value, one[0]);
    return true;
  }
  char one[5];
  if (!parseString(RUNG_STRING, from, kind == RUNG_CHAR ? 1 : 4, one)) return false;
  if (kind == RUNG_CHAR) {
    store(value, one[0]);
    return true;
  }
  if (rung_ustring_length(one) > 1) return false;
  store(value, rung_ustring_code(one));
  return true;
}

}  // namespace

bool rung_parse(uint8_t kind, bool is_signed, uint32_t length, const char* text, size_t size, void* value) {
  const Reader from{text, text + size};
  switch (static_cast<rung_type_kind>(kind)) {
    case RUNG_BOOL: return parseBool(from, value);
    case RUNG_BYTE:
    case RUNG_WORD:
    case RUNG_DWORD:
    case RUNG_LWORD:
    case RUNG_SINT:
    case RUNG_INT:
    case RUNG_DINT:
    case RUNG_LINT:
    case RUNG_USINT:
    case RUNG_UINT:
    case RUNG_UDINT:
    case RUNG_ULINT: {
      Integer integer;
      return readInteger(from, integer) && storeInteger(integer, formatOf(kind), value);
    }
    case RUNG_REAL: return parseReal(from, true, value);
    case RUNG_LREAL: return parseReal(from, false, value);
    case RUNG_TIME:
    case RUNG_LTIME: return parseTime(kind == RUNG_LTIME, is_signed, from, value);
    case RUNG_DATE:
    case RUNG_LDATE:
    case RUNG_TOD:
    case RUNG_LTOD:
    case RUNG_DT:
    case RUNG_LDT: return parseDate(kind, from, value);
    case RUNG_CHAR:
    case RUNG_WCHAR:
    case RUNG_UCHAR: return parseCharacter(kind, from, value);
    case RUNG_STRING:
    case RUNG_USTRING:
    case RUNG_WSTRING: return parseString(kind, from, length, value);
    case RUNG_ENUM:
    case RUNG_ARRAY:
    case RUNG_RECORD:
    case RUNG_POINTER: break;
  }
  return false;
}

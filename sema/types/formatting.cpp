// SPDX-License-Identifier: Apache-2.0
// Types and values in messages, traces and generated comments.
#include <charconv>
#include <cmath>

#include "frontend/source/calendar.h"
#include "frontend/source/files.h"
#include "frontend/source/quoting.h"
#include "sema/types/arithmetic.h"
#include "sema/types/types.h"

namespace rung::types {

namespace {

constexpr int64_t kNsPerSecond = 1'000'000'000, kNsPerMs = 1'000'000, kNsPerDay = 86'400 * kNsPerSecond;

void appendNumber(std::string& out, uint64_t value, int min_digits = 1) {
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  for (auto i = end - digits; i < min_digits; ++i) out += '0';
  out.append(digits, end);
}

void appendSigned(std::string& out, int64_t value) {
  if (value < 0) out += '-';
  appendNumber(out, value < 0 ? 0 - static_cast<uint64_t>(value) : static_cast<uint64_t>(value));
}

template <class Float>
void appendReal(std::string& out, Float value) {
  if (std::isnan(value)) {
    out += "NaN";
  } else if (std::isinf(value)) {
    out += value < 0 ? "-Inf" : "Inf";
  } else {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    const std::string_view text(digits, static_cast<size_t>(end - digits));
    out += text;
    if (text.find_first_of(".e") == std::string_view::npos) out += ".0";
  }
}

// T#1d2h3m4s5ms, LTIME#…us…ns; units that are zero are omitted.
void appendDuration(std::string& out, uint64_t ns, bool negative, bool long_form) {
  out += long_form ? "LTIME#" : "T#";
  if (negative) out += '-';
  struct Unit {
    uint64_t ns;
    const char* word;
  };
  static constexpr Unit kUnits[] = {{uint64_t{kNsPerDay}, "d"},
                                    {3600 * uint64_t{kNsPerSecond}, "h"},
                                    {60 * uint64_t{kNsPerSecond}, "m"},
                                    {uint64_t{kNsPerSecond}, "s"},
                                    {uint64_t{kNsPerMs}, "ms"},
                                    {1000, "us"},
                                    {1, "ns"}};
  if (ns == 0) {
    out += long_form ? "0ns" : "0ms";
    return;
  }
  for (const Unit& unit : kUnits) {
    if (ns < unit.ns) continue;
    appendNumber(out, ns / unit.ns);
    out += unit.word;
    ns %= unit.ns;
  }
}

void appendDate(std::string& out, int64_t days) {
  const CalendarDate date = dateOfDays(days);
  appendNumber(out, date.year, 4);
  out += '-';
  appendNumber(out, date.month, 2);
  out += '-';
  appendNumber(out, date.day, 2);
}

void appendClock(std::string& out, uint64_t ns) {
  const uint64_t seconds = ns / kNsPerSecond;
  appendNumber(out, seconds / 3600, 2);
  out += ':';
  appendNumber(out, seconds / 60 % 60, 2);
  out += ':';
  appendNumber(out, seconds % 60, 2);
  uint64_t fraction = ns % kNsPerSecond;
  if (fraction == 0) return;
  int digits = 9;
  while (fraction % 10 == 0) {
    fraction /= 10;
    --digits;
  }
  out += '.';
  appendNumber(out, fraction, digits);
}

void appendString(std::string& out, std::string_view text, char quote) {
  out += quote;
  for (const char c : text) {
    switch (c) {
      case '$': out += "$$"; break;
      case '\n': out += "$L"; break;
      case '\r': out += "$R"; break;
      case '\f': out += "$P"; break;
      case '\t': out += "$T"; break;
      default: appendInQuotes(out, c, quote, isControl(c), quote == '"');  // WSTRING: four digits
    }
  }
  out += quote;
}

}  // namespace

std::string TypeTable::toString(TypeId id) const {
  const TypeInfo& info = types_[id.index];
  std::string text;
  const auto appendBound = [&](int64_t bound) {
    if (isSigned(plainKind(info.base))) {
      appendSigned(text, bound);
    } else {
      appendNumber(text, static_cast<uint64_t>(bound));
    }
  };
  if (isString(info.kind) && id != idOf(info.kind)) {
    text = std::string(names_.string(types_[static_cast<uint32_t>(info.kind)].name)) + '[';
    appendNumber(text, info.length);
    return text + ']';
  }
  if (info.name) return std::string(names_.string(info.shown_name ? info.shown_name : info.name));
  if (info.kind == TypeKind::Array) {
    text = "ARRAY[";
    for (uint32_t i = 0; i < info.length; ++i) text += i == 0 ? "*" : ", *";
    for (size_t i = 0; i < info.dimensions.size(); ++i) {
      if (i > 0) text += ", ";
      appendSigned(text, info.dimensions[i].low);
      text += "..";
      appendSigned(text, info.dimensions[i].high);
    }
    return text + "] OF " + toString(info.base);
  }
  if (info.kind == TypeKind::Pointer) {
    const TypeInfo& target = types_[resolve(info.base).index];
    const bool interface = target.kind == TypeKind::Record && target.record_kind == RecordKind::Interface;
    return (interface ? "" : "POINTER TO ") + toString(info.base);
  }
  if (info.kind == TypeKind::Reference) return "REFERENCE TO " + toString(info.base);
  if (info.kind == TypeKind::Subrange) {
    text = toString(info.base) + '(';
    appendBound(info.low);
    text += "..";
    appendBound(info.high);
    return text + ')';
  }
  if (info.kind == TypeKind::Enum) {
    text = "(";
    for (size_t i = 0; i < info.items.size() && i < 4; ++i) {
      if (i > 0) text += ", ";
      text += names_.string(info.items[i].first);
    }
    return text + (info.items.size() > 4 ? ", ...)" : ")");
  }
  if (info.kind == TypeKind::Record)
    return info.record_kind == RecordKind::Union && !info.overlaps ? "UNION" : "STRUCT";
  if (info.kind == TypeKind::IntegerLiteral) return "integer literal";
  if (info.kind == TypeKind::RealLiteral) return "real literal";
  if (info.kind == TypeKind::NullLiteral) return "NULL";
  return "unknown type";
}

std::string durationText(int64_t ns) {
  std::string out;
  appendDuration(out, ns < 0 ? 0 - static_cast<uint64_t>(ns) : static_cast<uint64_t>(ns), ns < 0, false);
  return out;
}

std::string toString(const TypeTable& table, const Names& names, const Value& value) {
  std::string out;
  const TypeInfo& resolved = table.info(table.resolve(value.type));
  if (resolved.kind == TypeKind::Enum) {
    for (const auto& [item, item_value] : resolved.items) {
      if (item_value == value.asSigned()) return std::string(names.string(item));
    }
  }
  const TypeKind kind = table.plainKind(value.type);
  if (kind == TypeKind::Bool) {
    out = value.bits != 0 ? "TRUE" : "FALSE";
  } else if (kind == TypeKind::Real) {
    appendReal(out, static_cast<float>(value.asReal()));
  } else if (kind == TypeKind::LReal || kind == TypeKind::RealLiteral) {
    appendReal(out, value.asReal());
  } else if (TypeTable::isDuration(kind)) {
    const bool negative = table.isSigned(kind) && value.asSigned() < 0;
    const uint64_t magnitude = negative ? 0 - value.bits : value.bits;
    const bool is_long = kind == TypeKind::LTime;
    appendDuration(out, is_long ? magnitude : magnitude * kNsPerMs, negative, is_long);
  } else if (kind == TypeKind::Date || kind == TypeKind::LDate) {
    const uint64_t per_day = kind == TypeKind::Date ? 86'400 : uint64_t{kNsPerDay};
    out = kind == TypeKind::Date ? "D#" : "LDATE#";
    appendDate(out, static_cast<int64_t>(value.bits / per_day));
  } else if (kind == TypeKind::TimeOfDay || kind == TypeKind::LTimeOfDay) {
    out = kind == TypeKind::TimeOfDay ? "TOD#" : "LTOD#";
    appendClock(out, kind == TypeKind::TimeOfDay ? value.bits * kNsPerMs : value.bits);
  } else if (kind == TypeKind::DateTime || kind == TypeKind::LDateTime) {
    const uint64_t per_day = kind == TypeKind::DateTime ? 86'400 : uint64_t{kNsPerDay};
    const uint64_t in_day = value.bits % per_day;
    out = kind == TypeKind::DateTime ? "DT#" : "LDT#";
    appendDate(out, static_cast<int64_t>(value.bits / per_day));
    out += '-';
    appendClock(out, kind == TypeKind::DateTime ? in_day * kNsPerSecond : in_day);
  } else if (TypeTable::isString(kind)) {
    appendString(out, names.string(NameId{static_cast<uint32_t>(value.bits)}), kind == TypeKind::WString ? '"' : '\'');
  } else if (kind == TypeKind::Char) {
    const char c = static_cast<char>(value.bits);
    appendString(out, {&c, 1}, '\'');
  } else if (TypeTable::isCharacter(kind)) {
    std::string character;
    appendUtf8(character, static_cast<uint32_t>(value.bits));
    appendString(out, character, kind == TypeKind::WChar ? '"' : '\'');
  } else if (TypeTable::isSignedInteger(kind) || kind == TypeKind::IntegerLiteral) {
    appendSigned(out, value.asSigned());
  } else {
    appendNumber(out, value.bits);
  }
  return out;
}

}  // namespace rung::types

// SPDX-License-Identifier: Apache-2.0
// Formats and parses values: every format of the trace and every form of literal.
#include "rung/values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace {

template <class T>
std::string format(rung_type_kind kind, T value, bool is_signed = false) {
  char out[RUNG_FORMATTED_SCALAR + 1];
  return std::string(out, rung_format(kind, is_signed, &value, out, RUNG_FORMATTED_SCALAR));
}
template <class T>
T parse(rung_type_kind kind, const std::string& text, bool is_signed = false) {
  T value{};
  EXPECT_TRUE(rung_parse(kind, is_signed, 0, text.data(), text.size(), &value)) << text;
  return value;
}
bool parses(rung_type_kind kind, const std::string& text, bool is_signed = false) {
  uint64_t room[4];
  return rung_parse(kind, is_signed, 8, text.data(), text.size(), room);
}

TEST(Values, BoolAndIntegers) {
  EXPECT_EQ(format<uint8_t>(RUNG_BOOL, 1), "TRUE");
  EXPECT_EQ(format<uint8_t>(RUNG_BOOL, 2), "TRUE");
  EXPECT_EQ(format<uint8_t>(RUNG_BOOL, 0), "FALSE");
  EXPECT_EQ(format<int8_t>(RUNG_SINT, -128), "-128");
  EXPECT_EQ(format<uint8_t>(RUNG_BYTE, 255), "255");
  EXPECT_EQ(format<int64_t>(RUNG_LINT, INT64_MIN), "-9223372036854775808");
  EXPECT_EQ(format<uint64_t>(RUNG_ULINT, UINT64_MAX), "18446744073709551615");
  EXPECT_EQ(parse<uint8_t>(RUNG_BOOL, "true"), 1);
  EXPECT_EQ(parse<uint8_t>(RUNG_BOOL, "BOOL#0"), 0);
  EXPECT_EQ(parse<int16_t>(RUNG_INT, "INT#-5"), -5);
  EXPECT_EQ(parse<int16_t>(RUNG_INT, "-32768"), -32768);
  EXPECT_EQ(parse<uint16_t>(RUNG_WORD, "16#FF_ff"), 0xffff);
  EXPECT_EQ(parse<uint8_t>(RUNG_USINT, "2#1010_0101"), 0xa5);
  EXPECT_EQ(parse<uint64_t>(RUNG_ULINT, "18446744073709551615"), UINT64_MAX);
  for (const char* bad : {"", "-", "32768", "-32769", "1.5", "16#", "3#1", "1 2", "abc", "99999999999999999999"})
    EXPECT_FALSE(parses(RUNG_INT, bad)) << bad;
  EXPECT_FALSE(parses(RUNG_UINT, "-1"));
  EXPECT_FALSE(parses(RUNG_BOOL, "2"));
}

TEST(Values, Reals) {
  EXPECT_EQ(format(RUNG_REAL, 0.15f), "0.15");
  EXPECT_EQ(format(RUNG_REAL, 5.0f), "5.0");
  EXPECT_EQ(format(RUNG_REAL, -0.0f), "-0.0");
  EXPECT_EQ(format(RUNG_LREAL, 1e300), "1e+300");
  EXPECT_EQ(format(RUNG_LREAL, 0.1), "0.1");
  EXPECT_EQ(format(RUNG_REAL, std::numeric_limits<float>::quiet_NaN()), "NaN");
  EXPECT_EQ(format(RUNG_LREAL, -std::numeric_limits<double>::infinity()), "-Inf");
  EXPECT_TRUE(std::isnan(parse<float>(RUNG_REAL, "NaN")));
  EXPECT_EQ(parse<double>(RUNG_LREAL, "-Inf"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse<float>(RUNG_REAL, "REAL#-1.5e2"), -150.0f);
  EXPECT_EQ(parse<double>(RUNG_LREAL, "7"), 7.0);
  for (const char* bad : {"", "e5", ".5", "1.5x", "--1", "infinity", "1e999"})
    EXPECT_FALSE(parses(RUNG_LREAL, bad)) << bad;
}

TEST(Values, RealsReadBackExactly) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const uint32_t bits = static_cast<uint32_t>(random());
    float value, back;
    memcpy(&value, &bits, 4);
    if (std::isnan(value)) continue;
    const std::string text = format(RUNG_REAL, value);
    EXPECT_NE(text.find_first_of(".eI"), std::string::npos) << text;
    back = parse<float>(RUNG_REAL, text);
    EXPECT_EQ(memcmp(&value, &back, 4), 0) << text;
  }
}

TEST(Values, Durations) {
  EXPECT_EQ(format<uint32_t>(RUNG_TIME, 1500), "T#1s500ms");
  EXPECT_EQ(format<uint32_t>(RUNG_TIME, 0), "T#0ms");
  EXPECT_EQ(format<int32_t>(RUNG_TIME, -5000, true), "T#-5s");
  EXPECT_EQ(format<uint32_t>(RUNG_TIME, UINT32_MAX), "T#49d17h2m47s295ms");
  EXPECT_EQ(format<int64_t>(RUNG_LTIME, 1'000'500'007, true), "LTIME#1s500us7ns");
  EXPECT_EQ(format<int64_t>(RUNG_LTIME, 0, true), "LTIME#0ns");
  EXPECT_EQ(parse<uint32_t>(RUNG_TIME, "T#1d2h7m19s45.7ms"), 94'039'045u);
  EXPECT_EQ(parse<uint32_t>(RUNG_TIME, "time#1.5S"), 1500u);
  EXPECT_EQ(parse<int32_t>(RUNG_TIME, "T#-5s", true), -5000);
  EXPECT_EQ(parse<uint64_t>(RUNG_LTIME, "LTIME#213503D23H34M33S709MS551US615NS"), UINT64_MAX);
  EXPECT_EQ(parse<int64_t>(RUNG_LTIME, "LT#0.3us", true), 300);
  for (const char* bad : {"T#", "T#5", "5s", "T#5s5s", "T#5ms2s", "T#-5s", "T#60d", "T#1x"})
    EXPECT_FALSE(parses(RUNG_TIME, bad)) << bad;
}

TEST(Values, Dates) {
  EXPECT_EQ(format<uint32_t>(RUNG_DATE, 0), "D#1970-01-01");
  EXPECT_EQ(parse<uint32_t>(RUNG_DATE, "DATE#2026-11-21"), 1795219200u);
  EXPECT_EQ(format<uint32_t>(RUNG_DATE, 1795219200), "D#2026-11-21");
  EXPECT_EQ(format<uint32_t>(RUNG_DT, 1795219200 + 45000), "DT#2026-11-21-12:30:00");
  EXPECT_EQ(parse<uint32_t>(RUNG_DT, "DATE_AND_TIME#2026-11-21-12:30:00"), 1795264200u);
  EXPECT_EQ(format<uint32_t>(RUNG_TOD, 45'000'500), "TOD#12:30:00.5");
  EXPECT_EQ(parse<uint32_t>(RUNG_TOD, "TIME_OF_DAY#12:30:00.5"), 45'000'500u);
  EXPECT_EQ(format<uint64_t>(RUNG_LDT, 1795264200'000'001'000), "LDT#2026-11-21-12:30:00.000001");
  EXPECT_EQ(parse<uint64_t>(RUNG_LDT, "LDT#2026-11-21-12:30:00.000001"), 1795264200'000'001'000u);
  EXPECT_EQ(format<uint32_t>(RUNG_DATE, 951782400), "D#2000-02-29");
  EXPECT_EQ(parse<uint32_t>(RUNG_DATE, "D#2000-02-29"), 951782400u);
  EXPECT_EQ(format<uint32_t>(RUNG_DT, UINT32_MAX), "DT#2106-02-07-06:28:15");
  for (const char* bad : {"D#2026-02-29", "D#2026-13-01", "2026-01-01", "D#2026-01", "D#1969-12-31", "D#2107-01-01"})
    EXPECT_FALSE(parses(RUNG_DATE, bad)) << bad;
  EXPECT_FALSE(parses(RUNG_TOD, "TOD#24:00:00"));
}

TEST(Values, Texts) {
  char out[64];
  const auto string = [&](const char* text) {
    return std::string(out, rung_format(RUNG_STRING, false, text, out, 63));
  };
  EXPECT_EQ(string("it's $5\n\r\t\f\x01\x7f"), "'it$'s $$5$L$R$T$P$01$7F'");
  EXPECT_EQ(string("gr\xC3\xBC\xC3\x9F"), "'gr\xC3\xBC\xC3\x9F'");
  EXPECT_EQ(string("\xFC\xC3"), "'$FC$C3'");
  EXPECT_EQ(std::string(out, rung_format(RUNG_WSTRING, false, u"a\"\u00fc\U0001F600\xD800", out, 63)),
            "\"a$\"\xC3\xBC\xF0\x9F\x98\x80$D800\"");
  EXPECT_EQ(rung_format(RUNG_STRING, false, "abcdef", out, 3), 3u);
  EXPECT_STREQ(out, "'ab");

  char text[9];
  const auto read = [&](const char* from) { return rung_parse(RUNG_STRING, false, 8, from, strlen(from), text); };
  EXPECT_TRUE(read("'a$'b$L$41$$'"));
  EXPECT_STREQ(text, "a'b\nA$");
  EXPECT_TRUE(read("'0123456789'"));
  EXPECT_STREQ(text, "01234567");
  for (const char* bad : {"abc", "'abc", "'a$'", "'a$4'", "'a'b", "'$Q'"}) EXPECT_FALSE(read(bad)) << bad;
  char16_t wide[4];
  const std::string emoji = "\"a\xF0\x9F\x98\x80\xC3\xBC\"";
  EXPECT_TRUE(rung_parse(RUNG_WSTRING, false, 3, emoji.data(), emoji.size(), wide));
  EXPECT_EQ(std::u16string(wide), u"a\U0001F600");
  EXPECT_TRUE(rung_parse(RUNG_WSTRING, false, 2, emoji.data(), emoji.size(), wide));
  EXPECT_EQ(std::u16string(wide), u"a");  // never half of a pair
}

}  // namespace

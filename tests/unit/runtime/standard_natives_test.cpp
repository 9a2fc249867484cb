// SPDX-License-Identifier: Apache-2.0
// Native functions of the library Standard: values from the manuals' samples, limits of positions and lengths, results
// that overlap inputs.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "rung/code.h"

extern "C" {
int16_t rung_standard_LEN__STRING_255(rung_context*, const char*);
void rung_standard_LEFT__STRING_255(rung_context*, const char*, int32_t, char*, uint32_t);
void rung_standard_RIGHT__STRING_255(rung_context*, const char*, int32_t, char*, uint32_t);
void rung_standard_MID__STRING_255(rung_context*, const char*, int32_t, int32_t, char*, uint32_t);
void rung_standard_CONCAT__STRING_255(rung_context*, const char*, const char*, char*, uint32_t);
void rung_standard_CONCAT__WSTRING_255(rung_context*, const char16_t*, const char16_t*, char16_t*, uint32_t);
void rung_standard_INSERT__STRING_255(rung_context*, const char*, const char*, int32_t, char*, uint32_t);
void rung_standard_DELETE__STRING_255(rung_context*, const char*, int32_t, int32_t, char*, uint32_t);
void rung_standard_REPLACE__STRING_255(rung_context*, const char*, const char*, int32_t, int32_t, char*, uint32_t);
int16_t rung_standard_FIND__STRING_255(rung_context*, const char*, const char*);
int16_t rung_standard_TRUNC__REAL_INT(rung_context*, float);
uint64_t rung_standard_TRUNC__LREAL_ULINT(rung_context*, double);
float rung_standard_LOG__REAL(rung_context*, float);
double rung_standard_ATAN2__LREAL(rung_context*, double, double);
uint8_t rung_standard_IS_VALID__REAL(rung_context*, float);
uint8_t rung_standard_USINT_TO_BCD_BYTE(rung_context*, uint8_t);
uint16_t rung_standard_WORD_BCD_TO_UINT(rung_context*, uint16_t);
uint8_t rung_standard_IS_VALID_BCD(rung_context*, uint64_t);
uint32_t rung_standard_TO_BIG_ENDIAN__DWORD(rung_context*, uint32_t);
void rung_standard_TO_STRING__REAL(rung_context*, float, char*, uint32_t);
void rung_standard_TO_STRING__TIME(rung_context*, uint32_t, char*, uint32_t);
int16_t rung_standard_STRING_TO_INT(rung_context*, const char*);
float rung_standard_WSTRING_TO_REAL(rung_context*, const char16_t*);
uint32_t rung_standard_CONCAT_DATE(rung_context*, int32_t, int32_t, int32_t);
uint32_t rung_standard_CONCAT_DT(rung_context*, int32_t, int32_t, int32_t, int32_t, int32_t, int32_t, int32_t);
void rung_standard_SPLIT_DT(rung_context*, uint32_t, int16_t*, int16_t*, int16_t*, int16_t*, int16_t*, int16_t*,
                            int16_t*);
int16_t rung_standard_DAY_OF_WEEK(rung_context*, uint32_t);
}

namespace {

rung_context ctx{};

template <class Function, class... Inputs>
std::string text(Function function, Inputs... inputs) {
  char out[256];
  function(&ctx, inputs..., out, 255u);
  return out;
}

TEST(StringFunctions, SamplesOfTheManuals) {
  EXPECT_EQ(rung_standard_LEN__STRING_255(&ctx, "ASTRING"), 7);
  EXPECT_EQ(text(rung_standard_LEFT__STRING_255, "SUSI", 3), "SUS");
  EXPECT_EQ(text(rung_standard_RIGHT__STRING_255, "SUSI", 3), "USI");
  EXPECT_EQ(text(rung_standard_MID__STRING_255, "SUSI", 2, 2), "US");
  EXPECT_EQ(text(rung_standard_CONCAT__STRING_255, "SUSI", "WILLI"), "SUSIWILLI");
  EXPECT_EQ(text(rung_standard_INSERT__STRING_255, "SUSI", "XY", 2), "SUXYSI");
  EXPECT_EQ(text(rung_standard_DELETE__STRING_255, "SUXYSI", 2, 3), "SUSI");
  EXPECT_EQ(text(rung_standard_REPLACE__STRING_255, "SUXYSI", "K", 2, 2), "SKYSI");
  EXPECT_EQ(text(rung_standard_REPLACE__STRING_255, "ABCDE", "X", 2, 3), "ABXE");
  EXPECT_EQ(rung_standard_FIND__STRING_255(&ctx, "abcdef", "de"), 4);
  EXPECT_EQ(rung_standard_FIND__STRING_255(&ctx, "ABCBC", "BC"), 2);
}

TEST(StringFunctions, NothingOutsideIsTouched) {
  constexpr int32_t least = INT32_MIN, most = INT32_MAX;
  for (const int32_t count : {least, -1, 0}) {
    EXPECT_EQ(text(rung_standard_LEFT__STRING_255, "ab", count), "");
    EXPECT_EQ(text(rung_standard_RIGHT__STRING_255, "ab", count), "");
    EXPECT_EQ(text(rung_standard_MID__STRING_255, "ab", count, 1), "");
    EXPECT_EQ(text(rung_standard_DELETE__STRING_255, "ab", count, 1), "ab");
    EXPECT_EQ(text(rung_standard_REPLACE__STRING_255, "ab", "X", count, 2), "aXb");
  }
  EXPECT_EQ(text(rung_standard_LEFT__STRING_255, "ab", most), "ab");
  EXPECT_EQ(text(rung_standard_RIGHT__STRING_255, "ab", most), "ab");
  EXPECT_EQ(text(rung_standard_MID__STRING_255, "abc", most, 2), "bc");
  EXPECT_EQ(text(rung_standard_DELETE__STRING_255, "abc", most, 2), "a");
  EXPECT_EQ(text(rung_standard_REPLACE__STRING_255, "abc", "X", most, 2), "aX");
  EXPECT_EQ(text(rung_standard_REPLACE__STRING_255, "abc", "X", 1, 4), "abcX");
  for (const int32_t position : {least, -1, 0, 4, most}) {
    EXPECT_EQ(text(rung_standard_MID__STRING_255, "abc", 1, position), "");
    EXPECT_EQ(text(rung_standard_DELETE__STRING_255, "abc", 1, position), "abc");
    EXPECT_EQ(text(rung_standard_REPLACE__STRING_255, "abc", "X", 1, position), position == 4   ? "abcX"
                                                                                : position == 0 ? "Xabc"
                                                                                                : "abc");
    EXPECT_EQ(text(rung_standard_INSERT__STRING_255, "abc", "X", position), position == 0   ? "Xabc"
                                                                            : position == 4 ? "abcX"
                                                                                            : "abc");
  }
  EXPECT_EQ(rung_standard_FIND__STRING_255(&ctx, "abc", ""), 0);
  EXPECT_EQ(rung_standard_FIND__STRING_255(&ctx, "", "a"), 0);
  EXPECT_EQ(rung_standard_FIND__STRING_255(&ctx, "ab", "abc"), 0);
}

TEST(StringFunctions, ResultsAreCutAndMayOverlapInputs) {
  const std::string full(255, 'x');
  EXPECT_EQ(text(rung_standard_CONCAT__STRING_255, full.c_str(), "y"), full);
  EXPECT_EQ(text(rung_standard_INSERT__STRING_255, full.c_str(), "y", 0), "y" + full.substr(1));
  const std::string longer(1000, 'z');
  EXPECT_EQ(text(rung_standard_LEFT__STRING_255, longer.c_str(), 900).size(), 255u);
  EXPECT_EQ(rung_standard_LEN__STRING_255(&ctx, longer.c_str()), 1000);
  char small[5] = "abcd";
  rung_standard_INSERT__STRING_255(&ctx, small, small, 2, small, 4);
  EXPECT_STREQ(small, "abab");
  rung_standard_CONCAT__STRING_255(&ctx, "1", small, small, 4);
  EXPECT_STREQ(small, "1aba");
  char16_t wide[4];
  rung_standard_CONCAT__WSTRING_255(&ctx, u"\u00e4b", u"cd", wide, 3);
  EXPECT_EQ(std::u16string(wide), u"\u00e4bc");
}

TEST(NumericFunctions, TruncationAndDomains) {
  EXPECT_EQ(rung_standard_TRUNC__REAL_INT(&ctx, 1.6f), 1);
  EXPECT_EQ(rung_standard_TRUNC__REAL_INT(&ctx, -1.6f), -1);
  EXPECT_EQ(rung_standard_TRUNC__REAL_INT(&ctx, 1e9f), 32767);
  EXPECT_EQ(rung_standard_TRUNC__REAL_INT(&ctx, std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(rung_standard_TRUNC__LREAL_ULINT(&ctx, 1e30), UINT64_MAX);
  EXPECT_EQ(rung_standard_TRUNC__LREAL_ULINT(&ctx, -0.5), 0u);
  EXPECT_EQ(rung_standard_LOG__REAL(&ctx, 1000.0f), 3.0f);
  EXPECT_TRUE(std::isnan(rung_standard_LOG__REAL(&ctx, -1.0f)));
  EXPECT_DOUBLE_EQ(rung_standard_ATAN2__LREAL(&ctx, 1.0, -1.0), 2.356194490192345);
  EXPECT_EQ(rung_standard_IS_VALID__REAL(&ctx, std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(rung_standard_IS_VALID__REAL(&ctx, 0.0f), 1);
}

TEST(ConversionFunctions, BcdSamples) {
  EXPECT_EQ(rung_standard_USINT_TO_BCD_BYTE(&ctx, 25), 0x25);
  EXPECT_EQ(rung_standard_WORD_BCD_TO_UINT(&ctx, 0x369), 369);
  EXPECT_EQ(rung_standard_IS_VALID_BCD(&ctx, 0x1234567890123456), 1);
  EXPECT_EQ(rung_standard_IS_VALID_BCD(&ctx, 0x1A), 0);
  EXPECT_EQ(rung_standard_TO_BIG_ENDIAN__DWORD(&ctx, 0x01020304), 0x04030201u);
}

TEST(ConversionFunctions, Text) {
  EXPECT_EQ(text(rung_standard_TO_STRING__REAL, 2.0f), "2.0");
  EXPECT_EQ(text(rung_standard_TO_STRING__TIME, 90'000u), "T#1m30s");
  EXPECT_EQ(rung_standard_STRING_TO_INT(&ctx, " -42x"), -42);
  EXPECT_EQ(rung_standard_WSTRING_TO_REAL(&ctx, u"2.5"), 2.5f);
}

TEST(TimeFunctions, CalendarByHand) {
  EXPECT_EQ(rung_standard_CONCAT_DATE(&ctx, 1970, 1, 1), 0u);
  EXPECT_EQ(rung_standard_CONCAT_DATE(&ctx, 2000, 2, 29), 951782400u);
  EXPECT_EQ(rung_standard_CONCAT_DATE(&ctx, 2025, 13, 1), rung_standard_CONCAT_DATE(&ctx, 2026, 1, 1));
  EXPECT_EQ(rung_standard_CONCAT_DT(&ctx, 2026, 11, 21, 12, 30, 0, 0), 1795264200u);
  int16_t year, month, day, hour, minute, second, ms;
  rung_standard_SPLIT_DT(&ctx, 1795264200u, &year, &month, &day, &hour, &minute, &second, &ms);
  EXPECT_EQ(std::make_tuple(year, month, day, hour, minute, second, ms), std::make_tuple(2026, 11, 21, 12, 30, 0, 0));
  rung_standard_SPLIT_DT(&ctx, 0, &year, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
  EXPECT_EQ(year, 1970);
  EXPECT_EQ(rung_standard_DAY_OF_WEEK(&ctx, 0), 4);
  EXPECT_EQ(rung_standard_DAY_OF_WEEK(&ctx, rung_standard_CONCAT_DATE(&ctx, 2026, 11, 21)), 6);  // a Saturday
}

}  // namespace

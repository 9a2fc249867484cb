// SPDX-License-Identifier: Apache-2.0
// The string functions and assertions of rung/code.h, and faults through guards.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "rung/code.h"

namespace {

TEST(Text, AssignCutsAndMayOverlap) {
  char text[6] = "abcde";
  rung_string_assign(text, 5, "0123456789");
  EXPECT_STREQ(text, "01234");
  rung_string_assign(text, 5, text + 2);
  EXPECT_STREQ(text, "234");
  rung_string_assign(text, 0, "x");
  EXPECT_STREQ(text, "");
}

TEST(Text, ComparesByUnsignedUnits) {
  EXPECT_GT(rung_string_compare("Z", "AZ"), 0);
  EXPECT_GT(rung_string_compare("AZ", "ABC"), 0);
  EXPECT_LT(rung_string_compare("a", "\xFC"), 0);
  EXPECT_EQ(rung_wstring_compare(u"ab", u"ab"), 0);
  EXPECT_LT(rung_wstring_compare(u"a", u"ab"), 0);
  EXPECT_LT(rung_wstring_compare(u"a", u"\uFFFF"), 0);
}

TEST(Text, BetweenTheTwoKinds) {
  char narrow[8];
  rung_string_of_wstring(narrow, 7, u"a\u00fc\U0001F600");
  EXPECT_STREQ(narrow, "a\xC3\xBC\xF0\x9F\x98\x80");
  rung_string_of_wstring(narrow, 5, u"a\u00fc\U0001F600");
  EXPECT_STREQ(narrow, "a\xC3\xBC");  // never half a character
  rung_string_of_wstring(narrow, 7, u"\xD800x");
  EXPECT_STREQ(narrow, "?x");
  char16_t wide[5];
  rung_wstring_of_string(wide, 4, "a\xC3\xBC\xF0\x9F\x98\x80");
  EXPECT_EQ(std::u16string(wide), u"a\u00fc\U0001F600");
  rung_wstring_of_string(wide, 4, "\xFF\xC3z");
  EXPECT_EQ(std::u16string(wide), u"??z");
}

std::string textOf(uint8_t kind, uint64_t bits) {
  char out[65];
  rung_string_of_scalar(out, 64, kind, bits);
  return out;
}

TEST(Text, ScalarsAsStrings) {
  EXPECT_EQ(textOf(RUNG_BOOL, 1), "TRUE");
  EXPECT_EQ(textOf(RUNG_INT, static_cast<uint64_t>(int64_t{-5})), "-5");
  EXPECT_EQ(textOf(RUNG_REAL, rung_bits_of_f64(static_cast<double>(0.15f))), "0.15");
  EXPECT_EQ(textOf(RUNG_TIME, 5000), "T#5s");
  EXPECT_EQ(textOf(RUNG_TIME, static_cast<uint64_t>(int64_t{-5000})), "T#-5s");
  EXPECT_EQ(textOf(RUNG_TIME, 4294967295u), "T#49d17h2m47s295ms");
  EXPECT_EQ(textOf(RUNG_CHAR, 'x'), "x");
  char small[3];
  rung_string_of_scalar(small, 2, RUNG_INT, 12345);
  EXPECT_STREQ(small, "12");
}

TEST(Text, IntegersInEveryRoom) {
  const int64_t numbers[] = {0, 7, -7, 10, 99, -100, 123456, 999999, -999999, 1000000, -1000000, INT64_MAX, INT64_MIN};
  for (const int64_t number : numbers) {
    const std::string whole = std::to_string(number);
    for (uint32_t capacity = 0; capacity < 24; ++capacity) {
      char text[32];
      memset(text, '#', sizeof text);
      const std::string expected = whole.substr(0, capacity);
      EXPECT_EQ(rung_string_of_scalar(text, capacity, RUNG_LINT, static_cast<uint64_t>(number)), expected.size());
      EXPECT_EQ(expected, text);
      EXPECT_EQ('#', text[capacity + 1]);
    }
  }
  for (int64_t number = -20000; number < 20000; ++number)
    ASSERT_EQ(std::to_string(number), textOf(RUNG_LINT, static_cast<uint64_t>(number)));
  for (int64_t number = 20000; number < 1000100; number += 37)
    ASSERT_EQ(std::to_string(number), textOf(RUNG_LINT, static_cast<uint64_t>(number)));
  EXPECT_EQ(textOf(RUNG_ULINT, UINT64_MAX), "18446744073709551615");
  EXPECT_EQ(textOf(RUNG_BYTE, 255), "255");
}

TEST(Text, StringsAsScalars) {
  EXPECT_EQ(static_cast<int64_t>(rung_scalar_of_string(RUNG_INT, "  -17abc")), -17);
  EXPECT_EQ(rung_scalar_of_string(RUNG_INT, "abc"), 0u);
  EXPECT_EQ(rung_scalar_of_string(RUNG_WORD, "16#FF"), 255u);
  EXPECT_EQ(rung_scalar_of_string(RUNG_WORD, "2#101"), 5u);
  EXPECT_EQ(rung_scalar_of_string(RUNG_BOOL, "true"), 1u);
  EXPECT_EQ(rung_scalar_of_string(RUNG_BOOL, "yes"), 0u);
  EXPECT_EQ(rung_f64_of(rung_scalar_of_string(RUNG_REAL, " 1.5e1x")), 15.0);
  EXPECT_EQ(rung_f64_of(rung_scalar_of_string(RUNG_LREAL, "-2")), -2.0);
  EXPECT_EQ(rung_f64_of(rung_scalar_of_string(RUNG_LREAL, "1e999")), HUGE_VAL);
  EXPECT_EQ(rung_scalar_of_string(RUNG_TIME, "T#5s"), 5000u);
  EXPECT_EQ(rung_scalar_of_string(RUNG_TIME, "5s"), 0u);
  EXPECT_EQ(rung_scalar_of_string(RUNG_DT, "DT#1970-01-02-00:00:01"), 86401u);
  EXPECT_EQ(rung_scalar_of_wstring(RUNG_DINT, u"42"), 42u);
}

struct Report {
  bool passed;
  std::string expected, actual;
};
void collect(void* data, const rung_assertion*, bool passed, const char* expected, const char* actual) {
  *static_cast<Report*>(data) = {passed, expected == nullptr ? "" : expected, actual == nullptr ? "" : actual};
}

TEST(Assertions, ReportBothValues) {
  Report last{};
  rung_host host{};
  host.assertion = collect;
  rung_context ctx{};
  ctx.host = &host;
  ctx.host_data = &last;
  rung_assertion at{"f", 1, 1, nullptr, nullptr, nullptr, nullptr};
  rung_assert_equal(&ctx, &at, RUNG_TIME, 5000, 4000);
  EXPECT_FALSE(last.passed);
  EXPECT_EQ(last.expected + last.actual, "T#5sT#4s");
  const uint64_t nan = rung_bits_of_f64(std::numeric_limits<double>::quiet_NaN());
  rung_assert_equal(&ctx, &at, RUNG_LREAL, nan, nan);
  EXPECT_TRUE(last.passed);
  at.items = "Red\0000\0Green\0001\0\0";
  rung_assert_equal(&ctx, &at, RUNG_ENUM, 1, 7);
  EXPECT_EQ(last.expected + last.actual, "Green7");
  rung_assert_equal(&ctx, &at, RUNG_WSTRING, reinterpret_cast<uintptr_t>(u"a"), reinterpret_cast<uintptr_t>(u"b"));
  EXPECT_EQ(last.expected + last.actual, "\"a\"\"b\"");
  rung_assert_near(&ctx, &at, RUNG_REAL, 1.0, 1.25, 0.25);
  EXPECT_TRUE(last.passed);
  rung_assert_near(&ctx, &at, RUNG_REAL, 1.0, 1.5, 0.25);
  EXPECT_FALSE(last.passed);
}

TEST(Assertions, ShowTheSidesOfAComparison) {
  Report last{};
  rung_host host{};
  host.assertion = collect;
  rung_context ctx{};
  ctx.host = &host;
  ctx.host_data = &last;
  rung_assertion at{"f", 1, 1, nullptr, nullptr, "a > b\na\nb", nullptr};
  rung_assert_compared(&ctx, &at, true, RUNG_INT, 6, 5);
  EXPECT_TRUE(last.passed);
  rung_assert_compared(&ctx, &at, false, RUNG_INT, 3, 5);
  EXPECT_FALSE(last.passed);
  EXPECT_EQ(last.expected + " / " + last.actual, "a > b / a = 3, b = 5");
  at.shown = "5 < b\n\nb";
  rung_assert_compared(&ctx, &at, false, RUNG_INT, 5, 3);
  EXPECT_EQ(last.expected + " / " + last.actual, "5 < b / b = 3");
  at.shown = "a <> 'x'\na\n";
  rung_assert_compared(&ctx, &at, false, RUNG_STRING, reinterpret_cast<uintptr_t>("x"),
                       reinterpret_cast<uintptr_t>("x"));
  EXPECT_EQ(last.expected + " / " + last.actual, "a <> 'x' / a = 'x'");
}

int depth = 0;
void raising(rung_context* ctx) { rung_raise(ctx, RUNG_FAULT_DIV, 3, -4); }
struct Frame {
  rung_context* ctx;
  int steps;
};
void innerTry(void* frame) {
  Frame& f = *static_cast<Frame*>(frame);
  ++f.steps;
  rung_raise(f.ctx, RUNG_FAULT_NULL, 5, 0);
}
void nested(rung_context* ctx) {
  Frame frame{ctx, 0};
  if (rung_try(ctx, innerTry, &frame) == RUNG_FAULT_NULL) depth = frame.steps;
  raising(ctx);
}

TEST(Faults, LeaveToTheInnermostGuard) {
  rung_context ctx{};
  EXPECT_EQ(rung_guarded(&ctx, raising), RUNG_FAULT_DIV);
  EXPECT_EQ(ctx.fault.site, 3u);
  EXPECT_EQ(ctx.fault.value, -4);
  EXPECT_EQ(rung_guarded(&ctx, nested), RUNG_FAULT_DIV);
  EXPECT_EQ(depth, 1);
  EXPECT_EQ(ctx.fault_target, nullptr);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// REAL and LREAL as characters: the C++ library's to_chars and the C library's printf and strtod are the judges.
#include "rung/reals.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "rung/code.h"

namespace {

constexpr int kRandomValues = 100'000;

template <class Real>
std::string format(Real value) {
  char out[RUNG_REAL_ROOM];
  return std::string(out, rung_real_format(static_cast<double>(value), sizeof(Real) == 4, out));
}
template <class Real>
std::string expected(Real value) {
  char out[RUNG_REAL_ROOM];
  return std::string(out, std::to_chars(out, out + sizeof out, value).ptr);
}

template <class Real>
void expectRead(const std::string& text) {
  double value = -1;
  size_t size = text.size();
  EXPECT_NE(rung_real_parse(text.data(), &size, sizeof(Real) == 4, &value), RUNG_REAL_NONE) << text;
  EXPECT_EQ(size, text.size()) << text;
  const Real wanted = sizeof(Real) == 4 ? static_cast<Real>(strtof(text.c_str(), nullptr))
                                        : static_cast<Real>(strtod(text.c_str(), nullptr));
  EXPECT_EQ(value, static_cast<double>(wanted)) << text;
}

std::string printed(const char* format, int precision, long double value) {
  char out[1400];
  return std::string(out, static_cast<size_t>(snprintf(out, sizeof out, format, precision, value)));
}

double finiteMagnitude(std::mt19937_64& random) {
  for (;;) {
    const double value = std::fabs(rung_f64_of(random()));
    if (std::isfinite(value)) return value;
  }
}

TEST(Reals, ShortestOfEveryExponent) {
  for (uint64_t exponent = 0; exponent < 2047; ++exponent)
    for (const uint64_t bits : {exponent << 52, (exponent << 52) + 1, ((exponent + 1) << 52) - 1}) {
      const double value = rung_f64_of(bits);
      ASSERT_EQ(format(value), expected(value));
    }
  for (uint32_t exponent = 0; exponent < 255; ++exponent)
    for (const uint32_t bits : {exponent << 23, (exponent << 23) + 1, ((exponent + 1) << 23) - 1}) {
      const float value = rung_f32_of(bits);
      ASSERT_EQ(format(value), expected(value));
    }
}

TEST(Reals, ShortestOfRandomValues) {
  std::mt19937_64 random(1);
  for (int i = 0; i < kRandomValues; ++i) {
    const double wide = finiteMagnitude(random), hundredths = static_cast<double>(random() % 10'000'000) / 100;
    const auto whole = static_cast<double>(random() >> random() % 64);
    for (const double value : {wide, -hundredths, whole}) ASSERT_EQ(format(value), expected(value));
    const float narrow = rung_f32_of(static_cast<uint32_t>(random()) & 0xff7fffff);
    for (const float value : {narrow, static_cast<float>(hundredths), static_cast<float>(whole)})
      ASSERT_EQ(format(value), expected(value));
  }
  EXPECT_EQ(format(std::numeric_limits<double>::quiet_NaN()), "NaN");
  EXPECT_EQ(format(-std::numeric_limits<float>::infinity()), "-Inf");
}

TEST(Reals, ReadsTheNearestValue) {
  std::mt19937_64 random(2);
  for (int i = 0; i < kRandomValues; ++i) {
    const std::string text = printed("%.*Le", static_cast<int>(random() % 25), finiteMagnitude(random));
    expectRead<double>(text);
    expectRead<float>(text);
  }
}

// Between two neighbours the last of many digits decides.
TEST(Reals, ReadsMiddles) {
  std::mt19937_64 random(3);
  for (int i = 0; i < kRandomValues / 20; ++i) {
    const double low = i % 2 == 0 ? rung_f64_of(random() >> 12) : finiteMagnitude(random);
    const long double middle = low + (std::nextafter(low, HUGE_VAL) - static_cast<long double>(low)) / 2;
    if (!std::isfinite(middle)) continue;
    const std::string exact = printed("%.*Le", 800, middle);
    expectRead<double>(exact);
    expectRead<double>(exact.substr(0, exact.find('e')) + "1" + exact.substr(exact.find('e')));
    const float narrow = static_cast<float>(i) * 1.37F;
    const double between = (static_cast<double>(narrow) + std::nextafter(narrow, HUGE_VALF)) / 2;
    expectRead<float>(printed("%.*Lf", 100, between));
    expectRead<float>(printed("%.*Lf", 100, between) + "1");
  }
}

TEST(Reals, ReadsLimits) {
  for (const char* text :
       {"0", "0e500", "1.", ".5", "00000000000000000000000000000001.50", "1e400", "1e-400", "1.7976931348623158e308",
        "1.7976931348623159e308", "4.9e-324", "2.4703282292062327e-324", "2.4703282292062328e-324", "9007199254740993",
        "3.4028235677973365e38", "3.4028235677973366e38", "7.006492321624085e-46", "7.006492321624086e-46",
        "1e99999999999999999999", "1e-99999999999999999999"}) {
    expectRead<double>(text);
    expectRead<float>(text);
  }
  const auto result = [](const char* text) {
    double value = 0;
    size_t size = std::string(text).size();
    return rung_real_parse(text, &size, false, &value);
  };
  EXPECT_EQ(result("1e308"), RUNG_REAL_READ);
  EXPECT_EQ(result("1e309"), RUNG_REAL_OVERFLOW);
  EXPECT_EQ(result("1e-324"), RUNG_REAL_UNDERFLOW);
  EXPECT_EQ(result("0e-999"), RUNG_REAL_READ);
}

TEST(Reals, ReadsUpToTheFirstOtherCharacter) {
  const auto length = [](const char* text) {
    double value = 0;
    size_t size = std::string(text).size();
    rung_real_parse(text, &size, false, &value);
    return size;
  };
  EXPECT_EQ(length("12 V"), 2u);
  EXPECT_EQ(length("1.5.5"), 3u);
  EXPECT_EQ(length("1e+"), 1u);
  EXPECT_EQ(length("2em"), 1u);
  EXPECT_EQ(length("."), 0u);
  EXPECT_EQ(length("-1"), 0u);
  EXPECT_EQ(length(""), 0u);
}

TEST(Reals, PrintsLikePrintf) {
  std::mt19937_64 random(4);
  const auto check = [](double value, char type, int precision) {
    char out[RUNG_REAL_PRINT_ROOM];
    const uint32_t length = rung_real_print(value, type, static_cast<uint32_t>(precision), false, out);
    const char format[] = {'%', '.', '*', 'L', type, 0};
    ASSERT_EQ(std::string(out, length), printed(format, precision, value)) << type << ' ' << precision;
  };
  for (int i = 0; i < kRandomValues; ++i) {
    const double value = i % 2 == 0 ? finiteMagnitude(random) : static_cast<double>(random() % 100'000'000) / 1024;
    check(value, "feg"[random() % 3], static_cast<int>(random() % (i % 4 == 0 ? 65 : 8)));
  }
  for (const double value : {0.0, 0.5, 1.5, 2.5, 9.5, 9.995, 99.95, 1734.99, 99999.5, 999999.5, 1e22, 1e23, 1e-5,
                             4.9e-324, 1.7976931348623157e308})
    for (const char type : {'f', 'e', 'g'})
      for (int precision = 0; precision <= 64; ++precision) check(value, type, precision);
}

TEST(Reals, KeepsZerosAndPoint) {
  const auto print = [](double value, char type, uint32_t precision) {
    char out[RUNG_REAL_PRINT_ROOM];
    return std::string(out, rung_real_print(value, type, precision, true, out));
  };
  EXPECT_EQ(print(3, 'f', 0), "3.");
  EXPECT_EQ(print(3, 'e', 0), "3.e+00");
  EXPECT_EQ(print(3, 'g', 4), "3.000");
  EXPECT_EQ(print(300000, 'g', 2), "3.0e+05");
}

}  // namespace

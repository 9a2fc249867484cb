// SPDX-License-Identifier: Apache-2.0
// The functions of one REAL or LREAL against those of the C library for long double, over a range of arguments each:
// they differ by at most one unit in the last place.
#include "rung/real_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rung/code.h"

extern "C" {
#define RUNG_DECLARED(NAME, function)                          \
  float rung_standard_##NAME##__REAL(rung_context*, float in); \
  double rung_standard_##NAME##__LREAL(rung_context*, double in);
RUNG_EACH_REAL_FUNCTION(RUNG_DECLARED)
#undef RUNG_DECLARED
}

namespace {

constexpr int kSteps = 20000;

// Distance in units of the last place of the nearest value of the type.
template <class Real>
long double unitsBetween(Real value, long double exact) {
  const Real nearest = static_cast<Real>(exact);
  if (value == nearest || (std::isnan(value) && std::isnan(exact))) return 0;
  const Real unit = std::nextafter(std::fabs(nearest), INFINITY) - std::fabs(nearest);
  return std::fabs(static_cast<long double>(value) - exact) / static_cast<long double>(unit);
}

struct Range {
  double from, to;
};

Range rangeOf(const std::string& name) {
  if (name == "SQRT" || name == "LN" || name == "LOG") return {1e-6, 1e6};
  if (name == "EXP") return {-80.0, 80.0};
  if (name == "ASIN" || name == "ACOS") return {-1.0, 1.0};
  return {-1000.0, 1000.0};
}

TEST(RealFunctions, WithinOneUnitOfTheLastPlace) {
  rung_context context = {};
#define RUNG_COMPARED(NAME, function)                                                                               \
  {                                                                                                                 \
    const Range range = rangeOf(#NAME);                                                                             \
    for (int i = 0; i <= kSteps; ++i) {                                                                             \
      const double x = range.from + (range.to - range.from) * i / kSteps;                                           \
      const auto single = static_cast<float>(x);                                                                    \
      EXPECT_LE(unitsBetween(rung_standard_##NAME##__LREAL(&context, x), function##l(x)), 1.0L) << x;               \
      EXPECT_LE(unitsBetween(rung_standard_##NAME##__REAL(&context, single), function##l(single)), 1.0L) << single; \
    }                                                                                                               \
  }
  RUNG_EACH_REAL_FUNCTION(RUNG_COMPARED)
#undef RUNG_COMPARED
}

}  // namespace

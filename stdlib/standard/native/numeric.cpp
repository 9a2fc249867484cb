// SPDX-License-Identifier: Apache-2.0
// Native bodies of numeric.st: one C function per function and type. Domain errors give NaN or an infinity, no fault.
#include <math.h>

#include "integers.h"
#include "rung/code.h"
#include "rung/real_functions.h"

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadianPerDegree = kPi / 180.0, kDegreePerRadian = 180.0 / kPi;

// Towards zero; saturates outside the type's range, NaN gives 0.
template <class Integer>
Integer truncated(double value) {
  constexpr bool kIsSigned = static_cast<Integer>(-1) < static_cast<Integer>(0);
  constexpr uint64_t kHighest = UINT64_MAX >> (64 - 8 * sizeof(Integer) + (kIsSigned ? 1 : 0));
  constexpr Integer kMax = static_cast<Integer>(kHighest), kMin = kIsSigned ? static_cast<Integer>(-kMax - 1) : 0;
  if (value != value) return 0;
  if (value <= static_cast<double>(kMin)) return kMin;
  // The maximum of a 64-bit type is not exact in a double: it is rounded up, as this comparison needs.
  if (value >= static_cast<double>(kMax)) return kMax;
  return static_cast<Integer>(value);
}

}  // namespace

extern "C" {

#define RUNG_ONE_VARIABLE(NAME, function)                                                 \
  float rung_standard_##NAME##__REAL(rung_context*, float in) { return function##f(in); } \
  double rung_standard_##NAME##__LREAL(rung_context*, double in) { return function(in); }
RUNG_EACH_REAL_FUNCTION(RUNG_ONE_VARIABLE)
#undef RUNG_ONE_VARIABLE

float rung_standard_ATAN2__REAL(rung_context*, float y, float x) { return atan2f(y, x); }
double rung_standard_ATAN2__LREAL(rung_context*, double y, double x) { return atan2(y, x); }

// A REAL is multiplied as LREAL, so that its only rounding is the last.
float rung_standard_RAD__REAL(rung_context*, float in) { return static_cast<float>(in * kRadianPerDegree); }
double rung_standard_RAD__LREAL(rung_context*, double in) { return in * kRadianPerDegree; }
float rung_standard_DEG__REAL(rung_context*, float in) { return static_cast<float>(in * kDegreePerRadian); }
double rung_standard_DEG__LREAL(rung_context*, double in) { return in * kDegreePerRadian; }

#define RUNG_TRUNCATION(TYPE, Integer)                                                                 \
  Integer rung_standard_TRUNC__REAL_##TYPE(rung_context*, float in) { return truncated<Integer>(in); } \
  Integer rung_standard_TRUNC__LREAL_##TYPE(rung_context*, double in) { return truncated<Integer>(in); }
RUNG_EACH_INTEGER(RUNG_TRUNCATION)
#undef RUNG_TRUNCATION

uint8_t rung_standard_IS_VALID__REAL(rung_context*, float in) { return __builtin_isfinite(in) ? 1 : 0; }
uint8_t rung_standard_IS_VALID__LREAL(rung_context*, double in) { return __builtin_isfinite(in) ? 1 : 0; }

}  // extern "C"

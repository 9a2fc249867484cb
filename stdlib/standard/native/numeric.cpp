// Native bodies of numeric.st: one C function per function and type. Domain errors give NaN or an infinity, no fault.
#include <cmath>
#include <limits>

#include "integers.h"
#include "rung/code.h"
#include "rung/cpp_functions.h"

namespace {

// Towards zero; saturates outside the type's range, NaN gives 0.
template <class Integer>
Integer truncated(double value) {
  if (std::isnan(value)) return 0;
  if (value <= static_cast<double>(std::numeric_limits<Integer>::min())) return std::numeric_limits<Integer>::min();
  // The maximum of a 64-bit type is not exact in a double: it is rounded up, as this comparison needs.
  if (value >= static_cast<double>(std::numeric_limits<Integer>::max())) return std::numeric_limits<Integer>::max();
  return static_cast<Integer>(value);
}

}  // namespace

extern "C" {

#define RUNG_ONE_VARIABLE(NAME, function)                                                   \
  float rung_standard_##NAME##__REAL(rung_context*, float in) { return std::function(in); } \
  double rung_standard_##NAME##__LREAL(rung_context*, double in) { return std::function(in); }
RUNG_EACH_REAL_FUNCTION(RUNG_ONE_VARIABLE)
#undef RUNG_ONE_VARIABLE

float rung_standard_ATAN2__REAL(rung_context*, float y, float x) { return std::atan2(y, x); }
double rung_standard_ATAN2__LREAL(rung_context*, double y, double x) { return std::atan2(y, x); }

#define RUNG_TRUNCATION(TYPE, Integer)                                                                 \
  Integer rung_standard_TRUNC__REAL_##TYPE(rung_context*, float in) { return truncated<Integer>(in); } \
  Integer rung_standard_TRUNC__LREAL_##TYPE(rung_context*, double in) { return truncated<Integer>(in); }
RUNG_EACH_INTEGER(RUNG_TRUNCATION)
#undef RUNG_TRUNCATION

uint8_t rung_standard_IS_VALID__REAL(rung_context*, float in) { return std::isfinite(in) ? 1 : 0; }
uint8_t rung_standard_IS_VALID__LREAL(rung_context*, double in) { return std::isfinite(in) ? 1 : 0; }

}  // extern "C"

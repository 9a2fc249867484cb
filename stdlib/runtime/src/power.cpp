// The power function of `**` and EXPT, out of line so that generated code needs no <cmath>. Domain errors give NaN.
#include <cmath>

#include "rung/code.h"

double rung_power(double base, double exponent) { return std::pow(base, exponent); }
double rung_power_integer(double base, int64_t exponent) { return std::pow(base, static_cast<double>(exponent)); }

// SPDX-License-Identifier: Apache-2.0
// The power function of `**` and EXPT, out of line so that generated code needs no <math.h>. Domain errors give NaN.
#include <math.h>

#include "rung/code.h"

double rung_power(double base, double exponent) { return pow(base, exponent); }
double rung_power_integer(double base, int64_t exponent) { return pow(base, static_cast<double>(exponent)); }

/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of one REAL or LREAL of the standard, as a list. Included by their native bodies and by
 * rung/cpp_functions.h.
 */
#ifndef RUNG_REAL_FUNCTIONS_H
#define RUNG_REAL_FUNCTIONS_H

/* ROW(NAME, function) for the functions of one REAL or LREAL; the function is that of <math.h>. */
#define RUNG_EACH_REAL_FUNCTION(ROW) \
  ROW(SQRT, sqrt)                    \
  ROW(LN, log)                       \
  ROW(LOG, log10)                    \
  ROW(EXP, exp)                      \
  ROW(SIN, sin)                      \
  ROW(COS, cos)                      \
  ROW(TAN, tan)                      \
  ROW(ASIN, asin)                    \
  ROW(ACOS, acos)                    \
  ROW(ATAN, atan)

#endif

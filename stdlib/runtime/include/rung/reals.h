/* SPDX-License-Identifier: Apache-2.0 */
/* REAL and LREAL as characters, and back, with the C library alone: no heap, no locale, no writable statics. In: a
 * value (a REAL as the double that equals it) or characters. Out: characters without NUL, or the nearest value. Called
 * by the runtime's string functions, by rung/values.h and by native bodies that format numbers. */
#ifndef RUNG_REALS_H
#define RUNG_REALS_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RUNG_REAL_ROOM 40u        /* characters that rung_real_format may write */
#define RUNG_REAL_PRINT_ROOM 400u /* and rung_real_print */
#define RUNG_REAL_PRECISION 64u   /* the most digits that rung_real_print takes */

/* Writes the fewest digits that read back as the same value, in fixed or scientific notation, whichever is shorter:
 * `0.5`, `100000`, `1e-07`, `NaN`, `-Inf`. `is_single`: as a REAL. Returns the length. */
uint32_t rung_real_format(double value, bool is_single, char* out);

/* Writes the magnitude of a finite value as printf does for `%.*f`, `%.*e` or `%.*g` (`type`); every digit is exact.
 * `keep_zeros`: the flag `#`. Returns the length. */
uint32_t rung_real_print(double value, char type, uint32_t precision, bool keep_zeros, char* out);

typedef enum rung_real_result {
  RUNG_REAL_NONE,      /* no number at the beginning */
  RUNG_REAL_READ,      /* the value that is nearest */
  RUNG_REAL_OVERFLOW,  /* too large: infinity */
  RUNG_REAL_UNDERFLOW, /* not zero, but nearer to zero than to any other value: zero */
} rung_real_result;
/* Reads `12`, `.5`, `1.5e-3` from the beginning of the `*size` characters; no sign. `*size` becomes the number of
 * characters read. */
rung_real_result rung_real_parse(const char* text, size_t* size, bool is_single, double* value);

#ifdef __cplusplus
}
#endif
#endif

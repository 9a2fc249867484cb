/* SPDX-License-Identifier: Apache-2.0 */
/* Formats and parses elementary values. In: a kind of rung_type_kind and the memory of a value. Out: characters, or the
 * value. Serves traces, inputs, assertions and the TO_STRING functions. No heap, no locale. */
#ifndef RUNG_VALUES_H
#define RUNG_VALUES_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Characters that any scalar may need; a STRING[n] needs up to 5n+2. */
#define RUNG_FORMATTED_SCALAR 64u

/* Writes a value as the trace prints it: `TRUE`, `-5`, `0.5`, `T#1s500ms`, `'a$L'`. `is_signed` matters for durations
 * (rung_type::is_signed). For RUNG_STRING and RUNG_WSTRING `value` is the string itself. Cuts at `capacity` characters,
 * ends with NUL (out has capacity + 1 bytes); returns the length written. */
uint32_t rung_format(uint8_t kind, bool is_signed, const void* value, char* out, uint32_t capacity);

/* The same of a string of at most `length` characters, whose NUL may be missing. */
uint32_t rung_format_string(uint8_t kind, const void* value, uint32_t length, char* out, uint32_t capacity);

/* Reads what rung_format writes and any literal of the language (INT#5, 16#FF, 1_000, T#1.5s, DT#...). All of `text`
 * must be the literal. Strings are cut to `length` characters. False: `text` is not a literal of this type, or its
 * value does not fit; then nothing is written. */
bool rung_parse(uint8_t kind, bool is_signed, uint32_t length, const char* text, size_t size, void* value);

#ifdef __cplusplus
}
#endif
#endif

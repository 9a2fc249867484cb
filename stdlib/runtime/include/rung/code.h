/* SPDX-License-Identifier: Apache-2.0 */
/* The runtime header of generated code, included besides its own headers: C++17, no <cmath>, no templates. In: nothing
 * but the compiler and <string.h>. Out: inline helpers for arithmetic with IEC semantics (docs/language.md, Arithmetic
 * and faults), image access, and the declarations of the functions that librung_runtime holds out of line
 * (stdlib/runtime/src). The names of the helpers are a contract with codegen/expressions.cpp; they agree with the
 * arithmetic kernel (sema/types/arithmetic.cpp) bit for bit. */
#ifndef RUNG_CODE_H
#define RUNG_CODE_H

#include <string.h>

#include "rung/call_paths.h"
#include "rung/module.h"

/* The user may compare a USINT with 0 or never read a variable: rung has warned where it matters. */
#ifdef RUNG_GENERATED
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-label"
#pragma GCC diagnostic ignored "-Wtype-limits"
#pragma GCC diagnostic ignored "-Wtautological-compare"
#ifdef __clang__
#pragma clang diagnostic ignored "-Wself-assign"
#else
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#endif

#define RUNG_UNLIKELY(condition) __builtin_expect((condition), 0)
#define RUNG_MAY_ALIAS __attribute__((may_alias))
#define RUNG_COLD __attribute__((cold, noinline))
#define RUNG_PURE __attribute__((pure))
/* A small function that its file calls in loops: g++ may inline it there, and others call it. */
#define RUNG_INLINE __attribute__((used)) inline
/* Optimization of a body (codegen/effort.h). Straight: its loops do little, the quick passes are enough; the three
 * passes that are off took 8 % of the time without effect, since the others find the same. Loops: a swap of two
 * neighbours must not become one wide load and store, whose next load waits for both (every sort would be four times
 * slower); loops are still vectorized; aligned, since the speed of a loop depends by up to 15 % on its position in
 * cache lines. Checked loops: where checks are left, the check of an index that does not change, but is reached after
 * one that does, leaves the inner loop, of which there are then two. As attributes: a pragma costs time at each
 * declaration. */
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && defined(__GNUC__) && !defined(__clang__)
#define RUNG_STRAIGHT __attribute__((optimize("Og", "no-forward-propagate", "no-cprop-registers", "no-tree-ccp")))
#define RUNG_LOOPS __attribute__((aligned(64), optimize("no-tree-slp-vectorize")))
#define RUNG_CHECKED_LOOPS __attribute__((aligned(64), optimize("no-tree-slp-vectorize", "unswitch-loops")))
#else
#define RUNG_STRAIGHT
#define RUNG_LOOPS
#define RUNG_CHECKED_LOOPS
#endif

/* Scalars accessed through POINTER and UNION: memory of any type at any address. */
#define RUNG_ANYWHERE __attribute__((may_alias, aligned(1)))
typedef int8_t RUNG_ANYWHERE rung_i8_at;
typedef int16_t RUNG_ANYWHERE rung_i16_at;
typedef int32_t RUNG_ANYWHERE rung_i32_at;
typedef int64_t RUNG_ANYWHERE rung_i64_at;
typedef uint8_t RUNG_ANYWHERE rung_u8_at;
typedef uint16_t RUNG_ANYWHERE rung_u16_at;
typedef uint32_t RUNG_ANYWHERE rung_u32_at;
typedef uint64_t RUNG_ANYWHERE rung_u64_at;
typedef float RUNG_ANYWHERE rung_f32_at;
typedef double RUNG_ANYWHERE rung_f64_at;
typedef void* RUNG_ANYWHERE rung_pointer_at;

/* A check in front of a statement: `at` is number << 3 | kind of fault; the label is at the end of the body. */
#define RUNG_CHECK(bad, number, what) \
  if (RUNG_UNLIKELY(bad)) {           \
    at = (number);                    \
    value = (int64_t)(what);          \
    goto fault;                       \
  }

/* The type id at the beginning of an object: its class number. */
static inline uint32_t rung_class_of(const void* object) {
  uint32_t number;
  memcpy(&number, object, sizeof number);
  return number;
}

/* ---- division: x/0 = 0 and x MOD 0 = 0 where the check is off, INT_MIN/-1 wraps. 8 and 16 bits go through 32. */
static inline int32_t rung_div_i32(int32_t a, int32_t b) {
  if (b == 0) return 0;
  if (b == -1) return (int32_t)(0u - (uint32_t)a);
  return a / b;
}
static inline int32_t rung_mod_i32(int32_t a, int32_t b) { return b == 0 || b == -1 ? 0 : a % b; }
static inline uint32_t rung_div_u32(uint32_t a, uint32_t b) { return b == 0 ? 0 : a / b; }
static inline uint32_t rung_mod_u32(uint32_t a, uint32_t b) { return b == 0 ? 0 : a % b; }
static inline int64_t rung_div_i64(int64_t a, int64_t b) {
  if (b == 0) return 0;
  if (b == -1) return (int64_t)(0u - (uint64_t)a);
  return a / b;
}
static inline int64_t rung_mod_i64(int64_t a, int64_t b) { return b == 0 || b == -1 ? 0 : a % b; }
static inline uint64_t rung_div_u64(uint64_t a, uint64_t b) { return b == 0 ? 0 : a / b; }
static inline uint64_t rung_mod_u64(uint64_t a, uint64_t b) { return b == 0 ? 0 : a % b; }

/* ---- shifts by a count in 64 bits (a negative one is huge): a count of the width or more gives 0; rotations are
 * modulo the width. `a` is zero-extended. */
static inline uint32_t rung_shl(uint32_t a, uint64_t n) { return n >= 32 ? 0 : a << n; }
static inline uint32_t rung_shr(uint32_t a, uint64_t n) { return n >= 32 ? 0 : a >> n; }
static inline uint64_t rung_shl64(uint64_t a, uint64_t n) { return n >= 64 ? 0 : a << n; }
static inline uint64_t rung_shr64(uint64_t a, uint64_t n) { return n >= 64 ? 0 : a >> n; }
/* Filled with the sign. */
static inline int64_t rung_sar(int64_t a, uint64_t n) { return a >> (n >= 63 ? 63 : n); }
static inline uint8_t rung_rol8(uint8_t a, uint64_t n) { return (uint8_t)(a << (n & 7) | a >> (-n & 7)); }
static inline uint16_t rung_rol16(uint16_t a, uint64_t n) {
  return (uint16_t)((uint32_t)a << (n & 15) | a >> (-n & 15));
}
static inline uint32_t rung_rol32(uint32_t a, uint64_t n) { return a << (n & 31) | a >> (-n & 31); }
static inline uint64_t rung_rol64(uint64_t a, uint64_t n) { return a << (n & 63) | a >> (-n & 63); }

/* ---- conversions. REAL and LREAL to integer give 0 for NaN. rung_round: half to even, saturating; the sum with 2^52
 * rounds in the default mode, which needs no libm. */
static inline int64_t rung_round(double x, int64_t low, int64_t high) {
  if (!(x == x)) return 0;
  if (x <= (double)low) return low;
  if (x >= (double)high) return high;
  if (x >= 4503599627370496.0 || x <= -4503599627370496.0) return (int64_t)x;
  const double shift = x < 0.0 ? -4503599627370496.0 : 4503599627370496.0;
  return (int64_t)((x + shift) - shift);
}
static inline int32_t rung_round_i32(double x) { return (int32_t)rung_round(x, INT32_MIN, INT32_MAX); }
static inline int64_t rung_round_i64(double x) { return rung_round(x, INT64_MIN, INT64_MAX); }
static inline uint64_t rung_round_u64(double x) {
  if (x < 9223372036854775808.0) return (uint64_t)rung_round(x, 0, INT64_MAX);
  if (!(x == x)) return 0;
  return x >= 18446744073709551616.0 ? UINT64_MAX : (uint64_t)x;
}
/* rung_whole: half away from zero, modulo 2^64; to be cut. The constant is the number before 0.5: 0.5 itself would
 * round 0.49999999999999994 up. */
static inline uint64_t rung_last_bits(double whole) {
  uint64_t bits;
  memcpy(&bits, &whole, sizeof bits);
  const uint32_t exponent = (uint32_t)(bits >> 52) & 0x7ff;
  if (exponent < 1075 || exponent >= 1075 + 64) return 0;
  const uint64_t magnitude = ((bits & 0xfffffffffffffULL) | 0x10000000000000ULL) << (exponent - 1075);
  return bits >> 63 != 0 ? 0 - magnitude : magnitude;
}
static inline uint64_t rung_whole(double x) {
  if (!(x > -9223372036854775808.0 && x < 9223372036854775808.0)) return rung_last_bits(x);
  return (uint64_t)(int64_t)(x < 0.0 ? x - 0.49999999999999994 : x + 0.49999999999999994);
}
/* Rounded in the same way, saturating: for checks. */
static inline int64_t rung_whole_i64(double x) {
  if (x >= 9223372036854775808.0) return INT64_MAX;
  return x < -9223372036854775808.0 ? INT64_MIN : (int64_t)rung_whole(x);
}
static inline int64_t rung_clamp(int64_t x, int64_t low, int64_t high) { return x < low ? low : x > high ? high : x; }
static inline uint64_t rung_clamp_u(uint64_t x, uint64_t low, uint64_t high) {
  return x < low ? low : x > high ? high : x;
}
/* Base and exponent of `**`; a REAL base casts the result to float. */
double rung_power(double base, double exponent);
double rung_power_integer(double base, int64_t exponent);
/* Integer base, modulo 2^64; 0 to a negative power is 0 where the check is off. */
static inline uint64_t rung_integer_power(uint64_t base, uint64_t exponent, bool negative) {
  if (negative) return base == 1 ? 1 : base == UINT64_MAX ? ((exponent & 1) != 0 ? base : 1) : 0;
  uint64_t result = 1;
  for (; exponent != 0; exponent >>= 1, base *= base) {
    if ((exponent & 1) != 0) result *= base;
  }
  return result;
}
/* True when x, rounded, is outside of an integer type with these limits (as reals). */
static inline bool rung_round_saturates(double x, double low, double high) {
  return !(x >= low - 0.5 && x < high + 0.5);
}
static inline bool rung_whole_wraps(double x, double low, double high) {
  return !((x > low - 0.5 || x == low) && x < high + 0.5);
}

/* ---- minimum, maximum, magnitude. As in the kernel: the first operand unless the second is beyond it. */
static inline int32_t rung_min_i32(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t rung_max_i32(int32_t a, int32_t b) { return a > b ? a : b; }
static inline uint32_t rung_min_u32(uint32_t a, uint32_t b) { return a < b ? a : b; }
static inline uint32_t rung_max_u32(uint32_t a, uint32_t b) { return a > b ? a : b; }
static inline int64_t rung_min_i64(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t rung_max_i64(int64_t a, int64_t b) { return a > b ? a : b; }
static inline uint64_t rung_min_u64(uint64_t a, uint64_t b) { return a < b ? a : b; }
static inline uint64_t rung_max_u64(uint64_t a, uint64_t b) { return a > b ? a : b; }
static inline float rung_min_f32(float a, float b) { return b < a ? b : a; }
static inline float rung_max_f32(float a, float b) { return b > a ? b : a; }
static inline double rung_min_f64(double a, double b) { return b < a ? b : a; }
static inline double rung_max_f64(double a, double b) { return b > a ? b : a; }
static inline int32_t rung_abs_i32(int32_t a) { return a < 0 ? (int32_t)(0u - (uint32_t)a) : a; }
static inline int64_t rung_abs_i64(int64_t a) { return a < 0 ? (int64_t)(0u - (uint64_t)a) : a; }

/* ---- process image: little-endian at any address, on any machine. Inlined where the quick passes inline nothing, too:
 * a body may be thousands of accesses to the image. */
#if defined(__GNUC__)
#define RUNG_IMAGE static inline __attribute__((always_inline))
#else
#define RUNG_IMAGE static inline
#endif
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ /* one instruction in the quick passes */
RUNG_IMAGE uint16_t rung_get16(const uint8_t* p) {
  uint16_t v;
  memcpy(&v, p, sizeof v);
  return v;
}
RUNG_IMAGE uint32_t rung_get32(const uint8_t* p) {
  uint32_t v;
  memcpy(&v, p, sizeof v);
  return v;
}
RUNG_IMAGE uint64_t rung_get64(const uint8_t* p) {
  uint64_t v;
  memcpy(&v, p, sizeof v);
  return v;
}
RUNG_IMAGE void rung_put16(uint8_t* p, uint16_t v) { memcpy(p, &v, sizeof v); }
RUNG_IMAGE void rung_put32(uint8_t* p, uint32_t v) { memcpy(p, &v, sizeof v); }
RUNG_IMAGE void rung_put64(uint8_t* p, uint64_t v) { memcpy(p, &v, sizeof v); }
#else
RUNG_IMAGE uint16_t rung_get16(const uint8_t* p) { return (uint16_t)(p[0] | p[1] << 8); }
RUNG_IMAGE uint32_t rung_get32(const uint8_t* p) {
  return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}
RUNG_IMAGE uint64_t rung_get64(const uint8_t* p) { return rung_get32(p) | (uint64_t)rung_get32(p + 4) << 32; }
RUNG_IMAGE void rung_put16(uint8_t* p, uint16_t v) {
  p[0] = (uint8_t)v;
  p[1] = (uint8_t)(v >> 8);
}
RUNG_IMAGE void rung_put32(uint8_t* p, uint32_t v) {
  rung_put16(p, (uint16_t)v);
  rung_put16(p + 2, (uint16_t)(v >> 16));
}
RUNG_IMAGE void rung_put64(uint8_t* p, uint64_t v) {
  rung_put32(p, (uint32_t)v);
  rung_put32(p + 4, (uint32_t)(v >> 32));
}
#endif
/* A call: g++ makes a jump of a comparison that is shifted. */
RUNG_IMAGE uint32_t rung_bit(bool v, uint32_t bit) { return (uint32_t)v << bit; }
RUNG_IMAGE void rung_put_bit(uint8_t* p, uint32_t bit, bool v) {
  *p = (uint8_t)((*p & ~(1u << bit)) | (uint32_t)v << bit);
}
static inline float rung_f32_of(uint32_t bits) {
  float v;
  memcpy(&v, &bits, sizeof v);
  return v;
}
static inline double rung_f64_of(uint64_t bits) {
  double v;
  memcpy(&v, &bits, sizeof v);
  return v;
}
static inline uint32_t rung_bits_of_f32(float v) {
  uint32_t bits;
  memcpy(&bits, &v, sizeof bits);
  return bits;
}
static inline uint64_t rung_bits_of_f64(double v) {
  uint64_t bits;
  memcpy(&bits, &v, sizeof bits);
  return bits;
}

#ifdef __cplusplus
extern "C" {

/* ---- strings. In place, NUL-terminated, `capacity` without the NUL; results that are too long are cut. `to` may be
 * `from`, or overlap it. The same holds for every native function of a library: `out` may be one of its string inputs.
 * Functions that make a string return its length. */
uint32_t rung_string_assign(char* to, uint32_t capacity, const char* from);
uint32_t rung_wstring_assign(char16_t* to, uint32_t capacity, const char16_t* from);
/* USTRING: UTF-8, cut between characters. Compared like STRING: that order is the order of code points. */
uint32_t rung_ustring_assign(char* to, uint32_t capacity, const char* from);
/* Drops an incomplete character at the end of a string; returns its length without it. */
uint32_t rung_ustring_whole(char* string, uint32_t length);
uint32_t rung_ustring_length(const char* string) RUNG_PURE; /* in characters */
/* The offset in bytes where `count` characters end; each character beyond the end of the string counts as one byte. */
int64_t rung_ustring_offset(const char* string, int64_t count) RUNG_PURE;
uint32_t rung_ustring_code(const char* string) RUNG_PURE; /* the first character; 0 when empty, '?' when invalid */
uint32_t rung_ustring_of_code(char* to, uint32_t capacity, uint32_t code);
uint32_t rung_ustring_of_string(char* to, uint32_t capacity,
                                const char* from); /* of a STRING, which may hold any bytes */
/* A unit of a WSTRING, which may begin at an odd address of the image. */
static inline char16_t rung_unit(const char16_t* string, uint32_t index) {
  char16_t unit;
  memcpy(&unit, (const char*)string + index * sizeof unit, sizeof unit);
  return unit;
}
static inline void rung_set_unit(char16_t* string, uint32_t index, char16_t unit) {
  memcpy((char*)string + index * sizeof unit, &unit, sizeof unit);
}
/* Negative, 0 or positive; compares unsigned units. */
int rung_string_compare(const char* a, const char* b) RUNG_PURE;
int rung_wstring_compare(const char16_t* a, const char16_t* b) RUNG_PURE;
uint32_t rung_wstring_length(const char16_t* string) RUNG_PURE;
#define RUNG_UNCOUNTED UINT32_MAX /* in place of a length that nothing knows */
static inline uint32_t rung_string_length(const char* string) { return (uint32_t)strlen(string); }
/* As rung_string_assign, with a known length; `to` and `from` are one variable or do not overlap. */
static inline uint32_t rung_string_put(char* to, uint32_t capacity, const char* from, uint32_t length) {
  if (length > capacity) length = capacity;
  memmove(to, from, length);
  to[length] = 0;
  return length;
}
/* STRING is UTF-8 here, WSTRING UTF-16; an invalid code point becomes '?'. */
uint32_t rung_string_of_wstring(char* to, uint32_t capacity, const char16_t* from);
uint32_t rung_wstring_of_string(char16_t* to, uint32_t capacity, const char* from);
/* A scalar as <T>_TO_STRING formats it, and back. `kind`: rung_type_kind; `bits`: the value, sign- or
 * zero-extended (REAL and LREAL: the bits of a double). Reading gives 0 when the string is not such a value; the caller
 * cuts the result to the type's width. */
uint32_t rung_string_of_scalar(char* to, uint32_t capacity, uint8_t kind, uint64_t bits);
uint32_t rung_wstring_of_scalar(char16_t* to, uint32_t capacity, uint8_t kind, uint64_t bits);
/* The most frequent case: a decimal number. */
uint32_t rung_string_of_integer(char* to, uint32_t capacity, bool negative, uint64_t magnitude);
uint64_t rung_scalar_of_string(uint8_t kind, const char* string) RUNG_PURE;
uint64_t rung_scalar_of_wstring(uint8_t kind, const char16_t* string) RUNG_PURE;

/* ---- faults */
/* Runs `run(frame)` and catches its faults: RUNG_FAULT_NONE, or the kind, details in ctx->fault. Nests. For __TRY. */
uint8_t rung_try(rung_context* ctx, void (*run)(void* frame), void* frame);
/* Asked when ctx->steps is below 0 or ctx->stop is set: whether the activation ends here, by rung_raise with
 * RUNG_FAULT_STOP. */
bool rung_poll(rung_context* ctx);
static inline bool rung_step(rung_context* ctx) {
  return RUNG_UNLIKELY((int)(--ctx->steps < 0) | (int)(ctx->stop != 0)) && rung_poll(ctx);
}
/* The steps of a loop with `repeats` + 1 iterations, at once. */
static inline bool rung_steps(rung_context* ctx, uint64_t repeats) {
  if (RUNG_UNLIKELY((repeats >= (uint64_t)ctx->steps) | (ctx->stop != 0))) {
    ctx->steps = -1;
    return rung_poll(ctx);
  }
  ctx->steps -= (int64_t)repeats + 1;
  return false;
}

/* ---- assertions of tests, reported to ctx->host->assertion. `kind` and bits: as in rung_string_of_scalar, and
 * RUNG_ENUM; for RUNG_STRING and RUNG_WSTRING the bits are the address. Equal means IEC `=` (NaN is equal to NaN here).
 */
void rung_assert(rung_context* ctx, const rung_assertion* assertion, bool ok);
/* The same for a comparison; the report shows both sides. */
void rung_assert_compared(rung_context* ctx, const rung_assertion* assertion, bool ok, uint8_t kind, uint64_t left,
                          uint64_t right);
void rung_assert_equal(rung_context* ctx, const rung_assertion* assertion, uint8_t kind, uint64_t expected,
                       uint64_t actual);
/* kind: RUNG_REAL or RUNG_LREAL; passes when |expected - actual| <= tolerance, or both are equal. */
void rung_assert_near(rung_context* ctx, const rung_assertion* assertion, uint8_t kind, double expected, double actual,
                      double tolerance);

} /* extern "C" */
#endif
#endif

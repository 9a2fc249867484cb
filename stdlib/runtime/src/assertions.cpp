// SPDX-License-Identifier: Apache-2.0
// ASSERT, ASSERT_EQ and ASSERT_NEAR of tests (rung/code.h): compares, formats the values of a failure like the trace,
// and reports to the host's `assertion` callback. A failing assertion does not end the test.
#include <string.h>

#include "rung/code.h"
#include "rung/values.h"

namespace {

void report(rung_context* ctx, const rung_assertion* assertion, bool passed, const char* expected, const char* actual) {
  if (ctx->host != nullptr && ctx->host->assertion != nullptr)
    ctx->host->assertion(ctx->host_data, assertion, passed, expected, actual);
}

// Room for the functions' strings of 255 characters, each as `$hhhh`.
constexpr uint32_t kRoom = 5 * 255 + 2;
struct Formatted {
  char text[kRoom + 1];
};

template <class Char>
const Char* stringAt(uint64_t bits) {
  return reinterpret_cast<const Char*>(static_cast<uintptr_t>(bits));
}

bool isReal(uint8_t kind) { return kind == RUNG_REAL || kind == RUNG_LREAL; }

// `Red`, or the number when it is not an item.
void formatItem(const char* items, uint64_t bits, Formatted& out) {
  rung_format(RUNG_LINT, true, &bits, out.text, kRoom);
  while (items != nullptr && *items != 0) {
    const char* const name = items;
    const char* const number = name + strlen(name) + 1;
    if (strcmp(number, out.text) == 0) {
      rung_string_assign(out.text, kRoom, name);
      return;
    }
    items = number + strlen(number) + 1;
  }
}

void format(const rung_assertion* assertion, uint8_t kind, uint64_t bits, Formatted& out) {
  if (kind == RUNG_STRING || kind == RUNG_USTRING) {
    rung_format(kind, false, stringAt<char>(bits), out.text, kRoom);
  } else if (kind == RUNG_WSTRING) {
    rung_format(kind, false, stringAt<char16_t>(bits), out.text, kRoom);
  } else if (kind == RUNG_ENUM) {
    formatItem(assertion->items, bits, out);
  } else if (kind == RUNG_REAL) {
    const float value = static_cast<float>(rung_f64_of(bits));
    rung_format(kind, false, &value, out.text, kRoom);
  } else {
    rung_format(kind, static_cast<int64_t>(bits) < 0, &bits, out.text, kRoom);
  }
}

bool areEqual(uint8_t kind, uint64_t a, uint64_t b) {
  if (kind == RUNG_STRING || kind == RUNG_USTRING) return strcmp(stringAt<char>(a), stringAt<char>(b)) == 0;
  if (kind == RUNG_WSTRING) return rung_wstring_compare(stringAt<char16_t>(a), stringAt<char16_t>(b)) == 0;
  if (!isReal(kind)) return a == b;
  const double x = rung_f64_of(a), y = rung_f64_of(b);
  return x == y || (x != x && y != y);
}

// Appends to a string as much as fits.
template <size_t kSize>
void append(char (&to)[kSize], const char* from, size_t length) {
  const size_t at = strlen(to), room = kSize - 1 - at;
  if (length > room) length = room;
  memcpy(to + at, from, length);
  to[at + length] = 0;
}

// `a = 5`
template <size_t kSize>
void appendValue(char (&to)[kSize], const char* name, size_t name_length, const char* value) {
  append(to, name, name_length);
  append(to, " = ", 3);
  append(to, value, strlen(value));
}

void reportValues(rung_context* ctx, const rung_assertion* assertion, uint8_t kind, uint64_t expected,
                  uint64_t actual) {
  Formatted wanted, seen;
  format(assertion, kind, expected, wanted);
  format(assertion, kind, actual, seen);
  report(ctx, assertion, false, wanted.text, seen.text);
}

}  // namespace

void rung_assert(rung_context* ctx, const rung_assertion* assertion, bool ok) {
  report(ctx, assertion, ok, ok ? nullptr : "TRUE", ok ? nullptr : "FALSE");
}

void rung_assert_compared(rung_context* ctx, const rung_assertion* assertion, bool ok, uint8_t kind, uint64_t left,
                          uint64_t right) {
  if (ok || assertion->shown == nullptr) return rung_assert(ctx, assertion, ok);
  const char* const condition = assertion->shown;
  const size_t condition_length = strcspn(condition, "\n");
  const char* const left_name = condition + condition_length + 1;
  const size_t left_length = strcspn(left_name, "\n");
  const char* const right_name = left_name + left_length + 1;
  Formatted value;
  char wanted[512], seen[2 * kRoom + 512];
  wanted[0] = seen[0] = 0;
  append(wanted, condition, condition_length);
  if (left_length != 0) {
    format(assertion, kind, left, value);
    appendValue(seen, left_name, left_length, value.text);
  }
  if (*right_name != 0) {
    format(assertion, kind, right, value);
    if (left_length != 0) append(seen, ", ", 2);
    appendValue(seen, right_name, strlen(right_name), value.text);
  }
  report(ctx, assertion, false, wanted, seen);
}

void rung_assert_equal(rung_context* ctx, const rung_assertion* assertion, uint8_t kind, uint64_t expected,
                       uint64_t actual) {
  if (areEqual(kind, expected, actual)) return report(ctx, assertion, true, nullptr, nullptr);
  reportValues(ctx, assertion, kind, expected, actual);
}

void rung_assert_near(rung_context* ctx, const rung_assertion* assertion, uint8_t kind, double expected, double actual,
                      double tolerance) {
  const bool ok = expected == actual || __builtin_fabs(expected - actual) <= tolerance ||
                  (expected != expected && actual != actual);
  if (ok) return report(ctx, assertion, true, nullptr, nullptr);
  reportValues(ctx, assertion, kind, rung_bits_of_f64(expected), rung_bits_of_f64(actual));
}

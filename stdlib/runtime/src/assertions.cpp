// ASSERT, ASSERT_EQ and ASSERT_NEAR of tests (rung/code.h): compares, formats the values of a failure like the trace,
// and reports to the host's `assertion` callback. A failing assertion does not end the test.
#include <cmath>
#include <cstdio>
#include <cstring>

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
  return x == y || (std::isnan(x) && std::isnan(y));
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
  snprintf(wanted, sizeof wanted, "%.*s", static_cast<int>(condition_length), condition);
  int length = 0;
  if (left_length != 0) {
    format(assertion, kind, left, value);
    length = snprintf(seen, sizeof seen, "%.*s = %s", static_cast<int>(left_length), left_name, value.text);
  }
  if (*right_name != 0 && length < static_cast<int>(sizeof seen)) {
    format(assertion, kind, right, value);
    snprintf(seen + length, sizeof seen - static_cast<size_t>(length), "%s%s = %s", length == 0 ? "" : ", ", right_name,
             value.text);
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
  const bool ok =
      expected == actual || std::fabs(expected - actual) <= tolerance || (std::isnan(expected) && std::isnan(actual));
  if (ok) return report(ctx, assertion, true, nullptr, nullptr);
  reportValues(ctx, assertion, kind, rung_bits_of_f64(expected), rung_bits_of_f64(actual));
}

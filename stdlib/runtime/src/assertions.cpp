// ASSERT, ASSERT_EQ and ASSERT_NEAR of tests (rung/code.h): compares, spells both values as the trace does, and reports
// to the host's `assertion` callback. A failing assertion does not end the test.
#include <cmath>
#include <cstring>

#include "rung/code.h"
#include "rung/values.h"

namespace {

void report(rung_context* ctx, bool passed, const char* file, uint32_t line, const char* expected, const char* actual,
            const char* text) {
  if (ctx->host != nullptr && ctx->host->assertion != nullptr)
    ctx->host->assertion(ctx->host_data, passed, file, line, expected, actual, text);
}

void spellScalar(uint8_t kind, uint64_t bits, char* out) {
  if (kind == RUNG_REAL) {
    const float value = static_cast<float>(rung_f64_of(bits));
    rung_spell(kind, false, &value, out, RUNG_SPELLED_SCALAR);
  } else {
    rung_spell(kind, static_cast<int64_t>(bits) < 0, &bits, out, RUNG_SPELLED_SCALAR);
  }
}

bool isReal(uint8_t kind) { return kind == RUNG_REAL || kind == RUNG_LREAL; }

// `Red`, or the number when no item has it.
void spellItem(const char* items, int64_t value, char* out, size_t room) {
  rung_spell(RUNG_LINT, true, &value, out, static_cast<uint32_t>(room - 1));
  while (*items != 0) {
    const char* const name = items;
    const char* const number = name + strlen(name) + 1;
    if (strcmp(number, out) == 0) {
      rung_text_assign(out, static_cast<uint32_t>(room - 1), name);
      return;
    }
    items = number + strlen(number) + 1;
  }
}

// Room for texts of the functions' 255 characters, each as `$hh`.
constexpr uint32_t kTextRoom = 3 * 255 + 2;

}  // namespace

void rung_assert(rung_context* ctx, const char* file, uint32_t line, bool good, const char* text) {
  report(ctx, good, file, line, "TRUE", good ? "TRUE" : "FALSE", text);
}

void rung_assert_equal(rung_context* ctx, const char* file, uint32_t line, uint8_t kind, uint64_t expected,
                       uint64_t actual, const char* text) {
  bool good = expected == actual;
  if (isReal(kind)) {
    const double a = rung_f64_of(expected), b = rung_f64_of(actual);
    good = a == b || (std::isnan(a) && std::isnan(b));
  }
  char wanted[RUNG_SPELLED_SCALAR + 1], seen[RUNG_SPELLED_SCALAR + 1];
  spellScalar(kind, expected, wanted);
  spellScalar(kind, actual, seen);
  report(ctx, good, file, line, wanted, seen, text);
}

void rung_assert_equal_text(rung_context* ctx, const char* file, uint32_t line, const char* expected,
                            const char* actual, const char* text) {
  char wanted[kTextRoom + 1], seen[kTextRoom + 1];
  rung_spell(RUNG_STRING, false, expected, wanted, kTextRoom);
  rung_spell(RUNG_STRING, false, actual, seen, kTextRoom);
  report(ctx, strcmp(expected, actual) == 0, file, line, wanted, seen, text);
}

void rung_assert_equal_wtext(rung_context* ctx, const char* file, uint32_t line, const char16_t* expected,
                             const char16_t* actual, const char* text) {
  char wanted[2 * kTextRoom + 1], seen[2 * kTextRoom + 1];
  rung_spell(RUNG_WSTRING, false, expected, wanted, 2 * kTextRoom);
  rung_spell(RUNG_WSTRING, false, actual, seen, 2 * kTextRoom);
  report(ctx, rung_wtext_compare(expected, actual) == 0, file, line, wanted, seen, text);
}

void rung_assert_equal_enum(rung_context* ctx, const char* file, uint32_t line, const char* items, int64_t expected,
                            int64_t actual, const char* text) {
  char wanted[256], seen[256];
  spellItem(items, expected, wanted, sizeof wanted);
  spellItem(items, actual, seen, sizeof seen);
  report(ctx, expected == actual, file, line, wanted, seen, text);
}

void rung_assert_near(rung_context* ctx, const char* file, uint32_t line, uint8_t kind, double expected, double actual,
                      double tolerance, const char* text) {
  const bool good =
      expected == actual || std::fabs(expected - actual) <= tolerance || (std::isnan(expected) && std::isnan(actual));
  char wanted[RUNG_SPELLED_SCALAR + 1], seen[RUNG_SPELLED_SCALAR + 1];
  spellScalar(kind, rung_bits_of_f64(expected), wanted);
  spellScalar(kind, rung_bits_of_f64(actual), seen);
  report(ctx, good, file, line, wanted, seen, text);
}

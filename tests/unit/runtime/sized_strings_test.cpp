// SPDX-License-Identifier: Apache-2.0
// The string functions of the library Standard, in both native forms, against the descriptions of their declarations
// (standard/string.st) written with std::string: all small arguments, all capacities, and the target as each input.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>

#include "rung/standard.h"

extern "C" {
uint32_t rung_standard_LEFT__STRING_255(rung_context*, const char*, int32_t, char*, uint32_t);
uint32_t rung_standard_RIGHT__STRING_255(rung_context*, const char*, int32_t, char*, uint32_t);
uint32_t rung_standard_MID__STRING_255(rung_context*, const char*, int32_t, int32_t, char*, uint32_t);
uint32_t rung_standard_CONCAT__STRING_255(rung_context*, const char*, const char*, char*, uint32_t);
uint32_t rung_standard_INSERT__STRING_255(rung_context*, const char*, const char*, int32_t, char*, uint32_t);
uint32_t rung_standard_DELETE__STRING_255(rung_context*, const char*, int32_t, int32_t, char*, uint32_t);
uint32_t rung_standard_REPLACE__STRING_255(rung_context*, const char*, const char*, int32_t, int32_t, char*, uint32_t);
int16_t rung_standard_FIND__STRING_255(rung_context*, const char*, const char*);
}

namespace {

constexpr uint32_t kMaxCapacity = 8;
const std::string kFirst[] = {"", "a", "abc", "abab", "abcdefgh"};
const std::string kSecond[] = {"", "x", "ab", "xyz"};

// As many characters as there are; none for a count of 0 or less.
std::string part(const std::string& text, int64_t begin, int64_t count) {
  if (begin < 0 || begin >= static_cast<int64_t>(text.size()) || count <= 0) return "";
  return text.substr(static_cast<size_t>(begin), static_cast<size_t>(count));
}

struct Arguments {
  std::string in1, in2;
  int32_t l, p;
};
struct Case {
  const char* name;
  std::function<std::string(const Arguments&)> expected;
  std::function<uint32_t(const Arguments&, const char*, const char*, char*, uint32_t)> plain, sized;
};

uint32_t length(const char* text) { return static_cast<uint32_t>(strlen(text)); }

const Case kCases[] = {
    {"LEFT", [](const Arguments& x) { return part(x.in1, 0, x.l); },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_LEFT__STRING_255(nullptr, a, x.l, out, capacity);
     },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_LEFT__STRING_255_sized(a, length(a), x.l, out, capacity);
     }},
    {"RIGHT",
     [](const Arguments& x) {
       const auto size = static_cast<int64_t>(x.in1.size());
       return x.l >= size ? x.in1 : part(x.in1, size - x.l, x.l);
     },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_RIGHT__STRING_255(nullptr, a, x.l, out, capacity);
     },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_RIGHT__STRING_255_sized(a, length(a), x.l, out, capacity);
     }},
    {"MID", [](const Arguments& x) { return part(x.in1, int64_t{x.p} - 1, x.l); },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_MID__STRING_255(nullptr, a, x.l, x.p, out, capacity);
     },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_MID__STRING_255_sized(a, length(a), x.l, x.p, out, capacity);
     }},
    {"CONCAT", [](const Arguments& x) { return x.in1 + x.in2; },
     [](const Arguments&, const char* a, const char* b, char* out, uint32_t capacity) {
       return rung_standard_CONCAT__STRING_255(nullptr, a, b, out, capacity);
     },
     [](const Arguments&, const char* a, const char* b, char* out, uint32_t capacity) {
       return rung_standard_CONCAT__STRING_255_sized(a, length(a), b, length(b), out, capacity);
     }},
    {"INSERT",
     [](const Arguments& x) {
       const int64_t size = static_cast<int64_t>(x.in1.size()), at = x.p > size ? size : x.p;
       if (x.p < 0 || x.p > 255) return x.in1;
       return part(x.in1, 0, at) + x.in2 + part(x.in1, at, size);
     },
     [](const Arguments& x, const char* a, const char* b, char* out, uint32_t capacity) {
       return rung_standard_INSERT__STRING_255(nullptr, a, b, x.p, out, capacity);
     },
     [](const Arguments& x, const char* a, const char* b, char* out, uint32_t capacity) {
       return rung_standard_INSERT__STRING_255_sized(a, length(a), b, length(b), x.p, out, capacity);
     }},
    {"DELETE",
     [](const Arguments& x) {
       const auto size = static_cast<int64_t>(x.in1.size());
       const int64_t p = x.p == 0 ? 1 : x.p, l = int64_t{x.l} - (x.p == 0 ? 1 : 0);
       if (p < 1 || p > size || l <= 0) return x.in1;
       return part(x.in1, 0, p - 1) + part(x.in1, p - 1 + l, size);
     },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_DELETE__STRING_255(nullptr, a, x.l, x.p, out, capacity);
     },
     [](const Arguments& x, const char* a, const char*, char* out, uint32_t capacity) {
       return rung_standard_DELETE__STRING_255_sized(a, length(a), x.l, x.p, out, capacity);
     }},
    {"REPLACE",
     [](const Arguments& x) {
       const auto size = static_cast<int64_t>(x.in1.size());
       const int64_t p = x.p == 0 ? 1 : x.p, l = int64_t{x.l} - (x.p == 0 ? 1 : 0);
       if (p < 1 || p > size + 1) return x.in1;
       return part(x.in1, 0, p - 1) + x.in2 + part(x.in1, p - 1 + (l > 0 ? l : 0), size);
     },
     [](const Arguments& x, const char* a, const char* b, char* out, uint32_t capacity) {
       return rung_standard_REPLACE__STRING_255(nullptr, a, b, x.l, x.p, out, capacity);
     },
     [](const Arguments& x, const char* a, const char* b, char* out, uint32_t capacity) {
       return rung_standard_REPLACE__STRING_255_sized(a, length(a), b, length(b), x.l, x.p, out, capacity);
     }},
};

// The target separate, as the first input, as the second, and as both inputs, which may be longer than it is.
void check(const Case& one, const Arguments& x, uint32_t capacity) {
  for (int alias = 0; alias < 4; ++alias) {
    Arguments used = x;
    if (alias == 3) used.in2 = used.in1;
    const std::string expected = one.expected(used).substr(0, capacity);
    for (const auto& form : {one.plain, one.sized}) {
      char in1[16], in2[16], out[kMaxCapacity + 2];
      strcpy(in1, used.in1.c_str());
      strcpy(in2, used.in2.c_str());
      memset(out, '#', sizeof out);
      if (alias == 1 || alias == 3) strcpy(out, used.in1.c_str());
      if (alias == 2) strcpy(out, used.in2.c_str());
      const char* const a = alias == 1 || alias == 3 ? out : in1;
      const char* const b = alias == 2 || alias == 3 ? out : in2;
      const uint32_t given = form(used, a, b, out, capacity);
      ASSERT_EQ(expected, out) << one.name << "('" << used.in1 << "', '" << used.in2 << "', L " << x.l << ", P " << x.p
                               << ") in " << capacity << ", alias " << alias;
      ASSERT_EQ(expected.size(), given) << one.name;
      const bool was_longer = alias != 0 && strlen(a == out ? in1 : in2) > capacity;
      if (!was_longer) {
        ASSERT_EQ('#', out[capacity + 1]) << one.name << " wrote past its target";
      }
    }
  }
}

TEST(SizedString, BothFormsDoWhatTheDeclarationSays) {
  for (const Case& one : kCases) {
    for (const std::string& in1 : kFirst) {
      for (const std::string& in2 : kSecond) {
        for (int32_t l : {INT32_MIN, -1, 0, 1, 2, 3, 8, 9, INT32_MAX}) {
          for (int32_t p : {INT32_MIN, -1, 0, 1, 2, 4, 8, 9, INT32_MAX}) {
            for (uint32_t capacity = 0; capacity <= kMaxCapacity; ++capacity)
              ASSERT_NO_FATAL_FAILURE(check(one, {in1, in2, l, p}, capacity));
          }
        }
      }
    }
  }
}

// Decimal digits, cut at the capacity.
TEST(SizedString, NumbersOfEveryLength) {
  const auto check = [](int64_t number) {
    const std::string all = std::to_string(number);
    for (uint32_t capacity = 0; capacity <= 24; ++capacity) {
      const std::string expected = all.substr(0, capacity);
      char out[32];
      memset(out, '#', sizeof out);
      ASSERT_EQ(expected.size(), rung_standard_TO_STRING__LINT_sized(number, out, capacity)) << number;
      ASSERT_EQ(expected, out) << number << " in " << capacity;
      ASSERT_EQ('#', out[capacity + 1]) << number << " wrote past its target";
      if (number == static_cast<int16_t>(number)) {
        ASSERT_EQ(expected.size(), rung_standard_TO_STRING__INT_sized(static_cast<int16_t>(number), out, capacity));
        ASSERT_EQ(expected, out) << number << " in " << capacity;
      }
    }
  };
  for (int64_t power = 1; power < INT64_MAX / 10; power *= 10) {
    for (int64_t digit = 1; digit < 10; ++digit) {
      for (int64_t number : {power * digit - 1, power * digit, power * digit + power / 3}) {
        ASSERT_NO_FATAL_FAILURE(check(number));
        ASSERT_NO_FATAL_FAILURE(check(-number));
      }
    }
  }
  for (int64_t number : {INT64_MIN, INT64_MAX}) ASSERT_NO_FATAL_FAILURE(check(number));
  char out[32];
  EXPECT_EQ(20, rung_standard_TO_STRING__ULINT_sized(UINT64_MAX, out, 30));
  EXPECT_EQ(std::to_string(UINT64_MAX), out);
  EXPECT_EQ(3, rung_standard_TO_STRING__BYTE_sized(200, out, 30));
  EXPECT_STREQ("200", out);
}

TEST(SizedString, FindInStringsOfEveryLength) {
  for (size_t size = 0; size < 40; ++size) {
    for (size_t at = 0; at <= size; ++at) {
      std::string text(size, '0');
      if (at < size) text[at] = '1';
      const int16_t expected = at < size ? static_cast<int16_t>(at + 1) : 0;
      const auto length = static_cast<uint32_t>(size);
      ASSERT_EQ(expected, rung_standard_FIND__STRING_255_sized(text.data(), length, "1", 1)) << size;
      ASSERT_EQ(expected, rung_standard_FIND__STRING_255(nullptr, text.c_str(), "1")) << size;
      ASSERT_EQ(at > 0 ? expected > 0 ? expected - 1 : 0 : 0,
                rung_standard_FIND__STRING_255_sized(text.data(), length, "01", 2))
          << size;
    }
  }
  EXPECT_EQ(0, rung_standard_FIND__STRING_255_sized("abc", 3, "", 0));
  EXPECT_EQ(0, rung_standard_FIND__STRING_255_sized("ab", 2, "abc", 3));
  // A byte that differs from the previous one by its highest bit, or by one.
  EXPECT_EQ(3, rung_standard_FIND__STRING_255_sized("\x80\x02\x01\x01\x01\x01\x01\x01\x01", 9, "\x01", 1));
}

TEST(SizedString, ResultsHaveAtMost255Characters) {
  const std::string long_string(300, 'a');
  char out[401];
  strcpy(out, long_string.c_str());
  EXPECT_EQ(255u, rung_standard_CONCAT__STRING_255_sized(out, 300, "x", 1, out, 400));
  EXPECT_EQ(255u, strlen(out));
  EXPECT_EQ(255u, rung_standard_LEFT__STRING_255_sized(long_string.c_str(), 300, 290, out, 400));
  EXPECT_EQ(255u, rung_standard_MID__STRING_255_sized(long_string.c_str(), 300, 290, 2, out, 400));
  EXPECT_EQ(255u, rung_standard_INSERT__STRING_255_sized(long_string.c_str(), 300, "x", 1, 299, out, 400));
}

}  // namespace

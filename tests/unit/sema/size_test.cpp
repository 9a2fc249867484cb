// SPDX-License-Identifier: Apache-2.0
// Large and deep declarations: linear time, no deep recursion.
#include <gtest/gtest.h>

#include <chrono>

#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

struct Clock {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
};

// The limits are far above the actual time, and far below that of a quadratic step.
std::string blocksInAChain(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string next = i + 1 < count ? "b" + std::to_string(i + 1) : "INT";
    text += "FUNCTION_BLOCK b" + std::to_string(i) + " VAR x : " + next + "; END_VAR END_FUNCTION_BLOCK\n";
  }
  return text;
}

TEST(Size, a_thousand_blocks_in_a_chain) { EXPECT_EQ(Checked(blocksInAChain(1000)).codes(), ""); }

TEST(Size, a_hundred_thousand_blocks_in_a_chain_end_with_errors_not_a_crash) {
  const Clock clock;
  const Checked checked(blocksInAChain(100000));
  EXPECT_TRUE(checked.codes().starts_with("E0220@"));
  EXPECT_LT(clock.seconds(), 20.0);
}

TEST(Size, a_hundred_thousand_variables_in_one_program) {
  std::string text = "PROGRAM p VAR\n";
  for (int i = 0; i < 100000; ++i) text += "v" + std::to_string(i) + " : INT := 5;\n";
  text += "END_VAR v99999 := v0; END_PROGRAM";
  const Clock clock;
  const Checked checked(text);
  EXPECT_EQ(checked.codes(), "");
  EXPECT_LT(clock.seconds(), 5.0);
}

TEST(Size, a_hundred_thousand_elements) {
  std::string text = "PROGRAM p VAR a : ARRAY[1..100000] OF DINT := [0";
  for (int i = 1; i < 100000; ++i) text += ", " + std::to_string(i);
  text += "]; END_VAR END_PROGRAM";
  const Clock clock;
  const Checked checked(text);
  EXPECT_EQ(checked.codes(), "");
  EXPECT_LT(clock.seconds(), 5.0);
}

TEST(Size, constants_in_a_chain_backwards_end_with_an_error_not_a_crash) {
  std::string text = "VAR_GLOBAL CONSTANT\n";
  for (int i = 0; i < 20000; ++i) text += "c" + std::to_string(i) + " : INT := c" + std::to_string(i + 1) + ";\n";
  text += "c20000 : INT := 1; END_VAR";
  const Checked checked(text);
  EXPECT_TRUE(checked.diagnostics.hasErrors());
}

}  // namespace
}  // namespace rung::sema

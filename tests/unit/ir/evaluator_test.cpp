// SPDX-License-Identifier: Apache-2.0
// The test evaluator itself: faults, loops and calls, with results computed by hand.
#include "evaluator.h"

#include <gtest/gtest.h>

#include "ir_text.h"

namespace rung::ir {
namespace {

RunResult runText(const std::string& text, std::vector<int64_t> arguments) {
  TestModule m(text);
  EXPECT_TRUE(m.ok) << m.errors();
  std::vector<types::Value> values;
  for (int64_t a : arguments) values.push_back({types::kInt, static_cast<uint64_t>(a)});
  return run(m.module, *m.find("f"), values);
}

TEST(Evaluator, SumOfAForLoop) {
  RunResult r = runText(
      "function @f { in n: int; result int }\n"
      "body @f { var i: int\n for i = 1 to n by 1 { result = add int result, i } }\n",
      {10});
  EXPECT_EQ(r.trouble, "");
  EXPECT_EQ(r.value.asSigned(), 55);
}

TEST(Evaluator, FaultsStopAndTryCatches) {
  EXPECT_EQ(runText("function @f faults { in n: int; result int }\nbody @f { return div! int 1, n }\n", {0}).fault,
            types::Fault::Div);
  RunResult r = runText(
      "function @f faults { in n: int; result int }\n"
      "body @f { try { result = div! int 1, n } catch result { result = add int result, 10 } }\n",
      {0});
  EXPECT_EQ(r.value.asSigned(), 11);
}

TEST(Evaluator, CallsGiveOutputs) {
  RunResult r = runText(
      "function @two { in a: int; out b: int; result int }\nbody @two { b = add int a, 1\n return mul int a, 2 }\n"
      "function @f { in n: int; result int }\nbody @f { temp t: int\n temp u: int\n %t = call @two(n, %u)\n"
      " return sub int %t, %u }\n",
      {7});
  EXPECT_EQ(r.value.asSigned(), 6);
}

TEST(Evaluator, JumpsFindTheirLabel) {
  RunResult r = runText(
      "function @f { in n: int; result int }\n"
      "body @f {\nlabel again\n result = add int result, n\n n = sub int n, 1\n if gt int n, 0 { jump again } }\n",
      {4});
  EXPECT_EQ(r.value.asSigned(), 10);
}

TEST(Evaluator, EndlessRunsAreReported) {
  EXPECT_NE(runText("function @f { in n: int; result int }\nbody @f { loop { } }\n", {0}).trouble, "");
}

}  // namespace
}  // namespace rung::ir

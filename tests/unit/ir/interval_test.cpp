// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic contains every result of the kernel: all operands of small intervals of SINT, USINT and BYTE.
#include "ir/passes/interval.h"

#include <gtest/gtest.h>

namespace rung::ir {
namespace {

using types::Op;

TEST(Interval, HoldsEveryResultOfTheKernel) {
  Names names;
  types::TypeTable types(names, 8);
  const std::vector<Interval> signed_ones = {{-128, -128}, {-128, 127}, {-3, 2},  {0, 0},
                                             {1, 5},       {100, 127},  {-7, -2}, {0, 9}};
  const std::vector<Interval> unsigned_ones = {{0, 255}, {0, 0}, {1, 1}, {3, 9}, {250, 255}};
  for (TypeId type : {types::kSInt, types::kUSInt, types::kByte}) {
    const Interval all = intervalOf(types, type, true);
    const auto& intervals = type == types::kSInt ? signed_ones : unsigned_ones;
    for (int number = 0; number <= static_cast<int>(Op::Abs); ++number) {
      const Op op = static_cast<Op>(number);
      for (const Interval& a : intervals) {
        for (const Interval& b : intervals) {
          const IntervalResult result = apply(op, a, b, all);
          for (Int128 x = a.low; x <= a.high; ++x) {
            for (Int128 y = b.low; y <= b.high; ++y) {
              const bool negative_shift = op >= Op::Shl && op <= Op::Ror && y < 0;
              if (negative_shift) continue;
              const types::Outcome outcome =
                  types::apply(types, names, op, {type, static_cast<uint64_t>(x)}, {type, static_cast<uint64_t>(y)});
              const Int128 value = types::isComparison(op) || type != types::kSInt ? Int128{outcome.value.bits}
                                                                                   : Int128{outcome.value.asSigned()};
              ASSERT_TRUE(result.interval.contains(value))
                  << types::word(op) << " " << static_cast<int>(x) << " " << static_cast<int>(y);
              if (result.fits && outcome.overflow)
                FAIL() << types::word(op) << " overflows: " << static_cast<int>(x) << " " << static_cast<int>(y);
            }
          }
        }
      }
    }
  }
}

// The result of a comparison is a BOOL, whatever its operands: nothing to check.
TEST(Interval, ComparisonsFit) {
  for (const Op op : {Op::Eq, Op::Ne, Op::Lt, Op::Le, Op::Gt, Op::Ge}) {
    const IntervalResult result = apply(op, {-3, 900}, {5, 7}, {-128, 127});
    EXPECT_TRUE(result.fits);
    EXPECT_EQ(result.interval, (Interval{0, 1}));
  }
}

TEST(Interval, BoundsOfTypes) {
  Names names;
  types::TypeTable types(names, 8);
  EXPECT_EQ(intervalOf(types, types::kInt, true), (Interval{-32768, 32767}));
  EXPECT_TRUE(intervalOf(types, types::kULInt, true).high == (Int128{1} << 64) - 1);
  const TypeId percent = types.addSubrange(names.intern("Percent"), types::kInt, 0, 100);
  EXPECT_EQ(intervalOf(types, percent, true), (Interval{0, 100}));
  EXPECT_EQ(intervalOf(types, percent, false), (Interval{-32768, 32767}));
  EXPECT_FALSE(hasInterval(types, types::kReal));
}

TEST(Interval, SixtyFourBitsDoNotWrap) {
  const Interval ulint{0, (Int128{1} << 64) - 1};
  EXPECT_FALSE(apply(Op::Add, ulint, {1, 1}, ulint).fits);
  EXPECT_FALSE(apply(Op::Mul, ulint, ulint, ulint).fits);
  EXPECT_EQ(apply(Op::Mod, ulint, {8, 8}, ulint).interval, (Interval{0, 7}));
}

}  // namespace
}  // namespace rung::ir

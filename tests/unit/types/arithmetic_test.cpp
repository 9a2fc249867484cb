// SPDX-License-Identifier: Apache-2.0
// The arithmetic kernel: docs/language.md, Arithmetic and faults; expected values computed by hand.
#include "sema/types/arithmetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rung::types {
namespace {

struct Arithmetic : testing::Test {
  Names names;
  TypeTable table{names, 8};
  static Value of(TypeId type, int64_t value) { return {type, static_cast<uint64_t>(value)}; }
  int64_t run(Op op, TypeId type, int64_t a, int64_t b = 0) {
    return apply(table, names, op, of(type, a), of(type, b)).value.asSigned();
  }
};

TEST_F(Arithmetic, integers_wrap_at_their_own_width) {
  EXPECT_EQ(run(Op::Add, kInt, 32767, 1), -32768);
  EXPECT_EQ(run(Op::Mul, kUSInt, 16, 17), 16);
  EXPECT_EQ(run(Op::Sub, kUDInt, 0, 1), 0xffffffff);
  EXPECT_EQ(run(Op::Neg, kSInt, -128), -128);
  EXPECT_EQ(run(Op::Abs, kInt, -32768), -32768);
  EXPECT_TRUE(apply(table, names, Op::Add, of(kInt, 32767), of(kInt, 1)).overflow);
  EXPECT_TRUE(apply(table, names, Op::Mul, of(kULInt, -1), of(kULInt, 2)).overflow);
  EXPECT_FALSE(apply(table, names, Op::Add, of(kInt, 1), of(kInt, 1)).overflow);
}

TEST_F(Arithmetic, division) {
  EXPECT_EQ(run(Op::Div, kDInt, -2147483648LL, -1), -2147483648LL);
  EXPECT_EQ(run(Op::Div, kLInt, std::numeric_limits<int64_t>::min(), -1), std::numeric_limits<int64_t>::min());
  EXPECT_EQ(run(Op::Mod, kInt, -7, 3), -1);
  EXPECT_EQ(run(Op::Mod, kInt, 7, -3), 1);
  const Outcome by_zero = apply(table, names, Op::Div, of(kInt, 7), of(kInt, 0));
  EXPECT_EQ(by_zero.fault, Fault::Div);
  EXPECT_EQ(by_zero.value.bits, 0u);
}

TEST_F(Arithmetic, shifts_and_rotates) {
  EXPECT_EQ(run(Op::Shl, kByte, 0x81, 1), 0x02);
  EXPECT_EQ(run(Op::Shl, kByte, 1, 8), 0);
  EXPECT_EQ(run(Op::Shr, kInt, -1, 15), 1);  // logical
  EXPECT_EQ(run(Op::Sar, kInt, -32768, 14), -2);
  EXPECT_EQ(run(Op::Sar, kInt, -1, 99), -1);
  EXPECT_EQ(run(Op::Sar, kLInt, std::numeric_limits<int64_t>::min(), 63), -1);
  EXPECT_EQ(run(Op::Sar, kLInt, std::numeric_limits<int64_t>::max(), 64), 0);
  EXPECT_EQ(run(Op::Sar, kByte, 0x80, 7), 1);  // no sign
  EXPECT_EQ(run(Op::Rol, kByte, 0x81, 9), 0x03);
  EXPECT_EQ(run(Op::Ror, kWord, 1, 1), 0x8000);
  EXPECT_EQ(run(Op::Ror, kLWord, 5, 64), 5);
}

TEST_F(Arithmetic, reals_round_to_float_after_each_operation) {
  const Value big = Value::ofReal(kReal, 16777216.0), one = Value::ofReal(kReal, 1.0);
  EXPECT_EQ(apply(table, names, Op::Add, big, one).value.asReal(), 16777216.0);
  EXPECT_EQ(apply(table, names, Op::Power, Value::ofReal(kLReal, 2), of(kInt, -2)).value.asReal(), 0.25);
  EXPECT_TRUE(std::isinf(apply(table, names, Op::Div, one, Value::ofReal(kReal, 0)).value.asReal()));
}

// An LREAL exponent of a REAL base keeps its digits: -1 ** 2147483647.5 has no real value.
TEST_F(Arithmetic, exponents_are_not_cut) {
  const Value power =
      apply(table, names, Op::Power, Value::ofReal(kReal, -1.0), Value::ofReal(kLReal, 2147483647.5)).value;
  EXPECT_TRUE(std::isnan(power.asReal()));
}

TEST_F(Arithmetic, real_to_integer_rounds_half_to_even_and_saturates) {
  const auto toInt = [&](double value) { return convert(table, Value::ofReal(kLReal, value), kInt).value.asSigned(); };
  EXPECT_EQ(toInt(2.5), 2);
  EXPECT_EQ(toInt(-2.5), -2);
  EXPECT_EQ(toInt(1.5), 2);
  EXPECT_EQ(toInt(1e9), 32767);
  EXPECT_EQ(toInt(-1e9), -32768);
  EXPECT_EQ(toInt(std::nan("")), 0);
  EXPECT_EQ(convert(table, Value::ofReal(kLReal, 1e30), kULInt).value.bits, ~uint64_t{0});
  EXPECT_EQ(convert(table, Value::ofReal(kLReal, 1e30), kLInt).value.asSigned(), std::numeric_limits<int64_t>::max());
}

TEST_F(Arithmetic, real_to_integer_rounds_away_from_zero_and_wraps) {
  const auto to = [&](TypeId type, double value) {
    return convert(table, Value::ofReal(kLReal, value), type, Rounding::AwayFromZero);
  };
  EXPECT_EQ(to(kInt, 2.5).value.asSigned(), 3);
  EXPECT_EQ(to(kInt, -2.5).value.asSigned(), -3);
  EXPECT_EQ(to(kInt, 0.49999999999999994).value.asSigned(), 0);
  EXPECT_EQ(to(kUSInt, 300.0).value.bits, 44u);
  EXPECT_TRUE(to(kUSInt, 300.0).overflow);
  EXPECT_EQ(to(kInt, -40000.0).value.asSigned(), 25536);  // 65536 - 40000
  EXPECT_EQ(to(kULInt, 1e20).value.bits, 7'766'279'631'452'241'920u);
  EXPECT_EQ(to(kULInt, -1.0).value.bits, ~uint64_t{0});
  EXPECT_EQ(to(kLInt, -0x1p63).value.asSigned(), std::numeric_limits<int64_t>::min());
  EXPECT_FALSE(to(kLInt, -0x1p63).overflow);
  EXPECT_EQ(to(kLInt, std::numeric_limits<double>::infinity()).value.bits, 0u);
  EXPECT_EQ(to(kInt, std::nan("")).value.asSigned(), 0);
}

TEST_F(Arithmetic, conversions) {
  EXPECT_EQ(convert(table, of(kInt, -1), kUSInt).value.bits, 255u);
  EXPECT_TRUE(convert(table, of(kDInt, 70000), kInt).overflow);
  EXPECT_EQ(convert(table, of(kTime, 1500), kLTime).value.bits, 1'500'000'000u);
  EXPECT_EQ(convert(table, of(kLTime, 1'500'000'000), kTime).value.bits, 1500u);
  const TypeId dt = idOf(TypeKind::DateTime);
  EXPECT_EQ(convert(table, of(dt, 86400 * 3 + 61), idOf(TypeKind::TimeOfDay)).value.bits, 61000u);
  EXPECT_EQ(convert(table, of(dt, 86400 * 3 + 61), idOf(TypeKind::Date)).value.bits, 86400u * 3);
  const TypeId level = table.addSubrange(names.intern("Level"), kInt, -10, 100);
  EXPECT_EQ(convert(table, of(kInt, 300), level).value.asSigned(), 100);
  EXPECT_EQ(convert(table, of(kInt, -300), level).value.asSigned(), -10);
  EXPECT_EQ(defaultValue(table, names, level).asSigned(), -10);
}

TEST_F(Arithmetic, strings_compare_by_code) {
  const auto text = [&](const char* t) { return Value{table.string(10), names.intern(t).index}; };
  EXPECT_EQ(apply(table, names, Op::Gt, text("Z"), text("AZ")).value.bits, 1u);
  EXPECT_EQ(apply(table, names, Op::Lt, text("ABC"), text("AZ")).value.bits, 1u);
  EXPECT_EQ(apply(table, names, Op::Eq, text("a"), text("A")).value.bits, 0u);
}

TEST_F(Arithmetic, lossless_conversions) {
  EXPECT_TRUE(isLossless(table, kInt, kDInt));
  EXPECT_TRUE(isLossless(table, kUSInt, kInt));
  EXPECT_TRUE(isLossless(table, kInt, kReal));
  EXPECT_FALSE(isLossless(table, kDInt, kReal));
  EXPECT_FALSE(isLossless(table, kUInt, kInt));
  EXPECT_TRUE(isLossless(table, kReal, kLReal));
  EXPECT_FALSE(isLossless(table, kBool, kInt));
}

}  // namespace
}  // namespace rung::types

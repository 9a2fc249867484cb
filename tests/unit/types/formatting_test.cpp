// SPDX-License-Identifier: Apache-2.0
// Types and values as messages and traces print them.
#include <gtest/gtest.h>

#include <limits>

#include "sema/types/arithmetic.h"

namespace rung::types {
namespace {

struct Formatting : testing::Test {
  Names names;
  TypeTable table{names, 8};
  std::string of(TypeKind kind, uint64_t bits) { return toString(table, names, {idOf(kind), bits}); }
  std::string ofReal(TypeKind kind, double value) { return toString(table, names, Value::ofReal(idOf(kind), value)); }
};

TEST_F(Formatting, types) {
  const Dimension bounds[] = {{1, 10}, {-1, 3}};
  EXPECT_EQ(table.toString(table.string(20)), "STRING[20]");
  EXPECT_EQ(table.toString(idOf(TypeKind::String)), "STRING");
  EXPECT_EQ(table.toString(table.array(kReal, bounds)), "ARRAY[1..10, -1..3] OF REAL");
  EXPECT_EQ(table.toString(table.pointer(kInt)), "POINTER TO INT");
}

TEST_F(Formatting, numbers) {
  EXPECT_EQ(of(TypeKind::Bool, 1), "TRUE");
  EXPECT_EQ(of(TypeKind::Int, static_cast<uint64_t>(-5)), "-5");
  EXPECT_EQ(of(TypeKind::ULInt, ~uint64_t{0}), "18446744073709551615");
  EXPECT_EQ(ofReal(TypeKind::Real, 0.1f), "0.1");
  EXPECT_EQ(ofReal(TypeKind::LReal, 3), "3.0");
  EXPECT_EQ(ofReal(TypeKind::LReal, -std::numeric_limits<double>::infinity()), "-Inf");
  EXPECT_EQ(ofReal(TypeKind::LReal, std::numeric_limits<double>::quiet_NaN()), "NaN");
}

TEST_F(Formatting, times_and_dates) {
  EXPECT_EQ(of(TypeKind::Time, 1500), "T#1s500ms");
  EXPECT_EQ(of(TypeKind::Time, 0), "T#0ms");
  table.time_is_signed = true;
  EXPECT_EQ(of(TypeKind::Time, static_cast<uint64_t>(-5000)), "T#-5s");
  EXPECT_EQ(of(TypeKind::LTime, 1'000'002), "LTIME#1ms2ns");
  EXPECT_EQ(of(TypeKind::Date, 1795219200), "D#2026-11-21");
  EXPECT_EQ(of(TypeKind::TimeOfDay, 45'000'000), "TOD#12:30:00");
  EXPECT_EQ(of(TypeKind::DateTime, 1795219200 + 45000), "DT#2026-11-21-12:30:00");
}

TEST_F(Formatting, strings_and_items) {
  EXPECT_EQ(of(TypeKind::String, names.intern("a'$\n\x01").index), "'a$'$$$L$01'");
  EXPECT_EQ(of(TypeKind::WString, names.intern("a\"'").index), "\"a$\"'\"");
  const TypeId color = table.addEnum(names.intern("Color"), kInt);
  table.edit(color).items = {{names.intern("Red"), 0}, {names.intern("Green"), 5}};
  EXPECT_EQ(toString(table, names, {color, 5}), "Green");
  EXPECT_EQ(toString(table, names, {color, 7}), "7");
}

}  // namespace
}  // namespace rung::types

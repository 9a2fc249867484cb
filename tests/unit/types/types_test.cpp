// SPDX-License-Identifier: Apache-2.0
// Interning, names of elementary types and the tree of generic types.
#include "sema/types/types.h"

#include <gtest/gtest.h>

namespace rung::types {
namespace {

TEST(Types, structural_types_are_interned) {
  Names names;
  TypeTable table(names, 8);
  const Dimension one_to_ten[] = {{1, 10}};
  const Dimension zero_to_nine[] = {{0, 9}};
  EXPECT_EQ(table.array(kInt, one_to_ten), table.array(kInt, one_to_ten));
  EXPECT_NE(table.array(kInt, one_to_ten), table.array(kInt, zero_to_nine));
  EXPECT_NE(table.array(kInt, one_to_ten), table.array(kUInt, one_to_ten));
  EXPECT_EQ(table.pointer(kInt), table.pointer(kInt));
  EXPECT_NE(table.pointer(kInt), table.reference(kInt));
  EXPECT_EQ(table.string(20), table.string(20));
  EXPECT_EQ(table.string(80), idOf(TypeKind::String));
}

TEST(Types, elementary_names_in_any_case) {
  Names names;
  TypeTable table(names, 8);
  EXPECT_EQ(table.elementary(names.intern("int")), kInt);
  EXPECT_EQ(table.elementary(names.intern("Tod")), idOf(TypeKind::TimeOfDay));
  EXPECT_EQ(table.elementary(names.intern("TIME_OF_DAY")), idOf(TypeKind::TimeOfDay));
  EXPECT_EQ(table.elementary(names.intern("ANY_NUM")), idOf(TypeKind::AnyNum));
  EXPECT_FALSE(table.elementary(names.intern("motor")));
}

TEST(Types, generic_types_hold_what_the_standard_says) {
  EXPECT_TRUE(TypeTable::belongsTo(TypeKind::Time, TypeKind::AnyMagnitude));
  EXPECT_FALSE(TypeTable::belongsTo(TypeKind::Time, TypeKind::AnyNum));
  EXPECT_TRUE(TypeTable::belongsTo(TypeKind::Bool, TypeKind::AnyBit));
  EXPECT_FALSE(TypeTable::belongsTo(TypeKind::Bool, TypeKind::AnyInt));
  EXPECT_TRUE(TypeTable::belongsTo(TypeKind::WString, TypeKind::AnyString));
}

TEST(Types, plain_goes_through_aliases_enumerations_and_subranges) {
  Names names;
  TypeTable table(names, 8);
  const TypeId range = table.addSubrange(names.intern("Level"), kInt, 0, 100);
  const TypeId alias = table.addAlias(names.intern("Tank"), range);
  EXPECT_EQ(table.resolve(alias), range);
  EXPECT_EQ(table.plain(alias), kInt);
}

}  // namespace
}  // namespace rung::types

// SPDX-License-Identifier: Apache-2.0
// Sizes, alignments and offsets: docs/language.md, Types and memory.
#include <gtest/gtest.h>

#include "sema/types/types.h"

namespace rung::types {
namespace {

TEST(Layout, natural_alignment_and_padding) {
  Names names;
  TypeTable table(names, 8);
  const TypeId id = table.addRecord(RecordKind::Struct, names.intern("Mix"));
  for (const TypeId type : {kBool, kLReal, kInt, table.string(5), kTime}) {
    Field field;
    field.name = names.intern("f");
    field.type = type;
    table.edit(id).fields.push_back(field);
  }
  ASSERT_TRUE(table.layout(id));
  const TypeInfo& info = table.info(id);
  EXPECT_EQ(info.fields[1].offset, 8u);
  EXPECT_EQ(info.fields[2].offset, 16u);
  EXPECT_EQ(info.fields[3].offset, 18u);  // STRING[5]: 6 bytes
  EXPECT_EQ(info.fields[4].offset, 24u);
  EXPECT_EQ(info.size, 32u);
  EXPECT_EQ(info.align, 8u);
}

TEST(Layout, pointers_have_the_size_of_the_target) {
  Names names;
  TypeTable table(names, 4);
  const TypeId id = table.addRecord(RecordKind::FunctionBlock, names.intern("Block"));
  Field in_out;
  in_out.type = kLReal;
  in_out.by_reference = true;
  table.edit(id).fields.push_back(in_out);
  ASSERT_TRUE(table.layout(id));
  EXPECT_EQ(table.info(id).size, 4u);
}

TEST(Layout, a_union_is_as_large_as_its_largest_member) {
  Names names;
  TypeTable table(names, 8);
  const TypeId id = table.addRecord(RecordKind::Union, names.intern("Either"));
  const Dimension five[] = {{0, 4}};
  for (const TypeId type : {kDInt, table.array(kByte, five)}) {
    Field field;
    field.type = type;
    table.edit(id).fields.push_back(field);
  }
  ASSERT_TRUE(table.layout(id));
  EXPECT_EQ(table.info(id).fields[1].offset, 0u);
  EXPECT_EQ(table.info(id).size, 8u);
}

TEST(Layout, an_empty_record_takes_one_byte) {
  Names names;
  TypeTable table(names, 8);
  const TypeId id = table.addRecord(RecordKind::FunctionBlock, names.intern("Nothing"));
  ASSERT_TRUE(table.layout(id));
  EXPECT_EQ(table.info(id).size, 1u);
}

TEST(Layout, what_does_not_fit_is_refused) {
  Names names;
  TypeTable table(names, 8);
  const Dimension huge[] = {{0, 0x7fffffff}, {0, 0x7fffffff}, {0, 0x7fffffff}};
  EXPECT_FALSE(table.layout(table.array(kLInt, huge)));
}

}  // namespace
}  // namespace rung::types

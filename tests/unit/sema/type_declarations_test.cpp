// SPDX-License-Identifier: Apache-2.0
// Types as declared: aliases, enumerations, subranges, arrays, strings, structures; cycles and bounds.
#include <gtest/gtest.h>

#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

TEST(TypeDeclarations, arrays_and_strings_with_constant_bounds) {
  const Checked checked(
      "VAR_GLOBAL CONSTANT n : INT := 2 * m; m : INT := 5; END_VAR\n"
      "PROGRAM p VAR a : ARRAY[1..n, -1..1] OF REAL; s : STRING[n + 1]; w : WSTRING(m); d : STRING; END_VAR "
      "END_PROGRAM");
  EXPECT_EQ(checked.codes(), "");
  EXPECT_EQ(checked.typeOf("a"), "ARRAY[1..10, -1..1] OF REAL");
  EXPECT_EQ(checked.typeOf("s"), "STRING[11]");
  EXPECT_EQ(checked.typeOf("w"), "WSTRING[5]");
  EXPECT_EQ(checked.typeOf("d"), "STRING");
}

TEST(TypeDeclarations, bounds_must_be_constant_and_in_order) {
  const Checked checked(
      "PROGRAM p VAR n : INT;\n"
      "a : ARRAY[10..1] OF INT;\n"
      "b : ARRAY[1..n] OF INT;\n"
      "c : ARRAY[1..2.5] OF INT;\n"
      "s : STRING[-1];\n"
      "END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0306@2 E0322@3 E0336@4 E0310@5");
}

TEST(TypeDeclarations, enumerations_count_from_the_item_before) {
  const Checked checked(
      "TYPE Color : (red, green := 5, blue) USINT := blue; END_TYPE\n"
      "PROGRAM p VAR c : Color; s : (idle, busy); END_VAR c := blue; s := busy; END_PROGRAM");
  EXPECT_EQ(checked.codes(), "");
  ASSERT_EQ(checked.project.enum_values.size(), 6u);
  EXPECT_EQ(checked.project.enum_values[1].value, 0);
  EXPECT_EQ(checked.project.enum_values[3].value, 6);
  const TypeId color = checked.var("c").type;
  EXPECT_EQ(checked.project.types.info(color).size, 1u);
  ASSERT_LT(color.index, checked.project.type_inits.size());
  EXPECT_TRUE(checked.project.type_inits[color.index]);
}

TEST(TypeDeclarations, values_must_fit_the_base) {
  const Checked checked(
      "TYPE\n"
      "a : (x := 300) USINT;\n"
      "b : SINT (0..200);\n"
      "c : REAL (0..1);\n"
      "d : INT (5..1);\n"
      "END_TYPE");
  EXPECT_EQ(checked.codes(), "E0309@2 E0309@3 E0308@4 E0307@5");
}

TEST(TypeDeclarations, structures_are_laid_out_in_order) {
  const Checked checked(
      "TYPE Base : STRUCT on : BOOL; END_STRUCT; END_TYPE\n"
      "TYPE More EXTENDS Base : STRUCT y : LREAL; x, z : INT := 3; END_STRUCT; END_TYPE\n"
      "TYPE Either : UNION d : DWORD; b : ARRAY[0..3] OF BYTE; END_UNION; END_TYPE\n"
      "PROGRAM p VAR m : More; e : Either; END_VAR m.z := 1; e.d := 2; END_PROGRAM");
  EXPECT_EQ(checked.codes(), "");
  const types::TypeInfo& more = checked.project.types.info(checked.var("m").type);
  ASSERT_EQ(more.fields.size(), 4u);
  EXPECT_EQ(more.fields[1].offset, 8u);
  EXPECT_EQ(more.size, 24u);
  const auto& inits = checked.project.field_inits[checked.var("m").type.index];
  ASSERT_EQ(inits.size(), 4u);
  EXPECT_TRUE(inits[2]);
  EXPECT_EQ(checked.project.types.info(checked.var("e").type).size, 4u);
}

TEST(TypeDeclarations, what_contains_itself_is_named_and_cut) {
  const Checked checked(
      "FUNCTION_BLOCK a VAR x : b; END_VAR END_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK b VAR y : ARRAY[1..2] OF a; END_VAR END_FUNCTION_BLOCK\n"
      "TYPE Link : STRUCT next : POINTER TO Link; END_STRUCT; END_TYPE\n");
  EXPECT_EQ(checked.codes(), "E0303@2");
  EXPECT_NE(checked.messages().find("`a` contains `b` contains `a`"), std::string::npos);
}

TEST(TypeDeclarations, an_alias_of_itself) {
  const Checked checked("TYPE a : b; b : c; c : a; END_TYPE\nPROGRAM p VAR x : a; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0304@1");
}

TEST(TypeDeclarations, too_large) {
  const Checked checked("PROGRAM p VAR a : ARRAY[0..2000000000] OF LREAL; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0311@1");
}

}  // namespace
}  // namespace rung::sema

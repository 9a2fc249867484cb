// SPDX-License-Identifier: Apache-2.0
// Initial values: lists, repetitions, surplus, members, instances, constants.
#include <gtest/gtest.h>

#include "frontend/source/dialect.h"
#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

TEST(InitialValues, arrays_are_filled_in_row_major_order) {
  const Checked checked(
      "PROGRAM p VAR\n"
      "a : ARRAY[1..2, 1..3] OF INT := [1, 2, 3(4), 6];\n"
      "b : ARRAY[1..4] OF INT := [2(1, 2, 3)];\n"
      "c : ARRAY[1..3] OF INT := [1];\n"
      "d : ARRAY[1..8] OF BOOL := [1, 1, 0, FALSE, 4(TRUE)];\n"
      "e : ARRAY[1..2] OF ARRAY[1..2] OF INT := [[1, 2], [3, 4]];\n"
      "f : ARRAY[1..2] OF INT := [1, 2, 3];\n"
      "g : ARRAY[1..2] OF INT := 1;\n"
      "h : INT := [1];\n"
      "END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "W0366@3 W0366@7 E0326@8 E0328@9");
  const ArrayInitExpr& cut = checked.tree.as<ArrayInitExpr>(checked.var("f").init);
  EXPECT_EQ(cut.elements.count, 2u);
}

TEST(InitialValues, structures_and_instances) {
  const Checked checked(
      "TYPE Person : STRUCT age : INT; name : STRING; END_STRUCT; END_TYPE\n"
      "FUNCTION_BLOCK Loop VAR_INPUT band : REAL; END_VAR VAR_IN_OUT x : REAL; END_VAR END_FUNCTION_BLOCK\n"
      "PROGRAM p VAR\n"
      "a : Person := (age := 18, name := 'Whoami');\n"
      "l : Loop := (band := 2.5);\n"
      "b : Person := (agee := 18);\n"
      "c : Person := (age := 1, AGE := 2);\n"
      "d : Person := 5;\n"
      "e : Loop := (x := 1.0);\n"
      "f : ARRAY[1..2] OF Person := [(age := 1), (age := 2)];\n"
      "END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0329@6 E0330@7 E0327@8 E0331@9");
  EXPECT_NE(checked.messages().find("`age`"), std::string::npos);
}

TEST(InitialValues, of_a_block_read_its_own_variables_in_codesys) {
  const Checked checked("PROGRAM p VAR a : INT := 5; c : INT := a; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "");
}

TEST(InitialValues, must_be_constant_in_blocks) {
  Options iec;
  iec.dialect = Dialect::Iec3;
  const Checked checked(
      "PROGRAM p VAR\n"
      "a : INT := 5; b : INT := 2 * 3;\n"
      "c : INT := a;\n"
      "END_VAR END_PROGRAM\n"
      "FUNCTION f : INT VAR_INPUT x : INT; END_VAR VAR y : INT := 2; END_VAR f := x + y; END_FUNCTION",
      iec);
  EXPECT_EQ(checked.codes(), "E0325@3");
}

TEST(InitialValues, of_a_list_of_variables_is_checked_once) {
  const Checked checked("PROGRAM p VAR a, b, c : INT := 'text'; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.diagnostics.errorCount(), 1u) << checked.messages();
}

}  // namespace
}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Names: duplicates, libraries of names in any order, the nearest name.
#include <gtest/gtest.h>

#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

TEST(DeclaredNames, order_of_files_and_declarations_does_not_matter) {
  const Checked checked(
      {{"a.st", "PROGRAM Main VAR m : Motor; l : Level; END_VAR END_PROGRAM"},
       {"b.st", "TYPE Level : INT (0..limit); END_TYPE VAR_GLOBAL CONSTANT limit : INT := 100; END_VAR"},
       {"c.st", "FUNCTION_BLOCK Motor VAR_INPUT on : BOOL; END_VAR END_FUNCTION_BLOCK"}});
  EXPECT_EQ(checked.codes(), "");
  EXPECT_EQ(checked.typeOf("m"), "Motor");
  EXPECT_EQ(checked.typeOf("l"), "Level");
}

TEST(DeclaredNames, a_second_declaration_is_one_error_with_a_note) {
  const Checked checked(
      "FUNCTION f : INT f := 1; END_FUNCTION\n"
      "FUNCTION_BLOCK F END_FUNCTION_BLOCK\n"
      "PROGRAM Main VAR a : INT; b, A : BOOL; END_VAR END_PROGRAM\n"
      "TYPE c : (x, y, X); END_TYPE\n");
  EXPECT_EQ(checked.codes(), "E0301@2 E0301@3 E0301@4");
  EXPECT_NE(checked.messages().find("also declared here"), std::string::npos);
}

TEST(DeclaredNames, unknown_types_name_the_nearest) {
  const Checked checked(
      "FUNCTION_BLOCK Motor END_FUNCTION_BLOCK\nPROGRAM p VAR m : Moter; d : DITN; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0402@2 E0402@2");
  EXPECT_NE(checked.messages().find("`Motor`"), std::string::npos);
  EXPECT_NE(checked.messages().find("`DINT`"), std::string::npos);
}

TEST(DeclaredNames, a_variable_may_hide_a_block) {
  const Checked checked(
      "FUNCTION_BLOCK delay VAR_OUTPUT q : BOOL; END_VAR END_FUNCTION_BLOCK\n"
      "PROGRAM p VAR delay : INT; x : INT; END_VAR x := delay; END_PROGRAM");
  EXPECT_EQ(checked.codes(), "");
}

TEST(DeclaredNames, a_function_is_no_type) {
  const Checked checked("FUNCTION f : INT f := 1; END_FUNCTION\nPROGRAM p VAR x : f; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0312@2");
}

}  // namespace
}  // namespace rung::sema

// SPDX-License-Identifier: Apache-2.0
// Variables: storage, constants, externals, located variables, edges.
#include <gtest/gtest.h>

#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

TEST(Variables, storage_follows_section_and_pou) {
  const Checked checked(
      "FUNCTION_BLOCK b\n"
      "VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR VAR_IN_OUT io : INT; END_VAR VAR l : INT; END_VAR\n"
      "VAR_TEMP t : INT; END_VAR VAR CONSTANT c : INT := 4; END_VAR VAR at1 AT %MW2 : INT; END_VAR\n"
      "END_FUNCTION_BLOCK\n"
      "FUNCTION f : INT VAR_INPUT x : INT; END_VAR VAR y : INT; END_VAR f := x; END_FUNCTION");
  EXPECT_EQ(checked.codes(), "");
  const types::TypeInfo& record = checked.project.types.info(checked.pou("b").record);
  ASSERT_EQ(record.fields.size(), 5u);
  EXPECT_TRUE(record.fields[2].by_reference);
  EXPECT_EQ(record.fields[0].role, types::FieldRole::Input);
  EXPECT_EQ(checked.var("c").field, 4u);
  EXPECT_EQ(checked.valueOf("c"), "4");
  EXPECT_EQ(checked.var("t").storage, Storage::Local);
  EXPECT_EQ(checked.var("at1").storage, Storage::Image);
  EXPECT_EQ(checked.var("at1").image.byte, 4u);
  EXPECT_EQ(checked.var("y").storage, Storage::Local);
  EXPECT_EQ(checked.var("y").field, 1u);
  EXPECT_TRUE(checked.pou("f").result_var);
}

TEST(Variables, constants_refer_to_each_other_in_any_order) {
  const Checked checked(
      "VAR_GLOBAL CONSTANT a : INT := b + 1; b : INT := c * 2; c : INT := 20; d : REAL := 1.5; e : STRING := 'x'; "
      "END_VAR\n"
      "VAR_GLOBAL CONSTANT t : TIME := T#1s500ms; n : INT := -c; END_VAR");
  EXPECT_EQ(checked.codes(), "");
  EXPECT_EQ(checked.valueOf("a"), "41");
  EXPECT_EQ(checked.valueOf("d"), "1.5");
  EXPECT_EQ(checked.valueOf("e"), "'x'");
  EXPECT_EQ(checked.valueOf("t"), "T#1s500ms");
  EXPECT_EQ(checked.valueOf("n"), "-20");
}

TEST(Variables, constants_of_themselves) {
  const Checked checked(
      "VAR_GLOBAL CONSTANT\na : INT := b;\nb : INT := a;\nc : INT;\nd : INT := 1 / (2 - 2);\nEND_VAR");
  EXPECT_EQ(checked.diagnostics.errorCount(), 2u) << checked.messages();
  EXPECT_NE(checked.messages().find("depends on itself"), std::string::npos);
}

TEST(Variables, global_lists_are_named_after_their_file) {
  const Checked checked({{"io/my-list.st", "{attribute 'qualified_only'}\nVAR_GLOBAL x : INT; END_VAR"},
                         {"plain.st", "VAR_GLOBAL RETAIN y : INT; END_VAR"},
                         {"main.st", "PROGRAM p VAR a : INT; END_VAR a := my_list.x + y + plain.y; END_PROGRAM"},
                         {"bad.st", "PROGRAM q VAR b : INT; END_VAR b := x; END_PROGRAM"}});
  EXPECT_EQ(checked.codes(), "E0255@1");
  ASSERT_EQ(checked.project.global_lists.size(), 3u);
  EXPECT_TRUE(checked.project.global_lists[1].qualified_only);
  EXPECT_TRUE(checked.project.types.info(checked.project.global_lists[2].record).fields[0].retain);
}

TEST(Variables, externals_are_matched_to_globals) {
  const Checked checked(
      "VAR_GLOBAL level : REAL; END_VAR\n"
      "PROGRAM p VAR_EXTERNAL level : REAL; END_VAR level := 1.0; END_PROGRAM\n"
      "PROGRAM q VAR_EXTERNAL level : INT; END_VAR END_PROGRAM\n"
      "PROGRAM r VAR_EXTERNAL levl : REAL; END_VAR END_PROGRAM\n"
      "PROGRAM s VAR_EXTERNAL level : REAL := 2.0; END_VAR END_PROGRAM");
  EXPECT_EQ(checked.codes(), "E0335@3 E0334@4 E0324@5");
  const Var& external = checked.project.var(checked.pou("p").vars[0]);
  EXPECT_TRUE(external.external);
  EXPECT_EQ(external.storage, Storage::Global);
}

TEST(Variables, addresses) {
  const Checked checked(
      "VAR_GLOBAL\n"
      "a AT %ID48 : DWORD; b AT %IX5 : BOOL; c AT %QX5.1 : BOOL; d AT %MB7 : BOOL; e AT %IL24 : LWORD;\n"
      "f AT %IW100 : ARRAY[1..4] OF REAL; AT %QW6 : INT := 8;\n"
      "g AT %QX5.9 : BOOL;\n"
      "h AT %QX5.1 : INT;\n"
      "i AT %I* : BOOL;\n"
      "j AT %IW1.2 : INT;\n"
      "END_VAR");
  EXPECT_EQ(checked.codes(), "E0340@4 E0341@5 W0367@7");
  EXPECT_EQ(checked.var("a").image.byte, 192u);
  EXPECT_EQ(checked.var("b").image.byte, 0u);
  EXPECT_EQ(checked.var("b").image.bit, 5u);
  EXPECT_EQ(checked.var("c").image.byte, 5u);
  EXPECT_EQ(checked.var("c").image.bit, 1u);
  EXPECT_TRUE(checked.var("d").image.is_bit);
  EXPECT_EQ(checked.var("e").image.byte, 192u);
  EXPECT_EQ(checked.var("i").image.byte, 216u);  // allocated after all others
  EXPECT_EQ(checked.var("j").image.byte, 218u);  // and this one after them, aligned
  EXPECT_EQ(checked.project.area_bytes[0], 220u);
}

TEST(Variables, edge_inputs_have_a_memory) {
  const Checked checked(
      "FUNCTION_BLOCK b VAR_INPUT clk : BOOL R_EDGE; END_VAR END_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK c VAR_INPUT clk : INT F_EDGE; END_VAR END_FUNCTION_BLOCK");
  EXPECT_EQ(checked.codes(), "E0333@2");
  const Var& clk = checked.var("clk");
  ASSERT_TRUE(clk.memory.edge);
  EXPECT_EQ(checked.project.var(clk.memory.edge).field, 1u);
}

TEST(Variables, elementary_types_name_nothing_else) {
  const Checked checked("PROGRAM p VAR a : INT; END_VAR END_PROGRAM\nVAR_GLOBAL b : INT; END_VAR");
  EXPECT_EQ(checked.codes(), "");
}

}  // namespace
}  // namespace rung::sema

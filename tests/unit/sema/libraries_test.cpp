// SPDX-License-Identifier: Apache-2.0
// Libraries: the index, reading on first use, namespaces, generic functions.
#include "sema/declarations/libraries.h"

#include <gtest/gtest.h>

#include "tests/unit/sema/checked.h"

namespace rung::sema {
namespace {

constexpr const char* kLibrary =
    "/// (* a comment *) 'with' FUNCTION words\n"
    "{pure} FUNCTION LIMIT : ANY_ELEMENTARY\n"
    "VAR_INPUT MN, IN, MX : ANY_ELEMENTARY; END_VAR\n"
    "IF IN < MN THEN LIMIT := MN; ELSIF IN > MX THEN LIMIT := MX; ELSE LIMIT := IN; END_IF\n"
    "END_FUNCTION\n"
    "TYPE Mode : (off := 0, slow := 1, quick := 2); Pair : STRUCT a, b : INT; END_STRUCT; END_TYPE\n"
    "VAR_GLOBAL CONSTANT DEFAULT_LIMIT : INT := 7; END_VAR\n"
    "FUNCTION_BLOCK CTU\n"
    "VAR_INPUT CU : BOOL R_EDGE; {alias 'R'} RESET : BOOL; PV : INT := DEFAULT_LIMIT; END_VAR\n"
    "VAR_OUTPUT Q : BOOL; CV : INT; END_VAR\n"
    "CV := LIMIT(0, CV, PV);\n"
    "END_FUNCTION_BLOCK\n"
    "{std 'iec2 iec3'} FUNCTION only_iec : INT only_iec := 1; END_FUNCTION\n"
    "FUNCTION_BLOCK broken_and_unused VAR x : no_such_type; END_VAR END_FUNCTION_BLOCK\n";

Options withLibrary() {
  static const LibraryFile files[] = {{"Standard", "standard/all.st", kLibrary}};
  Options options;
  options.libraries = files;
  return options;
}

TEST(Libraries, the_index_names_what_is_declared) {
  const std::vector<IndexedBlock> blocks = indexLibrary(kLibrary);
  ASSERT_EQ(blocks.size(), 6u);
  EXPECT_EQ(blocks[0].names, std::vector<std::string_view>({"LIMIT"}));
  EXPECT_EQ(std::string_view(kLibrary).substr(blocks[0].begin, 6), "{pure}");
  EXPECT_EQ(blocks[1].names, std::vector<std::string_view>({"Mode", "off", "slow", "quick", "Pair"}));
  EXPECT_EQ(blocks[2].names, std::vector<std::string_view>({"DEFAULT_LIMIT"}));
  EXPECT_EQ(blocks[4].standards, 3u);
  EXPECT_EQ(std::string_view(kLibrary).substr(blocks[3].end - 18, 18), "END_FUNCTION_BLOCK");
}

TEST(Libraries, declarations_are_read_on_first_use) {
  const Checked checked("PROGRAM p VAR c : CTU; d : Standard.CTU; END_VAR c(CU := TRUE, R := FALSE); END_PROGRAM",
                        withLibrary());
  EXPECT_EQ(checked.codes(), "") << checked.messages();
  EXPECT_EQ(checked.typeOf("d"), "CTU");
  EXPECT_TRUE(checked.pou("CTU").library);
  EXPECT_FALSE(checked.pou("broken_and_unused").name);
  EXPECT_FALSE(checked.pou("only_iec").name);
  EXPECT_EQ(checked.valueOf("DEFAULT_LIMIT"), "7");
}

TEST(Libraries, generic_functions_have_an_instance_for_each_tuple) {
  const Checked checked(
      "PROGRAM p VAR r : REAL; i : INT; END_VAR r := LIMIT(0.0, r, 1.0); i := LIMIT(0, i, 9); i := LIMIT(1, i, 2); "
      "END_PROGRAM",
      withLibrary());
  EXPECT_EQ(checked.codes(), "") << checked.messages();
  EXPECT_TRUE(checked.pou("LIMIT__REAL").progress.checked());
  EXPECT_TRUE(checked.pou("LIMIT__INT").progress.checked());
  EXPECT_FALSE(checked.pou("LIMIT").progress.checked());
  EXPECT_EQ(checked.project.pous.size(), 5u);
}

TEST(Libraries, names_of_the_project_come_first_but_never_inside_a_library) {
  const Checked checked(
      "FUNCTION LIMIT : INT VAR_INPUT a : INT; END_VAR LIMIT := a; END_FUNCTION\n"
      "PROGRAM p VAR c : CTU; i : INT; END_VAR c(); i := LIMIT(3); i := Standard.LIMIT(0, i, 9); END_PROGRAM",
      withLibrary());
  EXPECT_EQ(checked.codes(), "") << checked.messages();
  EXPECT_TRUE(checked.pou("Standard__LIMIT__INT").library);
}

TEST(Libraries, items_and_misspelled_names) {
  const Checked checked("PROGRAM p VAR m : Mode := quick; t : CTUU; END_VAR m := slow; END_PROGRAM", withLibrary());
  EXPECT_EQ(checked.codes(), "E0402@1");
  EXPECT_NE(checked.messages().find("`CTU`"), std::string::npos);
}

}  // namespace
}  // namespace rung::sema

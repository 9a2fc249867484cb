// SPDX-License-Identifier: Apache-2.0
// ST divided into units: what is not closed ends with the source, a string with its line.
#include "frontend/source/scanner.h"

#include <gtest/gtest.h>

namespace rung {
namespace {

// The units, each with the first letter of its kind: `N:a O:+ N:b`.
std::string unitsOf(std::string_view source) {
  static constexpr char kLetters[] = {'E', 'C', 'P', 'S', 'N', '0', 'O'};
  std::string out;
  Scanner scanner(source);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
    out += (out.empty() ? "" : " ") + std::string(1, kLetters[static_cast<size_t>(unit.kind)]) + ":" +
           std::string(scanner.textOf(unit));
  return out;
}

TEST(Scanner, Units) {
  EXPECT_EQ(unitsOf("x1 := 16#ff + 'a$'b';\t// c\r\n"), "N:x1 O:: O:= 0:16 O:# N:ff O:+ S:'a$'b' O:; C:// c");
  EXPECT_EQ(unitsOf("(* a (* b *) c *)/*d*/{e '}'}f"), "C:(* a (* b *) c *) C:/*d*/ P:{e '}'} N:f");
  EXPECT_EQ(unitsOf("\xc3\xa4 y"), "N:\xc3\xa4 N:y");
}

TEST(Scanner, NotClosed) {
  EXPECT_EQ(unitsOf("a (* b"), "N:a C:(* b");
  EXPECT_EQ(unitsOf("a {b"), "N:a P:{b");
  EXPECT_EQ(unitsOf("a 'b\nc"), "N:a S:'b N:c");
  EXPECT_EQ(unitsOf("'$"), "S:'$");
}

TEST(Scanner, CommentsThatDoNotNest) {
  EXPECT_EQ(unitsOf("(* @NESTEDCOMMENTS := 'No' *) (* a (* b *) c"),
            "C:(* @NESTEDCOMMENTS := 'No' *) C:(* a (* b *) N:c");
}

TEST(Scanner, FirstWord) {
  EXPECT_EQ(firstWord("\xef\xbb\xbf (* a (* b *) *) // c\n{d 'e}'} function_block x"), "FUNCTION_BLOCK");
  EXPECT_EQ(firstWord("; PROGRAM"), "");
  EXPECT_EQ(firstWord("(* PROGRAM"), "");
  EXPECT_EQ(firstWord("12 PROGRAM"), "");
}

TEST(Scanner, NamesAndPaths) {
  EXPECT_TRUE(isIdentifier("_a1"));
  EXPECT_FALSE(isIdentifier(""));
  EXPECT_FALSE(isIdentifier("1a"));
  EXPECT_FALSE(isIdentifier("a.b"));
  EXPECT_TRUE(isPath("a.b"));
  EXPECT_FALSE(isPath("a..b"));
  EXPECT_FALSE(isPath("a."));
  EXPECT_FALSE(isPath(""));
}

}  // namespace
}  // namespace rung

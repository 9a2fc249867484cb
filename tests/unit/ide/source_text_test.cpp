// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/source_text.h"

#include <gtest/gtest.h>

namespace rung::ide {
namespace {

std::string docOf(std::string source) {
  const size_t at = source.find('@');
  source.erase(at, 1);
  return documentationAbove(source, at);
}

TEST(Documentation, IsTheCommentDirectlyAbove) {
  EXPECT_EQ(docOf("/// One.\n/// Two.\n  @x"), "One.\nTwo.");
  EXPECT_EQ(docOf("// not this\n/// this\n@x"), "this");
  EXPECT_EQ(docOf("// One.\r\n// Two.\r\n@x"), "One.\nTwo.");
  EXPECT_EQ(docOf("(* One.\n * Two.\n *)\n@x"), "One.\nTwo.");
  EXPECT_EQ(docOf("/* One. */\n@x"), "One.");
  EXPECT_EQ(docOf("y : INT; (* of x *)\n@x"), "of x");
}

TEST(Documentation, IsNotAnythingElse) {
  EXPECT_EQ(docOf("(* above *)\n\n@x"), "");
  EXPECT_EQ(docOf("// above\ny; @x"), "");
  EXPECT_EQ(docOf("@x"), "");
  EXPECT_EQ(docOf("\n@x"), "");
  EXPECT_EQ(docOf("*)\n@x"), "");
}

}  // namespace
}  // namespace rung::ide

// SPDX-License-Identifier: Apache-2.0
#include "tools/lsp/uri.h"

#include <gtest/gtest.h>

namespace rung::lsp {
namespace {

TEST(Uri, NamesFiles) {
  EXPECT_EQ(uriOf("/a b/m\xc3\xbchle#1.st"), "file:///a%20b/m%C3%BChle%231.st");
  EXPECT_EQ(pathOfUri("file:///a%20b/m%C3%BChle%231.st"), "/a b/m\xc3\xbchle#1.st");
  EXPECT_EQ(pathOfUri("file:///a%3ab"), "/a:b");
  EXPECT_EQ(pathOfUri("file://localhost/a"), "/a");
  EXPECT_EQ(pathOfUri("file:///a/../b/./c/"), "/b/c");
}

TEST(Uri, WhatIsNoFileHasNoPath) {
  for (const char* uri : {"", "untitled:1", "file:", "file://", "file://host/a", "http://x/a", "file:///a%00b", "a.st"})
    EXPECT_EQ(pathOfUri(uri), "") << uri;
  EXPECT_EQ(pathOfUri("file:///%zz%"), "/%zz%");
}

}  // namespace
}  // namespace rung::lsp

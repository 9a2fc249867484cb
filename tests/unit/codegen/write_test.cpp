// SPDX-License-Identifier: Apache-2.0
// Output folders: all or nothing, equal files untouched, stale files deleted.
#include "codegen/write.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rung::codegen {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

struct WriteTest : testing::Test {
  WriteTest() : folder((fs::temp_directory_path() / "rung-write-XXXXXX").string()) {
    if (mkdtemp(folder.data()) == nullptr) abort();
  }
  ~WriteTest() override { fs::remove_all(folder); }
  std::string text(const std::string& name) const {
    std::ifstream in(folder + "/" + name);
    std::stringstream out;
    out << in.rdbuf();
    return out.str();
  }
  std::string folder;
};

TEST_F(WriteTest, WritesKeepsAndDeletes) {
  WriteResult first = writeOutputs(folder + "/deep/er", {{"a.cpp", "1"}, {"b b.h", "2"}, {"c.cpp", "3"}});
  EXPECT_EQ(first.error, "");
  EXPECT_EQ(text("deep/er/b b.h"), "2");
  EXPECT_EQ(text("deep/er/rung.manifest"), "a.cpp\nb b.h\nc.cpp\n");
  std::ofstream(folder + "/deep/er/mine.txt") << "kept";

  WriteResult second = writeOutputs(folder + "/deep/er", {{"a.cpp", "1"}, {"b b.h", "22"}});
  EXPECT_EQ(second.kept, Names{"a.cpp"});
  EXPECT_EQ(second.written, (Names{"b b.h", "rung.manifest"}));
  EXPECT_EQ(second.deleted, Names{"c.cpp"});
  EXPECT_EQ(text("deep/er/mine.txt"), "kept");

  WriteResult third = writeOutputs(folder + "/deep/er", {{"a.cpp", "1"}, {"b b.h", "22"}});
  EXPECT_TRUE(third.written.empty());
  EXPECT_TRUE(third.deleted.empty());
}

TEST_F(WriteTest, LeavesNothingWhenOneFileIsRefused) {
  ASSERT_EQ(writeOutputs(folder, {{"a.cpp", "1"}}).error, "");
  fs::create_directory(folder + "/z.cpp");  // in the way of the rename
  fs::create_directory(folder + "/z.cpp/x");
  std::ofstream(folder + "/plain") << "";
  WriteResult result = writeOutputs(folder, {{"a.cpp", "2"}, {"plain/b.cpp", "3"}});
  EXPECT_NE(result.error, "");
  EXPECT_EQ(text("a.cpp"), "1");
  size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    files += entry.path().filename().string().find(".rung-") != std::string::npos;
  EXPECT_EQ(files, 0u);
}

// No name is the folder where the tool runs; a slash at the end names the same folder.
TEST_F(WriteTest, CurrentFolderAndTrailingSlash) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  const WriteResult here = writeOutputs("", {{"a.cpp", "1"}});
  const WriteResult below = writeOutputs("new/", {{"b.cpp", "2"}});
  fs::current_path(before);
  EXPECT_EQ(here.error, "");
  EXPECT_EQ(text("a.cpp"), "1");
  EXPECT_EQ(below.error, "");
  EXPECT_EQ(text("new/b.cpp"), "2");
}

TEST_F(WriteTest, AManifestNamesNothingOutside) {
  std::ofstream(folder + "/outside") << "kept";
  fs::create_directory(folder + "/gen");
  std::ofstream(folder + "/gen/rung.manifest") << "../outside\n/etc/hostname\n";
  EXPECT_EQ(writeOutputs(folder + "/gen", {{"a.cpp", "1"}}).error, "");
  EXPECT_EQ(text("outside"), "kept");
}

TEST(Depfile, EscapesBlanks) {
  EXPECT_EQ(depfile("gen/a b", {"x y.st", "#1$.st"}), "gen/a\\ b: \\\n  x\\ y.st \\\n  \\#1$$.st\n");
}

}  // namespace
}  // namespace rung::codegen

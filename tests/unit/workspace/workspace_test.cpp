// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/workspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "tests/unit/tools/temporary_folder.h"

namespace rung::workspace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBlock = "FUNCTION_BLOCK Ramp\nVAR_OUTPUT y : REAL; END_VAR\ny := y + 1.0;\nEND_FUNCTION_BLOCK\n";
constexpr const char* kMain = "PROGRAM Main\nVAR ramp : Ramp; END_VAR\nramp();\nEND_PROGRAM\n";

driver::ProjectOptions optionsOf(const std::string& folder) {
  driver::ProjectOptions options;
  options.inputs = {folder};
  return options;
}

// `3:1 E0701 message`, one a line.
std::string messagesOf(const Snapshot& snapshot) {
  std::string out;
  for (const Diagnostic& diagnostic : snapshot.diagnostics()) {
    const SourceLocation at = snapshot.sources().location(diagnostic.loc);
    out += std::to_string(at.line) + ":" + std::to_string(at.column) + " " + diagInfo(diagnostic.diag).code + " " +
           diagnostic.message + "\n";
  }
  return out;
}

class WorkspaceTest : public testing::Test {
 protected:
  TemporaryFolder folder;
  const std::string block = folder.write("ramp.st", kBlock), main = folder.write("main.st", kMain);
  Workspace workspace{optionsOf(folder.path())};
};

TEST_F(WorkspaceTest, BuffersLieOverTheDisk) {
  const auto first = workspace.apply({});
  EXPECT_EQ(messagesOf(*first), "");
  EXPECT_EQ(first->exitCode(), 0);

  const auto second = workspace.apply({{main, "PROGRAM Main\nVAR ramp : Rump; END_VAR\nramp();\nEND_PROGRAM\n"}});
  EXPECT_EQ(messagesOf(*second).substr(0, 5), "2:12 ");
  EXPECT_EQ(second->exitCode(), 1);
  EXPECT_EQ(messagesOf(*first), "") << "an old snapshot stays as it was";
  EXPECT_EQ(workspace.current(), second);

  // A declaration in one file counts in the others, although no file on disk has changed.
  const auto third = workspace.apply({{block, std::string("TYPE Rump : REAL; END_TYPE\n") + kBlock}});
  EXPECT_NE(messagesOf(*third), messagesOf(*second));

  const auto closed = workspace.apply({{main, std::nullopt}, {block, std::nullopt}});
  EXPECT_EQ(messagesOf(*closed), "");
}

TEST_F(WorkspaceTest, ACancelledChangeIsInTheNextSnapshot) {
  const auto first = workspace.apply({});
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(workspace.apply({{main, "PROGRAM Main\nEND_PROGRAM\nx"}}, &cancelled), nullptr);
  EXPECT_EQ(workspace.current(), first);
  EXPECT_NE(messagesOf(*workspace.apply({})), "");
}

TEST_F(WorkspaceTest, ASnapshotTellsWhyItHasNothing) {
  Workspace missing(optionsOf(folder.path() + "/no_such_folder"));
  const auto snapshot = missing.apply({});
  EXPECT_EQ(snapshot->exitCode(), 2);
  EXPECT_EQ(snapshot->project(), nullptr);
}

std::string textOf(const std::string& path) { return readFile(path).content; }

// One character that somebody types, deletes or replaces.
void edit(std::string& text, std::mt19937& random) {
  static constexpr std::string_view kTyped = "abx01 ;:=()\n.'";
  const size_t at = random() % (text.size() + 1);
  const char typed = kTyped[random() % kTyped.size()];
  switch (random() % 3) {
    case 0: text.insert(at, 1, typed); break;
    case 1: text.erase(at, 1); break;
    case 2:
      if (at < text.size()) text[at] = typed;
      break;
  }
}

// Copies of the samples, edited at random: a snapshot says what a check of the same files on disk says, and four other
// threads read the snapshots before it meanwhile.
TEST(Workspace, SnapshotsOfRandomEditsEqualACheck) {
  TemporaryFolder folder;
  for (const char* sample : {"conveyor", "traffic_light", "filling_station"})
    fs::copy(std::string(RUNG_SOURCE) + "/samples/" + sample, folder.path() + "/" + sample,
             fs::copy_options::recursive);
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.path().extension() == ".st") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  ASSERT_FALSE(files.empty());

  Workspace workspace(optionsOf(folder.path()));
  std::shared_ptr<const Snapshot> last = workspace.apply({});
  std::map<std::string, std::string> texts;
  for (const std::string& file : files) texts[file] = textOf(file);
  std::mt19937 random(41);
  for (int round = 0; round < 200; ++round) {
    const std::string before = messagesOf(*last);
    std::vector<std::thread> readers;
    for (int reader = 0; reader < 4; ++reader)
      readers.emplace_back([last, &before] { EXPECT_EQ(messagesOf(*last), before); });
    const std::string& file = files[random() % files.size()];
    edit(texts[file], random);
    const auto snapshot = workspace.apply({{file, texts[file]}});
    for (std::thread& reader : readers) reader.join();
    std::ofstream(file, std::ios::binary) << texts[file];
    Workspace cold(optionsOf(folder.path()));
    ASSERT_EQ(messagesOf(*snapshot), messagesOf(*cold.apply({}))) << file << "\n" << texts[file];
    last = snapshot;
  }
}

}  // namespace
}  // namespace rung::workspace

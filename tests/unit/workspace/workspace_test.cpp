// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/workspace.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <initializer_list>
#include <thread>

#include "tests/unit/tools/temporary_folder.h"
#include "tests/unit/workspace/typing.h"

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
  EXPECT_EQ(messagesOf(*second).substr(0, 13), "main.st 2:12 ");
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

TEST_F(WorkspaceTest, ABodyAfterACancelledChangeIsNotTheOnlyOneThatChanges) {
  workspace.apply({});
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(workspace.apply({{main, "PROGRAM Main\nEND_PROGRAM\nx"}, {block, kBlock}}, &cancelled), nullptr);
  const std::string other = "FUNCTION_BLOCK Ramp\nVAR_OUTPUT y : REAL; END_VAR\ny := 2.0;\nEND_FUNCTION_BLOCK\n";
  EXPECT_NE(messagesOf(*workspace.apply({{block, other}})), "");
}

TEST_F(WorkspaceTest, ASnapshotTellsWhyItHasNothing) {
  Workspace missing(optionsOf(folder.path() + "/no_such_folder"));
  const auto snapshot = missing.apply({});
  EXPECT_EQ(snapshot->exitCode(), 2);
  EXPECT_EQ(snapshot->project(), nullptr);
}

// A body alone is checked again, unless somebody reads what it replaces; all else stays, at its new place.
TEST_F(WorkspaceTest, ABodyIsReplaced) {
  const uint64_t revision = workspace.apply({})->revision();
  const std::string longer =
      "FUNCTION_BLOCK Ramp\nVAR_OUTPUT y : REAL; END_VAR\n\n\ny := y + z;\nEND_FUNCTION_BLOCK\n" +
      std::string("FUNCTION Last : INT\nVAR unused : INT; END_VAR\nLast := 1;\nEND_FUNCTION\n");
  const std::string shorter = "FUNCTION_BLOCK Ramp\nVAR_OUTPUT y : REAL; END_VAR\ny := 1.0;\nEND_FUNCTION_BLOCK\n" +
                              std::string("FUNCTION Last : INT\nVAR unused : INT; END_VAR\nLast := 1;\nEND_FUNCTION\n");
  workspace.apply({{block, longer}});
  const uint64_t declared = workspace.current()->revision();
  EXPECT_NE(declared, revision) << "a function was declared";
  EXPECT_EQ(messagesOf(*workspace.current()), "ramp.st 5:10 E0401 `z` is not declared\n");
  workspace.apply({{block, shorter}});
  EXPECT_EQ(workspace.current()->revision(), declared);
  EXPECT_EQ(messagesOf(*workspace.current()), "ramp.st 6:5 W0758 `unused` is never used; remove it\n");
  const auto held = workspace.apply({{block, longer}});
  EXPECT_EQ(held->revision(), declared);
  const auto after = workspace.apply({{block, shorter}});
  EXPECT_NE(after->revision(), declared);
  EXPECT_EQ(messagesOf(*held), "ramp.st 5:10 E0401 `z` is not declared\n");
}

// What bodies say in the place of each other: a name that is missing in several, a call that makes a program run, a
// constant that a function computes.
TEST_F(WorkspaceTest, WhatOtherBodiesSayIsSaidAgain) {
  const auto function = [&](const char* name, const char* body) {
    return std::string("FUNCTION ") + name + " : INT\nVAR r : Ramp; END_VAR\n" + body + "\nEND_FUNCTION\n";
  };
  const auto texts = [&](const char* first, const char* second) {
    return function("First", first) + function("Second", second) +
           "FUNCTION Third : INT\nVAR CONSTANT n : INT := First(); END_VAR\nVAR a : ARRAY[1..n] OF INT; END_VAR\nThird "
           ":= "
           "a[2];\nEND_FUNCTION\n";
  };
  const std::string file = folder.path() + "/functions.st";
  for (const auto& [first, second] :
       std::initializer_list<std::pair<const char*, const char*>>{{"First := 2;", "Second := 1;"},
                                                                  {"First := r.no;", "Second := r.no;"},
                                                                  {"First := 2;", "Second := r.no;"},
                                                                  {"First := 1;", "Second := r.no;"},
                                                                  {"First := 1;", "Second := 2;"}}) {
    const std::string text = texts(first, second);
    workspace.apply({{file, text}});
    Workspace cold(optionsOf(folder.path()));
    EXPECT_EQ(messagesOf(*workspace.current()), messagesOf(*cold.apply({{file, text}}))) << first << second;
  }
}

// A rule that looks at two files names the later one, whichever was edited last.
TEST_F(WorkspaceTest, FilesKeepTheirOrder) {
  const auto program = [](const char* name, const char* type, const char* value) {
    return std::string("PROGRAM ") + name + "\nVAR v AT %MW0 : " + type + "; END_VAR\nv := " + value +
           ";\nEND_PROGRAM\n";
  };
  const std::string first = folder.write("a.st", program("A", "WORD", "1")),
                    last = folder.write("z.st", program("Z", "DWORD", "2"));
  const std::string messages = messagesOf(*workspace.apply({}));
  EXPECT_NE(messages.find("z.st 2:5 W0369"), std::string::npos) << messages;
  EXPECT_EQ(messagesOf(*workspace.apply({{first, program("A", "WORD", "3")}})), messages);
  EXPECT_EQ(messagesOf(*workspace.apply({{last, program("Z", "DWORD", "4")}})), messages);
}

// A trial says what is wrong with each statement, and nothing of it is left.
TEST_F(WorkspaceTest, StatementsAreTried) {
  const auto snapshot =
      workspace.apply({{main, "PROGRAM Main\nVAR ramp : Ramp; END_VAR\nramp(); x := 1;\nEND_PROGRAM\n"}});
  const std::string messages = messagesOf(*snapshot);
  sema::PouId pou;
  for (uint32_t i = 1; i < snapshot->project()->pous.size(); ++i)
    if (snapshot->names().string(snapshot->project()->pous[i].name) == "Main") pou = {i};
  ASSERT_TRUE(pou);
  const auto tried = [&](const std::vector<std::string>& statements) {
    const auto errors = workspace.errorsOf(pou, statements);
    std::string all;
    for (const std::string& of : errors ? *errors : std::vector<std::string>{"none"}) all += of + "|";
    return all;
  };
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(tried({"ramp();", "x := 1;", "ramp(z := 1);", "x := x;", "ramp.y := ;"}),
              "|1:E0401 |6:E0601 |1:E0401 6:E0401 |11:E0203 |");
    EXPECT_EQ(tried({"%QX0.0 := TRUE;"}), "|");
    EXPECT_EQ(messagesOf(*snapshot), messages);
  }
  EXPECT_EQ(messagesOf(*workspace.apply({{main, kMain}})), "");
}

class TypingTest : public testing::Test {
 protected:
  TypingTest() {
    for (const char* sample : {"conveyor", "traffic_light", "filling_station", "tank", "pick_and_place"})
      fs::copy(std::string(RUNG_SOURCE) + "/samples/" + sample, folder.path() + "/" + sample,
               fs::copy_options::recursive);
  }

  std::string messagesOfCheck(const Typing& typing) {
    Workspace cold(optionsOf(folder.path()));
    std::vector<Change> changes;
    for (const auto& [path, text] : typing.texts()) changes.push_back({path, text});
    return messagesOf(*cold.apply(changes));
  }

  TemporaryFolder folder;
  Workspace workspace{optionsOf(folder.path())};
};

// A snapshot says what a check of the same texts says.
TEST_F(TypingTest, SnapshotsEqualACheck) {
  Typing typing(folder.path(), 41);
  uint64_t revision = workspace.apply({})->revision();
  int bodies = 0;
  for (int round = 0; round < 400; ++round) {
    const Change change = typing.next();
    const auto snapshot = workspace.apply({change});
    bodies += snapshot->revision() == revision ? 1 : 0;
    revision = snapshot->revision();
    const auto pous = static_cast<uint32_t>(snapshot->project() == nullptr ? 0 : snapshot->project()->pous.size());
    for (uint32_t pou = 1 + static_cast<uint32_t>(round) % 7; pou < pous; pou += 7) {
      const sema::Pou& of = snapshot->project()->pous[pou];
      if (!of.decl || of.library) continue;
      EXPECT_TRUE(workspace.errorsOf({pou}, {"x := LIMIT(1, x, 7);", "rung_no_name.x(a := 1);", "END_IF; RETURN;"}));
    }
    ASSERT_EQ(messagesOf(*snapshot), messagesOfCheck(typing)) << change.path << "\n" << *change.text;
  }
  EXPECT_GT(bodies, 40);
}

// … also while four other threads read the snapshots before it.
TEST_F(TypingTest, OldSnapshotsStayReadable) {
  Typing typing(folder.path(), 42);
  std::shared_ptr<const Snapshot> last = workspace.apply({});
  for (int round = 0; round < 50; ++round) {
    const std::string before = messagesOf(*last);
    std::vector<std::thread> readers;
    for (int reader = 0; reader < 4; ++reader)
      readers.emplace_back([snapshot = last, &before] { EXPECT_EQ(messagesOf(*snapshot), before); });
    if (round % 3 == 0) last.reset();  // the readers alone hold it
    last = workspace.apply({typing.next()});
    for (std::thread& reader : readers) reader.join();
    ASSERT_EQ(messagesOf(*last), messagesOfCheck(typing));
  }
}

}  // namespace
}  // namespace rung::workspace

// SPDX-License-Identifier: Apache-2.0
// The tool from a user's view: exit codes, messages, outputs that are whole or absent, the cache, concurrent runs.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "frontend/source/files.h"
#include "tests/unit/tools/temporary_folder.h"

namespace rung::tool {
namespace {

constexpr const char* kCounter =
    "PROGRAM Main\nVAR n : INT; limit : INT := 3; END_VAR\nn := n + 1;\nIF n > limit THEN n := 0; "
    "END_IF;\nEND_PROGRAM\n";

struct Outcome {
  int exit = -1;
  std::string out, err;
};

class CommandTest : public testing::Test {
 protected:
  CommandTest() { setenv("RUNG_CACHE_DIR", cache.path().c_str(), 1); }

  // A line for the shell, run in the test's folder; `rung` is the tool.
  Outcome shell(const std::string& line) const {
    const std::string id = std::to_string(next_++);
    const std::string command = "cd '" + folder.path() + "' && rung() { '" RUNG_TOOL "' \"$@\"; } && ( " + line +
                                " ) >.out" + id + " 2>.err" + id + " </dev/null";
    const int status = system(command.c_str());
    Outcome outcome;
    outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    outcome.out = readFile(folder.path() + "/.out" + id).content;
    outcome.err = readFile(folder.path() + "/.err" + id).content;
    return outcome;
  }
  void expect(const std::string& line, int exit, const std::string& part_of_err) const {
    Outcome outcome = shell(line);
    EXPECT_EQ(outcome.exit, exit) << line << "\n" << outcome.out << outcome.err.substr(0, 2000);
    EXPECT_NE(outcome.err.find(part_of_err), std::string::npos) << line << "\n" << outcome.err.substr(0, 2000);
    EXPECT_LT(outcome.err.size(), 200'000u) << line;
  }
  bool exists(const std::string& name) const { return access((folder.path() + "/" + name).c_str(), F_OK) == 0; }

  TemporaryFolder folder, cache;
  mutable std::atomic<int> next_ = 0;
};

TEST_F(CommandTest, GoodInputIsSilent) {
  folder.write("a.st", kCounter);
  Outcome outcome = shell("rung check a.st");
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(CommandTest, InputsThatCannotBeRead) {
  mkdir((folder.path() + "/empty").c_str(), 0777);
  folder.write("binary.st", std::string("\0\1\2\3", 4));
  folder.write("what.txt", "hello");
  expect("rung check nowhere.st", 2, "cannot read `nowhere.st`: No such file or directory");
  expect("rung check empty", 2, "folder `empty` contains no source file");
  expect("rung check binary.st", 2, "`binary.st` is a binary file");
  expect("rung check what.txt", 2, "unknown file type of `what.txt`");
  expect("rung check", 2, "needs files or folders");
  expect("rung chekc x", 2, "did you mean `check`?");
}

TEST_F(CommandTest, HostileText) {
  folder.write(
      "line.st", "PROGRAM p VAR x : INT; END_VAR x := 1" + [] {
        std::string sum;
        while (sum.size() < 1'000'000) sum += " + 1";
        return sum;
      }() + "; END_PROGRAM");
  folder.write("deep.st", "PROGRAM p VAR x : INT; END_VAR x := " + std::string(10'000, '(') + "1" +
                              std::string(10'000, ')') + "; END_PROGRAM");
  folder.write("comment.st", "PROGRAM p\n(* never closed\nEND_PROGRAM\n");
  folder.write("string.st", "PROGRAM p VAR s : STRING; END_VAR\ns := 'never closed");
  folder.write("word.st", "PROGRAM " + std::string(1'000'000, 'a') + " END_PROGRAM");
  folder.write("noise.st", "PROGRAM p \x01\x02 \xff\xfe ; ; ) ( END_PROGRAM");
  for (const char* name : {"line.st", "deep.st", "comment.st", "string.st", "word.st", "noise.st"}) {
    Outcome outcome = shell(std::string("rung check ") + name);
    EXPECT_TRUE(outcome.exit == 0 || outcome.exit == 1) << name << " " << outcome.exit << outcome.err.substr(0, 2000);
    EXPECT_LT(outcome.err.size(), 200'000u) << name;
  }
  expect("rung check comment.st", 1, "comment.st:2:1: error[E");
  expect("rung check string.st", 1, "string.st:2:6: error[E");
}

TEST_F(CommandTest, FiftyThousandErrors) {
  std::string text = "PROGRAM p\nVAR x : INT; END_VAR\n";
  for (int i = 0; i < 50'000; i++) text += "x := unknown" + std::to_string(i) + ";\n";
  folder.write("many.st", text + "END_PROGRAM\n");
  Outcome outcome = shell("rung check many.st");
  EXPECT_EQ(outcome.exit, 1);
  size_t count = 0;
  for (size_t at = 0; (at = outcome.err.find(": error[", at)) != std::string::npos; at++) count++;
  EXPECT_EQ(count, 100u);
  EXPECT_NE(outcome.err.find("--max-errors"), std::string::npos) << outcome.err.substr(outcome.err.size() - 300);
  EXPECT_EQ(shell("rung check --max-errors=7 many.st 2>&1 | grep -c 'error\\['").out, "7\n");
}

TEST_F(CommandTest, ExitCodes) {
  folder.write("wrong.st", "PROGRAM p\nx := 1;\nEND_PROGRAM\n");
  folder.write("fault.st", "PROGRAM p\nVAR x, y : INT; END_VAR\nx := 1 / y;\nEND_PROGRAM\n");
  folder.write("test.st", "{test}\nPROGRAM t\nASSERT_EQ(1, 2);\nEND_PROGRAM\n");
  expect("rung check wrong.st", 1, "wrong.st:2:1: error[E");
  expect("rung run fault.st --cycles 1", 3, "fault.st:3: fault[div]");
  EXPECT_EQ(shell("rung test test.st").exit, 4);
  expect("rung run wrong.st --cycles 1", 1, "error[E");
  expect("rung emit --emit=ir fault.st >/dev/full", 2, "cannot write to stdout");
}

TEST_F(CommandTest, FailedEmitLeavesTheOldOutput) {
  folder.write("a.st", kCounter);
  ASSERT_EQ(shell("rung emit a.st -o out").exit, 0);
  const std::string before = shell("cd out && ls -l --time-style=full-iso").out;
  folder.write("a.st", "PROGRAM Main\nn := ;\nEND_PROGRAM\n");
  EXPECT_EQ(shell("rung emit a.st -o out").exit, 1);
  EXPECT_EQ(shell("cd out && ls -l --time-style=full-iso").out, before);
  EXPECT_EQ(shell("rung emit a.st -o fresh").exit, 1);
  EXPECT_FALSE(exists("fresh"));
}

TEST_F(CommandTest, EmitDependsOnNothingButTheInput) {
  folder.write("p/a.st", kCounter);
  folder.write("p/b.st", "FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR\nTwice := 2 * x;\nEND_FUNCTION\n");
  ASSERT_EQ(shell("rung emit p -o one && rung emit p/b.st p/a.st -o two && cd p && rung emit . -o ../three").exit, 0);
  EXPECT_EQ(shell("diff -r one two && diff -r one three").exit, 0);
  EXPECT_EQ(shell("grep -rF '" + folder.path() + "' one").exit, 1);
  EXPECT_EQ(shell("rung emit p --list-outputs | sort").out, shell("ls one | grep -v rung.manifest | sort").out);
}

TEST_F(CommandTest, BlanksAndUtf8InPaths) {
  folder.write("m\xc3\xbchle 1/pumpe \xe2\x82\xac.st", kCounter);
  EXPECT_EQ(shell("rung run 'm\xc3\xbchle 1' --cycles 2 --trace -").out,
            "cycle,time_ms,Main.n,Main.limit\n0,0,1,3\n1,10,2,3\n");
  ASSERT_EQ(shell("rung build 'm\xc3\xbchle 1' -o 'm\xc3\xbchle 1/das programm'").exit, 0);
  EXPECT_EQ(shell("'./m\xc3\xbchle 1/das programm' --cycles 1 --trace -").out,
            "cycle,time_ms,Main.n,Main.limit\n0,0,1,3\n");
}

TEST_F(CommandTest, UnchangedRunUsesTheCache) {
  folder.write("a.st", kCounter);
  ASSERT_EQ(shell("rung run --engine=native a.st --cycles 1").exit, 0);
  // Without a compiler, only the cache can serve; another compiler makes another entry.
  EXPECT_EQ(shell("PATH=/nowhere; rung run --engine=native a.st --cycles 1").exit, 2);
  EXPECT_EQ(shell("rung run --engine=native a.st --cycles 1").exit, 0);
  EXPECT_EQ(shell("ls '" + cache.path() + "/work' | wc -l").out, "0\n");
}

TEST_F(CommandTest, InterpretsWithoutACompiler) {
  folder.write("a.st", kCounter);
  folder.write("test.st", "{test}\nPROGRAM t\nASSERT_EQ(2, 2);\nEND_PROGRAM\n");
  EXPECT_EQ(shell("PATH=/nowhere; rung run a.st --cycles 1 --trace -").out,
            "cycle,time_ms,Main.n,Main.limit\n0,0,1,3\n");
  EXPECT_EQ(shell("PATH=/nowhere; rung test test.st").out, "pass t\n1 passed, 0 failed\n");
}

// rung lacks the native functions of a user's library: such a program is compiled, with a message.
TEST_F(CommandTest, CompilesWhatItCannotInterpret) {
  folder.write("lib/plant/own.st", "{native}\nFUNCTION OwnCount : INT\nEND_FUNCTION\n");
  folder.write("a.st", "PROGRAM Main\nVAR x : INT; END_VAR\nx := OwnCount();\nEND_PROGRAM\n");
  expect("rung run a.st -I lib --cycles 1", 1, "no file in a folder `native` defines `rung_plant_OwnCount`");
  folder.write("lib/plant/native/own.cpp",
               "#include \"native_blocks.h\"\nint16_t rung_plant_OwnCount(rung_context*) { return 4; }\n");
  expect("rung run a.st -I lib --cycles 1", 0, "this program runs as compiled C++: the native function `OwnCount`");
  expect("rung run a.st -I lib --cycles 1 --engine=interp", 2, "this program cannot be interpreted");
}

TEST_F(CommandTest, EndlessRecursionIsAFault) {
  folder.write("a.st",
               "FUNCTION F : INT\nVAR_INPUT n : INT; END_VAR\nF := F(n + 1) + 1;\nEND_FUNCTION\n"
               "PROGRAM Main\nVAR x : INT; END_VAR\nx := F(1);\nEND_PROGRAM\n");
  expect("rung run a.st --cycles 1", 3, "a.st:3: fault[stack]: calls are nested too deeply in `F`");
}

TEST_F(CommandTest, ManyRunsAtOnce) {
  folder.write("a.st", kCounter);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; i++)
    threads.emplace_back([this] {
      Outcome outcome = shell("rung run --engine=native a.st --cycles 1 --trace -");
      EXPECT_EQ(outcome.out, "cycle,time_ms,Main.n,Main.limit\n0,0,1,3\n") << outcome.err;
    });
  for (std::thread& thread : threads) thread.join();
}

TEST_F(CommandTest, CacheThatCannotBeWritten) {
  folder.write("a.st", kCounter);
  EXPECT_EQ(shell("RUNG_CACHE_DIR=/proc/rung rung run --engine=native a.st --cycles 1").exit, 0);
}

TEST_F(CommandTest, CompilerThatDoesNotStart) {
  folder.write("a.st", kCounter);
  expect("CXX=no-such-compiler rung run --engine=native a.st --cycles 1", 2, "cannot start `no-such-compiler`");
  expect("CXXFLAGS=-fno-such-flag rung build a.st -o a", 2, "-fno-such-flag");
  EXPECT_FALSE(exists("a"));
}

TEST_F(CommandTest, SeparateTests) {
  for (int i = 0; i < 40; i++)
    folder.write("t/t" + std::to_string(i) + ".st", "FUNCTION Value : INT\nValue := " + std::to_string(i) +
                                                        ";\nEND_FUNCTION\n{test}\nPROGRAM same_name\nASSERT_EQ(" +
                                                        std::to_string(i) + ", Value());\nEND_PROGRAM\n");
  Outcome outcome = shell("rung test --separate t --junit junit.xml");
  EXPECT_EQ(outcome.exit, 0) << outcome.err.substr(0, 2000);
  EXPECT_NE(outcome.out.find("\n40 passed, 0 failed\n"), std::string::npos) << outcome.out;
  EXPECT_NE(readFile(folder.path() + "/junit.xml")
                .content.find("<testsuites name=\"rung\" tests=\"40\" failures=\"0\" errors=\"0\""),
            std::string::npos);
  folder.write("t/t7.st", "{test}\nPROGRAM same_name\nx := 1;\nEND_PROGRAM\n");
  outcome = shell("rung test --separate t");
  EXPECT_EQ(outcome.exit, 4);
  EXPECT_NE(outcome.out.find("FAIL t/t7.st: does not compile\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n39 passed, 1 failed\n"), std::string::npos) << outcome.out;
}

TEST_F(CommandTest, LibrariesOfAFolder) {
  folder.write("lib/plant/pump.st",
               "FUNCTION PumpFlow : INT\nVAR_INPUT level : INT; END_VAR\nPumpFlow := level * 3;\nEND_FUNCTION\n");
  folder.write("a.st", "PROGRAM Main\nVAR x : INT; END_VAR\nx := PumpFlow(2) + plant.PumpFlow(1);\nEND_PROGRAM\n");
  EXPECT_EQ(shell("rung run a.st -I lib --cycles 1 --trace -").out, "cycle,time_ms,Main.x\n0,0,9\n");
  EXPECT_EQ(shell("rung check a.st").exit, 1);
  EXPECT_NE(shell("rung list -I lib --signature pumpflow").out.find("FUNCTION PumpFlow : INT"), std::string::npos);
}

TEST_F(CommandTest, ProjectFileTasks) {
  folder.write("p/rung.project", "[project]\nname = line\n[task fast]\ninterval = 5ms\nprograms = Main\n");
  folder.write("p/main.st", kCounter);
  EXPECT_EQ(shell("rung run p --cycles 2 --watch Main.n --trace -").out, "cycle,time_ms,Main.n\n0,0,1\n1,5,2\n");
  folder.write("p/rung.project", "[project]\nnmae = line\n");
  expect("rung check p", 1, "p/rung.project:2:1: error[E0803]: unknown key `nmae` in section `project`");
}

TEST_F(CommandTest, Explain) {
  EXPECT_NE(shell("rung explain e0401").out.find("E0401"), std::string::npos);
  expect("rung explain E9999", 2, "unknown diagnostic `E9999`");
}

// A change of a block's fields changes its users' code only; just records with many users have a header
// (codegen/records.h).
TEST_F(CommandTest, AnInterfaceChangesItsUsersOnly) {
  std::string text = "TYPE Shared : STRUCT n : INT; END_STRUCT END_TYPE\n";
  for (int i = 0; i < 400; ++i) {
    text += "FUNCTION_BLOCK Unit" + std::to_string(i) +
            " VAR s : Shared; END_VAR VAR_INPUT x : INT; END_VAR s.n := x; END_FUNCTION_BLOCK\n";
  }
  folder.write("units.st", text + "PROGRAM Main VAR u : Unit7; END_VAR u(); END_PROGRAM\n");
  expect("rung emit units.st -o out", 0, "");
  EXPECT_TRUE(exists("out/Shared_.h"));
  EXPECT_FALSE(exists("out/Unit7_.h"));
  expect(
      "touch stamp; sleep 0.05; sed -i 's/Unit7 VAR/Unit7 VAR more : INT; END_VAR VAR/' units.st; rung emit units.st "
      "-o out",
      0, "");
  expect("test $(grep -l 'struct Unit7_type {' out/*.cpp | wc -l) = 2", 0, "");
  expect("test $(find out -name 'code*' -newer stamp | wc -l) = 2", 0, "");
}

}  // namespace
}  // namespace rung::tool

// SPDX-License-Identifier: Apache-2.0
// The driver in one process: two projects, each compiled twice and at the same time, from disk and from the unsaved
// texts of an editor, with the results of the command line.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <thread>

#include "frontend/source/files.h"
#include "tests/unit/tools/temporary_folder.h"
#include "tests/unit/tools/text_sink.h"
#include "tools/driver/commands.h"

namespace rung::driver {
namespace {

constexpr const char* kPump = R"(FUNCTION_BLOCK Pump
VAR_INPUT run : BOOL; END_VAR
VAR_OUTPUT on : BOOL; END_VAR
on := run;
END_FUNCTION_BLOCK
PROGRAM Main
VAR p : Pump; n : INT; END_VAR
p(run := n > 3);
n := n + 1;
END_PROGRAM
)";
constexpr const char* kValve = R"(<?xml version="1.0"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><pous><pou name="Valve" pouType="program">
<interface><localVars><variable name="open"><type><BOOL/></type></variable></localVars></interface>
<body><ST><xhtml:p><![CDATA[open := NOT open; shut := open;]]></xhtml:p></ST></body></pou></pous></types></project>
)";

struct Outcome {
  int exit = -1;
  std::string messages, outputs;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

ProjectOptions projectOf(std::vector<std::string> inputs) {
  ProjectOptions project;
  project.inputs = std::move(inputs);
  return project;
}

Outcome emitted(const ProjectOptions& project) {
  TextSink sink;
  EmitOptions options;
  options.kind = EmitKind::Ir;
  const int exit = runEmit(project, options, sink);
  return {exit, sink.messages, sink.outputs};
}

// The same by the command line.
Outcome byCommand(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string out = folder.path() + "/stdout", err = folder.path() + "/stderr";
  const int status = std::system((std::string(RUNG_TOOL) + " " + arguments + " >" + out + " 2>" + err).c_str());
  return {WEXITSTATUS(status), readFile(err).content, readFile(out).content};
}

TEST(Driver, TwoProjectsTwiceAsFromTheCommandLine) {
  TemporaryFolder folder;
  const std::string pump = folder.write("pump/pump.st", kPump), valve = folder.write("valve/valve.xml", kValve);
  const Outcome first = emitted(projectOf({pump})), other = emitted(projectOf({valve}));
  EXPECT_EQ(first.exit, kSuccess);
  EXPECT_NE(first.outputs.find("Pump"), std::string::npos);
  EXPECT_EQ(other.exit, kInputErrors);
  EXPECT_NE(other.messages.find("`shut`"), std::string::npos) << other.messages;
  EXPECT_EQ(emitted(projectOf({pump})), first);
  EXPECT_EQ(emitted(projectOf({valve})), other);
  EXPECT_EQ(byCommand(folder, "emit --emit=ir " + pump), first);
  EXPECT_EQ(byCommand(folder, "emit --emit=ir " + valve), other);
}

TEST(Driver, UnsavedTextReplacesTheFile) {
  TemporaryFolder folder;
  const std::string pump = folder.write("pump/pump.st", kPump), stale = folder.write("stale/pump.st", "not yet (*");
  const Outcome saved = emitted(projectOf({pump}));
  ProjectOptions options = projectOf({stale});
  options.unsaved = {{stale, kPump}};
  const Outcome unsaved = emitted(options);
  EXPECT_EQ(unsaved, saved);  // the IR names files below the root
  EXPECT_EQ(emitted(options), saved);

  options.unsaved = {{folder.path() + "/stale/../pump/pump.st", "PROGRAM Main\nx := 1;\nEND_PROGRAM\n"}};
  options.inputs = {folder.path() + "/pump"};
  const Outcome broken = emitted(options);
  EXPECT_EQ(broken.exit, kInputErrors);
  EXPECT_EQ(broken.messages.find(pump + ":2:1: error"), 0u) << broken.messages;
}

TEST(Driver, UnsavedFileThatIsNotOnDisk) {
  TemporaryFolder folder;
  folder.write("p/main.st", "PROGRAM Main\nVAR p : Pump; END_VAR\np();\nEND_PROGRAM\n");
  ProjectOptions options = projectOf({folder.path() + "/p"});
  EXPECT_EQ(emitted(options).exit, kInputErrors);
  options.unsaved = {{folder.path() + "/p/inside/pump.st", "FUNCTION_BLOCK Pump\n;\nEND_FUNCTION_BLOCK\n"}};
  const Outcome outcome = emitted(options);
  EXPECT_EQ(outcome.exit, kSuccess) << outcome.messages;
}

TEST(Driver, TwoThreads) {
  TemporaryFolder folder;
  const std::string pump = folder.write("pump/pump.st", kPump), valve = folder.write("valve/valve.xml", kValve);
  const Outcome first = emitted(projectOf({pump})), other = emitted(projectOf({valve}));
  const auto repeat = [](const std::string& path, const Outcome& expected, int& wrong) {
    for (int i = 0; i < 20; ++i) wrong += emitted(projectOf({path})) == expected ? 0 : 1;
  };
  int wrong[2] = {};
  std::thread one([&] { repeat(pump, first, wrong[0]); }), two([&] { repeat(valve, other, wrong[1]); });
  one.join();
  two.join();
  EXPECT_EQ(wrong[0], 0);
  EXPECT_EQ(wrong[1], 0);
}

// Programs and tests write to the sink's files.
class RunSink : public TextSink {
 public:
  RunSink() : file_(open_memstream(&text_, &size_)) {}
  ~RunSink() override {
    fclose(file_);
    free(text_);
  }
  std::FILE* programOutput() override { return file_; }
  std::FILE* programErrors() override { return file_; }
  std::string program() {
    fflush(file_);
    return {text_, size_};
  }

 private:
  char* text_ = nullptr;
  size_t size_ = 0;
  std::FILE* file_;
};

TEST(Driver, RunsAndTestsWithoutTheTerminal) {
  TemporaryFolder folder;
  const std::string pump = folder.write("pump/pump.st", kPump);
  RunOptions options;
  options.host_arguments = {"--cycles=6"};
  RunSink run;
  EXPECT_EQ(runRun(projectOf({pump}), options, run), kSuccess) << run.messages;
  EXPECT_NE(run.program().find("Main.p.on = TRUE\n"), std::string::npos) << run.program();
  EXPECT_EQ(run.messages, "");

  const std::string tests = folder.write("t/t.st", "{test} PROGRAM counts\nASSERT_EQ(1, 1);\nEND_PROGRAM\n");
  RunSink test;
  EXPECT_EQ(runTest(projectOf({tests}), {}, test), kSuccess) << test.messages;
  EXPECT_EQ(test.program(), "pass counts\n1 passed, 0 failed\n");
}

TEST(Driver, FilesAndPages) {
  TemporaryFolder folder;
  ConvertOptions options;
  options.to = ConvertTo::Xml;
  options.output = folder.path() + "/out";
  TextSink sink;
  EXPECT_EQ(runConvert(projectOf({folder.write("pump/pump.st", kPump)}), options, sink), kSuccess) << sink.messages;
  EXPECT_NE(readFile(folder.path() + "/out/pump.xml").content.find("name=\"Pump\""), std::string::npos);
  EXPECT_EQ(runExplain("E0231", false, sink), kSuccess);
  EXPECT_EQ(sink.outputs.find("E0231: "), 0u);
  EXPECT_EQ(runList({}, {"nothing", ""}, sink), kUsage);
  EXPECT_NE(sink.messages.find("rung: error: unknown argument `nothing`"), std::string::npos);
}

}  // namespace
}  // namespace rung::driver

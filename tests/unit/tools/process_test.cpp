// SPDX-License-Identifier: Apache-2.0
// Child processes: folder, output, the first failure.
#include "tools/driver/process.h"

#include <gtest/gtest.h>

#include "frontend/source/files.h"
#include "tests/unit/tools/temporary_folder.h"
#include "tests/unit/tools/text_sink.h"

namespace rung::driver {
namespace {

Process shell(const TemporaryFolder& folder, const std::string& script, const std::string& log) {
  Process process;
  process.arguments = {"sh", "-c", script};
  process.folder = folder.path();
  process.log = folder.path() + "/" + log;
  return process;
}

TEST(Process, RunsInItsFolderAndKeepsBothOutputs) {
  TemporaryFolder folder;
  TextSink sink;
  std::vector<Process> processes = {shell(folder, "pwd; echo err >&2", "a.log"), shell(folder, "exit 0", "b.log")};
  EXPECT_EQ(runAll(processes, 2, "testing", sink), nullptr);
  EXPECT_EQ(readFile(folder.path() + "/a.log").content, folder.path() + "\nerr\n");
}

TEST(Process, TellsTheFirstFailureAndStartsNoMore) {
  TemporaryFolder folder;
  TextSink sink;
  std::vector<Process> processes = {shell(folder, "exit 3", "a.log"), shell(folder, "touch later", "b.log")};
  const Process* failed = runAll(processes, 1, "testing", sink);
  ASSERT_EQ(failed, &processes[0]);
  EXPECT_EQ(failed->exit_code, 3);
  EXPECT_FALSE(readFile(folder.path() + "/later").error.empty());
}

TEST(Process, ProgramThatDoesNotExist) {
  TemporaryFolder folder;
  TextSink sink;
  std::vector<Process> processes = {shell(folder, "", "a.log")};
  processes[0].arguments = {"rung-no-such-program"};
  ASSERT_NE(runAll(processes, 1, "testing", sink), nullptr);
  EXPECT_EQ(processes[0].exit_code, 127);
}

}  // namespace
}  // namespace rung::driver

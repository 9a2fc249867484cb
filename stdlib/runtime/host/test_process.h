// SPDX-License-Identifier: Apache-2.0
// Tests run in a child process, so that a crash, or code that cannot be stopped, ends one test and no more, and the
// results are always reported. In: the numbers of the tests. Out: a result for each. A new child continues after one
// that died. Called by test.cpp.
#pragma once

#include <functional>
#include <vector>

#include "rung/host.h"

namespace rung::host {

struct TestProcess {
  // In the child: runs a test. `where` is shared memory of kWhereSize bytes: a signal handler notes there where code is
  // that cannot be stopped.
  std::function<TestResult(uint32_t test, char* where)> run;
  // In the child, after a test: SIGINT has ended it, so no other begins.
  std::function<bool()> interrupted;
  // In the child, in a handler of SIGABRT and the like: notes in `where` what crashed.
  void (*crashed)(const char* signal);
  // Describes a test that has no result.
  std::function<TestResult(uint32_t test)> describe;
  // In this process, in the order of the tests.
  std::function<void(TestResult)> report;
};
constexpr size_t kWhereSize = 4096;

// Returns why no process could be started, or an empty string.
std::string runInChildren(const std::vector<uint32_t>& tests, const TestOptions& options, const TestProcess& process,
                          TestResults& results);

}  // namespace rung::host

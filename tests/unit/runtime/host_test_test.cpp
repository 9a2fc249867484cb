// SPDX-License-Identifier: Apache-2.0
// `rung test` on the sample module: messages, faults, `done`, filter, JUnit.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "rung/host.h"
#include "sample_module.h"
#include "stdlib/runtime/host/junit.h"

using namespace rung::host;

namespace {

std::string go(const TestOptions& options, int expected_code) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(test(sample::module(), options), expected_code);
  return testing::internal::GetCapturedStdout();
}

TEST(TestHost, ReportsEachTest) {
  EXPECT_EQ(go({}, 4),
            "pass good_test\n"
            "t.st:8: assertion failed: expected 5, got -7 (the level)\n"
            "t.st:9: assertion failed: expected 'a', got 'b$$'\n"
            "t.st:10:4: assertion failed: expected TRUE, got FALSE (never)\n"
            " 10 | \tü ASSERT(FALSE);\n"
            "    | \t  ^~~~~~\n"
            "FAIL bad_test\n"
            "main.st:14: fault[index]: index 11 is outside 1..10 in `Main`\n"
            "FAIL faulting_test\n"
            "pass cyclic_test\n"
            "t.st:30: `done` is still FALSE after 100000 cycles\n"
            "FAIL endless_test\n"
            "2 passed, 3 failed\n");
}

TEST(TestHost, FilterAndJUnit) {
  TestOptions options;
  options.filters = {"Good*"};
  options.junit_path = testing::TempDir() + "rung_junit.xml";
  EXPECT_EQ(go(options, 0), "pass good_test\n1 passed, 0 failed\n");
  options.filters = {"bad_test"};
  go(options, 4);
  std::ostringstream xml;
  xml << std::ifstream(options.junit_path).rdbuf();
  const std::regex time(" time=\"0\\.[0-9]{6}\"");
  const std::string messages =
      "t.st:8: assertion failed: expected 5, got -7 (the level)\n"
      "t.st:9: assertion failed: expected 'a', got 'b$$'\n"
      "t.st:10:4: assertion failed: expected TRUE, got FALSE (never)\n"
      " 10 | \tü ASSERT(FALSE);\n"
      "    | \t  ^~~~~~\n";
  EXPECT_EQ(std::regex_replace(xml.str(), time, " T"),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites name=\"rung\" tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\" T>\n"
            "  <testsuite name=\"t.st\" tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\" T>\n"
            "    <testcase name=\"bad_test\" classname=\"t\" file=\"t.st\" line=\"6\" assertions=\"3\" T>\n"
            "      <failure message=\"t.st:8: assertion failed: expected 5, got -7 (the level)\">" +
                messages + "</failure>\n    </testcase>\n    <system-out>" + messages +
                "FAIL bad_test\n</system-out>\n  </testsuite>\n</testsuites>\n");
}

TEST(TestHost, JUnitTellsFaultsFromFailures) {
  TestResults results;
  results.tests.push_back({"a", "plc/x.st", 1, TestResult::Passed, 1, 0.5, "", "plc/x.st"});
  results.tests.push_back({"b", "y.st", 2, TestResult::Broken, 0, 0.25, "y.st:3: fault[div]\n", "y.st"});
  results.tests.push_back({"c", "plc/x.st", 9, TestResult::Failed, 1, 0.25, "<&>\n", "plc/x.st"});
  EXPECT_EQ(junitXml(results),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites name=\"rung\" tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\" time=\"1.000000\">\n"
            "  <testsuite name=\"plc/x.st\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\" time=\"0.750000\">\n"
            "    <testcase name=\"a\" classname=\"plc.x\" file=\"plc/x.st\" line=\"1\" assertions=\"1\" "
            "time=\"0.500000\"/>\n"
            "    <testcase name=\"c\" classname=\"plc.x\" file=\"plc/x.st\" line=\"9\" assertions=\"1\" "
            "time=\"0.250000\">\n"
            "      <failure message=\"&lt;&amp;&gt;\">&lt;&amp;&gt;\n</failure>\n    </testcase>\n"
            "    <system-out>pass a\n&lt;&amp;&gt;\nFAIL c\n</system-out>\n  </testsuite>\n"
            "  <testsuite name=\"y.st\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\" time=\"0.250000\">\n"
            "    <testcase name=\"b\" classname=\"y\" file=\"y.st\" line=\"2\" assertions=\"0\" time=\"0.250000\">\n"
            "      <error message=\"y.st:3: fault[div]\">y.st:3: fault[div]\n</error>\n    </testcase>\n"
            "    <system-out>y.st:3: fault[div]\nFAIL b\n</system-out>\n  </testsuite>\n</testsuites>\n");
}

}  // namespace

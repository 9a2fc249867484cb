// `rung test` on the sample module: messages, faults, `done`, filter, JUnit.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "rung/host.h"
#include "sample_module.h"

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
            "t.st:10: assertion failed: expected TRUE, got FALSE (never)\n"
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
  options.filter = "Good*";
  options.junit_path = testing::TempDir() + "rung_junit.xml";
  EXPECT_EQ(go(options, 0), "pass good_test\n1 passed, 0 failed\n");
  options.filter = "bad_test";
  go(options, 4);
  std::ostringstream xml;
  xml << std::ifstream(options.junit_path).rdbuf();
  EXPECT_EQ(xml.str(),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites tests=\"1\" failures=\"1\">\n  <testsuite name=\"sample\" tests=\"1\" failures=\"1\">\n"
            "    <testcase name=\"bad_test\" classname=\"t.st\" file=\"t.st\" line=\"6\" assertions=\"3\">\n"
            "      <failure message=\"t.st:8: assertion failed: expected 5, got -7 (the level)\">"
            "t.st:8: assertion failed: expected 5, got -7 (the level)&#10;"
            "t.st:9: assertion failed: expected 'a', got 'b$$'&#10;"
            "t.st:10: assertion failed: expected TRUE, got FALSE (never)&#10;</failure>\n"
            "    </testcase>\n  </testsuite>\n</testsuites>\n");
}

}  // namespace

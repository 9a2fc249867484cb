// Test results as JUnit XML, as Jenkins and GitLab read it: a <testsuite> for each file of tests. Called by test.cpp.
#pragma once

#include <string>

#include "rung/host.h"

namespace rung::host {

std::string junitXml(const TestResults& results);

}  // namespace rung::host

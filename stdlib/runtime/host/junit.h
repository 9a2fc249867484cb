// SPDX-License-Identifier: Apache-2.0
// Test results as JUnit XML for Jenkins and GitLab: a <testsuite> for each file of tests. Called by test.cpp.
#pragma once

#include <string>

#include "rung/host.h"

namespace rung::host {

std::string junitXml(const TestResults& results);

}  // namespace rung::host

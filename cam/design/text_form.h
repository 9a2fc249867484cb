// SPDX-License-Identifier: Apache-2.0
// A cam as the text of a `.cam` file (docs/cam.md). In: a cam. Out: text from which frontend/import/cam makes the same
// cam, to the last bit of each number. Called by `rung cam`.
#pragma once

#include <string>

#include "cam/design/cam.h"

namespace rung::cam {

std::string textOf(const Cam& cam);

// The shortest digits that read back as the same number.
std::string exactText(double value);

}  // namespace rung::cam

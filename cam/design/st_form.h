// A cam as declarations in ST: `<name>_A` with its rows, `<name>_S` with its segments and `<name>_T` with its tappets,
// where it has them, and the MC_CAM_REF `<name>`. In: a cam. Out: the text. Called by the reader of `.cam` files of a
// project and by `rung cam convert`.
#pragma once

#include <string>

#include "cam/design/cam.h"

namespace rung::cam {

// `VAR_GLOBAL … END_VAR`
std::string globalsOf(const Cam& cam);

}  // namespace rung::cam

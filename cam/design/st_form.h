// SPDX-License-Identifier: Apache-2.0
// A cam as declarations in ST: `<name>_A` with its rows, `<name>_S` with its segments and `<name>_T` with its tappets,
// where it has them, and the MC_CAM_REF `<name>`. What a program does not need, such as units and limits, is in an
// attribute of that variable, as lines of a `.cam` file. In: a cam. Out: the text, from which `rung cam convert` makes
// the same cam. Called by the reader of `.cam` files of a project and by `rung cam convert`.
#pragma once

#include <string>
#include <string_view>

#include "cam/design/cam.h"

namespace rung::cam {

// {attribute 'cam' := 'repeat relative; master deg; slave mm'}
inline constexpr std::string_view kDesignAttribute = "cam";
// {attribute 'unique_name'}: a second global variable of the name is an error.
inline constexpr std::string_view kUniqueAttribute = "unique_name";

enum class Duplicates : uint8_t { AreAllowed, AreErrors };  // of the names, in other files
// `VAR_GLOBAL … END_VAR`
std::string globalsOf(const Cam& cam, Duplicates duplicates = Duplicates::AreAllowed);

// The `.cam` text of a cam whose table was read from ST, with what the attribute says of its design.
std::string withDesign(Cam table, std::string_view attribute);

}  // namespace rung::cam
